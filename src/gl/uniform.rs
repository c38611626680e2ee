//! Uniforms and the values that they take.

use std::cell::Cell;

use glam::{DMat3, DMat4, DVec3, DVec4};
use glow::HasContext;

/// A uniform of one program.
pub struct Uniform {
    /// None where the program has no active uniform of that name.
    location: Option<glow::UniformLocation>,
    /// What the driver has: a program keeps its uniforms' values from frame to frame.
    sent: Cell<Option<Value>>,
}

impl Uniform {
    pub fn look_up(gl: &glow::Context, program: glow::Program, name: &str) -> Self {
        Self {
            location: unsafe { gl.get_uniform_location(program, name) },
            sent: Cell::new(None),
        }
    }

    pub fn is_active(&self) -> bool {
        self.location.is_some()
    }

    pub fn set(&self, gl: &glow::Context, value: Value) {
        if self.is_active() && self.sent.replace(Some(value)) != Some(value) {
            value.send(gl, self.location.as_ref());
        }
    }
}

/// A value as the driver gets it. Numbers are f64 until here, and rounded to f32 once.
#[derive(Clone, Copy, PartialEq)]
pub enum Value {
    Mat4([f32; 16]),
    Mat3([f32; 9]),
    Vec4([f32; 4]),
    Vec3([f32; 3]),
    Float(f32),
    /// Samplers (their texture unit), choices and, as 0 or 1, `bool`s.
    Int(i32),
}

impl Value {
    fn send(self, gl: &glow::Context, location: Option<&glow::UniformLocation>) {
        unsafe {
            match self {
                Self::Mat4(columns) => gl.uniform_matrix_4_f32_slice(location, false, &columns),
                Self::Mat3(columns) => gl.uniform_matrix_3_f32_slice(location, false, &columns),
                Self::Vec4([x, y, z, w]) => gl.uniform_4_f32(location, x, y, z, w),
                Self::Vec3([x, y, z]) => gl.uniform_3_f32(location, x, y, z),
                Self::Float(value) => gl.uniform_1_f32(location, value),
                Self::Int(value) => gl.uniform_1_i32(location, value),
            }
        }
    }
}

impl From<DMat4> for Value {
    fn from(matrix: DMat4) -> Self {
        Self::Mat4(matrix.as_mat4().to_cols_array())
    }
}

impl From<DMat3> for Value {
    fn from(matrix: DMat3) -> Self {
        Self::Mat3(matrix.as_mat3().to_cols_array())
    }
}

impl From<DVec4> for Value {
    fn from(vector: DVec4) -> Self {
        Self::Vec4(vector.as_vec4().to_array())
    }
}

impl From<DVec3> for Value {
    fn from(vector: DVec3) -> Self {
        Self::Vec3(vector.as_vec3().to_array())
    }
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Float(value as f32)
    }
}

impl From<i32> for Value {
    fn from(value: i32) -> Self {
        Self::Int(value)
    }
}
