//! Uniforms that did not go where they should, or were never set.

use std::collections::BTreeSet;

use super::faults::{NO_PROGRAM, OTHER_PROGRAM, OTHER_TYPE};
use super::{Map, Second};
use crate::calls::frame::{Draw, Frame};
use crate::calls::handouts::Handout;
use crate::calls::objects::{Program, Value, looks_like_matrix, looks_like_sampler};
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
    let step = (place, "every uniform goes to its own program and place");
    for slip in &state.slips {
        let line = slip.line;
        match &slip.kind {
            SlipKind::Nowhere { program, names } => {
                let names = names.join(" or ");
                let told = format!("glUniform at location -1: program {program} has no {names}");
                steps.mistake(step, Mark::OtherArguments, line, "misspelt_uniform", told);
            }
            SlipKind::NoProgram { location } => {
                let told = format!("location {location} is set while no program is in use");
                steps.fault(step, Mark::OutOfOrder, line, told, &NO_PROGRAM);
            }
            SlipKind::OtherProgram { used, meant, name } => {
                let told = format!(
                    "program {used} is in use, and the location is that of {name} in program {meant}"
                );
                if looks_like_sampler(name) {
                    steps.mistake(step, Mark::OutOfOrder, line, "same_texture_unit", told);
                } else {
                    steps.fault(step, Mark::OutOfOrder, line, told, &OTHER_PROGRAM);
                }
            }
            SlipKind::OtherType { name, kind, call } => {
                let told = format!("{call} for {name}, which is a {kind}");
                steps.fault(step, Mark::OtherArguments, line, told, &OTHER_TYPE);
            }
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
            let told = format!(
                "{} is never set, and so all zeros when line {} draws with it",
                name.value, draw.line
            );
            steps.mistake(step, Mark::Missing, name.line, "misspelt_uniform", told);
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
