//! `shadowlab report`: run small, its files are held against each other and against `measure`. Nothing is timed.

mod common;

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use common::{Bench, work_folder};
use serde_json::{Value, json};
use shadowlab::gl::{self, trace};
use shadowlab::labs::LABS;

const SIZE: [&str; 4] = ["--size", "96x72", "--device", "software"];

fn shadowlab(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
    command
        .current_dir(folder)
        .args(arguments.split_whitespace())
        .args(SIZE);
    command
}

fn succeeded(mut command: Command) -> Output {
    let output = command.output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    output
}

fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

/// What a page would load from elsewhere.
fn links(page: &str) -> Vec<&str> {
    let mut links = Vec::new();
    for attribute in ["src=\"", "href=\"", "url(", "@import"] {
        for (at, _) in page.match_indices(attribute) {
            let target = &page[at + attribute.len()..];
            if !target.starts_with("data:") {
                links.push(&target[..target.len().min(20)]);
            }
        }
    }
    links
}

#[test]
fn the_report_is_whole_and_agrees_with_measure() {
    let folder = work_folder("report");
    let ran = succeeded(shadowlab(
        &folder,
        "report csci3260 --set map_size=512 --sweep scene=course,room --sweep stage=constant,thick,pcf --rounds 2 -o a/b",
    ));
    let told = String::from_utf8(ran.stdout).unwrap();
    assert_eq!(told.lines().count(), 3, "{told}");
    assert!(told.ends_with("a/b/index.html\n"), "{told}");
    assert_eq!(std::fs::read_dir(folder.join("a/b")).unwrap().count(), 3);

    let report = read_json(&folder.join("a/b/report.json"));
    assert_eq!(report["machine"]["software"], true);
    assert_eq!(report["interrupted"], false);
    let lab = &report["labs"][0];
    assert_eq!(lab["lab"], "csci3260");
    let options = json!([
        "--set",
        "map_size=512",
        "--sweep",
        "scene=course,room",
        "--sweep",
        "stage=constant,thick,pcf"
    ]);
    assert_eq!(lab["options"], options);
    let comparisons = list(&lab["comparisons"]);
    // In the course's scene there is nothing to thicken, but it is another row all the same.
    let settings = [json!([]), json!(["stage=thick"]), json!(["stage=pcf"])];
    for (comparison, scene) in comparisons.iter().zip(["scene=course", "scene=room"]) {
        assert_eq!(comparison["set"], json!([scene]));
        let rows = list(&comparison["rows"]);
        let found: Vec<_> = rows.iter().map(|row| row["settings"].clone()).collect();
        assert_eq!(found, settings, "{scene}");
        assert_eq!(rows[0]["frame"]["ratio"], 1.0);
        assert_eq!(rows[0]["rest"]["ratio"], 1.0);
        assert_eq!(rows.iter().filter(|row| row["chosen"] == true).count(), 1);
        assert!(rows.iter().any(|row| row["pareto"] == true));
        for row in rows {
            check_row(row);
            check_errors(&folder, scene, row);
        }
    }
    assert_eq!(comparisons.len(), 2);
    // The control for the truths: a wall that is thicker shadows more, and is measured against rays that know it.
    let lit = |row: usize| {
        comparisons[1]["rows"][row]["lights"][0]["lit"]
            .as_u64()
            .unwrap()
    };
    assert!(lit(1) != lit(0) && lit(2) == lit(0));

    check_csv(&folder.join("a/b/report.csv"), comparisons);
    check_page(&folder.join("a/b/index.html"));
}

