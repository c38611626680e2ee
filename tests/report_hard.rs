//! `shadowlab report hard` and `report scaling`: run small, their files are held against each other, against `measure` and
//! against what is expected of the cases. Nothing is timed.

mod common;

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use common::work_folder;
use serde_json::Value;
use shadowlab::hard::{self, anchor};
use shadowlab::labs::{self, Kind};

fn shadowlab(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
    command
        .current_dir(folder)
        .args(arguments.split_whitespace());
    command
}

fn succeeded(folder: &Path, arguments: &str) -> Output {
    let output = shadowlab(folder, arguments).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments}: {told}");
    output
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

fn read_json(path: &Path) -> Value {
    serde_json::from_str(&read(path)).unwrap()
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

/// The records of a CSV file, whose lines are all as long as its head.
fn records(path: &Path) -> Vec<csv::StringRecord> {
    let mut csv = csv::Reader::from_path(path).unwrap();
    csv.records().map(|record| record.unwrap()).collect()
}

/// What the lab offers, so that a test that is added is asked for.
fn shadow_tests(lab: &str) -> Vec<&'static str> {
    let mut settings = labs::find(lab).unwrap().settings.iter();
    let setting = settings.find(|setting| setting.name == "shadow_test");
    match setting.map(|setting| setting.kind) {
        Some(Kind::Choice(names)) => names.to_vec(),
        _ => vec!["handout"],
    }
}

fn of_shadow_test<'a>(tests: &'a [Value], name: &str) -> &'a Value {
    let mut tests = tests.iter();
    let found = tests.find(|test| test["shadow_test"] == name && test["depth_format"] == "");
    found.unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn a_case_is_held_against_what_is_expected_of_it() {
    let folder = work_folder("report-hard");
    let ran = succeeded(
        &folder,
        "report hard --scene hard:wall --rounds 1 --device software -o wall",
    );
    let told = String::from_utf8(ran.stdout).unwrap();
    assert!(
        told.contains("shadow_test=exact: holds 1 of 1 cases"),
        "{told}"
    );
    assert!(told.contains("controls fail as they must"), "{told}");
    assert!(!told.contains("NOT AS EXPECTED"), "{told}");
    assert!(told.ends_with("wall/index.html\n"), "{told}");

    let report = read_json(&folder.join("wall/report.json"));
    assert_eq!(report["interrupted"], false);
    assert_eq!([&report["width"], &report["height"]], [320, 240]);
    assert_eq!(list(&report["closed_form"]).len(), 0);
    assert_eq!(list(&report["cases"]).len(), 1);
    let tests = list(&report["cases"][0]["tests"]);
    for shadow_test in shadow_tests("cs541") {
        of_shadow_test(tests, shadow_test);
    }
    // Every promise is judged, and there is a control and a test that holds.
    for test in tests {
        assert_eq!(test["expected"].is_null(), test["as_expected"].is_null());
        assert_ne!(test["as_expected"], false, "{test}");
    }
    let any = |holds: fn(&Value) -> bool| tests.iter().any(holds);
    assert!(any(
        |test| test["control"] == true && test["verdict"] == "fails"
    ));
    assert!(any(
        |test| test["expected"] == "must hold" && test["verdict"] == "holds"
    ));
    assert_eq!(of_shadow_test(tests, "exact")["verdict"], "exact");

    let ran = succeeded(
        &folder,
        "measure cs541 --scene hard:wall --json --device software",
    );
    let measured: Value = serde_json::from_slice(&ran.stdout).unwrap();
    let handout = &of_shadow_test(tests, "handout")["errors"];
    for (name, value) in handout.as_object().unwrap() {
        assert_eq!(value, &measured[name], "{name}");
    }
    assert!(handout["false_light"]["interior"].as_u64().unwrap() >= 50);

    assert_eq!(records(&folder.join("wall/report.csv")).len(), tests.len());
    let page = read(&folder.join("wall/index.html"));
    assert!(page.contains("SOFTWARE RENDERER") && !page.contains("INTERRUPTED"));
    assert!(
        page.contains("<tr class=\"control\">"),
        "no control is marked"
    );
    assert!(!page.contains("<tr class=\"broken\">"));
    assert!(page.contains("class=\"cell fails\"") && page.contains("class=\"cell exact\""));
    let pictures = page.matches("data:image/png;base64,").count();
    assert_eq!(pictures, shadow_tests("cs541").len());

    // Where the case is about depth formats, every test that has a map is put to them.
    succeeded(
        &folder,
        "report hard --scene hard:near-far --rounds 1 --size 64x48 --device software -o formats",
    );
    let report = read_json(&folder.join("formats/report.json"));
    let tests = list(&report["cases"][0]["tests"]);
    let handouts = tests.iter().filter(|test| test["shadow_test"] == "handout");
    let formats: Vec<_> = handouts.map(|test| test["depth_format"].clone()).collect();
    let named = ["16", "24", "32F"].map(|format| format!("depth_format={format}"));
    assert_eq!(formats, [&[String::new()], &named[..]].concat());
    // At another size than the one that pixels were counted at, nothing is judged.
    assert!(tests.iter().all(|test| test["as_expected"].is_null()));
    assert!(report["summary"].to_string().contains("not judged"));
}

