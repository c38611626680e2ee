//! The palace's pictures: a storey's wall with its painted bands, the fresco of the halls, and the paving.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use image::RgbImage;

use crate::assets::paint::{hash, mix, noise, picture, smooth, step, supersampled};

const RED: DVec3 = DVec3::new(0.62, 0.15, 0.10);
const OCHRE: DVec3 = DVec3::new(0.90, 0.74, 0.42);
const CREAM: DVec3 = DVec3::new(0.94, 0.89, 0.77);
const BLUE: DVec3 = DVec3::new(0.22, 0.46, 0.62);
const BLACK: DVec3 = DVec3::new(0.10, 0.09, 0.09);

/// One storey, once around its height: a veined dado, cream plaster, a band of running spirals, a row of beam ends.
pub fn wall() -> RgbImage {
    supersampled(256, 256, |u, v| {
        let color = match v {
            _ if v < 0.26 => dado(u, v / 0.26),
            _ if v < 0.62 => CREAM * (0.95 + 0.08 * noise(u * 8.0, v * 8.0, 8, 8, 4)),
            _ if v < 0.82 => spirals(u, (v - 0.62) / 0.20),
            _ => beam_ends(u, (v - 0.82) / 0.18),
        };
        [(0.26, RED), (0.62, RED), (0.82, BLACK)]
            .iter()
            .fold(color, |color, &(height, line)| {
                mix(color, line, step(0.016, 0.012, (v - height).abs()))
            })
    })
}

/// Slabs of veined gypsum between upright joints.
fn dado(u: f64, v: f64) -> DVec3 {
    let slab = (u * 4.0).floor();
    let vein = noise(
        u * 16.0 + 3.0 * slab,
        v * 4.0 + 2.0 * noise(u * 8.0, v * 3.0, 8, 64, 3),
        64,
        64,
        6,
    );
    let tone = 0.66 + 0.08 * hash(slab as i64, 2, 2);
    let stone = DVec3::new(tone, tone * 0.97, tone * 0.90) * (0.90 + 0.25 * vein);
    let joint = (u * 4.0 - slab).min(slab + 1.0 - u * 4.0);
    mix(stone, stone * 0.55, step(0.035, 0.015, joint))
}

/// Spirals that run into each other on blue.
fn spirals(u: f64, v: f64) -> DVec3 {
    let at = DVec2::new((u * 5.0).fract() - 0.5, v - 0.5);
    let radius = at.length();
    let wound = (at.to_angle() / TAU - radius * 5.6).rem_euclid(1.0);
    let arm = step(0.20, 0.12, (wound - 0.5).abs()) * step(0.44, 0.40, radius);
    let eye = step(0.09, 0.06, radius);
    // From the rim of each to the rim of the next.
    let wave = 0.36 * (TAU * (at.x + 0.5)).cos();
    let link = step(0.08, 0.05, (at.y - wave).abs()) * step(0.36, 0.42, radius);
    let color = mix(BLUE, CREAM, arm.max(link));
    mix(color, RED, eye)
}

/// The round ends of the ceiling's beams, as on the palace's own frescoes.
fn beam_ends(u: f64, v: f64) -> DVec3 {
    let at = DVec2::new((u * 8.0).fract() - 0.5, (v - 0.5) * 0.75);
    let color = mix(OCHRE, RED, step(0.33, 0.29, at.length()));
    mix(color, CREAM, step(0.13, 0.10, at.length()))
}

/// The halls' fresco: dolphins over the sea's ground, rosettes above and below.
pub fn fresco() -> RgbImage {
    supersampled(256, 256, |u, v| {
        if !(0.2..=0.8).contains(&v) {
            return rosettes(u, if v < 0.5 { v / 0.2 } else { (v - 0.8) / 0.2 });
        }
        let water = mix(
            CREAM,
            DVec3::new(0.62, 0.78, 0.80),
            0.5 + 0.5 * (TAU * (2.0 * u + (TAU * u).sin() * 0.3 + 2.0 * v)).sin(),
        );
        let color = [
            (0.25, 0.60, 1.0),
            (0.75, 0.42, 1.0),
            (0.27, 0.30, 0.45),
            (0.74, 0.70, 0.45),
        ]
        .iter()
        .fold(water, |color, &(x, y, size)| {
            let du = u - x - (u - x).round();
            dolphin(color, DVec2::new(du, v - y) / size)
        });
        mix(
            color,
            BLACK,
            step(0.012, 0.008, (v - 0.2).abs().min((v - 0.8).abs())),
        )
    })
}

/// A painted dolphin about the origin: a blue back over a light belly, on one bent line.
fn dolphin(color: DVec3, at: DVec2) -> DVec3 {
    let bent = at.y + 1.6 * at.x * at.x - 0.03;
    let along = (at.x + 0.2) / 0.4;
    let half = 0.062
        * (1.0 - (2.0 * along - 0.85).powi(2) / 1.35).max(0.0).sqrt()
        * smooth(1.06, 0.80, along);
    let tail = (along - 0.96).clamp(0.0, 0.12) * 0.55 * step(1.09, 1.05, along);
    let half = half.max(tail);
    let fin = step(
        0.012,
        0.0,
        (at.x - 0.01 - 0.4 * (bent - 0.06)).abs() - 0.035 + 0.5 * (bent - 0.05).max(0.0),
    );
    let fin = fin * step(0.11, 0.10, bent) * step(0.02, 0.03, bent);
    let inside = step(0.006, -0.004, bent.abs() - half).max(fin);
    let body = mix(OCHRE, CREAM, 0.6);
    let body = mix(body, BLUE * 0.8, step(-0.006, 0.006, bent - 0.012));
    let eye = step(0.012, 0.008, DVec2::new(at.x + 0.14, bent - 0.014).length());
    mix(color, mix(body, BLACK, eye), inside)
}

fn rosettes(u: f64, v: f64) -> DVec3 {
    let at = DVec2::new((u * 6.0).fract() - 0.5, v - 0.5);
    let petals = 0.34 + 0.06 * (8.0 * at.to_angle()).cos();
    let color = mix(RED, CREAM, step(petals + 0.02, petals - 0.02, at.length()));
    mix(color, OCHRE * 0.9, step(0.15, 0.11, at.length()))
}

/// Slabs of pale stone. Repeats in both directions.
pub fn paving() -> RgbImage {
    picture(256, 256, 6, |u, v| {
        let row = (v * 4.0).floor();
        let along = u * 3.0 + 0.5 * row;
        let slab = along.floor();
        let (x, y) = (along - slab, v * 4.0 - row);
        let tone = 0.90 + 0.14 * hash((slab as i64).rem_euclid(3), row as i64, 8);
        let grain = noise(u * 40.0, v * 40.0, 40, 40, 2) - 0.5;
        let stone = DVec3::new(0.86, 0.80, 0.70) * (tone + 0.07 * grain);
        let joint = step(0.035, 0.015, x.min(1.0 - x)).max(step(0.045, 0.02, y.min(1.0 - y)));
        mix(stone, stone * 0.6, joint)
    })
}
