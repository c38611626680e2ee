//! `report hard`: every hard case under every shadow test, and the plane whose error is known in closed form.
//!
//! | file | what |
//! |---|---|
//! | `tried.rs` | which tests a case is put to |
//! | `run.rs` | measuring them, case by case |
//! | `anchor.rs` | the tilted plane against its closed form |
//! | `verdict.rs` | whether a test held, and whether that was expected; how many cases each test holds |
//! | `page.rs`, `table.rs`, `files.rs` | the page, its long table; CSV and JSON |

mod anchor;
mod files;
mod page;
mod run;
mod table;
mod tried;
mod verdict;

use std::path::{Path, PathBuf};

pub use anchor::AnchorRow;
pub use run::{measure, steps};
pub use verdict::Verdict;

use super::{Machine, Row, write};
use crate::Result;
use crate::hard::{Case, Expected};

/// Everything that is written.
pub struct HardReport {
    pub machine: Machine,
    pub size: [u32; 2],
    pub rounds: usize,
    pub cases: Vec<CaseReport>,
    /// Nothing where single cases were asked for.
    pub anchor: Vec<AnchorRow>,
    /// Whether Ctrl-C left some of the cases out.
    pub interrupted: bool,
}

/// What was found of one case.
pub struct CaseReport {
    pub case: &'static Case,
    /// The shadow tests of its lab, the handout's first.
    pub shadow_tests: &'static [&'static str],
    pub rows: Vec<Tested>,
}

/// One test of a case.
pub struct Tested {
    pub row: Row,
    pub expected: Expected,
    /// Which value of the setting `shadow_test` it shows, if it changes nothing else but the format of the depth texture.
    pub shadow_test: Option<&'static str>,
    /// That format, as `--set` writes it; nothing where it is the handout's.
    pub depth_format: String,
}

impl HardReport {
    /// The sentences that say how many cases each test holds, and what came otherwise than expected.
    pub fn summary(&self) -> Vec<String> {
        verdict::summary(self)
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
