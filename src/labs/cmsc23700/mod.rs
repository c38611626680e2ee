//! CMSC 23700, project 3: shadow maps for one or two lights, in a box where balls bounce.
//!
//! | the handout | here |
//! |---|---|
//! | Description: first pass, a depth texture for each light | `shadow_map.rs`; `glsl/cmsc23700/shadow.vert`, `shadow.frag` |
//! | Description: second pass, per-pixel lighting with the shadow maps | `second_pass.rs`; `glsl/cmsc23700/lighting.vert`, `lighting.frag` |
//! | Lights: a directional light, a spotlight above the box without its top wall | `scene.rs`, `lights.rs` |
//! | Lights: C_out = C_in · max(A, clamp(Σ S_l (A_l + D_l))) | `lighting.frag` |
//! | User interface: `l`, `s`, `q` | `settings.rs`, [`Lab::key`] |
//! | User interface: `+` adds a ball to the simulation | [`simulation::Simulation::new_ball`] |
//! | User interface: `-` removes a ball from the simulation | [`simulation::Simulation::kill_ball`] |
//! | Hints: the sphere of radius √3, the orthographic projection, the texture matrix | `scene.rs`, `lights.rs`: `LightCamera` |
//! | Hints: the shadow map on the screen, from −1 black to 1 white | [`Lab::grey`] |
//! | no part of it: the maps at their best | `offset_test.rs`; `glsl/cmsc23700/lighting_offset.frag` |
//! | no part of it: a test without a map | `exact_test.rs`; `glsl/cmsc23700/lighting_exact.frag` |
//!
//! Chosen, because the handout does not say it: which ball is removed (the newest), and which of the eight colours a
//! ball has (they are given in turn); how many balls there are at the start, and both lights enabled; where the lights
//! are, how they weaken, and their levels; that the walls cast; the size of the maps, their filter, what lies beside
//! them (it is lit), and the bias of each. The handout's scene has no textures, no highlights and no sky, and so a
//! student's has none here.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod balls;
mod exact_test;
mod explain;
mod lights;
mod offset_test;
mod scene;
mod second_pass;
mod settings;
mod shadow_map;
mod shadow_test;
pub mod simulation;
mod stages;

use std::cell::Cell;
use std::path::Path;

use glow::HasContext;

use super::chosen_test::{check_map, chosen_test};
use super::{
    Explanation, Handout, Key, Lab, MapScale, Pointer, Probe, Settings, ShadowTexture, Show,
};
use crate::gl::{self, Program, Shaders};
use crate::picture::{Grey, Projection};
use crate::scene::{Light, Object, Scene};
use crate::shadow_tests::offset::OffsetTest;
use crate::{Error, Result, shadow_tests};
use balls::Balls;
use exact_test::Exact;
use lights::LightCamera;
use offset_test::Offset;
use settings::{KEYS, SETTINGS};
use shadow_map::ShadowMap;
use shadow_test::ShadowTest;
use simulation::Simulation;

pub static HANDOUT: Handout = Handout {
    name: "cmsc23700",
    title: "CMSC 23700, project 3: a directional light and a spotlight, each with a shadow map",
    size: [800, 800],
    keys: KEYS,
    quit: Some(Key::Char('q')),
    settings: SETTINGS,
    shaders: SHADERS,
    stages: stages::STAGES,
    comparisons: stages::COMPARISONS,
    lights: 2,
    set_bias: settings::set_bias,
    scene: scene::the_box,
    start: |gl, scene, students| Ok(Box::new(Cmsc23700::new(gl, scene, students)?)),
};

