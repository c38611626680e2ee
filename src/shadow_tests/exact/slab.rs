//! Long lists, divided into slabs.
//!
//! Where a finely divided surface turns away from the light, a cell sees many of its triangles nearly edge-on, one beside
//! the other, and its outline too, so that the cell is not dark as a whole. Such a list is sorted across the cell. A ray
//! passes by most of it together: some casters at a time lie between two planes through the light.

use glam::{DVec2, DVec3, Vec2};

use super::band::Content;
use super::layout::Layout;
use super::node::{self, Node};
use crate::shadow_tests::polygon::{PADDING, extent, larger};

/// A list of as many casters is divided, if an outline passes its cell.
pub const LONG: u32 = 24;
/// How many casters there are in a slab.
const IN_SLAB: usize = 8;
/// How many planes are in front of them.
const PLANES: usize = 2;

/// How many nodes the divided list of so many casters has.
pub fn nodes(casters: u32) -> u32 {
    casters + PLANES as u32 * casters.div_ceil(IN_SLAB as u32)
}

/// How far a caster reaches across a cell, from its middle, in cells.
#[derive(Clone, Copy, Default)]
pub struct Reach {
    least: f64,
    most: f64,
    shape: u32,
}

/// The way across a cell in which its casters are thin.
pub struct Across {
    face: u32,
    middle: DVec2,
    direction: DVec2,
}

impl Across {
    /// Of a cell in a row, counted through all faces. Nearness, of all casters together, grows along `slope`: most of all
    /// across those that are seen edge-on.
    pub fn new(layout: Layout, row: u32, column: u32, slope: Vec2) -> Self {
        Self {
            face: row / layout.side,
            middle: DVec2::new(f64::from(column), f64::from(row % layout.side)) + 0.5,
            direction: slope.as_dvec2().normalize_or(DVec2::X),
        }
    }

    pub fn reach(&self, content: Content, shape: u32) -> Reach {
        let Content {
            layout,
            shapes,
            points,
            seen,
            ..
        } = content;
        let outline = layout.outline(&shapes[shape as usize], self.face, points, seen);
        let corners = outline.corners().iter();
        let places = corners.map(|corner| self.direction.dot(*corner - self.middle));
        let [least, most] = extent(places);
        Reach { least, most, shape }
    }

    /// Writes the nodes of a list, of which there are `first` others in front.
    pub fn write(&self, content: Content, reaches: &mut [Reach], list: &mut [Node], first: u32) {
        let plane = |in_cells| content.layout.plane(self.face, in_cells);
        reaches.sort_unstable_by(|a, b| a.least.total_cmp(&b.least));
        let end = first + list.len() as u32;
        let mut next = first;
        let slabs = list.chunks_mut(PLANES + IN_SLAB);
        for (nodes, casters) in slabs.zip(reaches.chunks(IN_SLAB)) {
            next += nodes.len() as u32;
            let (planes, nodes) = nodes.split_at_mut(PLANES);
            let most = casters.iter().map(|reach| reach.most);
            let most = most.fold(f64::NEG_INFINITY, larger);
            // Beyond this slab the ray may be in the next one; before it there is no other.
            planes[0] = node::of_slab(plane(self.beyond(most + PADDING)), next);
            planes[1] = node::of_slab(plane(-self.beyond(casters[0].least - PADDING)), end);
            for (node, reach) in nodes.iter_mut().zip(casters) {
                *node = content.node_of(reach.shape);
            }
        }
    }

    /// What (x, y, 1) is multiplied with, in cells: not negative where a ray is farther across the cell than this.
    fn beyond(&self, place: f64) -> DVec3 {
        let from_middle = self.direction.dot(self.middle);
        self.direction.extend(-from_middle - place)
    }
}
