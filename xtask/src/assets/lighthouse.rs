//! A lighthouse from turned profiles and boxes: y up, foot at y = 0, the door towards +z, height 2.
//!
//! Every solid is closed. Solids are sunk a little into each other, so that no two surfaces coincide.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use glam::{DQuat, DVec2, DVec3};
use shadowlab::scene::{Mesh, shapes};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl wall
Kd 1 1 1
Ks 0.08 0.08 0.08
Ns 12
map_Kd lighthouse.png

newmtl stone
Kd 0.62 0.6 0.56
Ks 0.05 0.05 0.05
Ns 8

newmtl metal
Kd 0.2 0.22 0.25
Ks 0.6 0.6 0.6
Ns 60

newmtl roof
Kd 0.55 0.13 0.1
Ks 0.4 0.4 0.4
Ns 40

newmtl lamp
Kd 1 0.87 0.45
Ks 0.9 0.9 0.9
Ns 120
";

const HEADER: &str = "\
# Lighthouse. Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
mtllib lighthouse.mtl
";

/// The model as OBJ text.
pub fn obj() -> String {
    let mut writer = Writer::default();
    writer.object(
        "base",
        "stone",
        &[base(), door_step(0.05, 0.62), door_step(0.09, 0.54)],
    );
    writer.object("tower", "wall", &[tower()]);
    writer.object("gallery", "stone", &[gallery()]);
    writer.object("railing", "metal", &railing());
    writer.object("lantern", "metal", &lantern());
    writer.object("lamp", "lamp", &[ball(1.535, 0.065, 16)]);
    writer.object("roof", "roof", &[roof()]);
    writer.object(
        "finial",
        "metal",
        &[ball(1.865, 0.03, 12), cylinder(0.007, 1.88, 2.0, 6)],
    );
    writer.text()
}

/// How many sides the round walls have.
const SLICES: u32 = 24;

fn base() -> Mesh {
    let profile = [
        [0.0, 0.0],
        [0.48, 0.0],
        [0.48, 0.06],
        [0.44, 0.06],
        [0.44, 0.11],
        [0.43, 0.12],
        [0.0, 0.12],
    ];
    turned(&profile, Ends::OnAxis, SLICES)
}

/// A stair before the door, up to `height` and out to z = `reach`.
fn door_step(height: f64, reach: f64) -> Mesh {
    let inner = 0.38;
    let size = DVec3::new(0.22 + 0.4 * (reach - 0.5), height, reach - inner);
    boxed(
        size,
        DVec3::new(0.0, height / 2.0, (reach + inner) / 2.0),
        0.0,
    )
}

/// The wall tapers as an oak does: quickly at the foot, and then ever less.
fn tower() -> Mesh {
    let rings = 6;
    let mut profile = vec![[0.0, 0.115]];
    for ring in 0..=rings {
        let t = f64::from(ring) / f64::from(rings);
        let radius = 0.225 + 0.115 * (1.0 - t).powf(1.5);
        profile.push([radius, 0.115 + 1.17 * t]);
    }
    profile.push([0.0, 1.285]);
    turned(&profile, Ends::OnAxis, SLICES)
}

/// The platform, on a corbel that leads the wall outwards.
fn gallery() -> Mesh {
    let profile = [
        [0.0, 1.25],
        [0.237, 1.25],
        [0.25, 1.275],
        [0.34, 1.33],
        [0.355, 1.33],
        [0.355, 1.37],
        [0.0, 1.37],
    ];
    turned(&profile, Ends::OnAxis, SLICES)
}

/// Sixteen posts and two rails around the gallery.
fn railing() -> Vec<Mesh> {
    let mut solids = around(16, 0.33, |place, degrees| {
        boxed(
            DVec3::new(0.012, 0.155, 0.012),
            place.with_y(1.4425),
            degrees,
        )
    });
    solids.push(ring(0.322, 0.338, 1.435, 1.447));
    solids.push(ring(0.320, 0.340, 1.512, 1.526));
    solids
}

