//! Projected shadows: the handout of eecs487.
//!
//! A shadow is drawn by a matrix that takes everything onto a plane: it has no inverse, and by that it is found.

use glam::{DMat4, DVec4};

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
            steps.found(step, first.draw.line, format!("{} draw calls", shadows.len()));
            shadow_matrix(steps, &shadows);
            offset(steps, &shadows);
            color(steps, &shadows);
            clipped(steps, &draws, &shadows, frame);
        }
        (None, Some(last)) if last.program.is_some() => steps.other(step, Mark::Unclear, 0,
            "no matrix of the frame does: the shader may, or the shadows are switched off", "", ""),
        (None, last) => steps.other(step, Mark::Missing, last.map_or(0, |draw| draw.line),
            "no matrix of the frame does", "there is no shadow",
            "multiply the modelview matrix by (plane·light)·I − light⊗plane before the occluders are drawn"),
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
    uniform.or_else(|| made(draw.fixed.3, draw.fixed.0, false).filter(|_| is_fixed))
}

fn shadow_matrix(steps: &mut Steps, shadows: &[Shadow]) {
    let step = (HARD, "multShadowMat: the shadow matrix");
    // The trace is three times plane·light, which is positive in the room.
    let turned = shadows
        .iter()
        .find(|shadow| shadow.is_alone && trace(shadow.matrix) < 0.0);
    if let Some(shadow) = turned {
        return steps.mistake(
            step,
            Mark::OtherArguments,
            shadow.line,
            "plane_sign",
            "the light is behind the wall's plane: every shadow has a negative w",
        );
    }
    if is_transposed(shadows) {
        return steps.mistake(step, Mark::OtherArguments, shadows[0].line, "shadow_matrix_row_major",
            "the wall's plane stands where the light should, and the light where the plane should: it is transposed");
    }
    steps.found(
        step,
        shadows[0].line,
        "it projects from the light onto the wall",
    );
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
        return steps.found(
            step,
            pipeline.line_of("GL_DEPTH_TEST"),
            "not needed: the depth test is off",
        );
    }
    let source = first
        .program
        .as_ref()
        .map(|program| program.source.as_ref());
    match source {
        Some(Some(source)) if source.writes_depth => steps.found(
            step,
            first.used,
            "not needed: the shader writes its own depth",
        ),
        Some(None) => steps.other(
            step,
            Mark::Unclear,
            first.line,
            "there is none; right, where the shader writes the wall's depth",
            "",
            "",
        ),
        _ => steps.mistake(
            step,
            Mark::Missing,
            first.line,
            "no_polygon_offset",
            "it is off when the shadows are drawn",
        ),
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
        let starts = program
            .declared(&name.value)
            .is_some_and(|uniform| uniform.has_value);
        if !name.value.to_lowercase().contains("color") || starts {
            continue;
        }
        match program.values.get(location) {
            Some(set) => steps.found(step, set.line, name.value.clone()),
            None => steps.mistake(
                step,
                Mark::Missing,
                name.line,
                "shadow_color_never_set",
                format!(
                    "{} is never set before line {} draws with it",
                    name.value, first.line
                ),
            ),
        }
    }
}

/// The three steps that fill the stencil buffer, and the test behind them.
fn clipped(steps: &mut Steps, draws: &[&Draw], shadows: &[Shadow], frame: &Frame) {
    let step = (CLIPPED, "shadows drawn where the stencil is 1 alone");
    let beyond = "shadows go on past the edges of the wall";
    let first = shadows[0].draw;
    if !first.pipeline.is_on("GL_STENCIL_TEST") {
        return steps.other(
            step,
            Mark::Unclear,
            0,
            "the stencil test is off in this frame",
            beyond,
            "the key c of the handout's program switches it on",
        );
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
        steps.other(
            step,
            Mark::OtherArguments,
            line,
            told,
            beyond,
            "glStencilFunc(GL_EQUAL, 1, …) behind the wall",
        );
    }

    let step = (CLIPPED, "the stencil is set to 1 while the wall is drawn");
    let wall = draws.iter().find(|draw| {
        let always = draw.pipeline.stencil.value == ("GL_ALWAYS".to_owned(), *reference);
        draw.line < first.line && draw.pipeline.is_on("GL_STENCIL_TEST") && always
    });
    let lost = "the stencil is 1 nowhere, and so there are no shadows";
    match wall {
        Some(wall) if wall.pipeline.stencil_pass.value == "GL_REPLACE" => {
            steps.found(
                step,
                wall.pipeline.stencil_pass.line,
                "glStencilFunc(GL_ALWAYS, …) and glStencilOp(…, GL_REPLACE)",
            );
        }
        Some(wall) => steps.other(
            step,
            Mark::OtherArguments,
            wall.pipeline.stencil_pass.line,
            format!(
                "where the tests pass, glStencilOp says {}",
                wall.pipeline.stencil_pass.value
            ),
            lost,
            "glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)",
        ),
        None => steps.other(
            step,
            Mark::Missing,
            first.line,
            format!(
                "nothing is drawn with glStencilFunc(GL_ALWAYS, {reference}, …) before the shadows"
            ),
            lost,
            "glStencilFunc(GL_ALWAYS, 1, …) before the wall is drawn",
        ),
    }

    let step = (CLIPPED, "the stencil buffer is cleared in each frame");
    let clear = frame.steps.iter().find(|step| {
        matches!(step.what, StepKind::Clear { stencil: true, .. }) && step.line < first.line
    });
    match clear {
        Some(clear) => steps.found(step, clear.line, "it is"),
        None => steps.other(
            step,
            Mark::Missing,
            0,
            "GL_STENCIL_BUFFER_BIT is in no glClear before them",
            "of a wall that is hidden or moves the shadows stay",
            "glClear(… | GL_STENCIL_BUFFER_BIT)",
        ),
    }
}
