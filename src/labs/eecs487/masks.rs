//! What the fast method draws into: the frame, and a bit for each light at each pixel.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::DVec3;
use glow::{HasContext, PixelUnpackData};

use super::programs::JITTERS;
use super::settings::MOST_JITTERS;
use crate::gl::trace::{ObjectKind, name_object};
use crate::{Error, Result, gl};

/// Four bytes have so many bits.
pub const LIGHTS_PER_MASK: usize = 32;

pub struct Masks {
    pub size: [u32; 2],
    pub frame: glow::Framebuffer,
    /// One for each layer of the texture, with the frame's depth and stencil buffer.
    pub framebuffers: Vec<glow::Framebuffer>,
    texture: glow::Texture,
    color: glow::Renderbuffer,
    depth_stencil: glow::Renderbuffer,
    quad: glow::VertexArray,

    /// By how much each light is jittered, as the uniform block has it.
    block: glow::Buffer,
    sent: Option<JittersSent>,
    pub jitters: Vec<DVec3>,
}

/// What the jitters were made from.
#[derive(Clone, Copy, PartialEq)]
pub struct JittersSent {
    pub kind: &'static str,
    pub amount: f64,
    pub first: f64,
    pub count: usize,
}

impl Masks {
    pub fn new(gl: &glow::Context, size: [u32; 2], count: usize) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: masks of the fast method");
        let [width, height] = size.map(|n| n as i32);
        unsafe {
            let texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, texture.0.get(), "masks");
            gl.bind_texture(glow::TEXTURE_2D_ARRAY, Some(texture));
            gl.tex_image_3d(
                glow::TEXTURE_2D_ARRAY,
                0,
                glow::RGBA8 as i32,
                width,
                height,
                count as i32,
                0,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                PixelUnpackData::Slice(None),
            );
            for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D_ARRAY, filter, glow::NEAREST as i32);
            }

            let storage = |format| -> Result<glow::Renderbuffer> {
                let buffer = gl.create_renderbuffer().map_err(Error::gl)?;
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.renderbuffer_storage(glow::RENDERBUFFER, format, width, height);
                Ok(buffer)
            };
            // Blending in 8 bits would round three times.
            let color = storage(glow::RGBA16F)?;
            let depth_stencil = storage(glow::DEPTH24_STENCIL8)?;

            let with_depth_and_stencil = |name: &str| -> Result<glow::Framebuffer> {
                let framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
                name_object(ObjectKind::Framebuffer, framebuffer.0.get(), name);
                gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
                gl.framebuffer_renderbuffer(
                    glow::FRAMEBUFFER,
                    glow::DEPTH_STENCIL_ATTACHMENT,
                    glow::RENDERBUFFER,
                    Some(depth_stencil),
                );
                Ok(framebuffer)
            };
            let frame = with_depth_and_stencil("frame_fbo")?;
            gl.framebuffer_renderbuffer(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                glow::RENDERBUFFER,
                Some(color),
            );
            gl::check_framebuffer(gl, "the frame's framebuffer")?;
            let mut framebuffers = Vec::new();
            for layer in 0..count {
                framebuffers.push(with_depth_and_stencil(&format!("mask_fbo_{layer}"))?);
                gl.framebuffer_texture_layer(
                    glow::FRAMEBUFFER,
                    glow::COLOR_ATTACHMENT0,
                    Some(texture),
                    0,
                    layer as i32,
                );
                gl::check_framebuffer(gl, "a mask's framebuffer")?;
            }
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);

            let block = gl.create_buffer().map_err(Error::gl)?;
            gl.bind_buffer_base(glow::UNIFORM_BUFFER, JITTERS, Some(block));
            let bytes = vec![0; MOST_JITTERS * size_of::<[f32; 4]>()];
            gl.buffer_data_u8_slice(glow::UNIFORM_BUFFER, &bytes, glow::DYNAMIC_DRAW);
            Ok(Self {
                size,
                frame,
                framebuffers,
                texture,
                color,
                depth_stencil,
                quad: gl.create_vertex_array().map_err(Error::gl)?,
                block,
                sent: None,
                jitters: Vec::new(),
            })
        }
    }

    /// How many masks there is room for.
    pub fn count(&self) -> usize {
        self.framebuffers.len()
    }

    pub fn is_sent(&self, wanted: &JittersSent) -> bool {
        self.sent.as_ref() == Some(wanted)
    }

    pub fn send_jitters(&mut self, gl: &glow::Context, from: JittersSent, jitters: Vec<DVec3>) {
        let four = |jitter: &DVec3| jitter.as_vec3().extend(0.0).to_array();
        let bytes = jitters.iter().flat_map(four).flat_map(f32::to_ne_bytes);
        let bytes: Vec<u8> = bytes.collect();
        unsafe {
            gl.bind_buffer(glow::UNIFORM_BUFFER, Some(self.block));
            gl.buffer_sub_data_u8_slice(glow::UNIFORM_BUFFER, 0, &bytes);
        }
        self.jitters = jitters;
        self.sent = Some(from);
    }

    /// A pixel of each mask for each pixel of the window.
    pub fn draw_quad(&self, gl: &glow::Context) {
        unsafe {
            gl.bind_vertex_array(Some(self.quad));
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
        }
    }

    /// Where the penumbra's shader finds them.
    pub fn bind(&self, gl: &glow::Context) {
        unsafe {
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(glow::TEXTURE_2D_ARRAY, Some(self.texture));
        }
    }

    /// The frame is bound.
    pub fn to_window(&self, gl: &glow::Context) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
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
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            for framebuffer in self.framebuffers.iter().chain([&self.frame]) {
                gl.delete_framebuffer(*framebuffer);
            }
            gl.delete_texture(self.texture);
            gl.delete_renderbuffer(self.color);
            gl.delete_renderbuffer(self.depth_stencil);
            gl.delete_vertex_array(self.quad);
            gl.delete_buffer(self.block);
        }
    }
}