/// The shaders, which are the lesson's other half.
const SHADERS: &[(&str, &str)] = &[
    (
        "shadow.vert",
        include_str!("../../../glsl/cmsc23700/shadow.vert"),
    ),
    (
        "shadow.frag",
        include_str!("../../../glsl/cmsc23700/shadow.frag"),
    ),
    (
        "lighting.vert",
        include_str!("../../../glsl/cmsc23700/lighting.vert"),
    ),
    (
        "lighting.frag",
        include_str!("../../../glsl/cmsc23700/lighting.frag"),
    ),
    (
        "visibility.frag",
        include_str!("../../../glsl/cmsc23700/visibility.frag"),
    ),
    (
        "explain.frag",
        include_str!("../../../glsl/cmsc23700/explain.frag"),
    ),
    (
        "lighting_exact.frag",
        include_str!("../../../glsl/cmsc23700/lighting_exact.frag"),
    ),
    (
        "visibility_exact.frag",
        include_str!("../../../glsl/cmsc23700/visibility_exact.frag"),
    ),
    (
        "lighting_lcs.vert",
        include_str!("../../../glsl/cmsc23700/lighting_lcs.vert"),
    ),
    (
        "lighting_offset.frag",
        include_str!("../../../glsl/cmsc23700/lighting_offset.frag"),
    ),
    (
        "visibility_offset.frag",
        include_str!("../../../glsl/cmsc23700/visibility_offset.frag"),
    ),
    shadow_tests::SHADERS[0],
    shadow_tests::SHADERS[1],
    shadow_tests::SHADERS[2],
];

/// The lights' numbers in the scene, and their texture units.
const DIRECTIONAL: usize = 0;
const SPOT: usize = 1;
const NAMES: [&str; 2] = ["directional light", "spotlight"];

/// Where the balls of the first picture are: with this one they stand apart, in both lights.
const SEED: u64 = 1;

struct Cmsc23700 {
    /// Without the balls.
    scene: Scene,
    settings: Settings,
    size: [u32; 2],
    simulation: Simulation,
    light_cameras: [LightCamera; 2],

    /// What both passes draw.
    meshes: Vec<gl::Mesh>,
    balls: Balls,
    /// The number of what this frame has drawn last: its vertex array is bound.
    bound: Cell<Option<usize>>,

    shaders: Shaders,
    programs: Programs,
    shadow_maps: [ShadowMap; 2],
    /// The most texels that the driver allows along a side.
    largest_map: u32,

    /// What only the setting shadow_test asks for.
    offset: Option<Offset>,
    exact: Option<Exact>,
    /// Programs that only the measuring commands ask for.
    visibility: Option<Program>,
    explainer: Option<Program>,
}

struct Programs {
    shadow: Program,
    lighting: Program,
}

impl Programs {
    /// Both or none: a lab never draws with half of its shaders.
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let shadow = shadow_map::shadow_program(gl, shaders)?;
        let lighting =
            second_pass::lighting_program(gl, shaders).inspect_err(|_| shadow.delete(gl))?;
        Ok(Self { shadow, lighting })
    }
}

impl Cmsc23700 {
    fn new(gl: &glow::Context, scene: Scene, students: Option<&Path>) -> Result<Self> {
        scene::check_lights(&scene)?;
        scene::note_textures(&scene);
        let settings = Settings::new(SETTINGS);
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let largest_map = gl::largest_texture(gl);
        let size = largest_map.min(settings.number("map_size") as u32);
        let shadow_maps = [
            ShadowMap::new(gl, DIRECTIONAL, size)?,
            ShadowMap::new(gl, SPOT, size)?,
        ];
        let programs = Programs::new(gl, &shaders)?;
        let meshes = {
            let _pass = gl::pass(gl, "set-up: the meshes");
            let mut meshes = Vec::new();
            for object in &scene.objects {
                meshes.push(gl::Mesh::new(gl, &object.name, &object.mesh)?);
                balls::single_instance(gl, &object.name, object.material.diffuse)?;
            }
            meshes
        };
        let balls = Balls::new(gl)?;
        unsafe { gl.enable(glow::DEPTH_TEST) };
        let light_cameras =
            [DIRECTIONAL, SPOT].map(|light| LightCamera::new(&scene.lights[light], &scene.camera));
        let mut lab = Self {
            scene,
            settings,
            size: HANDOUT.size,
            simulation: Simulation::new(SEED),
            light_cameras,
            meshes,
            balls,
            bound: Cell::new(None),
            shaders,
            programs,
            shadow_maps,
            largest_map,
            offset: None,
            exact: None,
            visibility: None,
            explainer: None,
        };
        lab.set_lights(gl);
        lab.match_balls();
        Ok(lab)
    }

