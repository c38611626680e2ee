//! Which cells of a grid a convex polygon meets.

use glam::{DVec2, DVec3};

/// How much larger than itself each cell is taken for, in cells. A fragment finds its cell in f32, which moves it by
/// some 1e-4 cells, and more where a triangle reaches far beyond its distance from the light.
pub const PADDING: f64 = 1.0 / 32.0;

/// A triangle has 3 corners, and each of the 4 clip planes may add one.
const MOST_CORNERS: usize = 7;

/// Corners as (x, y, w): seen at (x/w, y/w). What is cut by w = 0 is still one polygon here.
#[derive(Clone, Copy)]
pub struct Polygon {
    corners: [DVec3; MOST_CORNERS],
    count: usize,
}

impl Polygon {
    /// A triangle; or an edge, with two corners at one end.
    pub fn new(from: [DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; MOST_CORNERS];
        corners[..3].copy_from_slice(&from);
        Self { corners, count: 3 }
    }

    pub fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// What of it is seen between two corners of a rectangle. Nothing of that has w < 0, and w = 0 only at the origin.
    pub fn clipped(mut self, least: DVec2, most: DVec2) -> Self {
        for plane in [
            DVec3::new(1.0, 0.0, -least.x),
            DVec3::new(-1.0, 0.0, most.x),
            DVec3::new(0.0, 1.0, -least.y),
            DVec3::new(0.0, -1.0, most.y),
        ] {
            self.clip(plane);
        }
        self
    }

    /// Keeps what is on the plane's positive side (Sutherland and Hodgman 1974).
    fn clip(&mut self, plane: DVec3) {
        if self.corners().iter().all(|c| plane.dot(*c) >= 0.0) {
            return;
        }
        let sides = self.corners.map(|corner| plane.dot(corner));
        let sides = &sides[..self.count];
        let whole = *self;
        self.count = 0;
        for (i, side) in sides.iter().enumerate() {
            let next = (i + 1) % whole.count;
            if *side >= 0.0 {
                self.push(whole.corners[i]);
            }
            if (*side >= 0.0) != (sides[next] >= 0.0) {
                let share = side / (side - sides[next]);
                self.push(whole.corners[i].lerp(whole.corners[next], share));
            }
        }
    }

    fn push(&mut self, corner: DVec3) {
        // A polygon of two corners is a line there and back, whose crossings come twice.
        if self.count < MOST_CORNERS {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }
}

/// The first and the last row that a polygon, given in cells, may meet, of a grid with `side` cells a side.
pub fn rows(corners: &[DVec2], side: u32) -> [u32; 2] {
    cells(extent(corners.iter().map(|corner| corner.y)), side)
}

/// An edge of a polygon, from its lower end to its upper one.
#[derive(Clone, Copy, Default)]
struct Edge {
    low: f64,
    high: f64,
    /// At the lower end.
    x: f64,
    slope: f64,
}

impl Edge {
    fn new(from: DVec2, to: DVec2) -> Self {
        let (low, high) = if from.y < to.y {
            (from, to)
        } else {
            (to, from)
        };
        // Of a level edge one corner is enough: the other one is on the next edge too.
        let slope = if low.y < high.y {
            (high.x - low.x) / (high.y - low.y)
        } else {
            0.0
        };
        Self {
            low: low.y,
            high: high.y,
            x: low.x,
            slope,
        }
    }
}

/// Visits the rows between a first and a last one, each with the first and the last cell that the polygon may meet there.
pub fn visit_rows(
    corners: &[DVec2],
    side: u32,
    [first, last]: [u32; 2],
    mut visit: impl FnMut(u32, [u32; 2]),
) {
    let [left, right] = cells(extent(corners.iter().map(|corner| corner.x)), side);
    let [bottom, top] = rows(corners, side);
    let mut edges = [Edge::default(); MOST_CORNERS];
    let edges = &mut edges[..corners.len()];
    let is_scanned = left < right && bottom < top;
    if is_scanned {
        let mut from = corners[corners.len() - 1];
        for (edge, to) in edges.iter_mut().zip(corners) {
            *edge = Edge::new(from, *to);
            from = *to;
        }
    }
    for row in bottom.max(first)..=top.min(last) {
        if !is_scanned {
            visit(row, [left, right]);
            continue;
        }
        let (low, high) = (f64::from(row) - PADDING, f64::from(row) + 1.0 + PADDING);
        let mut reached = [f64::INFINITY, f64::NEG_INFINITY];
        for edge in &*edges {
            let (start, end) = (larger(edge.low, low), smaller(edge.high, high));
            if start <= end {
                let start = edge.x + (start - edge.low) * edge.slope;
                let end = edge.x + (end - edge.low) * edge.slope;
                reached[0] = smaller(reached[0], smaller(start, end));
                reached[1] = larger(reached[1], larger(start, end));
            }
        }
        if reached[0] <= reached[1] {
            visit(row, cells(reached, side));
        }
    }
}

/// The first and the last cell of a stretch.
fn cells([least, most]: [f64; 2], side: u32) -> [u32; 2] {
    let end = f64::from(side - 1);
    // What is not negative is rounded down.
    let cell = |place: f64| smaller(larger(place, 0.0), end) as u32;
    [cell(least - PADDING), cell(most + PADDING)]
}

/// The least and the largest of some values.
pub fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    values.fold(nothing, |[least, most], value| {
        [smaller(least, value), larger(most, value)]
    })
}

