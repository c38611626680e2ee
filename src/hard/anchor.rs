//! A plane whose false shadow is known in closed form: the anchor of the whole chain from map to measure.
//!
//! Parallel light meets an unoccluded plane at θ from its normal; the plane is tilted about one axis of the map. Over
//! a texel of width w the plane's depth rises by w · tan θ, and the map has the one depth of the texel's centre. So
//! half of the plane is nearer than its texel, and half farther, by up to w/2 · tan θ; a bias b takes from the darker
//! half what is farther by less than b.

use glam::{DVec3, dvec3};

use super::build::{SUN_REACH, camera, floor, scene, sun};
use crate::scene::Scene;

/// The lab that has one constant bias and no filter.
pub const LAB: &str = "csci3260";

/// What is measured: angles from the plane's normal in degrees, sizes of the map, biases in units of [`deepest`].
pub const ANGLES: [f64; 5] = [20.0, 45.0, 60.0, 75.0, 85.0];
pub const MAP_SIZES: [u32; 3] = [512, 1024, 2048];
pub const BIASES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.25];

/// Half the side of the map.
const HALF: f64 = 10.0;

/// The plane in light that comes at `degrees` from its normal; it is larger than the picture and than the map.
pub fn tilted(degrees: f64) -> Scene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let area = [-HALF, HALF, -HALF, HALF];
    scene(
        // Turned a little, so that rows of pixels do not run along rows of texels.
        camera(dvec3(1.0, 6.0, 2.0), DVec3::ZERO, 45.0),
        sun(dvec3(0.0, cos, sin), area),
        vec![floor(12.0)],
    )
}

/// The width of a texel, in world units.
pub fn texel(map_size: u32) -> f64 {
    2.0 * HALF / f64::from(map_size)
}

/// A length along the light in depth as the map stores it.
pub fn in_depth(length: f64) -> f64 {
    length / (2.0 * SUN_REACH)
}

/// The largest depth, in world units, by which a lit point lies behind what the map has for it.
pub fn deepest(texel: f64, degrees: f64) -> f64 {
    texel / 2.0 * degrees.to_radians().tan()
}

/// The share of the plane in false shadow at a bias, in world units.
pub fn false_shadow(texel: f64, degrees: f64, bias: f64) -> f64 {
    0.5 * f64::max(0.0, 1.0 - bias / deepest(texel, degrees))
}
