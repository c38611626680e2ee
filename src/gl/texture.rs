//! Colour textures for objects.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use glow::{HasContext, PixelUnpackData};
use image::{RgbaImage, imageops};

use super::trace::{ObjectKind, name_object};
use crate::{Error, Result};

/// A picture's mipmap levels, ready for a texture: each half as large as the one before, the bottom row first as GL
/// counts. Needs no context, so it can go on beside something that does.
///
/// They are averaged here: a software driver compiles shaders for `glGenerateMipmap`, which takes it longer than to draw
/// the whole first frame.
pub fn levels(picture: &RgbaImage) -> Vec<RgbaImage> {
    let mut levels = vec![imageops::flip_vertical(picture)];
    while let Some(last) = levels.last()
        && last.dimensions() != (1, 1)
    {
        let (width, height) = last.dimensions();
        levels.push(imageops::thumbnail(
            last,
            (width / 2).max(1),
            (height / 2).max(1),
        ));
    }
    levels
}

/// A repeating, mipmapped texture, with its name for the trace.
///
/// Where the picture has no transparent pixel, the texture has no alpha: it reads as 1 then, however it is filtered.
pub fn texture(gl: &glow::Context, name: &str, levels: &[RgbaImage]) -> Result<glow::Texture> {
    let opaque = levels[0].pixels().all(|pixel| pixel.0[3] == u8::MAX);
    let internal_format = if opaque { glow::RGB } else { glow::RGBA };
    unsafe {
        let texture = gl.create_texture().map_err(Error::gl)?;
        name_object(ObjectKind::Texture, texture.0.get(), name);
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        gl.tex_parameter_i32(
            glow::TEXTURE_2D,
            glow::TEXTURE_MIN_FILTER,
            glow::LINEAR_MIPMAP_LINEAR as i32,
        );
        for (number, level) in levels.iter().enumerate() {
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                number as i32,
                internal_format as i32,
                level.width() as i32,
                level.height() as i32,
                0,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                PixelUnpackData::Slice(Some(level.as_raw())),
            );
        }
        Ok(texture)
    }
}

/// The textures of a scene's pictures: each is sent once, however many objects wear it.
#[derive(Default)]
pub struct Textures {
    /// By where a picture is in memory. The scene, which has it, outlives its being sent.
    sent: HashMap<*const RgbaImage, glow::Texture>,
}

impl Textures {
    /// The texture of a picture; if it is new, the `levels` are asked for and sent under this name.
    pub fn of(
        &mut self,
        gl: &glow::Context,
        name: &str,
        picture: &Arc<RgbaImage>,
        levels: impl FnOnce() -> Vec<RgbaImage>,
    ) -> Result<glow::Texture> {
        let place = Arc::as_ptr(picture);
        if let Some(texture) = self.sent.get(&place) {
            return Ok(*texture);
        }
        let texture = texture(gl, name, &levels())?;
        self.sent.insert(place, texture);
        Ok(texture)
    }
}

/// Each picture once, in the order in which [`Textures::of`] will ask for its levels.
pub fn distinct<'a>(
    pictures: impl IntoIterator<Item = &'a Arc<RgbaImage>>,
) -> Vec<&'a Arc<RgbaImage>> {
    let mut known = HashSet::new();
    let pictures = pictures.into_iter();
    pictures
        .filter(|picture| known.insert(Arc::as_ptr(picture)))
        .collect()
}

/// The most pixels that the driver allows along a side.
pub fn largest_texture(gl: &glow::Context) -> u32 {
    unsafe { gl.get_parameter_i32(glow::MAX_TEXTURE_SIZE) as u32 }
}

/// One white texel: an untextured object multiplies its colour by it, so that one shader draws both kinds.
///
/// It is white however it is filtered, and a software driver takes as long to mix it with itself as two levels of a
/// picture: no filter saves a tenth of an untextured frame.
pub fn solid_texture(gl: &glow::Context) -> Result<glow::Texture> {
    let white = texture(
        gl,
        "white",
        &[RgbaImage::from_pixel(1, 1, image::Rgba([255; 4]))],
    )?;
    for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
        unsafe { gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32) };
    }
    Ok(white)
}

/// A depth map of `size` × `size` texels that holds the same everywhere, also a depth that no first pass could store: 1e9
/// is behind everything, −1e9 before everything.
pub fn flat_depths(gl: &glow::Context, size: u32, depth: f32) -> Result<glow::Texture> {
    let depths = vec![depth; size as usize * size as usize];
    let size = size as i32;
    unsafe {
        let texture = gl.create_texture().map_err(Error::gl)?;
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        // Floats alone are not held to 0…1.
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::DEPTH_COMPONENT32F as i32,
            size,
            size,
            0,
            glow::DEPTH_COMPONENT,
            glow::FLOAT,
            PixelUnpackData::Slice(Some(bytemuck::cast_slice(&depths))),
        );
        for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
        }
        for axis in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, axis, glow::CLAMP_TO_EDGE as i32);
        }
        // Whichever component a shader reads.
        let swizzle = [glow::RED, glow::RED, glow::RED, glow::ONE].map(|c| c as i32);
        gl.tex_parameter_i32_slice(glow::TEXTURE_2D, glow::TEXTURE_SWIZZLE_RGBA, &swizzle);
        Ok(texture)
    }
}
