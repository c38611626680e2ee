//! `shadow_test=offset`: the first pass from a camera that is fitted to the casters, with `glPolygonOffset`. No part of
//! the handout.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::DMat4;
use glow::HasContext;

use super::Cs541;
use super::programs::{offset_lighting_program, offset_visibility_program};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::offset::{Casts, FITTED_MAP, OffsetTest, Taps, UNITS, set_culling};

/// A filter, of depths or of tests, costs more than the handout's whole test, and makes no shadow truer.
pub const TAPS: Taps = Taps::One;

/// The test and the programs that are linked with it; made when it is first asked for.
pub struct Offset {
    pub test: OffsetTest,
    pub lighting: Program,
    pub visibility: Program,
}

impl Offset {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let [lighting, visibility] = programs(gl, shaders)?;
        Ok(Self {
            test: OffsetTest::default(),
            lighting,
            visibility,
        })
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders) -> Result<()> {
        let [lighting, visibility] = programs(gl, shaders)?;
        std::mem::replace(&mut self.lighting, lighting).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        Ok(())
    }
}

fn programs(gl: &glow::Context, shaders: &Shaders) -> Result<[Program; 2]> {
    let lighting = offset_lighting_program(gl, shaders)?;
    let visibility = offset_visibility_program(gl, shaders).inspect_err(|_| lighting.delete(gl))?;
    Ok([lighting, visibility])
}

impl Cs541 {
    /// The first pass, if the map that it drew last does not serve on.
    pub(super) fn prepare_offset_test(&mut self, gl: &glow::Context) -> Result<()> {
        let mut offset = match self.offset.take() {
            Some(offset) => offset,
            None => Offset::new(gl, &self.shaders)?,
        };
        if self.renew_shadow_buffer(gl)? {
            offset.test.forget();
        }
        let redraw = self.settings.choice("redraw") == "every_frame";
        let size = self.shadow_buffer.kind.size;
        let (light, scene) = (self.set_light(), self.placed());
        if offset.test.prepare(&light, scene, size, TAPS, redraw) {
            self.draw_fitted_map(gl, &offset);
            // The handout's map is no more.
            self.drawn = None;
        }
        self.offset = Some(offset);
        Ok(())
    }

    fn draw_fitted_map(&self, gl: &glow::Context, offset: &Offset) {
        let _pass = gl::pass(gl, "first pass: drawing the fitted shadow map");
        let (program, buffer) = (&self.programs.shadow, &self.shadow_buffer);
        let size = buffer.kind.size as i32;
        let fit = offset.test.fit();
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(buffer.frame_buffer));
            gl.viewport(0, 0, size, size);
            gl.use_program(Some(program.handle));
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.enable(glow::POLYGON_OFFSET_FILL);
            gl.polygon_offset(TAPS.factor(), UNITS);
            // What is nearer than near casts all the same.
            gl.enable(glow::DEPTH_CLAMP);

            program.set(gl, "persp_matrix", fit.projection());
            program.set(gl, "view_matrix", DMat4::IDENTITY);
            gl.cull_face(glow::BACK);
            let mut culling = false;
            let objects = self.scene.objects.iter().zip(&self.meshes);
            for ((object, mesh), casts) in objects.zip(&fit.casts) {
                if *casts == Casts::Nothing {
                    continue;
                }
                culling = set_culling(gl, *casts == Casts::FrontFaces, culling);
                let model = fit.space.from_object(object.model(self.time));
                program.set(gl, "model_matrix", model);
                mesh.draw(gl);
            }
            set_culling(gl, false, culling);

            gl.disable(glow::DEPTH_CLAMP);
            gl.disable(glow::POLYGON_OFFSET_FILL);
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        }
    }

    /// What every program with the offset test needs: the eye's camera, the map on texture unit 1, the beam.
    pub(super) fn use_fitted_map(&self, gl: &glow::Context, offset: &Offset, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE1);
            gl.bind_texture(
                glow::TEXTURE_2D,
                Some(self.shadow_buffer.depth_texture_buffer),
            );
        }
        offset.test.send(gl, program, &FITTED_MAP, 1);
        program.set(gl, "beam", self.beam());
        self.set_camera(gl, program);
    }
}
