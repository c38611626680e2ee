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

/// Two digits that count, of a length of any size.
pub fn two_digits(length: f64) -> String {
    let rounded: f64 = format!("{length:.1e}")
        .parse()
        .expect("a number was written");
    if (0.001..1e5).contains(&rounded) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// 1000000 as 1,000,000.
pub fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let grouped = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<_> = grouped.map(String::from_utf8_lossy).collect();
    groups.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!(two_digits(0.012_34), "0.012");
        assert_eq!(two_digits(1234.0), "1200");
        assert_eq!(two_digits(0.000_099_9), "1e-4");
        assert_eq!(thousands(1_234_567), "1,234,567");
        assert_eq!(thousands(512), "512");
    }
}
