//! Streams of GL calls, read from text, and the steps that a handout expects in them.
//!
//! # Steps
//! A step is one call as a handout writes it, `glBindFramebuffer(GL_FRAMEBUFFER, $frame_buffer)`, where
//! - `$name` is any argument when it first occurs, and the same argument from then on;
//! - `_` is any argument; `...`, in the last place, is any number of them;
//! - `$location = glGetUniformLocation($program, "shadow_sampler")` does for a result what `$name` does for an argument
//!   (a type before the variable is ignored, and a step without `=` does not look at the result);
//! - `// first pass` is the heading of a pass.
//!
//! White space, `&`, casts, a closing `;` and the order of `GL_…_BIT`s do not matter. Two variables may stand for the
//! same argument: framebuffer 1 and texture 1 are both `1` in some dumps.
//!
//! # Which lines the steps find
//! [`find_in_order`] looks for each step after the line of the step before; other lines may stand between. But a call
//! that works on a bound object must work on the one that the steps have bound: after a step
//! `glBindTexture(GL_TEXTURE_2D, $shadow_map)`, a `glTexImage2D` that stands where another texture is bound is not the
//! one that is looked for. (So for textures, framebuffers, renderbuffers, buffers and programs.) When
//! a variable first occurs there may be several lines to choose from (the first texture that is generated need not be
//! the shadow map), so every choice is tried, up to [`TRIES`]. A step that binds nothing new takes the first line
//! that it fits: a later one could only leave fewer lines for the steps that follow.
#![allow(dead_code)] // Each test program that reads calls uses a part of this.

use std::collections::BTreeMap;
use std::fmt;

mod bound;
pub mod record;
mod text;

use bound::{Bound, bind_target, same_target, works_on};
use text::{Parts, line_of};
pub use text::{parse_apitrace, parse_c};

/// A call, the same whether it was read from C or from `apitrace dump`. Or a heading: see [`Line::heading`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    pub name: String,
    pub args: Vec<String>,
    pub result: Option<String>,
}

/// What the variables of the steps stand for, without their `$`.
pub type Bindings = BTreeMap<String, String>;

/// How many choices [`find_in_order`] tries before it gives up.
pub const TRIES: usize = 100_000;

const HEADING: &str = "//";

impl Line {
    /// The pass that begins here.
    pub fn heading(&self) -> Option<&str> {
        (self.name == HEADING).then(|| self.args[0].as_str())
    }

    fn new_heading(text: &str) -> Self {
        Self {
            name: HEADING.to_owned(),
            args: vec![text.trim().to_owned()],
            result: None,
        }
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(heading) = self.heading() {
            return write!(f, "// {heading}");
        }
        if let Some(result) = &self.result {
            write!(f, "{result} = ")?;
        }
        write!(f, "{}({})", self.name, self.args.join(", "))
    }
}

/// The lines of one pass: those after its heading, up to the next heading. Panics if there is no such heading.
pub fn in_pass<'a>(lines: &'a [Line], heading: &str) -> &'a [Line] {
    let start = lines
        .iter()
        .position(|line| line.heading() == Some(heading))
        .unwrap_or_else(|| panic!("no pass is called {heading:?}"));
    let pass = &lines[start + 1..];
    let end = pass.iter().position(|line| line.heading().is_some());
    &pass[..end.unwrap_or(pass.len())]
}

/// Finds every expected step in `lines`, in order, with anything between them. The error names the first step that is
/// missing, on the way that led furthest.
pub fn find_in_order(lines: &[Line], expected: &[&str]) -> Result<Bindings, String> {
    let steps = steps(expected);
    let mut search = Search {
        lines,
        steps: &steps,
        state: bound::at_each(lines),
        tries: 0,
        furthest: None,
    };
    if let Some(bindings) = search.find(0, 0, &Bindings::new()) {
        return Ok(bindings);
    }
    if search.tries >= TRIES {
        return Err(format!("gave up after {TRIES} tries to find the steps"));
    }
    let stop = search.furthest.expect("a search fails at some step");
    Err(format!(
        "step {} of {} is missing: {}{}, with {:?}{}",
        stop.step + 1,
        steps.len(),
        expected[stop.step].trim(),
        match stop.from.checked_sub(1) {
            Some(last) => format!(", after line {}, {}", last + 1, lines[last]),
            None => String::new(),
        },
        stop.bindings,
        match stop.other_object {
            Some(line) => format!("; line {} has it, for another object", line + 1),
            None => String::new(),
        }
    ))
}

