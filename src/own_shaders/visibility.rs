//! The shadows of a shader that has its shadow test and its lighting in one: read from three of its pictures.

use image::{GrayImage, Rgb};

use crate::compare::Shadows;
use crate::headless::Headless;
use crate::labs::{Lab, Show};
use crate::{Error, Result, gl};

/// A depth that is behind, or with a minus before, everything that a map can show.
const FAR: f32 = 1e9;

/// Where the light (from 1) arrives, by the present test, whoever wrote it: 255 lit, 0 in shadow. The frame's own picture
/// stands between that with a map in which nothing casts a shadow and that with a map in which everything is in shadow.
///
/// In a picture a shadow is to be read only where the light changes it: not where it does not reach. There the visibility
/// is 255 and not `known`. Where the picture does not ask the map at all, that is an error.
pub fn visibility(
    lab: &mut dyn Lab,
    context: &Headless,
    size: [u32; 2],
    light: usize,
) -> Result<Shadows> {
    try_visibility(lab, context, size, light)?.ok_or_else(|| {
        Error::gl(
            "the picture is the same whatever the shadow map holds, so no shadow can be read from it, expected a shadow \
             test that reaches the picture",
        )
    })
}

/// The same, with None where the picture does not ask the map.
pub fn try_visibility(
    lab: &mut dyn Lab,
    context: &Headless,
    size: [u32; 2],
    light: usize,
) -> Result<Option<Shadows>> {
    let gl = &context.gl;
    if !lab.has_students_test() {
        lab.render(gl, Show::Visibility { light })?;
        let visibility: GrayImage = gl::read_grey(gl, size);
        let known = vec![true; visibility.len()];
        return Ok(Some(Shadows { visibility, known }));
    }
    let mut picture = |show| -> Result<_> {
        lab.render(gl, show)?;
        Ok(gl::read_rgb(gl, size))
    };
    let own = picture(Show::Picture)?;
    let mut lit = picture(Show::FlatMap { light, depth: FAR })?;
    let depth = -FAR;
    let mut dark = picture(Show::FlatMap { light, depth })?;
    // A comparison that is the wrong way round has them the wrong way round, too; and light makes nothing darker.
    let brightness = |pixel: &Rgb<u8>| pixel.0.map(u16::from).iter().sum::<u16>();
    for (lit, dark) in lit.pixels_mut().zip(dark.pixels_mut()) {
        if brightness(lit) < brightness(dark) {
            std::mem::swap(lit, dark);
        }
    }
    let shadows = Shadows::between(&own, &lit, &dark);
    Ok(shadows.known.contains(&true).then_some(shadows))
}
