//! Texts that no person would write, for each parser of what a student hands in: no panic, no hang, no leak.
//!
//! A deterministic mutational fuzzer: input N of a parser is made from N and the seed alone, on every machine. A short run
//! is part of the tests; `cargo xtask fuzz [COUNT]` does the long one. `SHADOWLAB_FUZZ` is the number of inputs for
//! each parser, `SHADOWLAB_FUZZ_INPUT=N` runs the single input N again.

#[path = "../common/mod.rs"]
mod common;
mod harness;
mod memory;
mod mutate;

use std::io;
use std::path::Path;
use std::sync::LazyLock;
use std::time::Duration;

use harness::{Limits, Parser, Verdict, fuzz};
use shadowlab::labs::parse_keys;
use shadowlab::scene::reading::Files;
use shadowlab::scene::{file, obj};
use shadowlab::{Error, Result};

/// Where the material library begins in an input of the OBJ fuzzer.
const MTL: &str = "\n=== m.mtl\n";

const OBJ_SEEDS: &[&str] = &[
    "mtllib m.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 2\n\
     usemtl red\nl 1 2 3\nf 1/1/1 2/2/1 3/2/1 -1/1/1\n\
     \n=== m.mtl\nnewmtl red\nKa 1\nKd 1 0 0\nKs .5 .5 .5\nNs 20\nmap_Kd -s 1 1 1 a.png\n",
    "# faces first\r\nf 1 2 \\\r\n3 4 5 6\r\ng one two\r\nf -0 1 2\r\nv 0 0 0 1.0\r\nv 2 0 0\r\nv 2 1 0\r\n\
     v 1 1 0\r\nv 1 2 0 .5 .5 .5\r\nv 0 2 0\r\ns off\r\nusemtl none\r\nf -6//-1 -5// -4/1\r\n",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5\nvn 0 0 0\nf 1/1/1 2/1 3//1\nf 1 1 1\nf 1 2 3 4 1 2 3 4\n\
     mtllib m.mtl none.mtl\nusemtl dark grey\nfo 1 2 4\n\
     \n=== m.mtl\nnewmtl dark grey\nKd 0.2\nmap_Kd C:\\textures\\a.png\nnewmtl\nNs -1\nmap_Kd wood.tga\nnewmtl b\nmap_Kd b.png\n",
];

const OBJ_WORDS: &[&str] = &[
    "v ",
    "vt ",
    "vn ",
    "f ",
    "fo ",
    "o ",
    "g ",
    "usemtl ",
    "mtllib ",
    "newmtl ",
    "Kd ",
    "Ks ",
    "Ns ",
    "map_Kd ",
    "m.mtl",
    "a.png",
    "b.png",
    "-s ",
    "-mm ",
    "-clamp on ",
    "/",
    "//",
    "\\\n",
    "\r\n",
    "\n",
    "#",
    "-1",
    " ",
    "\t",
    "../",
    "\u{feff}",
    "red",
    MTL,
];

const SCENE_SEEDS: &[&str] = &[
    include_str!("../../assets/five_shapes.toml"),
    "size = [8, 6]\nsky = \"a.png\"\n[camera]\neye = [0, 5, 10]\nlook = [0, -1, -2]\nfovx = 45\nnear = 0.1\nfar = 100\n\
     [[light]]\nkind = \"directional\"\nposition = [4, 7, 5]\ndirection = [0, -1, 0]\ncolor = [1, 1, 1]\n\
     [[light]]\nkind = \"point\"\nposition = [4, 7, 5]\nshadow_fov = 120\nnear = 1\nfar = 30\n\
     [[object]]\nmesh = \"a.obj\"\nspin = { axis = [0, 1, 0], degrees_per_second = 30 }\ntexture = \"a.png\"\n",
    "[camera]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\nup = [0, 0, 1]\n\
     [light]\nkind = \"directional\"\ndirection = [0, -1, 0]\nbox = [-1, 1, -1, 1, 0, 9]\n\
     [[object]]\nmesh = \"plane\"\nmesh_size = 2\nscale = [1, 2, 3]\nrotate = [{ axis = [0, 1, 0], degrees = 30 }, \
     { axis = [1, 0, 0], degrees = -90 }]\ntranslate = [0, 1, 0]\ndiffuse = [1, 1, 1]\nspecular = [0.5, 0.5, 0.5]\n\
     shininess = 50\ncasts = false\n[[object]]\nmesh = \"torus\"\nmesh_size = 3\nthickness = 0.5\n\
     [[object]]\nmesh = \"teapot\"\nmesh_size = 1\nspin = { axis = [0, 1, 0], degrees_per_second = 30 }\n",
];

