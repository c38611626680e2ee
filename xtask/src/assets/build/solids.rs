//! Solids about the y axis, and boxes.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2, DVec3};
use shadowlab::scene::{Mesh, shapes};

/// A ball about the y axis, its middle at the height `middle`.
pub fn ball(middle: f64, radius: f64, slices: u32) -> Mesh {
    let stacks = slices / 2;
    let profile: Vec<[f64; 2]> = (0..=stacks)
        .map(|stack| {
            let latitude = PI * (f64::from(stack) / f64::from(stacks) - 0.5);
            // The poles are on the axis exactly.
            let inside = stack > 0 && stack < stacks;
            let from_axis = if inside { radius * latitude.cos() } else { 0.0 };
            [from_axis, middle + radius * latitude.sin()]
        })
        .collect();
    turned(&profile, Ends::OnAxis, slices)
}

pub fn cylinder(radius: f64, bottom: f64, top: f64, slices: u32) -> Mesh {
    let profile = [[0.0, bottom], [radius, bottom], [radius, top], [0.0, top]];
    turned(&profile, Ends::OnAxis, slices)
}

/// A ring of rectangular section.
pub fn ring(inner: f64, outer: f64, bottom: f64, top: f64, slices: u32) -> Mesh {
    let section = [[inner, bottom], [outer, bottom], [outer, top], [inner, top]];
    turned(&section, Ends::Joined, slices)
}

/// One solid at each of `count` places around the axis, turned to face outwards.
pub fn around(count: u32, radius: f64, solid: impl Fn(DVec3, f64) -> Mesh) -> Vec<Mesh> {
    let placed = |i: u32| {
        let degrees = 360.0 * (f64::from(i) + 0.5) / f64::from(count);
        let place = DQuat::from_rotation_y(degrees.to_radians()) * DVec3::new(0.0, 0.0, radius);
        solid(place, degrees)
    };
    (0..count).map(placed).collect()
}

/// A box, turned about its own vertical axis.
pub fn boxed(size: DVec3, middle: DVec3, degrees: f64) -> Mesh {
    let turn = DQuat::from_rotation_y(degrees.to_radians());
    let mut mesh = shapes::cube();
    for position in &mut mesh.positions {
        *position = middle + turn * (*position * size);
    }
    for normal in &mut mesh.normals {
        *normal = turn * *normal;
    }
    mesh
}

#[derive(Clone, Copy, PartialEq)]
pub enum Ends {
    /// The profile starts and ends on the axis.
    OnAxis,
    /// The last point leads back to the first.
    Joined,
}

/// Turns a profile of radius and height about the y axis.
///
/// The profile goes up where it faces outwards. A bend of less than 40° is smooth.
pub fn turned(profile: &[[f64; 2]], ends: Ends, slices: u32) -> Mesh {
    let points: Vec<DVec2> = profile.iter().copied().map(DVec2::from).collect();
    let count = points.len();
    let segments = if ends == Ends::Joined {
        count
    } else {
        count - 1
    };
    let facing = |segment: usize| {
        let along = points[(segment + 1) % count] - points[segment];
        DVec2::new(along.y, -along.x).normalize()
    };
    // A segment's normal at one of its ends is shared with its neighbour there, if the bend is smooth.
    let shared = |segment: usize, neighbour: Option<usize>| {
        let (own, other) = (facing(segment), neighbour.map(facing));
        match other {
            Some(other) if own.dot(other) > 40_f64.to_radians().cos() => (own + other).normalize(),
            _ => own,
        }
    };
    let (low, high) = (
        points[0].y,
        points.iter().fold(points[0].y, |y, p| y.max(p.y)),
    );
    let mut mesh = Mesh::default();
    for segment in 0..segments {
        let joined = ends == Ends::Joined;
        let before = (joined || segment > 0).then(|| (segment + segments - 1) % segments);
        let after = (joined || segment + 1 < segments).then(|| (segment + 1) % segments);
        let rows = [
            (points[segment], shared(segment, before)),
            (points[(segment + 1) % count], shared(segment, after)),
        ];
        let first = mesh.positions.len() as u32;
        for (point, normal) in rows {
            for slice in 0..=slices {
                // The last column is the first again, to the last bit.
                let angle = TAU * f64::from(slice % slices) / f64::from(slices);
                let outwards = DVec3::new(-angle.cos(), 0.0, angle.sin());
                mesh.positions.push(outwards * point.x + DVec3::Y * point.y);
                mesh.normals.push(outwards * normal.x + DVec3::Y * normal.y);
                let up = (point.y - low) / (high - low);
                mesh.texture_coords
                    .push(DVec2::new(f64::from(slice) / f64::from(slices), up));
            }
        }
        for slice in 0..slices {
            let a = first + slice;
            let (b, d) = (a + 1, a + slices + 1);
            let c = d + 1;
            // On the axis a quad is a triangle.
            if rows[0].0.x > 0.0 {
                mesh.faces.push([a, b, c]);
            }
            if rows[1].0.x > 0.0 {
                mesh.faces.push([a, c, d]);
            }
        }
    }
    mesh
}