fn check_row(row: &Value) {
    for time in ["frame", "rest", "shadow_pass", "lighting"] {
        let number = |name: &str| row[time][name].as_f64().unwrap();
        assert!(
            number("ms") > 0.0 && number("ms_p95") >= number("ms"),
            "{time}: {row}"
        );
    }
    // Of two rounds no interval can be told.
    assert_eq!(row["frame"]["ratio_95"], Value::Null);
    let outside = row["outside_gl"].as_f64().unwrap();
    assert!(outside > 0.0 && outside < 1.0, "{row}");
    assert!(row["outside_gl_ms"].as_f64().unwrap() > 0.0, "{row}");
    // No row here is without shadows.
    assert_eq!(row["look_ups"], Value::Null);
    assert_eq!(row["shading_ms"], Value::Null);
    let calls = &row["gl_calls"];
    assert!(calls["rest"].as_u64().unwrap() > 10, "{row}");
    assert!(calls["frame"].as_u64() > calls["rest"].as_u64(), "{row}");
    // The map's 512² texels of four bytes.
    assert_eq!(row["bytes"]["drawn_into"], 4 << 18);
    assert!(row["bytes"]["textures"].as_u64().unwrap() > 1 << 20);
    assert!(row["bytes"]["buffers"].as_u64().unwrap() > 1 << 15);
}

fn check_errors(folder: &Path, scene: &str, row: &Value) {
    let row_settings = list(&row["settings"])
        .iter()
        .map(|text| format!("--set {}", text.as_str().unwrap()));
    let settings: Vec<_> = row_settings.collect();
    let ran = succeeded(shadowlab(
        folder,
        &format!(
            "measure csci3260 --json --set map_size=512 --set {scene} {}",
            settings.join(" ")
        ),
    ));
    let measured: Value = serde_json::from_slice(&ran.stdout).unwrap();
    let reported = &list(&row["lights"])[0];
    for (name, value) in reported.as_object().unwrap() {
        assert_eq!(value, &measured[name], "{scene} {settings:?}: {name}");
    }
    assert!(reported["valid"].as_u64().unwrap() > 1000);
}

fn check_csv(path: &Path, comparisons: &[Value]) {
    let mut csv = csv::Reader::from_path(path).unwrap();
    let header = csv.headers().unwrap().clone();
    let records: Vec<_> = csv.records().map(|record| record.unwrap()).collect();
    let rows = comparisons
        .iter()
        .flat_map(|comparison| list(&comparison["rows"]));
    let rows: Vec<_> = rows.collect();
    assert_eq!(records.len(), rows.len());
    for (record, row) in records.iter().zip(rows) {
        let field = |name: &str| {
            let index = header.iter().position(|column| column == name);
            &record[index.unwrap_or_else(|| panic!("no column {name}"))]
        };
        let number = |name: &str| field(name).parse::<f64>().unwrap();
        let settings = list(&row["settings"])
            .iter()
            .map(|text| text.as_str().unwrap());
        assert_eq!(field("settings"), settings.collect::<Vec<_>>().join(" "));
        for (column, value) in [
            ("frame_ratio", &row["frame"]["ratio"]),
            ("rest_ms", &row["rest"]["ms"]),
            ("lighting_ms_p95", &row["lighting"]["ms_p95"]),
            ("outside_gl", &row["outside_gl"]),
            ("gl_calls_rest", &row["gl_calls"]["rest"]),
            ("bytes_buffers", &row["bytes"]["buffers"]),
            ("valid", &row["lights"][0]["valid"]),
            ("ambiguous", &row["lights"][0]["ambiguous"]),
            ("false_shadow", &row["lights"][0]["false_shadow"]["pixels"]),
            (
                "false_light_edgeT",
                &row["lights"][0]["false_light"]["edgeT"],
            ),
            (
                "false_light_ambiguous",
                &row["lights"][0]["false_light"]["ambiguous"],
            ),
            ("grey", &row["lights"][0]["grey"]),
        ] {
            // serde_json may miss the last digit as it reads.
            let (found, value) = (number(column), value.as_f64().unwrap());
            assert!(
                (found - value).abs() <= 1e-12 * value,
                "{column}: {found}, {value}"
            );
        }
        assert_eq!(field("chosen"), row["chosen"].to_string());
        assert_eq!(field("rounds"), "2");
        assert_eq!(field("frame_ratio_low"), "");
        assert_eq!(field("look_ups_ms"), "");
    }
}