const SCENE_WORDS: &[&str] = &[
    "[camera]\n",
    "[light]\n",
    "[[light]]\n",
    "[[object]]\n",
    "mesh = ",
    "\"cube\"\n",
    "\"sphere\"\n",
    "\"a.obj\"\n",
    "mesh_size = ",
    "eye = ",
    "target = ",
    "look = ",
    "up = ",
    "[0, 0, 0]",
    "[1, 2, 3]",
    "near = ",
    "far = ",
    "cone = ",
    "kind = ",
    "\"spot\"\n",
    "\"point\"\n",
    "\"directional\"\n",
    "box = ",
    "rotate = ",
    "spin = ",
    "{",
    "}",
    "[",
    "]",
    "\"",
    "'",
    "\"\"\"",
    "=",
    ",",
    ".",
    "\n",
    "#",
    "true",
    "false",
    "1979-05-27",
    "\\u0000",
    "\\",
    "texture = ",
    "\"../a.png\"",
    "é",
    "\u{feff}",
];

const KEY_SEEDS: &[&str] = &["wwa<Left><Left>", "x<Tab><lt>é", "<PageUp><PageDown>opqe"];
const KEY_WORDS: &[&str] = &[
    "<",
    ">",
    "<<",
    "<>",
    "<Left>",
    "<lt>",
    "<PageU",
    "é",
    "\u{10ffff}",
    "\0",
    " ",
];

/// What the texts name, in memory.
fn file_in_memory(path: &Path, mtl: &[u8]) -> Result<Vec<u8>> {
    match path.to_str() {
        Some("m.mtl") => Ok(mtl.to_vec()),
        Some("a.obj") => Ok(OBJ_SEEDS[2].split(MTL).next().unwrap().into()),
        Some("a.png") => Ok(PICTURE.to_vec()),
        Some("b.png") => Ok(PICTURE[..40].to_vec()),
        _ => Err(Error::reading(path, io::ErrorKind::NotFound.into())),
    }
}

/// Small, for decoding it takes longer than all else.
static PICTURE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut bytes = io::Cursor::new(Vec::new());
    let picture = image::RgbImage::new(2, 2);
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
});

fn parse_obj(input: &[u8]) -> Verdict {
    let marker = MTL.as_bytes();
    let at = input.windows(marker.len()).position(|part| part == marker);
    let (model, mtl) = match at {
        Some(at) => (&input[..at], &input[at + marker.len()..]),
        None => (input, &b""[..]),
    };
    let files = Files::new(|path, _| file_in_memory(path, mtl));
    let parts = obj::parse_with(Path::new("m.obj"), model, &files);
    // The checks let nothing through that tobj does not take.
    if let Err(error) = &parts {
        assert!(!error.to_string().contains("tobj"), "{error}");
    }
    // What is handed on must keep what a mesh promises.
    for mesh in parts.iter().flatten().map(|part| &part.mesh) {
        let vertices = mesh.positions.len();
        assert_eq!(
            [mesh.normals.len(), mesh.texture_coords.len()],
            [vertices; 2]
        );
        assert!(
            mesh.faces
                .iter()
                .flatten()
                .all(|index| (*index as usize) < vertices)
        );
        assert!(mesh.normals.iter().all(|normal| normal.is_normalized()));
        assert!(mesh.positions.iter().all(|position| position.is_finite()));
    }
    verdict(parts)
}

fn parse_scene(input: &[u8]) -> Verdict {
    let text = String::from_utf8_lossy(input);
    let files = Files::new(|path, _| file_in_memory(path, b"newmtl red\n"));
    let scene = file::parse(Path::new("s.toml"), &text, &files);
    // And what reaches the GPU must be numbers.
    if let Ok(scene) = &scene {
        assert!(scene.camera.view().is_finite() && scene.camera.perspective(1.5).is_finite());
        assert!(
            scene
                .objects
                .iter()
                .all(|object| object.model(1.0).is_finite())
        );
        for light in &scene.lights {
            assert!(light.position.is_finite() && light.direction.normalize().is_finite());
            assert!(light.near < light.far && light.far.is_finite());
        }
    }
    verdict(scene)
}

fn parse_key_string(input: &[u8]) -> Verdict {
    verdict(parse_keys(&String::from_utf8_lossy(input)))
}

/// An error is one line without anything that would steer a terminal.
fn verdict<T>(result: Result<T>) -> Verdict {
    match result {
        Ok(_) => Verdict::Accepted,
        Err(error) => {
            let line = error.to_string();
            assert!(
                !line.is_empty() && !line.contains(char::is_control),
                "{line:?}"
            );
            assert!(line.chars().count() <= 601, "{line}");
            Verdict::Refused
        }
    }
}

#[test]
fn objs_and_mtls() {
    fuzz(&Parser {
        name: "OBJ and MTL",
        parse: parse_obj,
        seeds: OBJ_SEEDS,
        words: OBJ_WORDS,
        limits: Limits::default(),
    });
}

#[test]
fn scenes() {
    fuzz(&Parser {
        name: "scene",
        parse: parse_scene,
        seeds: SCENE_SEEDS,
        words: SCENE_WORDS,
        // A mesh_size may come out large all the same.
        limits: Limits {
            bytes: 1 << 30,
            time: Duration::from_secs(10),
        },
    });
}

#[test]
fn key_strings() {
    fuzz(&Parser {
        name: "key string",
        parse: parse_key_string,
        seeds: KEY_SEEDS,
        words: KEY_WORDS,
        limits: Limits::default(),
    });
}
