//! `shadow_test=offset`: DrawSceneToShadowFBO from a camera that is fitted to what casts, with `glPolygonOffset`. No part
//! of the exercises.
//!
//! The filter's samples are one texel apart, whatever `step` says. In wireframe and points, the triangles cast as if they
//! were filled; and what casts, casts from behind, too.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glow::HasContext;

use super::Aueb7;
use super::programs::{LIGHTING, VERTEX_SHADER};
use super::spot_light::{DIFFUSE, SHADOW_MAP};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::offset::{self, Casts, OffsetTest, Taps, UNITS, set_culling};

/// Uniforms of the vertex shader as far as the test needs it, and of what both fragment shaders ask.
const TEST: [&str; 6] = [
    "uniform_m",
    "uniform_v",
    "uniform_p",
    "uniform_light_m",
    "uniform_sampler_diffuse",
    "uniform_outside",
];

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Offset {
    pub test: OffsetTest,
    taps: Taps,
    pub spot_light: Program,
    pub visibility: Program,
}

impl Offset {
    fn new(gl: &glow::Context, shaders: &Shaders, taps: Taps) -> Result<Self> {
        let [spot_light, visibility] = programs(gl, shaders, taps)?;
        Ok(Self {
            test: OffsetTest::default(),
            taps,
            spot_light,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let [spot_light, visibility] = programs(gl, shaders, self.taps)?;
        std::mem::replace(&mut self.spot_light, spot_light).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }

    fn delete(&self, gl: &glow::Context) {
        self.spot_light.delete(gl);
        self.visibility.delete(gl);
    }
}

/// The spotlight shader with the offset test, and the test alone.
fn programs(gl: &glow::Context, shaders: &Shaders, taps: Taps) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the offset test");
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&TEST[..], &offset::FITTED_MAP, others].concat();
        let fragments = [fragment, offset::SHADER, taps.shader()];
        Program::linked(gl, shaders, VERTEX_SHADER, &fragments, &uniforms)
    };
    let spot_light = linked("SpotLight_offset.frag", &LIGHTING)?;
    let visibility =
        linked("visibility_offset.frag", &[]).inspect_err(|_| spot_light.delete(gl))?;
    Ok([spot_light, visibility])
}

impl Aueb7 {
    /// DrawSceneToShadowFBO, if the map that it drew last does not serve on.
    pub(super) fn prepare_offset_test(&mut self, gl: &glow::Context) -> Result<()> {
        let taps = match self.settings.choice("filter") {
            "pcf_5" => Taps::Five,
            "pcf_9" => Taps::Nine,
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
        if self.renew_shadow_fbo(gl)? {
            offset.test.forget();
        }
        let redraw = self.settings.choice("redraw") == "every_frame";
        let (light, scene) = (self.light(), self.placed());
        let size = self.shadow_fbo.shadow_dimensions;
        if offset.test.prepare(&light, scene, size, taps, redraw) {
            self.draw_scene_to_fitted_map(gl, &offset);
            // The exercises' map is no more.
            self.drawn = None;
        }
        self.offset = Some(offset);
        Ok(())
    }

    fn draw_scene_to_fitted_map(&self, gl: &glow::Context, offset: &Offset) {
        let _pass = gl::pass(gl, "first pass: DrawSceneToShadowFBO, fitted");
        let program = &self.programs.shadow_map;
        let size = self.shadow_fbo.shadow_dimensions as i32;
        let fit = offset.test.fit();
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.shadow_fbo.fbo));
            gl.viewport(0, 0, size, size);
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.use_program(Some(program.handle));
            gl.enable(glow::POLYGON_OFFSET_FILL);
            gl.polygon_offset(offset.taps.factor(), UNITS);
            // What is nearer than near casts all the same.
            gl.enable(glow::DEPTH_CLAMP);
        }
        let mut culling = true;
        // root->draw(1): with the shadow map shader.
        self.draw(gl, |index, _, model| {
            let casts = fit.casts[index];
            if casts == Casts::Nothing {
                return false;
            }
            culling = set_culling(gl, casts == Casts::FrontFaces, culling);
            let mvp = fit.projection() * fit.space.from_object(model);
            program.set(gl, "uniform_mvp", mvp);
            true
        });
        set_culling(gl, true, culling);
        unsafe {
            gl.disable(glow::DEPTH_CLAMP);
            gl.disable(glow::POLYGON_OFFSET_FILL);
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        }
    }

    /// What every program with the offset test needs: the camera, the fitted map, what lies outside of the beam.
    pub(super) fn use_fitted_map(&self, gl: &glow::Context, offset: &Offset, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE0 + SHADOW_MAP as u32);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.shadow_fbo.fbo_shadow_texture));
            gl.active_texture(glow::TEXTURE0 + DIFFUSE as u32);
        }
        offset
            .test
            .send(gl, program, &offset::FITTED_MAP, SHADOW_MAP);
        program.set(gl, "uniform_sampler_diffuse", DIFFUSE);
        program.set(gl, "uniform_v", self.view());
        program.set(gl, "uniform_p", self.projection());
        program.set(gl, "uniform_outside", self.outside());
    }
}
