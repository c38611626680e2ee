//! The report for other programs: CSV with a line for each thing measured, and JSON.

use serde_json::{Value, json};

use super::cube::Deviation;
use super::times::{find, ratio};
use super::{Found, SoftReport, times};

/// The first names the table, the next seven the row in it; the rest is what was found, empty where it has no meaning.
const COLUMNS: &[&str] = &[
    "table",
    "clipped_to",
    "stencil_clipping",
    "jitter_amount",
    "jitter",
    "accumulator",
    "soft_method",
    "num_jitters",
    "valid",
    "ambiguous",
    "false_shadow",
    "false_shadow_interior",
    "false_light",
    "false_light_interior",
    "integral_mean",
    "integral_rms",
    "integral_max",
    "mean_rms_levels",
    "mean_max_levels",
    "other_level_share",
    "draws",
    "draws_rms",
    "draws_least",
    "draws_most",
    "levels",
    "beyond_one_share",
    "rounds",
    "ms",
    "ratio",
    "ratio_low",
    "ratio_high",
];

type Field = (&'static str, String);

fn text(name: &'static str, value: impl ToString) -> Field {
    (name, value.to_string())
}

pub fn csv(report: &SoftReport) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut write = |record: &[String]| {
        let written = writer.write_record(record);
        written.expect("lines of equal length can be written to memory");
    };
    write(
        &COLUMNS
            .iter()
            .map(|name| (*name).to_owned())
            .collect::<Vec<_>>(),
    );
    for row in rows(&report.found) {
        let field = |column: &&str| {
            let field = row.iter().find(|(name, _)| name == column);
            field.map(|(_, value)| value.clone()).unwrap_or_default()
        };
        write(&COLUMNS.iter().map(field).collect::<Vec<_>>());
    }
    let bytes = writer.into_inner().expect("memory takes it all");
    String::from_utf8(bytes).expect("text was written")
}

fn rows(found: &Found) -> Vec<Vec<Field>> {
    let mut rows = Vec::new();
    for hard in &found.hard {
        let figures = &hard.figures;
        rows.push(vec![
            text("table", "hard"),
            text("clipped_to", hard.shown),
            text("stencil_clipping", hard.clipping),
            text("valid", figures.lit + figures.shadowed),
            text("ambiguous", figures.ambiguous),
            text("false_shadow", figures.false_shadow.total()),
            text("false_shadow_interior", figures.false_shadow.interior),
            text("false_light", figures.false_light.total()),
            text("false_light_interior", figures.false_light.interior),
        ]);
    }
    for errors in &found.errors {
        rows.push(vec![
            text("table", "errors"),
            text("jitter_amount", errors.amount),
            text("jitter", errors.jitter),
            text("accumulator", errors.accumulator),
            text("num_jitters", errors.count),
            text("integral_mean", errors.from_integral.mean),
            text("integral_rms", errors.from_integral.rms),
            text("integral_max", errors.from_integral.max),
            text("mean_rms_levels", errors.from_mean.rms),
            text("mean_max_levels", errors.from_mean.max),
            text("other_level_share", errors.other_level),
        ]);
    }
    for draws in &found.draws {
        let [least, most] = draws.range();
        rows.push(vec![
            text("table", "draws"),
            text("jitter_amount", draws.amount),
            text("jitter", draws.jitter),
            text("num_jitters", draws.count),
            text("draws", draws.rms.len()),
            text("draws_rms", draws.mean()),
            text("draws_least", least),
            text("draws_most", most),
        ]);
    }
    for equal in &found.equal {
        rows.push(vec![
            text("table", "equal"),
            text("accumulator", equal.accumulator),
            text("num_jitters", equal.count),
            text("levels", equal.levels),
        ]);
    }
    for methods in &found.methods {
        rows.push(vec![
            text("table", "methods"),
            text("jitter_amount", methods.amount),
            text("num_jitters", methods.count),
            text("levels", methods.levels),
            text("beyond_one_share", methods.beyond_one),
        ]);
    }
    for times in &found.times {
        rows.push(time_row(found, times));
    }
    rows
}

fn time_row(found: &Found, row: &times::Times) -> Vec<Field> {
    let mut fields = vec![
        text("table", "times"),
        text("jitter_amount", row.amount),
        text("soft_method", row.method),
        text("num_jitters", row.count),
        text("rounds", row.ms.len()),
        text("ms", row.median()),
    ];
    if let Some(handouts) = find(&found.times, "handout", row.amount, row.count) {
        let ratio = ratio(row, handouts);
        fields.push(text("ratio", ratio.median()));
        if let Some([low, high]) = ratio.interval_95() {
            fields.extend([text("ratio_low", low), text("ratio_high", high)]);
        }
    }
    fields
}

pub fn json(report: &SoftReport) -> Value {
    let machine = &report.machine;
    let found = &report.found;
    let deviation = |d: &Deviation| json!({ "mean": d.mean, "rms": d.rms, "max": d.max });
    json!({
        "shadowlab": env!("CARGO_PKG_VERSION"),
        "machine": {
            "renderer": machine.renderer,
            "driver": machine.driver,
            "software": machine.software,
            "cpu": machine.cpu,
            "threads": machine.threads,
            "system": machine.system,
        },
        "interrupted": report.interrupted,
        "lab": report.handout.name,
        "options": report.options,
        "width": report.size[0],
        "height": report.size[1],
        "hard": found.hard.iter().map(|hard| json!({
            "clipped_to": hard.shown,
            "stencil_clipping": hard.clipping,
            "figures": hard.figures.json(),
        })).collect::<Vec<_>>(),
        "errors": found.errors.iter().map(|errors| json!({
            "jitter_amount": errors.amount,
            "jitter": errors.jitter,
            "accumulator": errors.accumulator,
            "num_jitters": errors.count,
            "from_integral": deviation(&errors.from_integral),
            "from_mean_in_levels": deviation(&errors.from_mean),
            "other_level_share": errors.other_level,
        })).collect::<Vec<_>>(),
        "draws": found.draws.iter().map(|draws| json!({
            "jitter_amount": draws.amount,
            "jitter": draws.jitter,
            "num_jitters": draws.count,
            "rms": draws.rms,
            "uncertain": draws.uncertain,
        })).collect::<Vec<_>>(),
        "equal": found.equal.iter().map(|equal| json!({
            "accumulator": equal.accumulator,
            "num_jitters": equal.count,
            "levels": equal.levels,
        })).collect::<Vec<_>>(),
        "methods": found.methods.iter().map(|methods| json!({
            "jitter_amount": methods.amount,
            "num_jitters": methods.count,
            "levels": methods.levels,
            "beyond_one_share": methods.beyond_one,
        })).collect::<Vec<_>>(),
        "times": found.times.iter().map(|times| json!({
            "jitter_amount": times.amount,
            "soft_method": times.method,
            "num_jitters": times.count,
            "ms": times.ms,
        })).collect::<Vec<_>>(),
    })
}
