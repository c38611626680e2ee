//! The handout, section by section, in pictures; and its remedies, side by side in figures.

use crate::labs::{Comparison, Stage};

pub const STAGES: &[Stage] = &[
    Stage {
        name: "default",
        options: "",
        caption: "The two passes together: a spot light, its shadows, a textured floor and a rotating object.",
    },
    Stage {
        name: "shadows-off",
        options: "--set shadows=off",
        caption: "Local illumination alone, where the assignment begins: nothing stands on the floor.",
    },
    Stage {
        name: "depth-map",
        options: "--show shadow-map",
        caption: "Storing depth values as a texture: the distance from the light, near black, far white.",
    },
    Stage {
        name: "from-light",
        options: "--keys x",
        caption: "The camera of the first pass: seen from the light, no shadow is visible.",
    },
    Stage {
        name: "visibility",
        options: "--show visibility",
        caption: "The test of the second pass alone: white where no depth in the map is nearer to the light.",
    },
    Stage {
        name: "point",
        options: "--set light=point",
        caption: "A point light: the map needs a larger field of view, and what it does not cover is lit.",
    },
    Stage {
        name: "circular",
        options: "--set beam=circular",
        caption: "A spot light with a circular beam.",
    },
    Stage {
        name: "acne",
        options: "--set remedy=none --set filter=nearest",
        caption: "Shadow acne: without a remedy a lit surface shadows itself, texel by texel.",
    },
    Stage {
        name: "epsilon-large",
        options: "--set epsilon=0.01",
        caption: "Too large an epsilon: point_depth is pushed so far towards the light that shadows leave their casters.",
    },
    Stage {
        name: "culling",
        options: "--set remedy=culling",
        caption: "Front face culling in the first pass: solids keep their shadows, the painting, a Plane, loses its own.",
    },
    Stage {
        name: "second-plane",
        options: "--set remedy=culling --set second_plane=on",
        caption: "A second copy of each Plane, offset and the other way round: the painting's shadow is back.",
    },
    Stage {
        name: "map-256",
        options: "--set map_size=256",
        caption: "A smaller depth texture: the shadows' edges show its texels.",
    },
];

pub const COMPARISONS: &[Comparison] = &[
    Comparison {
        title: "a spot light",
        set: &[],
        sweeps: &[
            &["remedy=epsilon,none,culling,both", "map_size=256..2048"],
            &["map_size=4096"],
            &["remedy=culling", "second_plane=on"],
            &["epsilon=0.0001,0.01"],
            &["filter=nearest"],
            &["depth_format=16,32F"],
            &["shadow_test=offset", "map_size=256..2048"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
    Comparison {
        title: "a point light",
        set: &["light=point"],
        sweeps: &[
            &["remedy=epsilon,culling", "map_size=512..2048"],
            &["shadow_test=offset", "map_size=512..2048"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
];
