//! Uniforms: those that the lab does not set, those of another type, samplers on one texture unit, and those that the
//! handout's shadows need and that have no effect.

use super::needed::{Needed, needed};
use super::subject::Subject;
use super::{Finding, hint};
use crate::gl::inspect::{Active, Interface, Stage};
use crate::glsl::Storage;

pub fn check(subject: &Subject, linked: &Interface, findings: &mut Vec<Finding>) {
    let (known, unknown): (Vec<_>, Vec<_>) = linked
        .uniforms
        .iter()
        .partition(|uniform| subject.set.contains(&uniform.name.as_str()));
    for uniform in &known {
        // What the lab's own shader does not use, nobody has told the type of.
        let labs = subject.labs.uniform(&uniform.name);
        let lab = subject.handout.name;
        if let Some(text) = labs.and_then(|labs| wrong_type(lab, labs.kind, uniform)) {
            let place = subject.place_of(Storage::Uniform, &uniform.name);
            findings.push(Finding::wrong(place, text));
        }
    }
    // A uniform can have a value of its own.
    let unset: Vec<_> = unknown
        .into_iter()
        .filter(|uniform| uniform.value == 0.0)
        .collect();
    for uniform in &unset {
        let place = subject.place_of(Storage::Uniform, &uniform.name);
        findings.push(Finding::wrong(place, not_set(subject, linked, uniform)));
    }
    check_needed(subject, linked, &unset, findings);
}

fn is_sampler(kind: &str) -> bool {
    kind.contains("sampler")
}

/// `sampler2DShadow` and its kin compare.
fn compares(kind: &str) -> bool {
    is_sampler(kind) && kind.ends_with("Shadow")
}

/// What is wrong with the type of a uniform that the lab sets.
fn wrong_type(lab: &str, wanted: &str, uniform: &Active) -> Option<String> {
    let Active { name, kind, .. } = uniform;
    // glUniform1i sets both.
    let both_whole = [kind, wanted]
        .iter()
        .all(|kind| ["int", "bool"].contains(kind));
    if *kind == wanted || both_whole {
        return None;
    }
    Some(match (is_sampler(kind), is_sampler(wanted)) {
        (true, true) if compares(kind) && !compares(wanted) => format!(
            "{kind} {name} compares, expected {wanted}: the texture's GL_TEXTURE_COMPARE_MODE is GL_NONE, and what a \
             comparison with it gives is undefined"
        ),
        (true, true) if compares(wanted) && !compares(kind) => format!(
            "{kind} {name} reads a depth, expected {wanted}: the texture's GL_TEXTURE_COMPARE_MODE is set, and what a \
             plain look-up gives is undefined"
        ),
        _ => format!(
            "{kind} {name}, expected {wanted}: GL refuses what {lab} sets it to, and it stays 0"
        ),
    })
}

/// What is told of a uniform that the lab does not set.
fn not_set(subject: &Subject, linked: &Interface, uniform: &Active) -> String {
    let Active { name, kind, .. } = uniform;
    let lab = subject.handout.name;
    let lacking = |wanted: &dyn Fn(&str) -> bool| -> Vec<&str> {
        let own = subject
            .labs
            .uniforms
            .iter()
            .filter(|labs| wanted(labs.kind));
        let own = own.filter(|labs| linked.uniform(&labs.name).is_none());
        own.map(|labs| labs.name.as_str()).collect()
    };
    let of_its_type = lacking(&|labs| labs == *kind);
    let all = lacking(&|_| true);
    // One of another type is a mistake of its own.
    let near = crate::error::did_you_mean(name, of_its_type.iter().copied());
    let hint = match near.is_empty() {
        false => near,
        true => hint(name, &all, |_| match of_its_type.as_slice() {
            [] => ", expected a value in the shader, or a const".to_owned(),
            names => format!(", expected its {kind} {}", names.join(" or ")),
        }),
    };
    if !is_sampler(kind) {
        return format!(
            "uniform {kind} {name}: {lab} sets none of that name, and it stays 0{hint}"
        );
    }
    let on_unit_0 = |other: &&Active| {
        let labs = subject.labs.uniform(&other.name);
        is_sampler(other.kind) && other.name != *name && labs.is_none_or(|labs| labs.value == 0.0)
    };
    let others: Vec<_> = linked.uniforms.iter().filter(on_unit_0).collect();
    let beside = match others.as_slice() {
        [] => String::new(),
        [other, ..] if other.kind == *kind => format!(", together with {}", other.name),
        [other, ..] => format!(
            ", together with {}, which is of another type: GL then draws nothing",
            other.name
        ),
    };
    format!(
        "{kind} {name}: {lab} sets none of that name, and it stays on texture unit 0{beside}{hint}"
    )
}

