//! Wires, bumps, and triangles that a careful modeller would not make.

use glam::{DMat4, DQuat, DVec2, DVec3, dvec3};

use super::Case;
use super::Expected::{FalseLight, FalseShadow, Holds, Unresolved};
use super::build::{ORANGE, at, camera, floor, object, scene, spot, with_mesh};
use crate::scene::{Beam, Light, Mesh, Object, Scene, rotate, shapes};

pub const CASES: &[Case] = &[
    Case {
        name: "wires",
        about: "two layers of wires of half a texel, their shadows seen close up",
        lab: "cs541",
        scene: wires,
        expected: &[
            ("remedy=epsilon", Unresolved(2_000)),
            ("remedy=epsilon epsilon=0.00005 map_size=8192", Holds(0, 0)),
        ],
    },
    Case {
        name: "bumpy",
        about: "a bumpy sphere of 200,000 triangles, seen at its terminator",
        lab: "cs541",
        scene: bumpy,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(2_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "degenerate",
        about: "a box and a floor with triangles that occur twice or have no area",
        lab: "cs541",
        scene: degenerate,
        expected: &[
            ("remedy=none filter=nearest", FalseShadow(5_000)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
    Case {
        name: "open-mesh",
        about: "a ball with a hole, every third of its triangles the wrong way round",
        lab: "cs541",
        scene: open_mesh,
        expected: &[
            ("remedy=culling", FalseLight(500)),
            ("remedy=epsilon", Holds(0, 0)),
        ],
    },
];

fn light() -> Light {
    spot(dvec3(4.0, 7.0, -3.0), DVec3::ZERO, 60.0, Beam::Circular)
}

/// A square bar between two points.
fn wire(from: DVec3, to: DVec3, width: f64) -> Object {
    let along = to - from;
    let turn = DQuat::from_rotation_arc(DVec3::Y, along.normalize());
    let placement = at((from + to) / 2.0)
        * DMat4::from_quat(turn)
        * DMat4::from_scale(dvec3(width, along.length(), width));
    object("wire", shapes::cube(), placement, ORANGE)
}

/// A texel of the map of 1024 is about 0.009 wide there.
fn wires() -> Scene {
    let width = 0.004;
    let bars = (-4..=4).flat_map(|i| {
        let x = 0.04 * f64::from(i);
        let (low, high) = (dvec3(x, 0.03, -0.2), dvec3(x, 0.05, 0.2));
        // The others lie across, above them: none touches another.
        let across = |p: DVec3| dvec3(p.z, p.y + 0.03, p.x);
        [
            wire(low, high, width),
            wire(across(low), across(high), width),
        ]
    });
    scene(
        camera(dvec3(-0.22, 0.2, 0.2), dvec3(-0.04, 0.0, 0.03), 40.0),
        light(),
        [floor(10.0)].into_iter().chain(bars).collect(),
    )
}

/// Waves on the unit sphere; equal points stay equal, so that no seam opens.
fn with_bumps(mesh: &mut Mesh) {
    const HEIGHT: f64 = 0.02;
    const WAVES: DVec3 = DVec3::new(21.0, 19.0, 23.0);
    for (position, normal) in mesh.positions.iter_mut().zip(&mut mesh.normals) {
        let direction = *position;
        let (sin, cos) = (
            (direction * WAVES).map(f64::sin),
            (direction * WAVES).map(f64::cos),
        );
        let radius = 1.0 + HEIGHT * sin.element_product();
        let slope = HEIGHT
            * WAVES
            * dvec3(
                cos.x * sin.y * sin.z,
                sin.x * cos.y * sin.z,
                sin.x * sin.y * cos.z,
            );
        // The gradient along the sphere tips the normal.
        let along = slope - slope.dot(direction) * direction;
        *position = radius * direction;
        *normal = (radius * direction - along).normalize();
    }
}

fn bumpy() -> Scene {
    bumpy_ball(201_600)
}

/// A bumpy sphere of about so many triangles over a floor: with their number, nothing changes but how fine it is.
pub fn bumpy_ball(triangles: u32) -> Scene {
    // A sphere of mesh size n has 4 n (n − 1).
    let mesh_size = 0.5 + (f64::from(triangles) / 4.0).sqrt();
    let sphere = shapes::sphere(mesh_size.round() as u32);
    let ball = object("ball", sphere, at(1.2 * DVec3::Y), ORANGE);
    scene(
        camera(dvec3(-2.2, 1.9, 3.6), dvec3(0.0, 1.1, 0.0), 40.0),
        spot(
            dvec3(6.0, 4.0, 2.0),
            dvec3(0.0, 1.0, 0.0),
            50.0,
            Beam::Circular,
        ),
        vec![floor(10.0), with_mesh(ball, with_bumps)],
    )
}

/// Every triangle twice, the second time from another corner; and three that are lines or points.
fn careless(mesh: &mut Mesh) {
    let again: Vec<[u32; 3]> = mesh.faces.iter().map(|[a, b, c]| [*b, *c, *a]).collect();
    let middle = mesh.positions.len() as u32;
    mesh.positions
        .push((mesh.positions[0] + mesh.positions[1]) / 2.0);
    mesh.normals.push(mesh.normals[0]);
    mesh.texture_coords.push(DVec2::ZERO);
    mesh.faces.extend(again);
    mesh.faces.extend([[0, 0, 1], [1, 1, 1], [0, 1, middle]]);
}

fn degenerate() -> Scene {
    let turned = at(dvec3(0.0, 0.6, 0.0)) * rotate(30.0, dvec3(0.3, 1.0, 0.2));
    let cube = object("box", shapes::cube(), turned, ORANGE);
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.5, 0.3, 0.3), 45.0),
        light(),
        vec![with_mesh(floor(10.0), careless), with_mesh(cube, careless)],
    )
}

/// The hole is where the sphere's own x is above 0.6; it is turned to the camera.
fn broken(mesh: &mut Mesh) {
    let positions = &mesh.positions;
    let in_hole = |face: &[u32; 3]| face.iter().all(|i| positions[*i as usize].x > 0.6);
    mesh.faces.retain(|face| !in_hole(face));
    for face in mesh.faces.iter_mut().step_by(3) {
        face.swap(0, 1);
    }
}

fn open_mesh() -> Scene {
    let turn = rotate(240.0, DVec3::Y) * rotate(35.0, DVec3::Z);
    let ball = object(
        "ball",
        shapes::sphere(20),
        at(1.3 * DVec3::Y) * turn,
        ORANGE,
    );
    scene(
        camera(dvec3(-3.5, 4.5, 6.0), dvec3(-0.5, 0.3, 0.3), 45.0),
        light(),
        vec![floor(10.0), with_mesh(ball, broken)],
    )
}
