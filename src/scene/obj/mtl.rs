//! Material libraries: the lines that a [`Material`] has a place for are checked, and tobj reads them.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use image::{ImageFormat, RgbaImage};

use super::beside;
use super::lines::{Checked, keyword, lines, numbers, put};
use crate::error::quoted;
use crate::scene::Material;
use crate::scene::reading::{Files, TEXT_LIMIT};
use crate::{Error, Result};

/// The materials of all libraries of a model, by name. Of two with one name, the first is kept.
#[derive(Default)]
pub struct Library {
    pub materials: HashMap<String, Material>,
    asked_for: HashSet<PathBuf>,
}

/// Limits that bound time and memory: a model of a gigabyte could name the same library a hundred million times.
const MOST_LIBRARIES: usize = 100;
const MOST_MATERIALS: usize = 65_536;

/// What a material has where its lines say nothing.
const UNSAID: Material = Material {
    diffuse: DVec3::splat(0.8),
    specular: DVec3::ZERO,
    shininess: 1.0,
    texture: None,
};

impl Library {
    /// Whether there is, or was, anything to read.
    pub fn read(&mut self, path: &Path, files: &Files) -> Result<bool> {
        if self.asked_for.contains(path) {
            return Ok(true);
        }
        if self.asked_for.len() == MOST_LIBRARIES {
            let message =
                format!("is one library more than {MOST_LIBRARIES}, expected at most that");
            return Err(Error::input(path, None, message));
        }
        self.asked_for.insert(path.to_owned());
        match self.read_lines(path, files) {
            Err(error) if error.is_missing() => Ok(false),
            done => done.map(|()| true),
        }
    }

    fn read_lines(&mut self, path: &Path, files: &Files) -> Result<()> {
        let passed = check(path, &files.read(path, TEXT_LIMIT)?, self.materials.len())?;
        let (materials, _) = tobj::load_mtl_buf(&mut passed.text.as_bytes())
            .map_err(|error| Error::input(path, None, super::unread(&error)))?;
        for (named, found) in passed.materials.into_iter().zip(materials) {
            let texture = match &found.diffuse_texture {
                Some(name) => texture(path, named.texture_line, name, files)?,
                None => None,
            };
            self.materials
                .entry(named.name)
                .or_insert(material(&found, texture));
        }
        Ok(())
    }
}

/// What passed.
#[derive(Default)]
struct Passed {
    /// For tobj: materials have numbers for names.
    text: String,
    materials: Vec<Named>,
}

struct Named {
    name: String,
    texture_line: usize,
}

/// Goes over the lines of a library once; there are `known` materials already.
fn check(path: &Path, text: &[u8], known: usize) -> Result<Passed> {
    let mut passed = Passed::default();
    for line in lines(text) {
        let (keyword, rest) = keyword(&line.text);
        passed
            .take(line.number, keyword, rest, known)
            .map_err(|message| Error::input(path, line.number, message))?;
    }
    Ok(passed)
}

impl Passed {
    fn take(&mut self, line: usize, keyword: &str, rest: &str, known: usize) -> Checked<()> {
        if keyword == "newmtl" {
            check_count(known + self.materials.len())?;
            let number = self.materials.len().to_string();
            put(&mut self.text, "newmtl", &[&number]);
            // Blender has written materials without a name.
            self.materials.push(Named {
                name: rest.to_owned(),
                texture_line: line,
            });
        }
        let Some(material) = self.materials.last_mut() else {
            return Ok(());
        };
        match keyword {
            "Kd" | "Ks" => put(&mut self.text, keyword, &color(rest)?),
            "Ns" => put(&mut self.text, keyword, &numbers::<1>(rest)?),
            "map_Kd" if !without_options(rest).is_empty() => {
                material.texture_line = line;
                put(&mut self.text, keyword, &[without_options(rest)]);
            }
            _ => {}
        }
        Ok(())
    }
}

