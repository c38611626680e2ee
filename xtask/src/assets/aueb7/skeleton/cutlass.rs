//! The cutlass, and where it is held.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::ellipsoid;
use crate::assets::build::{bar, capsule, tube};

/// The hand that holds it, raised beside the head.
pub const FIST: DVec3 = DVec3::new(2.35, 8.15, -0.75);

/// The way the cutlass points.
pub fn sword() -> DVec3 {
    DVec3::new(0.42, 0.80, -0.42).normalize()
}

/// A broad blade that bends backwards and ends in a point.
pub fn blade() -> Mesh {
    let side = sword().cross(DVec3::Z).normalize();
    let path: Vec<(DVec3, DVec2)> = (0..=10)
        .map(|i| {
            let t = f64::from(i) / 10.0;
            let place = FIST + sword() * (0.30 + 1.75 * t) - side * (0.28 * t * t);
            let width = 0.13 + 0.05 * (PI * t).sin() - 0.12 * t.powi(4);
            (place, DVec2::new(width, 0.022))
        })
        .collect();
    bar(&path, sword().cross(side))
}

/// Grip, pommel, and the guard around the hand.
pub fn hilt() -> Vec<Mesh> {
    let side = sword().cross(DVec3::Z).normalize();
    let (pommel, guard) = (FIST - sword() * 0.36, FIST + sword() * 0.30);
    let bow: Vec<(DVec3, DVec2)> = (0..=6)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 6.0).sin_cos();
            let place = FIST - sword() * (0.33 * cos) + side * (0.30 * sin);
            (place, DVec2::new(0.05, 0.03))
        })
        .collect();
    vec![
        capsule(pommel, guard, 0.07, 8),
        ellipsoid(pommel, DVec3::splat(0.11), 10),
        capsule(guard - side * 0.22, guard + side * 0.22, 0.05, 6),
        tube(&bow, sword().cross(side), 6),
    ]
}
