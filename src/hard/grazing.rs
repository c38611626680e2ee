//! Light that skims over the floor: a texel covers a length of it that grows with the tangent of the angle.

use glam::{DVec3, dvec3};

use super::Case;
use super::Expected::{FalseShadow, Grey, Holds};
use super::build::{GREY, ORANGE, camera, floor, scene, solid, spot, sun};
use crate::scene::{Beam, Object, Scene};

pub const CASES: &[Case] = &[
    Case {
        name: "grazing-60",
        about: "thin poles on a slab, 60 degrees from its normal to the light",
        lab: "csci3260",
        scene: || poles(60.0),
        expected: &[
            ("stage=no_bias", FalseShadow(10_000)),
            ("stage=constant", Holds(0, 0)),
        ],
    },
    Case {
        name: "grazing-75",
        about: "thin poles on a slab, 75 degrees from its normal to the light",
        lab: "csci3260",
        scene: || poles(75.0),
        expected: &[
            ("stage=no_bias", FalseShadow(10_000)),
            ("stage=constant", Holds(0, 0)),
        ],
    },
    Case {
        name: "grazing-85",
        about: "at 85 degrees: a constant bias is just enough, and not for PCF",
        lab: "csci3260",
        scene: || poles(85.0),
        expected: &[
            ("stage=no_bias", FalseShadow(10_000)),
            ("stage=constant", Holds(0, 0)),
            ("stage=pcf", Grey(10_000)),
        ],
    },
    Case {
        name: "grazing-89",
        about: "at 89 degrees: a slope scaled bias is cut off long before",
        lab: "csci3260",
        scene: || poles(89.0),
        expected: &[
            ("stage=constant", FalseShadow(5_000)),
            ("stage=slope", FalseShadow(1_000)),
            ("stage=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "grazing-89.9",
        about: "at 89.9 degrees: a texel covers twelve units of the floor",
        lab: "csci3260",
        scene: || poles(89.9),
        expected: &[
            ("stage=constant", FalseShadow(5_000)),
            ("stage=slope", FalseShadow(5_000)),
            ("stage=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "grazing-spot",
        about: "poles under a spot light that stands 1 degree above the floor's middle",
        lab: "cs541",
        scene: low_spot,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(10_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
];

/// Four poles of five texels' width, each higher than the one before.
fn row_of_poles(x: f64) -> impl Iterator<Item = Object> {
    let heights = [0.3, 0.6, 1.0, 1.5];
    heights.into_iter().zip(0..).map(move |(height, number)| {
        let foot = dvec3(x, 0.0, 1.5 * f64::from(number) - 2.25);
        let half = dvec3(0.05, 0.0, 0.05);
        let top = foot + half + height * DVec3::Y;
        solid("pole", foot - half, top, ORANGE)
    })
}

/// The slab is closed: its underside is what front face culling leaves in the map.
fn poles(degrees: f64) -> Scene {
    let slab = solid(
        "slab",
        dvec3(-10.0, -0.5, -10.0),
        dvec3(10.0, 0.0, 10.0),
        GREY,
    );
    let (sin, cos) = degrees.to_radians().sin_cos();
    scene(
        camera(dvec3(-2.5, 4.0, 7.5), dvec3(-0.5, 0.0, 0.0), 45.0),
        // A little wider than the slab.
        sun(dvec3(sin, cos, 0.0), [-11.0, 11.0, -11.0, 11.0]),
        [slab].into_iter().chain(row_of_poles(2.5)).collect(),
    )
}

fn low_spot() -> Scene {
    // 1 degree above the horizon, seen from the floor's middle.
    let position = dvec3(9.0, 9.0 * 1_f64.to_radians().tan(), 0.0);
    scene(
        camera(dvec3(-2.5, 4.0, 7.5), dvec3(-0.5, 0.0, 0.0), 45.0),
        spot(position, DVec3::ZERO, 60.0, Beam::Circular),
        [floor(10.0)].into_iter().chain(row_of_poles(2.5)).collect(),
    )
}
