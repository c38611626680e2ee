//! Whether anything grows faster than what it is drawn from: the slope of a cost over a size, both in logarithms.

use super::{Axis, Point, Series};
use crate::report::run::{Row, Times};
use crate::report::statistics::Sample;

/// A cost that may grow.
pub struct Cost {
    pub name: &'static str,
    /// One value of each round; memory is the same in all of them.
    values: fn(&Row) -> Vec<f64>,
}

fn times(row: &Row, time: fn(&Times) -> f64) -> Vec<f64> {
    row.times.iter().map(time).collect()
}

pub const COSTS: [Cost; 4] = [
    Cost {
        name: "frame, light moving",
        values: |row| times(row, |times| times.frame),
    },
    Cost {
        name: "frame at rest",
        values: |row| times(row, |times| times.rest),
    },
    Cost {
        name: "shadow pass or light buffer",
        values: |row| times(row, |times| times.shadow_pass),
    },
    Cost {
        name: "memory",
        values: |row| vec![row.bytes.total() as f64 / f64::from(1 << 20)],
    },
];

impl Cost {
    /// Its median, and where the true one is.
    pub fn of(&self, row: &Row) -> (f64, Option<[f64; 2]>) {
        let sample = Sample::new((self.values)(row));
        (sample.median(), sample.interval_95())
    }
}

/// How a cost grows at the large end, where what does not grow at all counts least.
pub struct Growth {
    pub cost: &'static str,
    pub shadow_test: &'static str,
    /// The median of the rounds' slopes.
    pub slope: f64,
    pub slope_95: Option<[f64; 2]>,
}

/// How many sizes a slope is fitted to: from the largest down, a factor of ten of triangles.
const FITTED: usize = 3;

/// A slope of 1.05 is 12 % more than ten times as much at ten times the size: that much may be the caches', which a
/// larger scene fits in worse.
const LINEAR: f64 = 1.05;

/// Of every test that has sizes enough, every cost.
pub fn growths(axis: &Axis) -> Vec<Growth> {
    let series = axis
        .series
        .iter()
        .filter(|series| series.points.len() >= FITTED);
    let of_series =
        |series| -> Vec<Growth> { COSTS.iter().map(|cost| growth(series, cost)).collect() };
    series.flat_map(of_series).collect()
}

fn growth(series: &Series, cost: &Cost) -> Growth {
    let fitted = &series.points[series.points.len() - FITTED..];
    let sizes: Vec<f64> = fitted.iter().map(|point| point.count as f64).collect();
    let values = |point: &Point| (cost.values)(&point.row);
    let values: Vec<Vec<f64>> = fitted.iter().map(values).collect();
    let slopes = (0..values[0].len()).map(|round| {
        let costs = values.iter().map(|costs| costs[round]);
        slope(sizes.iter().copied().zip(costs))
    });
    let slopes = Sample::new(slopes);
    Growth {
        cost: cost.name,
        shadow_test: series.shadow_test,
        slope: slopes.median(),
        slope_95: slopes.interval_95(),
    }
}

/// Of the straight line through the logarithms, by least squares.
fn slope(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logarithms: Vec<[f64; 2]> = points.map(|(x, y)| [x.ln(), y.ln()]).collect();
    let mean = [0, 1]
        .map(|i| logarithms.iter().map(|point| point[i]).sum::<f64>() / logarithms.len() as f64);
    let from_mean = logarithms.iter().map(|[x, y]| [x - mean[0], y - mean[1]]);
    let (along, across) = from_mean.fold((0.0, 0.0), |(along, across), [x, y]| {
        (along + x * y, across + x * x)
    });
    along / across
}

impl Growth {
    /// Whether it is sure to grow faster than the size does.
    pub fn is_faster(&self) -> bool {
        self.slope_95.map_or(self.slope, |[low, _]| low) > LINEAR
    }

    pub fn text(&self) -> String {
        let interval = match self.slope_95 {
            Some([low, high]) => format!(" (95 %: {low:.2} to {high:.2})"),
            None => String::new(),
        };
        format!(
            "shadow_test={}, {}: slope {:.2}{interval}",
            self.shadow_test, self.cost, self.slope
        )
    }
}

/// Whether anything grows faster than the axis does.
pub fn sentence(axis: &Axis) -> String {
    let growths = growths(axis);
    let unit = axis.unit;
    let faster: Vec<String> = growths
        .iter()
        .filter(|growth| growth.is_faster())
        .map(Growth::text)
        .collect();
    if !faster.is_empty() {
        return format!("FASTER than the {unit} grows: {}", faster.join("; "));
    }
    let steepest = growths.iter().max_by(|a, b| a.slope.total_cmp(&b.slope));
    match steepest {
        Some(steepest) => format!(
            "nothing is seen to grow faster than the {unit} do; the steepest is {}",
            steepest.text()
        ),
        None => format!("too few sizes to say how anything grows with the {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::trace::Bytes;
    use crate::report::Calls;

    #[test]
    fn a_power_has_its_exponent_as_slope() {
        let power = |exponent: f64| {
            let sizes = [1000.0, 3000.0, 10_000.0_f64];
            slope(
                sizes
                    .into_iter()
                    .map(|size| (size, 0.01 * size.powf(exponent))),
            )
        };
        for exponent in [0.0, 1.0, 1.7] {
            assert!((power(exponent) - exponent).abs() < 1e-12);
        }
    }

    fn axis(exponent: f64) -> Axis {
        let point = |count: u64| {
            let ms = (count as f64).powf(exponent);
            let time = Times {
                frame: ms,
                rest: ms,
                shadow_pass: ms,
                lighting: ms,
                shadow_pass_in_gl: ms,
                lighting_in_gl: ms,
                outside_gl: 0.0,
                outside_gl_ms: 0.0,
            };
            let row = Row {
                differences: Vec::new(),
                calls: Calls { frame: 1, rest: 1 },
                bytes: Bytes {
                    buffers: count,
                    ..Bytes::default()
                },
                figures: Vec::new(),
                thumbnails: Vec::new(),
                times: vec![time; 6],
            };
            Point { count, row }
        };
        Axis {
            unit: "triangles",
            rounds: 6,
            series: vec![Series {
                shadow_test: "handout",
                points: [1000, 3000, 10_000].map(point).into(),
            }],
        }
    }

    #[test]
    fn what_grows_faster_is_told() {
        let told = sentence(&axis(0.9));
        assert!(told.starts_with("nothing is seen to grow faster"), "{told}");
        assert!(told.ends_with("memory: slope 1.00"), "{told}");
        // The control.
        let told = sentence(&axis(1.3));
        assert!(told.starts_with("FASTER than the triangles"), "{told}");
        assert_eq!(told.matches("slope 1.30 (95 %: 1.30 to 1.30)").count(), 3);
    }
}
