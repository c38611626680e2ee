//! OBJ models, as they are found.
//!
//! What makes the geometry wrong (a number that is none, an index out of range) stops with file and line. What only makes
//! it plainer (a material or a texture that is not there) is noted, and the model is drawn without.

mod build;
mod lines;
mod mtl;
mod polygon;
mod progress;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};

use super::reading::{Files, MODEL_LIMIT};
use super::{Material, Mesh};
use crate::error::{did_you_mean, quoted};
use crate::{Error, Result};
use lines::{Checked, keyword, lines, numbers};
use progress::Progress;

/// The faces of one object that have one material.
#[derive(Clone, Debug)]
pub struct Part {
    pub name: String,
    pub mesh: Mesh,
    /// None where the model names none, or one that does not exist.
    pub material: Option<Material>,
}

/// Limits that bound the memory: a face of six bytes becomes 200 bytes of triangle.
pub const MOST_TRIANGLES: usize = 10_000_000;
const MOST_VERTICES: usize = 3 * MOST_TRIANGLES;

/// Reads a model; its materials and its textures are looked for beside it.
pub fn load(path: &Path) -> Result<Vec<Part>> {
    let files = Files::anywhere();
    let parts = read(path, &files)?;
    files.print_notes();
    Ok(parts)
}

/// A model in memory: `path` is its name in messages, `read` gives a material library or texture by name.
pub fn parse(
    path: &Path,
    text: &[u8],
    read: impl Fn(&str) -> Result<Vec<u8>>,
) -> Result<Vec<Part>> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = Files::new(|path, _| {
        let name = path.strip_prefix(folder).unwrap_or(path);
        read(&name.to_string_lossy())
    });
    parse_with(path, text, &files)
}

/// Reads a model and what belongs to it from `files`.
pub fn read(path: &Path, files: &Files) -> Result<Vec<Part>> {
    parse_with(path, &files.read(path, MODEL_LIMIT)?, files)
}

/// A model in memory, with its materials and textures from `files`.
pub fn parse_with(path: &Path, text: &[u8], files: &Files) -> Result<Vec<Part>> {
    // Notepad's "Unicode".
    if text.starts_with(b"\xff\xfe") || text.starts_with(b"\xfe\xff") {
        let message = "found UTF-16, expected a model in ASCII or UTF-8";
        return Err(Error::input(path, None, message));
    }
    let mut model = Model::new(path);
    let mut progress = Progress::new(path, text.len());
    for line in lines(text) {
        progress.at(line.end);
        let (keyword, rest) = keyword(&line.text);
        model
            .take(line.number, keyword, rest, files)
            .map_err(|problem| match problem {
                Problem::Here(message) => Error::input(path, line.number, message),
                Problem::Elsewhere(error) => error,
            })?;
    }
    model.check_indices_ahead()?;
    let parts = build::parts(&model, files);
    if parts.is_empty() {
        let message = "found no faces, expected at least one";
        return Err(Error::input(path, None, message));
    }
    Ok(parts)
}

/// What is wrong with the line at hand, or with another file.
enum Problem {
    Here(String),
    Elsewhere(Error),
}

impl From<String> for Problem {
    fn from(message: String) -> Self {
        Self::Here(message)
    }
}

/// What the lines so far have said.
struct Model<'a> {
    path: &'a Path,
    positions: Vec<DVec3>,
    texture_coords: Vec<DVec2>,
    normals: Vec<DVec3>,
    /// The corners of all faces, one face behind the other.
    corners: Vec<Corner>,
    faces: Vec<Face>,
    triangles: usize,
    /// For positions, texture coordinates and normals: the largest index that was used before its line came.
    ahead: [Option<Ahead>; 3],
    /// Each name of an object or group, and each of a material with the line that used it first, if it has faces.
    names: Vec<String>,
    materials: Vec<Used>,
    material_numbers: HashMap<String, u32>,
    library: mtl::Library,
    /// What the next face belongs to: numbers, and names that have none yet because they have no face.
    name: u32,
    new_name: Option<String>,
    material: u32,
    new_material: Option<Used>,
}

/// Indices from 0 into positions, texture coordinates and normals; [`NONE`] where the corner has none.
type Corner = [u32; 3];
const NONE: u32 = u32::MAX;

struct Face {
    /// Where its corners end; they begin where those of the face before end.
    end: usize,
    name: u32,
    material: u32,
}

struct Ahead {
    index: usize,
    line: usize,
    corner: String,
}

struct Used {
    name: String,
    line: usize,
}

impl<'a> Model<'a> {
    fn new(path: &'a Path) -> Self {
        Self {
            path,
            positions: Vec::new(),
            texture_coords: Vec::new(),
            normals: Vec::new(),
            corners: Vec::new(),
            faces: Vec::new(),
            triangles: 0,
            ahead: [None, None, None],
            names: vec!["object".to_owned()],
            materials: Vec::new(),
            material_numbers: HashMap::new(),
            library: mtl::Library::default(),
            name: 0,
            new_name: None,
            material: NONE,
            new_material: None,
        }
    }

