//! EECS 487, lab 7: projected (soft) shadows, and a framebuffer object as accumulation buffer.
//!
//! | the handout | here |
//! |---|---|
//! | 1. Hard shadows | `shadow_matrix.rs`: `mult_shadow_mat`; `draw_scene.rs`: `draw_shadows`, `draw_wall`, `draw_occluders` |
//! | 2. Clipped projected shadows | `draw_scene.rs`: `draw_scene`, `populate_stencil` |
//! | Table 1 | `settings.rs`: `KEYS`, `kbd` |
//! | 3. Soft shadows | `soft.rs`: `display`, `soft_shadows`; `jitter.rs` |
//! | 4. Framebuffer object | `fbo_accum.rs`: `fbo_accum_init`, `fbo_accum`, `fbo_accum_return`; `accum_buffers.rs` |
//! | 5. Banding in a limited buffer | the settings `accumulator`, `accumulation` and `scene=ramp`; `s8.rs` |
//!
//! `fast.rs` draws the same picture as section 3, for each light again only where it matters which one it is.
//!
//! Chosen, because the handout leaves it open: the jitter is uniform in the cube, from a seeded generator; walls are cut
//! into 16×16 quads; a window that is not square shows more beside the room. Torus and teapot receive no shadows: for
//! truth and measure their pixels are not valid. A student's scene brings its objects, by their diffuse color, and its
//! light into the room, whose camera stays.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod accum_buffers;
mod draw_scene;
mod explain;
mod fast;
mod fbo_accum;
pub mod jitter;
mod look;
mod masks;
mod occluders;
mod programs;
mod s8;
mod scene;
mod selection;
mod settings;
mod shadow_masks;
mod shadow_matrix;
mod soft;
mod stages;
mod topology;
mod umbra;

use std::path::Path;

use glow::HasContext;

use super::{Explanation, Handout, Key, Lab, Pointer, Probe, Settings, ShadowTexture, Show};
use crate::gl::{self, Shaders};
use crate::scene::{Object, Scene, shapes};
use crate::{Error, Result};
use draw_scene::WallMesh;
use fbo_accum::FboAccum;
use masks::Masks;
use occluders::Occluder;
use programs::{Programs, SHADERS};
use scene::Wall;
use selection::Selection;
use settings::{KEYS, SETTINGS};

pub static HANDOUT: Handout = Handout {
    name: "eecs487",
    title: "EECS 487, lab 7: projected (soft) shadows with a framebuffer object",
    size: [600, 600],
    keys: KEYS,
    quit: Some(Key::Char('q')),
    settings: SETTINGS,
    shaders: programs::SHADERS,
    stages: stages::STAGES,
    comparisons: &[],
    lights: 1,
    set_bias: settings::set_bias,
    scene: scene::course,
    start: |gl, scene, students| Ok(Box::new(Eecs487::init_gl(gl, scene, students)?)),
};

struct Eecs487 {
    /// Camera, light and colors; the objects are below.
    scene: Scene,
    walls: [Wall; 5],
    occluders: Vec<Occluder>,
    sphere: gl::Mesh,
    /// What every wall is drawn with; None where the tessellation leaves none.
    wall_mesh: Option<WallMesh>,
    /// Of torus and teapot, in degrees.
    rotation: f64,
    settings: Settings,
    size: [u32; 2],

    shaders: Shaders,
    programs: Programs,
    /// Made when the first soft shadow asks for them.
    accumulation: Option<FboAccum>,
    masks: Option<Masks>,
    selection: Option<Selection>,
}

impl Eecs487 {
    #[doc(alias = "initGL")]
    fn init_gl(gl: &glow::Context, scene: Scene, students: Option<&Path>) -> Result<Self> {
        let mut scene = scene::with_room(scene)?;
        let shaders = Shaders::new(HANDOUT.name, SHADERS, students)?;
        let programs = Programs::new(gl, &shaders)?;
        let _pass = gl::pass(gl, "set-up: meshes");
        let (walls, occluders) = scene::split(std::mem::take(&mut scene.objects));
        let occluders = Occluder::of(gl, occluders)?;
        let sphere = gl::Mesh::new(gl, "light", &scene::light_mesh())?;
        unsafe { gl.enable(glow::DEPTH_TEST) };
        let mut lab = Self {
            scene,
            walls,
            occluders,
            sphere,
            wall_mesh: None,
            rotation: 0.0,
            settings: Settings::new(SETTINGS),
            size: HANDOUT.size,
            shaders,
            programs,
            accumulation: None,
            masks: None,
            selection: None,
        };
        lab.tessellate(gl)?;
        Ok(lab)
    }

    /// Cuts the walls into as many quads as the setting says.
    fn tessellate(&mut self, gl: &glow::Context) -> Result<()> {
        let tessellation = self.settings.number("tessellation") as u32;
        if self.wall_mesh.as_ref().map_or(0, |mesh| mesh.tessellation) == tessellation {
            return Ok(());
        }
        if let Some(old) = self.wall_mesh.take() {
            old.buffers.delete(gl);
        }
        if tessellation > 0 {
            self.wall_mesh = Some(WallMesh {
                tessellation,
                buffers: gl::Mesh::new(gl, "wall", &shapes::plane(tessellation))?,
            });
        }
        Ok(())
    }
}

impl Lab for Eecs487 {
    fn settings(&mut self) -> &mut Settings {
        &mut self.settings
    }

    fn key(&mut self, key: Key) -> bool {
        self.kbd(key)
    }

    fn pointer(&mut self, _: Pointer) -> bool {
        false
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
    }

    fn advance(&mut self, _: f64) {}

    fn moves(&self) -> bool {
        false
    }

    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.display(gl, show)
    }

    fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        let programs = Programs::new(gl, &self.shaders)?;
        std::mem::replace(&mut self.programs, programs).delete(gl);
        if let Some(fbo) = &mut self.accumulation {
            fbo.programs = self.programs.accumulation.clone();
        }
        Ok(())
    }

    fn shadow_texture(&self, _: usize) -> Result<ShadowTexture> {
        Err(Error::usage(
            "eecs487 has no shadow map: its shadows are projected onto the walls, expected picture or visibility",
        ))
    }

    fn now(&self) -> Scene {
        let mut scene = self.scene.clone();
        let tessellation = self.settings.number("tessellation");
        if tessellation > 0.0 {
            // However finely it is cut, a wall is the same square.
            let walls = self.shown();
            let objects = walls.map(|wall| scene::wall_object(wall, shapes::plane(1)));
            scene.objects.extend(objects.collect::<Vec<Object>>());
        }
        scene.objects.push(scene::light_object(self.light()));
        occluders::add_to(&mut scene, &self.occluders, self.rotation);
        scene
    }

    fn explain(&mut self, gl: &glow::Context, probe: Probe, _: usize) -> Result<Explanation> {
        self.explain_at(gl, probe)
    }
}
