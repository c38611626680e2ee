//! One scene in other places and other sizes: what is right of it at the origin must be right of it there.

use glam::{DMat4, DVec3, dvec3};

use super::Case;
use super::Expected::{self, FalseShadow, Holds};
use super::build::{ORANGE, at, camera, floor, object, scene, solid, spot, sun};
use crate::scene::{Beam, Light, Scene, rotate, shapes};

pub const CASES: &[Case] = &[
    in_spot("here", "a ring, a ball and a box on a floor", || {
        still_life(lamp())
    }),
    in_spot("far-1e5", "ring, ball and box 1e5 from the origin", || {
        far(lamp(), 1e5)
    }),
    in_spot("far-1e6", "ring, ball and box 1e6 from the origin", || {
        far(lamp(), 1e6)
    }),
    in_spot("scale-1e-3", "ring, ball and box times 1e-3", || {
        still_life(lamp()).scaled(1e-3)
    }),
    in_spot("scale-1e4", "ring, ball and box times 1e4", || {
        still_life(lamp()).scaled(1e4)
    }),
    in_sun(
        "sun-far-1e6",
        "ring, ball and box 1e6 from the origin",
        || far(daylight(), 1e6),
    ),
    in_sun("sun-scale-1e-3", "ring, ball and box times 1e-3", || {
        still_life(daylight()).scaled(1e-3)
    }),
    in_sun("sun-scale-1e4", "ring, ball and box times 1e4", || {
        still_life(daylight()).scaled(1e4)
    }),
];

const fn in_spot(name: &'static str, about: &'static str, scene: fn() -> Scene) -> Case {
    const EXPECTED: &[(&str, Expected)] = &[
        ("remedy=none filter=nearest", FalseShadow(5_000)),
        ("remedy=epsilon", Holds(0, 0)),
    ];
    Case {
        name,
        about,
        lab: "cs541",
        scene,
        expected: EXPECTED,
    }
}

const fn in_sun(name: &'static str, about: &'static str, scene: fn() -> Scene) -> Case {
    const EXPECTED: &[(&str, Expected)] = &[
        ("stage=no_bias", FalseShadow(5_000)),
        ("stage=constant", Holds(0, 0)),
    ];
    Case {
        name,
        about,
        lab: "csci3260",
        scene,
        expected: EXPECTED,
    }
}

const TOWARDS: DVec3 = DVec3::new(4.0, 7.0, -3.0);

fn lamp() -> Light {
    spot(TOWARDS, DVec3::ZERO, 60.0, Beam::Circular)
}

fn daylight() -> Light {
    sun(TOWARDS, [-11.0, 11.0, -11.0, 11.0])
}

fn far(light: Light, distance: f64) -> Scene {
    still_life(light).moved(distance * dvec3(1.0, -2.0, 0.5))
}

fn still_life(light: Light) -> Scene {
    let ring =
        at(dvec3(-0.9, 0.9, 0.8)) * rotate(-60.0, DVec3::X) * DMat4::from_scale(DVec3::splat(0.9));
    let ball = at(dvec3(1.2, 0.7, 0.6)) * DMat4::from_scale(DVec3::splat(0.7));
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.2, 0.3, 0.3), 45.0),
        light,
        vec![
            floor(10.0),
            object("ring", shapes::torus(0.35, 24), ring, ORANGE),
            object("ball", shapes::sphere(24), ball, ORANGE),
            solid("box", dvec3(-0.5, 0.0, -1.6), dvec3(0.5, 1.0, -0.6), ORANGE),
        ],
    )
}
