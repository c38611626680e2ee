//! "Vertex and fragment shaders": which files make which program, and what is set in it.

use super::offset_test::TAPS;
use crate::Result;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests::{self, exact, offset};

/// The shaders, which are the lesson's other half.
pub const SHADERS: &[(&str, &str)] = &[
    (
        "shadow.vert",
        include_str!("../../../glsl/cs541/shadow.vert"),
    ),
    (
        "shadow.frag",
        include_str!("../../../glsl/cs541/shadow.frag"),
    ),
    (
        "lighting.vert",
        include_str!("../../../glsl/cs541/lighting.vert"),
    ),
    (
        "lighting.frag",
        include_str!("../../../glsl/cs541/lighting.frag"),
    ),
    (
        "lighting_unshadowed.frag",
        include_str!("../../../glsl/cs541/lighting_unshadowed.frag"),
    ),
    (
        "visibility.frag",
        include_str!("../../../glsl/cs541/visibility.frag"),
    ),
    (
        "explain.frag",
        include_str!("../../../glsl/cs541/explain.frag"),
    ),
    (
        "lighting_lcs.vert",
        include_str!("../../../glsl/cs541/lighting_lcs.vert"),
    ),
    (
        "lighting_exact.frag",
        include_str!("../../../glsl/cs541/lighting_exact.frag"),
    ),
    (
        "visibility_exact.frag",
        include_str!("../../../glsl/cs541/visibility_exact.frag"),
    ),
    (
        "lighting_offset.frag",
        include_str!("../../../glsl/cs541/lighting_offset.frag"),
    ),
    (
        "visibility_offset.frag",
        include_str!("../../../glsl/cs541/visibility_offset.frag"),
    ),
    shadow_tests::SHADERS[0],
    shadow_tests::SHADERS[1],
    shadow_tests::SHADERS[2],
    ("unlit.vert", include_str!("../../../glsl/cs541/unlit.vert")),
    ("unlit.frag", include_str!("../../../glsl/cs541/unlit.frag")),
];

/// Uniforms that both passes and the sky have.
pub const MATRICES: [&str; 3] = ["persp_matrix", "view_matrix", "model_matrix"];
/// Uniforms of the shadow test.
pub const SHADOW_TEST: [&str; 6] = [
    "shadow_persp_matrix",
    "shadow_view_matrix",
    "shadow_sampler",
    "epsilon",
    "shadows",
    "beam",
];

/// Of those, what the beam alone asks for.
const BEAM: [&str; 3] = ["shadow_persp_matrix", "shadow_view_matrix", "beam"];

/// Uniforms of the two tests in the light's coordinate system.
const LCS_TEST: [&str; 2] = ["light_model_matrix", "beam"];
/// Uniforms of the lighting.
const LIGHTING: [&str; 9] = [
    "normal_matrix",
    "eye_position",
    "light_position",
    "ambient_color",
    "light_color",
    "diffuse_color",
    "specular_color",
    "shininess",
    "usampler",
];

/// The programs of the two passes, and of what is neither lit nor shadowed.
pub struct Programs {
    pub shadow: Program,
    pub lighting: Program,
    pub unlit: Program,
}

impl Programs {
    /// All of them or none: a lab never draws with half of its shaders.
    pub fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let shadow = shadow_program(gl, shaders)?;
        let lighting = lighting_program(gl, shaders).inspect_err(|_| shadow.delete(gl))?;
        let unlit = unlit_program(gl, shaders).inspect_err(|_| {
            shadow.delete(gl);
            lighting.delete(gl);
        })?;
        Ok(Self {
            shadow,
            lighting,
            unlit,
        })
    }

    pub fn delete(&self, gl: &glow::Context) {
        for program in [&self.shadow, &self.lighting, &self.unlit] {
            program.delete(gl);
        }
    }
}

fn shadow_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the shadow shader program");
    let program = Program::new(gl, shaders, "shadow.vert", "shadow.frag", &MATRICES)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "shadow_program",
    );
    Ok(program)
}

fn lighting_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting shader program");
    let uniforms = [&MATRICES[..], &SHADOW_TEST, &LIGHTING].concat();
    let program = Program::new(gl, shaders, "lighting.vert", "lighting.frag", &uniforms)?;
    name_object(ObjectKind::Program, program.handle.0.get(), "program");
    Ok(program)
}

/// The shadow test alone; no part of the handout, so it is made when it is first asked for.
pub fn visibility_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the visibility shader program");
    let uniforms = [&MATRICES[..], &SHADOW_TEST].concat();
    let program = Program::new(gl, shaders, "lighting.vert", "visibility.frag", &uniforms)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "visibility_program",
    );
    Ok(program)
}

/// The second pass without shadows; made when it is first asked for.
pub fn unshadowed_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting program without shadows");
    let uniforms = [&MATRICES[..], &BEAM, &LIGHTING].concat();
    let fragment = "lighting_unshadowed.frag";
    let program = Program::new(gl, shaders, "lighting.vert", fragment, &uniforms)?;
    name_object(
        ObjectKind::Program,
        program.handle.0.get(),
        "unshadowed_program",
    );
    Ok(program)
}

/// The second pass with the exact shadow test.
pub fn exact_lighting_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting program with the exact test");
    exact_program(gl, shaders, "lighting_exact.frag", &LIGHTING)
}

/// The exact shadow test alone.
pub fn exact_visibility_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the visibility program with the exact test");
    exact_program(gl, shaders, "visibility_exact.frag", &[])
}

fn exact_program(
    gl: &glow::Context,
    shaders: &Shaders,
    fragment: &str,
    others: &[&'static str],
) -> Result<Program> {
    let fragments = [fragment, exact::SHADER];
    let uniforms = [&MATRICES[..], &LCS_TEST, &exact::LIGHT_BUFFER, others];
    let uniforms = uniforms.concat();
    Program::linked(gl, shaders, "lighting_lcs.vert", &fragments, &uniforms)
}

/// The second pass with the offset shadow test.
pub fn offset_lighting_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the lighting program with the offset test");
    offset_program(gl, shaders, "lighting_offset.frag", &LIGHTING)
}

/// The offset shadow test alone.
pub fn offset_visibility_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let _pass = gl::pass(gl, "set-up: the visibility program with the offset test");
    offset_program(gl, shaders, "visibility_offset.frag", &[])
}

fn offset_program(
    gl: &glow::Context,
    shaders: &Shaders,
    fragment: &str,
    others: &[&'static str],
) -> Result<Program> {
    let fragments = [fragment, offset::SHADER, TAPS.shader()];
    let uniforms = [&MATRICES[..], &LCS_TEST, &offset::FITTED_MAP, others].concat();
    Program::linked(gl, shaders, "lighting_lcs.vert", &fragments, &uniforms)
}

fn unlit_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let uniforms = [&MATRICES[..], &["diffuse_color", "usampler"]].concat();
    let program = Program::new(gl, shaders, "unlit.vert", "unlit.frag", &uniforms)?;
    name_object(ObjectKind::Program, program.handle.0.get(), "sky_program");
    Ok(program)
}
