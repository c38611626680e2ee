//! The truth of a soft shadow: which share of the light's cube a pixel sees, by rays in f64.

use glam::{DVec3, dvec3};
use image::GrayImage;
use rayon::prelude::*;

use crate::ground_truth::{Label, Ray, Rays, Truth};

/// Points in the cube for each pixel of a penumbra. With so many, two halves of them tell apart by far less than what
/// 256 lights are off.
const POINTS: usize = 2048;

/// Rays that look whether a pixel is in a penumbra at all: they fill a cube half as wide again.
const LOOKS: usize = 27;
const MARGIN: f64 = 1.5;

/// The pixels that the light can reach, and the share of the cube that each sees.
pub struct Penumbrae {
    pixels: Vec<(usize, f64)>,
    /// Root mean square of the difference between the two halves of the points: twice what the shares are off, about.
    pub halves_differ: f64,
}

/// How far values are from what they should be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    pub mean: f64,
    pub rms: f64,
    pub max: f64,
}

impl Deviation {
    /// Of one value or more.
    pub fn of(differences: impl IntoIterator<Item = f64>) -> Self {
        let (mut count, mut sum, mut squares, mut max) = (0.0, 0.0, 0.0, 0.0_f64);
        for difference in differences {
            let difference = difference.abs();
            count += 1.0;
            sum += difference;
            squares += difference * difference;
            max = max.max(difference);
        }
        Self {
            mean: sum / count,
            rms: f64::sqrt(squares / count),
            max,
        }
    }
}

/// Evenly in −1…1 along each axis: the R3 sequence of Roberts (2018), which no lab uses.
fn point(index: usize) -> DVec3 {
    // The inverse of the root of x⁴ = x + 1, its square and its cube.
    const STEP: DVec3 = dvec3(
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    );
    2.0 * (DVec3::splat(0.5) + index as f64 * STEP).fract() - 1.0
}

impl Penumbrae {
    pub fn new(rays: &Rays, truth: &Truth, amount: f64) -> Self {
        let looks: Vec<DVec3> = (0..LOOKS).map(|i| MARGIN * amount * point(i)).collect();
        let points: Vec<DVec3> = (0..POINTS).map(|i| amount * point(i)).collect();
        let (first, second) = points.split_at(POINTS / 2);
        let valid = (0..truth.labels.len()).filter(|i| truth.labels[*i] != Label::NotValid);
        let valid: Vec<usize> = valid.collect();
        let halves: Vec<[f64; 2]> = valid
            .par_iter()
            .map(|pixel| {
                let share = |lights: &[DVec3]| visible_share(rays, truth, *pixel, lights);
                let look = share(&looks);
                if look == 0.0 || look == 1.0 {
                    [look; 2]
                } else {
                    [share(first), share(second)]
                }
            })
            .collect();
        Self {
            halves_differ: Deviation::of(halves.iter().map(|[a, b]| a - b)).rms,
            pixels: valid
                .into_iter()
                .zip(halves.iter().map(|[a, b]| 0.5 * (a + b)))
                .collect(),
        }
    }

    /// What a visibility picture is off, in 0…1.
    pub fn deviation(&self, visibility: &GrayImage) -> Deviation {
        let found = |pixel: usize| f64::from(visibility.as_raw()[pixel]) / 255.0;
        Deviation::of(
            self.pixels
                .iter()
                .map(|(pixel, share)| found(*pixel) - share),
        )
    }
}

fn visible_share(rays: &Rays, truth: &Truth, pixel: usize, lights: &[DVec3]) -> f64 {
    let (triangle, point) = truth.seen[pixel].expect("a valid pixel shows a surface");
    let is_seen = |light: &&DVec3| {
        let light = rays.source.position + **light;
        !rays.is_blocked(&Ray::new(light, point - light), triangle)
    };
    lights.iter().filter(is_seen).count() as f64 / lights.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_what_they_are_called() {
        let found = Deviation::of([3.0, -4.0, 0.0, 0.0]);
        assert_eq!(found.mean, 1.75);
        assert_eq!(found.rms, 2.5);
        assert_eq!(found.max, 4.0);
    }

    /// Every eighth of it has its share of the points, but for a tenth.
    #[test]
    fn the_cube_is_filled() {
        let mut counts = [0_usize; 8];
        for index in 0..POINTS {
            let [x, y, z] = point(index).to_array().map(|n| usize::from(n > 0.0));
            counts[x + 2 * y + 4 * z] += 1;
        }
        let even = POINTS / 8;
        let fits = |count: &usize| count.abs_diff(even) < even / 10;
        assert!(counts.iter().all(fits), "{counts:?}");
    }
}
