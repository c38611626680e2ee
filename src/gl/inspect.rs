//! What the driver says of shaders: its messages, and what of a linked program has an effect.

use glow::HasContext;

use super::mesh::ATTRIBUTES;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    Vertex,
    Fragment,
}

/// What of a program's uniforms and inputs has an effect on what it draws.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    pub uniforms: Vec<Active>,
    /// Of the vertex shader.
    pub inputs: Vec<Active>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Active {
    /// Of an array without its brackets.
    pub name: String,
    /// The type, as GLSL writes it.
    pub kind: &'static str,
    /// Of an input, where it is fed.
    pub location: Option<u32>,
    /// Of a uniform, what it is set to, as a number: a sampler's is its texture unit.
    pub value: f32,
}

impl Interface {
    pub fn uniform(&self, name: &str) -> Option<&Active> {
        self.uniforms.iter().find(|uniform| uniform.name == name)
    }
}

/// The compiled shader, or the driver's log.
pub fn compile(
    gl: &glow::Context,
    stage: Stage,
    text: &str,
) -> std::result::Result<glow::Shader, String> {
    let kind = match stage {
        Stage::Vertex => glow::VERTEX_SHADER,
        Stage::Fragment => glow::FRAGMENT_SHADER,
    };
    unsafe {
        let shader = gl.create_shader(kind)?;
        gl.shader_source(shader, text);
        gl.compile_shader(shader);
        if gl.get_shader_compile_status(shader) {
            return Ok(shader);
        }
        let log = gl.get_shader_info_log(shader);
        gl.delete_shader(shader);
        Err(log)
    }
}

/// What the driver has against a text.
pub fn compiles(gl: &glow::Context, stage: Stage, text: &str) -> std::result::Result<(), String> {
    let shader = compile(gl, stage, text)?;
    unsafe { gl.delete_shader(shader) };
    Ok(())
}

/// Links shaders as [`super::Program`] does. A program that does not link is deleted, and the driver's log returned.
pub fn link(
    gl: &glow::Context,
    shaders: &[glow::Shader],
) -> std::result::Result<glow::Program, String> {
    unsafe {
        let program = gl.create_program()?;
        for shader in shaders {
            gl.attach_shader(program, *shader);
        }
        for (name, location) in ATTRIBUTES {
            gl.bind_attrib_location(program, location, name);
        }
        gl.link_program(program);
        if gl.get_program_link_status(program) {
            return Ok(program);
        }
        let log = gl.get_program_info_log(program);
        gl.delete_program(program);
        Err(log)
    }
}

/// What of a linked program has an effect, and which values its uniforms have now.
pub fn interface(gl: &glow::Context, program: glow::Program) -> Interface {
    let mut found = Interface::default();
    unsafe {
        for index in 0..gl.get_program_parameter_i32(program, glow::ACTIVE_UNIFORMS) as u32 {
            let Some(uniform) = gl.get_active_uniform(program, index) else {
                continue;
            };
            // A uniform of a block has no location, and comes from a buffer.
            let Some(location) = gl.get_uniform_location(program, &uniform.name) else {
                continue;
            };
            // The first number is enough to tell a value from none; a 4 × 4 matrix is the longest.
            let mut value = [0.0; 16];
            gl.get_uniform_f32(program, &location, &mut value);
            found.uniforms.push(Active {
                name: without_brackets(&uniform.name),
                kind: kind_name(uniform.utype),
                location: None,
                value: value.into_iter().find(|value| *value != 0.0).unwrap_or(0.0),
            });
        }
        for index in 0..gl.get_program_parameter_i32(program, glow::ACTIVE_ATTRIBUTES) as u32 {
            let Some(input) = gl.get_active_attribute(program, index) else {
                continue;
            };
            // What is built in, as gl_InstanceID, has none.
            let Some(location) = gl.get_attrib_location(program, &input.name) else {
                continue;
            };
            found.inputs.push(Active {
                name: without_brackets(&input.name),
                kind: kind_name(input.atype),
                location: Some(location),
                value: 0.0,
            });
        }
    }
    found
}

