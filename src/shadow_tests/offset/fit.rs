//! From a light and what is in its scene to the map's camera: what has to be drawn into it, and no more around that than
//! the test asks for.

use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::shape::Shape;
use crate::scene::{Beam, Light, LightKind, Mesh, camera};
use crate::shadow_tests::polygon::Polygon;
use crate::shadow_tests::{LightSpace, Placed, Rays};

/// How many points or triangles are worth a thread.
const WORTH_A_THREAD: usize = 4096;

/// Texels that are left free on each side: of those that are asked about a point, the farthest is not two away.
const MARGIN: f64 = 2.0;
/// How much nearer than the nearest caster the near plane is, and how much farther than everything the far plane: none
/// of them is cut off by rounding.
const ROOM: f64 = 1.0 / 64.0;
/// The least that near may be of far. Depths between them are so much less precise, and what is nearer is not cut off:
/// its depth is near's.
const LEAST_NEAR: f64 = 1e-3;
/// The least width of the map, in the light's space: a caster that is seen edge-on has none.
const LEAST_WIDTH: f64 = 1e-6;

/// Where a spot light's rays go: |x|, |y| are at most the depth.
const BEAM: [DVec2; 2] = [DVec2::NEG_ONE, DVec2::ONE];

/// What of a mesh has to be drawn into the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Casts {
    Nothing,
    /// Of a solid, the light meets its front faces first: the others are never seen.
    FrontFaces,
    BothFaces,
}

/// The map's camera, in the light's space.
pub struct Fit {
    pub space: LightSpace,
    /// Of each mesh in the scene.
    pub casts: Vec<Casts>,
    /// The corners of the map, as (x, y)/depth or, where rays are parallel, as (x, y).
    pub least: DVec2,
    pub most: DVec2,
    pub near: f64,
    pub far: f64,
}

/// Fits maps; it keeps what it has found out about each mesh.
#[derive(Default)]
pub struct Fitter {
    shapes: Vec<(Arc<Mesh>, Arc<Shape>)>,
}

impl Fitter {
    /// Of a map with so many texels on each side.
    pub fn fit(&mut self, light: &Light, scene: &[Placed], size: u32) -> Fit {
        let shapes: Vec<_> = scene.iter().map(|placed| self.shape(placed)).collect();
        let boxes = scene.iter().zip(&shapes);
        let corners: Vec<Vec<DVec3>> = boxes
            .map(|(placed, shape)| shape.corners(placed.model))
            .collect();
        let space = LightSpace::new(&within_one_map(light), &corners.concat());
        let corners: Vec<Vec<DVec3>> = corners
            .iter()
            .map(|corners| corners.iter().map(|p| space.from_world(*p)).collect())
            .collect();

        // A floor under everything is in nothing's way.
        let casts_on_something = |index: usize| {
            let from_object = space.from_object(scene[index].model);
            let others = corners.iter().enumerate().filter(|(i, _)| *i != index);
            let others: Vec<DVec3> = others.flat_map(|(_, c)| c).copied().collect();
            !shapes[index].convex || !shapes[index].is_behind(space.rays, from_object, &others)
        };
        let mut casts = Vec::new();
        let mut seen = Extent::NOTHING;
        for (index, placed) in scene.iter().enumerate() {
            let mut what = Casts::Nothing;
            if placed.casts && casts_on_something(index) {
                let extent = Extent::of(&space, placed);
                seen = seen.and(extent);
                let from_object = space.from_object(placed.model);
                what = match extent.least.is_finite() {
                    false => Casts::Nothing,
                    true if shapes[index].is_solid_to(space.rays, from_object) => Casts::FrontFaces,
                    true => Casts::BothFaces,
                };
            }
            casts.push(what);
        }

        let depths = corners.iter().flatten().map(|corner| -corner.z);
        let farthest = depths.fold(f64::NEG_INFINITY, f64::max);
        Fit::around(space, casts, &seen, farthest, size)
    }

    fn shape(&mut self, placed: &Placed) -> Arc<Shape> {
        let mut known = self.shapes.iter();
        if let Some((_, shape)) = known.find(|(mesh, _)| Arc::ptr_eq(mesh, &placed.mesh)) {
            return shape.clone();
        }
        let shape = Arc::new(Shape::new(&placed.mesh));
        self.shapes.push((placed.mesh.clone(), shape.clone()));
        shape
    }
}

/// One map sees what a spot light's beam does: for a point light, its map's field of view takes the beam's place.
fn within_one_map(light: &Light) -> Light {
    let kind = match light.kind {
        LightKind::Point { shadow_fov } => LightKind::Spot {
            cone: shadow_fov,
            beam: Beam::Rectangular,
        },
        kind => kind,
    };
    Light {
        kind,
        ..light.clone()
    }
}

