//! `shadowlab report eecs487`, of a scene that is soon drawn. Nothing is timed.

mod common;

use std::collections::HashMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use common::work_folder;
use serde_json::Value;

const SCENE: &str = "
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
up = [0, 1, 0]
fovy = 45
near = 2
far = 7

[light]
kind = \"point\"
position = [0.3, 0.5, 0.3]
near = 0.1
far = 10

[[object]]
mesh = \"cube\"
scale = 0.5
translate = [0, -0.4, 0]
";

const WALLS: [&str; 6] = ["all", "floor", "left", "right", "ceiling", "rear"];
const ACCUMULATORS: usize = 7;

fn report(folder: &Path, rounds: usize) -> Command {
    std::fs::write(folder.join("cube.toml"), SCENE).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
    let rounds = rounds.to_string();
    command.current_dir(folder).args([
        "report",
        "eecs487",
        "--scene",
        "cube.toml",
        "--set",
        "tessellation=1",
        "--size",
        "48x48",
        "--device",
        "software",
        "--rounds",
        &rounds,
        "-o",
        "r",
    ]);
    command
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The rows that have these values.
fn rows<'a>(table: &'a Value, wanted: &[(&str, Value)]) -> Vec<&'a Value> {
    let fits = |row: &&Value| wanted.iter().all(|(name, value)| row[name] == *value);
    list(table).iter().filter(fits).collect()
}

#[test]
fn the_report_is_whole() {
    let folder = work_folder("eecs487-report");
    let output = report(&folder, 2).output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    let wrong = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{wrong}");
    assert!(
        told.ends_with("r/index.html\n") && told.lines().count() == 6,
        "{told}"
    );
    assert_eq!(std::fs::read_dir(folder.join("r")).unwrap().count(), 3);

    let text = std::fs::read(folder.join("r/report.json")).unwrap();
    let report: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(report["interrupted"], false);
    check_hard(&report["hard"]);
    check_errors(&report["errors"]);
    check_draws(&report["draws"]);
    check_equal(&report["equal"]);
    for row in rows(&report["methods"], &[("jitter_amount", 0.1.into())]) {
        assert!(number(&row["levels"]) <= 1.0, "{row}");
    }
    // Four numbers of lights, two amounts, two methods; two rounds each.
    let times = list(&report["times"]);
    assert_eq!(times.len(), 16);
    for row in times {
        let ms = list(&row["ms"]);
        assert!(
            ms.len() == 2 && ms.iter().all(|ms| number(ms) > 0.0),
            "{row}"
        );
    }
    check_csv(&folder.join("r/report.csv"), &report);
    check_page(&folder.join("r/index.html"));
}

fn check_hard(hard: &Value) {
    assert_eq!(list(hard).len(), 2 * WALLS.len());
    for wall in WALLS {
        for row in rows(hard, &[("clipped_to", wall.into())]) {
            let figures = &row["figures"];
            assert!(number(&figures["valid"]) > 100.0, "{row}");
            for wrong in ["false_shadow", "false_light"] {
                assert_eq!(figures[wrong]["pixels"], 0, "{row}");
            }
        }
    }
    // The control: there is a shadow that could be missed.
    let floor = rows(hard, &[("clipped_to", "floor".into())])[0];
    assert!(number(&floor["figures"]["shadowed"]) > 50.0, "{floor}");
}

fn check_errors(errors: &Value) {
    // Nine numbers of random lights, seven of even ones; two amounts.
    assert_eq!(list(errors).len(), 2 * (9 + 7) * ACCUMULATORS);
    let levels = |accumulator: &str, count: usize| {
        let wanted = [
            ("accumulator", accumulator.into()),
            ("num_jitters", count.into()),
        ];
        let rows = rows(errors, &wanted);
        let levels = rows
            .iter()
            .map(|row| number(&row["from_mean_in_levels"]["max"]));
        levels.fold(0.0, f64::max)
    };
    for count in [1, 16, 256] {
        assert!(
            levels("RGBA32F", count) < 0.51,
            "{count}: {}",
            levels("RGBA32F", count)
        );
    }
    // The control: eight bits lose more than the last rounding.
    assert!(levels("S8", 16) > 8.0 && levels("RGBA8", 16) > 1.0);
}

