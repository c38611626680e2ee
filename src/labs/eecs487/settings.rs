//! What can be set, and Table 1: which keys do what.

use glam::{DVec3, dvec3};

use super::Eecs487;
use super::scene::WALLS;
use crate::labs::{Key, Kind, Setting, Settings};
use crate::{Error, Result};

/// Steps of one key press; degrees for the rotation.
const LIGHT_STEP: f64 = 0.02;
const VIEW_STEP: f64 = 0.1;
const ROTATION_STEP: f64 = 5.0;
const TESSELLATION_STEP: f64 = 8.0;
/// Of the jitter, in thousandths.
const AMOUNT_STEP: f64 = 1.0;

/// How near to a wall the light may be moved. A step of the light is a little off in binary.
const LIGHT_MARGIN: f64 = 0.05 - 1e-9;
/// How far from the room's middle the view may be moved.
const VIEW_RANGE: [f64; 2] = [1.0, 6.0];

/// At the end of a range a key changes nothing.
pub const KEYS: &[(&str, &str)] = &[
    ("q", "quit the application"),
    ("h", "move the light left"),
    ("j", "move the light down"),
    ("k", "move the light up"),
    ("l", "move the light right"),
    ("w", "move the light back"),
    ("s", "move the light forward"),
    ("r", "rotate the torus and the teapot"),
    ("f", "toggle soft/hard shadows"),
    ("-", "decrease the number of light jitters"),
    ("+", "increase the number of light jitters"),
    ("d", "decrease the amount of light jitter"),
    ("a", "increase the amount of light jitter"),
    ("t", "decrease wall tessellation"),
    ("T", "increase wall tessellation"),
    (
        "c",
        "toggle stencil-based clipping of shadows against receiver geometry",
    ),
    ("x", "show/hide the walls and ceiling, cycling through them"),
    (
        "X",
        "show/hide the walls and ceiling, cycling in reverse order",
    ),
    ("W S", "move the view forward, back"),
];

/// The most lights that the fast method has room for; see `mean.vert`.
pub const MOST_JITTERS: usize = 1024;

pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "scene",
        kind: Kind::Choice(&["room", "ramp"]),
        help: "the room, or section 5's quad from red to black, accumulated in eight passes",
    },
    Setting {
        name: "clipped_to",
        kind: Kind::Choice(&["all", "floor", "left", "right", "ceiling", "rear"]),
        help: "the only wall that is shown, or all",
    },
    Setting {
        name: "stencil_clipping",
        kind: Kind::Switch { default: false },
        help: "clip the shadows at each wall's edges with the stencil test",
    },
    Setting {
        name: "soft_shadows",
        kind: Kind::Switch { default: false },
        help: "the average of several renderings, each with the light jittered",
    },
    Setting {
        name: "num_jitters",
        kind: Kind::Number {
            default: 2.0,
            least: 1.0,
            most: MOST_JITTERS as f64,
            whole: true,
        },
        help: "the number of render passes, which is also the number of light jitters",
    },
    Setting {
        name: "jitter_amount",
        kind: Kind::Number {
            default: 0.009,
            least: 0.0,
            most: 1.0,
            whole: false,
        },
        help: "how far the light is jittered along each axis, either way",
    },
    Setting {
        name: "jitter",
        kind: Kind::Choice(&["random", "low-discrepancy"]),
        help: "how the lights fill the cube around the light: by a seeded generator, or evenly",
    },
    Setting {
        name: "first_jitter",
        kind: Kind::Number {
            default: 0.0,
            least: 0.0,
            most: 1e6,
            whole: true,
        },
        help: "the number of the first of these lights; from another one on, they are others",
    },
    Setting {
        name: "soft_method",
        kind: Kind::Choice(&["handout", "fast"]),
        help: "draw everything for each light, or the shadows alone",
    },
    Setting {
        name: "accumulator",
        kind: Kind::Choice(&[
            "RGB32F", "RGBA32F", "RGB16F", "RGBA16F", "RGB8", "RGBA8", "S8",
        ]),
        help: "the accumulation buffer's format; S8: 8 bits with sign, truncating, wrapping; RGB with alpha where a driver must",
    },
    Setting {
        name: "accumulation",
        kind: Kind::Choice(&["weighted", "sum_then_divide"]),
        help: "weigh each render as it is added, or add up the renders and then divide the total",
    },
    Setting {
        name: "tessellation",
        kind: Kind::Number {
            default: 16.0,
            least: 0.0,
            most: 256.0,
            whole: true,
        },
        help: "the number of quads along a wall's edge; 0 leaves no wall",
    },
];

