//! CS 541, assignment 5: shadows from a single light source by the two-pass shadow map algorithm.
//!
//! | the handout | here |
//! |---|---|
//! | Storing depth values as a texture | [`ShadowBuffer::new`] |
//! | Vertex and fragment shaders | `glsl/cs541/shadow.vert`, `shadow.frag` |
//! | First pass: drawing the shadow map | [`Cs541::draw_shadow_map`] |
//! | Second pass: using the shadow map | [`Cs541::draw_scene`], `glsl/cs541/lighting.vert`, `lighting.frag` |
//! | Shadow acne | the settings `remedy`, `epsilon`, `second_plane`; [`Cs541::draw_shadow_map`] |
//!
//! Chosen, because the handout leaves it to each student: the scene, the light's near and far, the step of each key,
//! the value of epsilon, and the distance of the second plane.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod explain;
mod scene;
mod settings;

use std::path::Path;

use glam::{DMat3, DMat4, DVec3};
use glow::{HasContext, PixelUnpackData};

use super::{
    Button, Explanation, Handout, Key, Lab, MapScale, Pointer, Probe, Settings, ShadowTexture, Show,
};
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::scene::{
    Beam, Camera, Fov, Light, LightKind, Material, Object, Scene, camera, rotate, shapes,
};
use crate::{Error, Result};
use settings::{DRAG_STEP, EYE_STEP, FOV_STEP, KEYS, LIGHT_STEP, SETTINGS};

pub static HANDOUT: Handout = Handout {
    name: "cs541",
    title: "CS 541, assignment 5: the two-pass shadow map, spot or point light",
    size: [500, 500],
    keys: KEYS,
    settings: SETTINGS,
    lights: 1,
    set_bias,
    scene: scene::default_scene,
    start: |gl, scene, students| Ok(Box::new(Cs541::new(gl, scene, students)?)),
};

/// The shaders, which are the lesson's other half.
const SHADERS: &[(&str, &str)] = &[
    (
        "shadow.vert",
        include_str!("../../../glsl/cs541/shadow.vert"),
    ),
    (
        "shadow.frag",
        include_str!("../../../glsl/cs541/shadow.frag"),
    ),
    (
        "lighting.vert",
        include_str!("../../../glsl/cs541/lighting.vert"),
    ),
    (
        "lighting.frag",
        include_str!("../../../glsl/cs541/lighting.frag"),
    ),
    (
        "visibility.frag",
        include_str!("../../../glsl/cs541/visibility.frag"),
    ),
    (
        "explain.frag",
        include_str!("../../../glsl/cs541/explain.frag"),
    ),
    ("unlit.vert", include_str!("../../../glsl/cs541/unlit.vert")),
    ("unlit.frag", include_str!("../../../glsl/cs541/unlit.frag")),
];

/// Uniforms that both passes and the sky have.
const MATRICES: [&str; 3] = ["persp_matrix", "view_matrix", "model_matrix"];
/// Uniforms of the shadow test.
const SHADOW_TEST: [&str; 6] = [
    "shadow_persp_matrix",
    "shadow_view_matrix",
    "shadow_sampler",
    "epsilon",
    "shadows",
    "beam",
];

/// How far behind a Plane its second copy stands, in world units.
const SECOND_PLANE_OFFSET: f64 = 0.05;
/// The radius of the sphere that shows where the light is, in world units.
const MARKER_RADIUS: f64 = 0.12;
/// How far up or down the mouse turns the look, in degrees.
const STEEPEST: f64 = 89.0;

/// The lab's state, grouped by pass.
struct Cs541 {
    scene: Scene,
    settings: Settings,
    size: [u32; 2],
    /// In seconds; stands still while `rotation` is off.
    time: f64,
    look_from_light: bool,

    /// What both passes draw: one mesh and one texture for each object of the scene.
    meshes: Vec<gl::Mesh>,
    textures: Vec<glow::Texture>,

    first_pass: FirstPass,
    second_pass: SecondPass,
    sky: Sky,
    shaders: Shaders,
    /// Made when the first explanation is asked for.
    explainer: Option<Program>,
}

struct FirstPass {
    program: Program,
    buffer: ShadowBuffer,
    /// What the map was drawn from, while that still holds.
    drawn: Option<MapInputs>,
}

struct SecondPass {
    program: Program,
    visibility: Program,
}

struct Sky {
    program: Program,
    dome: gl::Mesh,
    texture: Option<glow::Texture>,
    marker_texture: glow::Texture,
}

