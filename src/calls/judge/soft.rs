//! Soft shadows: pictures with the light at different places, averaged in an accumulation buffer of either kind.

use super::faults::{BANDS, HARD, NOT_RETURNED, SUM_THEN_DIVIDE};
use crate::calls::frame::{Draw, Frame, Pass, Step, StepKind};
use crate::calls::handouts::{FBO, SOFT};
use crate::calls::objects::Attachment;
use crate::calls::report::{Asked, Mark, Steps};
use crate::calls::state::State;

/// Of a sum of weights that students write as 0.33 or as 1/3.
const TOLERANCE: f64 = 0.011;

pub fn judge(steps: &mut Steps, frame: &Frame, state: &State) {
    let accumulated = frame.steps.iter().filter_map(|step| match &step.what {
        StepKind::Accumulate { operation, value } => Some((step.line, operation.as_str(), *value)),
        _ => None,
    });
    let accumulated: Vec<(u64, &str, f64)> = accumulated.collect();
    let mut blended: Vec<(&Pass, &Draw)> = Vec::new();
    for pass in &frame.passes {
        let adds = |draw: &&Draw| {
            let pipeline = &draw.pipeline;
            pipeline.is_on("GL_BLEND") && pipeline.blend.value[0] == "GL_CONSTANT_ALPHA"
        };
        blended.extend(pass.draws.iter().filter(adds).map(|draw| (pass, draw)));
    }
    if !accumulated.is_empty() {
        accumulation_buffer(steps, &accumulated, frame);
    } else if !blended.is_empty() {
        framebuffer_object(steps, &blended, frame, state);
    } else {
        let step = (SOFT, "the scene is drawn several times and averaged");
        steps.fault(
            step,
            Mark::Unclear,
            0,
            "nothing is accumulated in this frame",
            &HARD,
        );
    }
}

/// Of glAccum: line, operation and value of each.
fn accumulation_buffer(steps: &mut Steps, calls: &[(u64, &str, f64)], frame: &Frame) {
    let added: Vec<_> = calls
        .iter()
        .filter(|(_, operation, _)| matches!(*operation, "GL_ACCUM" | "GL_LOAD"))
        .collect();
    let (first, replaces) = match added.first() {
        Some((line, operation, _)) => (*line, *operation == "GL_LOAD"),
        None => (calls[0].0, false),
    };
    let step = (SOFT, "the accumulation buffer is cleared");
    match before(frame, first, |what| {
        matches!(
            what,
            StepKind::Clear {
                accumulation: true,
                ..
            }
        )
    }) {
        Some(clear) => steps.found(step, clear.line, "glClear(GL_ACCUM_BUFFER_BIT)"),
        None if replaces => steps.found(step, first, "GL_LOAD replaces what it held"),
        None => {
            let told = "nothing clears it before the first GL_ACCUM";
            steps.mistake(step, Mark::Missing, first, "accumulator_not_cleared", told);
        }
    }
    let returned = calls
        .iter()
        .find(|(_, operation, _)| *operation == "GL_RETURN");
    let values: Vec<f64> = added.iter().map(|call| call.2).collect();
    let step = (SOFT, "glAccum(GL_ACCUM, 1/numJitters) behind each picture");
    weights(
        steps,
        step,
        first,
        &values,
        returned.map_or(1.0, |call| call.2),
    );

    let step = (SOFT, "glAccum(GL_RETURN, 1) behind the last picture");
    match returned {
        Some((line, _, value)) => steps.found(step, *line, format!("with {value}")),
        None => steps.fault(step, Mark::Missing, first, "there is none", &NOT_RETURNED),
    }
}

