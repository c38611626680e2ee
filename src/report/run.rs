//! Measuring the rows of one lab: first what stays the same (errors, calls, memory), then time, round by round.
//!
//! Every round visits every row, so that the machine's drift hits all of them alike; a ratio is one of two times of the
//! same round. Each round begins with another row, and every second one goes backwards, so that no row always follows the
//! same other one.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::Result;
use crate::gl::trace::{self, Bytes, Memory};
use crate::gl::{self, PassTime};
use crate::headless::Headless;
use crate::labs::{Handout, Lab, Settings, Show};
use crate::measure::Figures;
use crate::own_shaders;
use crate::progress::Progress;
use crate::report::sweep::Plan;
use crate::report::thumbnail;
use crate::report::truths::Truths;

/// A lab that runs in a context whose calls are recorded.
pub struct Subject<'a> {
    pub handout: &'static Handout,
    pub lab: &'a mut dyn Lab,
    pub context: &'a Headless,
    pub size: [u32; 2],
}

/// One combination of settings, measured.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it sets otherwise than the handout's row, as `--set` writes it.
    pub differences: Vec<String>,
    pub calls: Calls,
    pub bytes: Bytes,
    /// Of each light.
    pub figures: Vec<Figures>,
    /// The mistakes under each light: a small PNG.
    pub thumbnails: Vec<Vec<u8>>,
    /// One of each round.
    pub times: Vec<Times>,
}

/// GL calls of a frame that draws the shadow pass, and of one at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calls {
    pub frame: usize,
    pub rest: usize,
}

/// What a visit of a row measured, in milliseconds.
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// A frame that draws the shadow pass: light or casters move.
    pub frame: f64,
    /// A frame with light and casters at rest.
    pub rest: f64,
    /// Of a frame of which each pass is waited for: the passes that a frame at rest does not have,
    pub shadow_pass: f64,
    /// and the others.
    pub lighting: f64,
    /// What of these two was spent in GL calls.
    pub shadow_pass_in_gl: f64,
    pub lighting_in_gl: f64,
    /// The share of that frame that was not,
    pub outside_gl: f64,
    /// and its milliseconds.
    pub outside_gl_ms: f64,
}

/// A row that is being measured.
pub(super) struct Running {
    settings: Settings,
    /// The headings of a frame at rest.
    rest_passes: Vec<String>,
    pub row: Row,
}

/// Setting up a row and casting its truth takes about as long as this many visits.
pub(super) const PREPARATION: u64 = 2;

/// How much there is to do, in the steps of [`measure`]'s progress.
pub fn steps(rows: usize, rounds: usize) -> u64 {
    rows as u64 * (PREPARATION + rounds as u64)
}

/// Measures the rows of every plan, and hands them over with as many rounds as were finished before `stop` was raised.
pub fn measure(
    subject: &mut Subject,
    plans: &[Plan],
    rounds: usize,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Vec<Vec<Row>>> {
    let now = subject.lab.settings().clone();
    let mut memory = Memory::default();
    memory.note(&trace::take())?;
    let mut truths = Truths::new(subject.size);
    let mut rows = Vec::new();
    // Of each plan, how many rows are in front of it.
    let mut starts = Vec::new();
    for plan in plans {
        starts.push(rows.len());
        let settings = plan.settings(&now)?;
        for row in &settings {
            if stop.load(Ordering::Relaxed) {
                return Ok(Vec::new());
            }
            let differences = row.differences(&settings[0]);
            rows.push(prepare(
                subject,
                row.clone(),
                differences,
                &mut memory,
                &mut truths,
            )?);
            progress.add(PREPARATION);
        }
    }
    for round in 0..rounds {
        let mut times = vec![None; rows.len()];
        for i in order(round, rows.len()) {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            times[i] = Some(trace::unrecorded(|| visit(subject, &rows[i]))?);
            progress.add(1);
        }
        // A round that was not finished is no round.
        let Some(times) = times.into_iter().collect::<Option<Vec<_>>>() else {
            break;
        };
        for (running, times) in rows.iter_mut().zip(times) {
            running.row.times.push(times);
        }
    }
    let mut rows: Vec<Row> = rows.into_iter().map(|running| running.row).collect();
    let mut of_plans: Vec<_> = starts
        .iter()
        .rev()
        .map(|start| rows.split_off(*start))
        .collect();
    of_plans.reverse();
    Ok(of_plans)
}

/// In which order a round visits the rows.
pub(super) fn order(round: usize, rows: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..rows).map(|i| (i + round) % rows).collect();
    if round % 2 == 1 {
        order.reverse();
    }
    order
}

