//! `explain` says what the shader computed: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;
mod explaining;

use common::Bench;
use explaining::explained;
use glam::dvec3;
use shadowlab::labs::Probe;

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [&[&str]; 10] = [
        &[],
        &["stage=no_bias"],
        &["stage=slope"],
        &["stage=pcf", "map_size=300"],
        &["scene=room"],
        &["scene=room", "stage=no_bias"],
        &["scene=room", "stage=slope", "map_size=4096"],
        &["scene=room", "stage=culling"],
        &["scene=room", "stage=thick", "bias=0.02"],
        &["scene=room", "stage=pcf"],
    ];
    let surfaces: u32 = states
        .iter()
        .zip(1..)
        .map(|(settings, seed)| explained("csci3260", settings, 100, seed))
        .sum();
    // The sky takes about a quarter of the picture.
    assert!(surfaces > 600, "only {surfaces} pixels showed a surface");
}

#[test]
fn a_point_behind_the_thin_wall_is_lit_and_behind_the_thick_one_shadowed() {
    // Where the wall's shadow should begin.
    let in_shadow = |stage: &str, z: f64| {
        let mut bench = Bench::new("csci3260", [320, 240], &["scene=room", stage]);
        let probe = Probe::Point(dvec3(1.5, 0.0, z));
        let explanation = bench.lab.explain(&bench.context.gl, probe, 1).unwrap();
        for step in &explanation.steps {
            assert!(step.agrees(), "{}\n{explanation}", step.name);
        }
        explanation.in_shadow.unwrap()
    };
    assert!(!in_shadow("stage=constant", -1.35));
    assert!(in_shadow("stage=constant", -1.5));
    assert!(in_shadow("stage=thick", -1.55));
    assert!(in_shadow("stage=culling", -1.35));
}

#[test]
fn what_cannot_be_explained_is_told() {
    let refused = |setting: &str, probe: Probe| {
        let mut bench = Bench::new("csci3260", [320, 240], &[setting]);
        let explained = bench.lab.explain(&bench.context.gl, probe, 1);
        explained.err().unwrap().to_string()
    };
    assert!(refused("shadows=off", Probe::Pixel([0, 0])).contains("expected shadows=on"));
    assert!(refused("stage=pcf", Probe::Pixel([320, 0])).contains("0,0 to 319,239"));
    assert!(
        refused("stage=slope", Probe::Point(dvec3(0.0, 0.0, 0.0))).contains("expected a pixel")
    );
}
