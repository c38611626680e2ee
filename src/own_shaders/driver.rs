//! What does not compile, and what does not link.

use super::subject::{Part, Subject};
use super::{Finding, stages};
use crate::gl::{self, inspect};

/// So many messages of one file are told: the first one is the cause of most others.
const MOST_MESSAGES: usize = 5;

/// `log` is what the driver said of the program that does not link.
pub fn check(gl: &gl::Context, subject: &Subject, log: &str, findings: &mut Vec<Finding>) {
    let before = findings.len();
    for part in subject.students() {
        if let Some(path) = part.path
            && let Err(log) = compile(gl, part)
        {
            let errors = inspect::messages(&log).filter(|(_, text)| !text.contains("warning"));
            // The first of a line is the cause of the others there.
            let mut told = Vec::new();
            let errors = errors.filter(|(line, _)| {
                let is_new = line.is_none() || !told.contains(line);
                told.push(*line);
                is_new
            });
            for (line, message) in errors.take(MOST_MESSAGES) {
                let text = format!("does not compile: {message}");
                findings.push(Finding::wrong((path, line), text));
            }
        }
    }
    if findings.len() > before {
        return;
    }
    // What the texts tell of the way between the stages says more than the driver, which knows no file and no line.
    stages::check(subject, None, findings);
    if !findings[before..].iter().any(Finding::is_wrong) {
        let (_, message) = inspect::first_message(log);
        let names: Vec<_> = subject.parts.iter().map(|part| part.name).collect();
        let text = format!("{} do not link: {message}", names.join(" and "));
        let mentioned = subject.students().find_map(|part| {
            let quoted = message.split(['`', '\'', '"']);
            let line = quoted.filter_map(|word| part.scan.line_of(word)).next()?;
            Some((part.path?, Some(line)))
        });
        let first = subject.students().find_map(|part| Some((part.path?, None)));
        let place = mentioned.or(first).expect("a student's file takes part");
        findings.push(Finding::wrong(place, text));
    }
}

fn compile(gl: &gl::Context, part: &Part) -> std::result::Result<(), String> {
    inspect::compiles(gl, part.stage, part.text)
}
