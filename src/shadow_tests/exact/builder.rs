//! From a light and what is in its scene to the light buffer: which triangles can cast onto something, and where.

use std::sync::Arc;

use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::caster::{Caster, faces_light};
use super::grid::{Cell, Filling, Group, Layout};
use crate::scene::{Light, Mesh};
use crate::shadow_tests::placed::{Placed, box_corners};
use crate::shadow_tests::space::{LightSpace, Rays};
use crate::shadow_tests::topology::{FaceEdge, Topology};

/// How many triangles or points are worth a thread.
const WORTH_A_THREAD: usize = 1024;

/// The light buffer as the shader reads it.
pub struct LightBuffer {
    pub space: LightSpace,
    pub layout: Layout,
    pub cells: Vec<Cell>,
    /// The cells' lists, one behind the other.
    pub lists: Vec<u32>,
    /// Four vectors for each caster: its plane with its number, from 1 and negative where it faces away from the light,
    /// and the planes of its edges.
    pub casters: Vec<[f32; 4]>,
    /// The number of each mesh's first triangle.
    pub first_triangles: Vec<u32>,
    pub triangle_count: u32,
}

/// Builds light buffers. It keeps what it has found out about each mesh, and its memory: to ask for some megabytes takes
/// as long as to fill them.
#[derive(Default)]
pub struct Builder {
    topologies: Vec<(Arc<Mesh>, Arc<Topology>)>,
    casters: Vec<Caster>,
    /// The number of each caster in the scene.
    numbers: Vec<u32>,
    filling: Filling,
    spare: Option<LightBuffer>,
}

impl Builder {
    /// `scene` is in the order in which it is drawn.
    pub fn build(&mut self, light: &Light, scene: &[Placed]) -> &LightBuffer {
        let topologies: Vec<_> = scene.iter().map(|placed| self.topology(placed)).collect();
        let boxes = scene.iter().zip(&topologies);
        let corners: Vec<DVec3> = boxes
            .flat_map(|(placed, topology)| box_corners(placed.model, topology.bounds))
            .collect();
        let space = LightSpace::new(light, &corners);
        self.casters.clear();
        self.numbers.clear();
        let mut found = Found {
            rays: space.rays,
            receivers: corners.iter().map(|p| space.from_world(*p)).collect(),
            casters: &mut self.casters,
            numbers: &mut self.numbers,
            groups: Vec::new(),
        };
        let mut first_triangles = Vec::new();
        let mut first = 0;
        for (placed, topology) in scene.iter().zip(&topologies) {
            first_triangles.push(first);
            if placed.casts {
                found.add(space.from_object(placed.model), topology, first);
            }
            first += topology.faces.len() as u32;
        }

        let groups = found.groups;
        let layout = Layout::around(space.rays, &self.casters);
        let spare = self.spare.take();
        let (mut cells, mut lists, mut vectors) = spare.map_or_else(Default::default, |spare| {
            (spare.cells, spare.lists, spare.casters)
        });
        self.filling.fill(layout, &self.casters, &groups);
        self.filling.write(&mut cells, &mut lists);
        let casters = self.casters.iter().zip(&self.numbers);
        vectors.clear();
        vectors.extend(
            casters.flat_map(|(caster, number)| caster_vectors(space.rays, caster, *number)),
        );
        self.spare.insert(LightBuffer {
            space,
            layout,
            cells,
            lists,
            casters: vectors,
            first_triangles,
            triangle_count: first,
        })
    }

    fn topology(&mut self, placed: &Placed) -> Arc<Topology> {
        let known = self.topologies.iter();
        let mut known = known.filter(|(mesh, _)| Arc::ptr_eq(mesh, &placed.mesh));
        if let Some((_, topology)) = known.next() {
            return topology.clone();
        }
        let topology = Arc::new(Topology::new(&placed.mesh));
        self.topologies
            .push((placed.mesh.clone(), topology.clone()));
        topology
    }
}

