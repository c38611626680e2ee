//! A lighthouse from turned profiles and boxes: y up, foot at y = 0, the door towards +z, height 2.

use glam::DVec3;
use shadowlab::scene::Mesh;

use super::build::{Ends, Obj, around, ball, boxed, cylinder, ring, turned};

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

/// The model as OBJ text.
pub fn obj() -> String {
    let mut writer = Obj::new("Lighthouse", "lighthouse.mtl", [5; 3]);
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
    solids.push(ring(0.322, 0.338, 1.435, 1.447, SLICES));
    solids.push(ring(0.320, 0.340, 1.512, 1.526, SLICES));
    solids
}

/// The lamp room: a low wall, eight pillars, the ring that bears the roof, and the lamp's stand.
fn lantern() -> Vec<Mesh> {
    let mut solids = around(8, 0.165, |place, degrees| {
        boxed(DVec3::new(0.02, 0.23, 0.02), place.with_y(1.54), degrees)
    });
    solids.push(ring(0.148, 0.182, 1.365, 1.44, SLICES));
    solids.push(ring(0.148, 0.182, 1.63, 1.655, SLICES));
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
