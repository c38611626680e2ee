//! How the cells lie over the light's view, and where in it points and polygons are seen.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::builder::WORTH_A_THREAD;
use crate::shadow_tests::polygon::{PADDING, Polygon};
use crate::shadow_tests::space::Rays;

/// How many cells there are for each caster: fewer make longer lists, more take longer to fill. Between 4 and 16 the frames
/// of the labs' scenes differ by less than a tenth.
const CELLS_FOR_A_CASTER: f64 = 8.0;
/// The least and the most cells on each side of the grid: to fill fewer costs nothing, and with 100,000 casters to fill
/// 256 a side takes half as long again as 160, which shorter lists do not make up for.
const SIDES: [f64; 2] = [64.0, 160.0];

/// What the light's view has at most: the beam, or a face.
const VIEW: [DVec2; 2] = [DVec2::NEG_ONE, DVec2::ONE];

/// A point as the light sees it.
#[derive(Clone, Copy)]
pub struct Seen {
    /// The face that sees the point; [`NOWHERE`] where it is outside of the view, or near the border of a face.
    pub face: u32,
    /// x/depth and y/depth.
    place: DVec2,
}

pub const NOWHERE: u32 = u32::MAX;

impl Seen {
    pub fn new(rays: Rays, point: DVec3) -> Self {
        let (face, half) = match rays {
            Rays::Spot | Rays::Parallel => (0, 1.0),
            Rays::Point => {
                let size = point.abs();
                let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
                let face = 2 * axis as u32 + u32::from(point[axis] < 0.0);
                // What is nearer to a face's border than a cell's padding is seen by its neighbour too.
                (face, 1.0 - 2.0 * PADDING * 2.0 / SIDES[0])
            }
        };
        let on_face = on_face(rays, face, point);
        let place = on_face.truncate() / on_face.z;
        let inside = on_face.z > 0.0 && place.abs().max_element() <= half;
        let face = if inside { face } else { NOWHERE };
        Self { face, place }
    }
}

/// How the cells lie over the light's view.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    pub rays: Rays,
    pub side: u32,
    /// The corner, and how many cells there are to a unit.
    pub least: DVec2,
    pub scale: DVec2,
}

impl Layout {
    /// Over the rectangle of what casts.
    pub fn around(rays: Rays, points: &[DVec3], seen: &[Seen], casters: &[Shape]) -> Self {
        let [least_side, most_side] = SIDES;
        let side = (CELLS_FOR_A_CASTER * casters.len() as f64).sqrt().ceil();
        // Of a point light as many on each face: all casters may lie on one.
        let side = side.clamp(least_side, most_side);
        let [least, most] = match rays {
            Rays::Point => VIEW,
            Rays::Spot | Rays::Parallel => {
                let nothing = || [DVec2::INFINITY, DVec2::NEG_INFINITY];
                let join = |[least, most]: [DVec2; 2], [other_least, other_most]: [DVec2; 2]| {
                    [least.min(other_least), most.max(other_most)]
                };
                let shapes = casters.par_iter().with_min_len(WORTH_A_THREAD);
                let rectangles = shapes.map(|shape| {
                    let [a, b, c] = shape.points;
                    let [a, b, c] = [seen[a as usize], seen[b as usize], seen[c as usize]];
                    if a.face == 0 && b.face == 0 && c.face == 0 {
                        let [a, b, c] = [a.place, b.place, c.place];
                        return [a.min(b).min(c), a.max(b).max(c)];
                    }
                    let polygon = shape.on_face(rays, 0, points);
                    let [view_least, view_most] = VIEW;
                    let polygon = polygon.clipped(view_least, view_most);
                    let places = polygon.corners().iter().map(|c| [c.truncate() / c.z; 2]);
                    places.fold(nothing(), join)
                });
                rectangles.reduce(nothing, join)
            }
        };
        // Without casters one cell is over everything, and is empty.
        let scale = side / (most - least);
        let is_flat = !(least.is_finite() && scale.is_finite());
        Self {
            rays,
            side: side as u32,
            least: if is_flat { DVec2::ZERO } else { least },
            scale: if is_flat { DVec2::ZERO } else { scale },
        }
    }

    pub fn faces(&self) -> u32 {
        match self.rays {
            Rays::Point => 6,
            Rays::Spot | Rays::Parallel => 1,
        }
    }

    pub fn cell_count(&self) -> usize {
        (self.faces() * self.side * self.side) as usize
    }

