//! The course's meshes: `Plane`, `Sphere`, `Torus`, `Cube`, and the teapot.
//!
//! `mesh_size` says how finely a curved shape is cut; the demos of the course use 20.
//! Every face has an area: where the corners of a grid meet in a pole, one triangle is left out.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::Mesh;

/// [−1, 1]² at z = 0 with the normal +z: (n+1)² vertices and 2n² faces.
#[doc(alias = "Plane")]
pub fn plane(mesh_size: u32) -> Mesh {
    grid(mesh_size, mesh_size, |row, column| {
        let st = DVec2::new(f64::from(column), f64::from(row)) / f64::from(mesh_size);
        let position = (2.0 * st - DVec2::ONE).extend(0.0);
        (position, DVec3::Z, st)
    })
}

/// Unit radius, poles on z: 2n slices and n stacks. Needs at least 2 stacks to enclose a volume.
#[doc(alias = "Sphere")]
pub fn sphere(mesh_size: u32) -> Mesh {
    assert!(mesh_size >= 2, "a sphere of {mesh_size} stacks is flat");
    let (stacks, slices) = (mesh_size, 2 * mesh_size);
    grid(stacks, slices, |stack, slice| {
        let latitude = PI * (f64::from(stack) / f64::from(stacks) - 0.5);
        // A pole is on the axis exactly, whatever the cosine of π/2 is in floating point.
        let (normal, middle) = match stack {
            0 => (DVec3::NEG_Z, -0.5),
            _ if stack == stacks => (DVec3::Z, 0.5),
            _ => {
                let around = on_circle(slice, slices) * latitude.cos();
                (around.extend(latitude.sin()), 0.0)
            }
        };
        // Each slice has its own pole vertex: its texture coordinate is the middle of the slice.
        let s = (f64::from(slice) + middle) / f64::from(slices);
        let t = f64::from(stack) / f64::from(stacks);
        (normal, normal, DVec2::new(s, t))
    })
}

/// A ring about z of outer radius 1: R = 1/(1+t) to the middle of the tube, which has the radius tR.
///
/// 2n slices about the axis and n about the tube, at least 3.
#[doc(alias = "Torus")]
pub fn torus(thickness: f64, mesh_size: u32) -> Mesh {
    let major = 1.0 / (1.0 + thickness);
    ring(thickness * major, major, mesh_size, 2 * mesh_size)
}

/// A ring about z: `sides` about the tube of radius `minor`, `rings` about the axis at the distance `major`.
#[doc(alias = "glutSolidTorus")]
pub fn ring(minor: f64, major: f64, sides: u32, rings: u32) -> Mesh {
    assert!(sides >= 3, "a tube of {sides} sides is flat");
    grid(sides, rings, |side, slice| {
        let (tube, around) = (on_circle(side, sides), on_circle(slice, rings));
        let position = (around * (major + minor * tube.x)).extend(minor * tube.y);
        let normal = (around * tube.x).extend(tube.y);
        let st = DVec2::new(
            f64::from(slice) / f64::from(rings),
            f64::from(side) / f64::from(sides),
        );
        (position, normal, st)
    })
}

/// Edge 1, centred at the origin: each side has its own four vertices and the whole picture.
#[doc(alias = "Cube")]
pub fn cube() -> Mesh {
    let mut mesh = Mesh::default();
    for (normal, right) in [
        (DVec3::X, DVec3::NEG_Z),
        (DVec3::NEG_X, DVec3::Z),
        (DVec3::Y, DVec3::X),
        (DVec3::NEG_Y, DVec3::X),
        (DVec3::Z, DVec3::X),
        (DVec3::NEG_Z, DVec3::NEG_X),
    ] {
        let up = normal.cross(right);
        let side = grid(1, 1, |row, column| {
            let st = DVec2::new(f64::from(column), f64::from(row));
            let position = 0.5 * normal + (st.x - 0.5) * right + (st.y - 0.5) * up;
            (position, normal, st)
        });
        append(&mut mesh, side);
    }
    mesh
}

/// Martin Newell's teapot in its own units, each of its 32 Bézier patches cut into n × n.
///
/// The axis is z, the base is at z = 0, the spout points to +x. It fills
/// [−3, 3.434] × [−2, 2] × [0, 3.15]. Every patch has the whole picture.
/// As in the original, the spout is an open tube, and handle and spout go through the wall of the body.
/// Below a `mesh_size` of 6 the rolled lip of the spout is too coarse for a few of its normals.
#[doc(alias = "Teapot")]
pub fn teapot(mesh_size: u32) -> Mesh {
    let turned = TEAPOT_PROFILES.iter().flat_map(quarters);
    let tubes = TEAPOT_TUBES.iter().flat_map(halves);
    let mut mesh = Mesh::default();
    for patch in turned.chain(tubes) {
        append(&mut mesh, bezier_patch(&patch, mesh_size));
    }
    mesh
}

