//! The record of every GL call that goes through a glow context, and its text in C.
//!
//! A handout shows its algorithm as a sequence of C calls. So that a lab can be laid beside it, [`recorded`] puts a
//! shim between glow and the driver for each function of [`FUNCTIONS`]: the shim forwards the call, then writes down
//! what was asked and what came back. Functions outside that list look to glow as if the driver did not have them, so
//! a call that the record would miss stops the program instead of passing unseen.
//!
//! ```no_run
//! # fn with_loader(load: impl FnMut(&std::ffi::CStr) -> *const std::ffi::c_void) {
//! use shadowlab::gl::trace;
//!
//! let gl = trace::recorded(load);
//! trace::pass("first pass: drawing the shadow map");
//! // … draw with `gl` …
//! trace::name_object(trace::ObjectKind::Framebuffer, 1, "frame_buffer");
//! println!("{}", trace::to_c(&trace::take()));
//! # }
//! ```
//!
//! Safety, for the whole module: the loader that is given to [`recorded`] returns pointers of a GL context that is
//! current, of the driver that every recorded context of the program uses; each shim has the parameters that the GL
//! specification gives its function; and the pointers that a caller passes reach as far as GL itself would read.
#![allow(unsafe_code)]

use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::{CStr, c_void};

mod args;
mod functions;
mod memory;
mod names;
mod text;
mod watch;

pub use args::{Arg, Names, Object, ObjectKind};
pub use functions::{FORWARDED, FUNCTIONS};
pub use memory::{Bytes, Memory};
pub use text::to_c;
pub use watch::{in_calls, so_far, unrecorded};

/// One entry of the record.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// The heading of the calls that follow it.
    Pass(String),
    Call(Call),
}

/// One GL call: what was asked and what came back.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// The C name, `glBindFramebuffer`.
    pub name: &'static str,
    pub args: Vec<Arg>,
    /// What the function returned; `None` for a `void` function.
    pub result: Option<Arg>,
}

thread_local! {
    /// `None` until this thread has a recorded context.
    static RECORDER: RefCell<Option<Recorder>> = const { RefCell::new(None) };
}

/// A glow context whose calls are recorded, on the thread that makes them.
///
/// `loader` is that of a context that is current on this thread. The record begins here, empty: glow's own questions
/// at start are not part of it, and neither is anything that an earlier context of this thread recorded. A thread
/// records one context at a time, because object numbers say nothing about which context they belong to.
pub fn recorded(mut loader: impl FnMut(&CStr) -> *const c_void) -> glow::Context {
    let shims = |name: &CStr| {
        let name = functions::core_name(name);
        functions::shim(name, loader(name))
    };
    let gl = unsafe { glow::Context::from_loader_function_cstr(shims) };
    RECORDER.set(Some(Recorder::default()));
    watch::start();
    gl
}

/// A glow context whose calls are edited, where there are edits of calls, and not recorded.
pub fn edited(mut loader: impl FnMut(&CStr) -> *const c_void) -> glow::Context {
    if !super::edits::are_of_calls() {
        return unsafe { glow::Context::from_loader_function_cstr(loader) };
    }
    let gl = recorded(&mut loader);
    watch::stop();
    gl
}

/// Hands over what was recorded on this thread and goes on recording; the names of objects stay known.
pub fn take() -> Vec<Event> {
    with_recorder(|recorder| std::mem::take(&mut recorder.events)).unwrap_or_default()
}

/// Writes a heading over the calls that follow. Does nothing while nothing is being recorded.
pub fn pass(name: &str) {
    if !watch::records() {
        return;
    }
    with_recorder(|recorder| recorder.events.push(Event::Pass(name.to_owned())));
}

/// Says what the lab calls an object; the record then says so in every line, the earlier ones too.
/// Does nothing while nothing is being recorded.
pub fn name_object(kind: ObjectKind, id: u32, name: &str) {
    with_recorder(|recorder| recorder.name_object(kind, id, name));
}

fn with_recorder<T>(use_it: impl FnOnce(&mut Recorder) -> T) -> Option<T> {
    RECORDER.with_borrow_mut(|recorder| recorder.as_mut().map(use_it))
}

/// What the shims call. A context that was sent to another thread is recorded there.
fn record(call: Call) {
    // At the end of a thread the record may be gone before the context is: then nobody can ask for it any more.
    let _ = RECORDER.try_with(|recorder| {
        recorder.borrow_mut().get_or_insert_default().record(call);
    });
}

/// The record, with what it must remember of earlier calls to say what the later ones mean.
#[derive(Default)]
struct Recorder {
    events: Vec<Event>,
    names: HashMap<(ObjectKind, u32), String>,
    /// The names of uniform locations, by program and location.
    uniforms: HashMap<(u32, i32), String>,
    /// The program in use.
    program: u32,
}

