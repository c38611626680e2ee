//! Random numbers that are the same on every machine.

use glam::{DVec3, dvec3};

/// SplitMix64: a counter whose bits are stirred. Small, and good enough to place balls.
#[derive(Clone, Debug)]
pub(super) struct Random {
    state: u64,
}

impl Random {
    pub(super) fn new(seed: u64) -> Random {
        Random { state: seed }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// From −1 up to, and without, 1.
    fn signed(&mut self) -> f64 {
        // The upper 53 bits, as many as an f64 has.
        let steps = (self.next() >> 11) as f64;
        steps / (1_u64 << 52) as f64 - 1.0
    }

    /// Evenly in the cube [−1,1]³.
    pub(super) fn in_cube(&mut self) -> DVec3 {
        dvec3(self.signed(), self.signed(), self.signed())
    }

    /// A unit vector, evenly in all directions.
    pub(super) fn direction(&mut self) -> DVec3 {
        // Points of the ball have every direction equally often, points of the cube have not. No sine and cosine:
        // their last bits differ from machine to machine. A point near the centre has too few bits left.
        loop {
            let point = self.in_cube();
            if (0.01..=1.0).contains(&point.length_squared()) {
                return point / point.length();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_splitmix64s() {
        // The first numbers for the seed 1234567, as they are widely published for checking ports.
        let mut random = Random::new(1_234_567);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
    }

    fn fourth_power(d: &DVec3) -> DVec3 {
        *d * *d * *d * *d
    }

    #[test]
    fn directions_are_unit_vectors_and_favour_no_side() {
        let mut random = Random::new(5);
        let directions: Vec<DVec3> = (0..100_000).map(|_| random.direction()).collect();
        assert!(directions.iter().all(|d| (d.length() - 1.0).abs() < 1e-15));
        let count = directions.len() as f64;
        let mean = directions.iter().sum::<DVec3>() / count;
        assert!(mean.length() < 0.01, "mean {mean}");
        // Evenly on the sphere, the squares of the parts are 1/3 on average, and their fourth powers 1/5. The control:
        // directions to points of a cube have 0.18 there.
        let fourth = directions.iter().map(fourth_power).sum::<DVec3>() / count;
        assert!((fourth - 0.2).abs().max_element() < 0.005, "{fourth}");
        let of_cube = (0..100_000)
            .map(|_| fourth_power(&random.in_cube().normalize()))
            .sum::<DVec3>()
            / count;
        assert!((of_cube - 0.2).abs().max_element() > 0.01, "{of_cube}");
    }
}
