//! `shadowlab report hard`.

use shadowlab::hard::{self, Case};
use shadowlab::progress::Progress;
use shadowlab::report::hard::{measure, steps};
use shadowlab::{Error, Result};

use super::{ReportCommand, finish, raised_by_ctrl_c};

/// Enough for an interval; it is the errors that the cases are about.
const ROUNDS: u16 = 6;

impl ReportCommand {
    pub(super) fn check_hard(&self) -> Result<()> {
        if self.changes.are_of_one_state() || !self.sweeps.is_empty() {
            return Err(Error::usage(
                "report hard: every case is put to every test, expected no option but --scene hard:NAME, --size, --rounds and --device",
            ));
        }
        self.hard_cases().map(|_| ())
    }

    /// All of them, or the one that --scene names.
    fn hard_cases(&self) -> Result<Vec<&'static Case>> {
        if !self.changes.has_scene() {
            return Ok(hard::cases().collect());
        }
        let case = self.changes.hard_case()?;
        let case = case
            .ok_or_else(|| Error::usage("report hard: --scene names a file, expected hard:NAME"))?;
        Ok(vec![case])
    }

    pub(super) fn hard(&self) -> Result<()> {
        let stop = raised_by_ctrl_c()?;
        let rounds = usize::from(self.rounds.unwrap_or(ROUNDS));
        let cases = self.hard_cases()?;
        let with_anchor = !self.changes.has_scene();
        let progress = Progress::new("measuring", steps(&cases, with_anchor, rounds)?);
        let size = self.changes.size.unwrap_or(hard::SIZE);
        let report = measure(
            &self.device,
            size,
            &cases,
            with_anchor,
            rounds,
            &progress,
            &stop,
        )?;
        drop(progress);
        let page = report.write(&self.output)?;
        let interrupted = report.interrupted.then(|| {
            format!(
                "interrupted: {} has the {} cases that were finished of {}",
                page.display(),
                report.cases.len(),
                cases.len()
            )
        });
        finish(&report.summary(), &page, interrupted)
    }
}
