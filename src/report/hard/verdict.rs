//! Whether a test held on a case, and whether that was expected.

use super::{CaseReport, HardReport, Tested, anchor};
use crate::hard::{self, Expected};
use crate::measure::Figures;
use crate::report::words;

/// How a test did, whatever was expected of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Wrong or grey in the interior.
    Fails,
    /// Wrong along the shadows' edges at most, but so often within a texel of them that the shadow is another one.
    Unresolved,
    /// Wrong along the shadows' edges at most.
    Holds,
    /// No pixel is wrong but where the truth itself is ambiguous.
    Exact,
}

/// More than so many of the pixels that face the light: wires of half a texel lose half of their shadow, and no pixel of
/// it is in the interior.
const RESOLVED: f64 = 0.01;

impl Verdict {
    pub fn of(figures: &Figures) -> Self {
        let edge_t = figures.false_shadow.edge_t + figures.false_light.edge_t;
        let valid = figures.lit + figures.shadowed;
        if Expected::Exact.is_met(figures) && figures.grey == 0 {
            Self::Exact
        } else if !Expected::Holds(0, 0).is_met(figures) {
            Self::Fails
        } else if edge_t as f64 > RESOLVED * valid as f64 {
            Self::Unresolved
        } else {
            Self::Holds
        }
    }

    /// In one word, which is its class on the page, too.
    pub fn word(self) -> &'static str {
        match self {
            Self::Fails => "fails",
            Self::Unresolved => "unresolved",
            Self::Holds => "holds",
            Self::Exact => "exact",
        }
    }
}

/// Whether it came as expected; None where nothing is promised, or where the picture has another size than the one that
/// the promises count their pixels in.
pub fn is_met(tested: &Tested, size: [u32; 2]) -> Option<bool> {
    let judged = size == hard::SIZE && tested.expected != Expected::Shown;
    judged.then(|| tested.expected.is_met(&tested.row.figures[0]))
}

/// Whether a test is a control, which must fail.
pub fn is_control(expected: Expected) -> bool {
    use Expected::{Exact, FalseLight, FalseShadow, Grey, Holds, Shown, Unresolved};
    match expected {
        FalseShadow(_) | FalseLight(_) | Grey(_) | Unresolved(_) => true,
        Holds(..) | Exact | Shown => false,
    }
}

/// What must come of a test, for a reader.
pub fn promise(expected: Expected) -> String {
    match expected {
        Expected::FalseShadow(least) => format!("control: false shadow ≥ {least}"),
        Expected::FalseLight(least) => format!("control: false light ≥ {least}"),
        Expected::Grey(least) => format!("control: grey ≥ {least}"),
        Expected::Unresolved(least) => format!("control: unresolved ≥ {least}"),
        Expected::Holds(0, 0) => "must hold".to_owned(),
        Expected::Holds(grey, light) => format!("must hold but for {grey} grey, {light} lit"),
        Expected::Exact => "must be exact".to_owned(),
        Expected::Shown => String::new(),
    }
}

impl CaseReport {
    /// How a shadow test did with everything else as the handout has it.
    pub fn of_shadow_test(&self, shadow_test: &str) -> Option<&Tested> {
        let mut rows = self.rows.iter();
        rows.find(|row| row.shadow_test == Some(shadow_test) && row.depth_format.is_empty())
    }
}

/// Of one shadow test: how many cases it was put to, held, and was exact on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    pub shadow_test: &'static str,
    pub cases: usize,
    pub holds: usize,
    pub exact: usize,
}

/// One for each shadow test that any case's lab has, in the labs' order.
pub fn scores(report: &HardReport) -> Vec<Score> {
    let mut scores: Vec<Score> = Vec::new();
    for case in &report.cases {
        for shadow_test in case.shadow_tests {
            let Some(tested) = case.of_shadow_test(shadow_test) else {
                continue;
            };
            let verdict = Verdict::of(&tested.row.figures[0]);
            let index = scores.iter().position(|s| s.shadow_test == *shadow_test);
            let index = index.unwrap_or_else(|| {
                scores.push(Score {
                    shadow_test,
                    cases: 0,
                    holds: 0,
                    exact: 0,
                });
                scores.len() - 1
            });
            let score = &mut scores[index];
            score.cases += 1;
            score.holds += usize::from(verdict >= Verdict::Holds);
            score.exact += usize::from(verdict == Verdict::Exact);
        }
    }
    scores
}

/// What came otherwise than expected, one line each.
pub fn broken(report: &HardReport) -> Vec<String> {
    let cases = report.cases.iter();
    let tests = cases.flat_map(|case| case.rows.iter().map(move |tested| (case, tested)));
    let broken = tests.filter(|(_, tested)| is_met(tested, report.size) == Some(false));
    let line = |(case, tested): (&CaseReport, &Tested)| {
        let figures = &tested.row.figures[0];
        format!(
            "{}, {}: {}, found {} falsely dark and {} falsely lit in the interior, {} grey, {} wrong in all",
            case.case.name,
            words::name(&tested.row),
            promise(tested.expected),
            figures.false_shadow.interior,
            figures.false_light.interior,
            figures.grey,
            figures.false_shadow.total() + figures.false_light.total(),
        )
    };
    broken.map(line).collect()
}

