//! The hard cases: every test on every case and in every depth format, in one table, held against what must come of it;
//! and the plane whose error is known in closed form. `cargo test --release --test hard_cases -- --nocapture` prints both.

mod common;

use std::collections::BTreeSet;

use common::{Bench, differing};
use glam::DVec3;
use shadowlab::ground_truth::Rays;
use shadowlab::hard::{self, Case, Expected, anchor};
use shadowlab::labs;
use shadowlab::measure::{Figures, Measure, Wrong};
use shadowlab::scene::Scene;

/// The most ambiguous pixels of a case: where many are, the truth says nothing.
const MOST_AMBIGUOUS: usize = 80;

/// One test of a case.
struct Row {
    settings: String,
    expected: Expected,
    figures: Figures,
}

/// A test's settings in each format of the depth texture that the lab offers, unless the test itself chooses one or has
/// no such texture.
fn in_each_depth_format(lab: &str, test: &str) -> Vec<String> {
    let settings = labs::find(lab).unwrap().settings;
    let has_formats = settings
        .iter()
        .any(|setting| setting.name == "depth_format");
    if !has_formats || test.contains("depth_format") || test == "shadow_test=exact" {
        return vec![test.to_owned()];
    }
    let formats = ["16", "24", "32F"];
    formats
        .map(|format| format!("{test} depth_format={format}"))
        .to_vec()
}

fn rows(case: &Case) -> Vec<Row> {
    let mut bench = Bench::with_scene(case.lab, (case.scene)(), hard::SIZE, &[]);
    let start = bench.lab.settings().clone();
    let rays = Rays::new(&bench.lab.now(), 0);
    let truth = rays.truth(hard::SIZE);
    let measure = Measure::new(&rays, &truth);
    let mut rows = Vec::new();
    for (test, expected) in case.tests() {
        for settings in in_each_depth_format(case.lab, test) {
            *bench.lab.settings() = start.clone();
            bench.set(&settings.split_whitespace().collect::<Vec<_>>());
            let visibility = bench.visibility();
            let map = bench.map_scale();
            rows.push(Row {
                figures: measure.measure(&visibility, map.as_ref()).0,
                settings,
                expected,
            });
        }
    }
    rows
}

fn line(case: &Case, row: &Row) -> String {
    let figures = &row.figures;
    let wrong = |wrong: &Wrong| {
        let Wrong {
            edge1,
            edge_t,
            interior,
            ..
        } = wrong;
        format!("{edge1:5} {edge_t:5} {interior:5}")
    };
    let gap = figures.contact_gap.map_or(String::new(), |gap| {
        let texels = gap.texels.map(|texels| format!("{texels:6.1}"));
        format!("{:10.4} {}", gap.world, texels.unwrap_or_default())
    });
    format!(
        "{:18}{:58}{}   {}   {:6} {gap:18} {:4}  {:?}",
        case.name,
        row.settings,
        wrong(&figures.false_shadow),
        wrong(&figures.false_light),
        figures.grey,
        figures.ambiguous,
        row.expected
    )
}

