//! Five university handouts on real-time shadows, each as one lab that reads like its handout.
//!
//! | room | what lives there |
//! |---|---|
//! | [`scene`] | plain data in f64: meshes, objects, camera, light |
//! | [`glsl`] | what a shader's text declares, and in which lines |
//! | [`gl`] | what the courses gave their students: shaders, meshes, textures, readback, the call trace |
//! | [`shadow_tests`] | the shadow tests that no handout has |
//! | [`labs`] | what the students write: one module per handout, and the seam that all labs share |
//! | [`ground_truth`] | what is in shadow in truth: rays in f64, which know no lab |
//! | [`measure`] | a visibility picture against the truth, in figures |
//! | [`compare`] | a student's picture against a reference: what is forgiven, what differs, where its shadows are |
//! | [`mistakes`] | the classic mistakes, as edits of shaders, uniforms and calls |
//! | [`calls`] | a dump of a program's GL calls, held against a handout |
//! | [`diagnosis`] | which mistake explains a picture |
//! | [`own_shaders`] | a student's shaders in a lab's place: what is wrong with them, where their shadows are |
//! | [`hard`] | scenes on which shadow tests are known to break, and what must come of each test |
//! | [`headless`] | an OpenGL 3.3 context on an EGL pbuffer, with no display |
//! | [`report`] | speed against error: settings held against each other |
//! | [`window`] | the desktop viewer |
//! | [`picture`] | pictures and depth maps, written to files |
//! | [`progress`] | how far a long task has come |
//! | [`error`] | the one error type |
//!
//! Imports go downward only: `headless`, `window`, `report` and the command line use `labs`, `labs` use
//! `shadow_tests` and `gl`, `gl` uses `scene`.
#![deny(unsafe_code)]

pub mod calls;
pub mod compare;
pub mod diagnosis;
pub mod error;
pub mod gl;
pub mod glsl;
pub mod ground_truth;
pub mod hard;
pub mod headless;
pub mod labs;
pub mod measure;
pub mod mistakes;
pub mod own_shaders;
pub mod picture;
pub mod progress;
pub mod report;
pub mod scene;
pub mod shadow_tests;
pub mod window;

pub use error::{Error, Result};
