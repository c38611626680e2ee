//! Section 4: a framebuffer object as accumulation buffer, one-to-one with the uses of `glAccum()`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::cell::Cell;
use std::rc::Rc;

use glow::{HasContext, PixelUnpackData};

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

/// Attachment 0 of the course: what `drawScene()` draws.
struct Frame {
    framebuffer: glow::Framebuffer,
    texture: glow::Texture,
    depth_stencil: glow::Renderbuffer,
}

/// Attachment 1 of the course: the accumulation buffer.
enum Sum {
    Blended {
        framebuffer: glow::Framebuffer,
        renderbuffer: glow::Renderbuffer,
        /// The weight that blending has, once it has been set in a frame.
        weight: Cell<Option<f64>>,
    },
    Signed(SignedSum),
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
            gl.delete_framebuffer(self.frame.framebuffer);
            gl.delete_texture(self.frame.texture);
            gl.delete_renderbuffer(self.frame.depth_stencil);
            match &self.sum {
                Sum::Blended {
                    framebuffer,
                    renderbuffer,
                    ..
                } => {
                    gl.delete_framebuffer(*framebuffer);
                    gl.delete_renderbuffer(*renderbuffer);
                }
                Sum::Signed(sum) => sum.delete(gl),
            }
        }
    }
}

impl Frame {
    fn new(gl: &glow::Context, [width, height]: [u32; 2]) -> Result<Self> {
        unsafe {
            let framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(ObjectKind::Framebuffer, framebuffer.0.get(), "frame_fbo");
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));

            let texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, texture.0.get(), "frame");
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGBA8 as i32,
                width as i32,
                height as i32,
                0,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                PixelUnpackData::Slice(None),
            );
            for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
            }
            gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                glow::TEXTURE_2D,
                Some(texture),
                0,
            );

            let depth_stencil = gl.create_renderbuffer().map_err(Error::gl)?;
            name_object(
                ObjectKind::Renderbuffer,
                depth_stencil.0.get(),
                "depth_stencil",
            );
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(depth_stencil));
            gl.renderbuffer_storage(
                glow::RENDERBUFFER,
                glow::DEPTH24_STENCIL8,
                width as i32,
                height as i32,
            );
            gl.framebuffer_renderbuffer(
                glow::FRAMEBUFFER,
                glow::DEPTH_STENCIL_ATTACHMENT,
                glow::RENDERBUFFER,
                Some(depth_stencil),
            );
            gl::check_framebuffer(gl, "the frame's framebuffer")?;
            Ok(Self {
                framebuffer,
                texture,
                depth_stencil,
            })
        }
    }
}

impl Sum {
    fn blended(gl: &glow::Context, size: [u32; 2], accumulator: &str) -> Result<Self> {
        let [width, height] = size.map(|n| n as i32);
        unsafe {
            let framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(ObjectKind::Framebuffer, framebuffer.0.get(), "accum_fbo");
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let renderbuffer = gl.create_renderbuffer().map_err(Error::gl)?;
            name_object(ObjectKind::Renderbuffer, renderbuffer.0.get(), "accum");
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(renderbuffer));
            let (wanted, with_alpha) = formats(accumulator);
            let mut complete = Ok(());
            // DEVIATES: alpha, GL 3.3 promises no framebuffer with an RGB renderbuffer; where the driver has none, the
            // format with alpha takes its place, whose other three components are the same.
            for format in [wanted, with_alpha] {
                gl.renderbuffer_storage(glow::RENDERBUFFER, format, width, height);
                gl.framebuffer_renderbuffer(
                    glow::FRAMEBUFFER,
                    glow::COLOR_ATTACHMENT0,
                    glow::RENDERBUFFER,
                    Some(renderbuffer),
                );
                complete = gl::check_framebuffer(gl, "the accumulation buffer");
                if complete.is_ok() {
                    break;
                }
            }
            complete?;
            Ok(Self::Blended {
                framebuffer,
                renderbuffer,
                weight: Cell::new(None),
            })
        }
    }
}

/// The format of a setting, and the one with alpha.
fn formats(accumulator: &str) -> (u32, u32) {
    match accumulator {
        "RGB32F" => (glow::RGB32F, glow::RGBA32F),
        "RGBA32F" => (glow::RGBA32F, glow::RGBA32F),
        "RGB16F" => (glow::RGB16F, glow::RGBA16F),
        "RGBA16F" => (glow::RGBA16F, glow::RGBA16F),
        "RGB8" => (glow::RGB8, glow::RGBA8),
        _ => (glow::RGBA8, glow::RGBA8),
    }
}
