//! What the GPU computes: the lab's own vertex shader with `explain.frag`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3, DVec4};
use glow::HasContext;

use super::super::Csci3260;
use super::super::basic_shader::{bias_matrix, with_shadow_test};
use crate::Result;
use crate::gl::{self, Program};
use crate::labs::Probe;

/// What `explain.frag` tells of one fragment.
pub struct Fragment {
    /// Relative to the eye.
    pub position: DVec3,
    pub shadow_coord: DVec3,
    pub cos_theta: f64,
    pub bias: f64,
    /// `ShadowCoord.z` less the bias.
    pub nearer: f64,
    /// What each tap finds in the map; without PCF only the first one counts.
    pub stored: [f64; 5],
    pub visibility: f64,
    pub object: usize,
    pub triangle: usize,
}

impl Csci3260 {
    /// Draws with the explaining program and reads one fragment: a pixel of the picture, or a point of the world.
    /// None where nothing is drawn.
    pub(super) fn fragment(
        &mut self,
        gl: &glow::Context,
        probe: Probe,
    ) -> Result<Option<Fragment>> {
        if self.explainer.is_none() {
            let own = ["M", "objectNumber", "valueNumber"];
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
        let mut values = [0.0; 17];
        for (value, number) in values.iter_mut().zip(0..) {
            *value = read(Some(object), number)?;
        }
        let [
            _,
            triangle,
            x,
            y,
            z,
            s,
            t,
            depth,
            cos_theta,
            bias,
            nearer,
            taps @ ..,
            visibility,
        ] = values;
        Ok(Some(Fragment {
            position: DVec3::new(x, y, z),
            shadow_coord: DVec3::new(s, t, depth),
            cos_theta,
            bias,
            nearer,
            stored: taps,
            visibility,
            object,
            triangle: triangle as usize,
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
        self.select_window(gl, [0.0; 4]);
        self.set_shadow_test(gl, program);
        program.set(gl, "valueNumber", value);
        self.bound.set(None);
        self.draw_scene(gl, |mesh, _| {
            let object = &self.scene().objects[mesh.object];
            self.set_transformations(gl, program, object);
            program.set(gl, "M", self.model_from_eye(object));
            program.set(gl, "objectNumber", mesh.object as i32 + 1);
            only.is_none_or(|only| only == mesh.object)
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
        let eye = self.scene().camera.eye;
        let to_point = DMat4::from_translation(point - eye);
        unsafe { gl.use_program(Some(program.handle)) };
        self.select_window(gl, [0.0; 4]);
        self.set_shadow_test(gl, program);
        program.set(gl, "valueNumber", value);
        program.set(gl, "objectNumber", 1);
        let middle = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        program.set(gl, "MVP", middle);
        program.set(gl, "M", to_point);
        program.set(gl, "normalMatrix", DMat3::IDENTITY);
        let to_light = self.depth_projection_matrix() * self.depth_view_matrix(eye);
        program.set(gl, "DepthBiasMVP", bias_matrix() * to_light * to_point);
        Ok(f64::from(gl::read_float_of_one_vertex(gl)?))
    }
}
