//! Soft shadows against the light's integral, and against the mean of the same renders.

use image::RgbImage;

use super::cube::{Deviation, Penumbrae};
use super::{AMOUNTS, COUNTS, Found, JITTERS, Run, choices};
use crate::Result;
use crate::ground_truth::Rays;
use crate::labs::Handout;

/// One average of renders.
#[derive(Clone, Debug)]
pub struct Errors {
    pub amount: f64,
    pub jitter: &'static str,
    pub accumulator: &'static str,
    pub count: usize,
    /// Of the visibility, from the share of the light's cube that each pixel sees; in 0…1.
    pub from_integral: Deviation,
    /// Of the picture, from the mean of the same renders in f64; in levels of 255.
    pub from_mean: Deviation,
    /// The share of the picture's values that are another level than the mean is rounded to.
    pub other_level: f64,
}

/// The same lights again and again with other jitters: how far an error is a matter of luck.
#[derive(Clone, Debug)]
pub struct Draws {
    pub amount: f64,
    pub jitter: &'static str,
    pub count: usize,
    /// Of each draw, the root mean square from the light's integral.
    pub rms: Vec<f64>,
    /// What the integral itself is uncertain by.
    pub uncertain: f64,
}

impl Draws {
    pub fn mean(&self) -> f64 {
        let squares = self.rms.iter().map(|rms| rms * rms).sum::<f64>();
        (squares / self.rms.len() as f64).sqrt()
    }

    /// The luckiest draw and the unluckiest.
    pub fn range(&self) -> [f64; 2] {
        let least = self.rms.iter().copied().fold(f64::INFINITY, f64::min);
        [least, self.rms.iter().copied().fold(0.0, f64::max)]
    }
}

/// So many draws, each with lights of its own.
const DRAWS: usize = 5;

fn most() -> usize {
    COUNTS[COUNTS.len() - 1]
}

/// Every accumulator is drawn with so many lights. What it loses has little to do with where they are: where they are even,
/// as many as are said to be enough will do.
fn counts(jitter: &str) -> &'static [usize] {
    match jitter {
        "random" => &COUNTS,
        _ => &COUNTS[..7],
    }
}

/// How many lights are drawn.
pub fn lights(handout: &Handout) -> usize {
    let accumulators = choices(handout, "accumulator").len();
    let of_jitter = |jitter: &&str| {
        let counts = counts(jitter);
        let sum = |counts: &[usize]| counts.iter().sum::<usize>();
        DRAWS * sum(&COUNTS) + counts[counts.len() - 1] + 2 * accumulators * sum(counts)
    };
    AMOUNTS.len() * JITTERS.iter().map(of_jitter).sum::<usize>()
}

pub fn measure(run: &mut Run, found: &mut Found) -> Result<()> {
    // Every wall ends where it ends in truth.
    run.set(&["clipped_to=all", "stencil_clipping=on", "soft_shadows=on"])?;
    let rays = Rays::new(&run.subject.lab.now(), 0);
    let truth = rays.truth(run.subject.size);
    for amount in AMOUNTS {
        let penumbrae = Penumbrae::new(&rays, &truth, amount);
        for jitter in JITTERS {
            run.set(&[&format!("jitter={jitter}")])?;
            found.draws.extend(draws(run, amount, jitter, &penumbrae)?);
            let counts = counts(jitter);
            let Some(means) = means(run, amount, counts)? else {
                return Ok(());
            };
            for (count, mean) in counts.iter().copied().zip(&means) {
                for accumulator in choices(run.subject.handout, "accumulator") {
                    if run.is_stopped() {
                        return Ok(());
                    }
                    run.set_lights(count, amount)?;
                    run.set(&[&format!("accumulator={accumulator}")])?;
                    let picture = run.picture()?;
                    let visibility = run.visibility()?;
                    run.progress.add(2 * count as u64);
                    found.errors.push(Errors {
                        amount,
                        jitter,
                        accumulator,
                        count,
                        from_integral: penumbrae.deviation(&visibility),
                        from_mean: Deviation::of(differences(&picture, mean)),
                        other_level: other_level(&picture, mean),
                    });
                }
            }
        }
    }
    Ok(())
}

/// Drawn by the fast method, whose masks are the handout's.
fn draws(
    run: &mut Run,
    amount: f64,
    jitter: &'static str,
    penumbrae: &Penumbrae,
) -> Result<Vec<Draws>> {
    let mut found = Vec::new();
    run.set(&["soft_method=fast"])?;
    for count in COUNTS {
        run.set_lights(count, amount)?;
        let mut rms = Vec::new();
        for draw in 0..DRAWS {
            if run.is_stopped() {
                return Ok(found);
            }
            run.set(&[&format!("first_jitter={}", draw * most())])?;
            rms.push(penumbrae.deviation(&run.visibility()?).rms);
            run.progress.add(count as u64);
        }
        found.push(Draws {
            amount,
            jitter,
            count,
            rms,
            uncertain: 0.5 * penumbrae.halves_differ,
        });
    }
    run.set(&["soft_method=handout", "first_jitter=0"])?;
    Ok(found)
}

/// The mean of the first renders in f64, for each number of them. A single render is its own mean: RGBA32F gives it back.
fn means(run: &mut Run, amount: f64, counts: &[usize]) -> Result<Option<Vec<Vec<f64>>>> {
    run.set(&["accumulator=RGBA32F"])?;
    run.set_lights(1, amount)?;
    let mut means = Vec::new();
    let mut sum: Vec<f64> = Vec::new();
    for index in 0..counts[counts.len() - 1] {
        if run.is_stopped() {
            return Ok(None);
        }
        run.set(&[&format!("first_jitter={index}")])?;
        let render = run.picture()?;
        sum.resize(render.as_raw().len(), 0.0);
        let values = sum.iter_mut().zip(render.as_raw());
        values.for_each(|(sum, value)| *sum += f64::from(*value));
        if counts.contains(&(index + 1)) {
            let count = (index + 1) as f64;
            means.push(sum.iter().map(|sum| sum / count).collect());
        }
        run.progress.add(1);
    }
    run.set(&["first_jitter=0"])?;
    Ok(Some(means))
}

fn differences(picture: &RgbImage, mean: &[f64]) -> impl Iterator<Item = f64> {
    let values = picture.as_raw().iter().zip(mean);
    values.map(|(value, mean)| f64::from(*value) - mean)
}

/// Another level than the mean is rounded to, whichever way a half is rounded.
fn other_level(picture: &RgbImage, mean: &[f64]) -> f64 {
    // More than the rounding of f64, less than the next possible mean is away from a half.
    const HALF: f64 = 0.5 + 1e-9;
    let others = differences(picture, mean).filter(|difference| difference.abs() > HALF);
    others.count() as f64 / mean.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_may_be_rounded_either_way() {
        let picture = RgbImage::from_raw(2, 1, vec![1, 2, 3, 4, 5, 6]).unwrap();
        assert_eq!(other_level(&picture, &[1.5, 1.5, 3.0, 4.4, 5.5, 5.5]), 0.0);
        // The control.
        assert_eq!(
            other_level(&picture, &[1.6, 1.4, 3.0, 4.4, 5.5, 5.5]),
            2.0 / 6.0
        );
    }

    #[test]
    fn draws_are_averaged_as_squares() {
        let draws = Draws {
            amount: 0.1,
            jitter: "random",
            count: 1,
            rms: vec![3.0, 4.0],
            uncertain: 0.0,
        };
        assert_eq!(draws.mean(), 12.5_f64.sqrt());
    }
}
