//! The report as one page that needs no other file.

use maud::{Markup, PreEscaped, html};

use super::run::Row;
use super::sheet::sheet;
use super::summary::{Summary, Timing};
use super::{Compared, LabReport, Report, advice, bars, plot, thumbnail, words};
use crate::labs::Setting;
use crate::measure::{Figures, Wrong};

pub fn page(report: &Report) -> Markup {
    let interrupted = report
        .interrupted
        .map(|rounds| format!("INTERRUPTED: of {rounds} rounds, only those that were finished."));
    let body = html! {
        (reading())
        @for lab in &report.labs { (of_lab(lab)) }
    };
    sheet("Speed against error", &report.machine, interrupted, body)
}

/// How to read what follows.
fn reading() -> Markup {
    html! {
        details {
            summary { "What the figures mean" }
            p {
                "All rows of a lab are visited once in every round, in changing order. A ratio is that of a row's time to \
                 the handout's row of the same round: the median over the rounds, and between which values the true median \
                 lies with 95 % certainty, by order statistics. Times are wall time from an idle driver to an idle driver: \
                 the median, and the 95th percentile behind it. " b { "moving" } ": light or casters move, so the shadow \
                 pass is drawn. " b { "at rest" } ": the map of an earlier frame serves on. Shadow pass and lighting are \
                 each waited for, so their sum may be more than the frame. " b { "look-ups" } ": what the lighting takes more than in \
                 the row with shadows=off, of the same round. Where a lab's shader only branches around its test, a \
                 software driver looks up all the same, and they seem to cost nothing. " b { "shading" } ": the rest of \
                 the lighting. " b { "outside GL" } " is the share of such a \
                 frame in which the program was in no GL call, its clock counted in: an upper bound."
            }
            p {
                b { "MiB" } ": storage that the driver was asked for, as drivers hold it (three channels in the room of \
                 four); behind it, how much of that is drawn into: the shadow maps. Not counted: the window's own \
                 framebuffer, programs, what a driver keeps beside."
            }
            p {
                "Wrong pixels are counted against rays in f64. " b { "False shadow" } ": lit in truth, dark here. "
                b { "False light" } ": the other way round. " b { "edge1" } ": within a pixel of a change in the truth; "
                b { "edgeT" } ": within a texel of the map, which it cannot resolve; " b { "interior" } ": a fault of the \
                 method. " b { "Grey" } ": lit in truth, below 95 % here, in the interior. " b { "Gap" } ": the strip of \
                 light between a caster and its shadow, in world units. " b { "Ambiguous" } ": pixels whose truth hangs on \
                 1/256 of a pixel, wrong of all: counted apart."
            }
        }
    }
}

fn of_lab(lab: &LabReport) -> Markup {
    let options = lab.options.join(" ");
    html! {
        h2 id=(lab.handout.name) { (lab.handout.title) }
        p {
            code { "shadowlab report " (lab.handout.name) " " (options) }
            " at " (lab.size[0]) "×" (lab.size[1])
        }
        @for compared in &lab.comparisons { (of_comparison(lab.handout.settings, compared)) }
    }
}

fn of_comparison(table: &[Setting], compared: &Compared) -> Markup {
    let summaries = Summary::of_rows(&compared.rows);
    let rounds = compared.rows[0].times.len();
    html! {
        h3 { (compared.title) }
        @for fault in advice::faults(compared, &summaries) { p.loud { "WORSE: " (fault) } }
        @if !compared.set.is_empty() { p { "All rows: " code { (compared.set.join(" ")) } } }
        p.advice {
            b { "Which setting do I choose for this scene, and what does it cost me? " }
            (words::capitalised(&advice::sentence(compared, &summaries)))
        }
        div.plot { (PreEscaped(plot::svg(table, compared, &summaries))) }
        ul.legend {
            @for series in plot::series(table, compared, &summaries) {
                li { b.round[series.round] style=(swatch(series.color)) {} (series.name) }
            }
        }
        p {
            "Numbers are the table's rows, as far as there is room. Filled: no wrong pixel in the interior; hollow: some. \
             The bar through a point is the 95 % interval of its cost; " (rounds) " rounds. The grey stairs are the Pareto \
             front: "
            (front(compared, &summaries)) "."
        }
        (taken_apart(&summaries))
        div.wide { (rows(compared, &summaries)) }
        h4 { "Where they are wrong" }
        p { "False shadow red, false light blue, shadow dark grey, light bright grey. A mistake of a single pixel is kept." }
        div {
            @for (i, row) in compared.rows.iter().enumerate() {
                @for light in 0..row.figures.len() { (mistakes(i, row, light)) }
            }
        }
    }
}

/// The rows of the Pareto front, from the cheapest to the most exact.
fn front(compared: &Compared, summaries: &[Summary]) -> String {
    let mut rows: Vec<usize> = (0..summaries.len())
        .filter(|i| summaries[*i].on_front)
        .collect();
    rows.sort_by(|a, b| {
        summaries[*a]
            .frame
            .ratio
            .total_cmp(&summaries[*b].frame.ratio)
    });
    let names = rows
        .iter()
        .map(|i| format!("{} {}", i + 1, words::name(&compared.rows[*i])));
    names.collect::<Vec<_>>().join("; ")
}

fn swatch([red, green, blue]: [u8; 3]) -> String {
    format!("background: rgb({red}, {green}, {blue})")
}

