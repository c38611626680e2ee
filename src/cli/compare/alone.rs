//! One picture with shadows, against the lab's.

use std::path::Path;

use image::{RgbImage, imageops};
use shadowlab::compare::{
    Difference, Forgiven, Matching, Shadows, TOLERANCE, TOLERANCE_OF_JPEG, forgive, resized,
};
use shadowlab::diagnosis::Diagnosis;
use shadowlab::labs::Handout;
use shadowlab::{Error, Result};

use super::CompareCommand;
use super::judged::Judged;
use super::lab::LabPictures;
use super::load::{Loaded, load};

/// Mistakes are looked for in so many pixels at most: each of them is drawn, and all are kept.
const MOST_DIAGNOSED: u32 = 1 << 20;

/// What was found of a picture at one size.
struct Held<'a> {
    lab: LabPictures<'a>,
    right: RgbImage,
    difference: Difference,
    /// After what was forgiven.
    mine: RgbImage,
    forgiven: Vec<Forgiven>,
}

pub fn judge(command: &CompareCommand, handout: &'static Handout, path: &Path) -> Result<Judged> {
    let loaded = load(path, command.crop)?;
    judge_loaded(command, handout, path, loaded, None)
}

/// `shadows` are those of a light (from 1), where they need not be read from the picture alone.
pub fn judge_loaded(
    command: &CompareCommand,
    handout: &'static Handout,
    path: &Path,
    loaded: Loaded,
    shadows: Option<(usize, Shadows)>,
) -> Result<Judged> {
    let Loaded {
        picture: mut given,
        is_jpeg,
        mut notes,
    } = loaded;
    let found: [u32; 2] = given.dimensions().into();
    let reference = command.reference.as_deref();
    let reference = reference.map(|path| load(path, command.crop)).transpose()?;
    let reference = reference.map(|loaded| loaded.picture);
    let expected = match &reference {
        Some(reference) => Some(reference.dimensions().into()),
        None => command.changes.size,
    };
    let size = expected.unwrap_or(found);
    if command.strict && size != found {
        let [width, height] = size;
        let message = format!(
            "{}×{} pixels, expected {width}×{height}",
            found[0], found[1]
        );
        return Err(Error::input(path, None, message));
    }

    let tolerance = match is_jpeg && !command.strict {
        true => TOLERANCE_OF_JPEG,
        false => TOLERANCE,
    };
    let hold = |given: &RgbImage, window| {
        hold(
            command,
            handout,
            given,
            reference.as_ref(),
            window,
            tolerance,
        )
    };
    let mut held = hold(&given, size)?;
    // A picture of another size is one of a smaller window, or one that was scaled.
    let window = command.window(handout)?;
    let may_be_scaled = !command.strict && expected.is_none() && is_scaled(found, window);
    if may_be_scaled && !held.difference.is_same() {
        let scaled = hold(&given, window)?;
        if scaled.difference.is_same() {
            held = scaled;
        }
    }
    let diagnosis = if held.difference.is_same() {
        Some(Diagnosis::Right)
    } else if let Some(test) = command.changes.other_test() {
        notes.push(format!(
            "the mistakes are of the handout's test: with shadow_test={test} none is looked for"
        ));
        None
    } else {
        let mine = fitted(&given, reduced(found));
        let diagnose = |window| {
            let lab = LabPictures::new(handout, &command.changes, window, &command.device);
            let mut suspects = lab.suspects()?;
            if window != reduced(found) {
                suspects = suspects.resized(reduced(found));
            }
            Ok::<_, Error>(suspects.diagnose(&mine, tolerance, command.strict))
        };
        let diagnosis = diagnose(reduced(size))?;
        Some(match may_be_scaled {
            true => diagnosis.or_better(diagnose(reduced(window))?),
            false => diagnosis,
        })
    };

    // A mistake can hide which way up a picture is, and its curve, until it is known.
    if let Some(Diagnosis::Explained(found)) = &diagnosis {
        let hidden: Vec<Forgiven> = hidden(&found[0].forgiven, &held.forgiven);
        if !hidden.is_empty() {
            for forgiven in &hidden {
                given = match forgiven {
                    Forgiven::Curve(curve) => curve.undone(&given),
                    _ => imageops::flip_vertical(&given),
                };
            }
            held = hold(&given, size)?;
            held.forgiven.extend(hidden);
        }
    }
    if tolerance == TOLERANCE_OF_JPEG {
        held.forgiven.insert(0, Forgiven::Jpeg);
    }
    let Held {
        lab,
        right,
        difference,
        mine,
        forgiven,
    } = held;
    let read = match shadows {
        Some((light, shadows)) => Some(lab.read_of(light, shadows)?),
        None => lab.read(Shadows::between(&mine, &lab.lit()?, &lab.dark()?))?,
    };
    if read.is_none() {
        notes.push(format!(
            "the shadows of {} lights cannot be told apart in one picture: no figures of them",
            handout.lights
        ));
    }
    Ok(Judged {
        name: path.display().to_string(),
        handout,
        options: lab.state.options(),
        forgiven,
        notes,
        findings: Vec::new(),
        difference: Some(difference),
        diagnosis,
        read,
        mine,
        reference: right,
    })
}

