//! Section 1: the shadow projection matrix.

use glam::{DMat4, DVec3, DVec4};

/// Projects from the light onto the receiver wall Ax + By + Cz + D = 0: `plane` is (A, B, C, D).
///
/// A point P goes to where the line from the light L through it meets the wall: (plane·L) P − (plane·P) L. Its w is
/// plane·L − plane·P, how much nearer to the wall than the light it is. What lies beyond the light has w < 0 and is
/// clipped, as long as nobody divides by w before.
#[doc(alias = "multShadowMat")]
pub fn mult_shadow_mat(plane: DVec4, light_pos: DVec3) -> DMat4 {
    let light = light_pos.extend(1.0);
    let dot = plane.dot(light);
    // Column by column: dot on the diagonal, less the light's coordinates times A, B, C and D.
    DMat4::from_cols(
        dot * DVec4::X - plane.x * light,
        dot * DVec4::Y - plane.y * light,
        dot * DVec4::Z - plane.z * light,
        dot * DVec4::W - plane.w * light,
    )
}

/// The same plane after the world's origin has moved.
pub fn plane_from(origin: DVec3, plane: DVec4) -> DVec4 {
    plane.truncate().extend(plane.dot(origin.extend(1.0)))
}

#[cfg(test)]
mod tests {
    use glam::{dvec3, dvec4};

    use super::*;

    /// The projected point lies on the wall and on the line through light and point, with the sign of w.
    #[test]
    fn points_go_to_the_wall_along_their_rays() {
        let light = dvec3(0.05, 0.6, 0.2);
        for plane in [
            dvec4(0.0, 1.0, 0.0, 1.0),
            dvec4(-1.0, 0.0, 0.0, 1.0),
            dvec4(0.6, 0.0, -0.8, 2.0),
        ] {
            for point in [dvec3(0.3, 0.1, -0.4), dvec3(-0.5, 0.9, 0.2)] {
                let projected = mult_shadow_mat(plane, light) * point.extend(1.0);
                assert!(plane.dot(projected).abs() < 1e-12);
                let nearer = plane.dot(light.extend(1.0)) - plane.dot(point.extend(1.0));
                assert!((projected.w - nearer).abs() < 1e-12);
                let along = projected.truncate() / projected.w - light;
                assert!(along.cross(point - light).length() < 1e-12);
                // In front of the light or behind it.
                assert_eq!(along.dot(point - light) > 0.0, nearer > 0.0);
            }
        }
    }

    /// The control: with the other sign of the plane every true shadow has w < 0.
    #[test]
    fn a_plane_the_other_way_round_loses_the_shadow() {
        let (light, point) = (dvec3(0.05, 0.6, 0.2), DVec3::ZERO);
        let floor = dvec4(0.0, 1.0, 0.0, 1.0);
        assert!((mult_shadow_mat(floor, light) * point.extend(1.0)).w > 0.0);
        assert!((mult_shadow_mat(-floor, light) * point.extend(1.0)).w < 0.0);
    }
}