/// The cosine and sine of step `i` of `n`. Step n is step 0, to the last bit: no seam opens.
fn on_circle(i: u32, n: u32) -> DVec2 {
    DVec2::from_angle(TAU * f64::from(i % n) / f64::from(n))
}

/// Position, normal, texture coordinate.
type Vertex = (DVec3, DVec3, DVec2);

/// A grid of quads, each cut in two; counter-clockwise where columns go right and rows go up.
fn grid(rows: u32, columns: u32, vertex: impl Fn(u32, u32) -> Vertex) -> Mesh {
    assert!(rows > 0 && columns > 0, "a mesh of no faces");
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let (position, normal, texture_coord) = vertex(row, column);
            // Adding 0 makes −0 into 0: equal positions are then equal bit for bit.
            mesh.positions.push(position + DVec3::ZERO);
            mesh.normals.push(normal);
            mesh.texture_coords.push(texture_coord);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let (b, d) = (a + 1, a + columns + 1);
            let c = d + 1;
            push_face(&mut mesh, [a, b, c]);
            push_face(&mut mesh, [a, c, d]);
        }
    }
    mesh
}

/// At a pole two corners are one point: that face has no area and is left out.
fn push_face(mesh: &mut Mesh, face: [u32; 3]) {
    let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
    if a != b && b != c && c != a {
        mesh.faces.push(face);
    }
}

fn append(mesh: &mut Mesh, other: Mesh) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(other.positions);
    mesh.normals.extend(other.normals);
    mesh.texture_coords.extend(other.texture_coords);
    let moved = other.faces.iter().map(|face| face.map(|i| first + i));
    mesh.faces.extend(moved);
}

/// Four rows of four control points. Columns go right and rows go up, seen from outside.
type Patch = [[DVec3; 4]; 4];

/// Rim, body, lid and bottom have four quarters: each is a profile turned about z.
///
/// A control point of a profile is its radius, the length of the handle that bends the arc, and z.
/// Profiles go from the bottom up on the outside, and then inwards.
const TEAPOT_PROFILES: [[[f64; 3]; 4]; 6] = [
    // Bottom.
    [
        [0.0, 0.0, 0.0],
        [1.425, 0.798, 0.0],
        [1.5, 0.84, 0.075],
        [1.5, 0.84, 0.15],
    ],
    // Body, lower and upper half.
    [
        [1.5, 0.84, 0.15],
        [1.5, 0.84, 0.225],
        [2.0, 1.12, 0.45],
        [2.0, 1.12, 0.9],
    ],
    [
        [2.0, 1.12, 0.9],
        [2.0, 1.12, 1.35],
        [1.75, 0.98, 1.875],
        [1.5, 0.84, 2.4],
    ],
    // Rim.
    [
        [1.5, 0.84, 2.4],
        [1.4375, 0.805, 2.53125],
        [1.3375, 0.749, 2.53125],
        [1.4, 0.784, 2.4],
    ],
    // Lid and its knob.
    [
        [1.3, 0.728, 2.4],
        [1.3, 0.728, 2.55],
        [0.4, 0.224, 2.55],
        [0.2, 0.112, 2.7],
    ],
    [
        [0.2, 0.112, 2.7],
        [0.0, 0.0, 2.85],
        [0.8, 0.45, 3.15],
        [0.0, 0.0, 3.15],
    ],
];

/// Handle and spout have two halves, mirror images in y: each is a row of flat rings.
///
/// A ring is x and z of the side towards the pot's axis or lid, x and z of the side away, half its width.
const TEAPOT_TUBES: [[[f64; 5]; 4]; 4] = [
    // Handle, upper and lower half.
    [
        [-1.6, 2.025, -1.5, 2.25, 0.3],
        [-2.3, 2.025, -2.5, 2.25, 0.3],
        [-2.7, 2.025, -3.0, 2.25, 0.3],
        [-2.7, 1.8, -3.0, 1.8, 0.3],
    ],
    [
        [-2.7, 1.8, -3.0, 1.8, 0.3],
        [-2.7, 1.575, -3.0, 1.35, 0.3],
        [-2.5, 1.125, -2.65, 0.9375, 0.3],
        [-2.0, 0.9, -1.9, 0.6, 0.3],
    ],
    // Spout, from the body to the lip.
    [
        [1.7, 1.425, 1.7, 0.6, 0.66],
        [2.6, 1.425, 3.1, 0.825, 0.66],
        [2.3, 2.1, 2.4, 2.025, 0.25],
        [2.7, 2.4, 3.3, 2.4, 0.25],
    ],
    [
        [2.7, 2.4, 3.3, 2.4, 0.25],
        [2.8, 2.475, 3.525, 2.49375, 0.25],
        [2.9, 2.475, 3.45, 2.5125, 0.15],
        [2.8, 2.4, 3.2, 2.4, 0.15],
    ],
];

