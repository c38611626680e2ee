//! A leaping dolphin in the course's units and orientation: z up, the beak towards −y, symmetric in x.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use shadowlab::scene::Mesh;

use super::skins;
use crate::assets::build::{Obj, curve, fitted, joined, mirrored, skin};

pub const MTL: &str = "\
# Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.
newmtl skin
Kd 1 1 1
Ks 0.5 0.5 0.5
Ns 40
map_Kd dolphin_01.png
";

/// The box of the course's own model.
const LOW: DVec3 = DVec3::new(-41.1, -111.5, 1.0);
const HIGH: DVec3 = DVec3::new(41.1, 66.0, 153.2);

/// From the tip of the beak to the root of the fluke: y and z of the spine.
const SPINE: [DVec2; 16] = [
    DVec2::new(-110.0, 104.0),
    DVec2::new(-103.0, 107.5),
    DVec2::new(-96.0, 111.0),
    DVec2::new(-89.0, 114.5),
    DVec2::new(-80.0, 118.0),
    DVec2::new(-66.0, 122.0),
    DVec2::new(-48.0, 124.5),
    DVec2::new(-28.0, 122.0),
    DVec2::new(-8.0, 113.0),
    DVec2::new(11.0, 98.5),
    DVec2::new(27.0, 80.0),
    DVec2::new(39.0, 60.0),
    DVec2::new(47.5, 42.0),
    DVec2::new(53.0, 27.0),
    DVec2::new(56.5, 14.0),
    DVec2::new(58.5, 6.0),
];

/// At the same places: how far the skin is from the spine to the side, to the back, and to the belly.
const GIRTH: [DVec3; 16] = [
    DVec3::new(2.3, 1.7, 2.0),
    DVec3::new(3.7, 2.4, 3.0),
    DVec3::new(5.2, 3.2, 4.2),
    DVec3::new(9.4, 9.6, 6.6),
    DVec3::new(13.0, 14.0, 10.0),
    DVec3::new(16.0, 16.2, 14.2),
    DVec3::new(18.6, 18.2, 18.0),
    DVec3::new(20.0, 19.8, 20.0),
    DVec3::new(19.4, 20.0, 19.4),
    DVec3::new(16.8, 18.6, 17.0),
    DVec3::new(13.2, 16.2, 14.0),
    DVec3::new(9.4, 13.0, 11.0),
    DVec3::new(6.2, 9.6, 8.6),
    DVec3::new(3.9, 6.6, 6.2),
    DVec3::new(2.7, 4.0, 4.0),
    DVec3::new(2.2, 2.2, 2.2),
];

/// The last station's number: stations are counted from the beak.
const STATIONS: f64 = 15.0;

const RINGS: usize = 92;
const COLUMNS: usize = 40;

/// One object of one material, as the course's own loader expects it.
pub fn obj() -> String {
    let flipper = flipper();
    let whole = joined([
        body(),
        dorsal(),
        flipper.clone(),
        mirrored(flipper),
        fluke(),
    ]);
    let mut obj = Obj::new("Dolphin", "dolphin.mtl", [2, 4, 3]);
    obj.object("dolphin", "skin", &[fitted(whole, LOW, HIGH)]);
    obj.text()
}

/// The spine at a station, with the ways tailwards and backwards (away from the belly) there.
fn spine(station: f64) -> (DVec3, DVec3, DVec3) {
    let at = |station: f64| {
        let point = curve(&SPINE, station / STATIONS);
        DVec3::new(0.0, point.x, point.y)
    };
    let tailwards = (at(station + 0.05) - at(station - 0.05)).normalize();
    (at(station), tailwards, DVec3::X.cross(tailwards))
}

fn body() -> Mesh {
    let ring = |row: usize| -> Vec<DVec3> {
        let along = along(row);
        let (middle, _, back) = spine(along * STATIONS);
        let girth = curve(&GIRTH, along);
        (0..COLUMNS)
            .map(|column| {
                let (side, up) = (TAU * column as f64 / COLUMNS as f64).sin_cos();
                let height = if up > 0.0 { girth.y } else { girth.z };
                middle + back * (up * height) + DVec3::X * (side * girth.x)
            })
            .collect()
    };
    let rings: Vec<Vec<DVec3>> = (0..RINGS).map(ring).collect();
    let (beak, tailwards, _) = spine(0.0);
    let (tail, ..) = spine(STATIONS);
    skin([beak - tailwards * 1.3, tail], &rings, |row, column| {
        let around = column as f64 / COLUMNS as f64;
        let from_belly = 1.0 - 2.0 * around.min(1.0 - around);
        skins::on_body(along(row.clamp(1, RINGS) - 1), from_belly)
    })
}

/// Where a ring is, from 0 to 1: the rings of the beak and the melon are closer to each other.
fn along(ring: usize) -> f64 {
    let t = ring as f64 / (RINGS - 1) as f64;
    t - 0.07 * (TAU * t).sin()
}

/// A fin's edges at a share of its span, and half its thickness there.
#[derive(Clone, Copy)]
struct Section {
    front: DVec3,
    rear: DVec3,
    thickness: f64,
}

