//! A student's own shaders: each thing that can be wrong with them is found, with its file and line; what is right is not
//! accused, however it is written.

mod cases;
#[path = "../common/mod.rs"]
mod common;

use std::path::Path;

use cases::{CASES, Case, Edited, one};
use common::{Bench, work_folder};
use shadowlab::Error;
use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, LABS};
use shadowlab::own_shaders::{self, Checked};

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
