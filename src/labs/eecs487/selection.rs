//! The fast method's buffers: of each caster the triangles that each light draws, and the umbra that none has to.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use std::ops::Range;

use glam::{DVec2, DVec3};
use glow::HasContext;

use super::occluders::Occluder;
use super::scene::{WALLS, Wall};
use super::topology::Topology;
use super::umbra::{Caster, Cube, Parts};
use crate::gl::trace::{ObjectKind, name_object};
use crate::{Error, Result};

/// What the selection hangs on: where the light is, how far it is jittered, and how the casters are turned.
#[derive(Clone, Copy, PartialEq)]
pub struct MadeFor {
    pub light: DVec3,
    pub amount: f64,
    pub rotation: f64,
    /// Without walls there is nothing to draw an umbra on.
    pub has_walls: bool,
    /// Whether shadows beyond a wall's edges can be seen.
    pub beyond: bool,
}

/// Where every shader has the attribute `position`.
const POSITION: u32 = 0;

pub struct Selection {
    made_for: Option<MadeFor>,
    casters: Vec<CasterBuffers>,
    umbra: Positions,
    walls: [OnWall; WALLS.len()],
}

#[derive(Default)]
struct OnWall {
    /// The vertices of its umbra.
    umbra: Range<i32>,
    is_cut: bool,
}

/// The positions of a mesh alone, and the indices of those triangles that a light has to draw.
struct CasterBuffers {
    topology: Topology,
    positions: Positions,
    indices: glow::Buffer,
    /// Of each wall.
    ranges: [Range<i32>; WALLS.len()],
}

struct Positions {
    vertex_array: glow::VertexArray,
    buffer: glow::Buffer,
}

impl Selection {
    pub fn new(gl: &glow::Context, occluders: &[Occluder]) -> Result<Self> {
        let casters = occluders.iter().map(|o| CasterBuffers::new(gl, o));
        Ok(Self {
            made_for: None,
            casters: casters.collect::<Result<_>>()?,
            umbra: Positions::new(gl, "umbra")?,
            walls: Default::default(),
        })
    }

    /// Selects and sends anew what has changed.
    pub fn bring_up_to_date(
        &mut self,
        gl: &glow::Context,
        wanted: MadeFor,
        walls: &[Wall; WALLS.len()],
        occluders: &[Occluder],
    ) {
        if self.made_for.replace(wanted) == Some(wanted) {
            return;
        }
        let parts = self.parts(wanted, walls, occluders);
        let mut vertices = Vec::new();
        for (wall, parts) in parts.iter().enumerate() {
            let first = vertices.len() as i32 / 3;
            for corners in &parts.umbra {
                vertices.extend(two_triangles(*corners));
            }
            self.walls[wall] = OnWall {
                umbra: first..vertices.len() as i32 / 3,
                is_cut: parts.is_cut,
            };
        }
        self.umbra.send(gl, &vertices);
        for (number, caster) in self.casters.iter_mut().enumerate() {
            let mut indices: Vec<u32> = Vec::new();
            for (wall, parts) in parts.iter().enumerate() {
                let first = indices.len() as i32;
                indices.extend(&parts.penumbra[number]);
                caster.ranges[wall] = first..indices.len() as i32;
            }
            caster.send(gl, &indices);
        }
    }

    fn parts(&self, wanted: MadeFor, walls: &[Wall], occluders: &[Occluder]) -> Vec<Parts> {
        let lights = Cube {
            centre: wanted.light,
            reach: wanted.amount,
        };
        let casters = self
            .casters
            .iter()
            .zip(occluders)
            .map(|(caster, occluder)| {
                let model = occluder.model(wanted.rotation);
                let mesh = &occluder.object.mesh;
                let positions = mesh.positions.iter().map(|p| model.transform_point3(*p));
                Caster {
                    positions: positions.collect(),
                    faces: if occluder.object.casts {
                        &mesh.faces
                    } else {
                        &[]
                    },
                    topology: &caster.topology,
                }
            });
        let casters: Vec<Caster> = casters.collect();
        let of_wall = |wall: &Wall| match wanted.has_walls {
            true => Parts::new(wall, lights, &casters, wanted.beyond),
            false => Parts::whole(&casters),
        };
        walls.iter().map(of_wall).collect()
    }

