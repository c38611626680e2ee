//! "Which setting do I choose for this scene, and what does it cost me?"

use super::bench::EXACT;
use super::run::Row;
use super::summary::Summary;
use super::{Compared, words};

/// Medians of one run differ from those of the next by as much.
const AS_CHEAP: f64 = 1.05;

/// The row to choose: of those with the fewest wrong pixels in the interior (none, it is to be hoped: they are faults of
/// the method, where one along an edge is a matter of resolution) the cheapest; and of those that cost hardly more, the
/// one with the fewest wrong pixels in all.
pub fn choice(summaries: &[Summary]) -> usize {
    let cost = |i: usize| summaries[i].frame.ratio;
    let by_cost = |a: &usize, b: &usize| cost(*a).total_cmp(&cost(*b));
    let least = summaries.iter().map(|row| row.interior).min();
    let rows = 0..summaries.len();
    let cleanest: Vec<usize> = rows
        .filter(|i| Some(summaries[*i].interior) == least)
        .collect();
    let cheapest = cleanest.iter().copied().min_by(by_cost);
    let limit = AS_CHEAP * cost(cheapest.expect("a report has a row"));
    let as_cheap = cleanest.into_iter().filter(|i| cost(*i) <= limit);
    let by_errors = |a: &usize, b: &usize| summaries[*a].wrong.cmp(&summaries[*b].wrong);
    as_cheap
        .min_by(|a, b| by_errors(a, b).then(by_cost(a, b)))
        .expect("the cheapest is as cheap as itself")
}

/// From the row that was chosen on, those as clean in the interior that buy fewer wrong pixels with more time.
fn more_exact(summaries: &[Summary], chosen: usize) -> Vec<usize> {
    let cost = |i: usize| summaries[i].frame.ratio;
    let mut dearer: Vec<usize> = (0..summaries.len())
        .filter(|i| summaries[*i].interior == summaries[chosen].interior && cost(*i) > cost(chosen))
        .collect();
    dearer.sort_by(|a, b| cost(*a).total_cmp(&cost(*b)));
    let mut fewest = summaries[chosen].wrong;
    dearer.retain(|i| {
        let fewer = summaries[*i].wrong < fewest;
        fewest = fewest.min(summaries[*i].wrong);
        fewer
    });
    dearer
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
    let others: Vec<String> = more_exact(summaries, chosen)
        .into_iter()
        .map(|i| {
            let (ratio, wrong) = (words::ratio(summaries[i].frame.ratio), summaries[i].wrong);
            format!("{} ({ratio} ×, {wrong} wrong)", name(i))
        })
        .collect();
    if !others.is_empty() {
        text += &format!(" More exact, for more time: {}.", others.join(", "));
    }
    text
}

/// What a test that is no handout's must not be: worse than the handout's. The exact one not by a pixel, any other one not
/// in the interior.
pub fn faults(compared: &Compared, summaries: &[Summary]) -> Vec<String> {
    let handouts = &summaries[0];
    let rows = compared.rows.iter().zip(summaries);
    let worse = rows.filter(|(row, summary)| {
        let tests = row.differences.iter();
        let mut tests = tests.filter_map(|text| text.strip_prefix("shadow_test="));
        tests.any(|test| match test {
            "handout" => false,
            EXACT => summary.wrong > handouts.wrong,
            _ => summary.interior > handouts.interior,
        })
    });
    let line = |(row, summary): (&Row, &Summary)| {
        format!(
            "{} is worse than the handout's settings: {} wrong pixels, {} of them in the interior, where those have {} and {}",
            words::name(row),
            summary.wrong,
            summary.interior,
            handouts.wrong,
            handouts.interior
        )
    };
    worse.map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::super::run::Calls;
    use super::super::summary::Timing;
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
            shadow_pass_in_gl: 0.0,
            lighting_in_gl: 0.0,
            look_ups: None,
            outside_gl: 0.0,
            outside_gl_ms: 0.0,
            wrong,
            interior,
            valid: 1000,
            on_front: true,
        }
    }

    fn compared(settings: &[&str]) -> Compared {
        let row = |setting: &&str| Row {
            differences: setting.split_whitespace().map(str::to_owned).collect(),
            calls: Calls { frame: 1, rest: 1 },
            bytes: Default::default(),
            figures: Vec::new(),
            thumbnails: Vec::new(),
            times: Vec::new(),
        };
        Compared {
            title: String::new(),
            set: Vec::new(),
            rows: settings.iter().map(row).collect(),
        }
    }

    #[test]
    fn a_test_that_is_worse_than_the_handouts_is_told() {
        let settings = ["", "shadow_test=exact", "shadow_test=offset", "stage=pcf"];
        let compared = compared(&settings);
        let same = [1.0, 1.0];
        let rows = |exact: usize, offset: usize| {
            [
                row(1.0, same, 90, 0),
                row(1.0, same, exact, 0),
                row(1.0, same, 95, offset),
                row(1.0, same, 99, 9),
            ]
        };
        assert_eq!(faults(&compared, &rows(90, 0)), [""; 0]);
        let told = faults(&compared, &rows(91, 0));
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].starts_with("shadow_test=exact is worse"),
            "{told:?}"
        );
        let told = faults(&compared, &rows(0, 1));
        assert!(
            told[0].starts_with("shadow_test=offset is worse"),
            "{told:?}"
        );
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
        assert_eq!(more_exact(&rows, 3), [2]);
        // The control: without the clean ones, the fewest errors.
        assert_eq!(choice(&rows[..2]), 1);
    }

    #[test]
    fn of_those_that_cost_hardly_more_one_with_the_fewest_errors_is_chosen() {
        let rows = [
            row(1.0, [1.0, 1.0], 90, 0),
            row(1.01, [0.97, 1.04], 20, 0),
            row(0.99, [0.97, 1.02], 50, 0),
            row(1.2, [1.1, 1.3], 0, 0),
        ];
        assert_eq!(choice(&rows), 1);
    }
}
