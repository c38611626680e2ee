//! The shadows of a shader that has its shadow test and its lighting in one: read from three of its pictures.

use image::GrayImage;

use crate::compare::Shadows;
use crate::headless::Headless;
use crate::labs::{Lab, Show};
use crate::{Result, gl};

/// A depth that is behind, or with a minus before, everything that a map can show.
const FAR: f32 = 1e9;

/// Where the light (from 1) arrives, by the present test, whoever wrote it: 255 lit, 0 in shadow. The frame's own picture
/// stands between that with a map in which nothing casts a shadow and that with a map in which everything is in shadow.
///
/// In a picture a shadow is to be read only where the light changes it: not where it does not reach. There the visibility
/// is 255 and not `known`.
pub fn visibility(
    lab: &mut dyn Lab,
    context: &Headless,
    size: [u32; 2],
    light: usize,
) -> Result<Shadows> {
    let gl = &context.gl;
    if !lab.has_students_test() {
        lab.render(gl, Show::Visibility { light })?;
        let visibility: GrayImage = gl::read_grey(gl, size);
        let known = vec![true; visibility.len()];
        return Ok(Shadows { visibility, known });
    }
    let mut picture = |show| -> Result<_> {
        lab.render(gl, show)?;
        Ok(gl::read_rgb(gl, size))
    };
    let own = picture(Show::Picture)?;
    let lit = picture(Show::FlatMap { light, depth: FAR })?;
    let depth = -FAR;
    let dark = picture(Show::FlatMap { light, depth })?;
    Ok(Shadows::between(&own, &lit, &dark))
}