/// The calls of `lines` are the expected steps and no others. Headings count only if one is expected.
pub fn exactly(lines: &[Line], expected: &[&str]) -> Result<Bindings, String> {
    let steps = steps(expected);
    let with_headings = steps.iter().any(|step| step.heading().is_some());
    let lines: Vec<_> = lines
        .iter()
        .filter(|line| with_headings || line.heading().is_none())
        .collect();
    let mut bindings = Bindings::new();
    for (index, step) in steps.iter().enumerate() {
        let wanted = expected[index].trim();
        let place = format!("step {} of {}", index + 1, steps.len());
        let line = lines
            .get(index)
            .ok_or_else(|| format!("{place} is missing at the end: {wanted}"))?;
        bindings = fit(step, line, &bindings)
            .ok_or_else(|| format!("{place} is {line}, not {wanted}, with {bindings:?}"))?;
    }
    match lines.get(steps.len()) {
        Some(line) => Err(format!("after the {} steps comes {line}", steps.len())),
        None => Ok(bindings),
    }
}

struct Search<'a> {
    lines: &'a [Line],
    steps: &'a [Line],
    /// What is bound at each line.
    state: Vec<Bound>,
    tries: usize,
    furthest: Option<Stop>,
}

/// Where the search could not go on.
struct Stop {
    step: usize,
    /// The line from which the step was sought.
    from: usize,
    bindings: Bindings,
    /// A line that would fit, but that works on another object than the steps have bound.
    other_object: Option<usize>,
}

impl Search<'_> {
    /// Finds the steps from `step` on in the lines from `from` on.
    fn find(&mut self, step: usize, from: usize, bindings: &Bindings) -> Option<Bindings> {
        if step == self.steps.len() {
            return Some(bindings.clone());
        }
        let mut tried: Vec<Bindings> = Vec::new();
        let mut other_object = None;
        for index in from..self.lines.len() {
            let Some(bound) = fit(&self.steps[step], &self.lines[index], bindings) else {
                continue;
            };
            // The same choice further down leaves fewer lines for the rest.
            if tried.contains(&bound) {
                continue;
            }
            if !self.works_on_what_the_steps_bound(step, index, &bound) {
                other_object.get_or_insert(index);
                continue;
            }
            self.tries += 1;
            if self.tries >= TRIES {
                return None;
            }
            if let Some(found) = self.find(step + 1, index + 1, &bound) {
                return Some(found);
            }
            let nothing_new = bound == *bindings;
            tried.push(bound);
            if nothing_new {
                break;
            }
        }
        let furthest = self.furthest.as_ref().map(|stop| stop.step);
        if tried.is_empty() && furthest < Some(step) {
            self.furthest = Some(Stop {
                step,
                from,
                bindings: bindings.clone(),
                other_object,
            });
        }
        None
    }

    fn works_on_what_the_steps_bound(
        &self,
        step: usize,
        index: usize,
        bindings: &Bindings,
    ) -> bool {
        let Some((bind, target)) = works_on(&self.lines[index]) else {
            return true;
        };
        let earlier = self.steps[..step].iter().rev();
        let Some(bind_step) = earlier.into_iter().find(|earlier| {
            earlier.name == bind
                && bind_target(earlier).is_none_or(|bound| same_target(bound, target))
        }) else {
            return true;
        };
        let wanted = match bind_step.args.last().map(String::as_str) {
            None | Some("_" | "...") => return true,
            Some(arg) => match arg.strip_prefix('$') {
                Some(variable) => bindings.get(variable).map(String::as_str),
                None => Some(arg),
            },
        };
        self.state[index].get(bind, target) == wanted
    }
}

/// The bindings with which `line` is what `step` expects.
fn fit(step: &Line, line: &Line, bindings: &Bindings) -> Option<Bindings> {
    if step.name != line.name {
        return None;
    }
    let mut bindings = bindings.clone();
    let named = match step.args.split_last() {
        Some((last, named)) if last == "..." && line.args.len() >= named.len() => named,
        _ if step.args.len() == line.args.len() => step.args.as_slice(),
        _ => return None,
    };
    let results = step.result.iter().map(|wanted| (wanted, &line.result));
    for (wanted, found) in results {
        if !fit_one(wanted, found.as_deref()?, &mut bindings) {
            return None;
        }
    }
    let fits = named
        .iter()
        .zip(&line.args)
        .all(|(wanted, found)| fit_one(wanted, found, &mut bindings));
    fits.then_some(bindings)
}

fn fit_one(wanted: &str, found: &str, bindings: &mut Bindings) -> bool {
    match wanted.strip_prefix('$') {
        Some(variable) => {
            let bound = bindings.entry(variable.to_owned());
            bound.or_insert_with(|| found.to_owned()) == found
        }
        None => wanted == "_" || wanted == found,
    }
}

fn steps(expected: &[&str]) -> Vec<Line> {
    expected
        .iter()
        .map(|step| match step.trim().strip_prefix(HEADING) {
            Some(heading) => Line::new_heading(heading),
            None => {
                let call = Parts::read(step).unwrap_or_else(|| panic!("not a step: {step}"));
                line_of(call.name, call.args.clone(), call.variable)
            }
        })
        .collect()
}