    pub fn has_umbra(&self, wall: usize) -> bool {
        !self.walls[wall].umbra.is_empty()
    }

    pub fn has_penumbra(&self, wall: usize) -> bool {
        self.casters
            .iter()
            .any(|caster| !caster.ranges[wall].is_empty())
    }

    pub fn is_cut(&self, wall: usize) -> bool {
        self.walls[wall].is_cut
    }

    /// Whether each light draws something of a caster, which is known by its number, too.
    pub fn casts(&self, caster: usize, wall: usize) -> bool {
        !self.casters[caster].ranges[wall].is_empty()
    }

    pub fn bind_caster(&self, gl: &glow::Context, caster: usize) {
        unsafe { gl.bind_vertex_array(Some(self.casters[caster].positions.vertex_array)) };
    }

    /// The caster that was bound last.
    pub fn draw_caster(&self, gl: &glow::Context, caster: usize, wall: usize) {
        let range = &self.casters[caster].ranges[wall];
        let offset = range.start * size_of::<u32>() as i32;
        unsafe {
            gl.draw_elements(
                glow::TRIANGLES,
                range.len() as i32,
                glow::UNSIGNED_INT,
                offset,
            )
        };
    }

    pub fn bind_umbrae(&self, gl: &glow::Context) {
        unsafe { gl.bind_vertex_array(Some(self.umbra.vertex_array)) };
    }

    /// After `bind_umbrae`.
    pub fn draw_umbra(&self, gl: &glow::Context, wall: usize) {
        let range = &self.walls[wall].umbra;
        unsafe { gl.draw_arrays(glow::TRIANGLES, range.start, range.len() as i32) };
    }
}

impl CasterBuffers {
    fn new(gl: &glow::Context, occluder: &Occluder) -> Result<Self> {
        let mesh = &occluder.object.mesh;
        let positions = Positions::new(gl, &format!("{}_penumbra", occluder.object.name))?;
        let vertices = mesh.positions.iter().flat_map(|p| p.as_vec3().to_array());
        positions.send(gl, &vertices.collect::<Vec<_>>());
        unsafe {
            let indices = gl.create_buffer().map_err(Error::gl)?;
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(indices));
            Ok(Self {
                topology: Topology::new(mesh),
                positions,
                indices,
                ranges: Default::default(),
            })
        }
    }

    fn send(&self, gl: &glow::Context, indices: &[u32]) {
        unsafe {
            gl.bind_vertex_array(Some(self.positions.vertex_array));
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(self.indices));
            let bytes = bytemuck::cast_slice(indices);
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, bytes, glow::DYNAMIC_DRAW);
        }
    }
}

impl Positions {
    /// The vertex array stays bound.
    fn new(gl: &glow::Context, name: &str) -> Result<Self> {
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(Error::gl)?;
            name_object(ObjectKind::VertexArray, vertex_array.0.get(), name);
            gl.bind_vertex_array(Some(vertex_array));
            let buffer = gl.create_buffer().map_err(Error::gl)?;
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            gl.enable_vertex_attrib_array(POSITION);
            gl.vertex_attrib_pointer_f32(POSITION, 3, glow::FLOAT, false, 0, 0);
            Ok(Self {
                vertex_array,
                buffer,
            })
        }
    }

    fn send(&self, gl: &glow::Context, vertices: &[f32]) {
        unsafe {
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
            let bytes = bytemuck::cast_slice(vertices);
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::DYNAMIC_DRAW);
        }
    }
}

/// A rectangle of a wall, from two opposite corners.
fn two_triangles([low, high]: [DVec2; 2]) -> [f32; 18] {
    let (a, b) = (low.as_vec2(), high.as_vec2());
    let corners = [
        [a.x, a.y],
        [b.x, a.y],
        [b.x, b.y],
        [a.x, a.y],
        [b.x, b.y],
        [a.x, b.y],
    ];
    std::array::from_fn(|i| corners[i / 3].get(i % 3).copied().unwrap_or(0.0))
}
