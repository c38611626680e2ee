//! Some rows of cells while they are filled: which casters each cell lists, and what is known of it as a whole.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3, Vec2};

use super::caster::Caster;
use super::layout::{BOUNDARY, Layout, Seen, Shape};
use super::node::{self, Node};
use super::slab::{self, Across, Reach};
use crate::shadow_tests::polygon::{PADDING, extent, larger, smaller, visit_rows};
use crate::shadow_tests::space::Rays;

/// A cell as the shader reads it. Nearness is 1/depth or, where rays are parallel, z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Cell {
    /// What is nearer than this is lit, whatever the list says.
    pub lit_above: f32,
    /// What is farther than this is dark.
    pub dark_below: f32,
    /// Its list's first node, and the one behind its last.
    pub first: u32,
    pub end: u32,
}

/// What the grid is filled with.
#[derive(Clone, Copy)]
pub struct Content<'a> {
    pub layout: Layout,
    /// Sorted by group; a group's boundary is in front of its casters.
    pub shapes: &'a [Shape],
    pub points: &'a [DVec3],
    pub seen: &'a [Seen],
    /// By their triangles' numbers.
    pub casters: &'a [Caster],
}

impl Content<'_> {
    /// A caster's entry in a list.
    pub fn node_of(&self, shape: u32) -> Node {
        let caster = self.shapes[shape as usize].caster;
        node::of_plane(&self.casters[caster as usize], shape)
    }
}

/// A shape that a face sees in some row of a band.
#[derive(Clone, Copy)]
pub struct Piece {
    pub shape: u32,
    pub face: u32,
}

/// A caster that a cell of a band sees.
struct Entry {
    cell: u32,
    shape: u32,
    /// The nearest that it comes to the light there.
    nearest: f32,
}

/// Some rows of cells.
#[derive(Default)]
pub struct Band {
    /// The first and the last, counted through all faces.
    pub rows: [u32; 2],
    cells: Vec<Unfinished>,
    entries: Vec<Entry>,
    /// What the long lists hold, list by list.
    reaches: Vec<Reach>,
    /// How many nodes all lists have together.
    pub nodes: u32,
}

#[derive(Clone, Copy)]
struct Unfinished {
    lit_above: f32,
    dark_below: f32,
    /// The last group whose boundary passes the cell, and the last one that has a caster in it.
    boundary_of: u32,
    some_of: u32,
    /// The farthest of that group here.
    farthest: f32,
    /// Which way nearness grows, summed over the casters here.
    slope: Vec2,
    /// How many entries are of use.
    listed: u32,
    /// Where its casters' reaches begin among the band's; [`NONE`] where the list is short.
    reaches: u32,
}

/// No group, or no place.
const NONE: u32 = u32::MAX;

const EMPTY: Unfinished = Unfinished {
    lit_above: f32::NEG_INFINITY,
    dark_below: f32::NEG_INFINITY,
    boundary_of: NONE,
    some_of: NONE,
    farthest: 0.0,
    slope: Vec2::ZERO,
    listed: 0,
    reaches: NONE,
};

impl Unfinished {
    /// How many nodes its list has.
    fn nodes(&self) -> u32 {
        match self.reaches {
            NONE => self.listed,
            _ => slab::nodes(self.listed),
        }
    }
}

