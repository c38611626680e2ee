//! The committed assets are what the scenes expect: models of whole solids with their textures, and the pictures.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DVec3;
use image::RgbImage;
use shadowlab::scene::Mesh;
use shadowlab::scene::obj::{Part, load};

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("assets")
        .join(name)
}

fn parts(name: &str) -> Vec<Part> {
    load(&asset(name)).unwrap_or_else(|error| panic!("{error}"))
}

struct Model {
    file: &'static str,
    /// Each part, and the width and height of its texture.
    parts: &'static [(&'static str, Option<(u32, u32)>)],
    /// How many faces it has at least, and at most.
    faces: [usize; 2],
    /// The corners of its box.
    low: [f64; 3],
    high: [f64; 3],
}

const MODELS: &[Model] = &[
    Model {
        file: "lighthouse.obj",
        parts: &[
            ("base", None),
            ("tower", Some((256, 256))),
            ("gallery", None),
            ("railing", None),
            ("lantern", None),
            ("lamp", None),
            ("roof", None),
            ("finial", None),
        ],
        faces: [1000, 2600],
        low: [-0.48, 0.0, -0.48],
        high: [0.48, 2.0, 0.62],
    },
    // The box of the course's own dolphin, so that the course's matrices fit.
    Model {
        file: "csci3260/dolphin.obj",
        parts: &[("dolphin", Some((512, 512)))],
        faces: [8_000, 15_000],
        low: [-41.1, -111.5, 1.0],
        high: [41.1, 66.0, 153.2],
    },
    Model {
        file: "aueb7/terrain.obj",
        parts: &[
            ("ground", Some((256, 256))),
            ("rocks", None),
            ("trunk", None),
            ("leaves", None),
        ],
        faces: [4_000, 10_000],
        low: [-8.83, -0.6, -9.36],
        high: [9.01, 3.22, 9.01],
    },
    Model {
        file: "aueb7/skeleton.obj",
        parts: &[
            ("skull", Some((128, 128))),
            ("sockets", None),
            ("trunk", Some((128, 128))),
            ("arms", Some((128, 128))),
            ("legs", Some((128, 128))),
            ("blade", None),
            ("hilt", None),
        ],
        faces: [3_000, 8_000],
        low: [-2.0, 0.0, -1.64],
        high: [3.02, 9.94, 0.71],
    },
    Model {
        file: "aueb7/treasure.obj",
        parts: &[
            ("chest", Some((256, 256))),
            ("lid", Some((256, 256))),
            ("bands", None),
            ("hoard", Some((256, 256))),
            ("coins", Some((256, 256))),
            ("gems", None),
        ],
        faces: [3_000, 8_000],
        low: [-10.58, 0.0, -11.74],
        high: [10.58, 18.56, 12.12],
    },
    Model {
        file: "aueb7/palace.obj",
        parts: &[
            ("ground", Some((256, 256))),
            ("terraces", None),
            ("masonry", None),
            ("walls", Some((256, 256))),
            ("frescoes", Some((256, 256))),
            ("shafts", None),
            ("capitals", None),
            ("openings", None),
        ],
        faces: [10_000, 30_000],
        low: [-35.0, 0.0, -22.5],
        high: [35.0, 25.0, 22.5],
    },
];

/// How a picture goes on beyond its edges.
#[derive(Clone, Copy, PartialEq)]
enum Repeats {
    No,
    Across,
    BothWays,
}

const PICTURES: &[(&str, (u32, u32), Repeats)] = &[
    ("floor.png", (512, 512), Repeats::BothWays),
    ("sky.png", (512, 256), Repeats::Across),
    ("painting.png", (256, 256), Repeats::No),
    ("crate.png", (256, 256), Repeats::No),
    ("lighthouse.png", (256, 256), Repeats::Across),
    ("csci3260/dolphin_01.png", (512, 512), Repeats::No),
    ("csci3260/dolphin_02.png", (512, 512), Repeats::No),
    ("csci3260/sea_01.png", (512, 512), Repeats::BothWays),
    ("csci3260/sea_02.png", (512, 512), Repeats::BothWays),
    ("aueb7/ball_01.png", (256, 256), Repeats::Across),
    ("aueb7/ball_02.png", (256, 256), Repeats::Across),
    ("aueb7/sand.png", (256, 256), Repeats::BothWays),
    ("aueb7/bone.png", (128, 128), Repeats::BothWays),
    ("aueb7/wood.png", (256, 256), Repeats::BothWays),
    ("aueb7/gold.png", (256, 256), Repeats::BothWays),
    ("aueb7/wall.png", (256, 256), Repeats::Across),
    ("aueb7/fresco.png", (256, 256), Repeats::Across),
    ("aueb7/paving.png", (256, 256), Repeats::BothWays),
];

/// The faces with a vertex normal that points to their other side. NaN counts.
fn turned_away(mesh: &Mesh) -> usize {
    let against = |face: &&[u32; 3]| {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        let normal = (b - a).cross(c - a);
        let agrees = |&i: &u32| normal.dot(mesh.normals[i as usize]) > 0.0;
        !face.iter().all(agrees)
    };
    mesh.faces.iter().filter(against).count()
}

/// The directed edges that are not matched by exactly one edge the other way.
fn open_edges(mesh: &Mesh) -> usize {
    let mut edges = HashMap::new();
    for face in &mesh.faces {
        let corners = face.map(|i| mesh.positions[i as usize].to_array().map(f64::to_bits));
        for i in 0..3 {
            *edges.entry([corners[i], corners[(i + 1) % 3]]).or_insert(0) += 1;
        }
    }
    let open = |(edge, count): &(&[[u64; 3]; 2], &i32)| {
        **count != 1 || edges.get(&[edge[1], edge[0]]) != Some(&1)
    };
    edges.iter().filter(open).count()
}