    fn wanted_balls(&self) -> usize {
        self.settings.number("balls") as usize
    }

    /// Adds or removes balls until there are as many as the setting says.
    fn match_balls(&mut self) {
        let wanted = self.wanted_balls();
        match_balls(&mut self.simulation, wanted);
    }

    /// Adds or removes so many balls, within what the setting takes.
    fn change_balls(&mut self, by: isize) {
        let wanted = self.wanted_balls().saturating_add_signed(by);
        self.set(&format!("balls={}", wanted.min(simulation::MAX_BALLS)));
        self.match_balls();
    }

    /// What a key sets.
    fn set(&mut self, assignment: &str) {
        let set = self.settings.set(assignment);
        set.expect("a key sets what the setting takes");
    }

    /// Which lights are on.
    fn enabled(&self) -> [bool; 2] {
        match self.settings.choice("lights") {
            "directional" => [true, false],
            "spotlight" => [false, true],
            _ => [true, true],
        }
    }

    fn bias(&self, light: usize) -> f64 {
        let setting = ["directional_bias", "spot_bias"][light];
        self.settings.number(setting)
    }

    fn draw(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.match_balls();
        self.balls.take_positions(gl, &self.simulation);
        self.bound.set(None);
        self.prepare_shadow_test(gl)?;
        match show {
            Show::Picture => self.draw_picture(gl),
            Show::FlatMap { light, depth } => {
                self.check_light(light)?;
                let flat = gl::flat_depths(gl, self.shadow_maps[light - 1].size, depth)?;
                let map = &mut self.shadow_maps[light - 1].depth_texture;
                let own = std::mem::replace(map, flat);
                self.draw_picture(gl);
                self.shadow_maps[light - 1].depth_texture = own;
                unsafe { gl.delete_texture(flat) };
            }
            Show::Visibility { light } => {
                self.check_light(light)?;
                self.draw_visibility(gl, light)?;
            }
        }
        Ok(())
    }

    /// The shadow maps, drawn anew where the last ones do not serve on.
    fn prepare_shadow_maps(&mut self, gl: &glow::Context) -> Result<()> {
        self.renew_shadow_maps(gl)?;
        if self.settings.switch("shadows") {
            self.draw_shadow_maps(gl);
        }
        Ok(())
    }

    /// Other shadow maps, if the settings ask for another size; says whether they do.
    fn renew_shadow_maps(&mut self, gl: &glow::Context) -> Result<bool> {
        let size = self
            .largest_map
            .min(self.settings.number("map_size") as u32);
        let renewed = size != self.shadow_maps[0].size;
        if renewed {
            for (light, map) in self.shadow_maps.iter_mut().enumerate() {
                map.delete(gl);
                *map = ShadowMap::new(gl, light, size)?;
            }
        }
        Ok(renewed)
    }
}

fn match_balls(simulation: &mut Simulation, wanted: usize) {
    while simulation.balls().len() > wanted {
        simulation.kill_ball();
    }
    // A box without room for another ball keeps those that it has.
    while simulation.balls().len() < wanted && simulation.new_ball().is_ok() {}
}

impl Lab for Cmsc23700 {
    fn settings(&mut self) -> &mut Settings {
        &mut self.settings
    }

    fn key(&mut self, key: Key) -> bool {
        match key {
            Key::Char('l') => {
                let next = settings::next_lights(self.settings.choice("lights"));
                self.set(&format!("lights={next}"));
            }
            Key::Char('+') => self.change_balls(1),
            Key::Char('-') => self.change_balls(-1),
            Key::Char('s') => {
                let shadows = self.settings.switch("shadows");
                self.set(if shadows { "shadows=off" } else { "shadows=on" });
            }
            // The viewer ends.
            Key::Char('q') => (),
            _ => return false,
        }
        true
    }

