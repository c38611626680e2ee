//! The corners of faces: every index is counted, and what tobj gets counts from the front and leaves none out.
//!
//! tobj would stop at an index that is ahead of its line, and takes one that is missing from the corner before. So
//! missing ones name the [`NOTHING`] that stands first, and the others stand behind it.

use std::fmt::Write;
use std::path::Path;

use super::lines::Checked;
use super::{MOST_TRIANGLES, MOST_VERTICES};
use crate::error::quoted;
use crate::{Error, Result};

/// The texture coordinate and the normal of a corner that has none; a normal without direction is made up later.
pub const NOTHING: &str = "vt 0 0\nvn 0 0 0\n";
/// How many lines of [`NOTHING`] stand before the positions, texture coordinates and normals.
const BEFORE: [usize; 3] = [0, 1, 1];

/// What the lines so far allow a corner to name.
#[derive(Default)]
pub struct Corners {
    /// Of positions, texture coordinates and normals.
    counts: [usize; 3],
    /// For each of these: the largest index that was used before its line came.
    ahead: [Option<Ahead>; 3],
    triangles: usize,
}

struct Ahead {
    index: usize,
    line: usize,
    corner: String,
}

impl Corners {
    /// One more position (0), texture coordinate (1) or normal (2).
    pub fn count(&mut self, kind: usize) -> Checked<()> {
        if self.counts[kind] == MOST_VERTICES {
            return Err(format!(
                "found more than {MOST_VERTICES} lines of this kind, expected at most that"
            ));
        }
        self.counts[kind] += 1;
        Ok(())
    }

    /// Puts a face into `text`.
    pub fn face(&mut self, line: usize, rest: &str, text: &mut String) -> Checked<()> {
        text.push('f');
        let mut count = 0;
        for word in rest.split_ascii_whitespace() {
            if word.starts_with('#') {
                break;
            }
            self.corner(line, word, text)?;
            count += 1;
            if count > 2 {
                self.triangles += 1;
            }
            if self.triangles > MOST_TRIANGLES {
                return Err(format!(
                    "found more than {MOST_TRIANGLES} triangles, expected at most that"
                ));
            }
        }
        text.push('\n');
        match count {
            3.. => Ok(()),
            _ => Err(format!(
                "found the face {}, expected at least 3 corners",
                quoted(rest)
            )),
        }
    }

    /// `position/texture coordinate/normal`, the last two of which may be missing.
    fn corner(&mut self, line: usize, word: &str, text: &mut String) -> Checked<()> {
        let mut corner = [1; 3];
        for (kind, index) in word.split('/').enumerate() {
            if kind > 2 || (kind == 0 && index.is_empty()) {
                return Err(format!(
                    "found the corner {}, expected v, v/vt, v//vn or v/vt/vn",
                    quoted(word)
                ));
            }
            if !index.is_empty() {
                corner[kind] = self.place(kind, index, line, word)? + BEFORE[kind] + 1;
            }
        }
        let [position, texture_coord, normal] = corner;
        write!(text, " {position}/{texture_coord}/{normal}").map_err(|error| error.to_string())
    }

    fn place(&mut self, kind: usize, index: &str, line: usize, corner: &str) -> Checked<usize> {
        let count = self.counts[kind];
        let place = place_of(index, count).ok_or_else(|| out_of_range(index, corner, count))?;
        let known = self.ahead[kind]
            .as_ref()
            .map_or(count, |known| known.index + 1);
        if place >= known.max(count) {
            self.ahead[kind] = Some(Ahead {
                index: place,
                line,
                corner: corner.to_owned(),
            });
        }
        Ok(place)
    }

    /// Some programs write faces before their vertices; at the end, all must be there.
    pub fn check_indices_ahead(&self, path: &Path) -> Result<()> {
        for (ahead, count) in self.ahead.iter().zip(self.counts) {
            if let Some(ahead) = ahead
                && ahead.index >= count
            {
                let index = (ahead.index + 1).to_string();
                let message = out_of_range(&index, &ahead.corner, count);
                return Err(Error::input(path, ahead.line, message));
            }
        }
        Ok(())
    }
}

/// From the front indices count from 1, from the back from −1. None if it cannot be there, whatever follows.
fn place_of(index: &str, count: usize) -> Option<usize> {
    match index.parse::<i64>().ok()? {
        0 => None,
        back @ ..0 => count.checked_sub(usize::try_from(back.unsigned_abs()).ok()?),
        front => usize::try_from(front - 1)
            .ok()
            .filter(|place| *place < MOST_VERTICES),
    }
}

fn out_of_range(index: &str, corner: &str, count: usize) -> String {
    let (index, corner) = (quoted(index), quoted(corner));
    match count {
        0 => {
            format!("found the index {index} in {corner}, expected none: there is nothing to count")
        }
        _ => {
            format!("found the index {index} in {corner}, expected 1 to {count}, or −1 to −{count}")
        }
    }
}
