//! Mistakes of the comparison of two depths, and of its bias.

use super::values::{too_much, zero};
use super::{Made, Mistake};

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "no_bias",
        symptom: "stripes or dots all over what is lit",
        cause: "a surface is compared with its own depth, which the map holds only once for each texel",
        fix: "move the point towards the light by a small bias before the comparison",
        made: &[
            Made {
                lab: "cs541",
                place: "Shadow acne: \"point_depth - epsilon\"",
                edits: edits! {
                    uniform "epsilon" in "": zero;
                },
            },
            Made {
                lab: "csci3260",
                place: "Shadow acne: \"ShadowCoord.z - bias\"",
                edits: edits! {
                    uniform "biasValue" in "": zero;
                },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the bias of each light's test",
                edits: edits! {
                    uniform "directionalBias" in "": zero;
                    uniform "spotBias" in "": zero;
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: constant_depth_bias",
                edits: edits! {
                    uniform "constant_depth_bias" in "": zero;
                },
            },
        ],
    },
    Mistake {
        name: "too_much_bias",
        symptom: "shadows begin a way behind what casts them, and light leaks in at the contact",
        cause: "the bias is many times larger than the map's texels ask for",
        fix: "take the least bias without acne; shadowlab measure tells it",
        made: &[
            Made {
                lab: "cs541",
                place: "Shadow acne: \"point_depth - epsilon\"",
                edits: edits! {
                    uniform "epsilon" in "": too_much;
                },
            },
            Made {
                lab: "csci3260",
                place: "Peter Panning",
                edits: edits! {
                    uniform "biasValue" in "": too_much;
                },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the bias of each light's test",
                edits: edits! {
                    uniform "directionalBias" in "": too_much;
                    uniform "spotBias" in "": too_much;
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: constant_depth_bias",
                edits: edits! {
                    uniform "constant_depth_bias" in "": too_much;
                },
            },
        ],
    },
    Mistake {
        name: "bias_on_xyz",
        symptom: "shadows are shifted sideways on top of the bias",
        cause: "the bias is subtracted from the whole vector, and not from its depth alone",
        fix: "subtract it from z",
        made: &[
            Made {
                lab: "cs541",
                place: "Shadow acne: \"point_depth - epsilon\"",
                edits: edits! {
                    file "lighting.frag": "texture(shadow_sampler,uv)" => "texture(shadow_sampler,uv - epsilon)";
                    file "visibility.frag": "texture(shadow_sampler,uv)" => "texture(shadow_sampler,uv - epsilon)";
                },
            },
            Made {
                lab: "csci3260",
                place: "Shadow acne: \"ShadowCoord.z - bias\"",
                edits: edits! {
                    file "FragmentShaderCode.glsl": "texture(shadowMap, ShadowCoord.xy" => "texture(shadowMap, ShadowCoord.xy - bias";
                    file "visibility.frag": "texture(shadowMap, ShadowCoord.xy" => "texture(shadowMap, ShadowCoord.xy - bias";
                },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the bias of each light's test",
                edits: edits! {
                    file "lighting.frag": "texture(shadowMap, place.xy)" => "texture(shadowMap, place.xy - bias)";
                    file "visibility.frag": "texture(shadowMap, place.xy)" => "texture(shadowMap, place.xy - bias)";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: constant_depth_bias",
                edits: edits! {
                    file "is_point_in_shadow.frag": "texture(uniform_sampler_shadow_map, position_lcs.xy)" =>
                        "texture(uniform_sampler_shadow_map, position_lcs.xy - constant_depth_bias)";
                },
            },
        ],
    },
    Mistake {
        name: "comparison_reversed",
        symptom: "what is lit is dark, and what is in shadow is lit",
        cause: "the point counts as shadowed where the map's surface is the farther one",
        fix: "in shadow is what is farther from the light than the map's surface",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: \"shadow_depth < point_depth\"; the section on acne prints it the other way round",
                edits: edits! {
                    file "lighting.frag": "shadow_depth < point_depth" => "shadow_depth > point_depth";
                    file "visibility.frag": "shadow_depth < point_depth" => "shadow_depth > point_depth";
                },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: \"texture(shadowMap, ShadowCoord.xy).z < ShadowCoord.z\"",
                edits: edits! {
                    file "FragmentShaderCode.glsl": ".z < ShadowCoord.z - bias" => ".z > ShadowCoord.z - bias";
                    file "visibility.frag": ".z < ShadowCoord.z - bias" => ".z > ShadowCoord.z - bias";
                },
            },
            Made {
                lab: "cmsc23700",
                place: "Second pass: S_l",
                edits: edits! {
                    file "lighting.frag": ".r < depth - bias" => ".r > depth - bias";
                    file "visibility.frag": ".r < depth - bias" => ".r > depth - bias";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow",
                edits: edits! {
                    file "is_point_in_shadow.frag": "shadow_map_z < position_lcs.z" => "shadow_map_z > position_lcs.z";
                },
            },
        ],
    },
];
