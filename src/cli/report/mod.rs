//! `shadowlab report`: speed against error, as a page, CSV and JSON; of labs, of the hard cases, and as scenes grow.

mod hard;
mod scaling;
mod soft;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use shadowlab::error::did_you_mean;
use shadowlab::headless::Choice;
use shadowlab::labs::{self, Handout, LABS, Settings};
use shadowlab::progress::Progress;
use shadowlab::report::{
    self, Compared, LabReport, Machine, Plan, Report, Subject, Sweep, measure, steps,
};
use shadowlab::{Error, Result};
use signal_hook::consts::SIGINT;

use crate::cli::changes::Changes;
use crate::cli::state::{Drawing, State};
use crate::cli::{child, print};

#[derive(Args)]
pub struct ReportCommand {
    /// The lab's name, as `shadowlab labs` lists it [default: every lab]; or hard: every hard case under every test; or
    /// scaling: how cost grows with triangles and texels
    lab: Option<String>,
    #[command(flatten)]
    changes: Changes,
    /// Give a setting several values, map_size=256..4096 or filter=linear,nearest; several sweeps are combined
    /// [default: the lab's own comparisons]
    #[arg(long = "sweep", value_name = "NAME=VALUES")]
    sweeps: Vec<String>,
    /// How many times each row is timed [default: 30; every lab: 24; hard: 6; scaling: 9; eecs487: 9]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    rounds: Option<u16>,
    /// scaling: how many triangles the largest scene has [default: 1000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(10_000..=10_000_000))]
    triangles: Option<u32>,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
    /// The folder to write report.csv, report.json and index.html to
    #[arg(short, long = "output", value_name = "DIR")]
    output: PathBuf,
}

/// How many times the rows of a lab with shadow maps are timed.
const ROUNDS: u16 = 30;
/// The same where all labs are measured: on two cores that takes less than five minutes.
const ROUNDS_OF_ALL: u16 = 24;

/// Names that no lab has.
const HARD: &str = "hard";
const SCALING: &str = "scaling";

/// A lab and what is to be compared in it.
struct Task {
    handout: &'static Handout,
    plans: Vec<Plan>,
}

impl ReportCommand {
    pub fn run(self) -> Result<()> {
        let name = self.lab.as_deref();
        if self.triangles.is_some() && name != Some(SCALING) {
            return Err(Error::usage("--triangles: expected report scaling"));
        }
        let mut averages = LABS.iter().copied().filter(|lab| report::soft::is_for(lab));
        let averages = averages.find(|lab| Some(lab.name) == name);
        match (name, averages) {
            (Some(HARD), _) => {
                self.check_hard()?;
                self.with_folder(|| self.hard())
            }
            (Some(SCALING), _) => {
                self.check_scaling()?;
                self.with_folder(|| self.scaling())
            }
            (_, Some(handout)) => {
                self.check_soft(handout)?;
                let rounds = self.rounds.unwrap_or(soft::ROUNDS).into();
                self.with_folder(|| self.soft(handout, rounds))
            }
            _ => {
                let tasks = self.tasks()?;
                self.with_folder(|| self.fill(tasks))
            }
        }
    }

    fn with_folder(&self, fill: impl FnOnce() -> Result<()>) -> Result<()> {
        // That there can be no such folder should not be found out after minutes.
        let was_there = self.output.is_dir();
        std::fs::create_dir_all(&self.output)
            .map_err(|cause| Error::writing(&self.output, cause))?;
        fill().inspect_err(|_| {
            if !was_there {
                // Where the rounds that were finished are in it, it stays.
                let _ = std::fs::remove_dir(&self.output);
            }
        })
    }

    fn fill(&self, tasks: Vec<Task>) -> Result<()> {
        let stop = raised_by_ctrl_c()?;
        let usual = match self.lab {
            Some(_) => ROUNDS,
            None => ROUNDS_OF_ALL,
        };
        let rounds = usize::from(self.rounds.unwrap_or(usual));
        let mut count = 0;
        for task in &tasks {
            let now = Settings::new(task.handout.settings);
            for plan in &task.plans {
                count += plan.settings(&now)?.len();
            }
        }
        let progress = Progress::new("measuring", steps(count, rounds));

        let wanted = tasks.len();
        let mut labs = Vec::new();
        let mut machine = None;
        for task in tasks {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let (lab, seen) = self.measure(task, rounds, &progress, &stop)?;
            machine = Some(seen);
            labs.push(lab);
        }
        drop(progress);
        let finished = |lab: &LabReport| {
            let rows = lab.comparisons.iter().flat_map(|compared| &compared.rows);
            rows.map(|row| row.times.len()).min().unwrap_or(0)
        };
        let complete = labs.iter().filter(|lab| finished(lab) == rounds).count();
        let interrupted = complete < wanted;
        labs.retain(|lab| finished(lab) > 0);
        let Some(machine) = machine.filter(|_| !labs.is_empty()) else {
            let message = "interrupted before the first round: nothing is written";
            return Err(Error::Interrupted(message.to_owned()));
        };
        let report = Report {
            machine,
            labs,
            interrupted: interrupted.then_some(rounds),
        };
        let page = report.write(&self.output)?;
        let interrupted = interrupted.then(|| {
            format!(
                "interrupted: {} has the rounds that were finished of {rounds}",
                page.display()
            )
        });
        finish(&report.advice(), &page, interrupted)
    }

