//! `explain` says what the shader computed: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;
mod explaining;

use common::Bench;
use explaining::explained;
use glam::dvec3;
use shadowlab::labs::{Explanation, Probe};

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [&[&str]; 10] = [
        &[],
        &["constant_depth_bias=0"],
        &["filter=pcf_5", "map_size=300"],
        &["filter=pcf_9", "step=1.5"],
        &["outside=lit", "filter=pcf_9", "map_size=1024"],
        &["scene=pirate", "map_size=1024"],
        &["scene=pirate", "filter=pcf_5", "map_size=512"],
        &["scene=knossos", "map_size=1024"],
        &["scene=knossos", "filter=pcf_5", "map_size=512"],
        &["scene=pirate"],
    ];
    let surfaces: u32 = states
        .iter()
        .zip(1..)
        .map(|(settings, seed)| explained("aueb7", settings, 100, seed))
        .sum();
    // The palace fills about a quarter of its picture.
    assert!(surfaces > 500, "only {surfaces} pixels showed a surface");
}

fn explanation(settings: &[&str], keys: &str, probe: Probe) -> Explanation {
    let mut bench = Bench::new("aueb7", [320, 320], settings);
    bench.press(keys);
    let explanation = bench.lab.explain(&bench.context.gl, probe, 1).unwrap();
    for step in &explanation.steps {
        assert!(step.agrees(), "{}\n{explanation}", step.name);
    }
    explanation
}

#[test]
fn a_point_under_a_sphere_is_in_shadow_and_one_beside_it_is_not() {
    // From the light at (5, 20, 0) through the sphere at (10, 0, 0) to the plane.
    let in_shadow = |x: f64, y: f64, keys: &str| {
        let probe = Probe::Point(dvec3(x, y, 0.0));
        explanation(&[], keys, probe).in_shadow.unwrap()
    };
    assert!(in_shadow(12.5, -10.0, ""));
    assert!(!in_shadow(0.0, -10.0, ""));
    // The world goes to the left, and light and shadow with it.
    assert!(!in_shadow(2.5, -10.0, ""));
    assert!(in_shadow(2.5, -10.0, &"<Left>".repeat(10)));
    // The light turns by half, and the shadow goes away from it.
    assert!(!in_shadow(21.0, -10.0, ""));
    let mut bench = Bench::new("aueb7", [320, 320], &["rotate_light=on"]);
    bench.lab.advance(180.0 / 25.0);
    let probe = Probe::Point(dvec3(21.0, -10.0, 0.0));
    let turned = bench.lab.explain(&bench.context.gl, probe, 1).unwrap();
    assert!(turned.steps.iter().all(|step| step.agrees()), "{turned}");
    assert_eq!(turned.in_shadow, Some(true), "{turned}");
}

#[test]
fn each_filter_asks_its_own_number_of_samples() {
    for (filter, samples) in [("none", 1), ("pcf_5", 5), ("pcf_9", 9)] {
        let filter = format!("filter={filter}");
        let explanation = explanation(&[&filter], "", Probe::Pixel([160, 200]));
        assert_eq!(explanation.tests.len(), samples);
        let step = |name| explanation.steps.iter().find(|step| step.name == name);
        assert_eq!(step("shadow_map_z").unwrap().gpu.len(), samples);
        let visible = &step("is_point_in_shadow").unwrap().gpu;
        let mean = visible.iter().sum::<f64>() / samples as f64;
        let factor = step("shadow_factor").unwrap().gpu[0];
        assert!((factor - mean).abs() < 1e-6, "{explanation}");
    }
}

#[test]
fn what_cannot_be_explained_is_told() {
    let refused = |setting: &str, keys: &str, probe: Probe| {
        let mut bench = Bench::new("aueb7", [320, 240], &[setting]);
        bench.press(keys);
        let explained = bench.lab.explain(&bench.context.gl, probe, 1);
        explained.err().unwrap().to_string()
    };
    let corner = Probe::Pixel([0, 0]);
    assert!(refused("shadows=off", "", corner).contains("expected shadows=on"));
    assert!(refused("filter=pcf_5", "<F1>", corner).contains("expected the filled surfaces"));
    let beside = Probe::Pixel([320, 0]);
    assert!(refused("filter=pcf_5", "", beside).contains("0,0 to 319,239"));
}
