//! The fast method: which triangles of a mesh meet at which edges.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::scene::Mesh;

/// An edge, and the two triangles on its sides where there are two that agree on which way is out.
pub struct Edge {
    pub ends: [usize; 2],
    pub faces: Option<[usize; 2]>,
}

/// Which triangles of a mesh meet at which edges.
pub struct Topology {
    pub edges: Vec<Edge>,
    /// Every edge has two triangles: what the front of such a mesh covers, its back covers, too.
    pub is_closed: bool,
}

impl Topology {
    /// Vertices in the same place, as GL has it, are one, whatever their normals.
    pub fn new(mesh: &Mesh) -> Self {
        let mut places = HashMap::new();
        // Also -0 and 0 are the same place.
        let bits = |p: &DVec3| (p.as_vec3() + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut place = |i: usize| *places.entry(bits(&mesh.positions[i])).or_insert(i);
        let places: Vec<usize> = (0..mesh.positions.len()).map(&mut place).collect();
        let mut faces: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
        for (number, face) in mesh.faces.iter().enumerate() {
            let [a, b, c] = face.map(|i| places[i as usize]);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                // At a pole an edge may have no length.
                if from != to {
                    faces.entry([from, to]).or_default().push(number);
                }
            }
        }
        let mut edges = Vec::new();
        for (ends @ [from, to], there) in &faces {
            let back = faces.get(&[*to, *from]);
            let pair = match (&there[..], back.map(Vec::as_slice)) {
                ([one], Some([other])) => Some([*one, *other]),
                _ => None,
            };
            // An edge that is passed both ways is met twice.
            if from < to || back.is_none() {
                edges.push(Edge {
                    ends: *ends,
                    faces: pair,
                });
            }
        }
        Self {
            is_closed: edges.iter().all(|edge| edge.faces.is_some()),
            edges,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes;

    #[test]
    fn closed_meshes_have_two_triangles_at_every_edge() {
        let open = |mesh: &Mesh| {
            let topology = Topology::new(mesh);
            let open = topology.edges.iter().filter(|edge| edge.faces.is_none());
            let open = open.count();
            assert_eq!(topology.is_closed, open == 0);
            [topology.edges.len(), open]
        };
        // Euler: a sphere has two more vertices and faces than edges.
        let mut sphere = shapes::sphere(8);
        let [edges, none] = open(&sphere);
        assert_eq!((edges, none), (3 * sphere.faces.len() / 2, 0));
        assert_eq!(open(&shapes::plane(3))[1], 12);
        // The controls: a hole; a face that is there twice; one that is turned round.
        let face = sphere.faces.pop().unwrap();
        assert_eq!(open(&sphere)[1], 3);
        sphere.faces.extend([face, face]);
        assert_eq!(open(&sphere)[1], 3);
        sphere.faces.pop();
        let [a, b, c] = sphere.faces.pop().unwrap();
        sphere.faces.push([a, c, b]);
        assert!(open(&sphere)[1] >= 3);
    }
}
