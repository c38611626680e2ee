//! AUEB Computer Graphics, lab 7: shadow mapping of a spotlight, Percentage Closer Filtering, a scene graph.
//!
//! | the handout | here |
//! |---|---|
//! | `InitializeRenderer`, `Render` | this file |
//! | Key input | `movement.rs`, `settings.rs` |
//! | `CreateShadowFBO`, `DrawSceneToShadowFBO` | `shadow_map.rs`; `glsl/aueb7/ShadowMap.vert`, `ShadowMap.frag` |
//! | The spotlight shader, `DrawSportLightSource` | `spot_light.rs`; `glsl/aueb7/SpotLight.vert`, `SpotLight.frag` |
//! | `root->draw(0)`, `root->draw(1)` | `spot_light.rs`: `draw`; [`crate::scene::graph`] |
//! | Exercise 2: the shadow map resolution | the setting `map_size` |
//! | Exercise 3: PCF, the bias, the step | `glsl/aueb7/is_point_in_shadow.frag`; the settings `filter`, `constant_depth_bias`, `step` |
//! | `SceneGraphExampleInit`, `2`, `3` | `scenes.rs`; the setting `scene` |
//! | no part of it: the map at its best | `offset_test.rs`; `glsl/aueb7/SpotLight_offset.frag` |
//! | no part of it: a test without a map | `exact_test.rs`; `glsl/aueb7/SpotLight_exact.frag` |
//!
//! Of the course's texture units, 0 (diffuse) and 4 (the shadow map) are in use. Back faces are culled in both passes, so
//! that an open mesh of `--scene` neither shows nor casts from behind; of its materials, diffuse color and texture count.
//!
//! Chosen, because the handout leaves it open: which way each key and drag moves, how far a left drag goes, the key `l`,
//! and that the eye never comes to stand straight above its target, or in it. F1 goes round in the handout's order; the
//! course's program has points before wireframe. What keys and mouse have moved holds in each of the scenes.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod exact_test;
mod explain;
mod movement;
mod offset_test;
mod programs;
mod scenes;
mod settings;
mod shadow_map;
mod shadow_test;
mod spot_light;
mod stages;

use std::cell::OnceCell;
use std::path::Path;

use glam::DMat4;
use glow::HasContext;

use super::chosen_test::{check_map, chosen_test};
use super::{
    Explanation, Handout, Key, Lab, MapScale, Pointer, Probe, Settings, ShadowTexture, Show,
};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::picture::Projection;
use crate::scene::{Beam, Light, LightKind, Object, Scene, shapes};
use exact_test::Exact;
use movement::Moved;
use offset_test::Offset;
use programs::{Programs, SHADERS, with_shadow_test};
use scenes::SceneGraph;
use settings::{KEYS, SETTINGS};
use shadow_map::{MapInputs, ShadowFbo, create_shadow_fbo};
use shadow_test::ShadowTest;

pub static HANDOUT: Handout = Handout {
    name: "aueb7",
    title: "AUEB Computer Graphics, lab 7: a spotlight's shadow map, PCF",
    size: [500, 500],
    keys: KEYS,
    quit: None,
    settings: SETTINGS,
    shaders: programs::SHADERS,
    stages: stages::STAGES,
    comparisons: stages::COMPARISONS,
    lights: 1,
    set_bias: settings::set_bias,
    scene: || Ok(scenes::scene_graph_example_init()?.flattened(DMat4::IDENTITY, 0.0)),
    start: |gl, scene, students| Ok(Box::new(Aueb7::initialize_renderer(gl, scene, students)?)),
};

struct Aueb7 {
    /// Each is made when it is first asked for.
    scenes: [OnceCell<SceneGraph>; 3],
    settings: Settings,
    size: [u32; 2],
    /// In seconds.
    time: f64,
    moved: Moved,
    polygon_mode: u32,

    /// What both passes draw: the geometry of each scene graph; empty until it is first drawn.
    models: [Vec<Model>; 3],
    white: glow::Texture,
    /// The sphere at the light.
    marker: gl::Mesh,

    shaders: Shaders,
    programs: Programs,
    /// The most texels that the driver allows along a side.
    largest_map: u32,
    shadow_fbo: ShadowFbo,
    /// What the shadow map was drawn from, while that still holds.
    drawn: Option<MapInputs>,

