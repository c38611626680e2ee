//! `shadow_test=exact`: no first pass and no shadow map; the second pass asks the light buffer. No part of the handout.

use super::Cs541;
use super::programs::{exact_lighting_program, exact_visibility_program};
use crate::Result;
use crate::gl::{Program, Shaders};
use crate::shadow_tests::exact::{Binding, Builder, ExactTest, LIGHT_BUFFER};

const BINDING: Binding = Binding {
    pass: "the light buffer",
    uniforms: LIGHT_BUFFER,
    // Before it are the object's texture and the shadow map.
    first_unit: 2,
};

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Exact {
    builder: Builder,
    pub test: ExactTest,
    pub lighting: Program,
    pub visibility: Program,
}

impl Exact {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let lighting = exact_lighting_program(gl, shaders)?;
        let visibility =
            exact_visibility_program(gl, shaders).inspect_err(|_| lighting.delete(gl))?;
        Ok(Self {
            builder: Builder::default(),
            test: ExactTest::new(gl, &BINDING)?,
            lighting,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let lighting = exact_lighting_program(gl, shaders)?;
        let visibility =
            exact_visibility_program(gl, shaders).inspect_err(|_| lighting.delete(gl))?;
        std::mem::replace(&mut self.lighting, lighting).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }
}

impl Cs541 {
    /// Brings the light buffer up to date with the light and the scene.
    pub(super) fn prepare_exact_test(&mut self, gl: &glow::Context) -> Result<()> {
        if self.exact.is_none() {
            self.exact = Some(Exact::new(gl, &self.shaders)?);
        }
        let every_frame = self.settings.choice("redraw") == "every_frame";
        let (light, scene) = (self.set_light(), self.placed());
        let exact = self.exact.as_mut().expect("made above");
        let Exact { builder, test, .. } = exact;
        test.prepare(gl, builder, &light, scene, every_frame)
    }

    /// Gives the light buffer back once another test is chosen.
    pub(super) fn release_exact_test(&mut self, gl: &glow::Context) {
        let is_chosen = self.settings.choice("shadow_test") == "exact";
        let exact = self.exact.as_mut().filter(|_| !is_chosen);
        if let Some(exact) = exact {
            exact.test.release(gl);
        }
    }

    /// What every program with the exact test needs: the eye's camera, the light buffer, the beam.
    pub(super) fn use_light_buffer(&self, gl: &glow::Context, exact: &Exact, program: &Program) {
        exact.test.bind(gl, program);
        program.set(gl, "beam", self.beam());
        self.set_camera(gl, program);
    }
}