    fn pointer(&mut self, _pointer: Pointer) -> bool {
        false
    }

    /// A ball flies from the moment when it is added.
    fn keys_ask_time(&self) -> bool {
        true
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
    }

    /// A day: every bounce until then is computed, which takes 100 balls some 20 seconds.
    fn most_time(&self) -> f64 {
        86_400.0
    }

    fn advance(&mut self, dt: f64) {
        self.match_balls();
        self.simulation.simulate(dt);
    }

    fn moves(&self) -> bool {
        let spins = |object: &Object| {
            object
                .spin
                .is_some_and(|spin| spin.degrees_per_second != 0.0)
        };
        self.wanted_balls() > 0 || self.scene.objects.iter().any(spins)
    }

    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.draw(gl, show)
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        let programs = Programs::new(gl, &self.shaders)?;
        let (shaders, scene) = (&self.shaders, &self.scene);
        let offset = self.offset.as_mut().map(|o| o.reload(gl, shaders, scene));
        let exact = self.exact.as_mut().map(|e| e.reload(gl, shaders, scene));
        for reloaded in [offset, exact].into_iter().flatten() {
            reloaded.inspect_err(|_| {
                programs.shadow.delete(gl);
                programs.lighting.delete(gl);
            })?;
        }
        let old = std::mem::replace(&mut self.programs, programs);
        let made_on_demand = [self.visibility.take(), self.explainer.take()];
        let others = made_on_demand.iter().flatten();
        for program in [old.shadow, old.lighting].iter().chain(others) {
            program.delete(gl);
        }
        self.set_lights(gl);
        // The maps were drawn by the old shaders.
        for map in &mut self.shadow_maps {
            map.drawn = None;
        }
        if let Some(offset) = &mut self.offset {
            offset.tests.iter_mut().for_each(OffsetTest::forget);
        }
        Ok(())
    }

    fn check_light(&self, light: usize) -> Result<()> {
        if self.enabled()[light - 1] {
            return Ok(());
        }
        let (lights, own) = (self.settings.choice("lights"), ["directional", "spotlight"]);
        Err(Error::usage(format!(
            "lights={lights} draws no map of light {light}, expected lights={} or lights=both",
            own[light - 1]
        )))
    }

    fn has_students_test(&self) -> bool {
        chosen_test(&self.settings) == "handout" && self.shaders.has_own("lighting.frag")
    }

    fn shadow_texture(&self, light: usize) -> Result<ShadowTexture> {
        self.check_light(light)?;
        check_map(&self.settings)?;
        let number = light - 1;
        let map = &self.shadow_maps[number];
        let Light { near, far, .. } = self.scene.lights[number];
        let (share, [near, far], bias) = match self.shadow_test() {
            ShadowTest::Offset(Offset { tests, .. }) => {
                (tests[number].share(), tests[number].planes(), 0.0)
            }
            _ => ([1.0; 2], [near, far], self.bias(number)),
        };
        Ok(ShadowTexture {
            texture: map.depth_texture,
            scale: MapScale {
                size: map.size,
                share,
                projection: [Projection::Orthographic, Projection::Perspective][number],
                near,
                far,
                bias,
            },
        })
    }

    fn grey(&self) -> Grey {
        // DEVIATES: second window, the viewer and `--show shadow-map` show the maps, one light's at a time.
        Grey::Depth
    }

    fn now(&self) -> Scene {
        let mut scene = self.scene.clone();
        for object in &mut scene.objects {
            object.placement = self.model(object);
            object.spin = None;
        }
        let mut simulation = self.simulation.clone();
        match_balls(&mut simulation, self.wanted_balls());
        scene
            .objects
            .extend(scene::balls(&simulation, &self.balls.mesh));
        scene
    }

    fn explain(&mut self, gl: &glow::Context, probe: Probe, light: usize) -> Result<Explanation> {
        self.explain_at(gl, probe, light)
    }
}
