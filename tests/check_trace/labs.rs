//! What `shadowlab trace` writes of the labs: clean, and with each mistake that calls can show told by its name.

use std::process::Command;

use shadowlab::calls::{Mark, Report};
use shadowlab::labs::LABS;
use shadowlab::mistakes::{self, Made};

use super::{assert_clean, check};

fn traced(lab: &str, options: &[&str]) -> String {
    let ran = Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .args(["trace", lab, "--device", "software"])
        .args(options)
        .output()
        .unwrap();
    assert!(
        ran.status.success(),
        "{lab} {options:?}: {}",
        String::from_utf8_lossy(&ran.stderr)
    );
    String::from_utf8(ran.stdout).unwrap()
}

fn report(lab: &'static str, options: &[&str]) -> Report {
    check(&traced(lab, options), lab)
}

#[test]
fn the_labs_are_clean() {
    for lab in LABS {
        let found = if lab.name == "eecs487" { 3 } else { 20 };
        assert_clean(&report(lab.name, &[]), found, lab.name);
    }
    for (lab, options, found) in [
        ("cs541", ["--set", "remedy=culling"], 21),
        ("cs541", ["--set", "map_size=256"], 20),
        ("cs541", ["--size", "1024x1024"], 20),
        ("csci3260", ["--set", "scene=room"], 20),
        ("cmsc23700", ["--set", "lights=spotlight"], 18),
        ("aueb7", ["--set", "scene=pirate"], 20),
        ("eecs487", ["--keys", "f"], 7),
        ("eecs487", ["--keys", "fc"], 10),
        ("eecs487", ["--keys", "fc+++"], 10),
        ("cs541", ["--frames", "3"], 20),
    ] {
        assert_clean(&report(lab, &options), found, &format!("{lab} {options:?}"));
    }
}

/// Made in the calls, and yet not to be seen in them: a number that is right or wrong by the scene alone.
const NOT_IN_CALLS: &[&str] = &[
    "too_much_bias",
    "frustum_too_small",
    "frustum_too_large",
    "outside_wrong",
    "specular_in_shadow",
];

/// Calls show it, in these states of the lab.
fn state(lab: &str, mistake: &str) -> &'static [&'static str] {
    match (lab, mistake) {
        ("cs541", "light_along_up") => &["--scene", "hard:overhead"],
        ("eecs487", "weights_wrong" | "accumulator_not_cleared") => &["--keys", "f"],
        _ => &[],
    }
}

fn changes_calls(made: &Made) -> bool {
    !made.edits.calls.is_empty() || !made.edits.uniforms.is_empty()
}

#[test]
fn the_labs_mistakes_are_told() {
    let mut told = 0;
    for lab in LABS {
        for (mistake, made) in mistakes::of_lab(lab.name) {
            if !changes_calls(made) || NOT_IN_CALLS.contains(&mistake.name) {
                continue;
            }
            let options = state(lab.name, mistake.name);
            let without = report(lab.name, options);
            let report = report(lab.name, &[options, &["--mistake", mistake.name]].concat());
            let is_told = |report: &Report| {
                let mut steps = report.steps.iter();
                steps.any(|step| step.mistake == Some(mistake.name) && step.mark != Mark::Found)
            };
            let what = format!("{} {}: {}", lab.name, mistake.name, report.text());
            assert!(is_told(&report), "{what}");
            assert!(!is_told(&without), "told without it: {what}");
            // Whether the shader of cs541 asks where a point is, and which near plane is near, no call says.
            let judged = ["near_too_small", "degrees_for_radians"].contains(&mistake.name)
                || lab.name == "cs541" && mistake.name == "repeat_outside";
            assert!(judged || !report.is_clean(), "{what}");
            told += 1;
        }
    }
    assert!(told >= 50, "{told} mistakes");
}

/// The control: what is in the shaders alone is in no call, and nothing is told of it.
#[test]
fn what_is_not_in_calls_is_not_told() {
    for (lab, mistake) in [
        ("cs541", "comparison_reversed"),
        ("csci3260", "ambient_in_shadow"),
        ("cmsc23700", "no_division_by_w"),
        ("aueb7", "beyond_far"),
        ("eecs487", "divided_early"),
    ] {
        let (_, made) = mistakes::find(mistake, lab).unwrap();
        assert!(!changes_calls(made), "{lab} {mistake}");
        assert!(
            report(lab, &["--mistake", mistake]).is_clean(),
            "{lab} {mistake}"
        );
    }
}
