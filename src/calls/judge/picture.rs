//! The second pass: the window is drawn to again, and the shader finds the map.

use super::{Map, Second, is_for_a_map};
use crate::calls::frame::{Frame, Reading, StepKind};
use crate::calls::handouts::Handout;
use crate::calls::report::{Mark, Steps};
use crate::calls::state::State;

/// What the first pass changed, and the second pass needs otherwise.
pub fn restored(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, state: &State) {
    let step = (
        handout.first_pass,
        "glBindFramebuffer(GL_FRAMEBUFFER, 0) behind it",
    );
    let into_map = &map.pass.target;
    let (Some(pass), Some(first)) = (second.pass, second.draws.first()) else {
        return steps.other(
            step,
            Mark::Missing,
            into_map.line,
            format!("everything is drawn into framebuffer {}", into_map.value),
            "the window stays as it was cleared, or empty",
            "bind framebuffer 0 before the second pass",
        );
    };
    if second.attached {
        let found = format!(
            "line {} reads texture {} while it is attached to framebuffer {}, which is drawn to",
            first.line, map.id, pass.target.value
        );
        return steps.other(
            step,
            Mark::Missing,
            into_map.line,
            found,
            "the window stays empty; what is read from a texture that is drawn to is undefined",
            "bind framebuffer 0 before the second pass",
        );
    }
    steps.found(
        step,
        pass.target.line,
        match pass.target.value.as_str() {
            "0" => "it is".to_owned(),
            other => format!("framebuffer {other}, with a picture of its own"),
        },
    );

    let step = (handout.second_pass, "glViewport, with the window's size");
    let (viewport, of_map) = (
        &first.pipeline.viewport,
        map.pass.draws.first().map(|draw| &draw.pipeline.viewport),
    );
    let [_, _, w, h] = viewport.value;
    let is_maps = map.texture.size() == Some((w, h))
        && of_map.is_some_and(|of_map| of_map.line == viewport.line);
    if is_maps && state.window != Some((w, h)) {
        steps.mistake(
            step,
            Mark::Missing,
            viewport.line,
            "viewport_not_restored",
            format!("it is still the map's, {w}×{h}"),
        );
    } else if let Some((width, height)) = state
        .window
        .filter(|window| *window != (w, h) && pass.target.value == "0")
    {
        steps.mistake(
            step,
            Mark::Unclear,
            viewport.line,
            "viewport_not_restored",
            format!("it is {w}×{h}, and the window was made with {width}×{height}"),
        );
    } else {
        steps.found(step, viewport.line, format!("{w}×{h}"));
    }

    // A first pass that culls front faces leaves that behind.
    let culls = |draw: &crate::calls::frame::Draw| {
        draw.pipeline.is_on("GL_CULL_FACE") && draw.pipeline.cull_face.value == "GL_FRONT"
    };
    if map.pass.draws.iter().any(culls) {
        let step = (handout.acne, "glCullFace(GL_BACK) behind the first pass");
        match second.draws.iter().find(|draw| culls(draw)) {
            Some(draw) => steps.other(
                step,
                Mark::Missing,
                draw.pipeline.cull_face.line,
                "front faces are culled in the second pass, too",
                "objects are seen from inside",
                "reset the culling face",
            ),
            None => steps.found(step, first.pipeline.cull_face.line, "it is reset"),
        }
    }
}

