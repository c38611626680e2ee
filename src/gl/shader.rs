//! Shader files to linked programs; a failure names file, line and the driver's message.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glow::HasContext;

use super::edits;
use super::inspect::{self, Stage};
use super::mesh::ATTRIBUTES;
use super::uniform::{Uniform, Value};
use crate::glsl::Scan;
use crate::scene::reading;
use crate::{Error, Result};

thread_local! {
    static MADE: RefCell<Option<Vec<Made>>> = const { RefCell::new(None) };
}

/// A program, as a lab has made it.
pub struct Made {
    pub handle: glow::Program,
    /// The vertex shader first.
    pub files: Vec<MadeOf>,
    /// What the lab sets, or may set.
    pub uniforms: Vec<&'static str>,
}

/// A shader file of a program.
pub struct MadeOf {
    pub stage: Stage,
    /// As the lab calls it.
    pub name: String,
    pub text: String,
}

/// Every program that is made meanwhile, on this thread.
pub fn programs_made<T>(make: impl FnOnce() -> T) -> (T, Vec<Made>) {
    MADE.set(Some(Vec::new()));
    let made = make();
    (made, MADE.take().unwrap_or_default())
}

/// Whether a student's file has functions of the lab's own file in it, and so stands for both: a handout shows its shader
/// as one file, and the lab may have its shadow test in another.
pub fn stands_for_both(students: &Scan, labs: &Scan) -> bool {
    let mut functions = labs.functions.iter();
    functions.any(|lab| students.functions.iter().any(|own| own.name == lab.name))
}

/// A lab's shader files: those in the binary, or a student's own of the same names in their place. A file that several
/// labs share has its folder in its name.
pub struct Shaders {
    lab: &'static str,
    builtin: &'static [(&'static str, &'static str)],
    students: Option<PathBuf>,
}

impl Shaders {
    /// `builtin` holds each file's name and text; `students` is the folder given with `--glsl`.
    pub fn new(
        lab: &'static str,
        builtin: &'static [(&'static str, &'static str)],
        students: Option<&Path>,
    ) -> Result<Self> {
        if let Some(folder) = students {
            let names: Vec<_> = builtin.iter().map(|(name, _)| *name).collect();
            std::fs::read_dir(folder).map_err(|cause| Error::reading(folder, cause))?;
            if !names.iter().any(|name| is_there(&folder.join(name))) {
                return Err(Error::input(
                    folder,
                    None,
                    format!(
                        "none of {lab}'s shaders is here, expected one or more of {}",
                        names.join(", ")
                    ),
                ));
            }
        }
        Ok(Self {
            lab,
            builtin,
            students: students.map(Path::to_owned),
        })
    }

    /// Whether the student has a file of that name.
    pub fn has_own(&self, name: &str) -> bool {
        let students = self.students.as_ref();
        students.is_some_and(|folder| is_there(&folder.join(name)))
    }

    /// The text of a shader, and the path that a message about it names.
    fn read(&self, name: &str) -> Result<Source> {
        if let Some(path) = self.students.as_ref().map(|folder| folder.join(name))
            && is_there(&path)
        {
            let text = reading::read_text(&path, reading::TEXT_LIMIT)?;
            return Ok(Source {
                name: name.to_owned(),
                path,
                text: Cow::Owned(text),
                students: true,
                edited: false,
            });
        }
        let (name, text) = self
            .builtin
            .iter()
            .find(|(known, _)| *known == name)
            .expect("a lab asks for its own shaders only");
        let edited = edits::shader(name, text);
        Ok(Source {
            name: (*name).to_owned(),
            path: match name.contains('/') {
                true => Path::new("glsl").join(name),
                false => Path::new("glsl").join(self.lab).join(name),
            },
            edited: edited.is_some(),
            text: edited.map_or(Cow::Borrowed(*text), Cow::Owned),
            students: false,
        })
    }
}

/// Also of a link that leads nowhere: it is there, and cannot be read.
fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

struct Source {
    name: String,
    path: PathBuf,
    text: Cow<'static, str>,
    students: bool,
    /// A mistake may leave a uniform without effect.
    edited: bool,
}

/// A linked program with its uniforms, whose locations are looked up once.
pub struct Program {
    pub handle: glow::Program,
    uniforms: HashMap<&'static str, Uniform>,
}

