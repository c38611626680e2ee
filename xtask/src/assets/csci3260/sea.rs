//! Two surfaces of water. Both repeat in both directions: every wave fits the picture a whole number of times.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use image::RgbImage;

use crate::assets::paint::{hash, mix, noise, picture, smooth};

/// Shallow water over light ground, with the net of light that ripples cast.
pub fn caustics() -> RgbImage {
    picture(512, 512, 6, |u, v| {
        let at = DVec2::new(u, v);
        let net = 0.65 * threads(at, 6, 1) + 0.45 * threads(at + 0.37, 9, 2);
        let depth = noise(u * 4.0, v * 4.0, 4, 4, 5);
        let water = mix(
            DVec3::new(0.07, 0.46, 0.58),
            DVec3::new(0.16, 0.62, 0.68),
            depth,
        );
        mix(water, DVec3::new(0.86, 0.99, 0.95), net.min(1.0))
    })
}

/// Deep water: long waves with light on their slopes, and a little foam on the highest crests.
pub fn swell() -> RgbImage {
    picture(512, 512, 4, |u, v| {
        let (height, slope) = waves(u, v);
        let lit = smooth(-1.0, 1.0, 0.085 * slope.dot(DVec2::new(0.35, 0.9)));
        let deep = mix(
            DVec3::new(0.02, 0.13, 0.27),
            DVec3::new(0.06, 0.33, 0.47),
            smooth(-1.2, 1.3, height),
        );
        let color = mix(deep * 0.75, deep * 1.25 + DVec3::new(0.03, 0.07, 0.07), lit);
        let flecks = noise(u * 96.0, v * 128.0, 96, 128, 9) * noise(u * 29.0, v * 37.0, 29, 37, 4);
        let foam = smooth(0.95, 1.55, height + 0.9 * flecks - 0.1);
        mix(color, DVec3::new(0.80, 0.90, 0.92), 0.8 * foam)
    })
}

/// Bright lines between cells, wavering: the edges of a Voronoi diagram that repeats.
fn threads(at: DVec2, cells: i64, seed: i64) -> f64 {
    let sway = |x: f64, y: f64, phase: f64| (TAU * (2.0 * x + 3.0 * y) + phase).sin();
    let bent = at + 0.012 * DVec2::new(sway(at.y, at.x, 0.7), sway(at.x, at.y, 2.9));
    let place = bent * cells as f64;
    let (mut nearest, mut second) = (f64::MAX, f64::MAX);
    for dy in -2..=2 {
        for dx in -2..=2 {
            let (x, y) = (place.x.floor() as i64 + dx, place.y.floor() as i64 + dy);
            let (i, j) = (x.rem_euclid(cells), y.rem_euclid(cells));
            let offset = DVec2::new(hash(i, j, seed), hash(i, j, seed + 50));
            let distance = place.distance(DVec2::new(x as f64, y as f64) + offset);
            second = second.min(distance.max(nearest));
            nearest = nearest.min(distance);
        }
    }
    let edge = second - nearest;
    let width = 0.05 + 0.10 * noise(at.x * 5.0, at.y * 5.0, 5, 5, seed + 9);
    (-(edge / width)).exp()
}

/// The height of the water and its slope.
fn waves(u: f64, v: f64) -> (f64, DVec2) {
    let bend = 0.35 * (TAU * (u + 2.0 * v)).sin();
    let (mut height, mut slope) = (0.0, DVec2::ZERO);
    for (i, (kx, ky, size)) in [
        (1.0, 3.0, 0.40),
        (-3.0, 5.0, 0.34),
        (5.0, 9.0, 0.24),
        (-8.0, 14.0, 0.16),
        (13.0, 19.0, 0.11),
        (-17.0, 31.0, 0.07),
        (27.0, 38.0, 0.04),
        (-35.0, 52.0, 0.03),
    ]
    .into_iter()
    .enumerate()
    {
        let phase = TAU * (kx * u + ky * v) + 1.7 * i as f64 + bend * (1.0 + 0.3 * i as f64);
        // Sharper crests than troughs.
        height += size * (2.0 * (0.5 + 0.5 * phase.sin()).powf(1.6) - 0.9);
        slope += size * phase.cos() * DVec2::new(kx, ky);
    }
    (height, slope)
}
