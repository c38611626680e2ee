//! CS 541, assignment 5: shadows from a single light source by the two-pass shadow map algorithm.
//!
//! | the handout | here |
//! |---|---|
//! | Storing depth values as a texture | `shadow_buffer.rs` |
//! | Vertex and fragment shaders | `programs.rs`; `glsl/cs541/shadow.vert`, `shadow.frag` |
//! | First pass: drawing the shadow map | `first_pass.rs` |
//! | Second pass: using the shadow map | `second_pass.rs`; `glsl/cs541/lighting.vert`, `lighting.frag` |
//! | Shadow acne | the settings `remedy`, `epsilon`, `second_plane` |
//! | no part of it: the map at its best | `offset_test.rs`; `glsl/cs541/lighting_offset.frag` |
//! | no part of it: a test without a map | `exact_test.rs`; `glsl/cs541/lighting_exact.frag` |
//!
//! Chosen, because the handout leaves it to each student: the scene, the light's near and far, the step of each key,
//! the value of epsilon, and the distance of the second plane.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod draw_order;
mod exact_test;
mod explain;
mod first_pass;
mod offset_test;
mod programs;
mod scene;
mod second_pass;
mod settings;
mod shadow_buffer;
mod shadow_test;
mod stages;

use std::path::Path;

use glam::DVec3;
use glow::HasContext;

use super::chosen_test::{check_map, chosen_test};
use super::{
    Button, Explanation, Handout, Key, Lab, MapScale, Pointer, Probe, Settings, ShadowTexture, Show,
};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::picture::Projection;
use crate::scene::{Camera, Light, Object, Scene, rotate, shapes};
use draw_order::Outline;
use exact_test::Exact;
use first_pass::MapInputs;
use offset_test::Offset;
use programs::{Programs, SHADERS, unshadowed_program};
use second_pass::Sky;
use settings::{DRAG_STEP, EYE_STEP, FOV_STEP, KEYS, LIGHT_STEP, SETTINGS};
use shadow_buffer::{ShadowBuffer, ShadowBufferKind};
use shadow_test::ShadowTest;

pub static HANDOUT: Handout = Handout {
    name: "cs541",
    title: "CS 541, assignment 5: the two-pass shadow map, spot or point light",
    size: [500, 500],
    keys: KEYS,
    quit: None,
    settings: SETTINGS,
    shaders: programs::SHADERS,
    stages: stages::STAGES,
    comparisons: stages::COMPARISONS,
    lights: 1,
    set_bias: settings::set_bias,
    scene: scene::default_scene,
    start: |gl, scene, students| Ok(Box::new(Cs541::new(gl, scene, students)?)),
};

/// How far up or down the mouse turns the look, in degrees.
const STEEPEST: f64 = 89.0;

/// The lab's state.
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
    outlines: Vec<Outline>,

    shaders: Shaders,
    programs: Programs,
    /// The most texels that the driver allows along a side.
    largest_map: u32,
    shadow_buffer: ShadowBuffer,
    /// What the shadow map was drawn from, while that still holds.
    drawn: Option<MapInputs>,
    sky: Sky,

    /// What only the setting shadow_test asks for.
    offset: Option<Offset>,
    exact: Option<Exact>,
    /// What only shadows=off asks for.
    unshadowed: Option<Program>,
    /// Programs that only the measuring commands ask for.
    visibility: Option<Program>,
    explainer: Option<Program>,
}

impl Cs541 {
    fn new(gl: &glow::Context, scene: Scene, students: Option<&Path>) -> Result<Self> {
        let mut settings = Settings::new(SETTINGS);
        settings::take_light(&scene, &mut settings)?;
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let largest_map = gl::largest_texture(gl);
        let kind = ShadowBufferKind::new(largest_map, &settings);
        let shadow_buffer = ShadowBuffer::new(gl, kind)?;
        // The driver compiles on one core; what needs no driver is done on another: the textures' smaller levels, and
        // which meshes are solid.
        let pictures = scene.objects.iter().map(|object| &object.material.texture);
        let pictures = gl::distinct(pictures.chain([&scene.sky]).flatten());
        let (programs, (levels, outlines)) = std::thread::scope(|scope| {
            let levels = pictures.iter().map(|picture| gl::levels(picture));
            let outlines = scene
                .objects
                .iter()
                .map(|object| Outline::new(&object.mesh));
            let beside = || (levels.collect::<Vec<_>>(), outlines.collect::<Vec<_>>());
            let beside = scope.spawn(beside);
            let programs = Programs::new(gl, &shaders);
            (programs, beside.join().expect("it ends without panic"))
        });
        let programs = programs?;

        let _pass = gl::pass(gl, "set-up: meshes and textures");
        let white = gl::solid_texture(gl)?;
        let mut meshes = Vec::new();
        let mut textures = Vec::new();
        let mut sent = gl::Textures::default();
        let mut levels = levels.into_iter();
        let mut next = || levels.next().expect("each picture was averaged");
        for object in &scene.objects {
            meshes.push(gl::Mesh::new(gl, &object.name, &object.mesh)?);
            let name = format!("{}_texture", object.name);
            textures.push(match &object.material.texture {
                Some(picture) => sent.of(gl, &name, picture, &mut next)?,
                None => white,
            });
        }
        let sky = Sky {
            dome: gl::Mesh::new(gl, "dome", &shapes::sphere(20))?,
            texture: match &scene.sky {
                Some(picture) => Some(sent.of(gl, "sky_texture", picture, &mut next)?),
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
            outlines,
            shaders,
            programs,
            largest_map,
            shadow_buffer,
            drawn: None,
            sky,
            offset: None,
            exact: None,
            unshadowed: None,
            visibility: None,
            explainer: None,
        })
    }

