//! The time since the start, as a sum of steps that does not depend on how many they are.

/// A sum of two numbers: the time, and what its rounding has left out so far.
///
/// 2000 steps of 0.01 s added plainly miss 20 s by 10⁻¹³ s; here they are 20 s.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    now: f64,
    left_out: f64,
}

impl Clock {
    /// Seconds since the start.
    pub(super) fn now(self) -> f64 {
        self.now
    }

    pub(super) fn advance(&mut self, dt: f64) {
        assert!(
            dt.is_finite() && dt >= 0.0,
            "time cannot pass by {dt} s: expected a number from 0"
        );
        let (sum, left_out) = sum_exactly(self.now, dt);
        (self.now, self.left_out) = sum_exactly(sum, self.left_out + left_out);
    }
}

/// a + b as f64 rounds it, and the rest, with no error at all (Knuth's two-sum).
fn sum_exactly(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    let of_a = sum - of_b;
    (sum, (a - of_a) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(steps: impl IntoIterator<Item = f64>) -> f64 {
        let mut clock = Clock::default();
        steps.into_iter().for_each(|dt| clock.advance(dt));
        clock.now()
    }

    #[test]
    fn many_steps_are_one_long_step() {
        assert_eq!(after(vec![0.01; 2000]), 20.0);
        assert_eq!(after(vec![0.001; 1_000_000]), 1000.0);
        assert_eq!(after(vec![1.0 / 60.0; 36_000]), 600.0);
        // The control: a plain sum is another number.
        assert_ne!(vec![0.01; 2000].iter().sum::<f64>(), 20.0);
    }

    #[test]
    fn the_order_of_the_steps_does_not_matter() {
        let steps: Vec<f64> = (1..5000).map(|k| 1.0 / f64::from(k)).collect();
        let backwards = steps.iter().rev().copied();
        assert_eq!(after(steps.iter().copied()), after(backwards));
    }

    #[test]
    fn time_does_not_run_backwards() {
        for dt in [-0.01, f64::NAN, f64::INFINITY] {
            assert!(
                std::panic::catch_unwind(|| after([dt])).is_err(),
                "{dt} was taken"
            );
        }
    }
}