/// Everything that decides what the shadow map holds.
#[derive(PartialEq)]
struct MapInputs {
    view_matrix: DMat4,
    persp_matrix: DMat4,
    model_matrices: Vec<DMat4>,
    front_face_culling: bool,
}

// ---- Storing depth values as a texture -----------------------------------------------------------------------------

/// A framebuffer object with depth and no color, and the texture that stores its depth values.
struct ShadowBuffer {
    frame_buffer: glow::Framebuffer,
    depth_texture_buffer: glow::Texture,
    kind: ShadowBufferKind,
}

#[derive(Clone, Copy, PartialEq)]
struct ShadowBufferKind {
    size: u32,
    depth_format: &'static str,
    filter: &'static str,
}

impl ShadowBuffer {
    #[doc(alias = "glGenFramebuffers")]
    fn new(gl: &glow::Context, kind: ShadowBufferKind) -> Result<Self> {
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

    fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_framebuffer(self.frame_buffer);
            gl.delete_texture(self.depth_texture_buffer);
        }
    }
}

// ---- Set-up ----------------------------------------------------------------------------------------------------------

impl Cs541 {
    fn new(gl: &glow::Context, scene: Scene, students: Option<&Path>) -> Result<Self> {
        let mut settings = Settings::new(SETTINGS);
        take_light(&scene, &mut settings)?;
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let first_pass = FirstPass {
            buffer: ShadowBuffer::new(gl, shadow_buffer_kind(gl, &settings))?,
            program: shadow_program(gl, &shaders)?,
            drawn: None,
        };
        let second_pass = SecondPass {
            program: lighting_program(gl, &shaders)?,
            visibility: visibility_program(gl, &shaders)?,
        };

        let _pass = gl::pass(gl, "set-up: meshes and textures");
        let white = gl::solid_texture(gl)?;
        let mut meshes = Vec::new();
        let mut textures = Vec::new();
        for object in &scene.objects {
            meshes.push(gl::Mesh::new(gl, &object.name, &object.mesh)?);
            textures.push(match &object.material.texture {
                Some(picture) => gl::texture(gl, &format!("{}_texture", object.name), picture)?,
                None => white,
            });
        }
        let sky = Sky {
            program: unlit_program(gl, &shaders)?,
            dome: gl::Mesh::new(gl, "dome", &shapes::sphere(20))?,
            texture: match &scene.sky {
                Some(picture) => Some(gl::texture(gl, "sky_texture", picture)?),
                None => None,
            },
            marker_texture: white,
        };
        unsafe { gl.enable(glow::DEPTH_TEST) };
        Ok(Self {
            scene,
            settings,
            size: HANDOUT.size,
            time: 0.0,
            look_from_light: false,
            meshes,
            textures,
            first_pass,
            second_pass,
            sky,
            shaders,
            explainer: None,
        })
    }
}

/// The scene's light decides where the settings start.
fn take_light(scene: &Scene, settings: &mut Settings) -> Result<()> {
    let [light] = &scene.lights[..] else {
        let found = scene.lights.len();
        return Err(Error::usage(format!(
            "the scene has {found} lights, expected 1: cs541 has a single light source"
        )));
    };
    match light.kind {
        LightKind::Spot { cone, beam } => {
            let beam = match beam {
                Beam::Rectangular => "rectangular",
                Beam::Circular => "circular",
            };
            settings.set("light=spot")?;
            settings.set(&format!("beam={beam}"))?;
            settings.set(&format!("spot_angle={cone}"))
        }
        LightKind::Point { shadow_fov } => {
            settings.set("light=point")?;
            settings.set(&format!("shadow_fov={shadow_fov}"))
        }
        LightKind::Directional { .. } => Err(Error::usage(
            "the scene has a directional light, expected spot or point: cs541 draws no other",
        )),
    }
}

fn shadow_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the shadow shader program");
    let program = Program::new(gl, shaders, "shadow.vert", "shadow.frag", &MATRICES)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "shadow_program",
    );
    Ok(program)
}

fn lighting_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting shader program");
    let lighting = [
        "normal_matrix",
        "eye_position",
        "light_position",
        "ambient_color",
        "light_color",
        "diffuse_color",
        "specular_color",
        "shininess",
        "usampler",
    ];
    let uniforms = [&MATRICES[..], &SHADOW_TEST, &lighting].concat();
    let program = Program::new(gl, shaders, "lighting.vert", "lighting.frag", &uniforms)?;
    name_object(ObjectKind::Program, program.handle.0.get(), "program");
    Ok(program)
}

