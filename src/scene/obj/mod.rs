//! OBJ models, as they are found: a guard checks the lines, tobj reads what passes, and its arrays become meshes.
//!
//! What makes the geometry wrong (a number that is none, an index out of range) stops with file and line. What only makes
//! it plainer (a material or a texture that is not there) is noted, and the model is drawn without.

mod build;
mod corners;
mod groups;
mod guard;
mod lines;
mod mtl;
mod polygon;

use std::path::{Path, PathBuf};

use super::reading::{Files, MODEL_LIMIT};
use super::{Material, Mesh};
use crate::{Error, Result};

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
    // The file's own text is dropped before tobj reads what passed.
    let passed = check(path, &files.read(path, MODEL_LIMIT)?, files)?;
    build::parts(path, passed)
}

/// A model in memory, with its materials and textures from `files`.
pub fn parse_with(path: &Path, text: &[u8], files: &Files) -> Result<Vec<Part>> {
    build::parts(path, check(path, text, files)?)
}

fn check(path: &Path, text: &[u8], files: &Files) -> Result<guard::Passed> {
    // Notepad's "Unicode".
    if text.starts_with(b"\xff\xfe") || text.starts_with(b"\xfe\xff") {
        let message = "found UTF-16, expected a model in ASCII or UTF-8";
        return Err(Error::input(path, None, message));
    }
    guard::check(path, text, files)
}

/// The guard let something through that tobj does not take: a mistake in this program.
fn unread(cause: &tobj::LoadError) -> String {
    format!("found what tobj cannot read ({cause}), expected that the checks stop it")
}

/// The path of a file that is named in another one. Programs on Windows write names with backslashes.
fn beside(path: &Path, name: &str) -> PathBuf {
    path.with_file_name("").join(name.replace('\\', "/"))
}

#[cfg(test)]
mod tests;