    /// The first pass, if the map that it drew last does not serve on.
    fn prepare_shadow_map(&mut self, gl: &glow::Context) -> Result<()> {
        self.renew_shadow_buffer(gl)?;
        if self.settings.switch("shadows") {
            let inputs = self.map_inputs();
            let redraw = self.settings.choice("redraw") == "every_frame";
            if redraw || self.drawn.as_ref() != Some(&inputs) {
                self.draw_shadow_map(gl, &inputs);
                self.drawn = Some(inputs);
                // The offset test's map is no more.
                if let Some(offset) = &mut self.offset {
                    offset.test.forget();
                }
            }
        }
        Ok(())
    }

    /// The program for shadows=off. A student's own lighting shader has no such twin and draws it itself.
    fn prepare_unshadowed(&mut self, gl: &glow::Context) -> Result<()> {
        let wanted = !self.settings.switch("shadows") && !self.shaders.has_own("lighting.frag");
        if wanted && self.unshadowed.is_none() {
            self.unshadowed = Some(unshadowed_program(gl, &self.shaders)?);
        }
        Ok(())
    }

    /// Another texture, if the settings ask for another kind; says whether they do.
    fn renew_shadow_buffer(&mut self, gl: &glow::Context) -> Result<bool> {
        let kind = ShadowBufferKind::new(self.largest_map, &self.settings);
        let renewed = kind != self.shadow_buffer.kind;
        if renewed {
            self.shadow_buffer.delete(gl);
            self.shadow_buffer = ShadowBuffer::new(gl, kind)?;
            self.drawn = None;
        }
        Ok(renewed)
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
        self.prepare_shadow_test(gl)?;
        match show {
            Show::Picture => {
                self.prepare_unshadowed(gl)?;
                self.draw_scene(gl);
            }
            Show::FlatMap { depth, .. } => {
                let flat = gl::flat_depths(gl, self.shadow_buffer.kind.size, depth)?;
                let map = &mut self.shadow_buffer.depth_texture_buffer;
                let own = std::mem::replace(map, flat);
                self.draw_scene(gl);
                self.shadow_buffer.depth_texture_buffer = own;
                unsafe { gl.delete_texture(flat) };
            }
            Show::Visibility { .. } => self.draw_visibility(gl)?,
        }
        Ok(())
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        let programs = Programs::new(gl, &self.shaders)?;
        let offset = self.offset.as_mut().map(|o| o.reload(gl, &self.shaders));
        let exact = self.exact.as_mut().map(|e| e.reload(gl, &self.shaders));
        for reloaded in [offset, exact].into_iter().flatten() {
            reloaded.inspect_err(|_| programs.delete(gl))?;
        }
        std::mem::replace(&mut self.programs, programs).delete(gl);
        let made_on_demand = [
            self.unshadowed.take(),
            self.visibility.take(),
            self.explainer.take(),
        ];
        for program in made_on_demand.into_iter().flatten() {
            program.delete(gl);
        }
        // The map was drawn by the old shaders.
        self.drawn = None;
        if let Some(offset) = &mut self.offset {
            offset.test.forget();
        }
        Ok(())
    }

    fn has_students_test(&self) -> bool {
        chosen_test(&self.settings) == "handout" && self.shaders.has_own("lighting.frag")
    }

    fn shadow_texture(&self, _light: usize) -> Result<ShadowTexture> {
        check_map(&self.settings)?;
        let Light { near, far, .. } = *self.light();
        let (share, [near, far], bias) = match self.shadow_test() {
            ShadowTest::Offset(offset) => (offset.test.share(), offset.test.planes(), 0.0),
            _ => ([1.0; 2], [near, far], self.epsilon()),
        };
        Ok(ShadowTexture {
            texture: self.shadow_buffer.depth_texture_buffer,
            scale: MapScale {
                size: self.shadow_buffer.kind.size,
                share,
                projection: Projection::Perspective,
                near,
                far,
                bias,
            },
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

    fn explain(&mut self, gl: &glow::Context, probe: Probe, _light: usize) -> Result<Explanation> {
        self.explain_at(gl, probe)
    }
}
