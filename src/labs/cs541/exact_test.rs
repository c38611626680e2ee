//! `shadow_test=exact`: no first pass and no shadow map; the second pass asks the light buffer. No part of the handout.

use super::Cs541;
use super::programs::{exact_lighting_program, exact_visibility_program};
use crate::Result;
use crate::gl::{Program, Shaders};
use crate::shadow_tests::exact::ExactTest;

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Exact {
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
            test: ExactTest::new(gl)?,
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
        exact.test.prepare(gl, &light, scene, every_frame)
    }

    /// What every program with the exact test needs: the eye's camera, the light buffer, the beam.
    pub(super) fn use_light_buffer(&self, gl: &glow::Context, exact: &Exact, program: &Program) {
        exact.test.bind(gl, program);
        program.set(gl, "beam", self.beam());
        self.set_camera(gl, program);
    }
}
