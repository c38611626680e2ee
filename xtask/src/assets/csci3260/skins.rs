//! The dolphin's skins. Above: the body seen from its left, belly to back, both sides alike; below: the three kinds of fin.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use image::RgbImage;

use crate::assets::paint::{mix, noise, smooth, step, supersampled};

#[derive(Clone, Copy)]
pub enum Fin {
    Dorsal,
    Flipper,
    Fluke,
}

const FINS: f64 = 0.25;
/// Between the body, the fins and the picture's edges: filters must not mix them.
const GAP: f64 = 0.012;

/// Texture coordinates on the body: `along` from the beak to the tail, `up` from the belly to the back.
pub fn on_body(along: f64, up: f64) -> DVec2 {
    let (low, high) = (FINS + GAP, 1.0 - GAP);
    DVec2::new(GAP + along * (1.0 - 2.0 * GAP), low + up * (high - low))
}

/// Texture coordinates on a fin: from the front edge to the rear, and along the span.
pub fn on_fin(fin: Fin, chord: f64, span: f64) -> DVec2 {
    let inside = GAP + chord * (1.0 / 3.0 - 2.0 * GAP);
    let v = GAP + span * (FINS - 2.0 * GAP);
    DVec2::new(f64::from(fin as u8) / 3.0 + inside, v)
}

/// Where a point of the picture is on the dolphin.
enum Place {
    Body(DVec2),
    /// How far it is from the root to the tip, and which fin.
    Fin(f64, u8),
}

fn place(u: f64, v: f64) -> Place {
    if v < FINS {
        let kind = (u * 3.0) as u8;
        let span = ((v - GAP) / (FINS - 2.0 * GAP)).clamp(0.0, 1.0);
        // The fluke's picture goes from tip to tip.
        let share = if kind == Fin::Fluke as u8 {
            (2.0 * span - 1.0).abs()
        } else {
            span
        };
        return Place::Fin(share, kind);
    }
    let along = (u - GAP) / (1.0 - 2.0 * GAP);
    let up = (v - FINS - GAP) / (1.0 - FINS - 2.0 * GAP);
    Place::Body(DVec2::new(along, up).clamp(DVec2::ZERO, DVec2::ONE))
}

/// A bottlenose dolphin: a slate cape, paler flanks, a light belly.
pub fn grey() -> RgbImage {
    let cape = DVec3::new(0.25, 0.33, 0.43);
    supersampled(512, 512, |u, v| match place(u, v) {
        Place::Fin(share, _) => cape * (1.05 - 0.15 * share) * grain(u, v),
        Place::Body(at) => {
            let wave = 0.05 * (TAU * (1.6 * at.x + 0.1)).sin();
            let wander = 0.05 * (noise(at.x * 14.0, at.y * 5.0, 64, 64, 3) - 0.5);
            let flank = mix(
                DVec3::new(0.50, 0.59, 0.66),
                cape,
                smooth(0.52, 0.72, at.y + wave + wander),
            );
            let belly_line = 0.40 + wave + wander - 0.30 * smooth(0.55, 1.0, at.x);
            let belly = smooth(belly_line + 0.06, belly_line - 0.06, at.y);
            let color = mix(flank, DVec3::new(0.91, 0.90, 0.88), belly) * grain(u, v);
            face(color, at, DVec3::new(0.16, 0.20, 0.26))
        }
    })
}

/// Black and white as an orca: a white chin and belly with a lobe up the flank, a patch behind the eye, a grey saddle.
pub fn orca() -> RgbImage {
    let black = DVec3::new(0.075, 0.08, 0.095);
    let white = DVec3::new(0.93, 0.93, 0.90);
    supersampled(512, 512, |u, v| match place(u, v) {
        // The fluke is white below, which its picture cannot tell from above: only its edges are pale.
        Place::Fin(share, kind) if kind == Fin::Fluke as u8 => {
            mix(black, white, 0.25 * step(0.85, 1.0, share))
        }
        Place::Fin(..) => black * grain(u, v),
        Place::Body(at) => {
            let chin = 0.43 * smooth(0.40, 0.26, at.x);
            let middle = 0.20 + 0.05 * (TAU * 2.0 * at.x).sin();
            let lobe = 0.40 * (-((at.x - 0.74 - 0.25 * (at.y - 0.3)) / 0.055).powi(2)).exp();
            let end = smooth(0.86, 0.78, at.x);
            let line = chin.max(middle + lobe) * end;
            let belly = step(line + 0.008, line - 0.008, at.y);
            let patch = ellipse(at, DVec2::new(0.315, 0.635), DVec2::new(0.038, 0.075), 0.25);
            let saddle = ellipse(at, DVec2::new(0.655, 1.0), DVec2::new(0.055, 0.30), 0.0);
            let color = mix(
                black,
                DVec3::new(0.42, 0.43, 0.45),
                smooth(1.1, 0.8, saddle),
            );
            let color = mix(color, white, belly.max(step(1.04, 0.96, patch)));
            face(color * grain(u, v), at, DVec3::splat(0.03))
        }
    })
}

/// How far a point is from an ellipse's middle: 1 on its edge. Its long axis leans by `lean`.
fn ellipse(at: DVec2, middle: DVec2, half: DVec2, lean: f64) -> f64 {
    let offset = at - middle;
    (DVec2::new(offset.x + lean * offset.y * half.x / half.y, offset.y) / half).length()
}

/// Eye, mouth and blowhole.
fn face(color: DVec3, at: DVec2, dark: DVec3) -> DVec3 {
    let eye = DVec2::new(0.262, 0.50);
    let size = DVec2::new(0.0075, 0.040);
    let around = ellipse(at, eye, size * 1.6, 0.0);
    let color = mix(color, color * 0.62, smooth(1.2, 0.7, around));
    let color = mix(
        color,
        DVec3::splat(0.02),
        step(1.05, 0.95, ellipse(at, eye, size, 0.0)),
    );
    let glint = ellipse(at, eye + DVec2::new(-0.002, 0.014), size * 0.3, 0.0);
    let color = mix(color, DVec3::splat(0.95), step(1.2, 0.8, glint));
    // The mouth runs back along the beak and turns up into the smile.
    let mouth = 0.47 - 0.10 * smooth(0.0, 0.20, at.x) + 0.09 * smooth(0.19, 0.245, at.x);
    let line = step(0.016, 0.007, (at.y - mouth).abs()) * step(0.25, 0.24, at.x);
    let color = mix(color, dark, 0.85 * line);
    let blowhole = ellipse(at, DVec2::new(0.305, 1.0), DVec2::new(0.006, 0.05), 0.0);
    mix(color, dark, step(1.1, 0.9, blowhole))
}

fn grain(u: f64, v: f64) -> f64 {
    0.97 + 0.06 * noise(u * 40.0, v * 20.0, 64, 64, 17)
}
