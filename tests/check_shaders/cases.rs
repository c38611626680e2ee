//! The deliberately wrong shaders, and what must be told of each.

/// A shader of the lab, in which each passage stands for another one.
pub struct Edited {
    pub file: &'static str,
    passages: &'static [(&'static str, &'static str)],
}

impl Edited {
    pub fn text(&self, lab: &str) -> String {
        let text = std::fs::read_to_string(format!("glsl/{lab}/{}", self.file)).unwrap();
        self.passages.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{} has no \"{from}\"", self.file);
            text.replace(from, to)
        })
    }
}

/// One thing that is wrong.
pub struct Case {
    pub name: &'static str,
    pub lab: &'static str,
    pub files: &'static [Edited],
    /// The file, and a passage of the line that is to be named; "" where no line is.
    pub at: (&'static str, &'static str),
    /// What must be told of it.
    pub words: &'static [&'static str],
}

pub const fn one(file: &'static str, passages: &'static [(&'static str, &'static str)]) -> Edited {
    Edited { file, passages }
}

pub const CASES: &[Case] = &[
    Case {
        name: "a misspelt sampler, two on one unit",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[("shadow_sampler", "shadow_sampeler")],
        )],
        at: ("lighting.frag", "uniform sampler2D shadow_sampeler"),
        words: &[
            "sets none of that name",
            "texture unit 0, together with usampler",
            "did you mean \"shadow_sampler\"?",
        ],
    },
    Case {
        name: "a misspelt matrix",
        lab: "cs541",
        files: &[one("shadow.vert", &[("model_matrix", "modelMatrix")])],
        at: ("shadow.vert", "uniform mat4 modelMatrix"),
        words: &[
            "mat4 modelMatrix",
            "it stays 0",
            "did you mean \"model_matrix\"?",
        ],
    },
    Case {
        name: "a uniform of one's own that nobody sets",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[
                (
                    "uniform mat4 shadow_persp_matrix;\nuniform mat4 shadow_view_matrix;",
                    "uniform mat4 to_map;",
                ),
                (
                    "shadow_persp_matrix * (shadow_view_matrix * world_position)",
                    "to_map * world_position",
                ),
            ],
        )],
        at: ("lighting.vert", "uniform mat4 to_map"),
        words: &[
            "mat4 to_map",
            "expected its mat4 shadow_persp_matrix or shadow_view_matrix",
        ],
    },
    Case {
        name: "a matrix of another size",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[
                ("uniform mat3 normal_matrix", "uniform mat4 normal_matrix"),
                ("normal_matrix * normal", "mat3(normal_matrix) * normal"),
            ],
        )],
        at: ("lighting.vert", "uniform mat4 normal_matrix"),
        words: &["mat4 normal_matrix, expected mat3", "GL refuses"],
    },
    Case {
        name: "a vec4 where the lab sends a vec3",
        lab: "csci3260",
        files: &[one(
            "FragmentShaderCode.glsl",
            &[
                ("uniform vec3 lightInvDir", "uniform vec4 lightInvDir"),
                ("vec3 l = lightInvDir", "vec3 l = lightInvDir.xyz"),
            ],
        )],
        at: ("FragmentShaderCode.glsl", "uniform vec4 lightInvDir"),
        words: &["vec4 lightInvDir, expected vec3"],
    },
    Case {
        name: "a float where the lab sends an int",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[
                ("uniform int beam", "uniform float beam"),
                ("beam == CIRCULAR", "beam == float(CIRCULAR)"),
                ("beam == NO_BEAM", "beam == float(NO_BEAM)"),
            ],
        )],
        at: ("lighting.frag", "uniform float beam"),
        words: &["float beam, expected int"],
    },
    Case {
        name: "a comparison sampler on a plain texture",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[
                (
                    "uniform sampler2D shadow_sampler",
                    "uniform sampler2DShadow shadow_sampler",
                ),
                (
                    "texture(shadow_sampler,uv).z",
                    "texture(shadow_sampler, vec3(uv, 0.5))",
                ),
            ],
        )],
        at: ("lighting.frag", "uniform sampler2DShadow shadow_sampler"),
        words: &[
            "compares, expected sampler2D",
            "GL_TEXTURE_COMPARE_MODE is GL_NONE",
        ],
    },
    Case {
        name: "a map of another kind",
        lab: "aueb7",
        files: &[one(
            "is_point_in_shadow.frag",
            &[
                (
                    "uniform sampler2D uniform_sampler_shadow_map",
                    "uniform samplerCube uniform_sampler_shadow_map",
                ),
                (
                    "uniform_sampler_shadow_map, position_lcs.xy)",
                    "uniform_sampler_shadow_map, position_lcs.xyz)",
                ),
            ],
        )],
        at: ("is_point_in_shadow.frag", "uniform samplerCube"),
        words: &["samplerCube uniform_sampler_shadow_map, expected sampler2D"],
    },
    Case {
        name: "the fragment shader's input has another name",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[("vshadow_position", "vshadow_positon")],
        )],
        at: ("lighting.frag", "in vec4 vshadow_positon"),
        words: &[
            "cs541's own lighting.vert has no out of that name",
            "did you mean \"vshadow_position\"?",
        ],
    },
    Case {
        name: "the slides' own slip: another name in each stage",
        lab: "csci3260",
        files: &[
            one("VertexShaderCode.glsl", &[]),
            one(
                "FragmentShaderCode.glsl",
                &[("ShadowCoord", "shadow_vertexPosition")],
            ),
        ],
        at: ("FragmentShaderCode.glsl", "in vec4 shadow_vertexPosition"),
        words: &[
            "VertexShaderCode.glsl has no out of that name",
            "ShadowCoord",
        ],
    },
    Case {
        name: "another type in each stage",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[
                ("in vec3 eye_vector", "in vec4 eye_vector"),
                ("normalize(eye_vector)", "normalize(eye_vector.xyz)"),
            ],
        )],
        at: ("lighting.frag", "in vec4 eye_vector"),
        words: &["eye_vector is vec4 in lighting.frag and vec3 in lighting.vert"],
    },
    Case {
        name: "an unread vshadow_position",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[
                ("vshadow_position.xy/vshadow_position.w", "vec2(0.5)"),
                ("vshadow_position.z/vshadow_position.w", "0.0"),
                ("vshadow_position.w > 0", "true"),
                ("texture(shadow_sampler,uv).z", "1.0"),
            ],
        )],
        at: ("lighting.frag", "in vec4 vshadow_position"),
        words: &["vshadow_position is handed to the fragment shader, which does not read it"],
    },
    Case {
        name: "a shadow test whose answer nobody uses",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[("!in_shadow && (inside_beam || beam == NO_BEAM)", "true")],
        )],
        at: ("lighting.frag", "uniform sampler2D shadow_sampler"),
        words: &["shadow_sampler: nothing of it reaches the picture, nor of vshadow_position"],
    },
    Case {
        name: "no look-up",
        lab: "cmsc23700",
        files: &[one(
            "lighting.frag",
            &[
                ("uniform sampler2D spotMap;", ""),
                ("S(spotMap, spotCoord, spotBias)", "1.0"),
            ],
        )],
        at: ("lighting.frag", ""),
        words: &["no uniform sampler2D spotMap, expected the shadow map to be looked up"],
    },
    Case {
        name: "no model matrix",
        lab: "cs541",
        files: &[one(
            "shadow.vert",
            &[
                ("uniform mat4 model_matrix;", ""),
                ("(model_matrix * position)", "position"),
            ],
        )],
        at: ("shadow.vert", ""),
        words: &["no uniform mat4 model_matrix, expected it to be declared and used"],
    },
    Case {
        name: "a misspelt input",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[
                ("in vec3 normal;", "in vec3 normall;"),
                ("normal_matrix * normal", "normal_matrix * normall"),
            ],
        )],
        at: ("lighting.vert", "in vec3 normall"),
        words: &[
            "cs541 feeds no input of that name",
            "did you mean \"normal\"?",
        ],
    },
    Case {
        name: "an input at another's location",
        lab: "csci3260",
        files: &[one(
            "ShadowVertexShader.glsl",
            &[("location = 0", "location = 5")],
        )],
        at: ("ShadowVertexShader.glsl", "in vec3 position_modelSpace;"),
        words: &[
            "position_modelSpace is at location 5",
            "expected layout(location = 0) in vec3 position_modelSpace",
        ],
    },
    Case {
        name: "an input without its location",
        lab: "csci3260",
        files: &[one(
            "VertexShaderCode.glsl",
            &[("layout(location = 2) in vec2 vertexUV", "in vec2 vertexUV")],
        )],
        at: ("VertexShaderCode.glsl", "in vec2 vertexUV"),
        words: &["vertexUV has no location, expected layout(location = 2) in vec2 vertexUV"],
    },
    Case {
        name: "an input that no mesh has",
        lab: "aueb7",
        files: &[one(
            "SpotLight.vert",
            &[
                (
                    "layout(location = 2) in vec2 texture_coord",
                    "layout(location = 7) in vec2 uv",
                ),
                ("texcoord = texture_coord", "texcoord = uv"),
            ],
        )],
        at: ("SpotLight.vert", "location = 7"),
        words: &["in vec2 uv is at location 7, which aueb7 does not feed"],
    },
    Case {
        name: "an input of whole numbers",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[("in vec3 normal;", "in ivec3 normal;")],
        )],
        at: ("lighting.vert", "in ivec3 normal"),
        words: &["ivec3 normal, expected vec3 or vec4"],
    },
    Case {
        name: "no position",
        lab: "cs541",
        files: &[one("shadow.vert", &[("* position", "* vec4(1.0)")])],
        at: ("shadow.vert", ""),
        words: &["reads no position, expected in vec4 position"],
    },
    Case {
        name: "handed on, and never written",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[("    vtexture_coord = texture_coord;\n", "")],
        )],
        at: ("lighting.vert", "out vec2 vtexture_coord"),
        words: &["vtexture_coord is read by lighting.frag, and never written"],
    },
    Case {
        name: "not handed on",
        lab: "cs541",
        files: &[one(
            "lighting.vert",
            &[
                ("out vec3 eye_vector;\n", ""),
                ("    eye_vector = eye_position - world_position.xyz;\n", ""),
            ],
        )],
        at: ("lighting.vert", ""),
        words: &["no out vec3 eye_vector, which lighting.frag reads"],
    },
    Case {
        name: "no color",
        lab: "eecs487",
        files: &[one(
            "lighting.frag",
            &[("    color = vec4(vertexColor, 1);\n", "")],
        )],
        at: ("lighting.frag", ""),
        words: &["writes no color"],
    },
    Case {
        name: "it does not compile",
        lab: "cs541",
        files: &[one(
            "lighting.frag",
            &[("float shadow_depth = ", "float shadow_depht = ")],
        )],
        at: ("lighting.frag", "bool in_shadow"),
        words: &["does not compile", "shadow_depth"],
    },
    Case {
        name: "it does not link",
        lab: "cs541",
        files: &[one("lighting.frag", &[("void main", "void mian")])],
        at: ("lighting.frag", ""),
        words: &["lighting.vert and lighting.frag do not link", "main"],
    },
];
