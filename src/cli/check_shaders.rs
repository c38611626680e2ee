//! `shadowlab check-shaders`: a student's own shaders in the lab's program, what is wrong with them, and their picture held
//! against the lab's.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde_json::{Value, json};
use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, Handout, Show};
use shadowlab::own_shaders::{self, Checked, Finding};
use shadowlab::{Error, Result, gl, picture};

use super::changes::Changes;
use super::compare::{CompareCommand, DIFFERENT, Judged, SAME};
use super::print;
use super::state::{Drawing, Running, State};
use super::values::check_light;

#[derive(Args)]
pub struct CheckShadersCommand {
    /// The folder with my shaders, of the names that the lab's have
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The lab's name, as `shadowlab labs` lists it
    lab: String,
    #[command(flatten)]
    changes: Changes,
    /// Print what is found as JSON
    #[arg(long)]
    json: bool,
    /// Write a page with the pictures
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Which of the lab's lights the shadows are of
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
}

impl CheckShadersCommand {
    pub fn folder_and_limit(&self) -> (PathBuf, u64) {
        (self.folder.clone(), self.changes.limit)
    }

    /// What brings the lab to its state, the student's shaders among it.
    pub fn with_shaders(&self) -> Changes {
        let mut changes = self.changes.clone();
        changes.glsl = Some(self.folder.clone());
        changes
    }

    pub fn run(self) -> Result<ExitCode> {
        let handout = labs::find(&self.lab)?;
        check_light(handout, self.light)?;
        self.changes.refuse_mistake("check-shaders")?;
        if self.changes.glsl.is_some() {
            return Err(Error::usage(
                "check-shaders DIR LAB: found --glsl, expected the folder of shaders as DIR",
            ));
        }
        if let Some(output) = &self.output {
            picture::check_name(output, &["html"])?;
        }
        let context = Headless::open(&self.device, handout.size, false)?;
        let checked = own_shaders::check(&context, handout, &self.folder)?;
        drop(context);
        let mut judged = match checked.draws {
            true => Some(self.judge(handout)?),
            false => None,
        };
        print(&match self.json {
            true => format!("{:#}\n", json(&checked, judged.as_ref())),
            false => self.text(handout, &checked, judged.as_ref()),
        })?;
        if let (Some(output), Some(judged)) = (&self.output, &mut judged) {
            // The page says it all in one.
            judged.findings = checked.findings.iter().map(Finding::to_string).collect();
            judged.write_page(output)?;
        }
        let is_clean = !checked.findings.iter().any(Finding::is_wrong);
        let is_same = judged.is_some_and(|judged| judged.is_same());
        Ok(ExitCode::from(match is_clean && is_same {
            true => SAME,
            false => DIFFERENT,
        }))
    }

    /// The student's picture, and its shadows, against the lab's.
    fn judge(&self, handout: &'static Handout) -> Result<Judged> {
        let state = State {
            lab: self.lab.clone(),
            changes: self.with_shaders(),
        };
        // What has no effect in them has been found already.
        let (drawn, _) = gl::programs_made(|| -> Result<_> {
            let mut running = state.start(&Drawing::on(&self.device), &[], false)?;
            running.draw(1, Show::Picture)?;
            let picture = gl::read_rgb(&running.context.gl, running.size);
            let Running {
                lab, context, size, ..
            } = &mut running;
            let shadows = own_shaders::try_visibility(lab.as_mut(), context, *size, self.light)?;
            gl::check_errors(&context.gl, "drawing")?;
            Ok((picture, shadows))
        });
        let (picture, shadows) = drawn?;
        let compare = CompareCommand::of_drawn(&self.changes, &self.device);
        let shadows = shadows.map(|shadows| (self.light, shadows));
        compare.drawn(handout, &self.folder, picture, shadows)
    }

    fn text(&self, handout: &Handout, checked: &Checked, judged: Option<&Judged>) -> String {
        let findings = &checked.findings;
        let mut text: String = findings
            .iter()
            .map(|finding| format!("{finding}\n"))
            .collect();
        let wrong = findings.iter().filter(|finding| finding.is_wrong()).count();
        text += &format!(
            "{} in {}: {wrong} wrong, {} to note\n",
            self.folder.display(),
            handout.name,
            findings.len() - wrong
        );
        match judged {
            Some(judged) => text + &judged.to_string(),
            None => text + "no picture: not every program compiles and links\n",
        }
    }
}

fn json(checked: &Checked, judged: Option<&Judged>) -> Value {
    let finding = |finding: &Finding| {
        json!({
            "wrong": finding.is_wrong(),
            "file": finding.path.display().to_string(),
            "line": finding.line,
            "text": finding.text,
        })
    };
    json!({
        "findings": checked.findings.iter().map(finding).collect::<Vec<_>>(),
        "compared": judged.map(Judged::json),
    })
}
