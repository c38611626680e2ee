//! `shadow_test=exact`: DrawSceneToShadowFBO has nothing to do; Render asks the light buffer. No part of the exercises.
//!
//! Shadows are hard, whatever `filter` says: PCF is the mean of tests around a point, and here is only the point's own.
//! In wireframe and points, the triangles cast as if they were filled.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glow::HasContext;

use super::Aueb7;
use super::programs::{LIGHTING, VERTEX_SHADER};
use super::spot_light::DIFFUSE;
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::exact::{self, Binding, Builder, ExactTest, LIGHT_BUFFER};

const BINDING: Binding = Binding {
    pass: "the light buffer",
    uniforms: LIGHT_BUFFER,
    // Before it are the course's maps and the shadow map.
    first_unit: 5,
};

/// Uniforms of the exact shadow test, and of the vertex shader as far as the test needs it.
const TEST: [&str; 6] = [
    "uniform_m",
    "uniform_v",
    "uniform_p",
    "uniform_light_m",
    "uniform_sampler_diffuse",
    "uniform_outside",
];

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Exact {
    builder: Builder,
    pub test: ExactTest,
    pub spot_light: Program,
    pub visibility: Program,
}

impl Exact {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let [spot_light, visibility] = programs(gl, shaders)?;
        Ok(Self {
            builder: Builder::default(),
            test: ExactTest::new(gl, &BINDING)?,
            spot_light,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let [spot_light, visibility] = programs(gl, shaders)?;
        std::mem::replace(&mut self.spot_light, spot_light).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }
}

/// The spotlight shader with the exact test, and the test alone.
fn programs(gl: &glow::Context, shaders: &Shaders) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the exact test");
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&TEST[..], &LIGHT_BUFFER, others].concat();
        let fragments = [fragment, exact::SHADER];
        Program::linked(gl, shaders, VERTEX_SHADER, &fragments, &uniforms)
    };
    let spot_light = linked("SpotLight_exact.frag", &LIGHTING)?;
    let visibility = linked("visibility_exact.frag", &[]).inspect_err(|_| spot_light.delete(gl))?;
    Ok([spot_light, visibility])
}

impl Aueb7 {
    /// Brings the light buffer up to date with the light and the scene graph.
    pub(super) fn prepare_exact_test(&mut self, gl: &glow::Context) -> Result<()> {
        if self.exact.is_none() {
            self.exact = Some(Exact::new(gl, &self.shaders)?);
        }
        let (light, scene) = (self.light(), self.placed());
        let every_frame = self.settings.choice("redraw") == "every_frame";
        let Exact { builder, test, .. } = self.exact.as_mut().expect("made above");
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

    /// What every program with the exact test needs: the camera, the light buffer, what lies outside of the beam.
    pub(super) fn use_light_buffer(&self, gl: &glow::Context, exact: &Exact, program: &Program) {
        exact.test.bind(gl, program);
        unsafe { gl.active_texture(glow::TEXTURE0 + DIFFUSE as u32) };
        program.set(gl, "uniform_sampler_diffuse", DIFFUSE);
        program.set(gl, "uniform_v", self.view());
        program.set(gl, "uniform_p", self.projection());
        program.set(gl, "uniform_outside", self.outside());
    }
}
