//! The chest of boards and iron, and its lid.

use std::f64::consts::PI;

use glam::{DMat4, DQuat, DVec2, DVec3};
use shadowlab::scene::Mesh;

use crate::assets::build::{bar, block, mirrored, placed, skin, tube};

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

pub fn chest() -> Vec<Mesh> {
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
pub fn bands() -> Vec<Mesh> {
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
pub fn lid() -> Vec<Mesh> {
    let shell = arch(HALF.y - 0.35, 0.35, 0.0, HALF.x - 0.05);
    let end = half_disc(HALF.x - BOARD, HALF.x - 0.1, HALF.y - 0.3);
    let mut parts = vec![shell];
    parts.extend(at_both_ends(end));
    parts
}

pub fn lid_bands() -> Vec<Mesh> {
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
pub fn opened(parts: Vec<Mesh>) -> Vec<Mesh> {
    let hinge = DVec3::new(0.0, HEIGHT + 0.15, HALF.y);
    let turn = DMat4::from_translation(hinge)
        * DMat4::from_quat(DQuat::from_rotation_x(100_f64.to_radians()))
        * DMat4::from_translation(-hinge);
    parts.into_iter().map(|part| placed(part, turn)).collect()
}
