//! How far a point is from an object.

use std::ops::Range;

use glam::DVec3;

use crate::ground_truth::Rays;

/// The triangles of a scene in clumps, of which those that are too far away are passed over whole.
pub struct Clumps(Vec<Clump>);

/// Some triangles of one object, in a row, and a ball around them.
struct Clump {
    object: u32,
    triangles: Range<u32>,
    centre: DVec3,
    radius: f64,
}

/// The most triangles of a clump: an object of 200,000 has about as many clumps then as are looked into near a point.
const MOST: usize = 64;

impl Clumps {
    pub fn new(rays: &Rays) -> Self {
        let mut clumps = Vec::new();
        let mut first = 0;
        for of_object in rays.objects.chunk_by(|a, b| a == b) {
            for part in of_object.chunks(MOST) {
                let triangles = first..first + part.len() as u32;
                first = triangles.end;
                let corners = || triangles.clone().flat_map(|t| *rays.surfaces.triangle(t));
                let centre = corners().sum::<DVec3>() / (3 * part.len()) as f64;
                let radius = corners().map(|corner| corner.distance(centre));
                clumps.push(Clump {
                    object: part[0],
                    radius: radius.fold(0.0, f64::max),
                    triangles,
                    centre,
                });
            }
        }
        Self(clumps)
    }

    /// From a point of one triangle to the nearest other one of an object.
    pub fn distance(&self, point: DVec3, own: u32, object: u32, rays: &Rays) -> f64 {
        let distance = |t: u32| distance_to_triangle(point, rays.surfaces.triangle(t));
        let of_object = self.0.iter().filter(|clump| clump.object == object);
        let mut nearest = f64::INFINITY;
        for clump in of_object {
            if point.distance(clump.centre) - clump.radius < nearest {
                let others = clump.triangles.clone().filter(|t| *t != own);
                nearest = others.map(distance).fold(nearest, f64::min);
            }
        }
        nearest
    }
}

/// From a point to the nearest point of a triangle: Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
fn distance_to_triangle(point: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let (ab, ac) = (*b - *a, *c - *a);
    let normal = ab.cross(ac);
    let to_segment = |from: DVec3, to: DVec3| {
        let along = to - from;
        let t = (point - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        point.distance(from + t.clamp(0.0, 1.0) * along)
    };
    // Above the triangle: on the inner side of all three edges.
    let inside = [(*a, *b), (*b, *c), (*c, *a)]
        .iter()
        .all(|(from, to)| (*to - *from).cross(point - *from).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO {
        return (point - *a).dot(normal.normalize()).abs();
    }
    to_segment(*a, *b)
        .min(to_segment(*b, *c))
        .min(to_segment(*c, *a))
}
