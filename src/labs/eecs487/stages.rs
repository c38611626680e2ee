//! The handout's stages in pictures.

use crate::labs::Stage;

pub const STAGES: &[Stage] = &[
    Stage {
        name: "default",
        options: "",
        caption: "1. Hard shadows: each caster once more, projected onto each wall.",
    },
    Stage {
        name: "floor-unclipped",
        options: "--keys x",
        caption: "2. The floor alone: the shadows extend beyond its edges.",
    },
    Stage {
        name: "floor-clipped",
        options: "--keys xc",
        caption: "The same, clipped with the stencil test.",
    },
    Stage {
        name: "left-clipped",
        options: "--keys cxx",
        caption: "The left wall alone, clipped.",
    },
    Stage {
        name: "tessellation-2",
        options: "--set tessellation=2",
        caption: "Lighting is computed per vertex: too low a tessellation is unintuitive.",
    },
    Stage {
        name: "soft-2",
        options: "--keys f --set jitter_amount=0.05",
        caption: "3. Soft shadows: the average of two renders, the light jittered between them.",
    },
    Stage {
        name: "soft-64",
        options: "--keys f --set num_jitters=64 --set jitter_amount=0.05",
        caption: "The average of 64: where shadows meet the walls softly, the geometry stays crisp.",
    },
    Stage {
        name: "soft-64-low-discrepancy",
        options: "--keys f --set num_jitters=64 --set jitter_amount=0.05 --set jitter=low-discrepancy",
        caption: "64 lights that fill their cube evenly.",
    },
    Stage {
        name: "ramp",
        options: "--set scene=ramp",
        caption: "5. Red from 255 to 0, accumulated in eight passes of 1/8 each: with 32 bits nothing is lost.",
    },
    Stage {
        name: "ramp-s8",
        options: "--set scene=ramp --set accumulator=S8",
        caption: "An accumulation buffer of 8 bits: 16 bands.",
    },
    Stage {
        name: "soft-s8",
        options: "--keys f --set num_jitters=8 --set accumulator=S8",
        caption: "Fig. 2(a): the room in an 8-bit accumulation buffer.",
    },
    Stage {
        name: "soft-s8-sum",
        options: "--keys f --set num_jitters=8 --set accumulator=S8 --set accumulation=sum_then_divide",
        caption: "Fig. 2(b): adding up first overflows into the negative numbers.",
    },
];
