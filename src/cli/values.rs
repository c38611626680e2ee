//! The values of options.

use std::str::FromStr;

use shadowlab::labs::Handout;
use shadowlab::{Error, Result};

/// The most that --time takes, in seconds.
pub const MOST_TIME: f64 = 3e10;

pub fn check_light(handout: &Handout, light: usize) -> Result<()> {
    if (1..=handout.lights).contains(&light) {
        return Ok(());
    }
    let expected = match handout.lights {
        1 => "1, its only light".to_owned(),
        lights => format!("1 to {lights}"),
    };
    Err(Error::usage(format!(
        "--light {light}: {} has no such light, expected {expected}",
        handout.name
    )))
}

pub fn parse_size(text: &str) -> std::result::Result<[u32; 2], String> {
    let size = text.split_once('x').and_then(|(width, height)| {
        let size = [width.parse().ok()?, height.parse().ok()?];
        size.iter()
            .all(|n| (1..=65_536).contains(n))
            .then_some(size)
    });
    size.ok_or_else(|| {
        "expected WIDTHxHEIGHT in pixels, 1x1 to 65536x65536, for example 800x600".to_owned()
    })
}

pub fn parse_crop(text: &str) -> std::result::Result<[u32; 4], String> {
    let crop = text.rsplit_once(',').and_then(|(place, size)| {
        let [x, y] = parse_numbers::<u32, 2>(place).ok()?;
        let [width, height] = parse_size(size).ok()?;
        Some([x, y, width, height])
    });
    crop.ok_or_else(|| "expected X,Y,WIDTHxHEIGHT in pixels, for example 8,31,500x500".to_owned())
}

pub fn parse_time(text: &str) -> std::result::Result<f64, String> {
    let time: Option<f64> = text.parse().ok();
    // A NaN is in no range. In a thousand years a turn still has a millisecond's precision.
    time.filter(|time| (0.0..=MOST_TIME).contains(time))
        .ok_or_else(|| format!("expected a number of seconds, 0 to {MOST_TIME}"))
}

pub fn parse_numbers<T: FromStr + Into<f64> + Copy, const N: usize>(
    text: &str,
) -> std::result::Result<[T; N], String> {
    let numbers: Option<Vec<T>> = text
        .split(',')
        .map(|number| number.trim().parse().ok())
        .collect();
    numbers
        .filter(|numbers| numbers.iter().all(|number| (*number).into().is_finite()))
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("expected {N} numbers with commas between them"))
}
