//! An indexed triangle mesh in object space.

use glam::{DVec2, DVec3};

/// `Mesh3D` of the course: vertices with normals and texture coordinates, three indices a face.
///
/// Faces are counter-clockwise seen from the side that their normals point to.
/// The three vertex arrays have the same length.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    /// (0, 0) is the picture's bottom left corner, as in OpenGL.
    pub texture_coords: Vec<DVec2>,
    pub faces: Vec<[u32; 3]>,
}
