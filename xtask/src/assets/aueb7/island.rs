//! The pirate's island, drawn ten times as large: sand with a dug-out hollow in the middle, rocks and a palm.

use std::f64::consts::TAU;

use glam::{DMat4, DQuat, DVec2, DVec3};
use image::RgbImage;
use shadowlab::scene::Mesh;

use crate::assets::build::{Obj, ball, bar, placed, skin, tube};
use crate::assets::paint::{clouds, noise, picture, smooth};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl sand
Kd 1 1 1
Ks 0.02 0.02 0.02
Ns 4
map_Kd sand.png

newmtl rock
Kd 0.42 0.4 0.37
Ks 0.05 0.05 0.05
Ns 8

newmtl trunk
Kd 0.45 0.33 0.2
Ks 0.03 0.03 0.03
Ns 6

newmtl leaf
Kd 0.22 0.45 0.14
Ks 0.1 0.1 0.1
Ns 12
";

pub fn obj() -> String {
    let mut obj = Obj::new("Island", "terrain.mtl", [4, 3, 3]);
    obj.object("ground", "sand", &[ground()]);
    obj.object("rocks", "rock", &rocks());
    let crown = palm_path(1.0);
    let trunk: Vec<(DVec3, DVec2)> = (0..=14)
        .map(|i| {
            let t = f64::from(i) / 14.0;
            // The old leaves have left rings.
            let ring = if i % 2 == 0 { 1.0 } else { 1.25 };
            (palm_path(t), DVec2::splat(ring * (0.085 - 0.035 * t)))
        })
        .collect();
    obj.object("trunk", "trunk", &[tube(&trunk, DVec3::Z, 10)]);
    let leaves: Vec<Mesh> = (0..13).map(|i| leaf(crown, i)).collect();
    obj.object("leaves", "leaf", &leaves);
    obj.text()
}

/// Sand that repeats: ripples of the wind, patches, grains.
pub fn sand() -> RgbImage {
    picture(256, 256, 5, |u, v| {
        let bend = 1.5 * noise(u * 3.0, v * 3.0, 3, 3, 2);
        let ripple = (TAU * (2.0 * u + 9.0 * v + bend)).sin();
        let grain = noise(u * 128.0, v * 128.0, 128, 128, 6) - 0.5;
        let patch = noise(u * 6.0, v * 6.0, 6, 6, 12) - 0.5;
        DVec3::new(0.87, 0.75, 0.53) * (1.0 + 0.045 * ripple + 0.16 * grain + 0.10 * patch)
    })
}

const RINGS: usize = 46;
const COLUMNS: usize = 72;

/// The ground is closed below by a flat bottom, so that no light comes in from under it.
fn ground() -> Mesh {
    let around = |column: usize| DVec2::from_angle(TAU * column as f64 / COLUMNS as f64);
    let shore = |column: usize| {
        let way = around(column) * 1.4 + 20.0;
        8.2 + 2.8 * (clouds(way) - 0.2)
    };
    let mut rings: Vec<Vec<DVec3>> = (1..=RINGS)
        .map(|ring| {
            let share = (ring as f64 / RINGS as f64).powf(1.3);
            let point = |column: usize| {
                let at = around(column) * share * shore(column);
                DVec3::new(at.x, height(at, share), at.y)
            };
            (0..COLUMNS).map(point).collect()
        })
        .collect();
    let rim = rings[RINGS - 1].clone();
    let bottom = |share: f64| {
        rim.iter()
            .map(|p| DVec3::new(p.x * share, BOTTOM, p.z * share))
            .collect()
    };
    let bottom_rim: Vec<DVec3> = bottom(1.0);
    rings.extend([rim.clone(), bottom_rim.clone(), bottom_rim]);
    let poles = [
        DVec3::new(0.0, height(DVec2::ZERO, 0.0), 0.0),
        DVec3::new(0.0, BOTTOM, 0.0),
    ];
    let mut mesh = skin(poles, &rings, |_, _| DVec2::ZERO);
    // The picture lies flat on the ground: one repeat is two units.
    for (uv, position) in mesh.texture_coords.iter_mut().zip(&mesh.positions) {
        *uv = DVec2::new(position.x, -position.z) * 0.5;
    }
    mesh
}

