//! A palace in the manner of Knossos: y up, its front towards +z, on y = 0; 70 wide, 45 deep and 25 high.
//!
//! The wings rise from the low east, where the evening's light comes in, to three storeys in the west; each storey
//! stands back behind a terrace, and each has a colonnade before its painted wall.

mod parts;
mod stairs;

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use crate::assets::build::Obj;
use parts::{Axis, colonnade, horns, row, slab, wall, windows};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl paving
Kd 1 1 1
Ks 0.05 0.05 0.05
Ns 8
map_Kd paving.png

newmtl plaster
Kd 0.95 0.86 0.7
Ks 0.02 0.02 0.02
Ns 4

newmtl stone
Kd 0.8 0.76 0.68
Ks 0.05 0.05 0.05
Ns 8

newmtl wall
Kd 1 1 1
Ks 0.02 0.02 0.02
Ns 4
map_Kd wall.png

newmtl fresco
Kd 1 1 1
Ks 0.02 0.02 0.02
Ns 4
map_Kd fresco.png

newmtl red
Kd 0.62 0.12 0.08
Ks 0.25 0.25 0.25
Ns 24

newmtl black
Kd 0.09 0.08 0.08
Ks 0.3 0.3 0.3
Ns 24

newmtl dark
Kd 0.16 0.11 0.09
Ks 0 0 0
Ns 1
";

/// The solids by material, in the order of the file.
#[derive(Default)]
struct Palace {
    paving: Vec<Mesh>,
    terraces: Vec<Mesh>,
    stone: Vec<Mesh>,
    walls: Vec<Mesh>,
    frescoes: Vec<Mesh>,
    shafts: Vec<Mesh>,
    capitals: Vec<Mesh>,
    openings: Vec<Mesh>,
}

pub fn obj() -> String {
    let mut palace = Palace::default();
    ground(&mut palace);
    west_wing(&mut palace);
    north_wing(&mut palace);
    east_wing(&mut palace);
    propylaeum(&mut palace);
    stairs::all(&mut palace);
    let mut obj = Obj::new("Palace", "palace.mtl", [3, 3, 3]);
    for (name, material, solids) in [
        ("ground", "paving", &palace.paving),
        ("terraces", "plaster", &palace.terraces),
        ("masonry", "stone", &palace.stone),
        ("walls", "wall", &palace.walls),
        ("frescoes", "fresco", &palace.frescoes),
        ("shafts", "red", &palace.shafts),
        ("capitals", "black", &palace.capitals),
        ("openings", "dark", &palace.openings),
    ] {
        obj.object(name, material, solids);
    }
    obj.text()
}

/// The top of the ground slab, and the height of a storey from floor to floor.
const GROUND: f64 = 1.0;
const STOREY: f64 = 7.5;

fn floor(storey: u32) -> f64 {
    GROUND + STOREY * f64::from(storey)
}

fn ground(palace: &mut Palace) {
    palace
        .paving
        .push(slab([-35.0, 0.0, -22.5], [35.0, GROUND, 22.5]));
}

/// A storey: a block with painted walls between `low` and `high` (x and z).
fn storey(palace: &mut Palace, number: u32, low: [f64; 2], high: [f64; 2]) {
    let (bottom, top) = (floor(number), floor(number + 1) - 0.7);
    palace.walls.push(wall(
        [low[0], bottom - 0.1, low[1]],
        [high[0], top + 0.1, high[1]],
    ));
}

/// A flat roof, whose upper side is the next storey's floor.
fn roof(palace: &mut Palace, number: u32, low: [f64; 2], high: [f64; 2]) {
    let top = floor(number + 1);
    palace.stone.push(slab(
        [low[0], top - 0.75, low[1]],
        [high[0], top - 0.25, high[1]],
    ));
    let inset = 0.25;
    palace.terraces.push(slab(
        [low[0] + inset, top - 0.3, low[1] + inset],
        [high[0] - inset, top, high[1] - inset],
    ));
}

