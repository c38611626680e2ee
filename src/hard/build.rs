//! What the cases are built of.

use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3, dvec3};

use crate::scene::{
    Beam, Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, rotate, shapes,
};

/// What receives, and what casts.
pub const GREY: DVec3 = DVec3::new(0.75, 0.74, 0.7);
pub const ORANGE: DVec3 = DVec3::new(0.9, 0.5, 0.2);

/// Without a texture and without gloss: only light and shadow are to be seen.
pub fn object(name: &str, mesh: Mesh, placement: DMat4, color: DVec3) -> Object {
    let material = Material {
        diffuse: color,
        specular: DVec3::ZERO,
        shininess: 1.0,
        texture: None,
    };
    Object::new(name, mesh, placement, material)
}

/// A closed box between two corners.
pub fn solid(name: &str, low: DVec3, high: DVec3, color: DVec3) -> Object {
    let placement = DMat4::from_translation((low + high) / 2.0) * DMat4::from_scale(high - low);
    object(name, shapes::cube(), placement, color)
}

/// The course's Plane, which has one side only.
pub fn sheet(name: &str, placement: DMat4, color: DVec3) -> Object {
    Object {
        plane: true,
        ..object(name, shapes::plane(1), placement, color)
    }
}

/// A Plane at y = 0 that looks upwards.
pub fn floor(half_width: f64) -> Object {
    let placement = lying() * DMat4::from_scale(dvec3(half_width, half_width, 1.0));
    sheet("floor", placement, GREY)
}

/// From +z, where a Plane looks, to +y.
pub fn lying() -> DMat4 {
    rotate(-90.0, DVec3::X)
}

pub fn at(position: DVec3) -> DMat4 {
    DMat4::from_translation(position)
}

/// Triangles that share nothing, each with its own normal; what has no area gets any.
pub fn soup(triangles: &[[DVec3; 3]]) -> Mesh {
    let normal = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).normalize_or(DVec3::Y);
    Mesh {
        positions: triangles.iter().flatten().copied().collect(),
        normals: triangles.iter().flat_map(|t| [normal(t); 3]).collect(),
        texture_coords: vec![DVec2::ZERO; 3 * triangles.len()],
        faces: (0..triangles.len() as u32)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect(),
    }
}

/// The same object with another mesh.
pub fn with_mesh(mut object: Object, change: impl FnOnce(&mut Mesh)) -> Object {
    change(Arc::make_mut(&mut object.mesh));
    object
}

/// Looks from `eye` at `target`; the field of view is vertical, in degrees.
pub fn camera(eye: DVec3, target: DVec3, fovy: f64) -> Camera {
    Camera {
        eye,
        look: target - eye,
        rup: DVec3::Y,
        fov: Fov::Vertical(fovy),
        near: 0.1,
        far: Some(100.0),
    }
}

/// A spot light with the near and far plane that most scenes of the labs have.
pub fn spot(position: DVec3, target: DVec3, cone: f64, beam: Beam) -> Light {
    lamp(LightKind::Spot { cone, beam }, position, target)
}

/// A point light, whose shadow map looks at `target`.
pub fn point(position: DVec3, target: DVec3, shadow_fov: f64) -> Light {
    lamp(LightKind::Point { shadow_fov }, position, target)
}

fn lamp(kind: LightKind, position: DVec3, target: DVec3) -> Light {
    Light {
        kind,
        position,
        direction: target - position,
        color: DVec3::ONE,
        near: 1.0,
        far: 30.0,
    }
}

/// Half the depth of the box of a directional light: as deep as the slides' own.
pub const SUN_REACH: f64 = 15.0;

/// A directional light from `towards`, with a box around the origin: left, right, bottom, top.
pub fn sun(towards: DVec3, area: [f64; 4]) -> Light {
    let towards = towards.normalize();
    Light {
        kind: LightKind::Directional { area },
        position: SUN_REACH * towards,
        direction: -towards,
        color: DVec3::ONE,
        near: 0.0,
        far: 2.0 * SUN_REACH,
    }
}

pub fn scene(camera: Camera, light: Light, objects: Vec<Object>) -> Scene {
    Scene {
        size: Some(super::SIZE),
        clear: dvec3(0.62, 0.78, 0.92),
        camera,
        lights: vec![light],
        ambient: DVec3::splat(0.25),
        sky: None,
        objects,
    }
}
