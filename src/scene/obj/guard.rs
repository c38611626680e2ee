//! The guard in front of tobj: what passes is written anew, so that tobj can neither stop nor misread it.
//!
//! tobj tells no lines, and takes less than is found in files. Of a model it gets `v`, `vt`, `vn`, and behind them one `o`
//! for each part with its `f`: numbers and nothing else. Names stay here.

use std::path::Path;

use super::corners::{Corners, NOTHING};
use super::groups::Groups;
use super::lines::{Checked, keyword, lines, numbers, put};
use super::{Part, beside, mtl};
use crate::error::{one_line, quoted};
use crate::progress::Progress;
use crate::scene::reading::Files;
use crate::{Error, Result};

/// What passed: the parts, still without their meshes, and the text for tobj.
pub type Passed = (Vec<Part>, String);

/// Goes over the lines of a model once.
pub fn check(path: &Path, text: &[u8], files: &Files) -> Result<Passed> {
    let mut guard = Guard {
        path,
        files,
        text: NOTHING.to_owned(),
        corners: Corners::default(),
        groups: Groups::default(),
        library: mtl::Library::default(),
    };
    let name = one_line(&path.display().to_string());
    let progress = Progress::new(format!("checking {name}"), text.len() as u64);
    let mut end = 0;
    for line in lines(text) {
        progress.add((line.end - end) as u64);
        end = line.end;
        let (keyword, rest) = keyword(&line.text);
        match keyword {
            "mtllib" => guard.libraries(line.number, rest)?,
            _ => guard
                .take(line.number, keyword, rest)
                .map_err(|message| Error::input(path, line.number, message))?,
        }
    }
    guard.passed()
}

struct Guard<'a> {
    path: &'a Path,
    files: &'a Files<'a>,
    text: String,
    corners: Corners,
    groups: Groups,
    library: mtl::Library,
}

impl Guard<'_> {
    fn take(&mut self, line: usize, keyword: &str, rest: &str) -> Checked<()> {
        match keyword {
            // A fourth number would be a weight, more would be a colour.
            "v" => self.vertex(0, "v", &numbers::<3>(rest)?)?,
            "vt" => self.vertex(1, "vt", &texture_coord(rest)?)?,
            "vn" => self.vertex(2, "vn", &numbers::<3>(rest)?)?,
            // `fo` is how the format's first version spelt it.
            "f" | "fo" => self.corners.face(line, rest, self.groups.faces()?)?,
            "o" | "g" => self.groups.start(rest),
            "usemtl" => self.groups.use_material(line, rest),
            // Points and lines have no area; the rest says nothing about faces.
            _ => {}
        }
        Ok(())
    }

    fn vertex(&mut self, kind: usize, keyword: &str, words: &[&str]) -> Checked<()> {
        self.corners.count(kind)?;
        put(&mut self.text, keyword, words);
        Ok(())
    }

    /// One name that may have spaces in it, or several names with spaces between them.
    fn libraries(&mut self, line: usize, rest: &str) -> Result<()> {
        let (path, files) = (self.path, self.files);
        if self.library.read(&beside(path, rest), files)? {
            return Ok(());
        }
        let several = rest.split_whitespace().nth(1).is_some();
        for name in rest.split_whitespace() {
            if !several || !self.library.read(&beside(path, name), files)? {
                let name = quoted(name);
                let message = format!("found no file {name}, drawn without its materials");
                files.note(&Error::input(path, line, message));
            }
        }
        Ok(())
    }

    fn passed(mut self) -> Result<Passed> {
        self.corners.check_indices_ahead(self.path)?;
        let (parts, faces) = self.groups.parts(&self.library, self.path, self.files);
        if parts.is_empty() {
            let message = "found no faces, expected at least one";
            return Err(Error::input(self.path, None, message));
        }
        for faces in faces {
            put(&mut self.text, "o", &[]);
            self.text.push_str(&faces);
        }
        Ok((parts, self.text))
    }
}

/// One number or two; a third would be for solid textures.
fn texture_coord(rest: &str) -> Checked<[&str; 2]> {
    match rest.split_ascii_whitespace().count() {
        1 => numbers(rest).map(|[s]| [s, "0"]),
        _ => numbers(rest),
    }
}
