//! A report for other programs: CSV with a line for each row and light, and JSON.

use serde_json::{Value, json};

use super::summary::{Summary, Timing};
use super::{Compared, LabReport, Machine, Report, advice};
use crate::measure::Figures;

/// Before the errors.
const COLUMNS: &[&str] = &[
    "lab",
    "comparison",
    "settings",
    "light",
    "rounds",
    "frame_ratio",
    "frame_ratio_low",
    "frame_ratio_high",
    "rest_ratio",
    "rest_ratio_low",
    "rest_ratio_high",
    "frame_ms",
    "frame_ms_p95",
    "rest_ms",
    "rest_ms_p95",
    "shadow_pass_ms",
    "shadow_pass_ms_p95",
    "lighting_ms",
    "lighting_ms_p95",
    "look_ups_ms",
    "look_ups_ms_low",
    "look_ups_ms_high",
    "shading_ms",
    "outside_gl_ms",
    "outside_gl",
    "gl_calls",
    "gl_calls_rest",
    "bytes_drawn_into",
    "bytes_textures",
    "bytes_buffers",
];

/// What is said of the errors under one light.
pub const ERRORS: &[&str] = &[
    "valid",
    "ambiguous",
    "false_shadow",
    "false_shadow_edge1",
    "false_shadow_edgeT",
    "false_shadow_interior",
    "false_shadow_ambiguous",
    "false_light",
    "false_light_edge1",
    "false_light_edgeT",
    "false_light_interior",
    "false_light_ambiguous",
    "grey",
    "contact_gap",
    "contact_gap_texels",
];

pub fn csv(report: &Report) -> String {
    let compared = report
        .labs
        .iter()
        .flat_map(|lab| lab.comparisons.iter().map(move |compared| (lab, compared)));
    let records = compared.flat_map(|(lab, compared)| records(lab, compared));
    table(&[COLUMNS, ERRORS, &["pareto", "chosen"]].concat(), records)
}

/// CSV with these columns.
pub fn table(columns: &[&str], records: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let memory = "lines of equal length can be written to memory";
    writer.write_record(columns).expect(memory);
    for record in records {
        writer.write_record(record).expect(memory);
    }
    let bytes = writer.into_inner().expect("memory takes it all");
    String::from_utf8(bytes).expect("text was written")
}

/// Nothing where there is no number.
pub fn optional(number: Option<f64>) -> String {
    number.map(|number| number.to_string()).unwrap_or_default()
}

fn records(lab: &LabReport, compared: &Compared) -> Vec<Vec<String>> {
    let summaries = Summary::of_rows(&compared.rows);
    let chosen = advice::choice(&summaries);
    let mut records = Vec::new();
    for (i, (row, summary)) in compared.rows.iter().zip(&summaries).enumerate() {
        for (light, figures) in row.figures.iter().enumerate() {
            let mut record = vec![
                lab.handout.name.to_owned(),
                compared.title.clone(),
                row.differences.join(" "),
                (light + 1).to_string(),
                row.times.len().to_string(),
            ];
            for Timing {
                ratio, ratio_95, ..
            } in [&summary.frame, &summary.rest]
            {
                record.push(ratio.to_string());
                record.extend([0, 1].map(|end| optional(ratio_95.map(|ends| ends[end]))));
            }
            for Timing { ms, ms_95, .. } in [&summary.frame, &summary.rest] {
                record.extend([ms, ms_95].map(f64::to_string));
            }
            record.extend(
                [summary.shadow_pass, summary.lighting]
                    .as_flattened()
                    .iter()
                    .map(f64::to_string),
            );
            let look_ups = summary.look_ups.as_ref();
            let interval = look_ups.and_then(|look_ups| look_ups.interval_95);
            record.push(optional(look_ups.map(|look_ups| look_ups.ms)));
            record.extend([0, 1].map(|end| optional(interval.map(|ends| ends[end]))));
            record.push(optional(summary.shading()));
            record.extend([summary.outside_gl_ms, summary.outside_gl].map(|x| x.to_string()));
            record.extend([row.calls.frame, row.calls.rest].map(|calls| calls.to_string()));
            let bytes = row.bytes;
            record.extend([bytes.drawn_into, bytes.textures, bytes.buffers].map(|b| b.to_string()));
            record.extend(errors(figures));
            record.extend([summary.on_front, i == chosen].map(|yes| yes.to_string()));
            records.push(record);
        }
    }
    records
}

