//! What of a mesh decides whether it can cast onto something, and which of its faces do.

use glam::{DMat4, DVec3};

use crate::scene::Mesh;
use crate::shadow_tests::Rays;
use crate::shadow_tests::placed::box_corners;
use crate::shadow_tests::topology::Topology;

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
    /// Whether its faces enclose volumes, all seen from outside.
    solid: bool,
}

impl Shape {
    pub fn new(mesh: &Mesh) -> Self {
        let topology = Topology::new(mesh);
        let [least, most] = topology.bounds;
        Self {
            bounds: [least, most],
            convex: is_flat(mesh, most - least) || is_convex(mesh, most - least),
            solid: is_solid(&topology),
        }
    }

    /// The corners of the box around the mesh, where a matrix puts them.
    pub fn corners(&self, placement: DMat4) -> Vec<DVec3> {
        box_corners(placement, self.bounds)
    }

    /// Whether all points are on the light's side of one side of the box around the mesh: nothing of the mesh stands
    /// between them and the light. All in the light's space.
    pub fn is_behind(&self, rays: Rays, from_object: DMat4, points: &[DVec3]) -> bool {
        let mut facing = self.sides_to_light(rays, from_object);
        facing.any(|(normal, corner)| {
            let least = -ON_PLANE * normal.length();
            let mut points = points.iter();
            points.all(|point| normal.dot(*point - corner) >= least)
        })
    }

    /// Whether the light, which is outside of it, meets front faces of the mesh before any others.
    pub fn is_solid_to(&self, rays: Rays, from_object: DMat4) -> bool {
        // A mirrored mesh has its front faces inside.
        let mirrored = from_object.determinant() < 0.0;
        self.solid && !mirrored && self.sides_to_light(rays, from_object).next().is_some()
    }

    /// The sides of the box around the mesh that face the light: a normal, outwards, and a corner. From within the box
    /// there is none.
    fn sides_to_light(
        &self,
        rays: Rays,
        from_object: DMat4,
    ) -> impl Iterator<Item = (DVec3, DVec3)> {
        let corners = self.corners(from_object);
        let ends = corners.first().copied().zip(corners.last().copied());
        let sides = ends.map(|(first, last)| {
            let [a, b, c] = [1, 2, 4].map(|i| corners[i] - first);
            // Of a mirrored box the products point the other way; of a flat one the two sides of a pair are one.
            let sign = if a.cross(b).dot(c) < 0.0 { -1.0 } else { 1.0 };
            let outwards = [b.cross(c), c.cross(a), a.cross(b)].map(|normal| sign * normal);
            outwards.map(|normal| [(normal, last), (-normal, first)])
        });
        let faces_light = move |(normal, corner): &(DVec3, DVec3)| match rays {
            Rays::Spot | Rays::Point => normal.dot(*corner) < 0.0,
            Rays::Parallel => normal.z > 0.0,
        };
        sides.into_iter().flatten().flatten().filter(faces_light)
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

/// Whether every component of a mesh encloses a volume, which its faces look out of.
fn is_solid(topology: &Topology) -> bool {
    let volume = |component: &Vec<u32>| {
        let six_times = component.iter().map(|face| {
            let [a, b, c] = topology.faces[*face as usize]
                .map(|i| topology.points[i as usize] - topology.bounds[0]);
            a.dot(b.cross(c))
        });
        six_times.sum::<f64>()
    };
    topology.closed.iter().all(|closed| *closed)
        && topology.components.iter().all(|c| volume(c) > 0.0)
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
    fn what_the_light_sees_from_outside_is_solid() {
        let before = DMat4::from_translation(-5.0 * DVec3::Z);
        let solid = |mesh: &Mesh, place: DMat4| Shape::new(mesh).is_solid_to(Rays::Spot, place);
        assert!(solid(&shapes::cube(), before));
        assert!(solid(&shapes::torus(0.3, 8), before));
        // The light inside; a mirror; a sheet; inside out.
        assert!(!solid(&shapes::cube(), DMat4::IDENTITY));
        assert!(!solid(
            &shapes::cube(),
            before * DMat4::from_scale(-DVec3::ONE)
        ));
        assert!(!solid(&shapes::plane(2), before));
        let mut inverted = shapes::cube();
        for face in &mut inverted.faces {
            face.swap(0, 1);
        }
        assert!(!solid(&inverted, before));
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