/// One instruction each: nothing here is NaN, for which `f64::min` and `f64::max` care.
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_across_w_0_is_cut_to_the_rectangle() {
        let polygon = Polygon::new([
            DVec3::new(0.0, 0.0, 1.0),
            DVec3::new(5.0, 0.5, -3.0),
            DVec3::new(0.0, 0.5, 1.0),
        ]);
        let cut = polygon.clipped(DVec2::splat(-1.0), DVec2::splat(1.0));
        assert!(cut.corners().len() >= 3);
        for corner in cut.corners() {
            assert!(
                corner.z > 0.0 && corner.x.abs() <= corner.z + 1e-12,
                "{corner}"
            );
        }
        // Wholly behind the light there is nothing to see.
        let behind = Polygon::new([DVec3::NEG_Z, -DVec3::ONE, DVec3::new(0.0, 1.0, -2.0)]);
        let cut = behind.clipped(DVec2::splat(-1.0), DVec2::splat(1.0));
        assert_eq!(cut.corners(), []);
    }

    #[test]
    fn the_cells_are_those_that_points_of_the_triangle_are_in() {
        let corners = [
            DVec2::new(1.3, 2.1),
            DVec2::new(14.2, 4.7),
            DVec2::new(3.9, 12.4),
        ];
        let mut visited = std::collections::BTreeSet::new();
        visit_rows(&corners, 16, [0, 15], |row, [first, last]| {
            for column in first..=last {
                assert!(visited.insert((column, row)), "twice");
            }
        });
        // A part of the rows is a part of the cells.
        let mut part = std::collections::BTreeSet::new();
        visit_rows(&corners, 16, [4, 6], |row, [first, last]| {
            part.extend((first..=last).map(|column| (column, row)));
        });
        let in_rows = visited.iter().filter(|(_, row)| (4..=6).contains(row));
        assert!(in_rows.eq(&part));
        let mut met = std::collections::BTreeSet::new();
        let steps = 400;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let (s, t) = (f64::from(i) / 400.0, f64::from(j) / 400.0);
                let point = (1.0 - s - t) * corners[0] + s * corners[1] + t * corners[2];
                met.insert((point.x as u32, point.y as u32));
            }
        }
        assert!(met.is_subset(&visited));
        // And hardly more.
        assert!(
            visited.len() <= met.len() + 8,
            "{} {}",
            visited.len(),
            met.len()
        );
    }
}
