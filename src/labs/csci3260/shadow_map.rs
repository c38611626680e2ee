//! "Rendering the shadow map".
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3};
use glow::{HasContext, PixelUnpackData};

use super::{Csci3260, scene};
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::scene::{Object, camera};
use crate::{Error, Result};

/// The render target: a framebuffer, and the depth texture that it draws into.
pub struct RenderTarget {
    pub shadow_framebuffer: glow::Framebuffer,
    pub depth_texture: glow::Texture,
    pub size: u32,
}

/// Everything that decides what the shadow map holds.
#[derive(PartialEq)]
pub struct MapInputs {
    pub place: usize,
    /// None where a model casts no shadow.
    pub depth_mvps: Vec<Option<DMat4>>,
    pub front_face_culling: bool,
}

impl RenderTarget {
    /// "Setting up the render target".
    pub fn new(gl: &glow::Context, size: u32) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: the render target of the shadow map");
        unsafe {
            // DEVIATES: shadowFramebuffer, the slides also spell it `shadowFrameBuffer`, which is another variable.
            let shadow_framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
            name_object(
                ObjectKind::Framebuffer,
                shadow_framebuffer.0.get(),
                "shadowFramebuffer",
            );
            let depth_texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, depth_texture.0.get(), "depthTexture");
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
            for filter in [glow::TEXTURE_MAG_FILTER, glow::TEXTURE_MIN_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
            }
            for axis in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, axis, glow::CLAMP_TO_EDGE as i32);
            }
            // DEVIATES: swizzle, a core profile returns a depth as (d, 0, 0, 1), and the slides' `.z` would read 0.
            let swizzle = [glow::RED, glow::RED, glow::RED, glow::ONE].map(|c| c as i32);
            gl.tex_parameter_i32_slice(glow::TEXTURE_2D, glow::TEXTURE_SWIZZLE_RGBA, &swizzle);

            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(shadow_framebuffer));
            gl.framebuffer_texture(
                glow::FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                Some(depth_texture),
                0,
            );
            // No color buffer is drawn to.
            gl.draw_buffer(glow::NONE);
            // DEVIATES: read buffer, a strict 3.3 driver calls a framebuffer incomplete that reads from a color buffer
            // which it does not have.
            gl.read_buffer(glow::NONE);
            // Always check that our framebuffer is OK.
            gl::check_framebuffer(gl, "shadowFramebuffer")?;
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            Ok(Self {
                shadow_framebuffer,
                depth_texture,
                size,
            })
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.shadow_framebuffer);
            gl.delete_texture(self.depth_texture);
        }
    }
}

/// "Create the function which is similar to installShaders()".
#[doc(alias = "installShadowMapShaders")]
pub fn install_shadow_map_shaders(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: installShadowMapShaders");
    // DEVIATES: "depthMVP ", the slides ask for the uniform's location with a space behind its name: there is none.
    let program = Program::new(
        gl,
        shaders,
        "ShadowVertexShader.glsl",
        "ShadowFragmentShader.glsl",
        &["depthMVP"],
    )?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "shadowMapProgramID",
    );
    Ok(program)
}

impl Csci3260 {
    /// World space to the light's view: it looks from `lightInvDir` at the origin. The world's origin is `origin`.
    pub(super) fn depth_view_matrix(&self, origin: DVec3) -> DMat4 {
        let light = self.light();
        // DEVIATES: up vector, (0, 1, 0) as in the slides but for a light along it, where lookAt divides by zero.
        let up = camera::up_for(light.direction);
        camera::view(light.position - origin, light.direction, up)
    }

    /// "The projection matrix is an orthographic matrix which will encompass everything in the axis-aligned box".
    pub(super) fn depth_projection_matrix(&self) -> DMat4 {
        let light = self.light();
        camera::orthographic(self.area(), light.near, light.far)
    }

    /// The model matrix: depends on different models, and on the stage of the slides.
    pub(super) fn model_matrix(&self, object: &Object) -> DMat4 {
        if self.settings.choice("stage") == "thick" && self.place() == super::ROOM {
            scene::thickened(object)
        } else {
            object.model(self.time)
        }
    }

    /// The depth MVP matrix which is used to render the scene from the light's point of view.
    pub(super) fn depth_mvp(&self, object: &Object) -> DMat4 {
        // DEVIATES: origin, the products are made in f64 and rounded once, and the world's origin is moved to the light
        // here and to the eye in the second pass: far from it the f32 products of glm would cancel.
        let origin = self.light().position;
        let depth_model_matrix = DMat4::from_translation(-origin) * self.model_matrix(object);
        self.depth_projection_matrix() * self.depth_view_matrix(origin) * depth_model_matrix
    }

    pub(super) fn map_inputs(&self) -> MapInputs {
        let objects = self.scene().objects.iter();
        let depth_mvp = |object: &Object| object.casts.then(|| self.depth_mvp(object));
        MapInputs {
            place: self.place(),
            depth_mvps: objects.map(depth_mvp).collect(),
            front_face_culling: self.settings.choice("stage") == "culling",
        }
    }

    /// The first half of `paintGL`: "Render shadow map".
    pub(super) fn render_shadow_map(&self, gl: &glow::Context, inputs: &MapInputs) {
        let _pass = gl::pass(gl, "rendering the shadow map");
        let (program, target) = (&self.programs.shadow_map, &self.target);
        let size = target.size as i32;
        unsafe {
            gl.use_program(Some(program.handle));
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(target.shadow_framebuffer));
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.viewport(0, 0, size, size);
            if inputs.front_face_culling {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::FRONT);
            }
        }
        // Send different transformations to different models, and render shadow maps.
        self.draw_scene(gl, |mesh, _| {
            let depth_mvp = inputs.depth_mvps[mesh.object];
            if let Some(depth_mvp) = depth_mvp {
                program.set(gl, "depthMVP", depth_mvp);
            }
            depth_mvp.is_some()
        });
        if inputs.front_face_culling {
            unsafe {
                // Don't forget to reset original culling face.
                gl.cull_face(glow::BACK);
                gl.disable(glow::CULL_FACE);
            }
        }
    }
}
