//! A student's own scene, from the file to the picture, the trace and the explanation.

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::work_folder;

fn shadowlab(folder: &Path, arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .args(arguments.split(' '))
        .current_dir(folder)
        .output()
        .unwrap()
}

/// What the program says when it succeeds: standard output and standard error.
fn said(folder: &Path, arguments: &str) -> [String; 2] {
    let output = shadowlab(folder, arguments);
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(output.status.success(), "{arguments}: {err}");
    [out, err]
}

fn size(folder: &Path) -> (u32, u32) {
    image::image_dimensions(folder.join("cs541.png")).unwrap()
}

/// The example of the README, as it stands there.
#[test]
fn the_readmes_scene_is_drawn() {
    let folder = work_folder("readme_scene");
    let readme = include_str!("../README.md");
    let example = readme.split("```toml\n").nth(1).unwrap();
    let example = example.split("```").next().unwrap();
    std::fs::write(folder.join("my_scene.toml"), example).unwrap();
    let call = "screenshot cs541 --scene my_scene.toml";
    assert!(readme.contains(&format!("shadowlab {call}")));
    let [_, notes] = said(&folder, call);
    assert_eq!(notes, "");
    let picture = image::open(folder.join("cs541.png")).unwrap().into_rgb8();
    let bluish = |pixel: &&image::Rgb<u8>| pixel.0[2] > pixel.0[0].saturating_add(40);
    let teapot = picture.pixels().filter(bluish).count();
    assert!(teapot > 5000, "{teapot} pixels of the teapot");
    let clear = picture.get_pixel(2, 2).0;
    assert_eq!(clear, [26, 26, 38], "the default clear colour");
}

#[test]
fn the_size_is_that_of_the_call_then_of_the_scene_then_of_the_lab() {
    let folder = work_folder("scene_size");
    let five_shapes = include_str!("../assets/five_shapes.toml");
    std::fs::write(folder.join("s.toml"), five_shapes).unwrap();
    let without = five_shapes.replace("size = [800, 600]", "");
    std::fs::write(folder.join("t.toml"), without).unwrap();
    said(&folder, "screenshot cs541 --scene s.toml");
    assert_eq!(size(&folder), (800, 600));
    said(&folder, "screenshot cs541 --scene s.toml --size 40x30");
    assert_eq!(size(&folder), (40, 30));
    said(&folder, "screenshot cs541 --scene t.toml");
    assert_eq!(size(&folder), (500, 500));
}

/// Trace and explain see the scene too: its five meshes, and a pixel in the shadow of its sphere.
#[test]
fn trace_and_explain_take_the_scene() {
    let folder = work_folder("scene_explain");
    let five_shapes = include_str!("../assets/five_shapes.toml");
    std::fs::write(folder.join("s.toml"), five_shapes).unwrap();
    let [trace, _] = said(&folder, "trace cs541 --scene s.toml");
    for word in ["torus", "sphere", "cube"] {
        assert!(trace.contains(word), "{word}");
    }
    assert!(!trace.contains("lighthouse"), "the lab's own scene");
    let [shadow, _] = said(&folder, "explain cs541 --scene s.toml --point 1.5,0,-0.7");
    let [light, _] = said(&folder, "explain cs541 --scene s.toml --point 4,0,3");
    assert_ne!(
        shadow.lines().last().unwrap(),
        light.lines().last().unwrap(),
        "{shadow}{light}"
    );
}

/// What can be drawn without is noted, one line each, and drawn.
#[test]
fn odd_models_are_noted_and_drawn() {
    let folder = work_folder("odd_models");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write(
        "odd.obj",
        "mtllib none.mtl\nmtllib odd.mtl\nusemtl wood\nv -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\nf 1 2 3 4\n\
         usemtl glas\nf 1 2 4\nf 1 2 4\n",
    );
    write("odd.mtl", "newmtl wood\nmap_Kd wood.png\nnewmtl glass\n");
    write(
        "s.toml",
        "[camera]\neye = [0, 5, 5]\ntarget = [0, 0, 0]\n[light]\nposition = [1, 5, 1]\n\
         [[object]]\nmesh = \"odd.obj\"\n",
    );
    let [_, notes] = said(&folder, "screenshot cs541 --scene s.toml");
    let expected = "\
note: odd.obj:1: found no file \"none.mtl\", drawn without its materials
note: odd.mtl:2: found no file \"wood.png\", drawn without it
note: odd.obj:9: found no material \"glas\" (did you mean \"glass\"?), drawn with the default
";
    assert_eq!(notes, expected);
}
