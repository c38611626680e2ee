//! Projected shadows: the handout of eecs487.
//!
//! A shadow is drawn by a matrix that takes everything onto a plane: it has no inverse, and by that it is found.

use glam::{DMat4, DVec4};

use super::faults::{
    CLIPPING_OFF, NO_PROJECTION, NOT_CLIPPED, NOT_TOLD, STENCIL_NOT_CLEARED, STENCIL_NOT_FILLED,
};
use super::soft;
use super::uniforms;
use crate::calls::frame::{Draw, Frame, StepKind};
use crate::calls::handouts::{CLIPPED, HARD};
use crate::calls::matrices::{is_along, light_and_plane};
use crate::calls::report::{Mark, Steps};
use crate::calls::state::State;

/// A mesh that is drawn as a shadow.
struct Shadow<'a> {
    draw: &'a Draw,
    line: u64,
    /// The whole way, or the shadow matrix alone where it is known.
    matrix: DMat4,
    is_alone: bool,
    /// What the matrix takes to nothing, and what all projected points lie on.
    light: DVec4,
    plane: DVec4,
}

/// A light that is jittered moves by less than this, and two walls of a room differ by more.
const SAME_LIGHT: f64 = 0.9;

pub fn judge(steps: &mut Steps, frame: &Frame, state: &State) {
    let draws: Vec<&Draw> = frame.passes.iter().flat_map(|pass| &pass.draws).collect();
    let shadows: Vec<Shadow> = draws.iter().filter_map(|draw| shadow(draw)).collect();
    let step = (
        HARD,
        "shadows drawn by a matrix that projects onto the wall",
    );
    match (shadows.first(), draws.last()) {
        (Some(first), _) => {
            steps.found(
                step,
                first.draw.line,
                format!("{} draw calls", shadows.len()),
            );
            shadow_matrix(steps, &shadows);
            offset(steps, &shadows);
            color(steps, &shadows);
            clipped(steps, &draws, &shadows, frame);
        }
        (None, Some(last)) if last.program.is_some() => {
            let told = "no matrix of the frame does: the shader may, or the shadows are off";
            steps.fault(step, Mark::Unclear, 0, told, &NOT_TOLD);
        }
        (None, last) => {
            let line = last.map_or(0, |draw| draw.line);
            steps.fault(
                step,
                Mark::Missing,
                line,
                "no matrix of the frame does",
                &NO_PROJECTION,
            );
        }
    }
    soft::judge(steps, frame, state);
    uniforms::slips(steps, HARD, state);
}

fn shadow(draw: &Draw) -> Option<Shadow<'_>> {
    let made = |line, matrix, is_alone| {
        light_and_plane(matrix).map(|[light, plane]| Shadow {
            draw,
            line,
            matrix,
            is_alone,
            light,
            plane,
        })
    };
    if let Some((line, matrix)) = draw.projector {
        return made(line, matrix, true);
    }
    let uniform = draw
        .matrices
        .iter()
        .find_map(|matrix| made(matrix.line, matrix.value, false));
    let is_fixed = draw.matrices.is_empty();
    uniform.or_else(|| {
        made(draw.fixed.modelview.line, draw.fixed.modelview.value, false).filter(|_| is_fixed)
    })
}

fn shadow_matrix(steps: &mut Steps, shadows: &[Shadow]) {
    let step = (HARD, "multShadowMat: the shadow matrix");
    // The trace is three times plane·light, which is positive in the room.
    let turned = shadows
        .iter()
        .find(|shadow| shadow.is_alone && trace(shadow.matrix) < 0.0);
    if let Some(shadow) = turned {
        let told = "the light is behind the wall's plane: every shadow has a negative w";
        return steps.mistake(step, Mark::OtherArguments, shadow.line, "plane_sign", told);
    }
    let line = shadows[0].line;
    if is_transposed(shadows) {
        let told = "it is transposed: light and plane stand in each other's place";
        return steps.mistake(
            step,
            Mark::OtherArguments,
            line,
            "shadow_matrix_row_major",
            told,
        );
    }
    steps.found(step, line, "it projects from the light onto the wall");
}

fn trace(m: DMat4) -> f64 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z + m.w_axis.w
}

/// One mesh has one light and as many planes as there are walls; with the matrix transposed it has one plane and as many
/// lights.
fn is_transposed(shadows: &[Shadow]) -> bool {
    let (mut right, mut wrong) = (false, false);
    for (place, a) in shadows.iter().enumerate() {
        for b in shadows[place + 1..]
            .iter()
            .filter(|b| b.draw.mesh == a.draw.mesh)
        {
            let [lights, planes] = [(a.light, b.light), (a.plane, b.plane)];
            let other = |(a, b): (DVec4, DVec4)| a.dot(b).abs() < SAME_LIGHT;
            right |= is_along(lights.0, lights.1) && other(planes);
            wrong |= is_along(planes.0, planes.1) && other(lights);
        }
    }
    wrong && !right
}

