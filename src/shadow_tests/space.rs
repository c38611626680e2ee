//! Where the light is: the space in which rays and triangles meet.

use glam::{DMat3, DMat4, DVec3};

use crate::scene::{Light, LightKind, camera};

/// How a light's rays run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rays {
    /// From the origin, in a beam along −z: |x| and |y| are at most −z.
    Spot,
    /// From the origin, in all directions.
    Point,
    /// Along −z.
    Parallel,
}

/// The light's coordinate system (`_lcs`): the light's camera looks along −z, as all of OpenGL's cameras do. The origin
/// is the light, or the scene's centre where rays are parallel; nothing of the scene is farther from it than 1, but that
/// a spot light's x and y are widened until its beam is a right angle wide.
#[derive(Clone, Copy, Debug)]
pub struct LightSpace {
    pub rays: Rays,
    /// The length, in world units, of a unit along z.
    pub unit: f64,
    origin: DVec3,
    axes: DMat3,
}

impl LightSpace {
    /// Of a light and what is in its scene, as points in world space.
    pub fn new(light: &Light, points: &[DVec3]) -> Self {
        let axis = light.direction.normalize();
        let view = camera::view(DVec3::ZERO, axis, camera::up_for(axis));
        let view = DMat3::from_mat4(view);
        let (rays, origin, widened) = match light.kind {
            LightKind::Spot { cone, .. } => {
                let across = 1.0 / (cone.to_radians() / 2.0).tan();
                (Rays::Spot, light.position, DVec3::new(across, across, 1.0))
            }
            LightKind::Point { .. } => (Rays::Point, light.position, DVec3::ONE),
            LightKind::Directional { .. } => (Rays::Parallel, centre(points), DVec3::ONE),
        };
        let distances = points.iter().map(|point| point.distance(origin));
        let radius = distances.fold(f64::MIN_POSITIVE, f64::max);
        Self {
            rays,
            unit: radius,
            origin,
            axes: DMat3::from_diagonal(widened / radius) * view,
        }
    }

    /// Object space to the light's.
    pub fn from_object(&self, model: DMat4) -> DMat4 {
        DMat4::from_mat3(self.axes) * (DMat4::from_translation(-self.origin) * model)
    }

    pub fn from_world(&self, point: DVec3) -> DVec3 {
        self.axes * (point - self.origin)
    }
}

impl Rays {
    /// Any vector along the way from the light through a point, seen as from a pinhole: in all three cases rays are
    /// vectors, and a plane through the light (or along the rays) is a vector that those in it are at right angles to.
    pub fn through(self, point: DVec3) -> DVec3 {
        match self {
            Self::Spot | Self::Point => point,
            Self::Parallel => DVec3::new(point.x, point.y, -1.0),
        }
    }
}

/// The middle of the box around some points.
fn centre(points: &[DVec3]) -> DVec3 {
    let least = points.iter().copied().reduce(DVec3::min);
    let most = points.iter().copied().reduce(DVec3::max);
    least
        .zip(most)
        .map_or(DVec3::ZERO, |(least, most)| 0.5 * (least + most))
}
