//! Edits of what a lab does, made where its calls and shader files pass through: no lab contains a mistake, and yet each
//! mistake can be shown.
//!
//! They hold on the thread that sets them, in the time of the guard: for what starts, compiles and draws in it. Calls can
//! be edited in a recorded context alone (see [`super::trace`]).

use std::cell::{Cell, RefCell};

use super::Value;
use super::trace::Arg;

/// One way to do something otherwise.
#[derive(Clone, Copy, Debug, Default)]
pub struct Edits {
    pub shaders: &'static [ShaderEdit],
    pub uniforms: &'static [UniformEdit],
    pub calls: &'static [CallEdit],
}

/// In a shader file, one passage in place of another.
#[derive(Clone, Copy, Debug)]
pub struct ShaderEdit {
    pub file: &'static str,
    pub from: &'static str,
    pub to: &'static str,
}

/// Another value for a uniform, or none: then it is never set.
#[derive(Clone, Copy)]
pub struct UniformEdit {
    /// A part of the heading of the passes that it is about; all, where it is empty.
    pub pass: &'static str,
    pub name: &'static str,
    pub change: fn(Value) -> Option<Value>,
}

/// Something else in place of a call.
#[derive(Clone, Copy, Debug)]
pub struct CallEdit {
    /// A part of the heading of the passes that it is about; all, where it is empty.
    pub pass: &'static str,
    /// The name in C. No function that answers, and none that fills memory.
    pub call: &'static str,
    /// Which of its calls: those whose arguments have these values, by their place.
    pub with: &'static [(usize, i64)],
    pub make: Make,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Make {
    /// No call.
    Nothing,
    /// The call with other arguments, by their place.
    Instead(&'static [(usize, i64)]),
    /// The call, and then once more with other arguments.
    Also(&'static [(usize, i64)]),
}

impl std::fmt::Debug for UniformEdit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} in \"{}\"", self.name, self.pass)
    }
}

thread_local! {
    static EDITS: Cell<Edits> = const { Cell::new(Edits::NONE) };
    /// The headings of the passes that are open, the innermost last.
    static PASSES: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

impl Edits {
    const NONE: Self = Self {
        shaders: &[],
        uniforms: &[],
        calls: &[],
    };
}

/// While it lives, the edits hold.
#[must_use]
pub struct Edited {
    before: Edits,
}

/// Whether calls are edited: then a context needs the shims of [`super::trace`].
pub fn are_of_calls() -> bool {
    !EDITS.get().calls.is_empty()
}

pub fn set(edits: Edits) -> Edited {
    Edited {
        before: EDITS.replace(edits),
    }
}

impl Drop for Edited {
    fn drop(&mut self) {
        EDITS.set(self.before);
    }
}

pub(super) fn begin_pass(name: &str) {
    PASSES.with_borrow_mut(|passes| passes.push(name.to_owned()));
}

pub(super) fn end_pass() {
    PASSES.with_borrow_mut(|passes| passes.pop());
}

fn is_in(pass: &str) -> bool {
    pass.is_empty()
        || PASSES.with_borrow(|passes| passes.last().is_some_and(|open| open.contains(pass)))
}

/// The text of a shader file, edited.
pub(super) fn shader(file: &str, text: &str) -> Option<String> {
    let edits = EDITS.get().shaders.iter().filter(|edit| edit.file == file);
    edits.fold(None, |edited, edit| {
        let text = edited.as_deref().unwrap_or(text);
        assert!(text.contains(edit.from), "{file} has no \"{}\"", edit.from);
        Some(text.replace(edit.from, edit.to))
    })
}

/// What a uniform is set to; None where it is not set.
pub(super) fn uniform(name: &str, value: Value) -> Option<Value> {
    let edits = EDITS.get().uniforms.iter();
    let mut edits = edits.filter(|edit| edit.name == name && is_in(edit.pass));
    edits.try_fold(value, |value, edit| (edit.change)(value))
}

/// What is to be made of a call, if anything else than the call.
pub(super) fn call(name: &str, args: impl FnOnce() -> Vec<Arg>) -> Option<Make> {
    let of_name = |edit: &&CallEdit| edit.call == name && is_in(edit.pass);
    let mut edits = EDITS.get().calls.iter().filter(of_name).peekable();
    edits.peek()?;
    let args = args();
    let is_meant = |edit: &&CallEdit| {
        let mut with = edit.with.iter();
        with.all(|(place, value)| number(&args[*place]) == Some(*value))
    };
    edits.find(is_meant).map(|edit| edit.make)
}

fn number(arg: &Arg) -> Option<i64> {
    match arg {
        Arg::Int(value) => Some(*value),
        Arg::Bool(value) => Some((*value).into()),
        Arg::Enum(_, value) | Arg::Buffers(value) | Arg::Mask(value) => Some((*value).into()),
        Arg::Object(object) => Some(object.id.into()),
        _ => None,
    }
}

/// The new value of an argument.
pub(super) fn argument(changes: &[(usize, i64)], place: usize) -> Option<i64> {
    let mut changes = changes.iter();
    changes
        .find(|(changed, _)| *changed == place)
        .map(|(_, value)| *value)
}