/// What a triangle does.
#[derive(Clone, Copy, PartialEq)]
enum Cast {
    Nothing,
    FacingAway,
    FacingLight,
}

/// What the scene's triangles are to the light.
struct Found<'a> {
    rays: Rays,
    /// The corners of the boxes around everything that shadows can fall on.
    receivers: Vec<DVec3>,
    casters: &'a mut Vec<Caster>,
    numbers: &'a mut Vec<u32>,
    groups: Vec<Group>,
}

impl Found<'_> {
    fn add(&mut self, to_light: DMat4, topology: &Topology, first: u32) {
        let points = topology.points.par_iter().with_min_len(WORTH_A_THREAD);
        let points: Vec<DVec3> = points.map(|p| to_light.transform_point3(*p)).collect();
        let caster = |face: usize| {
            let corners = topology.faces[face].map(|i| points[i as usize]);
            Caster::new(self.rays, corners, topology.closed[face])
        };
        // Between its two ends a ray that meets a closed surface leaves it again, through a face that faces away from
        // the light. Of an open surface every face casts, whichever way it is turned.
        let cast = |face: usize| {
            let corners = topology.faces[face].map(|i| points[i as usize]);
            if topology.closed[face] && faces_light(self.rays, corners) {
                return Cast::Nothing;
            }
            match caster(face).filter(|caster| self.casts_on_something(caster)) {
                None => Cast::Nothing,
                Some(caster) if caster.faces_light => Cast::FacingLight,
                Some(_) => Cast::FacingAway,
            }
        };
        let casts = (0..topology.faces.len()).into_par_iter();
        let casts: Vec<Cast> = casts.with_min_len(WORTH_A_THREAD).map(cast).collect();

        let first_caster = self.casters.len();
        let mut chosen = Vec::new();
        let mut uses = vec![0; topology.edges.len()];
        for component in &topology.components {
            for wanted in [Cast::FacingAway, Cast::FacingLight] {
                let start = chosen.len();
                let of_group = component.iter().map(|face| *face as usize);
                chosen.extend(of_group.filter(|face| casts[*face] == wanted));
                let group = &chosen[start..];
                for FaceEdge { edge, direction } in
                    group.iter().flat_map(|face| topology.face_edges[*face])
                {
                    uses[edge as usize] += direction;
                }
                let mut boundary = Vec::new();
                for FaceEdge { edge, .. } in
                    group.iter().flat_map(|face| topology.face_edges[*face])
                {
                    if std::mem::take(&mut uses[edge as usize]) != 0 {
                        let ends = topology.edges[edge as usize];
                        boundary.push(ends.map(|i| points[i as usize]));
                    }
                }
                if !group.is_empty() {
                    let range = [start, chosen.len()].map(|n| (first_caster + n) as u32);
                    self.groups.push(Group {
                        casters: range[0]..range[1],
                        boundary,
                    });
                }
            }
        }
        let casters = chosen.par_iter().with_min_len(WORTH_A_THREAD);
        let casters = casters.map(|face| caster(*face).expect("it casts"));
        self.casters.par_extend(casters);
        let numbers = chosen.iter().map(|face| first + *face as u32);
        self.numbers.extend(numbers);
    }

    /// Whether anything of the scene can be behind a triangle: a floor under everything casts on nothing.
    fn casts_on_something(&self, caster: &Caster) -> bool {
        let mut receivers = self.receivers.iter();
        receivers.any(|point| caster.is_before(self.rays, *point))
    }
}

fn caster_vectors(rays: Rays, caster: &Caster, number: u32) -> [[f32; 4]; 4] {
    let vector = |v: DVec3, w: f32| {
        let [x, y, z] = v.as_vec3().to_array();
        [x, y, z, w]
    };
    let [ab, bc, ca] = caster.edges.map(|edge| vector(edge, 0.0));
    let number = number as f32 + 1.0;
    let number = if caster.faces_light { number } else { -number };
    [vector(caster.shifted_plane(rays), number), ab, bc, ca]
}
