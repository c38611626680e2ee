//! Section 5: the 8-bit accumulation buffer of Fig. 2, which GL 3.3 has no more.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::cell::Cell;

use glow::{HasContext, PixelUnpackData};

use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program};
use crate::{Error, Result};

/// Two targets in turn: one has the sum so far, into the other one goes the next.
// DEVIATES: S8, the handout's buffer truncates and wraps where blending in GL 3.3 rounds and saturates, and glBlitFramebuffer
// converts no integers: a shader adds, and another one returns.
pub struct SignedSum {
    targets: [Target; 2],
    /// The one that has the sum so far.
    current: Cell<usize>,
}

struct Target {
    framebuffer: glow::Framebuffer,
    texture: glow::Texture,
}

impl SignedSum {
    pub fn new(gl: &glow::Context, size: [u32; 2]) -> Result<Self> {
        Ok(Self {
            targets: [
                Target::new(gl, size, "accum_0")?,
                Target::new(gl, size, "accum_1")?,
            ],
            current: Cell::new(0),
        })
    }

    /// The sum is 0; its texture will be on unit 1.
    pub fn clear(&self, gl: &glow::Context) {
        let target = &self.targets[self.current.get()];
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(target.framebuffer));
            gl.clear_buffer_i32_slice(glow::COLOR, 0, &[0; 4]);
            gl.active_texture(glow::TEXTURE1);
        }
    }

    /// From the sum so far to the other target, which becomes the sum.
    pub fn select_next(&self, gl: &glow::Context, program: &Program, weight: f64) {
        let from = self.current.get();
        self.current.set(1 - from);
        unsafe {
            let target = &self.targets[1 - from];
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(target.framebuffer));
            gl.bind_texture(glow::TEXTURE_2D, Some(self.targets[from].texture));
            gl.use_program(Some(program.handle));
        }
        program.set(gl, "frame", 0);
        program.set(gl, "accumulated", 1);
        program.set(gl, "weight", weight);
    }

    pub fn select_return(&self, gl: &glow::Context, program: &Program, weight: f64) {
        unsafe {
            let target = &self.targets[self.current.get()];
            gl.bind_texture(glow::TEXTURE_2D, Some(target.texture));
            gl.use_program(Some(program.handle));
        }
        program.set(gl, "accumulated", 1);
        program.set(gl, "weight", weight);
    }

    pub fn delete(&self, gl: &glow::Context) {
        for target in &self.targets {
            unsafe {
                gl.delete_framebuffer(target.framebuffer);
                gl.delete_texture(target.texture);
            }
        }
    }
}

impl Target {
    fn new(gl: &glow::Context, [width, height]: [u32; 2], name: &str) -> Result<Self> {
        unsafe {
            let texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, texture.0.get(), name);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGBA8I as i32,
                width as i32,
                height as i32,
                0,
                glow::RGBA_INTEGER,
                glow::BYTE,
                PixelUnpackData::Slice(None),
            );
            for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
            }
            let framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(ObjectKind::Framebuffer, framebuffer.0.get(), name);
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                glow::TEXTURE_2D,
                Some(texture),
                0,
            );
            gl::check_framebuffer(gl, "the accumulation buffer S8")?;
            Ok(Self {
                framebuffer,
                texture,
            })
        }
    }
}
