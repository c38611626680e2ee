//! Speed against error: settings × scene → rows of time and mistakes, and what they advise.
//!
//! | file | what |
//! |---|---|
//! | `sweep.rs` | which rows there are: the combinations of settings |
//! | `run.rs` | measuring them, in rounds |
//! | `truths.rs` | the truth of each scene, cast once |
//! | `summary.rs` | medians, ratios and their intervals, the Pareto front, the choice |
//! | `advice.rs` | the sentence that says which setting to choose, and what it costs |
//! | `statistics.rs` | medians and intervals of a sample |
//! | `thumbnail.rs` | the mistakes, small |
//! | `plot.rs` | error against time |
//! | `page.rs`, `files.rs` | the page; CSV and JSON |
//! | `words.rs` | figures and rows as a reader sees them |
//! | [`soft`] | soft shadows from many lights: a report of its own |
//! | `machine.rs` | what it was measured on |
//!
//! It is a room of its own, above the labs and the contexts, because it needs both and neither needs it: a lab is known
//! by its settings and by [`Lab`](crate::labs::Lab) alone, so whatever else is a lab with settings can be reported on.

mod advice;
mod files;
mod machine;
mod page;
mod plot;
mod run;
pub mod soft;
mod statistics;
mod summary;
mod sweep;
mod thumbnail;
mod truths;
mod words;

use std::path::{Path, PathBuf};

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
    /// The sentences that say which setting to choose, one for each comparison.
    pub fn advice(&self) -> Vec<String> {
        let labs = self.labs.iter();
        let advice = labs.flat_map(|lab| {
            lab.comparisons.iter().map(|compared| {
                let advice = advice::sentence(compared, &Summary::of_rows(&compared.rows));
                format!("{}, {}: {advice}", lab.handout.name, compared.title)
            })
        });
        advice.collect()
    }

    /// Writes `report.csv`, `report.json` and `index.html`, each whole or not at all; returns the page's name.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        std::fs::create_dir_all(folder).map_err(|cause| Error::writing(folder, cause))?;
        let write = |name: &str, text: &str| {
            let path = folder.join(name);
            picture::write_whole(&path, |file| {
                std::io::Write::write_all(file, text.as_bytes())
            })?;
            Ok(path)
        };
        write("report.csv", &files::csv(self))?;
        write("report.json", &format!("{:#}\n", files::json(self)))?;
        write("index.html", &page::page(self).into_string())
    }
}