    fn take(
        &mut self,
        line: usize,
        keyword: &str,
        rest: &str,
        files: &Files,
    ) -> std::result::Result<(), Problem> {
        match keyword {
            // A fourth number would be a weight, more would be a colour.
            "v" => push(&mut self.positions, numbers(rest)?.into())?,
            "vn" => push(&mut self.normals, numbers(rest)?.into())?,
            "vt" => push(&mut self.texture_coords, texture_coord(rest)?)?,
            // `fo` is how the format's first version spelt it.
            "f" | "fo" => self.face(line, rest)?,
            "o" | "g" => self.new_name = Some(rest.to_owned()),
            "usemtl" => {
                let name = rest.to_owned();
                self.new_material = Some(Used { name, line });
            }
            "mtllib" => self
                .libraries(line, rest, files)
                .map_err(Problem::Elsewhere)?,
            // Points and lines have no area; the rest says nothing about faces.
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, line: usize, rest: &str) -> Checked<()> {
        self.number_names()?;
        let start = self.corners.len();
        for word in rest.split_ascii_whitespace() {
            if word.starts_with('#') {
                break;
            }
            let corner = self.corner(line, word)?;
            self.corners.push(corner);
            let triangles = (self.corners.len() - start).saturating_sub(2);
            if self.triangles + triangles > MOST_TRIANGLES {
                return Err(format!(
                    "found more than {MOST_TRIANGLES} triangles, expected at most that"
                ));
            }
        }
        let count = self.corners.len() - start;
        if count < 3 {
            let found = quoted(rest);
            return Err(format!(
                "found the face {found}, expected at least 3 corners"
            ));
        }
        self.triangles += count - 2;
        self.faces.push(Face {
            end: self.corners.len(),
            name: self.name,
            material: self.material,
        });
        Ok(())
    }

    /// `position/texture coordinate/normal`, the last two of which may be missing.
    fn corner(&mut self, line: usize, word: &str) -> Checked<Corner> {
        let counts = [
            self.positions.len(),
            self.texture_coords.len(),
            self.normals.len(),
        ];
        let mut corner = [NONE; 3];
        for (kind, index) in word.split('/').enumerate() {
            if kind > 2 || (kind == 0 && index.is_empty()) {
                return Err(format!(
                    "found the corner {}, expected v, v/vt, v//vn or v/vt/vn",
                    quoted(word)
                ));
            }
            if index.is_empty() {
                continue;
            }
            let count = counts[kind];
            let place = place_of(index, count).ok_or_else(|| out_of_range(index, word, count))?;
            if place >= count
                && self.ahead[kind]
                    .as_ref()
                    .is_none_or(|known| known.index < place)
            {
                self.ahead[kind] = Some(Ahead {
                    index: place,
                    line,
                    corner: word.to_owned(),
                });
            }
            corner[kind] = place as u32;
        }
        Ok(corner)
    }

    /// Some programs write faces before their vertices; at the end, all must be there.
    fn check_indices_ahead(&self) -> Result<()> {
        let counts = [
            self.positions.len(),
            self.texture_coords.len(),
            self.normals.len(),
        ];
        for (ahead, count) in self.ahead.iter().zip(counts) {
            if let Some(ahead) = ahead
                && ahead.index >= count
            {
                let index = (ahead.index + 1).to_string();
                let message = out_of_range(&index, &ahead.corner, count);
                return Err(Error::input(self.path, ahead.line, message));
            }
        }
        Ok(())
    }

    /// Numbers for the names that the face at hand is the first to belong to.
    fn number_names(&mut self) -> Checked<()> {
        if let Some(name) = self.new_name.take() {
            // Beyond that, parts have no names.
            self.name = 0;
            if self.names.len() < build::MOST_NAMED_PARTS {
                self.name = self.names.len() as u32;
                self.names.push(name);
            }
        }
        if let Some(used) = self.new_material.take() {
            let known = self.material_numbers.get(&used.name);
            self.material = known.copied().unwrap_or(self.materials.len() as u32);
            if known.is_none() {
                if self.materials.len() == mtl::MOST_MATERIALS {
                    let most = mtl::MOST_MATERIALS;
                    return Err(format!(
                        "found more than {most} materials, expected at most that"
                    ));
                }
                self.material_numbers
                    .insert(used.name.clone(), self.material);
                self.materials.push(used);
            }
        }
        Ok(())
    }

    /// One name that may have spaces in it, or several names with spaces between them.
    fn libraries(&mut self, line: usize, rest: &str, files: &Files) -> Result<()> {
        if self.library.read(&beside(self.path, rest), files)? {
            return Ok(());
        }
        let several = rest.split_whitespace().nth(1).is_some();
        for name in rest.split_whitespace() {
            if !several || !self.library.read(&beside(self.path, name), files)? {
                let name = quoted(name);
                let message = format!("found no file {name}, drawn without its materials");
                files.note(&Error::input(self.path, line, message));
            }
        }
        Ok(())
    }

    /// The materials that faces use, by number; a note for each that there is not.
    fn resolved_materials(&self, files: &Files) -> Vec<Option<&Material>> {
        let resolve = |used: &Used| {
            let found = self.library.materials.get(&used.name);
            if found.is_none() && files.takes_notes() {
                let names = self.library.materials.keys().map(String::as_str);
                let hint = did_you_mean(&used.name, names);
                let name = quoted(&used.name);
                let message = format!("found no material {name}{hint}, drawn with the default");
                files.note(&Error::input(self.path, used.line, message));
            }
            found
        };
        self.materials.iter().map(resolve).collect()
    }
}

fn push<T>(list: &mut Vec<T>, value: T) -> Checked<()> {
    if list.len() == MOST_VERTICES {
        return Err(format!(
            "found more than {MOST_VERTICES} lines of this kind, expected at most that"
        ));
    }
    list.push(value);
    Ok(())
}

/// One number or two; a third would be for solid textures.
fn texture_coord(rest: &str) -> Checked<DVec2> {
    match rest.split_ascii_whitespace().count() {
        1 => numbers::<1>(rest).map(|[s]| DVec2::new(s, 0.0)),
        _ => numbers::<2>(rest).map(DVec2::from),
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

/// The path of a file that is named in another one. Programs on Windows write names with backslashes.
fn beside(path: &Path, name: &str) -> PathBuf {
    path.with_file_name("").join(name.replace('\\', "/"))
}

#[cfg(test)]
mod tests;
