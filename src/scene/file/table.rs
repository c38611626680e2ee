//! TOML tables, read key by key; whatever is wrong is told with file, line and column.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use image::RgbaImage;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::numbers::{Kind, number};
use crate::error::{did_you_mean, quoted};
use crate::scene::reading::Files;
use crate::{Error, Result};

/// The scene file's text, to say where in it something is.
pub struct Source<'a> {
    path: &'a Path,
    text: &'a str,
}

impl<'a> Source<'a> {
    pub fn new(path: &'a Path, text: &'a str) -> Self {
        Self { path, text }
    }

    /// The outermost table.
    pub fn entries(&self) -> Result<DeTable<'a>> {
        match DeTable::parse(self.text) {
            Ok(table) => Ok(table.into_inner()),
            Err(wrong) => {
                let place = wrong.span().map_or(0, |span| span.start);
                let message = format!("found no TOML: {}", wrong.message());
                Err(self.wrong(place, message))
            }
        }
    }

    fn wrong(&self, place: usize, message: String) -> Error {
        Error::input_at(self.path, self.line_and_column(place), message)
    }

    fn line_and_column(&self, place: usize) -> [usize; 2] {
        // TOML's own errors may point into the middle of a character.
        let before = &self.text.as_bytes()[..place.min(self.text.len())];
        let before = String::from_utf8_lossy(before);
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        [
            1 + before.matches('\n').count(),
            1 + before[line_start..].chars().count(),
        ]
    }
}

/// A table whose keys are all known.
pub struct Table<'a> {
    source: &'a Source<'a>,
    name: &'static str,
    place: usize,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    pub fn new(
        source: &'a Source<'a>,
        name: &'static str,
        place: usize,
        entries: &'a DeTable<'a>,
        known: &'static [&'static str],
    ) -> Result<Self> {
        let unknown = entries
            .keys()
            .filter(|key| !known.contains(&&**key.get_ref()))
            .min_by_key(|key| key.span().start);
        if let Some(key) = unknown {
            let found = key.get_ref();
            let hint = did_you_mean(found, known.iter().copied());
            let message = format!(
                "found the key {} in {name}{hint}, expected one of {}",
                quoted(found),
                known.join(", ")
            );
            return Err(source.wrong(key.span().start, message));
        }
        Ok(Self {
            source,
            name,
            place,
            entries,
        })
    }

    /// An error about the table as a whole.
    pub fn wrong(&self, message: String) -> Error {
        self.source.wrong(self.place, message)
    }

    pub fn value(&self, key: &'static str) -> Option<Value<'a>> {
        let value = self.entries.get(key)?;
        Some(Value {
            source: self.source,
            span: value.span(),
            value: value.get_ref(),
        })
    }

    pub fn required(&self, key: &'static str) -> Result<Value<'a>> {
        self.value(key)
            .ok_or_else(|| self.wrong(format!("found no {key} in {}, expected one", self.name)))
    }

    /// The one of two keys that is given.
    pub fn either(&self, one: &'static str, other: &'static str) -> Result<Option<Either<'a>>> {
        match (self.value(one), self.value(other)) {
            (None, None) => Ok(None),
            (Some(value), None) => Ok(Some(Either::One(value))),
            (None, Some(value)) => Ok(Some(Either::Other(value))),
            (Some(_), Some(value)) => {
                Err(value.error(format!("found {one} and {other}, expected one of the two")))
            }
        }
    }

    pub fn number(&self, key: &'static str, kind: Kind, default: f64) -> Result<f64> {
        self.value(key)
            .map_or(Ok(default), |value| value.number(kind))
    }

    pub fn vector(&self, key: &'static str, kind: Kind, default: DVec3) -> Result<DVec3> {
        self.value(key)
            .map_or(Ok(default), |value| value.vector(kind))
    }

    pub fn flag(&self, key: &'static str, default: bool) -> Result<bool> {
        self.value(key).map_or(Ok(default), |value| value.flag())
    }

    /// One of a few words.
    pub fn choice(&self, key: &'static str, choices: &[&'static str]) -> Result<&'static str> {
        let Some(value) = self.value(key) else {
            return Ok(choices[0]);
        };
        let text = value.text()?;
        let found = choices.iter().find(|choice| **choice == text);
        found.copied().ok_or_else(|| {
            let hint = did_you_mean(text, choices.iter().copied());
            value.wrong(&format!("one of {}{hint}", choices.join(", ")))
        })
    }
}

