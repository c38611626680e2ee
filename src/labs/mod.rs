//! What the students write: one module per handout, and the seam that all labs share.
//!
//! A lab reads top to bottom in its handout's order, with the GL calls in plain sight. Command line and tests know
//! no more of a lab than [`Lab`] and [`Handout`]. Labs never import labs.

pub mod aueb7;
mod chosen_test;
pub mod cmsc23700;
pub mod cs541;
pub mod csci3260;
pub mod eecs487;
mod exact;
mod explanation;
mod keys;
mod settings;

use std::path::Path;

pub use explanation::{Explanation, LookUp, Probe, Step};
pub use keys::{Button, Input, Key, Pointer, parse_keys};
pub use settings::{Kind, Setting, Settings};

use crate::picture::{Grey, Projection};
use crate::scene::Scene;
use crate::{Error, Result, error};

/// Every lab, in the order in which they are listed.
pub static LABS: &[&Handout] = &[
    &cs541::HANDOUT,
    &eecs487::HANDOUT,
    &csci3260::HANDOUT,
    &cmsc23700::HANDOUT,
    &aueb7::HANDOUT,
];

/// What is known of a lab before there is a context.
pub struct Handout {
    /// The address of code, shaders and goldens.
    pub name: &'static str,
    pub title: &'static str,
    /// The size of the course's window, in pixels.
    pub size: [u32; 2],
    pub keys: &'static [(&'static str, &'static str)],
    /// The key of the handout that ends the viewer, as escape does. Without a window it changes nothing.
    pub quit: Option<Key>,
    pub settings: &'static [Setting],
    /// The names and texts of its shader files, which a student's may replace.
    pub shaders: &'static [(&'static str, &'static str)],
    /// What the handout shows, in its order.
    pub stages: &'static [Stage],
    /// What `shadowlab report` compares where the command line does not say.
    pub comparisons: &'static [Comparison],
    /// How many lights have a shadow of their own.
    pub lights: usize,
    /// Makes the lab's own remedy against acne use this bias, in depth as the map stores it.
    pub set_bias: fn(&mut Settings, f64) -> Result<()>,
    /// The scene that shows each of the handout's points.
    pub scene: fn() -> Result<Scene>,
    pub start: Start,
}

/// A state of a lab that shows one point of its handout.
pub struct Stage {
    /// The name of its picture.
    pub name: &'static str,
    /// Options of `shadowlab screenshot`, with spaces between them.
    pub options: &'static str,
    pub caption: &'static str,
}

/// Settings to be held against each other, in one plot. The row that they are held against, the handout's, is that of
/// `set` alone; it need not be listed.
pub struct Comparison {
    pub title: &'static str,
    /// What all rows have in common, as `--set` writes it.
    pub set: &'static [&'static str],
    /// Groups of settings with several values, as `--sweep` writes them; a group has a row for each combination.
    pub sweeps: &'static [&'static [&'static str]],
}

/// Set-up of a lab for a scene; a student's own shaders are in the folder, if one is given.
pub type Start = fn(&glow::Context, Scene, Option<&Path>) -> Result<Box<dyn Lab>>;

/// A running lab.
pub trait Lab {
    fn settings(&mut self) -> &mut Settings;

    /// Whether the lab knows the key.
    fn key(&mut self, key: Key) -> bool;

    /// Whether the lab has a use for what the mouse did.
    fn pointer(&mut self, pointer: Pointer) -> bool;

    /// Whether the lab has a use for it.
    fn input(&mut self, input: Input) -> bool {
        match input {
            Input::Key(key) => self.key(key),
            Input::Pointer(pointer) => self.pointer(pointer),
            Input::Set(assignment) => self.settings().set(&assignment).is_ok(),
            Input::Wait(seconds) => {
                self.advance(seconds);
                true
            }
        }
    }

    /// Whether it makes a difference at what time a key is pressed.
    fn keys_ask_time(&self) -> bool {
        false
    }

    /// The default framebuffer has a new size, in pixels.
    fn resize(&mut self, size: [u32; 2]);

    /// The most time, in seconds, that the lab can let pass before a picture.
    fn most_time(&self) -> f64 {
        f64::INFINITY
    }

    /// Lets time pass, in seconds. There is no other clock.
    fn advance(&mut self, dt: f64);

    /// Whether the picture changes as time passes.
    fn moves(&self) -> bool;

    /// Draws one frame into framebuffer 0.
    fn render(&mut self, gl: &glow::Context, show: Show) -> Result<()>;

    /// Compiles the shaders again, from their files. After an error the lab draws on with those it had.
    fn reload(&mut self, gl: &glow::Context) -> Result<()>;

    /// Whether the present test is in a student's own shader, together with the lighting. Then [`Show::Visibility`] shows
    /// the lab's test and not the student's, whose visibility is to be read from pictures.
    fn has_students_test(&self) -> bool {
        false
    }

    /// A light (from 1) that is off has no shadow to ask for.
    fn check_light(&self, _light: usize) -> Result<()> {
        Ok(())
    }

    /// What the grey of a depth map stands for: the distance, unless the handout wants to see the depths as they are.
    fn grey(&self) -> Grey {
        Grey::Distance
    }

    /// The depth map of a light (from 1), as the last frame drew it.
    fn shadow_texture(&self, light: usize) -> Result<ShadowTexture>;

    /// The scene at this moment, with everything that keys and settings have changed, and nothing that still moves:
    /// what the ground truth sees.
    fn now(&self) -> Scene;

    /// What the handout's shader computes for a light (from 1) at one place, step by step.
    fn explain(&mut self, gl: &glow::Context, probe: Probe, light: usize) -> Result<Explanation>;
}

/// What a frame shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Show {
    Picture,
    /// One channel: 1 lit, 0 in shadow of the light (counted from 1) by the lab's own test, for every pixel of every
    /// surface, whichever way it faces the light; 1 where there is no surface.
    Visibility {
        light: usize,
    },
    /// The picture, with a map that holds this depth everywhere in place of the light's (counted from 1): far behind
    /// everything it leaves everything lit, and far before everything, all that the light reaches in shadow. A lab without
    /// maps draws its picture.
    FlatMap {
        light: usize,
        depth: f32,
    },
}

/// A shadow map as the last frame drew it.
#[derive(Clone, Copy, Debug)]
pub struct ShadowTexture {
    pub texture: glow::Texture,
    pub scale: MapScale,
}

/// The sizes of a shadow map, in which errors are told.
#[derive(Clone, Copy, Debug)]
pub struct MapScale {
    /// Texels across the map, which is square.
    pub size: u32,
    /// How much of the light's field of view (or of its box) lies across the map, right and up: 1 is all of it.
    pub share: [f64; 2],
    /// Whether depths grow evenly with the distance.
    pub projection: Projection,
    /// Near and far plane of the camera that it was drawn from.
    pub near: f64,
    pub far: f64,
    /// By how much the test moves a point towards the light, in depth as the map stores it (0…1).
    pub bias: f64,
}

/// The lab of that name.
pub fn find(name: &str) -> Result<&'static Handout> {
    LABS.iter()
        .copied()
        .find(|lab| lab.name == name)
        .ok_or_else(|| {
            let known: Vec<_> = LABS.iter().map(|lab| lab.name).collect();
            let hint = error::did_you_mean(name, known.iter().copied());
            Error::usage(format!(
                "unknown lab \"{name}\"{hint}: expected one of {}",
                known.join(", ")
            ))
        })
}
