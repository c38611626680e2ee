//! A picture with shadows and one without: the shadows alone, whatever the shading.

use std::path::Path;

use image::imageops;
use shadowlab::compare::{Forgiven, Shadows, TOLERANCE, forgive};
use shadowlab::labs::Handout;
use shadowlab::{Error, Result};

use super::CompareCommand;
use super::judged::Judged;
use super::lab::{LabPictures, black_and_white};
use super::load::load;

pub fn judge(
    command: &CompareCommand,
    handout: &'static Handout,
    on: &Path,
    off: &Path,
) -> Result<Judged> {
    let (on_loaded, off_loaded) = (load(on, command.crop)?, load(off, command.crop)?);
    let mut notes = [on_loaded.notes, off_loaded.notes].concat();
    let (mut mine, mut without) = (on_loaded.picture, off_loaded.picture);
    let size: [u32; 2] = mine.dimensions().into();
    let found: [u32; 2] = without.dimensions().into();
    let [width, height] = size;
    if found != size {
        let message = format!(
            "{}×{} pixels, expected {width}×{height} as {} has",
            found[0],
            found[1],
            on.display()
        );
        return Err(Error::input(off, None, message));
    }
    if command
        .changes
        .size
        .is_some_and(|expected| expected != size)
    {
        return Err(Error::usage(format!(
            "--size: {} has {width}×{height} pixels, and a pair is not scaled",
            on.display()
        )));
    }

    let lab = LabPictures::new(handout, &command.changes, size, &command.device);
    let mut forgiven = Vec::new();
    if !command.strict {
        forgiven = forgive(without.clone(), &lab.lit()?).forgiven;
        // Their shading is not looked at, and their curve is the same in both.
        forgiven.retain(|found| *found == Forgiven::UpsideDown);
    }
    if !forgiven.is_empty() {
        mine = imageops::flip_vertical(&mine);
        without = imageops::flip_vertical(&without);
    }
    let shadows = Shadows::ratio(&mine, &without);
    let seen = black_and_white(&shadows);
    let Some(read) = lab.read(shadows)? else {
        return Err(Error::usage(format!(
            "compare: {} lights cast shadows, which a pair of pictures cannot tell apart, expected one: \
             --set lights=…",
            handout.lights
        )));
    };
    let diagnosis = if read.is_right() {
        None
    } else if let Some(test) = command.changes.other_test() {
        notes.push(format!(
            "the mistakes are of the handout's test: with shadow_test={test} none is looked for"
        ));
        None
    } else {
        Some(lab.suspected_shadows()?.diagnose(&seen, TOLERANCE, true))
    };
    Ok(Judged {
        name: format!("{} and {}", on.display(), off.display()),
        handout,
        options: lab.state.options(),
        forgiven,
        notes,
        findings: Vec::new(),
        difference: None,
        diagnosis,
        read: Some(read),
        mine,
        reference: lab.right()?,
    })
}