    /// The face that sees all corners of a shape, if that is one.
    pub fn face_of(&self, shape: &Shape, seen: &[Seen]) -> Option<u32> {
        let [a, b, c] = shape.points;
        let face = |point: u32| seen[point as usize].face;
        let first = face(a);
        (first != NOWHERE && first == face(b) && first == face(c)).then_some(first)
    }

    /// What a face sees of a shape, in cells.
    pub fn outline(&self, shape: &Shape, face: u32, points: &[DVec3], seen: &[Seen]) -> Outline {
        let to_cells = |place: DVec2| (place - self.least) * self.scale;
        if self.face_of(shape, seen) == Some(face) {
            let [a, b, c] = shape.points;
            let corner = |point: u32| to_cells(seen[point as usize].place);
            return Outline::Triangle([corner(a), corner(b), corner(c)]);
        }
        let padding = PADDING / self.scale;
        let polygon = shape.on_face(self.rays, face, points).clipped(
            self.least - padding,
            self.least + f64::from(self.side) / self.scale + padding,
        );
        let corners = polygon.corners().iter();
        Outline::Clipped(corners.map(|c| to_cells(c.truncate() / c.z)).collect())
    }

    /// A plane in the light's space, from what it has of (x, y, 1), in cells: the other way round than [`Self::nearness`].
    pub fn plane(&self, face: u32, in_cells: DVec3) -> DVec3 {
        let slope = in_cells.truncate() * self.scale;
        let on_face = slope.extend(in_cells.z - slope.dot(self.least));
        match self.rays {
            Rays::Spot | Rays::Parallel => DVec3::new(on_face.x, on_face.y, -on_face.z),
            Rays::Point => from_face(face, on_face),
        }
    }

    /// The nearness of a caster's plane: what it has of (x, y, 1), in cells.
    pub fn nearness(&self, face: u32, plane: DVec3) -> DVec3 {
        let on_face = match self.rays {
            Rays::Spot | Rays::Parallel => DVec3::new(plane.x, plane.y, -plane.z),
            Rays::Point => on_face(self.rays, face, plane),
        };
        let slope = on_face.truncate() / self.scale;
        slope.extend(on_face.z + on_face.truncate().dot(self.least))
    }
}

/// A caster; or an edge of the boundary of some casters, as a triangle with two equal corners.
#[derive(Clone, Copy)]
pub struct Shape {
    pub points: [u32; 3],
    /// The casters of one component that face one way.
    pub group: u32,
    /// The caster's triangle; [`BOUNDARY`] if it is none.
    pub caster: u32,
}

pub const BOUNDARY: u32 = u32::MAX;

impl Shape {
    fn on_face(&self, rays: Rays, face: u32, points: &[DVec3]) -> Polygon {
        Polygon::new(self.points.map(|i| on_face(rays, face, points[i as usize])))
    }
}

/// The corners of a convex polygon, in cells.
pub enum Outline {
    Triangle([DVec2; 3]),
    /// What has been cut at the border of the view; that may be nothing.
    Clipped(Vec<DVec2>),
}

impl Outline {
    pub fn corners(&self) -> &[DVec2] {
        match self {
            Self::Triangle(corners) => corners,
            Self::Clipped(corners) => corners,
        }
    }
}

/// A point as a face sees it, as (x, y, depth). Face 2k looks along axis k, face 2k + 1 against it.
fn on_face(rays: Rays, face: u32, point: DVec3) -> DVec3 {
    match rays {
        Rays::Spot => DVec3::new(point.x, point.y, -point.z),
        Rays::Parallel => DVec3::new(point.x, point.y, 1.0),
        Rays::Point => {
            let face = face as usize;
            let axis = face / 2;
            let along = [1.0, -1.0][face % 2];
            DVec3::new(
                point[(axis + 1) % 3],
                point[(axis + 2) % 3],
                along * point[axis],
            )
        }
    }
}

/// Where a point is that a face of a point light sees there: the other way round than [`on_face`].
fn from_face(face: u32, seen: DVec3) -> DVec3 {
    let face = face as usize;
    let axis = face / 2;
    let along = [1.0, -1.0][face % 2];
    let mut point = DVec3::ZERO;
    point[(axis + 1) % 3] = seen.x;
    point[(axis + 2) % 3] = seen.y;
    point[axis] = along * seen.z;
    point
}
