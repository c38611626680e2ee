//! `shadow_test=exact`: no shadow map is rendered; the basic shader asks the light buffer. No part of the slides.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glow::HasContext;

use super::Csci3260;
use super::basic_shader::{SHADING, VERTEX_SHADER};
use crate::gl::{self, Program, Shaders};
use crate::scene::Object;
use crate::shadow_tests::exact::{self, Binding, Builder, ExactTest, LIGHT_BUFFER, Placed};
use crate::{Error, Result};

/// Uniforms of the exact shadow test, and of the vertex shader as far as the test needs it.
const TEST: [&str; 3] = ["MVP", "DepthBiasMVP", "firstTriangle"];

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
    /// Whether the exact test is made: with shadows=off none is.
    pub(super) fn is_exact(&self) -> bool {
        self.settings.choice("shadow_test") == "exact" && self.settings.switch("shadows")
    }

    /// Brings the light buffer up to date with the light and the scene.
    pub(super) fn prepare_exact_test(&mut self, gl: &glow::Context) -> Result<()> {
        if self.exact.is_none() {
            self.exact = Some(Exact::new(gl, &self.shaders)?);
        }
        let placed = |object: &Object| Placed {
            mesh: object.mesh.clone(),
            model: self.model_matrix(object),
            casts: object.casts,
        };
        let scene = self.scene().objects.iter().map(placed).collect();
        let light = self.light().clone();
        let every_frame = self.settings.choice("redraw") == "every_frame";
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

    /// The exact test alone.
    pub(super) fn draw_exact_visibility(&self, gl: &glow::Context, exact: &Exact) {
        let _pass = gl::pass(gl, "using the light buffer: the test alone");
        let program = &exact.visibility;
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [1.0; 4]);
        exact.test.bind(gl, program);
        self.draw_scene(gl, |mesh, _| {
            self.set_exact_test(gl, exact, program, mesh.object);
            true
        });
    }

    /// Where a model is as the camera and the light see it, and which triangles are its own.
    pub(super) fn set_exact_test(
        &self,
        gl: &glow::Context,
        exact: &Exact,
        program: &Program,
        index: usize,
    ) {
        let object = &self.scene().objects[index];
        let model = self.model_matrix(object);
        program.set(gl, "MVP", self.mvp(object));
        program.set(gl, "DepthBiasMVP", exact.test.from_object(model));
        program.set(gl, "firstTriangle", exact.test.first_triangle(index));
    }

    /// An error where the state has no shadow map.
    pub(super) fn check_map(&self) -> Result<()> {
        if !self.settings.switch("shadows") {
            return Err(Error::usage(
                "shadows=off draws no shadow map, expected shadows=on",
            ));
        }
        if self.is_exact() {
            return Err(Error::usage(
                "shadow_test=exact draws no shadow map, expected shadow_test=handout",
            ));
        }
        Ok(())
    }
}
