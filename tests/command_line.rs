//! The program as a person calls it: what it writes, and what it says to input that is wrong.

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::work_folder;

fn shadowlab(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn names(folder: &Path) -> Vec<PathBuf> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    names.sort();
    names
}

/// What is wrong, the exit code, and words that the one line must contain: the thing, and what was expected.
const WRONG: &[(&str, i32, &[&str])] = &[
    ("", 2, &["subcommand"]),
    ("screenshoot cs541", 2, &["screenshoot", "screenshot"]),
    ("screenshot", 2, &["LAB"]),
    (
        "screenshot cs542",
        2,
        &["cs542", "did you mean \"cs541\"", "expected one of"],
    ),
    ("view", 2, &["LAB"]),
    ("view cs542", 2, &["cs542", "did you mean \"cs541\""]),
    ("view cs541 --vsync maybe", 2, &["maybe", "on, off"]),
    ("view cs541 --api x11", 2, &["x11", "auto, glx, egl"]),
    (
        "screenshot cs541 --keys <Drag:1>",
        2,
        &["<Drag:1>", "<Drag:12,-5>"],
    ),
    (
        "screenshot cs541 --keys <RightDrag:1,2>",
        2,
        &["no key <RightDrag:1,2>", "expected one of"],
    ),
    ("screenshot cs541 --sise 1x1", 2, &["--sise", "--size"]),
    ("screenshot cs541 --size 0x10", 2, &["0x10", "WIDTHxHEIGHT"]),
    ("screenshot cs541 --size 10", 2, &["'10'", "WIDTHxHEIGHT"]),
    (
        "screenshot cs541 --size 10x-1",
        2,
        &["10x-1", "WIDTHxHEIGHT"],
    ),
    (
        "screenshot cs541 --size 99999999999x1",
        2,
        &["99999999999x1", "WIDTHxHEIGHT"],
    ),
    (
        "screenshot cs541 --size 65537x1",
        2,
        &["65537x1", "1x1 to 65536x65536"],
    ),
    (
        "screenshot cs541 --size 60000x60000",
        2,
        &["60000×60000", "at most 16384×16384"],
    ),
    (
        "screenshot cs541 --show shadows",
        2,
        &["shadows", "picture, visibility, shadow-map, depth-raw"],
    ),
    (
        "screenshot cs541 --time NaN",
        2,
        &["NaN", "a number of seconds, 0 to 30000000000"],
    ),
    (
        "screenshot cs541 --time inf",
        2,
        &["inf", "a number of seconds"],
    ),
    ("screenshot cs541 --time -1", 2, &["-1", "0 to 30000000000"]),
    ("screenshot cs541 --frames 0", 2, &["0", "1..=100000"]),
    (
        "screenshot cs541 --light 2",
        2,
        &["--light 2", "expected 1"],
    ),
    (
        "screenshot cs541 --light 0",
        2,
        &["--light 0", "expected 1"],
    ),
    (
        "screenshot cs541 --device Voodoo",
        2,
        &["Voodoo", "auto, software, or part of one of: llvmpipe"],
    ),
    (
        "screenshot cs541 --set epsilom=0",
        2,
        &["epsilom", "did you mean \"epsilon\""],
    ),
    ("screenshot cs541 --set epsilon", 2, &["name=value"]),
    (
        "screenshot cs541 --set epsilon=NaN",
        2,
        &["NaN", "a number from 0 to 0.1"],
    ),
    (
        "screenshot cs541 --set epsilon=-1",
        2,
        &["-1", "a number from 0 to 0.1"],
    ),
    (
        "screenshot cs541 --set map_size=100000",
        2,
        &["100000", "a whole number from 256 to 8192"],
    ),
    (
        "screenshot cs541 --set depth_format=8",
        2,
        &["\"8\"", "handout | 16 | 24 | 32F"],
    ),
    (
        "screenshot cs541 --set shadows=yes",
        2,
        &["yes", "on | off"],
    ),
    (
        "screenshot cs541 --show depth-raw --set shadows=off",
        2,
        &["shadows=off", "expected shadows=on"],
    ),
    ("screenshot cs541 --keys wz", 2, &["no key z", "<Left>"]),
    (
        "screenshot cs541 --keys <Lfet>",
        2,
        &["<Lfet>", "did you mean \"Left\""],
    ),
    ("screenshot cs541 --keys w<", 2, &["closing", "<lt>"]),
    (
        "screenshot cs541 --keys <Set:filtre=nearest>",
        2,
        &["filtre", "did you mean \"filter\""],
    ),
    (
        "screenshot cs541 --keys <Set:filter>",
        2,
        &["<Set:filter>", "<Set:name=value>"],
    ),
    (
        "screenshot cs541 -o picture.jpg",
        2,
        &["picture.jpg", "ends in .png"],
    ),
    (
        "screenshot cs541 -o picture.pfm",
        2,
        &["picture.pfm", "ends in .png"],
    ),
    (
        "screenshot cs541 -o missing/picture.png",
        1,
        &["missing/picture.png", "cannot write it", "No such file"],
    ),
    (
        "screenshot cs541 -o folder.png",
        2,
        &["folder.png", "is a directory"],
    ),
    (
        "screenshot cs541 --glsl missing",
        1,
        &["missing", "cannot read it"],
    ),
    (
        "screenshot cs541 --glsl empty",
        1,
        &["empty", "expected one or more of shadow.vert"],
    ),
    (
        "screenshot cs541 --glsl broken",
        1,
        &[
            "broken/lighting.frag:4:",
            "does not compile",
            "shadow_depht",
        ],
    ),
    (
        "screenshot cs541 --glsl unlinked",
        1,
        &["unlinked/lighting.frag", "does not link"],
    ),
    (
        "screenshot cs541 --glsl folder_for_file",
        1,
        &["lighting.frag", "cannot read it"],
    ),
    (
        "screenshot cs541 --glsl binary",
        1,
        &["binary/lighting.frag", "cannot read it"],
    ),
    ("check-shaders", 2, &["<DIR>", "<LAB>"]),
    (
        "check-shaders missing cs541",
        2,
        &["missing", "cannot read it"],
    ),
    (
        "check-shaders empty cs541",
        2,
        &["empty", "none of cs541's shaders is here", "shadow.vert"],
    ),
    (
        "check-shaders binary cs541",
        2,
        &["binary/lighting.frag", "found no UTF-8"],
    ),
    (
        "check-shaders folder_for_file cs541",
        2,
        &["lighting.frag", "cannot read it"],
    ),
    (
        "check-shaders broken cs999",
        2,
        &["cs999", "expected one of cs541"],
    ),
    (
        "check-shaders broken cs541 --glsl broken",
        2,
        &["found --glsl", "expected the folder of shaders as DIR"],
    ),
    (
        "check-shaders broken cs541 --mistake no_bias",
        2,
        &[
            "--mistake no_bias",
            "check-shaders is about the lab without mistakes",
        ],
    ),
    (
        "check-shaders broken cs541 -o a.png",
        2,
        &["a.png", "ends in .html"],
    ),
    (
        "check-shaders broken cs541 --light 2",
        2,
        &["--light 2", "expected 1"],
    ),
    ("explain cs541", 2, &["--pixel", "--point"]),
    ("explain cs541 --pixel 1", 2, &["'1'", "2 numbers"]),
    (
        "explain cs541 --pixel 500,0",
        2,
        &["500,0", "expected 0,0 to 499,499"],
    ),
    ("explain cs541 --pixel -1,0", 2, &["-1"]),
    ("explain cs541 --point 1,2,NaN", 2, &["NaN", "3 numbers"]),
    (
        "explain cs541 --pixel 1,1 --point 1,1,1",
        2,
        &["--pixel", "--point"],
    ),
    (
        "explain cs541 --pixel 1,1 --set shadows=off",
        2,
        &["shadows=off", "expected shadows=on"],
    ),
    ("measure cs541 --light 2", 2, &["--light 2", "expected 1"]),
    ("measure cs541 -o a.jpg", 2, &["a.jpg", "ends in .png"]),
    (
        "measure cs541 --reference missing.png",
        1,
        &["missing.png", "No such file"],
    ),
    (
        "measure cs541 --reference small.png",
        1,
        &["small.png", "4×3 pixels, expected 500×500"],
    ),
    (
        "measure cs541 --reference broken/lighting.frag",
        1,
        &["broken/lighting.frag", "expected a PNG"],
    ),
    ("truth cs542", 2, &["cs542"]),
    (
        "truth cs541 --scene hard:wal",
        2,
        &["hard case \"wal\"", "did you mean \"wall\"?"],
    ),
    (
        "truth csci3260 --scene hard:wall",
        2,
        &["hard case wall", "drawn by cs541, found csci3260"],
    ),
    (
        "truth cs541 -o missing/a.png",
        1,
        &["missing/a.png", "cannot write it"],
    ),
    (
        "screenshot cmsc23700 --keys +p",
        2,
        &["no key p", "expected one of l + -"],
    ),
    (
        "screenshot cmsc23700 --light 3",
        2,
        &["--light 3", "expected 1 to 2"],
    ),
    (
        "screenshot cmsc23700 --set balls=101",
        2,
        &["101", "a whole number from 0 to 100"],
    ),
    (
        "screenshot cmsc23700 --time 86401",
        2,
        &["86401", "0 to 86400"],
    ),
    (
        "screenshot cmsc23700 --keys <Wait:80000>+ --time 6401",
        2,
        &["86401", "0 to 86400"],
    ),
    (
        "screenshot cmsc23700 --show visibility --set lights=spotlight",
        2,
        OFF,
    ),
    (
        "screenshot cmsc23700 --show shadow-map --set lights=spotlight",
        2,
        OFF,
    ),
    ("screenshot cmsc23700 --show depth-raw --keys ll", 2, OFF),
    ("measure cmsc23700 --set lights=spotlight", 2, OFF),
    (
        "measure cmsc23700 --reference small.png --size 4x3 --set lights=spotlight",
        2,
        OFF,
    ),
    ("truth cmsc23700 --set lights=spotlight", 2, OFF),
    (
        "explain cmsc23700 --pixel 1,1 --set lights=spotlight",
        2,
        OFF,
    ),
    (
        "measure cmsc23700 --light 2 --set lights=directional",
        2,
        &["lights=directional", "map of light 2", "lights=both"],
    ),
    ("trace cs541 -o trace.txt", 2, &["-o"]),
    ("report cs541", 2, &["--output"]),
    (
        "report eecs487 --sweep num_jitters=2..64 -o r",
        2,
        &["eecs487", "no --sweep"],
    ),
    (
        "report eecs487 --set soft_method=fast -o r",
        2,
        &["--set soft_method", "eecs487", "of its own"],
    ),
    ("report cs542 -o r", 2, &["cs542", "did you mean \"cs541\""]),
    (
        "report --set epsilon=0 -o r",
        2,
        &["expected a LAB", "one lab"],
    ),
    ("report cs541 --rounds 0 -o r", 2, &["0", "1..=1000"]),
    (
        "report cs541 --sweep map_size -o r",
        2,
        &["--sweep map_size", "NAME=A..B", "NAME=VALUE,VALUE"],
    ),
    (
        "report cs541 --sweep map_sise=256,512 -o r",
        2,
        &["--sweep map_sise", "did you mean \"map_size\""],
    ),
    (
        "report cs541 --sweep map_size=100..512 -o r",
        2,
        &["\"100\"", "a whole number from 256 to 8192"],
    ),
    (
        "report cs541 --sweep map_size=512..256 -o r",
        2,
        &["map_size=512..256", "B not below A"],
    ),
    (
        "report cs541 --sweep epsilon=0..0.1 -o r",
        2,
        &["epsilon=0..0.1", "0 < A"],
    ),
    (
        "report cs541 --sweep epsilon=NaN..0.1 -o r",
        2,
        &["epsilon=NaN..0.1", "0 < A"],
    ),
    (
        "report cs541 --sweep filter=linear,,nearest -o r",
        2,
        &["\"\"", "linear | nearest"],
    ),
    (
        "report cs541 --sweep remedy=epsilon..none -o r",
        2,
        &["epsilon..none", "epsilon | none | culling | both"],
    ),
    (
        "report cs541 --sweep redraw=every_frame,when_changed -o r",
        2,
        &["redraw", "every row"],
    ),
    (
        "report cs541 --set redraw=every_frame -o r",
        2,
        &["redraw", "every row"],
    ),
    (
        "report cs541 --sweep filter=linear --sweep filter=nearest -o r",
        2,
        &["--sweep filter", "given twice", "one --sweep"],
    ),
    (
        "report cs541 --sweep map_size=256..8192 --sweep epsilon=0.0001..0.1 --sweep remedy=none,both,culling,epsilon \
         --sweep filter=linear,nearest -o r",
        2,
        &["too many rows", "at most 500"],
    ),
    (
        "report cs541 -o broken/lighting.frag",
        1,
        &["broken/lighting.frag", "cannot write it"],
    ),
    (
        "report cs541 --device Voodoo -o r",
        2,
        &["Voodoo", "auto, software"],
    ),
    ("labs cs541", 2, &["cs541"]),
];