/// Draw calls that blend a picture into the accumulator, each with its pass.
fn framebuffer_object(steps: &mut Steps, blended: &[(&Pass, &Draw)], frame: &Frame, state: &State) {
    let ((pass, first), (_, last)) = (blended[0], blended[blended.len() - 1]);
    let accumulator = &pass.target.value;
    let step = (
        FBO,
        "fbo_accum_init: the accumulator holds more than 8 bits",
    );
    match format(pass, state) {
        Some((line, format)) if holds_8_bits(&format) => {
            steps.fault(step, Mark::OtherArguments, line, format, &BANDS);
        }
        Some((line, format)) => steps.found(step, line, format),
        None => {}
    }

    let step = (FBO, "the accumulator is cleared");
    let is_clear = |what: &StepKind| matches!(what, StepKind::Clear { target, color: true, .. } if target == accumulator);
    match before(frame, first.line, is_clear) {
        Some(clear) => steps.found(step, clear.line, "it is"),
        None => {
            let told = format!(
                "framebuffer {accumulator} is not cleared before the first picture is added"
            );
            steps.mistake(
                step,
                Mark::Missing,
                first.line,
                "accumulator_not_cleared",
                told,
            );
        }
    }

    let step = (
        FBO,
        "fbo_accum: blended with (GL_CONSTANT_ALPHA, GL_ONE) by 1/numJitters",
    );
    let pipeline = &first.pipeline;
    let kept = &pipeline.blend.value[1];
    if kept == "GL_ONE" {
        let values = blended
            .iter()
            .map(|(_, draw)| draw.pipeline.blend_alpha.value);
        let values: Vec<f64> = values.collect();
        weights(steps, step, pipeline.blend_alpha.line, &values, 1.0);
    } else {
        let told = format!("what is there is multiplied by {kept}");
        steps.mistake(
            step,
            Mark::OtherArguments,
            pipeline.blend.line,
            "weights_wrong",
            told,
        );
    }

    let step = (FBO, "fbo_accum_return: a copy to the window");
    let is_return = |step: &&Step| {
        let to_window =
            matches!(&step.what, StepKind::Blit { from, to } if from != "0" && to == "0");
        to_window && step.line > last.line
    };
    let copied = frame.steps.iter().find(is_return).map(|step| step.line);
    let mut passes = frame.passes.iter();
    let drawn = passes.find(|pass| pass.target.value == "0" && pass.last > last.line);
    match copied.or(drawn.map(|pass| pass.last)) {
        Some(line) => steps.found(step, line, "it is"),
        None => {
            let told = "framebuffer 0 gets nothing behind the last picture";
            steps.fault(step, Mark::Missing, last.line, told, &NOT_RETURNED);
        }
    }
}

/// Says whether weights sum up to 1.
fn weights(steps: &mut Steps, step: Asked, line: u64, weights: &[f64], returned: f64) {
    let sum: f64 = weights.iter().sum();
    let rounded = (sum * 1e4).round() / 1e4;
    let told = format!(
        "{} pictures, whose weights sum up to {rounded}",
        weights.len()
    );
    let is_one = |value: f64| (value - 1.0).abs() <= TOLERANCE;
    if is_one(sum) && is_one(returned) {
        steps.found(step, line, told);
    } else if is_one(sum * returned) {
        let told = told + ", and are divided at the end";
        steps.fault(step, Mark::OtherArguments, line, told, &SUM_THEN_DIVIDE);
    } else {
        steps.mistake(step, Mark::OtherArguments, line, "weights_wrong", told);
    }
}

fn before(frame: &Frame, line: u64, wanted: impl Fn(&StepKind) -> bool) -> Option<&Step> {
    let mut steps = frame.steps.iter();
    steps.find(|step| step.line < line && wanted(&step.what))
}

/// Of the color buffer that is added to, with the line that made it.
fn format(pass: &Pass, state: &State) -> Option<(u64, String)> {
    let attachment = pass.framebuffer.as_ref()?.drawn_to().next()?;
    match &attachment.value {
        Attachment::Texture { id, .. } => {
            let image = state.textures.get(id)?.image.as_ref()?;
            Some((image.line, image.value.2.clone()))
        }
        Attachment::Renderbuffer(id) => {
            let format = state.renderbuffers.get(id)?;
            Some((format.line, format.value.clone()))
        }
    }
}

fn holds_8_bits(format: &str) -> bool {
    let formats = [
        "GL_RGB",
        "GL_RGBA",
        "GL_RGB8",
        "GL_RGBA8",
        "GL_RGB8_SNORM",
        "GL_RGBA8_SNORM",
    ];
    formats.contains(&format)
}
