//! The light's camera, and the way from a point to its texel.

use super::{Map, Second};
use crate::calls::frame::Draw;
use crate::calls::handouts::Handout;
use crate::calls::matrices::{self, Relation};
use crate::calls::report::{Mark, Steps};

/// A far plane so many times as far as the near one spends all but 0.1 % of the depths on the near tenth of a percent.
const FARTHEST: f64 = 1000.0;

pub fn judge(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second) {
    let first: Vec<&Draw> = map.pass.draws.iter().collect();
    let step = (handout.first_pass, "the light's matrices");
    if let Some((line, name)) = not_a_number(&first) {
        steps.mistake(
            step,
            Mark::Wrong,
            line,
            "light_along_up",
            format!("{name} holds NaN"),
        );
        return;
    }
    if let Some(projection) = first.first().and_then(|draw| matrices::projection(draw)) {
        let line = first[0]
            .matrices
            .first()
            .map_or(first[0].fixed.3, |matrix| matrix.line);
        if let Some(times) = matrices::depth_range(projection).filter(|times| *times > FARTHEST) {
            steps.mistake(
                step,
                Mark::Unclear,
                line,
                "near_too_small",
                format!("the far plane is {times:.0} times as far as the near one"),
            );
        }
        if let Some(degrees) = matrices::degrees_for_radians(projection) {
            steps.mistake(
                step,
                Mark::Unclear,
                line,
                "degrees_for_radians",
                format!("the field of view is that of {degrees} radians"),
            );
        }
    }
    relation(steps, handout, map, second, &first);
}

fn relation(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, first: &[&Draw]) {
    let step = (handout.matrix, "B · projection · view · model of the light");
    if second.draws.is_empty() {
        return;
    }
    let found = matrices::relations(first, &second.draws);
    let has_half = second.draws.iter().find_map(|draw| {
        let source = draw.program.as_ref()?.source.as_ref()?;
        Some(source.has_half)
    });
    match &found.found {
        Some((Relation::WithBias, line, name)) => steps.found(step, *line, format!("{} is B times the first pass's", called(name))),
        Some((Relation::Plain, line, name)) => match has_half {
            Some(false) => missing(steps, step, *line, name),
            None if handout.bias_in_program => missing(steps, step, *line, name),
            _ => steps.found(step, *line, format!("{} is the first pass's, and B is the shader's", called(name))),
        },
        Some((Relation::Twice, line, name)) => steps.mistake(step, Mark::OtherArguments, *line, "bias_matrix_twice",
            format!("{} is B·B times the first pass's", called(name))),
        Some((Relation::Swapped, line, name)) => steps.mistake(step, Mark::OtherArguments, *line, "bias_matrix_swapped",
            format!("{} is H(1/2)·T(1/2) times the first pass's", called(name))),
        Some((Relation::Transposed, line, name)) => steps.mistake(step, Mark::OtherArguments, *line, "row_major",
            format!("{} is right when it is transposed", called(name))),
        None if found.differs.is_some() => {}
        None => steps.other(step, Mark::Unclear, 0,
            "no product of the second pass's matrices is the first pass's: they are set by no call that is seen, made in the shader, or of another light",
            "where they are of another light, shadows are out of place", ""),
    }
    let step = (handout.first_pass, "the same model matrix in both passes");
    if let Some((first, second)) = found.differs {
        steps.mistake(step, Mark::OtherArguments, second, "model_matrix_differs",
            format!("line {first} draws the mesh into the map with another matrix than line {second} into the picture"));
    } else if found.found.is_some() {
        steps.found(step, map.pass.first, "it is");
    }
}

fn missing(steps: &mut Steps, step: (&'static str, &'static str), line: u64, name: &str) {
    steps.mistake(
        step,
        Mark::Missing,
        line,
        "bias_matrix_missing",
        format!("{} is the first pass's, without B", called(name)),
    );
}

fn called(name: &str) -> &str {
    if name.is_empty() { "the matrix" } else { name }
}

/// A matrix of the first pass that is none, with its line and its name.
fn not_a_number<'a>(first: &[&'a Draw]) -> Option<(u64, &'a str)> {
    first.iter().find_map(|draw| {
        let uniform = draw.matrices.iter().find(|matrix| matrix.value.is_nan());
        let fixed = draw.fixed.0.is_nan() || draw.fixed.1.is_nan();
        match uniform {
            Some(matrix) => Some((matrix.line, called(&matrix.name))),
            None if draw.program.is_none() && fixed => Some((draw.fixed.3, "the light's view")),
            None => None,
        }
    })
}
