//! A program of the lab, with the student's files in it, beside the lab's own.

use std::path::Path;

use super::files::Files;
use crate::gl::inspect::{self, Interface, Stage};
use crate::gl::{self, Made};
use crate::glsl::{Scan, Storage};
use crate::labs::Handout;

pub struct Subject<'t> {
    pub handout: &'static Handout,
    pub parts: Vec<Part<'t>>,
    /// What the lab sets, or may set.
    pub set: &'t [&'static str],
    /// The lab's own program: its files, and what of it has an effect.
    pub labs_parts: Vec<Part<'t>>,
    pub labs: Interface,
    linked: std::result::Result<Interface, String>,
}

/// A shader file of it.
pub struct Part<'t> {
    pub stage: Stage,
    pub name: &'t str,
    pub text: &'t str,
    /// Of a student's file.
    pub path: Option<&'t Path>,
    pub scan: Scan<'t>,
}

/// Where something stands, for a finding.
pub type Place<'t> = (&'t Path, Option<usize>);

impl<'t> Subject<'t> {
    pub fn new(
        gl: &gl::Context,
        handout: &'static Handout,
        made: &'t Made,
        files: &'t Files,
    ) -> Self {
        let part = |stage, name, text, path| Part {
            stage,
            name,
            text,
            path,
            scan: Scan::new(text),
        };
        let labs_files = made.files.iter();
        let labs_parts: Vec<_> = labs_files
            .map(|file| part(file.stage, &file.name, &file.text, None))
            .collect();
        let mut parts: Vec<Part> = made
            .files
            .iter()
            .map(|file| match files.find(&file.name) {
                Some(own) => part(file.stage, &file.name, &own.text, Some(own.path.as_path())),
                None => part(file.stage, &file.name, &file.text, None),
            })
            .collect();
        let stands_for_both: Vec<bool> = parts
            .iter()
            .map(|labs| {
                let mut others = parts.iter().filter(|other| other.path.is_some());
                labs.path.is_none()
                    && others.any(|own| {
                        own.stage == labs.stage && gl::stands_for_both(&own.scan, &labs.scan)
                    })
            })
            .collect();
        let mut stands_for_both = stands_for_both.into_iter();
        parts.retain(|_| !stands_for_both.next().expect("as many as parts"));

        let texts: Vec<_> = parts.iter().map(|part| (part.stage, part.text)).collect();
        Self {
            handout,
            linked: inspect::try_link(gl, &texts),
            parts,
            set: &made.uniforms,
            labs_parts,
            labs: inspect::interface(gl, made.handle),
        }
    }

    /// What of it has an effect, or the driver's log.
    pub fn linked(&self) -> std::result::Result<&Interface, &str> {
        self.linked.as_ref().map_err(String::as_str)
    }

    pub fn of_stage(&self, stage: Stage) -> impl Iterator<Item = &Part<'t>> {
        self.parts.iter().filter(move |part| part.stage == stage)
    }

    /// The student's files.
    pub fn students(&self) -> impl Iterator<Item = &Part<'t>> {
        self.parts.iter().filter(|part| part.path.is_some())
    }

    /// The line in which the student declares it; else, of the student's files, the last, which is the fragment shader
    /// where there is one.
    pub fn place_of(&self, storage: Storage, name: &str) -> Place<'t> {
        let mut own = self.students();
        let declared = own.find_map(|part| Some((part.path?, part.scan.find(storage, name)?.line)));
        match declared {
            Some((path, line)) => (path, Some(line)),
            None => {
                let last = self.students().filter_map(|part| part.path).last();
                (last.expect("a student's file takes part"), None)
            }
        }
    }

    /// Whether any file declares it.
    pub fn declares(&self, storage: Storage, name: &str) -> bool {
        let mut parts = self.parts.iter();
        parts.any(|part| part.scan.find(storage, name).is_some())
    }
}