fn check_page(path: &Path) {
    let page = std::fs::read_to_string(path).unwrap();
    assert_eq!(links(&page), [""; 0]);
    assert!(page.contains("SOFTWARE RENDERER") && page.contains("llvmpipe"));
    assert!(!page.contains("INTERRUPTED"));
    // Error against time, and the frame in bars.
    assert_eq!(page.matches("<svg").count(), 2 * 2);
    assert!(page.contains("lighting, look-ups and all") && !page.contains("look-ups</li>"));
    // Each row is a disc and its rim, and has a line of the table and a thumbnail.
    assert_eq!(page.matches("<circle").count(), 2 * 6);
    assert_eq!(page.matches("<td class=\"name\"").count(), 6);
    let mut colors = std::collections::BTreeSet::new();
    for (at, start) in page.match_indices("data:image/png;base64,") {
        let text = page[at + start.len()..].split('"').next().unwrap();
        let picture = image::load_from_memory(&STANDARD.decode(text).unwrap()).unwrap();
        let picture = picture.into_rgb8();
        assert_eq!(picture.dimensions(), (96, 72));
        colors.extend(picture.pixels().map(|pixel| pixel.0));
    }
    assert!(colors.contains(&[40, 80, 230]), "no false light anywhere");
    assert!(colors.contains(&[220, 30, 30]), "no false shadow anywhere");

    // The control: a page that loads something is found.
    for edit in [
        "<img src=\"a.png\">",
        "<link href=\"https://a/b.css\">",
        "url(a.woff)",
    ] {
        let edited = format!("{page}{edit}");
        assert_eq!(links(&edited).len(), 1, "{edit}");
    }
}

/// Where a row is without shadows, the lighting of the others falls into look-ups and shading.
#[test]
fn the_frame_is_taken_apart() {
    let folder = work_folder("report-parts");
    succeeded(shadowlab(
        &folder,
        "report cs541 --sweep shadows=on,off --rounds 2 -o r",
    ));
    let report = read_json(&folder.join("r/report.json"));
    let rows = list(&report["labs"][0]["comparisons"][0]["rows"]);
    assert_eq!(rows[1]["settings"], json!(["shadows=off"]));
    let number = |value: &Value| value.as_f64().unwrap();
    let look_ups = |row: usize| number(&rows[row]["look_ups"]["ms"]);
    assert_eq!(look_ups(1), 0.0);
    // Medians of two rounds are means.
    let lighting = |row: usize| number(&rows[row]["lighting"]["ms"]);
    assert!((look_ups(0) - (lighting(0) - lighting(1))).abs() < 1e-9);
    for (row, value) in rows.iter().enumerate() {
        let (shading, outside) = (
            number(&value["shading_ms"]),
            number(&value["outside_gl_ms"]),
        );
        let in_gl = lighting(row) - look_ups(row);
        assert!(shading < in_gl && in_gl < shading + outside, "{value}");
    }
    let mut csv = csv::Reader::from_path(folder.join("r/report.csv")).unwrap();
    let column = csv
        .headers()
        .unwrap()
        .iter()
        .position(|name| name == "shading_ms");
    let record = csv.records().next().unwrap().unwrap();
    let written: f64 = record[column.unwrap()].parse().unwrap();
    assert!((written - number(&rows[0]["shading_ms"])).abs() < 1e-9);
    let page = std::fs::read_to_string(folder.join("r/index.html")).unwrap();
    // Of two rounds on a busy machine, look-ups may come to less than nothing, and have no bar then.
    assert!(page.contains("shading</li>") && !page.contains("lighting, look-ups and all"));
}