/// What is said of the directional light where it is off.
const OFF: &[&str] = &[
    "lights=spotlight",
    "map of light 1",
    "expected lights=directional",
];

/// Files and folders that the wrong calls speak of.
fn prepare(folder: &Path) {
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    };
    write("empty/notes.txt", b"");
    write("broken/lighting.frag", b"#version 330 core\nout vec4 frag_color;\nvoid main(void) {\n    frag_color = vec4(shadow_depht);\n}\n");
    write("unlinked/lighting.frag", b"#version 330 core\nin vec3 vtexture_coord;\nout vec4 frag_color;\nvoid main(void) {\n    frag_color = vtexture_coord.xyzz;\n}\n");
    let small = image::GrayImage::new(4, 3);
    small.save(folder.join("small.png")).unwrap();
    write("binary/lighting.frag", &[0xff, 0xfe, 0x00, 0x80]);
    std::fs::create_dir_all(folder.join("folder_for_file/lighting.frag")).unwrap();
    std::fs::create_dir_all(folder.join("folder.png")).unwrap();
}

#[test]
fn wrong_input_gets_one_line_and_leaves_nothing_behind() {
    let folder = work_folder("wrong");
    prepare(&folder);
    let before = names(&folder);
    for (arguments, code, words) in WRONG {
        let list: Vec<&str> = arguments.split_whitespace().collect();
        let output = shadowlab(&folder, &list);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(*code), "{arguments}: {told}");
        assert_eq!(told.lines().count(), 1, "{arguments}: {told}");
        assert!(told.starts_with("shadowlab: "), "{arguments}: {told}");
        for word in *words {
            assert!(told.contains(word), "{arguments}: no \"{word}\" in: {told}");
        }
        assert!(output.stdout.is_empty(), "{arguments}");
        assert_eq!(names(&folder), before, "{arguments}: left something behind");
        println!("| `{arguments}` | {code} | {} |", told.trim());
    }
}

