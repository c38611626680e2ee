//! The hard cases for other programs: CSV with a line for each case and test, and JSON, which has the closed form, too.

use serde_json::{Value, json};

use super::verdict::{Verdict, is_control, is_met, promise, scores, summary};
use super::{CaseReport, HardReport, Tested};
use crate::hard::Expected;
use crate::report::files::{self, ERRORS, machine_json, optional};
use crate::report::summary::{Summary, Timing};

const COLUMNS: &[&str] = &[
    "case",
    "lab",
    "settings",
    "shadow_test",
    "depth_format",
    "expected",
    "as_expected",
    "verdict",
    "rounds",
    "frame_ratio",
    "frame_ratio_low",
    "frame_ratio_high",
    "frame_ms",
    "rest_ms",
    "shadow_pass_ms",
    "lighting_ms",
];

pub fn csv(report: &HardReport) -> String {
    let cases = report.cases.iter();
    let records = cases.flat_map(|case| {
        let tests = case.rows.iter().zip(case.summaries());
        tests.map(|(tested, times)| record(report, case, tested, &times))
    });
    files::table(&[COLUMNS, ERRORS].concat(), records)
}

fn record(report: &HardReport, case: &CaseReport, tested: &Tested, times: &Summary) -> Vec<String> {
    let figures = &tested.row.figures[0];
    let Timing {
        ratio,
        ratio_95,
        ms,
        ..
    } = times.frame;
    let mut record = vec![
        case.case.name.to_owned(),
        case.case.lab.to_owned(),
        tested.row.differences.join(" "),
        tested.shadow_test.unwrap_or_default().to_owned(),
        tested.depth_format.clone(),
        promise(tested.expected),
        is_met(tested, report.size)
            .map(|met| met.to_string())
            .unwrap_or_default(),
        Verdict::of(figures).word().to_owned(),
        tested.row.times.len().to_string(),
        ratio.to_string(),
    ];
    record.extend([0, 1].map(|end| optional(ratio_95.map(|ends| ends[end]))));
    let times = [ms, times.rest.ms, times.shadow_pass[0], times.lighting[0]];
    record.extend(times.map(|milliseconds| milliseconds.to_string()));
    record.extend(files::errors(figures));
    record
}

pub fn json(report: &HardReport) -> Value {
    let tested = |tested: &Tested, times: &Summary| {
        let figures = &tested.row.figures[0];
        json!({
            "settings": tested.row.differences,
            "shadow_test": tested.shadow_test,
            "depth_format": tested.depth_format,
            "expected": (tested.expected != Expected::Shown).then(|| promise(tested.expected)),
            "control": is_control(tested.expected),
            "as_expected": is_met(tested, report.size),
            "verdict": Verdict::of(figures).word(),
            "frame": files::timing(&times.frame),
            "rest": files::timing(&times.rest),
            "shadow_pass_ms": times.shadow_pass[0],
            "lighting_ms": times.lighting[0],
            "errors": figures.json(),
        })
    };
    let case = |case: &CaseReport| {
        let rows = case.rows.iter().zip(case.summaries());
        json!({
            "case": case.case.name,
            "about": case.case.about,
            "lab": case.case.lab,
            "tests": rows.map(|(row, times)| tested(row, &times)).collect::<Vec<_>>(),
        })
    };
    let scores = scores(report);
    let scores = scores.iter().map(|score| {
        json!({
            "shadow_test": score.shadow_test,
            "cases": score.cases,
            "holds": score.holds,
            "exact": score.exact,
        })
    });
    let anchor = report.anchor.iter().map(|row| {
        json!({
            "degrees": row.degrees,
            "map_size": row.map_size,
            "bias_texels": row.bias_texels,
            "measured": row.measured,
            "told": row.told,
        })
    });
    json!({
        "shadowlab": env!("CARGO_PKG_VERSION"),
        "machine": machine_json(&report.machine),
        "interrupted": report.interrupted,
        "width": report.size[0],
        "height": report.size[1],
        "rounds": report.rounds,
        "summary": summary(report),
        "scores": scores.collect::<Vec<_>>(),
        "cases": report.cases.iter().map(case).collect::<Vec<_>>(),
        "closed_form": anchor.collect::<Vec<_>>(),
    })
}
