//! Uniforms that did not go where they should, or were never set.

use std::collections::BTreeSet;

use super::{Map, Second};
use crate::calls::frame::{Draw, Frame};
use crate::calls::handouts::Handout;
use crate::calls::objects::{Program, Value, looks_like_matrix};
use crate::calls::report::{Mark, Steps};
use crate::calls::state::{SlipKind, State};

pub fn judge(steps: &mut Steps, handout: &Handout, frame: &Frame, maps: &[Map], state: &State) {
    slips(steps, handout.second_pass, state);
    let mut known = BTreeSet::new();
    let passes = frame.passes.iter().chain(maps.iter().map(|map| map.pass));
    for draw in passes.flat_map(|pass| &pass.draws) {
        let Some(program) = &draw.program else {
            continue;
        };
        // A program of a frame is looked at once, at its first draw call.
        if known.insert(program.id.clone()) {
            never_set(steps, handout, program, draw);
        }
    }
    for map in maps {
        let second = super::second_pass(frame, map, maps);
        no_bias(steps, handout, map, &second);
    }
}

/// What glUniform was given, and where it went.
pub fn slips(steps: &mut Steps, place: &'static str, state: &State) {
    for slip in &state.slips {
        let step = (place, "every uniform goes to its own program and place");
        match &slip.kind {
            SlipKind::Nowhere { program, names } => steps.mistake(step, Mark::OtherArguments, slip.line, "misspelt_uniform",
                format!("glUniform at location -1: program {program} has no uniform {}", names.join(" or "))),
            SlipKind::NoProgram { location } => steps.other(step, Mark::OutOfOrder, slip.line,
                format!("location {location} is set while no program is in use"),
                "the uniform keeps its old value, at first 0", "glUseProgram before glUniform"),
            SlipKind::OtherProgram { used, meant, name } => steps.mistake(step, Mark::OutOfOrder, slip.line, "same_texture_unit",
                format!("program {used} is in use, and the location is that of {name} in program {meant}")),
            SlipKind::OtherType { name, kind, call } => steps.other(step, Mark::OtherArguments, slip.line,
                format!("{call} for {name}, which is a {kind}"),
                "the driver refuses it, and the uniform keeps its old value", "another program is in use than the one meant, or the function is that of another type"),
        }
    }
}

/// A matrix that somebody asked for and nobody set is all zeros.
fn never_set(steps: &mut Steps, handout: &Handout, program: &Program, draw: &Draw) {
    let step = (handout.matrix, "every matrix of the program is set");
    for (location, name) in &program.names {
        let is_matrix = match program.declared(&name.value) {
            Some(uniform) => uniform.kind == "mat4" && !uniform.has_value,
            None => program.source.is_none() && looks_like_matrix(&name.value),
        };
        if is_matrix && !program.values.contains_key(location) {
            steps.mistake(
                step,
                Mark::Missing,
                name.line,
                "misspelt_uniform",
                format!(
                    "{} is never set, and so all zeros when line {} draws with it",
                    name.value, draw.line
                ),
            );
        }
    }
}

/// A bias of 0, and nothing else against acne.
fn no_bias(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second) {
    let step = (handout.acne, "a bias, an offset, or front faces culled");
    let helped = map.pass.draws.iter().any(|draw| {
        let culls =
            draw.pipeline.is_on("GL_CULL_FACE") && draw.pipeline.cull_face.value == "GL_FRONT";
        culls || draw.pipeline.is_on("GL_POLYGON_OFFSET_FILL")
    });
    let Some(program) = second.draws.first().and_then(|draw| draw.program.as_ref()) else {
        return;
    };
    for (location, name) in &program.names {
        let lower = name.value.to_lowercase();
        let is_bias =
            lower.contains("bias") && !looks_like_matrix(&lower) || lower.contains("epsilon");
        let Some(set) = program.values.get(location).filter(|_| is_bias) else {
            continue;
        };
        let Value::Float(bias) = set.value else {
            continue;
        };
        if bias == 0.0 && !helped {
            steps.mistake(
                step,
                Mark::OtherArguments,
                set.line,
                "no_bias",
                format!("{} is 0", name.value),
            );
        } else {
            steps.found(step, set.line, format!("{} is {bias}", name.value));
        }
    }
}
