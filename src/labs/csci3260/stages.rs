//! The slides' stages in pictures.

use crate::labs::{Comparison, Stage};

pub const STAGES: &[Stage] = &[
    Stage {
        name: "default",
        options: "",
        caption: "Using the shadow map: the dolphin's shadow on the sea, with a bias of 0.005.",
    },
    Stage {
        name: "depth-map",
        options: "--show shadow-map",
        caption: "Rendering the shadow map: the scene along the light's direction, in an orthographic box.",
    },
    Stage {
        name: "no-bias",
        options: "--set stage=no_bias",
        caption: "The first result: the global idea is there, but the sea is striped with shadow acne.",
    },
    Stage {
        name: "room-no-bias",
        options: "--set scene=room --set stage=no_bias",
        caption: "Shadow acne on a flat ground: texels that are deeper and texels that are nearer than the ground take turns.",
    },
    Stage {
        name: "room-constant",
        options: "--set scene=room",
        caption: "An error margin of 0.005: no acne, but the wall's shadow begins behind a strip of light.",
    },
    Stage {
        name: "room-small-bias",
        options: "--set scene=room --set bias=0.0004",
        caption: "Irregular surface: a bias that is enough for the ground leaves acne on the sphere and the teapot.",
    },
    Stage {
        name: "room-slope",
        options: "--set scene=room --set stage=slope --set bias=0.0004",
        caption: "The same bias modified according to the slope: acne is left only where the light grazes, beyond the clamp.",
    },
    Stage {
        name: "room-culling",
        options: "--set scene=room --set stage=culling",
        caption: "glCullFace(GL_FRONT): the acne lies on faces that are in the shadow anyway.",
    },
    Stage {
        name: "room-peter-panning",
        options: "--set scene=room --set bias=0.02",
        caption: "Peter Panning: more bias makes it worse, the wall looks as if it were flying.",
    },
    Stage {
        name: "room-thick",
        options: "--set scene=room --set stage=thick",
        caption: "Thin geometry avoided: the thick wall's shadow begins at its foot.",
    },
    Stage {
        name: "room-256",
        options: "--set scene=room --set map_size=256",
        caption: "Aliasing: each texel of a small map is a stair.",
    },
    Stage {
        name: "room-pcf",
        options: "--set scene=room --set stage=pcf",
        caption: "PCF: the mean of five tests.",
    },
];

pub const COMPARISONS: &[Comparison] = &[
    Comparison {
        title: "the dolphin over the sea",
        set: &[],
        sweeps: &[
            &[
                "stage=constant,no_bias,slope,culling,pcf",
                "map_size=512..2048",
            ],
            &["bias=0.0005,0.05"],
            &["shadow_test=offset", "map_size=512..2048"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
    Comparison {
        title: "the room",
        set: &["scene=room"],
        sweeps: &[
            &[
                "stage=constant,no_bias,slope,culling,thick,pcf",
                "map_size=512..2048",
            ],
            &["bias=0.0005,0.05"],
            &["shadow_test=offset", "map_size=512..2048"],
            &["shadow_test=offset", "stage=thick,pcf"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
];
