//! A student's own shaders: each thing that can be wrong with them is found, with its file and line; what is right is not
//! accused, however it is written; and their shadows are read from their pictures.

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::{Bench, work_folder};
use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, LABS, Show};
use shadowlab::own_shaders::{self, Checked};
use shadowlab::{Error, gl};

/// A shader of the lab, in which each passage stands for another one.
struct Edited {
    file: &'static str,
    passages: &'static [(&'static str, &'static str)],
}

impl Edited {
    fn text(&self, lab: &str) -> String {
        let text = std::fs::read_to_string(format!("glsl/{lab}/{}", self.file)).unwrap();
        self.passages.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{} has no \"{from}\"", self.file);
            text.replace(from, to)
        })
    }
}

/// Writes the files into an empty folder.
fn folder(name: &str, lab: &str, files: &[Edited]) -> std::path::PathBuf {
    let folder = work_folder(&format!("check_shaders_{name}"));
    for file in files {
        std::fs::write(folder.join(file.file), file.text(lab)).unwrap();
    }
    folder
}

fn check(lab: &str, folder: &Path) -> Result<Checked, Error> {
    let context = Headless::open(&Choice::Software, [64, 64], false).unwrap();
    own_shaders::check(&context, labs::find(lab).unwrap(), folder)
}

/// The findings, without the folder's name.
fn told(lab: &str, folder: &Path) -> Vec<String> {
    let checked = check(lab, folder).unwrap();
    let folder = format!("{}/", folder.display());
    let findings = checked.findings.iter();
    findings
        .map(|finding| finding.to_string().replace(&folder, ""))
        .collect()
}

/// One thing that is wrong.
struct Case {
    name: &'static str,
    lab: &'static str,
    files: &'static [Edited],
    /// The file, and a passage of the line that is to be named; "" where no line is.
    at: (&'static str, &'static str),
    /// What must be told of it.
    words: &'static [&'static str],
}

const fn one(file: &'static str, passages: &'static [(&'static str, &'static str)]) -> Edited {
    Edited { file, passages }
}