const BOTTOM: f64 = -0.6;

/// Hills that fall to the shore at `share` 1, and level places for the chest and the skeleton.
fn height(at: DVec2, share: f64) -> f64 {
    let hills = clouds(at * 0.45 + 60.0) - 0.45;
    let inland = smooth(1.0, 0.45, share);
    let land = -0.35 + inland * (1.25 + 1.3 * hills * smooth(0.5, 3.0, at.length()));
    // What was dug out lies west of the hollow: neither the view nor the light comes from there.
    let away = smooth(
        0.45,
        -0.5,
        at.normalize_or_zero().dot(DVec2::new(0.97, 0.22)),
    );
    let heap = 0.34 * away * (-((at.length() - 1.15) / 0.26).powi(2)).exp();
    let heap = heap * (0.7 + 0.6 * clouds(at * 3.0 + 9.0));
    let level = |height: f64, middle: DVec2, target: f64, reach: f64| {
        let share = smooth(2.4 * reach, reach, at.distance(middle));
        height + (target - height) * share
    };
    let ground = level(land + heap, DVec2::new(0.0, -1.8), 0.8, 0.36);
    level(ground, DVec2::ZERO, 1.0, 0.6)
}

/// Stones half in the sand.
fn rocks() -> Vec<Mesh> {
    [
        (2.1, 0.9, 0.22),
        (2.45, 0.7, 0.13),
        (-1.9, 1.2, 0.26),
        (-2.3, 1.35, 0.16),
        (0.9, -2.5, 0.3),
        (1.3, -2.75, 0.18),
        (-0.9, 2.2, 0.12),
        (-4.2, -2.6, 0.5),
        (3.4, -3.9, 0.45),
    ]
    .iter()
    .zip(0_u8..)
    .map(|(&(x, z, size), i)| {
        let mut stone = ball(0.0, 1.0, 12);
        let uneven = |p: DVec3| {
            0.75 + 0.5
                * clouds(DVec2::new(p.x + 0.6 * p.y, p.z - 0.5 * p.y) * 1.3 + f64::from(i) * 7.0)
        };
        for position in &mut stone.positions {
            *position *= uneven(*position);
        }
        let at = DVec2::new(x, z);
        let turn = DQuat::from_rotation_y(f64::from(i) * 2.1);
        let scale = DVec3::new(1.25, 0.8, 1.0) * size;
        let middle = DVec3::new(x, height(at, at.length() / 9.0) + 0.2 * size, z);
        placed(
            stone,
            DMat4::from_scale_rotation_translation(scale, turn, middle),
        )
    })
    .collect()
}

/// The palm bends from the skeleton's side towards the light.
fn palm_path(t: f64) -> DVec3 {
    let root = DVec3::new(-1.75, 0.55, -1.0);
    root + DVec3::new(0.15 * t + 0.45 * t * t, 2.6 * t, 0.35 * t * t)
}

/// A drooping leaf with a ridge along its middle.
fn leaf(crown: DVec3, i: u32) -> Mesh {
    let turn = DQuat::from_rotation_y(f64::from(i) * TAU / 13.0 + 0.3 * f64::from(i % 2));
    let length = 1.15 + 0.15 * f64::from(i % 3);
    let path: Vec<(DVec3, DVec2)> = (0..=7)
        .map(|step| {
            let t = f64::from(step) / 7.0;
            let rise = 0.42 * t - (0.75 + 0.1 * f64::from(i % 3)) * t * t;
            let place = crown + turn * DVec3::new(length * t, rise, 0.0);
            let width = 0.02 + 0.095 * (std::f64::consts::PI * t.powf(0.7)).sin();
            (place, DVec2::new(width, 0.012))
        })
        .collect();
    bar(&path, DVec3::Y)
}