/// The frame of each row in bars, and the handout's in words.
fn taken_apart(summaries: &[Summary]) -> Markup {
    let handouts = &summaries[0];
    let ms = words::milliseconds;
    html! {
        h4 { "The frame, taken apart" }
        p {
            "The handout's: shadow pass " (ms(handouts.shadow_pass[0])) " ms, "
            @match (&handouts.look_ups, handouts.shading()) {
                (Some(look_ups), Some(shading)) => {
                    "look-ups " (ms(look_ups.ms)) " ms ("
                    @match look_ups.interval_95 {
                        Some([low, high]) => { "95 %: " (ms(low)) " to " (ms(high)) }
                        None => { "too few rounds to be sure" }
                    }
                    "), the rest of the shading " (ms(shading)) " ms, "
                }
                _ => { "lighting with its look-ups " (ms(handouts.lighting[0])) " ms, " }
            }
            "outside of GL " (words::percent(handouts.outside_gl)) "."
        }
        div.plot { (PreEscaped(bars::svg(summaries))) }
        ul.legend {
            @for (name, color) in bars::legend(summaries) { li { b style=(swatch(color)) {} (name) } }
        }
    }
}

fn rows(compared: &Compared, summaries: &[Summary]) -> Markup {
    let chosen = advice::choice(summaries);
    html! {
        table {
            thead {
                tr {
                    th {} th {}
                    th colspan="2" { "× the handout's (95 %)" }
                    th colspan="2" { "wrong pixels: all = edge1 + edgeT + interior" }
                    th {} th {} th {}
                    th colspan="4" { "ms (p95)" }
                    th colspan="2" { "ms" }
                    th {} th { "GL calls" } th { "MiB" }
                }
                tr {
                    th { "#" } th.name { "settings" }
                    th { "moving" } th { "at rest" }
                    th { "false shadow" } th { "false light" }
                    th { "grey" } th { "gap" } th { "ambiguous" }
                    th { "moving" } th { "at rest" } th { "shadow pass" } th { "lighting" }
                    th { "look-ups" } th { "shading" }
                    th { "outside GL" } th { "moving, at rest" } th { "all (maps)" }
                }
            }
            tbody {
                @for (i, (row, summary)) in compared.rows.iter().zip(summaries).enumerate() {
                    tr.chosen[i == chosen].front[summary.on_front] {
                        td { (i + 1) } td.name { (words::name(row)) }
                        @for timing in [&summary.frame, &summary.rest] { td { (ratio(timing)) } }
                        td { (of_lights(row, |figures| wrong(&figures.false_shadow))) }
                        td { (of_lights(row, |figures| wrong(&figures.false_light))) }
                        td { (of_lights(row, |figures| figures.grey.to_string())) }
                        td { (of_lights(row, gap)) }
                        td { (of_lights(row, ambiguous)) }
                        @for Timing { ms, ms_95, .. } in [&summary.frame, &summary.rest] {
                            td { (milliseconds([*ms, *ms_95])) }
                        }
                        td { (milliseconds(summary.shadow_pass)) } td { (milliseconds(summary.lighting)) }
                        td { (or_dash(summary.look_ups.as_ref().map(|look_ups| look_ups.ms))) }
                        td { (or_dash(summary.shading())) }
                        td { (words::percent(summary.outside_gl)) }
                        td { (row.calls.frame) ", " (row.calls.rest) }
                        td { (words::mebibytes(row.bytes.total())) " (" (words::mebibytes(row.bytes.drawn_into)) ")" }
                    }
                }
            }
        }
    }
}

pub fn ratio(timing: &Timing) -> String {
    let ratio = words::ratio(timing.ratio);
    match timing.ratio_95 {
        Some(interval) => format!("{ratio} ({})", words::interval(Some(interval))),
        None => ratio,
    }
}

pub fn milliseconds([median, percentile_95]: [f64; 2]) -> String {
    format!(
        "{} ({})",
        words::milliseconds(median),
        words::milliseconds(percentile_95)
    )
}

/// Milliseconds, where there are any.
fn or_dash(milliseconds: Option<f64>) -> String {
    milliseconds.map_or("–".to_owned(), words::milliseconds)
}

/// What is said of each light, one behind the other.
fn of_lights(row: &Row, text: impl Fn(&Figures) -> String) -> String {
    row.figures.iter().map(text).collect::<Vec<_>>().join(" | ")
}

pub fn wrong(wrong: &Wrong) -> String {
    let Wrong {
        edge1,
        edge_t,
        interior,
        ..
    } = wrong;
    format!("{} = {edge1} + {edge_t} + {interior}", wrong.total())
}

pub fn gap(figures: &Figures) -> String {
    figures
        .contact_gap
        .map_or("–".to_owned(), |gap| format!("{:.3}", gap.world))
}

pub fn ambiguous(figures: &Figures) -> String {
    let wrong = figures.false_shadow.ambiguous + figures.false_light.ambiguous;
    format!("{wrong} of {}", figures.ambiguous)
}

fn mistakes(i: usize, row: &Row, light: usize) -> Markup {
    let picture = thumbnail::data_url(&row.thumbnails[light]);
    let figures = &row.figures[light];
    html! {
        figure {
            img src=(picture) alt="the mistakes";
            figcaption {
                b { (i + 1) } " " (words::name(row))
                @if row.figures.len() > 1 { ", light " (light + 1) }
                ": " (figures.false_shadow.total()) " falsely shadowed, " (figures.false_light.total()) " falsely lit"
            }
        }
    }
}
