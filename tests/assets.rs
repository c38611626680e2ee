//! The committed assets are what the scenes expect: the lighthouse's parts, solids and texture, and the pictures.

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

fn lighthouse() -> Vec<Part> {
    load(&asset("lighthouse.obj")).unwrap_or_else(|error| panic!("{error}"))
}

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
fn the_lighthouse_has_its_parts_and_its_texture() {
    let parts = lighthouse();
    let names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    let expected = [
        "base", "tower", "gallery", "railing", "lantern", "lamp", "roof", "finial",
    ];
    assert_eq!(names, expected);
    for part in &parts {
        let texture = part.material.as_ref().unwrap().texture.as_ref();
        assert_eq!(texture.is_some(), part.name == "tower", "{}", part.name);
        if let Some(texture) = texture {
            assert_eq!(texture.dimensions(), (256, 256));
        }
    }
    let faces: usize = parts.iter().map(|part| part.mesh.faces.len()).sum();
    assert!((1000..=2600).contains(&faces), "{faces}");
}

#[test]
fn the_lighthouse_stands_upright_at_the_origin() {
    let parts = lighthouse();
    let positions = || {
        parts
            .iter()
            .flat_map(|part| part.mesh.positions.iter().copied())
    };
    let low = positions().reduce(DVec3::min).unwrap();
    let high = positions().reduce(DVec3::max).unwrap();
    assert_eq!((low.y, high.y), (0.0, 2.0));
    assert!(low.x > -0.7 && low.z > -0.7 && high.x < 0.7 && high.z < 0.7);
}

#[test]
fn the_solids_are_closed_and_face_outwards() {
    for part in lighthouse() {
        assert_eq!(open_edges(&part.mesh), 0, "{}", part.name);
        assert_eq!(turned_away(&part.mesh), 0, "{}", part.name);
        assert!(volume(&part.mesh) > 0.0, "{}", part.name);
    }
}

/// The control: a face that is turned round or left out is noticed.
#[test]
fn a_damaged_solid_is_noticed() {
    let mut mesh = lighthouse().swap_remove(1).mesh;
    mesh.faces[0].swap(0, 1);
    assert_eq!(turned_away(&mesh), 1);
    assert!(open_edges(&mesh) > 0);
    mesh.faces.remove(0);
    assert_eq!(open_edges(&mesh), 3);
}

#[test]
fn the_pictures_have_their_sizes() {
    for (name, size) in [
        ("floor.png", (512, 512)),
        ("sky.png", (512, 256)),
        ("painting.png", (256, 256)),
        ("crate.png", (256, 256)),
        ("lighthouse.png", (256, 256)),
    ] {
        let picture = image::open(asset(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((picture.width(), picture.height()), size, "{name}");
    }
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
    change(width - 1) > 3 * mean
}

#[test]
fn floor_and_sky_have_no_seam() {
    let floor = image::open(asset("floor.png")).unwrap().to_rgb8();
    let sky = image::open(asset("sky.png")).unwrap().to_rgb8();
    let floor_on_its_side = image::imageops::rotate90(&floor);
    for picture in [floor, sky, floor_on_its_side] {
        assert!(!has_seam(&picture));
        // The control: a part of the picture does have one.
        let part = image::imageops::crop_imm(&picture, 0, 0, 300, picture.height()).to_image();
        assert!(has_seam(&part));
    }
}
