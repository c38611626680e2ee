//! "Using the shadow map": the basic shader.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3};
use glow::HasContext;

use super::Csci3260;
use super::models::Mesh;
use super::shadow_test::ShadowTest;
use crate::Result;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::scene::{Object, camera};

/// Uniforms of the shadow test, and of the vertex shader as far as the test needs it.
pub const SHADOW_TEST: [&str; 8] = [
    "MVP",
    "DepthBiasMVP",
    "normalMatrix",
    "shadowMap",
    "stage",
    "biasValue",
    "shadows",
    "lightInvDir",
];

/// Uniforms of the shading.
pub const SHADING: [&str; 8] = [
    "M",
    "specularVisibility",
    "objTexture",
    "materialColor",
    "MaterialSpecularColor",
    "AmbientLightColor",
    "DiffuseLightColor",
    "SpecularLightColor",
];

pub const VERTEX_SHADER: &str = "VertexShaderCode.glsl";

#[doc(alias = "installShaders")]
pub fn install_shaders(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: installShaders");
    let program = with_shadow_test(gl, shaders, "FragmentShaderCode.glsl", &SHADING)?;
    name_object(ObjectKind::Program, program.handle.0.get(), "programID");
    Ok(program)
}

/// The basic vertex shader with a fragment shader that makes the shadow test.
pub fn with_shadow_test(
    gl: &glow::Context,
    shaders: &Shaders,
    fragment: &str,
    others: &[&'static str],
) -> Result<Program> {
    let uniforms = [&SHADOW_TEST[..], others].concat();
    Program::new(gl, shaders, VERTEX_SHADER, fragment, &uniforms)
}

/// [−1, 1] to [0, 1], column by column: the diagonal divides by 2, the lower row translates.
pub fn bias_matrix() -> DMat4 {
    #[rustfmt::skip]
    let columns = [
        0.5, 0.0, 0.0, 0.0,
        0.0, 0.5, 0.0, 0.0,
        0.0, 0.0, 0.5, 0.0,
        0.5, 0.5, 0.5, 1.0,
    ];
    DMat4::from_cols_array(&columns)
}

impl Csci3260 {
    /// The slides' stages as far as the shader knows them.
    fn stage_number(&self) -> i32 {
        match self.settings.choice("stage") {
            "no_bias" | "culling" => 0,
            "slope" => 2,
            "pcf" => 3,
            _ => 1,
        }
    }

    /// The bias of the present stage; slope: where the light comes at 45 degrees.
    pub(super) fn bias(&self) -> f64 {
        match self.stage_number() {
            0 => 0.0,
            _ => self.settings.number("bias"),
        }
    }

    /// Object space to world space, its origin moved to the eye.
    pub(super) fn model_from_eye(&self, object: &Object) -> DMat4 {
        DMat4::from_translation(-self.scene().camera.eye) * self.model_matrix(object)
    }

    pub(super) fn mvp(&self, object: &Object) -> DMat4 {
        let camera = self.scene().camera;
        let view = camera::view(DVec3::ZERO, camera.look, camera.rup);
        camera.perspective(self.aspect()) * view * self.model_from_eye(object)
    }

    pub(super) fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// The second half of `paintGL`: "using the basic shader".
    pub(super) fn use_shadow_map(&self, gl: &glow::Context) {
        let (heading, program) = match self.shadow_test() {
            ShadowTest::Slides => ("using the shadow map", &self.programs.basic),
            ShadowTest::Offset(offset) => ("using the fitted shadow map", &offset.basic),
            ShadowTest::Exact(exact) => ("using the light buffer", &exact.basic),
        };
        let _pass = gl::pass(gl, heading);
        let [red, green, blue] = self.scene().clear.as_vec3().to_array();
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [red, green, blue, 1.0]);
        self.use_shadow_test(gl, program);
        program.set(gl, "lightInvDir", self.light_inv_dir());
        program.set(gl, "objTexture", 0);
        let specular_visibility = self.settings.number("specular_visibility");
        program.set(gl, "specularVisibility", specular_visibility);
        let light_color = self.light().color;
        program.set(gl, "AmbientLightColor", self.scene().ambient);
        program.set(gl, "DiffuseLightColor", light_color);
        program.set(gl, "SpecularLightColor", light_color);
        unsafe { gl.active_texture(glow::TEXTURE0) };
        let mut bound = None;
        self.draw_scene(gl, |mesh, texture| {
            let object = &self.scene().objects[mesh.object];
            if bound.replace(texture) != Some(texture) {
                unsafe { gl.bind_texture(glow::TEXTURE_2D, Some(texture)) };
            }
            self.send_object(gl, program, mesh.object);
            program.set(gl, "normalMatrix", self.normal_matrix(object));
            program.set(gl, "M", self.model_from_eye(object));
            program.set(gl, "materialColor", object.material.diffuse);
            program.set(gl, "MaterialSpecularColor", object.material.specular);
            true
        });
    }

    /// The shadow test alone.
    pub(super) fn draw_visibility(&mut self, gl: &glow::Context) -> Result<()> {
        if self.visibility.is_none() && matches!(self.shadow_test(), ShadowTest::Slides) {
            let _pass = gl::pass(gl, "set-up: the visibility program");
            self.visibility = Some(with_shadow_test(gl, &self.shaders, "visibility.frag", &[])?);
        }
        let program = match self.shadow_test() {
            ShadowTest::Slides => self.visibility.as_ref().expect("made above"),
            ShadowTest::Offset(offset) => &offset.visibility,
            ShadowTest::Exact(exact) => &exact.visibility,
        };
        let _pass = gl::pass(gl, "the shadow test alone");
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [1.0; 4]);
        self.use_shadow_test(gl, program);
        self.draw_scene(gl, |mesh, _| {
            self.send_object(gl, program, mesh.object);
            true
        });
        Ok(())
    }

    pub(super) fn select_window(&self, gl: &glow::Context, [red, green, blue, alpha]: [f32; 4]) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            // DEVIATES: viewport, the window's whole size; the slides' 512×512 fills a corner of their 800×600.
            gl.viewport(0, 0, width, height);
        }
    }

    /// What every program with the shadow test needs: the depth texture on unit 1, and the stage of the slides.
    pub(super) fn set_shadow_test(&self, gl: &glow::Context, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE1);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.target.depth_texture));
        }
        program.set(gl, "shadowMap", 1);
        program.set(gl, "stage", self.stage_number());
        program.set(gl, "biasValue", self.settings.number("bias"));
        program.set(gl, "shadows", i32::from(self.settings.switch("shadows")));
        program.set(gl, "lightInvDir", self.light_inv_dir());
    }

    /// Towards the light, of length 1.
    fn light_inv_dir(&self) -> DVec3 {
        -self.light().direction.normalize()
    }

    fn normal_matrix(&self, object: &Object) -> DMat3 {
        let model = self.model_from_eye(object);
        DMat3::from_mat4(model).inverse().transpose()
    }

    /// "Send the usual MVP and depth MVP to shader".
    pub(super) fn set_transformations(
        &self,
        gl: &glow::Context,
        program: &Program,
        object: &Object,
    ) {
        let depth_bias_mvp = bias_matrix() * self.depth_mvp(object);
        program.set(gl, "MVP", self.mvp(object));
        program.set(gl, "DepthBiasMVP", depth_bias_mvp);
        program.set(gl, "normalMatrix", self.normal_matrix(object));
    }

    /// Each mesh of each model, with its present texture; `send` sends its transformation to the currently bound shader,
    /// and says whether it is to be drawn.
    #[doc(alias = "drawScene")]
    pub(super) fn draw_scene(
        &self,
        gl: &glow::Context,
        mut send: impl FnMut(&Mesh, glow::Texture) -> bool,
    ) {
        let mut bound = self.bound.take();
        for model in self.models[self.place()].iter().flatten() {
            let chosen = self.chosen_texture(&model.name);
            for mesh in &model.meshes {
                let texture = mesh.textures.get(chosen).unwrap_or(&mesh.textures[0]);
                if send(mesh, *texture) {
                    // The map's last mesh may be the picture's first.
                    if bound.replace(mesh.object) == Some(mesh.object) {
                        mesh.buffers.draw_again(gl);
                    } else {
                        mesh.buffers.draw(gl);
                    }
                }
            }
        }
        self.bound.set(bound);
    }
}
