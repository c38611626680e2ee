//! A mesh as a surface: which of its vertices are one point, what hangs together, what encloses a volume.

use std::collections::HashMap;

use glam::DVec3;

use crate::scene::Mesh;

/// What is known of a mesh wherever it is placed.
pub struct Topology {
    /// Each point once; vertices at the same position are one point, whatever their normals.
    pub points: Vec<DVec3>,
    /// The three points of each face.
    pub faces: Vec<[u32; 3]>,
    /// Faces that hang together by their points.
    pub components: Vec<Vec<u32>>,
    /// Of each face: whether its component's edges are each used as often in one direction as in the other, so that it
    /// encloses volumes.
    pub closed: Vec<bool>,
    /// The component of each face.
    pub component_of: Vec<u32>,
    /// The two points of each edge.
    pub edges: Vec<[u32; 2]>,
    /// Which faces use the edges: the first edge's, then the second one's, and so on.
    uses: Vec<Use>,
    /// Where each edge's uses begin; and, behind the last, where they end.
    first_uses: Vec<u32>,
    /// The corners of the box around the mesh.
    pub bounds: [DVec3; 2],
}

/// A face that has an edge.
#[derive(Clone, Copy, Default)]
pub struct Use {
    pub face: u32,
    /// 1 if the face has the edge's points in their order, −1 in the other, 0 if they are one point.
    pub direction: i32,
}

/// An edge of a face.
#[derive(Clone, Copy)]
struct FaceEdge {
    edge: u32,
    direction: i32,
}

impl Topology {
    pub fn new(mesh: &Mesh) -> Self {
        let (points, welded) = weld(&mesh.positions);
        let faces: Vec<[u32; 3]> = mesh
            .faces
            .iter()
            .map(|face| face.map(|vertex| welded[vertex as usize]))
            .collect();
        let (edges, face_edges) = edges(&faces);
        let components = components(points.len(), &faces);
        let mut component_of = vec![0; faces.len()];
        for (component, number) in components.iter().zip(0..) {
            for face in component {
                component_of[*face as usize] = number;
            }
        }
        let closed = closed(&components, edges.len(), &face_edges);
        let (uses, first_uses) = uses(edges.len(), &face_edges);
        let least = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let most = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        Self {
            points,
            faces,
            components,
            component_of,
            closed,
            edges,
            uses,
            first_uses,
            bounds: [least, most],
        }
    }

    /// Whether it is the surface of solids, its faces outwards: who looks from outside sees no face from behind. (But for
    /// a surface that cuts through itself and is turned inside out there.)
    pub fn is_solid(&self) -> bool {
        let has_volume = |component: &Vec<u32>| {
            let corners = |face: &u32| self.faces[*face as usize].map(|i| self.points[i as usize]);
            let origin = corners(&component[0])[0];
            let (mut sum, mut magnitude) = (0.0, 0.0);
            for [a, b, c] in component.iter().map(corners) {
                // Six times the volume of a tetrahedron.
                let volume = (a - origin).dot((b - origin).cross(c - origin));
                sum += volume;
                magnitude += volume.abs();
            }
            // Where it is nothing but rounding, front and back are one.
            sum > 1e-9 * magnitude
        };
        !self.faces.is_empty()
            && self.closed.iter().all(|closed| *closed)
            && self.components.iter().all(has_volume)
    }

    pub fn uses(&self, edge: usize) -> &[Use] {
        let [first, end] = [edge, edge + 1].map(|edge| self.first_uses[edge] as usize);
        &self.uses[first..end]
    }
}

/// The points, and the point of each vertex.
fn weld(positions: &[DVec3]) -> (Vec<DVec3>, Vec<u32>) {
    let mut points = Vec::new();
    let mut numbers = HashMap::new();
    let welded = positions.iter().map(|position| {
        // Adding 0 makes −0 into 0.
        let key = (*position + DVec3::ZERO).to_array().map(f64::to_bits);
        *numbers.entry(key).or_insert_with(|| {
            points.push(*position);
            points.len() as u32 - 1
        })
    });
    let welded = welded.collect();
    (points, welded)
}

fn edges(faces: &[[u32; 3]]) -> (Vec<[u32; 2]>, Vec<[FaceEdge; 3]>) {
    let mut edges = Vec::new();
    let mut numbers = HashMap::new();
    let mut number = |from: u32, to: u32| {
        let edge = [from.min(to), from.max(to)];
        let edge = *numbers.entry(edge).or_insert_with(|| {
            edges.push(edge);
            edges.len() as u32 - 1
        });
        let direction = to.cmp(&from) as i32;
        FaceEdge { edge, direction }
    };
    let face_edges = faces
        .iter()
        .map(|[a, b, c]| [number(*a, *b), number(*b, *c), number(*c, *a)])
        .collect();
    (edges, face_edges)
}

