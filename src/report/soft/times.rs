//! The handout's method and the fast one, timed in rounds.

use std::time::Instant;

use super::fit;
use super::{AMOUNTS, METHODS, Run};
use crate::Result;
use crate::gl;
use crate::labs::Show;
use crate::report::statistics::Sample;

/// Numbers of lights that are timed. More would keep a round waiting, and cost as much for each light.
pub const COUNTS: [usize; 4] = [1, 4, 16, 64];

/// A method with so many lights.
#[derive(Clone, Debug)]
pub struct Times {
    pub method: &'static str,
    pub amount: f64,
    pub count: usize,
    /// Milliseconds of a frame, one of each round.
    pub ms: Vec<f64>,
}

impl Times {
    pub fn median(&self) -> f64 {
        Sample::new(self.ms.iter().copied()).median()
    }
}

/// How many lights are drawn: each frame once before it is timed.
pub fn lights(rounds: usize) -> usize {
    2 * rounds * METHODS.len() * AMOUNTS.len() * COUNTS.iter().sum::<usize>()
}

/// Rows with as many rounds as were finished; none if not a single one was.
pub fn measure(run: &mut Run, rounds: usize) -> Result<Vec<Times>> {
    run.set(&["clipped_to=all", "stencil_clipping=on", "soft_shadows=on"])?;
    run.set(&["jitter=random", "first_jitter=0", "accumulator=RGB32F"])?;
    let mut rows = Vec::new();
    for amount in AMOUNTS {
        for count in COUNTS {
            // Side by side: what is divided by each other later is measured under the same load.
            rows.extend(METHODS.map(|method| Times {
                method,
                amount,
                count,
                ms: Vec::new(),
            }));
        }
    }
    for round in 0..rounds {
        let mut times = vec![0.0; rows.len()];
        for place in 0..rows.len() {
            if run.is_stopped() {
                rows.retain(|row| !row.ms.is_empty());
                return Ok(rows);
            }
            // Every second round goes backwards, so that no row always follows the same one.
            let row = if round % 2 == 0 {
                place
            } else {
                rows.len() - 1 - place
            };
            let Times {
                method,
                amount,
                count,
                ..
            } = rows[row];
            run.set_lights(count, amount)?;
            run.set(&[&format!("soft_method={method}")])?;
            // What a change of settings asks for is made in a frame that nobody times.
            run.draw(Show::Picture)?;
            times[row] = timed(run)?;
            run.progress.add(2 * count as u64);
        }
        for (row, ms) in rows.iter_mut().zip(times) {
            row.ms.push(ms);
        }
    }
    Ok(rows)
}

/// From a driver that is idle to one that is idle again.
fn timed(run: &mut Run) -> Result<f64> {
    let gl = &run.subject.context.gl;
    gl::finish(gl);
    let begun = Instant::now();
    run.subject.lab.render(gl, Show::Picture)?;
    gl::finish(gl);
    Ok(1000.0 * begun.elapsed().as_secs_f64())
}

pub fn find<'a>(times: &'a [Times], method: &str, amount: f64, count: usize) -> Option<&'a Times> {
    let is_it = |t: &&Times| t.method == method && t.amount == amount && t.count == count;
    times.iter().find(is_it)
}

/// The ratios of two rows, round by round.
pub fn ratio(row: &Times, to: &Times) -> Sample {
    Sample::new(row.ms.iter().zip(&to.ms).map(|(own, other)| own / other))
}

/// Of a method: what a frame costs with no light at all, and each light more; milliseconds, one of each round.
pub fn cost(times: &[Times], method: &str, amount: f64) -> Option<[Sample; 2]> {
    let rows = COUNTS.map(|count| find(times, method, amount, count));
    let rows: Vec<&Times> = rows.into_iter().collect::<Option<_>>()?;
    let lines = (0..rows[0].ms.len()).map(|round| {
        let points = rows.iter().map(|row| (row.count as f64, row.ms[round]));
        fit::line(&points.collect::<Vec<_>>())
    });
    let lines: Vec<_> = lines.collect();
    Some([
        Sample::new(lines.iter().map(|line| line.at_zero)),
        Sample::new(lines.iter().map(|line| line.slope)),
    ])
}
