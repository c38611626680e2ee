//! Lights with an area: how much of the light a point sees.

use glam::DVec3;

use super::{Ray, Rays};

/// A flat light: all points centre + a·u + b·v with |a|, |b| ≤ 1, or a² + b² ≤ 1 for a disc; relative to the eye.
#[derive(Clone, Copy, Debug)]
pub struct AreaLight {
    pub centre: DVec3,
    pub u: DVec3,
    pub v: DVec3,
    pub disc: bool,
}

/// The share of an area light that a point sees, and the standard error of that mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penumbra {
    pub visibility: f64,
    pub standard_error: f64,
}

/// How many stretches the sequence of samples is cut into; their scatter gives the standard error. It is an upper bound:
/// the whole sequence fills the light more evenly than its stretches do.
const STRETCHES: u32 = 16;

impl AreaLight {
    /// Sample `index`: the R2 sequence of Roberts (2018), which fills the square evenly.
    fn point(&self, index: u32) -> DVec3 {
        // The inverse of the plastic number, the root of x³ = x + 1, and its square.
        const STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
        let [a, b] = STEP.map(|step| (0.5 + f64::from(index) * step).fract());
        if self.disc {
            // Equal areas: the square root of the radius, all around.
            let (sin, cos) = (std::f64::consts::TAU * b).sin_cos();
            self.centre + a.sqrt() * (cos * self.u + sin * self.v)
        } else {
            self.centre + (2.0 * a - 1.0) * self.u + (2.0 * b - 1.0) * self.v
        }
    }
}

impl Rays {
    /// The share of the light that is seen from a point of a triangle, by `samples` rays at least.
    pub fn penumbra(
        &self,
        triangle: u32,
        point: DVec3,
        light: &AreaLight,
        samples: u32,
    ) -> Penumbra {
        let stretch = samples.div_ceil(STRETCHES).max(1);
        let seen = |index: &u32| {
            let ray = Ray::new(point, light.point(*index) - point);
            !self.is_stopped(&ray, triangle, 1.0)
        };
        let mean_of_stretch = |number: u32| {
            let indices = number * stretch..(number + 1) * stretch;
            indices.filter(seen).count() as f64 / f64::from(stretch)
        };
        let means: Vec<f64> = (0..STRETCHES).map(mean_of_stretch).collect();
        let count = f64::from(STRETCHES);
        let visibility = means.iter().sum::<f64>() / count;
        let scatter: f64 = means.iter().map(|mean| (mean - visibility).powi(2)).sum();
        Penumbra {
            visibility,
            standard_error: (scatter / (count - 1.0) / count).sqrt(),
        }
    }
}
