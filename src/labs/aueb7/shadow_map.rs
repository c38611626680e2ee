//! The first pass: the scene as viewed from the light, into the shadow map of the spotlight.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3};
use glow::{HasContext, PixelUnpackData};

use super::Aueb7;
use crate::gl;
use crate::gl::trace::{ObjectKind, name_object};
use crate::scene::{Light, LightKind, camera, rotate};
use crate::{Error, Result};

/// The framebuffer object, and the texture which stores the shadow map.
pub struct ShadowFbo {
    pub fbo: glow::Framebuffer,
    pub fbo_shadow_texture: glow::Texture,
    /// `shadow_dimensions`: width and height.
    pub shadow_dimensions: u32,
}

/// Everything that decides what the shadow map holds.
#[derive(PartialEq)]
pub struct MapInputs {
    pub place: usize,
    /// None where an object casts no shadow.
    pub mvps: Vec<Option<DMat4>>,
    pub polygon_mode: u32,
}

#[doc(alias = "CreateShadowFBO")]
pub fn create_shadow_fbo(gl: &glow::Context, shadow_dimensions: u32) -> Result<ShadowFbo> {
    let _pass = gl::pass(gl, "set-up: CreateShadowFBO");
    unsafe {
        let fbo = gl.create_framebuffer().map_err(Error::gl)?;
        name_object(ObjectKind::Framebuffer, fbo.0.get(), "fbo");
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(fbo));

        // The depths. Nearest: a depth between two surfaces would be on neither.
        let fbo_shadow_texture = gl.create_texture().map_err(Error::gl)?;
        name_object(
            ObjectKind::Texture,
            fbo_shadow_texture.0.get(),
            "fbo_shadow_texture",
        );
        gl.bind_texture(glow::TEXTURE_2D, Some(fbo_shadow_texture));
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::DEPTH_COMPONENT32 as i32,
            shadow_dimensions as i32,
            shadow_dimensions as i32,
            0,
            glow::DEPTH_COMPONENT,
            glow::FLOAT,
            PixelUnpackData::Slice(None),
        );
        for filter in [glow::TEXTURE_MAG_FILTER, glow::TEXTURE_MIN_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
        }
        for axis in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, axis, glow::CLAMP_TO_EDGE as i32);
        }
        gl.framebuffer_texture_2d(
            glow::FRAMEBUFFER,
            glow::DEPTH_ATTACHMENT,
            glow::TEXTURE_2D,
            Some(fbo_shadow_texture),
            0,
        );

        // There is no color to draw or to read.
        gl.draw_buffer(glow::NONE);
        gl.read_buffer(glow::NONE);
        gl::check_framebuffer(gl, "fbo")?;
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        Ok(ShadowFbo {
            fbo,
            fbo_shadow_texture,
            shadow_dimensions,
        })
    }
}

impl ShadowFbo {
    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.fbo);
            gl.delete_texture(self.fbo_shadow_texture);
        }
    }
}

impl Aueb7 {
    /// The spotlight: it follows the world's translation, and turns about the world's y axis.
    pub(super) fn light(&self) -> Light {
        let light = &self.scene().lights[0];
        let turn = rotate(self.light_angle(), DVec3::Y);
        Light {
            position: turn.transform_point3(light.position) + self.moved.world,
            direction: turn.transform_vector3(light.direction),
            ..light.clone()
        }
    }

    /// World space to the light's view; the world's origin is `origin`.
    pub(super) fn light_view(&self, origin: DVec3) -> DMat4 {
        let light = self.light();
        // The up vector is y; where the light looks along it, z.
        let up = camera::up_for(light.direction);
        camera::view(light.position - origin, light.direction, up)
    }

    pub(super) fn light_projection(&self) -> DMat4 {
        let light = self.light();
        let LightKind::Spot { cone, .. } = light.kind else {
            unreachable!("a scene of another light was refused")
        };
        camera::perspective(cone, 1.0, light.near, Some(light.far))
    }

    pub(super) fn map_inputs(&self) -> MapInputs {
        // DEVIATES: origin, the products are made in f64 and rounded once, and the world's origin is moved to the light
        // here and to the eye in the second pass: far from it the f32 products of glm would cancel.
        let origin = self.light().position;
        let from_world =
            self.light_projection() * self.light_view(origin) * DMat4::from_translation(-origin);
        let geometry = self.geometry();
        let mvps = geometry.iter();
        let mvps = mvps.map(|(object, model)| object.casts.then(|| from_world * *model));
        MapInputs {
            place: self.place(),
            mvps: mvps.collect(),
            polygon_mode: self.polygon_mode,
        }
    }

    #[doc(alias = "DrawSceneToShadowFBO")]
    pub(super) fn draw_scene_to_shadow_fbo(&self, gl: &glow::Context, inputs: &MapInputs) {
        let _pass = gl::pass(gl, "first pass: DrawSceneToShadowFBO");
        let program = &self.programs.shadow_map;
        let size = self.shadow_fbo.shadow_dimensions as i32;
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.shadow_fbo.fbo));
            gl.viewport(0, 0, size, size);
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.use_program(Some(program.handle));
        }
        // root->draw(1): with the shadow map shader.
        self.draw(gl, |index, _, _| {
            let mvp = inputs.mvps[index];
            if let Some(mvp) = mvp {
                program.set(gl, "uniform_mvp", mvp);
            }
            mvp.is_some()
        });
        unsafe { gl.bind_framebuffer(glow::FRAMEBUFFER, None) };
    }
}
