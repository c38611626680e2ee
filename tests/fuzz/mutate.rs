//! From texts that are right to texts that are wrong in every way that comes to mind.

use crate::common::Random;

/// What stands in for a number. No whole numbers that make a mesh of millions of triangles: those take their time.
const EXTREMES: &[&str] = &[
    "0",
    "-0",
    "0.0",
    "1",
    "-1",
    "2",
    "3",
    "1e-320",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "-inf",
    "inf",
    "0.01",
    "178.5",
    "180.5",
    "1e12",
    "-1e12",
    "1e13",
    "1e-9",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "30000001",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0x7fffffffffffffff",
    "1_0",
    ".5",
    "5.",
    "+7",
    "00000000000000000001",
    "1e",
    "--1",
];

/// Longer ones take time and find nothing new.
const LONGEST: usize = 20_000;

/// Input `number` of a parser: a seed text, changed once, which mostly leaves it readable, or up to eight times.
pub fn input(seeds: &[&str], words: &[&str], number: u64) -> Vec<u8> {
    // Neighbouring numbers must not give neighbouring sequences.
    let mut random = Random(number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 541);
    random.below(2);
    let mut text = pick(&mut random, seeds).as_bytes().to_vec();
    let more = random.below(2) * random.below(8);
    for _ in 0..=more {
        change(&mut text, seeds, words, &mut random);
        text.truncate(LONGEST);
    }
    text
}

fn pick<'a>(random: &mut Random, list: &[&'a str]) -> &'a str {
    list[random.below(list.len() as u32) as usize]
}

fn change(text: &mut Vec<u8>, seeds: &[&str], words: &[&str], random: &mut Random) {
    let at = place(text, random);
    match random.below(11) {
        0 if at < text.len() => text[at] ^= 1 << random.below(8),
        1 => text.insert(at, random.below(256) as u8),
        2 => drop(text.drain(range(text, random))),
        3 => {
            let part = text[range(text, random)].to_vec();
            insert(text, at, &part);
        }
        4 => insert(text, at, pick(random, words).as_bytes()),
        5 => {
            let part = range(text, random);
            text.splice(part, pick(random, words).bytes());
        }
        6 | 7 => replace_number(text, at, pick(random, EXTREMES)),
        8 => text.truncate(at),
        9 => {
            let other = pick(random, seeds).as_bytes();
            text.truncate(at);
            text.extend_from_slice(&other[place(other, random)..]);
        }
        _ => repeat_line(text, at, random),
    }
}

/// A place in the text, its end included.
fn place(text: &[u8], random: &mut Random) -> usize {
    random.below(text.len() as u32 + 1) as usize
}

/// A part of the text, mostly a short one.
fn range(text: &[u8], random: &mut Random) -> std::ops::Range<usize> {
    let start = place(text, random);
    let most = if random.below(4) == 0 { text.len() } else { 12 };
    let length = random.below(most as u32 + 1) as usize;
    start..(start + length).min(text.len())
}

fn insert(text: &mut Vec<u8>, at: usize, part: &[u8]) {
    text.splice(at..at, part.iter().copied());
}

/// The first number from `at` on becomes another one.
fn replace_number(text: &mut Vec<u8>, at: usize, by: &str) {
    let is_digit = |byte: &u8| byte.is_ascii_digit();
    let Some(start) = text[at..]
        .iter()
        .position(is_digit)
        .map(|offset| at + offset)
    else {
        return;
    };
    let length = text[start..]
        .iter()
        .position(|byte| !is_digit(byte) && *byte != b'.');
    let end = length.map_or(text.len(), |length| start + length);
    text.splice(start..end, by.bytes());
}

/// The line at `at` comes up to a hundred times more, or once somewhere else.
fn repeat_line(text: &mut Vec<u8>, at: usize, random: &mut Random) {
    let start = text[..at]
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |i| i + 1);
    let end = text[at..]
        .iter()
        .position(|byte| *byte == b'\n')
        .map_or(text.len(), |i| at + i + 1);
    let line = text[start..end].to_vec();
    if random.below(2) == 0 {
        let times = 1 + random.below(100) as usize;
        insert(text, start, &line.repeat(times));
    } else {
        let elsewhere = place(text, random);
        insert(text, elsewhere, &line);
    }
}
