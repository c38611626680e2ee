//! Mistakes of the way from a point to its texel.

use super::values::{
    bias_matrix_swapped, bias_matrix_twice, never, transposed, without_bias_matrix,
};
use super::{Made, Mistake};
use crate::gl::edits::Make;

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "no_division_by_w",
        symptom: "shadows slide and stretch with the distance from the light",
        cause: "a perspective light's coordinates are used before they are divided by w",
        fix: "divide by w, or use textureProj",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: \"vshadow_position.xy/vshadow_position.w\"",
                edits: edits! {
                    file "lighting.frag": "vshadow_position.xy/vshadow_position.w" => "vshadow_position.xy";
                    file "lighting.frag": "vshadow_position.z/vshadow_position.w" => "vshadow_position.z";
                    file "visibility.frag": "vshadow_position.xy/vshadow_position.w" => "vshadow_position.xy";
                    file "visibility.frag": "vshadow_position.z/vshadow_position.w" => "vshadow_position.z";
                },
            },
            Made {
                lab: "cmsc23700",
                place: "Second pass: texture coordinates for each light",
                edits: edits! {
                    file "lighting.frag": "coord.xyz / coord.w" => "coord.xyz";
                    file "visibility.frag": "coord.xyz / coord.w" => "coord.xyz";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: position_lcs",
                edits: edits! {
                    file "is_point_in_shadow.frag": "position_lcs.xyz / position_lcs.w" => "position_lcs.xyz";
                },
            },
        ],
    },
    Mistake {
        name: "bias_matrix_missing",
        symptom: "the shadow lies elsewhere, four times as large; most of the scene is compared with the map's border",
        cause: "the light's coordinates run from -1 to 1, and the map's from 0 to 1",
        fix: "scale by 1/2, then move by 1/2",
        made: &[
            Made {
                lab: "cs541",
                place: "equation (1): the matrix B",
                edits: edits! { file "lighting.vert": "B * (shadow" => "(shadow"; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: biasMatrix",
                edits: edits! { uniform "DepthBiasMVP" in "": without_bias_matrix; },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the texture matrix",
                edits: edits! {
                    uniform "directionalTextureMatrix" in "": without_bias_matrix;
                    uniform "spotTextureMatrix" in "": without_bias_matrix;
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: position_lcs",
                edits: edits! {
                    file "is_point_in_shadow.frag": "0.5 * (position_lcs.xyz / position_lcs.w) + 0.5" =>
                        "position_lcs.xyz / position_lcs.w";
                },
            },
        ],
    },
    Mistake {
        name: "bias_matrix_twice",
        symptom: "the shadow is half as large, and in a corner of its place",
        cause: "the light's coordinates are brought to 0…1 once in the program and once more in the shader",
        fix: "do it once",
        made: &[
            Made {
                lab: "cs541",
                place: "equation (1): the matrix B",
                edits: edits! { file "lighting.vert": "B * (shadow" => "B * B * (shadow"; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: biasMatrix",
                edits: edits! { uniform "DepthBiasMVP" in "": bias_matrix_twice; },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the texture matrix",
                edits: edits! {
                    uniform "directionalTextureMatrix" in "": bias_matrix_twice;
                    uniform "spotTextureMatrix" in "": bias_matrix_twice;
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: position_lcs",
                edits: edits! {
                    file "is_point_in_shadow.frag": "0.5 * (position_lcs.xyz / position_lcs.w) + 0.5" =>
                        "0.5 * (0.5 * (position_lcs.xyz / position_lcs.w) + 0.5) + 0.5";
                },
            },
        ],
    },
    Mistake {
        name: "bias_matrix_swapped",
        symptom: "all shadows are shifted by a quarter of the map",
        cause: "the bias matrix is built as H(1/2)·T(1/2), which moves by a quarter",
        fix: "build it as T(1/2)·H(1/2): scale first, then move",
        made: &[
            Made {
                lab: "cs541",
                place: "equation (1): the matrix B",
                edits: edits! {
                    file "lighting.vert": "0.5, 0.5, 0.5, 1.0);" => "0.25, 0.25, 0.25, 1.0);";
                },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: biasMatrix",
                edits: edits! { uniform "DepthBiasMVP" in "": bias_matrix_swapped; },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the texture matrix",
                edits: edits! {
                    uniform "directionalTextureMatrix" in "": bias_matrix_swapped;
                    uniform "spotTextureMatrix" in "": bias_matrix_swapped;
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: position_lcs",
                edits: edits! {
                    file "is_point_in_shadow.frag": "0.5 * (position_lcs.xyz / position_lcs.w) + 0.5" =>
                        "0.5 * (position_lcs.xyz / position_lcs.w + 0.5)";
                },
            },
        ],
    },
    Mistake {
        name: "no_w_test",
        symptom: "behind the light there is a second, mirrored beam",
        cause: "behind the light w is negative, and the division makes a point in front of it",
        fix: "ask for w > 0 before the division",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: what is inside of the beam",
                edits: edits! {
                    file "lighting.frag": "vshadow_position.w > 0" => "true";
                    file "visibility.frag": "vshadow_position.w > 0" => "true";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: outside of the map",
                edits: edits! {
                    file "is_point_in_shadow.frag": "position_lcs.w <= 0.0\n        || any" => "any";
                },
            },
        ],
    },
    Mistake {
        name: "outside_wrong",
        symptom: "a hard rectangle around the scene, lit where it should be dark or dark where it should be lit",
        cause: "what lies outside of the map gets the wrong answer",
        fix: "say which answer it gets, as the handout does",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: a spot light lights what is inside of its beam, a point light everything",
                edits: edits! {
                    file "lighting.frag": "(inside_beam || beam == NO_BEAM)" => "(inside_beam || beam != NO_BEAM)";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: outside of the map",
                edits: edits! { uniform "uniform_outside" in "": super::values::other; },
            },
        ],
    },
    Mistake {
        name: "repeat_outside",
        symptom: "phantom shadows, as in a row of tiles, or streaks",
        cause: "the texture repeats (GL_REPEAT is the default), and nobody asks whether a point lies on the map",
        fix: "GL_CLAMP_TO_EDGE or GL_CLAMP_TO_BORDER, and ask",
        made: &[
            Made {
                lab: "cs541",
                place: "Storing depth values as a texture",
                edits: edits! {
                    file "lighting.frag": "&& 0 <= uv.x && uv.x <= 1 && 0 <= uv.y && uv.y <= 1" => "";
                    file "visibility.frag": "&& 0 <= uv.x && uv.x <= 1 && 0 <= uv.y && uv.y <= 1" => "";
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_S] in "storing depth values": Make::Nothing;
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_T] in "storing depth values": Make::Nothing;
                },
            },
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: the render target",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_S] in "render target": Make::Nothing;
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_T] in "render target": Make::Nothing;
                },
            },
            Made {
                lab: "cmsc23700",
                place: "First pass: a depth texture for each light",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_S] in "shadow map": Make::Nothing;
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_T] in "shadow map": Make::Nothing;
                },
            },
            Made {
                lab: "aueb7",
                place: "CreateShadowFBO",
                edits: edits! {
                    file "is_point_in_shadow.frag":
                        "any(lessThan(position_lcs.xyz, vec3(0.0))) || any(greaterThan(position_lcs.xyz, vec3(1.0)))" =>
                        "position_lcs.z < 0.0 || position_lcs.z > 1.0";
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_S] in "CreateShadowFBO": Make::Nothing;
                    call "glTexParameteri" [1: glow::TEXTURE_WRAP_T] in "CreateShadowFBO": Make::Nothing;
                },
            },
        ],
    },
    Mistake {
        name: "beyond_far",
        symptom: "far from the light everything is dark",
        cause: "beyond the light's far plane a depth is above 1, and no depth of the map is",
        fix: "count what lies beyond the far plane as lit, or clamp its depth to 1",
        made: &[
            Made {
                lab: "cmsc23700",
                place: "Second pass: S_l",
                edits: edits! {
                    file "lighting.frag": "min(place.z, 1.0)" => "place.z";
                    file "visibility.frag": "min(place.z, 1.0)" => "place.z";
                },
            },
            Made {
                lab: "aueb7",
                place: "is_point_in_shadow: outside of the map",
                edits: edits! {
                    file "is_point_in_shadow.frag": "any(greaterThan(position_lcs.xyz, vec3(1.0)))" =>
                        "any(greaterThan(position_lcs.xy, vec2(1.0)))";
                },
            },
        ],
    },
    Mistake {
        name: "row_major",
        symptom: "shadows are sheared out of place, or gone",
        cause: "the light's matrix is uploaded row by row",
        fix: "GLSL takes matrices column by column: transpose it, or say GL_TRUE",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: the light's matrices",
                edits: edits! { uniform "shadow_view_matrix" in "": transposed; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: DepthBiasMVP",
                edits: edits! { uniform "DepthBiasMVP" in "": transposed; },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the texture matrix",
                edits: edits! {
                    uniform "directionalTextureMatrix" in "": transposed;
                    uniform "spotTextureMatrix" in "": transposed;
                },
            },
            Made {
                lab: "aueb7",
                place: "The spotlight shader: uniform_light_view_projection",
                edits: edits! { uniform "uniform_light_view_projection" in "": transposed; },
            },
        ],
    },
    Mistake {
        name: "misspelt_uniform",
        symptom: "no shadow, or everything in shadow: the light's matrix is all zeros",
        cause: "glGetUniformLocation returns -1 for a name that the shader does not have, and glUniform ignores that",
        fix: "print what glGetUniformLocation returns, and compare the spelling",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: the light's matrices",
                edits: edits! { uniform "shadow_view_matrix" in "": never; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: DepthBiasMVP",
                edits: edits! { uniform "DepthBiasMVP" in "": never; },
            },
            Made {
                lab: "cmsc23700",
                place: "Hints: the texture matrix",
                edits: edits! {
                    uniform "directionalTextureMatrix" in "": never;
                    uniform "spotTextureMatrix" in "": never;
                },
            },
            Made {
                lab: "aueb7",
                place: "The spotlight shader: uniform_light_view_projection",
                edits: edits! { uniform "uniform_light_view_projection" in "": never; },
            },
        ],
    },
];
