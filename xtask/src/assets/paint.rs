//! What every painted picture is made with: filling, blending, and noise that is the same on every machine.
//!
//! In every formula u goes right and v goes up, from 0 to 1.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

/// Fills a picture, with each channel rounded to multiples of `level`: flat areas make small files.
pub fn picture(width: u32, height: u32, level: u32, color: impl Fn(f64, f64) -> DVec3) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let u = (f64::from(x) + 0.5) / f64::from(width);
        let v = 1.0 - (f64::from(y) + 0.5) / f64::from(height);
        let level = f64::from(level);
        let byte =
            |channel: f64| ((255.0 * channel / level).round() * level).clamp(0.0, 255.0) as u8;
        Rgb(color(u, v).to_array().map(byte))
    })
}

/// For pictures of shapes: each pixel is the mean of nine places in it.
pub fn supersampled(width: u32, height: u32, color: impl Fn(f64, f64) -> DVec3) -> RgbImage {
    picture(width, height, 1, |u, v| {
        let offset = |i: u32, size: u32| (f64::from(i) - 1.0) / (3.0 * f64::from(size));
        let place = |i: u32| color(u + offset(i % 3, width), v + offset(i / 3, height));
        (0..9).map(place).sum::<DVec3>() / 9.0
    })
}

pub fn mix(a: DVec3, b: DVec3, share: f64) -> DVec3 {
    a.lerp(b, share)
}

/// 0 at `from`, 1 at `to`, in a straight line between; `from` may be the greater.
pub fn step(from: f64, to: f64, x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// The same with a soft start and end.
pub fn smooth(from: f64, to: f64, x: f64) -> f64 {
    let t = step(from, to, x);
    t * t * (3.0 - 2.0 * t)
}

/// Five octaves of noise, each turned so that the lattice does not show.
pub fn clouds(mut place: DVec2) -> f64 {
    let turn = DVec2::from_angle(0.65);
    let (mut sum, mut weight) = (0.0, 0.5);
    for octave in 0..5 {
        sum += weight * noise(place.x, place.y, i64::MAX, i64::MAX, 31 + octave);
        place = turn.rotate(place) * 2.03 + DVec2::splat(5.3);
        weight *= 0.5;
    }
    sum
}

/// Smooth noise on a lattice that repeats after `period_x` and `period_y` cells.
pub fn noise(x: f64, y: f64, period_x: i64, period_y: i64, seed: i64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let corner = |dx: i64, dy: i64| {
        let x = (column as i64 + dx).rem_euclid(period_x);
        let y = (row as i64 + dy).rem_euclid(period_y);
        hash(x, y, seed)
    };
    let (s, t) = (smooth(0.0, 1.0, x - column), smooth(0.0, 1.0, y - row));
    let bottom = corner(0, 0) + s * (corner(1, 0) - corner(0, 0));
    let top = corner(0, 1) + s * (corner(1, 1) - corner(0, 1));
    bottom + t * (top - bottom)
}

/// Three integers to a number from 0 to 1 that looks random and is the same everywhere.
pub fn hash(x: i64, y: i64, seed: i64) -> f64 {
    let mut bits = 0x9E37_79B9_7F4A_7C15_u64;
    for word in [x, y, seed] {
        bits = (bits ^ word as u64).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        bits ^= bits >> 32;
    }
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
