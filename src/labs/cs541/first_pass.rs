//! "First pass: drawing the shadow map".
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3};
use glow::HasContext;

use super::Cs541;
use crate::gl;
use crate::scene::{Beam, Camera, Fov, LightKind, camera, rotate};

/// How far behind a Plane its second copy stands, as a share of half the Plane's shorter side: the same in every scale.
const SECOND_PLANE_OFFSET: f64 = 0.05;

/// Everything that decides what the shadow map holds.
#[derive(PartialEq)]
pub struct MapInputs {
    pub view_matrix: DMat4,
    pub persp_matrix: DMat4,
    pub model_matrices: Vec<DMat4>,
    pub front_face_culling: bool,
}

impl Cs541 {
    /// The kind of light that the settings ask for.
    pub(super) fn light_kind(&self) -> LightKind {
        match self.settings.choice("light") {
            "point" => LightKind::Point {
                shadow_fov: self.settings.number("shadow_fov"),
            },
            _ => LightKind::Spot {
                cone: self.settings.number("spot_angle"),
                beam: match self.settings.choice("beam") {
                    "circular" => Beam::Circular,
                    _ => Beam::Rectangular,
                },
            },
        }
    }

    /// The camera with its center of projection at the light.
    pub(super) fn light_camera(&self) -> Camera {
        let light = self.light();
        let fov = match self.light_kind() {
            LightKind::Spot { cone, .. } => cone,
            LightKind::Point { shadow_fov } => shadow_fov,
            LightKind::Directional { .. } => unreachable!("no setting asks for one"),
        };
        Camera {
            eye: light.position,
            look: light.direction,
            rup: camera::up_for(light.direction),
            fov: Fov::Horizontal(fov),
            near: light.near,
            far: Some(light.far),
        }
    }

    /// Each mesh that casts a shadow, with its model matrix in world space.
    pub(super) fn casters(&self) -> Vec<(usize, DMat4)> {
        let mut casters = Vec::new();
        for (index, object) in self.scene.objects.iter().enumerate() {
            if !object.casts {
                continue;
            }
            let model = object.model(self.time);
            casters.push((index, model));
            if object.plane && self.settings.switch("second_plane") {
                casters.push((index, second_plane(model)));
            }
        }
        casters
    }

    pub(super) fn map_inputs(&self) -> MapInputs {
        let light = self.light_camera();
        // DEVIATES: origin, the products of the matrices stay in GLSL and in f32 as the handout has them, but the
        // world's origin is moved (in f64) to the light here and to the eye in the second pass: far from the origin
        // the numbers would otherwise cancel and the shadows dissolve.
        let to_light = DMat4::from_translation(-light.eye);
        MapInputs {
            view_matrix: camera::view(DVec3::ZERO, light.look, light.rup),
            persp_matrix: light.perspective(1.0),
            model_matrices: self
                .casters()
                .iter()
                .map(|(_, model)| to_light * *model)
                .collect(),
            front_face_culling: matches!(self.settings.choice("remedy"), "culling" | "both"),
        }
    }

    pub(super) fn draw_shadow_map(&self, gl: &glow::Context, inputs: &MapInputs) {
        let _pass = gl::pass(gl, "first pass: drawing the shadow map");
        let (program, buffer) = (&self.programs.shadow, &self.shadow_buffer);
        let size = buffer.kind.size as i32;
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(buffer.frame_buffer));
            gl.viewport(0, 0, size, size);
            gl.use_program(Some(program.handle));
            gl.clear(glow::DEPTH_BUFFER_BIT);
            if inputs.front_face_culling {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::FRONT);
            }

            program.set(gl, "persp_matrix", inputs.persp_matrix);
            program.set(gl, "view_matrix", inputs.view_matrix);
            let mut last = None;
            for ((index, _), model_matrix) in self.casters().iter().zip(&inputs.model_matrices) {
                program.set(gl, "model_matrix", *model_matrix);
                let mesh = &self.meshes[*index];
                // A second plane is the same mesh as the first.
                if last.replace(*index) == Some(*index) {
                    mesh.draw_again(gl);
                } else {
                    mesh.draw(gl);
                }
            }

            if inputs.front_face_culling {
                // GL's default, which the second pass counts on.
                gl.cull_face(glow::BACK);
                gl.disable(glow::CULL_FACE);
            }
            // Done with the shadow map: select the default frame buffer, that is, the window.
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        }
    }
}

/// The second copy of a Plane: a small amount behind the first one, facing the other way.
fn second_plane(model: DMat4) -> DMat4 {
    let normal = DMat3::from_mat4(model).inverse().transpose() * DVec3::Z;
    let half_side = model.x_axis.length().min(model.y_axis.length());
    DMat4::from_translation(-SECOND_PLANE_OFFSET * half_side * normal.normalize())
        * model
        * rotate(180.0, DVec3::X)
}
