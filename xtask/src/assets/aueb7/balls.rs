//! Two balls to tell apart under an orange light, which swallows blue: light and dark do the work, not the hue.
//!
//! Across is once around, up is from pole to pole.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use image::RgbImage;

use crate::assets::paint::{mix, step, supersampled};

/// A beach ball: six gores and two caps.
pub fn beach() -> RgbImage {
    let colors = [
        DVec3::new(0.97, 0.95, 0.90),
        DVec3::new(0.85, 0.12, 0.10),
        DVec3::new(0.97, 0.95, 0.90),
        DVec3::new(0.10, 0.25, 0.60),
        DVec3::new(0.97, 0.95, 0.90),
        DVec3::new(0.98, 0.75, 0.10),
    ];
    supersampled(256, 256, |u, v| {
        // No seam of the ball is on the picture's edge.
        let around = u * 6.0 + 0.5;
        let gore = around.floor();
        let to_seam = (around - gore).min(gore + 1.0 - around);
        let to_pole = v.min(1.0 - v);
        // A seam is as wide near the poles as at the equator.
        let seam = step(0.05, 0.025, to_seam * (PI * v).sin());
        let color = mix(colors[gore as usize % 6], DVec3::splat(0.55), 0.6 * seam);
        let color = mix(color, DVec3::splat(0.45), step(0.105, 0.100, to_pole));
        mix(
            color,
            DVec3::new(0.97, 0.95, 0.90),
            step(0.092, 0.087, to_pole),
        )
    })
}

/// A cream ball with a dark band of stars, and zigzags above and below it.
pub fn stars() -> RgbImage {
    let cream = DVec3::new(0.95, 0.88, 0.72);
    let night = DVec3::new(0.13, 0.16, 0.36);
    let brick = DVec3::new(0.72, 0.22, 0.12);
    supersampled(256, 256, |u, v| {
        let height = (v - 0.5).abs();
        let cell = DVec2::new((u * 8.0).fract() - 0.5, (v - 0.5) * 4.6);
        let color = mix(cream, night, step(0.165, 0.158, height));
        let color = mix(color, DVec3::new(1.0, 0.86, 0.30), star(cell));
        let zigzag = 0.255 + 0.05 * (2.0 * (u * 16.0).fract() - 1.0).abs();
        let color = mix(color, brick, step(0.026, 0.018, (height - zigzag).abs()));
        let color = mix(color, brick, step(0.012, 0.006, (height - 0.19).abs()));
        mix(color, night, step(0.405, 0.412, height))
    })
}

/// A five-pointed star about the origin.
fn star(at: DVec2) -> f64 {
    let sector = 2.0 * PI / 5.0;
    // By symmetry one half of one point is enough.
    let angle = (at.x.atan2(at.y).rem_euclid(sector) - sector / 2.0).abs();
    let place = DVec2::from_angle(sector / 2.0 - angle) * at.length();
    let (tip, notch) = (
        DVec2::new(0.40, 0.0),
        DVec2::from_angle(sector / 2.0) * 0.17,
    );
    let inside = (notch - tip).perp_dot(place - tip) / notch.distance(tip);
    step(-0.02, 0.02, inside)
}