const CASES: &[Case] = &[
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

fn line_of(text: &str, passage: &str) -> usize {
    1 + text
        .lines()
        .position(|line| line.contains(passage))
        .unwrap()
}

#[test]
fn what_is_wrong_is_found_in_its_line() {
    for case in CASES {
        let Case {
            name,
            lab,
            files,
            at: (file, passage),
            words,
        } = case;
        let folder = folder("wrong", lab, files);
        let edited = files.iter().find(|edited| edited.file == *file).unwrap();
        let place = match *passage {
            "" => format!("{file}: "),
            passage => format!("{file}:{}: ", line_of(&edited.text(lab), passage)),
        };
        let told = told(lab, &folder);
        let wrong: Vec<_> = told
            .iter()
            .filter(|told| !told.starts_with("note: "))
            .collect();
        let is_it = |told: &&&String| {
            told.starts_with(&place) && words.iter().all(|word| told.contains(word))
        };
        let found = wrong.iter().find(is_it);
        assert!(
            found.is_some(),
            "{name}: no \"{place}… {words:?}\" in {told:#?}"
        );
        // The mistake is told once, and what follows from it is not held against the student as well; but a driver may
        // have more to say of the lines that a slip leaves without sense.
        let others = wrong
            .iter()
            .filter(|told| !told.contains("does not compile"))
            .count();
        let is_compiled = !found.unwrap().contains("does not compile");
        assert_eq!(others, usize::from(is_compiled), "{name}: {told:#?}");
        println!("| {name} | `{}` |", found.unwrap());
    }
}

#[test]
fn the_labs_own_shaders_are_clean() {
    for handout in LABS {
        let folder = work_folder("check_shaders_own");
        for file in std::fs::read_dir(format!("glsl/{}", handout.name)).unwrap() {
            let file = file.unwrap();
            std::fs::copy(file.path(), folder.join(file.file_name())).unwrap();
        }
        assert_eq!(told(handout.name, &folder), [""; 0], "{}", handout.name);
        assert!(check(handout.name, &folder).unwrap().draws);
    }
}

/// A file and its text.
type Named = (&'static str, String);

/// As students write them: nothing is wrong, and the picture is the lab's.
#[test]
fn what_is_right_is_not_accused() {
    let other_names: &[(&str, &str)] = &[
        ("vshadow_position", "FragPosLightSpace"),
        ("normal_vector", "N_"),
        ("eye_vector", "V"),
    ];
    let read =
        |lab: &str, file: &str| std::fs::read_to_string(format!("glsl/{lab}/{file}")).unwrap();
    let renamed = |file| {
        other_names
            .iter()
            .fold(read("cs541", file), |text, (a, b)| text.replace(a, b))
    };
    let lighting = read("cs541", "lighting.frag");
    let vertex = read("cs541", "lighting.vert");
    let test = read("aueb7", "is_point_in_shadow.frag").replacen("#version 330 core", "", 1);
    let prototypes = "// These are in is_point_in_shadow.frag.\nvec4 to_light_space(vec3 position_ecs);\n\
        float is_point_in_shadow(vec4 position_lcs);\nfloat is_point_in_shadow_pcf_5(vec4 position_lcs);\n\
        float is_point_in_shadow_pcf_9(vec4 position_lcs);\n";
    let spot = read("aueb7", "SpotLight.frag");
    assert!(spot.contains(prototypes));
    let csci = read("csci3260", "VertexShaderCode.glsl");
    let variants: [(&str, &str, Vec<Named>); 7] = [
        ("other names between the stages", "cs541", vec![
            ("lighting.vert", renamed("lighting.vert")),
            ("lighting.frag", renamed("lighting.frag")),
        ]),
        ("other spaces, other lines, comments, and code put aside", "cs541", vec![(
            "lighting.frag",
            lighting
                .replace("uniform sampler2D usampler;\n", "uniform\n\tsampler2D /* the object's;\n */ usampler ;\r\n")
                .replace("in vec3 eye_vector;\nin vec2 vtexture_coord;", "in vec2 vtexture_coord; in vec3\\\n eye_vector;")
                .replace("void main(void)\n", "#if 0\nuniform sampler2D old_map;\nin vec4 shadow_pos;\n#endif\nvoid main()")
                + "// in vec3 nowhere;\n",
        )]),
        ("a constant of one's own", "cs541", vec![(
            "lighting.frag",
            lighting
                .replace("uniform float epsilon;", "uniform float my_bias = 0.001;\nconst float half_bias = 0.0;")
                .replace("- epsilon", "- my_bias - half_bias"),
        )]),
        ("a position of three numbers", "cs541", vec![(
            "lighting.vert",
            vertex
                .replace("in vec4 position", "layout(location = 0) in vec3 position")
                .replace("model_matrix * position", "model_matrix * vec4(position, 1.0)"),
        )]),
        ("inputs by their locations", "csci3260", vec![(
            "VertexShaderCode.glsl",
            csci.replace("vertexPosition_modelspace", "aPos").replace("vertexNormal_modelspace", "aNormal"),
        )]),
        ("a block between the stages", "cs541", vec![
            ("lighting.vert", vertex
                .replace("out vec4 vshadow_position;", "out Shadow { vec4 place; } shadow_out;")
                .replace("    vshadow_position =", "    shadow_out.place =")),
            ("lighting.frag", lighting
                .replace("in vec4 vshadow_position;", "in Shadow { vec4 place; } shadow_in;")
                .replace("vshadow_position", "shadow_in.place")),
        ]),
        // As the handout has it; the lab has the shadow test in a file of its own.
        ("one file", "aueb7", vec![(
            "SpotLight.frag",
            spot.replace(prototypes, &test),
        )]),
    ];
    for (name, lab, files) in variants {
        let folder = work_folder("check_shaders_right");
        for (file, text) in &files {
            assert_ne!(*text, read(lab, file), "{name}: {file}");
            std::fs::write(folder.join(file), text).unwrap();
        }
        let told = told(lab, &folder);
        assert!(
            told.iter().all(|told| told.starts_with("note: ")),
            "{name}: {told:#?}"
        );
        let picture = Bench::with_glsl(lab, &folder, [160, 120]).picture();
        let own = Bench::new(lab, [160, 120], &[]).picture();
        let differing = common::differing(&own, &picture);
        // The bias of one's own is another one.
        let is_same = differing == 0 || name.starts_with("a constant");
        assert!(is_same, "{name}: {differing} pixels");
    }
}

/// `attribute` and `varying` stand where the handout has them, and are told what became of them.
#[test]
fn glsl_of_the_handouts_age_is_taken_and_told() {
    let read = |file: &str| std::fs::read_to_string(format!("glsl/cs541/{file}")).unwrap();
    let vertex = read("lighting.vert")
        .replace("\nin ", "\nattribute ")
        .replace("\nout ", "\nvarying ");
    let mut fragment = read("lighting.frag")
        .replace("\nin ", "\nvarying ")
        .replace("out vec4 frag_color;\n", "");
    for (from, to) in [("texture(", "texture2D("), ("frag_color", "gl_FragColor")] {
        fragment = fragment.replace(from, to);
    }
    for version in ["120", "130"] {
        let folder = work_folder("check_shaders_age");
        let of_age = |text: &str| text.replace("#version 330 core", &format!("#version {version}"));
        // Version 120 makes no float of an int that is passed to a function.
        let fragment =
            fragment.replace("normalize(eye_vector)), 0)", "normalize(eye_vector)), 0.0)");
        std::fs::write(folder.join("lighting.vert"), of_age(&vertex)).unwrap();
        std::fs::write(folder.join("lighting.frag"), of_age(&fragment)).unwrap();
        let told = told("cs541", &folder);
        for note in [
            format!("note: lighting.vert:1: #version {version}, expected #version 330 core"),
            format!(
                "note: lighting.vert:{}: attribute, expected in:",
                line_of(&vertex, "attribute vec4")
            ),
            format!(
                "note: lighting.frag:{}: varying, expected",
                line_of(&fragment, "varying vec3")
            ),
            format!(
                "note: lighting.frag:{}: texture2D, expected texture:",
                line_of(&fragment, "texture2D(")
            ),
            format!(
                "note: lighting.frag:{}: gl_FragColor, expected an out vec4",
                line_of(&fragment, "gl_FragColor")
            ),
        ] {
            assert!(
                told.iter().any(|told| told.starts_with(&note)),
                "no \"{note}\" in {told:#?}"
            );
        }
        assert_eq!(told.len(), 7, "{told:#?}");
        let picture = Bench::with_glsl("cs541", &folder, [160, 120]).picture();
        let own = Bench::new("cs541", [160, 120], &[]).picture();
        assert_eq!(common::differing(&own, &picture), 0, "{version}");
    }
}

#[test]
fn a_file_of_another_name_is_told_which_one_it_is() {
    let folder = folder("names", "cs541", &[one("lighting.vert", &[])]);
    let lighting = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    std::fs::write(folder.join("phong.frag"), &lighting).unwrap();
    std::fs::write(folder.join("shadow.frag.glsl"), "void main() {}").unwrap();
    std::fs::write(folder.join("sahdow.frag"), "void main() {}").unwrap();
    std::fs::write(folder.join("readme.txt"), "in vec3 position;").unwrap();
    let told = told("cs541", &folder);
    let expected = [
        "note: phong.frag: takes no part: cs541 has no shader of this name (it declares 15 of the names of \
         \"lighting.frag\": did you mean that?)",
        "note: sahdow.frag: takes no part: cs541 has no shader of this name (did you mean \"shadow.frag\"?)",
        "note: shadow.frag.glsl: takes no part: cs541 has no shader of this name",
    ];
    assert_eq!(told, expected);

    std::fs::write(folder.join("lighting.frag"), &lighting).unwrap();
    let again = self::told("cs541", &folder);
    assert!(
        again[0].ends_with("\"lighting.frag\", which is here already)"),
        "{again:#?}"
    );
    for file in ["lighting.vert", "lighting.frag"] {
        std::fs::remove_file(folder.join(file)).unwrap();
    }
    let refused = check("cs541", &folder).err().unwrap().to_string();
    for words in [
        "none of cs541's shaders is here",
        "\"phong.frag\" (it declares 15 of the names of \"lighting.frag\"",
        "expected one or more of",
    ] {
        assert!(refused.contains(words), "{refused}");
    }
}

/// The file of each lab that has its shadow test and its lighting in one.
const TESTS: [(&str, &str, &str, &str); 4] = [
    (
        "cs541",
        "lighting.frag",
        "shadow_depth < point_depth",
        "shadow_depth > point_depth",
    ),
    (
        "csci3260",
        "FragmentShaderCode.glsl",
        ".z < ShadowCoord.z - bias",
        ".z > ShadowCoord.z - bias",
    ),
    (
        "cmsc23700",
        "lighting.frag",
        ".r < depth - bias",
        ".r > depth - bias",
    ),
    (
        "aueb7",
        "SpotLight.frag",
        "shadow_factor * diffuse",
        "(1.0 - shadow_factor) * diffuse",
    ),
];

/// The shadows are read from pictures, and are those that the lab's own visibility program shows; a student's test that
/// answers the other way round is seen to, although the lab's program knows nothing of it.
#[test]
fn the_shadows_are_those_of_the_students_own_test() {
    let size = [200, 160];
    for (lab, file, right, wrong) in TESTS {
        let expected = Bench::new(lab, size, &[]).visibility();
        for (from, to, is_right) in [(right, right, true), (right, wrong, false)] {
            let folder = work_folder("check_shaders_visibility");
            let text = std::fs::read_to_string(format!("glsl/{lab}/{file}")).unwrap();
            assert!(text.contains(from), "{lab}");
            std::fs::write(folder.join(file), text.replace(from, to)).unwrap();
            let mut bench = Bench::with_glsl(lab, &folder, size);
            assert!(bench.lab.has_students_test(), "{lab}");
            let found =
                own_shaders::visibility(bench.lab.as_mut(), &bench.context, size, 1).unwrap();
            gl::check_errors(&bench.context.gl, "drawing").unwrap();
            let pairs = found
                .visibility
                .pixels()
                .zip(expected.pixels())
                .zip(&found.known);
            let known: Vec<_> = pairs
                .filter(|(_, known)| **known)
                .map(|(pair, _)| pair)
                .collect();
            // The light reaches a good part of every lab's picture.
            assert!(known.len() > 8_000, "{lab}: {} known", known.len());
            let alike = known
                .iter()
                .filter(|(a, b)| a.0[0].abs_diff(b.0[0]) < 64)
                .count();
            let share = alike as f64 / known.len() as f64;
            assert_eq!(share > 0.999, is_right, "{lab}: {share}");

            // What the lab's own program shows is not the student's test.
            bench
                .lab
                .render(&bench.context.gl, Show::Visibility { light: 1 })
                .unwrap();
            let labs = gl::read_grey(&bench.context.gl, size);
            assert_eq!(common::differing(&labs, &expected), 0, "{lab}");
        }
    }
}

fn shadowlab(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// More than any machine takes for it; the limit's own test has a small one.
const PATIENT: [&str; 2] = ["--limit", "600"];

#[test]
fn the_command_tells_findings_then_the_picture_and_its_exit_code_is_diffs() {
    let folder = work_folder("check_shaders_command");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let write = |name: &str, text: &str| {
        std::fs::create_dir(folder.join(name)).unwrap();
        std::fs::write(folder.join(name).join("lighting.frag"), text).unwrap();
    };
    write("right", &own);
    write(
        "reversed",
        &own.replace("shadow_depth < point_depth", "shadow_depth > point_depth"),
    );
    write(
        "misspelt",
        &own.replace("shadow_sampler", "shadow_sampeler"),
    );
    write(
        "broken",
        &own.replace("float shadow_depth", "float shadow_depht"),
    );
    let run = |name: &str, more: &[&str]| {
        let arguments = [
            &["check-shaders", name, "cs541", "--size", "160x160"][..],
            &PATIENT,
            more,
        ]
        .concat();
        shadowlab(&folder, &arguments)
    };

    let right = run("right", &[]);
    let text = out(&right);
    assert_eq!(right.status.code(), Some(0), "{text}{}", err(&right));
    assert!(
        text.starts_with("right in cs541: 0 wrong, 0 to note\nright against cs541: the same"),
        "{text}"
    );
    assert!(
        text.contains("shadows, as far as they can be read") && text.contains("false shadow"),
        "{text}"
    );

    // Nothing is wrong with it but what it draws.
    let reversed = run("reversed", &["-o", "reversed.html"]);
    let text = out(&reversed);
    assert_eq!(reversed.status.code(), Some(1), "{text}");
    assert!(
        text.starts_with("reversed in cs541: 0 wrong") && text.contains("not the same"),
        "{text}"
    );
    assert!(
        text.contains("diagnosis: comparison_reversed") || text.contains("diagnosis: "),
        "{text}"
    );
    let page = std::fs::read_to_string(folder.join("reversed.html")).unwrap();
    assert!(page.contains("data:image/png") && page.contains("not the same"));

    let misspelt = run("misspelt", &["--json", "-o", "misspelt.html"]);
    let page = std::fs::read_to_string(folder.join("misspelt.html")).unwrap();
    assert!(page.contains("<li><code>misspelt/lighting.frag:17: sampler2D shadow_sampeler"));
    assert_eq!(misspelt.status.code(), Some(1));
    let found: serde_json::Value = serde_json::from_slice(&misspelt.stdout).unwrap();
    let finding = &found["findings"][0];
    assert_eq!(finding["wrong"], true);
    assert_eq!(finding["file"], "misspelt/lighting.frag");
    assert_eq!(
        finding["line"],
        line_of(&own, "uniform sampler2D shadow_sampler")
    );
    assert_eq!(found["compared"]["same"], false);

    // What does not compile has no picture.
    let broken = run("broken", &["-o", "broken.html"]);
    let text = out(&broken);
    assert_eq!(broken.status.code(), Some(1), "{text}");
    assert!(
        text.contains("broken/lighting.frag:") && text.contains("no picture: "),
        "{text}"
    );
    assert!(!folder.join("broken.html").exists());
}

/// The figures of `measure` are the student's own: the lab's are those of the control.
#[test]
fn measure_is_of_the_students_test() {
    let folder = work_folder("check_shaders_measure");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    std::fs::create_dir(folder.join("mine")).unwrap();
    let measure = |text: &str| {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let arguments = [
            "measure", "cs541", "--size", "160x160", "--json", "--glsl", "mine",
        ];
        shadowlab(&folder, &[&arguments[..], &PATIENT].concat())
    };
    let figures = |text: &str| -> serde_json::Value {
        let ran = measure(text);
        assert!(ran.status.success(), "{}", err(&ran));
        serde_json::from_slice(&ran.stdout).unwrap()
    };
    let bias = "point_depth = point_depth - epsilon";
    let too_much = own.replace(bias, "point_depth = point_depth - 0.02");
    assert_ne!(own, too_much);
    let reported = |text: &str| -> u64 {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let arguments =
            "report cs541 --size 160x160 --rounds 1 --sweep map_size=1024 --glsl mine -o out";
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let ran = shadowlab(&folder, &[&arguments[..], &PATIENT].concat());
        assert!(ran.status.success(), "{}", err(&ran));
        let mut csv = csv::Reader::from_path(folder.join("out/report.csv")).unwrap();
        let columns = csv.headers().unwrap().clone();
        let row = csv.records().next().unwrap().unwrap();
        let place = columns.iter().position(|name| name == "false_light");
        row[place.unwrap()].parse().unwrap()
    };
    let reports = (reported(&own), reported(&too_much));
    let (right, too_much) = (figures(&own), figures(&too_much));
    let false_light =
        |figures: &serde_json::Value| figures["false_light"]["pixels"].as_u64().unwrap();
    assert!(false_light(&right) < 100, "{right:#}");
    assert!(
        false_light(&too_much) > 3 * false_light(&right),
        "{too_much:#}"
    );
    assert_eq!(reports, (false_light(&right), false_light(&too_much)));
    assert!(right["judged"].as_u64().unwrap() > 10_000, "{right:#}");

    // Without a shadow test there is nothing to read, and that is no good figure.
    let none = measure(&own.replace("shadows && inside_beam", "false && inside_beam"));
    assert_eq!(none.status.code(), Some(1), "{}", out(&none));
    assert!(
        err(&none).contains("the same whatever the shadow map holds"),
        "{}",
        err(&none)
    );
}

/// Files that nobody checked: there are findings, or one line says why there are none; nothing hangs, and nothing is left
/// behind.
#[test]
fn a_broken_or_hostile_file_is_told() {
    let folder = work_folder("check_shaders_hostile");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let half = &own[..own.len() / 2];
    let head = "#version 330 core\n";
    let texts = [
        ("empty", String::new()),
        ("cut off", half.to_owned()),
        ("zeros", "\0".repeat(1000)),
        ("a byte order mark", format!("\u{feff}{own}")),
        ("an open comment", format!("{head}/* {own}")),
        ("open braces", format!("{head}{}", "{".repeat(100_000))),
        (
            "open brackets",
            format!("{head}void main() {{ int i = {}", "(".repeat(100_000)),
        ),
        (
            "many inputs",
            format!("{head}{}", "in vec3 a;".repeat(2_000)),
        ),
        (
            "an endless line",
            format!("{head}// {}", "\\\n".repeat(500_000)),
        ),
        (
            "no end of #if",
            format!("{head}{}", "#if 0\n".repeat(100_000)),
        ),
        (
            "a memory full",
            format!(
                "{head}out vec4 c; void main() {{ float a[2000000000]; a[int(gl_FragCoord.x)] = 1.0; c = vec4(a[7]); }}"
            ),
        ),
        ("steering", format!("{head}in vec3 \u{1b}[2J;")),
    ];
    std::fs::create_dir(folder.join("mine")).unwrap();
    for (name, text) in texts {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let ran = shadowlab(
            &folder,
            &[
                &["check-shaders", "mine", "cs541", "--size", "32x32"][..],
                &PATIENT,
            ]
            .concat(),
        );
        let (said, error) = (out(&ran), err(&ran));
        match ran.status.code() {
            Some(1) => {
                assert!(said.starts_with("mine/lighting.frag"), "{name}: {said}");
                assert!(!said.contains('\u{1b}'), "{name}: {said}");
                let has_mark = name == "a byte order mark";
                let is_told = said.contains("byte order mark, expected none");
                assert_eq!(is_told, has_mark, "{name}: {said}");
                assert!(said.lines().all(|line| line.len() < 3000), "{name}: {said}");
            }
            Some(2) => {
                assert!(
                    error.lines().last().unwrap().starts_with("shadowlab: mine"),
                    "{name}: {error}"
                );
                assert!(said.is_empty(), "{name}: {said}");
            }
            code => panic!("{name}: {code:?}: {said}{error}"),
        }
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "{name}");
        println!(
            "| {name} | {:?} | {} |",
            ran.status.code(),
            said.lines().next().unwrap_or(error.trim())
        );
    }
}

/// A loop that no compiler can take out, since what ends it is read from a texture. llvmpipe gives every loop up after 65,536 rounds
/// (other drivers do not), so a round takes long enough for hours of them.
const ENDLESS: &str = "#version 330 core
uniform sampler2D usampler;
out vec4 frag_color;
#define READ sum += texture(usampler, vec2(sum, 0.5 * sum)).r;
#define READS READ READ READ READ READ READ READ READ READ READ
#define ROUND READS READS READS READS READS READS READS READS READS READS
void main(void)
{
    float sum = 0.0;
    for (int i = 0; sum >= 0.0; i = 1 - i) {
        ROUND ROUND
        if (sum > 100.0)
            sum = float(i);
    }
    frag_color = vec4(sum);
}
";

#[test]
fn a_shader_that_never_ends_is_ended() {
    let folder = work_folder("check_shaders_endless");
    let mine = folder.join("mine");
    std::fs::create_dir(&mine).unwrap();
    let draw = |text: &str, command: &[&str], limit: &str| {
        std::fs::write(mine.join("lighting.frag"), text).unwrap();
        shadowlab(&folder, &[command, &["--limit", limit]].concat())
    };
    let commands: [(&[&str], i32); 5] = [
        (&["screenshot", "cs541", "--glsl", "mine"], 1),
        (&["trace", "cs541", "--glsl", "mine"], 1),
        (&["measure", "cs541", "--glsl", "mine"], 1),
        (&["view", "cs541", "--glsl", "mine"], 1),
        (&["check-shaders", "mine", "cs541"], 2),
    ];
    for (command, code) in commands {
        let ended = draw(ENDLESS, command, "2");
        assert_eq!(
            ended.status.code(),
            Some(code),
            "{command:?}: {}",
            err(&ended)
        );
        let told = err(&ended);
        let last = told.lines().last().unwrap();
        assert_eq!(
            last,
            "shadowlab: mine: drawing with its shaders took longer than 2 s, expected a picture by then: a loop there may \
             never end (--limit SECONDS allows more)",
            "{command:?}"
        );
        assert!(out(&ended).is_empty(), "{command:?}");
    }
    assert!(!folder.join("cs541.png").exists());
    // The control: with loops that end it is drawn.
    let ends = ENDLESS
        .replace("sum >= 0.0;", "i < 1;")
        .replace("i = 1 - i", "i++");
    let drawn = draw(&ends, commands[0].0, "600");
    assert!(drawn.status.success(), "{}", err(&drawn));
    assert!(folder.join("cs541.png").exists());
}
