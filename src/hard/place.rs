//! One scene in other places and other sizes: what is right of it at the origin must be right of it there.

use glam::{DMat4, DVec3, dvec3};

use super::Case;
use super::Expected::{FalseShadow, Holds};
use super::build::{ORANGE, at, camera, floor, object, scene, solid, spot};
use crate::scene::{Beam, Scene, rotate, shapes};

pub const CASES: &[Case] = &[
    case("here", "a ring, a ball and a box on a floor", still_life),
    case("far-1e5", "the same, 1e5 from the origin", || far(1e5)),
    case("far-1e6", "the same, 1e6 from the origin", || far(1e6)),
    case("scale-1e-3", "the same, a thousandth of its size", || {
        still_life().scaled(1e-3)
    }),
    case("scale-1e4", "the same, 1e4 times its size", || {
        still_life().scaled(1e4)
    }),
];

const fn case(name: &'static str, about: &'static str, scene: fn() -> Scene) -> Case {
    Case {
        name,
        about,
        lab: "cs541",
        scene,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    }
}

fn far(distance: f64) -> Scene {
    still_life().moved(distance * dvec3(1.0, -2.0, 0.5))
}

fn still_life() -> Scene {
    let ring =
        at(dvec3(-0.9, 0.9, 0.8)) * rotate(-60.0, DVec3::X) * DMat4::from_scale(DVec3::splat(0.9));
    let ball = at(dvec3(1.2, 0.7, 0.6)) * DMat4::from_scale(DVec3::splat(0.7));
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.2, 0.3, 0.3), 45.0),
        spot(dvec3(4.0, 7.0, -3.0), DVec3::ZERO, 60.0, Beam::Circular),
        vec![
            floor(10.0),
            object("ring", shapes::torus(0.35, 24), ring, ORANGE),
            object("ball", shapes::sphere(24), ball, ORANGE),
            solid("box", dvec3(-0.5, 0.0, -1.6), dvec3(0.5, 1.0, -0.6), ORANGE),
        ],
    )
}
