//! `report scaling`: how time and memory grow with triangles and with the map, under every shadow test.
//!
//! | file | what |
//! |---|---|
//! | `run.rs` | measuring, in rounds that visit every size |
//! | `growth.rs` | slopes of logarithms, and whether anything grows faster than what it is drawn from |
//! | `plot.rs` | lines on two logarithmic axes, beside one of slope 1 |
//! | `page.rs`, `files.rs` | the page; CSV and JSON |

mod files;
mod growth;
mod page;
mod plot;
mod run;

use std::path::{Path, PathBuf};

pub use run::{LAB, Sizes, measure, steps};

use super::{Machine, Row, write};
use crate::Result;

/// Everything that is written.
pub struct ScalingReport {
    pub machine: Machine,
    pub size: [u32; 2],
    /// How many rounds were asked for.
    pub rounds: usize,
    /// Triangles and texels, as far as Ctrl-C let them be measured.
    pub axes: Vec<Axis>,
    pub interrupted: bool,
}

/// What is made larger and larger, everything else being the same.
pub struct Axis {
    /// In the plural.
    pub unit: &'static str,
    /// How many were finished.
    pub rounds: usize,
    /// One for each shadow test, the handout's first.
    pub series: Vec<Series>,
}

pub struct Series {
    pub shadow_test: &'static str,
    /// From the smallest on. A single one: it has no such size, and is the same at all of them.
    pub points: Vec<Point>,
}

pub struct Point {
    /// In the axis' unit.
    pub count: u64,
    pub row: Row,
}

impl ScalingReport {
    /// The sentences that say whether anything grows faster than triangles and texels do.
    pub fn summary(&self) -> Vec<String> {
        self.axes.iter().map(growth::sentence).collect()
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
