//! The skull: a braincase with holes for eyes and nose, teeth, and the jaw.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::ellipsoid;
use crate::assets::build::{boxed, mirrored, skin, tube};
use crate::assets::paint::smooth;

const SKULL: DVec3 = DVec3::new(0.0, 9.25, -0.05);
/// Which way the holes for the left eye and the nose are, from the skull's middle.
const EYE: DVec3 = DVec3::new(0.34, 0.0, -0.94);
const NOSE: DVec3 = DVec3::new(0.0, -0.42, -0.90);

pub fn skull() -> Vec<Mesh> {
    const ROWS: usize = 17;
    const COLUMNS: usize = 24;
    let place = |row: usize, column: usize| {
        let (around, up) = (
            TAU * column as f64 / COLUMNS as f64,
            PI * ((row + 1) as f64 / (ROWS + 1) as f64 - 0.5),
        );
        let way = DVec3::new(around.sin() * up.cos(), up.sin(), around.cos() * up.cos());
        SKULL + cranium(way)
    };
    let rings: Vec<Vec<DVec3>> = (0..ROWS)
        .map(|row| (0..COLUMNS).map(|column| place(row, column)).collect())
        .collect();
    let poles = [SKULL + cranium(DVec3::NEG_Y), SKULL + cranium(DVec3::Y)];
    let head = skin(poles, &rings, |row, column| {
        DVec2::new(column as f64 / COLUMNS as f64, row as f64 / ROWS as f64) * 2.0
    });
    let mut parts = vec![head, jaw()];
    for (height, size) in [(8.72, 0.13), (8.58, 0.11)] {
        for i in -3..=3 {
            let angle = f64::from(i) * 0.24;
            let place = DVec3::new(0.36 * angle.sin(), height, -0.14 - 0.42 * angle.cos());
            let tooth = DVec3::new(0.075, size, 0.07);
            parts.push(boxed(tooth, place, -angle.to_degrees()));
        }
    }
    parts
}

/// The skull's surface in a direction: a round braincase, a narrow face, holes for eyes and nose.
fn cranium(way: DVec3) -> DVec3 {
    let low = smooth(0.05, -0.9, way.y);
    let size = DVec3::new(0.60 * (1.0 - 0.35 * low), 0.68, 0.74 - 0.10 * low);
    let hole = |middle: DVec3, reach: f64| (-(way.distance(middle) / reach).powi(4)).exp();
    let eyes = hole(EYE, 0.27) + hole(DVec3::new(-EYE.x, EYE.y, EYE.z), 0.27);
    let cheeks =
        hole(DVec3::new(0.86, -0.40, -0.30), 0.30) + hole(DVec3::new(-0.86, -0.40, -0.30), 0.30);
    let brow = (-((way.y - 0.33) / 0.10).powi(2)).exp() * smooth(-0.5, -0.9, way.z);
    way * size * (1.0 - 0.30 * eyes - 0.20 * hole(NOSE, 0.18) - 0.16 * cheeks + 0.05 * brow)
}

/// The holes' floors are black, whatever light falls in.
pub fn sockets() -> Vec<Mesh> {
    let size = DVec3::new(0.60, 0.68, 0.74);
    let eye = ellipsoid(SKULL + EYE * size * 0.76, DVec3::new(0.15, 0.155, 0.09), 10);
    let nose = ellipsoid(
        SKULL + NOSE * size * 0.84,
        DVec3::new(0.065, 0.10, 0.09),
        10,
    );
    vec![mirrored(eye.clone()), eye, nose]
}

/// From under one ear around the chin to the other.
fn jaw() -> Mesh {
    let path: Vec<(DVec3, DVec2)> = (0..=12)
        .map(|i| {
            let angle = PI * (f64::from(i) / 12.0 - 0.5) * 1.25;
            let rise = 0.55 * smooth(0.55, 1.0, (angle / (PI * 0.625)).abs());
            let place = DVec3::new(0.43 * angle.sin(), 8.46 + rise, -0.12 - 0.50 * angle.cos());
            (place, DVec2::new(0.085, 0.13))
        })
        .collect();
    tube(&path, DVec3::Y, 6)
}
