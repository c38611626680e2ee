//! The room with its five walls, torus and teapot, and the light that floats inside the torus.

use glam::{DMat4, DVec3, DVec4, dvec3};

use crate::scene::{Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, rotate, shapes};
use crate::{Error, Result};

/// The walls, in the order of the key `x`. A scene with an object for each of these names, a
/// [`shapes::plane`], is a room of its own.
pub const WALLS: [&str; 5] = ["floor", "left", "right", "ceiling", "rear"];

/// The sphere that is drawn around the light.
pub const LIGHT_RADIUS: f64 = 0.05;
pub const LIGHT_COLOR: DVec3 = dvec3(1.0, 1.0, 0.8);

/// A receiver.
pub struct Wall {
    pub name: &'static str,
    pub color: DVec3,
    /// The implicit function Ax + By + Cz + D = 0; (A, B, C) has length 1 and points into the room.
    pub plane: DVec4,
    /// From [−1, 1]² at z = 0.
    pub placement: DMat4,
}

impl Wall {
    /// Its place in the order of the key `x`.
    pub fn number(&self) -> usize {
        let place = WALLS.iter().position(|name| *name == self.name);
        place.expect("a wall is one of the five")
    }
}

pub fn course() -> Result<Scene> {
    let teapot = DMat4::from_translation(dvec3(-0.3, 0.16, 0.1))
        * DMat4::from_scale(DVec3::splat(0.5 * 0.16))
        * rotate(-90.0, DVec3::X);
    let objects = vec![
        Object::new(
            "torus",
            shapes::ring(0.05, 0.35, 16, 24),
            rotate(80.0, dvec3(1.0, 1.0, 0.0)),
            plain(dvec3(1.0, 0.5, 0.3)),
        ),
        Object::new(
            "teapot",
            solid_teapot(),
            teapot,
            plain(dvec3(0.5, 0.3, 1.0)),
        ),
    ];
    Ok(in_the_room(
        objects,
        Light {
            kind: LightKind::Point { shadow_fov: 90.0 },
            position: dvec3(0.05, 0.6, 0.2),
            direction: DVec3::NEG_Y,
            color: DVec3::ONE,
            near: 0.1,
            far: 10.0,
        },
    ))
}

/// `glutSolidTeapot`: around its middle, with seven quads along the edge of each patch.
fn solid_teapot() -> Mesh {
    let mut mesh = shapes::teapot(7);
    for position in &mut mesh.positions {
        position.z -= 1.5;
    }
    mesh
}

fn in_the_room(mut objects: Vec<Object>, light: Light) -> Scene {
    objects.extend(room());
    Scene {
        size: None,
        clear: dvec3(0.7, 0.8, 1.0),
        // glFrustum(-1, 1, -1, 1, 2, 7) and a step of 3 back: the near plane lies on the room's open side.
        camera: Camera {
            eye: dvec3(0.0, 0.0, 3.0),
            look: DVec3::NEG_Z,
            rup: DVec3::Y,
            fov: Fov::Vertical(2.0 * 0.5_f64.atan().to_degrees()),
            near: 2.0,
            far: Some(7.0),
        },
        lights: vec![light],
        // GL_LIGHT_MODEL_AMBIENT as GL has it from the start; the light has no ambient part.
        ambient: DVec3::splat(0.2),
        sky: None,
        objects,
    }
}

/// The walls of the cube [−1, 1]³, open to the front.
fn room() -> impl Iterator<Item = Object> {
    let walls = [
        (DVec3::Y, DVec3::X, dvec3(0.4, 0.8, 0.7)),
        (DVec3::X, DVec3::NEG_Z, dvec3(0.8, 0.7, 0.4)),
        (DVec3::NEG_X, DVec3::Z, dvec3(0.7, 0.8, 0.4)),
        (DVec3::NEG_Y, DVec3::X, dvec3(0.4, 0.7, 0.8)),
        (DVec3::Z, DVec3::X, dvec3(0.8, 0.4, 0.7)),
    ];
    WALLS
        .into_iter()
        .zip(walls)
        .map(|(name, (normal, right, color))| {
            let up = normal.cross(right);
            let placement = DMat4::from_cols(
                right.extend(0.0),
                up.extend(0.0),
                normal.extend(0.0),
                (-normal).extend(1.0),
            );
            Object {
                casts: false,
                ..Object::new(name, shapes::plane(1), placement, plain(color))
            }
        })
}

/// A student's scene: its objects and its light come into the room. A scene that is a room stays what it is.
pub fn with_room(scene: Scene) -> Result<Scene> {
    let [light] = &scene.lights[..] else {
        let found = scene.lights.len();
        return Err(Error::usage(format!(
            "the scene has {found} lights, expected 1: eecs487 has a single light source"
        )));
    };
    let found = match light.kind {
        LightKind::Point { .. } => None,
        LightKind::Spot { .. } => Some("spot"),
        LightKind::Directional { .. } => Some("directional"),
    };
    if let Some(found) = found {
        return Err(Error::usage(format!(
            "the scene has a {found} light, expected point: eecs487 projects from the place where the light floats"
        )));
    }
    let is_there = |name: &&str| scene.objects.iter().any(|object| object.name == **name);
    Ok(if WALLS.iter().all(is_there) {
        scene
    } else {
        in_the_room(scene.objects, scene.lights[0].clone())
    })
}

/// The walls of a scene that has them, and its other objects. A student's object may be called like a wall: those of the
/// room are the last ones.
pub fn split(objects: Vec<Object>) -> ([Wall; 5], Vec<Object>) {
    let place = |name: &&str| objects.iter().rposition(|object| object.name == **name);
    let places = WALLS.map(|name| place(&name).expect("a room has every wall"));
    let walls = std::array::from_fn(|i| {
        let object = &objects[places[i]];
        let normal = object.placement.z_axis.truncate().normalize();
        let d = -normal.dot(object.placement.w_axis.truncate());
        Wall {
            name: WALLS[i],
            color: object.material.diffuse,
            plane: normal.extend(d),
            placement: object.placement,
        }
    });
    let others = objects.into_iter().enumerate();
    let others = others.filter(|(i, _)| !places.contains(i));
    (walls, others.map(|(_, object)| object).collect())
}

/// A wall as the truth sees it, in as many quads as GL draws.
pub fn wall_object(wall: &Wall, mesh: Mesh) -> Object {
    Object {
        casts: false,
        ..Object::new(wall.name, mesh, wall.placement, plain(wall.color))
    }
}

/// The sphere around the light, which hides what is behind it and casts no shadow.
pub fn light_object(light: DVec3) -> Object {
    let placement = DMat4::from_translation(light) * DMat4::from_scale(DVec3::splat(LIGHT_RADIUS));
    Object {
        casts: false,
        receives: false,
        ..Object::new("light", light_mesh(), placement, plain(LIGHT_COLOR))
    }
}

/// Twenty slices, as in the course's `glutSolidSphere`.
pub fn light_mesh() -> Mesh {
    shapes::sphere(10)
}

fn plain(diffuse: DVec3) -> Material {
    Material {
        diffuse,
        specular: DVec3::ZERO,
        ..Material::default()
    }
}
