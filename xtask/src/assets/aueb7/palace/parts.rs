//! What the palace is put together from: slabs, painted walls, columns, windows, and the horns on the roofs.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::{Palace, STOREY, at, floor};
use crate::assets::build::{Ends, bar, block, moved, turned};

/// A box of stone or paving: one repeat of the picture is eight units.
pub fn slab(low: [f64; 3], high: [f64; 3]) -> Mesh {
    block(low.into(), high.into(), |position, normal| {
        let flat = if normal.y.abs() > 0.5 {
            DVec2::new(position.x, -position.z)
        } else {
            DVec2::new(position.x + position.z, position.y)
        };
        flat / 8.0
    })
}

/// A painted box: the picture's height is the storey's, and it repeats along the wall.
pub fn wall(low: [f64; 3], high: [f64; 3]) -> Mesh {
    block(low.into(), high.into(), |position, normal| {
        let (bottom, top) = (low[1] + 0.1, low[1] + STOREY - 0.5);
        let up = (position.y - bottom) / (top - bottom).min(high[1] - low[1]);
        let along = if normal.x.abs() > 0.5 {
            position.z
        } else {
            position.x
        };
        // Roofs hide the upper side.
        let up = if normal.y.abs() > 0.5 {
            0.5
        } else {
            up.clamp(0.002, 0.998)
        };
        DVec2::new(along / 7.0, up)
    })
}

/// A thin fresco before a wall that faces +z: from corner to corner, its back sunk into the wall.
pub fn panel(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let (low, high) = (DVec3::from(low) - 0.2 * DVec3::Z, DVec3::from(high));
    block(low, high, |position, _| {
        DVec2::new(
            position.x / 4.5,
            ((position.y - low.y) / (high.y - low.y)).clamp(0.002, 0.998),
        )
    })
}

/// `count` places from one to the other (x and z).
pub fn row(from: [f64; 2], to: [f64; 2], count: u32) -> Vec<DVec2> {
    (0..count)
        .map(|i| DVec2::from(from).lerp(to.into(), f64::from(i) / f64::from((count - 1).max(1))))
        .collect()
}

/// How many sides a column has.
const SLICES: u32 = 12;

/// Columns from a storey's floor to its roof, which are thicker above than below, as only the Minoans built them.
pub fn colonnade(palace: &mut Palace, storey: u32, places: Vec<DVec2>) {
    let (bottom, top) = (floor(storey), floor(storey + 1) - 0.75);
    let base = [[0.0, -0.05], [0.85, -0.05], [0.85, 0.3], [0.0, 0.3]];
    let shaft = [
        [0.0, 0.25],
        [0.52, 0.25],
        [0.74, top - bottom - 1.2],
        [0.0, top - bottom - 1.2],
    ];
    // A neck, a cushion, and the square plate that bears the beam.
    let cushion = [
        [0.0, -1.3],
        [0.68, -1.3],
        [0.98, -1.0],
        [0.98, -0.75],
        [0.7, -0.5],
        [0.0, -0.5],
    ]
    .map(|[radius, y]| [radius, y + top - bottom]);
    for place in places {
        let foot = at(place, bottom);
        palace
            .stone
            .push(moved(turned(&base, Ends::OnAxis, SLICES), foot));
        palace
            .shafts
            .push(moved(turned(&shaft, Ends::OnAxis, SLICES), foot));
        palace
            .capitals
            .push(moved(turned(&cushion, Ends::OnAxis, SLICES), foot));
        let plate = DVec3::new(0.95, 0.0, 0.95);
        let under = at(place, top);
        palace.capitals.push(block(
            under - plate - 0.55 * DVec3::Y,
            under + plate + 0.05 * DVec3::Y,
            |_, _| DVec2::ZERO,
        ));
    }
}

/// The axis that a wall's outward normal is along.
#[derive(Clone, Copy, PartialEq)]
pub enum Axis {
    X,
    Z,
}

/// Dark windows in a wall that faces +x or +z at `face`, framed by red beams; from `range.0` to `range.1` along it.
pub fn windows(
    palace: &mut Palace,
    storey: u32,
    axis: Axis,
    face: f64,
    range: [f64; 2],
    count: u32,
) {
    let sill = floor(storey) + 2.0;
    let frame = |along: f64, half: DVec2, low: f64, out: f64| {
        let (near, far) = (along - half.x, along + half.x);
        match axis {
            Axis::X => slab([face - 0.3, low, near], [face + out, low + half.y, far]),
            Axis::Z => slab([near, low, face - 0.3], [far, low + half.y, face + out]),
        }
    };
    for place in row([range[0], 0.0], [range[1], 0.0], count) {
        let along = place.x;
        palace
            .openings
            .push(frame(along, DVec2::new(0.95, 2.3), sill, 0.06));
        palace
            .shafts
            .push(frame(along, DVec2::new(1.35, 0.35), sill - 0.3, 0.3));
        palace
            .shafts
            .push(frame(along, DVec2::new(1.40, 0.40), sill + 2.2, 0.35));
        for side in [-1.1, 1.1] {
            palace
                .shafts
                .push(frame(along + side, DVec2::new(0.17, 2.5), sill - 0.1, 0.22));
        }
        palace
            .shafts
            .push(frame(along, DVec2::new(0.1, 2.5), sill - 0.1, 0.16));
    }
}

/// Horns of consecration: two points that rise from one foot, along the row that they stand in.
pub fn horns(palace: &mut Palace, roof: f64, places: Vec<DVec2>) {
    let along = (places[places.len() - 1] - places[0]).normalize_or(DVec2::X);
    let along = DVec3::new(along.x, 0.0, along.y);
    for place in places {
        let path: Vec<(DVec3, DVec2)> = (0..=8)
            .map(|i| {
                let turn = PI * (f64::from(i) / 8.0 - 0.5) * 1.12;
                let (sin, cos) = turn.sin_cos();
                let thin = 1.0 - 0.6 * sin.abs().powi(2);
                let point =
                    at(place, roof) + along * (0.62 * sin) + DVec3::Y * (1.291 - 1.10 * cos);
                (point, DVec2::new(0.26, 0.40) * thin)
            })
            .collect();
        palace.stone.push(bar(&path, along.cross(DVec3::Y)));
    }
}