pub fn summary(report: &HardReport) -> Vec<String> {
    let of_test = |score: &Score| {
        format!(
            "shadow_test={}: holds {} of {} cases, is exact to the pixel on {}",
            score.shadow_test, score.holds, score.cases, score.exact
        )
    };
    let mut lines: Vec<String> = scores(report).iter().map(of_test).collect();
    let tests = report.cases.iter().flat_map(|case| &case.rows);
    let judged: Vec<_> = tests
        .filter_map(|tested| is_met(tested, report.size).map(|met| (tested.expected, met)))
        .collect();
    if judged.is_empty() {
        let [width, height] = hard::SIZE;
        lines.push(format!(
            "what is expected of each test counts pixels of {width}×{height}: not judged at this size"
        ));
    } else {
        let count = |controls: bool, met_only: bool| {
            let of_kind = judged
                .iter()
                .filter(|(expected, met)| is_control(*expected) == controls && (*met || !met_only));
            of_kind.count()
        };
        lines.push(format!(
            "{} of {} controls fail as they must, {} of {} promises are kept",
            count(true, true),
            count(true, false),
            count(false, true),
            count(false, false)
        ));
    }
    let broken = broken(report);
    lines.extend(broken.iter().map(|line| format!("NOT AS EXPECTED: {line}")));
    if !report.anchor.is_empty() {
        lines.push(format!(
            "closed form: {} planes, at most {:.2} percentage points off",
            report.anchor.len(),
            100.0 * anchor::worst(&report.anchor)
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::trace::Bytes;
    use crate::measure::Wrong;
    use crate::report::{Calls, Machine, Row};

    fn figures(false_shadow: Wrong, grey: usize) -> Figures {
        Figures {
            lit: 1000,
            shadowed: 1000,
            ambiguous: 0,
            false_shadow,
            false_light: Wrong::default(),
            grey,
            contact_gap: None,
            bias: None,
        }
    }

    fn interior(pixels: usize) -> Figures {
        let wrong = Wrong {
            interior: pixels,
            ..Wrong::default()
        };
        figures(wrong, pixels)
    }

    fn tested(shadow_test: &'static str, expected: Expected, figures: Figures) -> Tested {
        Tested {
            row: Row {
                differences: vec![format!("shadow_test={shadow_test}")],
                calls: Calls { frame: 1, rest: 1 },
                bytes: Bytes::default(),
                figures: vec![figures],
                thumbnails: vec![Vec::new()],
                times: Vec::new(),
            },
            expected,
            shadow_test: Some(shadow_test),
            depth_format: String::new(),
        }
    }

    fn report(rows: Vec<Tested>, size: [u32; 2]) -> HardReport {
        HardReport {
            machine: Machine {
                renderer: String::new(),
                driver: String::new(),
                software: true,
                cpu: String::new(),
                threads: 1,
                system: String::new(),
            },
            size,
            rounds: 1,
            cases: vec![CaseReport {
                case: hard::find("wall").unwrap(),
                shadow_tests: &["handout", "exact"],
                rows,
            }],
            anchor: Vec::new(),
            interrupted: false,
        }
    }

    #[test]
    fn a_pixel_in_the_interior_fails_and_one_at_an_edge_does_not() {
        let edge = Wrong {
            edge1: 1,
            edge_t: 5,
            ..Wrong::default()
        };
        assert_eq!(Verdict::of(&interior(0)), Verdict::Exact);
        assert_eq!(Verdict::of(&figures(edge, 0)), Verdict::Holds);
        assert_eq!(Verdict::of(&figures(edge, 1)), Verdict::Fails);
        let many = Wrong {
            edge_t: 21,
            ..Wrong::default()
        };
        assert_eq!(Verdict::of(&figures(many, 0)), Verdict::Unresolved);
        assert_eq!(Verdict::of(&interior(1)), Verdict::Fails);
    }

    #[test]
    fn a_promise_that_is_broken_is_told() {
        let rows = |control: usize, exact: usize| {
            vec![
                tested("handout", Expected::FalseShadow(50), interior(control)),
                tested("exact", Expected::Exact, interior(exact)),
            ]
        };
        let kept = summary(&report(rows(50, 0), hard::SIZE));
        assert_eq!(kept.len(), 3, "{kept:?}");
        assert!(kept[0].contains("handout: holds 0 of 1"), "{kept:?}");
        assert!(kept[1].contains("exact: holds 1 of 1"), "{kept:?}");
        assert!(kept[2].starts_with("1 of 1 controls fail as they must, 1 of 1 promises"));

        // The controls: an exact test that is wrong, and a control that does not fail.
        let wrong = summary(&report(rows(50, 1), hard::SIZE));
        assert!(wrong[3].starts_with("NOT AS EXPECTED: wall, shadow_test=exact: must be exact"));
        let harmless = summary(&report(rows(49, 0), hard::SIZE));
        assert!(harmless[3].starts_with("NOT AS EXPECTED: wall, shadow_test=handout: control"));

        // At another size nobody knows how many pixels there must be.
        let small = summary(&report(rows(0, 1), [64, 48]));
        assert!(small[2].contains("not judged"), "{small:?}");
        assert_eq!(small.len(), 3);
    }
}
