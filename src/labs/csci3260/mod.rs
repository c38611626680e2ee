//! CSCI 3260, tutorial 8: OBJ models, and the shadows of a directional light by shadow mapping.
//!
//! | the slides | here |
//! |---|---|
//! | Load model | `models.rs`: `load_obj`, `load_texture` |
//! | Rendering the shadow map | `shadow_map.rs`; `glsl/csci3260/ShadowVertexShader.glsl`, `ShadowFragmentShader.glsl` |
//! | Using the shadow map | `basic_shader.rs`; `glsl/csci3260/VertexShaderCode.glsl`, `FragmentShaderCode.glsl` |
//! | Shadow acne, Peter Panning, PCF | the settings `stage`, `bias`, `scene` |
//! | no part of them: the map at its best | `offset_test.rs`; `glsl/csci3260/FragmentShaderCode_offset.glsl` |
//! | no part of them: a test without a map | `exact_test.rs`; `glsl/csci3260/FragmentShaderCode_exact.glsl` |
//!
//! Chosen, because the slides leave it open: the clear color, the light's colors, the steps of the keys, the room, and
//! the taps of PCF, of which the slides have only the name: the mean of five.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod basic_shader;
mod exact_test;
mod explain;
mod models;
mod offset_test;
mod scene;
mod settings;
mod shadow_map;
mod shadow_test;
mod stages;

use std::cell::Cell;
use std::path::Path;

use glam::{DMat4, DVec3};
use glow::HasContext;

use super::chosen_test::{check_map, chosen_test};
use super::{
    Button, Explanation, Handout, Key, Lab, MapScale, Pointer, Probe, Settings, ShadowTexture, Show,
};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::picture::Projection;
use crate::scene::{Camera, Light, Object, Scene, rotate};
use crate::shadow_tests;
use exact_test::Exact;
use models::Model;
use offset_test::Offset;
use settings::{DOLPHIN_STEP, DOLPHIN_TURN, DRAG_STEP, INTENSITY_STEP, KEYS, SETTINGS};
use shadow_map::{MapInputs, RenderTarget};
use shadow_test::ShadowTest;

pub static HANDOUT: Handout = Handout {
    name: "csci3260",
    title: "CSCI 3260, tutorial 8: shadow mapping of a directional light",
    size: [800, 600],
    keys: KEYS,
    quit: None,
    settings: SETTINGS,
    shaders: SHADERS,
    stages: stages::STAGES,
    comparisons: stages::COMPARISONS,
    lights: 1,
    set_bias: settings::set_bias,
    scene: scene::course,
    start: |gl, scene, students| Ok(Box::new(Csci3260::initialized_gl(gl, scene, students)?)),
};

/// The shaders, which are the lesson's other half.
const SHADERS: &[(&str, &str)] = &[
    (
        "ShadowVertexShader.glsl",
        include_str!("../../../glsl/csci3260/ShadowVertexShader.glsl"),
    ),
    (
        "ShadowFragmentShader.glsl",
        include_str!("../../../glsl/csci3260/ShadowFragmentShader.glsl"),
    ),
    (
        "VertexShaderCode.glsl",
        include_str!("../../../glsl/csci3260/VertexShaderCode.glsl"),
    ),
    (
        "FragmentShaderCode.glsl",
        include_str!("../../../glsl/csci3260/FragmentShaderCode.glsl"),
    ),
    (
        "visibility.frag",
        include_str!("../../../glsl/csci3260/visibility.frag"),
    ),
    (
        "explain.frag",
        include_str!("../../../glsl/csci3260/explain.frag"),
    ),
    (
        "FragmentShaderCode_exact.glsl",
        include_str!("../../../glsl/csci3260/FragmentShaderCode_exact.glsl"),
    ),
    (
        "visibility_exact.frag",
        include_str!("../../../glsl/csci3260/visibility_exact.frag"),
    ),
    (
        "FragmentShaderCode_offset.glsl",
        include_str!("../../../glsl/csci3260/FragmentShaderCode_offset.glsl"),
    ),
    (
        "visibility_offset.frag",
        include_str!("../../../glsl/csci3260/visibility_offset.frag"),
    ),
    shadow_tests::SHADERS[0],
    shadow_tests::SHADERS[1],
    shadow_tests::SHADERS[2],
    shadow_tests::SHADERS[3],
];

/// The numbers of the two scenes, the course's (or a student's) and the room.
const COURSE: usize = 0;
const ROOM: usize = 1;

/// How far up or down the mouse orbits, in degrees.
const STEEPEST: f64 = 89.0;

struct Csci3260 {
    scenes: [Scene; 2],
    settings: Settings,
    size: [u32; 2],
    /// In seconds; stands still while `rotation` is off.
    time: f64,
    dolphin_texture: usize,
    sea_texture: usize,

    /// What both passes draw, of each scene; None until it is first drawn.
    models: [Option<Vec<Model>>; 2],
    /// The object that this frame has drawn last.
    bound: Cell<Option<usize>>,

