//! What the viewer draws over a lab's finished picture: a depth map as an inset, and a sheet of text.
//!
//! A lab knows nothing of it: whatever state is touched here is put back.

use glow::{HasContext, PixelUnpackData};
use image::RgbaImage;

use super::{Program, Shaders};
use crate::picture::Projection;
use crate::{Error, Result};

const SHADERS: &[(&str, &str)] = &[
    ("quad.vert", include_str!("../../glsl/viewer/quad.vert")),
    ("sheet.frag", include_str!("../../glsl/viewer/sheet.frag")),
    ("inset.frag", include_str!("../../glsl/viewer/inset.frag")),
];

/// Part of the window in pixels, from the bottom left as GL counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    pub left: u32,
    pub bottom: u32,
    pub size: [u32; 2],
}

pub struct Overlay {
    /// Has no attributes: the corners come from `gl_VertexID`.
    vertex_array: glow::VertexArray,
    sheet: Sheet,
    inset: Inset,
}

struct Sheet {
    program: Program,
    texture: glow::Texture,
    size: [u32; 2],
}

struct Inset {
    program: Program,
    /// Reads a depth texture as it is, whatever filter or comparison the lab has given it.
    sampler: glow::Sampler,
}

impl Overlay {
    pub fn new(gl: &glow::Context) -> Result<Self> {
        let shaders = Shaders::new("viewer", SHADERS, None)?;
        let program =
            |fragment, uniforms| Program::new(gl, &shaders, "quad.vert", fragment, uniforms);
        let sheet_program = program("sheet.frag", &["sheet"])?;
        let inset_program = program("inset.frag", &["shadow_map", "near", "far", "orthographic"])?;
        let saved = Saved::new(gl);
        unsafe {
            let texture = gl.create_texture().map_err(Error::gl)?;
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            for filter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, filter, glow::NEAREST as i32);
            }
            let sampler = gl.create_sampler().map_err(Error::gl)?;
            for (parameter, value) in [
                (glow::TEXTURE_MIN_FILTER, glow::NEAREST),
                (glow::TEXTURE_MAG_FILTER, glow::NEAREST),
                (glow::TEXTURE_COMPARE_MODE, glow::NONE),
            ] {
                gl.sampler_parameter_i32(sampler, parameter, value as i32);
            }
            saved.put_back(gl);
            Ok(Self {
                vertex_array: gl.create_vertex_array().map_err(Error::gl)?,
                sheet: Sheet {
                    program: sheet_program,
                    texture,
                    size: [0; 2],
                },
                inset: Inset {
                    program: inset_program,
                    sampler,
                },
            })
        }
    }

    /// Takes another sheet, as large as the window.
    pub fn set_sheet(&mut self, gl: &glow::Context, sheet: &RgbaImage) {
        let saved = Saved::new(gl);
        self.sheet.size = [sheet.width(), sheet.height()];
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.sheet.texture));
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RGBA8 as i32,
                sheet.width() as i32,
                sheet.height() as i32,
                0,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                PixelUnpackData::Slice(Some(sheet.as_raw())),
            );
        }
        saved.put_back(gl);
    }

    /// Draws the sheet over the whole window.
    pub fn draw_sheet(&self, gl: &glow::Context) {
        let saved = Saved::new(gl);
        unsafe {
            gl.enable(glow::BLEND);
            gl.blend_func_separate(
                glow::SRC_ALPHA,
                glow::ONE_MINUS_SRC_ALPHA,
                glow::ZERO,
                glow::ONE,
            );
            gl.use_program(Some(self.sheet.program.handle));
            self.sheet.program.set(gl, "sheet", 0);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.sheet.texture));
        }
        let [left, bottom] = [0, 0];
        self.draw_quad(
            gl,
            Area {
                left,
                bottom,
                size: self.sheet.size,
            },
        );
        saved.put_back(gl);
    }

    /// Draws a depth texture into an area, as the distance between `near` and `far`.
    pub fn draw_inset(
        &self,
        gl: &glow::Context,
        texture: glow::Texture,
        projection: Projection,
        [near, far]: [f64; 2],
        area: Area,
    ) {
        let saved = Saved::new(gl);
        let program = &self.inset.program;
        unsafe {
            gl.disable(glow::BLEND);
            gl.use_program(Some(program.handle));
            program.set(gl, "shadow_map", 0);
            program.set(gl, "near", near);
            program.set(gl, "far", far);
            let orthographic = projection == Projection::Orthographic;
            program.set(gl, "orthographic", i32::from(orthographic));
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.bind_sampler(0, Some(self.inset.sampler));
        }
        self.draw_quad(gl, area);
        saved.put_back(gl);
    }

    fn draw_quad(&self, gl: &glow::Context, area: Area) {
        let [left, bottom, width, height] =
            [area.left, area.bottom, area.size[0], area.size[1]].map(|n| n as i32);
        unsafe {
            for test in TESTS {
                gl.disable(test);
            }
            gl.viewport(left, bottom, width, height);
            gl.bind_vertex_array(Some(self.vertex_array));
            gl.draw_arrays(glow::TRIANGLE_STRIP, 0, 4);
        }
    }
}

