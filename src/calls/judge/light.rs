//! The light's camera, and the way from a point to its texel.

use super::faults::OTHER_LIGHT;
use super::{Map, Second};
use crate::calls::frame::Draw;
use crate::calls::handouts::Handout;
use crate::calls::matrices::{self, Relation, Relations};
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
    let found = matrices::relations(&first, &second.draws);
    if let Some(whole) = first.first().and_then(|draw| matrices::projection(draw)) {
        let line = whole.line;
        let light = found.of_light().unwrap_or(whole.value);
        if let Some(times) = matrices::depth_range(light).filter(|times| *times > FARTHEST) {
            let told = format!("the far plane is {times:.0} times as far as the near one");
            steps.mistake(step, Mark::Unclear, line, "near_too_small", told);
        }
        if let Some(degrees) = matrices::degrees_for_radians(light) {
            let told = format!("the field of view is that of {degrees} radians");
            steps.mistake(step, Mark::Unclear, line, "degrees_for_radians", told);
        }
    }
    if !second.draws.is_empty() {
        relation(steps, handout, map, second, &found);
    }
}

fn relation(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, found: &Relations) {
    let step = (handout.matrix, "B · projection · view · model of the light");
    let has_halves = second.draws.iter().find_map(|draw| {
        let source = draw.program.as_ref()?.source.as_ref()?;
        Some(source.has_halves)
    });
    let other = Mark::OtherArguments;
    match &found.found {
        Some((relation, matrix)) => {
            let (line, name) = (matrix.line, called(&matrix.name));
            match relation {
                Relation::WithBias => {
                    steps.found(step, line, format!("{name} is B times the first pass's"))
                }
                Relation::Plain
                    if has_halves == Some(false)
                        || has_halves.is_none() && handout.bias_in_program =>
                {
                    let told = format!("{name} is the first pass's, without B");
                    steps.mistake(step, Mark::Missing, line, "bias_matrix_missing", told);
                }
                Relation::Plain => {
                    steps.found(
                        step,
                        line,
                        format!("{name} is the first pass's, and B is the shader's"),
                    );
                }
                Relation::Twice => {
                    let told = format!("{name} is B·B times the first pass's");
                    steps.mistake(step, other, line, "bias_matrix_twice", told);
                }
                Relation::Swapped => {
                    let told = format!("{name} is H(1/2)·T(1/2) times the first pass's");
                    steps.mistake(step, other, line, "bias_matrix_swapped", told);
                }
                Relation::Transposed => {
                    let told = format!("{name} is right when it is transposed");
                    steps.mistake(step, other, line, "row_major", told);
                }
            }
        }
        None if found.differs.is_some() => {}
        None => {
            let told = "no product of the second pass's matrices is the first pass's: the shader \
                        makes it, or no call that is seen, or it is another light's";
            steps.fault(step, Mark::Unclear, 0, told, &OTHER_LIGHT);
        }
    }
    let step = (handout.first_pass, "the same model matrix in both passes");
    if let Some((first, second)) = found.differs {
        let told = format!(
            "line {first} draws the mesh into the map with another matrix than line {second} into the picture"
        );
        steps.mistake(step, other, second, "model_matrix_differs", told);
    } else if found.found.is_some() {
        steps.found(step, map.pass.first, "it is");
    }
}

fn called(name: &str) -> &str {
    if name.is_empty() { "the matrix" } else { name }
}

/// A matrix of the first pass that is none, with its line and its name.
fn not_a_number<'a>(first: &[&'a Draw]) -> Option<(u64, &'a str)> {
    first.iter().find_map(|draw| {
        let uniform = draw.matrices.iter().find(|matrix| matrix.value.is_nan());
        if let Some(matrix) = uniform {
            return Some((matrix.line, called(&matrix.name)));
        }
        let fixed = [&draw.fixed.modelview, &draw.fixed.projection];
        let of_fixed = fixed.into_iter().find(|set| set.value.is_nan());
        let of_fixed = of_fixed.filter(|_| draw.program.is_none());
        of_fixed.map(|set| (set.line, "the light's view"))
    })
}