    fn tasks(&self) -> Result<Vec<Task>> {
        let task = |handout: &'static Handout| {
            let plans = Plan::of_lab(handout)?;
            Ok(Task { handout, plans })
        };
        let Some(name) = &self.lab else {
            if self.changes.are_of_one_lab() || !self.sweeps.is_empty() {
                return Err(Error::usage(
                    "report: expected a LAB in front of options that are about one lab",
                ));
            }
            let with_maps = LABS.iter().filter(|lab| !lab.comparisons.is_empty());
            return with_maps.copied().map(task).collect();
        };
        let handout = labs::find(name).map_err(|error| also(&error, name))?;
        if self.changes.sets("redraw") {
            return Err(Error::usage(
                "--set redraw: every row is measured with the shadow pass drawn and at rest",
            ));
        }
        if self.sweeps.is_empty() {
            return Ok(vec![task(handout)?]);
        }
        let sweeps = self.sweeps.iter();
        let sweeps = sweeps.map(|text| Sweep::parse(text, handout.settings));
        let plans = Plan::of_sweeps("the sweep", &sweeps.collect::<Result<Vec<_>>>()?)?;
        Ok(vec![Task { handout, plans }])
    }

    /// Starts one lab and measures its plans.
    fn measure(
        &self,
        Task { handout, plans }: Task,
        rounds: usize,
        progress: &Progress,
        stop: &AtomicBool,
    ) -> Result<(LabReport, Machine)> {
        let state = State {
            lab: handout.name.to_owned(),
            changes: self.changes.clone(),
        };
        self.changes.refuse_mistake("report")?;
        if let Some(folder) = &self.changes.glsl {
            child::try_first(&state, folder)?;
        }
        let mut running = state.start(&Drawing::on(&self.device), &[], true)?;
        let mut subject = Subject {
            handout,
            lab: running.lab.as_mut(),
            context: &running.context,
            size: running.size,
        };
        let rows = measure(&mut subject, &plans, rounds, progress, stop)?;
        let comparisons = plans.into_iter().zip(rows).map(|(plan, rows)| Compared {
            title: plan.title,
            set: plan.set,
            rows,
        });
        let lab = LabReport {
            handout,
            size: running.size,
            options: self.options(&state),
            comparisons: comparisons.collect(),
        };
        Ok((lab, Machine::new(&running.context)))
    }
}

impl ReportCommand {
    /// What made the report another one than the default.
    fn options(&self, state: &State) -> Vec<String> {
        let mut options = state.options();
        if !self.changes.keys.is_empty() {
            options.extend(["--keys".to_owned(), self.changes.keys.clone()]);
        }
        if self.changes.time > 0.0 {
            options.extend(["--time".to_owned(), self.changes.time.to_string()]);
        }
        for sweep in &self.sweeps {
            options.extend(["--sweep".to_owned(), sweep.clone()]);
        }
        options
    }
}

/// Prints what was found and where the page is; an error where Ctrl-C kept it from being all.
fn finish(lines: &[String], page: &Path, interrupted: Option<String>) -> Result<()> {
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    print(&format!("{text}{}\n", page.display()))?;
    interrupted.map_or(Ok(()), |message| Err(Error::Interrupted(message)))
}

/// What is no lab may be meant to be one of the other names.
fn also(error: &Error, name: &str) -> Error {
    let hint = did_you_mean(name, [HARD, SCALING]);
    Error::usage(format!("{error}, {HARD} or {SCALING}{hint}"))
}

/// A flag that the first Ctrl-C raises; the second one ends the program.
fn raised_by_ctrl_c() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let registered = signal_hook::flag::register_conditional_default(SIGINT, stop.clone())
        .and_then(|_| signal_hook::flag::register(SIGINT, stop.clone()));
    registered.map_err(|cause| Error::gl(format!("Ctrl-C cannot be watched: {cause}")))?;
    Ok(stop)
}