fn visibility_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the visibility shader program");
    let uniforms = [&MATRICES[..], &SHADOW_TEST].concat();
    let program = Program::new(gl, shaders, "lighting.vert", "visibility.frag", &uniforms)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "visibility_program",
    );
    Ok(program)
}

fn unlit_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let uniforms = [&MATRICES[..], &["diffuse_color", "usampler"]].concat();
    let program = Program::new(gl, shaders, "unlit.vert", "unlit.frag", &uniforms)?;
    name_object(ObjectKind::Program, program.handle.0.get(), "sky_program");
    Ok(program)
}

/// The shadow map that the settings ask for, no larger than the driver allows.
fn shadow_buffer_kind(gl: &glow::Context, settings: &Settings) -> ShadowBufferKind {
    let most = unsafe { gl.get_parameter_i32(glow::MAX_TEXTURE_SIZE) };
    ShadowBufferKind {
        size: settings.number("map_size").min(f64::from(most)) as u32,
        depth_format: settings.choice("depth_format"),
        filter: settings.choice("filter"),
    }
}

// ---- First pass: drawing the shadow map ------------------------------------------------------------------------------

impl Cs541 {
    /// The kind of light that the settings ask for.
    fn light_kind(&self) -> LightKind {
        match self.settings.choice("light") {
            "point" => LightKind::Point {
                shadow_fov: self.settings.number("shadow_fov"),
            },
            _ => LightKind::Spot {
                cone: self.settings.number("spot_angle"),
                beam: match self.settings.choice("beam") {
                    "circular" => Beam::Circular,
                    _ => Beam::Rectangular,
                },
            },
        }
    }

    /// The camera with its center of projection at the light.
    fn light_camera(&self) -> Camera {
        let light = self.light();
        let fov = match self.settings.choice("light") {
            "point" => self.settings.number("shadow_fov"),
            _ => self.settings.number("spot_angle"),
        };
        Camera {
            eye: light.position,
            look: light.direction,
            rup: camera::up_for(light.direction),
            fov: Fov::Horizontal(fov),
            near: light.near,
            far: Some(light.far),
        }
    }

    /// Each mesh that casts a shadow, with its model matrix in world space.
    fn casters(&self) -> Vec<(usize, DMat4)> {
        let mut casters = Vec::new();
        for (index, object) in self.scene.objects.iter().enumerate() {
            if !object.casts {
                continue;
            }
            let model = object.model(self.time);
            casters.push((index, model));
            if object.plane && self.settings.switch("second_plane") {
                casters.push((index, second_plane(model)));
            }
        }
        casters
    }

    fn map_inputs(&self) -> MapInputs {
        let light = self.light_camera();
        // DEVIATES: origin, the products of the matrices stay in GLSL and in f32 as the handout has them, but the
        // world's origin is moved (in f64) to the light here and to the eye in the second pass: far from the origin
        // the numbers would otherwise cancel and the shadows dissolve.
        let to_light = DMat4::from_translation(-light.eye);
        MapInputs {
            view_matrix: camera::view(DVec3::ZERO, light.look, light.rup),
            persp_matrix: light.perspective(1.0),
            model_matrices: self
                .casters()
                .iter()
                .map(|(_, model)| to_light * *model)
                .collect(),
            front_face_culling: matches!(self.settings.choice("remedy"), "culling" | "both"),
        }
    }

    fn draw_shadow_map(&self, gl: &glow::Context, inputs: &MapInputs) {
        let _pass = gl::pass(gl, "first pass: drawing the shadow map");
        let FirstPass {
            program, buffer, ..
        } = &self.first_pass;
        let size = buffer.kind.size as i32;
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(buffer.frame_buffer));
            gl.viewport(0, 0, size, size);
            gl.use_program(Some(program.handle));
            gl.clear(glow::DEPTH_BUFFER_BIT);
            if inputs.front_face_culling {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::FRONT);
            }

            program.set(gl, "persp_matrix", inputs.persp_matrix);
            program.set(gl, "view_matrix", inputs.view_matrix);
            for ((index, _), model_matrix) in self.casters().iter().zip(&inputs.model_matrices) {
                program.set(gl, "model_matrix", *model_matrix);
                self.meshes[*index].draw(gl);
            }

            if inputs.front_face_culling {
                gl.disable(glow::CULL_FACE);
            }
            // Done with the shadow map: select the default frame buffer, that is, the window.
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        }
    }
}