/// The fields of [`ERRORS`].
pub fn errors(figures: &Figures) -> Vec<String> {
    let mut fields = vec![
        (figures.lit + figures.shadowed).to_string(),
        figures.ambiguous.to_string(),
    ];
    for wrong in [&figures.false_shadow, &figures.false_light] {
        let places = [
            wrong.total(),
            wrong.edge1,
            wrong.edge_t,
            wrong.interior,
            wrong.ambiguous,
        ];
        fields.extend(places.map(|pixels| pixels.to_string()));
    }
    fields.push(figures.grey.to_string());
    let gap = figures.contact_gap;
    fields.push(optional(gap.map(|gap| gap.world)));
    fields.push(optional(gap.and_then(|gap| gap.texels)));
    fields
}

pub fn machine_json(machine: &Machine) -> Value {
    json!({
        "renderer": machine.renderer,
        "driver": machine.driver,
        "software": machine.software,
        "cpu": machine.cpu,
        "threads": machine.threads,
        "system": machine.system,
    })
}

pub fn json(report: &Report) -> Value {
    json!({
        "shadowlab": env!("CARGO_PKG_VERSION"),
        "machine": machine_json(&report.machine),
        "interrupted": report.interrupted.is_some(),
        "labs": report.labs.iter().map(lab_json).collect::<Vec<_>>(),
    })
}

fn lab_json(lab: &LabReport) -> Value {
    json!({
        "lab": lab.handout.name,
        "options": lab.options,
        "width": lab.size[0],
        "height": lab.size[1],
        "comparisons": lab.comparisons.iter().map(comparison_json).collect::<Vec<_>>(),
    })
}

pub fn timing(timing: &Timing) -> Value {
    json!({
        "ratio": timing.ratio,
        "ratio_95": timing.ratio_95,
        "ms": timing.ms,
        "ms_p95": timing.ms_95,
    })
}

fn comparison_json(compared: &Compared) -> Value {
    let summaries = Summary::of_rows(&compared.rows);
    let chosen = advice::choice(&summaries);
    let pass = |[ms, ms_95]: [f64; 2]| json!({ "ms": ms, "ms_p95": ms_95 });
    let rows = compared.rows.iter().zip(&summaries).enumerate();
    let rows = rows.map(|(i, (row, summary))| {
        json!({
            "settings": row.differences,
            "rounds": row.times.len(),
            "frame": timing(&summary.frame),
            "rest": timing(&summary.rest),
            "shadow_pass": pass(summary.shadow_pass),
            "lighting": pass(summary.lighting),
            "look_ups": summary.look_ups.as_ref().map(|look_ups| json!({
                "ms": look_ups.ms,
                "ms_95": look_ups.interval_95,
            })),
            "shading_ms": summary.shading(),
            "outside_gl_ms": summary.outside_gl_ms,
            "outside_gl": summary.outside_gl,
            "gl_calls": { "frame": row.calls.frame, "rest": row.calls.rest },
            "bytes": {
                "drawn_into": row.bytes.drawn_into,
                "textures": row.bytes.textures,
                "buffers": row.bytes.buffers,
            },
            "lights": row.figures.iter().map(|figures| figures.json()).collect::<Vec<_>>(),
            "pareto": summary.on_front,
            "chosen": i == chosen,
        })
    });
    json!({
        "title": compared.title,
        "set": compared.set,
        "advice": advice::sentence(compared, &summaries),
        "faults": advice::faults(compared, &summaries),
        "rows": rows.collect::<Vec<_>>(),
    })
}
