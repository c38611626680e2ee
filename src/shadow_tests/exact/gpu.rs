//! The light buffer on the GPU: two buffer textures and two uniforms.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context, and every pointer that GL gets comes from a slice
//! that outlives the call.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3, DVec4};
use glow::HasContext;

use super::builder::{Builder, LightBuffer};
use super::layout::Layout;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program};
use crate::scene::{Light, LightKind};
use crate::shadow_tests::{LightSpace, Placed};
use crate::{Error, Result};

/// What a light buffer is called, and where it is bound.
pub struct Binding {
    /// The pass that builds it.
    pub pass: &'static str,
    /// The parts of the `LightBuffer` of `exact.frag`, in its order.
    pub uniforms: [&'static str; 4],
    /// The first of two texture units that nothing else has.
    pub first_unit: u32,
}

/// The uniforms of a lab's only light buffer.
pub const LIGHT_BUFFER: [&str; 4] = [
    "light_buffer.cells",
    "light_buffer.nodes",
    "light_buffer.rectangle",
    "light_buffer.side",
];

/// Four numbers of four bytes.
const TEXEL: usize = 16;

/// A light buffer in the driver.
pub struct ExactTest {
    binding: &'static Binding,
    textures: [BufferTexture; 2],
    /// `GL_MAX_TEXTURE_BUFFER_SIZE`.
    most_texels: usize,
    /// What it was built from, while that still holds; and what the shader is told of it.
    built: Option<(Inputs, Values)>,
}

/// Everything that decides what the light buffer holds.
#[derive(PartialEq)]
struct Inputs {
    kind: LightKind,
    position: DVec3,
    direction: DVec3,
    scene: Vec<Placed>,
}

/// What a program is told beside the textures.
struct Values {
    rectangle: DVec4,
    side: i32,
    space: LightSpace,
}

struct BufferTexture {
    name: &'static str,
    texture: glow::Texture,
    buffer: glow::Buffer,
    internal_format: u32,
    capacity: usize,
}

impl ExactTest {
    pub fn new(gl: &glow::Context, binding: &'static Binding) -> Result<Self> {
        let [cells, nodes, ..] = binding.uniforms;
        let cells = BufferTexture::new(gl, cells, glow::RGBA32UI)?;
        let nodes = BufferTexture::new(gl, nodes, glow::RGBA32I)?;
        let most_texels = unsafe { gl.get_parameter_i32(glow::MAX_TEXTURE_BUFFER_SIZE) };
        Ok(Self {
            binding,
            textures: [cells, nodes],
            most_texels: most_texels as usize,
            built: None,
        })
    }

    /// Builds the light buffer if the light or something in the scene has moved, or `always`.
    pub fn prepare(
        &mut self,
        gl: &glow::Context,
        builder: &mut Builder,
        light: &Light,
        scene: Vec<Placed>,
        always: bool,
    ) -> Result<()> {
        let inputs = Inputs {
            kind: light.kind,
            position: light.position,
            direction: light.direction,
            scene,
        };
        let built = self.built.take();
        if let Some(built) = built.filter(|(built, _)| !always && *built == inputs) {
            self.built = Some(built);
            return Ok(());
        }
        let _pass = gl::pass(gl, self.binding.pass);
        let light_buffer = builder.build(light, &inputs.scene);
        let Layout {
            least, scale, side, ..
        } = light_buffer.layout;
        let values = Values {
            rectangle: least.extend(scale.x).extend(scale.y),
            side: side as i32,
            space: light_buffer.space,
        };
        upload(gl, &mut self.textures, light_buffer, self.most_texels)?;
        self.built = Some((inputs, values));
        Ok(())
    }

    /// Gives the memory back, while another test is in use.
    pub fn release(&mut self, gl: &glow::Context) {
        self.built = None;
        for texture in &mut self.textures {
            texture.release(gl);
        }
    }

    fn values(&self) -> &Values {
        let (_, values) = self
            .built
            .as_ref()
            .expect("a frame prepares the test first");
        values
    }

    /// Object space to the light's.
    pub fn from_object(&self, model: DMat4) -> DMat4 {
        self.values().space.from_object(model)
    }

