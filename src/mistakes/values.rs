//! What happens to a value on its way to a uniform.

use glam::{DMat4, DVec4};

use crate::gl::Value;

/// To [0,1] from the standard cube [−1,1]: T(1/2)·H(1/2).
const B: DMat4 = DMat4::from_cols(
    DVec4::new(0.5, 0.0, 0.0, 0.0),
    DVec4::new(0.0, 0.5, 0.0, 0.0),
    DVec4::new(0.0, 0.0, 0.5, 0.0),
    DVec4::new(0.5, 0.5, 0.5, 1.0),
);
/// The two factors in the wrong order: H(1/2)·T(1/2).
const B_SWAPPED: DMat4 = DMat4::from_cols(
    DVec4::new(0.5, 0.0, 0.0, 0.0),
    DVec4::new(0.0, 0.5, 0.0, 0.0),
    DVec4::new(0.0, 0.0, 0.5, 0.0),
    DVec4::new(0.25, 0.25, 0.25, 1.0),
);
/// What is too large is so by this factor: a bias,
const TOO_MUCH: f64 = 15.0;
/// the light's field of view or box; what is too small, by half of it.
const TOO_WIDE: f64 = 6.0;
const TOO_NARROW: f64 = 0.5;
/// A near plane that somebody put at "almost 0".
const TOO_NEAR: f64 = 1e-3;
/// A light that looks along the up vector by all but this makes a view matrix without a right vector.
const ALONG_UP: f64 = 1e-6;

fn matrix(value: Value, change: impl FnOnce(DMat4) -> DMat4) -> Option<Value> {
    match value {
        Value::Mat4(columns) => {
            let columns = columns.map(f64::from);
            Some(change(DMat4::from_cols_array(&columns)).into())
        }
        _ => unreachable!("an edit of a matrix is about one"),
    }
}

fn number(value: Value, change: impl FnOnce(f64) -> f64) -> Option<Value> {
    match value {
        Value::Float(number) => Some(change(number.into()).into()),
        _ => unreachable!("an edit of a number is about one"),
    }
}

pub fn never(_: Value) -> Option<Value> {
    None
}

pub fn zero(value: Value) -> Option<Value> {
    number(value, |_| 0.0)
}

pub fn too_much(value: Value) -> Option<Value> {
    number(value, |number| TOO_MUCH * number)
}

/// Of 0 and 1, the other one.
pub fn other(value: Value) -> Option<Value> {
    number(value, |number| 1.0 - number)
}

pub fn first_unit(_: Value) -> Option<Value> {
    Some(0.into())
}

pub fn transposed(value: Value) -> Option<Value> {
    matrix(value, |m| m.transpose())
}

/// A light that looks straight down or up, with an up vector that does the same.
pub fn without_right(value: Value) -> Option<Value> {
    matrix(value, |view| {
        if view.row(2).y.abs() > 1.0 - ALONG_UP {
            DMat4::NAN
        } else {
            view
        }
    })
}

pub fn unrotated(value: Value) -> Option<Value> {
    matrix(value, |model| {
        DMat4::from_translation(model.w_axis.truncate())
    })
}

// Of a matrix that ends in [0,1].

pub fn without_bias_matrix(value: Value) -> Option<Value> {
    matrix(value, |m| B.inverse() * m)
}

pub fn bias_matrix_twice(value: Value) -> Option<Value> {
    matrix(value, |m| B * m)
}

pub fn bias_matrix_swapped(value: Value) -> Option<Value> {
    matrix(value, |m| B_SWAPPED * B.inverse() * m)
}

/// The same change of the light's camera to a matrix that ends in [0,1].
macro_rules! mapped {
    ($($name:ident => $change:ident;)*) => {$(
        pub fn $name(value: Value) -> Option<Value> {
            matrix(value, |m| B * $change(B.inverse() * m))
        }
    )*};
}

macro_rules! clipped {
    ($($name:ident => $change:ident;)*) => {$(
        pub fn $name(value: Value) -> Option<Value> {
            matrix(value, $change)
        }
    )*};
}

