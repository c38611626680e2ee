//! What the GPU computes: the lab's own vertex shader with `explain.frag`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3, DVec4};
use glow::HasContext;

use super::super::second_pass::with_shadow_test;
use super::super::{Cmsc23700, lights};
use crate::Result;
use crate::gl::{self, Program};
use crate::labs::Probe;

/// What `explain.frag` tells of one fragment.
pub struct Fragment {
    pub eye_position: DVec3,
    /// Before and after the division by w.
    pub coord: DVec4,
    pub place: DVec3,
    pub spot_dot: f64,
    /// The depth less the bias.
    pub nearer: f64,
    pub stored: f64,
    /// S_l.
    pub shadow: f64,
    /// Its number among all that is drawn: the objects, then the balls.
    pub object: usize,
    pub triangle: usize,
}

impl Cmsc23700 {
    /// Draws with the explaining program and reads one fragment: a pixel of the picture, or a point of the world.
    /// None where nothing is drawn.
    pub(super) fn fragment(
        &mut self,
        gl: &glow::Context,
        probe: Probe,
        light: usize,
    ) -> Result<Option<Fragment>> {
        if self.explainer.is_none() {
            let own = ["light", "objectNumber", "valueNumber"];
            let program = with_shadow_test(gl, &self.shaders, "explain.frag", &own)?;
            unsafe { gl.use_program(Some(program.handle)) };
            lights::set_shadow_test(gl, &program, &self.scene, &self.light_cameras);
            self.explainer = Some(program);
        }
        let program = self.explainer.as_ref().expect("made above");
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_maps(gl, program);
        program.set(gl, "light", light as i32);
        let read = |only: Option<usize>, value| {
            program.set(gl, "valueNumber", value);
            match probe {
                Probe::Pixel(pixel) => Ok(self.pixel_value(gl, program, pixel, only)),
                Probe::Point(point) => self.point_value(gl, program, point),
            }
        };
        // The whole scene decides what is seen; after that its own object, or the balls, are enough.
        let number = read(None, 0)?;
        if number == 0.0 {
            return Ok(None);
        }
        let only = (number as usize - 1).min(self.scene.objects.len());
        let mut values = [0.0; 16];
        for (value, number) in values.iter_mut().zip(0..) {
            *value = read(Some(only), number)?;
        }
        let [
            number,
            triangle,
            x,
            y,
            z,
            s,
            t,
            r,
            q,
            u,
            v,
            depth,
            spot_dot,
            nearer,
            stored,
            shadow,
        ] = values;
        let object = number as usize - 1;
        Ok(Some(Fragment {
            eye_position: DVec3::new(x, y, z),
            coord: DVec4::new(s, t, r, q),
            place: DVec3::new(u, v, depth),
            spot_dot,
            nearer,
            stored,
            shadow,
            object,
            // Some drivers count on from instance to instance.
            triangle: match self.scene.objects.get(object) {
                Some(_) => triangle as usize,
                None => triangle as usize % self.balls.mesh.faces.len(),
            },
        }))
    }

    /// One value of the fragment that is seen at a pixel, when one object or the balls are drawn, or all.
    fn pixel_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        [x, y]: [u32; 2],
        only: Option<usize>,
    ) -> f64 {
        let row = self.size[1] - 1 - y;
        // Into the window, where the driver rounds as it does in the picture that is explained.
        unsafe {
            gl.enable(glow::SCISSOR_TEST);
            gl.scissor(x as i32, row as i32, 1, 1);
        }
        self.select_window(gl, [0.0; 4]);
        program.set(gl, "projection", self.projection());
        self.draw_scene(
            gl,
            |number| {
                program.set(gl, "objectNumber", number as i32 + 1);
                only.is_none_or(|only| only == number)
            },
            |_, model| program.set(gl, "modelView", self.model_view(model)),
        );
        unsafe { gl.disable(glow::SCISSOR_TEST) };
        f64::from(gl::read_float_in_bytes(gl, [x, row]))
    }

    /// One value at a point of the world: a single vertex at the origin of its object (what attributes without an array
    /// hold), moved to the point, and projected onto the middle of a viewport of one pixel.
    fn point_value(&self, gl: &glow::Context, program: &Program, point: DVec3) -> Result<f64> {
        self.select_window(gl, [0.0; 4]);
        program.set(gl, "objectNumber", 1);
        program.set(
            gl,
            "modelView",
            self.model_view(DMat4::from_translation(point)),
        );
        let middle = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        program.set(gl, "projection", middle);
        Ok(f64::from(gl::read_float_of_one_vertex(gl)?))
    }
}
