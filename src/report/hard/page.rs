//! The hard cases on one page: what each shadow test holds, in pictures; the closed form; and every test in figures.

use maud::{Markup, PreEscaped, html};

use super::table;
use super::verdict::{Verdict, broken, scores, summary};
use super::{AnchorRow, CaseReport, HardReport, Tested, anchor};
use crate::hard::{THEMES, Theme, anchor::BIASES};
use crate::report::sheet::sheet;
use crate::report::summary::Summary;
use crate::report::{page, thumbnail, words};

const STYLE: &str = "
    .matrix td { white-space: normal; text-align: left; vertical-align: top; padding: 0.3rem 0.5rem; }
    .matrix td.case { width: 15rem; }
    .matrix td.cell { width: 18rem; }
    .matrix img { width: 8rem; float: left; margin-right: 0.6rem; }
    .exact b { color: #00664b; }
    .holds b { color: #0072b2; }
    .fails, .unresolved { background: #fbe3d9; }
    .fails b, .unresolved b { color: #b00020; }
    tr.theme th { text-align: left; padding-top: 1rem; font-size: 1rem; }
    tr.broken td { background: #b00020; color: #fff; }
    tr.control td { color: #777; }
    td.off { background: #b00020; color: #fff; }
";

pub fn page(report: &HardReport) -> Markup {
    let interrupted = report
        .interrupted
        .then(|| "INTERRUPTED: only the cases that were finished.".to_owned());
    let [width, height] = report.size;
    let body = html! {
        style { (PreEscaped(STYLE)) }
        @for line in broken(report) { p.loud { "NOT AS EXPECTED: " (line) } }
        p.advice {
            b { "Which test holds where? " }
            @for line in summary(report).iter().filter(|line| !line.starts_with("NOT")) {
                br; (line)
            }
        }
        p {
            code { "shadowlab report hard" } " at " (width) "×" (height) ", " (report.rounds) " rounds. "
            "Each case is a scene: " code { "shadowlab view LAB --scene hard:NAME" } "."
        }
        (reading())
        h2 { "Every case under every shadow test" }
        p {
            "False shadow red, false light blue, shadow dark grey, light bright grey. ms: the handout's frame while light or \
             casters move; ×: that of another test to it, of the same round, with its 95 % interval."
        }
        div.wide { (matrix(report)) }
        @if !report.anchor.is_empty() { (closed_form(&report.anchor)) }
        h2 { "Every test in figures" }
        p {
            "Grey lines are controls, which fail as they must; white on red: not as expected. All wrong pixels = edge1 + \
             edgeT + interior, the ambiguous ones apart."
        }
        div.wide { (table::every_test(report)) }
    };
    sheet("The hard cases", &report.machine, interrupted, body)
}

fn reading() -> Markup {
    html! {
        details {
            summary { "What the words mean" }
            p {
                b { "exact" } ": no pixel is wrong, but where the truth itself is ambiguous: its label flips under a shift of \
                 1/256 pixel. " b { "holds" } ": wrong pixels lie within a pixel of a change in the truth (edge1) or within a \
                 texel of it on the map (edgeT), where the resolution ends; none in the interior, and none that is lit is \
                 darker than 95 % there. " b { "unresolved" } ": the same, but more than 1 % of the pixels that face the light are \
                 wrong within a texel: the map is too coarse for what casts. " b { "fails" } ": some are wrong in the \
                 interior: a fault of the method. "
                b { "Gap" } ": the strip of light between a caster and its shadow. " b { "Grey" } ": lit in truth, below 95 % \
                 here, in the interior."
            }
            p {
                b { "Control" } ": a test that must fail on the case by so many pixels, or the case would be no hard one. "
                b { "Must hold" } ", " b { "must be exact" } ": what is promised. What is expected counts pixels of "
                (crate::hard::SIZE[0]) "×" (crate::hard::SIZE[1]) "; at another size it is not judged."
            }
        }
    }
}

/// The cases of a theme that were measured.
pub fn of_theme<'a>(report: &'a HardReport, theme: &Theme) -> Vec<&'a CaseReport> {
    let is_its = |case: &&CaseReport| theme.cases.iter().any(|own| own.name == case.case.name);
    report.cases.iter().filter(is_its).collect()
}

fn matrix(report: &HardReport) -> Markup {
    let scores = scores(report);
    html! {
        table.matrix {
            thead {
                tr {
                    th.name { "case" }
                    @for score in &scores {
                        th.name {
                            "shadow_test=" (score.shadow_test) br;
                            "holds " (score.holds) " of " (score.cases) ", exact on " (score.exact)
                        }
                    }
                }
            }
            tbody {
                @for theme in THEMES {
                    @let cases = of_theme(report, theme);
                    @if !cases.is_empty() {
                        tr.theme { th colspan=(1 + scores.len()) { (theme.title) } }
                    }
                    @for case in cases {
                        @for format in depth_formats(case) {
                            tr {
                                td.case {
                                    b { (case.case.name) } br;
                                    @if format.is_empty() { (case.case.about) " (" (case.case.lab) ")" }
                                    @else { code { (format) } }
                                }
                                @for score in &scores { (cell(case, score.shadow_test, format)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// That of the handout, and those that the case is put to beside.
fn depth_formats(case: &CaseReport) -> Vec<&str> {
    let shown = case.rows.iter().filter(|row| row.shadow_test.is_some());
    let mut formats: Vec<&str> = shown.map(|row| row.depth_format.as_str()).collect();
    formats.dedup();
    formats
}

fn cell(case: &CaseReport, shadow_test: &str, format: &str) -> Markup {
    let is_asked =
        |row: &Tested| row.shadow_test == Some(shadow_test) && row.depth_format == format;
    let Some(index) = case.rows.iter().position(is_asked) else {
        return html! { td.cell { "–" } };
    };
    let row = &case.rows[index].row;
    let figures = &row.figures[0];
    let verdict = Verdict::of(figures).word();
    let (shadow, light) = (&figures.false_shadow, &figures.false_light);
    let edge = [shadow, light].map(|wrong| wrong.edge1 + wrong.edge_t);
    let summary: &Summary = &case.summaries()[index];
    html! {
        td class={ "cell " (verdict) } {
            img src=(thumbnail::data_url(&row.thumbnails[0])) alt="the mistakes";
            b { (verdict) } br;
            @if shadow.interior > 0 { (shadow.interior) " falsely dark" br; }
            @if light.interior > 0 { (light.interior) " falsely lit" br; }
            @if figures.grey > shadow.interior { (figures.grey) " grey" br; }
            @if edge != [0, 0] { (edge[0] + edge[1]) " wrong at edges" br; }
            @if index == 0 { (words::milliseconds(summary.frame.ms)) " ms" }
            @else { (page::ratio(&summary.frame)) " ×" }
        }
    }
}

fn closed_form(rows: &[AnchorRow]) -> Markup {
    let worst = anchor::worst(rows);
    html! {
        h2 { "The closed form" }
        p {
            "Parallel light meets an unoccluded plane at θ from its normal, tilted about one axis of the map. With texels of \
             width w and a constant bias b, the share of it in false shadow is ½·max(0, 1 − 2b/(w·tan θ)): measured (told, \
             difference in percentage points). The largest difference is " (format!("{:.2}", 100.0 * worst)) "; within 1 is \
             asked for."
        }
        table {
            thead {
                tr {
                    th { "θ" } th { "map" }
                    @for bias in BIASES { th { "b = " (bias) " · ½ w tan θ" } }
                }
            }
            tbody {
                @for line in rows.chunks(BIASES.len()) {
                    tr {
                        td { (line[0].degrees) "°" } td { (line[0].map_size) "²" }
                        @for row in line { (anchor_cell(row)) }
                    }
                }
            }
        }
    }
}

fn anchor_cell(row: &AnchorRow) -> Markup {
    let difference = 100.0 * (row.measured - row.told);
    html! {
        td.off[difference.abs() > 1.0] {
            (words::percent(row.measured)) " (" (words::percent(row.told)) ", "
            (format!("{difference:+.2}")) ")"
        }
    }
}
