//! Soft shadows: pictures with the light at different places, averaged in an accumulation buffer of either kind.

use crate::calls::frame::{Draw, Frame, Pass, StepKind};
use crate::calls::handouts::{FBO, SOFT};
use crate::calls::objects::{Attachment, Id};
use crate::calls::report::{Asked, Mark, Steps};
use crate::calls::state::State;

/// Of a sum of weights that students write as 0.33 or as 1/3.
const TOLERANCE: f64 = 0.011;

pub fn judge(steps: &mut Steps, frame: &Frame, state: &State) {
    let old: Vec<(u64, &str, f64)> = frame
        .steps
        .iter()
        .filter_map(|step| match &step.what {
            StepKind::Accumulate { operation, value } => {
                Some((step.line, operation.as_str(), *value))
            }
            _ => None,
        })
        .collect();
    let blended = |draw: &&Draw| {
        draw.pipeline.is_on("GL_BLEND") && draw.pipeline.blend.value[0] == "GL_CONSTANT_ALPHA"
    };
    let mut sums: Vec<(&Pass, &Draw)> = Vec::new();
    for pass in &frame.passes {
        sums.extend(pass.draws.iter().filter(blended).map(|draw| (pass, draw)));
    }
    if !old.is_empty() {
        accumulation_buffer(steps, &old, frame);
    } else if let Some((pass, _)) = sums.first() {
        framebuffer_object(steps, &sums, pass, frame, state);
    } else {
        steps.other(
            (SOFT, "the scene is drawn several times and averaged"),
            Mark::Unclear,
            0,
            "nothing is accumulated in this frame",
            "shadows are hard",
            "the key f of the handout's program switches to soft shadows",
        );
    }
}

/// Says whether weights sum up to 1.
fn weights(steps: &mut Steps, step: Asked, line: u64, weights: &[f64], returned: f64) {
    let sum: f64 = weights.iter().sum();
    let told = format!(
        "{} pictures, whose weights sum up to {}",
        weights.len(),
        (sum * 1e4).round() / 1e4
    );
    if (sum - 1.0).abs() <= TOLERANCE && (returned - 1.0).abs() <= TOLERANCE {
        steps.found(step, line, told);
    } else if (sum * returned - 1.0).abs() <= TOLERANCE {
        steps.other(
            step,
            Mark::OtherArguments,
            line,
            told + ", and are divided at the end",
            "a buffer that holds [-1, 1] runs over: most of the picture is dark (Fig. 2(b))",
            "weight each picture by 1/numJitters as it is added",
        );
    } else {
        steps.mistake(step, Mark::OtherArguments, line, "weights_wrong", told);
    }
}

fn accumulation_buffer(steps: &mut Steps, calls: &[(u64, &str, f64)], frame: &Frame) {
    let added: Vec<_> = calls
        .iter()
        .filter(|(_, operation, _)| matches!(*operation, "GL_ACCUM" | "GL_LOAD"))
        .collect();
    let first = added.first().map_or(calls[0].0, |call| call.0);
    let step = (SOFT, "the accumulation buffer is cleared");
    let clear = frame.steps.iter().find(|step| {
        matches!(
            step.what,
            StepKind::Clear {
                accumulation: true,
                ..
            }
        ) && step.line < first
    });
    match clear {
        Some(clear) => steps.found(step, clear.line, "glClear(GL_ACCUM_BUFFER_BIT)"),
        None if added.first().is_some_and(|call| call.1 == "GL_LOAD") => {
            steps.found(step, first, "GL_LOAD replaces what it held")
        }
        None => steps.other(
            step,
            Mark::Missing,
            first,
            "nothing clears it before the first GL_ACCUM",
            GHOSTS,
            "glClear(GL_ACCUM_BUFFER_BIT) at the start of display()",
        ),
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
        None => steps.other(
            step,
            Mark::Missing,
            first,
            "there is none",
            "only the last picture is seen: hard shadows",
            "glAccum(GL_RETURN, 1)",
        ),
    }
}

const GHOSTS: &str = "the pictures of earlier frames shine through: ghosts, and ever brighter";

fn framebuffer_object(
    steps: &mut Steps,
    sums: &[(&Pass, &Draw)],
    pass: &Pass,
    frame: &Frame,
    state: &State,
) {
    let (first, last) = (sums[0].1, sums[sums.len() - 1].1);
    let target = &pass.target.value;
    let step = (
        FBO,
        "fbo_accum_init: the accumulator holds more than 8 bits",
    );
    match format(pass, state) {
        Some((line, format)) if holds_8_bits(&format) => steps.other(
            step,
            Mark::OtherArguments,
            line,
            format,
            "bands, as in Fig. 2(a)",
            "GL_RGBA32F, or GL_RGB32F where the driver has it",
        ),
        Some((line, format)) => steps.found(step, line, format),
        None => {}
    }
    let step = (FBO, "the accumulator is cleared");
    let clear = frame.steps.iter().find(|step| {
        let cleared = matches!(&step.what, StepKind::Clear { target: cleared, color: true, .. } if cleared == target);
        cleared && step.line < first.line
    });
    match clear {
        Some(clear) => steps.found(step, clear.line, "it is"),
        None => steps.other(
            step,
            Mark::Missing,
            first.line,
            format!("framebuffer {target} is not cleared before the first picture is added"),
            GHOSTS,
            "clear it before the first fbo_accum",
        ),
    }
    let values: Vec<f64> = sums
        .iter()
        .map(|(_, draw)| draw.pipeline.blend_alpha.value)
        .collect();
    let step = (
        FBO,
        "fbo_accum: blended with (GL_CONSTANT_ALPHA, GL_ONE) by 1/numJitters",
    );
    let added = first.pipeline.blend.value[1] == "GL_ONE";
    if added {
        weights(steps, step, first.pipeline.blend_alpha.line, &values, 1.0);
    } else {
        let told = format!(
            "what is there is multiplied by {}",
            first.pipeline.blend.value[1]
        );
        steps.mistake(
            step,
            Mark::OtherArguments,
            first.pipeline.blend.line,
            "weights_wrong",
            told,
        );
    }
    let step = (FBO, "fbo_accum_return: a copy to the window");
    let blit = frame.steps.iter().find(|step| {
        step.line > last.line
            && matches!(&step.what, StepKind::Blit { from, to } if is_return(from, to))
    });
    let drawn = frame
        .passes
        .iter()
        .find(|pass| pass.target.value == "0" && pass.last > last.line);
    match blit.map(|step| step.line).or(drawn.map(|pass| pass.last)) {
        Some(line) => steps.found(step, line, "it is"),
        None => steps.other(
            step,
            Mark::Missing,
            last.line,
            "framebuffer 0 gets nothing behind the last picture",
            "the window stays empty, or keeps its last picture",
            "glBlitFramebuffer to framebuffer 0, or a textured quad",
        ),
    }
}

fn is_return(from: &Id, to: &Id) -> bool {
    from != "0" && to == "0"
}

/// Of the color buffer that is added to, with the line that made it.
fn format(pass: &Pass, state: &State) -> Option<(u64, String)> {
    let attachment = pass.framebuffer.as_ref()?.drawn_to().next()?;
    match &attachment.value {
        Attachment::Texture(id) => {
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
    matches!(
        format,
        "GL_RGB" | "GL_RGBA" | "GL_RGB8" | "GL_RGBA8" | "GL_RGB8_SNORM" | "GL_RGBA8_SNORM"
    )
}
