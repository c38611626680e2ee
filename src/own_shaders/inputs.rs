//! The inputs of the vertex shader: a mesh has its positions at location 0, its normals at 1, its texture coordinates at 2.

use super::subject::{Part, Subject};
use super::{Finding, hint};
use crate::gl::inspect::Stage;
use crate::gl::mesh::ATTRIBUTES;
use crate::glsl::{Declared, Storage};

pub fn check(subject: &Subject, findings: &mut Vec<Finding>) {
    for part in subject.of_stage(Stage::Vertex) {
        let Some(path) = part.path else {
            continue;
        };
        let labs = labs_inputs(subject);
        for input in part.scan.of(&[Storage::In, Storage::Attribute]) {
            if let Some(wrong) = wrong(subject, &labs, input) {
                findings.push(Finding::wrong((path, Some(input.line)), wrong));
            }
        }
        let has_position = subject.linked().is_ok_and(|linked| {
            let mut inputs = linked.inputs.iter();
            inputs.any(|input| input.location == Some(0))
        });
        let is_told = findings
            .iter()
            .any(|finding| finding.path == path && finding.is_wrong());
        // What is drawn without a mesh needs none.
        let labs_position = subject
            .labs
            .inputs
            .iter()
            .find(|input| input.location == Some(0));
        if labs_position.is_some() && !has_position && !is_told {
            let text = format!(
                "reads no position, expected {} to be declared and used",
                labs_own_words(subject, &labs, 0)
            );
            findings.push(Finding::wrong((path, None), text));
        }
    }
}

/// A name of an input, and the location that is fed under it.
type Known<'t> = (&'t str, u32);

/// What every mesh feeds by its names, and what the lab's own vertex shader has at its locations.
fn labs_inputs<'t>(subject: &Subject<'t>) -> Vec<Known<'t>> {
    let mut known: Vec<Known> = ATTRIBUTES.to_vec();
    let own = subject.labs_parts.iter();
    for input in own.flat_map(|part| part.scan.of(&[Storage::In])) {
        if let Some(location) = input.location {
            known.push((input.name, location));
        }
    }
    known
}

fn wrong(subject: &Subject, labs: &[Known], input: &Declared) -> Option<String> {
    let Declared {
        kind,
        name,
        location,
        ..
    } = *input;
    let lab = subject.handout.name;
    let by_name = labs.iter().find(|(known, _)| *known == name);
    let fed = match (location, by_name) {
        (Some(at), Some((_, known))) if at != *known => {
            let there = labs_own_words(subject, labs, at);
            return Some(format!(
                "{name} is at location {at}, where {lab} has {there}, expected layout(location = {known}) in {kind} {name}"
            ));
        }
        (Some(at), _) => at,
        // The linker gives a name of which nobody said its place to whatever is free.
        (None, Some((_, known))) if !ATTRIBUTES.iter().any(|(bound, _)| *bound == name) => {
            return is_active(subject, name).then(|| {
                format!(
                    "{name} has no location, expected layout(location = {known}) in {kind} {name}"
                )
            });
        }
        (None, Some((_, known))) => *known,
        (None, None) => {
            let names: Vec<_> = labs.iter().map(|(name, _)| *name).collect();
            let hint = hint(name, &names, |names| {
                format!(": expected one of {}", names.join(", "))
            });
            return is_active(subject, name)
                .then(|| format!("in {kind} {name}: {lab} feeds no input of that name{hint}"));
        }
    };
    if !labs.iter().any(|(_, known)| *known == fed) {
        return Some(format!(
            "in {kind} {name} is at location {fed}, which {lab} does not feed, expected 0 (position), 1 (normal) or 2 \
             (texture_coord)"
        ));
    }
    // A missing w becomes 1; what is left out of a position or a normal is lost.
    let wanted: &[&str] = match fed {
        0 | 1 => &["vec3", "vec4"],
        2 => &["vec2", "vec3", "vec4"],
        _ => &["float", "vec2", "vec3", "vec4"],
    };
    (!wanted.contains(&kind)).then(|| {
        format!(
            "in {kind} {name}, expected {}: {lab} feeds floats",
            wanted.join(" or ")
        )
    })
}

/// An input that nothing reads does no harm.
fn is_active(subject: &Subject, name: &str) -> bool {
    subject
        .linked()
        .is_ok_and(|linked| linked.inputs.iter().any(|input| input.name == name))
}

/// As the lab's own vertex shader declares what is at this location.
fn labs_own_words(subject: &Subject, labs: &[Known], at: u32) -> String {
    let at_location = |input: &&Declared| {
        let mut known = labs.iter();
        known.any(|(name, location)| *name == input.name && *location == at)
    };
    let own = subject
        .labs_parts
        .iter()
        .filter(|part: &&Part| part.stage == Stage::Vertex);
    let found = own
        .flat_map(|part| part.scan.of(&[Storage::In]))
        .find(at_location);
    match (found, labs.iter().find(|(_, location)| *location == at)) {
        (Some(input), _) => match input.location {
            Some(at) => format!("layout(location = {at}) in {} {}", input.kind, input.name),
            None => format!("in {} {}", input.kind, input.name),
        },
        (None, Some((name, _))) => format!("the {name}"),
        (None, None) => "nothing".to_owned(),
    }
}
