//! From the GPU back to memory. GL's first row is the bottom one, a picture's is the top: only this file turns them.

use glow::{HasContext, PixelPackData};
use image::{GrayImage, RgbImage};

use crate::picture::DepthMap;
use crate::{Error, Result};

/// The colours of the framebuffer that is bound for reading.
pub fn read_rgb(gl: &glow::Context, [width, height]: [u32; 2]) -> RgbImage {
    let mut bytes = vec![0; 3 * width as usize * height as usize];
    read_pixels(
        gl,
        [0, 0, width, height],
        glow::RGB,
        glow::UNSIGNED_BYTE,
        &mut bytes,
    );
    let bottom_up = RgbImage::from_raw(width, height, bytes).expect("three bytes a pixel");
    image::imageops::flip_vertical(&bottom_up)
}

/// The red channel of the framebuffer that is bound for reading.
pub fn read_grey(gl: &glow::Context, [width, height]: [u32; 2]) -> GrayImage {
    let mut bytes = vec![0; width as usize * height as usize];
    read_pixels(
        gl,
        [0, 0, width, height],
        glow::RED,
        glow::UNSIGNED_BYTE,
        &mut bytes,
    );
    let bottom_up = GrayImage::from_raw(width, height, bytes).expect("one byte a pixel");
    image::imageops::flip_vertical(&bottom_up)
}

/// A float whose 32 bits a shader has written as the four bytes of a pixel; `x`, `y` from the bottom left as GL counts.
pub fn read_float_in_bytes(gl: &glow::Context, [x, y]: [u32; 2]) -> f32 {
    let mut bytes = [0; 4];
    read_pixels(
        gl,
        [x, y, 1, 1],
        glow::RGBA,
        glow::UNSIGNED_BYTE,
        &mut bytes,
    );
    f32::from_le_bytes(bytes)
}

/// The same of a single vertex, whose attributes come from no array: it is drawn into a viewport of one pixel.
pub fn read_float_of_one_vertex(gl: &glow::Context) -> Result<f32> {
    unsafe {
        gl.viewport(0, 0, 1, 1);
        let nothing = gl.create_vertex_array().map_err(Error::gl)?;
        gl.bind_vertex_array(Some(nothing));
        gl.draw_arrays(glow::POINTS, 0, 1);
        gl.delete_vertex_array(nothing);
    }
    Ok(read_float_in_bytes(gl, [0, 0]))
}

/// One pixel of the depth buffer; `x`, `y` from the bottom left as GL counts.
pub fn read_depth(gl: &glow::Context, [x, y]: [u32; 2]) -> f32 {
    let mut bytes = [0; 4];
    read_pixels(
        gl,
        [x, y, 1, 1],
        glow::DEPTH_COMPONENT,
        glow::FLOAT,
        &mut bytes,
    );
    f32::from_ne_bytes(bytes)
}

/// One pixel of the stencil buffer.
pub fn read_stencil(gl: &glow::Context, [x, y]: [u32; 2]) -> u8 {
    let mut bytes = [0];
    read_pixels(
        gl,
        [x, y, 1, 1],
        glow::STENCIL_INDEX,
        glow::UNSIGNED_BYTE,
        &mut bytes,
    );
    bytes[0]
}

/// A depth texture, top row first. It stays bound to the texture unit that is active.
pub fn read_depths(
    gl: &glow::Context,
    texture: glow::Texture,
    [width, height]: [u32; 2],
) -> DepthMap {
    let mut bytes = vec![0; 4 * width as usize * height as usize];
    unsafe {
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        gl.get_tex_image(
            glow::TEXTURE_2D,
            0,
            glow::DEPTH_COMPONENT,
            glow::FLOAT,
            PixelPackData::Slice(Some(&mut bytes)),
        );
    }
    let depths = bytes
        .chunks_exact(4 * width as usize)
        .rev()
        .flat_map(|row| row.chunks_exact(4))
        .map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    DepthMap {
        size: [width, height],
        depths,
    }
}

/// Some texels of a depth texture, from `first` on, row by row from the bottom; all within it.
pub fn read_depth_texels(
    gl: &glow::Context,
    texture: glow::Texture,
    [x, y]: [u32; 2],
    [width, height]: [u32; 2],
) -> Result<Vec<f32>> {
    let mut bytes = vec![0; 4 * width as usize * height as usize];
    unsafe {
        let before = gl.get_parameter_framebuffer(glow::READ_FRAMEBUFFER_BINDING);
        let framebuffer = gl.create_framebuffer().map_err(Error::gl)?;
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(framebuffer));
        gl.framebuffer_texture_2d(
            glow::READ_FRAMEBUFFER,
            glow::DEPTH_ATTACHMENT,
            glow::TEXTURE_2D,
            Some(texture),
            0,
        );
        gl.read_buffer(glow::NONE);
        let area = [x, y, width, height];
        read_pixels(gl, area, glow::DEPTH_COMPONENT, glow::FLOAT, &mut bytes);
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, before);
        gl.delete_framebuffer(framebuffer);
    }
    let texels = bytes.chunks_exact(4);
    Ok(texels
        .map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]))
        .collect())
}

fn read_pixels(gl: &glow::Context, area: [u32; 4], format: u32, kind: u32, bytes: &mut [u8]) {
    let [x, y, width, height] = area.map(|n| n as i32);
    unsafe {
        gl.pixel_store_i32(glow::PACK_ALIGNMENT, 1);
        gl.read_pixels(
            x,
            y,
            width,
            height,
            format,
            kind,
            PixelPackData::Slice(Some(bytes)),
        );
    }
}
