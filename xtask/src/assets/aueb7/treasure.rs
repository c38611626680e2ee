//! A treasure chest, drawn half as large: its front towards −z, the lid open, gold inside and spilled before it.

mod chest;
mod hoard;

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use image::RgbImage;

use crate::assets::build::Obj;
use crate::assets::paint::{hash, mix, noise, picture, step, supersampled};
use chest::{bands, chest, lid, lid_bands, opened};
use hoard::{coins, gems, goblet, mound};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl wood
Kd 1 1 1
Ks 0.1 0.1 0.1
Ns 12
map_Kd wood.png

newmtl iron
Kd 0.2 0.19 0.19
Ks 0.5 0.5 0.5
Ns 40

newmtl gold
Kd 1 1 1
Ks 0.9 0.75 0.4
Ns 60
map_Kd gold.png

newmtl ruby
Kd 0.7 0.04 0.1
Ks 0.9 0.9 0.9
Ns 120
";

pub fn obj() -> String {
    let mut obj = Obj::new("Treasure chest", "treasure.mtl", [3, 3, 3]);
    obj.object("chest", "wood", &chest());
    obj.object("lid", "wood", &opened(lid()));
    obj.object("bands", "iron", &[bands(), opened(lid_bands())].concat());
    obj.object("hoard", "gold", &[vec![mound()], goblet()].concat());
    obj.object("coins", "gold", &coins());
    obj.object("gems", "ruby", &gems());
    obj.text()
}

/// Dark planks that repeat, five to a picture.
pub fn wood() -> RgbImage {
    picture(256, 256, 6, |u, v| {
        let plank = (v * 5.0).floor();
        let across = v * 5.0 - plank;
        let tone = 0.85 + 0.3 * hash(plank as i64, 1, 4);
        let wander = noise(u * 4.0, across * 1.5, 4, 64, plank as i64 + 20);
        let rings = ((across * 4.0 + 2.5 * wander) * TAU).sin();
        let fibre = noise(u * 16.0, v * 100.0, 16, 100, 5) - 0.5;
        let wood = DVec3::new(0.47, 0.27, 0.13) * (tone + 0.07 * rings + 0.14 * fibre);
        mix(
            wood,
            wood * 0.25,
            step(0.07, 0.02, across.min(1.0 - across)),
        )
    })
}

/// Coins that lie over each other. Repeats in both directions.
pub fn gold() -> RgbImage {
    const CELLS: i64 = 7;
    supersampled(256, 256, |u, v| {
        let place = DVec2::new(u, v) * CELLS as f64;
        let mut color = DVec3::new(0.40, 0.24, 0.05);
        let mut highest = 0.0;
        for near in 0..25 {
            let (x, y) = (place.x as i64 + near % 5 - 2, place.y as i64 + near / 5 - 2);
            let random = |seed| hash(x.rem_euclid(CELLS), y.rem_euclid(CELLS), seed);
            let middle = DVec2::new(x as f64 + random(1), y as f64 + random(2));
            let from_middle = place.distance(middle) / 0.72;
            if from_middle < 1.0 && random(3) > highest {
                highest = random(3);
                let rim = step(0.74, 0.78, from_middle) - step(0.90, 1.0, from_middle);
                let head = step(0.42, 0.36, from_middle);
                let shade = 0.72 + 0.30 * random(4) + 0.16 * rim + 0.10 * head
                    - 0.25 * step(0.9, 1.0, from_middle);
                color = DVec3::new(0.98, 0.74, 0.22) * shade;
            }
        }
        color
    })
}