    shaders: Shaders,
    programs: Programs,
    /// The most texels that the driver allows along a side.
    largest_map: u32,
    target: RenderTarget,
    /// What the shadow map was drawn from, while that still holds.
    drawn: Option<MapInputs>,

    /// What only the setting shadow_test asks for.
    offset: Option<Offset>,
    exact: Option<Exact>,
    /// Programs that only the measuring commands ask for.
    visibility: Option<Program>,
    explainer: Option<Program>,
}

struct Programs {
    basic: Program,
    shadow_map: Program,
}

impl Programs {
    /// Both or none: a lab never draws with half of its shaders.
    fn install(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let basic = basic_shader::install_shaders(gl, shaders)?;
        let shadow_map = shadow_map::install_shadow_map_shaders(gl, shaders)
            .inspect_err(|_| basic.delete(gl))?;
        Ok(Self { basic, shadow_map })
    }
}

impl Csci3260 {
    #[doc(alias = "initializedGL")]
    fn initialized_gl(gl: &glow::Context, scene: Scene, students: Option<&Path>) -> Result<Self> {
        settings::area(&scene)?;
        let settings = Settings::new(SETTINGS);
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let largest_map = gl::largest_texture(gl);
        let target = RenderTarget::new(gl, map_size(largest_map, &settings))?;
        let programs = Programs::install(gl, &shaders)?;
        unsafe { gl.enable(glow::DEPTH_TEST) };
        let mut lab = Self {
            scenes: [scene, scene::room()],
            settings,
            size: HANDOUT.size,
            time: 0.0,
            dolphin_texture: 0,
            sea_texture: 0,
            models: [None, None],
            bound: Cell::new(None),
            shaders,
            programs,
            largest_map,
            target,
            drawn: None,
            offset: None,
            exact: None,
            visibility: None,
            explainer: None,
        };
        lab.send_data_to_opengl(gl)?;
        Ok(lab)
    }

    /// Models and textures of the present scene, if it has not been drawn yet.
    #[doc(alias = "sendDataToOpenGL")]
    fn send_data_to_opengl(&mut self, gl: &glow::Context) -> Result<()> {
        let place = self.place();
        if self.models[place].is_none() {
            let _pass = gl::pass(gl, "set-up: models and textures");
            let models = Model::of_scene(gl, self.scene(), scene::second_texture)?;
            self.models[place] = Some(models);
        }
        Ok(())
    }

    /// Which of the two scenes is drawn.
    fn place(&self) -> usize {
        match self.settings.choice("scene") {
            "room" => ROOM,
            _ => COURSE,
        }
    }

    fn scene(&self) -> &Scene {
        &self.scenes[self.place()]
    }

    fn light(&self) -> &Light {
        &self.scene().lights[0]
    }

    fn area(&self) -> [f64; 4] {
        settings::area(self.scene()).expect("a scene of another light was refused")
    }

    fn chosen_texture(&self, model: &str) -> usize {
        match model {
            "dolphin" => self.dolphin_texture,
            "sea" => self.sea_texture,
            _ => 0,
        }
    }

    /// Applies a movement of the world to the dolphin, about where it stands.
    fn move_dolphin(&mut self, movement: impl Fn(&Object) -> DMat4) {
        let place = self.place();
        let objects = self.scenes[place].objects.iter_mut();
        for object in objects.filter(|object| object.name == "dolphin") {
            let here = DMat4::from_translation(object.placement.w_axis.truncate());
            object.placement = here * movement(object) * here.inverse() * object.placement;
        }
    }

    /// Forward is where the beak points: −y in the model.
    fn swim(&mut self, distance: f64) {
        self.move_dolphin(|dolphin| {
            let forward = dolphin.placement.transform_vector3(DVec3::NEG_Y);
            DMat4::from_translation(distance * forward.normalize())
        });
    }

    #[doc(alias = "paintGL")]
    fn paint_gl(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.send_data_to_opengl(gl)?;
        self.bound.set(None);
        self.prepare_shadow_test(gl)?;
        match show {
            Show::Picture => self.use_shadow_map(gl),
            Show::FlatMap { depth, .. } => {
                let flat = gl::flat_depths(gl, self.target.size, depth)?;
                let own = std::mem::replace(&mut self.target.depth_texture, flat);
                self.use_shadow_map(gl);
                self.target.depth_texture = own;
                unsafe { gl.delete_texture(flat) };
            }
            Show::Visibility { .. } => self.draw_visibility(gl)?,
        }
        Ok(())
    }

    /// The shadow map, rendered anew if the last one does not serve on.
    fn prepare_shadow_map(&mut self, gl: &glow::Context) -> Result<()> {
        self.renew_target(gl)?;
        if self.settings.switch("shadows") {
            let inputs = self.map_inputs();
            let redraw = self.settings.choice("redraw") == "every_frame";
            if redraw || self.drawn.as_ref() != Some(&inputs) {
                self.render_shadow_map(gl, &inputs);
                self.drawn = Some(inputs);
                // The offset test's map is no more.
                if let Some(offset) = &mut self.offset {
                    offset.test.forget();
                }
            }
        }
        Ok(())
    }

