//! `shadow_test=exact`: no shadow map is rendered; the basic shader asks the light buffer. No part of the slides.

use super::Csci3260;
use super::basic_shader::{SHADING, VERTEX_SHADER};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::exact::{self, ExactTest};

/// Uniforms of the exact shadow test, and of the vertex shader as far as the test needs it.
const TEST: [&str; 3] = ["MVP", "DepthBiasMVP", "firstTriangle"];

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Exact {
    pub test: ExactTest,
    pub basic: Program,
    pub visibility: Program,
}

impl Exact {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let [basic, visibility] = install(gl, shaders)?;
        Ok(Self {
            test: ExactTest::new(gl)?,
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
        let uniforms = [&TEST[..], &exact::LIGHT_BUFFER, others].concat();
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
        exact.test.prepare(gl, &light, scene, every_frame)
    }
}
