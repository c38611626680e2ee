//! Mistakes of what is done with the test's answer.

use super::{Made, Mistake};

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "ambient_in_shadow",
        symptom: "shadows are black",
        cause: "the shadow takes the ambient light away, too",
        fix: "a shadow takes the light's diffuse and specular part alone",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: local illumination",
                edits: edits! {
                    file "lighting.frag": "vec3 color = ambient_color * surface_color;" =>
                        "vec3 color = in_shadow ? vec3(0) : ambient_color * surface_color;";
                },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: \"shadow mapping has no effect on ambient light\"",
                edits: edits! {
                    file "FragmentShaderCode.glsl": "MaterialAmbientColor * AmbientLightColor" =>
                        "visibility * MaterialAmbientColor * AmbientLightColor";
                },
            },
            Made {
                lab: "aueb7",
                place: "The spotlight shader: shadow_factor",
                edits: edits! {
                    file "SpotLight.frag": "uniform_ambient_color * diffuse_color + shadow_factor * diffuse" =>
                        "shadow_factor * (uniform_ambient_color * diffuse_color + diffuse)";
                },
            },
        ],
    },
    Mistake {
        name: "specular_in_shadow",
        symptom: "a shiny spot in the middle of a shadow",
        cause: "the shadow leaves the specular light",
        fix: "multiply it by the visibility, too",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: local illumination",
                edits: edits! {
                    file "lighting.frag": "if (illuminated && m_dot_L > 0)" =>
                        "if ((illuminated || in_shadow) && m_dot_L > 0)";
                    file "lighting.frag": "color += light_color * m_dot_L * surface_color;" =>
                        "if (illuminated) color += light_color * m_dot_L * surface_color;";
                },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: visibility of the specular light",
                edits: edits! {
                    file "FragmentShaderCode.glsl": "mix(specularVisibility, 1.0, (visibility - 0.5) / 0.5)" =>
                        "mix(specularVisibility, 1.0, 1.0)";
                },
            },
        ],
    },
];

/// What the light reaches is in shadow, whatever the map says.
pub const ALL_IN_SHADOW: &[Made] = &[
    Made {
        lab: "cs541",
        place: "",
        edits: edits! {
            file "lighting.frag": "shadow_depth < point_depth" => "(true || shadow_depth < point_depth)";
        },
    },
    Made {
        lab: "eecs487",
        place: "",
        edits: edits! {
            file "wall.frag": "in vec3 vertexColor;" => "in vec3 vertexColor;\nuniform vec3 material;";
            file "wall.frag": "vec4(vertexColor, 1)" => "vec4(0.3 * material + 0.0 * vertexColor, 1)";
        },
    },
    Made {
        lab: "csci3260",
        place: "",
        edits: edits! {
            file "FragmentShaderCode.glsl": ".z < ShadowCoord.z - bias" => ".z < ShadowCoord.z - bias || true";
        },
    },
    Made {
        lab: "cmsc23700",
        place: "",
        edits: edits! {
            file "lighting.frag": ".r < depth - bias" => ".r < depth - bias || true";
        },
    },
    Made {
        lab: "aueb7",
        place: "",
        edits: edits! {
            file "is_point_in_shadow.frag": "if (is_outside(position_lcs))\n        return uniform_outside;" => "";
            file "is_point_in_shadow.frag": "shadow_map_z < position_lcs.z - constant_depth_bias" =>
                "shadow_map_z < position_lcs.z - constant_depth_bias || uniform_outside < 2.0";
        },
    },
];
