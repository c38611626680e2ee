//! A light as the rays see it: where it is, or where it comes from, and what its beam reaches.

use glam::DVec3;

use crate::scene::{Beam, Light, LightKind, camera};

/// A light source relative to some origin.
#[derive(Clone, Debug)]
pub struct Source {
    pub position: DVec3,
    /// The beam's axis and the two directions across it; each of length 1.
    pub axis: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    kind: LightKind,
}

/// The width of a light's shadow map, across its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapWidth {
    /// It grows with the distance from the light.
    AtDistance1(f64),
    /// It is the same all along parallel rays.
    Everywhere([f64; 2]),
}

impl Source {
    pub fn new(light: &Light, origin: DVec3) -> Self {
        let axis = light.direction.normalize();
        let right = axis.cross(camera::up_for(axis)).normalize();
        Self {
            position: light.position - origin,
            axis,
            right,
            up: right.cross(axis),
            kind: light.kind,
        }
    }

    /// From a point to the light: all the way, or against the parallel rays.
    pub fn towards(&self, point: DVec3) -> DVec3 {
        match self.kind {
            LightKind::Directional { .. } => -self.axis,
            LightKind::Spot { .. } | LightKind::Point { .. } => self.position - point,
        }
    }

    /// How far along [`Self::towards`] something can stand before the light.
    pub fn end(&self) -> f64 {
        match self.kind {
            LightKind::Directional { .. } => f64::INFINITY,
            LightKind::Spot { .. } | LightKind::Point { .. } => 1.0,
        }
    }

    /// Whether a point lies in the beam.
    pub fn reaches(&self, point: DVec3) -> bool {
        let LightKind::Spot { cone, beam } = self.kind else {
            return true;
        };
        let from_light = point - self.position;
        let forward = from_light.dot(self.axis);
        let across = [from_light.dot(self.right), from_light.dot(self.up)];
        let half_width = forward * (cone.to_radians() / 2.0).tan();
        forward > 0.0
            && match beam {
                Beam::Circular => across[0].hypot(across[1]) <= half_width,
                Beam::Rectangular => across.iter().all(|a| a.abs() <= half_width),
            }
    }

    /// How wide the shadow map is, right and up.
    pub fn map_width(&self) -> MapWidth {
        match self.kind {
            LightKind::Spot { cone: fov, .. } | LightKind::Point { shadow_fov: fov } => {
                MapWidth::AtDistance1(2.0 * (fov.to_radians() / 2.0).tan())
            }
            LightKind::Directional {
                area: [left, right, bottom, top],
            } => MapWidth::Everywhere([right - left, top - bottom]),
        }
    }
}
