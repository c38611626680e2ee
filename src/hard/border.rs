//! Where the map ends.

use glam::{DVec3, dvec3};

use super::Case;
use super::Expected::{FalseShadow, Holds};
use super::build::{ORANGE, camera, floor, scene, solid, spot, sun};
use crate::scene::{Beam, Object, Scene};

pub const CASES: &[Case] = &[
    Case {
        name: "map-border",
        about: "a floor that fills the map from uv 0 to uv 1 exactly, with boxes at its border",
        lab: "csci3260",
        scene: || at_border([-10.0, 10.0, -8.0, 8.0]),
        expected: &[
            ("stage=no_bias", FalseShadow(5_000)),
            ("stage=constant", Holds(0, 0)),
            ("stage=pcf", Holds(0, 0)),
        ],
    },
    Case {
        name: "beyond-the-map",
        about: "a map that ends amid the boxes: its last texels streak outwards",
        lab: "csci3260",
        scene: || at_border([-6.0, 6.0, -5.0, 5.0]),
        expected: &[("stage=constant", FalseShadow(100))],
    },
    Case {
        name: "beam-border",
        about: "boxes that cross the border of a rectangular beam, which is the map's",
        lab: "cs541",
        scene: beam_border,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
];

fn boxes(places: &[[f64; 2]]) -> impl Iterator<Item = Object> {
    places.iter().map(|[x, z]| {
        let foot = dvec3(*x, 0.0, *z);
        let half = dvec3(0.4, 0.0, 0.4);
        solid("box", foot - half, foot + half + 0.8 * DVec3::Y, ORANGE)
    })
}

/// Light from −x: across its axis, the floor is 20 wide and 20 · 0.8 high.
fn at_border(area: [f64; 4]) -> Scene {
    let casters = boxes(&[
        [8.5, 3.0],
        [8.0, -3.0],
        [6.0, 9.6],
        [3.5, 9.6],
        [6.2, 1.0],
        [3.0, 6.0],
    ]);
    scene(
        camera(dvec3(14.0, 7.0, 15.0), dvec3(6.5, 0.0, 4.0), 50.0),
        sun(dvec3(-0.6, 0.8, 0.0), area),
        [floor(10.0)].into_iter().chain(casters).collect(),
    )
}

fn beam_border() -> Scene {
    let casters = boxes(&[[2.1, 0.5], [0.3, 2.2], [-1.6, 0.0], [0.0, -1.4], [0.4, 0.3]]);
    scene(
        camera(dvec3(-3.0, 5.5, 6.0), dvec3(0.3, 0.0, 0.3), 45.0),
        spot(dvec3(2.0, 6.0, 1.0), DVec3::ZERO, 40.0, Beam::Rectangular),
        [floor(10.0)].into_iter().chain(casters).collect(),
    )
}
