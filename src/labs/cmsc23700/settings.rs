//! What can be set, and which keys do what.

use super::simulation::MAX_BALLS;
use crate::Result;
use crate::labs::{Kind, Setting, Settings};

pub const KEYS: &[(&str, &str)] = &[
    (
        "l",
        "toggle the lighting: directional, spotlight, both lights",
    ),
    ("+ -", "add a ball to the simulation, remove one"),
    ("s", "enable, disable shadows"),
    ("q", "quit the viewer"),
];

pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "lights",
        kind: Kind::Choice(&["both", "directional", "spotlight"]),
        help: "the lights that are enabled; each has a shadow map of its own",
    },
    Setting {
        name: "shadows",
        kind: Kind::Switch { default: true },
        help: "shadow maps; off: S_l is 1 everywhere",
    },
    Setting {
        name: "balls",
        kind: Kind::Number {
            default: 20.0,
            least: 0.0,
            most: MAX_BALLS as f64,
            whole: true,
        },
        help: "how many balls the simulation has",
    },
    Setting {
        name: "map_size",
        kind: Kind::Number {
            default: 1024.0,
            least: 256.0,
            most: 8192.0,
            whole: true,
        },
        help: "width and height of each shadow map",
    },
    Setting {
        name: "directional_bias",
        kind: Kind::Number {
            default: 0.0035,
            least: 0.0,
            most: 0.1,
            whole: false,
        },
        help: "by how much a depth must be behind the directional light's map to be in shadow",
    },
    Setting {
        name: "spot_bias",
        kind: Kind::Number {
            default: 0.0015,
            least: 0.0,
            most: 0.1,
            whole: false,
        },
        help: "the same for the spotlight, whose depths lie closer together away from it",
    },
    Setting {
        name: "shadow_test",
        kind: Kind::Choice(&["handout", "offset", "exact"]),
        help: "the handout's shadow maps; maps that are fitted to what casts, drawn with glPolygonOffset and without bias; or the ray to each light against every triangle that it can meet: no map, no bias, no resolution",
    },
    Setting {
        name: "redraw",
        kind: Kind::Choice(&["when_changed", "every_frame"]),
        help: "a shadow map is drawn when a ball has moved, or in every frame as in the handout",
    },
];

/// What the key `l` turns each choice into.
pub fn next_lights(lights: &str) -> &'static str {
    match lights {
        "directional" => "spotlight",
        "spotlight" => "both",
        _ => "directional",
    }
}

/// The same bias for each light's map.
pub fn set_bias(settings: &mut Settings, bias: f64) -> Result<()> {
    settings.set(&format!("directional_bias={bias}"))?;
    settings.set(&format!("spot_bias={bias}"))
}