impl Band {
    pub fn fill<'a>(&mut self, content: Content, pieces: impl Iterator<Item = &'a Piece>) {
        let [first, last] = self.rows;
        let count = (last - first + 1) * content.layout.side;
        self.cells.clear();
        self.cells.resize(count as usize, EMPTY);
        self.entries.clear();
        let mut first_of_group = 0;
        let mut group = 0;
        for piece in pieces {
            let shape = &content.shapes[piece.shape as usize];
            if shape.group != group {
                self.cover(group, first_of_group);
                first_of_group = self.entries.len();
                group = shape.group;
            }
            match shape.caster {
                BOUNDARY => self.add_boundary(content, piece, shape),
                _ => self.add_caster(content, piece, shape),
            }
        }
        self.cover(group, first_of_group);
        for entry in &self.entries {
            let cell = &mut self.cells[entry.cell as usize];
            cell.listed += u32::from(entry.nearest >= cell.dark_below);
        }
        let mut reaches = 0;
        self.nodes = 0;
        for cell in &mut self.cells {
            // Where no outline passes, few points ask the list: the cell is dark as a whole.
            if cell.boundary_of != NONE && cell.listed >= slab::LONG {
                cell.reaches = reaches;
                reaches += cell.listed;
            }
            self.nodes += cell.nodes();
        }
        self.reaches.resize(reaches as usize, Reach::default());
    }

    /// Where a group has no boundary, its edge does not run: it covers the cell as a whole, as soon as any of it is there.
    fn cover(&mut self, group: u32, first_entry: usize) {
        for Entry { cell, .. } in &self.entries[first_entry..] {
            let cell = &mut self.cells[*cell as usize];
            if cell.boundary_of != group {
                cell.dark_below = cell.dark_below.max(cell.farthest);
            }
        }
    }

    /// Of a piece, the rows of its face that are in the band; and the number of the face's first cell, as the band counts.
    fn rows_of_face(&self, side: u32, face: u32) -> ([u32; 2], i64) {
        let [first, last] = self.rows.map(|row| i64::from(row) - i64::from(face * side));
        let end = i64::from(side) - 1;
        let rows = [first.max(0) as u32, last.min(end) as u32];
        (rows, -first * i64::from(side))
    }

    fn add_boundary(&mut self, content: Content, piece: &Piece, shape: &Shape) {
        let Content {
            layout,
            points,
            seen,
            ..
        } = content;
        let outline = layout.outline(shape, piece.face, points, seen);
        let (rows, first_cell) = self.rows_of_face(layout.side, piece.face);
        visit_rows(
            outline.corners(),
            layout.side,
            rows,
            |row, [first, last]| {
                let start = first_cell + i64::from(row * layout.side);
                let [first, last] =
                    [first, last].map(|column| (start + i64::from(column)) as usize);
                for cell in &mut self.cells[first..=last] {
                    cell.boundary_of = shape.group;
                }
            },
        );
    }

    fn add_caster(&mut self, content: Content, piece: &Piece, shape: &Shape) {
        let Content {
            layout,
            points,
            seen,
            casters,
            ..
        } = content;
        let outline = layout.outline(shape, piece.face, points, seen);
        let caster = &casters[shape.caster as usize];
        let plane = layout.nearness(piece.face, caster.plane);
        let slope = plane.truncate();
        let steepness = slope.as_vec2();
        let half_range = (0.5 + PADDING) * slope.abs().element_sum();
        // What rounding may do to a nearness, in parallel rays and relative.
        let (offset, share) = match layout.rays {
            Rays::Parallel => (caster.rounding, 0.0),
            Rays::Spot | Rays::Point => (0.0, caster.rounding),
        };
        // No nearer and no farther than the triangle's own corners.
        let corners = outline.corners().iter();
        let [least, most] = extent(corners.map(|corner| slope.dot(*corner) + plane.z));
        let (rows, first_cell) = self.rows_of_face(layout.side, piece.face);
        visit_rows(
            outline.corners(),
            layout.side,
            rows,
            |row, [first, last]| {
                let start = first_cell + i64::from(row * layout.side);
                for column in first..=last {
                    let middle = DVec2::new(f64::from(column), f64::from(row)) + 0.5;
                    let middle = slope.dot(middle) + plane.z;
                    let nearest = smaller(most, middle + half_range) * (1.0 + share) + offset;
                    let farthest = larger(least, middle - half_range) * (1.0 - share) - offset;
                    let (nearest, farthest) = (nearest as f32, farthest as f32);
                    let index = (start + i64::from(column)) as u32;
                    self.entries.push(Entry {
                        cell: index,
                        shape: piece.shape,
                        nearest,
                    });
                    let cell = &mut self.cells[index as usize];
                    cell.slope += steepness;
                    if nearest > cell.lit_above {
                        cell.lit_above = nearest;
                    }
                    if cell.some_of != shape.group || farthest < cell.farthest {
                        cell.farthest = farthest;
                        cell.some_of = shape.group;
                    }
                }
            },
        );
    }

    /// The cells with their lists, one list behind the other, without what lies in the dark anyway. `first` other nodes are
    /// in front of the lists.
    pub fn write(&mut self, content: Content, cells: &mut [Cell], lists: &mut [Node], first: u32) {
        let mut next = first;
        for (cell, from) in cells.iter_mut().zip(&self.cells) {
            *cell = Cell {
                lit_above: from.lit_above,
                dark_below: from.dark_below,
                first: next,
                end: next,
            };
            next += from.nodes();
        }
        for entry in &self.entries {
            let from = &self.cells[entry.cell as usize];
            if entry.nearest < from.dark_below {
                continue;
            }
            let cell = &mut cells[entry.cell as usize];
            if from.reaches == NONE {
                lists[(cell.end - first) as usize] = content.node_of(entry.shape);
            } else {
                let place = from.reaches + cell.end - cell.first;
                let across = self.across(content.layout, entry.cell);
                self.reaches[place as usize] = across.reach(content, entry.shape);
            }
            cell.end += 1;
        }
        let long = (0..).zip(cells).zip(&self.cells);
        for ((index, cell), from) in long.filter(|(_, from)| from.reaches != NONE) {
            let across = self.across(content.layout, index);
            let reaches = &mut self.reaches[from.reaches as usize..][..from.listed as usize];
            cell.end = cell.first + from.nodes();
            let list = &mut lists[(cell.first - first) as usize..(cell.end - first) as usize];
            across.write(content, reaches, list, cell.first);
        }
    }

    fn across(&self, layout: Layout, cell: u32) -> Across {
        let (row, column) = (cell / layout.side, cell % layout.side);
        Across::new(
            layout,
            self.rows[0] + row,
            column,
            self.cells[cell as usize].slope,
        )
    }
}
