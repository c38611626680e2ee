//! The shadow tests that no handout has, each with its GLSL and its reason. A lab links one with its own lighting, in
//! place of the handout's test, where its setting `shadow_test` asks for it.
//!
//! | `shadow_test` | |
//! |---|---|
//! | `handout` | the handout's own, in the lab |
//! | `offset` | [`offset`]: one depth map as good as it can be without a constant that depends on the scene |
//! | `exact` | [`exact`]: every ray to the light against the triangles that it can meet |

pub mod exact;
pub mod offset;
mod placed;
mod polygon;
mod space;
mod topology;

pub use placed::Placed;
pub use space::{LightSpace, Rays};
pub use topology::Topology;

/// The tests as GLSL functions: fragment shader files without a `main`, for a lab's [`crate::gl::Shaders`].
pub const SHADERS: &[(&str, &str)] = &[
    (
        exact::SHADER,
        include_str!("../../glsl/shadow_tests/exact.frag"),
    ),
    (
        offset::SHADER,
        include_str!("../../glsl/shadow_tests/offset.frag"),
    ),
    (
        "shadow_tests/offset_one.frag",
        include_str!("../../glsl/shadow_tests/offset_one.frag"),
    ),
    (
        "shadow_tests/offset_five.frag",
        include_str!("../../glsl/shadow_tests/offset_five.frag"),
    ),
    (
        "shadow_tests/offset_nine.frag",
        include_str!("../../glsl/shadow_tests/offset_nine.frag"),
    ),
];
