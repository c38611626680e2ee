//! The lines of OBJ and MTL files, and the numbers in them.

use std::borrow::Cow;

use crate::error::quoted;

/// What is wrong with a line: what was found, and what was expected.
pub type Checked<T> = Result<T, String>;

/// One line, or several that backslashes join.
pub struct Line<'a> {
    /// Of the first one, from 1.
    pub number: usize,
    pub text: Cow<'a, str>,
    /// Where it ends, in bytes.
    pub end: usize,
}

pub struct Lines<'a> {
    text: &'a [u8],
    at: usize,
    number: usize,
}

pub fn lines(text: &[u8]) -> Lines<'_> {
    // Some editors put a byte order mark first.
    let at = if text.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    Lines {
        text,
        at,
        number: 0,
    }
}

impl<'a> Lines<'a> {
    /// Up to the next line end, of Unix or of Windows.
    fn physical(&mut self) -> &'a [u8] {
        let rest = &self.text[self.at..];
        let length = rest.iter().position(|byte| *byte == b'\n');
        self.at += length.map_or(rest.len(), |length| length + 1);
        self.number += 1;
        let line = &rest[..length.unwrap_or(rest.len())];
        line.strip_suffix(b"\r").unwrap_or(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.at == self.text.len() {
            return None;
        }
        let mut line = self.physical();
        let number = self.number;
        let mut joined = Vec::new();
        while let Some(before) = line.strip_suffix(b"\\")
            && self.at < self.text.len()
        {
            joined.extend_from_slice(before);
            joined.push(b' ');
            line = self.physical();
        }
        // Old files have comments that are not UTF-8.
        let text = if joined.is_empty() {
            String::from_utf8_lossy(line)
        } else {
            joined.extend_from_slice(line);
            Cow::Owned(String::from_utf8_lossy(&joined).into_owned())
        };
        let end = self.at;
        Some(Line { number, text, end })
    }
}

/// The keyword and the rest of a line.
pub fn keyword(line: &str) -> (&str, &str) {
    let line = line.trim();
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    (keyword, rest.trim())
}

/// Beyond this, squares and products of a few of them would leave the range of an f32.
const LARGEST: f64 = 1e12;

/// The first N numbers, as they are written.
pub fn numbers<const N: usize>(rest: &str) -> Checked<[&str; N]> {
    let mut words = rest.split_ascii_whitespace();
    let mut numbers = [""; N];
    for number in &mut numbers {
        *number = words.next().filter(|word| is_usable(word)).ok_or_else(|| {
            let found = quoted(rest);
            format!("found {found}, expected {N} finite numbers of at most 1e12")
        })?;
    }
    Ok(numbers)
}

fn is_usable(word: &str) -> bool {
    word.parse::<f64>()
        .is_ok_and(|value| value.abs() <= LARGEST)
}

/// Writes a line for tobj.
pub fn put(text: &mut String, keyword: &str, words: &[&str]) {
    text.push_str(keyword);
    for word in words {
        text.push(' ');
        text.push_str(word);
    }
    text.push('\n');
}
