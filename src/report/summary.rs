//! What the rounds of a row come to, and which rows no other row beats.

use super::run::{Row, Times};
use super::statistics::Sample;

/// A time over the rounds.
#[derive(Clone, Debug)]
pub struct Timing {
    /// To the handout's row of the same round.
    pub ratio: f64,
    /// Where the true median of that ratio is; None where there are too few rounds to say.
    pub ratio_95: Option<[f64; 2]>,
    pub ms: f64,
    pub ms_95: f64,
}

#[derive(Clone, Debug)]
pub struct Summary {
    /// Light or casters move.
    pub frame: Timing,
    pub rest: Timing,
    /// Milliseconds: median and 95th percentile.
    pub shadow_pass: [f64; 2],
    pub lighting: [f64; 2],
    /// What of the two was spent in GL calls.
    pub shadow_pass_in_gl: f64,
    pub lighting_in_gl: f64,
    /// What the lighting takes more than with shadows=off; None where no row has that.
    pub look_ups: Option<LookUps>,
    /// A share, and milliseconds.
    pub outside_gl: f64,
    pub outside_gl_ms: f64,
    /// Falsely shadowed and falsely lit pixels, but for the ambiguous ones.
    pub wrong: usize,
    /// Those of them that lie away from the shadows' edges.
    pub interior: usize,
    /// Pixels that can be wrong at all.
    pub valid: usize,
    /// No other row has fewer wrong pixels at no more time, or takes less time with no more of them.
    pub on_front: bool,
}

/// A difference of two rows' lighting, of the same round each.
#[derive(Clone, Debug)]
pub struct LookUps {
    pub ms: f64,
    /// Where its true median is; None where there are too few rounds to say.
    pub interval_95: Option<[f64; 2]>,
}

impl Summary {
    /// Of rows with one round or more; the first is the handout's.
    pub fn of_rows(rows: &[Row]) -> Vec<Self> {
        let handouts = &rows[0].times;
        let unshadowed = rows.iter().find(|row| row.differences == ["shadows=off"]);
        let unshadowed = unshadowed.map(|row| &row.times[..]);
        let summary = |row| Self::of_row(row, handouts, unshadowed);
        let mut summaries: Vec<Self> = rows.iter().map(summary).collect();
        let points: Vec<_> = summaries
            .iter()
            .map(|row| (row.frame.ratio, row.wrong))
            .collect();
        for (i, summary) in summaries.iter_mut().enumerate() {
            summary.on_front = is_on_front(&points, i);
        }
        summaries
    }

    fn of_row(row: &Row, handouts: &[Times], unshadowed: Option<&[Times]>) -> Self {
        let timing = |time: fn(&Times) -> f64| {
            let rounds = row.times.iter().zip(handouts);
            let ratios = Sample::new(rounds.map(|(own, handouts)| time(own) / time(handouts)));
            let [ms, ms_95] = milliseconds(row, time);
            Timing {
                ratio: ratios.median(),
                ratio_95: ratios.interval_95(),
                ms,
                ms_95,
            }
        };
        let sum =
            |count: fn(&crate::measure::Figures) -> usize| row.figures.iter().map(count).sum();
        let look_ups = unshadowed.map(|unshadowed| {
            let rounds = row.times.iter().zip(unshadowed);
            let sample =
                Sample::new(rounds.map(|(with, without)| with.lighting - without.lighting));
            LookUps {
                ms: sample.median(),
                interval_95: sample.interval_95(),
            }
        });
        Self {
            frame: timing(|times| times.frame),
            rest: timing(|times| times.rest),
            shadow_pass: milliseconds(row, |times| times.shadow_pass),
            lighting: milliseconds(row, |times| times.lighting),
            shadow_pass_in_gl: milliseconds(row, |times| times.shadow_pass_in_gl)[0],
            lighting_in_gl: milliseconds(row, |times| times.lighting_in_gl)[0],
            look_ups,
            outside_gl: milliseconds(row, |times| times.outside_gl)[0],
            outside_gl_ms: milliseconds(row, |times| times.outside_gl_ms)[0],
            wrong: sum(|figures| figures.false_shadow.total() + figures.false_light.total()),
            interior: sum(|figures| figures.false_shadow.interior + figures.false_light.interior),
            valid: sum(|figures| figures.lit + figures.shadowed),
            on_front: false,
        }
    }

    /// Milliseconds: what look-ups leave of the lighting.
    pub fn shading(&self) -> Option<f64> {
        let look_ups = self.look_ups.as_ref()?;
        Some(self.lighting_in_gl - look_ups.ms)
    }

    /// Wrong pixels as a share of the valid ones.
    pub fn share(&self) -> f64 {
        self.wrong as f64 / self.valid.max(1) as f64
    }
}

/// Median and 95th percentile.
fn milliseconds(row: &Row, time: fn(&Times) -> f64) -> [f64; 2] {
    let sample = Sample::new(row.times.iter().map(time));
    [sample.median(), sample.percentile_95()]
}

/// Whether no other point is at least as good in both and better in one.
fn is_on_front(points: &[(f64, usize)], i: usize) -> bool {
    let (cost, wrong) = points[i];
    !points.iter().any(|(other_cost, other_wrong)| {
        *other_cost <= cost && *other_wrong <= wrong && (*other_cost < cost || *other_wrong < wrong)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [
            (1.0, 10),
            (0.5, 20),
            (2.0, 10),
            (2.0, 0),
            (0.6, 20),
            (0.5, 20),
        ];
        let front: Vec<bool> = (0..points.len()).map(|i| is_on_front(&points, i)).collect();
        assert_eq!(front, [true, true, false, true, false, true]);
    }
}
