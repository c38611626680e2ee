//! "Second pass: using the shadow map".
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3};
use glow::HasContext;

use super::Cs541;
use super::draw_order::{Drawn, set_culling};
use super::programs::visibility_program;
use super::shadow_test::ShadowTest;
use crate::Result;
use crate::gl::{self, Program};
use crate::scene::{Beam, Camera, Light, LightKind, Material, Object, camera, rotate};

/// The radius of the sphere that shows where the light is, as a share of the light's near distance: in no scale does it
/// reach what is lit.
const MARKER_RADIUS: f64 = 0.06;

/// What is drawn without light and shadow: the dome around the eye, and the marker that shows where the light is.
pub struct Sky {
    pub dome: gl::Mesh,
    pub texture: Option<glow::Texture>,
    pub marker_texture: glow::Texture,
}

/// `beam` in the shaders.
const NO_BEAM: i32 = 0;
const RECTANGULAR: i32 = 1;
pub const CIRCULAR: i32 = 2;

impl Cs541 {
    pub(super) fn light(&self) -> &Light {
        &self.scene.lights[0]
    }

    /// The user's camera, or the light's while `x` is on.
    pub(super) fn camera(&self) -> Camera {
        if self.look_from_light {
            let Camera { near, far, .. } = self.scene.camera;
            Camera {
                near,
                far,
                ..self.light_camera()
            }
        } else {
            self.scene.camera
        }
    }

    pub(super) fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    pub(super) fn beam(&self) -> i32 {
        match self.light_kind() {
            LightKind::Spot {
                beam: Beam::Circular,
                ..
            } => CIRCULAR,
            LightKind::Spot { .. } => RECTANGULAR,
            _ => NO_BEAM,
        }
    }

    pub(super) fn epsilon(&self) -> f64 {
        match self.settings.choice("remedy") {
            "epsilon" | "both" => self.settings.number("epsilon"),
            _ => 0.0,
        }
    }

    pub(super) fn draw_scene(&self, gl: &glow::Context) {
        let shadows = self.settings.switch("shadows");
        let unshadowed = self.unshadowed.as_ref().filter(|_| !shadows);
        let (heading, program) = match (self.shadow_test(), unshadowed) {
            (_, Some(unshadowed)) => ("second pass: local illumination alone", unshadowed),
            (ShadowTest::Handout, None) => {
                ("second pass: using the shadow map", &self.programs.lighting)
            }
            (ShadowTest::Offset(offset), None) => {
                ("second pass: using the fitted shadow map", &offset.lighting)
            }
            (ShadowTest::Exact(exact), None) => {
                ("second pass: using the light buffer", &exact.lighting)
            }
        };
        let _pass = gl::pass(gl, heading);
        let [red, green, blue] = self.scene.clear.as_vec3().to_array();
        self.select_window(gl, [red, green, blue, 1.0]);
        let mut bound = self.draw_sky(gl);

        let eye = self.camera().eye;
        let Light {
            position, color, ..
        } = *self.light();
        unsafe { gl.use_program(Some(program.handle)) };
        match unshadowed {
            Some(_) => self.use_light_camera(gl, program),
            None => self.use_shadow_test(gl, program),
        }
        program.set(gl, "usampler", 0);
        program.set(gl, "eye_position", DVec3::ZERO);
        program.set(gl, "light_position", position - eye);
        program.set(gl, "light_color", color);
        program.set(gl, "ambient_color", self.scene.ambient);
        if unshadowed.is_none() {
            // The map or the light buffer was bound last.
            unsafe { gl.active_texture(glow::TEXTURE0) };
        }
        let mut culling = false;
        for drawn in self.draw_order() {
            let Drawn { index, model, .. } = drawn;
            let Material {
                diffuse,
                specular,
                shininess,
                ..
            } = self.scene.objects[index].material;
            let texture = self.textures[index];
            if bound.replace(texture) != Some(texture) {
                unsafe { gl.bind_texture(glow::TEXTURE_2D, Some(texture)) };
            }
            program.set(gl, "model_matrix", model);
            if unshadowed.is_none() {
                self.set_shadow_test(gl, program, index);
            }
            program.set(
                gl,
                "normal_matrix",
                DMat3::from_mat4(model).inverse().transpose(),
            );
            program.set(gl, "diffuse_color", diffuse);
            program.set(gl, "specular_color", specular);
            program.set(gl, "shininess", shininess);
            set_culling(gl, &mut culling, drawn.hides_back_faces);
            self.meshes[index].draw(gl);
        }
        set_culling(gl, &mut culling, false);
    }

