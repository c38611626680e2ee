//! "Which setting do I choose for this scene, and what does it cost me?"

use super::Compared;
use super::summary::{Summary, Timing};
use super::words;

/// The row to choose.
///
/// Of the rows without a wrong pixel in the interior (a fault of the method, where one along an edge is a matter of
/// resolution), the cheapest; of those that cost as much as far as the rounds can tell, the one with the fewest wrong
/// pixels. Where every row is wrong somewhere in the interior, the one that is so in the fewest pixels.
pub fn choice(summaries: &[Summary]) -> usize {
    let cheapest = |rows: &[usize]| {
        let costs = rows.iter().copied();
        costs.min_by(|a, b| {
            summaries[*a]
                .frame
                .ratio
                .total_cmp(&summaries[*b].frame.ratio)
        })
    };
    let rows_where = |holds: &dyn Fn(&Summary) -> bool| -> Vec<usize> {
        let rows = 0..summaries.len();
        rows.filter(|i| holds(&summaries[*i])).collect()
    };
    let clean = rows_where(&|row| row.interior == 0);
    if let Some(cheapest) = cheapest(&clean) {
        let as_cheap = clean.into_iter().filter(|i| {
            *i == cheapest || overlap(&summaries[*i].frame, &summaries[cheapest].frame)
        });
        let fewest = as_cheap.min_by(|a, b| {
            let [a, b] = [a, b].map(|i| &summaries[*i]);
            a.wrong
                .cmp(&b.wrong)
                .then(a.frame.ratio.total_cmp(&b.frame.ratio))
        });
        return fewest.expect("the cheapest is as cheap as itself");
    }
    let fewest = summaries.iter().map(|row| row.interior).min();
    let fewest = rows_where(&|row| Some(row.interior) == fewest);
    cheapest(&fewest).expect("a report has a row")
}

/// Whether the rounds cannot tell two costs apart.
fn overlap(a: &Timing, b: &Timing) -> bool {
    let (Some(a), Some(b)) = (a.ratio_95, b.ratio_95) else {
        return false;
    };
    a[0] <= b[1] && b[0] <= a[1]
}

pub fn sentence(compared: &Compared, summaries: &[Summary]) -> String {
    let name = |i: usize| words::name(&compared.rows[i]);
    let chosen = choice(summaries);
    let row = &summaries[chosen];
    let cost = format!(
        "{} × the handout's frame (95 %: {}), {} ms here",
        words::ratio(row.frame.ratio),
        words::interval(row.frame.ratio_95),
        words::milliseconds(row.frame.ms),
    );
    let mut text = if row.interior == 0 {
        format!(
            "choose {}. It costs {cost}; no pixel is wrong away from the shadows' edges, {} along them ({} of those that \
             face the light).",
            name(chosen),
            row.wrong,
            words::percent(row.share()),
        )
    } else {
        format!(
            "no setting here is without wrong pixels away from the shadows' edges. The fewest, {}, has {}. It costs {cost}.",
            row.interior,
            name(chosen),
        )
    };
    let handouts = &summaries[0];
    if chosen != 0 && handouts.interior > row.interior {
        text += &format!(
            " The handout's settings leave {} wrong pixels away from the edges.",
            handouts.interior
        );
    }
    let best = (0..summaries.len()).filter(|i| summaries[*i].on_front);
    if let Some(best) = best.min_by_key(|i| summaries[*i].wrong)
        && summaries[best].wrong < row.wrong
    {
        text += &format!(
            " The fewest wrong pixels in all, {}, {} away from the edges, has {}, at {} ×.",
            summaries[best].wrong,
            summaries[best].interior,
            name(best),
            words::ratio(summaries[best].frame.ratio),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(ratio: f64, [low, high]: [f64; 2], wrong: usize, interior: usize) -> Summary {
        let timing = Timing {
            ratio,
            ratio_95: Some([low, high]),
            ms: ratio,
            ms_95: ratio,
        };
        Summary {
            frame: timing.clone(),
            rest: timing,
            shadow_pass: [0.0; 2],
            lighting: [0.0; 2],
            outside_gl: 0.0,
            wrong,
            interior,
            valid: 1000,
            on_front: true,
        }
    }

    #[test]
    fn the_cheapest_without_interior_errors_is_chosen() {
        let rows = [
            row(1.0, [1.0, 1.0], 90, 10),
            row(0.5, [0.4, 0.6], 90, 1),
            row(1.5, [1.4, 1.6], 60, 0),
            row(1.2, [1.1, 1.3], 70, 0),
        ];
        assert_eq!(choice(&rows), 3);
        // The control: without the clean ones, the fewest errors.
        assert_eq!(choice(&rows[..2]), 1);
    }

    #[test]
    fn of_equal_costs_the_fewest_errors_are_chosen() {
        let rows = [
            row(1.0, [1.0, 1.0], 90, 0),
            row(1.01, [0.97, 1.04], 20, 0),
            row(1.2, [1.1, 1.3], 0, 0),
        ];
        assert_eq!(choice(&rows), 1);
    }
}
