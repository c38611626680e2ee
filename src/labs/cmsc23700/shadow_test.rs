//! The setting `shadow_test`: the handout's test, or one that is no part of it.

use std::sync::Arc;

use glam::DMat4;

use super::exact_test::Exact;
use super::offset_test::Offset;
use super::{Cmsc23700, DIRECTIONAL, SPOT};
use crate::Result;
use crate::gl::Program;
use crate::labs::chosen_test::chosen_test;
use crate::scene::Object;
use crate::shadow_tests::Placed;

/// The shadow test that a frame makes.
#[derive(Clone, Copy)]
pub enum ShadowTest<'a> {
    Handout,
    Offset(&'a Offset),
    Exact(&'a Exact),
}

impl Cmsc23700 {
    pub(super) fn prepare_shadow_test(&mut self, gl: &glow::Context) -> Result<()> {
        self.release_exact_tests(gl);
        match chosen_test(&self.settings) {
            "exact" => self.prepare_exact_tests(gl),
            "offset" => self.prepare_offset_tests(gl),
            _ => self.prepare_shadow_maps(gl),
        }
    }

    /// The test that this frame has prepared.
    pub(super) fn shadow_test(&self) -> ShadowTest<'_> {
        match (chosen_test(&self.settings), &self.offset, &self.exact) {
            ("offset", Some(offset), _) => ShadowTest::Offset(offset),
            ("exact", _, Some(exact)) => ShadowTest::Exact(exact),
            _ => ShadowTest::Handout,
        }
    }

    /// The numbers of the lights that are on.
    pub(super) fn enabled_lights(&self) -> impl Iterator<Item = usize> + use<> {
        let enabled = self.enabled();
        [DIRECTIONAL, SPOT]
            .into_iter()
            .filter(move |light| enabled[*light])
    }

    /// The objects, and then each ball.
    pub(super) fn placed_scene(&self) -> Vec<Placed> {
        let object = |object: &Object| Placed {
            mesh: object.mesh.clone(),
            model: self.model(object),
            casts: object.casts,
        };
        // Where the GPU has it, which knows its place in f32.
        let ball = |center: &glam::Vec3| Placed {
            mesh: Arc::clone(&self.balls.mesh),
            model: DMat4::from_translation(center.as_dvec3()),
            casts: true,
        };
        let objects = self.scene.objects.iter().map(object);
        let balls = self.balls.positions().iter().map(ball);
        objects.chain(balls).collect()
    }

    /// What every program with a shadow test needs.
    pub(super) fn use_shadow_test(&self, gl: &glow::Context, program: &Program) {
        match self.shadow_test() {
            ShadowTest::Handout => self.set_shadows(gl, program),
            ShadowTest::Offset(offset) => self.use_fitted_maps(gl, offset, program),
            ShadowTest::Exact(exact) => self.use_light_buffers(gl, exact, program),
        }
    }

    /// What a shadow test needs of an object, beside its place as the eye sees it.
    pub(super) fn set_shadow_test(&self, gl: &glow::Context, program: &Program, model: DMat4) {
        match self.shadow_test() {
            ShadowTest::Handout => (),
            ShadowTest::Offset(offset) => self.set_offset_test(gl, offset, program, model),
            ShadowTest::Exact(exact) => self.set_exact_test(gl, exact, program, model),
        }
    }
}
