//! The course's `Camera.h` and what a lab keeps of a camera.
//!
//! `view` and `perspective` are the functions that CS 541 hands out: the field of view is in degrees
//! and horizontal, the look is a direction and not a target.

use glam::{DMat4, DVec3, DVec4};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub eye: DVec3,
    /// A direction, of any length.
    pub look: DVec3,
    /// The relative up vector: need not be at right angles to `look`, but not along it.
    pub rup: DVec3,
    pub fov: Fov,
    pub near: f64,
    /// None: infinite, as the three-argument `perspective`.
    pub far: Option<f64>,
}

/// A field of view, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fov {
    /// As the course's `perspective` takes it.
    Horizontal(f64),
    /// As GLU and most others take it.
    Vertical(f64),
}

impl Fov {
    /// The horizontal angle in a picture that is `aspect` times as wide as high.
    pub fn horizontal(self, aspect: f64) -> f64 {
        match self {
            Self::Horizontal(degrees) => degrees,
            Self::Vertical(degrees) => {
                let slope = aspect * (degrees.to_radians() / 2.0).tan();
                2.0 * slope.atan().to_degrees()
            }
        }
    }

    /// Wider by some degrees, within what a picture can show.
    pub fn widened(self, by: f64) -> Self {
        let widened = |degrees: f64| (degrees + by).clamp(1.0, 150.0);
        match self {
            Self::Horizontal(degrees) => Self::Horizontal(widened(degrees)),
            Self::Vertical(degrees) => Self::Vertical(widened(degrees)),
        }
    }
}

impl Camera {
    pub fn view(&self) -> DMat4 {
        view(self.eye, self.look, self.rup)
    }

    /// `aspect` is width over height.
    pub fn perspective(&self, aspect: f64) -> DMat4 {
        perspective(self.fov.horizontal(aspect), aspect, self.near, self.far)
    }
}

/// World space to camera space: the camera sits at `eye` and looks along its own −z.
pub fn view(eye: DVec3, look: DVec3, rup: DVec3) -> DMat4 {
    let back = -look.normalize();
    let right = rup.cross(back).normalize();
    let up = back.cross(right);
    let rotation = DMat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        back.extend(0.0),
        DVec4::W,
    )
    .transpose();
    rotation * DMat4::from_translation(-eye)
}

/// Camera space to clip space; `fov` is the horizontal angle in degrees, `aspect` width over height.
pub fn perspective(fov: f64, aspect: f64, near: f64, far: Option<f64>) -> DMat4 {
    let x = 1.0 / (fov.to_radians() / 2.0).tan();
    let (z, translate) = match far {
        Some(far) => (
            -(far + near) / (far - near),
            -2.0 * far * near / (far - near),
        ),
        None => (-1.0, -2.0 * near),
    };
    DMat4::from_cols(
        DVec4::new(x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, aspect * x, 0.0, 0.0),
        DVec4::new(0.0, 0.0, z, -1.0),
        DVec4::new(0.0, 0.0, translate, 0.0),
    )
}

/// Camera space to clip space through a window that need not be around the camera's axis: `glFrustum`, of the window left,
/// right, bottom, top at distance 1.
pub fn frustum([left, right, bottom, top]: [f64; 4], near: f64, far: f64) -> DMat4 {
    let (width, height, depth) = (right - left, top - bottom, far - near);
    DMat4::from_cols(
        DVec4::new(2.0 / width, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 2.0 / height, 0.0, 0.0),
        DVec4::new(
            (right + left) / width,
            (top + bottom) / height,
            -(far + near) / depth,
            -1.0,
        ),
        DVec4::new(0.0, 0.0, -2.0 * far * near / depth, 0.0),
    )
}

/// Camera space to clip space without perspective: `glm::ortho`, of the box left, right, bottom, top between two planes.
pub fn orthographic([left, right, bottom, top]: [f64; 4], near: f64, far: f64) -> DMat4 {
    let (width, height, depth) = (right - left, top - bottom, far - near);
    DMat4::from_cols(
        DVec4::new(2.0 / width, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 2.0 / height, 0.0, 0.0),
        DVec4::new(0.0, 0.0, -2.0 / depth, 0.0),
        DVec4::new(
            -(right + left) / width,
            -(top + bottom) / height,
            -(far + near) / depth,
            1.0,
        ),
    )
}

/// An up vector that is never along `look`: y, or z where the camera looks (nearly) along y.
///
/// With the up vector along the look, `view` divides zero by zero and the whole map is NaN.
pub fn up_for(look: DVec3) -> DVec3 {
    let look = look.normalize();
    if look.cross(DVec3::Y).length() > 1e-3 {
        DVec3::Y
    } else {
        DVec3::Z
    }
}
