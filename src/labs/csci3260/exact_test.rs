//! `shadow_test=exact`: no shadow map is rendered; the basic shader asks the light buffer. No part of the slides.

use super::Csci3260;
use super::basic_shader::{SHADING, VERTEX_SHADER};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::exact::{self, Binding, Builder, ExactTest, LIGHT_BUFFER};

/// Uniforms of the exact shadow test, and of the vertex shader as far as the test needs it.
const TEST: [&str; 2] = ["MVP", "DepthBiasMVP"];

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
    pub basic: Program,
    pub visibility: Program,
}

impl Exact {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let [basic, visibility] = install(gl, shaders)?;
        Ok(Self {
            builder: Builder::default(),
            test: ExactTest::new(gl, &BINDING)?,
            basic,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let [basic, visibility] = install(gl, shaders)?;
        std::mem::replace(&mut self.basic, basic).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }
}

/// The basic shader with the exact test, and the test alone.
fn install(gl: &glow::Context, shaders: &Shaders) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the exact test");
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&TEST[..], &LIGHT_BUFFER, others].concat();
        let fragments = [fragment, exact::SHADER];
        Program::linked(gl, shaders, VERTEX_SHADER, &fragments, &uniforms)
    };
    let shading = [&SHADING[..], &["normalMatrix", "lightInvDir"]].concat();
    let basic = linked("FragmentShaderCode_exact.glsl", &shading)?;
    let visibility = linked("visibility_exact.frag", &[]).inspect_err(|_| basic.delete(gl))?;
    Ok([basic, visibility])
}

impl Csci3260 {
    /// Brings the light buffer up to date with the light and the scene.
    pub(super) fn prepare_exact_test(&mut self, gl: &glow::Context) -> Result<()> {
        if self.exact.is_none() {
            self.exact = Some(Exact::new(gl, &self.shaders)?);
        }
        let every_frame = self.settings.choice("redraw") == "every_frame";
        let (light, scene) = (self.light().clone(), self.placed());
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
}