/// Started with far more rounds than anybody waits for.
fn endless(folder: &Path) -> Child {
    let mut command = shadowlab(
        folder,
        "report cs541 --sweep map_size=256..2048 --rounds 1000 -o r",
    );
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// When the first round is finished depends on the machine, so the test waits longer and longer before it presses.
#[test]
fn ctrl_c_keeps_the_rounds_that_were_finished() {
    let folder = work_folder("report-interrupted");
    for seconds in [1, 2, 4, 8, 16, 32, 64] {
        let running = endless(&folder);
        std::thread::sleep(Duration::from_secs(seconds));
        // The shell has its own: a small system has no program of that name.
        let pressed = Command::new("sh")
            .args(["-c", &format!("kill -INT {}", running.id())])
            .status()
            .unwrap();
        assert!(pressed.success());
        let output = running.wait_with_output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        if output.status.code().is_none() {
            // Before anybody watched for it, it ended the program.
            continue;
        }
        assert_eq!(output.status.code(), Some(130), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(told.starts_with("shadowlab: interrupted"), "{told}");
        if told.contains("nothing is written") {
            assert!(!folder.join("r").exists(), "{told}");
            continue;
        }
        let report = read_json(&folder.join("r/report.json"));
        assert_eq!(report["interrupted"], true);
        let rows = list(&report["labs"][0]["comparisons"][0]["rows"]);
        assert_eq!(rows.len(), 4);
        let rounds: Vec<_> = rows
            .iter()
            .map(|row| row["rounds"].as_u64().unwrap())
            .collect();
        assert!((1..1000).contains(&rounds[0]), "{rounds:?}");
        assert!(
            rounds.iter().all(|number| *number == rounds[0]),
            "{rounds:?}"
        );
        let page = std::fs::read_to_string(folder.join("r/index.html")).unwrap();
        assert!(page.contains("INTERRUPTED: of 1000 rounds"));
        return;
    }
    panic!("no round was finished in 64 seconds");
}

/// A pass is timed where somebody asks, and the driver is kept waiting nowhere else.
#[test]
fn passes_are_timed_only_on_demand() {
    let finishes = |events: &[trace::Event]| {
        let calls = events.iter().filter(|event| match event {
            trace::Event::Call(call) => call.name == "glFinish",
            trace::Event::Pass(_) => false,
        });
        calls.count()
    };
    for lab in LABS.iter().filter(|lab| !lab.comparisons.is_empty()) {
        let mut bench = Bench::recorded(lab.name, [64, 64], &["redraw=every_frame"]);
        bench.render();
        trace::take();
        let ((), passes) = gl::time_passes(|| bench.render());
        let events = trace::take();
        let headings = events.iter().filter_map(|event| match event {
            trace::Event::Pass(name) => Some(name.as_str()),
            trace::Event::Call(_) => None,
        });
        let timed = passes.iter().map(|pass| pass.name.as_str());
        assert_eq!(timed.collect::<Vec<_>>(), headings.collect::<Vec<_>>());
        assert!(passes.len() >= 2 && passes.iter().all(|pass| pass.ms > 0.0));
        assert!(
            passes.iter().all(|pass| pass.in_calls_ms == 0.0),
            "nobody watches"
        );
        assert_eq!(finishes(&events), 2 * passes.len(), "the control");
        let watched = trace::in_calls(|| gl::time_passes(|| bench.render()));
        let (((), passes), inside) = watched;
        assert!(
            passes
                .iter()
                .all(|pass| 0.0 < pass.in_calls_ms && pass.in_calls_ms < pass.ms)
        );
        let in_passes: f64 = passes.iter().map(|pass| pass.in_calls_ms).sum();
        assert!(in_passes < 1000.0 * inside.as_secs_f64());
        bench.render();
        assert_eq!(finishes(&trace::take()), 0, "{}", lab.name);
    }
}

#[test]
fn a_recorded_context_can_be_left_alone() {
    let mut bench = Bench::recorded("cs541", [64, 64], &["redraw=every_frame"]);
    trace::take();
    trace::unrecorded(|| bench.render());
    assert_eq!(trace::take(), []);
    let begun = std::time::Instant::now();
    let ((), inside) = trace::in_calls(|| bench.render());
    let total = begun.elapsed();
    assert!(inside > Duration::ZERO && inside < total);
    assert_eq!(trace::take(), []);
    bench.render();
    assert!(trace::take().len() > 100, "the control");
}
