//! Speed against error: settings × scene → rows of time and mistakes, and what they advise.
//!
//! | file | what |
//! |---|---|
//! | [`hard`] | the hard cases, each under every test |
//! | [`scaling`] | how cost grows with triangles and texels |
//! | `sweep.rs` | which rows there are: the combinations of settings |
//! | `run.rs` | measuring them, in rounds |
//! | `truths.rs` | the truth of each scene, cast once |
//! | `summary.rs` | medians, ratios and their intervals, the Pareto front, the choice |
//! | `advice.rs` | the sentence that says which setting to choose, and what it costs |
//! | `statistics.rs` | medians and intervals of a sample |
//! | `thumbnail.rs` | the mistakes, small |
//! | `plot.rs`, `labels.rs` | error against time; what is written beside its points |
//! | `bars.rs` | a frame taken apart |
//! | `page.rs`, `files.rs` | the page; CSV and JSON |
//! | `sheet.rs` | what every page begins with |
//! | `bench.rs` | a lab that is started with a scene of the report's own |
//! | `words.rs` | figures and rows as a reader sees them |
//! | [`soft`] | soft shadows from many lights: a report of its own |
//! | `machine.rs` | what it was measured on |
//!
//! It is a room of its own, above the labs and the contexts, because it needs both and neither needs it: a lab is known
//! by its settings and by [`Lab`](crate::labs::Lab) alone, so whatever else is a lab with settings can be reported on.

mod advice;
mod bars;
mod bench;
mod files;
pub mod hard;
mod labels;
mod machine;
mod page;
mod plot;
mod run;
pub mod scaling;
mod sheet;
pub mod soft;
mod statistics;
mod summary;
mod sweep;
mod thumbnail;
mod truths;
mod words;

use std::path::{Path, PathBuf};

use maud::Markup;
use serde_json::Value;

pub use machine::Machine;
pub use run::{Calls, Row, Subject, Times, measure, steps};
pub use sweep::{Plan, Sweep};

use summary::Summary;

use crate::labs::Handout;
use crate::{Error, Result, picture};

/// Everything that is written.
pub struct Report {
    pub machine: Machine,
    pub labs: Vec<LabReport>,
    /// How many rounds were asked for, if not all of them were finished.
    pub interrupted: Option<usize>,
}

/// What was found of one lab.
pub struct LabReport {
    pub handout: &'static Handout,
    pub size: [u32; 2],
    /// The options that brought the lab to its state, as another command line would repeat them.
    pub options: Vec<String>,
    pub comparisons: Vec<Compared>,
}

/// One plan, measured.
pub struct Compared {
    pub title: String,
    /// What all rows have in common, as `--set` writes it.
    pub set: Vec<String>,
    pub rows: Vec<Row>,
}

impl Report {
    /// The sentences that say which setting to choose, one for each comparison; behind it, what is worse than it may be.
    pub fn advice(&self) -> Vec<String> {
        let labs = self.labs.iter();
        let advice = labs.flat_map(|lab| {
            lab.comparisons.iter().map(|compared| {
                let summaries = Summary::of_rows(&compared.rows);
                let faults = advice::faults(compared, &summaries);
                let faults = faults.into_iter().map(|fault| format!("WORSE: {fault}"));
                let lines = std::iter::once(advice::sentence(compared, &summaries)).chain(faults);
                let name = format!("{}, {}", lab.handout.name, compared.title);
                lines
                    .map(|line| format!("{name}: {line}"))
                    .collect::<Vec<_>>()
            })
        });
        advice.flatten().collect()
    }

    /// Writes `report.csv`, `report.json` and `index.html`, each whole or not at all; returns the page's name.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        write(
            folder,
            &files::csv(self),
            &files::json(self),
            page::page(self),
        )
    }
}

/// The three files of a report; returns the page's name.
fn write(folder: &Path, csv: &str, json: &Value, page: Markup) -> Result<PathBuf> {
    std::fs::create_dir_all(folder).map_err(|cause| Error::writing(folder, cause))?;
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        picture::write_whole(&path, |file| {
            std::io::Write::write_all(file, text.as_bytes())
        })?;
        Ok(path)
    };
    write("report.csv", csv)?;
    write("report.json", &format!("{json:#}\n"))?;
    write("index.html", &page.into_string())
}
