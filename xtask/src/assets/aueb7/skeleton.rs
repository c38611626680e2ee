//! A pirate's skeleton with a cutlass: 10 high, y up, on y = 0, its face towards −z.

mod cutlass;
mod limbs;
mod skull;
mod trunk;

use glam::{DMat4, DVec3};
use image::RgbImage;
use shadowlab::scene::Mesh;

use crate::assets::build::{Obj, ball, mirrored, placed};
use crate::assets::paint::{noise, picture, smooth};
use cutlass::{blade, hilt};
use limbs::{arms, leg};
use skull::{skull, sockets};
use trunk::{breastbone, pelvis, ribs, spine};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl bone
Kd 1 1 1
Ks 0.15 0.15 0.15
Ns 16
map_Kd bone.png

newmtl hollow
Kd 0.05 0.04 0.03
Ks 0 0 0
Ns 1

newmtl steel
Kd 0.6 0.62 0.65
Ks 0.8 0.8 0.8
Ns 80

newmtl grip
Kd 0.5 0.33 0.1
Ks 0.5 0.4 0.2
Ns 40
";

pub fn obj() -> String {
    let mut obj = Obj::new("Skeleton", "skeleton.mtl", [3, 3, 3]);
    obj.object("skull", "bone", &skull());
    obj.object("sockets", "hollow", &sockets());
    obj.object(
        "trunk",
        "bone",
        &[spine(), breastbone(), pelvis(), ribs()].concat(),
    );
    obj.object("arms", "bone", &arms());
    obj.object("legs", "bone", &both(leg()));
    obj.object("blade", "steel", &[blade()]);
    obj.object("hilt", "grip", &hilt());
    obj.text()
}

/// Old bone: yellowish, with fine cracks along it.
pub fn bone_picture() -> RgbImage {
    picture(128, 128, 4, |u, v| {
        let stain = noise(u * 5.0, v * 5.0, 5, 5, 3);
        let crack = noise(u * 32.0, v * 6.0, 32, 6, 8);
        let dark = 1.0 - 0.14 * stain - 0.22 * smooth(0.78, 0.92, crack);
        DVec3::new(0.93, 0.88, 0.74) * dark
    })
}

fn both(side: Vec<Mesh>) -> Vec<Mesh> {
    let other: Vec<Mesh> = side.iter().cloned().map(mirrored).collect();
    [side, other].concat()
}

fn ellipsoid(middle: DVec3, half: DVec3, slices: u32) -> Mesh {
    let placement = DMat4::from_translation(middle) * DMat4::from_scale(half);
    placed(ball(0.0, 1.0, slices), placement)
}