/// What would keep a quad from being drawn.
const TESTS: [u32; 4] = [
    glow::DEPTH_TEST,
    glow::STENCIL_TEST,
    glow::SCISSOR_TEST,
    glow::CULL_FACE,
];

/// The state that this module touches, as a lab left it. Texture unit 0 is active until it is put back.
struct Saved {
    enabled: Vec<(u32, bool)>,
    blend: [u32; 4],
    viewport: [i32; 4],
    unpack_alignment: i32,
    program: Option<glow::Program>,
    vertex_array: Option<glow::VertexArray>,
    active_texture: u32,
    texture: Option<glow::Texture>,
    sampler: Option<glow::Sampler>,
}

impl Saved {
    fn new(gl: &glow::Context) -> Self {
        unsafe {
            let enabled = TESTS.iter().chain(&[glow::BLEND]);
            let active_texture = gl.get_parameter_i32(glow::ACTIVE_TEXTURE) as u32;
            gl.active_texture(glow::TEXTURE0);
            let mut viewport = [0; 4];
            gl.get_parameter_i32_slice(glow::VIEWPORT, &mut viewport);
            let saved = Self {
                enabled: enabled.map(|&what| (what, gl.is_enabled(what))).collect(),
                blend: [
                    glow::BLEND_SRC_RGB,
                    glow::BLEND_DST_RGB,
                    glow::BLEND_SRC_ALPHA,
                    glow::BLEND_DST_ALPHA,
                ]
                .map(|factor| gl.get_parameter_i32(factor) as u32),
                viewport,
                unpack_alignment: gl.get_parameter_i32(glow::UNPACK_ALIGNMENT),
                program: gl.get_parameter_program(glow::CURRENT_PROGRAM),
                vertex_array: gl.get_parameter_vertex_array(glow::VERTEX_ARRAY_BINDING),
                active_texture,
                texture: gl.get_parameter_texture(glow::TEXTURE_BINDING_2D),
                sampler: gl.get_parameter_sampler(glow::SAMPLER_BINDING),
            };
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, 1);
            saved
        }
    }

    fn put_back(self, gl: &glow::Context) {
        let [left, bottom, width, height] = self.viewport;
        let [source, destination, source_alpha, destination_alpha] = self.blend;
        unsafe {
            for (what, enabled) in self.enabled {
                if enabled {
                    gl.enable(what);
                } else {
                    gl.disable(what);
                }
            }
            gl.blend_func_separate(source, destination, source_alpha, destination_alpha);
            gl.viewport(left, bottom, width, height);
            gl.pixel_store_i32(glow::UNPACK_ALIGNMENT, self.unpack_alignment);
            gl.use_program(self.program);
            gl.bind_vertex_array(self.vertex_array);
            gl.bind_texture(glow::TEXTURE_2D, self.texture);
            gl.bind_sampler(0, self.sampler);
            gl.active_texture(self.active_texture);
        }
    }
}