/// What the handout's shadows need, and what of the lab's settings goes without effect.
fn check_needed(
    subject: &Subject,
    linked: &Interface,
    unset: &[&Active],
    findings: &mut Vec<Finding>,
) {
    let Needed {
        uniforms,
        maps,
        coordinates,
    } = needed(subject.handout.name);
    let missing: Vec<_> = subject
        .labs
        .uniforms
        .iter()
        .filter(|labs| linked.uniform(&labs.name).is_none())
        .collect();
    let is_missing = |name: &str| missing.iter().any(|labs| labs.name == name);
    // One that the lab does not set is likely to stand for it, and has been told.
    let is_told = |kind: &str| unset.iter().any(|uniform| uniform.kind == kind);
    let read: Vec<&str> = coordinates
        .iter()
        .copied()
        .filter(|name| reads(subject, name))
        .collect();
    let mut without = Vec::new();
    // Where they are lost on the way, so is what they are made of.
    let are_lost = uniforms
        .iter()
        .any(|name| is_missing(name) && subject.declares(Storage::Uniform, name));
    let no_map = maps.iter().any(|map| is_missing(map));
    for labs in &missing {
        let name = labs.name.as_str();
        let declared = subject.declares(Storage::Uniform, name);
        let place = subject.place_of(Storage::Uniform, name);
        if maps.contains(&name) {
            // Where its coordinates are not read either, that has been told.
            if is_told(labs.kind) || read.is_empty() && !coordinates.is_empty() {
                continue;
            }
            let with_it = match read.as_slice() {
                names @ [_, ..] if are_lost => format!(", nor of {}", names.join(" and ")),
                _ => String::new(),
            };
            let text = match declared {
                true => format!(
                    "uniform {} {name}: nothing of it reaches the picture{with_it}, expected the shadow test to use it",
                    labs.kind
                ),
                false => format!(
                    "no uniform {} {name}, expected the shadow map to be looked up",
                    labs.kind
                ),
            };
            findings.push(Finding::wrong(place, text));
        } else if uniforms.contains(&name) {
            // What goes into the map's coordinates goes nowhere without the map.
            if is_told(labs.kind) || declared && (no_map || read.len() < coordinates.len()) {
                continue;
            }
            let text = match declared {
                true => format!(
                    "uniform {} {name}: nothing of it reaches the picture",
                    labs.kind
                ),
                false => format!(
                    "no uniform {} {name}, expected it to be declared and used",
                    labs.kind
                ),
            };
            findings.push(Finding::wrong(place, text));
        } else {
            without.push(name);
        }
    }
    if !without.is_empty() {
        let text = format!(
            "goes without {}: what {} sets there has no effect",
            without.join(", "),
            subject.handout.name
        );
        // In one line, since a shader need not have them.
        let (path, _) = subject.place_of(Storage::Uniform, "");
        findings.push(Finding::note((path, None), text));
    }
}

/// Whether a fragment shader makes anything of what it is handed.
fn reads(subject: &Subject, name: &str) -> bool {
    subject.of_stage(Stage::Fragment).any(|part| {
        let mut declared = part.scan.of(&[Storage::In, Storage::Varying]);
        declared.any(|found| found.name == name && part.scan.mentions(found))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(wanted: &str, kind: &'static str) -> Option<String> {
        let uniform = Active {
            name: "u".to_owned(),
            kind,
            location: None,
            value: 0.0,
        };
        wrong_type("cs541", wanted, &uniform)
    }

    #[test]
    fn what_gl_takes_is_not_wrong() {
        for (wanted, kind) in [
            ("vec3", "vec3"),
            ("bool", "int"),
            ("int", "bool"),
            ("sampler2D", "sampler2D"),
            ("sampler2DShadow", "sampler2DShadow"),
        ] {
            assert_eq!(told(wanted, kind), None, "{kind} for {wanted}");
        }
    }

    #[test]
    fn what_gl_refuses_is_wrong() {
        for (wanted, kind) in [
            ("vec3", "vec4"),
            ("int", "float"),
            ("sampler2D", "int"),
            ("int", "uint"),
        ] {
            let told = told(wanted, kind).unwrap();
            assert!(told.contains("GL refuses"), "{told}");
        }
    }

    #[test]
    fn a_comparison_is_told_from_a_look_up_both_ways() {
        let compares = told("sampler2D", "sampler2DShadow").unwrap();
        assert!(
            compares.contains("GL_TEXTURE_COMPARE_MODE is GL_NONE"),
            "{compares}"
        );
        let reads = told("sampler2DShadow", "sampler2D").unwrap();
        assert!(reads.contains("GL_TEXTURE_COMPARE_MODE is set"), "{reads}");
    }
}