/// A rounded blade through sections that follow `outwards`, between two poles. A section given twice is a crease.
fn fin(kind: skins::Fin, poles: [DVec3; 2], outwards: DVec3, sections: &[Section]) -> Mesh {
    const AROUND: usize = 20;
    let ring = |section: &Section| -> Vec<DVec3> {
        let chord = section.rear - section.front;
        let thick = chord.cross(outwards).normalize() * section.thickness;
        (0..AROUND)
            .map(|i| {
                let (sin, cos) = (TAU * i as f64 / AROUND as f64).sin_cos();
                // Fullest before the middle, thin towards the rear edge.
                let share = 0.5 - 0.5 * cos;
                section.front + chord * share + thick * (sin * (1.3 - 0.85 * share))
            })
            .collect()
    };
    let rings: Vec<Vec<DVec3>> = sections.iter().map(ring).collect();
    let last = rings.len() + 1;
    skin(poles, &rings, |row, column| {
        let turn = TAU * column as f64 / AROUND as f64;
        skins::on_fin(kind, 0.5 - 0.5 * turn.cos(), row as f64 / last as f64)
    })
}

const FIN_SECTIONS: usize = 16;

/// Shares of the span: close to each other at the tip.
fn shares() -> impl Iterator<Item = f64> {
    (0..FIN_SECTIONS).map(|i| (PI / 2.0 * (i as f64 + 0.25) / (FIN_SECTIONS as f64 + 0.5)).sin())
}

fn dorsal() -> Mesh {
    let (middle, tailwards, back) = spine(8.1);
    let root = middle + back * curve(&GIRTH, 8.1 / STATIONS).y;
    let place = |along: f64, s: f64| root + tailwards * along + back * (29.0 * s - 6.5);
    let mut sections: Vec<Section> = shares()
        .map(|s| Section {
            front: place(-20.0 + 24.0 * s + 15.0 * s * s, s),
            rear: place(14.0 - 11.0 * (PI * s).sin() + 7.0 * s * s, s),
            thickness: 2.2 * (1.0 - 0.8 * s) + 2.5 * (1.0 - s).powi(4),
        })
        .collect();
    // The root is cut off inside the body.
    sections.insert(0, sections[0]);
    let poles = [place(-3.0, 0.0), place(20.0, 1.02)];
    fin(skins::Fin::Dorsal, poles, back, &sections)
}

/// The one at x > 0.
fn flipper() -> Mesh {
    let (middle, tailwards, back) = spine(5.75);
    let girth = curve(&GIRTH, 5.75 / STATIONS);
    let (side, up) = 2.05_f64.sin_cos();
    let root = middle + back * (up * girth.z) + DVec3::X * (side * girth.x);
    let outwards = (DVec3::X * 0.72 - back * 0.5 + tailwards * 0.5).normalize();
    let chord = (tailwards - outwards * tailwards.dot(outwards)).normalize();
    let place = |along: f64, s: f64| root + chord * along + outwards * (42.0 * s - 5.0);
    let mut sections: Vec<Section> = shares()
        .map(|s| Section {
            front: place(-8.0 - 3.0 * (PI * s).sin() + 14.0 * s * s, s),
            rear: place(7.5 - 2.0 * (PI * s).sin() + 1.5 * s * s, s),
            thickness: 2.0 * (1.0 - 0.75 * s) + 1.5 * (1.0 - s).powi(4),
        })
        .collect();
    // The root is cut off inside the body.
    sections.insert(0, sections[0]);
    let poles = [place(0.0, 0.0), place(7.6, 1.02)];
    fin(skins::Fin::Flipper, poles, outwards, &sections)
}

/// Both lobes in one, from tip to tip, with the notch between them.
fn fluke() -> Mesh {
    let (end, tailwards, back) = spine(STATIONS);
    // The beat of the tail bends the fluke upwards.
    let rear = (tailwards * 0.72 + back * 0.7).normalize();
    let raised = DVec3::X.cross(rear);
    let place = |along: f64, s: f64| {
        let lift = 5.0 * s * s - 1.0;
        end + rear * along + raised * lift + DVec3::X * (40.0 * s)
    };
    let lobes = shares().map(|s| -s).collect::<Vec<_>>();
    let both = lobes.iter().rev().copied().chain(shares());
    let sections: Vec<Section> = both
        .map(|s| {
            let far = s.abs();
            let notch = 7.0 * (-(far / 0.10).powi(2)).exp();
            Section {
                front: place(-13.0 + 33.0 * far.powf(1.25), s),
                rear: place(13.0 - notch + 9.0 * far.powi(2) - 5.0 * (PI * far).sin(), s),
                thickness: 1.3 * (1.0 - 0.7 * far) + 1.6 * (-(far / 0.12).powi(2)).exp(),
            }
        })
        .collect();
    let poles = [place(20.9, -1.012), place(20.9, 1.012)];
    fin(skins::Fin::Fluke, poles, DVec3::X, &sections)
}
