//! A mesh on the GPU.

use glow::HasContext;

use super::trace::{ObjectKind, name_object};
use crate::scene;
use crate::{Error, Result};

/// Where every shader finds its vertex attributes; `Program` binds the names to these places.
pub const ATTRIBUTES: [(&str, u32); 3] = [("position", 0), ("normal", 1), ("texture_coord", 2)];

/// Vertices and triangles in buffers, ready to draw.
pub struct Mesh {
    vertex_array: glow::VertexArray,
    buffers: [glow::Buffer; 2],
    index_count: i32,
}

impl Mesh {
    /// Rounds the vertices to f32, once, and sends them to the driver. `name` is for the trace. The vertex array stays
    /// bound: a lab may add attributes of its own.
    pub fn new(gl: &glow::Context, name: &str, mesh: &scene::Mesh) -> Result<Self> {
        let mut vertices: Vec<f32> = Vec::with_capacity(8 * mesh.positions.len());
        for ((position, normal), uv) in mesh
            .positions
            .iter()
            .zip(&mesh.normals)
            .zip(&mesh.texture_coords)
        {
            vertices.extend(position.as_vec3().to_array());
            vertices.extend(normal.as_vec3().to_array());
            vertices.extend(uv.as_vec2().to_array());
        }
        let stride = 8 * size_of::<f32>() as i32;
        let vertices: Vec<u8> = vertices.iter().flat_map(|v| v.to_ne_bytes()).collect();
        let indices = mesh.faces.iter().flatten().flat_map(|i| i.to_ne_bytes());
        let indices: Vec<u8> = indices.collect();

        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(Error::gl)?;
            name_object(ObjectKind::VertexArray, vertex_array.0.get(), name);
            gl.bind_vertex_array(Some(vertex_array));

            let vertex_buffer = gl.create_buffer().map_err(Error::gl)?;
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(vertex_buffer));
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, &vertices, glow::STATIC_DRAW);

            let index_buffer = gl.create_buffer().map_err(Error::gl)?;
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(index_buffer));
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, &indices, glow::STATIC_DRAW);

            let mut offset = 0;
            for ((_, location), components) in ATTRIBUTES.into_iter().zip([3, 3, 2]) {
                gl.enable_vertex_attrib_array(location);
                gl.vertex_attrib_pointer_f32(
                    location,
                    components,
                    glow::FLOAT,
                    false,
                    stride,
                    offset,
                );
                offset += components * size_of::<f32>() as i32;
            }
            Ok(Self {
                vertex_array,
                buffers: [vertex_buffer, index_buffer],
                index_count: 3 * mesh.faces.len() as i32,
            })
        }
    }

    pub fn draw(&self, gl: &glow::Context) {
        self.bind(gl);
        self.draw_again(gl);
    }

    pub fn bind(&self, gl: &glow::Context) {
        unsafe { gl.bind_vertex_array(Some(self.vertex_array)) };
    }

    /// Draws the mesh that was drawn or bound last.
    pub fn draw_again(&self, gl: &glow::Context) {
        unsafe { gl.draw_elements(glow::TRIANGLES, self.index_count, glow::UNSIGNED_INT, 0) };
    }

    /// Draws the mesh as often as there are instances, each with its own values of the attributes that have a divisor.
    pub fn draw_instances(&self, gl: &glow::Context, instances: usize) {
        self.bind(gl);
        self.draw_instances_again(gl, instances);
    }

    /// The same of the mesh that was drawn or bound last.
    pub fn draw_instances_again(&self, gl: &glow::Context, instances: usize) {
        unsafe {
            gl.draw_elements_instanced(
                glow::TRIANGLES,
                self.index_count,
                glow::UNSIGNED_INT,
                0,
                instances as i32,
            );
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe {
            gl.delete_vertex_array(self.vertex_array);
            for buffer in self.buffers {
                gl.delete_buffer(buffer);
            }
        }
    }
}
