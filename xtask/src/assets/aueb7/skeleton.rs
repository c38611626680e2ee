//! A pirate's skeleton with a cutlass: 10 high, y up, on y = 0, its face towards −z.

use std::f64::consts::{PI, TAU};

use glam::{DMat4, DVec2, DVec3};
use image::RgbImage;
use shadowlab::scene::Mesh;

use crate::assets::build::{Obj, ball, bar, bone, boxed, capsule, mirrored, placed, skin, tube};
use crate::assets::paint::{noise, picture, smooth};

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

const SKULL: DVec3 = DVec3::new(0.0, 9.25, -0.05);
/// Where the eyes were, seen from the skull's middle; and how wide the holes are.
const EYE: DVec3 = DVec3::new(0.34, 0.0, -0.94);
const NOSE: DVec3 = DVec3::new(0.0, -0.42, -0.90);

fn skull() -> Vec<Mesh> {
    const ROWS: usize = 17;
    const COLUMNS: usize = 24;
    let place = |row: usize, column: usize| {
        let (around, up) = (
            TAU * column as f64 / COLUMNS as f64,
            PI * ((row + 1) as f64 / (ROWS + 1) as f64 - 0.5),
        );
        let way = DVec3::new(around.sin() * up.cos(), up.sin(), around.cos() * up.cos());
        SKULL + cranium(way)
    };
    let rings: Vec<Vec<DVec3>> = (0..ROWS)
        .map(|row| (0..COLUMNS).map(|column| place(row, column)).collect())
        .collect();
    let poles = [SKULL + cranium(DVec3::NEG_Y), SKULL + cranium(DVec3::Y)];
    let head = skin(poles, &rings, |row, column| {
        DVec2::new(column as f64 / COLUMNS as f64, row as f64 / ROWS as f64) * 2.0
    });
    let mut parts = vec![head, jaw()];
    for (height, size) in [(8.72, 0.13), (8.58, 0.11)] {
        for i in -3..=3 {
            let angle = f64::from(i) * 0.24;
            let place = DVec3::new(0.36 * angle.sin(), height, -0.14 - 0.42 * angle.cos());
            let tooth = DVec3::new(0.075, size, 0.07);
            parts.push(boxed(tooth, place, -angle.to_degrees()));
        }
    }
    parts
}

/// The skull's surface in a direction: a round braincase, a narrow face, holes for eyes and nose.
fn cranium(way: DVec3) -> DVec3 {
    let low = smooth(0.05, -0.9, way.y);
    let size = DVec3::new(0.60 * (1.0 - 0.35 * low), 0.68, 0.74 - 0.10 * low);
    let hole = |middle: DVec3, reach: f64| (-(way.distance(middle) / reach).powi(4)).exp();
    let eyes = hole(EYE, 0.27) + hole(DVec3::new(-EYE.x, EYE.y, EYE.z), 0.27);
    let cheeks =
        hole(DVec3::new(0.86, -0.40, -0.30), 0.30) + hole(DVec3::new(-0.86, -0.40, -0.30), 0.30);
    let brow = (-((way.y - 0.33) / 0.10).powi(2)).exp() * smooth(-0.5, -0.9, way.z);
    way * size * (1.0 - 0.30 * eyes - 0.20 * hole(NOSE, 0.18) - 0.16 * cheeks + 0.05 * brow)
}

/// The holes' floors are black, whatever light falls in.
fn sockets() -> Vec<Mesh> {
    let size = DVec3::new(0.60, 0.68, 0.74);
    let eye = ellipsoid(SKULL + EYE * size * 0.76, DVec3::new(0.15, 0.155, 0.09), 10);
    let nose = ellipsoid(
        SKULL + NOSE * size * 0.84,
        DVec3::new(0.065, 0.10, 0.09),
        10,
    );
    vec![mirrored(eye.clone()), eye, nose]
}

/// From under one ear around the chin to the other.
fn jaw() -> Mesh {
    let path: Vec<(DVec3, DVec2)> = (0..=12)
        .map(|i| {
            let angle = PI * (f64::from(i) / 12.0 - 0.5) * 1.25;
            let rise = 0.55 * smooth(0.55, 1.0, (angle / (PI * 0.625)).abs());
            let place = DVec3::new(0.43 * angle.sin(), 8.46 + rise, -0.12 - 0.50 * angle.cos());
            (place, DVec2::new(0.085, 0.13))
        })
        .collect();
    tube(&path, DVec3::Y, 6)
}