/// Wall and shadow lie in one plane.
fn offset(steps: &mut Steps, shadows: &[Shadow]) {
    let step = (HARD, "glPolygonOffset for the shadows");
    let first = shadows[0].draw;
    let pipeline = &first.pipeline;
    let [factor, units] = pipeline.polygon_offset.value;
    let line = pipeline.polygon_offset.line;
    if pipeline.is_on("GL_POLYGON_OFFSET_FILL") && (factor != 0.0 || units != 0.0) {
        if factor > 0.0 || units > 0.0 {
            let told = format!("({factor}, {units}) moves the shadows behind the wall");
            return steps.mistake(step, Mark::OtherArguments, line, "no_polygon_offset", told);
        }
        return steps.found(step, line, format!("({factor}, {units})"));
    }
    if !pipeline.is_on("GL_DEPTH_TEST") {
        let line = pipeline.line_of("GL_DEPTH_TEST");
        return steps.found(step, line, "not needed: the depth test is off");
    }
    let source = first
        .program
        .as_ref()
        .map(|program| program.source.as_ref());
    match source {
        Some(Some(source)) if source.writes_depth => {
            steps.found(
                step,
                first.used,
                "not needed: the shader writes its own depth",
            );
        }
        Some(None) => {
            let told = "there is none; right, where the shader writes the wall's depth";
            steps.fault(step, Mark::Unclear, first.line, told, &NOT_TOLD);
        }
        _ => {
            let told = "it is off when the shadows are drawn";
            steps.mistake(step, Mark::Missing, first.line, "no_polygon_offset", told);
        }
    }
}

/// A color that somebody asked for and nobody set is black.
fn color(steps: &mut Steps, shadows: &[Shadow]) {
    let first = shadows[0].draw;
    let Some(program) = &first.program else {
        return;
    };
    let step = (HARD, "the shadow's color is set");
    for (location, name) in &program.names {
        let declared = program.declared(&name.value);
        let starts = declared.is_some_and(|uniform| uniform.has_value);
        if !name.value.to_lowercase().contains("color") || starts {
            continue;
        }
        match program.values.get(location) {
            Some(set) => steps.found(step, set.line, name.value.clone()),
            None => {
                let drawn = first.line;
                let told = format!(
                    "{} is never set before line {drawn} draws with it",
                    name.value
                );
                steps.mistake(
                    step,
                    Mark::Missing,
                    name.line,
                    "shadow_color_never_set",
                    told,
                );
            }
        }
    }
}

/// The three steps that fill the stencil buffer, and the test behind them.
fn clipped(steps: &mut Steps, draws: &[&Draw], shadows: &[Shadow], frame: &Frame) {
    let step = (CLIPPED, "shadows drawn where the stencil is 1 alone");
    let first = shadows[0].draw;
    if !first.pipeline.is_on("GL_STENCIL_TEST") {
        let told = "the stencil test is off in this frame";
        return steps.fault(step, Mark::Unclear, 0, told, &CLIPPING_OFF);
    }
    let (function, reference) = &first.pipeline.stencil.value;
    let line = first.pipeline.stencil.line;
    if function == "GL_EQUAL" && *reference != 0 {
        steps.found(
            step,
            line,
            format!("glStencilFunc(GL_EQUAL, {reference}, …)"),
        );
    } else {
        let told = format!("it is glStencilFunc({function}, {reference}, …) when they are drawn");
        steps.fault(step, Mark::OtherArguments, line, told, &NOT_CLIPPED);
    }

    let step = (CLIPPED, "the stencil is set to 1 while the wall is drawn");
    let always = ("GL_ALWAYS".to_owned(), *reference);
    let wall = draws.iter().find(|draw| {
        let is_before = draw.line < first.line && draw.pipeline.is_on("GL_STENCIL_TEST");
        is_before && draw.pipeline.stencil.value == always
    });
    match wall.map(|wall| &wall.pipeline.stencil_pass) {
        Some(pass) if pass.value == "GL_REPLACE" => {
            let told = "glStencilFunc(GL_ALWAYS, …) and glStencilOp(…, GL_REPLACE)";
            steps.found(step, pass.line, told);
        }
        Some(pass) => {
            let told = format!("where the tests pass, glStencilOp says {}", pass.value);
            steps.fault(
                step,
                Mark::OtherArguments,
                pass.line,
                told,
                &STENCIL_NOT_FILLED,
            );
        }
        None => {
            let told = "nothing is drawn with glStencilFunc(GL_ALWAYS, …) before the shadows";
            steps.fault(step, Mark::Missing, first.line, told, &STENCIL_NOT_FILLED);
        }
    }

    let step = (CLIPPED, "the stencil buffer is cleared in each frame");
    let clear = frame.steps.iter().find(|step| {
        step.line < first.line && matches!(step.what, StepKind::Clear { stencil: true, .. })
    });
    match clear {
        Some(clear) => steps.found(step, clear.line, "it is"),
        None => {
            let told = "GL_STENCIL_BUFFER_BIT is in no glClear before them";
            steps.fault(step, Mark::Missing, 0, told, &STENCIL_NOT_CLEARED);
        }
    }
}
