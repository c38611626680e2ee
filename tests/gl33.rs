//! The labs are programs of OpenGL 3.3 core. Drivers give a newer context to whoever asks for 3.3, so a newer call
//! would work unnoticed; but a recorded context has only the functions of the traced list, and these are all of 3.3.

use std::collections::HashSet;

use shadowlab::gl::trace::{FORWARDED, FUNCTIONS};

/// Every function of OpenGL 1.0 to 3.3, core profile, one a line.
const CORE: &str = include_str!("gl33.txt");

fn core() -> HashSet<&'static str> {
    CORE.lines().collect()
}

#[test]
fn the_list_is_that_of_3_3() {
    assert_eq!(CORE.lines().count(), core().len(), "a name stands twice");
    // One function of 1.0, one of 3.2 and two of 3.3.
    for name in [
        "glCullFace",
        "glGenSamplers",
        "glQueryCounter",
        "glDrawElementsBaseVertex",
    ] {
        assert!(core().contains(name), "{name} is missing");
    }
}

#[test]
fn every_traced_function_is_in_gl_3_3() {
    let newer: Vec<_> = FUNCTIONS
        .iter()
        .filter(|name| !core().contains(*name))
        .collect();
    assert!(newer.is_empty(), "not in OpenGL 3.3: {newer:?}");
}

/// The control: what came later is told apart from what was there.
#[test]
fn newer_functions_are_not_in_the_list() {
    for name in [
        "glClipControl",
        "glObjectLabel",
        "glTexStorage2D",
        "glClearDepthf",
    ] {
        assert!(!core().contains(name), "{name} is newer than 3.3");
    }
    // Debug output is 4.3, but for a function of 1.1 that it took up again.
    for name in FORWARDED.iter().filter(|name| **name != "glGetPointerv") {
        assert!(!core().contains(name), "{name} need not be forwarded");
    }
}

#[test]
fn a_function_is_traced_once() {
    let names: HashSet<_> = FUNCTIONS.iter().collect();
    assert_eq!(names.len(), FUNCTIONS.len());
}
