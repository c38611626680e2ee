//! The one door through which a student's files come in.
//!
//! Nobody has checked these files. What is opened is a regular file, and never a pipe that would wait for ever; what is
//! read has a limit, so a file that grows while it is read ends there; and a scene that was handed on reads nothing
//! outside of its own folder.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::RgbaImage;

use super::texture;
use crate::{Error, Result};

/// The most that is read of a file, in bytes: far more than any that a person made.
///
/// TOML takes 80 times its size in memory while it is read, so a scene has the smallest limit; 4 MiB hold 60,000 objects.
pub const SCENE_LIMIT: u64 = 4 << 20;
/// Shaders and material libraries.
pub const TEXT_LIMIT: u64 = 16 << 20;
pub const MODEL_LIMIT: u64 = 1 << 30;
pub const PICTURE_LIMIT: u64 = 256 << 20;

/// How many notes are told; a broken file could hold a million reasons.
const MOST_NOTES: usize = 20;

/// The bytes of a regular file.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>> {
    read_as(path, path, limit)
}

/// The text of a regular file.
pub fn read_text(path: &Path, limit: u64) -> Result<String> {
    String::from_utf8(read(path, limit)?).map_err(|wrong| {
        let place = wrong.utf8_error().valid_up_to();
        let cause = format!("found no UTF-8 at byte {place}, expected text");
        Error::reading(path, io::Error::other(cause))
    })
}

/// Reads `real`, which messages call `path`.
fn read_as(path: &Path, real: &Path, limit: u64) -> Result<Vec<u8>> {
    let failed = |cause| Error::reading(path, cause);
    // Looked at before it is opened, because opening a pipe waits for its writer and opening a device may act; and
    // again after, because by then the name may stand for something else.
    let found = fs::metadata(real).map_err(failed)?;
    regular(&found, limit).map_err(failed)?;
    let file = open(real).map_err(failed)?;
    let found = file.metadata().map_err(failed)?;
    regular(&found, limit).map_err(failed)?;

    let mut bytes = Vec::new();
    let mut bounded = file.take(limit + 1);
    bounded.read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(failed(too_large(limit)));
    }
    Ok(bytes)
}

fn regular(found: &Metadata, limit: u64) -> io::Result<()> {
    if found.is_dir() {
        return Err(io::Error::other("it is a directory, expected a file"));
    }
    if !found.is_file() {
        return Err(io::Error::other(
            "it is a pipe, a socket or a device, expected a file",
        ));
    }
    if found.len() > limit {
        return Err(too_large(limit));
    }
    Ok(())
}

fn too_large(limit: u64) -> io::Error {
    let mib = limit >> 20;
    io::Error::other(format!(
        "it is larger than {mib} MiB, expected at most that"
    ))
}

/// Opens without waiting, where the flag for that is known.
fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(all(
        target_os = "linux",
        any(target_arch = "x86_64", target_arch = "aarch64")
    ))]
    {
        const O_NONBLOCK: i32 = 0o4000;
        std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, O_NONBLOCK);
    }
    options.open(path)
}

/// What hands out a file's bytes: path, and the most that may be read.
type ReadFile<'a> = dyn Fn(&Path, u64) -> Result<Vec<u8>> + 'a;

/// The files that a scene or a model names, its pictures (each decoded once), and what was odd about them.
pub struct Files<'a> {
    read: Box<ReadFile<'a>>,
    pictures: RefCell<Pictures>,
    notes: RefCell<Vec<String>>,
}

struct Pictures {
    decoded: HashMap<PathBuf, Arc<RgbaImage>>,
    /// Bytes that may still be decoded.
    room: u64,
}

impl<'a> Files<'a> {
    /// Files that come from `read`, which may hold them in memory.
    pub fn new(read: impl Fn(&Path, u64) -> Result<Vec<u8>> + 'a) -> Self {
        let pictures = Pictures {
            decoded: HashMap::new(),
            room: texture::MOST_BYTES,
        };
        Self {
            read: Box::new(read),
            pictures: RefCell::new(pictures),
            notes: RefCell::default(),
        }
    }

    pub fn anywhere() -> Self {
        Self::new(read)
    }

    /// Files of a folder and of those in it, wherever links and `..` lead.
    pub fn within(folder: &Path) -> Result<Self> {
        // The empty path is how `parent` spells the folder that one is in.
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
        let folder = fs::canonicalize(folder).map_err(|cause| Error::reading(folder, cause))?;
        Ok(Self::new(move |path, limit| {
            let real = fs::canonicalize(path).map_err(|cause| Error::reading(path, cause))?;
            if !real.starts_with(&folder) {
                let message = "lies outside of the scene's folder, expected a file inside it (or --allow-outside)";
                return Err(Error::input(path, None, message));
            }
            read_as(path, &real, limit)
        }))
    }

    pub fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>> {
        (self.read)(path, limit)
    }

    /// A PNG or JPEG as RGB and alpha.
    pub fn picture(&self, path: &Path) -> Result<Arc<RgbaImage>> {
        let pictures = &mut *self.pictures.borrow_mut();
        if let Some(known) = pictures.decoded.get(path) {
            return Ok(Arc::clone(known));
        }
        let bytes = self.read(path, PICTURE_LIMIT)?;
        let picture = texture::decode(path, &bytes, pictures.room)?;
        pictures.room -= texture::bytes(&picture);
        let picture = Arc::new(picture);
        pictures
            .decoded
            .insert(path.to_owned(), Arc::clone(&picture));
        Ok(picture)
    }

    /// Something odd that the program goes on without.
    pub fn note(&self, place: &Error) {
        if !self.takes_notes() {
            return;
        }
        let note = place.to_string();
        let mut notes = self.notes.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// Whether there is room for one more; what finds out more about a note need not do so in vain.
    pub fn takes_notes(&self) -> bool {
        self.notes.borrow().len() <= MOST_NOTES
    }

    pub fn notes(&self) -> Vec<String> {
        self.notes.borrow().clone()
    }

    /// The notes on standard error, one line each.
    pub fn print_notes(&self) {
        let notes = self.notes.borrow();
        for note in notes.iter().take(MOST_NOTES) {
            eprintln!("note: {note}");
        }
        if notes.len() > MOST_NOTES {
            eprintln!("note: and more of that kind");
        }
    }
}
