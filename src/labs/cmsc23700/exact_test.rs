//! `shadow_test=exact`: no shadow map is drawn; the second pass asks a light buffer of each light. No part of the handout.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::DMat4;
use glow::HasContext;

use super::Cmsc23700;
use super::lights::{self, CONE, LIGHTING};
use super::second_pass::MATRICES;
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::scene::Scene;
use crate::shadow_tests::exact::{self, Binding, Builder, ExactTest};

/// Behind the two shadow maps' texture units come two for each light.
const BINDINGS: [Binding; 2] = [
    Binding {
        pass: "the directional light's buffer",
        uniforms: [
            "directionalBuffer.cells",
            "directionalBuffer.nodes",
            "directionalBuffer.rectangle",
            "directionalBuffer.side",
        ],
        first_unit: 2,
    },
    Binding {
        pass: "the spotlight's buffer",
        uniforms: [
            "spotBuffer.cells",
            "spotBuffer.nodes",
            "spotBuffer.rectangle",
            "spotBuffer.side",
        ],
        first_unit: 4,
    },
];

/// Of each light, in the tests that are no part of the handout: object space to its coordinate system.
pub const MODEL_MATRICES: [&str; 2] = ["directionalModelMatrix", "spotModelMatrix"];

/// The test of each light and the programs that are linked with it; made when it is first asked for.
pub struct Exact {
    builder: Builder,
    tests: [ExactTest; 2],
    pub lighting: Program,
    pub visibility: Program,
}

impl Exact {
    fn new(gl: &glow::Context, shaders: &Shaders, scene: &Scene) -> Result<Self> {
        let [lighting, visibility] = programs(gl, shaders)?;
        let [directional, spot] = &BINDINGS;
        let exact = Self {
            builder: Builder::default(),
            tests: [ExactTest::new(gl, directional)?, ExactTest::new(gl, spot)?],
            lighting,
            visibility,
        };
        exact.set_lights(gl, scene);
        Ok(exact)
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders, scene: &Scene) -> Result<()> {
        let [lighting, visibility] = programs(gl, shaders)?;
        std::mem::replace(&mut self.lighting, lighting).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        self.set_lights(gl, scene);
        Ok(())
    }

    /// What holds for as long as the programs do.
    fn set_lights(&self, gl: &glow::Context, scene: &Scene) {
        for program in [&self.visibility, &self.lighting] {
            unsafe { gl.use_program(Some(program.handle)) };
            lights::set_cone(gl, program, scene);
            for test in &self.tests {
                test.set_units(gl, program);
            }
        }
        lights::set_lighting(gl, &self.lighting, scene);
    }
}

/// The second pass with the exact test, and the test alone.
fn programs(gl: &glow::Context, shaders: &Shaders) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the exact test");
    let [directional, spot] = &BINDINGS;
    let test = [
        &MATRICES[..],
        &MODEL_MATRICES,
        &CONE,
        &directional.uniforms,
        &spot.uniforms,
    ]
    .concat();
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&test[..], others].concat();
        let fragments = [fragment, exact::SHADER];
        Program::linked(gl, shaders, "lighting_lcs.vert", &fragments, &uniforms)
    };
    let switches = ["normalMatrix", "directionalEnabled", "spotEnabled"];
    let lighting = linked("lighting_exact.frag", &[&LIGHTING[..], &switches].concat())?;
    let visibility =
        linked("visibility_exact.frag", &["light"]).inspect_err(|_| lighting.delete(gl))?;
    Ok([lighting, visibility])
}

impl Cmsc23700 {
    /// Brings the light buffer of each enabled light up to date with it and the scene.
    pub(super) fn prepare_exact_tests(&mut self, gl: &glow::Context) -> Result<()> {
        if self.exact.is_none() {
            self.exact = Some(Exact::new(gl, &self.shaders, &self.scene)?);
        }
        let lights = self.enabled_lights();
        let every_frame = self.settings.choice("redraw") == "every_frame";
        let scene = self.placed_scene();
        let Exact { builder, tests, .. } = self.exact.as_mut().expect("made above");
        for light in lights {
            let source = &self.scene.lights[light];
            tests[light].prepare(gl, builder, source, scene.clone(), every_frame)?;
        }
        Ok(())
    }

    /// Gives the light buffers back once another test is chosen.
    pub(super) fn release_exact_tests(&mut self, gl: &glow::Context) {
        let is_chosen = self.settings.choice("shadow_test") == "exact";
        let exact = self.exact.as_mut().filter(|_| !is_chosen);
        for test in exact.into_iter().flat_map(|exact| &mut exact.tests) {
            test.release(gl);
        }
    }

    /// The light buffer of each enabled light on its own texture units.
    pub(super) fn use_light_buffers(&self, gl: &glow::Context, exact: &Exact, program: &Program) {
        for (test, _) in exact.tests.iter().zip(self.enabled()).filter(|(_, on)| *on) {
            test.bind(gl, program);
        }
    }

    /// Where something is as the enabled lights see it.
    pub(super) fn set_exact_test(
        &self,
        gl: &glow::Context,
        exact: &Exact,
        program: &Program,
        model: DMat4,
    ) {
        for light in self.enabled_lights() {
            let matrix = exact.tests[light].from_object(model);
            program.set(gl, MODEL_MATRICES[light], matrix);
        }
    }
}
