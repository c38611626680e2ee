//! The setting `shadow_test`: the slides' test, or one that is no part of them.

use super::Csci3260;
use super::exact_test::Exact;
use super::offset_test::Offset;
use crate::Result;
use crate::gl::Program;
use crate::labs::chosen_test::chosen_test;
use crate::scene::Object;
use crate::shadow_tests::Placed;

/// The shadow test that a frame makes.
#[derive(Clone, Copy)]
pub enum ShadowTest<'a> {
    Slides,
    Offset(&'a Offset),
    Exact(&'a Exact),
}

impl Csci3260 {
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
            _ => ShadowTest::Slides,
        }
    }

    /// What is in the scene, in the order in which it is drawn.
    pub(super) fn placed(&self) -> Vec<Placed> {
        let placed = |object: &Object| Placed {
            mesh: object.mesh.clone(),
            model: self.model_matrix(object),
            casts: object.casts,
        };
        self.scene().objects.iter().map(placed).collect()
    }

    /// What every program with a shadow test needs.
    pub(super) fn use_shadow_test(&self, gl: &glow::Context, program: &Program) {
        match self.shadow_test() {
            ShadowTest::Slides => self.set_shadow_test(gl, program),
            ShadowTest::Offset(offset) => self.use_fitted_map(gl, offset, program),
            ShadowTest::Exact(exact) => exact.test.bind(gl, program),
        }
    }

    /// Where a model is as the camera and the light see it.
    pub(super) fn send_object(&self, gl: &glow::Context, program: &Program, index: usize) {
        let object = &self.scene().objects[index];
        let model = self.model_matrix(object);
        match self.shadow_test() {
            ShadowTest::Slides => self.set_transformations(gl, program, object),
            ShadowTest::Offset(offset) => {
                let space = offset.test.fit().space;
                program.set(gl, "MVP", self.mvp(object));
                program.set(gl, "DepthBiasMVP", space.from_object(model));
            }
            ShadowTest::Exact(exact) => {
                program.set(gl, "MVP", self.mvp(object));
                program.set(gl, "DepthBiasMVP", exact.test.from_object(model));
            }
        }
    }
}
