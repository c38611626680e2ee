//! A skin over rings of points: bodies, limbs, bars and whatever else is not turned on a lathe.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

/// A closed skin over rings of equally many points, from the first pole to the last.
///
/// The points go round the way of travel as a right-handed screw turns. Normals are smooth; where a ring, or a point
/// within the rings, is given twice, there is a crease. `uv` takes row and column: row 0 is the first pole, and the
/// column after the last is the first again.
pub fn skin(poles: [DVec3; 2], rings: &[Vec<DVec3>], uv: impl Fn(usize, usize) -> DVec2) -> Mesh {
    let (columns, last) = (rings[0].len(), rings.len() + 1);
    let at = |row: usize, column: usize| match row {
        0 => poles[0],
        _ if row == last => poles[1],
        _ => rings[row - 1][column % columns],
    };
    let mut mesh = Mesh::default();
    for row in 0..=last {
        for column in 0..=columns {
            mesh.positions.push(at(row, column) + DVec3::ZERO);
            mesh.texture_coords.push(uv(row, column));
        }
    }
    let index = |row: usize, column: usize| (row * (columns + 1) + column) as u32;
    for row in 0..last {
        for column in 0..columns {
            let (a, b) = (index(row, column), index(row, column + 1));
            let (d, c) = (index(row + 1, column), index(row + 1, column + 1));
            push_face(&mut mesh, [a, b, c]);
            push_face(&mut mesh, [a, c, d]);
        }
    }
    // Both columns of the seam are one, and so are all points of a pole.
    mesh.normals = smooth_normals(&mesh, |i| {
        let (row, column) = (i / (columns + 1), i % (columns + 1));
        match row {
            0 => 0,
            _ if row == last => 1,
            _ => 2 + row * columns + column % columns,
        }
    });
    mesh
}

/// At a pole and in a crease two corners are one point: that face has no area and is left out.
fn push_face(mesh: &mut Mesh, face: [u32; 3]) {
    let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
    if a != b && b != c && c != a {
        mesh.faces.push(face);
    }
}

/// The mean normal of the faces around each point, weighted by their areas; equal `group`s are one point.
fn smooth_normals(mesh: &Mesh, group: impl Fn(usize) -> usize) -> Vec<DVec3> {
    let count = mesh.positions.len();
    let mut sums = vec![DVec3::ZERO; (0..count).map(&group).max().map_or(0, |most| most + 1)];
    for face in &mesh.faces {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        for &i in face {
            sums[group(i as usize)] += (b - a).cross(c - a);
        }
    }
    (0..count)
        .map(|i| sums[group(i)].normalize_or(DVec3::Y))
        .collect()
}

/// A tube of `sides` along a path. Each point has the two half-axes of its section: across, and towards `up`.
///
/// The first and the last point are its poles, whatever their half-axes.
pub fn tube(path: &[(DVec3, DVec2)], up: DVec3, sides: u32) -> Mesh {
    let section: Vec<DVec2> = (0..sides)
        .map(|side| DVec2::from_angle(TAU * f64::from(side) / f64::from(sides)))
        .collect();
    along(path, up, &section)
}

