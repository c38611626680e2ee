//! `shadow_test=offset`: the shadow map in a box that is fitted to what casts, with `glPolygonOffset`. No part of the
//! slides.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glow::HasContext;

use super::Csci3260;
use super::basic_shader::{SHADING, VERTEX_SHADER};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::offset::{self, Casts, OffsetTest, Taps, UNITS, set_culling};

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Offset {
    pub test: OffsetTest,
    taps: Taps,
    pub basic: Program,
    pub visibility: Program,
}

impl Offset {
    fn new(gl: &glow::Context, shaders: &Shaders, taps: Taps) -> Result<Self> {
        let [basic, visibility] = install(gl, shaders, taps)?;
        Ok(Self {
            test: OffsetTest::default(),
            taps,
            basic,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let [basic, visibility] = install(gl, shaders, self.taps)?;
        std::mem::replace(&mut self.basic, basic).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }

    fn delete(&self, gl: &glow::Context) {
        self.basic.delete(gl);
        self.visibility.delete(gl);
    }
}

/// The basic shader with the offset test, and the test alone.
fn install(gl: &glow::Context, shaders: &Shaders, taps: Taps) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the offset test");
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&["MVP", "DepthBiasMVP"], &offset::FITTED_MAP[..], others].concat();
        let fragments = [fragment, offset::SHADER, taps.shader()];
        Program::linked(gl, shaders, VERTEX_SHADER, &fragments, &uniforms)
    };
    let shading = [&SHADING[..], &["normalMatrix", "lightInvDir"]].concat();
    let basic = linked("FragmentShaderCode_offset.glsl", &shading)?;
    let visibility = linked("visibility_offset.frag", &[]).inspect_err(|_| basic.delete(gl))?;
    Ok([basic, visibility])
}

impl Csci3260 {
    /// The shadow map, rendered anew if the last one does not serve on.
    pub(super) fn prepare_offset_test(&mut self, gl: &glow::Context) -> Result<()> {
        // The slides' other remedies are in the test already, or are none of it.
        let taps = match self.settings.choice("stage") {
            "pcf" => Taps::Five,
            _ => Taps::One,
        };
        let mut offset = match self.offset.take() {
            Some(offset) if offset.taps == taps => offset,
            other => {
                let made = Offset::new(gl, &self.shaders, taps)?;
                if let Some(other) = other {
                    other.delete(gl);
                }
                made
            }
        };
        if self.renew_target(gl)? {
            offset.test.forget();
        }
        let redraw = self.settings.choice("redraw") == "every_frame";
        let (light, scene, size) = (self.light(), self.placed(), self.target.size);
        if offset.test.prepare(light, scene, size, taps, redraw) {
            self.render_fitted_map(gl, &offset);
            // The slides' map is no more.
            self.drawn = None;
        }
        self.offset = Some(offset);
        Ok(())
    }

    fn render_fitted_map(&self, gl: &glow::Context, offset: &Offset) {
        let _pass = gl::pass(gl, "rendering the fitted shadow map");
        let (program, target) = (&self.programs.shadow_map, &self.target);
        let size = target.size as i32;
        let fit = offset.test.fit();
        unsafe {
            gl.use_program(Some(program.handle));
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(target.shadow_framebuffer));
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.viewport(0, 0, size, size);
            gl.enable(glow::POLYGON_OFFSET_FILL);
            gl.polygon_offset(offset.taps.factor(), UNITS);
        }
        let mut culling = false;
        self.draw_scene(gl, |mesh, _| {
            let casts = fit.casts[mesh.object];
            if casts == Casts::Nothing {
                return false;
            }
            culling = set_culling(gl, casts == Casts::FrontFaces, culling);
            let model = self.model_matrix(&self.scene().objects[mesh.object]);
            let depth_mvp = fit.projection() * fit.space.from_object(model);
            program.set(gl, "depthMVP", depth_mvp);
            true
        });
        set_culling(gl, false, culling);
        unsafe { gl.disable(glow::POLYGON_OFFSET_FILL) };
    }

    /// What every program with the offset test needs: the fitted map, on texture unit 1.
    pub(super) fn use_fitted_map(&self, gl: &glow::Context, offset: &Offset, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE1);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.target.depth_texture));
        }
        offset.test.send(gl, program, &offset::FITTED_MAP, 1);
    }
}
