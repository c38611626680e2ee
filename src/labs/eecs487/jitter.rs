//! Section 3: where the light is jittered to.

use glam::{DVec3, dvec3};

/// Any number will do, as long as it stays the same: the picture is the same in each frame and on each machine.
const SEED: u64 = 487;

/// Place number `index` of a jittered light, in [−1, 1]³.
pub fn jitter(kind: &str, index: usize) -> DVec3 {
    let place = match kind {
        "random" => random(index),
        _ => low_discrepancy(index),
    };
    2.0 * place - 1.0
}

/// Uniform in the unit cube.
fn random(index: usize) -> DVec3 {
    let number = |axis: u64| unit(SEED + 3 * index as u64 + axis);
    dvec3(number(0), number(1), number(2))
}

/// A number in 0…1 that looks like chance: the counter times an odd constant, its bits stirred until each depends on all
/// (splitmix64; Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
fn unit(counter: u64) -> f64 {
    let mut bits = (counter + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Steps that never come near to where they were. A shadow's edge cuts the cube in two: of 1,500 triples that were tried,
/// this one has 64 lights nearest to the share that lies on either side, over all ways to cut. (Roberts' triple, the powers
/// of the inverse root of x⁴ = x + 1, is a quarter worse.) The first place is the middle.
fn low_discrepancy(index: usize) -> DVec3 {
    const STEPS: DVec3 = dvec3(0.360_573, 0.767_450, 0.392_229);
    (DVec3::splat(0.5) + index as f64 * STEPS).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 4096;

    fn all(kind: &str) -> impl Iterator<Item = DVec3> {
        (0..COUNT).map(move |index| jitter(kind, index))
    }

    /// Every eighth of the cube has its eighth of the places.
    #[test]
    fn the_cube_is_filled() {
        for (kind, slack) in [("random", 90), ("low-discrepancy", 12)] {
            let mut counts = [0_usize; 8];
            for place in all(kind) {
                assert!(place.abs().max_element() <= 1.0, "{place}");
                let [x, y, z] = place.to_array().map(|n| usize::from(n > 0.0));
                counts[x + 2 * y + 4 * z] += 1;
            }
            let off = counts.map(|count| count.abs_diff(COUNT / 8));
            assert!(off.iter().all(|off| *off < slack), "{kind}: {counts:?}");
        }
    }

    /// The axes know nothing of each other: the mean of each product is 0, and of each square 1/3.
    #[test]
    fn axes_are_independent() {
        for kind in ["random", "low-discrepancy"] {
            let mean = |of: fn(DVec3) -> f64| all(kind).map(of).sum::<f64>() / COUNT as f64;
            for product in [
                mean(|p| p.x * p.y),
                mean(|p| p.y * p.z),
                mean(|p| p.z * p.x),
            ] {
                assert!(product.abs() < 0.02, "{kind}: {product}");
            }
            assert!((mean(|p| p.x * p.x) - 1.0 / 3.0).abs() < 0.02, "{kind}");
        }
    }
}