fn west_wing(palace: &mut Palace) {
    // Ground floor, with magazines behind and a colonnade along the court.
    storey(palace, 0, [-34.0, -21.5], [-17.5, 15.0]);
    roof(palace, 0, [-34.5, -22.0], [-13.5, 15.5]);
    colonnade(palace, 0, row([-14.6, -6.0], [-14.6, 14.4], 7));
    storey(palace, 1, [-33.0, -20.5], [-22.5, 12.0]);
    roof(palace, 1, [-33.5, -21.0], [-18.5, 12.5]);
    colonnade(palace, 1, row([-19.6, -19.8], [-19.6, 11.4], 8));
    storey(palace, 2, [-32.0, -19.5], [-26.5, 5.0]);
    roof(palace, 2, [-32.5, -20.0], [-22.5, 5.5]);
    colonnade(palace, 2, row([-23.6, -18.8], [-23.6, 4.4], 6));
    windows(palace, 0, Axis::Z, 15.0, [-31.0, -20.0], 3);
    windows(palace, 1, Axis::Z, 12.0, [-31.0, -24.5], 2);
    windows(palace, 2, Axis::Z, 5.0, [-30.5, -28.0], 1);
    windows(palace, 1, Axis::X, -22.5, [-17.0, 9.0], 5);
    windows(palace, 2, Axis::X, -26.5, [-16.0, 2.0], 3);
    horns(palace, floor(3), row([-32.0, 4.9], [-23.0, 4.9], 4));
    horns(palace, floor(3), row([-23.0, -18.4], [-23.0, 2.6], 8));
    horns(palace, floor(2), row([-19.0, -8.5], [-19.0, 12.0], 8));
    horns(palace, floor(2), row([-32.9, 12.0], [-21.6, 12.0], 4));
    horns(palace, floor(1), row([-33.9, 15.0], [-16.8, 15.0], 6));
}

fn north_wing(palace: &mut Palace) {
    storey(palace, 0, [-17.6, -21.4], [16.0, -12.5]);
    roof(palace, 0, [-13.5, -21.9], [16.5, -8.5]);
    colonnade(palace, 0, row([-9.8, -9.6], [15.4, -9.6], 8));
    storey(palace, 1, [-18.4, -20.4], [9.0, -15.5]);
    roof(palace, 1, [-18.5, -20.9], [9.5, -11.5]);
    colonnade(palace, 1, row([-14.6, -12.6], [8.4, -12.6], 7));
    windows(palace, 1, Axis::Z, -15.5, [-13.0, 7.0], 5);
    palace.frescoes.push(parts::panel(
        [-12.0, floor(0) + 1.4, -12.4],
        [14.0, floor(0) + 5.0, -12.4],
    ));
    horns(palace, floor(2), row([-15.8, -12.0], [9.0, -12.0], 9));
    horns(palace, floor(1), row([10.8, -9.0], [16.0, -9.0], 3));
}

/// Low, and open to both sides: light falls through it into the court.
fn east_wing(palace: &mut Palace) {
    storey(palace, 0, [20.0, -21.0], [33.5, -10.5]);
    roof(palace, 0, [16.5, -21.5], [34.3, -5.0]);
    colonnade(palace, 0, row([20.6, -6.2], [33.0, -6.2], 5));
    windows(palace, 0, Axis::X, 33.5, [-19.0, -12.5], 3);
    palace.frescoes.push(parts::panel(
        [21.5, floor(0) + 1.4, -10.4],
        [32.0, floor(0) + 5.0, -10.4],
    ));
    horns(palace, floor(1), row([18.4, -5.5], [33.8, -5.5], 6));
    horns(palace, floor(1), row([33.8, -8.0], [33.8, -20.0], 5));
    // A pergola of columns goes on towards the front.
    for x in [24.0, 32.5] {
        colonnade(palace, 0, row([x, -1.0], [x, 13.0], 4));
        let top = floor(1);
        palace
            .stone
            .push(slab([x - 0.8, top - 0.8, -2.0], [x + 0.8, top - 0.1, 14.0]));
    }
    for i in 0..6 {
        let z = -1.0 + 2.8 * f64::from(i);
        palace.openings.push(slab(
            [22.6, floor(1) - 0.15, z - 0.25],
            [33.9, floor(1) + 0.35, z + 0.25],
        ));
    }
}

/// The gate in the front: four columns under a roof of their own.
fn propylaeum(palace: &mut Palace) {
    roof(palace, 0, [-6.5, 11.0], [10.5, 18.5]);
    for z in [12.4, 17.1] {
        colonnade(palace, 0, row([-4.6, z], [8.6, z], 4));
    }
    horns(palace, floor(1), row([-5.9, 18.0], [9.9, 18.0], 6));
    horns(palace, floor(1), row([-5.9, 11.5], [9.9, 11.5], 6));
    // Low walls lead from the gate to the wings.
    palace.walls.push(wall(
        [-13.0, GROUND - 0.1, 14.2],
        [-7.4, GROUND + 3.4, 15.6],
    ));
    palace
        .walls
        .push(wall([11.4, GROUND - 0.1, 14.2], [20.5, GROUND + 3.4, 15.6]));
    palace.stone.push(slab(
        [-13.4, GROUND + 3.3, 13.9],
        [-7.0, GROUND + 3.8, 15.9],
    ));
    palace
        .stone
        .push(slab([11.0, GROUND + 3.3, 13.9], [20.9, GROUND + 3.8, 15.9]));
    horns(palace, GROUND + 3.8, row([13.0, 14.9], [19.0, 14.9], 3));
}

/// x and z as a place on the ground.
fn at(place: DVec2, y: f64) -> DVec3 {
    DVec3::new(place.x, y, place.y)
}
