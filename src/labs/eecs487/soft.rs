//! `display()`: section 3's soft shadows, and section 5's ramp.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::DVec3;
use glow::HasContext;

use super::Eecs487;
use super::fbo_accum::FboAccum;
use super::jitter::jitter;
use super::look::Look;
use crate::labs::Show;
use crate::{Error, Result, gl};

/// "The quad is rendered eight times into the accumulation buffer with 1/8th weight each".
const RAMP_PASSES: usize = 8;

impl Eecs487 {
    pub(super) fn display(&mut self, gl: &glow::Context, show: Show) -> Result<()> {
        self.tessellate(gl)?;
        let look = self.look(show);
        let soft = self.settings.switch("soft_shadows");
        let [width, height] = self.size.map(|n| n as i32);
        let [red, green, blue] = look.clear.as_vec3().to_array();
        unsafe {
            gl.viewport(0, 0, width, height);
            gl.clear_color(red, green, blue, 1.0);
        }
        if self.settings.choice("scene") == "ramp" {
            if matches!(show, Show::Visibility { .. }) {
                return Err(Error::usage(
                    "scene=ramp casts no shadows, expected scene=room",
                ));
            }
            self.make_accumulation_buffer(gl)?;
            self.accumulate_ramp(gl);
        } else if soft && self.settings.choice("soft_method") == "fast" {
            self.make_masks(gl)?;
            self.soft_shadows_fast(gl, &look);
        } else if soft {
            self.make_accumulation_buffer(gl)?;
            self.soft_shadows(gl, &look);
        } else {
            let _pass = gl::pass(gl, "drawScene");
            unsafe { gl.bind_framebuffer(glow::FRAMEBUFFER, None) };
            self.draw_scene(gl, self.light(), &look);
        }
        Ok(())
    }

    /// Render the scene multiple times, each time with the light somewhere else, and average all the renderings.
    fn soft_shadows(&self, gl: &glow::Context, look: &Look) {
        let fbo = self.accumulation_buffer();
        let passes = self.num_jitters();
        let (weight, return_weight) = self.weights(passes);

        // First, clear the accumulation buffer and jitter the position of the light before render starts.
        let _pass = gl::pass(gl, "soft shadows");
        fbo.fbo_accum_clear(gl);
        for index in 0..passes {
            fbo.select_frame(gl);
            self.draw_scene(gl, self.jittered(index), look);
            // Second, after each render, copy the contents of the frame buffer into the accumulation buffer.
            fbo.fbo_accum(gl, weight);
        }
        // Finally, move the accumulated contents from the accumulation buffer over to the frame buffer.
        fbo.fbo_accum_return(gl, return_weight);
    }

    fn accumulate_ramp(&self, gl: &glow::Context) {
        let fbo = self.accumulation_buffer();
        let (weight, return_weight) = self.weights(RAMP_PASSES);
        let _pass = gl::pass(gl, "the ramp");
        fbo.fbo_accum_clear(gl);
        for _ in 0..RAMP_PASSES {
            fbo.select_frame(gl);
            unsafe { gl.clear(glow::DEPTH_BUFFER_BIT) };
            fbo.draw_ramp(gl);
            fbo.fbo_accum(gl, weight);
        }
        fbo.fbo_accum_return(gl, return_weight);
    }

    /// Of each render, and of the accumulated contents.
    fn weights(&self, passes: usize) -> (f64, f64) {
        let share = 1.0 / passes as f64;
        match self.settings.choice("accumulation") {
            "weighted" => (share, 1.0),
            _ => (1.0, share),
        }
    }

    pub(super) fn num_jitters(&self) -> usize {
        self.settings.number("num_jitters") as usize
    }

    pub(super) fn light(&self) -> DVec3 {
        self.scene.lights[0].position
    }

    /// The position of the light in one of the renders.
    pub(super) fn jittered(&self, index: usize) -> DVec3 {
        self.light() + self.jitter(index)
    }

    pub(super) fn jitter(&self, index: usize) -> DVec3 {
        let amount = self.settings.number("jitter_amount");
        let first = self.settings.number("first_jitter") as usize;
        amount * jitter(self.settings.choice("jitter"), first + index)
    }

    /// Once, and again for another size or another format.
    fn make_accumulation_buffer(&mut self, gl: &glow::Context) -> Result<()> {
        let accumulator = self.settings.choice("accumulator");
        let wanted = |fbo: &FboAccum| fbo.size == self.size && fbo.accumulator == accumulator;
        if !self.accumulation.as_ref().is_some_and(wanted) {
            if let Some(old) = self.accumulation.take() {
                old.delete(gl);
            }
            let programs = self.programs.accumulation.clone();
            let fbo = FboAccum::fbo_accum_init(gl, programs, self.size, accumulator)?;
            self.accumulation = Some(fbo);
        }
        Ok(())
    }

    fn accumulation_buffer(&self) -> &FboAccum {
        self.accumulation.as_ref().expect("made before it is used")
    }
}