#[test]
fn a_picture_that_cannot_be_replaced_stays() {
    let folder = work_folder("replaced");
    assert!(
        shadowlab(&folder, &["screenshot", "cs541", "--size", "8x8"])
            .status
            .success()
    );
    let picture = std::fs::read(folder.join("cs541.png")).unwrap();
    let failed = shadowlab(
        &folder,
        &["screenshot", "cs541", "--size", "8x8", "--glsl", "missing"],
    );
    assert_eq!(failed.status.code(), Some(1));
    assert_eq!(std::fs::read(folder.join("cs541.png")).unwrap(), picture);
    assert_eq!(names(&folder).len(), 1);
}

#[test]
fn a_picture_says_who_drew_it() {
    let folder = work_folder("notes");
    let ran = shadowlab(
        &folder,
        &[
            "screenshot",
            "cs541",
            "--size",
            "40x30",
            "--device",
            "software",
            "-o",
            "a.png",
        ],
    );
    assert_eq!(String::from_utf8(ran.stdout).unwrap(), "a.png\n");
    let file = std::io::BufReader::new(std::fs::File::open(folder.join("a.png")).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    assert_eq!(reader.info().size(), (40, 30));
    let notes = &reader.info().utf8_text;
    let renderer = notes
        .iter()
        .find(|note| note.keyword == "Renderer")
        .unwrap();
    assert!(renderer.get_text().unwrap().contains("llvmpipe"));
}

/// Three ways to the same depths: floats, 16-bit PNG, and linearised for the eye.
#[test]
fn the_depth_texture_comes_out_as_it_is() {
    let folder = work_folder("depths");
    let write = |show: &str, name: &str| {
        let options = [
            "screenshot",
            "cs541",
            "--set",
            "map_size=256",
            "--show",
            show,
            "-o",
            name,
        ];
        assert!(shadowlab(&folder, &options).status.success());
        std::fs::read(folder.join(name)).unwrap()
    };
    let pfm = write("depth-raw", "a.pfm");
    let header = b"Pf\n256 256\n-1.0\n";
    assert!(pfm.starts_with(header));
    assert_eq!(pfm.len(), header.len() + 4 * 256 * 256);
    let float_rows = pfm[header.len()..].chunks_exact(4 * 256);
    // Bottom row first, as glGetTexImage has it.
    let floats: Vec<f32> = float_rows
        .rev()
        .flat_map(|row| row.chunks_exact(4))
        .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect();

    write("depth-raw", "a.png");
    let words = image::open(folder.join("a.png")).unwrap().into_luma16();
    for (word, float) in words.iter().zip(&floats) {
        assert_eq!(*word, (f64::from(*float) * 65535.0).round() as u16);
    }
    write("shadow-map", "b.png");
    let grey = image::open(folder.join("b.png")).unwrap().into_luma8();
    // The scene's light: near 2, far 20.
    for (grey, float) in grey.iter().zip(&floats) {
        let distance = 2.0 * 20.0 / (20.0 - f64::from(*float) * 18.0);
        let expected = 255.0 * (distance - 2.0) / 18.0;
        assert!(
            (f64::from(*grey) - expected).abs() <= 0.51,
            "{grey}, expected {expected}"
        );
    }
    assert!(floats.iter().any(|depth| *depth < 0.9) && floats.contains(&1.0));
}

/// A student's own shader takes the place of the one with the same name, and only of that one.
#[test]
fn a_students_shader_is_used() {
    let folder = work_folder("glsl");
    std::fs::create_dir(folder.join("mine")).unwrap();
    let mine = "#version 330 core\nout vec4 frag_color;\nvoid main(void) { frag_color = vec4(1, 0, 1, 1); }\n";
    std::fs::write(folder.join("mine/lighting.frag"), mine).unwrap();
    let ran = shadowlab(
        &folder,
        &["screenshot", "cs541", "--size", "64x64", "--glsl", "mine"],
    );
    let notes = String::from_utf8(ran.stderr).unwrap();
    assert!(ran.status.success(), "{notes}");
    assert!(
        notes.contains("mine/lighting.frag") && notes.contains("shadow_sampler"),
        "{notes}"
    );
    let picture = image::open(folder.join("cs541.png")).unwrap().into_rgb8();
    assert_eq!(picture.get_pixel(32, 60).0, [255, 0, 255]);
    assert_ne!(
        picture.get_pixel(32, 1).0,
        [255, 0, 255],
        "the sky has a shader of its own"
    );
}

/// The figures as JSON, with the mask and the mistakes as pictures; and the lab's own picture as if it came from elsewhere.
#[test]
fn truth_and_measure_agree_with_each_other() {
    let folder = work_folder("measure");
    let json = |arguments: &str| -> serde_json::Value {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let ran = shadowlab(&folder, &arguments);
        assert!(
            ran.status.success(),
            "{}",
            String::from_utf8_lossy(&ran.stderr)
        );
        serde_json::from_slice(&ran.stdout).unwrap()
    };
    let truth = json("truth cs541 --size 200x150 --json -o mask.png");
    let measured = json("measure cs541 --size 200x150 --json -o mistakes.png");
    for count in ["lit", "shadowed"] {
        assert_eq!(truth[count], measured[count], "{count}");
    }
    let total: u64 = ["lit", "shadowed", "not_valid"]
        .iter()
        .map(|label| truth[*label].as_u64().unwrap())
        .sum();
    assert_eq!(total, 200 * 150);
    assert_eq!(measured["false_shadow"]["interior"], 0);
    assert!(measured["least_bias"].as_f64().unwrap() < 0.001);

    let visibility = "screenshot cs541 --size 200x150 --show visibility -o visibility.png";
    assert!(
        shadowlab(&folder, &visibility.split(' ').collect::<Vec<_>>())
            .status
            .success()
    );
    let elsewhere = json("measure cs541 --size 200x150 --json --reference visibility.png");
    for kind in ["false_shadow", "false_light"] {
        assert_eq!(
            measured[kind]["pixels"], elsewhere[kind]["pixels"],
            "{kind}"
        );
    }
    let mistakes = image::open(folder.join("mistakes.png"))
        .unwrap()
        .into_rgb8();
    let red = mistakes
        .pixels()
        .filter(|pixel| pixel.0 == [220, 30, 30])
        .count() as u64;
    let wrong = &measured["false_shadow"];
    assert_eq!(
        red,
        wrong["pixels"].as_u64().unwrap() + wrong["ambiguous"].as_u64().unwrap()
    );
}

/// Characters that a shell's options begin with are keys, too; and the key that quits changes nothing here.
#[test]
fn plus_and_minus_are_keys() {
    let folder = work_folder("plus_and_minus");
    let picture = |keys: &str| {
        let options = ["screenshot", "cmsc23700", "--size", "80x80", "--keys", keys];
        let output = shadowlab(&folder, &options);
        assert!(output.status.success(), "{keys}");
        std::fs::read(folder.join("cmsc23700.png")).unwrap()
    };
    let plain = picture("q");
    assert!(picture("+-") == plain);
    assert!(picture("--++") == picture("--++q"));
    // The controls.
    assert!(picture("-") != plain);
    assert!(picture("+") != plain);
}

#[test]
fn labs_lists_every_key_and_setting() {
    let text = String::from_utf8(shadowlab(Path::new("."), &["labs"]).stdout).unwrap();
    for lab in shadowlab::labs::LABS {
        let settings = lab.settings.iter().map(|setting| setting.name);
        let keys = lab.keys.iter().map(|(keys, _)| *keys);
        for word in settings.chain(keys).chain([lab.name]) {
            assert!(text.contains(word), "{word}");
        }
    }
}

#[test]
fn help_and_version_go_to_standard_output() {
    for arguments in [
        &["--help"][..],
        &["help"],
        &["--version"],
        &["screenshot", "--help"],
        &["explain", "-h"],
    ] {
        let output = shadowlab(Path::new("."), arguments);
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{arguments:?}"
        );
        assert!(!output.stdout.is_empty(), "{arguments:?}");
    }
}