/// The same with a rectangular section and cut ends: all its edges are sharp.
pub fn bar(path: &[(DVec3, DVec2)], up: DVec3) -> Mesh {
    let corners = [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let section: Vec<DVec2> = corners
        .iter()
        .flat_map(|&corner| [DVec2::from(corner); 2])
        .collect();
    let mut sharp = Vec::new();
    let (first, last) = (path[0], path[path.len() - 1]);
    sharp.extend([first, first]);
    sharp.extend(path);
    sharp.extend([last, last]);
    along(&sharp, up, &section)
}

/// Sweeps a section along a path, whose repeated points keep the direction of their neighbours.
fn along(path: &[(DVec3, DVec2)], up: DVec3, section: &[DVec2]) -> Mesh {
    let last = path.len() - 1;
    let direction = |i: usize| {
        let before = path[..i].iter().rev().find(|p| p.0 != path[i].0);
        let after = path[i..].iter().find(|p| p.0 != path[i].0);
        let to = |other: Option<&(DVec3, DVec2)>| {
            other.map_or(DVec3::ZERO, |other| (other.0 - path[i].0).normalize())
        };
        (to(after) - to(before)).normalize()
    };
    let rings: Vec<Vec<DVec3>> = (1..last)
        .map(|i| {
            let (middle, half) = path[i];
            let across = up.cross(direction(i)).normalize();
            let upwards = direction(i).cross(across);
            let point = |p: &DVec2| middle + across * (half.x * p.x) + upwards * (half.y * p.y);
            section.iter().map(point).collect()
        })
        .collect();
    let columns = section.len();
    skin([path[0].0, path[last].0], &rings, |row, column| {
        DVec2::new(column as f64 / columns as f64, row as f64 / last as f64)
    })
}

/// A round-ended rod.
pub fn capsule(from: DVec3, to: DVec3, radius: f64, sides: u32) -> Mesh {
    limb(
        from,
        to,
        sides,
        &[
            (0.0, -0.71, 0.71),
            (0.0, 0.0, 1.0),
            (1.0, 0.0, 1.0),
            (1.0, 0.71, 0.71),
        ],
        radius,
    )
}

/// A rod with thick round ends, as a long bone has them.
pub fn bone(from: DVec3, to: DVec3, radius: f64, sides: u32) -> Mesh {
    let rings = [
        (0.0, -0.9, 1.1),
        (0.0, 0.0, 1.75),
        (0.1, 0.0, 1.45),
        (0.25, 0.0, 1.0),
        (0.5, 0.0, 0.9),
        (0.75, 0.0, 1.0),
        (0.9, 0.0, 1.45),
        (1.0, 0.0, 1.75),
        (1.0, 0.9, 1.1),
    ];
    limb(from, to, sides, &rings, radius)
}

/// Rings of (share of the length, radii beyond it, radii from the axis) between two poles.
fn limb(from: DVec3, to: DVec3, sides: u32, rings: &[(f64, f64, f64)], radius: f64) -> Mesh {
    let (length, way) = (from.distance(to), (to - from).normalize());
    let beyond = radius * rings.iter().fold(1.0, |most: f64, ring| most.max(ring.2));
    let mut path = vec![(from - way * beyond, DVec2::ZERO)];
    path.extend(rings.iter().map(|&(share, more, wide)| {
        let along = share * length + more * radius;
        (from + way * along, DVec2::splat(wide * radius))
    }));
    path.push((to + way * beyond, DVec2::ZERO));
    tube(&path, way.any_orthonormal_vector(), sides)
}

/// A smooth curve through a table of equally spaced values; `t` runs from 0 to 1.
pub fn curve<V>(table: &[V], t: f64) -> V
where
    V: Copy
        + std::ops::Add<Output = V>
        + std::ops::Sub<Output = V>
        + std::ops::Mul<f64, Output = V>,
{
    let last = table.len() - 1;
    let place = t.clamp(0.0, 1.0) * last as f64;
    let i = (place as usize).min(last - 1);
    let u = place - i as f64;
    let (p, q) = (table[i], table[i + 1]);
    // Beyond the ends the curve goes on as straight as it can.
    let before = if i == 0 { p - (q - p) } else { table[i - 1] };
    let after = if i + 2 > last {
        q + (q - p)
    } else {
        table[i + 2]
    };
    let (slope_p, slope_q) = ((q - before) * 0.5, (after - p) * 0.5);
    let (u2, u3) = (u * u, u * u * u);
    p * (2.0 * u3 - 3.0 * u2 + 1.0)
        + slope_p * (u3 - 2.0 * u2 + u)
        + q * (3.0 * u2 - 2.0 * u3)
        + slope_q * (u3 - u2)
}