/// Whether there may be one more material than `count`.
pub fn check_count(count: usize) -> Checked<()> {
    match count {
        ..MOST_MATERIALS => Ok(()),
        _ => Err(format!(
            "found more than {MOST_MATERIALS} materials, expected at most that"
        )),
    }
}

fn material(found: &tobj::Material, texture: Option<Arc<RgbaImage>>) -> Material {
    let shininess = found.shininess.unwrap_or(UNSAID.shininess);
    let mut material = Material {
        diffuse: found.diffuse.map_or(UNSAID.diffuse, DVec3::from),
        specular: found.specular.map_or(UNSAID.specular, DVec3::from),
        shininess,
        texture,
    };
    // With 0 or −1 programs mean no highlight; as an exponent it would be one all over.
    if shininess <= 0.0 {
        material.specular = DVec3::ZERO;
        material.shininess = UNSAID.shininess;
    }
    material
}

/// Three numbers, or one for a grey.
fn color(rest: &str) -> Checked<[&str; 3]> {
    match rest.split_ascii_whitespace().count() {
        1 => numbers(rest).map(|[grey]| [grey; 3]),
        _ => numbers(rest),
    }
}

/// The picture of a `map_Kd`, or a note that there is none.
fn texture(path: &Path, line: usize, name: &str, files: &Files) -> Result<Option<Arc<RgbaImage>>> {
    let wrong = |message| Error::input(path, line, message);
    let drawn_without = |what: &str| {
        let name = quoted(name);
        files.note(&wrong(format!("found {what} {name}, drawn without it")));
        Ok(None)
    };
    if !drawable(name) {
        return drawn_without("no PNG or JPEG but");
    }
    match files.picture(&beside(path, name)) {
        Err(error) if error.is_missing() => {}
        found => return found.map(Some),
    }
    // The path may be that of the disk where the model was made.
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    match files.picture(&beside(path, last)) {
        Err(error) if error.is_missing() => drawn_without("no file"),
        found => found.map(Some),
    }
}

/// Whether a name's ending is that of a format which is read here, or unknown.
fn drawable(name: &str) -> bool {
    let older = ["tga", "dds", "psd", "exr", "tx"];
    let ending = Path::new(name).extension().unwrap_or_default();
    let ending = ending.to_string_lossy().to_lowercase();
    match ImageFormat::from_extension(&ending) {
        Some(format) => matches!(format, ImageFormat::Png | ImageFormat::Jpeg),
        None => !older.contains(&ending.as_str()),
    }
}

/// The name, which may have spaces in it, behind options such as `-s 1 1 1`.
fn without_options(rest: &str) -> &str {
    let mut rest = rest.trim();
    while let Some(after) = option_taken(rest) {
        rest = after;
    }
    rest
}

/// What follows the first option and its values; None where no option stands first.
fn option_taken(rest: &str) -> Option<&str> {
    let (option, mut rest) = keyword(rest);
    let (least, most) = match option {
        "-s" | "-o" | "-t" => (1, 3),
        "-mm" => (2, 2),
        "-blendu" | "-blendv" | "-cc" | "-clamp" | "-texres" | "-bm" | "-boost" | "-imfchan"
        | "-type" => (1, 1),
        _ => return None,
    };
    for count in 0..most {
        let (value, after) = keyword(rest);
        if count >= least && value.parse::<f64>().is_err() {
            break;
        }
        rest = after;
    }
    Some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_the_name() {
        for (rest, name) in [
            ("wood.png", "wood.png"),
            ("-s 1 1 1 wood.png", "wood.png"),
            ("-s 2 my wood.png", "my wood.png"),
            ("-clamp on -o 0 0 -bm 0.3 a/b.jpg", "a/b.jpg"),
            ("-dark.png", "-dark.png"),
            ("-s", ""),
        ] {
            assert_eq!(without_options(rest), name, "{rest}");
        }
    }
}
