//! What the vertex shader hands on, and what the fragment shader makes of it.

use super::needed::needed;
use super::subject::{Part, Subject};
use super::{Finding, hint};
use crate::gl::inspect::{Interface, Stage};
use crate::glsl::{Declared, Storage};

/// `linked` is None where the driver does not link the stages.
pub fn check(subject: &Subject, linked: Option<&Interface>, findings: &mut Vec<Finding>) {
    let written = declared(subject, Stage::Vertex, &[Storage::Out, Storage::Varying]);
    let read = declared(subject, Stage::Fragment, &[Storage::In, Storage::Varying]);
    for (part, input) in &read {
        let source = written.iter().find(|(_, output)| output.name == input.name);
        let Some((source, output)) = source else {
            not_written(part, input, &written, &read, subject, findings);
            continue;
        };
        if output.kind != input.kind {
            different_types(part, input, source, output, findings);
        }
        if part.scan.mentions(input) && !source.scan.mentions(output) {
            let text = format!("{} is read by {}, and never written", input.name, part.name);
            if let Some(path) = source.path {
                findings.push(Finding::wrong((path, Some(output.line)), text));
            }
        }
    }
    unread_coordinates(subject, linked, &written, &read, findings);
    no_color(subject, findings);
}

type Found<'s, 't> = (&'s Part<'t>, &'s Declared<'t>);

fn declared<'s, 't>(
    subject: &'s Subject<'t>,
    stage: Stage,
    storages: &'static [Storage],
) -> Vec<Found<'s, 't>> {
    let parts = subject.of_stage(stage);
    let found = parts.flat_map(|part| part.scan.of(storages).map(move |declared| (part, declared)));
    found.collect()
}

/// The fragment shader reads what the vertex shader does not hand on.
fn not_written(
    part: &Part,
    input: &Declared,
    written: &[Found],
    read: &[Found],
    subject: &Subject,
    findings: &mut Vec<Finding>,
) {
    if !part.scan.mentions(input) {
        return;
    }
    let is_read = |name: &str| read.iter().any(|(_, input)| input.name == name);
    let free: Vec<_> = written
        .iter()
        .map(|(_, output)| output.name)
        .filter(|name| !is_read(name))
        .collect();
    let hint = hint(input.name, &free, |free| match free {
        [] => String::new(),
        names => format!(", expected one of {}", names.join(", ")),
    });
    let (
        Declared {
            kind, name, line, ..
        },
        vertex,
    ) = (input, vertex_shader(subject));
    findings.push(match part.path {
        Some(path) => {
            let text = format!("in {kind} {name}: {vertex} has no out of that name{hint}");
            Finding::wrong((path, Some(*line)), text)
        }
        // The lab's own fragment shader reads it.
        None => {
            let text = format!("no out {kind} {name}, which {} reads", part.name);
            let near = crate::error::did_you_mean(name, free.iter().copied());
            Finding::wrong(subject.place_of(Storage::Out, ""), text + &near)
        }
    });
}

fn vertex_shader(subject: &Subject) -> String {
    let mut vertex = subject.of_stage(Stage::Vertex);
    match vertex.next() {
        Some(Part {
            name, path: None, ..
        }) => format!("{}'s own {name}", subject.handout.name),
        Some(Part { name, .. }) => (*name).to_owned(),
        None => "the vertex shader".to_owned(),
    }
}

fn different_types(
    part: &Part,
    input: &Declared,
    source: &Part,
    output: &Declared,
    findings: &mut Vec<Finding>,
) {
    let place = match (part.path, source.path) {
        (Some(path), _) => (path, Some(input.line)),
        (None, Some(path)) => (path, Some(output.line)),
        (None, None) => return,
    };
    let text = format!(
        "{} is {} in {} and {} in {}, expected the same type",
        input.name, input.kind, part.name, output.kind, source.name
    );
    findings.push(Finding::wrong(place, text));
}

/// The place on the map is handed on, and nothing is made of it.
fn unread_coordinates(
    subject: &Subject,
    linked: Option<&Interface>,
    written: &[Found],
    read: &[Found],
    findings: &mut Vec<Finding>,
) {
    let needed = needed(subject.handout.name);
    // Who finds the way to the map otherwise needs none of it.
    let looks_up = linked.is_some_and(|linked| {
        let mut maps = needed.maps.iter();
        maps.any(|map| linked.uniform(map).is_some())
    });
    for name in needed.coordinates {
        let Some((source, output)) = written.iter().find(|(_, output)| output.name == *name) else {
            continue;
        };
        let input = read.iter().find(|(_, input)| input.name == *name);
        let is_read = input.is_some_and(|(part, input)| part.scan.mentions(input));
        if is_read || !has_color(subject) {
            continue;
        }
        let place = match (input, source.path) {
            (
                Some((
                    Part {
                        path: Some(path), ..
                    },
                    input,
                )),
                _,
            ) => (*path, Some(input.line)),
            (_, Some(path)) => (path, Some(output.line)),
            _ => subject.place_of(Storage::In, name),
        };
        let text = format!("{name} is handed to the fragment shader, which does not read it");
        findings.push(match looks_up {
            true => Finding::note(place, text),
            false => Finding::wrong(place, text + ", expected the shadow test to use it"),
        });
    }
}

/// Whether the lab's own program makes a color of anything: the first passes do not.
fn has_color(subject: &Subject) -> bool {
    let fragment = subject
        .labs_parts
        .iter()
        .filter(|part| part.stage == Stage::Fragment);
    let mut outputs = fragment.flat_map(|part| part.scan.of(&[Storage::Out]));
    outputs.any(|output| output.kind == "vec4")
}

fn no_color(subject: &Subject, findings: &mut Vec<Finding>) {
    let mut fragment = subject.of_stage(Stage::Fragment);
    let writes = fragment.any(|part| {
        let outputs = part.scan.of(&[Storage::Out]);
        let outputs = outputs.filter(|output| part.scan.mentions(output)).count();
        let built_in = ["gl_FragColor", "gl_FragData"];
        outputs > 0
            || built_in
                .iter()
                .any(|word| part.scan.line_of(word).is_some())
    });
    if has_color(subject) && !writes {
        let text = "writes no color, expected an out vec4 that main assigns to";
        if let Some(path) = subject.of_stage(Stage::Fragment).find_map(|part| part.path) {
            findings.push(Finding::wrong((path, None), text));
        }
    }
}
