//! Measuring the hard cases, one behind the other; within a case, its tests are timed in rounds.

use std::sync::atomic::{AtomicBool, Ordering};

use super::tried::{self, Test};
use super::{AnchorRow, CaseReport, HardReport, Tested, anchor};
use crate::hard::Case;
use crate::headless::{Choice, Headless};
use crate::labs::{self, Settings};
use crate::progress::Progress;
use crate::report::bench::{self, shadow_tests};
use crate::report::{Machine, Plan, Subject, run};
use crate::{Error, Result};

/// How much there is to do, in the steps of [`measure`]'s progress.
pub fn steps(cases: &[&'static Case], with_anchor: bool, rounds: usize) -> Result<u64> {
    let mut rows = 0;
    for case in cases {
        let handout = labs::find(case.lab)?;
        rows += tried::of_case(case, handout, &Settings::new(handout.settings))?.len();
    }
    let anchor = if with_anchor { anchor::STEPS } else { 0 };
    Ok(run::steps(rows, rounds) + anchor)
}

/// Measures the cases until `stop` is raised; a case that was not finished is left out.
pub fn measure(
    device: &Choice,
    size: [u32; 2],
    cases: &[&'static Case],
    with_anchor: bool,
    rounds: usize,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<HardReport> {
    let mut measured: Vec<CaseReport> = Vec::new();
    let mut anchor_rows: Vec<AnchorRow> = Vec::new();
    let mut machine = None;
    for case in cases {
        if stop.load(Ordering::Relaxed) {
            break;
        }
        let context = Headless::open(device, size, true)?;
        machine = Some(Machine::new(&context));
        measured.extend(measure_case(case, &context, size, rounds, progress, stop)?);
    }
    if with_anchor && !stop.load(Ordering::Relaxed) {
        anchor_rows = anchor::measure(device, size, progress, stop)?;
    }
    let machine = machine.filter(|_| !measured.is_empty()).ok_or_else(|| {
        Error::Interrupted("interrupted before the first case: nothing is written".to_owned())
    })?;
    let complete = measured.len() == cases.len() && anchor_rows.is_empty() != with_anchor;
    Ok(HardReport {
        machine,
        size,
        rounds,
        cases: measured,
        anchor: anchor_rows,
        interrupted: !complete,
    })
}

fn measure_case(
    case: &'static Case,
    context: &Headless,
    size: [u32; 2],
    rounds: usize,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Option<CaseReport>> {
    let handout = labs::find(case.lab)?;
    let mut lab = bench::start(handout, context, (case.scene)(), size)?;
    let tests = tried::of_case(case, handout, lab.settings())?;
    let assignments = tests.iter().map(|test| test.assignments.clone());
    let plan = Plan::of_rows(case.name, assignments.collect());
    let mut subject = Subject {
        handout,
        lab: lab.as_mut(),
        context,
        size,
    };
    let rows = run::measure(&mut subject, &[plan], rounds, progress, stop)?;
    let rows = rows.into_iter().flatten();
    let tested = tests.into_iter().zip(rows).map(|(test, row)| {
        let Test {
            expected,
            shadow_test,
            depth_format,
            ..
        } = test;
        Tested {
            row,
            expected,
            shadow_test,
            depth_format,
        }
    });
    let rows: Vec<Tested> = tested.collect();
    let finished = !rows.is_empty() && rows.iter().all(|row| row.row.times.len() == rounds);
    Ok(finished.then(|| CaseReport {
        case,
        shadow_tests: shadow_tests(handout),
        rows,
    }))
}