/// A profile as the four quarters of a turn about z.
fn quarters(profile: &[[f64; 3]; 4]) -> [Patch; 4] {
    let quarter = profile.map(|[radius, handle, z]| {
        [
            DVec3::new(radius, 0.0, z),
            DVec3::new(radius, handle, z),
            DVec3::new(handle, radius, z),
            DVec3::new(0.0, radius, z),
        ]
    });
    // A quarter turn swaps x and y and one sign: the seams agree exactly.
    let turn = |patch: Patch| patch.map(|row| row.map(|p| DVec3::new(-p.y, p.x, p.z)));
    let (second, third) = (turn(quarter), turn(turn(quarter)));
    [quarter, second, third, turn(third)]
}

/// A tube as its half at y ≤ 0 and its half at y ≥ 0.
fn halves(tube: &[[f64; 5]; 4]) -> [Patch; 2] {
    let half = |side: f64| {
        tube.map(|[near_x, near_z, far_x, far_z, width]| {
            [
                DVec3::new(near_x, 0.0, near_z),
                DVec3::new(near_x, side * width, near_z),
                DVec3::new(far_x, side * width, far_z),
                DVec3::new(far_x, 0.0, far_z),
            ]
        })
    };
    // A mirror image turns inside out; with its columns the other way round it faces outside again.
    let mut mirrored = half(1.0);
    mirrored.iter_mut().for_each(|row| row.reverse());
    [half(-1.0), mirrored]
}

fn bezier_patch(patch: &Patch, mesh_size: u32) -> Mesh {
    grid(mesh_size, mesh_size, |row, column| {
        let s = f64::from(column) / f64::from(mesh_size);
        let t = f64::from(row) / f64::from(mesh_size);
        let at = |in_s: fn(f64) -> [f64; 4], in_t: fn(f64) -> [f64; 4]| {
            weighted(in_t(t), patch.map(|row| weighted(in_s(s), row)))
        };
        let (mut position, mut along_s) =
            (at(bernstein, bernstein), at(bernstein_slope, bernstein));
        // At a pole the row is one point, and its derivative vanishes. The limit of its direction,
        // coming from inside the patch, is that of the mixed derivative.
        if along_s.length() < 1e-9 {
            let (pole, inwards) = if row == 0 {
                (patch[0], 1.0)
            } else {
                (patch[3], -1.0)
            };
            position = pole[0];
            along_s = inwards * at(bernstein_slope, bernstein_slope);
        }
        let along_t = at(bernstein, bernstein_slope);
        (
            position,
            along_s.cross(along_t).normalize(),
            DVec2::new(s, t),
        )
    })
}

fn weighted(weights: [f64; 4], points: [DVec3; 4]) -> DVec3 {
    (0..4).map(|i| weights[i] * points[i]).sum()
}

/// The four cubic Bernstein polynomials.
fn bernstein(t: f64) -> [f64; 4] {
    let r = 1.0 - t;
    [r * r * r, 3.0 * r * r * t, 3.0 * r * t * t, t * t * t]
}