/// Everything about a row that is the same in every round.
pub(super) fn prepare(
    subject: &mut Subject,
    settings: Settings,
    differences: Vec<String>,
    memory: &mut Memory,
    truths: &mut Truths,
) -> Result<Running> {
    let gl = &subject.context.gl;
    let lab = &mut *subject.lab;
    *lab.settings() = settings.clone();
    let calls = |lab: &mut dyn Lab, redraw: &str| -> Result<usize> {
        lab.settings().set(redraw)?;
        // What is made only once is made in the first frame.
        lab.render(gl, Show::Picture)?;
        trace::take();
        lab.render(gl, Show::Picture)?;
        let frame = trace::take();
        Ok(frame
            .iter()
            .filter(|event| matches!(event, trace::Event::Call(_)))
            .count())
    };
    lab.settings().set("redraw=every_frame")?;
    lab.render(gl, Show::Picture)?;
    memory.note(&trace::take())?;
    let calls = Calls {
        frame: calls(lab, "redraw=every_frame")?,
        rest: calls(lab, "redraw=when_changed")?,
    };
    let (drawn, passes) = gl::time_passes(|| lab.render(gl, Show::Picture));
    drawn?;

    let mut figures = Vec::new();
    let mut thumbnails = Vec::new();
    for light in 1..=subject.handout.lights {
        let shadows = own_shaders::visibility(lab, subject.context, subject.size, light)?;
        gl::check_errors(gl, "drawing")?;
        let map = lab.shadow_texture(light).ok().map(|map| map.scale);
        let (wrong, mistakes) = truths.measure(lab.now(), light, shadows, map.as_ref());
        figures.push(wrong);
        thumbnails.push(thumbnail::png(&mistakes));
    }
    memory.note(&trace::take())?;
    let mut bytes = memory.bytes();
    // A lab keeps its maps for the next row; this one could do without.
    if (1..=subject.handout.lights).all(|light| lab.shadow_texture(light).is_err()) {
        bytes.drawn_into = 0;
    }
    let row = Row {
        differences,
        calls,
        bytes,
        figures,
        thumbnails,
        times: Vec::new(),
    };
    Ok(Running {
        settings,
        rest_passes: passes.into_iter().map(|pass| pass.name).collect(),
        row,
    })
}

/// One visit of a row: a frame that nobody times, since the row before had other settings, and then the timed ones.
pub(super) fn visit(subject: &mut Subject, running: &Running) -> Result<Times> {
    let gl = &subject.context.gl;
    let lab = &mut *subject.lab;
    *lab.settings() = running.settings.clone();
    lab.settings().set("redraw=every_frame")?;
    timed(subject.context, lab)?;
    let frame = timed(subject.context, lab)?;

    let begun = Instant::now();
    let ((drawn, passes), inside) = trace::in_calls(|| {
        gl::time_passes(|| {
            let drawn = lab.render(gl, Show::Picture);
            gl::finish(gl);
            drawn
        })
    });
    let taken_apart = begun.elapsed();
    drawn?;
    let rests = |pass: &&PassTime| running.rest_passes.contains(&pass.name);
    let sum = |at_rest: bool, time: fn(&PassTime) -> f64| {
        let chosen = passes.iter().filter(|pass| rests(pass) == at_rest);
        // Of no pass at all it is 0, where a sum of f64 is −0.
        chosen.fold(0.0, |sum, pass| sum + time(pass))
    };

    let outside = taken_apart.saturating_sub(inside).as_secs_f64();

    lab.settings().set("redraw=when_changed")?;
    Ok(Times {
        frame,
        rest: timed(subject.context, lab)?,
        shadow_pass: sum(false, |pass| pass.ms),
        lighting: sum(true, |pass| pass.ms),
        shadow_pass_in_gl: sum(false, |pass| pass.in_calls_ms),
        lighting_in_gl: sum(true, |pass| pass.in_calls_ms),
        outside_gl: outside / taken_apart.as_secs_f64(),
        outside_gl_ms: 1000.0 * outside,
    })
}

/// The milliseconds of a frame, from a driver that is idle to one that is idle again.
fn timed(context: &Headless, lab: &mut dyn Lab) -> Result<f64> {
    gl::finish(&context.gl);
    let begun = Instant::now();
    lab.render(&context.gl, Show::Picture)?;
    gl::finish(&context.gl);
    Ok(1000.0 * begun.elapsed().as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_round_visits_every_row_in_another_order() {
        assert_eq!(order(0, 4), [0, 1, 2, 3]);
        assert_eq!(order(1, 4), [0, 3, 2, 1]);
        assert_eq!(order(2, 4), [2, 3, 0, 1]);
        for round in 0..9 {
            let mut visited = order(round, 5);
            visited.sort_unstable();
            assert_eq!(visited, [0, 1, 2, 3, 4]);
        }
    }
}