fn check_draws(draws: &Value) {
    let rms = |jitter: &str, count: usize| {
        let wanted = [
            ("jitter", jitter.into()),
            ("num_jitters", count.into()),
            ("jitter_amount", 0.1.into()),
        ];
        let squares = list(&rows(draws, &wanted)[0]["rms"])
            .iter()
            .map(|rms| number(rms).powi(2));
        squares.sum::<f64>().sqrt()
    };
    assert!(rms("random", 256) < rms("random", 1) / 8.0);
    assert!(rms("low-discrepancy", 64) <= rms("random", 256));
    // The control: random ones do not.
    assert!(rms("random", 64) > rms("random", 256));
}

fn check_equal(equal: &Value) {
    let levels = |accumulator: &str| {
        let rows = rows(equal, &[("accumulator", accumulator.into())]);
        assert_eq!(rows.len(), 10);
        rows.iter()
            .map(|row| number(&row["levels"]))
            .fold(0.0, f64::max)
    };
    assert_eq!(levels("RGBA32F"), 0.0);
    assert!(levels("S8") > 100.0, "the control");
}

/// Each line of the CSV is a row of the JSON, and its figures are the same.
fn check_csv(path: &Path, report: &Value) {
    let mut csv = csv::Reader::from_path(path).unwrap();
    let header = csv.headers().unwrap().clone();
    let records: Vec<_> = csv.records().map(|record| record.unwrap()).collect();
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for record in &records {
        let field = |name: &str| &record[header.iter().position(|column| column == name).unwrap()];
        let table = header.iter().position(|column| column == "table").unwrap();
        let row = counts.entry(&record[table]).or_default();
        let json = &report[field("table")][*row];
        *row += 1;
        for (column, value) in [
            ("num_jitters", &json["num_jitters"]),
            ("jitter_amount", &json["jitter_amount"]),
            ("integral_rms", &json["from_integral"]["rms"]),
            ("mean_max_levels", &json["from_mean_in_levels"]["max"]),
            ("levels", &json["levels"]),
            ("valid", &json["figures"]["valid"]),
            ("false_shadow", &json["figures"]["false_shadow"]["pixels"]),
        ] {
            match value.as_f64() {
                None => assert_eq!(field(column), "", "{column} of {json}"),
                Some(value) => {
                    let found: f64 = field(column).parse().unwrap();
                    assert!((found - value).abs() <= 1e-12 * value, "{column} of {json}");
                }
            }
        }
    }
    for (table, count) in counts {
        assert_eq!(count, list(&report[table]).len(), "{table}");
    }
}

fn check_page(path: &Path) {
    let page = std::fs::read_to_string(path).unwrap();
    for loads in ["src=", "href=", "url(", "@import"] {
        assert!(!page.contains(loads), "{loads}");
    }
    assert!(page.contains("SOFTWARE RENDERER") && !page.contains("INTERRUPTED"));
    // Error against lights, four of accumulators, two against time.
    assert_eq!(page.matches("<svg").count(), 7);
    for said in ["256 random lights", "numJitters", "the fast method takes"] {
        assert!(page.contains(said), "{said}");
    }
}

/// When something is finished depends on the machine, so the test waits longer and longer before it presses.
#[test]
fn ctrl_c_keeps_what_was_finished() {
    let folder = work_folder("eecs487-report-interrupted");
    for seconds in [1, 2, 4, 8, 16, 32] {
        let mut command = report(&folder, 1000);
        let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let running = command.spawn().unwrap();
        std::thread::sleep(Duration::from_secs(seconds));
        let kill = format!("kill -INT {}", running.id());
        assert!(
            Command::new("sh")
                .args(["-c", &kill])
                .status()
                .unwrap()
                .success()
        );
        let output = running.wait_with_output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        if output.status.code().is_none() || told.contains("nothing is written") {
            continue;
        }
        assert_eq!(output.status.code(), Some(130), "{told}");
        assert!(told.starts_with("shadowlab: interrupted"), "{told}");
        let text = std::fs::read(folder.join("r/report.json")).unwrap();
        let report: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(report["interrupted"], true);
        assert!(!list(&report["hard"]).is_empty());
        let page = std::fs::read_to_string(folder.join("r/index.html")).unwrap();
        assert!(page.contains("INTERRUPTED"));
        return;
    }
    panic!("nothing was finished in 32 seconds");
}
