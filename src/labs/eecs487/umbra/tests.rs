//! What all lights have in common, of shapes whose shadows are known.

use super::*;
use crate::scene::{Mesh, Object, shapes};
use glam::{DMat4, dvec4};

fn floor() -> Wall {
    Wall {
        name: "floor",
        color: DVec3::ONE,
        plane: dvec4(0.0, 0.0, 1.0, 0.0),
        placement: DMat4::IDENTITY,
    }
}

fn caster<'a>(mesh: &'a Mesh, topology: &'a Topology, at: DVec3, size: f64) -> Caster<'a> {
    Caster {
        positions: mesh.positions.iter().map(|p| at + size * *p).collect(),
        faces: &mesh.faces,
        topology,
    }
}

fn area(parts: &Parts) -> f64 {
    let sides = parts.umbra.iter().map(|[low, high]| *high - *low);
    sides.map(|sides| sides.x * sides.y).sum()
}

/// The umbra of a square half-way between the floor and lights 2 above it: of all lights, and of none else.
#[test]
fn a_square_has_its_umbra() {
    let mesh = shapes::plane(4);
    let topology = Topology::new(&mesh);
    assert!(!topology.is_closed);
    for reach in [0.01, 0.1, 0.2] {
        let lights = Cube {
            centre: dvec3(0.0, 0.0, 2.0),
            reach,
        };
        let parts = Parts::new(
            &floor(),
            lights,
            &[caster(&mesh, &topology, DVec3::Z, 0.3)],
            true,
        );
        // The lowest lights, off to one side, have the narrowest shadow there.
        let (near, far) = (2.0 - reach, 2.0 + reach);
        let edge = |height: f64| (height * 0.3 - reach) / (height - 1.0);
        let half = edge(near).min(edge(far));
        let found = area(&parts);
        let cells = 2.0 * half - 6.0 / CELLS as f64..2.0 * half;
        assert!(cells.contains(&found.sqrt()), "{reach}: {found} {half}");
        for [low, high] in &parts.umbra {
            assert!(low.abs().max(high.abs()).max_element() <= half, "{reach}");
        }
        // All or nothing: the inner quads of the square are beyond the penumbra of a small light.
        let kept = parts.penumbra[0].len() / 3;
        assert!((24..=32).contains(&kept), "{kept}");
    }
    // The control: lights that reach around the square leave no umbra.
    let lights = Cube {
        centre: dvec3(0.0, 0.0, 2.0),
        reach: 0.7,
    };
    let parts = Parts::new(
        &floor(),
        lights,
        &[caster(&mesh, &topology, DVec3::Z, 0.3)],
        true,
    );
    assert_eq!(area(&parts), 0.0);
    assert_eq!(parts.penumbra[0].len(), 3 * mesh.faces.len());
}

/// A closed mesh is drawn from its front alone, and of that what is near the silhouette.
#[test]
fn a_sphere_is_drawn_around_its_silhouette() {
    let mesh = shapes::sphere(24);
    let topology = Topology::new(&mesh);
    assert!(topology.is_closed);
    let lights = |reach| Cube {
        centre: dvec3(0.1, 0.0, 1.8),
        reach,
    };
    let kept = |reach| {
        let caster = caster(&mesh, &topology, dvec3(0.0, 0.0, 0.6), 0.3);
        let parts = Parts::new(&floor(), lights(reach), &[caster], true);
        assert!(area(&parts) > 0.0);
        parts.penumbra[0].len() / 3
    };
    let (narrow, wide) = (kept(0.005), kept(0.1));
    let all = mesh.faces.len();
    assert!(narrow < all / 4, "{narrow} of {all}");
    assert!(narrow < wide && wide < 3 * all / 4, "{wide} of {all}");
}

#[test]
fn what_is_cut_by_a_plane_is_drawn_whole() {
    let object = Object::new(
        "ball",
        shapes::sphere(8),
        DMat4::IDENTITY,
        Default::default(),
    );
    let topology = Topology::new(&object.mesh);
    let lights = Cube {
        centre: dvec3(0.0, 0.0, 2.0),
        reach: 0.1,
    };
    // Among the lights, and between.
    for (height, is_whole) in [(1.8, true), (1.0, false)] {
        let caster = caster(&object.mesh, &topology, dvec3(0.0, 0.0, height), 0.3);
        let parts = Parts::new(&floor(), lights, &[caster], true);
        let all = parts.penumbra[0].len() == 3 * object.mesh.faces.len();
        assert_eq!(all && parts.umbra.is_empty(), is_whole, "{height}");
    }
}
