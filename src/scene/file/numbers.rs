//! The numbers of a scene file, and which of them a key takes.

use toml::de::DeValue;

/// What numbers a key takes.
#[derive(Clone, Copy)]
pub enum Kind {
    /// A coordinate, or any other number that may be negative.
    Any,
    /// A distance that is not 0.
    Length,
    /// An angle that a camera can see.
    View,
    Color,
    /// 0 to 1.
    Share,
    Between(f64, f64),
    Whole(u32, u32),
}

impl Kind {
    fn range(self) -> (f64, f64) {
        match self {
            Self::Any => (-1e12, 1e12),
            Self::Length => (1e-9, 1e12),
            Self::View => (0.01, 179.0),
            Self::Color => (0.0, 1000.0),
            Self::Share => (0.0, 1.0),
            Self::Between(least, most) => (least, most),
            Self::Whole(least, most) => (f64::from(least), f64::from(most)),
        }
    }

    pub fn takes(self, number: f64) -> bool {
        let (least, most) = self.range();
        let whole = !matches!(self, Self::Whole(..)) || number.fract() == 0.0;
        (least..=most).contains(&number) && whole
    }

    /// "a number" or "3 numbers", and which.
    pub fn expected(self, count: usize) -> String {
        let (least, most) = self.range();
        let whole = if matches!(self, Self::Whole(..)) {
            "whole "
        } else {
            ""
        };
        // 1e12 is easier to read than its zeros.
        let range = if most >= 1e9 {
            format!("from {least:e} to {most:e}")
        } else {
            format!("from {least} to {most}")
        };
        match count {
            1 => format!("a {whole}number {range}"),
            _ => format!("{count} {whole}numbers {range}"),
        }
    }
}

/// As f64, however it is written.
pub fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|integer| integer as f64),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}
