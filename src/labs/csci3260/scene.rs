//! The course's scene, a dolphin over the sea, and a room after the slides' pictures of what goes wrong.

use glam::{DMat4, DVec3, dvec3};

use super::models::{File, load_obj, load_texture};
use crate::Result;
use crate::scene::{Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, rotate, shapes};

const DOLPHIN: &[File] = &[
    (
        "dolphin.obj",
        include_bytes!("../../../assets/csci3260/dolphin.obj"),
    ),
    (
        "dolphin.mtl",
        include_bytes!("../../../assets/csci3260/dolphin.mtl"),
    ),
    (
        "dolphin_01.png",
        include_bytes!("../../../assets/csci3260/dolphin_01.png"),
    ),
];
const DOLPHIN_02: File = (
    "dolphin_02.png",
    include_bytes!("../../../assets/csci3260/dolphin_02.png"),
);
const SEA_01: File = (
    "sea_01.png",
    include_bytes!("../../../assets/csci3260/sea_01.png"),
);
const SEA_02: File = (
    "sea_02.png",
    include_bytes!("../../../assets/csci3260/sea_02.png"),
);

/// The second texture of the course's models; the first is their material's.
pub fn second_texture(model: &str) -> Option<File> {
    match model {
        "dolphin" => Some(DOLPHIN_02),
        "sea" => Some(SEA_02),
        _ => None,
    }
}

pub fn course() -> Result<Scene> {
    // Leaping across the picture, its shadow on the water beneath.
    let placement = DMat4::from_translation(dvec3(0.1, -0.65, 3.4))
        * rotate(65.0, DVec3::Y)
        * rotate(-90.0, DVec3::X)
        * DMat4::from_scale(DVec3::splat(0.01));
    let mut objects = load_obj("dolphin", DOLPHIN, placement)?;
    objects.push(Object::new(
        "sea",
        repeated(shapes::cube(), 4.0),
        cuboid(dvec3(-10.0, -2.0, -8.0), dvec3(10.0, -1.0, 8.0)),
        Material {
            diffuse: DVec3::ONE,
            specular: DVec3::splat(0.3),
            shininess: 50.0,
            texture: Some(load_texture(SEA_01)?),
        },
    ));
    Ok(Scene {
        size: None,
        clear: dvec3(0.62, 0.78, 0.92),
        camera: Camera {
            eye: dvec3(0.0, 2.0, 7.7),
            look: dvec3(0.0, -1.0, 0.0) - dvec3(0.0, 2.0, 7.7),
            rup: DVec3::Y,
            fov: Fov::Vertical(45.0),
            near: 0.1,
            far: Some(100.0),
        },
        lights: vec![light()],
        ambient: DVec3::splat(0.25),
        sky: None,
        objects,
    })
}

/// The slides' light: looks from `lightInvDir` at the origin, with an orthographic box "that will encompass everything".
fn light() -> Light {
    let light_inv_dir = dvec3(0.5, 2.0, 2.0);
    Light {
        kind: LightKind::Directional {
            area: [-10.0, 10.0, -10.0, 10.0],
        },
        position: light_inv_dir,
        direction: -light_inv_dir,
        color: DVec3::splat(0.9),
        near: -10.0,
        far: 20.0,
    }
}

/// A flat ground for acne, curved surfaces that a constant bias serves worse, and a thin wall for Peter Panning. The
/// camera stands where the shadows fall to, and sees where they begin.
pub fn room() -> Scene {
    let objects = vec![
        Object::new(
            "ground",
            shapes::cube(),
            cuboid(dvec3(-5.0, -0.5, -5.0), dvec3(5.0, 0.0, 5.0)),
            plain(dvec3(0.8, 0.78, 0.72), 0.0),
        ),
        Object::new(
            WALL,
            shapes::cube(),
            cuboid(dvec3(0.5, 0.0, -1.31), dvec3(2.9, 1.3, -1.29)),
            plain(dvec3(0.85, 0.6, 0.4), 0.0),
        ),
        Object::new(
            "teapot",
            shapes::teapot(10),
            DMat4::from_translation(dvec3(-0.75, 0.0, 0.7))
                * rotate(200.0, DVec3::Y)
                * rotate(-90.0, DVec3::X)
                * DMat4::from_scale(DVec3::splat(0.4)),
            plain(dvec3(0.2, 0.5, 0.65), 0.4),
        ),
        Object::new(
            "sphere",
            shapes::sphere(24),
            DMat4::from_translation(dvec3(1.5, 0.7, 0.9)) * DMat4::from_scale(DVec3::splat(0.7)),
            plain(dvec3(0.75, 0.2, 0.15), 0.4),
        ),
    ];
    Scene {
        size: None,
        clear: dvec3(0.62, 0.78, 0.92),
        camera: Camera {
            eye: dvec3(-4.4, 3.0, -2.4),
            look: dvec3(0.2, 0.25, 0.0) - dvec3(-4.4, 3.0, -2.4),
            rup: DVec3::Y,
            fov: Fov::Vertical(45.0),
            near: 0.1,
            far: Some(100.0),
        },
        lights: vec![light()],
        ambient: DVec3::splat(0.25),
        sky: None,
        objects,
    }
}

const WALL: &str = "wall";
/// How many times as thick the wall is where thin geometry is avoided.
const THICKER: f64 = 20.0;

/// "Simply avoid thin geometry": the room's wall, the same but thick.
pub fn thickened(object: &Object) -> DMat4 {
    if object.name == WALL {
        object.placement * DMat4::from_scale(dvec3(1.0, 1.0, THICKER))
    } else {
        object.placement
    }
}

/// A cube of edge 1 around the origin to the box between two corners.
fn cuboid(low: DVec3, high: DVec3) -> DMat4 {
    DMat4::from_translation((low + high) / 2.0) * DMat4::from_scale(high - low)
}

/// The mesh with its picture repeated `times` along each side.
fn repeated(mut mesh: Mesh, times: f64) -> Mesh {
    for uv in &mut mesh.texture_coords {
        *uv *= times;
    }
    mesh
}

fn plain(diffuse: DVec3, specular: f64) -> Material {
    Material {
        diffuse,
        specular: DVec3::splat(specular),
        shininess: 50.0,
        texture: None,
    }
}
