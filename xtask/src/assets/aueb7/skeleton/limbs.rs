//! Legs, and the arms: one hangs, the other holds the cutlass.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::cutlass::{FIST, sword};
use super::ellipsoid;
use crate::assets::build::{bone, capsule, mirrored, tube};

/// The one at x > 0.
pub fn leg() -> Vec<Mesh> {
    let (hip, knee) = (DVec3::new(0.62, 4.55, 0.0), DVec3::new(0.58, 2.55, -0.16));
    let ankle = DVec3::new(0.60, 0.38, 0.06);
    let mut bones = vec![
        bone(hip, knee + DVec3::new(0.0, 0.16, 0.0), 0.125, 9),
        bone(knee - DVec3::new(0.0, 0.12, 0.0), ankle, 0.105, 9),
        capsule(
            knee + DVec3::new(0.20, -0.25, 0.06),
            ankle + DVec3::new(0.16, 0.05, 0.04),
            0.05,
            6,
        ),
        ellipsoid(
            knee + DVec3::new(0.0, 0.0, -0.20),
            DVec3::new(0.12, 0.14, 0.08),
            10,
        ),
        ellipsoid(
            DVec3::new(0.62, 0.18, 0.20),
            DVec3::new(0.15, 0.18, 0.26),
            10,
        ),
    ];
    for toe in 0..3 {
        let spread = 0.13 * (f64::from(toe) - 1.0);
        let knuckle = DVec3::new(0.66 + 1.4 * spread, 0.10, -0.66);
        bones.push(capsule(
            DVec3::new(0.62 + spread, 0.22, 0.02),
            knuckle,
            0.06,
            6,
        ));
    }
    bones
}

const SHOULDER: DVec3 = DVec3::new(1.12, 7.88, 0.05);

pub fn arms() -> Vec<Mesh> {
    let fist = limbs(SHOULDER, DVec3::new(1.95, 6.75, 0.10), FIST);
    // The other hand hangs a little out from the hip.
    let elbow = DVec3::new(1.55, 6.30, 0.30);
    let wrist = DVec3::new(1.75, 4.95, -0.25);
    let mut open = limbs(SHOULDER, elbow, wrist);
    for finger in 0..5 {
        let spread = 0.10 * (f64::from(finger) - 2.0);
        let knuckle = wrist + DVec3::new(0.05 + 0.3 * spread, -0.36, -0.06 - spread);
        let tip = knuckle + DVec3::new(0.02 + 0.4 * spread, -0.42, -0.10 - spread);
        open.push(capsule(wrist, knuckle, 0.05, 5));
        open.push(capsule(knuckle - DVec3::new(0.0, 0.1, 0.0), tip, 0.042, 5));
    }
    let mut bones: Vec<Mesh> = open.into_iter().map(mirrored).collect();
    bones.extend(fist);
    // Four fingers around the grip.
    for finger in 0..4 {
        let along = sword() * (0.11 * (f64::from(finger) - 1.5));
        let path: Vec<(DVec3, DVec2)> = (0..=8)
            .map(|i| {
                let (sin, cos) = (1.6 * PI * f64::from(i) / 6.0).sin_cos();
                let place = FIST + along + DVec3::new(0.13 * cos, 0.0, -0.13 * sin);
                (place, DVec2::splat(0.05))
            })
            .collect();
        bones.push(tube(&path, DVec3::Y, 6));
    }
    bones
}

/// Upper arm, and the two bones of the lower arm.
fn limbs(shoulder: DVec3, elbow: DVec3, wrist: DVec3) -> Vec<Mesh> {
    let across = (wrist - elbow).cross(elbow - shoulder).normalize() * 0.09;
    vec![
        bone(shoulder, elbow, 0.095, 8),
        bone(elbow + across, wrist + across * 0.6, 0.065, 6),
        capsule(elbow - across, wrist - across, 0.055, 6),
        ellipsoid(wrist, DVec3::new(0.14, 0.16, 0.14), 10),
    ]
}
