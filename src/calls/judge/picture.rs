//! The second pass: the window is drawn to again, and the shader finds the map.

use super::faults::{
    ATTACHED, CULLING, DEPTH_NOT_CLEARED, NOT_BOUND, NOT_RESTORED, NOT_TOLD, NOTHING_READS,
    WINDOW_GETS_NO_COLOR,
};
use super::{Map, Second, is_for_a_map};
use crate::calls::frame::{Draw, Frame, Reading, StepKind};
use crate::calls::handouts::Handout;
use crate::calls::report::{Asked, Mark, Steps};
use crate::calls::state::State;

/// What the first pass changed, and the second pass needs otherwise.
pub fn restored(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, state: &State) {
    let step = (
        handout.first_pass,
        "glBindFramebuffer(GL_FRAMEBUFFER, 0) behind it",
    );
    let into_map = &map.pass.target;
    let (Some(pass), Some(first)) = (second.pass, second.draws.first()) else {
        let told = format!("everything is drawn into framebuffer {}", into_map.value);
        return steps.fault(step, Mark::Missing, into_map.line, told, &NOT_RESTORED);
    };
    if second.attached {
        let told = format!(
            "line {} reads texture {}, and draws into framebuffer {}, to which it is attached",
            first.line, map.id, pass.target.value
        );
        return steps.fault(step, Mark::Missing, into_map.line, told, &ATTACHED);
    }
    let is_window = pass.target.value == "0";
    let told = match is_window {
        true => "it is".to_owned(),
        false => format!(
            "framebuffer {}, with a picture of its own",
            pass.target.value
        ),
    };
    steps.found(step, pass.target.line, told);
    let window = state
        .framebuffers
        .get("0")
        .filter(|window| is_window && window.draws_no_color());
    if let Some(chosen) = window.and_then(|window| window.draw_buffers.as_ref()) {
        let step = (
            handout.second_pass,
            "glDrawBuffer(GL_NONE) for the map alone",
        );
        let told = "framebuffer 0 was bound when it was called";
        steps.fault(
            step,
            Mark::OutOfOrder,
            chosen.line,
            told,
            &WINDOW_GETS_NO_COLOR,
        );
    }
    let window = state.window.filter(|_| is_window);
    let step = (handout.second_pass, "glViewport, with the window's size");
    viewport(steps, step, map, first, window);
    culling(
        steps,
        (handout.acne, "glCullFace(GL_BACK) behind the first pass"),
        map,
        second,
    );
}

fn viewport(steps: &mut Steps, step: Asked, map: &Map, first: &Draw, window: Option<(i64, i64)>) {
    let viewport = &first.pipeline.viewport;
    let [_, _, w, h] = viewport.value;
    let of_map = map
        .pass
        .draws
        .first()
        .map(|draw| draw.pipeline.viewport.line);
    let is_maps = map.texture.size() == Some((w, h)) && of_map == Some(viewport.line);
    if is_maps && window != Some((w, h)) {
        let told = format!("it is still the map's, {w}×{h}");
        return steps.mistake(
            step,
            Mark::Missing,
            viewport.line,
            "viewport_not_restored",
            told,
        );
    }
    match window.filter(|window| *window != (w, h)) {
        // A window may have grown, and a picture may be drawn in parts.
        Some((width, height)) => {
            let told = format!("it is {w}×{h}, and the window was made with {width}×{height}");
            steps.mistake(
                step,
                Mark::Unclear,
                viewport.line,
                "viewport_not_restored",
                told,
            );
        }
        None => steps.found(step, viewport.line, format!("{w}×{h}")),
    }
}

