//! The setting `shadow_test`: the handout's test, or one that is no part of it.

use super::Cs541;
use super::exact_test::Exact;
use super::offset_test::Offset;
use crate::Result;
use crate::gl::Program;
use crate::labs::chosen_test::chosen_test;
use crate::scene::{Light, Object};
use crate::shadow_tests::Placed;

/// The shadow test that a frame makes.
#[derive(Clone, Copy)]
pub enum ShadowTest<'a> {
    Handout,
    Offset(&'a Offset),
    Exact(&'a Exact),
}

impl Cs541 {
    pub(super) fn prepare_shadow_test(&mut self, gl: &glow::Context) -> Result<()> {
        self.release_exact_test(gl);
        match chosen_test(&self.settings) {
            "exact" => self.prepare_exact_test(gl),
            "offset" => self.prepare_offset_test(gl),
            _ => self.prepare_shadow_map(gl),
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

    /// The scene's light as the settings have it.
    pub(super) fn set_light(&self) -> Light {
        Light {
            kind: self.light_kind(),
            ..self.light().clone()
        }
    }

    /// What is in the scene, in the order in which it is drawn.
    pub(super) fn placed(&self) -> Vec<Placed> {
        let placed = |object: &Object| Placed {
            mesh: object.mesh.clone(),
            model: object.model(self.time),
            casts: object.casts,
        };
        self.scene.objects.iter().map(placed).collect()
    }

    /// What every program with a shadow test needs.
    pub(super) fn use_shadow_test(&self, gl: &glow::Context, program: &Program) {
        match self.shadow_test() {
            ShadowTest::Handout => self.use_shadow_map(gl, program),
            ShadowTest::Offset(offset) => self.use_fitted_map(gl, offset, program),
            ShadowTest::Exact(exact) => self.use_light_buffer(gl, exact, program),
        }
    }

    /// What a shadow test needs of an object, beside its model matrix.
    pub(super) fn set_shadow_test(&self, gl: &glow::Context, program: &Program, index: usize) {
        let model = self.scene.objects[index].model(self.time);
        // Where it is as the light sees it.
        match self.shadow_test() {
            ShadowTest::Handout => (),
            ShadowTest::Offset(offset) => {
                let space = offset.test.fit().space;
                program.set(gl, "light_model_matrix", space.from_object(model));
            }
            ShadowTest::Exact(exact) => {
                program.set(gl, "light_model_matrix", exact.test.from_object(model));
            }
        }
    }
}