/// The remedy with epsilon in place of the one without, and that epsilon.
fn set_bias(settings: &mut Settings, bias: f64) -> Result<()> {
    match settings.choice("remedy") {
        "none" => settings.set("remedy=epsilon")?,
        "culling" => settings.set("remedy=both")?,
        _ => (),
    }
    settings.set(&format!("epsilon={bias}"))
}

/// The second copy of a Plane: a small amount behind the first one, facing the other way.
fn second_plane(model: DMat4) -> DMat4 {
    let normal = DMat3::from_mat4(model).inverse().transpose() * DVec3::Z;
    DMat4::from_translation(-SECOND_PLANE_OFFSET * normal.normalize())
        * model
        * rotate(180.0, DVec3::X)
}

// ---- Second pass: using the shadow map -------------------------------------------------------------------------------

/// `beam` in the shaders.
const NO_BEAM: i32 = 0;
const RECTANGULAR: i32 = 1;
const CIRCULAR: i32 = 2;

impl Cs541 {
    fn light(&self) -> &Light {
        &self.scene.lights[0]
    }

    /// The user's camera, or the light's while `x` is on.
    fn camera(&self) -> Camera {
        if self.look_from_light {
            let Camera { near, far, .. } = self.scene.camera;
            Camera {
                near,
                far,
                ..self.light_camera()
            }
        } else {
            self.scene.camera
        }
    }

    fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    fn beam(&self) -> i32 {
        match (self.settings.choice("light"), self.settings.choice("beam")) {
            ("point", _) => NO_BEAM,
            (_, "circular") => CIRCULAR,
            _ => RECTANGULAR,
        }
    }

    fn epsilon(&self) -> f64 {
        match self.settings.choice("remedy") {
            "epsilon" | "both" => self.settings.number("epsilon"),
            _ => 0.0,
        }
    }

    fn draw_scene(&self, gl: &glow::Context) {
        let _pass = gl::pass(gl, "second pass: using the shadow map");
        let [red, green, blue] = self.scene.clear.as_vec3().to_array();
        self.select_window(gl, [red, green, blue, 1.0]);
        self.draw_sky(gl);

        let program = &self.second_pass.program;
        let eye = self.camera().eye;
        let Light {
            position, color, ..
        } = *self.light();
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_map(gl, program);
        program.set(gl, "usampler", 0);
        program.set(gl, "eye_position", DVec3::ZERO);
        program.set(gl, "light_position", position - eye);
        program.set(gl, "light_color", color);
        program.set(gl, "ambient_color", self.scene.ambient);
        unsafe { gl.active_texture(glow::TEXTURE0) };
        for (index, object) in self.scene.objects.iter().enumerate() {
            let Material {
                diffuse,
                specular,
                shininess,
                ..
            } = object.material;
            unsafe { gl.bind_texture(glow::TEXTURE_2D, Some(self.textures[index])) };
            let model = self.model_from(eye, object);
            program.set(gl, "model_matrix", model);
            program.set(
                gl,
                "normal_matrix",
                DMat3::from_mat4(model).inverse().transpose(),
            );
            program.set(gl, "diffuse_color", diffuse);
            program.set(gl, "specular_color", specular);
            program.set(gl, "shininess", shininess);
            self.meshes[index].draw(gl);
        }
    }

    fn draw_visibility(&self, gl: &glow::Context) {
        let _pass = gl::pass(gl, "second pass: the shadow test alone");
        self.select_window(gl, [1.0; 4]);
        let program = &self.second_pass.visibility;
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_map(gl, program);
        let eye = self.camera().eye;
        for (mesh, object) in self.meshes.iter().zip(&self.scene.objects) {
            program.set(gl, "model_matrix", self.model_from(eye, object));
            mesh.draw(gl);
        }
    }

