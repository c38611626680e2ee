//! What the courses gave their students: shader compilation, meshes, textures, readback. And what they did not: the call
//! trace, and what the viewer draws over a picture.
//!
//! SAFETY of this module and the ones below it: every function takes a context that is current on the calling
//! thread, and every pointer that GL gets comes from a slice that outlives the call.
#![allow(unsafe_code)]

mod check;
pub mod edits;
mod heap;
pub mod inspect;
pub mod mesh;
mod overlay;
mod read;
mod shader;
mod texture;
mod timer;
pub mod trace;
mod uniform;

pub use glow::Context;
use glow::HasContext;

pub use check::{check_errors, check_framebuffer};
pub use heap::keep_heap;
pub use mesh::Mesh;
pub use overlay::{Area, Overlay};
pub use read::{
    read_depth, read_depth_texels, read_depths, read_float_in_bytes, read_float_of_one_vertex,
    read_grey, read_rgb, read_stencil,
};
pub use shader::{Made, MadeOf, Program, Shaders, programs_made, stands_for_both};
pub use texture::{
    Textures, distinct, flat_depths, largest_texture, levels, solid_texture, texture,
};
pub use timer::{PassTime, finish, time_passes};
pub use uniform::Value;

/// Names the calls from here until the returned guard is dropped: a heading in the trace, a timer in the report, and a
/// debug group where the driver has them (so that RenderDoc and apitrace show the handout's passes too).
#[must_use]
pub fn pass<'gl>(gl: &'gl glow::Context, name: &str) -> Pass<'gl> {
    trace::pass(name);
    edits::begin_pass(name);
    if gl.supports_debug() {
        unsafe { gl.push_debug_group(glow::DEBUG_SOURCE_APPLICATION, 0, name) };
    }
    Pass {
        gl,
        timed: timer::begin(gl, name),
    }
}

pub struct Pass<'gl> {
    gl: &'gl glow::Context,
    timed: Option<timer::Timed>,
}

impl Drop for Pass<'_> {
    fn drop(&mut self) {
        edits::end_pass();
        if let Some(timed) = self.timed.take() {
            timer::end(self.gl, timed);
        }
        if self.gl.supports_debug() {
            unsafe { self.gl.pop_debug_group() };
        }
    }
}
