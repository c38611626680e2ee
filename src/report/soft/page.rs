//! The report as one page that needs no other file, and what it comes to in sentences.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::errors::{Draws, Errors};
use super::plot::{COLORS, Curve, Guide, Plot};
use super::times::{cost, find, ratio};
use super::{AMOUNTS, COUNTS, JITTERS, METHODS, SoftReport, choices, fit, times};
use crate::report::words;

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    .loud { background: #b00020; color: #fff; padding: 0.6rem 1rem; font-weight: bold; }
    .advice { border-left: 4px solid #0072b2; padding-left: 0.8rem; max-width: 60rem; }
    .plot svg { max-width: 100%; height: auto; }
    .legend { list-style: none; padding: 0; font-size: 0.9rem; }
    .legend li { display: inline-block; margin-right: 1.4rem; }
    .legend b { display: inline-block; width: 0.8rem; height: 0.8rem; margin-right: 0.4rem; }
    .wide { overflow-x: auto; }
    table { border-collapse: collapse; font-size: 0.8rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
    th, td { border-bottom: 1px solid #ddd; padding: 0.15rem 0.5rem; text-align: right; }
    th { border-bottom-color: #888; vertical-align: bottom; }
    td.name { text-align: left; }
    code { font-size: 0.85rem; color: #555; }
";

/// The accumulation buffer that the curves of light counts are drawn for: the handout's.
const HANDOUTS: &str = "RGB32F";

/// How many lights the handout says show banding in 16 bits.
const BANDING: usize = 4;

/// The share of values on another level that a person may see as a band.
const SEEN: f64 = 0.01;

pub fn page(report: &SoftReport) -> Markup {
    let machine = &report.machine;
    let options = report.options.join(" ");
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "shadowlab: soft shadows" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Soft shadows: error and time against the number of lights" }
                @if machine.software {
                    p.loud { "SOFTWARE RENDERER: these are the times of a CPU. A GPU has others, and other ratios." }
                }
                @if report.interrupted { p.loud { "INTERRUPTED: only what was finished." } }
                p {
                    "Drawn by " b { (machine.renderer) } ", driver " b { (machine.driver) } ", on "
                    b { (machine.cpu) } " (" (machine.threads) " threads, " (machine.system) ")."
                }
                h2 { (report.handout.title) }
                p {
                    code { "shadowlab report " (report.handout.name) " " (options) } ", timed at " (report.size[0]) "×"
                    (report.size[1]) "; errors are those of pictures of at most " (super::ERROR_SIZE) " pixels along a side."
                }
                @for sentence in sentences(report) { p.advice { (sentence) } }
                (error_against_lights(report))
                (accumulators(report))
                (error_against_time(report))
                (equal(report))
                (methods(report))
                (hard(report))
            }
        }
    }
}

/// What a person wants to know first.
pub fn sentences(report: &SoftReport) -> Vec<String> {
    let mut sentences = Vec::new();
    for amount in AMOUNTS {
        sentences.extend(fewer_lights(report, amount));
    }
    sentences.extend(banding(report));
    for amount in AMOUNTS {
        sentences.extend(speed(report, amount));
    }
    sentences
}

/// How many evenly spread lights do what the most random ones do.
fn fewer_lights(report: &SoftReport, amount: f64) -> Option<String> {
    let draws = |jitter: &str| draws(report, amount, jitter);
    let (random, even) = (draws(JITTERS[0]), draws(JITTERS[1]));
    let most = random
        .iter()
        .find(|draws| draws.count == COUNTS[COUNTS.len() - 1])?;
    let enough = even.iter().find(|draws| draws.mean() <= most.mean());
    let reached = match enough {
        Some(enough) => format!(
            "{} lights of low discrepancy reach that: {:.4}",
            enough.count,
            enough.mean()
        ),
        None => "no number of lights of low discrepancy reaches that".to_owned(),
    };
    Some(format!(
        "Jitter {amount}: the error (root mean square of visibility, {} draws) of {} random lights is {:.4}; {reached}. \
         It falls with the power {:.2} of the number of lights at random, {:.2} at low discrepancy.",
        most.rms.len(),
        most.count,
        most.mean(),
        slope(&random),
        slope(&even),
    ))
}

fn draws<'a>(report: &'a SoftReport, amount: f64, jitter: &str) -> Vec<&'a Draws> {
    let draws = report.found.draws.iter();
    draws
        .filter(|draws| draws.amount == amount && draws.jitter == jitter)
        .collect()
}

fn slope(draws: &[&Draws]) -> f64 {
    let points = draws.iter().map(|draws| (draws.count as f64, draws.mean()));
    fit::power(&points.collect::<Vec<_>>())
}

/// "Even with GL_RGB16F, one starts to see banding at numJitters ≥ 4", in levels.
fn banding(report: &SoftReport) -> Option<String> {
    let of_16_bits = report
        .found
        .errors
        .iter()
        .filter(|errors| errors.accumulator == "RGB16F");
    let of_16_bits: Vec<_> = of_16_bits.collect();
    let worst = |from: usize, to: usize| {
        let rows = of_16_bits
            .iter()
            .filter(|errors| (from..=to).contains(&errors.count));
        rows.max_by(|a, b| a.from_mean.max.total_cmp(&b.from_mean.max))
    };
    let (few, handouts) = (worst(1, BANDING - 1)?, worst(BANDING, BANDING)?);
    let most = of_16_bits
        .iter()
        .max_by(|a, b| a.from_mean.max.total_cmp(&b.from_mean.max))?;
    let said = |errors: &Errors| {
        let share = words::percent(errors.other_level);
        format!(
            "{:.2} levels at {} ({share})",
            errors.from_mean.max, errors.count
        )
    };
    let is_seen = |errors: &&&Errors| errors.other_level > SEEN;
    let first = of_16_bits.iter().filter(is_seen).map(|e| e.count).min();
    let first = first.map_or("nowhere".to_owned(), |count| {
        format!("from {count} lights on")
    });
    Some(format!(
        "\"Even with GL_RGB16F, one starts to see banding at numJitters ≥ {BANDING}\": the largest error from the mean of the \
         renders, and the share of values that are another level, is {}, {}, and at most {}; of it 0.5 is the last rounding to \
         8 bits. More than {} are another level {first}.",
        said(few),
        said(handouts),
        said(most),
        words::percent(SEEN),
    ))
}

/// What the fast method saves.
fn speed(report: &SoftReport, amount: f64) -> Option<String> {
    let rows = &report.found.times;
    let most = times::COUNTS[times::COUNTS.len() - 1];
    let [handout, fast] = METHODS.map(|method| find(rows, method, amount, most));
    let ratio = ratio(fast?, handout?);
    let [of_handout, of_fast] = METHODS.map(|method| cost(rows, method, amount));
    let [handouts_start, handouts_light] = of_handout?;
    let [start, light] = of_fast?;
    Some(format!(
        "Jitter {amount}: at {most} lights the fast method takes {} of the handout's time (95 %: {}). Each light costs {:.2} ms \
         instead of {:.2}, everything else {:.1} instead of {:.1}.",
        words::ratio(ratio.median()),
        words::interval(ratio.interval_95()),
        light.median(),
        handouts_light.median(),
        start.median(),
        handouts_start.median(),
    ))
}

fn legend(curves: &[Curve]) -> Markup {
    html! {
        ul.legend {
            @for Curve { name, color: [red, green, blue], .. } in curves {
                li { b style=(format!("background: rgb({red}, {green}, {blue})")) {} (name) }
            }
        }
    }
}

fn powers_of_two() -> Vec<f64> {
    COUNTS.map(|count| count as f64).to_vec()
}

fn error_against_lights(report: &SoftReport) -> Markup {
    let kinds = AMOUNTS
        .iter()
        .flat_map(|amount| JITTERS.map(|jitter| (*amount, jitter)));
    let kinds: Vec<_> = kinds
        .filter(|(amount, jitter)| !draws(report, *amount, jitter).is_empty())
        .collect();
    let curve = |((amount, jitter), color): (&(f64, &'static str), [u8; 3])| {
        let draws = draws(report, *amount, jitter);
        Curve {
            name: format!("{jitter}, jitter {amount}: power {:.2}", slope(&draws)),
            color,
            points: draws
                .iter()
                .map(|draws| (draws.count as f64, draws.mean()))
                .collect(),
            ranges: draws.iter().map(|draws| draws.range()).collect(),
        }
    };
    let curves: Vec<Curve> = kinds.iter().zip(COLORS).map(curve).collect();
    let Some(start) = curves
        .iter()
        .filter_map(|curve| curve.points.first())
        .max_by(|a, b| a.1.total_cmp(&b.1))
    else {
        return html! {};
    };
    let through = (start.0, 1.2 * start.1);
    let guide = |name, slope| Guide {
        name,
        slope,
        through,
    };
    let guides = [guide("power −1/2", -0.5), guide("power −1", -1.0)];
    let plot = Plot {
        x: "number of lights",
        y: "error of visibility, root mean square",
        curves: &curves,
        guides: &guides,
        x_ticks: powers_of_two(),
    };
    html! {
        h3 { "Error against the light's integral" }
        p {
            "Visibility (1 lit, 0 in shadow) against the share of the light's cube that each pixel sees, by rays in f64; all \
             pixels that can be in shadow. A point is the root mean square of several draws, each with other lights; the bar \
             goes from the luckiest of them to the unluckiest. The thin lines fall as the power −1/2, which is chance, and −1; of lights that are spread evenly in a cube that a shadow's edge cuts in two, −2/3 is to be expected."
        }
        div.plot { (PreEscaped(plot.svg())) }
        (legend(&curves))
        div.wide { table {
            thead { tr { th { "lights" } @for (amount, jitter) in &kinds { th { (jitter) ", " (amount) } } } }
            tbody { @for count in COUNTS { tr {
                td { (count) }
                @for (amount, jitter) in &kinds {
                    td { @if let Some(draws) = draws(report, *amount, jitter).iter().find(|draws| draws.count == count) {
                        (format!("{:.4} ({:.4}–{:.4})", draws.mean(), draws.range()[0], draws.range()[1]))
                    } }
                }
            } } }
        } }
        @if let Some(draws) = report.found.draws.last() {
            p { "The integral itself is uncertain by some " (format!("{:.4}", draws.uncertain)) " at jitter " (draws.amount) "." }
        }
    }
}

fn accumulators(report: &SoftReport) -> Markup {
    let errors = &report.found.errors;
    let names = choices(report.handout, "accumulator");
    let of = |amount: f64, jitter: &'static str, name: &'static str| {
        let rows = errors
            .iter()
            .filter(move |e| e.amount == amount && e.jitter == jitter && e.accumulator == name);
        rows.collect::<Vec<_>>()
    };
    html! {
        h3 { "What the accumulation buffer loses" }
        p {
            "The picture against the mean of the same renders in f64: the largest error, in levels of 255. 0.5 is what the \
             window's 8 bits cost in the end. Behind it, the share of values that are another level than the mean is rounded \
             to. Then visibility against the light's integral: root mean square. Formats that lose the same lie on each other in the \
             plots."
        }
        @for amount in AMOUNTS { @for jitter in JITTERS {
            @if !of(amount, jitter, HANDOUTS).is_empty() {
                h4 { "Jitter " (amount) ", " (jitter) }
                @let curves: Vec<Curve> = names.iter().zip(COLORS).map(|(name, color)| Curve {
                    name: (*name).to_owned(),
                    color,
                    points: of(amount, jitter, name).iter().map(|e| (e.count as f64, e.from_mean.max)).collect(),
                    ranges: Vec::new(),
                }).collect();
                @let plot = Plot {
                    x: "number of lights",
                    y: "largest error, levels",
                    curves: &curves,
                    guides: &[],
                    x_ticks: powers_of_two(),
                };
                div.plot { (PreEscaped(plot.svg())) }
                (legend(&curves))
                div.wide { table {
                    thead { tr { th { "lights" } @for name in names { th { (name) } } } }
                    tbody { @for count in COUNTS { tr {
                        td { (count) }
                        @for name in names {
                            td { @if let Some(e) = of(amount, jitter, name).iter().find(|e| e.count == count) {
                                (format!("{:.2} ({}) {:.4}", e.from_mean.max, words::percent(e.other_level), e.from_integral.rms))
                            } }
                        }
                    } } }
                } }
            }
        } }
    }
}

fn error_against_time(report: &SoftReport) -> Markup {
    let rows = &report.found.times;
    if rows.is_empty() {
        return html! {};
    }
    let kinds = METHODS
        .iter()
        .flat_map(|method| JITTERS.map(|jitter| (*method, jitter)));
    let kinds: Vec<_> = kinds.collect();
    html! {
        h3 { "Error against time" }
        p {
            "Times of a frame from an idle driver to an idle driver, over the handout's with one light; each number of lights \
             was timed with both methods in every one of " (rows[0].ms.len()) " rounds (of " (report.rounds) " asked for). \
             Ratios are medians of ratios within a round, with the 95 % interval."
        }
        @for amount in AMOUNTS {
            h4 { "Jitter " (amount) }
            @let curves: Vec<Curve> = kinds.iter().zip(COLORS).map(|((method, jitter), color)| Curve {
                name: format!("{method}, {jitter}"),
                color,
                points: times::COUNTS.iter().filter_map(|count| {
                    let single = find(rows, METHODS[0], amount, 1)?;
                    let own = find(rows, method, amount, *count)?;
                    let draws = draws(report, amount, jitter);
                    let error = draws.iter().find(|draws| draws.count == *count)?;
                    Some((ratio(own, single).median(), error.mean()))
                }).collect(),
                ranges: Vec::new(),
            }).collect();
            @let ticks = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
            @let plot = Plot {
                x: "time of a frame, × the handout's with one light",
                y: "error of visibility, root mean square",
                curves: &curves,
                guides: &[],
                x_ticks: ticks.to_vec(),
            };
            div.plot { (PreEscaped(plot.svg())) }
            (legend(&curves))
            div.wide { table {
                thead { tr { th { "lights" } @for method in METHODS { th { (method) ", ms" } } th { "fast / handout (95 %)" } } }
                tbody { @for count in times::COUNTS { tr {
                    td { (count) }
                    @for method in METHODS {
                        td { @if let Some(row) = find(rows, method, amount, count) { (words::milliseconds(row.median())) } }
                    }
                    @if let [Some(handout), Some(fast)] = METHODS.map(|method| find(rows, method, amount, count)) {
                        @let ratio = ratio(fast, handout);
                        td { (words::ratio(ratio.median())) " (" (words::interval(ratio.interval_95())) ")" }
                    }
                } } }
            } }
        }
    }
}

fn equal(report: &SoftReport) -> Markup {
    let rows = &report.found.equal;
    let names = choices(report.handout, "accumulator");
    let mut counts: Vec<usize> = rows.iter().map(|row| row.count).collect();
    counts.sort_unstable();
    counts.dedup();
    html! {
        h3 { "Renders that are all the same" }
        p { "Without any jitter, so many renders ought to give back that picture. The largest deviation, in levels." }
        div.wide { table {
            thead { tr { th { "accumulator" } @for count in &counts { th { (count) } } } }
            tbody { @for name in names { tr {
                td.name { (name) }
                @for count in &counts {
                    td { @if let Some(row) = rows.iter().find(|row| row.accumulator == *name && row.count == *count) { (row.levels) } }
                }
            } } }
        } }
    }
}

fn methods(report: &SoftReport) -> Markup {
    html! {
        h3 { "The fast method's picture against the handout's" }
        div.wide { table {
            thead { tr { th { "jitter" } th { "lights" } th { "largest difference, levels" } th { "pixels beyond one level" } } }
            tbody { @for row in &report.found.methods { tr {
                td { (row.amount) } td { (row.count) } td { (row.levels) } td { (words::percent(row.beyond_one)) }
            } } }
        } }
    }
}

fn hard(report: &SoftReport) -> Markup {
    html! {
        h3 { "Hard shadows on each wall" }
        p {
            "Against rays in f64. Wrong pixels, and how many of them are in the interior, away from a change of the truth by \
             more than a pixel; ambiguous pixels, whose truth hangs on 1/256 of a pixel, are counted apart."
        }
        div.wide { table {
            thead { tr {
                th { "shown" } th { "clipped" } th { "valid" } th { "ambiguous" }
                th { "false shadow (interior)" } th { "false light (interior)" } th { "wrong of the ambiguous" }
            } }
            tbody { @for row in &report.found.hard { tr {
                @let f = &row.figures;
                td.name { (row.shown) } td { @if row.clipping { "yes" } @else { "no" } }
                td { (f.lit + f.shadowed) } td { (f.ambiguous) }
                td { (f.false_shadow.total()) " (" (f.false_shadow.interior) ")" }
                td { (f.false_light.total()) " (" (f.false_light.interior) ")" }
                td { (f.false_shadow.ambiguous + f.false_light.ambiguous) }
            } } }
        } }
    }
}
