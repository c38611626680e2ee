//! What casts shadows: the torus and the teapot, and how they turn.

use glam::{DMat4, dvec3};

use crate::Result;
use crate::gl;
use crate::scene::{Object, Scene, rotate};

/// An occluder with its mesh on the GPU.
pub struct Occluder {
    pub object: Object,
    pub buffers: gl::Mesh,
}

impl Occluder {
    pub fn of(gl: &glow::Context, objects: Vec<Object>) -> Result<Vec<Self>> {
        let upload = |object: Object| {
            let buffers = gl::Mesh::new(gl, &object.name, &object.mesh)?;
            Ok(Self { object, buffers })
        };
        objects.into_iter().map(upload).collect()
    }

    /// Object space to world space after a rotation, in degrees: everything turns about the room's middle, the torus
    /// drifts, the teapot swings. The sines take the number as radians.
    pub fn model(&self, rotation: f64) -> DMat4 {
        let turn = rotate(rotation, dvec3(0.7, 1.0, -0.2))
            * rotate(0.434658 * rotation, dvec3(0.8, 0.1, 0.65));
        let placement = self.object.placement;
        match self.object.name.as_str() {
            "torus" => {
                let (x, y) = ((rotation / 80.0).sin(), (rotation / 100.0).sin());
                turn * DMat4::from_translation(dvec3(-0.3 * x, 0.3 * y, 0.0)) * placement
            }
            "teapot" => {
                let here = DMat4::from_translation(placement.w_axis.truncate());
                let swing = rotate(60.0 * (rotation / 60.0).sin(), dvec3(0.2, -0.6, -0.6));
                turn * here * swing * here.inverse() * placement
            }
            _ => turn * placement,
        }
    }
}

/// Adds the occluders to a scene, where they are now.
pub fn add_to(scene: &mut Scene, occluders: &[Occluder], rotation: f64) {
    let now = |occluder: &Occluder| Object {
        placement: occluder.model(rotation),
        spin: None,
        receives: false,
        ..occluder.object.clone()
    };
    scene.objects.extend(occluders.iter().map(now));
}
