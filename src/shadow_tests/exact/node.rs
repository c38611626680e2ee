//! What the shader goes from, plane to plane: each plane with the place where to go on if the ray is on its positive side.

use glam::DVec3;

use super::caster::Caster;

/// A plane, as the bits of three floats, and where to go on.
pub type Node = [u32; 4];

/// Behind all nodes: the ray has met a caster. `DARK` of `exact.frag`.
pub const DARK: u32 = 0x3fff_ffff;
/// In an entry of a list, beside where to go on: the caster faces the light. `FACES_LIGHT` of `exact.frag`.
pub const FACES_LIGHT: u32 = 0x8000_0000;

/// In an entry of a list, beside where to go on: its plane leads through the light, as those of edges do. `SLAB` of
/// `exact.frag`.
pub const SLAB: u32 = 0x4000_0000;

/// How many nodes a shape's edges take.
pub const EDGES: usize = 3;

/// Where the edges are of the shape in this place.
fn edges_of(shape: u32) -> u32 {
    EDGES as u32 * shape
}

/// A caster in a list: a ray that gets behind its plane goes on to its edges.
pub fn of_plane(caster: &Caster, shape: u32) -> Node {
    let turned = if caster.faces_light { FACES_LIGHT } else { 0 };
    node(caster.shifted, edges_of(shape) | turned)
}

/// A ray that passes one edge goes on to the next.
pub fn of_edges([ab, bc, ca]: [DVec3; EDGES], shape: u32) -> [Node; EDGES] {
    let first = edges_of(shape);
    [node(ab, first + 1), node(bc, first + 2), node(ca, DARK)]
}

/// A ray on the positive side of a slab's plane passes by, and goes on there.
pub fn of_slab(plane: DVec3, next: u32) -> Node {
    node(plane, next | SLAB)
}

fn node(plane: DVec3, next: u32) -> Node {
    let [x, y, z] = plane.as_vec3().to_array().map(f32::to_bits);
    [x, y, z, next]
}