/// The spine's middle at a height, with its double bend.
fn back(y: f64) -> DVec3 {
    DVec3::new(0.0, y, 0.22 + 0.16 * (1.9 * (y - 5.0)).sin())
}

fn spine() -> Vec<Mesh> {
    (0..12)
        .flat_map(|i| {
            let y = 5.0 + 0.32 * f64::from(i);
            let size = 0.20 - 0.005 * f64::from(i);
            let body = ellipsoid(back(y), DVec3::new(size, 0.16, size), 10);
            // A point that one feels through the skin of the back.
            let way = DVec3::new(0.0, -0.15, 0.34);
            let spur = [(0.0, 0.0), (0.5, 0.07), (1.0, 0.0)]
                .map(|(t, half)| (back(y) + way * t, DVec2::splat(half)));
            let spur = tube(&spur, DVec3::Y, 5);
            [body, spur]
        })
        .collect()
}

fn breastbone() -> Vec<Mesh> {
    let flat = |y: f64, z: f64, width: f64| (DVec3::new(0.0, y, z), DVec2::new(width, 0.06));
    let plate = tube(
        &[
            flat(7.98, -0.40, 0.05),
            flat(7.90, -0.42, 0.20),
            flat(7.55, -0.52, 0.13),
            flat(6.90, -0.60, 0.12),
            flat(6.50, -0.58, 0.07),
            flat(6.42, -0.57, 0.02),
        ],
        DVec3::NEG_Z,
        8,
    );
    let collar = capsule(
        DVec3::new(0.08, 7.88, -0.42),
        DVec3::new(1.05, 8.02, -0.02),
        0.075,
        5,
    );
    let blade = ellipsoid(
        DVec3::new(0.66, 7.45, 0.52),
        DVec3::new(0.36, 0.52, 0.07),
        12,
    );
    [both(vec![collar, blade]), vec![plate]].concat()
}

/// Eight pairs: six reach the breastbone, two end at the side.
fn ribs() -> Vec<Mesh> {
    let rib = |i: u32| {
        let t = f64::from(i) / 7.0;
        let top = back(7.85 - 1.75 * t);
        let width = 0.52 + 0.42 * (PI * (0.15 + 0.75 * t)).sin();
        let reach = if i < 6 { 1.0 } else { 0.62 };
        let path: Vec<(DVec3, DVec2)> = (0..=8)
            .map(|step| {
                let along = reach * f64::from(step) / 8.0;
                let (sin, cos) = (PI * along).sin_cos();
                let depth = 0.5 * (top.z + 0.52 + 0.10 * t);
                let place = DVec3::new(
                    0.08 + width * sin - 0.06 * along,
                    top.y - (0.30 + 0.25 * t) * along,
                    top.z - depth * (1.0 - cos),
                );
                (place, DVec2::new(0.06, 0.085))
            })
            .collect();
        tube(&path, DVec3::Y, 5)
    };
    both((0..8).map(rib).collect())
}

fn pelvis() -> Vec<Mesh> {
    // The rim of the hip bone, from the sacrum around to the front, and the ring below it.
    let rim: Vec<(DVec3, DVec2)> = (0..=12)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 12.0).sin_cos();
            let place = DVec3::new(
                0.10 + 0.72 * sin,
                5.0 + 0.34 * sin - 0.18 * (1.0 - cos),
                0.05 + 0.38 * cos,
            );
            (place, DVec2::new(0.10, 0.24))
        })
        .collect();
    let joint = ellipsoid(
        DVec3::new(0.50, 4.68, 0.0),
        DVec3::new(0.20, 0.24, 0.20),
        12,
    );
    let front = capsule(
        DVec3::new(0.48, 4.60, -0.08),
        DVec3::new(0.05, 4.50, -0.30),
        0.10,
        8,
    );
    let sacrum = ellipsoid(
        DVec3::new(0.0, 4.82, 0.32),
        DVec3::new(0.26, 0.42, 0.14),
        12,
    );
    [
        both(vec![tube(&rim, DVec3::Y, 8), joint, front]),
        vec![sacrum],
    ]
    .concat()
}

/// The one at x > 0.
fn leg() -> Vec<Mesh> {
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
/// The hand that holds the cutlass, raised beside the head.
const FIST: DVec3 = DVec3::new(2.35, 8.15, -0.75);

fn arms() -> Vec<Mesh> {
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

/// The way the cutlass points.
fn sword() -> DVec3 {
    DVec3::new(0.42, 0.80, -0.42).normalize()
}

/// A broad blade that bends backwards and ends in a point.
fn blade() -> Mesh {
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
fn hilt() -> Vec<Mesh> {
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
