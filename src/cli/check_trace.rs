//! `check-trace`: a dump of my own program's GL calls, held against the handout's steps.

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde_json::json;
use shadowlab::calls::{self, Mark, Report};
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, labs};

/// Something is wrong with the calls; of what the command cannot read it is 2.
const WRONG: u8 = 1;
pub const TROUBLE: u8 = 2;

#[derive(Args)]
pub struct CheckTraceCommand {
    /// The text of `apitrace dump program.trace`, or of `shadowlab trace`
    #[arg(value_name = "DUMP.txt")]
    dump: PathBuf,
    /// The lab whose handout the program follows
    lab: String,
    /// Print JSON in place of text
    #[arg(long)]
    json: bool,
}

impl CheckTraceCommand {
    pub fn run(&self) -> Result<ExitCode> {
        let lab = labs::find(&self.lab)?.name;
        let reading = |cause| Error::reading(&self.dump, cause);
        let file = File::open(&self.dump).map_err(reading)?;
        let size = file.metadata().map_err(reading)?.len();
        let progress = Progress::new("reading", size);
        let report = calls::check(BufReader::new(file), &self.dump, lab, &progress)?;
        drop(progress);
        super::print(&if self.json {
            to_json(&report)
        } else {
            report.text()
        })?;
        Ok(ExitCode::from(if report.is_clean() { 0 } else { WRONG }))
    }
}

fn to_json(report: &Report) -> String {
    let steps: Vec<_> = report
        .steps
        .iter()
        .map(|step| {
            json!({
                "place": step.place,
                "asked": step.asked,
                "verdict": step.mark.name(),
                "line": step.line,
                "found": step.found,
                "picture": step.effect,
                "mend": step.fix,
                "mistake": step.mistake,
            })
        })
        .collect();
    let value = json!({
        "lab": report.lab,
        "calls": report.calls,
        "frames": report.frames,
        "judged_lines": report.judged,
        "steps": steps,
        "found": report.count(|mark| mark == Mark::Found),
        "wrong": report.wrong(),
        "not_certain": report.count(|mark| mark == Mark::Unclear),
    });
    format!("{value:#}\n")
}
