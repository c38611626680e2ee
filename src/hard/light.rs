//! Where the light stands, what its beam spans, and what its depths do.

use glam::{DMat4, DQuat, DVec3, dvec3};

use super::Case;
use super::Expected::{FalseLight, FalseShadow, Holds};
use super::build::{
    GREY, ORANGE, at, camera, floor, object, point, scene, sheet, solid, soup, spot, sun,
};
use crate::scene::{Beam, Light, Object, Scene, shapes};

pub const CASES: &[Case] = &[
    Case {
        name: "near-far",
        about: "near 0.1 and far 100, a ball 0.3 from the light and others on the floor",
        lab: "cs541",
        scene: near_far,
        expected: &[
            ("remedy=epsilon", FalseLight(20)),
            (
                "remedy=epsilon epsilon=0.000003 depth_format=16",
                FalseShadow(5_000),
            ),
            (
                "remedy=epsilon epsilon=0.000003 depth_format=24",
                Holds(0, 0),
            ),
            (
                "remedy=epsilon epsilon=0.000003 depth_format=32F",
                Holds(0, 0),
            ),
        ],
    },
    Case {
        name: "overhead",
        about: "a spot light straight above, looking along the up vector of the world",
        lab: "cs541",
        scene: overhead,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(1_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "overhead-sun",
        about: "parallel light straight from above, along the up vector of the world",
        lab: "csci3260",
        scene: overhead_sun,
        expected: &[
            ("stage=no_bias", FalseShadow(500)),
            ("stage=constant", Holds(0, 0)),
        ],
    },
    Case {
        name: "beam-150",
        about: "a beam of 150 degrees; casters behind and across the light's plane, a corner at w = 0",
        lab: "cs541",
        scene: || wide_beam(150.0),
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(1_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "beam-170",
        about: "a beam of 170 degrees, with the casters of beam-150",
        lab: "cs541",
        scene: || wide_beam(170.0),
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(1_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "windows",
        about: "a point light in a box with windows, seen where the shadow map reaches",
        lab: "cs541",
        scene: || windows(dvec3(8.0, 6.0, 6.5), dvec3(7.5, 0.0, 0.0), 38.0),
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "windows-all-round",
        about: "the box with windows from above: one map cannot look through all of them",
        lab: "cs541",
        scene: || windows(dvec3(0.0, 14.0, 9.0), dvec3(0.0, 0.0, 0.5), 50.0),
        expected: &[
            ("remedy=epsilon", FalseLight(5_000)),
            ("shadow_test=offset", FalseLight(5_000)),
        ],
    },
    Case {
        name: "inside",
        about: "a spot light inside a caster: nothing outside of it is lit",
        lab: "cs541",
        scene: || inside(0.02),
        expected: &[
            ("shadows=off", FalseLight(5_000)),
            ("remedy=culling", Holds(0, 0)),
        ],
    },
    Case {
        name: "inside-near",
        about: "a spot light inside a caster that its near plane cuts open",
        lab: "cs541",
        scene: || inside(0.3),
        expected: &[("remedy=epsilon", FalseLight(1_000))],
    },
    Case {
        name: "cosine",
        about: "light along a floor's normal: the cosine rounds above 1, and a slope scaled bias is 0",
        lab: "csci3260",
        scene: along_the_normal,
        expected: &[
            ("stage=slope", FalseShadow(100)),
            ("stage=constant", Holds(0, 0)),
        ],
    },
];

fn ball(place: DVec3, radius: f64) -> Object {
    let scaled = DMat4::from_scale(DVec3::splat(radius));
    object("ball", shapes::sphere(24), at(place) * scaled, ORANGE)
}

fn near_far() -> Scene {
    let position = dvec3(4.0, 7.0, -3.0);
    let axis = -position.normalize();
    // Beside the beam's middle.
    let close = position + 0.3 * axis + 0.06 * axis.cross(DVec3::Y).normalize();
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.5, 0.3, 0.3), 45.0),
        Light {
            near: 0.1,
            far: 100.0,
            ..spot(position, DVec3::ZERO, 60.0, Beam::Circular)
        },
        vec![
            floor(10.0),
            ball(close, 0.03),
            ball(dvec3(-1.2, 0.5, 0.0), 0.5),
            solid("box", dvec3(0.3, 0.0, -0.7), dvec3(1.7, 1.0, 0.7), ORANGE),
        ],
    )
}

fn above(light: Light) -> Scene {
    scene(
        camera(dvec3(0.0, 4.0, 6.5), dvec3(0.0, 0.5, 0.0), 45.0),
        light,
        vec![
            floor(8.0),
            ball(dvec3(-1.2, 1.5, 0.0), 0.7),
            solid("table", dvec3(0.4, 1.0, -0.6), dvec3(1.9, 1.1, 0.6), ORANGE),
        ],
    )
}