/// The lamp room: a low wall, eight pillars, the ring that bears the roof, and the lamp's stand.
fn lantern() -> Vec<Mesh> {
    let mut solids = around(8, 0.165, |place, degrees| {
        boxed(DVec3::new(0.02, 0.23, 0.02), place.with_y(1.54), degrees)
    });
    solids.push(ring(0.148, 0.182, 1.365, 1.44));
    solids.push(ring(0.148, 0.182, 1.63, 1.655));
    solids.push(cylinder(0.03, 1.365, 1.48, 12));
    solids
}

fn roof() -> Mesh {
    let profile = [
        [0.0, 1.65],
        [0.225, 1.65],
        [0.23, 1.665],
        [0.13, 1.745],
        [0.02, 1.855],
        [0.0, 1.855],
    ];
    turned(&profile, Ends::OnAxis, SLICES)
}

fn ball(middle: f64, radius: f64, slices: u32) -> Mesh {
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

fn cylinder(radius: f64, bottom: f64, top: f64, slices: u32) -> Mesh {
    let profile = [[0.0, bottom], [radius, bottom], [radius, top], [0.0, top]];
    turned(&profile, Ends::OnAxis, slices)
}

/// A ring of rectangular section.
fn ring(inner: f64, outer: f64, bottom: f64, top: f64) -> Mesh {
    let section = [[inner, bottom], [outer, bottom], [outer, top], [inner, top]];
    turned(&section, Ends::Joined, SLICES)
}

/// One solid at each of `count` places around the axis, turned to face outwards.
fn around(count: u32, radius: f64, solid: impl Fn(DVec3, f64) -> Mesh) -> Vec<Mesh> {
    let placed = |i: u32| {
        let degrees = 360.0 * (f64::from(i) + 0.5) / f64::from(count);
        let place = DQuat::from_rotation_y(degrees.to_radians()) * DVec3::new(0.0, 0.0, radius);
        solid(place, degrees)
    };
    (0..count).map(placed).collect()
}

/// A box, turned about its own vertical axis.
fn boxed(size: DVec3, middle: DVec3, degrees: f64) -> Mesh {
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
enum Ends {
    /// The profile starts and ends on the axis.
    OnAxis,
    /// The last point leads back to the first.
    Joined,
}

/// Turns a profile of radius and height about the y axis.
///
/// The profile goes up where it faces outwards. A bend of less than 40° is smooth.
fn turned(profile: &[[f64; 2]], ends: Ends, slices: u32) -> Mesh {
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

/// OBJ text in which equal positions, texture coordinates and normals are written once.
#[derive(Default)]
struct Writer {
    lines: String,
    known: [HashMap<String, usize>; 3],
}

impl Writer {
    fn object(&mut self, name: &str, material: &str, solids: &[Mesh]) {
        let mut faces = format!("o {name}\nusemtl {material}\n");
        for mesh in solids {
            for face in &mesh.faces {
                faces.push('f');
                for i in face.map(|i| i as usize) {
                    let v = self.index(0, "v", &mesh.positions[i].to_array());
                    let vt = self.index(1, "vt", &mesh.texture_coords[i].to_array());
                    let vn = self.index(2, "vn", &mesh.normals[i].to_array());
                    write!(faces, " {v}/{vt}/{vn}").expect("a String takes everything");
                }
                faces.push('\n');
            }
        }
        self.lines += &faces;
    }

    /// The index of a line of numbers, which is written if it is new.
    fn index(&mut self, kind: usize, keyword: &str, numbers: &[f64]) -> usize {
        let mut line = keyword.to_owned();
        for number in numbers {
            // Five decimals, and no minus before a zero.
            let rounded = (number * 1e5).round() / 1e5 + 0.0;
            write!(line, " {rounded}").expect("a String takes everything");
        }
        let next = self.known[kind].len() + 1;
        *self.known[kind].entry(line).or_insert_with_key(|line| {
            self.lines += line;
            self.lines.push('\n');
            next
        })
    }

    fn text(self) -> String {
        format!("{HEADER}{}", self.lines)
    }
}
