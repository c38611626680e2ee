//! What of a mesh decides whether it can cast onto something.

use glam::{DMat4, DVec3};

use crate::scene::Mesh;
use crate::shadow_tests::exact::Rays;

/// How far a point may lie before a plane and still count as on it, as a share of the largest distance: some thousand
/// times what f64 rounds. What stands on a floor is not behind it.
const ON_PLANE: f64 = 1e-12;
/// A mesh of more faces is not asked whether it is convex, which takes each face with each vertex: what lies under a
/// whole scene, and is worth leaving out, is a sheet or a box.
const MOST_FACES: usize = 256;

/// What is known of a mesh wherever it is placed.
pub struct Shape {
    /// The corners of the box around it.
    pub bounds: [DVec3; 2],
    /// Whether no face has anything of the mesh before it: it casts no shadow onto faces of its own that face the light.
    pub convex: bool,
}

impl Shape {
    pub fn new(mesh: &Mesh) -> Self {
        let positions = mesh.positions.iter().copied();
        let least = positions.clone().fold(DVec3::INFINITY, DVec3::min);
        let most = positions.fold(DVec3::NEG_INFINITY, DVec3::max);
        Self {
            bounds: [least, most],
            convex: is_flat(mesh, most - least) || is_convex(mesh, most - least),
        }
    }

    /// The corners of the box around the mesh, placed by a matrix; none of a mesh without vertices.
    pub fn corners(&self, placement: DMat4) -> Vec<DVec3> {
        let [least, most] = self.bounds;
        if !least.is_finite() {
            return Vec::new();
        }
        let corner = |i: u32| {
            let pick = |axis: u32| [least, most][(i >> axis & 1) as usize][axis as usize];
            placement.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
        };
        (0..8).map(corner).collect()
    }

    /// Whether all points are on the light's side of one side of the box around the mesh: nothing of the mesh stands
    /// between them and the light. All in the light's space.
    pub fn is_behind(&self, rays: Rays, from_object: DMat4, points: &[DVec3]) -> bool {
        let corners = self.corners(from_object);
        let (Some(first), Some(last)) = (corners.first(), corners.last()) else {
            return true;
        };
        let [a, b, c] = [1, 2, 4].map(|i| corners[i] - *first);
        let volume = a.cross(b).dot(c);
        // Each of three pairs of parallel sides; of a box without volume the two sides of a pair are one.
        let outward = [b.cross(c), c.cross(a), a.cross(b)].map(|normal| match volume < 0.0 {
            true => -normal,
            false => normal,
        });
        let sides = outward
            .iter()
            .flat_map(|normal| [(*normal, *last), (-*normal, *first)]);
        let mut facing = sides.filter(|(normal, corner)| match rays {
            Rays::Spot | Rays::Point => normal.dot(*corner) < 0.0,
            Rays::Parallel => normal.z > 0.0,
        });
        facing.any(|(normal, corner)| {
            let least = -ON_PLANE * normal.length();
            let mut points = points.iter();
            points.all(|point| normal.dot(*point - corner) >= least)
        })
    }
}

/// A normal of each face that has an area, and a point of the face.
fn planes(mesh: &Mesh) -> impl Iterator<Item = (DVec3, DVec3)> {
    let planes = mesh.faces.iter().map(|face| {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        ((b - a).cross(c - a), a)
    });
    planes.filter(|(normal, _)| *normal != DVec3::ZERO)
}

fn is_flat(mesh: &Mesh, size: DVec3) -> bool {
    let Some((normal, point)) = planes(mesh).next() else {
        return true;
    };
    let most = ON_PLANE * normal.length() * size.length();
    let mut positions = mesh.positions.iter();
    positions.all(|position| normal.dot(*position - point).abs() <= most)
}

fn is_convex(mesh: &Mesh, size: DVec3) -> bool {
    mesh.faces.len() <= MOST_FACES
        && planes(mesh).all(|(normal, point)| {
            let most = ON_PLANE * normal.length() * size.length();
            let mut positions = mesh.positions.iter();
            positions.all(|position| normal.dot(*position - point) <= most)
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{rotate, shapes};

    #[test]
    fn sheets_and_boxes_are_convex() {
        assert!(Shape::new(&shapes::plane(20)).convex);
        assert!(Shape::new(&shapes::cube()).convex);
        assert!(!Shape::new(&shapes::torus(0.3, 8)).convex);
        // Two sheets that are not in one plane, and a box that is turned inside out.
        let mut roof = shapes::plane(2);
        roof.positions[4].z += 0.1;
        assert!(!Shape::new(&roof).convex);
        let mut inverted = shapes::cube();
        for face in &mut inverted.faces {
            face.swap(0, 1);
        }
        assert!(!Shape::new(&inverted).convex);
    }

    #[test]
    fn a_floor_is_behind_what_stands_on_it() {
        let lying = rotate(-90.0, DVec3::X);
        let below = |depth: f64| DMat4::from_translation(DVec3::new(0.0, -2.0, -depth)) * lying;
        // Seen from the origin and along −z, a sheet 2 below; and points above and below it.
        for mesh in [shapes::plane(3), shapes::cube()] {
            let shape = Shape::new(&mesh);
            let top = shape.corners(below(5.0));
            let top = top.iter().map(|c| c.y).fold(f64::NEG_INFINITY, f64::max);
            let above = [DVec3::new(3.0, top, -9.0), DVec3::new(0.0, 1.0, 2.0)];
            assert!(shape.is_behind(Rays::Spot, below(5.0), &above));
            let beneath = [above[0], DVec3::new(0.0, top - 1e-3, -5.0)];
            assert!(!shape.is_behind(Rays::Spot, below(5.0), &beneath));
        }
        let facing = Shape::new(&shapes::plane(3));
        let here = DMat4::IDENTITY;
        assert!(facing.is_behind(Rays::Parallel, here, &[DVec3::Z, DVec3::ZERO]));
        assert!(!facing.is_behind(Rays::Parallel, here, &[DVec3::NEG_Z]));
    }
}