    /// Another render target, if the settings ask for another size; says whether they do.
    fn renew_target(&mut self, gl: &glow::Context) -> Result<bool> {
        let size = map_size(self.largest_map, &self.settings);
        let renewed = size != self.target.size;
        if renewed {
            self.target.delete(gl);
            self.target = RenderTarget::new(gl, size)?;
            self.drawn = None;
        }
        Ok(renewed)
    }
}

/// What the settings ask for, no larger than the driver allows.
fn map_size(largest_map: u32, settings: &Settings) -> u32 {
    largest_map.min(settings.number("map_size") as u32)
}

/// The camera after an orbit around the point that it looks at: to the right, then up, in degrees.
fn orbited(camera: &Camera, right: f64, up: f64) -> Camera {
    let centre = camera.eye + camera.look;
    let look = rotate(right, camera.rup).transform_vector3(camera.look);
    let side = look.cross(camera.rup);
    // Straight from above and from below there is no side: the orbit stops short of them.
    let elevation = 90.0 - look.angle_between(camera.rup).to_degrees();
    let lowered = (elevation - up).clamp(-STEEPEST, STEEPEST) - elevation;
    let look = rotate(lowered, side).transform_vector3(look);
    Camera {
        eye: centre - look,
        look,
        ..*camera
    }
}

impl Lab for Csci3260 {
    fn settings(&mut self) -> &mut Settings {
        &mut self.settings
    }

    fn key(&mut self, key: Key) -> bool {
        let place = self.place();
        let light = &mut self.scenes[place].lights[0];
        let turn = |degrees| move |_: &Object| rotate(degrees, DVec3::Y);
        match key {
            Key::Char('1') => self.dolphin_texture = 0,
            Key::Char('2') => self.dolphin_texture = 1,
            Key::Char('3') => self.sea_texture = 0,
            Key::Char('4') => self.sea_texture = 1,
            Key::Char('w') => light.color *= INTENSITY_STEP,
            Key::Char('s') => light.color /= INTENSITY_STEP,
            Key::Up => self.swim(DOLPHIN_STEP),
            Key::Down => self.swim(-DOLPHIN_STEP),
            Key::Left => self.move_dolphin(turn(DOLPHIN_TURN)),
            Key::Right => self.move_dolphin(turn(-DOLPHIN_TURN)),
            _ => return false,
        }
        true
    }

    fn pointer(&mut self, pointer: Pointer) -> bool {
        let Pointer::Drag {
            button: Button::Left,
            dx,
            dy,
        } = pointer
        else {
            return false;
        };
        let place = self.place();
        let camera = &mut self.scenes[place].camera;
        *camera = orbited(
            camera,
            -DRAG_STEP * f64::from(dx),
            DRAG_STEP * f64::from(dy),
        );
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
        self.settings.switch("rotation") && self.scene().objects.iter().any(spins)
    }

    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.paint_gl(gl, show)
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        let programs = Programs::install(gl, &self.shaders)?;
        let offset = self.offset.as_mut().map(|o| o.reload(gl, &self.shaders));
        let exact = self.exact.as_mut().map(|e| e.reload(gl, &self.shaders));
        for reloaded in [offset, exact].into_iter().flatten() {
            reloaded.inspect_err(|_| {
                programs.basic.delete(gl);
                programs.shadow_map.delete(gl);
            })?;
        }
        let old = std::mem::replace(&mut self.programs, programs);
        let made_on_demand = [self.visibility.take(), self.explainer.take()];
        let others = made_on_demand.iter().flatten();
        for program in [old.basic, old.shadow_map].iter().chain(others) {
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
        chosen_test(&self.settings) == "handout" && self.shaders.has_own("FragmentShaderCode.glsl")
    }

    fn shadow_texture(&self, _light: usize) -> Result<ShadowTexture> {
        check_map(&self.settings)?;
        let Light { near, far, .. } = *self.light();
        let (share, [near, far], bias) = match self.shadow_test() {
            ShadowTest::Offset(offset) => (offset.test.share(), offset.test.planes(), 0.0),
            _ => ([1.0; 2], [near, far], self.bias()),
        };
        Ok(ShadowTexture {
            texture: self.target.depth_texture,
            scale: MapScale {
                size: self.target.size,
                share,
                projection: Projection::Orthographic,
                near,
                far,
                bias,
            },
        })
    }

    fn now(&self) -> Scene {
        let mut scene = self.scene().clone();
        for object in &mut scene.objects {
            object.placement = self.model_matrix(object);
            object.spin = None;
        }
        scene
    }

    fn explain(&mut self, gl: &glow::Context, probe: Probe, _light: usize) -> Result<Explanation> {
        self.explain_at(gl, probe)
    }
}