    /// What only the setting shadow_test asks for.
    offset: Option<Offset>,
    exact: Option<Exact>,
    /// Programs that only the measuring commands ask for.
    visibility: Option<Program>,
    explainer: Option<Program>,
}

/// One geometry node on the GPU.
struct Model {
    mesh: gl::Mesh,
    texture: glow::Texture,
}

impl Aueb7 {
    #[doc(alias = "InitializeRenderer")]
    fn initialize_renderer(
        gl: &glow::Context,
        scene: Scene,
        students: Option<&Path>,
    ) -> Result<Self> {
        settings::cone(&scene)?;
        let settings = Settings::new(SETTINGS);
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let largest_map = gl::largest_texture(gl);
        let shadow_fbo = create_shadow_fbo(gl, map_size(largest_map, &settings))?;
        let programs = Programs::load(gl, &shaders)?;
        let _pass = gl::pass(gl, "set-up: InitializeRenderer");
        unsafe {
            gl.enable(glow::DEPTH_TEST);
            gl.depth_func(glow::LEQUAL);
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        }
        let mut lab = Self {
            scenes: [
                OnceCell::from(SceneGraph::of(scene)),
                OnceCell::new(),
                OnceCell::new(),
            ],
            settings,
            size: HANDOUT.size,
            time: 0.0,
            moved: Moved::default(),
            polygon_mode: glow::FILL,
            models: [vec![], vec![], vec![]],
            white: gl::solid_texture(gl)?,
            marker: gl::Mesh::new(gl, "light_source", &shapes::sphere(16))?,
            shaders,
            programs,
            largest_map,
            shadow_fbo,
            drawn: None,
            offset: None,
            exact: None,
            visibility: None,
            explainer: None,
        };
        lab.load_models(gl)?;
        Ok(lab)
    }

    /// Meshes and textures of the present scene, if it has not been drawn yet.
    fn load_models(&mut self, gl: &glow::Context) -> Result<()> {
        let place = self.place();
        if !self.models[place].is_empty() {
            return Ok(());
        }
        let _pass = gl::pass(gl, "set-up: meshes and textures");
        let mut models = Vec::new();
        let mut sent = gl::Textures::default();
        for (object, _) in self.geometry() {
            let name = &object.name;
            models.push(Model {
                mesh: gl::Mesh::new(gl, name, &object.mesh)?,
                texture: match &object.material.texture {
                    Some(picture) => sent.of(gl, &format!("{name}_texture"), picture, || {
                        gl::levels(picture)
                    })?,
                    None => self.white,
                },
            });
        }
        self.models[place] = models;
        Ok(())
    }

    /// The shadow map in its present size, and the program that shows the test alone.
    fn prepare_exercises_test(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.renew_shadow_fbo(gl)?;
        if self.visibility.is_none() && matches!(show, Show::Visibility { .. }) {
            let program =
                with_shadow_test(gl, &self.shaders, "visibility.frag", &["uniform_shadows"])?;
            self.visibility = Some(program);
        }
        Ok(())
    }

    /// Another shadow map, if the settings ask for another size; says whether they do.
    fn renew_shadow_fbo(&mut self, gl: &glow::Context) -> Result<bool> {
        let size = map_size(self.largest_map, &self.settings);
        let renewed = size != self.shadow_fbo.shadow_dimensions;
        if renewed {
            self.shadow_fbo.delete(gl);
            self.shadow_fbo = create_shadow_fbo(gl, size)?;
            self.drawn = None;
        }
        Ok(renewed)
    }

    /// The number of the present scene.
    fn place(&self) -> usize {
        match self.settings.choice("scene") {
            "pirate" => 1,
            "knossos" => 2,
            _ => 0,
        }
    }

    fn graph(&self) -> &SceneGraph {
        let place = self.place();
        self.scenes[place].get_or_init(|| {
            let made = match place {
                1 => scenes::scene_graph_example_2_init(),
                _ => scenes::scene_graph_example_3_init(),
            };
            made.expect("what the program has of its own is right")
        })
    }

    fn scene(&self) -> &Scene {
        &self.graph().surroundings
    }

    /// What is drawn, each with its matrix to world space.
    fn geometry(&self) -> Vec<(&Object, DMat4)> {
        self.graph().root.geometry(self.world(), self.spin_time())
    }
}

/// What the settings ask for, no larger than the driver allows.
fn map_size(largest_map: u32, settings: &Settings) -> u32 {
    largest_map.min(settings.number("map_size") as u32)
}

