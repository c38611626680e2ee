//! What came of a dump: the handout's steps, each found, wrong, or not to be told from calls.

use std::fmt::Write;

use super::judge::Fault;
use crate::mistakes;

/// A step of the handout, and what the dump has of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Where the handout says it.
    pub place: &'static str,
    /// What it asks for.
    pub asked: &'static str,
    pub mark: Mark,
    /// Of the dump.
    pub line: Option<u64>,
    pub found: String,
    /// What it does to the picture, where something is wrong.
    pub effect: &'static str,
    pub fix: &'static str,
    /// As `--mistake` and `shadowlab mistakes` name it.
    pub mistake: Option<&'static str>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Found,
    Missing,
    OutOfOrder,
    OtherArguments,
    /// The step is there, and something undoes it.
    Wrong,
    /// Calls alone do not tell: worth a look.
    Unclear,
}

impl Mark {
    pub fn sign(self) -> &'static str {
        match self {
            Self::Found => "✓",
            Self::Unclear => "?",
            _ => "✗",
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::Missing => "missing",
            Self::OutOfOrder => "out of order",
            Self::OtherArguments => "other arguments",
            Self::Wrong => "wrong",
            Self::Unclear => "not certain",
        }
    }
}

#[derive(Clone, Debug)]
pub struct Report {
    pub lab: &'static str,
    pub calls: u64,
    /// How many pictures were finished.
    pub frames: u64,
    /// The lines of the picture that is judged.
    pub judged: Option<[u64; 2]>,
    pub steps: Vec<Step>,
    /// The first line that is no call, and how many such lines there are.
    pub other: Option<(u64, usize)>,
}

impl Report {
    pub fn count(&self, of: impl Fn(Mark) -> bool) -> usize {
        self.steps.iter().filter(|step| of(step.mark)).count()
    }

    pub fn wrong(&self) -> usize {
        self.count(|mark| mark.sign() == "✗")
    }

    pub fn is_clean(&self) -> bool {
        self.wrong() == 0
    }

    /// A line for each step under the place of the handout, and a summary.
    pub fn text(&self) -> String {
        let mut text = match self.judged {
            Some([first, last]) => format!(
                "{}: {} calls, {}; judged: lines {first} to {last}, and the start-up\n",
                self.lab,
                self.calls,
                match self.frames {
                    0 => "not one buffer swap, so that all of it is one frame".to_owned(),
                    1 => "1 frame".to_owned(),
                    frames => format!("{frames} frames"),
                }
            ),
            None => format!("{}: {} calls, none of which draws\n", self.lab, self.calls),
        };
        if let Some((line, count)) = self.other {
            let lines = if count == 1 { "line is" } else { "lines are" };
            let _ = writeln!(
                text,
                "note: {count} {lines} no call and left out, the first is line {line}"
            );
        }
        let mut place = "";
        for step in &self.steps {
            if step.place != place {
                place = step.place;
                let _ = write!(text, "\n{place}\n");
            }
            let kind = match step.mark {
                Mark::Found | Mark::Unclear => String::new(),
                mark => format!("{}: ", mark.name()),
            };
            let line = step
                .line
                .map_or(String::new(), |line| format!(" (line {line})"));
            let _ = writeln!(
                text,
                "  {} {}: {kind}{}{line}",
                step.mark.sign(),
                step.asked,
                step.found
            );
            if step.mark != Mark::Found {
                for (word, told) in [("picture", step.effect), ("mend", step.fix)] {
                    if !told.is_empty() {
                        let _ = writeln!(text, "      {word}: {told}");
                    }
                }
                if let Some(mistake) = step.mistake {
                    let _ = writeln!(text, "      mistake: {mistake}");
                }
            }
        }
        let [found, unclear] = ["✓", "?"].map(|sign| self.count(|mark| mark.sign() == sign));
        let _ = write!(
            text,
            "\n{found} found, {} wrong or missing, {unclear} not certain\n",
            self.wrong()
        );
        text
    }
}

/// The steps of a report, as they are found.
pub struct Steps {
    pub all: Vec<Step>,
}

impl Steps {
    pub fn found(&mut self, step: Asked, line: u64, found: impl Into<String>) {
        self.add(step, Mark::Found, line, found);
    }

    /// A classic mistake: what it does and how it is mended stands with the mistake.
    pub fn mistake(
        &mut self,
        step: Asked,
        mark: Mark,
        line: u64,
        mistake: &'static str,
        found: impl Into<String>,
    ) {
        let known = mistakes::all()
            .find(|known| known.name == mistake)
            .expect("a mistake that is told is in the table");
        let step = self.add(step, mark, line, found);
        step.effect = known.symptom;
        step.fix = known.fix;
        step.mistake = Some(known.name);
    }

    /// What is wrong besides the classic mistakes.
    pub fn fault(
        &mut self,
        step: Asked,
        mark: Mark,
        line: u64,
        found: impl Into<String>,
        fault: &Fault,
    ) {
        let step = self.add(step, mark, line, found);
        step.effect = fault.effect;
        step.fix = fault.fix;
    }

    fn add(
        &mut self,
        (place, asked): Asked,
        mark: Mark,
        line: u64,
        found: impl Into<String>,
    ) -> &mut Step {
        self.all.push(Step {
            place,
            asked,
            mark,
            line: (line > 0).then_some(line),
            found: found.into(),
            effect: "",
            fix: "",
            mistake: None,
        });
        self.all.last_mut().expect("one was pushed")
    }
}

/// Where the handout asks for a step, and what it asks for.
pub type Asked = (&'static str, &'static str);
