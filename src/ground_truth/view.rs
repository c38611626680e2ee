//! The camera as the rays see it.

use glam::{DVec2, DVec3};

use super::Ray;
use crate::scene::Camera;

/// The camera's rays, from its fields; the eye is the origin.
pub struct View {
    forward: DVec3,
    /// Half the picture's width and height at distance 1, as vectors.
    right: DVec3,
    up: DVec3,
    camera: Camera,
    pub near: f64,
    pub far: f64,
}

impl View {
    pub fn new(camera: &Camera) -> Self {
        let forward = camera.look.normalize();
        let right = forward.cross(camera.rup).normalize();
        Self {
            forward,
            right,
            up: right.cross(forward),
            camera: *camera,
            near: camera.near,
            far: camera.far.unwrap_or(f64::INFINITY),
        }
    }

    /// The ray through a place of the picture; its `t` is the depth along the look, as near and far measure it.
    pub fn ray(&self, [width, height]: [u32; 2], place: DVec2) -> Ray {
        let (width, height) = (f64::from(width), f64::from(height));
        let aspect = width / height;
        let slope = (self.camera.fov.horizontal(aspect).to_radians() / 2.0).tan();
        let x = slope * (2.0 * place.x / width - 1.0);
        let y = slope / aspect * (1.0 - 2.0 * place.y / height);
        Ray::new(DVec3::ZERO, self.forward + x * self.right + y * self.up)
    }
}
