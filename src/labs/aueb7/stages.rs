//! The handout's exercises in pictures.

use crate::labs::{Comparison, Stage};

pub const STAGES: &[Stage] = &[
    Stage {
        name: "default",
        options: "",
        caption: "Exercise 2: the shadow map as it is handed out, 128 × 128: its texels are projected on the plane.",
    },
    Stage {
        name: "depth-map",
        options: "--show shadow-map",
        caption: "DrawSceneToShadowFBO: the shadow texture, 128 × 128, as the spotlight sees the scene.",
    },
    Stage {
        name: "256",
        options: "--set map_size=256",
        caption: "Exercise 2: 256 × 256.",
    },
    Stage {
        name: "512",
        options: "--set map_size=512",
        caption: "Exercise 2: 512 × 512; the acne on the spheres fades with the texels.",
    },
    Stage {
        name: "1024",
        options: "--set map_size=1024",
        caption: "Exercise 2: 1024 × 1024.",
    },
    Stage {
        name: "pcf-5-128",
        options: "--set filter=pcf_5",
        caption: "Exercise 3: PCF of 5 samples, two texels apart, at 128 × 128: the steps become bands.",
    },
    Stage {
        name: "pcf-9-128",
        options: "--set filter=pcf_9",
        caption: "Exercise 3: PCF of 9 samples at 128 × 128.",
    },
    Stage {
        name: "pcf-5",
        options: "--set filter=pcf_5 --set map_size=512",
        caption: "Exercise 3: PCF of 5 samples at 512 × 512.",
    },
    Stage {
        name: "pcf-9-step-1",
        options: "--set filter=pcf_9 --set map_size=512 --set step=1",
        caption: "Exercise 3: PCF of 9 samples, one texel apart.",
    },
    Stage {
        name: "pcf-9",
        options: "--set filter=pcf_9 --set map_size=512",
        caption: "Exercise 3: PCF of 9 samples, two texels apart.",
    },
    Stage {
        name: "pcf-9-step-4",
        options: "--set filter=pcf_9 --set map_size=512 --set step=4",
        caption: "Exercise 3: four texels apart: softer, and the nine shadows begin to show one by one.",
    },
    Stage {
        name: "bias-0",
        options: "--set constant_depth_bias=0 --set map_size=512",
        caption: "Exercise 3: constant_depth_bias 0: acne wherever the light falls.",
    },
    Stage {
        name: "bias-0.001",
        options: "--set constant_depth_bias=0.001",
        caption: "Exercise 3: constant_depth_bias 0.001: at 128 × 128 the spheres are nearly clean.",
    },
    Stage {
        name: "outside-lit",
        options: "--set outside=lit --set map_size=512",
        caption: "What the shadow map does not cover, lit in place of dark.",
    },
    Stage {
        name: "light-rotated",
        options: "--set rotate_light=on --time 3 --set map_size=512",
        caption: "Exercise 3: the light rotates, and the shadows are recalculated.",
    },
    Stage {
        name: "pirate",
        options: "--set scene=pirate --set filter=pcf_9 --set map_size=1024",
        caption: "SceneGraphExample2Init: the pirate scene, with PCF.",
    },
    Stage {
        name: "pirate-128",
        options: "--set scene=pirate",
        caption: "The pirate scene with the shadow map as it is handed out.",
    },
    Stage {
        name: "knossos",
        options: "--set scene=knossos --set filter=pcf_9 --set map_size=1024",
        caption: "SceneGraphExample3Init: a palace in the manner of Knossos, with PCF.",
    },
    Stage {
        name: "knossos-128",
        options: "--set scene=knossos",
        caption: "The palace with the shadow map as it is handed out.",
    },
    Stage {
        name: "wireframe",
        options: "--keys <F1>",
        caption: "F1: wireframe, in the shadow map too.",
    },
];

pub const COMPARISONS: &[Comparison] = &[
    Comparison {
        title: "the example: two spheres over a plane",
        set: &[],
        sweeps: &[
            &["map_size=128..1024", "filter=none,pcf_5,pcf_9"],
            &["map_size=512", "filter=pcf_9", "step=1,4"],
            &["map_size=512", "constant_depth_bias=0,0.001"],
            &["shadow_test=offset", "map_size=128..1024"],
            &["shadow_test=offset", "map_size=512", "filter=pcf_5,pcf_9"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
    Comparison {
        title: "the pirate scene",
        set: &["scene=pirate"],
        sweeps: &[
            &["map_size=128,512,1024", "filter=none,pcf_9"],
            &["shadow_test=offset", "map_size=128,512,1024"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
    Comparison {
        title: "the palace",
        set: &["scene=knossos"],
        sweeps: &[
            &["map_size=128,512,1024", "filter=none,pcf_9"],
            &["map_size=1024", "constant_depth_bias=0,0.0001"],
            &["shadow_test=offset", "map_size=128,512,1024"],
            &["shadow_test=exact"],
            &["shadows=off"],
        ],
    },
];
