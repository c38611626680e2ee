//! `shadowlab report` of a lab that averages renders: error and time against the number of lights.

use std::sync::atomic::Ordering;

use shadowlab::labs::Handout;
use shadowlab::progress::Progress;
use shadowlab::report::soft::{SoftReport, measure, own_setting, steps};
use shadowlab::report::{Machine, Subject};
use shadowlab::{Error, Result};

use super::{ReportCommand, raised_by_ctrl_c};
use crate::cli::child;
use crate::cli::print;
use crate::cli::state::{Drawing, State};

/// Enough for an interval; a frame of many lights takes its time.
pub const ROUNDS: u16 = 9;

impl ReportCommand {
    pub(super) fn check_soft(&self, handout: &Handout) -> Result<()> {
        let name = handout.name;
        if !self.sweeps.is_empty() {
            return Err(Error::usage(format!(
                "report {name}: it has lights, accumulators and methods of its own to compare, expected no --sweep"
            )));
        }
        match own_setting(|setting| self.changes.sets(setting)) {
            Some(setting) => Err(Error::usage(format!(
                "--set {setting}: report {name} gives it values of its own"
            ))),
            None => Ok(()),
        }
    }

    pub(super) fn soft(&self, handout: &'static Handout, rounds: usize) -> Result<()> {
        let stop = raised_by_ctrl_c()?;
        let state = State {
            lab: handout.name.to_owned(),
            changes: self.changes.clone(),
        };
        if let Some(folder) = &self.changes.glsl {
            child::try_first(&state, folder)?;
        }
        let mut running = state.start(&Drawing::on(&self.device), &[], false)?;
        let progress = Progress::new("measuring", steps(handout, rounds));
        let mut subject = Subject {
            handout,
            lab: running.lab.as_mut(),
            context: &running.context,
            size: running.size,
        };
        let found = measure(&mut subject, rounds, &progress, &stop)?;
        drop(progress);
        let interrupted = stop.load(Ordering::Relaxed);
        if found.hard.is_empty() {
            let message = "interrupted before anything was measured: nothing is written";
            return Err(Error::Interrupted(message.to_owned()));
        }
        let report = SoftReport {
            machine: Machine::new(&running.context),
            handout,
            options: self.options(&state),
            size: running.size,
            rounds,
            found,
            interrupted,
        };
        let page = report.write(&self.output)?;
        let lines = report.summary().into_iter().map(|line| line + "\n");
        print(&format!(
            "{}{}\n",
            lines.collect::<String>(),
            page.display()
        ))?;
        if !interrupted {
            return Ok(());
        }
        Err(Error::Interrupted(format!(
            "interrupted: {} has what was finished",
            page.display()
        )))
    }
}
