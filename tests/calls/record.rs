//! The calls of a lab's picture, as `shadowlab trace` and as apitrace see them, and a check's controls: edited streams.

use std::path::Path;
use std::process::Command;

use super::{Line, in_pass, parse_apitrace, parse_c};

/// Whether a stream is the handout's.
pub type Check = fn(&[Line]) -> Result<(), String>;

fn output(command: &mut Command) -> Vec<u8> {
    let ran = command.output().unwrap_or_else(|error| {
        panic!("{command:?}: {error}; `cargo xtask test` installs what is missing")
    });
    let told = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{told}");
    ran.stdout
}

fn program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_shadowlab"))
}

/// The lines of `shadowlab trace`; options may follow the lab's name.
pub fn traced(lab: &str) -> Vec<Line> {
    let mut command = Command::new(program());
    command.arg("trace").args(lab.split(' '));
    let text = output(command.args(["--device", "software"]));
    parse_c(&String::from_utf8(text).unwrap())
}

/// The lines of apitrace on `shadowlab screenshot`, with its files in an empty folder.
pub fn seen_from_outside(lab: &str, folder: &Path) -> Vec<Line> {
    let record = folder.join("record.trace");
    output(
        Command::new("apitrace")
            .args(["trace", "--api", "egl", "--output"])
            .arg(&record)
            .arg(program())
            .arg("screenshot")
            .args(lab.split(' '))
            .args(["--device", "software", "-o"])
            .arg(folder.join("picture.png")),
    );
    let dump = output(
        Command::new("apitrace")
            .args(["dump", "--verbose", "--color=never"])
            .arg(&record),
    );
    parse_apitrace(&String::from_utf8_lossy(&dump))
}

/// Every call of these passes dropped, and swapped with the next one, must fail; returns how many edits that was.
pub fn dropping_and_swapping_fails(lines: &[Line], passes: &[&str], check: Check) -> usize {
    let mut edits = 0;
    for heading in passes {
        let is_heading = |line: &Line| line.heading() == Some(heading);
        let start = lines.iter().position(is_heading).unwrap() + 1;
        let calls = in_pass(lines, heading).iter();
        let length = calls.filter(|line| !line.name.is_empty()).count();
        for at in start..start + length {
            let mut dropped = lines.to_vec();
            dropped.remove(at);
            check(&dropped).expect_err(&format!("without {}", lines[at]));
            edits += 1;

            if let Some(next) = lines.get(at + 1)
                && next.heading().is_none()
                && next.name != lines[at].name
            {
                let mut swapped = lines.to_vec();
                swapped.swap(at, at + 1);
                check(&swapped).expect_err(&format!("{} after {next}", lines[at]));
                edits += 1;
            }
        }
    }
    edits
}

/// In the lines that hold a text, one argument made another, as in `("glViewport", "1024 → 500")`, must fail; returns
/// how many edits that was.
pub fn other_arguments_fail(lines: &[Line], edits: &[(&str, &str)], check: Check) -> usize {
    for (found, edited) in edits {
        let (from, to) = edited.split_once(" → ").unwrap();
        let mut changed = lines.to_vec();
        let mut count = 0;
        for line in changed
            .iter_mut()
            .filter(|line| line.to_string().contains(found))
        {
            for arg in line.args.iter_mut().filter(|arg| *arg == from) {
                *arg = to.to_owned();
                count += 1;
            }
        }
        assert!(count > 0, "{found}: {edited} changes nothing");
        check(&changed).expect_err(&format!("{found}: {edited}"));
    }
    edits.len()
}
