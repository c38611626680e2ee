//! The first pass: "render the scene from the light's point of view, generating a depth texture".
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, Vec3};
use glow::{HasContext, PixelUnpackData};

use super::{Cmsc23700, NAMES};
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::{Error, Result};

/// A light's frame-buffer object, and the depth texture that it draws into. The course gives FBOs in `fbo.h`.
pub struct ShadowMap {
    pub fbo: glow::Framebuffer,
    pub depth_texture: glow::Texture,
    pub size: u32,
    /// What the map was drawn from, while that still holds.
    pub drawn: Option<MapInputs>,
}

/// Everything that decides what a shadow map holds.
#[derive(PartialEq)]
pub struct MapInputs {
    /// Of each object; None where it casts no shadow.
    model_view_projections: Vec<Option<DMat4>>,
    balls: Vec<Vec3>,
}

impl ShadowMap {
    /// `light` counts from 0.
    pub fn new(gl: &glow::Context, light: usize, size: u32) -> Result<Self> {
        let name = NAMES[light];
        let _pass = gl::pass(gl, &format!("set-up: the {name}'s shadow map"));
        let [fbo_name, texture_name] =
            [["directionalFBO", "directionalMap"], ["spotFBO", "spotMap"]][light];
        unsafe {
            let depth_texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, depth_texture.0.get(), texture_name);
            gl.bind_texture(glow::TEXTURE_2D, Some(depth_texture));
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::DEPTH_COMPONENT as i32,
                size as i32,
                size as i32,
                0,
                glow::DEPTH_COMPONENT,
                glow::FLOAT,
                PixelUnpackData::Slice(None),
            );
            // A mean of depths is the depth of nothing.
            for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
            }
            // Beside the map nothing is known to stand before the light: there it is lit, as where the map is empty.
            for axis in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, axis, glow::CLAMP_TO_BORDER as i32);
            }
            gl.tex_parameter_f32_slice(glow::TEXTURE_2D, glow::TEXTURE_BORDER_COLOR, &[1.0; 4]);

            let fbo = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(ObjectKind::Framebuffer, fbo.0.get(), fbo_name);
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(fbo));
            gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                glow::TEXTURE_2D,
                Some(depth_texture),
                0,
            );
            // There is no color to draw or to read.
            gl.draw_buffer(glow::NONE);
            gl.read_buffer(glow::NONE);
            gl::check_framebuffer(gl, fbo_name)?;
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            Ok(Self {
                fbo,
                depth_texture,
                size,
                drawn: None,
            })
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.fbo);
            gl.delete_texture(self.depth_texture);
        }
    }
}

pub fn shadow_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the shadow program");
    let program = Program::new(
        gl,
        shaders,
        "shadow.vert",
        "shadow.frag",
        &["lightModelViewProjection"],
    )?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "shadow_program",
    );
    Ok(program)
}

impl Cmsc23700 {
    pub(super) fn map_inputs(&self, light: usize) -> MapInputs {
        let camera = &self.light_cameras[light];
        let objects = self.scene.objects.iter();
        let of_caster = |model| camera.model_view_projection(model);
        MapInputs {
            model_view_projections: objects
                .map(|object| object.casts.then(|| of_caster(self.model(object))))
                .collect(),
            balls: self.balls.positions().to_vec(),
        }
    }

    /// "If there are two lights enabled, then you will have to generate two shadow maps."
    pub(super) fn draw_shadow_maps(&mut self, gl: &glow::Context) {
        let every_frame = self.settings.choice("redraw") == "every_frame";
        let enabled = self.enabled();
        let due = (0..2).filter(|light| enabled[*light]).filter_map(|light| {
            let inputs = self.map_inputs(light);
            let holds = self.shadow_maps[light].drawn.as_ref() == Some(&inputs);
            (every_frame || !holds).then_some((light, inputs))
        });
        let due: Vec<_> = due.collect();
        if due.is_empty() {
            return;
        }
        let program = &self.programs.shadow;
        {
            let _pass = gl::pass(gl, "first pass");
            let size = self.shadow_maps[0].size as i32;
            unsafe {
                gl.use_program(Some(program.handle));
                gl.viewport(0, 0, size, size);
            }
        }
        for (light, inputs) in due {
            let _pass = gl::pass(
                gl,
                &format!("first pass: the {}'s shadow map", NAMES[light]),
            );
            unsafe {
                gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.shadow_maps[light].fbo));
                gl.clear(glow::DEPTH_BUFFER_BIT);
            }
            let camera = &self.light_cameras[light];
            self.draw_scene(
                gl,
                |number| self.scene.objects.get(number).is_none_or(|o| o.casts),
                |_, model| {
                    let matrix = camera.model_view_projection(model);
                    program.set(gl, "lightModelViewProjection", matrix);
                },
            );
            self.shadow_maps[light].drawn = Some(inputs);
            // The offset test's map is no more.
            if let Some(offset) = &mut self.offset {
                offset.tests[light].forget();
            }
        }
        unsafe { gl.bind_framebuffer(glow::FRAMEBUFFER, None) };
    }
}
