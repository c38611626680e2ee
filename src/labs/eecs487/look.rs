//! What a frame shows: the picture's colors, or those of the visibility.

use glam::DVec3;

use super::Eecs487;
use super::scene::Wall;
use crate::gl::Program;
use crate::labs::Show;

/// What of its light a shadow leaves a wall.
const SHADOW: f64 = 0.3;

/// The colors of a picture, or of the visibility: there everything is white but the shadows.
pub struct Look {
    pub clear: DVec3,
    pub ambient: DVec3,
    pub diffuse: DVec3,
    /// All surfaces are white, and shadows black.
    white: bool,
}

impl Look {
    pub fn material(&self, color: DVec3) -> DVec3 {
        if self.white { DVec3::ONE } else { color }
    }

    /// The wall's color, darker and unlit.
    pub fn shadow(&self, wall: &Wall) -> DVec3 {
        if self.white {
            DVec3::ZERO
        } else {
            SHADOW * wall.color
        }
    }
}

impl Eecs487 {
    pub(super) fn look(&self, show: Show) -> Look {
        match show {
            Show::Picture | Show::FlatMap { .. } => Look {
                clear: self.scene.clear,
                ambient: self.scene.ambient,
                diffuse: self.scene.lights[0].color,
                white: false,
            },
            Show::Visibility { .. } => Look {
                clear: DVec3::ONE,
                ambient: DVec3::ONE,
                diffuse: DVec3::ZERO,
                white: true,
            },
        }
    }
}

/// The light's and the room's part of the lighting.
pub fn set_light(gl: &glow::Context, program: &Program, look: &Look) {
    program.set(gl, "ambient", look.ambient);
    program.set(gl, "diffuse", look.diffuse);
}