/// There is no depth map, and so no bias.
pub fn set_bias(_: &mut Settings, _: f64) -> Result<()> {
    Err(Error::usage(
        "eecs487 has no bias to set: its shadows are projected onto the walls",
    ))
}

impl Eecs487 {
    /// Whether the lab knows the key.
    pub(super) fn kbd(&mut self, key: Key) -> bool {
        let Key::Char(key) = key else { return false };
        match key {
            // The viewer ends; without a window there is nothing to end.
            'q' => {}
            'h' => self.move_light(dvec3(-LIGHT_STEP, 0.0, 0.0)),
            'l' => self.move_light(dvec3(LIGHT_STEP, 0.0, 0.0)),
            'j' => self.move_light(dvec3(0.0, -LIGHT_STEP, 0.0)),
            'k' => self.move_light(dvec3(0.0, LIGHT_STEP, 0.0)),
            'w' => self.move_light(dvec3(0.0, 0.0, -LIGHT_STEP)),
            's' => self.move_light(dvec3(0.0, 0.0, LIGHT_STEP)),
            'W' => self.move_view(-VIEW_STEP),
            'S' => self.move_view(VIEW_STEP),
            'r' => self.rotation += ROTATION_STEP,
            'f' => self.toggle("soft_shadows"),
            'c' => self.toggle("stencil_clipping"),
            '-' => self.step("num_jitters", -1.0, 1.0),
            '+' => self.step("num_jitters", 1.0, 1.0),
            'd' => self.step("jitter_amount", -AMOUNT_STEP, 1000.0),
            'a' => self.step("jitter_amount", AMOUNT_STEP, 1000.0),
            't' => self.step("tessellation", -TESSELLATION_STEP, 1.0),
            'T' => self.step("tessellation", TESSELLATION_STEP, 1.0),
            'x' => self.cycle(1),
            'X' => self.cycle(WALLS.len()),
            _ => return false,
        }
        true
    }

    /// Refused near a wall, but away from it.
    fn move_light(&mut self, by: DVec3) {
        let light = &mut self.scene.lights[0].position;
        let moved = *light + by;
        let mut distances = self.walls.iter().map(|wall| {
            (
                wall.plane.dot(light.extend(1.0)),
                wall.plane.dot(moved.extend(1.0)),
            )
        });
        if distances.all(|(before, after)| after >= LIGHT_MARGIN || after > before) {
            *light = moved;
        }
    }

    fn move_view(&mut self, by: f64) {
        let [least, most] = VIEW_RANGE;
        let z = &mut self.scene.camera.eye.z;
        // In tenths, so that many steps there and back end where they began.
        *z = (((*z + by) * 10.0).round() / 10.0).clamp(least, most);
    }

    fn toggle(&mut self, switch: &str) {
        let value = if self.settings.switch(switch) {
            "off"
        } else {
            "on"
        };
        self.set(switch, value);
    }

    /// By `step` of `parts`, as far as the setting's range goes.
    fn step(&mut self, name: &str, step: f64, parts: f64) {
        let value = ((self.settings.number(name) * parts).round() + step) / parts;
        // Beyond the range nothing changes.
        let _ = self.settings.set(&format!("{name}={value}"));
    }

    /// Floor, left, right, ceiling, rear, all.
    fn cycle(&mut self, steps: usize) {
        let shown = WALLS
            .iter()
            .position(|name| *name == self.settings.choice("clipped_to"));
        let next = (shown.unwrap_or(WALLS.len()) + steps) % (WALLS.len() + 1);
        self.set("clipped_to", WALLS.get(next).unwrap_or(&"all"));
    }

    fn set(&mut self, name: &str, value: &str) {
        let set = self.settings.set(&format!("{name}={value}"));
        set.expect("a key sets what the table has");
    }
}
