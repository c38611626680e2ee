//! Which files of the folder take part: those with the names of the lab's.

use std::path::{Path, PathBuf};

use super::{Finding, nothing_here};
use crate::error::did_you_mean;
use crate::gl::Made;
use crate::glsl::{Scan, Storage};
use crate::labs::Handout;
use crate::scene::reading;
use crate::{Error, Result};

/// What shader files are called, where they end.
const ENDINGS: [&str; 9] = [
    "vert", "frag", "glsl", "vs", "fs", "vsh", "fsh", "vertex", "fragment",
];
/// So many names in common tell which of the lab's files a file with another name is.
const IN_COMMON: usize = 2;

pub struct Files {
    pub students: Vec<File>,
    /// Shaders that take no part, each with the reason.
    left_out: Vec<(PathBuf, String)>,
}

pub struct File {
    /// The lab's name for it.
    pub name: String,
    pub path: PathBuf,
    pub text: String,
}

/// Reads the files of the lab's names. `made` are the lab's own programs.
pub fn read(handout: &Handout, folder: &Path, made: &[Made]) -> Result<Files> {
    let failed = |cause| Error::reading(folder, cause);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        found.push(entry.map_err(failed)?.path());
    }
    found.sort();
    let mut files = Files {
        students: Vec::new(),
        left_out: Vec::new(),
    };
    // Each file once, though several programs have it.
    let mut own: Vec<(&str, &str)> = Vec::new();
    for file in made.iter().flat_map(|made| &made.files) {
        if !own.iter().any(|(name, _)| *name == file.name) {
            own.push((&file.name, &file.text));
        }
    }
    let mut others = Vec::new();
    for path in found {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if own.iter().any(|(own, _)| *own == name) {
            let text = reading::read_text(&path, reading::TEXT_LIMIT)?;
            files.students.push(File {
                name: name.into_owned(),
                path,
                text,
            });
        } else if is_shader(&path) && !handout.shaders.iter().any(|(own, _)| *own == name) {
            others.push(path);
        }
    }
    for path in others {
        let meant = meant(&path, &own, &files);
        files.left_out.push((path, meant));
    }
    if files.students.is_empty() {
        let hint = |(path, hint): &(PathBuf, String)| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            format!("\"{name}\"{hint}")
        };
        let hints = files.left_out.iter().filter(|(_, hint)| !hint.is_empty());
        let hints: Vec<_> = hints.map(hint).collect();
        let names: Vec<_> = own.iter().map(|(name, _)| *name).collect();
        return Err(nothing_here(handout, folder, &hints, &names));
    }
    Ok(files)
}

impl Files {
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    pub fn find(&self, name: &str) -> Option<&File> {
        self.students.iter().find(|file| file.name == name)
    }

    pub fn findings(&self, handout: &Handout) -> Vec<Finding> {
        let note = |(path, meant): &(PathBuf, String)| {
            let text = format!(
                "takes no part: {} has no shader of this name{meant}",
                handout.name
            );
            Finding::note((path, None), text)
        };
        self.left_out.iter().map(note).collect()
    }
}

fn is_shader(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    ENDINGS.contains(&ending.to_lowercase().as_str())
}

/// The file of the lab whose names this file has, or whose own name is near.
fn meant(path: &Path, own: &[(&str, &str)], files: &Files) -> String {
    let text = reading::read_text(path, reading::TEXT_LIMIT).unwrap_or_default();
    let scan = Scan::new(&text);
    let in_common = |labs: &str| {
        let labs = Scan::new(labs);
        let names = labs.of(&[Storage::In, Storage::Uniform]);
        let declared = |name: &str| scan.declared.iter().any(|found| found.name == name);
        names.filter(|found| declared(found.name)).count()
    };
    let nearest = own
        .iter()
        .map(|(name, text)| (in_common(text), *name))
        .max();
    match nearest {
        Some((names, name)) if names >= IN_COMMON => {
            let declares = format!("it declares {names} of the names of \"{name}\"");
            match files.has(name) {
                true => format!(" ({declares}, which is here already)"),
                false => format!(" ({declares}: did you mean that?)"),
            }
        }
        _ => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let free = own.iter().filter(|(name, _)| !files.has(name));
            did_you_mean(&name, free.map(|(name, _)| *name))
        }
    }
}
