//! The second pass: the scene as usual, with the spotlight shader that tests the shadow map.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3};
use glow::HasContext;

use super::Aueb7;
use super::shadow_test::ShadowTest;
use crate::gl::{self, Program};
use crate::scene::{Light, Object, camera};

/// The radius of the white sphere that shows where the light is, in world units, as in the course.
const MARKER_RADIUS: f64 = 0.2;
/// The texture units, as in the course: 0 is an object's own, and behind the course's other maps comes the shadow map.
pub const DIFFUSE: i32 = 0;
pub const SHADOW_MAP: i32 = 4;

impl Aueb7 {
    pub(super) fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    pub(super) fn projection(&self) -> DMat4 {
        self.camera().perspective(self.aspect())
    }

    /// World space to eye space; the world's origin is the eye.
    pub(super) fn view(&self) -> DMat4 {
        let camera = self.camera();
        camera::view(DVec3::ZERO, camera.look, camera.rup)
    }

    /// To world space, with its origin moved to the eye.
    pub(super) fn model_from_eye(&self, model: DMat4) -> DMat4 {
        DMat4::from_translation(-self.camera().eye) * model
    }

    /// World space to the shadow map's clip space; the world's origin is the eye.
    pub(super) fn light_view_projection(&self) -> DMat4 {
        self.light_projection() * self.light_view(self.camera().eye)
    }

    pub(super) fn draw_scene(&self, gl: &glow::Context) {
        let (heading, program) = match self.shadow_test() {
            ShadowTest::Exercises => ("second pass: Render", &self.programs.spot_light),
            ShadowTest::Offset(offset) => (
                "second pass: Render, with the fitted map",
                &offset.spot_light,
            ),
            ShadowTest::Exact(exact) => (
                "second pass: Render, with the light buffer",
                &exact.spot_light,
            ),
        };
        let _pass = gl::pass(gl, heading);
        let [red, green, blue] = self.scene().clear.as_vec3().to_array();
        self.clear_window(gl, [red, green, blue, 1.0]);
        self.draw_spot_light_source(gl);

        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_test(gl, program);
        let (light, view) = (self.light(), self.view());
        let Light {
            position,
            direction,
            color,
            ..
        } = light;
        program.set(gl, "uniform_light_color", color);
        program.set(
            gl,
            "uniform_light_position_ecs",
            view.transform_vector3(position - self.camera().eye),
        );
        program.set(
            gl,
            "uniform_light_direction_ecs",
            view.transform_vector3(direction.normalize()),
        );
        program.set(gl, "uniform_ambient_color", self.scene().ambient);
        // root->draw(0): with the spotlight shader.
        let mut bound = None;
        self.draw(gl, |index, object, model| {
            self.bind_texture(gl, index, &mut bound);
            self.set_model(gl, program, model);
            self.set_shadow_test(gl, program, model);
            let to_eye = DMat3::from_mat4(view * self.model_from_eye(model));
            let normal_matrix = to_eye.inverse().transpose();
            program.set(gl, "uniform_normal_matrix_ecs", normal_matrix);
            program.set(gl, "uniform_diffuse_color", object.material.diffuse);
            true
        });
    }

    /// The shadow_factor alone.
    pub(super) fn draw_visibility(&self, gl: &glow::Context) {
        let program = match self.shadow_test() {
            ShadowTest::Exercises => self.visibility.as_ref().expect("a frame makes it first"),
            ShadowTest::Offset(offset) => &offset.visibility,
            ShadowTest::Exact(exact) => &exact.visibility,
        };
        let _pass = gl::pass(gl, "second pass: the shadow_factor alone");
        self.clear_window(gl, [1.0; 4]);
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_test(gl, program);
        let mut bound = None;
        self.draw(gl, |index, _, model| {
            self.bind_texture(gl, index, &mut bound);
            self.set_model(gl, program, model);
            self.set_shadow_test(gl, program, model);
            true
        });
    }

    pub(super) fn clear_window(&self, gl: &glow::Context, [red, green, blue, alpha]: [f32; 4]) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            gl.viewport(0, 0, width, height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    // DEVIATES: DrawSportLightSource, a slip of the handout for DrawSpotLightSource.
    #[doc(alias = "DrawSportLightSource")]
    fn draw_spot_light_source(&self, gl: &glow::Context) {
        let program = &self.programs.light_source;
        let place = DMat4::from_translation(self.light().position);
        let model = self.model_from_eye(place) * DMat4::from_scale(DVec3::splat(MARKER_RADIUS));
        unsafe { gl.use_program(Some(program.handle)) };
        program.set(gl, "uniform_mvp", self.projection() * self.view() * model);
        self.marker.draw(gl);
    }

    /// What every program with the shadow test needs: both cameras, the map on its texture unit, the test's settings.
    pub(super) fn use_shadow_map(&self, gl: &glow::Context, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE0 + SHADOW_MAP as u32);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.shadow_fbo.fbo_shadow_texture));
            gl.active_texture(glow::TEXTURE0 + DIFFUSE as u32);
        }
        program.set(gl, "uniform_sampler_shadow_map", SHADOW_MAP);
        program.set(gl, "uniform_sampler_diffuse", DIFFUSE);
        program.set(gl, "uniform_v", self.view());
        program.set(gl, "uniform_p", self.projection());
        program.set(gl, "uniform_view_inverse", self.view().inverse());
        program.set(
            gl,
            "uniform_light_view_projection",
            self.light_view_projection(),
        );
        let filter = match self.settings.choice("filter") {
            "pcf_5" => 1,
            "pcf_9" => 2,
            _ => 0,
        };
        program.set(gl, "uniform_filter", filter);
        program.set(gl, "constant_depth_bias", self.bias());
        program.set(gl, "uniform_sample_step", self.settings.number("step"));
        program.set(gl, "uniform_outside", self.outside());
    }

    pub(super) fn bias(&self) -> f64 {
        self.settings.number("constant_depth_bias")
    }

    /// What the shadow test returns outside of the map.
    pub(super) fn outside(&self) -> f64 {
        match self.settings.choice("outside") {
            "lit" => 1.0,
            _ => 0.0,
        }
    }

    /// Whether there are shadows, and the map that tells where.
    pub(super) fn set_shadows(&self, gl: &glow::Context, program: &Program) {
        self.use_shadow_map(gl, program);
        let shadows = self.settings.switch("shadows");
        program.set(gl, "uniform_shadows", i32::from(shadows));
    }

    pub(super) fn set_model(&self, gl: &glow::Context, program: &Program, model: DMat4) {
        program.set(gl, "uniform_m", self.model_from_eye(model));
    }

    /// The texture of an object, unless the object before it has the same.
    pub(super) fn bind_texture(
        &self,
        gl: &glow::Context,
        index: usize,
        bound: &mut Option<glow::Texture>,
    ) {
        let texture = self.models[self.place()][index].texture;
        if bound.replace(texture) != Some(texture) {
            unsafe { gl.bind_texture(glow::TEXTURE_2D, Some(texture)) };
        }
    }

    /// Draws the geometry of the scene graph. `send` sends an object's matrix and material to the program, and says
    /// whether the object is to be drawn.
    pub(super) fn draw(
        &self,
        gl: &glow::Context,
        mut send: impl FnMut(usize, &Object, DMat4) -> bool,
    ) {
        let models = &self.models[self.place()];
        for (index, (object, model)) in self.geometry().into_iter().enumerate() {
            if send(index, object, model) {
                models[index].mesh.draw(gl);
            }
        }
    }
}
