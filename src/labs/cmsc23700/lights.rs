//! "Lights": what is computed of each at start-up, since the lights do not move.

use glam::{DMat3, DMat4, DVec3};

use super::{DIRECTIONAL, SPOT};
use crate::gl::Program;
use crate::scene::{Camera, Light, LightKind, Scene, camera};

/// A light's ambient part, of its color. The course's later edition has the intensity 1 and 0.25 of ambient.
pub const AMBIENT: f64 = 0.25;
/// How the spotlight weakens: towards the edge of its cone, and with the distance (constant, linear, quadratic).
pub const SPOT_EXPONENT: f64 = 2.0;
pub const SPOT_ATTENUATION: DVec3 = DVec3::new(1.0, 0.05, 0.02);

/// A light as the camera of its shadow map.
pub struct LightCamera {
    pub position: DVec3,
    /// World space, its origin moved to the light, to the light's view.
    pub model_view: DMat4,
    pub projection: DMat4,
    /// "The texture matrix needed to map eye-space vertices to the light's clipping space", and from there to 0…1.
    pub texture_matrix: DMat4,
}

impl LightCamera {
    pub fn new(light: &Light, camera: &Camera) -> Self {
        let model_view = camera::view(
            DVec3::ZERO,
            light.direction,
            camera::up_for(light.direction),
        );
        let projection = match light.kind {
            // "For the directional light, you will need to use an orthographic projection."
            LightKind::Directional { area } => camera::orthographic(area, light.near, light.far),
            // The square map just holds the round cone.
            LightKind::Spot { cone, .. } => {
                camera::perspective(cone, 1.0, light.near, Some(light.far))
            }
            LightKind::Point { .. } => unreachable!("a scene with a point light was refused"),
        };
        let from_eye_space = camera::view(DVec3::ZERO, camera.look, camera.rup).inverse();
        let to_light = DMat4::from_translation(camera.eye - light.position);
        Self {
            position: light.position,
            model_view,
            projection,
            texture_matrix: to_texture() * projection * model_view * to_light * from_eye_space,
        }
    }

    /// Object space to the light's clipping space.
    pub fn model_view_projection(&self, model: DMat4) -> DMat4 {
        // DEVIATES: origin, the products are made in f64 and rounded once, and the world's origin is moved to the light:
        // far from it the f32 products would cancel.
        self.projection * self.model_view * DMat4::from_translation(-self.position) * model
    }
}

/// Clipping space, −1…1, to texture coordinates and stored depths, 0…1.
pub fn to_texture() -> DMat4 {
    let half = DVec3::splat(0.5);
    DMat4::from_translation(half) * DMat4::from_scale(half)
}

/// Where a program finds the eye-space vertices' way to the maps, and the maps.
pub const SHADOW_TEST: [&str; 6] = [
    "directionalTextureMatrix",
    "spotTextureMatrix",
    "directionalMap",
    "spotMap",
    "directionalBias",
    "spotBias",
];

/// The cone of light.
pub const CONE: [&str; 3] = ["spotPosition", "spotDirection", "spotCosCutoff"];

/// What of the lights never changes, for a program with the shadow test, which must be in use.
pub fn set_shadow_test(
    gl: &glow::Context,
    program: &Program,
    scene: &Scene,
    cameras: &[LightCamera; 2],
) {
    let [directional_camera, spot_camera] = cameras;
    program.set(
        gl,
        "directionalTextureMatrix",
        directional_camera.texture_matrix,
    );
    program.set(gl, "spotTextureMatrix", spot_camera.texture_matrix);
    program.set(gl, "directionalMap", DIRECTIONAL as i32);
    program.set(gl, "spotMap", SPOT as i32);
    set_cone(gl, program, scene);
}

/// The cone of light, for a program that asks whether something is within it, which must be in use.
pub fn set_cone(gl: &glow::Context, program: &Program, scene: &Scene) {
    let spot = &scene.lights[SPOT];
    program.set(gl, "spotPosition", spot_position(scene));
    program.set(gl, "spotDirection", in_eye_space(scene, spot.direction));
    program.set(gl, "spotCosCutoff", cos_cutoff(spot));
}

/// Uniforms of the lighting alone.
pub const LIGHTING: [&str; 8] = [
    "A",
    "directionalAmbient",
    "directionalDiffuse",
    "directionalDirection",
    "spotAmbient",
    "spotDiffuse",
    "spotExponent",
    "spotAttenuation",
];

/// The lights' colors and the global ambient level, for the program that lights, which must be in use.
pub fn set_lighting(gl: &glow::Context, program: &Program, scene: &Scene) {
    let [directional, spot] = [DIRECTIONAL, SPOT].map(|light| &scene.lights[light]);
    let to_light = -in_eye_space(scene, directional.direction);
    program.set(gl, "A", scene.ambient);
    program.set(gl, "directionalAmbient", AMBIENT * directional.color);
    program.set(gl, "directionalDiffuse", directional.color);
    program.set(gl, "directionalDirection", to_light);
    program.set(gl, "spotAmbient", AMBIENT * spot.color);
    program.set(gl, "spotDiffuse", spot.color);
    program.set(gl, "spotExponent", SPOT_EXPONENT);
    program.set(gl, "spotAttenuation", SPOT_ATTENUATION);
}

/// Half the cone's angle is the cut-off.
pub fn cos_cutoff(light: &Light) -> f64 {
    match light.kind {
        LightKind::Spot { cone, .. } => (cone.to_radians() / 2.0).cos(),
        _ => unreachable!("the second light is a spotlight"),
    }
}

pub fn spot_position(scene: &Scene) -> DVec3 {
    let camera = &scene.camera;
    let from_eye = scene.lights[SPOT].position - camera.eye;
    DMat3::from_mat4(camera.view()) * from_eye
}

/// A direction of the world, with length 1.
pub fn in_eye_space(scene: &Scene, direction: DVec3) -> DVec3 {
    (DMat3::from_mat4(scene.camera.view()) * direction).normalize()
}
