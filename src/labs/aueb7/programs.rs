//! Which shader files make which program, and what is set in it.

use crate::Result;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};
use crate::shadow_tests;

/// The shaders, which are the lesson's other half.
pub const SHADERS: &[(&str, &str)] = &[
    (
        "ShadowMap.vert",
        include_str!("../../../glsl/aueb7/ShadowMap.vert"),
    ),
    (
        "ShadowMap.frag",
        include_str!("../../../glsl/aueb7/ShadowMap.frag"),
    ),
    (
        "SpotLight.vert",
        include_str!("../../../glsl/aueb7/SpotLight.vert"),
    ),
    (
        "SpotLight.frag",
        include_str!("../../../glsl/aueb7/SpotLight.frag"),
    ),
    (
        "is_point_in_shadow.frag",
        include_str!("../../../glsl/aueb7/is_point_in_shadow.frag"),
    ),
    (
        "LightSource.frag",
        include_str!("../../../glsl/aueb7/LightSource.frag"),
    ),
    (
        "visibility.frag",
        include_str!("../../../glsl/aueb7/visibility.frag"),
    ),
    (
        "explain.frag",
        include_str!("../../../glsl/aueb7/explain.frag"),
    ),
    (
        "SpotLight_lcs.vert",
        include_str!("../../../glsl/aueb7/SpotLight_lcs.vert"),
    ),
    (
        "SpotLight_exact.frag",
        include_str!("../../../glsl/aueb7/SpotLight_exact.frag"),
    ),
    (
        "visibility_exact.frag",
        include_str!("../../../glsl/aueb7/visibility_exact.frag"),
    ),
    (
        "SpotLight_offset.frag",
        include_str!("../../../glsl/aueb7/SpotLight_offset.frag"),
    ),
    (
        "visibility_offset.frag",
        include_str!("../../../glsl/aueb7/visibility_offset.frag"),
    ),
    shadow_tests::SHADERS[0],
    shadow_tests::SHADERS[1],
    shadow_tests::SHADERS[2],
    shadow_tests::SHADERS[3],
    shadow_tests::SHADERS[4],
];

/// Uniforms of every program with the shadow test.
const SHADOW_TEST: [&str; 11] = [
    "uniform_m",
    "uniform_v",
    "uniform_p",
    "uniform_view_inverse",
    "uniform_light_view_projection",
    "uniform_sampler_diffuse",
    "uniform_sampler_shadow_map",
    "uniform_filter",
    "constant_depth_bias",
    "uniform_sample_step",
    "uniform_outside",
];

/// Uniforms of the lighting.
pub const LIGHTING: [&str; 6] = [
    "uniform_normal_matrix_ecs",
    "uniform_diffuse_color",
    "uniform_ambient_color",
    "uniform_light_color",
    "uniform_light_position_ecs",
    "uniform_light_direction_ecs",
];

pub struct Programs {
    pub shadow_map: Program,
    pub spot_light: Program,
    /// Of the marker at the light.
    pub light_source: Program,
}

impl Programs {
    /// All of them or none: a lab never draws with some of its shaders.
    pub fn load(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: the shaders");
        let shadow_map = Program::new(
            gl,
            shaders,
            "ShadowMap.vert",
            "ShadowMap.frag",
            &["uniform_mvp"],
        )?;
        let lighting = [&LIGHTING[..], &["uniform_shadows"]].concat();
        let spot_light = with_shadow_test(gl, shaders, "SpotLight.frag", &lighting)
            .inspect_err(|_| shadow_map.delete(gl))?;
        let light_source = Program::new(
            gl,
            shaders,
            "ShadowMap.vert",
            "LightSource.frag",
            &["uniform_mvp"],
        )
        .inspect_err(|_| {
            shadow_map.delete(gl);
            spot_light.delete(gl);
        })?;
        for (program, name) in [
            (&shadow_map, "shadow_map_program"),
            (&spot_light, "spot_light_program"),
            (&light_source, "light_source_program"),
        ] {
            name_object(ObjectKind::Program, program.handle.0.get(), name);
        }
        Ok(Self {
            shadow_map,
            spot_light,
            light_source,
        })
    }

    pub fn delete(&self, gl: &glow::Context) {
        for program in [&self.shadow_map, &self.spot_light, &self.light_source] {
            program.delete(gl);
        }
    }
}

/// The spotlight's vertex shader, for the tests in the light's coordinate system.
pub const VERTEX_SHADER: &str = "SpotLight_lcs.vert";

/// The spotlight's vertex shader and the shadow test with a `main` that uses it.
pub fn with_shadow_test(
    gl: &glow::Context,
    shaders: &Shaders,
    main: &str,
    others: &[&'static str],
) -> Result<Program> {
    let uniforms = [&SHADOW_TEST[..], others].concat();
    let fragments = [main, "is_point_in_shadow.frag"];
    Program::linked(gl, shaders, "SpotLight.vert", &fragments, &uniforms)
}
