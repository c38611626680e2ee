//! A triangle as what a ray is tested against.

use glam::DVec3;

use crate::shadow_tests::polygon::larger;
use crate::shadow_tests::space::Rays;

/// A triangle is seen edge-on by the light, and casts nothing, where its plane passes the light nearer than this, as a
/// share of its distance: some thousand times what f64 rounds.
const EDGE_ON: f64 = 1e-12;
/// How far behind a triangle its shadow begins, as a share of the way from the light (of the scene's size where rays are
/// parallel): 16 times what f32 rounds, since a ray and its product with the plane make some ten roundings.
const TOLERANCE: f64 = 1e-6;

/// A triangle that casts, in the light's space.
#[derive(Clone, Copy, Debug, Default)]
pub struct Caster {
    pub faces_light: bool,
    /// plane · through(point) is 1 on the triangle's plane, and more behind it. Where rays are parallel it is the plane's
    /// z above a point.
    pub plane: DVec3,
    /// The same with a tolerance: where the shadow begins.
    pub shifted: DVec3,
    /// What rounding may add to plane · through(point) anywhere on the triangle.
    pub rounding: f64,
}

/// How far a triangle's normal points the way that the rays go, in whatever unit: negative where it faces the light.
fn along(rays: Rays, normal: DVec3, corner: DVec3) -> f64 {
    match rays {
        Rays::Spot | Rays::Point => normal.dot(corner),
        Rays::Parallel => -normal.z,
    }
}

impl Caster {
    /// None where the light sees the triangle edge-on, or it has no area, or it is a closed surface's side that faces the
    /// light: between its two ends a ray that meets a closed surface leaves it again, through a face that faces away. Of
    /// an open surface every face casts, whichever way it is turned.
    pub fn new(rays: Rays, corners: [DVec3; 3], closed: bool) -> Option<Self> {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let along = along(rays, normal, a);
        let faces_light = along < 0.0;
        if closed && faces_light {
            return None;
        }
        let distance_squared = match rays {
            Rays::Spot | Rays::Point => a.length_squared(),
            Rays::Parallel => 1.0,
        };
        if along * along <= EDGE_ON * EDGE_ON * normal.length_squared() * distance_squared {
            return None;
        }
        let plane = match rays {
            Rays::Spot | Rays::Point => normal,
            Rays::Parallel => DVec3::new(normal.x, normal.y, normal.dot(a)),
        };
        let plane = plane * along.recip();
        let terms = |p: DVec3| (plane * rays.through(p)).abs().element_sum();
        let largest_terms = larger(terms(a), larger(terms(b), terms(c)));
        let rounding = TOLERANCE
            * match rays {
                Rays::Spot | Rays::Point => largest_terms,
                Rays::Parallel => 1.0 + largest_terms,
            };
        // On a closed surface a lit point has no caster beside it: only what faces away casts. On an open one its
        // neighbours cast too, and shadow it as soon as rounding puts it behind their planes.
        let tolerance = if closed { TOLERANCE } else { rounding };
        let shifted = match rays {
            Rays::Spot | Rays::Point => plane * (1.0 + tolerance).recip(),
            Rays::Parallel => plane + DVec3::new(0.0, 0.0, tolerance),
        };
        Some(Self {
            faces_light,
            plane,
            shifted,
            rounding,
        })
    }

    /// Planes through the light and an edge each; the triangle is on the positive side. Two triangles that share an edge
    /// have the same plane to the last bit, but for its sign: a ray passes one of them on its positive side.
    pub fn edges(&self, rays: Rays, corners: [DVec3; 3]) -> [DVec3; 3] {
        let [a, b, c] = corners;
        let [a, b, c] = [rays.through(a), rays.through(b), rays.through(c)];
        let sign = if self.faces_light { -1.0 } else { 1.0 };
        [sign * a.cross(b), sign * b.cross(c), sign * c.cross(a)]
    }

    /// Whether a point is behind the triangle's plane, as far as the test can tell.
    pub fn is_before(&self, rays: Rays, point: DVec3) -> bool {
        let product = self.shifted.dot(rays.through(point));
        match rays {
            Rays::Spot | Rays::Point => product > 1.0,
            Rays::Parallel => product > point.z,
        }
    }
}