clipped! {
    too_narrow => narrowed;
    too_wide => widened;
    too_near => brought_near;
    degrees_for_radians => in_degrees;
}

mapped! {
    mapped_too_narrow => narrowed;
    mapped_too_wide => widened;
    mapped_too_near => brought_near;
    mapped_degrees_for_radians => in_degrees;
}

fn widened(m: DMat4) -> DMat4 {
    across(m, 1.0 / TOO_WIDE)
}

fn narrowed(m: DMat4) -> DMat4 {
    across(m, 1.0 / TOO_NARROW)
}

/// Everything larger or smaller across the light's view.
fn across(m: DMat4, factor: f64) -> DMat4 {
    DMat4::from_scale(glam::DVec3::new(factor, factor, 1.0)) * m
}

/// A field of view in degrees, in a function that takes radians. Orthographic matrices have none.
fn in_degrees(m: DMat4) -> DMat4 {
    let (across_row, w_row) = (m.row(0).truncate(), m.row(3).truncate());
    if w_row.length() == 0.0 {
        return m;
    }
    let focal = across_row.length() / w_row.length();
    let half_in_degrees = (1.0 / focal).atan().to_degrees();
    across(m, 1.0 / half_in_degrees.tan() / focal)
}

/// The same far plane and a near plane much nearer. Depth and w are both linear along the axis, so that each says the
/// other: z = b − a·w.
fn brought_near(m: DMat4) -> DMat4 {
    let (z, w) = (m.row(2), m.row(3));
    let w_squared = w.truncate().length_squared();
    if w_squared == 0.0 {
        return m;
    }
    let a = -z.truncate().dot(w.truncate()) / w_squared;
    let b = z.w + a * w.w;
    let (near, far) = (b / (a - 1.0), b / (a + 1.0));
    let near = TOO_NEAR * near;
    let a = (far + near) / (near - far);
    let b = 2.0 * far * near / (near - far);
    let z = DVec4::new(0.0, 0.0, 0.0, b) - a * w;
    DMat4::from_cols(m.row(0), m.row(1), z, w).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// OpenGL's perspective matrix with a horizontal field of view in degrees and the far plane at 30, in front of a view.
    fn light(near: f64, fov: f64) -> DMat4 {
        let far = 30.0;
        let focal = 1.0 / (fov / 2.0).to_radians().tan();
        let depth = [(far + near) / (near - far), 2.0 * far * near / (near - far)];
        let perspective = DMat4::from_cols(
            DVec4::new(focal, 0.0, 0.0, 0.0),
            DVec4::new(0.0, focal, 0.0, 0.0),
            DVec4::new(0.0, 0.0, depth[0], -1.0),
            DVec4::new(0.0, 0.0, depth[1], 0.0),
        );
        let turned = DMat4::from_euler(glam::EulerRot::XYZ, 0.7, -0.4, 0.2);
        perspective * turned * DMat4::from_translation(DVec3::new(1.0, 5.0, 2.0))
    }

    fn is_near(a: DMat4, b: DMat4) {
        let largest = b
            .to_cols_array()
            .iter()
            .fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(a.abs_diff_eq(b, 1e-9 * largest), "{a}\n{b}");
    }

    #[test]
    fn a_near_plane_is_moved_and_nothing_else() {
        is_near(brought_near(light(1.0, 60.0)), light(0.001, 60.0));
    }

    #[test]
    fn a_field_of_view_in_degrees() {
        // 60° as 60 radians: 60/2 rad is 1718.87°.
        let factor = 30_f64.to_radians().tan() / 30_f64.tan();
        is_near(
            in_degrees(light(1.0, 60.0)),
            across(light(1.0, 60.0), factor),
        );
    }

    #[test]
    fn the_factors_of_the_bias_matrix() {
        let corners = |m: DMat4| [-1.0, 1.0].map(|x| m.project_point3(DVec3::splat(x)).x);
        assert_eq!(corners(B), [0.0, 1.0]);
        assert_eq!(corners(B_SWAPPED), [-0.25, 0.75]);
    }
}
