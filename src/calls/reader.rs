//! The calls of a dump, one after the other, however long it is.

use std::io::BufRead;
use std::path::Path;

use super::syntax::{self, Call, Quotes};
use crate::error::quoted;
use crate::{Error, Result};

/// The longest call, in bytes: a shader's source is a part of one.
const LONGEST_CALL: usize = 16 << 20;
/// So many lines may be something else than a call: what a shell, a driver or a person wrote among them.
const OTHER_LINES: usize = 100;

/// Reads calls, in memory that does not grow.
pub struct Calls<'a, R> {
    input: R,
    /// As messages name the file.
    path: &'a Path,
    /// Lines and bytes that were read.
    line: u64,
    pub bytes: u64,
    buffer: Vec<u8>,
    calls: u64,
    /// The first line that is no call, and how many there are.
    pub other: Option<(u64, usize)>,
}

impl<'a, R: BufRead> Calls<'a, R> {
    pub fn new(input: R, path: &'a Path) -> Self {
        Self {
            input,
            path,
            line: 0,
            bytes: 0,
            buffer: Vec::new(),
            calls: 0,
            other: None,
        }
    }

    /// The next call; none at the end.
    pub fn read(&mut self) -> Result<Option<Call>> {
        loop {
            self.buffer.clear();
            let first = self.line + 1;
            let mut quotes = Quotes::default();
            // Strings are printed as they are: a shader's source goes on over many lines.
            loop {
                let start = self.buffer.len();
                let more = self.read_line(first)?;
                if !more && start == 0 {
                    return self.end().map(|()| None);
                }
                if !more {
                    let message = "the text ends inside of this call, expected a whole dump";
                    return Err(self.wrong(first, message));
                }
                if self.buffer.starts_with(b"//") || !quotes.read(&self.buffer[start..]) {
                    break;
                }
            }
            let text = String::from_utf8_lossy(&self.buffer);
            let text = without_colors(text.trim());
            if text.is_empty() || text.starts_with("//") {
                continue;
            }
            if let Some(call) = syntax::call(&text, first) {
                self.calls += 1;
                return Ok(Some(call));
            }
            let text = text.into_owned();
            self.not_a_call(first, &text)?;
        }
    }

    /// Appends a line to the buffer; false at the end of the text.
    fn read_line(&mut self, first: u64) -> Result<bool> {
        let room = (LONGEST_CALL + 1 - self.buffer.len()) as u64;
        let read = std::io::Read::take(&mut self.input, room)
            .read_until(b'\n', &mut self.buffer)
            .map_err(|cause| Error::reading(self.path, cause))?;
        self.bytes += read as u64;
        self.line += u64::from(read > 0);
        if self.buffer.len() > LONGEST_CALL {
            let message = format!(
                "a call of more than {} MiB, expected a GL call as apitrace dump prints it",
                LONGEST_CALL >> 20
            );
            return Err(self.wrong(first, &message));
        }
        Ok(read > 0)
    }

    fn not_a_call(&mut self, line: u64, text: &str) -> Result<()> {
        if text.contains(['\0', char::REPLACEMENT_CHARACTER]) && self.calls == 0 {
            let message =
                "found a binary file, expected text: apitrace dump program.trace > dump.txt";
            return Err(self.wrong(line, message));
        }
        // A call that was cut short would take a step away that the program has made.
        let cut = text.split_once('(').is_some_and(|(head, _)| {
            head.rsplit([' ', '='])
                .next()
                .is_some_and(|name| name.starts_with("gl"))
        });
        let (first, count) = self.other.unwrap_or((line, 0));
        self.other = Some((first, count + 1));
        if cut || count >= OTHER_LINES {
            let found = quoted(text);
            return Err(self.wrong(
                if cut { line } else { first },
                &format!("found {found}, expected a GL call as apitrace dump prints it"),
            ));
        }
        Ok(())
    }

    fn end(&self) -> Result<()> {
        if self.calls > 0 {
            return Ok(());
        }
        let line = self.other.map(|(line, _)| line as usize);
        let message = "found no GL call, expected the text of apitrace dump or of shadowlab trace";
        Err(Error::input(self.path, line, message))
    }

    fn wrong(&self, line: u64, message: &str) -> Error {
        Error::input(self.path, line as usize, message)
    }
}

/// Without the escape sequences with which apitrace colors what it prints.
fn without_colors(text: &str) -> std::borrow::Cow<'_, str> {
    if !text.contains("\x1b[") {
        return text.into();
    }
    let mut parts = text.split("\x1b[");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        plain += part.split_once('m').map_or("", |(_, rest)| rest);
    }
    plain.into()
}