#[test]
fn every_case_and_the_closed_form_are_in_the_report() {
    let folder = work_folder("report-hard-all");
    succeeded(
        &folder,
        "report hard --rounds 1 --size 64x48 --device software -o all",
    );
    let report = read_json(&folder.join("all/report.json"));
    let names = list(&report["cases"]).iter();
    let names: Vec<_> = names.map(|case| case["case"].as_str().unwrap()).collect();
    let expected: Vec<_> = hard::cases().map(|case| case.name).collect();
    assert_eq!(names, expected);
    let planes = anchor::ANGLES.len() * anchor::MAP_SIZES.len() * anchor::BIASES.len();
    let closed_form = list(&report["closed_form"]);
    assert_eq!(closed_form.len(), planes);
    // Few pixels, but still a half without a bias, and none with more than enough.
    for row in closed_form {
        let (measured, told) = (&row["measured"], &row["told"]);
        let difference = measured.as_f64().unwrap() - told.as_f64().unwrap();
        assert!(difference.abs() < 0.1, "{row}");
    }
    let tests = list(&report["cases"]).iter();
    let tests: usize = tests.map(|case| list(&case["tests"]).len()).sum();
    assert_eq!(records(&folder.join("all/report.csv")).len(), tests);

    let page = read(&folder.join("all/index.html"));
    for theme in hard::THEMES {
        // Once over the pictures, once over the figures.
        assert_eq!(page.matches(theme.title).count(), 2, "{}", theme.title);
    }
    assert!(page.contains("The closed form"));
    let scores = list(&report["scores"]);
    let cases: u64 = scores[0]["cases"].as_u64().unwrap();
    assert_eq!(cases as usize, expected.len());
}

#[test]
fn scaling_has_every_size_and_its_slopes() {
    let folder = work_folder("report-scaling");
    let ran = succeeded(
        &folder,
        "report scaling --triangles 10000 --rounds 1 --size 64x48 --device software -o s",
    );
    let told = String::from_utf8(ran.stdout).unwrap();
    assert_eq!(told.lines().count(), 3, "{told}");
    assert!(told.ends_with("s/index.html\n"), "{told}");

    let report = read_json(&folder.join("s/report.json"));
    assert_eq!(report["interrupted"], false);
    let axes = list(&report["axes"]);
    let units: Vec<_> = axes.iter().map(|axis| axis["unit"].clone()).collect();
    assert_eq!(units, ["triangles", "texels"]);
    let mut points = 0;
    for axis in axes {
        let series = list(&axis["series"]);
        let names: Vec<_> = series.iter().map(|s| s["shadow_test"].clone()).collect();
        assert_eq!(names, shadow_tests("cs541"));
        for series in series {
            let own = list(&series["points"]);
            points += own.len();
            check_points(axis["unit"].as_str().unwrap(), series);
        }
        let slopes = list(&axis["slopes"]);
        let with_sizes = series.iter().filter(|s| list(&s["points"]).len() > 1);
        assert_eq!(slopes.len(), 4 * with_sizes.count());
        assert!(slopes.iter().all(|slope| slope["slope"].is_f64()));
    }
    assert_eq!(records(&folder.join("s/report.csv")).len(), points);
    let page = read(&folder.join("s/index.html"));
    assert_eq!(page.matches("<svg").count(), 8);
    assert!(page.contains("SOFTWARE RENDERER") && !page.contains("INTERRUPTED"));
}

