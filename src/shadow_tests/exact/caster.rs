//! A triangle as what a ray is tested against.

use glam::DVec3;

use crate::shadow_tests::space::Rays;

/// A triangle is seen edge-on by the light, and casts nothing, where its plane passes the light nearer than this, as a
/// share of its distance: some thousand times what f64 rounds.
const EDGE_ON: f64 = 1e-12;
/// How far behind a triangle its shadow begins, as a share of the way from the light (of the scene's size where rays are
/// parallel): 16 times what f32 rounds, since a ray and its product with the plane make some ten roundings.
const TOLERANCE: f64 = 1e-6;

/// A triangle that casts, in the light's space.
#[derive(Clone, Copy, Debug)]
pub struct Caster {
    pub corners: [DVec3; 3],
    /// Planes through the light and an edge each; the triangle is on the positive side. Two triangles that share an edge
    /// have the same plane to the last bit, but for its sign: a ray passes one of them on its positive side.
    pub edges: [DVec3; 3],
    /// plane · through(point) is 1 on the triangle's plane, and more behind it. Where rays are parallel it is the plane's
    /// z above a point.
    pub plane: DVec3,
    /// How far behind the plane the shadow begins.
    pub tolerance: f64,
    /// What rounding may add to plane · through(point) anywhere on the triangle.
    pub rounding: f64,
    pub faces_light: bool,
}

/// How far a triangle's normal points the way that the rays go, in whatever unit: negative where it faces the light.
fn along(rays: Rays, normal: DVec3, corner: DVec3) -> f64 {
    match rays {
        Rays::Spot | Rays::Point => normal.dot(corner),
        Rays::Parallel => -normal.z,
    }
}

pub fn faces_light(rays: Rays, [a, b, c]: [DVec3; 3]) -> bool {
    along(rays, (b - a).cross(c - a), a) < 0.0
}

impl Caster {
    /// None where the light sees the triangle edge-on, or it has no area.
    pub fn new(rays: Rays, corners: [DVec3; 3], closed: bool) -> Option<Self> {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let along = along(rays, normal, a);
        let distance = match rays {
            Rays::Spot | Rays::Point => a.length(),
            Rays::Parallel => 1.0,
        };
        if along.abs() <= EDGE_ON * normal.length() * distance {
            return None;
        }
        let plane = match rays {
            Rays::Spot | Rays::Point => normal / along,
            Rays::Parallel => DVec3::new(normal.x, normal.y, normal.dot(a)) / along,
        };
        let through = corners.map(|corner| rays.through(corner));
        let largest_terms = through.map(|h| (plane * h).abs().element_sum());
        let largest_terms = largest_terms.into_iter().fold(0.0, f64::max);
        let rounding = TOLERANCE
            * match rays {
                Rays::Spot | Rays::Point => largest_terms,
                Rays::Parallel => 1.0 + largest_terms,
            };
        let [a, b, c] = through;
        let sign = along.signum();
        Some(Self {
            corners,
            edges: [a.cross(b), b.cross(c), c.cross(a)].map(|edge| sign * edge),
            plane,
            // On a closed surface a lit point has no caster beside it: only what faces away casts. On an open one its
            // neighbours cast too, and shadow it as soon as rounding puts it behind their planes.
            tolerance: if closed { TOLERANCE } else { rounding },
            rounding,
            faces_light: along < 0.0,
        })
    }

    /// Whether a point is behind the triangle's plane, as far as the test can tell.
    pub fn is_before(&self, rays: Rays, point: DVec3) -> bool {
        let product = self.plane.dot(rays.through(point));
        match rays {
            Rays::Spot | Rays::Point => product > 1.0 + self.tolerance,
            Rays::Parallel => product - self.tolerance > point.z,
        }
    }

    /// The plane with its tolerance in it, as the shader has it.
    pub fn shifted_plane(&self, rays: Rays) -> DVec3 {
        match rays {
            Rays::Spot | Rays::Point => self.plane / (1.0 + self.tolerance),
            Rays::Parallel => self.plane + DVec3::new(0.0, 0.0, self.tolerance),
        }
    }
}
