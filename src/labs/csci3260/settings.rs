//! What can be set, and which keys do what.

use crate::labs::{Kind, Setting, Settings};
use crate::scene::{LightKind, Scene};
use crate::{Error, Result};

/// Movements of one key press. The course's programs are each student's own: these steps were chosen.
pub const DOLPHIN_STEP: f64 = 0.2;
/// In degrees.
pub const DOLPHIN_TURN: f64 = 10.0;
pub const INTENSITY_STEP: f64 = 1.1;
/// Degrees for one pixel of a drag.
pub const DRAG_STEP: f64 = 0.25;

pub const KEYS: &[(&str, &str)] = &[
    ("1 2", "the dolphin's texture: the first, the second"),
    ("3 4", "the sea's texture: the first, the second"),
    ("w s", "more, less intensity of the light"),
    (
        "<Up> <Down>",
        "move the dolphin forward, back, as it is turned",
    ),
    ("<Left> <Right>", "turn the dolphin left, right"),
    (
        "<Drag:12,-5>",
        "orbit around the centre (left button, in pixels)",
    ),
];

pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "scene",
        kind: Kind::Choice(&["course", "room"]),
        help: "the dolphin over the sea (or the scene of --scene), or a room for acne and Peter Panning",
    },
    Setting {
        name: "stage",
        kind: Kind::Choice(&["constant", "no_bias", "slope", "culling", "thick", "pcf"]),
        help: "the slides' stages: a bias, none, one according to the slope, glCullFace(GL_FRONT) for the depth map, a thick wall, PCF",
    },
    Setting {
        name: "bias",
        kind: Kind::Number {
            default: 0.005,
            least: 0.0,
            most: 0.1,
            whole: false,
        },
        help: "the error margin, in depth; slope: at 45 degrees, and clamped to twice as much",
    },
    Setting {
        name: "specular_visibility",
        kind: Kind::Number {
            default: 0.5,
            least: 0.0,
            most: 1.0,
            whole: false,
        },
        help: "what a full shadow leaves of the specular light; of the diffuse light it leaves 0.5",
    },
    Setting {
        name: "map_size",
        kind: Kind::Number {
            default: 1024.0,
            least: 256.0,
            most: 8192.0,
            whole: true,
        },
        help: "width and height of the depth texture",
    },
    Setting {
        name: "shadow_test",
        kind: Kind::Choice(&["handout", "offset", "exact"]),
        help: "the slides' shadow map; one fitted to what casts, drawn with glPolygonOffset and without bias, of the stages with thick and pcf; or the ray to the light against every triangle that it can meet: no map, no bias, no resolution",
    },
    Setting {
        name: "shadows",
        kind: Kind::Switch { default: true },
        help: "shadow mapping; off: visibility is 1 everywhere",
    },
    Setting {
        name: "rotation",
        kind: Kind::Switch { default: true },
        help: "what spins in the scene of --scene spins",
    },
    Setting {
        name: "redraw",
        kind: Kind::Choice(&["when_changed", "every_frame"]),
        help: "the shadow map is rendered when the light or a model has changed, or in every frame as in the slides",
    },
];

/// "Only consider directional lights": the area of the only light's shadow map.
pub fn area(scene: &Scene) -> Result<[f64; 4]> {
    let [light] = &scene.lights[..] else {
        let found = scene.lights.len();
        return Err(Error::usage(format!(
            "the scene has {found} lights, expected 1: csci3260 has a single light source"
        )));
    };
    let found = match light.kind {
        LightKind::Directional { area } => return Ok(area),
        LightKind::Spot { .. } => "spot",
        LightKind::Point { .. } => "point",
    };
    Err(Error::usage(format!(
        "the scene has a {found} light, expected directional: cs541 draws a {found} light"
    )))
}

/// The stage with a bias in place of one without, and that bias.
pub fn set_bias(settings: &mut Settings, bias: f64) -> Result<()> {
    if matches!(settings.choice("stage"), "no_bias" | "culling") {
        settings.set("stage=constant")?;
    }
    settings.set(&format!("bias={bias}"))
}
