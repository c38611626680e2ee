//! Rays through triangles, in f64.
//!
//! Which triangles a ray may meet is told by a tree of boxes in f32 (the crate obvhs), padded so that none is missed;
//! whether it meets one is decided here, in f64, by the watertight test of Woop, Benthin and Wald, "Watertight
//! Ray/Triangle Intersection" (JCGT 2013): a ray through an edge or a corner that two triangles share meets at least
//! one of them.

use std::time::Duration;

use glam::{DVec2, DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray as BoxRay, RayHit};

/// Half the width of the tree's own coordinates. The tree takes boxes nearer than 1e-4 for met or missed as it falls,
/// and directions below 2⁻²³ for 2⁻²³: in coordinates this large both are far below the padding.
const TREE_RADIUS: f64 = 1_048_576.0;
/// How much each box is larger, in the tree's coordinates: some 60 times what f32 rounds there.
const PADDING: f32 = 4.0;

/// What f64 rounds in finding a point of a triangle, relative to the largest coordinates: some 64 roundings.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Triangles that rays can meet, each known by its index.
pub struct Surfaces {
    triangles: Vec<[DVec3; 3]>,
    tree: Option<CwBvh>,
    /// To the tree's coordinates: first less the centre, then times the scale.
    centre: DVec3,
    scale: f64,
}

/// Where a ray meets a triangle: at origin + t · direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    pub triangle: u32,
    pub t: f64,
}

impl Surfaces {
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let corners = || triangles.iter().flatten();
        let least = corners().fold(DVec3::INFINITY, |a, b| a.min(*b));
        let most = corners().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
        let mut surfaces = Self {
            centre: 0.5 * (least + most),
            scale: TREE_RADIUS / (0.5 * (most - least).max_element()).max(f64::MIN_POSITIVE),
            triangles,
            tree: None,
        };
        // The tree's builder wants two boxes at least.
        if surfaces.triangles.len() > 1 {
            let boxes: Vec<Aabb> = surfaces
                .triangles
                .iter()
                .map(|t| surfaces.tree_box(t))
                .collect();
            let params = BvhBuildParams::medium_build();
            surfaces.tree = Some(build_cwbvh(&boxes, params, &mut Duration::default()));
        }
        surfaces
    }

    pub fn triangle(&self, index: u32) -> &[DVec3; 3] {
        &self.triangles[index as usize]
    }

    /// The nearest triangle that the ray meets at a `t` from `near` to `far`; of two at the same, the first.
    pub fn nearest(&self, ray: &Ray, near: f64, far: f64) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let Some(tree) = &self.tree else {
            return self.nearest_of_all(ray, near, far);
        };
        let box_ray = self.box_ray(ray, far);
        let per_t = self.scale * ray.direction.length();
        tree.ray_traverse(box_ray, &mut RayHit::none(), |box_ray, place| {
            let triangle = tree.primitive_indices[place];
            if let Some(t) = ray.meets(&self.triangles[triangle as usize])
                && (near..=far).contains(&t)
                && best.is_none_or(|best| t < best.t || (t == best.t && triangle < best.triangle))
            {
                best = Some(Hit { triangle, t });
                return (t * per_t) as f32;
            }
            box_ray.tmax
        });
        best
    }

    /// Whether any triangle that `blocks` says may, meets the ray at a `t` between `near` and `end`, both excluded.
    pub fn is_met(&self, ray: &Ray, near: f64, end: f64, blocks: impl Fn(u32) -> bool) -> bool {
        let meets = |triangle: u32| {
            blocks(triangle)
                && ray
                    .meets(&self.triangles[triangle as usize])
                    .is_some_and(|t| near < t && t < end)
        };
        match &self.tree {
            None => (0..self.triangles.len() as u32).any(meets),
            Some(tree) => !tree.ray_traverse_miss(self.box_ray(ray, end), |box_ray, place| {
                if meets(tree.primitive_indices[place]) {
                    0.0
                } else {
                    box_ray.tmax
                }
            }),
        }
    }

    /// [`Self::nearest`] without the tree: every triangle is asked. For the checks.
    pub fn nearest_of_all(&self, ray: &Ray, near: f64, far: f64) -> Option<Hit> {
        let hits = self
            .triangles
            .iter()
            .zip(0..)
            .filter_map(|(corners, triangle)| {
                let t = ray.meets(corners)?;
                (near..=far).contains(&t).then_some(Hit { triangle, t })
            });
        hits.reduce(|a, b| if b.t < a.t { b } else { a })
    }

    /// [`Self::is_met`] without the tree.
    pub fn is_met_by_any(
        &self,
        ray: &Ray,
        near: f64,
        end: f64,
        blocks: impl Fn(u32) -> bool,
    ) -> bool {
        self.triangles.iter().zip(0..).any(|(corners, triangle)| {
            blocks(triangle) && ray.meets(corners).is_some_and(|t| near < t && t < end)
        })
    }

    /// How far a point that was computed on a triangle may lie off its plane.
    pub fn rounding(&self) -> f64 {
        ROUNDING * (self.centre.length() + TREE_RADIUS / self.scale)
    }

    fn to_tree(&self, point: DVec3) -> Vec3A {
        ((point - self.centre) * self.scale).as_vec3a()
    }

    fn tree_box(&self, corners: &[DVec3; 3]) -> Aabb {
        let mut around = Aabb::from_points(&corners.map(|corner| self.to_tree(corner)));
        around.min -= PADDING;
        around.max += PADDING;
        around
    }

    /// The ray in the tree's coordinates: with a direction of length 1, as its limits above assume.
    fn box_ray(&self, ray: &Ray, far: f64) -> BoxRay {
        let length = ray.direction.length();
        let far = (far * length * self.scale) as f32 + PADDING;
        let direction = (ray.direction / length).as_vec3a();
        BoxRay::new(self.to_tree(ray.origin), direction, 0.0, far.min(f32::MAX))
    }
}

/// A ray, with what the watertight test needs of it: the axis along which it mostly runs, and the shear that makes it
/// run along that axis alone.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
    /// The two minor axes and the major one.
    axes: [usize; 3],
    shear: DVec2,
}

impl Ray {
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let major = direction.abs().max_position();
        let (mut x, mut y) = ((major + 1) % 3, (major + 2) % 3);
        if direction[major] < 0.0 {
            // Keeps the winding of the triangles.
            std::mem::swap(&mut x, &mut y);
        }
        Self {
            origin,
            direction,
            axes: [x, y, major],
            shear: DVec2::new(direction[x], direction[y]) / direction[major],
        }
    }

    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// At which `t` the ray's line meets the triangle, whichever way it faces.
    pub fn meets(&self, corners: &[DVec3; 3]) -> Option<f64> {
        let [x, y, z] = self.axes;
        // The corners seen along the ray: two coordinates across it, and the distance along its major axis.
        let [a, b, c] = corners.map(|corner| {
            let corner = corner - self.origin;
            DVec3::new(
                corner[x] - self.shear.x * corner[z],
                corner[y] - self.shear.y * corner[z],
                corner[z],
            )
        });
        // On which side of each edge the ray passes.
        let u = c.x * b.y - c.y * b.x;
        let v = a.x * c.y - a.y * c.x;
        let w = b.x * a.y - b.y * a.x;
        let mixed = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let area = u + v + w;
        if mixed || area == 0.0 {
            return None;
        }
        Some((u * a.z + v * b.z + w * c.z) / (area * self.direction[z]))
    }
}
