//! What can be set, and which keys move what.

use crate::labs::{Kind, Setting, Settings};
use crate::scene::{LightKind, Scene};
use crate::{Error, Result};

/// Movements of one key press, as in the course.
pub const STEP: f64 = 1.0;
/// Degrees for one pixel of a right drag, as in the course.
pub const TURN_STEP: f64 = 0.1;
/// World units for one pixel of a left drag. It was chosen so that in the course's scenes and window the target keeps up
/// with the pointer, roughly.
pub const TARGET_STEP: f64 = 0.1;
/// The light's turn: the course's 0.4 degrees in each frame of 16 ms.
pub const DEGREES_PER_SECOND: f64 = 25.0;

// DEVIATES: A/S, the handout has it for "camera eye X translation": S already moves along z; the course's program has A and D.
pub const KEYS: &[(&str, &str)] = &[
    ("<F1>", "rendering mode: fill, wireframe, point"),
    ("w s", "camera eye Z translation: away, nearer"),
    ("a d", "camera eye X translation: left, right"),
    ("r f", "camera eye Y translation: up, down"),
    ("<Up> <Down>", "world Z translation: away, nearer"),
    ("<Left> <Right>", "world X translation: left, right"),
    ("<PageUp> <PageDown>", "world Y translation: up, down"),
    ("l", "rotate the light, and leave it at its place"),
    (
        "<Drag:12,-5>",
        "move the camera's target (left button, in pixels)",
    ),
    (
        "<RightDrag:12,-5>",
        "turn the world (right button, in pixels)",
    ),
];

pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "scene",
        kind: Kind::Choice(&["example", "pirate", "knossos"]),
        help: "SceneGraphExampleInit (or the scene of --scene), SceneGraphExample2Init, SceneGraphExample3Init",
    },
    Setting {
        name: "filter",
        kind: Kind::Choice(&["none", "pcf_5", "pcf_9"]),
        help: "shadow_factor in main: is_point_in_shadow, is_point_in_shadow_pcf_5, is_point_in_shadow_pcf_9",
    },
    Setting {
        name: "map_size",
        kind: Kind::Number {
            default: 128.0,
            least: 16.0,
            most: 8192.0,
            whole: true,
        },
        help: "the shadow map resolution; the exercise asks for 256, 512, 1024",
    },
    Setting {
        name: "step",
        kind: Kind::Number {
            default: 2.0,
            least: 0.0,
            most: 64.0,
            whole: false,
        },
        help: "the sample step of PCF, in texels",
    },
    Setting {
        name: "constant_depth_bias",
        kind: Kind::Number {
            default: 0.0005,
            least: 0.0,
            most: 0.1,
            whole: false,
        },
        help: "the constant bias, in depth; the exercise tries 0 to 0.001",
    },
    Setting {
        name: "outside",
        kind: Kind::Choice(&["dark", "lit"]),
        help: "what lies outside of the shadow map: in shadow, as in the course, or lit",
    },
    Setting {
        name: "shadow_test",
        kind: Kind::Choice(&["handout", "offset", "exact"]),
        help: "the exercises' shadow map; one fitted to what casts, drawn with glPolygonOffset and without constant_depth_bias, and with filter's samples one texel apart; or the ray to the light against every triangle that it can meet: no map, no bias, no filter, no resolution",
    },
    Setting {
        name: "rotate_light",
        kind: Kind::Switch { default: false },
        help: "the part of Render that rotates the light, uncommented",
    },
    Setting {
        name: "shadows",
        kind: Kind::Switch { default: true },
        help: "the shadow map; off: shadow_factor is 1 everywhere",
    },
    Setting {
        name: "rotation",
        kind: Kind::Switch { default: true },
        help: "what spins in the scene of --scene spins",
    },
    Setting {
        name: "redraw",
        kind: Kind::Choice(&["when_changed", "every_frame"]),
        help: "the shadow map is drawn when the light or an object has changed, or in every frame as in the course",
    },
];

/// The full angle of the only light's shadow map, in degrees.
pub fn cone(scene: &Scene) -> Result<f64> {
    let [light] = &scene.lights[..] else {
        let found = scene.lights.len();
        return Err(Error::usage(format!(
            "the scene has {found} lights, expected 1: aueb7 has a single spotlight"
        )));
    };
    let (found, other) = match light.kind {
        LightKind::Spot { cone, .. } => return Ok(cone),
        LightKind::Point { .. } => ("point", "cs541"),
        LightKind::Directional { .. } => ("directional", "csci3260"),
    };
    Err(Error::usage(format!(
        "the scene has a {found} light, expected spot: {other} draws a {found} light"
    )))
}

pub fn set_bias(settings: &mut Settings, bias: f64) -> Result<()> {
    settings.set(&format!("constant_depth_bias={bias}"))
}
