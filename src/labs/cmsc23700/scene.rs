//! The box and its two lights. Camera, box and colors are the course's, the lights were chosen.

use std::sync::Arc;

use glam::{DMat4, DVec3, dvec3};

use super::simulation::{COLORS, RADIUS, Simulation};
use crate::scene::{Beam, Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, shapes};
use crate::{Error, Result};

/// "The whole scene can be bounded by a sphere at the origin that has radius √3."
const BOUND: f64 = 1.732_050_807_568_877_2;
/// How finely a ball is cut.
const BALL_SIZE: u32 = 10;

/// The camera looks along +z, so that the viewer's left is +x.
pub fn the_box() -> Result<Scene> {
    let color = |red, green, blue| dvec3(red, green, blue) / 255.0;
    Ok(Scene {
        size: None,
        clear: dvec3(0.2, 0.2, 0.4),
        camera: Camera {
            eye: dvec3(0.0, 0.0, -3.0),
            look: DVec3::Z,
            rup: DVec3::Y,
            fov: Fov::Vertical(65.0),
            near: 1.9,
            far: Some(4.1),
        },
        lights: vec![directional(), spotlight()],
        ambient: DVec3::splat(0.2),
        sky: None,
        // "To allow light into the box, we have removed the top wall." The front is open, too.
        objects: vec![
            wall("bottom", DVec3::Y, DVec3::X, color(255.0, 63.0, 63.0)),
            wall("back", DVec3::NEG_Z, DVec3::NEG_X, color(63.0, 255.0, 63.0)),
            wall("left", DVec3::NEG_X, DVec3::Z, color(172.0, 63.0, 172.0)),
            wall("right", DVec3::X, DVec3::NEG_Z, color(63.0, 172.0, 172.0)),
        ],
    })
}

/// Mostly from above, so that the walls, which cast, leave most of the bottom in the light; a little from the viewer's
/// left, and from the front.
fn directional() -> Light {
    let to_light = dvec3(0.3, 1.0, -0.6).normalize();
    Light {
        kind: LightKind::Directional {
            area: [-BOUND, BOUND, -BOUND, BOUND],
        },
        position: BOUND * to_light,
        direction: -to_light,
        color: DVec3::splat(0.55),
        near: 0.0,
        far: 2.0 * BOUND,
    }
}

/// Above the open top and a little to the viewer's right, so that a ball's two shadows part.
fn spotlight() -> Light {
    let position = dvec3(-0.45, 2.3, -0.5);
    let target = dvec3(-0.1, -1.0, 0.1);
    let distance = position.length();
    Light {
        kind: LightKind::Spot {
            cone: 36.0,
            beam: Beam::Circular,
        },
        position,
        direction: target - position,
        color: DVec3::splat(0.6),
        near: distance - BOUND,
        far: distance + BOUND,
    }
}

/// One side of the box, seen from within; in the box's own coordinates, so that no wall has a matrix of its own.
fn wall(name: &str, normal: DVec3, right: DVec3, diffuse: DVec3) -> Object {
    let up = normal.cross(right);
    let mut mesh = shapes::plane(1);
    for (position, own) in mesh.positions.iter_mut().zip(&mut mesh.normals) {
        *position = position.x * right + position.y * up - normal;
        *own = normal;
    }
    let material = Material {
        diffuse,
        ..Material::default()
    };
    Object::new(name, mesh, DMat4::IDENTITY, material)
}

/// A ball around the origin.
pub fn ball() -> Mesh {
    let mut mesh = shapes::sphere(BALL_SIZE);
    for position in &mut mesh.positions {
        *position *= RADIUS;
    }
    mesh
}

/// The colors of the balls, oldest first, and again from the beginning.
pub fn ball_colors() -> impl Iterator<Item = DVec3> {
    let color = |color: &[u8; 3]| dvec3(color[0].into(), color[1].into(), color[2].into()) / 255.0;
    COLORS.iter().cycle().map(color)
}

/// The balls where they are now, each an object of its own.
pub fn balls(simulation: &Simulation, mesh: &Arc<Mesh>) -> impl Iterator<Item = Object> {
    let places = simulation.positions().zip(ball_colors());
    places.map(|(position, diffuse)| Object {
        name: "ball".to_owned(),
        mesh: Arc::clone(mesh),
        placement: DMat4::from_translation(position),
        spin: None,
        material: Material {
            diffuse,
            ..Material::default()
        },
        casts: true,
        receives: true,
        plane: false,
    })
}

/// "One light is a directional light and the other is a spotlight": a scene must have these, in this order.
pub fn check_lights(scene: &Scene) -> Result<()> {
    let kinds: Vec<_> = scene.lights.iter().map(|light| light.kind).collect();
    let found = match kinds[..] {
        [LightKind::Directional { .. }, LightKind::Spot { beam, .. }] => match beam {
            Beam::Circular => return Ok(()),
            Beam::Rectangular => "a spot light whose beam is rectangular".to_owned(),
        },
        _ => kinds.iter().map(kind_name).collect::<Vec<_>>().join(", "),
    };
    let other = match kinds[..] {
        [LightKind::Directional { .. }] => " (csci3260 draws a directional light alone)",
        [_] => " (cs541 draws a spot or point light alone)",
        _ => "",
    };
    let found = if found.is_empty() { "none" } else { &found };
    Err(Error::usage(format!(
        "found the lights: {found}; expected two: directional, then spot with a circular beam{other}"
    )))
}

fn kind_name(kind: &LightKind) -> &'static str {
    match kind {
        LightKind::Spot { .. } => "spot",
        LightKind::Point { .. } => "point",
        LightKind::Directional { .. } => "directional",
    }
}

/// The handout's lighting knows no textures: what a student's scene has of them is said to be missing.
pub fn note_textures(scene: &Scene) {
    for object in &scene.objects {
        if object.material.texture.is_some() {
            let name = crate::error::quoted(&object.name);
            eprintln!("note: cmsc23700 has no textures, {name} is drawn in its diffuse color");
        }
    }
}
