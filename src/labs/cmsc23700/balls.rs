//! The balls on the GPU.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::sync::Arc;

use glam::{DVec3, Vec3};
use glow::HasContext;

use super::scene;
use super::simulation::{MAX_BALLS, Simulation};
use crate::gl::trace::{ObjectKind, name_object};
use crate::scene::Mesh;
use crate::{Error, Result, gl};

/// Where the vertex shaders find what belongs to an instance.
const CENTER: u32 = 3;
const COLOR: u32 = 4;

const VEC3: usize = size_of::<Vec3>();

pub struct Balls {
    pub mesh: Arc<Mesh>,
    buffers: gl::Mesh,
    position_buffer: glow::Buffer,
    /// As the buffer has them.
    positions: Vec<Vec3>,
}

impl Balls {
    /// One ball, and room for the places and colors of as many as there can be.
    pub fn new(gl: &glow::Context) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: the balls");
        let mesh = Arc::new(scene::ball());
        let buffers = gl::Mesh::new(gl, "ball", &mesh)?;
        let position_buffer = instance_buffer(gl, "ball_positions", CENTER)?;
        instance_buffer(gl, "ball_colors", COLOR)?;
        let colors: Vec<Vec3> = scene::ball_colors()
            .map(DVec3::as_vec3)
            .take(MAX_BALLS)
            .collect();
        unsafe {
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, &bytes(&colors), glow::STATIC_DRAW);
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(position_buffer));
            let size = (MAX_BALLS * VEC3) as i32;
            gl.buffer_data_size(glow::ARRAY_BUFFER, size, glow::DYNAMIC_DRAW);
        }
        Ok(Self {
            mesh,
            buffers,
            position_buffer,
            positions: Vec::new(),
        })
    }

    /// Takes the places where the balls are now. They are relative to the box, so that f32 has room for them.
    pub fn take_positions(&mut self, gl: &glow::Context, simulation: &Simulation) {
        let positions: Vec<Vec3> = simulation.positions().map(DVec3::as_vec3).collect();
        if positions == self.positions {
            return;
        }
        if !positions.is_empty() {
            let _pass = gl::pass(gl, "the balls' places");
            unsafe {
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.position_buffer));
                gl.buffer_sub_data_u8_slice(glow::ARRAY_BUFFER, 0, &bytes(&positions));
            }
        }
        self.positions = positions;
    }

    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Draws all of them; `again` if they are what was drawn last.
    pub fn draw(&self, gl: &glow::Context, again: bool) {
        // DEVIATES: instancing, the course draws ball after ball; one call draws them all.
        let count = self.positions.len();
        match again {
            true => self.buffers.draw_instances_again(gl, count),
            false => self.buffers.draw_instances(gl, count),
        }
    }
}

/// A new buffer, bound, whose vectors are an attribute of the vertex array that is bound: one for each instance.
fn instance_buffer(gl: &glow::Context, name: &str, attribute: u32) -> Result<glow::Buffer> {
    unsafe {
        let buffer = gl.create_buffer().map_err(Error::gl)?;
        name_object(ObjectKind::Buffer, buffer.0.get(), name);
        gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
        gl.enable_vertex_attrib_array(attribute);
        gl.vertex_attrib_pointer_f32(attribute, 3, glow::FLOAT, false, VEC3 as i32, 0);
        gl.vertex_attrib_divisor(attribute, 1);
        Ok(buffer)
    }
}

/// What is no ball is an instance too, alone and where its own matrix puts it.
pub fn single_instance(gl: &glow::Context, name: &str, color: DVec3) -> Result<()> {
    for (what, attribute, value) in [
        ("center", CENTER, Vec3::ZERO),
        ("color", COLOR, color.as_vec3()),
    ] {
        instance_buffer(gl, &format!("{name}_{what}"), attribute)?;
        let value = bytes(&[value]);
        unsafe { gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, &value, glow::STATIC_DRAW) };
    }
    Ok(())
}

fn bytes(vectors: &[Vec3]) -> Vec<u8> {
    let numbers = vectors.iter().flat_map(|v| v.to_array());
    numbers.flat_map(f32::to_ne_bytes).collect()
}
