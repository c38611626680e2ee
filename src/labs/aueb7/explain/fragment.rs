//! What the GPU computes: the lab's own vertex shader and shadow test with `explain.frag`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3, DVec4};
use glow::HasContext;

use super::super::Aueb7;
use super::super::programs::with_shadow_test;
use crate::Result;
use crate::gl::{self, Program};
use crate::labs::Probe;

/// How many values `explain.frag` has.
const VALUES: usize = 29;

/// What `explain.frag` tells of one fragment.
pub struct Fragment {
    pub position_ecs: DVec3,
    pub position_lcs: DVec4,
    /// `position_lcs.z` less the bias.
    pub nearer: f64,
    /// What each sample of PCF finds in the map, and what `is_point_in_shadow` makes of it; the first is the center.
    pub stored: [f64; 9],
    pub visible: [f64; 9],
    pub shadow_factor: f64,
    pub object: usize,
    pub triangle: usize,
}

impl Aueb7 {
    /// Draws with the explaining program and reads one fragment: a pixel of the picture, or a point of the world.
    /// None where nothing is drawn.
    pub(super) fn fragment(
        &mut self,
        gl: &glow::Context,
        probe: Probe,
    ) -> Result<Option<Fragment>> {
        if self.explainer.is_none() {
            let own = ["object_number", "value_number"];
            let program = with_shadow_test(gl, &self.shaders, "explain.frag", &own)?;
            self.explainer = Some(program);
        }
        let program = self.explainer.as_ref().expect("made above");
        let read = |object: Option<usize>, value| match probe {
            Probe::Pixel(pixel) => Ok(self.pixel_value(gl, program, pixel, object, value)),
            Probe::Point(point) => self.point_value(gl, program, point, value),
        };
        // The whole scene decides what is seen; after that its own object is enough.
        let number = read(None, 0)?;
        if number == 0.0 {
            return Ok(None);
        }
        let object = number as usize - 1;
        let mut values = [0.0; VALUES];
        for (value, number) in values.iter_mut().zip(0..) {
            *value = read(Some(object), number)?;
        }
        let nine = |from: usize| std::array::from_fn(|i| values[from + i]);
        Ok(Some(Fragment {
            triangle: values[1] as usize,
            position_ecs: DVec3::from_slice(&values[2..5]),
            position_lcs: DVec4::from_slice(&values[5..9]),
            nearer: values[9],
            stored: nine(10),
            visible: nine(19),
            shadow_factor: values[28],
            object,
        }))
    }

    /// One value of the fragment that is seen at a pixel, when one object is drawn, or all.
    fn pixel_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        [x, y]: [u32; 2],
        only: Option<usize>,
        value: i32,
    ) -> f64 {
        let row = self.size[1] - 1 - y;
        // Into the window, where the driver rounds as it does in the picture that is explained.
        unsafe {
            gl.enable(glow::SCISSOR_TEST);
            gl.scissor(x as i32, row as i32, 1, 1);
            gl.use_program(Some(program.handle));
        }
        self.clear_window(gl, [0.0; 4]);
        self.use_shadow_map(gl, program);
        program.set(gl, "value_number", value);
        let mut bound = None;
        self.draw(gl, |index, _, model| {
            self.bind_texture(gl, index, &mut bound);
            self.set_model(gl, program, model);
            program.set(gl, "object_number", index as i32 + 1);
            only.is_none_or(|only| only == index)
        });
        unsafe { gl.disable(glow::SCISSOR_TEST) };
        f64::from(gl::read_float_in_bytes(gl, [x, row]))
    }

    /// One value at a point of the world: a single vertex at the origin of its object (what an attribute without an array
    /// holds), moved to the point, and projected onto the middle of a viewport of one pixel.
    fn point_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        point: DVec3,
        value: i32,
    ) -> Result<f64> {
        unsafe { gl.use_program(Some(program.handle)) };
        self.clear_window(gl, [0.0; 4]);
        self.use_shadow_map(gl, program);
        program.set(gl, "value_number", value);
        program.set(gl, "object_number", 1);
        let middle = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        program.set(gl, "uniform_p", middle);
        self.set_model(gl, program, DMat4::from_translation(point));
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.white));
        }
        Ok(f64::from(gl::read_float_of_one_vertex(gl)?))
    }
}