/// The faces sorted by edge, and where each edge's begin.
fn uses(edges: usize, face_edges: &[[FaceEdge; 3]]) -> (Vec<Use>, Vec<u32>) {
    let mut first_uses = vec![0; edges + 1];
    for FaceEdge { edge, .. } in face_edges.iter().flatten() {
        first_uses[*edge as usize + 1] += 1;
    }
    for edge in 0..edges {
        first_uses[edge + 1] += first_uses[edge];
    }
    let mut next = first_uses.clone();
    let mut uses = vec![Use::default(); 3 * face_edges.len()];
    for (of_face, face) in face_edges.iter().zip(0..) {
        for FaceEdge { edge, direction } in *of_face {
            let place = &mut next[edge as usize];
            uses[*place as usize] = Use { face, direction };
            *place += 1;
        }
    }
    (uses, first_uses)
}

fn components(points: usize, faces: &[[u32; 3]]) -> Vec<Vec<u32>> {
    // Union of the points of each face: a point leads to another one of its component, the last one to itself.
    let mut leads_to: Vec<u32> = (0..points as u32).collect();
    for [a, b, c] in faces {
        let a = last(&mut leads_to, *a);
        for other in [b, c] {
            let other = last(&mut leads_to, *other);
            leads_to[other as usize] = a;
        }
    }
    let mut components = Vec::new();
    let mut numbers = HashMap::new();
    for (face, number) in faces.iter().zip(0..) {
        let last = last(&mut leads_to, face[0]);
        let component = *numbers.entry(last).or_insert_with(|| {
            components.push(Vec::new());
            components.len() - 1
        });
        components[component].push(number);
    }
    components
}

/// The last point that a point leads to; the way there is made shorter.
fn last(leads_to: &mut [u32], point: u32) -> u32 {
    let mut point = point as usize;
    while leads_to[point] as usize != point {
        leads_to[point] = leads_to[leads_to[point] as usize];
        point = leads_to[point] as usize;
    }
    point as u32
}

fn closed(components: &[Vec<u32>], edges: usize, face_edges: &[[FaceEdge; 3]]) -> Vec<bool> {
    let mut uses = vec![0; edges];
    for FaceEdge { edge, direction } in face_edges.iter().flatten() {
        uses[*edge as usize] += direction;
    }
    let is_balanced = |face: &u32| {
        let mut edges = face_edges[*face as usize].iter();
        edges.all(|face_edge| uses[face_edge.edge as usize] == 0)
    };
    let mut closed = vec![false; face_edges.len()];
    for component in components.iter().filter(|c| c.iter().all(is_balanced)) {
        for face in component {
            closed[*face as usize] = true;
        }
    }
    closed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes;

    fn closed(mesh: &Mesh) -> Vec<bool> {
        let topology = Topology::new(mesh);
        let components = topology.components.iter();
        components.map(|c| topology.closed[c[0] as usize]).collect()
    }

    #[test]
    fn what_encloses_a_volume_is_closed() {
        assert_eq!(closed(&shapes::cube()), [true]);
        assert_eq!(closed(&shapes::sphere(8)), [true]);
        assert_eq!(closed(&shapes::torus(0.5, 8)), [true]);
        assert_eq!(closed(&shapes::plane(3)), [false]);
        let mut hole = shapes::sphere(8);
        hole.faces.remove(5);
        assert_eq!(closed(&hole), [false]);
        // A face the other way round: its edges are used twice in one direction.
        let mut inconsistent = shapes::sphere(8);
        inconsistent.faces[5].swap(0, 1);
        assert_eq!(closed(&inconsistent), [false]);
    }

    #[test]
    fn a_solid_is_closed_and_not_inside_out() {
        let is_solid = |mesh: &Mesh| Topology::new(mesh).is_solid();
        for mesh in [shapes::cube(), shapes::sphere(8), shapes::torus(0.5, 8)] {
            assert!(is_solid(&mesh));
            let mut inside_out = mesh.clone();
            inside_out.faces.iter_mut().for_each(|face| face.swap(0, 1));
            assert!(!is_solid(&inside_out));
            let mut both = mesh;
            both.faces.extend(inside_out.faces);
            assert!(!is_solid(&both));
        }
        for mesh in [shapes::plane(3), shapes::teapot(2), Mesh::default()] {
            assert!(!is_solid(&mesh));
        }
    }

    #[test]
    fn the_edges_of_a_cube_are_its_12_and_a_diagonal_on_each_side() {
        let topology = Topology::new(&shapes::cube());
        assert_eq!((topology.points.len(), topology.edges.len()), (8, 18));
    }

    #[test]
    fn two_solids_in_one_mesh_are_two_components() {
        let mut mesh = shapes::cube();
        let other = shapes::cube();
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(other.positions.iter().map(|p| *p + DVec3::splat(3.0)));
        mesh.faces
            .extend(other.faces.iter().map(|face| face.map(|i| first + i)));
        assert_eq!(closed(&mesh), [true, true]);
        // A face of no area takes nothing from that.
        mesh.faces.push([0, 0, 1]);
        assert_eq!(closed(&mesh), [true, true]);
    }
}
