//! Section 4: the storage that `fbo_accum_init()` makes, the frame and the accumulation buffer.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::cell::Cell;

use glow::{HasContext, PixelUnpackData};

use super::s8::SignedSum;
use crate::gl;
use crate::gl::trace::{ObjectKind, name_object};
use crate::{Error, Result};

/// Attachment 0 of the course: what `drawScene()` draws.
pub struct Frame {
    pub framebuffer: glow::Framebuffer,
    pub texture: glow::Texture,
    depth_stencil: glow::Renderbuffer,
}

/// Attachment 1 of the course: the accumulation buffer.
pub enum Sum {
    Blended {
        framebuffer: glow::Framebuffer,
        renderbuffer: glow::Renderbuffer,
        /// The weight that blending has, once it has been set in a frame.
        weight: Cell<Option<f64>>,
    },
    Signed(SignedSum),
}

impl Frame {
    pub fn new(gl: &glow::Context, [width, height]: [u32; 2]) -> Result<Self> {
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

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.framebuffer);
            gl.delete_texture(self.texture);
            gl.delete_renderbuffer(self.depth_stencil);
        }
    }
}

impl Sum {
    pub fn blended(gl: &glow::Context, size: [u32; 2], accumulator: &str) -> Result<Self> {
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

    pub fn delete(&self, gl: &glow::Context) {
        match self {
            Self::Blended {
                framebuffer,
                renderbuffer,
                ..
            } => unsafe {
                gl.delete_framebuffer(*framebuffer);
                gl.delete_renderbuffer(*renderbuffer);
            },
            Self::Signed(sum) => sum.delete(gl),
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
