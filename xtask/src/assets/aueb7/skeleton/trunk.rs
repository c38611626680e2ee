//! The trunk: spine, breastbone with collar bones and shoulder blades, ribs, and the pelvis.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::{both, ellipsoid};
use crate::assets::build::{capsule, tube};

/// The spine's middle at a height, with its double bend.
fn back(y: f64) -> DVec3 {
    DVec3::new(0.0, y, 0.22 + 0.16 * (1.9 * (y - 5.0)).sin())
}

pub fn spine() -> Vec<Mesh> {
    (0..12)
        .flat_map(|i| {
            let y = 5.0 + 0.32 * f64::from(i);
            let size = 0.20 - 0.005 * f64::from(i);
            let body = ellipsoid(back(y), DVec3::new(size, 0.16, size), 10);
            // A point that one feels through the skin of the back.
            let way = DVec3::new(0.0, -0.15, 0.34);
            let spur = [(0.0, 0.0), (0.5, 0.07), (1.0, 0.0)]
                .map(|(t, half)| (back(y) + way * t, DVec2::splat(half)));
            let spur = tube(&spur, DVec3::Y, 5);
            [body, spur]
        })
        .collect()
}

pub fn breastbone() -> Vec<Mesh> {
    let flat = |y: f64, z: f64, width: f64| (DVec3::new(0.0, y, z), DVec2::new(width, 0.06));
    let plate = tube(
        &[
            flat(7.98, -0.40, 0.05),
            flat(7.90, -0.42, 0.20),
            flat(7.55, -0.52, 0.13),
            flat(6.90, -0.60, 0.12),
            flat(6.50, -0.58, 0.07),
            flat(6.42, -0.57, 0.02),
        ],
        DVec3::NEG_Z,
        8,
    );
    let collar = capsule(
        DVec3::new(0.08, 7.88, -0.42),
        DVec3::new(1.05, 8.02, -0.02),
        0.075,
        5,
    );
    let blade = ellipsoid(
        DVec3::new(0.66, 7.45, 0.52),
        DVec3::new(0.36, 0.52, 0.07),
        12,
    );
    [both(vec![collar, blade]), vec![plate]].concat()
}

/// Eight pairs: six reach the breastbone, two end at the side.
pub fn ribs() -> Vec<Mesh> {
    let rib = |i: u32| {
        let t = f64::from(i) / 7.0;
        let top = back(7.85 - 1.75 * t);
        let width = 0.52 + 0.42 * (PI * (0.15 + 0.75 * t)).sin();
        let reach = if i < 6 { 1.0 } else { 0.62 };
        let path: Vec<(DVec3, DVec2)> = (0..=8)
            .map(|step| {
                let along = reach * f64::from(step) / 8.0;
                let (sin, cos) = (PI * along).sin_cos();
                let depth = 0.5 * (top.z + 0.52 + 0.10 * t);
                let place = DVec3::new(
                    0.08 + width * sin - 0.06 * along,
                    top.y - (0.30 + 0.25 * t) * along,
                    top.z - depth * (1.0 - cos),
                );
                (place, DVec2::new(0.06, 0.085))
            })
            .collect();
        tube(&path, DVec3::Y, 5)
    };
    both((0..8).map(rib).collect())
}

pub fn pelvis() -> Vec<Mesh> {
    // The rim of the hip bone, from the sacrum around to the front, and the ring below it.
    let rim: Vec<(DVec3, DVec2)> = (0..=12)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 12.0).sin_cos();
            let place = DVec3::new(
                0.10 + 0.72 * sin,
                5.0 + 0.34 * sin - 0.18 * (1.0 - cos),
                0.05 + 0.38 * cos,
            );
            (place, DVec2::new(0.10, 0.24))
        })
        .collect();
    let joint = ellipsoid(
        DVec3::new(0.50, 4.68, 0.0),
        DVec3::new(0.20, 0.24, 0.20),
        12,
    );
    let front = capsule(
        DVec3::new(0.48, 4.60, -0.08),
        DVec3::new(0.05, 4.50, -0.30),
        0.10,
        8,
    );
    let sacrum = ellipsoid(
        DVec3::new(0.0, 4.82, 0.32),
        DVec3::new(0.26, 0.42, 0.14),
        12,
    );
    [
        both(vec![tube(&rim, DVec3::Y, 8), joint, front]),
        vec![sacrum],
    ]
    .concat()
}