impl Fit {
    fn around(
        space: LightSpace,
        casts: Vec<Casts>,
        seen: &Extent,
        farthest: f64,
        size: u32,
    ) -> Self {
        let (mut least, mut most) = (seen.least, seen.most);
        // Where nothing casts, the map is empty and may lie anywhere.
        if !least.is_finite() {
            [least, most] = BEAM;
        }
        let width = (most - least).max(DVec2::splat(LEAST_WIDTH));
        let middle = 0.5 * (least + most);
        let texels = f64::from(size);
        let half = 0.5 * width * texels / (texels - 2.0 * MARGIN);
        let nearest = seen.nearest.min(farthest);
        let [near, far] = match space.rays {
            Rays::Spot | Rays::Point => {
                let far = farthest.max(f64::MIN_POSITIVE) * (1.0 + ROOM);
                [(nearest * (1.0 - ROOM)).max(LEAST_NEAR * far), far]
            }
            Rays::Parallel => {
                let room = ROOM * (farthest - nearest).max(LEAST_WIDTH);
                [nearest - room, farthest + room]
            }
        };
        Self {
            space,
            casts,
            least: middle - half,
            most: middle + half,
            near,
            far,
        }
    }

    /// The light's space to clip space.
    pub fn projection(&self) -> DMat4 {
        let window = [self.least.x, self.most.x, self.least.y, self.most.y];
        match self.space.rays {
            Rays::Spot | Rays::Point => camera::frustum(window, self.near, self.far),
            Rays::Parallel => camera::orthographic(window, self.near, self.far),
        }
    }

    /// The map's corner, and how many texels there are to a unit, across and up.
    pub fn rectangle(&self, size: u32) -> DVec4 {
        let scale = f64::from(size) / (self.most - self.least);
        self.least.extend(scale.x).extend(scale.y)
    }

    /// The depth that the map has of a nearness is the first number less the second times the nearness: 1/depth or,
    /// where rays are parallel, z. The second one, again, for a gain in nearness along x and y: in depth per texel.
    pub fn depths(&self, size: u32) -> DVec4 {
        let Self { near, far, .. } = *self;
        let [of_none, loss] = match self.space.rays {
            Rays::Spot | Rays::Point => [far / (far - near), far * near / (far - near)],
            Rays::Parallel => [-near / (far - near), 1.0 / (far - near)],
        };
        let texel = (self.most - self.least) / f64::from(size);
        DVec4::new(of_none, loss, loss * texel.x, loss * texel.y)
    }
}

/// What of a caster the light sees.
#[derive(Clone, Copy)]
struct Extent {
    least: DVec2,
    most: DVec2,
    nearest: f64,
}

impl Extent {
    const NOTHING: Self = Self {
        least: DVec2::INFINITY,
        most: DVec2::NEG_INFINITY,
        nearest: f64::INFINITY,
    };

    fn of(space: &LightSpace, placed: &Placed) -> Self {
        let from_object = space.from_object(placed.model);
        let positions = placed.mesh.positions.par_iter();
        let positions = positions.with_min_len(WORTH_A_THREAD);
        let point = |position: &DVec3| from_object.transform_point3(*position);
        if space.rays == Rays::Parallel {
            let seen = positions.map(|position| {
                let point = point(position);
                Self::of_point(point.truncate(), -point.z)
            });
            return seen.reduce(|| Self::NOTHING, Self::and);
        }
        // Nearly always all of it is in the beam, and its corners say enough.
        let in_beam = |point: DVec3| point.x.abs().max(point.y.abs()) <= -point.z;
        let seen = positions.clone().map(|position| {
            let point = point(position);
            in_beam(point).then(|| Self::of_point(point.truncate() / -point.z, -point.z))
        });
        let whole = seen.try_reduce(|| Self::NOTHING, |some, others| Some(some.and(others)));
        whole.unwrap_or_else(|| {
            let faces = placed.mesh.faces.par_iter().with_min_len(WORTH_A_THREAD);
            let seen = faces.map(|face| {
                let corners = face.map(|i| {
                    let point = point(&placed.mesh.positions[i as usize]);
                    point.truncate().extend(-point.z)
                });
                let [least, most] = BEAM;
                let cut = Polygon::new(corners).clipped(least, most);
                let corners = cut.corners().iter();
                corners.fold(Self::NOTHING, |seen, corner| {
                    // At the light itself there is no direction to see it in.
                    let place = match corner.z > 0.0 {
                        true => corner.truncate() / corner.z,
                        false => DVec2::ZERO,
                    };
                    seen.and(Self::of_point(place, corner.z))
                })
            });
            seen.reduce(|| Self::NOTHING, Self::and)
        })
    }

    fn of_point(place: DVec2, depth: f64) -> Self {
        Self {
            least: place,
            most: place,
            nearest: depth,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            least: self.least.min(other.least),
            most: self.most.max(other.most),
            nearest: self.nearest.min(other.nearest),
        }
    }
}
