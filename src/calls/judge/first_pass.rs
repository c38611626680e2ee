//! The state in which the shadow map is drawn.

use super::faults::{NO_DEPTH_WRITTEN, NO_SHADOW_PROGRAM};
use super::map::DRAW;
use super::{Map, Second};
use crate::calls::frame::{Clear, Frame, Step, StepKind};
use crate::calls::handouts::Handout;
use crate::calls::report::{Asked, Mark, Steps};

pub fn judge(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, frame: &Frame) {
    let place = handout.first_pass;
    let pass = map.pass;
    let Some(first) = pass.draws.first() else {
        return;
    };
    let step = (place, "glBindFramebuffer, with the map's framebuffer");
    let target = &pass.target;
    steps.found(step, target.line, format!("framebuffer {}", target.value));

    viewport(steps, (place, "glViewport, with the map's size"), map);
    let step = (
        place,
        "glClear(GL_DEPTH_BUFFER_BIT), with the depth mask on",
    );
    clear(steps, step, map, second, frame);
    depth_is_written(
        steps,
        (place, "the depth test and the depth mask are on"),
        map,
    );

    let step = (place, "the shadow program");
    match &first.program {
        Some(program) => steps.found(step, first.used, format!("program {}", program.id)),
        None if handout.fixed_pipeline => steps.found(step, first.used, "the fixed pipeline"),
        None => {
            let told = "the fixed pipeline";
            steps.fault(step, Mark::Unclear, first.used, told, &NO_SHADOW_PROGRAM);
        }
    }
    let old = if map.is_old {
        ", for an earlier frame"
    } else {
        ""
    };
    let calls = if pass.count == 1 { "call" } else { "calls" };
    steps.found(
        (place, DRAW),
        first.line,
        format!("{} draw {calls}{old}", pass.count),
    );
}

fn viewport(steps: &mut Steps, step: Asked, map: &Map) {
    let viewport = &map.pass.draws[0].pipeline.viewport;
    let Some((width, height)) = map.texture.size() else {
        return;
    };
    let [x, y, w, h] = viewport.value;
    if viewport.value == [0, 0, width, height] {
        return steps.found(step, viewport.line, format!("{width}×{height}"));
    }
    let is_new = viewport.line > map.pass.target.line;
    let mark = if is_new {
        Mark::OtherArguments
    } else {
        Mark::Missing
    };
    let told = match viewport.line {
        0 => format!("it is the window's, and the map {width}×{height}"),
        _ => format!("it is {w}×{h} at ({x}, {y}), and the map {width}×{height}"),
    };
    steps.mistake(step, mark, viewport.line, "viewport_not_set", told);
}

fn clear(steps: &mut Steps, step: Asked, map: &Map, second: &Second, frame: &Frame) {
    let pass = map.pass;
    // Where the second pass draws into the map, too, its clearing is no fault of the first pass.
    let late = pass.late_clear.as_ref().filter(|_| !second.attached);
    let (mark, line, told) = match (&pass.clear, late) {
        (_, Some(late)) => {
            let told = format!(
                "behind the first draw call, line {}, it wipes the map",
                pass.first
            );
            (Mark::OutOfOrder, late.line, told)
        }
        (
            Some(Clear {
                mask_off: Some(mask),
                line,
                ..
            }),
            _,
        ) => {
            let told = format!("the depth mask is off since line {mask}, and nothing is cleared");
            (Mark::Wrong, *line, told)
        }
        (Some(clear), _) if clear.depth.value != 1.0 => {
            let told = format!("to {}, and nothing is nearer than that", clear.depth.value);
            (Mark::OtherArguments, clear.line, told)
        }
        (Some(clear), _) => return steps.found(step, clear.line, "it is"),
        (None, None) => match too_early(map, frame) {
            Some((line, target)) => {
                let bind = pass.target.line;
                let told =
                    format!("the one before the bind, line {bind}, clears framebuffer {target}");
                (Mark::OutOfOrder, line, told)
            }
            None => {
                let told = "there is none before the first draw call".to_owned();
                (Mark::Missing, pass.first, told)
            }
        },
    };
    steps.mistake(step, mark, line, "map_not_cleared", told);
}

/// A clearing with another framebuffer bound that is the last before the map's is.
fn too_early<'a>(map: &Map, frame: &'a Frame) -> Option<(u64, &'a str)> {
    let mut before = frame.steps.iter().rev();
    let last = before.find(|step| step.line < map.pass.target.line)?;
    match last {
        Step {
            line,
            what:
                StepKind::Clear {
                    target,
                    depth: true,
                    ..
                },
        } if !map.is_old => Some((*line, target)),
        _ => None,
    }
}

fn depth_is_written(steps: &mut Steps, step: Asked, map: &Map) {
    let draws = &map.pass.draws;
    let pipeline = &draws[0].pipeline;
    let test = pipeline.line_of("GL_DEPTH_TEST");
    let is_written = draws
        .iter()
        .any(|draw| draw.pipeline.is_on("GL_DEPTH_TEST") && !draw.pipeline.depth_mask_off.value);
    if is_written {
        return steps.found(step, test, "they are");
    }
    let mask = &pipeline.depth_mask_off;
    let (line, told) = match mask.value {
        true => (mask.line, "glDepthMask(GL_FALSE)"),
        false => (test, "GL_DEPTH_TEST is off, and then no depth is written"),
    };
    steps.fault(step, Mark::Wrong, line, told, &NO_DEPTH_WRITTEN);
}