impl Recorder {
    fn record(&mut self, mut call: Call) {
        // GL gives the numbers of deleted objects to new ones: a new object has no name yet.
        if call.makes_objects() {
            for object in call.objects_mut() {
                self.names.remove(&(object.kind, object.id));
            }
        }
        // Keep what a later glUniform needs: it says a location, and nothing of program or name.
        match (call.name, call.args.as_slice(), &call.result) {
            ("glUseProgram", [Arg::Object(program)], _) => self.program = program.id,
            ("glLinkProgram", [Arg::Object(linked)], _) => {
                self.uniforms
                    .retain(|(program, _), _| *program != linked.id);
            }
            (
                "glGetUniformLocation",
                [Arg::Object(program), Arg::Str(name)],
                Some(Arg::Location { index, .. }),
            ) => {
                self.uniforms.insert((program.id, *index), name.clone());
            }
            _ => {}
        }
        for object in call.objects_mut() {
            object.name = self.names.get(&(object.kind, object.id)).cloned();
        }
        for arg in &mut call.args {
            if let Arg::Location { index, name } = arg {
                *name = self.uniforms.get(&(self.program, *index)).cloned();
            }
        }
        self.events.push(Event::Call(call));
    }

    fn name_object(&mut self, kind: ObjectKind, id: u32, name: &str) {
        // A name in C has no spaces.
        let name = name.replace(|c: char| !c.is_alphanumeric(), "_");
        self.names.insert((kind, id), name.clone());
        // Back through the record, up to the call that made the object.
        for event in self.events.iter_mut().rev() {
            let Event::Call(call) = event else { continue };
            let makes_objects = call.makes_objects();
            let mut made_here = false;
            for object in call.objects_mut() {
                if object.kind == kind && object.id == id {
                    object.name = Some(name.clone());
                    made_here = makes_objects;
                }
            }
            if made_here {
                break;
            }
        }
    }
}

impl Call {
    /// Whether the objects of this call are new.
    fn makes_objects(&self) -> bool {
        self.name.starts_with("glGen") || self.name.starts_with("glCreate")
    }

    fn objects_mut(&mut self) -> impl Iterator<Item = &mut Object> {
        let args = self.args.iter_mut().chain(&mut self.result);
        args.flat_map(|arg| match arg {
            Arg::Object(object) => std::slice::from_mut(object),
            Arg::Objects(objects) => objects.as_mut_slice(),
            _ => &mut [],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(id: u32) -> Object {
        Object::new(ObjectKind::Texture, id)
    }

    fn generated(id: u32) -> Call {
        Call {
            name: "glGenTextures",
            args: vec![Arg::Int(1), Arg::Objects(vec![texture(id)])],
            result: None,
        }
    }

    fn deleted(id: u32) -> Call {
        Call {
            name: "glDeleteTextures",
            ..generated(id)
        }
    }

    fn name_of(event: &Event) -> Option<&str> {
        match event {
            Event::Call(call) => match call.args.last() {
                Some(Arg::Objects(objects)) => objects[0].name.as_deref(),
                _ => None,
            },
            Event::Pass(_) => None,
        }
    }

    #[test]
    fn a_name_reaches_back_to_the_call_that_made_the_object_and_no_further() {
        let mut recorder = Recorder::default();
        for call in [
            generated(1),
            deleted(1),
            generated(1),
            generated(2),
            deleted(1),
        ] {
            recorder.record(call);
        }
        recorder.name_object(ObjectKind::Texture, 1, "shadow_map");
        recorder.record(deleted(1));
        recorder.record(generated(1));
        let names: Vec<_> = recorder.events.iter().map(name_of).collect();
        let named = Some("shadow_map");
        assert_eq!(names, [None, None, named, None, named, named, None]);
    }

    #[test]
    fn a_name_belongs_to_one_kind_of_object() {
        let mut recorder = Recorder::default();
        recorder.record(generated(1));
        recorder.name_object(ObjectKind::Framebuffer, 1, "frame_buffer");
        assert_eq!(name_of(&recorder.events[0]), None);
    }

    #[test]
    fn a_uniform_has_the_name_that_its_location_has_in_the_program_in_use() {
        let program = |id| Arg::Object(Object::new(ObjectKind::Program, id));
        let location = |index| Arg::Location { index, name: None };
        let mut recorder = Recorder::default();
        for (id, name) in [(1, "shadow_sampler"), (2, "model_matrix")] {
            recorder.record(Call {
                name: "glGetUniformLocation",
                args: vec![program(id), Arg::Str(name.to_owned())],
                result: Some(location(0)),
            });
        }
        for id in [1, 2, 3] {
            recorder.record(Call {
                name: "glUseProgram",
                args: vec![program(id)],
                result: None,
            });
            recorder.record(Call {
                name: "glUniform1i",
                args: vec![location(0), Arg::Int(1)],
                result: None,
            });
        }
        let text = to_c(&recorder.events);
        let uniforms: Vec<_> = text.lines().filter(|l| l.contains("glUniform1i")).collect();
        assert_eq!(
            uniforms,
            [
                "glUniform1i(0, 1);  // shadow_sampler",
                "glUniform1i(0, 1);  // model_matrix",
                "glUniform1i(0, 1);"
            ]
        );
    }

    #[test]
    fn nothing_is_recorded_before_there_is_a_context() {
        std::thread::spawn(|| {
            pass("first pass");
            name_object(ObjectKind::Texture, 1, "shadow_map");
            assert_eq!(take(), []);
        })
        .join()
        .unwrap();
    }
}
