//! Section 4: a framebuffer object as accumulation buffer, one-to-one with the uses of `glAccum()`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::cell::Cell;
use std::rc::Rc;

use glow::HasContext;

use super::accum_buffers::{Frame, Sum};
use super::programs::Accumulation;
use super::s8::SignedSum;
use crate::gl;
use crate::gl::trace::{ObjectKind, name_object};
use crate::{Error, Result};

/// What is rendered, and what it is accumulated in.
pub struct FboAccum {
    pub size: [u32; 2],
    /// The setting.
    pub accumulator: &'static str,
    pub programs: Rc<Accumulation>,
    /// These have no attributes: the corners come from `gl_VertexID`.
    quad: glow::VertexArray,
    ramp: glow::VertexArray,

    // DEVIATES: two framebuffers, the course samples attachment 0 while it draws to attachment 1 of the same framebuffer,
    // which GL leaves undefined.
    frame: Frame,
    sum: Sum,
    /// Whether blending is enabled.
    blends: Cell<bool>,
}

impl FboAccum {
    /// In place of a pixel format with an accumulation buffer.
    pub fn fbo_accum_init(
        gl: &glow::Context,
        programs: Rc<Accumulation>,
        size: [u32; 2],
        accumulator: &'static str,
    ) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: fbo_accum_init");
        let frame = Frame::new(gl, size)?;
        let sum = match accumulator {
            "S8" => Sum::Signed(SignedSum::new(gl, size)?),
            _ => Sum::blended(gl, size, accumulator)?,
        };
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            let quad = gl.create_vertex_array().map_err(Error::gl)?;
            name_object(ObjectKind::VertexArray, quad.0.get(), "quad");
            let ramp = gl.create_vertex_array().map_err(Error::gl)?;
            name_object(ObjectKind::VertexArray, ramp.0.get(), "ramp");
            Ok(Self {
                size,
                accumulator,
                programs,
                quad,
                ramp,
                frame,
                sum,
                blends: Cell::new(false),
            })
        }
    }

    /// `glClear(GL_ACCUM_BUFFER_BIT)`, and what holds for all passes of a frame.
    pub fn fbo_accum_clear(&self, gl: &glow::Context) {
        unsafe {
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.frame.texture));
            match &self.sum {
                Sum::Blended {
                    framebuffer,
                    weight,
                    ..
                } => {
                    gl.bind_framebuffer(glow::FRAMEBUFFER, Some(*framebuffer));
                    gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
                    gl.blend_func(glow::CONSTANT_ALPHA, glow::ONE);
                    weight.set(None);
                }
                Sum::Signed(sum) => sum.clear(gl),
            }
        }
    }

    /// The next render goes into the frame.
    pub fn select_frame(&self, gl: &glow::Context) {
        unsafe { gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.frame.framebuffer)) };
        self.blend_no_more(gl);
    }

    fn blend_no_more(&self, gl: &glow::Context) {
        if self.blends.replace(false) {
            unsafe { gl.disable(glow::BLEND) };
        }
    }

    /// `glAccum(GL_ACCUM, weight)`: adds the frame to the accumulation buffer.
    ///
    /// The accumulation buffer has no depth: the test lets everything pass.
    pub fn fbo_accum(&self, gl: &glow::Context, weight: f64) {
        unsafe {
            gl.bind_vertex_array(Some(self.quad));
            match &self.sum {
                Sum::Blended {
                    framebuffer,
                    weight: set,
                    ..
                } => {
                    gl.bind_framebuffer(glow::FRAMEBUFFER, Some(*framebuffer));
                    gl.use_program(Some(self.programs.accum.handle));
                    self.programs.accum.set(gl, "frame", 0);
                    if set.replace(Some(weight)) != Some(weight) {
                        gl.blend_color(0.0, 0.0, 0.0, weight as f32);
                    }
                    gl.enable(glow::BLEND);
                    self.blends.set(true);
                    gl.draw_arrays(glow::TRIANGLES, 0, 3);
                }
                Sum::Signed(sum) => {
                    sum.select_next(gl, &self.programs.accum_s8, weight);
                    gl.draw_arrays(glow::TRIANGLES, 0, 3);
                }
            }
        }
    }

    /// `glAccum(GL_RETURN, weight)`: moves the accumulated contents over to the window. The quad, the program and the
    /// framebuffer of the last `fbo_accum` are still there.
    pub fn fbo_accum_return(&self, gl: &glow::Context, weight: f64) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            match &self.sum {
                Sum::Blended { .. } => {
                    if weight != 1.0 {
                        self.multiply(gl, weight);
                    }
                    self.blend_no_more(gl);
                    // For reading, the accumulation buffer stays bound.
                    gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, None);
                    gl.blit_framebuffer(
                        0,
                        0,
                        width,
                        height,
                        0,
                        0,
                        width,
                        height,
                        glow::COLOR_BUFFER_BIT,
                        glow::NEAREST,
                    );
                    gl.bind_framebuffer(glow::READ_FRAMEBUFFER, None);
                }
                Sum::Signed(sum) => {
                    gl.bind_framebuffer(glow::FRAMEBUFFER, None);
                    gl.disable(glow::DEPTH_TEST);
                    sum.select_return(gl, &self.programs.return_s8, weight);
                    gl.draw_arrays(glow::TRIANGLES, 0, 3);
                    gl.enable(glow::DEPTH_TEST);
                }
            }
        }
    }

    /// `glAccum(GL_MULT, weight)`: blending leaves the accumulation buffer's share of itself alone.
    fn multiply(&self, gl: &glow::Context, weight: f64) {
        unsafe {
            gl.blend_func(glow::ZERO, glow::CONSTANT_ALPHA);
            gl.blend_color(0.0, 0.0, 0.0, weight as f32);
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
        }
    }

    /// Section 5's quad, into the frame.
    pub fn draw_ramp(&self, gl: &glow::Context) {
        unsafe {
            gl.use_program(Some(self.programs.ramp.handle));
            gl.bind_vertex_array(Some(self.ramp));
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_vertex_array(self.quad);
            gl.delete_vertex_array(self.ramp);
        }
        self.frame.delete(gl);
        self.sum.delete(gl);
    }
}