/// Compiles and links these texts, and says what of them has an effect; or returns the driver's log.
pub fn try_link(
    gl: &glow::Context,
    texts: &[(Stage, &str)],
) -> std::result::Result<Interface, String> {
    let mut shaders = Vec::new();
    let compiled = texts.iter().try_for_each(|(stage, text)| {
        shaders.push(compile(gl, *stage, text)?);
        Ok(())
    });
    let linked = compiled.and_then(|()| link(gl, &shaders));
    unsafe {
        shaders
            .into_iter()
            .for_each(|shader| gl.delete_shader(shader));
        let program = linked?;
        let found = interface(gl, program);
        gl.delete_program(program);
        Ok(found)
    }
}

fn without_brackets(name: &str) -> String {
    name.strip_suffix("[0]").unwrap_or(name).to_owned()
}

/// The types of what GLSL 330 can declare.
fn kind_name(kind: u32) -> &'static str {
    match kind {
        glow::FLOAT => "float",
        glow::FLOAT_VEC2 => "vec2",
        glow::FLOAT_VEC3 => "vec3",
        glow::FLOAT_VEC4 => "vec4",
        glow::INT => "int",
        glow::INT_VEC2 => "ivec2",
        glow::INT_VEC3 => "ivec3",
        glow::INT_VEC4 => "ivec4",
        glow::UNSIGNED_INT => "uint",
        glow::UNSIGNED_INT_VEC2 => "uvec2",
        glow::UNSIGNED_INT_VEC3 => "uvec3",
        glow::UNSIGNED_INT_VEC4 => "uvec4",
        glow::BOOL => "bool",
        glow::BOOL_VEC2 => "bvec2",
        glow::BOOL_VEC3 => "bvec3",
        glow::BOOL_VEC4 => "bvec4",
        glow::FLOAT_MAT2 => "mat2",
        glow::FLOAT_MAT3 => "mat3",
        glow::FLOAT_MAT4 => "mat4",
        glow::SAMPLER_1D => "sampler1D",
        glow::SAMPLER_2D => "sampler2D",
        glow::SAMPLER_3D => "sampler3D",
        glow::SAMPLER_CUBE => "samplerCube",
        glow::SAMPLER_2D_ARRAY => "sampler2DArray",
        glow::SAMPLER_2D_RECT => "sampler2DRect",
        glow::SAMPLER_1D_SHADOW => "sampler1DShadow",
        glow::SAMPLER_2D_SHADOW => "sampler2DShadow",
        glow::SAMPLER_CUBE_SHADOW => "samplerCubeShadow",
        glow::SAMPLER_2D_ARRAY_SHADOW => "sampler2DArrayShadow",
        glow::SAMPLER_BUFFER => "samplerBuffer",
        glow::INT_SAMPLER_2D => "isampler2D",
        glow::INT_SAMPLER_BUFFER => "isamplerBuffer",
        glow::UNSIGNED_INT_SAMPLER_2D => "usampler2D",
        glow::UNSIGNED_INT_SAMPLER_BUFFER => "usamplerBuffer",
        _ => "another type",
    }
}

/// The messages of a driver's log, each with the line of the shader that it speaks of.
pub fn messages(log: &str) -> impl Iterator<Item = (Option<usize>, &str)> {
    let lines = log.lines().filter(|line| !line.trim().is_empty());
    lines.map(|message| (line_in(message), message))
}

pub fn first_message(log: &str) -> (Option<usize>, &str) {
    messages(log).next().unwrap_or((None, "no message"))
}

/// Mesa writes `0:12(5): error: …`, NVIDIA `0(12) : error …`, AMD and Intel `ERROR: 0:12: …`.
fn line_in(message: &str) -> Option<usize> {
    let place = message.strip_prefix("ERROR: ").unwrap_or(message);
    let after_string_number = place.trim_start_matches(|c: char| c.is_ascii_digit());
    let rest = after_string_number.strip_prefix([':', '('])?;
    rest.split(|c: char| !c.is_ascii_digit())
        .next()?
        .parse()
        .ok()
}

#[cfg(test)]
mod tests {
    use super::first_message;

    #[test]
    fn the_line_is_found_in_every_dialect() {
        for log in [
            "0:12(5): error: `x' undeclared",
            "0(12) : error C1503: undefined variable",
            "ERROR: 0:12: 'x' : undeclared identifier",
        ] {
            assert_eq!(first_message(log).0, Some(12), "{log}");
        }
        assert_eq!(first_message("error: linking failed").0, None);
        assert_eq!(first_message("\n\n").1, "no message");
    }
}
