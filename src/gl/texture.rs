//! Colour textures for objects.

use glow::{HasContext, PixelUnpackData};
use image::{RgbImage, imageops};

use super::trace::{ObjectKind, name_object};
use crate::{Error, Result};

/// A repeating, mipmapped texture, with its name for the trace. A picture's first row is its top, GL's first row is the bottom.
///
/// The smaller levels are averaged here: a software driver compiles shaders for `glGenerateMipmap`, which takes it
/// longer than to draw the whole first frame.
pub fn texture(gl: &glow::Context, name: &str, picture: &RgbImage) -> Result<glow::Texture> {
    unsafe {
        let texture = gl.create_texture().map_err(Error::gl)?;
        name_object(ObjectKind::Texture, texture.0.get(), name);
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        // Rows of RGB bytes stand without gaps; GL expects them at multiples of 4 unless told.
        gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
        gl.tex_parameter_i32(
            glow::TEXTURE_2D,
            glow::TEXTURE_MIN_FILTER,
            glow::LINEAR_MIPMAP_LINEAR as i32,
        );
        let mut rows = imageops::flip_vertical(picture);
        for level in 0.. {
            let (width, height) = rows.dimensions();
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                level,
                glow::RGB as i32,
                width as i32,
                height as i32,
                0,
                glow::RGB,
                glow::UNSIGNED_BYTE,
                PixelUnpackData::Slice(Some(rows.as_raw())),
            );
            if (width, height) == (1, 1) {
                break;
            }
            rows = imageops::thumbnail(&rows, (width / 2).max(1), (height / 2).max(1));
        }
        Ok(texture)
    }
}

/// One white texel: an untextured object multiplies its colour by it, so that one shader draws both kinds.
pub fn solid_texture(gl: &glow::Context) -> Result<glow::Texture> {
    texture(
        gl,
        "white",
        &RgbImage::from_pixel(1, 1, image::Rgb([255; 3])),
    )
}