pub enum Either<'a> {
    One(Value<'a>),
    Other(Value<'a>),
}

/// The value of a key, or of an array's element.
pub struct Value<'a> {
    source: &'a Source<'a>,
    span: Range<usize>,
    value: &'a DeValue<'a>,
}

impl<'a> Value<'a> {
    pub fn error(&self, message: String) -> Error {
        self.source.wrong(self.span.start, message)
    }

    pub fn wrong(&self, expected: &str) -> Error {
        let found = self.source.text.get(self.span.clone()).unwrap_or_default();
        self.error(format!(
            "found {}, expected {expected}",
            bare_or_quoted(found)
        ))
    }

    pub fn number(&self, kind: Kind) -> Result<f64> {
        number(self.value)
            .filter(|number| kind.takes(*number))
            .ok_or_else(|| self.wrong(&kind.expected(1)))
    }

    pub fn is_number(&self) -> bool {
        number(self.value).is_some()
    }

    pub fn numbers<const N: usize>(&self, kind: Kind) -> Result<[f64; N]> {
        let wrong = || self.wrong(&format!("{} in brackets", kind.expected(N)));
        let array = self.value.as_array().ok_or_else(wrong)?;
        let numbers = array.iter().map(|element| number(element.get_ref()));
        let numbers: Option<Vec<f64>> = numbers.take(N + 1).collect();
        let numbers: [f64; N] = numbers
            .and_then(|numbers| numbers.try_into().ok())
            .ok_or_else(wrong)?;
        if numbers.iter().all(|number| kind.takes(*number)) {
            Ok(numbers)
        } else {
            Err(wrong())
        }
    }

    pub fn vector(&self, kind: Kind) -> Result<DVec3> {
        Ok(self.numbers(kind)?.into())
    }

    /// A vector that points somewhere.
    pub fn direction(&self) -> Result<DVec3> {
        let direction = self.vector(Kind::Any)?;
        if direction.length() < SHORTEST {
            return Err(self.wrong("a direction, not nothing"));
        }
        Ok(direction)
    }

    pub fn flag(&self) -> Result<bool> {
        self.value
            .as_bool()
            .ok_or_else(|| self.wrong("true or false"))
    }

    pub fn text(&self) -> Result<&'a str> {
        self.value
            .as_str()
            .ok_or_else(|| self.wrong("text in quotes"))
    }

    pub fn table(&self, name: &'static str, known: &'static [&'static str]) -> Result<Table<'a>> {
        match self.value {
            DeValue::Table(entries) => {
                Table::new(self.source, name, self.span.start, entries, known)
            }
            _ => Err(self.wrong(&format!("the table {name}"))),
        }
    }

    /// The tables of an array, or a single one.
    pub fn tables(
        &self,
        name: &'static str,
        known: &'static [&'static str],
    ) -> Result<Vec<Table<'a>>> {
        let Some(array) = self.value.as_array() else {
            return Ok(vec![self.table(name, known)?]);
        };
        array
            .iter()
            .map(|element| self.element(element).table(name, known))
            .collect()
    }

    fn element(&self, element: &'a Spanned<DeValue<'a>>) -> Self {
        Self {
            source: self.source,
            span: element.span(),
            value: element.get_ref(),
        }
    }

    /// The path of a file that is named relative to the scene.
    pub fn path(&self, scene: &Path) -> Result<PathBuf> {
        let name = self.text()?.replace('\\', "/");
        if name.is_empty() {
            return Err(self.wrong("a file's name"));
        }
        Ok(scene.with_file_name("").join(name))
    }

    pub fn picture(&self, scene: &Path, files: &Files) -> Result<Arc<RgbaImage>> {
        let path = self.path(scene)?;
        files
            .picture(&path)
            .map_err(|error| self.naming(&path, error))
    }

    /// An error about a file that could not be read at all is one of the line that names it.
    pub fn naming(&self, file: &Path, error: Error) -> Error {
        match &error {
            Error::File { path, .. }
            | Error::Input {
                path, line: None, ..
            } if path == file => self.error(error.to_string()),
            _ => error,
        }
    }
}

/// Below this, a difference of two coordinates is mostly rounding.
pub const SHORTEST: f64 = 1e-9;

/// Texts of the file have quotes of their own.
fn bare_or_quoted(found: &str) -> String {
    let shown = quoted(found);
    if found.starts_with(['"', '\'']) {
        shown[1..shown.len() - 1].to_owned()
    } else {
        shown
    }
}
