//! What the lines of a model say, one after the other.

use std::collections::HashMap;
use std::path::Path;

use glam::{DVec2, DVec3};

use super::lines::{Checked, numbers};
use super::{MOST_TRIANGLES, MOST_VERTICES, beside, build, mtl};
use crate::error::{did_you_mean, quoted};
use crate::scene::Material;
use crate::scene::reading::Files;
use crate::{Error, Result};

/// What is wrong with the line at hand, or with another file.
pub enum Problem {
    Here(String),
    Elsewhere(Error),
}

impl From<String> for Problem {
    fn from(message: String) -> Self {
        Self::Here(message)
    }
}

/// What the lines so far have said.
pub struct Model<'a> {
    path: &'a Path,
    pub positions: Vec<DVec3>,
    pub texture_coords: Vec<DVec2>,
    pub normals: Vec<DVec3>,
    /// The corners of all faces, one face behind the other.
    pub corners: Vec<Corner>,
    pub faces: Vec<Face>,
    triangles: usize,
    /// For positions, texture coordinates and normals: the largest index that was used before its line came.
    ahead: [Option<Ahead>; 3],
    /// Each name of an object or group, and each of a material with the line that used it first, if it has faces.
    pub names: Vec<String>,
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
pub type Corner = [u32; 3];
pub const NONE: u32 = u32::MAX;

pub struct Face {
    /// Where its corners end; they begin where those of the face before end.
    pub end: usize,
    pub name: u32,
    pub material: u32,
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
    pub fn new(path: &'a Path) -> Self {
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

    pub fn take(
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
    pub fn check_indices_ahead(&self) -> Result<()> {
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
    pub fn resolved_materials(&self, files: &Files) -> Vec<Option<&Material>> {
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
