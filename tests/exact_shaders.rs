//! The shaders with the exact shadow test are the handouts' own but for the test; and the test alone is that of the
//! lighting.

/// What every shader that asks a light buffer declares, as `exact.frag` does.
const LIGHT_BUFFER: &str = "\
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
";

/// Two files, and the words that only lines of the shadow test have.
struct Pair {
    handouts: &'static str,
    exact: &'static str,
    words: &'static [&'static str],
    /// An edit of the lighting, which must be noticed.
    edit: (&'static str, &'static str),
}

const PAIRS: &[Pair] = &[
    Pair {
        handouts: "cs541/lighting.frag",
        exact: "cs541/lighting_exact.frag",
        words: &[
            "shadow_",
            "in_shadow =",
            "bool shadows",
            "position_lcs",
            "normal_lcs",
            "light_buffer",
            "epsilon",
            "point_depth",
            "uv.",
            "inside_beam =",
            "if (beam == CIRCULAR)",
            "light_vector) > 0",
        ],
        edit: ("normalize(", "("),
    },
    Pair {
        handouts: "cs541/lighting.vert",
        exact: "cs541/lighting_lcs.vert",
        words: &[
            "shadow_",
            "position_lcs",
            "light_model_matrix",
            "mat4 B",
            "0.5",
            "vshadow_position",
        ],
        edit: ("eye_position - world", "world"),
    },
    Pair {
        handouts: "csci3260/FragmentShaderCode.glsl",
        exact: "csci3260/FragmentShaderCode_exact.glsl",
        words: &[
            "shadowMap",
            "bool shadows",
            "!shadows",
            "in_shadow",
            "stage",
            "NO_BIAS",
            "bias",
            "biasValue",
            "taps",
            "texel",
            "float visibility =",
            "visibility = ",
            "visibility -= ",
            "normal_lcs",
            "light_buffer",
            "cosTheta",
            "for (int i",
            "dot(n, l) > 0",
            "}",
        ],
        edit: ("normalize(", "("),
    },
    Pair {
        handouts: "cmsc23700/lighting.frag",
        exact: "cmsc23700/lighting_exact.frag",
        words: &[
            "Coord;",
            "Map;",
            "Bias;",
            "bool shadows",
            "!shadows",
            "return",
            "float S",
            "place",
            "Normal = cross",
            "Buffer;",
            "in_shadow",
        ],
        edit: ("normalize(", "("),
    },
    Pair {
        handouts: "cmsc23700/lighting.vert",
        exact: "cmsc23700/lighting_lcs.vert",
        words: &["Coord", "TextureMatrix", "ModelMatrix", "instance"],
        edit: ("normalMatrix * ", ""),
    },
    Pair {
        handouts: "aueb7/SpotLight.frag",
        exact: "aueb7/SpotLight_exact.frag",
        words: &[
            "uniform_shadows",
            "uniform_filter",
            "to_light_space",
            "PCF",
            "position_lcs",
            "shadow_factor =",
            "inside_beam",
            "uniform_outside",
            "normal_lcs",
            "light_buffer",
            "else",
            "}",
        ],
        edit: ("normalize(", "("),
    },
    Pair {
        handouts: "aueb7/SpotLight.vert",
        exact: "aueb7/SpotLight_lcs.vert",
        words: &["light_m", "position_lcs"],
        edit: ("uniform_normal_matrix_ecs * ", ""),
    },
];

fn read(path: &str) -> String {
    std::fs::read_to_string(format!("glsl/{path}")).unwrap()
}

/// The lines of a shader that are no comments.
fn lines(text: &str) -> Vec<String> {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap().trim());
    lines
        .filter(|line| !line.is_empty())
        .map(str::to_owned)
        .collect()
}

/// The lines without those of the shadow test, which have one of these words.
fn without(text: &str, words: &[&str]) -> Vec<String> {
    let is_of_the_test = |line: &String| words.iter().any(|word| line.contains(word));
    let mut lines = lines(&text.replace(LIGHT_BUFFER, ""));
    lines.retain(|line| !is_of_the_test(line));
    lines
}

#[test]
fn the_shaders_differ_from_the_handouts_in_the_test_alone() {
    for Pair {
        handouts,
        exact,
        words,
        edit: (from, to),
    } in PAIRS
    {
        let (handouts, text) = (read(handouts), read(exact));
        assert_ne!(lines(&handouts), lines(&text), "{exact}");
        assert_eq!(without(&handouts, words), without(&text, words), "{exact}");
        assert!(without(&text, words).len() > 15, "{exact}");
        // The control: a line of the lighting, edited.
        let edited = text.replace(from, to);
        assert_ne!(text, edited, "{exact}");
        assert_ne!(
            without(&handouts, words),
            without(&edited, words),
            "{exact}"
        );
    }
}

/// What the visibility asks is what the lighting asks, but for the surfaces that are dark anyway.
#[test]
fn the_test_alone_is_the_test_of_the_lighting() {
    for (lighting, visibility, words, dark) in [
        (
            "cs541/lighting_exact.frag",
            "cs541/visibility_exact.frag",
            &["inside_beam =", "in_shadow_of", "normal_lcs"][..],
            " && dot(normal_vector, light_vector) > 0",
        ),
        (
            "csci3260/FragmentShaderCode_exact.glsl",
            "csci3260/visibility_exact.frag",
            &[
                "in_shadow_of",
                "normal_lcs",
                "float visibility =",
                "visibility = 0.5",
            ],
            "",
        ),
        (
            "cmsc23700/lighting_exact.frag",
            "cmsc23700/visibility_exact.frag",
            &[
                "Normal = cross",
                "in_shadow",
                "float spotDot",
                "if (spotDot",
            ],
            "",
        ),
        (
            "aueb7/SpotLight_exact.frag",
            "aueb7/visibility_exact.frag",
            &["inside_beam", "position_lcs", "shadow_factor ="],
            "n_dot_l > 0.0 && ",
        ),
    ] {
        let asked = |path: &str| {
            let text = read(path);
            assert!(text.contains(LIGHT_BUFFER), "{path}");
            let mut lines = lines(&text.replace(dark, ""));
            lines.retain(|line| words.iter().any(|word| line.contains(word)));
            // How a line begins is another thing in each.
            let lines = lines.into_iter().map(|line| {
                let begun = ["float S_l = ", "S_l = ", "vec3 L = ", "float spotDot = "];
                let rest = begun.iter().find_map(|begun| line.strip_prefix(begun));
                rest.unwrap_or(&line).trim_end_matches(" {").to_owned()
            });
            lines.collect::<Vec<_>>()
        };
        assert!(asked(lighting).len() >= 3, "{lighting}");
        assert_eq!(asked(lighting), asked(visibility), "{lighting}");
    }
}
