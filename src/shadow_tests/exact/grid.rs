//! The cells over the light's view: which casters each of them lists, and what is known of it as a whole.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

use super::caster::Caster;
use crate::shadow_tests::polygon::{PADDING, Polygon, visit_cells};
use crate::shadow_tests::space::Rays;

/// How many cells there are for each caster: fewer make longer lists, more take longer to fill. Between 4 and 16 the frames
/// of the labs' scenes differ by less than a tenth.
const CELLS_FOR_A_CASTER: f64 = 8.0;
/// The least and the most cells on each side of the grid: to fill fewer costs nothing, more are worth no memory.
const SIDES: [f64; 2] = [64.0, 512.0];

/// A cell as the shader reads it. Nearness is 1/depth or, where rays are parallel, z.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Cell {
    /// What is nearer than this is lit, whatever the list says.
    pub lit_above: f32,
    /// What is farther than this is dark.
    pub dark_below: f32,
    /// Its list.
    pub first: u32,
    pub count: u32,
}

/// Casters of one component that face one way, as a range of all casters; and their boundary: the edges that they do not
/// use as often in one direction as in the other.
pub struct Group {
    pub casters: Range<u32>,
    pub boundary: Vec<[DVec3; 2]>,
}

/// How the cells lie over the light's view.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    rays: Rays,
    pub side: u32,
    /// The corner, and how many cells there are to a unit.
    pub least: DVec2,
    pub scale: DVec2,
}

/// What the light's view has at most: the beam, or a face.
const VIEW: [DVec2; 2] = [DVec2::NEG_ONE, DVec2::ONE];

impl Layout {
    /// Over the rectangle of what casts.
    pub fn around(rays: Rays, casters: &[Caster]) -> Self {
        let [least_side, most_side] = SIDES;
        let side = (CELLS_FOR_A_CASTER * casters.len() as f64).sqrt().ceil();
        let side = match rays {
            // All casters may lie on one of the six faces.
            Rays::Point => side.clamp(least_side, most_side / 2.0),
            Rays::Spot | Rays::Parallel => side.clamp(least_side, most_side),
        };
        let [least, most] = match rays {
            Rays::Point => VIEW,
            Rays::Spot | Rays::Parallel => {
                let mut least = DVec2::INFINITY;
                let mut most = DVec2::NEG_INFINITY;
                for caster in casters {
                    let polygon = Polygon::new(caster.corners.map(|p| on_face(rays, 0, p)));
                    let [view_least, view_most] = VIEW;
                    for corner in polygon.clipped(view_least, view_most).corners() {
                        least = least.min(corner.truncate() / corner.z);
                        most = most.max(corner.truncate() / corner.z);
                    }
                }
                [least, most]
            }
        };
        // Without casters one cell is over everything, and is empty.
        let scale = side / (most - least);
        let is_flat = !(least.is_finite() && scale.is_finite());
        Self {
            rays,
            side: side as u32,
            least: if is_flat { DVec2::ZERO } else { least },
            scale: if is_flat { DVec2::ZERO } else { scale },
        }
    }

    fn faces(&self) -> usize {
        match self.rays {
            Rays::Point => 6,
            Rays::Spot | Rays::Parallel => 1,
        }
    }

    /// Visits each cell that may see something of a polygon, with its corner in cells, and the polygon's own corners.
    fn visit<const N: usize>(
        &self,
        face: usize,
        points: [DVec3; N],
        mut visit: impl FnMut(usize, DVec2, &[DVec2]),
    ) {
        let side = f64::from(self.side);
        let padding = PADDING / self.scale;
        let polygon = Polygon::new(points.map(|point| on_face(self.rays, face, point)));
        let polygon = polygon.clipped(
            self.least - padding,
            self.least + side / self.scale + padding,
        );
        let mut corners = [DVec2::ZERO; 8];
        for (corner, from) in corners.iter_mut().zip(polygon.corners()) {
            *corner = (from.truncate() / from.z - self.least) * self.scale;
        }
        let corners = &corners[..polygon.corners().len()];
        if corners.is_empty() {
            return;
        }
        let first = face * (self.side * self.side) as usize;
        visit_cells(corners, self.side, |column, row| {
            let cell = first + (row * self.side + column) as usize;
            let corner = DVec2::new(f64::from(column), f64::from(row));
            visit(cell, corner, corners);
        });
    }

    /// The nearness of a caster's plane: what it has of (x, y, 1), in cells.
    fn nearness(&self, face: usize, plane: DVec3) -> DVec3 {
        let on_face = match self.rays {
            Rays::Spot | Rays::Parallel => DVec3::new(plane.x, plane.y, -plane.z),
            Rays::Point => on_face(self.rays, face, plane),
        };
        let slope = on_face.truncate() / self.scale;
        slope.extend(on_face.z + on_face.truncate().dot(self.least))
    }
}

