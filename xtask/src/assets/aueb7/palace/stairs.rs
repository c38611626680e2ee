//! The stairs: into the gate, down into the court, and up to the first terrace.
//!
//! A stair is slabs in each other: the higher, the narrower, by a hair on the sides that are flush to the eye.

use super::parts::slab;
use super::{GROUND, Palace, STOREY};

pub fn all(palace: &mut Palace) {
    gate(palace);
    grand_staircase(palace);
    theatre(palace);
}

const HAIR: f64 = 0.01;

/// Four broad steps before the gate.
fn gate(palace: &mut Palace) {
    for i in 0..4 {
        let out = f64::from(i);
        let top = GROUND + 0.15 + 0.18 * (3.0 - out);
        palace.paving.push(slab(
            [-5.6 - 0.3 * out, GROUND - 0.05, 10.4 - HAIR * out],
            [9.6 + 0.3 * out, top, 18.9 + 0.8 * out],
        ));
    }
}

/// From the court up to the terrace over the west wing's ground floor, between two parapets.
fn grand_staircase(palace: &mut Palace) {
    let steps = 14;
    let (front, back) = (-7.6, -2.4);
    let flight = |i: i32, steps: i32| {
        let share = f64::from(i) / f64::from(steps);
        (
            HAIR * f64::from(i),
            11.2 * share,
            STOREY * (share + 1.0 / f64::from(steps)),
        )
    };
    for i in 0..steps {
        let (hair, gone, risen) = flight(i, steps);
        palace.paving.push(slab(
            [-13.7 + hair, GROUND - 0.05, front + hair],
            [-2.0 - gone, GROUND + risen - 0.02, back - hair],
        ));
    }
    for z in [front - 0.35, back - 0.05] {
        for i in 0..5 {
            let (hair, gone, risen) = flight(i, 5);
            palace.stone.push(slab(
                [-13.75 + hair, GROUND - 0.05, z + hair],
                [-1.6 - gone, GROUND + risen + 0.6, z + 0.4 - hair],
            ));
        }
    }
}

/// Low seats along the court's north-east corner.
fn theatre(palace: &mut Palace) {
    for i in 0..4 {
        let out = f64::from(i);
        palace.paving.push(slab(
            [11.0 - 1.1 * out, GROUND - 0.05, -8.9 - HAIR * out],
            [20.2 + HAIR * out, GROUND + 0.35 * (4.0 - out), -6.6 + out],
        ));
    }
}
