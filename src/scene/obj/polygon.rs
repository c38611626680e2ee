//! Faces of more than three corners, cut into triangles.

use glam::{DVec2, DVec3};

/// Cutting ears takes up to the cube of the number of corners; a face of more is taken for convex.
const MOST_CORNERS: usize = 100;

/// The triangles of a face, as indices of its corners.
pub fn triangles(points: &[DVec3], triangles: &mut Vec<[usize; 3]>) {
    triangles.clear();
    if points.len() > 3 && points.len() <= MOST_CORNERS {
        let flat = flattened(points);
        if !is_convex(&flat) {
            return cut_ears(&flat, triangles);
        }
    }
    triangles.extend((2..points.len()).map(|i| [0, i - 1, i]));
}

/// The corners seen along the face's normal, counter-clockwise.
fn flattened(points: &[DVec3]) -> Vec<DVec2> {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    // Newell's normal: right for faces that are not quite flat, and the longest for those that are.
    let normal: DVec3 = edges
        .map(|(a, b)| (a - points[0]).cross(b - points[0]))
        .sum();
    let Some(normal) = normal.try_normalize() else {
        return vec![DVec2::ZERO; points.len()];
    };
    let (right, up) = normal.any_orthonormal_pair();
    let seen = |point: &DVec3| {
        let offset = point - points[0];
        DVec2::new(offset.dot(right), offset.dot(up))
    };
    let mut flat: Vec<DVec2> = points.iter().map(seen).collect();
    let edges = flat.iter().zip(flat.iter().cycle().skip(1));
    if edges.map(|(a, b)| a.perp_dot(*b)).sum::<f64>() < 0.0 {
        flat.iter_mut().for_each(|point| point.x = -point.x);
    }
    flat
}

/// Twice the area of a triangle, negative if it is clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

fn is_convex(points: &[DVec2]) -> bool {
    let count = points.len();
    let size = points
        .iter()
        .map(|p| p.length_squared())
        .fold(0.0, f64::max);
    // Three corners on a line may seem to turn the other way by the last bits.
    let straight = -1e-9 * size;
    (0..count)
        .all(|i| turn(points[i], points[(i + 1) % count], points[(i + 2) % count]) >= straight)
}

/// Cuts off one corner after the other whose triangle has no other corner in it.
fn cut_ears(points: &[DVec2], triangles: &mut Vec<[usize; 3]>) {
    let mut left: Vec<usize> = (0..points.len()).collect();
    while left.len() > 3 {
        let count = left.len();
        let corner = |i: usize| {
            [
                left[(i + count - 1) % count],
                left[i],
                left[(i + 1) % count],
            ]
        };
        let is_ear = |i: &usize| {
            let ear = corner(*i);
            let [a, b, c] = ear.map(|index| points[index]);
            let inside = |index: &usize| {
                let p = points[*index];
                !ear.contains(index)
                    && turn(a, b, p) >= 0.0
                    && turn(b, c, p) >= 0.0
                    && turn(c, a, p) >= 0.0
            };
            turn(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // A face that crosses itself may have none: then any corner will do.
        let ear = (0..count).find(is_ear).unwrap_or(0);
        triangles.push(corner(ear));
        left.remove(ear);
    }
    triangles.push([left[0], left[1], left[2]]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f64; 2]]) -> Vec<[usize; 3]> {
        // Tilted, so that the normal is no axis.
        let tilted = |&[x, y]: &[f64; 2]| DVec3::new(x, y, 0.5 * x - 2.0 * y);
        let points: Vec<DVec3> = points.iter().map(tilted).collect();
        let mut found = Vec::new();
        triangles(&points, &mut found);
        found
    }

    fn area(points: &[[f64; 2]], [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|i| DVec2::from_array(points[i]));
        turn(a, b, c) / 2.0
    }

    #[test]
    fn a_convex_face_is_a_fan() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    /// An L and an arrow: no triangle is turned over, and together they have the face's area.
    #[test]
    fn a_hollow_face_keeps_its_hollow() {
        let l = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        let arrow = [[1.0, 0.3], [2.0, 0.0], [1.0, 2.0], [0.0, 0.0]];
        for (points, expected) in [(&l[..], 3.0), (&arrow[..], 1.7)] {
            for first in 0..points.len() {
                let mut points = points.to_vec();
                points.rotate_left(first);
                let areas: Vec<f64> = cut(&points).iter().map(|t| area(&points, *t)).collect();
                assert_eq!(areas.len(), points.len() - 2);
                assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
                assert!((areas.iter().sum::<f64>() - expected).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_face_without_area_is_cut_too() {
        assert_eq!(cut(&[[0.0; 2]; 5]).len(), 3);
        assert_eq!(
            cut(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [1.0, 1.0]]).len(),
            2
        );
        // One that crosses itself.
        assert_eq!(
            cut(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]).len(),
            2
        );
    }
}