    pub(super) fn draw_visibility(&mut self, gl: &glow::Context) -> Result<()> {
        if self.visibility.is_none() && matches!(self.shadow_test(), ShadowTest::Handout) {
            self.visibility = Some(visibility_program(gl, &self.shaders)?);
        }
        let program = match self.shadow_test() {
            ShadowTest::Handout => self.visibility.as_ref().expect("made above"),
            ShadowTest::Offset(offset) => &offset.visibility,
            ShadowTest::Exact(exact) => &exact.visibility,
        };
        let _pass = gl::pass(gl, "second pass: the shadow test alone");
        self.select_window(gl, [1.0; 4]);
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_test(gl, program);
        let mut culling = false;
        for drawn in self.draw_order() {
            program.set(gl, "model_matrix", drawn.model);
            self.set_shadow_test(gl, program, drawn.index);
            set_culling(gl, &mut culling, drawn.hides_back_faces);
            self.meshes[drawn.index].draw(gl);
        }
        set_culling(gl, &mut culling, false);
        Ok(())
    }

    /// The viewport reset to the window's size; framebuffer 0 is bound ever since the last first pass.
    pub(super) fn select_window(&self, gl: &glow::Context, [red, green, blue, alpha]: [f32; 4]) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            gl.viewport(0, 0, width, height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    /// What every program with the shadow test needs: both cameras, the map on texture unit 1, the test's settings.
    pub(super) fn use_shadow_map(&self, gl: &glow::Context, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE1);
            gl.bind_texture(
                glow::TEXTURE_2D,
                Some(self.shadow_buffer.depth_texture_buffer),
            );
        }
        program.set(gl, "shadow_sampler", 1);
        program.set(gl, "epsilon", self.epsilon());
        program.set(gl, "shadows", i32::from(self.settings.switch("shadows")));
        self.use_light_camera(gl, program);
    }

    /// Both cameras, and the beam.
    fn use_light_camera(&self, gl: &glow::Context, program: &Program) {
        program.set(gl, "beam", self.beam());
        self.set_camera(gl, program);

        let light = self.light_camera();
        let view = camera::view(light.eye - self.camera().eye, light.look, light.rup);
        program.set(gl, "shadow_persp_matrix", light.perspective(1.0));
        program.set(gl, "shadow_view_matrix", view);
    }

    pub(super) fn set_camera(&self, gl: &glow::Context, program: &Program) {
        let camera = self.camera();
        program.set(gl, "persp_matrix", camera.perspective(self.aspect()));
        program.set(
            gl,
            "view_matrix",
            camera::view(DVec3::ZERO, camera.look, camera.rup),
        );
    }

    /// Object space to a world whose origin is at `eye`.
    pub(super) fn model_from(&self, eye: DVec3, object: &Object) -> DMat4 {
        DMat4::from_translation(-eye) * object.model(self.time)
    }

    /// The sky dome, around the eye and behind everything, and the marker that shows where the light is. Returns the
    /// texture that is bound now.
    fn draw_sky(&self, gl: &glow::Context) -> Option<glow::Texture> {
        let program = &self.programs.unlit;
        let Sky {
            dome,
            texture,
            marker_texture,
        } = &self.sky;
        let mut bound = *texture;
        let camera = self.camera();
        let dome_planes = Camera {
            near: 0.01,
            far: None,
            ..camera
        };
        unsafe {
            gl.use_program(Some(program.handle));
            gl.active_texture(glow::TEXTURE0);
        }
        program.set(gl, "usampler", 0);
        program.set(
            gl,
            "view_matrix",
            camera::view(DVec3::ZERO, camera.look, camera.rup),
        );
        if let Some(texture) = texture {
            unsafe {
                gl.bind_texture(glow::TEXTURE_2D, Some(*texture));
                gl.depth_mask(false);
            }
            program.set(gl, "persp_matrix", dome_planes.perspective(self.aspect()));
            // The sphere's poles are on z; the sky's are up and down.
            program.set(gl, "model_matrix", rotate(-90.0, DVec3::X));
            program.set(gl, "diffuse_color", DVec3::ONE);
            dome.draw(gl);
            unsafe { gl.depth_mask(true) };
        }
        let light = &self.light();
        let offset = light.position - camera.eye;
        let radius = MARKER_RADIUS * light.near;
        // From within, the marker would hide everything.
        if offset.length() > 2.0 * radius {
            bound = Some(*marker_texture);
            unsafe { gl.bind_texture(glow::TEXTURE_2D, bound) };
            let model = DMat4::from_translation(offset) * DMat4::from_scale(DVec3::splat(radius));
            program.set(gl, "persp_matrix", camera.perspective(self.aspect()));
            program.set(gl, "model_matrix", model);
            program.set(gl, "diffuse_color", light.color);
            if texture.is_some() {
                dome.draw_again(gl);
            } else {
                dome.draw(gl);
            }
        }
        bound
    }
}
