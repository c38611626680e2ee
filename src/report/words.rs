//! Figures and rows as a reader sees them.

use super::run::Row;

/// What a row sets; the handout's row sets nothing.
pub fn name(row: &Row) -> String {
    if row.differences.is_empty() {
        "the handout's settings".to_owned()
    } else {
        row.differences.join(" ")
    }
}

/// Two digits behind the point are more than a median of some dozen rounds is good for.
pub fn ratio(ratio: f64) -> String {
    format!("{ratio:.2}")
}

pub fn interval(interval: Option<[f64; 2]>) -> String {
    match interval {
        Some([low, high]) => format!("{}–{}", ratio(low), ratio(high)),
        None => "too few rounds".to_owned(),
    }
}

pub fn milliseconds(milliseconds: f64) -> String {
    format!("{milliseconds:.1}")
}

pub fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

pub fn mebibytes(bytes: u64) -> String {
    format!("{:.1}", bytes as f64 / f64::from(1 << 20))
}