/// Six times the volume inside: positive where the faces are seen from outside.
fn volume(mesh: &Mesh) -> f64 {
    let cone = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        a.dot(b.cross(c))
    };
    mesh.faces.iter().map(cone).sum()
}

#[test]
fn the_models_have_their_parts_and_their_textures() {
    for model in MODELS {
        let parts = parts(model.file);
        let found: Vec<_> = parts
            .iter()
            .map(|part| {
                let texture = part.material.as_ref().unwrap().texture.as_ref();
                (part.name.as_str(), texture.map(|t| t.dimensions()))
            })
            .collect();
        assert_eq!(found, model.parts, "{}", model.file);
        let faces: usize = parts.iter().map(|part| part.mesh.faces.len()).sum();
        let [least, most] = model.faces;
        assert!((least..=most).contains(&faces), "{}: {faces}", model.file);
    }
}

#[test]
fn the_models_fill_their_boxes() {
    for model in MODELS {
        let parts = parts(model.file);
        let positions = || parts.iter().flat_map(|part| part.mesh.positions.iter());
        let low = positions().copied().reduce(DVec3::min).unwrap();
        let high = positions().copied().reduce(DVec3::max).unwrap();
        let off = (low - DVec3::from(model.low)).abs() + (high - DVec3::from(model.high)).abs();
        // The tables hold two decimals.
        assert!(off.max_element() < 0.011, "{}: {low} {high}", model.file);
    }
}

#[test]
fn the_solids_are_closed_and_face_outwards() {
    for model in MODELS {
        for part in parts(model.file) {
            let name = format!("{}: {}", model.file, part.name);
            assert_eq!(open_edges(&part.mesh), 0, "{name}");
            assert_eq!(turned_away(&part.mesh), 0, "{name}");
            assert!(volume(&part.mesh) > 0.0, "{name}");
        }
    }
}

/// The control: a face that is turned round or left out is noticed.
#[test]
fn a_damaged_solid_is_noticed() {
    let mut mesh = parts("lighthouse.obj").swap_remove(1).mesh;
    mesh.faces[0].swap(0, 1);
    assert_eq!(turned_away(&mesh), 1);
    assert!(open_edges(&mesh) > 0);
    mesh.faces.remove(0);
    assert_eq!(open_edges(&mesh), 3);
}

fn picture(name: &str) -> RgbImage {
    let picture = image::open(asset(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    picture.to_rgb8()
}

#[test]
fn the_pictures_have_their_sizes() {
    for &(name, size, _) in PICTURES {
        assert_eq!(picture(name).dimensions(), size, "{name}");
    }
}

/// Every file, by its path in the folder; folders end in a slash.
fn files(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(asset(folder)).unwrap();
    entries
        .flat_map(|entry| {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if asset(folder).join(&name).is_dir() {
                files(&format!("{folder}{name}/"))
            } else {
                vec![format!("{folder}{name}")]
            }
        })
        .collect()
}

/// No file without a test and a line about its origin; all together stay a small download.
#[test]
fn every_file_is_known() {
    let readme = std::fs::read_to_string(asset("README.md")).unwrap();
    let mut bytes = 0;
    for file in files("") {
        bytes += std::fs::metadata(asset(&file)).unwrap().len();
        let name = file.rsplit('/').next().unwrap();
        let tested = PICTURES.iter().any(|picture| picture.0 == file)
            || MODELS
                .iter()
                .any(|model| model.file.replace(".obj", "") == file[..file.len() - 4]);
        // Scenes are drawn by the goldens; the README's plot is the report's.
        assert!(
            tested
                || name == "README.md"
                || name.ends_with(".toml")
                || name == "speed_against_error.png",
            "{file}"
        );
        assert!(
            name == "README.md" || readme.contains(&format!("`{name}`")),
            "{file}"
        );
    }
    assert!(bytes < 6_000_000, "{bytes}");
}

/// Whether the picture, laid beside itself, changes much more at the seam than inside it on average.
fn has_seam(picture: &RgbImage) -> bool {
    let width = picture.width();
    let change = |x: u32| -> u32 {
        let in_row = |y| {
            let (here, next) = (picture[(x, y)], picture[((x + 1) % width, y)]);
            (0..3)
                .map(|i| u32::from(here[i].abs_diff(next[i])))
                .sum::<u32>()
        };
        (0..picture.height()).map(in_row).sum()
    };
    let mean = (0..width - 1).map(change).sum::<u32>() / (width - 1);
    2 * change(width - 1) > 5 * mean
}

#[test]
fn pictures_that_repeat_have_no_seam() {
    for &(name, _, repeats) in PICTURES {
        let upright = picture(name);
        let on_its_side = image::imageops::rotate90(&upright);
        let both = [upright, on_its_side];
        let sides = match repeats {
            Repeats::No => &both[..0],
            Repeats::Across => &both[..1],
            Repeats::BothWays => &both[..],
        };
        for side in sides {
            assert!(!has_seam(side), "{name}");
            // The control: a part of the picture does have one.
            let (width, height) = side.dimensions();
            let part = image::imageops::crop_imm(side, 0, 0, width * 300 / 512, height).to_image();
            assert!(has_seam(&part), "{name}");
        }
    }
}
