//! The second pass: per-pixel lighting, combined with the shadow maps.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4};
use glow::HasContext;

use super::lights::{self, CONE, LIGHTING, SHADOW_TEST};
use super::shadow_test::ShadowTest;
use super::{Cmsc23700, DIRECTIONAL, SPOT};
use crate::Result;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::scene::{Object, camera};

/// Uniforms that every program with the shadow test has.
pub const MATRICES: [&str; 2] = ["modelView", "projection"];

pub fn lighting_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting program");
    let switches = [
        "normalMatrix",
        "shadows",
        "directionalEnabled",
        "spotEnabled",
    ];
    let uniforms = [&LIGHTING[..], &switches].concat();
    let program = with_shadow_test(gl, shaders, "lighting.frag", &uniforms)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "lighting_program",
    );
    Ok(program)
}

/// The vertex shader of the second pass with a fragment shader that makes the shadow test.
pub fn with_shadow_test(
    gl: &glow::Context,
    shaders: &Shaders,
    fragment: &str,
    others: &[&'static str],
) -> Result<Program> {
    let uniforms = [&MATRICES[..], &SHADOW_TEST, &CONE, others].concat();
    Program::new(gl, shaders, "lighting.vert", fragment, &uniforms)
}

impl Cmsc23700 {
    pub(super) fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// Object space to eye space. The camera's own place is taken off first, while nothing is rounded yet.
    pub(super) fn model_view(&self, model: DMat4) -> DMat4 {
        let camera = &self.scene.camera;
        let from_eye = DMat4::from_translation(-camera.eye) * model;
        camera::view(glam::DVec3::ZERO, camera.look, camera.rup) * from_eye
    }

    /// Object space to world space, now.
    pub(super) fn model(&self, object: &Object) -> DMat4 {
        object.model(self.simulation.now())
    }

    /// What of the lights holds for as long as the program does.
    pub(super) fn set_lights(&self, gl: &glow::Context) {
        let _pass = gl::pass(gl, "set-up: the lights");
        let program = &self.programs.lighting;
        unsafe { gl.use_program(Some(program.handle)) };
        lights::set_shadow_test(gl, program, &self.scene, &self.light_cameras);
        lights::set_lighting(gl, program, &self.scene);
    }

    pub(super) fn draw_picture(&self, gl: &glow::Context) {
        let (heading, program) = match self.shadow_test() {
            ShadowTest::Handout => ("second pass", &self.programs.lighting),
            ShadowTest::Offset(offset) => ("second pass: with the fitted maps", &offset.lighting),
            ShadowTest::Exact(exact) => ("second pass: with the light buffers", &exact.lighting),
        };
        let _pass = gl::pass(gl, heading);
        let [directional, spot] = self.enabled().map(i32::from);
        let [red, green, blue] = self.scene.clear.as_vec3().to_array();
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [red, green, blue, 1.0]);
        self.use_shadow_test(gl, program);
        program.set(gl, "directionalEnabled", directional);
        program.set(gl, "spotEnabled", spot);
        program.set(gl, "projection", self.projection());
        self.draw_scene(
            gl,
            |_| true,
            |_, model| {
                self.set_shadow_test(gl, program, model);
                let model_view = self.model_view(model);
                let normal_matrix = DMat3::from_mat4(model_view).inverse().transpose();
                program.set(gl, "modelView", model_view);
                program.set(gl, "normalMatrix", normal_matrix);
            },
        );
    }

    /// The shadow test alone, for a light counted from 1.
    pub(super) fn draw_visibility(&mut self, gl: &glow::Context, light: usize) -> Result<()> {
        let is_handouts = matches!(self.shadow_test(), ShadowTest::Handout);
        if self.visibility.is_none() && is_handouts {
            let _pass = gl::pass(gl, "set-up: the visibility program");
            let own = ["shadows", "light"];
            let program = with_shadow_test(gl, &self.shaders, "visibility.frag", &own)?;
            unsafe { gl.use_program(Some(program.handle)) };
            lights::set_shadow_test(gl, &program, &self.scene, &self.light_cameras);
            self.visibility = Some(program);
        }
        let program = match self.shadow_test() {
            ShadowTest::Handout => self.visibility.as_ref().expect("made above"),
            ShadowTest::Offset(offset) => &offset.visibility,
            ShadowTest::Exact(exact) => &exact.visibility,
        };
        let _pass = gl::pass(gl, "second pass: the test alone");
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [1.0; 4]);
        self.use_shadow_test(gl, program);
        program.set(gl, "light", light as i32);
        program.set(gl, "projection", self.projection());
        self.draw_scene(
            gl,
            |_| true,
            |_, model| {
                self.set_shadow_test(gl, program, model);
                program.set(gl, "modelView", self.model_view(model));
            },
        );
        Ok(())
    }

    pub(super) fn projection(&self) -> DMat4 {
        self.scene.camera.perspective(self.aspect())
    }

    /// The window's whole size; framebuffer 0 is bound ever since the last first pass.
    pub(super) fn select_window(&self, gl: &glow::Context, [red, green, blue, alpha]: [f32; 4]) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            gl.viewport(0, 0, width, height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    /// Whether there are shadows, and the maps that tell where.
    pub(super) fn set_shadows(&self, gl: &glow::Context, program: &Program) {
        let shadows = self.settings.switch("shadows");
        if shadows {
            self.use_shadow_maps(gl, program);
        }
        program.set(gl, "shadows", i32::from(shadows));
    }

    /// The map of each enabled light on its own texture unit, and the light's bias.
    pub(super) fn use_shadow_maps(&self, gl: &glow::Context, program: &Program) {
        let lights = [
            (DIRECTIONAL, glow::TEXTURE0, "directionalBias"),
            (SPOT, glow::TEXTURE1, "spotBias"),
        ];
        let enabled = self.enabled();
        for (light, unit, bias) in lights.into_iter().filter(|(light, ..)| enabled[*light]) {
            unsafe {
                gl.active_texture(unit);
                gl.bind_texture(
                    glow::TEXTURE_2D,
                    Some(self.shadow_maps[light].depth_texture),
                );
            }
            program.set(gl, bias, self.bias(light));
        }
    }

    /// Everything once: the objects that are `wanted`, by their numbers, and then all balls, which have the next number.
    /// Before each `set_model` is given its number and the matrix from object space to world space.
    pub(super) fn draw_scene(
        &self,
        gl: &glow::Context,
        wanted: impl Fn(usize) -> bool,
        mut set_model: impl FnMut(usize, DMat4),
    ) {
        let objects = &self.scene.objects;
        let mut bound = self.bound.take();
        for (number, (object, mesh)) in objects.iter().zip(&self.meshes).enumerate() {
            if wanted(number) {
                set_model(number, self.model(object));
                match bound.replace(number) == Some(number) {
                    true => mesh.draw_again(gl),
                    false => mesh.draw(gl),
                }
            }
        }
        if !self.balls.positions().is_empty() && wanted(objects.len()) {
            // Their places are told in the world itself.
            set_model(objects.len(), DMat4::IDENTITY);
            let again = bound.replace(objects.len()) == Some(objects.len());
            self.balls.draw(gl, again);
        }
        self.bound.set(bound);
    }
}
