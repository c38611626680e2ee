//! A treasure chest, drawn half as large: its front towards −z, the lid open, gold inside and spilled before it.

use std::f64::consts::{PI, TAU};

use glam::{DMat4, DQuat, DVec2, DVec3};
use image::RgbImage;
use shadowlab::scene::Mesh;

use crate::assets::build::{
    Ends, Obj, ball, bar, block, cylinder, mirrored, placed, skin, tube, turned,
};
use crate::assets::paint::{hash, mix, noise, picture, step, supersampled};

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

/// Half the chest's length and depth, and the height of its body.
const HALF: DVec2 = DVec2::new(9.0, 5.5);
const HEIGHT: f64 = 7.0;
const BOARD: f64 = 0.7;

/// The picture runs along the boards: one repeat is seven units.
fn planks(position: DVec3, normal: DVec3) -> DVec2 {
    let along = if normal.x.abs() > 0.5 {
        position.z
    } else {
        position.x
    };
    let up = if normal.y.abs() > 0.5 {
        position.z
    } else {
        position.y
    };
    DVec2::new(along, up) / 7.0
}

fn board(low: [f64; 3], high: [f64; 3]) -> Mesh {
    block(DVec3::from(low), DVec3::from(high), planks)
}

/// The same box at x and at −x.
fn at_both_ends(mesh: Mesh) -> [Mesh; 2] {
    [mirrored(mesh.clone()), mesh]
}

fn chest() -> Vec<Mesh> {
    let DVec2 { x, y: z } = HALF;
    let inner = x - BOARD + 0.05;
    let mut boards = vec![
        board([-inner, 0.3, -z + 0.1], [inner, 1.0, z - 0.1]),
        board([-x, 0.4, -z], [x, HEIGHT, -z + BOARD]),
        board([-x, 0.4, z - BOARD], [x, HEIGHT - 0.01, z]),
    ];
    boards.extend(at_both_ends(board(
        [x - BOARD, 0.45, -z + BOARD - 0.05],
        [x - 0.02, HEIGHT - 0.02, z - BOARD + 0.05],
    )));
    boards
}

/// Straps over the boards, a rim, corners, feet, the lock and the handles.
fn bands() -> Vec<Mesh> {
    let DVec2 { x, y: z } = HALF;
    let iron = |low: [f64; 3], high: [f64; 3]| {
        block(DVec3::from(low), DVec3::from(high), |_, _| DVec2::ZERO)
    };
    let mut parts = Vec::new();
    for face in [-z, z] {
        let out = face.signum() * 0.18;
        let (near, far) = ((face - out).min(face + out), (face - out).max(face + out));
        parts.push(iron(
            [-x - 0.1, HEIGHT - 1.0, near],
            [x + 0.1, HEIGHT + 0.08, far],
        ));
        parts.push(iron([-x - 0.1, 0.25, near], [x + 0.1, 1.1, far]));
        parts.extend(at_both_ends(iron(
            [4.0, 0.5, near * 1.01],
            [5.2, HEIGHT - 0.3, far * 1.01],
        )));
        parts.extend(at_both_ends(iron(
            [x - 1.0, 0.0, near * 1.02],
            [x + 0.2, HEIGHT + 0.12, far * 1.02],
        )));
    }
    parts.extend(at_both_ends(iron(
        [x - 0.1, HEIGHT - 0.95, -z + 0.1],
        [x + 0.15, HEIGHT + 0.06, z - 0.1],
    )));
    parts.push(iron([-1.3, 4.1, -z - 0.4], [1.3, 6.6, -z + 0.1]));
    let ring: Vec<(DVec3, DVec2)> = (0..=12)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 12.0).sin_cos();
            let place = DVec3::new(x - 0.1 + 1.5 * sin, 4.6 - 0.9 * sin, 1.6 * cos);
            (place, DVec2::splat(0.2))
        })
        .collect();
    parts.extend(at_both_ends(tube(&ring, DVec3::Y, 7)));
    parts
}

/// A half cylinder of boards with two ends, closed: its axis at the height of the rim.
fn lid() -> Vec<Mesh> {
    let shell = arch(HALF.y - 0.35, 0.35, 0.0, HALF.x - 0.05);
    let end = half_disc(HALF.x - BOARD, HALF.x - 0.1, HALF.y - 0.3);
    let mut parts = vec![shell];
    parts.extend(at_both_ends(end));
    parts
}