fn overhead() -> Scene {
    let position = dvec3(0.0, 7.0, 0.0);
    above(spot(position, DVec3::ZERO, 60.0, Beam::Circular))
}

fn overhead_sun() -> Scene {
    above(sun(DVec3::Y, [-9.0, 9.0, -9.0, 9.0]))
}

/// The light at height 2 looks straight down: what is at height 2 is at w = 0, what is higher is behind it.
fn wide_beam(degrees: f64) -> Scene {
    let light = dvec3(0.0, 2.0, 0.0);
    let sail = [
        dvec3(-1.2, 0.4, 1.4),
        dvec3(-2.4, 0.4, 0.2),
        dvec3(-2.2, 2.0, 1.0),
    ];
    let across = [
        dvec3(1.6, 0.3, -1.8),
        dvec3(3.0, 0.3, -0.8),
        dvec3(2.6, 4.0, -1.6),
    ];
    scene(
        camera(dvec3(-1.0, 6.5, 8.5), dvec3(0.0, 0.6, 0.0), 45.0),
        Light {
            near: 0.1,
            ..spot(light, light - DVec3::Y, degrees, Beam::Circular)
        },
        vec![
            floor(10.0),
            object("sail", soup(&[sail]), DMat4::IDENTITY, ORANGE),
            object("across", soup(&[across]), DMat4::IDENTITY, ORANGE),
            solid("pillar", dvec3(1.5, 0.0, 1.2), dvec3(1.9, 3.5, 1.6), ORANGE),
            solid(
                "behind",
                dvec3(-3.0, 3.2, -2.5),
                dvec3(-1.5, 3.4, -1.0),
                ORANGE,
            ),
            solid(
                "low",
                dvec3(-1.6, 0.0, -1.6),
                dvec3(-1.0, 0.6, -1.0),
                ORANGE,
            ),
        ],
    )
}

/// A house of edge 2 and a light in its middle: walls of four beams each around a window, lid and bottom closed.
fn windows(eye: DVec3, target: DVec3, fovy: f64) -> Scene {
    let middle = dvec3(0.0, 1.2, 0.0);
    let slab = |low: DVec3, high: DVec3| solid("wall", middle + low, middle + high, ORANGE);
    let mut objects = vec![
        floor(14.0),
        slab(dvec3(-1.0, 0.9, -1.0), dvec3(1.0, 1.0, 1.0)),
        slab(dvec3(-1.0, -1.0, -1.0), dvec3(1.0, -0.9, 1.0)),
    ];
    for side in [-1.0, 1.0] {
        for (low, high) in [(0.4, 0.9), (-0.9, -0.4)] {
            // Above and below the windows, along x and along z.
            let beam = |a: DVec3, b: DVec3| slab(a.min(b), a.max(b));
            objects.push(beam(dvec3(-1.0, low, 0.9 * side), dvec3(1.0, high, side)));
            objects.push(beam(dvec3(0.9 * side, low, -0.9), dvec3(side, high, 0.9)));
        }
        for other in [-1.0, 1.0] {
            let post = dvec3(0.6 * side, -0.4, 0.6 * other);
            let outer = dvec3(side, 0.4, other);
            objects.push(slab(post.min(outer), post.max(outer)));
        }
    }
    let light = Light {
        near: 0.1,
        ..point(middle, middle + DVec3::X, 120.0)
    };
    scene(camera(eye, target, fovy), light, objects)
}

/// The caster's walls are 0.1 to 0.5 from the light.
fn inside(near: f64) -> Scene {
    let position = dvec3(2.0, 4.0, -1.0);
    let low = position - dvec3(0.5, 0.1, 0.5);
    let high = position + dvec3(0.1, 0.5, 0.5);
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(0.0, 0.8, 0.0), 45.0),
        Light {
            near,
            ..spot(position, DVec3::ZERO, 90.0, Beam::Circular)
        },
        vec![
            floor(10.0),
            solid("lantern", low, high, ORANGE),
            ball(dvec3(-1.0, 0.7, 0.5), 0.7),
            solid("slab", dvec3(0.5, 0.0, 0.0), dvec3(1.2, 0.5, 1.2), GREY),
        ],
    )
}

fn along_the_normal() -> Scene {
    // Normalised in f32, its product with itself is 1 + 2⁻²³.
    let towards = dvec3(2.0, 2.0, 1.0);
    let turn = DQuat::from_rotation_arc(DVec3::Z, towards.normalize());
    let board = |shift: f64, half: f64| {
        let placement = at(shift * towards.normalize())
            * DMat4::from_quat(turn)
            * DMat4::from_scale(dvec3(half, half, 1.0));
        sheet("board", placement, if shift > 0.0 { ORANGE } else { GREY })
    };
    scene(
        camera(dvec3(-2.0, 5.0, 8.0), DVec3::ZERO, 45.0),
        sun(towards, [-9.0, 9.0, -9.0, 9.0]),
        vec![board(0.0, 5.0), board(1.0, 0.6)],
    )
}
