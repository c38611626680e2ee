//! Straight lines through points, by least squares.

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub at_zero: f64,
    pub slope: f64,
}

/// Through two points or more, no two above each other.
pub fn line(points: &[(f64, f64)]) -> Line {
    let count = points.len() as f64;
    let mean_x = points.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = points.iter().map(|(_, y)| y).sum::<f64>() / count;
    let products = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y));
    let squares = points.iter().map(|(x, _)| (x - mean_x).powi(2));
    let slope = products.sum::<f64>() / squares.sum::<f64>();
    Line {
        at_zero: mean_y - slope * mean_x,
        slope,
    }
}

/// The power of x with which y grows.
pub fn power(points: &[(f64, f64)]) -> f64 {
    let logarithms = points.iter().map(|(x, y)| (x.ln(), y.ln()));
    line(&logarithms.collect::<Vec<_>>()).slope
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_powers_are_found_again() {
        let Line { at_zero, slope } = line(&[(1.0, 5.0), (2.0, 7.0), (4.0, 11.0)]);
        assert!((at_zero - 3.0).abs() < 1e-12 && (slope - 2.0).abs() < 1e-12);
        let points = [1.0, 4.0, 64.0].map(|x: f64| (x, 3.0 / x.sqrt()));
        assert!((power(&points) + 0.5).abs() < 1e-12);
    }
}
