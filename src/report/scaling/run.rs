//! Measuring scenes and maps of growing size. Each scene has a lab of its own for every shadow test, all of them in one
//! context, so that a round can visit every size.

use std::sync::atomic::{AtomicBool, Ordering};

use super::{Axis, Point, ScalingReport, Series};
use crate::gl::trace::{self, Memory};
use crate::hard;
use crate::headless::{Choice, Headless};
use crate::labs::{self, Handout, Lab};
use crate::progress::Progress;
use crate::report::bench::{self, EXACT, assigned, choosing, shadow_tests};
use crate::report::run::{self, Running};
use crate::report::truths::Truths;
use crate::report::{Machine, Subject};
use crate::scene::Scene;
use crate::{Error, Result};

/// The lab that draws the scenes: a spot light is the case that both its passes are about.
pub const LAB: &str = "cs541";

const LEAST_TRIANGLES: f64 = 1000.0;
/// Two steps are a factor of ten.
const STEPS_IN_TEN: i32 = 2;
const MAP_SIZES: [u32; 6] = [256, 512, 1024, 2048, 4096, 8192];
/// Of the scene that the maps are drawn from.
const TRIANGLES_IN_MAPS: u32 = 10_000;

/// What grows along an axis.
pub const TRIANGLES: &str = "triangles";
pub const TEXELS: &str = "texels";

/// The sizes that are measured.
pub struct Sizes {
    triangles: Vec<u32>,
}

impl Sizes {
    /// From a thousand triangles up to the last step that is not above `most`.
    pub fn up_to(most: u32) -> Self {
        let steps = (0..).map(|i| 10_f64.powf(f64::from(i) / f64::from(STEPS_IN_TEN)));
        let sizes = steps.map(|step| (LEAST_TRIANGLES * step).round() as u32);
        Self {
            triangles: sizes.take_while(|size| *size <= most).collect(),
        }
    }

    fn rows(&self) -> Result<usize> {
        let tests = shadow_tests(labs::find(LAB)?);
        let maps = tests.iter().map(|test| map_sizes(test).len());
        Ok(self.triangles.len() * tests.len() + maps.sum::<usize>())
    }
}

/// The settings of the maps that a test is tried with.
fn map_sizes(shadow_test: &str) -> Vec<Option<u32>> {
    if shadow_test == EXACT {
        return vec![None];
    }
    MAP_SIZES.map(Some).to_vec()
}

/// How much there is to do, in the steps of [`measure`]'s progress.
pub fn steps(sizes: &Sizes, rounds: usize) -> Result<u64> {
    Ok(run::steps(sizes.rows()?, rounds))
}

/// What is measured: a lab with settings, and where its figures belong.
struct Place {
    lab: usize,
    running: Running,
    shadow_test: &'static str,
    count: u64,
}

struct Bench<'a> {
    handout: &'static Handout,
    context: &'a Headless,
    size: [u32; 2],
    unit: &'static str,
    labs: Vec<Box<dyn Lab>>,
    places: Vec<Place>,
}

