//! `check-trace`: dumps of real programs and of the labs, right ones and with each mistake that calls can show.
//!
//! The dumps of `tests/dumps` were made by the programs beside them (see the README there), those of the labs are made
//! here. No test needs apitrace.

mod bad;
mod labs;
mod may_differ;
mod table;

use std::path::{Path, PathBuf};

use shadowlab::calls::{self, Mark, Report, Step};
use shadowlab::progress::Progress;

/// What the library says of a dump.
fn check(text: &str, lab: &'static str) -> Report {
    try_check(text.as_bytes(), lab).unwrap_or_else(|error| panic!("{error}"))
}

fn try_check(text: &[u8], lab: &'static str) -> shadowlab::Result<Report> {
    let progress = Progress::new("reading", text.len() as u64);
    calls::check(text, Path::new("dump.txt"), lab, &progress)
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dumps")
}

fn dump(name: &str) -> String {
    let path = folder().join(name).with_extension("txt");
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The lab that a program is for.
fn lab_of(dump: &str) -> &'static str {
    match dump.split('-').next() {
        Some("legacy") => "cmsc23700",
        Some("core33") => "cs541",
        Some("dsa45") => "csci3260",
        Some("planar") => "eecs487",
        _ => panic!("{dump}: of which program?"),
    }
}

fn wrong(report: &Report) -> Vec<&Step> {
    let is_wrong = |step: &&Step| !matches!(step.mark, Mark::Found | Mark::Unclear);
    report.steps.iter().filter(is_wrong).collect()
}

/// Nothing is wrong, and so many steps are found: a report that found nothing would be clean, too.
fn assert_clean(report: &Report, at_least: usize, what: &str) {
    let text = report.text();
    assert!(report.is_clean(), "{what}: {text}");
    let found = report.count(|mark| mark == Mark::Found);
    assert!(found >= at_least, "{what}: {found} steps are found: {text}");
}
