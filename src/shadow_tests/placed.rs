//! What is in the scene, as a shadow test sees it.

use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::scene::Mesh;

/// A mesh in the scene. Its triangles are numbered as they are drawn.
#[derive(Clone)]
pub struct Placed {
    pub mesh: Arc<Mesh>,
    /// Object space to world space.
    pub model: DMat4,
    pub casts: bool,
}

impl PartialEq for Placed {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh)
            && self.model == other.model
            && self.casts == other.casts
    }
}

/// The corners of a box in object space, where a matrix puts them; none of the box around a mesh without vertices.
pub fn box_corners(model: DMat4, [least, most]: [DVec3; 2]) -> Vec<DVec3> {
    if !least.is_finite() {
        return Vec::new();
    }
    let corner = |i: u32| {
        let pick = |axis: u32| [least, most][(i >> axis & 1) as usize][axis as usize];
        model.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
    };
    (0..8).map(corner).collect()
}