/// Holds the picture against the lab's in a window of that size, scaled as the picture was since; or against the
/// reference, as whose size the picture is looked at.
fn hold<'a>(
    command: &'a CompareCommand,
    handout: &'static Handout,
    given: &RgbImage,
    reference: Option<&RgbImage>,
    window: [u32; 2],
    tolerance: u8,
) -> Result<Held<'a>> {
    let lab = |size| LabPictures::new(handout, &command.changes, size, &command.device);
    let found: [u32; 2] = given.dimensions().into();
    let (size, right) = match reference {
        Some(reference) => (window, reference.clone()),
        None => (found, fitted(&lab(window).right()?, found)),
    };
    let mut forgiven = Vec::new();
    if found != window {
        forgiven.push(Forgiven::Size(found));
    }
    let mine = fitted(given, size);
    let lab = lab(size);
    if command.strict {
        return Ok(Held {
            difference: Difference::new(&mine, &right, Matching::Exact, tolerance),
            lab,
            right,
            mine,
            forgiven,
        });
    }
    let found = forgive(mine, &right);
    let reference = found.darkened_reference.as_ref().unwrap_or(&right);
    let difference = Difference::new(&found.mine, reference, Matching::WithinAPixel, tolerance);
    forgiven.extend(&found.forgiven);
    Ok(Held {
        mine: found.brightened(),
        lab,
        right,
        difference,
        forgiven,
    })
}

/// What turns out to be forgiven when the mistake is known, of what the right picture could not tell.
fn hidden(known: &[Forgiven], before: &[Forgiven]) -> Vec<Forgiven> {
    let is_curve = |forgiven: &Forgiven| matches!(forgiven, Forgiven::Curve(_));
    let is_new = |forgiven: &&Forgiven| match forgiven {
        Forgiven::UpsideDown => !before.contains(&Forgiven::UpsideDown),
        Forgiven::Curve(_) => !before.iter().any(is_curve),
        _ => false,
    };
    known.iter().filter(is_new).copied().collect()
}

fn fitted(picture: &RgbImage, size: [u32; 2]) -> RgbImage {
    match size == <[u32; 2]>::from(picture.dimensions()) {
        true => picture.clone(),
        false => resized(picture, size),
    }
}

/// Whether a picture may be one of that window in another size: its sides have the same ratio, up to a pixel.
fn is_scaled([width, height]: [u32; 2], window: [u32; 2]) -> bool {
    let across = u64::from(width) * u64::from(window[1]);
    let down = u64::from(height) * u64::from(window[0]);
    let a_pixel = u64::from(window[0].max(window[1]));
    [width, height] != window && across.abs_diff(down) <= a_pixel
}

/// The size, or a smaller one with the same ratio of its sides.
fn reduced(size: [u32; 2]) -> [u32; 2] {
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    let scale = (f64::from(MOST_DIAGNOSED) / pixels).sqrt().min(1.0);
    size.map(|side| ((f64::from(side) * scale) as u32).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scaled_picture_has_the_windows_ratio() {
        assert!(is_scaled([375, 375], [500, 500]) && is_scaled([1200, 900], [800, 600]));
        // Three quarters of 335 is 251.25.
        assert!(is_scaled([375, 251], [500, 335]));
        assert!(!is_scaled([500, 500], [500, 500]) && !is_scaled([500, 400], [500, 500]));
    }

    #[test]
    fn a_large_picture_is_diagnosed_small() {
        assert_eq!(reduced([500, 500]), [500, 500]);
        assert_eq!(reduced([4096, 4096]), [1024, 1024]);
        assert_eq!(reduced([1 << 20, 4]), [524_288, 2]);
    }
}