fn check_points(unit: &str, series: &Value) {
    let points = list(&series["points"]);
    let number = |value: &Value| value.as_f64().unwrap();
    let counts: Vec<f64> = points.iter().map(|point| number(&point["count"])).collect();
    let memory = |point: &Value| number(&point["costs"]["memory"]["median"]);
    match (unit, series["shadow_test"].as_str().unwrap()) {
        ("triangles", _) => {
            // About 10^3, 10^3.5 and 10^4.
            assert_eq!(counts.len(), 3);
            assert!(counts.windows(2).all(|pair| pair[1] > 2.5 * pair[0]));
        }
        // The control: what has no map has no sizes of one.
        (_, "exact") => assert_eq!(counts, [0.0]),
        _ => {
            let sizes = [256.0, 512.0, 1024.0, 2048.0, 4096.0, 8192.0_f64];
            assert_eq!(counts, sizes.map(|size| size * size));
            // Four bytes for each texel, and what is the same in all.
            let more = memory(&points[5]) - memory(&points[4]);
            let texels = (counts[5] - counts[4]) / f64::from(1 << 20);
            assert!((more / texels - 4.0).abs() < 0.01, "{more} {texels}");
        }
    }
    assert!(
        points
            .windows(2)
            .all(|pair| memory(&pair[1]) > memory(&pair[0]))
    );
}

#[test]
fn what_makes_no_sense_is_told_in_a_line() {
    let folder = work_folder("report-hard-wrong");
    for (arguments, words) in [
        ("report hrad", "did you mean \"hard\""),
        ("report skaling", "did you mean \"scaling\""),
        ("report hard --set map_size=512", "expected no option but"),
        (
            "report hard --sweep map_size=256,512",
            "expected no option but",
        ),
        ("report hard --keys w", "expected no option but"),
        ("report hard --time 1", "expected no option but"),
        ("report hard --scene mine.toml", "expected hard:NAME"),
        ("report hard --scene hard:wal", "did you mean \"wall\""),
        ("report hard --triangles 10000", "expected report scaling"),
        ("report cs541 --triangles 10000", "expected report scaling"),
        ("report scaling --scene hard:wall", "expected no option but"),
        (
            "report scaling --set map_size=512",
            "expected no option but",
        ),
        ("report scaling --triangles 999", "999"),
        ("report hard --rounds 0", "0"),
        ("report hard --size 0x5", "WIDTHxHEIGHT"),
    ] {
        let output = shadowlab(&folder, arguments)
            .args(["-o", "r"])
            .output()
            .unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {told}");
        assert_eq!(told.lines().count(), 1, "{arguments}: {told}");
        assert!(told.contains(words), "{arguments}: {told}");
        assert!(!folder.join("r").exists(), "{arguments}");
    }
}

/// How many cases are finished when it is pressed depends on the machine, so the test waits longer and longer.
#[test]
fn ctrl_c_keeps_the_cases_that_were_finished() {
    let folder = work_folder("report-hard-interrupted");
    for seconds in [1, 2, 4, 8, 16, 32, 64] {
        let mut command = shadowlab(
            &folder,
            "report hard --rounds 30 --size 64x48 --device software -o r",
        );
        let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let running = command.spawn().unwrap();
        std::thread::sleep(Duration::from_secs(seconds));
        let pressed = Command::new("sh")
            .args(["-c", &format!("kill -INT {}", running.id())])
            .status()
            .unwrap();
        assert!(pressed.success());
        let output = running.wait_with_output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        if output.status.code().is_none() || told.contains("nothing is written") {
            continue;
        }
        assert_eq!(output.status.code(), Some(130), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        let report = read_json(&folder.join("r/report.json"));
        assert_eq!(report["interrupted"], true);
        let cases = list(&report["cases"]);
        assert!((1..hard::cases().count()).contains(&cases.len()));
        assert_eq!(list(&report["closed_form"]).len(), 0);
        assert!(read(&folder.join("r/index.html")).contains("INTERRUPTED"));
        return;
    }
    panic!("no case was finished in 64 seconds");
}
