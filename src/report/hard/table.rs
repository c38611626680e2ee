//! Every test of every case, in figures.

use maud::{Markup, html};

use super::page::of_theme;
use super::verdict::{Verdict, is_control, is_met, promise};
use super::{CaseReport, HardReport, Tested};
use crate::hard::THEMES;
use crate::measure::Figures;
use crate::report::summary::Summary;
use crate::report::{page, words};

impl CaseReport {
    /// The times of its rows, to those of its first, the handout's.
    pub fn summaries(&self) -> Vec<Summary> {
        let rows: Vec<_> = self.rows.iter().map(|row| row.row.clone()).collect();
        Summary::of_rows(&rows)
    }
}

const COLUMNS: usize = 12;

pub fn every_test(report: &HardReport) -> Markup {
    html! {
        table {
            thead {
                tr {
                    th.name { "case" } th.name { "test" } th.name { "expected" } th.name { "verdict" }
                    th { "false shadow" } th { "false light" } th { "grey" } th { "gap (texels)" } th { "ambiguous" }
                    th { "× the handout's (95 %)" } th { "moving, ms (p95)" } th { "at rest, ms (p95)" }
                }
            }
            tbody {
                @for theme in THEMES {
                    @let cases = of_theme(report, theme);
                    @if !cases.is_empty() { tr.theme { th colspan=(COLUMNS) { (theme.title) } } }
                    @for case in cases {
                        @for (tested, times) in case.rows.iter().zip(case.summaries()) {
                            (line(report, case, tested, &times))
                        }
                    }
                }
            }
        }
    }
}

fn line(report: &HardReport, case: &CaseReport, tested: &Tested, times: &Summary) -> Markup {
    let figures = &tested.row.figures[0];
    let met = is_met(tested, report.size);
    let class = match met {
        Some(false) => "broken",
        Some(true) if is_control(tested.expected) => "control",
        _ => "",
    };
    html! {
        tr class=(class) {
            td.name { (case.case.name) }
            td.name { (words::name(&tested.row)) }
            td.name {
                @match met {
                    Some(true) => { "✓ " }
                    Some(false) => { "✗ " }
                    None => {}
                }
                (promise(tested.expected))
            }
            td.name { (Verdict::of(figures).word()) }
            td { (page::wrong(&figures.false_shadow)) }
            td { (page::wrong(&figures.false_light)) }
            td { (figures.grey) }
            td { (gap(figures)) }
            td { (page::ambiguous(figures)) }
            td { (page::ratio(&times.frame)) }
            td { (page::milliseconds([times.frame.ms, times.frame.ms_95])) }
            td { (page::milliseconds([times.rest.ms, times.rest.ms_95])) }
        }
    }
}

/// World units may be of any size: two digits that count.
fn gap(figures: &Figures) -> String {
    let Some(gap) = figures.contact_gap else {
        return "–".to_owned();
    };
    let texels = gap.texels.map(|texels| format!(" ({texels:.1})"));
    format!(
        "{}{}",
        words::two_digits(gap.world),
        texels.unwrap_or_default()
    )
}
