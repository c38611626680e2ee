//! What must come out right: hard shadows on each wall, renders that are all the same, the fast method.

use image::RgbImage;

use super::{METHODS, Run, choices};
use crate::Result;
use crate::ground_truth::Rays;
use crate::labs::Handout;
use crate::measure::{Figures, Measure};

/// Hard shadows on one wall, or on all, against rays.
#[derive(Clone, Debug)]
pub struct Hard {
    pub shown: &'static str,
    pub clipping: bool,
    pub figures: Figures,
}

/// Renders that are all the same.
#[derive(Clone, Debug)]
pub struct Equal {
    pub accumulator: &'static str,
    pub count: usize,
    /// The largest deviation from a single one of them, in levels.
    pub levels: u8,
}

/// The fast method against the handout's.
#[derive(Clone, Debug)]
pub struct Methods {
    pub amount: f64,
    pub count: usize,
    /// The largest difference, in levels, and of pixels beside the seams of two walls.
    pub levels: u8,
    /// The share of pixels that differ by more than one level.
    pub beyond_one: f64,
}

/// Powers of two, whose weights a binary number has exactly, and others.
const EQUAL_COUNTS: [usize; 10] = [1, 2, 3, 4, 5, 8, 16, 64, 100, 256];

const METHOD_COUNTS: [usize; 2] = [16, 64];
const METHOD_AMOUNTS: [f64; 6] = [0.009, 0.03, 0.1, 0.2, 0.3, 0.4];

/// How many lights are drawn.
pub fn lights(handout: &Handout) -> usize {
    let equal = choices(handout, "accumulator").len() * EQUAL_COUNTS.iter().sum::<usize>();
    let methods = METHODS.len() * METHOD_AMOUNTS.len() * METHOD_COUNTS.iter().sum::<usize>();
    2 * choices(handout, "clipped_to").len() + equal + methods
}

pub fn hard(run: &mut Run, found: &mut Vec<Hard>) -> Result<()> {
    run.set(&["soft_shadows=off"])?;
    for shown in choices(run.subject.handout, "clipped_to") {
        if run.is_stopped() {
            return Ok(());
        }
        run.set(&[&format!("clipped_to={shown}")])?;
        let rays = Rays::new(&run.subject.lab.now(), 0);
        let truth = rays.truth(run.subject.size);
        let measure = Measure::new(&rays, &truth);
        for clipping in [false, true] {
            let switch = if clipping { "on" } else { "off" };
            run.set(&[&format!("stencil_clipping={switch}")])?;
            let (figures, _) = measure.measure(&run.visibility()?, None);
            found.push(Hard {
                shown,
                clipping,
                figures,
            });
            run.progress.add(1);
        }
    }
    run.set(&["clipped_to=all"])
}

pub fn equal(run: &mut Run, found: &mut Vec<Equal>) -> Result<()> {
    run.set(&["soft_shadows=on", "accumulator=RGBA32F"])?;
    run.set_lights(1, 0.0)?;
    let single = run.picture()?;
    for accumulator in choices(run.subject.handout, "accumulator") {
        run.set(&[&format!("accumulator={accumulator}")])?;
        for count in EQUAL_COUNTS {
            if run.is_stopped() {
                return Ok(());
            }
            run.set_lights(count, 0.0)?;
            found.push(Equal {
                accumulator,
                count,
                levels: largest(&single, &run.picture()?),
            });
            run.progress.add(count as u64);
        }
    }
    Ok(())
}

pub fn methods(run: &mut Run, found: &mut Vec<Methods>) -> Result<()> {
    run.set(&["stencil_clipping=on", "accumulator=RGBA32F"])?;
    for amount in METHOD_AMOUNTS {
        for count in METHOD_COUNTS {
            if run.is_stopped() {
                return Ok(());
            }
            run.set_lights(count, amount)?;
            run.set(&["soft_method=handout"])?;
            let handouts = run.picture()?;
            run.set(&["soft_method=fast"])?;
            let fast = beside_seams(&handouts, run.picture()?);
            let pairs = handouts.pixels().zip(fast.pixels());
            let beyond = pairs.filter(|(a, b)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 1));
            found.push(Methods {
                amount,
                count,
                levels: largest(&handouts, &fast),
                beyond_one: beyond.count() as f64 / f64::from(fast.width() * fast.height()),
            });
            run.progress.add(2 * count as u64);
        }
    }
    run.set(&["soft_method=handout"])
}

/// The largest difference of any channel, in levels.
fn largest(a: &RgbImage, b: &RgbImage) -> u8 {
    let pairs = a.as_raw().iter().zip(b.as_raw());
    pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

/// Where two walls meet, the diagonals of the window as long as the view is the course's, the shadows of either one are as
/// near: which of them is drawn is a tie.
fn beside_seams(handouts: &RgbImage, mut fast: RgbImage) -> RgbImage {
    let [width, height] = [fast.width(), fast.height()];
    for (x, y, pixel) in handouts.enumerate_pixels() {
        if x * height == y * width || (width - 1 - x) * height == y * width {
            fast.put_pixel(x, y, *pixel);
        }
    }
    fast
}