    /// The viewport reset to the window's size; framebuffer 0 is bound ever since the last first pass.
    fn select_window(&self, gl: &glow::Context, [red, green, blue, alpha]: [f32; 4]) {
        let [width, height] = self.size.map(|n| n as i32);
        unsafe {
            gl.viewport(0, 0, width, height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    /// What every program with the shadow test needs: both cameras, the map on texture unit 1, the test's settings.
    fn use_shadow_map(&self, gl: &glow::Context, program: &Program) {
        unsafe {
            gl.active_texture(glow::TEXTURE1);
            gl.bind_texture(
                glow::TEXTURE_2D,
                Some(self.first_pass.buffer.depth_texture_buffer),
            );
        }
        program.set(gl, "shadow_sampler", 1);
        program.set(gl, "epsilon", self.epsilon());
        program.set(gl, "shadows", i32::from(self.settings.switch("shadows")));
        program.set(gl, "beam", self.beam());

        let camera = self.camera();
        program.set(gl, "persp_matrix", camera.perspective(self.aspect()));
        program.set(
            gl,
            "view_matrix",
            camera::view(DVec3::ZERO, camera.look, camera.rup),
        );

        let light = self.light_camera();
        let view = camera::view(light.eye - camera.eye, light.look, light.rup);
        program.set(gl, "shadow_persp_matrix", light.perspective(1.0));
        program.set(gl, "shadow_view_matrix", view);
    }

    /// Object space to a world whose origin is at `eye`.
    fn model_from(&self, eye: DVec3, object: &Object) -> DMat4 {
        DMat4::from_translation(-eye) * object.model(self.time)
    }

    /// The sky dome, around the eye and behind everything, and the marker that shows where the light is.
    fn draw_sky(&self, gl: &glow::Context) {
        let Sky {
            program,
            dome,
            texture,
            marker_texture,
        } = &self.sky;
        let camera = self.camera();
        let dome_planes = Camera {
            near: 0.01,
            far: None,
            ..camera
        };
        unsafe {
            gl.use_program(Some(program.handle));
            gl.active_texture(glow::TEXTURE0);
        }
        program.set(gl, "usampler", 0);
        program.set(
            gl,
            "view_matrix",
            camera::view(DVec3::ZERO, camera.look, camera.rup),
        );
        if let Some(texture) = texture {
            unsafe {
                gl.bind_texture(glow::TEXTURE_2D, Some(*texture));
                gl.depth_mask(false);
            }
            program.set(gl, "persp_matrix", dome_planes.perspective(self.aspect()));
            // The sphere's poles are on z; the sky's are up and down.
            program.set(gl, "model_matrix", rotate(-90.0, DVec3::X));
            program.set(gl, "diffuse_color", DVec3::ONE);
            dome.draw(gl);
            unsafe { gl.depth_mask(true) };
        }
        let light = &self.light();
        let offset = light.position - camera.eye;
        // From within, the marker would hide everything.
        if offset.length() > 2.0 * MARKER_RADIUS {
            unsafe { gl.bind_texture(glow::TEXTURE_2D, Some(*marker_texture)) };
            let model =
                DMat4::from_translation(offset) * DMat4::from_scale(DVec3::splat(MARKER_RADIUS));
            program.set(gl, "persp_matrix", camera.perspective(self.aspect()));
            program.set(gl, "model_matrix", model);
            program.set(gl, "diffuse_color", light.color);
            dome.draw(gl);
        }
    }
}

/// The camera's look after a turn to the left about the up vector and then upwards, in degrees.
fn turned(camera: &Camera, left: f64, up: f64) -> DVec3 {
    let look = rotate(left, camera.rup).transform_vector3(camera.look.normalize());
    let right = look.cross(camera.rup);
    // Straight up and straight down have no right: the look stops short of them.
    let elevation = 90.0 - look.angle_between(camera.rup).to_degrees();
    let up = (elevation + up).clamp(-STEEPEST, STEEPEST) - elevation;
    rotate(up, right).transform_vector3(look)
}

// ---- The seam --------------------------------------------------------------------------------------------------------

impl Lab for Cs541 {
    fn settings(&mut self) -> &mut Settings {
        &mut self.settings
    }

    #[doc(alias = "keypress")]
    fn key(&mut self, key: Key) -> bool {
        let camera = &mut self.scene.camera;
        let light = &mut self.scene.lights[0];
        let forward = EYE_STEP * camera.look.normalize();
        let right = EYE_STEP * camera.look.cross(camera.rup).normalize();
        let up = EYE_STEP * camera.rup.normalize();
        match key {
            Key::Char('w') => camera.eye += forward,
            Key::Char('s') => camera.eye -= forward,
            Key::Char('d') => camera.eye += right,
            Key::Char('a') => camera.eye -= right,
            Key::Char('q') => camera.eye += up,
            Key::Char('e') => camera.eye -= up,
            Key::Left => light.position -= LIGHT_STEP * DVec3::X,
            Key::Right => light.position += LIGHT_STEP * DVec3::X,
            Key::Up => light.position -= LIGHT_STEP * DVec3::Z,
            Key::Down => light.position += LIGHT_STEP * DVec3::Z,
            Key::PageUp => light.position += LIGHT_STEP * DVec3::Y,
            Key::PageDown => light.position -= LIGHT_STEP * DVec3::Y,
            Key::Char('o') => camera.fov = camera.fov.widened(-FOV_STEP),
            Key::Char('p') => camera.fov = camera.fov.widened(FOV_STEP),
            Key::Char('x') => self.look_from_light = !self.look_from_light,
            Key::Tab => {
                light.position = camera.eye;
                light.direction = camera.look;
            }
            _ => return false,
        }
        true
    }

    #[doc(alias = "mousedrag")]
    fn pointer(&mut self, pointer: Pointer) -> bool {
        let camera = &mut self.scene.camera;
        match pointer {
            Pointer::Drag {
                button: Button::Left,
                dx,
                dy,
            } => {
                camera.look = turned(
                    camera,
                    -DRAG_STEP * f64::from(dx),
                    -DRAG_STEP * f64::from(dy),
                )
            }
            Pointer::Wheel(steps) => camera.fov = camera.fov.widened(-FOV_STEP * f64::from(steps)),
            _ => return false,
        }
        true
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
    }

    fn advance(&mut self, dt: f64) {
        if self.settings.switch("rotation") {
            self.time += dt;
        }
    }

    fn moves(&self) -> bool {
        let spins = |object: &Object| {
            object
                .spin
                .is_some_and(|spin| spin.degrees_per_second != 0.0)
        };
        self.settings.switch("rotation") && self.scene.objects.iter().any(spins)
    }

    #[doc(alias = "draw")]
    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        let kind = shadow_buffer_kind(gl, &self.settings);
        if kind != self.first_pass.buffer.kind {
            self.first_pass.buffer.delete(gl);
            self.first_pass.buffer = ShadowBuffer::new(gl, kind)?;
            self.first_pass.drawn = None;
        }
        if self.settings.switch("shadows") {
            let inputs = self.map_inputs();
            let redraw = self.settings.choice("redraw") == "every_frame";
            if redraw || self.first_pass.drawn.as_ref() != Some(&inputs) {
                self.draw_shadow_map(gl, &inputs);
                self.first_pass.drawn = Some(inputs);
            }
        }
        match show {
            Show::Picture => self.draw_scene(gl),
            Show::Visibility { .. } => self.draw_visibility(gl),
        }
        Ok(())
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        // All of them or none: a lab never draws with half a reload.
        let mut programs = Vec::new();
        for make in [
            shadow_program,
            lighting_program,
            visibility_program,
            unlit_program,
        ] {
            match make(gl, &self.shaders) {
                Ok(program) => programs.push(program),
                Err(error) => {
                    programs.iter().for_each(|program| program.delete(gl));
                    return Err(error);
                }
            }
        }
        let kept = [
            &mut self.first_pass.program,
            &mut self.second_pass.program,
            &mut self.second_pass.visibility,
            &mut self.sky.program,
        ];
        for (kept, program) in kept.into_iter().zip(programs) {
            std::mem::replace(kept, program).delete(gl);
        }
        if let Some(explainer) = self.explainer.take() {
            explainer.delete(gl);
        }
        // The map was drawn by the old shaders.
        self.first_pass.drawn = None;
        Ok(())
    }

    fn shadow_texture(&self, _light: usize) -> Result<ShadowTexture> {
        if !self.settings.switch("shadows") {
            return Err(Error::usage(
                "shadows=off draws no shadow map, expected shadows=on",
            ));
        }
        let ShadowBuffer {
            depth_texture_buffer,
            kind,
            ..
        } = self.first_pass.buffer;
        let Light { near, far, .. } = *self.light();
        Ok(ShadowTexture {
            texture: depth_texture_buffer,
            size: [kind.size; 2],
            near,
            far,
        })
    }

    fn now(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.camera = self.camera();
        scene.lights[0].kind = self.light_kind();
        for object in &mut scene.objects {
            object.placement = object.model(self.time);
            object.spin = None;
        }
        scene
    }

    fn map_scale(&self, _light: usize) -> Option<MapScale> {
        let Light { near, far, .. } = *self.light();
        self.settings.switch("shadows").then(|| MapScale {
            size: self.first_pass.buffer.kind.size,
            near,
            far,
            bias: self.epsilon(),
        })
    }

    fn explain(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        self.explain_at(gl, probe)
    }
}
