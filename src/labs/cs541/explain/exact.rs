//! The same in f64, from the unrounded scene: the point where the pixel's ray meets the triangle that the GPU drew there,
//! its place in the light's clip space, and the depth that an exact rasteriser would store in each texel.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::super::Cs541;
use super::fragment::Fragment;
use crate::labs::exact::{ClipTriangle, ExactMap};
use crate::scene::camera;

/// A point's way through equation (1) and the division.
#[derive(Clone, Copy)]
pub struct ShadowPosition {
    pub position: DVec4,
    pub uv: DVec2,
    pub depth: f64,
}

impl ShadowPosition {
    pub fn new(matrix: DMat4, point: DVec3) -> Self {
        let position = matrix * point.extend(1.0);
        let divided = position / position.w;
        Self {
            position,
            uv: divided.truncate().truncate(),
            depth: divided.z,
        }
    }

    pub fn values(&self) -> [f64; 7] {
        let DVec4 { x, y, z, w } = self.position;
        [x, y, z, w, self.uv.x, self.uv.y, self.depth]
    }
}

impl Cs541 {
    pub(in super::super) fn exact_map(&self) -> ExactMap {
        let inputs = self.map_inputs();
        let light = inputs.persp_matrix * inputs.view_matrix;
        let mut triangles = Vec::new();
        for ((index, _), model) in self.casters().iter().zip(&inputs.model_matrices) {
            let mesh = &self.scene.objects[*index].mesh;
            let matrix = light * *model;
            let clip: Vec<DVec4> = mesh
                .positions
                .iter()
                .map(|p| matrix * p.extend(1.0))
                .collect();
            let of_face = |face: &[u32; 3]| ClipTriangle::new(face.map(|i| clip[i as usize]));
            let kept = |t: &ClipTriangle| !(inputs.front_face_culling && t.front);
            triangles.extend(mesh.faces.iter().filter_map(of_face).filter(kept));
        }
        let kind = &self.shadow_buffer.kind;
        ExactMap::new(triangles, kind.size, kind.filter == "linear")
    }

    /// Where the ray through a place of the picture, in pixels from the bottom left, meets the plane of a triangle;
    /// relative to the eye.
    pub(in super::super) fn seen_point(&self, fragment: &Fragment, place: DVec2) -> DVec3 {
        let camera = self.camera();
        let object = &self.scene.objects[fragment.object];
        let model = self.model_from(camera.eye, object);
        let corners = object.mesh.faces[fragment.triangle]
            .map(|i| model.transform_point3(object.mesh.positions[i as usize]));
        let clip =
            camera.perspective(self.aspect()) * camera::view(DVec3::ZERO, camera.look, camera.rup);
        let Some(seen) = ClipTriangle::new(corners.map(|corner| clip * corner.extend(1.0))) else {
            return corners[0];
        };
        DMat3::from_cols(corners[0], corners[1], corners[2]) * seen.shares(self.size, place)
    }
}