    /// Tells a program, which must be in use, where the textures are, whether or not there is anything in them: units of
    /// samplers of several kinds must not be the same.
    pub fn set_units(&self, gl: &glow::Context, program: &Program) {
        for (texture, unit) in self.textures.iter().zip(self.binding.first_unit..) {
            program.set(gl, texture.name, unit as i32);
        }
    }

    /// Binds the textures for a program, which must be in use.
    pub fn bind(&self, gl: &glow::Context, program: &Program) {
        self.set_units(gl, program);
        for (texture, unit) in self.textures.iter().zip(self.binding.first_unit..) {
            unsafe {
                gl.active_texture(glow::TEXTURE0 + unit);
                gl.bind_texture(glow::TEXTURE_BUFFER, Some(texture.texture));
            }
        }
        let [.., rectangle, side] = self.binding.uniforms;
        let values = self.values();
        program.set(gl, rectangle, values.rectangle);
        program.set(gl, side, values.side);
    }
}

fn upload(
    gl: &glow::Context,
    textures: &mut [BufferTexture; 2],
    light_buffer: &LightBuffer,
    most_texels: usize,
) -> Result<()> {
    let contents: [&[u8]; 2] = [
        bytemuck::cast_slice(&light_buffer.cells),
        bytemuck::cast_slice(&light_buffer.nodes),
    ];
    for (texture, contents) in textures.iter_mut().zip(contents) {
        texture.upload(gl, contents, most_texels)?;
    }
    Ok(())
}

impl BufferTexture {
    fn new(gl: &glow::Context, name: &'static str, internal_format: u32) -> Result<Self> {
        unsafe {
            let buffer = gl.create_buffer().map_err(Error::gl)?;
            name_object(ObjectKind::Buffer, buffer.0.get(), name);
            let texture = gl.create_texture().map_err(Error::gl)?;
            name_object(ObjectKind::Texture, texture.0.get(), name);
            Ok(Self {
                name,
                texture,
                buffer,
                internal_format,
                capacity: 0,
            })
        }
    }

    fn upload(&mut self, gl: &glow::Context, contents: &[u8], most_texels: usize) -> Result<()> {
        let texels = contents.len() / TEXEL;
        check_size(self.name, texels, most_texels)?;
        unsafe {
            gl.bind_buffer(glow::TEXTURE_BUFFER, Some(self.buffer));
            // Larger than now by half: a light that moves a little finds room.
            if contents.len() > self.capacity || self.capacity == 0 {
                self.capacity = (texels + texels / 2).clamp(1, most_texels) * TEXEL;
                let capacity = self.capacity as i32;
                gl.buffer_data_size(glow::TEXTURE_BUFFER, capacity, glow::DYNAMIC_DRAW);
                gl.bind_texture(glow::TEXTURE_BUFFER, Some(self.texture));
                gl.tex_buffer(
                    glow::TEXTURE_BUFFER,
                    self.internal_format,
                    Some(self.buffer),
                );
            }
            gl.buffer_sub_data_u8_slice(glow::TEXTURE_BUFFER, 0, contents);
        }
        Ok(())
    }

    fn release(&mut self, gl: &glow::Context) {
        if std::mem::take(&mut self.capacity) > 0 {
            unsafe {
                gl.bind_buffer(glow::TEXTURE_BUFFER, Some(self.buffer));
                gl.buffer_data_size(glow::TEXTURE_BUFFER, 0, glow::DYNAMIC_DRAW);
            }
        }
    }
}

/// GL 3.3 promises 65,536 texels in a buffer texture, and no more.
fn check_size(name: &str, texels: usize, most: usize) -> Result<()> {
    if texels <= most {
        return Ok(());
    }
    Err(Error::gl(format!(
        "the exact shadow test: {name} has {texels} texels, expected at most {most} \
         (GL_MAX_TEXTURE_BUFFER_SIZE): a smaller scene, or shadow_test=handout"
    )))
}

#[cfg(test)]
mod tests {
    use super::check_size;

    #[test]
    fn what_does_not_fit_is_told() {
        assert!(check_size("light_buffer.cells", 65_536, 65_536).is_ok());
        let refused = check_size("light_buffer.cells", 65_537, 65_536).unwrap_err();
        for word in [
            "light_buffer.cells",
            "65537",
            "65536",
            "shadow_test=handout",
        ] {
            assert!(refused.to_string().contains(word), "{refused}");
        }
        assert_eq!(refused.exit_code(), 1);
    }
}
