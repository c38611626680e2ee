//! The setting `shadow_test`: the exercises' test, or one that is no part of them.

use glam::DMat4;

use super::Aueb7;
use super::exact_test::Exact;
use super::offset_test::Offset;
use crate::Result;
use crate::gl::Program;
use crate::labs::Show;
use crate::labs::chosen_test::chosen_test;
use crate::shadow_tests::Placed;

/// The shadow test that a frame makes.
#[derive(Clone, Copy)]
pub enum ShadowTest<'a> {
    Exercises,
    Offset(&'a Offset),
    Exact(&'a Exact),
}

impl Aueb7 {
    pub(super) fn prepare_shadow_test(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.release_exact_test(gl);
        match chosen_test(&self.settings) {
            "exact" => self.prepare_exact_test(gl),
            "offset" => self.prepare_offset_test(gl),
            _ => self.prepare_exercises_test(gl, show),
        }
    }

    /// The test that this frame has prepared.
    pub(super) fn shadow_test(&self) -> ShadowTest<'_> {
        match (chosen_test(&self.settings), &self.offset, &self.exact) {
            ("offset", Some(offset), _) => ShadowTest::Offset(offset),
            ("exact", _, Some(exact)) => ShadowTest::Exact(exact),
            _ => ShadowTest::Exercises,
        }
    }

    /// What is drawn, in the order in which it is.
    pub(super) fn placed(&self) -> Vec<Placed> {
        let geometry = self.geometry().into_iter();
        let placed = geometry.map(|(object, model)| Placed {
            mesh: object.mesh.clone(),
            model,
            casts: object.casts,
        });
        placed.collect()
    }

    /// What every program with a shadow test needs.
    pub(super) fn use_shadow_test(&self, gl: &glow::Context, program: &Program) {
        match self.shadow_test() {
            ShadowTest::Exercises => self.set_shadows(gl, program),
            ShadowTest::Offset(offset) => self.use_fitted_map(gl, offset, program),
            ShadowTest::Exact(exact) => self.use_light_buffer(gl, exact, program),
        }
    }

    /// What a shadow test needs of an object, beside its place as the eye sees it.
    pub(super) fn set_shadow_test(&self, gl: &glow::Context, program: &Program, model: DMat4) {
        // Where it is as the light sees it.
        match self.shadow_test() {
            ShadowTest::Exercises => (),
            ShadowTest::Offset(offset) => {
                let space = offset.test.fit().space;
                program.set(gl, "uniform_light_m", space.from_object(model));
            }
            ShadowTest::Exact(exact) => {
                program.set(gl, "uniform_light_m", exact.test.from_object(model));
            }
        }
    }
}