fn lid_bands() -> Vec<Mesh> {
    let hasp = block(
        DVec3::new(-0.6, HEIGHT - 1.2, -HALF.y - 0.35),
        DVec3::new(0.6, HEIGHT + 1.6, -HALF.y + 0.1),
        |_, _| DVec2::ZERO,
    );
    let mut parts = vec![hasp];
    parts.extend(at_both_ends(arch(HALF.y - 0.05, 0.22, 4.6, 0.6)));
    parts.extend(at_both_ends(arch(HALF.y - 0.03, 0.24, HALF.x - 0.45, 0.6)));
    parts
}

/// Half a ring about the lid's axis: `half` thick each way from `radius`, and `width` each way from `x`.
fn arch(radius: f64, half: f64, x: f64, width: f64) -> Mesh {
    let path: Vec<(DVec3, DVec2)> = (0..=18)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 18.0).sin_cos();
            let place = DVec3::new(x, HEIGHT + 0.1 + radius * sin, -radius * cos);
            (place, DVec2::new(half, width))
        })
        .collect();
    let mut mesh = bar(&path, DVec3::X);
    for (uv, position) in mesh.texture_coords.iter_mut().zip(&mesh.positions) {
        let around = (position.y - HEIGHT).atan2(-position.z);
        *uv = DVec2::new(position.x, around * radius) / 7.0;
    }
    mesh
}

/// An upright half disc from x = `low` to `high`, sharp at all its edges.
fn half_disc(low: f64, high: f64, radius: f64) -> Mesh {
    let mut outline: Vec<DVec2> = (0..=16)
        .map(|i| DVec2::from_angle(PI * (f64::from(i) / 16.0 - 0.5)) * radius)
        .collect();
    // The two corners at the foot.
    outline.insert(0, outline[0]);
    outline.push(outline[outline.len() - 1]);
    let ring = |x: f64| -> Vec<DVec3> {
        let point = |p: &DVec2| DVec3::new(x, HEIGHT + 0.1 + p.x, p.y);
        outline.iter().map(point).collect()
    };
    let middle = |x: f64| DVec3::new(x, HEIGHT + 0.1 + 0.4 * radius, 0.0);
    let rings = [ring(low), ring(low), ring(high), ring(high)];
    let mut mesh = skin([middle(low), middle(high)], &rings, |_, _| DVec2::ZERO);
    for (uv, position) in mesh.texture_coords.iter_mut().zip(&mesh.positions) {
        *uv = DVec2::new(position.z, position.y) / 7.0;
    }
    mesh
}

/// Thrown back over the hinge at the rear.
fn opened(parts: Vec<Mesh>) -> Vec<Mesh> {
    let hinge = DVec3::new(0.0, HEIGHT + 0.15, HALF.y);
    let turn = DMat4::from_translation(hinge)
        * DMat4::from_quat(DQuat::from_rotation_x(100_f64.to_radians()))
        * DMat4::from_translation(-hinge);
    parts.into_iter().map(|part| placed(part, turn)).collect()
}

/// The gold's surface above a place in the chest.
fn gold_height(at: DVec2) -> f64 {
    let share = (at / DVec2::new(8.25, 4.7)).length();
    let bumps = noise(at.x * 0.8 + 40.0, at.y * 0.8 + 40.0, i64::MAX, i64::MAX, 3) - 0.5;
    5.6 + 2.6 * (1.0 - share * share).max(0.0) + 0.9 * bumps
}

/// Fills the chest from wall to wall: a flattened heap over a rectangle with round corners.
fn mound() -> Mesh {
    const COLUMNS: usize = 48;
    let rim = |column: usize| {
        let (sin, cos) = (TAU * column as f64 / COLUMNS as f64).sin_cos();
        let round = |x: f64| x.signum() * x.abs().powf(0.35);
        DVec2::new(8.4 * round(cos), 4.9 * round(sin))
    };
    let ring = |share: f64, sunk: f64| -> Vec<DVec3> {
        let point = |column: usize| {
            let at = rim(column) * share;
            DVec3::new(at.x, gold_height(at) - sunk, at.y)
        };
        (0..COLUMNS).map(point).collect()
    };
    let mut rings: Vec<Vec<DVec3>> = (1..=12).map(|i| ring(f64::from(i) / 12.0, 0.0)).collect();
    // Sharp at the walls.
    rings.extend([ring(1.0, 0.0), ring(1.0, 2.0)]);
    let poles = [gold_height(DVec2::ZERO), 2.5].map(|y| DVec3::new(0.0, y, 0.0));
    let mut mesh = skin(poles, &rings, |_, _| DVec2::ZERO);
    for (uv, position) in mesh.texture_coords.iter_mut().zip(&mesh.positions) {
        *uv = DVec2::new(position.x, -position.z) / 8.0;
    }
    mesh
}

