//! From a light and what is in its scene to the light buffer: which triangles can cast onto something, and where.

use std::sync::Arc;

use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::band::{Cell, Content};
use super::caster::Caster;
use super::grid::Filling;
use super::layout::{BOUNDARY, Layout, Seen, Shape};
use super::node::{self, EDGES, Node};
use crate::scene::{Light, Mesh};
use crate::shadow_tests::placed::{Placed, box_corners};
use crate::shadow_tests::space::{LightSpace, Rays};
use crate::shadow_tests::topology::{Topology, Use};

/// How many triangles or points are worth a thread.
pub const WORTH_A_THREAD: usize = 1024;

/// The light buffer as the shader reads it.
#[derive(Clone)]
pub struct LightBuffer {
    pub space: LightSpace,
    pub layout: Layout,
    pub cells: Vec<Cell>,
    /// Three for the edges of each shape, which are left as they are where that is no caster. Then the cells' lists, one
    /// behind the other.
    pub nodes: Vec<Node>,
    /// Where the lists begin.
    pub first_list: u32,
}

/// Builds light buffers. It keeps what it has found out about each mesh, and its memory: to ask for some megabytes takes
/// as long as to fill them.
#[derive(Default)]
pub struct Builder {
    topologies: Vec<(Arc<Mesh>, Arc<Topology>)>,
    points: Vec<DVec3>,
    seen: Vec<Seen>,
    /// By the triangles' numbers, where they cast.
    casters: Vec<Caster>,
    shapes: Vec<Shape>,
    filling: Filling,
    spare: Option<LightBuffer>,
}