impl Program {
    /// Compiles and links two shader files and looks up `uniforms`.
    pub fn new(
        gl: &glow::Context,
        shaders: &Shaders,
        vertex: &str,
        fragment: &str,
        uniforms: &[&'static str],
    ) -> Result<Self> {
        Self::linked(gl, shaders, vertex, &[fragment], uniforms)
    }

    /// The same with several fragment shader files, one of which has `main`.
    ///
    /// A uniform that is not active in the linked program (misspelt, or without effect) is an error, except
    /// where a student's own file takes part: there it is said, and setting it does nothing.
    pub fn linked(
        gl: &glow::Context,
        shaders: &Shaders,
        vertex: &str,
        fragments: &[&str],
        uniforms: &[&'static str],
    ) -> Result<Self> {
        let mut sources = vec![(Stage::Vertex, shaders.read(vertex)?)];
        for fragment in fragments {
            sources.push((Stage::Fragment, shaders.read(fragment)?));
        }
        leave_out_what_is_there_twice(&mut sources);
        let paths = sources.iter().map(|(_, source)| source.path.display());
        let names: Vec<_> = paths.map(|path| path.to_string()).collect();
        let names = names.join(" with ");
        let students = sources.iter().any(|(_, source)| source.students);
        let edited = sources.iter().any(|(_, source)| source.edited);
        unsafe {
            let handle = gl.create_program().map_err(Error::gl)?;
            let refused = |error| {
                gl.delete_program(handle);
                error
            };
            for (stage, source) in &sources {
                let shader = compile(gl, *stage, source).map_err(refused)?;
                gl.attach_shader(handle, shader);
                gl.delete_shader(shader);
            }
            for (name, location) in ATTRIBUTES {
                gl.bind_attrib_location(handle, location, name);
            }
            gl.link_program(handle);
            if !gl.get_program_link_status(handle) {
                let log = gl.get_program_info_log(handle);
                let (_, message) = inspect::first_message(&log);
                return Err(refused(Error::gl(format!(
                    "{names}: does not link: {message}"
                ))));
            }
            let look_up = |name: &&'static str| (*name, Uniform::look_up(gl, handle, name));
            let looked_up: HashMap<_, _> = uniforms.iter().map(look_up).collect();
            let inactive = uniforms
                .iter()
                .filter(|name| !looked_up[**name].is_active());
            let inactive: Vec<_> = inactive.copied().collect();
            if !inactive.is_empty() && !students && !edited {
                return Err(refused(Error::gl(format!(
                    "{names}: no active uniform {}, expected it to be declared and used",
                    inactive.join(", ")
                ))));
            }
            // Who has the programs told looks for himself.
            let is_told = MADE.with_borrow(Option::is_some);
            if !inactive.is_empty() && students && !is_told {
                eprintln!(
                    "note: {names}: without effect, misspelt or unused: {}",
                    inactive.join(", ")
                );
            }
            MADE.with_borrow_mut(|made| {
                if let Some(made) = made {
                    made.push(Made {
                        handle,
                        files: sources.into_iter().map(MadeOf::new).collect(),
                        uniforms: uniforms.to_vec(),
                    });
                }
            });
            Ok(Self {
                handle,
                uniforms: looked_up,
            })
        }
    }

    pub fn delete(&self, gl: &glow::Context) {
        unsafe { gl.delete_program(self.handle) };
    }

    /// Sets a uniform of this program, which must be in use. A value that it has already is not sent again.
    pub fn set(&self, gl: &glow::Context, name: &str, value: impl Into<Value>) {
        if let Some(value) = edits::uniform(name, value.into()) {
            self.uniform(name).set(gl, value);
        }
    }

    fn uniform(&self, name: &str) -> &Uniform {
        let uniform = self.uniforms.get(name);
        uniform.unwrap_or_else(|| panic!("uniform {name} was not looked up"))
    }

    /// Takes a block of uniforms from the buffer that is bound at this number.
    pub fn bind_block(&self, gl: &glow::Context, name: &str, number: u32) {
        unsafe {
            if let Some(index) = gl.get_uniform_block_index(self.handle, name) {
                gl.uniform_block_binding(self.handle, index, number);
            }
        }
    }
}

impl MadeOf {
    fn new((stage, source): (Stage, Source)) -> Self {
        Self {
            stage,
            name: source.name,
            text: source.text.into_owned(),
        }
    }
}

/// The lab's own files whose functions a student's file has.
fn leave_out_what_is_there_twice(sources: &mut Vec<(Stage, Source)>) {
    let students = sources.iter().filter(|(_, source)| source.students);
    let students: Vec<_> = students
        .map(|(stage, source)| (*stage, source.text.clone()))
        .collect();
    let students: Vec<_> = students
        .iter()
        .map(|(stage, text)| (*stage, Scan::new(text)))
        .collect();
    sources.retain(|(stage, source)| {
        let scan = Scan::new(&source.text);
        let is_there =
            |(own_stage, own): &(Stage, Scan)| own_stage == stage && stands_for_both(own, &scan);
        source.students || !students.iter().any(is_there)
    });
}

fn compile(gl: &glow::Context, stage: Stage, source: &Source) -> Result<glow::Shader> {
    inspect::compile(gl, stage, &source.text).map_err(|log| {
        let (line, message) = inspect::first_message(&log);
        Error::input(&source.path, line, format!("does not compile: {message}"))
    })
}