/// Measures as many rounds as are finished before `stop` is raised. The axes follow each other, for memory's sake: that of
/// a million triangles is given back before the largest maps are drawn.
pub fn measure(
    device: &Choice,
    size: [u32; 2],
    sizes: &Sizes,
    rounds: usize,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<ScalingReport> {
    let mut axes = Vec::new();
    let mut machine = None;
    for (unit, scenes) in [
        (TRIANGLES, &sizes.triangles[..]),
        (TEXELS, &[TRIANGLES_IN_MAPS]),
    ] {
        let context = Headless::open(device, size, true)?;
        machine = Some(Machine::new(&context));
        let mut bench = Bench {
            handout: labs::find(LAB)?,
            context: &context,
            size,
            unit,
            labs: Vec::new(),
            places: Vec::new(),
        };
        for triangles in scenes {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            bench.add_scene(&hard::bumpy_ball(*triangles), progress)?;
        }
        axes.extend(bench.measure(rounds, progress, stop)?);
    }
    let machine = machine.filter(|_| !axes.is_empty()).ok_or_else(|| {
        Error::Interrupted("interrupted before the first round: nothing is written".to_owned())
    })?;
    Ok(ScalingReport {
        machine,
        size,
        rounds,
        interrupted: axes.len() < 2 || axes.iter().any(|axis| axis.rounds < rounds),
        axes,
    })
}

impl Bench<'_> {
    /// A lab for each shadow test, and the rows that it is measured in.
    fn add_scene(&mut self, scene: &Scene, progress: &Progress) -> Result<()> {
        let is_map = self.unit == TEXELS;
        let mut truths = Truths::new(self.size);
        let objects = scene.objects.iter();
        let triangles: usize = objects.map(|object| object.mesh.faces.len()).sum();
        for shadow_test in shadow_tests(self.handout) {
            trace::take();
            let mut lab = bench::start(self.handout, self.context, scene.clone(), self.size)?;
            let mut memory = Memory::default();
            memory.note(&trace::take())?;
            let now = lab.settings().clone();
            let maps = if is_map {
                map_sizes(shadow_test)
            } else {
                vec![None]
            };
            for map_size in maps {
                let mut assignments = choosing(self.handout, shadow_test);
                assignments.extend(map_size.map(|size| format!("map_size={size}")));
                let settings = assigned(&now, &assignments)?;
                let mut subject = Subject {
                    handout: self.handout,
                    lab: lab.as_mut(),
                    context: self.context,
                    size: self.size,
                };
                let differences = settings.differences(&now);
                let running = run::prepare(
                    &mut subject,
                    settings,
                    differences,
                    &mut memory,
                    &mut truths,
                )?;
                let drawn = lab.shadow_texture(1).ok();
                let texels = drawn.map_or(0, |map| u64::from(map.scale.size).pow(2));
                self.places.push(Place {
                    lab: self.labs.len(),
                    running,
                    shadow_test,
                    count: if is_map { texels } else { triangles as u64 },
                });
                progress.add(run::PREPARATION);
            }
            self.labs.push(lab);
        }
        Ok(())
    }

    /// None where not a single round was finished.
    fn measure(
        mut self,
        rounds: usize,
        progress: &Progress,
        stop: &AtomicBool,
    ) -> Result<Option<Axis>> {
        let stopped = || stop.load(Ordering::Relaxed);
        let mut finished = 0;
        while finished < rounds && !stopped() {
            let mut times = vec![None; self.places.len()];
            for i in run::order(finished, times.len()) {
                if stopped() {
                    break;
                }
                times[i] = Some(self.visit(i)?);
                progress.add(1);
            }
            // A round that was not finished is no round.
            let Some(times) = times.into_iter().collect::<Option<Vec<_>>>() else {
                break;
            };
            for (place, times) in self.places.iter_mut().zip(times) {
                place.running.row.times.push(times);
            }
            finished += 1;
        }
        Ok((finished > 0).then(|| Axis {
            unit: self.unit,
            rounds: finished,
            series: self.series(),
        }))
    }

    /// The figures by shadow test. A driver may allow no map as large as was asked for: then it has drawn the same twice.
    fn series(self) -> Vec<Series> {
        let empty = |shadow_test: &&'static str| Series {
            shadow_test,
            points: Vec::new(),
        };
        let mut series: Vec<Series> = shadow_tests(self.handout).iter().map(empty).collect();
        for place in self.places {
            let own = series
                .iter_mut()
                .find(|series| series.shadow_test == place.shadow_test);
            let points = &mut own.expect("every test has a series").points;
            if points.iter().all(|point| point.count != place.count) {
                points.push(Point {
                    count: place.count,
                    row: place.running.row,
                });
            }
        }
        series
    }

    fn visit(&mut self, i: usize) -> Result<run::Times> {
        let Place { lab, running, .. } = &self.places[i];
        let mut subject = Subject {
            handout: self.handout,
            lab: self.labs[*lab].as_mut(),
            context: self.context,
            size: self.size,
        };
        trace::unrecorded(|| run::visit(&mut subject, running))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_steps_are_a_factor_of_ten() {
        assert_eq!(Sizes::up_to(20_000).triangles, [1000, 3162, 10_000]);
        let all = Sizes::up_to(1_000_000).triangles;
        assert_eq!((all.len(), all[6]), (7, 1_000_000));
    }
}
