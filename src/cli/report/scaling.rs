//! `shadowlab report scaling`.

use shadowlab::labs;
use shadowlab::progress::Progress;
use shadowlab::report::scaling::{LAB, Sizes, measure, steps};
use shadowlab::{Error, Result};

use super::{ReportCommand, finish, raised_by_ctrl_c};

/// Enough for an interval that leaves the best and the worst round out.
const ROUNDS: u16 = 9;
const MOST_TRIANGLES: u32 = 1_000_000;

impl ReportCommand {
    pub(super) fn check_scaling(&self) -> Result<()> {
        if self.changes.has_scene() || self.changes.are_of_one_state() || !self.sweeps.is_empty() {
            return Err(Error::usage(
                "report scaling: it has its own scenes and maps, expected no option but --triangles, --size, --rounds and --device",
            ));
        }
        Ok(())
    }

    pub(super) fn scaling(&self) -> Result<()> {
        let stop = raised_by_ctrl_c()?;
        let rounds = usize::from(self.rounds.unwrap_or(ROUNDS));
        let sizes = Sizes::up_to(self.triangles.unwrap_or(MOST_TRIANGLES));
        let progress = Progress::new("measuring", steps(&sizes, rounds)?);
        let size = self.changes.size.unwrap_or(labs::find(LAB)?.size);
        let report = measure(&self.device, size, &sizes, rounds, &progress, &stop)?;
        drop(progress);
        let page = report.write(&self.output)?;
        let interrupted = report.interrupted.then(|| {
            format!(
                "interrupted: {} has the rounds that were finished of {rounds}",
                page.display()
            )
        });
        finish(&report.summary(), &page, interrupted)
    }
}