#[test]
fn every_test_does_on_every_case_as_expected() {
    println!(
        "{:18}{:58}{:17}   {:17}   {:6} {:18} {:4}  expected",
        "case", "test", "false shadow", "false light", "grey", "contact gap", "ambiguous"
    );
    println!(
        "{:76}{:>5} {:>5} {:>5}   {:>5} {:>5} {:>5}   {:6} {:>10} {:>6}",
        "", "edge1", "edgeT", "inner", "edge1", "edgeT", "inner", "", "world", "texels"
    );
    let mut complaints = Vec::new();
    for case in hard::cases() {
        for row in rows(case) {
            let line = line(case, &row);
            println!("{line}");
            let figures = &row.figures;
            if !row.expected.is_met(figures) || figures.ambiguous > MOST_AMBIGUOUS {
                complaints.push(line);
            }
        }
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn every_case_has_a_control_and_a_test_that_holds() {
    let mut names = BTreeSet::new();
    for case in hard::cases() {
        assert!(names.insert(case.name), "{} occurs twice", case.name);
        let tests = case.tests();
        let any = |is: fn(&Expected) -> bool| tests.iter().any(|(_, expected)| is(expected));
        let fails = any(|expected| {
            use Expected::{Exact, Holds, Shown};
            !matches!(expected, Holds(..) | Exact | Shown)
        });
        let holds = any(|expected| matches!(expected, Expected::Holds(..) | Expected::Exact));
        assert!(fails, "{}: no control", case.name);
        assert!(holds, "{}: no test that holds", case.name);
    }
}

/// The control: without its name, the lab's own scene is another.
#[test]
fn a_case_is_drawn_by_its_name() {
    let truth = |arguments: &str| {
        let program = std::process::Command::new(env!("CARGO_BIN_EXE_shadowlab"))
            .args(format!("truth cs541 --json {arguments}").split_whitespace())
            .output()
            .unwrap();
        assert!(program.status.success(), "{arguments}");
        let figures: serde_json::Value = serde_json::from_slice(&program.stdout).unwrap();
        ["width", "height", "shadowed"].map(|key| figures[key].as_u64().unwrap())
    };
    let [width, height, shadowed] = truth("--scene hard:wall");
    assert_eq!([width, height], hard::SIZE.map(u64::from));
    assert!(shadowed > 10_000, "{shadowed}");
    assert!(truth("--size 320x240")[2] < shadowed);
}

/// The control of the table: each promise is kept by some figures and broken by others.
#[test]
fn a_promise_can_be_broken() {
    let none = Wrong::default();
    let good = &Figures {
        lit: 1000,
        shadowed: 1000,
        ambiguous: 0,
        false_shadow: none,
        false_light: none,
        grey: 0,
        contact_gap: None,
        bias: None,
    };
    let mut edge = good.clone();
    edge.false_shadow.edge1 = 1;
    let mut dark = good.clone();
    dark.false_shadow.interior = 7;
    dark.grey = 7;
    let mut bright = good.clone();
    bright.false_light.interior = 7;
    bright.false_light.edge_t = 7;
    for (expected, kept, broken) in [
        (Expected::FalseShadow(7), &dark, good),
        (Expected::FalseShadow(7), &dark, &bright),
        (Expected::Grey(7), &dark, good),
        (Expected::FalseLight(7), &bright, &dark),
        (Expected::Unresolved(7), &bright, &dark),
        (Expected::Holds(0, 0), good, &dark),
        (Expected::Holds(7, 0), &dark, &bright),
        (Expected::Holds(0, 7), &bright, &dark),
        (Expected::Exact, good, &edge),
    ] {
        assert!(expected.is_met(kept), "{expected:?}");
        assert!(!expected.is_met(broken), "{expected:?}");
    }
}

/// Bit for bit where only the place differs; elsewhere rounding may move an edge.
#[test]
fn the_same_scene_elsewhere_has_the_same_shadows() {
    let visibility = |scene: Scene| Bench::with_scene("cs541", scene, hard::SIZE, &[]).visibility();
    let scene = |name: &str| (hard::find(name).unwrap().scene)();
    let here = visibility(scene("here"));
    for (name, most) in [
        ("far-1e5", 0),
        ("far-1e6", 0),
        ("scale-1e-3", 10),
        ("scale-1e4", 10),
    ] {
        let found = differing(&here, &visibility(scene(name)));
        println!("{name}: {found} pixels differ");
        assert!(found <= most, "{name}: {found}");
    }
    // The control: what an f32 world would do to the light, 1e6 from the origin.
    let mut rounded = scene("here");
    rounded.lights[0].position += DVec3::splat(1.0 / 16.0);
    assert!(differing(&here, &visibility(rounded)) > 50);
}

/// The settings that are given as lengths of the world are none: a Plane's second copy scales with it.
#[test]
fn a_second_plane_scales_with_its_plane() {
    let settings = ["remedy=culling", "second_plane=on"];
    let visibility =
        |scene: Scene| Bench::with_scene("cs541", scene, hard::SIZE, &settings).visibility();
    let scene = (hard::find("single-sided").unwrap().scene)();
    let here = visibility(scene.clone());
    for factor in [1e-3, 1e4] {
        let there = visibility(scene.clone().scaled(factor));
        assert!(differing(&here, &there) <= 10, "{factor}");
    }
}

/// The share of the plane that is falsely dark, on the lab that has one constant bias and no filter.
#[test]
fn acne_is_as_frequent_as_the_closed_form_says() {
    println!("angle   map   bias in texels   measured   closed form");
    let mut worst: f64 = 0.0;
    for degrees in anchor::ANGLES {
        let scene = anchor::tilted(degrees);
        let mut bench = Bench::with_scene(anchor::LAB, scene, hard::SIZE, &[]);
        for map_size in anchor::MAP_SIZES {
            let texel = anchor::texel(map_size);
            for share in anchor::BIASES {
                let bias = share * anchor::deepest(texel, degrees);
                let map_size = format!("map_size={map_size}");
                bench.set(&[&map_size, &format!("bias={}", anchor::in_depth(bias))]);
                let visibility = bench.visibility();
                let dark = visibility.pixels().filter(|pixel| pixel.0[0] == 0).count();
                let measured = dark as f64 / visibility.len() as f64;
                let expected = anchor::false_shadow(texel, degrees, bias);
                println!(
                    "{degrees:5} {:>5} {:16.3} {:9.2}% {:12.2}%",
                    &map_size[9..],
                    bias / texel,
                    100.0 * measured,
                    100.0 * expected
                );
                worst = worst.max((measured - expected).abs());
            }
        }
    }
    println!("worst: {:.2} percentage points", 100.0 * worst);
    assert!(worst < 0.01, "{worst}");
    // The control: the same plane by the formula of another angle.
    let wrong = anchor::false_shadow(0.01, 45.0, 0.002) - anchor::false_shadow(0.01, 60.0, 0.002);
    assert!(wrong.abs() > 0.05);
}
