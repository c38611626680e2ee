//! What can be set, and which keys move what.

use crate::labs::{Kind, Setting, Settings};
use crate::scene::{Beam, LightKind, Scene};
use crate::{Error, Result};

/// Movements of one key press. The course's programs are each student's own: these steps were chosen.
pub const EYE_STEP: f64 = 0.25;
pub const LIGHT_STEP: f64 = 0.25;
pub const FOV_STEP: f64 = 2.0;
/// Degrees for one pixel of a drag.
pub const DRAG_STEP: f64 = 0.25;

pub const KEYS: &[(&str, &str)] = &[
    ("w s a d", "move the eye forward, back, left, right"),
    ("q e", "move the eye up, down"),
    ("<Left> <Right>", "move the light left, right (along x)"),
    ("<Up> <Down>", "move the light away, nearer (along z)"),
    ("<PageUp> <PageDown>", "move the light up, down (along y)"),
    ("o p", "narrow, widen the field of view"),
    ("x", "look from the light, and back"),
    ("<Tab>", "put the light at the eye, pointing as it looks"),
    ("<Drag:12,-5>", "turn the look (left button, in pixels)"),
    ("<Wheel:1> <Wheel:-1>", "narrow, widen the field of view"),
];

pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "light",
        kind: Kind::Choice(&["spot", "point"]),
        help: "the light source: a spot light (direction and beam size) or a point light source",
    },
    Setting {
        name: "beam",
        kind: Kind::Choice(&["rectangular", "circular"]),
        help: "the spot light's beam",
    },
    Setting {
        name: "spot_angle",
        kind: Kind::Number {
            default: 60.0,
            least: 1.0,
            most: 179.0,
            whole: false,
        },
        help: "the spot light's full beam angle, and its shadow map's field of view, in degrees",
    },
    Setting {
        name: "shadow_fov",
        kind: Kind::Number {
            default: 120.0,
            least: 1.0,
            most: 179.0,
            whole: false,
        },
        help: "the point light's shadow map's field-of-view angle, larger than a spot's, in degrees",
    },
    Setting {
        name: "map_size",
        kind: Kind::Number {
            default: 1024.0,
            least: 256.0,
            most: 8192.0,
            whole: true,
        },
        help: "width and height of the depth buffer texture",
    },
    Setting {
        name: "depth_format",
        kind: Kind::Choice(&["handout", "16", "24", "32F"]),
        help: "what the texture stores: the handout's GL_DEPTH_COMPONENT (the driver chooses), or GL_DEPTH_COMPONENT16, 24, 32F",
    },
    Setting {
        name: "filter",
        kind: Kind::Choice(&["linear", "nearest"]),
        help: "the depth texture's GL_TEXTURE_MIN_FILTER and GL_TEXTURE_MAG_FILTER",
    },
    Setting {
        name: "remedy",
        kind: Kind::Choice(&["epsilon", "none", "culling", "both"]),
        help: "against shadow acne: push the fragment towards the light by epsilon, front face culling in the first pass, both, none",
    },
    Setting {
        name: "epsilon",
        kind: Kind::Number {
            default: 0.001,
            least: 0.0,
            most: 0.1,
            whole: false,
        },
        help: "the small value by which point_depth is decreased",
    },
    Setting {
        name: "second_plane",
        kind: Kind::Switch { default: false },
        help: "first pass: a second copy of each Plane, a small amount behind it and with the opposite orientation",
    },
    Setting {
        name: "shadow_test",
        kind: Kind::Choice(&["handout", "offset", "exact"]),
        help: "the handout's shadow map; one fitted to the casters, drawn with glPolygonOffset and without remedy, epsilon, second_plane; or the ray to the light against every triangle that it can meet: no map, no bias, no resolution",
    },
    Setting {
        name: "shadows",
        kind: Kind::Switch { default: true },
        help: "the two-pass shadow map; off: local illumination alone",
    },
    Setting {
        name: "rotation",
        kind: Kind::Switch { default: true },
        help: "the rotating object rotates",
    },
    Setting {
        name: "redraw",
        kind: Kind::Choice(&["when_changed", "every_frame"]),
        help: "the first pass is drawn when the light or a caster has changed, or in every frame as in the course",
    },
];

/// The scene's light decides where the settings start.
pub fn take_light(scene: &Scene, settings: &mut Settings) -> Result<()> {
    let [light] = &scene.lights[..] else {
        let found = scene.lights.len();
        return Err(Error::usage(format!(
            "the scene has {found} lights, expected 1: cs541 has a single light source"
        )));
    };
    match light.kind {
        LightKind::Spot { cone, beam } => {
            let beam = match beam {
                Beam::Rectangular => "rectangular",
                Beam::Circular => "circular",
            };
            settings.set("light=spot")?;
            settings.set(&format!("beam={beam}"))?;
            settings.set(&format!("spot_angle={cone}"))
        }
        LightKind::Point { shadow_fov } => {
            settings.set("light=point")?;
            settings.set(&format!("shadow_fov={shadow_fov}"))
        }
        LightKind::Directional { .. } => Err(Error::usage(
            "the scene has a directional light, expected spot or point: csci3260 draws a directional one",
        )),
    }
}

/// The remedy with epsilon in place of the one without, and that epsilon.
pub fn set_bias(settings: &mut Settings, bias: f64) -> Result<()> {
    match settings.choice("remedy") {
        "none" => settings.set("remedy=epsilon")?,
        "culling" => settings.set("remedy=both")?,
        _ => (),
    }
    settings.set(&format!("epsilon={bias}"))
}