impl Lab for Aueb7 {
    fn settings(&mut self) -> &mut Settings {
        &mut self.settings
    }

    fn key(&mut self, key: Key) -> bool {
        self.press(key)
    }

    fn pointer(&mut self, pointer: Pointer) -> bool {
        self.drag(pointer)
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
    }

    fn advance(&mut self, dt: f64) {
        self.time += dt;
    }

    fn moves(&self) -> bool {
        let spins = |(object, _): (&Object, DMat4)| {
            object
                .spin
                .is_some_and(|spin| spin.degrees_per_second != 0.0)
        };
        self.settings.switch("rotate_light")
            || self.settings.switch("rotation") && self.geometry().into_iter().any(spins)
    }

    #[doc(alias = "Render")]
    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.load_models(gl)?;
        self.prepare_shadow_test(gl, show)?;

        // F1's mode holds in both of the exercises' passes, and is gone after them.
        let is_filled = self.polygon_mode == glow::FILL;
        if !is_filled {
            unsafe { gl.polygon_mode(glow::FRONT_AND_BACK, self.polygon_mode) };
        }
        if self.settings.switch("shadows") && chosen_test(&self.settings) == "handout" {
            let inputs = self.map_inputs();
            let redraw = self.settings.choice("redraw") == "every_frame";
            if redraw || self.drawn.as_ref() != Some(&inputs) {
                self.draw_scene_to_shadow_fbo(gl, &inputs);
                self.drawn = Some(inputs);
                // The offset test's map is no more.
                if let Some(offset) = &mut self.offset {
                    offset.test.forget();
                }
            }
        }
        match show {
            Show::Picture => self.draw_scene(gl),
            Show::FlatMap { depth, .. } => {
                let flat = gl::flat_depths(gl, self.shadow_fbo.shadow_dimensions, depth)?;
                let own = std::mem::replace(&mut self.shadow_fbo.fbo_shadow_texture, flat);
                self.draw_scene(gl);
                self.shadow_fbo.fbo_shadow_texture = own;
                unsafe { gl.delete_texture(flat) };
            }
            Show::Visibility { .. } => self.draw_visibility(gl),
        }
        if !is_filled {
            unsafe { gl.polygon_mode(glow::FRONT_AND_BACK, glow::FILL) };
        }
        Ok(())
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        let programs = Programs::load(gl, &self.shaders)?;
        let offset = self.offset.as_mut().map(|o| o.reload(gl, &self.shaders));
        let exact = self.exact.as_mut().map(|e| e.reload(gl, &self.shaders));
        for reloaded in [offset, exact].into_iter().flatten() {
            reloaded.inspect_err(|_| programs.delete(gl))?;
        }
        std::mem::replace(&mut self.programs, programs).delete(gl);
        let made_on_demand = [self.visibility.take(), self.explainer.take()];
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
        chosen_test(&self.settings) == "handout" && self.shaders.has_own("SpotLight.frag")
    }

    fn shadow_texture(&self, _light: usize) -> Result<ShadowTexture> {
        check_map(&self.settings)?;
        let Light { near, far, .. } = self.light();
        let (share, [near, far], bias) = match self.shadow_test() {
            ShadowTest::Offset(offset) => (offset.test.share(), offset.test.planes(), 0.0),
            _ => ([1.0; 2], [near, far], self.bias()),
        };
        Ok(ShadowTexture {
            texture: self.shadow_fbo.fbo_shadow_texture,
            scale: MapScale {
                size: self.shadow_fbo.shadow_dimensions,
                share,
                projection: Projection::Perspective,
                near,
                far,
                bias,
            },
        })
    }

    fn now(&self) -> Scene {
        let mut scene = self.graph().flattened(self.world(), self.spin_time());
        scene.camera = self.camera();
        let light = self.light();
        let LightKind::Spot { cone, .. } = light.kind else {
            unreachable!("a scene of another light was refused")
        };
        // What the map covers is square, and the light ends where the map does.
        scene.lights = vec![Light {
            kind: LightKind::Spot {
                cone,
                beam: Beam::Rectangular,
            },
            ..light
        }];
        scene
    }

    fn explain(&mut self, gl: &glow::Context, probe: Probe, _light: usize) -> Result<Explanation> {
        self.explain_at(gl, probe)
    }
}
