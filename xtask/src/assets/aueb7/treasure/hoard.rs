//! What is in the chest, and what fell out of it.

use std::f64::consts::TAU;

use glam::{DMat4, DQuat, DVec2, DVec3};
use shadowlab::scene::Mesh;

use crate::assets::build::{Ends, ball, cylinder, placed, skin, turned};
use crate::assets::paint::{hash, noise};

/// The gold's surface above a place in the chest.
fn gold_height(at: DVec2) -> f64 {
    let share = (at / DVec2::new(8.25, 4.7)).length();
    let bumps = noise(at.x * 0.8 + 40.0, at.y * 0.8 + 40.0, i64::MAX, i64::MAX, 3) - 0.5;
    5.6 + 2.6 * (1.0 - share * share).max(0.0) + 0.9 * bumps
}

/// Fills the chest from wall to wall: a flattened heap over a rectangle with round corners.
pub fn mound() -> Mesh {
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
pub fn coins() -> Vec<Mesh> {
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
pub fn goblet() -> Vec<Mesh> {
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
pub fn gems() -> Vec<Mesh> {
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
