//! Material libraries: the lines that a [`Material`] has a place for.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use image::{ImageFormat, RgbImage};

use super::beside;
use super::lines::{Checked, keyword, lines, numbers};
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
pub const MOST_MATERIALS: usize = 65_536;

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
        let text = files.read(path, TEXT_LIMIT)?;
        let mut current = None;
        for line in lines(&text) {
            let wrong = |message| Error::input(path, line.number, message);
            let (keyword, rest) = keyword(&line.text);
            if self.materials.len() == MOST_MATERIALS {
                return Err(wrong(format!(
                    "found more than {MOST_MATERIALS} materials, expected at most that"
                )));
            }
            if keyword == "newmtl" {
                // Blender has written materials without a name.
                self.keep(current.replace((rest.to_owned(), UNSAID)));
            }
            let Some((_, material)) = &mut current else {
                continue;
            };
            match keyword {
                "Kd" => material.diffuse = color(rest).map_err(wrong)?,
                "Ks" => material.specular = color(rest).map_err(wrong)?,
                "Ns" => {
                    let [shininess] = numbers(rest).map_err(wrong)?;
                    material.shininess = shininess;
                }
                "map_Kd" => material.texture = texture(path, line.number, rest, files)?,
                _ => {}
            }
        }
        self.keep(current);
        Ok(())
    }

    fn keep(&mut self, material: Option<(String, Material)>) {
        if let Some((name, mut material)) = material {
            // With 0 or −1 programs mean no highlight; as an exponent it would be one all over.
            if material.shininess <= 0.0 {
                material.specular = DVec3::ZERO;
                material.shininess = UNSAID.shininess;
            }
            self.materials.entry(name).or_insert(material);
        }
    }
}

/// Three numbers, or one for a grey.
fn color(rest: &str) -> Checked<DVec3> {
    match rest.split_ascii_whitespace().count() {
        1 => numbers::<1>(rest).map(|[grey]| DVec3::splat(grey)),
        _ => numbers::<3>(rest).map(DVec3::from),
    }
}

/// The picture of a `map_Kd`, or a note that there is none.
fn texture(path: &Path, line: usize, rest: &str, files: &Files) -> Result<Option<Arc<RgbImage>>> {
    let wrong = |message| Error::input(path, line, message);
    let name = without_options(rest);
    if name.is_empty() {
        return Ok(None);
    }
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
