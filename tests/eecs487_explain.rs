//! `explain` says what was drawn: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;
mod explaining;

use common::Bench;
use explaining::explained;
use glam::DVec3;
use shadowlab::labs::Probe;

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [&[&str]; 6] = [
        &[],
        &["stencil_clipping=on"],
        &["clipped_to=floor"],
        &["clipped_to=floor", "stencil_clipping=on"],
        &["clipped_to=left"],
        &["clipped_to=rear", "tessellation=3"],
    ];
    let surfaces: u32 = states
        .iter()
        .zip(1..)
        .map(|(settings, seed)| explained("eecs487", settings, 170, seed))
        .sum();
    assert!(surfaces > 350, "only {surfaces} pixels showed a wall");
}

/// GPU and f64 give the same answers away from the shadows' edges, and both answers are given.
#[test]
fn the_caster_is_told() {
    let mut bench = Bench::new("eecs487", [600, 600], &["stencil_clipping=on"]);
    let mut explain = |pixel| {
        let probe = Probe::Pixel(pixel);
        bench.lab.explain(&bench.context.gl, probe, 1).unwrap()
    };
    for (pixel, wall, caster) in [
        ([420, 520], "floor", Some("torus")),
        ([100, 400], "left", Some("teapot")),
        ([360, 400], "rear", Some("torus")),
        ([300, 580], "floor", None),
        ([300, 60], "ceiling", None),
    ] {
        let explanation = explain(pixel);
        assert!(
            explanation.place.contains(&format!("\"{wall}\"")),
            "{explanation}"
        );
        let told = caster.is_none_or(|name| explanation.place.contains(name));
        assert!(told, "{explanation}");
        let [(_, gpu, exact), (_, in_stencil, inside)] = explanation.tests[..] else {
            panic!("{explanation}");
        };
        assert_eq!([gpu, exact], [caster.is_some(); 2], "{explanation}");
        assert!(inside, "{explanation}");
        // The last wall's 1 covers the others' where they overlap, and nothing is 0 in a full room.
        assert!(in_stencil, "{explanation}");
    }
    let teapot = explain([240, 270]);
    assert!(
        teapot.in_shadow.is_none() && teapot.steps.is_empty(),
        "{teapot}"
    );
}

#[test]
fn what_cannot_be_explained_is_told() {
    let refused = |setting: &str, probe: Probe| {
        let mut bench = Bench::new("eecs487", [320, 240], &[setting]);
        let explained = bench.lab.explain(&bench.context.gl, probe, 1);
        explained.err().unwrap().to_string()
    };
    assert!(refused("soft_shadows=on", Probe::Pixel([0, 0])).contains("soft_shadows=off"));
    assert!(refused("scene=ramp", Probe::Pixel([0, 0])).contains("scene=room"));
    assert!(refused("scene=room", Probe::Pixel([320, 0])).contains("0,0 to 319,239"));
    assert!(refused("scene=room", Probe::Point(DVec3::ZERO)).contains("expected a pixel"));
}
