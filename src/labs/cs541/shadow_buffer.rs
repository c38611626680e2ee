//! "Storing depth values as a texture".
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glow::{HasContext, PixelUnpackData};

use crate::gl;
use crate::gl::trace::{ObjectKind, name_object};
use crate::labs::Settings;
use crate::{Error, Result};

/// A framebuffer object with depth and no color, and the texture that stores its depth values.
pub struct ShadowBuffer {
    pub frame_buffer: glow::Framebuffer,
    pub depth_texture_buffer: glow::Texture,
    pub kind: ShadowBufferKind,
}

#[derive(Clone, Copy, PartialEq)]
pub struct ShadowBufferKind {
    pub size: u32,
    pub depth_format: &'static str,
    pub filter: &'static str,
}

impl ShadowBuffer {
    #[doc(alias = "glGenFramebuffers")]
    pub fn new(gl: &glow::Context, kind: ShadowBufferKind) -> Result<Self> {
        let (internal_format, component_type) = match kind.depth_format {
            "16" => (glow::DEPTH_COMPONENT16, glow::UNSIGNED_SHORT),
            "24" => (glow::DEPTH_COMPONENT24, glow::UNSIGNED_INT),
            "32F" => (glow::DEPTH_COMPONENT32F, glow::FLOAT),
            _ => (glow::DEPTH_COMPONENT, glow::FLOAT),
        };
        let filter = match kind.filter {
            "nearest" => glow::NEAREST,
            _ => glow::LINEAR,
        };
        let size = kind.size as i32;
        let _pass = gl::pass(gl, "set-up: storing depth values as a texture");
        unsafe {
            let frame_buffer = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(
                ObjectKind::Framebuffer,
                frame_buffer.0.get(),
                "frame_buffer",
            );
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame_buffer));

            let depth_texture_buffer = gl.create_texture().map_err(Error::gl)?;
            name_object(
                ObjectKind::Texture,
                depth_texture_buffer.0.get(),
                "depth_texture_buffer",
            );
            gl.bind_texture(glow::TEXTURE_2D, Some(depth_texture_buffer));
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                internal_format as i32,
                size,
                size,
                0,
                glow::DEPTH_COMPONENT,
                component_type,
                PixelUnpackData::Slice(None),
            );
            gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MIN_FILTER, filter as i32);
            gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAG_FILTER, filter as i32);

            // DEVIATES: wrap mode, with the default GL_REPEAT the linear filter mixes in depths from the map's
            // opposite edge.
            for axis in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, axis, glow::CLAMP_TO_EDGE as i32);
            }
            // DEVIATES: swizzle, a core profile returns a depth as (d, 0, 0, 1), and the handout's `.z` would read 0;
            // in 2018's compatibility profile any component returned the depth.
            let swizzle = [glow::RED, glow::RED, glow::RED, glow::ONE].map(|c| c as i32);
            gl.tex_parameter_i32_slice(glow::TEXTURE_2D, glow::TEXTURE_SWIZZLE_RGBA, &swizzle);

            gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                glow::TEXTURE_2D,
                Some(depth_texture_buffer),
                0,
            );

            // DEVIATES: draw and read buffer NONE, a strict 3.3 driver calls a framebuffer incomplete that names color
            // buffers it does not have.
            gl.draw_buffer(glow::NONE);
            gl.read_buffer(glow::NONE);
            // DEVIATES: completeness check, without it an incomplete framebuffer shows as missing shadows only.
            gl::check_framebuffer(gl, "frame_buffer")?;

            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            Ok(Self {
                frame_buffer,
                depth_texture_buffer,
                kind,
            })
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.frame_buffer);
            gl.delete_texture(self.depth_texture_buffer);
        }
    }
}

impl ShadowBufferKind {
    /// What the settings ask for, no larger than the driver allows.
    pub fn new(largest_map: u32, settings: &Settings) -> Self {
        Self {
            size: largest_map.min(settings.number("map_size") as u32),
            depth_format: settings.choice("depth_format"),
            filter: settings.choice("filter"),
        }
    }
}
