//! The light buffer on the GPU: three buffer textures and two uniforms.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context, and every pointer that GL gets comes from a slice
//! that outlives the call.
#![allow(unsafe_code)]

use glam::{DMat4, DVec3, DVec4};
use glow::HasContext;

use super::builder::{Builder, LightBuffer};
use super::grid::Layout;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program};
use crate::scene::{Light, LightKind};
use crate::shadow_tests::{LightSpace, Placed};
use crate::{Error, Result};

/// The uniforms of `exact.frag`.
pub const LIGHT_BUFFER: [&str; 5] = [
    "light_buffer_cells",
    "light_buffer_lists",
    "light_buffer_casters",
    "light_buffer_rectangle",
    "light_buffer_side",
];

/// The texture unit of the first of the three: before it are the object's texture and the shadow map.
const FIRST_UNIT: u32 = 2;

/// A caster's number goes through a float.
const MOST_TRIANGLES: u32 = (1 << 24) - 1;

/// A light buffer in the driver, and how it is made anew.
pub struct ExactTest {
    builder: Builder,
    textures: [BufferTexture; 3],
    /// `GL_MAX_TEXTURE_BUFFER_SIZE`.
    most_texels: usize,
    /// What it was built from, while that still holds; and what the shader is told of it.
    built: Option<(Inputs, Uniforms)>,
}

/// Everything that decides what the light buffer holds.
#[derive(PartialEq)]
struct Inputs {
    kind: LightKind,
    position: DVec3,
    direction: DVec3,
    scene: Vec<Placed>,
}

struct Uniforms {
    rectangle: DVec4,
    side: i32,
    space: LightSpace,
    first_triangles: Vec<u32>,
}

struct BufferTexture {
    name: &'static str,
    texture: glow::Texture,
    buffer: glow::Buffer,
    internal_format: u32,
    /// In bytes.
    texel: usize,
    capacity: usize,
}

impl ExactTest {
    pub fn new(gl: &glow::Context) -> Result<Self> {
        let [cells, lists, casters] = [
            ("light_buffer_cells", glow::RGBA32UI, 16),
            ("light_buffer_lists", glow::R32UI, 4),
            ("light_buffer_casters", glow::RGBA32F, 16),
        ]
        .map(|(name, internal_format, texel)| BufferTexture::new(gl, name, internal_format, texel));
        let most_texels = unsafe { gl.get_parameter_i32(glow::MAX_TEXTURE_BUFFER_SIZE) };
        Ok(Self {
            builder: Builder::default(),
            textures: [cells?, lists?, casters?],
            most_texels: most_texels as usize,
            built: None,
        })
    }

    /// Builds the light buffer if the light or something in the scene has moved, or `always`. `scene` is in the order in
    /// which it is drawn.
    pub fn prepare(
        &mut self,
        gl: &glow::Context,
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
        let _pass = gl::pass(gl, "the light buffer");
        let light_buffer = self.builder.build(light, &inputs.scene);
        let Layout {
            least, scale, side, ..
        } = light_buffer.layout;
        let uniforms = Uniforms {
            rectangle: least.extend(scale.x).extend(scale.y),
            side: side as i32,
            space: light_buffer.space,
            first_triangles: light_buffer.first_triangles.clone(),
        };
        upload(gl, &mut self.textures, light_buffer, self.most_texels)?;
        self.built = Some((inputs, uniforms));
        Ok(())
    }

    fn uniforms(&self) -> &Uniforms {
        let (_, uniforms) = self
            .built
            .as_ref()
            .expect("a frame prepares the test first");
        uniforms
    }

    /// Object space to the light's.
    pub fn from_object(&self, model: DMat4) -> DMat4 {
        self.uniforms().space.from_object(model)
    }

    /// The number of the first triangle of what is drawn in this place.
    pub fn first_triangle(&self, place: usize) -> i32 {
        self.uniforms().first_triangles[place] as i32
    }

    /// Binds the textures for a program, which must be in use.
    pub fn bind(&self, gl: &glow::Context, program: &Program) {
        for (texture, unit) in self.textures.iter().zip(FIRST_UNIT..) {
            unsafe {
                gl.active_texture(glow::TEXTURE0 + unit);
                gl.bind_texture(glow::TEXTURE_BUFFER, Some(texture.texture));
            }
            program.set(gl, texture.name, unit as i32);
        }
        let uniforms = self.uniforms();
        program.set(gl, "light_buffer_rectangle", uniforms.rectangle);
        program.set(gl, "light_buffer_side", uniforms.side);
    }
}

fn upload(
    gl: &glow::Context,
    textures: &mut [BufferTexture; 3],
    light_buffer: &LightBuffer,
    most_texels: usize,
) -> Result<()> {
    let triangles = light_buffer.triangle_count;
    if triangles > MOST_TRIANGLES {
        return Err(Error::gl(format!(
            "the exact shadow test: {triangles} triangles, expected at most {MOST_TRIANGLES}: \
             a smaller scene, or shadow_test=handout"
        )));
    }
    let contents: [&[u8]; 3] = [
        bytemuck::cast_slice(&light_buffer.cells),
        bytemuck::cast_slice(&light_buffer.lists),
        bytemuck::cast_slice(&light_buffer.casters),
    ];
    for (texture, contents) in textures.iter_mut().zip(contents) {
        texture.upload(gl, contents, most_texels)?;
    }
    Ok(())
}

impl BufferTexture {
    fn new(
        gl: &glow::Context,
        name: &'static str,
        internal_format: u32,
        texel: usize,
    ) -> Result<Self> {
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
                texel,
                capacity: 0,
            })
        }
    }

    fn upload(&mut self, gl: &glow::Context, contents: &[u8], most_texels: usize) -> Result<()> {
        let texels = contents.len() / self.texel;
        check_size(self.name, texels, most_texels)?;
        unsafe {
            gl.bind_buffer(glow::TEXTURE_BUFFER, Some(self.buffer));
            // Larger than now by half: a light that moves a little finds room.
            if contents.len() > self.capacity || self.capacity == 0 {
                self.capacity = (texels + texels / 2).clamp(1, most_texels) * self.texel;
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
        assert!(check_size("light_buffer_cells", 65_536, 65_536).is_ok());
        let refused = check_size("light_buffer_cells", 65_537, 65_536).unwrap_err();
        for word in [
            "light_buffer_cells",
            "65537",
            "65536",
            "shadow_test=handout",
        ] {
            assert!(refused.to_string().contains(word), "{refused}");
        }
        assert_eq!(refused.exit_code(), 1);
    }
}
