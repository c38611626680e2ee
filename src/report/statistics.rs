//! Medians, percentiles, and how sure a median is; all by order, so that no distribution is assumed.

/// A sample, sorted.
#[derive(Clone, Debug)]
pub struct Sample(Vec<f64>);

impl Sample {
    /// Of one value or more, none of them NaN.
    pub fn new(values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().collect();
        assert!(!values.is_empty(), "a sample has a value");
        values.sort_by(f64::total_cmp);
        Self(values)
    }

    pub fn median(&self) -> f64 {
        let middle = self.0.len() / 2;
        if self.0.len() % 2 == 1 {
            self.0[middle]
        } else {
            (self.0[middle - 1] + self.0[middle]) / 2.0
        }
    }

    /// The smallest value that 95 % of the sample do not exceed.
    pub fn percentile_95(&self) -> f64 {
        let rank = (0.95 * self.0.len() as f64).ceil() as usize;
        self.0[rank - 1]
    }

    /// Between two values of the sample lies the median of whatever it was drawn from, in 95 % of all samples or more.
    /// None below six values: even from the smallest to the largest it is less sure then.
    pub fn interval_95(&self) -> Option<[f64; 2]> {
        let size = self.0.len();
        // How many values are below the true median is as a coin's heads. The interval leaves out as many values on
        // either side as keep what lies outside within 2.5 % on that side.
        let mut exactly = 0.5_f64.powi(size as i32);
        let mut at_most = exactly;
        let mut left_out = 0;
        while at_most <= 0.025 {
            left_out += 1;
            exactly *= (size - left_out + 1) as f64 / left_out as f64;
            at_most += exactly;
        }
        let first = left_out.checked_sub(1)?;
        Some([self.0[first], self.0[size - 1 - first]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one_to(n: i32) -> Sample {
        Sample::new((1..=n).rev().map(f64::from))
    }

    #[test]
    fn medians_and_percentiles() {
        assert_eq!(one_to(1).median(), 1.0);
        assert_eq!(one_to(4).median(), 2.5);
        assert_eq!(one_to(5).median(), 3.0);
        assert_eq!(one_to(1).percentile_95(), 1.0);
        assert_eq!(one_to(20).percentile_95(), 19.0);
        assert_eq!(one_to(30).percentile_95(), 29.0);
    }

    /// The ranks of the tables: 1 and 6 of 6, 2 and 9 of 10, 10 and 21 of 30.
    #[test]
    fn the_interval_has_the_ranks_of_the_tables() {
        assert_eq!(one_to(5).interval_95(), None);
        assert_eq!(one_to(6).interval_95(), Some([1.0, 6.0]));
        assert_eq!(one_to(10).interval_95(), Some([2.0, 9.0]));
        assert_eq!(one_to(30).interval_95(), Some([10.0, 21.0]));
        assert_eq!(one_to(1000).interval_95(), Some([469.0, 532.0]));
    }
}
