//! The scaling on one page: plots, slopes, and the figures.

use maud::{Markup, PreEscaped, html};

use super::growth::{self, COSTS};
use super::{Axis, LAB, Point, ScalingReport, Series, plot};
use crate::report::run::{Row, Times};
use crate::report::sheet::sheet;
use crate::report::statistics::Sample;
use crate::report::words;

const STYLE: &str = "
    .plots figure { width: auto; font-size: 1rem; }
    .plots figcaption { font-weight: bold; }
    tr.first td { border-top: 2px solid #888; }
    td.loud { padding: 0.15rem 0.5rem; }
";

pub fn page(report: &ScalingReport) -> Markup {
    let interrupted = report.interrupted.then(|| {
        let finished = report.axes.iter();
        let finished = finished.map(|axis| format!("{} with the {}", axis.rounds, axis.unit));
        let finished = finished.collect::<Vec<_>>().join(", ");
        format!("INTERRUPTED: of {} rounds, {finished}.", report.rounds)
    });
    let body = html! {
        style { (PreEscaped(STYLE)) }
        p.advice {
            b { "Does anything grow faster than it must? " }
            @for sentence in report.summary() { (words::capitalised(&sentence)) ". " }
        }
        p {
            code { "shadowlab report scaling" } " at " (report.size[0]) "×" (report.size[1]) ", rounds: " (report.rounds)
            ", drawn by " (LAB) ": a bumpy sphere over a floor under a spot light. Every round visits every size, in \
             changing order. Times are wall time from an idle driver to an idle driver: medians, the bars their 95 % \
             intervals by order statistics. Thin lines have slope 1."
        }
        @for axis in &report.axes { (of_axis(axis)) }
    };
    sheet("How cost grows", &report.machine, interrupted, body)
}

fn of_axis(axis: &Axis) -> Markup {
    html! {
        h2 { "With the " (axis.unit) }
        ul.legend {
            @for (i, series) in axis.series.iter().enumerate() {
                li {
                    b.round style=(format!("background: {}", plot::color(i))) {}
                    "shadow_test=" (series.shadow_test)
                    @if series.points.len() == 1 { " (no map: the same at all sizes)" }
                }
            }
        }
        div.plots {
            @for cost in &COSTS {
                figure { figcaption { (words::capitalised(cost.name)) } (PreEscaped(plot::svg(axis, cost))) }
            }
        }
        h3 { "Slopes" }
        p { "Of the logarithms, fitted in each round to the three largest sizes: median and 95 % interval." }
        (slopes(axis))
        h3 { "Figures" }
        div.wide { (figures(axis)) }
    }
}

fn slopes(axis: &Axis) -> Markup {
    let growths = growth::growths(axis);
    html! {
        table {
            thead {
                tr { th.name { "test" } @for cost in &COSTS { th { (cost.name) } } }
            }
            tbody {
                @for of_test in growths.chunks(COSTS.len()) {
                    tr {
                        td.name { "shadow_test=" (of_test[0].shadow_test) }
                        @for growth in of_test {
                            td.loud[growth.is_faster()] {
                                (words::ratio(growth.slope))
                                @if let Some(interval) = growth.slope_95 { " (" (words::interval(Some(interval))) ")" }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn figures(axis: &Axis) -> Markup {
    html! {
        table {
            thead {
                tr {
                    th.name { "test" } th { (axis.unit) } th { "× the handout's (95 %)" }
                    th { "moving, ms (p95)" } th { "at rest, ms (p95)" } th { "pass or buffer, ms (p95)" }
                    th { "MiB (maps)" } th { "wrong pixels (interior)" }
                }
            }
            tbody {
                @for series in &axis.series {
                    @for (i, point) in series.points.iter().enumerate() {
                        tr.first[i == 0] { (line(axis, series, point)) }
                    }
                }
            }
        }
    }
}

fn line(axis: &Axis, series: &Series, point: &Point) -> Markup {
    let row = &point.row;
    let figures = &row.figures[0];
    let (shadow, light) = (&figures.false_shadow, &figures.false_light);
    html! {
        td.name { "shadow_test=" (series.shadow_test) }
        td { @if point.count == 0 { "any" } @else { (words::thousands(point.count)) } }
        td { (ratio(axis, point)) }
        td { (milliseconds(row, |times| times.frame)) }
        td { (milliseconds(row, |times| times.rest)) }
        td { (milliseconds(row, |times| times.shadow_pass)) }
        td { (words::mebibytes(row.bytes.total())) " (" (words::mebibytes(row.bytes.drawn_into)) ")" }
        td { (shadow.total() + light.total()) " (" (shadow.interior + light.interior) ")" }
    }
}

fn milliseconds(row: &Row, time: fn(&Times) -> f64) -> String {
    let sample = Sample::new(row.times.iter().map(time));
    format!(
        "{} ({})",
        words::milliseconds(sample.median()),
        words::milliseconds(sample.percentile_95())
    )
}

/// The ratio of a frame to the handout's of the same size and round, with the light moving.
pub fn ratios(axis: &Axis, point: &Point) -> Option<Sample> {
    let mut handouts = axis.series[0].points.iter();
    let handouts = handouts.find(|handouts| handouts.count == point.count)?;
    let rounds = point.row.times.iter().zip(&handouts.row.times);
    Some(Sample::new(
        rounds.map(|(own, handouts)| own.frame / handouts.frame),
    ))
}

fn ratio(axis: &Axis, point: &Point) -> String {
    let Some(ratios) = ratios(axis, point) else {
        return "–".to_owned();
    };
    let ratio = words::ratio(ratios.median());
    match ratios.interval_95() {
        Some(interval) => format!("{ratio} ({})", words::interval(Some(interval))),
        None => ratio,
    }
}
