//! The exact test: a light buffer (Haines and Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", 1986).
//!
//! A grid of cells lies over the light's view. Each cell lists the triangles that its rays can meet; a fragment looks
//! its cell up and tests its own ray to the light against them. There is no map, no bias and no resolution.
//!
//! | step | here |
//! |---|---|
//! | which vertices are one, which edges two triangles share; once for each mesh | `../topology.rs` |
//! | where the light is, and along which axes it looks | `../space.rs` |
//! | what a ray is tested against: three planes through the edges, and the triangle's own | `caster.rs` |
//! | which triangles can cast onto something | `builder.rs` |
//! | how cells lie over the light's view, and where in it a triangle is seen | `layout.rs` |
//! | which cells each of them meets, and which cells are lit or dark as a whole | `grid.rs`, `band.rs`, `../polygon.rs` |
//! | what a ray passes by together, where a list is long | `slab.rs` |
//! | the planes as the shader goes through them | `node.rs` |
//! | the buffer textures and the uniforms | `gpu.rs` |
//! | the test | `glsl/shadow_tests/exact.frag` |
//!
//! Everything is composed in f64 relative to the light, where the light is the origin or, for parallel rays, the scene's
//! centre is; lengths are in units of the scene's size. It is rounded to f32 once, when it is stored. So it is the same
//! wherever the scene lies and however large it is.
//!
//! A point is on a triangle that may cast. Which one that is, is not asked: gl_PrimitiveID would tell, but where a shader
//! uses it, llvmpipe takes meshes apart triangle by triangle, which with 200,000 of them is a seventh of a frame. The
//! position's derivatives tell the triangle's plane, and that is enough: what faces away from the light is in its own
//! shadow (however its normals are smoothed: without that the terminator would be lit in patches), and a caster that
//! faces the light casts nothing onto its own plane.
//!
//! What it cannot see: a camera inside a closed solid, which the light is outside of, sees what else is in there lit.
//! Of a closed solid only the far side casts, and there it has none behind it. Nor what is nearer to a shadow's edge, as
//! the light sees it, than f32 tells places apart: 2⁻²⁴ of the scene's size. Where the light grazes the surface, the truth
//! may call such a point certain: moved by 1/256 pixel along the surface it hardly leaves its ray to the light. Of the
//! bumpy sphere of 200,000 triangles, 4 of 480,000 pixels are wrong for that reason.

mod band;
mod builder;
mod caster;
mod gpu;
mod grid;
mod layout;
mod node;
mod slab;

pub use band::Cell;
pub use builder::{Builder, LightBuffer};
pub use gpu::{Binding, ExactTest, LIGHT_BUFFER};
pub use layout::Layout;
pub use node::{DARK, FACES_LIGHT, Node, SLAB};

/// The file of [`super::SHADERS`].
pub const SHADER: &str = "shadow_tests/exact.frag";