pub fn cleared(steps: &mut Steps, handout: &Handout, second: &Second, frame: &Frame) {
    let (Some(pass), false) = (second.pass, second.attached) else {
        return;
    };
    let step = (
        handout.second_pass,
        "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    );
    let clears = frame.steps.iter().filter(|step| {
        matches!(&step.what, StepKind::Clear { target, depth: true, .. } if *target == pass.target.value)
    });
    let before: Vec<u64> = clears
        .map(|step| step.line)
        .filter(|line| *line < second.draws[0].line)
        .collect();
    match before.last() {
        Some(line) => steps.found(step, *line, "it is"),
        None => steps.other(
            step,
            Mark::Missing,
            pass.target.line,
            format!(
                "the depth of framebuffer {} is not cleared",
                pass.target.value
            ),
            "of the frames behind the first one little or nothing is seen",
            "clear color and depth before the second pass",
        ),
    }
}

/// The sampler, its unit, and what is bound there.
pub fn samplers(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second) {
    let step = (
        handout.second_pass,
        "the depth texture on the unit of its sampler",
    );
    let Some(first) = second.draws.first() else {
        return;
    };
    if second.reads {
        let Some(reading) = first.reads(map.id) else {
            return;
        };
        let Some((bound, _)) = &reading.texture else {
            return;
        };
        let unit = reading.sampler.unit.value;
        steps.found(
            step,
            bound.line,
            format!(
                "texture {} on unit {unit}, read by {}",
                map.id, reading.sampler.name
            ),
        );
        let elsewhere = second
            .draws
            .iter()
            .filter(|draw| draw.reads(map.id).is_none())
            .count();
        if elsewhere > 0 {
            steps.other(
                step,
                Mark::Unclear,
                0,
                format!("{elsewhere} draw calls of the same program read another texture there"),
                "",
                "",
            );
        }
    }
    shared_unit(steps, handout, map, second);
    if second.reads {
        return;
    }

    // Nothing reads the map. Where is it bound, and where does its sampler look?
    let bound = first.units.iter().find(|(_, set)| set.value == *map.id);
    let wanted = first
        .samplers
        .iter()
        .find(|reading| is_for_a_map(&reading.sampler))
        .or(first.samplers.last());
    match (bound, wanted) {
        (_, None) => steps.other(
            step,
            Mark::Missing,
            first.line,
            format!("no shader of the second pass reads texture {}", map.id),
            "there are no shadows",
            "select the lighting program, and give it a sampler for the map",
        ),
        (Some((unit, set)), Some(reading)) => {
            let sampler = &reading.sampler;
            let how = if sampler.unit.line == 0 {
                "was never set in its program, and so reads"
            } else {
                "reads"
            };
            steps.mistake(
                step,
                Mark::OtherArguments,
                if sampler.unit.line == 0 {
                    set.line
                } else {
                    sampler.unit.line
                },
                "same_texture_unit",
                format!(
                    "the texture is on unit {unit}, and {} {how} unit {}",
                    sampler.name, sampler.unit.value
                ),
            );
        }
        (None, Some(reading)) => {
            let there = reading
                .texture
                .as_ref()
                .map_or("nothing".to_owned(), |(id, _)| {
                    format!("texture {}", id.value)
                });
            steps.other(step, Mark::Missing, reading.bound, format!("texture {} is bound to no unit; on unit {}, which {} reads, there is {there}", map.id, reading.sampler.unit.value, reading.sampler.name),
                "no shadow, or shadows that follow another texture", "glActiveTexture with the sampler's unit, then glBindTexture with the depth texture");
        }
    }
}

/// Two samplers that should read two textures.
fn shared_unit(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second) {
    let step = (
        handout.second_pass,
        "a texture unit of its own for each sampler",
    );
    let concerns = |reading: &Reading| {
        let reads = reading
            .texture
            .as_ref()
            .is_some_and(|(id, _)| id.value == *map.id);
        reads || is_for_a_map(&reading.sampler)
    };
    for draw in &second.draws {
        for (place, a) in draw.samplers.iter().enumerate() {
            for b in &draw.samplers[place + 1..] {
                if a.sampler.unit.value == b.sampler.unit.value && (concerns(a) || concerns(b)) {
                    let [a, b] = [&a.sampler, &b.sampler];
                    return steps.mistake(
                        step,
                        Mark::Wrong,
                        a.unit.line.max(b.unit.line),
                        "same_texture_unit",
                        format!("{} and {} both read unit {}", a.name, b.name, a.unit.value),
                    );
                }
            }
        }
    }
    let several = second.draws.iter().find(|draw| draw.samplers.len() > 1);
    if let Some(draw) = several {
        let units: Vec<_> = draw
            .samplers
            .iter()
            .map(|reading| format!("{} {}", reading.sampler.name, reading.sampler.unit.value))
            .collect();
        let line = draw
            .samplers
            .iter()
            .map(|reading| reading.sampler.unit.line)
            .max();
        steps.found(step, line.unwrap_or(0), units.join(", "));
    }
}
