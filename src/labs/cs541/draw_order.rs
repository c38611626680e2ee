//! In which order the second pass draws, and which faces. It saves time and shows in no picture; no part of the handout.
//!
//! Near objects come first, so that those behind them are not shaded where they are hidden. Of a solid that the eye is
//! outside of, only the faces that face the eye are drawn: the others are behind them.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3, dvec3};
use glow::HasContext;

use super::Cs541;
use crate::scene::{Camera, Mesh};
use crate::shadow_tests::Topology;

/// What the order asks of a mesh, wherever it is placed.
pub struct Outline {
    /// Of the box around it.
    corners: [DVec3; 8],
    is_solid: bool,
}

/// An object as the second pass draws it.
pub struct Drawn {
    pub index: usize,
    /// Object space to a world whose origin is at the eye.
    pub model: DMat4,
    /// Whether its back faces are hidden, wherever the eye looks.
    pub hides_back_faces: bool,
}

impl Outline {
    /// Needs no context, so it can go on beside something that does.
    pub fn new(mesh: &Mesh) -> Self {
        let topology = Topology::new(mesh);
        let [least, most] = topology.bounds;
        let corner = |i: usize| {
            let side = |axis: usize, a: f64, b: f64| if i >> axis & 1 == 0 { a } else { b };
            dvec3(
                side(0, least.x, most.x),
                side(1, least.y, most.y),
                side(2, least.z, most.z),
            )
        };
        Self {
            corners: std::array::from_fn(corner),
            is_solid: topology.is_solid(),
        }
    }
}

impl Cs541 {
    /// Every object, the nearest first. What a large one encloses is nearer than its farthest corner: that decides.
    pub(super) fn draw_order(&self) -> Vec<Drawn> {
        let camera = self.camera();
        let nearest_seen = self.near_corner(&camera);
        let objects = self.scene.objects.iter().zip(&self.outlines).enumerate();
        let mut order: Vec<_> = objects
            .map(|(index, (object, outline))| {
                let model = self.model_from(camera.eye, object);
                let corners = outline.corners.map(|corner| model.transform_point3(corner));
                let depths = corners.map(|corner| corner.dot(camera.look));
                let middle = (corners[0] + corners[7]) / 2.0;
                let radius =
                    (corners.map(|corner| corner.distance(middle)).into_iter()).fold(0.0, f64::max);
                let drawn = Drawn {
                    index,
                    model,
                    // A mirrored object shows its faces from the other side.
                    hides_back_faces: outline.is_solid
                        && model.determinant() > 0.0
                        && middle.length() > radius + nearest_seen,
                };
                (depths.into_iter().fold(f64::NEG_INFINITY, f64::max), drawn)
            })
            .collect();
        order.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        order.into_iter().map(|(_, drawn)| drawn).collect()
    }

    /// How far the corners of the near plane are from the eye: what is farther off is not cut open by it.
    fn near_corner(&self, camera: &Camera) -> f64 {
        let persp_matrix = camera.perspective(self.aspect());
        let slopes = dvec3(
            1.0 / persp_matrix.x_axis.x,
            1.0 / persp_matrix.y_axis.y,
            1.0,
        );
        camera.near * slopes.length()
    }
}

/// Draws back faces or leaves them out from here on; `culling` is how it was until here.
pub fn set_culling(gl: &glow::Context, culling: &mut bool, wanted: bool) {
    if std::mem::replace(culling, wanted) == wanted {
        return;
    }
    unsafe {
        if wanted {
            gl.enable(glow::CULL_FACE);
        } else {
            gl.disable(glow::CULL_FACE);
        }
    }
}
