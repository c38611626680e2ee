//! The default scene. The course leaves the scene to each student: this one was chosen to show every requirement of
//! the handout at once.

use std::path::Path;
use std::sync::Arc;

use glam::{DMat4, DVec3, dvec3};
use image::RgbaImage;

use crate::scene::{
    Beam, Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, Spin, obj, rotate, shapes,
};
use crate::{Error, Result};

/// The course's constants.
const MESH_SIZE: u32 = 20;
const THICKNESS: f64 = 0.5;

pub fn default_scene() -> Result<Scene> {
    let up = DVec3::X;
    let mut objects = vec![
        // A textured Plane for the shadows to fall on: 20 × 20, turned so that its normal is +y.
        Object {
            plane: true,
            ..Object::new(
                "floor",
                repeated(shapes::plane(MESH_SIZE), 3.0),
                rotate(-90.0, up) * DMat4::from_scale(dvec3(10.0, 10.0, 1.0)),
                textured(floor()?, DVec3::splat(0.1), 20.0),
            )
        },
        // A textured Plane that casts: with front face culling it loses its shadow, second_plane brings it back.
        Object {
            plane: true,
            ..Object::new(
                "painting",
                shapes::plane(MESH_SIZE),
                DMat4::from_translation(dvec3(-3.5, 1.25, -1.2)) * rotate(35.0, DVec3::Y),
                textured(
                    decode(
                        "painting.png",
                        include_bytes!("../../../assets/painting.png"),
                    )?,
                    DVec3::ZERO,
                    1.0,
                ),
            )
        },
        Object::new(
            "crate",
            shapes::cube(),
            DMat4::from_translation(dvec3(3.1, 0.7, -1.6))
                * rotate(25.0, DVec3::Y)
                * DMat4::from_scale(DVec3::splat(1.4)),
            textured(
                decode("crate.png", include_bytes!("../../../assets/crate.png"))?,
                DVec3::splat(0.1),
                10.0,
            ),
        ),
        Object::new(
            "sphere",
            shapes::sphere(MESH_SIZE),
            DMat4::from_translation(dvec3(1.9, 0.7, 1.3)) * DMat4::from_scale(DVec3::splat(0.7)),
            plain(dvec3(0.75, 0.15, 0.12), 60.0),
        ),
        Object::new(
            "teapot",
            shapes::teapot(8),
            DMat4::from_translation(dvec3(-1.4, 0.0, 1.4))
                * rotate(-35.0, DVec3::Y)
                * rotate(-90.0, up)
                * DMat4::from_scale(DVec3::splat(0.42)),
            plain(dvec3(0.2, 0.45, 0.6), 40.0),
        ),
        // The rotating object.
        Object {
            spin: Some(Spin {
                axis: DVec3::X,
                degrees_per_second: 45.0,
            }),
            ..Object::new(
                "torus",
                shapes::torus(THICKNESS, MESH_SIZE),
                DMat4::from_translation(dvec3(1.2, 2.3, -0.6))
                    * rotate(30.0, DVec3::Y)
                    * DMat4::from_scale(DVec3::splat(0.8)),
                plain(dvec3(0.85, 0.65, 0.15), 80.0),
            )
        },
    ];
    objects.extend(lighthouse()?);
    Ok(Scene {
        size: None,
        clear: DVec3::ZERO,
        camera: Camera {
            eye: dvec3(0.4, 5.0, 9.4),
            look: dvec3(-0.4, -4.3, -9.4),
            rup: DVec3::Y,
            fov: Fov::Horizontal(50.0),
            near: 0.1,
            far: Some(100.0),
        },
        lights: vec![Light {
            kind: LightKind::Spot {
                cone: 60.0,
                beam: Beam::Rectangular,
            },
            position: dvec3(3.5, 7.5, 4.0),
            direction: dvec3(-3.7, -7.3, -4.2),
            color: DVec3::splat(0.95),
            near: 2.0,
            far: 20.0,
        }],
        ambient: DVec3::splat(0.25),
        sky: Some(decode(
            "sky.png",
            include_bytes!("../../../assets/sky.png"),
        )?),
        objects,
    })
}

/// The textured OBJ model, with the materials of its MTL file.
fn lighthouse() -> Result<Vec<Object>> {
    let parts = obj::parse(
        Path::new("lighthouse.obj"),
        include_bytes!("../../../assets/lighthouse.obj"),
        |name| match name {
            "lighthouse.mtl" => Ok(include_bytes!("../../../assets/lighthouse.mtl").to_vec()),
            "lighthouse.png" => Ok(include_bytes!("../../../assets/lighthouse.png").to_vec()),
            other => unreachable!("{other} is not one of the model's files"),
        },
    )?;
    let placement =
        DMat4::from_translation(dvec3(-0.9, 0.0, -2.6)) * DMat4::from_scale(DVec3::splat(1.75));
    let placed = |part: obj::Part| {
        let material = part.material.unwrap_or_default();
        Object::new(&part.name, part.mesh, placement, material)
    };
    Ok(parts.into_iter().map(placed).collect())
}

/// The mesh with its picture repeated `times` along each side.
fn repeated(mut mesh: Mesh, times: f64) -> Mesh {
    for uv in &mut mesh.texture_coords {
        *uv *= times;
    }
    mesh
}

fn plain(diffuse: DVec3, shininess: f64) -> Material {
    Material {
        diffuse,
        specular: DVec3::splat(0.6),
        shininess,
        texture: None,
    }
}

fn textured(texture: Arc<RgbaImage>, specular: DVec3, shininess: f64) -> Material {
    Material {
        diffuse: DVec3::ONE,
        specular,
        shininess,
        texture: Some(texture),
    }
}

fn floor() -> Result<Arc<RgbaImage>> {
    decode("floor.png", include_bytes!("../../../assets/floor.png"))
}

fn decode(name: &str, bytes: &[u8]) -> Result<Arc<RgbaImage>> {
    let picture = image::load_from_memory(bytes);
    let picture = picture.map_err(|error| Error::input(name, None, error.to_string()))?;
    Ok(Arc::new(picture.into_rgba8()))
}
