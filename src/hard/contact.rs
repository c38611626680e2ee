//! Thin, single-sided and touching things: where a bias loses what is near, and culling what has no back.

use glam::{DMat4, DVec3, dvec3};

use super::Case;
use super::Expected::{FalseLight, FalseShadow, Holds};
use super::build::{GREY, ORANGE, at, camera, floor, lying, object, scene, sheet, solid, spot};
use crate::scene::{Beam, Light, Object, Scene, rotate, shapes};

pub const CASES: &[Case] = &[
    Case {
        name: "single-sided",
        about: "a leaf of one side floats over the floor and faces the light",
        lab: "cs541",
        scene: single_sided,
        expected: &[
            ("remedy=culling", FalseLight(500)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "touching-sheets",
        about: "two leaves share an edge: no light comes through between them",
        lab: "cs541",
        scene: touching_sheets,
        expected: &[
            ("remedy=culling", FalseLight(500)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "roof",
        about: "two leaves lean on each other: no light comes through at the ridge",
        lab: "cs541",
        scene: roof,
        expected: &[
            ("remedy=culling", FalseLight(500)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "wall",
        about: "a wall 0.005 thick stands on the floor: its shadow begins at its foot",
        lab: "cs541",
        scene: wall,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", FalseLight(50)),
            ("remedy=epsilon epsilon=0.0001 map_size=4096", Holds(0, 0)),
        ],
    },
    Case {
        name: "box-on-floor",
        about: "a box rests on the floor: its bottom and the floor are one plane",
        lab: "cs541",
        scene: box_on_floor,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "sphere-on-floor",
        about: "a sphere touches the floor in one point, from which its shadow spreads",
        lab: "cs541",
        scene: sphere_on_floor,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "interpenetrating",
        about: "two boxes stand in each other and in the floor: the lit sides meet in concave edges",
        lab: "cs541",
        scene: interpenetrating,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "corner",
        about: "a box before the corner of two walls and a floor, which it shadows",
        lab: "cs541",
        scene: corner,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
];

/// From the right and behind: shadows fall to the left, towards the camera.
fn light() -> Light {
    spot(dvec3(4.0, 7.0, -3.0), DVec3::ZERO, 60.0, Beam::Circular)
}

fn on_floor(casters: impl IntoIterator<Item = Object>) -> Scene {
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.5, 0.3, 0.3), 45.0),
        light(),
        [floor(10.0)].into_iter().chain(casters).collect(),
    )
}

fn leaf(placement: DMat4) -> Object {
    sheet("leaf", placement, ORANGE)
}

fn single_sided() -> Scene {
    let tilted = rotate(15.0, DVec3::X) * lying();
    on_floor([leaf(at(1.2 * DVec3::Y) * tilted)])
}

/// Two Planes from −2 to 0 and from 0 to 2, whose edges at 0 are the same to the last bit.
fn touching_sheets() -> Scene {
    let beside = |x: f64| leaf(at(dvec3(x, 1.2, 0.0)) * lying());
    on_floor([beside(-1.0), beside(1.0)])
}

/// Two Planes from the ridge down: the ridge is where both are turned about.
fn roof() -> Scene {
    let slope = |side: f64| {
        let from_ridge = at(dvec3(side, 0.0, 0.0)) * lying();
        leaf(at(1.6 * DVec3::Y) * rotate(-30.0 * side, DVec3::Z) * from_ridge)
    };
    on_floor([slope(-1.0), slope(1.0)])
}

fn wall() -> Scene {
    let half = dvec3(1.5, 0.0, 0.0025);
    let wall = solid("wall", -half, half + 1.2 * DVec3::Y, ORANGE);
    Scene {
        // Close to where the shadow begins.
        camera: camera(dvec3(-0.8, 1.0, 1.6), dvec3(0.0, 0.05, 0.1), 45.0),
        ..on_floor([wall])
    }
}

fn box_on_floor() -> Scene {
    let half = dvec3(0.7, 0.0, 0.7);
    let low = solid("box", -half, half + DVec3::Y, ORANGE);
    on_floor([low])
}

fn sphere_on_floor() -> Scene {
    on_floor([object("sphere", shapes::sphere(32), at(DVec3::Y), ORANGE)])
}

fn interpenetrating() -> Scene {
    let cube = |turn: DMat4, place: DVec3| {
        let scaled = DMat4::from_scale(DVec3::splat(1.4));
        object("box", shapes::cube(), at(place) * turn * scaled, ORANGE)
    };
    let upright = cube(rotate(20.0, DVec3::Y), dvec3(0.4, 0.5, 0.0));
    let leaning = cube(rotate(35.0, dvec3(1.0, 0.3, 1.0)), dvec3(-0.4, 0.5, 0.5));
    on_floor([upright, leaning])
}

fn corner() -> Scene {
    let wall = |low: DVec3, high: DVec3| solid("wall", low, high, GREY);
    let objects = vec![
        floor(10.0),
        wall(dvec3(-2.5, 0.0, -2.5), dvec3(-2.3, 2.0, 2.5)),
        wall(dvec3(-2.5, 0.0, -2.5), dvec3(2.5, 2.0, -2.3)),
        solid(
            "box",
            dvec3(-1.9, 0.0, -1.9),
            dvec3(-1.1, 1.0, -1.1),
            ORANGE,
        ),
    ];
    scene(
        camera(dvec3(3.0, 4.0, 4.5), dvec3(-1.0, 0.4, -1.0), 45.0),
        spot(
            dvec3(4.0, 5.0, -0.5),
            dvec3(-1.0, 0.0, -1.0),
            60.0,
            Beam::Circular,
        ),
        objects,
    )
}