/// A first pass that culls front faces leaves that behind.
fn culling(steps: &mut Steps, step: Asked, map: &Map, second: &Second) {
    let culls = |draw: &Draw| {
        draw.pipeline.is_on("GL_CULL_FACE") && draw.pipeline.cull_face.value == "GL_FRONT"
    };
    if !map.pass.draws.iter().any(culls) {
        return;
    }
    match second.draws.iter().find(|draw| culls(draw)) {
        Some(draw) => {
            let told = "front faces are culled in the second pass, too";
            steps.fault(
                step,
                Mark::Missing,
                draw.pipeline.cull_face.line,
                told,
                &CULLING,
            );
        }
        None => {
            let line = second
                .draws
                .first()
                .map_or(0, |draw| draw.pipeline.cull_face.line);
            steps.found(step, line, "it is reset");
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
    let into = &pass.target;
    let first = second.draws[0].line;
    let clear = frame.steps.iter().rev().find(|step| {
        let StepKind::Clear { target, depth, .. } = &step.what else {
            return false;
        };
        step.line < first && *depth && *target == into.value
    });
    match clear {
        Some(clear) => steps.found(step, clear.line, "it is"),
        None => {
            let told = format!("the depth of framebuffer {} is not cleared", into.value);
            steps.fault(step, Mark::Missing, into.line, told, &DEPTH_NOT_CLEARED);
        }
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
    if let Some(reading) = first.reads(map.id) {
        let line = reading.texture.as_ref().map_or(0, |(bound, _)| bound.line);
        let (unit, name) = (reading.sampler.unit.value, &reading.sampler.name);
        steps.found(
            step,
            line,
            format!("texture {} on unit {unit}, read by {name}", map.id),
        );
        let (program, sampler) = (first.program.as_ref().map(|program| &program.id), name);
        others(steps, step, map, second, program, sampler);
    }
    shared_unit(steps, handout, map, second);
    if !second.reads {
        unread(steps, step, map, first);
    }
}

/// Draw calls between those that read the map for which another texture is in its place.
fn others(
    steps: &mut Steps,
    step: Asked,
    map: &Map,
    second: &Second,
    program: Option<&String>,
    sampler: &str,
) {
    let Some(pass) = second.pass else { return };
    let other = pass.draws.iter().find(|draw| {
        let same = draw.program.as_ref().map(|program| &program.id) == program;
        same && draw.reads(map.id).is_none()
            && draw
                .samplers
                .iter()
                .any(|reading| reading.sampler.name == sampler)
    });
    if let Some(draw) = other {
        let told = format!(
            "line {} draws with the same program and another texture there",
            draw.line
        );
        steps.fault(step, Mark::Unclear, draw.line, told, &NOT_TOLD);
    }
}

/// Nothing reads the map. Where is it bound, and where does its sampler look?
fn unread(steps: &mut Steps, step: Asked, map: &Map, first: &Draw) {
    let of_a_map = first
        .samplers
        .iter()
        .find(|reading| is_for_a_map(&reading.sampler));
    let Some(reading) = of_a_map.or(first.samplers.last()) else {
        let told = format!("no shader of the second pass reads texture {}", map.id);
        return steps.fault(step, Mark::Missing, first.line, told, &NOTHING_READS);
    };
    let (name, unit) = (&reading.sampler.name, &reading.sampler.unit);
    let bound = first.units.iter().find(|(_, set)| set.value == *map.id);
    let Some((at, set)) = bound else {
        let there = match &reading.texture {
            Some((id, _)) => format!("texture {}", id.value),
            None => "nothing".to_owned(),
        };
        let told = format!(
            "texture {} is bound to no unit; on unit {}, which {name} reads, there is {there}",
            map.id, unit.value
        );
        return steps.fault(step, Mark::Missing, reading.bound, told, &NOT_BOUND);
    };
    let (line, reads) = match unit.line {
        0 => (set.line, "was never set in its program, and so reads"),
        line => (line, "reads"),
    };
    let told = format!(
        "the texture is on unit {at}, and {name} {reads} unit {}",
        unit.value
    );
    steps.mistake(step, Mark::OtherArguments, line, "same_texture_unit", told);
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
            let shares = draw.samplers[place + 1..].iter().find(|b| {
                a.sampler.unit.value == b.sampler.unit.value && (concerns(a) || concerns(b))
            });
            if let Some(b) = shares {
                let [a, b] = [&a.sampler, &b.sampler];
                let line = a.unit.line.max(b.unit.line);
                let told = format!("{} and {} both read unit {}", a.name, b.name, a.unit.value);
                return steps.mistake(step, Mark::Wrong, line, "same_texture_unit", told);
            }
        }
    }
    if let Some(draw) = second.draws.iter().find(|draw| draw.samplers.len() > 1) {
        let samplers = draw.samplers.iter().map(|reading| &reading.sampler);
        let line = samplers.clone().map(|sampler| sampler.unit.line).max();
        let units: Vec<_> = samplers
            .map(|sampler| format!("{} {}", sampler.name, sampler.unit.value))
            .collect();
        steps.found(step, line.unwrap_or(0), units.join(", "));
    }
}