/// Their derivatives.
fn bernstein_slope(t: f64) -> [f64; 4] {
    let r = 1.0 - t;
    let (first, second, third) = (3.0 * r * r, 6.0 * r * t, 3.0 * t * t);
    [-first, first - second, second - third, third]
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    fn all() -> Vec<(&'static str, Mesh)> {
        let mut shapes = vec![("cube", cube()), ("plane 1", plane(1))];
        for n in [3, 7, 20] {
            shapes.push(("plane", plane(n)));
            shapes.push(("sphere", sphere(n)));
            shapes.push(("torus", torus(0.5, n)));
            shapes.push(("teapot", teapot(n.max(6))));
        }
        shapes
    }

    /// The faces whose own normal points away from a normal of one of its vertices, or that have none.
    fn turned_away(mesh: &Mesh) -> usize {
        let against = |face: &&[u32; 3]| {
            let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
            let normal = (b - a).cross(c - a);
            // Written so that NaN counts as wrong.
            !face
                .iter()
                .all(|&i| normal.dot(mesh.normals[i as usize]) > 0.0)
        };
        mesh.faces.iter().filter(against).count()
    }

    /// The directed edges that do not occur once, or whose other direction does not.
    fn open_edges(mesh: &Mesh) -> usize {
        let mut edges = HashMap::new();
        for face in &mesh.faces {
            let corners = face.map(|i| mesh.positions[i as usize].to_array().map(f64::to_bits));
            for i in 0..3 {
                *edges.entry([corners[i], corners[(i + 1) % 3]]).or_insert(0) += 1;
            }
        }
        let open = |(edge, count): &(&[[u64; 3]; 2], &i32)| {
            **count != 1 || edges.get(&[edge[1], edge[0]]) != Some(&1)
        };
        edges.iter().filter(open).count()
    }

    fn counts(mesh: &Mesh) -> (usize, usize) {
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert_eq!(mesh.positions.len(), mesh.texture_coords.len());
        (mesh.positions.len(), mesh.faces.len())
    }

    #[test]
    fn the_counts_are_those_of_the_course() {
        for n in [3_usize, 20] {
            let size = n as u32;
            let rings = (n + 1) * (2 * n + 1);
            assert_eq!(counts(&plane(size)), ((n + 1) * (n + 1), 2 * n * n));
            // One triangle a slice at either pole instead of two.
            assert_eq!(counts(&sphere(size)), (rings, 4 * n * n - 4 * n));
            assert_eq!(counts(&torus(0.5, size)), (rings, 4 * n * n));
            // The tip of the knob and the middle of the bottom are poles of four patches each.
            let patches = (32 * (n + 1) * (n + 1), 32 * 2 * n * n - 8 * n);
            assert_eq!(counts(&teapot(size)), patches);
        }
        assert_eq!(counts(&cube()), (24, 12));
    }

    #[test]
    fn faces_and_normals_agree() {
        for (name, mesh) in all() {
            assert_eq!(turned_away(&mesh), 0, "{name}");
        }
    }

    /// The control: one face the other way round is found, by its normals and by its three edges.
    #[test]
    fn a_flipped_face_is_noticed() {
        for (name, mut mesh) in all() {
            let middle = mesh.faces.len() / 2;
            mesh.faces[middle].swap(0, 1);
            assert_eq!(turned_away(&mesh), 1, "{name}");
        }
        let mut mesh = torus(0.5, 5);
        mesh.faces[7].swap(0, 1);
        assert!(open_edges(&mesh) >= 3);
    }

    #[test]
    fn normals_have_length_one() {
        for (name, mesh) in all() {
            let off = |normal: &DVec3| (normal.length() - 1.0).abs();
            let worst = mesh.normals.iter().map(off).fold(0.0, f64::max);
            assert!(worst < 1e-12, "{name}: {worst}");
        }
    }

    #[test]
    fn texture_coordinates_stay_on_the_picture() {
        for (name, mesh) in all() {
            for st in &mesh.texture_coords {
                // Pole vertices of the first and last slice that no face uses lie half a slice outside.
                let slack = if name == "sphere" { 0.5 / 6.0 } else { 0.0 };
                assert!(st.min_element() >= -slack && st.max_element() <= 1.0 + slack);
            }
        }
    }

    #[test]
    fn closed_shapes_are_closed() {
        for n in [3, 7, 20] {
            assert_eq!(open_edges(&sphere(n)), 0);
            assert_eq!(open_edges(&torus(0.3, n)), 0);
        }
        assert_eq!(open_edges(&cube()), 0);
        // The control: a plane has an edge all round.
        assert_eq!(open_edges(&plane(5)), 4 * 5);
    }

    #[test]
    fn radii() {
        for position in &sphere(20).positions {
            assert!((position.length() - 1.0).abs() < 1e-12);
        }
        let (major, minor) = (1.0 / 1.5, 0.5 / 1.5);
        for position in &torus(0.5, 20).positions {
            let from_ring = DVec2::new(position.truncate().length() - major, position.z);
            assert!((from_ring.length() - minor).abs() < 1e-12);
        }
    }

    #[test]
    fn the_teapot_fills_the_box_that_its_documentation_names() {
        let mesh = teapot(64);
        let low = mesh.positions.iter().copied().reduce(DVec3::min).unwrap();
        let high = mesh.positions.iter().copied().reduce(DVec3::max).unwrap();
        let off_low = low - DVec3::new(-3.0, -2.0, 0.0);
        let off_high = high - DVec3::new(3.434, 2.0, 3.15);
        assert!(off_low.abs().max_element() < 1e-3, "{low}");
        assert!(off_high.abs().max_element() < 1e-3, "{high}");
    }

    /// The quarters of lid, rim, body and bottom meet without a gap.
    #[test]
    fn turned_patches_meet_exactly() {
        for profile in &TEAPOT_PROFILES {
            let quarters = quarters(profile);
            for i in 0..4 {
                let last = quarters[i].map(|row| row[3]);
                let first = quarters[(i + 1) % 4].map(|row| row[0]);
                assert_eq!(last, first);
            }
        }
    }
}