impl Builder {
    pub fn build(&mut self, light: &Light, scene: &[Placed]) -> &LightBuffer {
        let topologies: Vec<_> = scene.iter().map(|placed| self.topology(placed)).collect();
        let boxes = scene.iter().zip(&topologies);
        let corners: Vec<DVec3> = boxes
            .flat_map(|(placed, topology)| box_corners(placed.model, topology.bounds))
            .collect();
        let space = LightSpace::new(light, &corners);
        let spare = self.spare.take();
        let spare = spare.map(|spare| (spare.cells, spare.nodes));
        let (mut cells, mut nodes) = spare.unwrap_or_default();
        let faces = topologies.iter().map(|topology| topology.faces.len());
        let triangle_count: usize = faces.sum();
        // What the last build left is written over, and not cleared.
        self.casters.resize(triangle_count, Caster::default());
        self.points.clear();
        self.seen.clear();
        self.shapes.clear();
        let mut found = Found {
            rays: space.rays,
            receivers: corners.iter().map(|p| space.from_world(*p)).collect(),
            points: &mut self.points,
            seen: &mut self.seen,
            casters: &mut self.casters,
            shapes: &mut self.shapes,
            groups: 0,
        };
        let mut first = 0;
        for (placed, topology) in scene.iter().zip(&topologies) {
            if placed.casts {
                found.add(space.from_object(placed.model), topology, first);
            }
            first += topology.faces.len() as u32;
        }

        let layout = Layout::around(space.rays, &self.points, &self.seen, &self.shapes);
        let content = Content {
            layout,
            shapes: &self.shapes,
            points: &self.points,
            seen: &self.seen,
            casters: &self.casters,
        };
        let listed = self.filling.fill(content);
        cells.resize(layout.cell_count(), Cell::default());
        let first_list = EDGES * self.shapes.len();
        nodes.resize(first_list + listed, Node::default());
        let (edges, lists) = nodes.split_at_mut(first_list);
        write_edges(content, edges);
        let first_list = first_list as u32;
        self.filling.write(content, &mut cells, lists, first_list);
        self.spare.insert(LightBuffer {
            space,
            layout,
            cells,
            nodes,
            first_list,
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
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Cast {
    Nothing,
    FacingAway,
    FacingLight,
}

const SIDES: [Cast; 2] = [Cast::FacingAway, Cast::FacingLight];

/// What the scene's triangles are to the light.
struct Found<'a> {
    rays: Rays,
    /// The corners of the boxes around everything that shadows can fall on.
    receivers: Vec<DVec3>,
    points: &'a mut Vec<DVec3>,
    seen: &'a mut Vec<Seen>,
    casters: &'a mut [Caster],
    shapes: &'a mut Vec<Shape>,
    groups: u32,
}

impl Found<'_> {
    fn add(&mut self, to_light: DMat4, topology: &Topology, first: u32) {
        let rays = self.rays;
        let first_point = self.points.len();
        let points = topology.points.par_iter().with_min_len(WORTH_A_THREAD);
        let points = points.map(|p| to_light.transform_point3(*p));
        self.points.par_extend(points);
        let points = self.points[first_point..].par_iter();
        let seen = points.with_min_len(WORTH_A_THREAD);
        self.seen.par_extend(seen.map(|p| Seen::new(rays, *p)));

        let (receivers, points) = (&self.receivers, &self.points);
        let numbers = first as usize..first as usize + topology.faces.len();
        let faces = topology.faces.par_iter().with_min_len(WORTH_A_THREAD);
        let faces = faces.zip(&topology.closed).zip(&mut self.casters[numbers]);
        let casts = faces.map(|((face, closed), caster)| {
            let corners = corners(&points[first_point..], *face);
            let found = Caster::new(rays, corners, *closed);
            let Some(found) = found.filter(|found| casts_on_something(rays, found, receivers))
            else {
                return Cast::Nothing;
            };
            *caster = found;
            match found.faces_light {
                true => Cast::FacingLight,
                false => Cast::FacingAway,
            }
        });
        let casts: Vec<Cast> = casts.collect();
        self.add_shapes(topology, &casts, first_point as u32, first);
    }

    /// The casters of each component that face one way, behind their boundary: the edges that they do not use as often in
    /// one direction as in the other.
    fn add_shapes(&mut self, topology: &Topology, casts: &[Cast], first_point: u32, first: u32) {
        let edges = (0..topology.edges.len()).into_par_iter();
        let boundary = edges
            .with_min_len(WORTH_A_THREAD)
            .fold(Vec::new, |mut found, edge| {
                let uses = topology.uses(edge);
                // Nearly all edges: between two casters, or between two others.
                if let [one, other] = uses
                    && casts[one.face as usize] == casts[other.face as usize]
                    && one.direction + other.direction == 0
                {
                    return found;
                }
                let mut balances = [0; 2];
                for Use { face, direction } in uses {
                    match casts[*face as usize] {
                        Cast::Nothing => {}
                        Cast::FacingAway => balances[0] += direction,
                        Cast::FacingLight => balances[1] += direction,
                    }
                }
                for (side, balance) in SIDES.into_iter().zip(balances) {
                    if balance != 0 {
                        let [a, b] = topology.edges[edge].map(|i| i + first_point);
                        let component = topology.component_of[uses[0].face as usize];
                        found.push((component, side, [a, b, b]));
                    }
                }
                found
            });
        let mut boundary = boundary.collect::<Vec<_>>().concat();
        boundary.sort_unstable_by_key(|(component, side, _)| (*component, *side));
        let mut boundary = boundary.into_iter().peekable();

        for (component, number) in topology.components.iter().zip(0..) {
            for side in SIDES {
                let group = self.groups;
                let of_group =
                    |(of, its_side, _): &(u32, Cast, _)| (*of, *its_side) == (number, side);
                while let Some((_, _, points)) = boundary.next_if(of_group) {
                    self.shapes.push(Shape {
                        points,
                        group,
                        caster: BOUNDARY,
                    });
                }
                let chosen = component
                    .iter()
                    .filter(|face| casts[**face as usize] == side);
                let shapes = chosen.map(|face| Shape {
                    points: topology.faces[*face as usize].map(|i| i + first_point),
                    group,
                    caster: first + *face,
                });
                self.shapes.extend(shapes);
                self.groups += 1;
            }
        }
    }
}

/// By hand: `map` of an array may be left as calls, here and in the other loops over all triangles.
fn corners(points: &[DVec3], [a, b, c]: [u32; 3]) -> [DVec3; 3] {
    let corner = |point: u32| points[point as usize];
    [corner(a), corner(b), corner(c)]
}

/// The planes through the light and the casters' edges.
fn write_edges(content: Content, nodes: &mut [Node]) {
    let rays = content.layout.rays;
    let nodes = nodes
        .par_chunks_exact_mut(EDGES)
        .with_min_len(WORTH_A_THREAD);
    let shapes = nodes.zip(content.shapes).enumerate();
    let casters = shapes.filter(|(_, (_, shape))| shape.caster != BOUNDARY);
    casters.for_each(|(place, (nodes, shape))| {
        let corners = corners(content.points, shape.points);
        let planes = content.casters[shape.caster as usize].edges(rays, corners);
        nodes.copy_from_slice(&node::of_edges(planes, place as u32));
    });
}

/// Whether anything of the scene can be behind a triangle: a floor under everything casts on nothing.
fn casts_on_something(rays: Rays, caster: &Caster, receivers: &[DVec3]) -> bool {
    let mut receivers = receivers.iter();
    receivers.any(|point| caster.is_before(rays, *point))
}
