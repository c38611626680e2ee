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
    /// Of two corners or three.
    pub fn new<const N: usize>(from: [DVec3; N]) -> Self {
        let mut corners = [DVec3::ZERO; MOST_CORNERS];
        corners[..N].copy_from_slice(&from);
        Self { corners, count: N }
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

/// Visits each cell (column, row) that a convex polygon, given in cells, may meet, of a grid with `side` cells a side.
pub fn visit_cells(corners: &[DVec2], side: u32, mut visit: impl FnMut(u32, u32)) {
    let least = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let most = corners
        .iter()
        .copied()
        .fold(DVec2::NEG_INFINITY, DVec2::max);
    let [(left, right), (bottom, top)] =
        [(least.x, most.x), (least.y, most.y)].map(|(least, most)| cells(least, most, side));
    let whole_rows = bottom == top || left == right;
    for row in bottom..=top {
        let (first, last) = if whole_rows {
            (left, right)
        } else {
            let (low, high) = (f64::from(row) - PADDING, f64::from(row) + 1.0 + PADDING);
            let [least, most] = extent(corners, low, high);
            if least > most {
                continue;
            }
            cells(least, most, side)
        };
        for column in first..=last {
            visit(column, row);
        }
    }
}

/// The first and the last cell of a stretch.
fn cells(least: f64, most: f64, side: u32) -> (u32, u32) {
    let end = f64::from(side - 1);
    let cell = |place: f64| place.floor().clamp(0.0, end) as u32;
    (cell(least - PADDING), cell(most + PADDING))
}

/// The least and the largest x of what lies between two heights.
fn extent(corners: &[DVec2], low: f64, high: f64) -> [f64; 2] {
    let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
    let mut take = |x: f64| {
        least = least.min(x);
        most = most.max(x);
    };
    for (i, from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % corners.len()];
        if (low..=high).contains(&from.y) {
            take(from.x);
        }
        for height in [low, high] {
            if (from.y < height) != (to.y < height) {
                take(from.x + (height - from.y) / (to.y - from.y) * (to.x - from.x));
            }
        }
    }
    [least, most]
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
        visit_cells(&corners, 16, |column, row| {
            assert!(visited.insert((column, row)), "twice");
        });
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
