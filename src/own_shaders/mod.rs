//! A student's own shaders in the place of a lab's: what is wrong with them, and where their shadows are.
//!
//! The handouts fix names and types; whatever else a shader does is the student's own affair. What has an effect is asked
//! of the driver, and in which line it is declared, of the text.
//!
//! | file | what |
//! |---|---|
//! | `files.rs` | which files of the folder take part, and which do not |
//! | `subject.rs` | a program of the lab with the student's files in it, beside the lab's own |
//! | `driver.rs` | what does not compile or link |
//! | `inputs.rs` | the vertex shader's inputs |
//! | `uniforms.rs` | names and types of uniforms, and the texture units of samplers |
//! | `stages.rs` | what the vertex shader hands on to the fragment shader |
//! | `needed.rs` | what the handouts' shadows do not come about without |
//! | `age.rs` | GLSL of the handouts' age |
//! | `visibility.rs` | the shadows of a shader that does not show them alone |

mod age;
mod driver;
mod files;
mod inputs;
mod needed;
mod stages;
mod subject;
mod uniforms;
mod visibility;

use std::fmt;
use std::path::{Path, PathBuf};

use crate::error::one_line;
use crate::gl;
use crate::headless::Headless;
use crate::labs::{Handout, Show};
use crate::{Error, Result};

pub use visibility::{try_visibility, visibility};

/// What was found in a student's shader, and what was expected.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    pub weight: Weight,
    pub path: PathBuf,
    pub line: Option<usize>,
    pub text: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// It spoils the picture.
    Wrong,
    /// It does not, or not here.
    Note,
}

impl Finding {
    fn wrong(place: (&Path, Option<usize>), text: impl Into<String>) -> Self {
        Self::new(Weight::Wrong, place, text.into())
    }

    fn note(place: (&Path, Option<usize>), text: impl Into<String>) -> Self {
        Self::new(Weight::Note, place, text.into())
    }

    fn new(weight: Weight, (path, line): (&Path, Option<usize>), text: String) -> Self {
        Self {
            weight,
            path: path.to_owned(),
            line,
            text,
        }
    }

    pub fn is_wrong(&self) -> bool {
        self.weight == Weight::Wrong
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let note = if self.is_wrong() { "" } else { "note: " };
        let line = self.line.map_or(String::new(), |line| format!(":{line}"));
        let text = format!("{note}{}{line}: {}", self.path.display(), self.text);
        f.write_str(&one_line(&text))
    }
}

/// What was found in a folder of shaders.
pub struct Checked {
    /// What is wrong first; then by file and line.
    pub findings: Vec<Finding>,
    /// Whether everything compiles and links, so that there is a picture.
    pub draws: bool,
}

/// Holds the shaders of a folder against a lab's: each of the programs that the lab starts with, with the student's files in
/// the place of the lab's.
///
/// An error is a folder that cannot be read, or that has none of the lab's files; or a lab that does not start.
pub fn check(context: &Headless, handout: &'static Handout, folder: &Path) -> Result<Checked> {
    let gl = &context.gl;
    let (started, made) = gl::programs_made(|| (handout.start)(gl, (handout.scene)()?, None));
    let mut lab = started?;
    // What a frame sets stays in the programs, and tells which sampler is on which texture unit.
    lab.render(gl, Show::Picture)?;

    let files = files::read(handout, folder, &made)?;
    let mut findings = files.findings(handout);
    for file in &files.students {
        age::check(file, &mut findings);
    }
    let mut draws = true;
    for made in &made {
        if !made.files.iter().any(|file| files.has(&file.name)) {
            continue;
        }
        let subject = subject::Subject::new(gl, handout, made, &files);
        match subject.linked() {
            Ok(linked) => {
                inputs::check(&subject, &mut findings);
                uniforms::check(&subject, linked, &mut findings);
                stages::check(&subject, Some(linked), &mut findings);
            }
            Err(log) => {
                draws = false;
                driver::check(gl, &subject, log, &mut findings);
            }
        }
    }
    findings.sort();
    // A file can take part in several programs.
    findings.dedup();
    Ok(Checked { findings, draws })
}

/// ` (did you mean "x"?)`, or the names that are left.
fn hint<'a>(
    found: &str,
    known: &[&'a str],
    otherwise: impl FnOnce(&[&'a str]) -> String,
) -> String {
    let hint = crate::error::did_you_mean(found, known.iter().copied());
    match hint.is_empty() {
        true => otherwise(known),
        false => hint,
    }
}

/// What a folder that holds none of a lab's shaders is told.
fn nothing_here(handout: &Handout, folder: &Path, hints: &[String], names: &[&str]) -> Error {
    let hints = match hints {
        [] => String::new(),
        hints => format!(" ({})", hints.join("; ")),
    };
    Error::input(
        folder,
        None,
        format!(
            "none of {}'s shaders is here{hints}, expected one or more of {}",
            handout.name,
            names.join(", ")
        ),
    )
}