/// A point as a face sees it, as (x, y, depth). Face 2k looks along axis k, face 2k + 1 against it.
fn on_face(rays: Rays, face: usize, point: DVec3) -> DVec3 {
    match rays {
        Rays::Spot => DVec3::new(point.x, point.y, -point.z),
        Rays::Parallel => DVec3::new(point.x, point.y, 1.0),
        Rays::Point => {
            let axis = face / 2;
            let along = [1.0, -1.0][face % 2];
            DVec3::new(
                point[(axis + 1) % 3],
                point[(axis + 2) % 3],
                along * point[axis],
            )
        }
    }
}

/// A caster that a cell sees.
struct Entry {
    cell: u32,
    caster: u32,
    /// The nearest that it comes to the light there.
    nearest: f32,
}

/// The cells while they are filled.
#[derive(Default)]
pub struct Filling {
    cells: Vec<Unfinished>,
    entries: Vec<Entry>,
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
}

const EMPTY: Unfinished = Unfinished {
    lit_above: f32::NEG_INFINITY,
    dark_below: f32::NEG_INFINITY,
    boundary_of: u32::MAX,
    some_of: u32::MAX,
    farthest: 0.0,
};

impl Filling {
    pub fn fill(&mut self, layout: Layout, casters: &[Caster], groups: &[Group]) {
        let count = layout.faces() * (layout.side * layout.side) as usize;
        self.cells.clear();
        self.cells.resize(count, EMPTY);
        self.entries.clear();
        for (group, number) in groups.iter().zip(0..) {
            self.add(layout, number, group, casters);
        }
    }

    fn add(&mut self, layout: Layout, number: u32, group: &Group, casters: &[Caster]) {
        for face in 0..layout.faces() {
            for ends in &group.boundary {
                layout.visit(face, *ends, |cell, _, _| {
                    self.cells[cell].boundary_of = number
                });
            }
            let first_entry = self.entries.len();
            for index in group.casters.clone() {
                self.add_caster(layout, face, number, index, &casters[index as usize]);
            }
            // Where a group has no boundary, its edge does not run: it covers the cell as a whole, as soon as any of it
            // is there.
            for Entry { cell, .. } in &self.entries[first_entry..] {
                let cell = &mut self.cells[*cell as usize];
                if cell.boundary_of != number {
                    cell.dark_below = cell.dark_below.max(cell.farthest);
                }
            }
        }
    }

    fn add_caster(&mut self, layout: Layout, face: usize, group: u32, index: u32, caster: &Caster) {
        let plane = layout.nearness(face, caster.plane);
        let slope = plane.truncate();
        let half_range = (0.5 + PADDING) * slope.abs().element_sum();
        // What rounding may do to a nearness, in parallel rays and relative.
        let (offset, share) = match layout.rays {
            Rays::Parallel => (caster.rounding, 0.0),
            Rays::Spot | Rays::Point => (0.0, caster.rounding),
        };
        let mut range = None;
        layout.visit(face, caster.corners, |cell, corner, polygon| {
            // No nearer and no farther than the triangle's own corners.
            let [least, most] = *range.get_or_insert_with(|| {
                let at = polygon.iter().map(|corner| slope.dot(*corner) + plane.z);
                at.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], at| {
                    [least.min(at), most.max(at)]
                })
            });
            let middle = slope.dot(corner + 0.5) + plane.z;
            let nearest = most.min(middle + half_range) * (1.0 + share) + offset;
            let farthest = least.max(middle - half_range) * (1.0 - share) - offset;
            let (nearest, farthest) = (nearest as f32, farthest as f32);
            self.entries.push(Entry {
                cell: cell as u32,
                caster: index,
                nearest,
            });
            let cell = &mut self.cells[cell];
            cell.lit_above = cell.lit_above.max(nearest);
            cell.farthest = match cell.some_of == group {
                true => cell.farthest.min(farthest),
                false => farthest,
            };
            cell.some_of = group;
        });
    }

    /// The cells with their lists, one list behind the other, without what lies in the dark anyway.
    pub fn write(&self, cells: &mut Vec<Cell>, lists: &mut Vec<u32>) {
        cells.clear();
        cells.extend(self.cells.iter().map(|cell| Cell {
            lit_above: cell.lit_above,
            dark_below: cell.dark_below,
            first: 0,
            count: 0,
        }));
        let is_of_use =
            |entry: &&Entry| entry.nearest >= self.cells[entry.cell as usize].dark_below;
        for entry in self.entries.iter().filter(is_of_use) {
            cells[entry.cell as usize].count += 1;
        }
        let mut end = 0;
        for cell in cells.iter_mut() {
            cell.first = end;
            end += std::mem::take(&mut cell.count);
        }
        lists.clear();
        lists.resize(end as usize, 0);
        for entry in self.entries.iter().filter(is_of_use) {
            let cell = &mut cells[entry.cell as usize];
            lists[(cell.first + cell.count) as usize] = entry.caster;
            cell.count += 1;
        }
    }
}
