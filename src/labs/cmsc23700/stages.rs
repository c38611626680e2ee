//! The handout's points in pictures.

use crate::labs::{Comparison, Stage};

pub const STAGES: &[Stage] = &[
    Stage {
        name: "default",
        options: "",
        caption: "Both lights enabled: two shadow maps, and a ball has a shadow from each.",
    },
    Stage {
        name: "directional",
        options: "--set lights=directional",
        caption: "The directional light alone: one shadow map, by an orthographic projection.",
    },
    Stage {
        name: "spotlight",
        options: "--set lights=spotlight",
        caption: "The spotlight alone, above the open top: outside of its cone A_l + D_l is 0, and the global ambient level is left.",
    },
    Stage {
        name: "shadows-off",
        options: "--keys s",
        caption: "Shadows disabled: S_l is 1 everywhere.",
    },
    Stage {
        name: "map-directional",
        options: "--show shadow-map --light 1",
        caption: "The debugging aid: the directional light's map, from −1 black to 1 white.",
    },
    Stage {
        name: "map-spotlight",
        options: "--show shadow-map --light 2",
        caption: "The same of the spotlight: by perspective, most depths are near 1.",
    },
    Stage {
        name: "visibility-directional",
        options: "--show visibility --light 1",
        caption: "S_l of the directional light: black is 0.5, white is 1.",
    },
    Stage {
        name: "visibility-spotlight",
        options: "--show visibility --light 2",
        caption: "S_l of the spotlight, which is not asked outside of its cone.",
    },
    Stage {
        name: "no-bias",
        options: "--set directional_bias=0 --set spot_bias=0",
        caption: "Without a bias, both maps show acne.",
    },
    Stage {
        name: "hundred-balls",
        options: "--set balls=100 --time 10",
        caption: "A hundred balls, the most that + adds, after ten seconds of the simulation.",
    },
    Stage {
        name: "no-balls",
        options: "--set balls=0",
        caption: "The box alone, after - has removed the last ball.",
    },
];

pub const COMPARISONS: &[Comparison] = &[
    Comparison {
        title: "twenty balls, both lights",
        set: &[],
        sweeps: &[
            &["map_size=256..4096"],
            &["directional_bias=0", "spot_bias=0"],
            &["directional_bias=0.01", "spot_bias=0.01"],
            &["shadow_test=offset", "map_size=256..4096"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
    Comparison {
        title: "a hundred balls",
        set: &["balls=100"],
        sweeps: &[
            &["map_size=512..2048"],
            &["shadow_test=offset", "map_size=512..2048"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
];
