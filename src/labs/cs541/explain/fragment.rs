//! What the GPU computes: the lab's own vertex shader with `explain.frag`.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat4, DVec2, DVec3, DVec4, dvec2};
use glow::HasContext;

use super::super::Cs541;
use super::super::programs::{MATRICES, SHADOW_TEST};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::labs::Probe;

/// What `explain.frag` tells of one fragment.
pub struct Fragment {
    /// Relative to the eye.
    pub position: DVec3,
    pub shadow_position: DVec4,
    pub uv: DVec2,
    pub point_depth: f64,
    /// `point_depth` less epsilon.
    pub nearer_depth: f64,
    pub shadow_depth: f64,
    pub in_front: bool,
    pub uv_inside: bool,
    pub inside_beam: bool,
    pub in_shadow: bool,
    pub object: usize,
    pub triangle: usize,
}

impl Cs541 {
    /// Draws with the explaining program and reads one fragment: a pixel of the picture, or a point of the world.
    /// None where nothing is drawn.
    pub(in super::super) fn fragment(
        &mut self,
        gl: &glow::Context,
        probe: Probe,
    ) -> Result<Option<Fragment>> {
        if self.explainer.is_none() {
            self.explainer = Some(explain_program(gl, &self.shaders)?);
        }
        let program = self.explainer.as_ref().expect("made above");
        let read = |objects: &[usize], value| match probe {
            Probe::Pixel(pixel) => self.pixel_value(gl, program, pixel, objects, value),
            Probe::Point(point) => self.point_value(gl, program, point, value),
        };
        // The whole scene decides what is seen; after that its own object is enough.
        let all: Vec<usize> = (0..self.scene.objects.len()).collect();
        let number = read(&all, 0)?;
        if number == 0.0 {
            return Ok(None);
        }
        let object = number as usize - 1;
        let mut values = [0.0; 16];
        for (number, value) in values.iter_mut().enumerate() {
            *value = read(&[object], number as i32)?;
        }
        let [
            _,
            triangle,
            lx,
            ly,
            lz,
            x,
            y,
            z,
            w,
            u,
            v,
            point_depth,
            nearer_depth,
            shadow_depth,
            tests,
            in_shadow,
        ] = values;
        // The shader gets the light's position in f32: less light_vector, that is its own world position.
        let light = self.light().position - self.camera().eye;
        let tests = tests as u32;
        Ok(Some(Fragment {
            position: light.as_vec3().as_dvec3() - DVec3::new(lx, ly, lz),
            shadow_position: DVec4::new(x, y, z, w),
            uv: dvec2(u, v),
            point_depth,
            nearer_depth,
            shadow_depth,
            in_front: tests & 1 != 0,
            uv_inside: tests & 2 != 0,
            inside_beam: tests & 4 != 0,
            in_shadow: in_shadow != 0.0,
            object,
            triangle: triangle as usize,
        }))
    }

    /// One value of the fragment that is seen at a pixel, when these objects are drawn.
    fn pixel_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        [x, y]: [u32; 2],
        objects: &[usize],
        value: i32,
    ) -> Result<f64> {
        let row = self.size[1] - 1 - y;
        // Into the window, not a framebuffer of floats: there a driver may count rows the other way, and round
        // otherwise than in the picture that is explained.
        unsafe {
            gl.enable(glow::SCISSOR_TEST);
            gl.scissor(x as i32, row as i32, 1, 1);
        }
        self.select_window(gl, [0.0; 4]);
        self.use_explainer(gl, program, value);
        let eye = self.camera().eye;
        for index in objects {
            program.set(gl, "object_number", *index as i32 + 1);
            program.set(
                gl,
                "model_matrix",
                self.model_from(eye, &self.scene.objects[*index]),
            );
            self.meshes[*index].draw(gl);
        }
        unsafe { gl.disable(glow::SCISSOR_TEST) };
        Ok(f64::from(gl::read_float_in_bytes(gl, [x, row])))
    }

    /// One value at a point of the world: a single vertex at the object's origin (what an attribute without an array
    /// holds), moved to the point, and projected onto the middle of a viewport of one pixel.
    fn point_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        point: DVec3,
        value: i32,
    ) -> Result<f64> {
        self.select_window(gl, [0.0; 4]);
        self.use_explainer(gl, program, value);
        let middle = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        program.set(gl, "object_number", 1);
        program.set(gl, "persp_matrix", middle);
        program.set(
            gl,
            "model_matrix",
            DMat4::from_translation(point - self.camera().eye),
        );
        Ok(f64::from(gl::read_float_of_one_vertex(gl)?))
    }

    fn use_explainer(&self, gl: &glow::Context, program: &Program, value: i32) {
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_map(gl, program);
        program.set(
            gl,
            "light_position",
            self.light().position - self.camera().eye,
        );
        program.set(gl, "value_number", value);
    }
}

fn explain_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let own = ["light_position", "object_number", "value_number"];
    let uniforms = [&MATRICES[..], &SHADOW_TEST, &own].concat();
    Program::new(gl, shaders, "lighting.vert", "explain.frag", &uniforms)
}