/// Coins on the heap, and coins on the ground before the chest.
fn coins() -> Vec<Mesh> {
    let random = |i: i64, what: i64| hash(i, what, 77);
    let coin = |i: i64, place: DVec3, tilt: f64| {
        let flat = cylinder(0.68, -0.08, 0.08, 12);
        let turn = DQuat::from_rotation_y(TAU * random(i, 5)) * DQuat::from_rotation_x(tilt);
        placed(
            one_coin(flat),
            DMat4::from_rotation_translation(turn, place),
        )
    };
    let on_heap = (0..46).map(|i| {
        let at = DVec2::new(14.6 * random(i, 1) - 7.3, 7.6 * random(i, 2) - 3.8);
        let place = DVec3::new(at.x, gold_height(at) + 0.12, at.y);
        coin(i, place, 1.5 * random(i, 3) - 0.6)
    });
    let spilled = (100..134).map(|i| {
        let away = random(i, 2).powf(1.6);
        let at = DVec2::new(11.0 * random(i, 1) - 4.5, -6.6 - 4.5 * away);
        let resting: f64 = if random(i, 4) > 0.8 { 0.5 } else { 0.06 };
        coin(
            i,
            // The lower edge of a tilted coin is still on the ground.
            DVec3::new(at.x, 0.09 + 0.68 * resting.sin() + 0.2 * (1.0 - away), at.y),
            resting,
        )
    });
    on_heap.chain(spilled).collect()
}

/// A coin shows one coin's worth of the picture: plain gold of its rim.
fn one_coin(mut coin: Mesh) -> Mesh {
    for uv in &mut coin.texture_coords {
        *uv = DVec2::new(0.30, 0.40) + *uv * 0.02;
    }
    coin
}

/// A goblet half sunk in the heap, leaning.
fn goblet() -> Vec<Mesh> {
    let profile = [
        [0.0, 0.0],
        [0.95, 0.0],
        [0.9, 0.15],
        [0.3, 0.4],
        [0.2, 0.9],
        [0.32, 1.3],
        [0.85, 1.7],
        [1.1, 2.3],
        [1.15, 3.0],
        [1.05, 3.0],
        [0.95, 2.3],
        [0.7, 1.9],
        [0.0, 1.75],
    ];
    let lean = DQuat::from_rotation_z(0.35) * DQuat::from_rotation_x(-0.2);
    let place = DMat4::from_rotation_translation(lean, DVec3::new(4.6, 6.4, -1.4));
    vec![placed(one_coin(turned(&profile, Ends::OnAxis, 18)), place)]
}

/// Cut stones among the coins: two cones with a flat top.
fn gems() -> Vec<Mesh> {
    let cut = [[0.0, -0.6], [0.65, 0.1], [0.4, 0.4], [0.0, 0.4]];
    let mut stones: Vec<Mesh> = [
        (-4.8, -1.9),
        (-1.0, 0.6),
        (1.9, -2.6),
        (-2.4, -3.1),
        (6.3, 1.2),
    ]
    .iter()
    .zip(0_u8..)
    .map(|(&(x, z), i)| {
        let turn = DQuat::from_rotation_z(0.5) * DQuat::from_rotation_y(f64::from(i));
        let place = DVec3::new(x, gold_height(DVec2::new(x, z)) + 0.3, z);
        placed(
            turned(&cut, Ends::OnAxis, 6),
            DMat4::from_rotation_translation(turn, place),
        )
    })
    .collect();
    // One has rolled away.
    stones.push(placed(
        ball(0.0, 0.5, 12),
        DMat4::from_translation(DVec3::new(-4.5, 0.5, -9.4)),
    ));
    stones
}
