//! Five university handouts on real-time shadows, each as one lab that reads like its handout.
//!
//! | room | what lives there |
//! |---|---|
//! | [`scene`] | plain data in f64: meshes, objects, camera, light |
//! | [`gl`] | what the courses gave their students: shaders, meshes, textures, readback, the call trace |
//! | [`shadow_tests`] | the shadow tests that no handout has |
//! | [`labs`] | what the students write: one module per handout, and the seam that all labs share |
//! | [`ground_truth`] | what is in shadow in truth: rays in f64, which know no lab |
//! | [`measure`] | a visibility picture against the truth, in figures |
//! | [`headless`] | an OpenGL 3.3 context on an EGL pbuffer, with no display |
//! | [`window`] | the desktop viewer |
//! | [`picture`] | pictures and depth maps, written to files |
//! | [`progress`] | how far a long task has come |
//! | [`error`] | the one error type |
//!
//! Imports go downward only: `headless`, `window` and the command line use `labs`, `labs` use
//! `shadow_tests` and `gl`, `gl` uses `scene`.
#![deny(unsafe_code)]

pub mod error;
pub mod gl;
pub mod ground_truth;
pub mod headless;
pub mod labs;
pub mod measure;
pub mod picture;
pub mod progress;
pub mod scene;
pub mod shadow_tests;
pub mod window;

pub use error::{Error, Result};
