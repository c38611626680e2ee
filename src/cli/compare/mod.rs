//! `shadowlab compare`: a student's picture, held against the lab's.

mod alone;
mod batch;
mod judged;
mod lab;
mod load;
mod page;
mod pair;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use image::RgbImage;
use shadowlab::compare::Shadows;
use shadowlab::headless::Choice;
use shadowlab::labs::{self, Handout};
use shadowlab::{Error, Result, picture};

use super::changes::Changes;
use super::print;
use super::state::State;
use super::values::parse_crop;
pub use judged::Judged;
use load::Loaded;

/// What the pictures are the same within their tolerance, differ, or could not be compared, as diff has it.
pub const SAME: u8 = 0;
pub const DIFFERENT: u8 = 1;
pub const TROUBLE: u8 = 2;

#[derive(Args)]
pub struct CompareCommand {
    /// The picture (or one with shadows and one without) and the lab's name; with --batch, the name alone
    #[arg(required = true, num_args = 1..=3, value_names = ["MINE.png", "WITHOUT.png", "LAB"])]
    what: Vec<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    /// Hold it against this picture in place of the lab's
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Look at this part alone, without a window's frame
    #[arg(long, value_name = "X,Y,WxH", value_parser = parse_crop)]
    crop: Option<[u32; 4]>,
    /// Forgive nothing: no flip, gamma, tint, shift, and no edge that is a pixel off
    #[arg(long)]
    strict: bool,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Write a page (LAB.html), or with --batch a folder of them
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Compare every picture of this folder, each in a process of its own
    #[arg(long, value_name = "DIR", conflicts_with_all = ["json", "reference"])]
    batch: Option<PathBuf>,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
}

impl CompareCommand {
    pub fn changes(&self) -> &Changes {
        &self.changes
    }

    /// The command for a picture that is drawn in this state, and not loaded.
    pub fn of_drawn(changes: &Changes, device: &Choice) -> Self {
        Self {
            what: Vec::new(),
            changes: changes.clone(),
            reference: None,
            crop: None,
            strict: false,
            json: false,
            output: None,
            batch: None,
            device: device.clone(),
        }
    }

    /// Holds a picture that was drawn against the lab's. `shadows` are those of a light (from 1), where they are known.
    pub fn drawn(
        &self,
        handout: &'static Handout,
        name: &Path,
        picture: RgbImage,
        shadows: Option<(usize, Shadows)>,
    ) -> Result<Judged> {
        let drawn = Loaded {
            picture,
            is_jpeg: false,
            notes: Vec::new(),
        };
        alone::judge_loaded(self, handout, name, drawn, shadows)
    }

    pub fn run(self) -> Result<ExitCode> {
        let Some((lab, pictures)) = self.what.split_last() else {
            unreachable!("clap asks for one");
        };
        let handout = labs::find(&lab.to_string_lossy())?;
        self.changes.refuse_mistake("compare")?;
        match (&self.batch, pictures) {
            (Some(folder), []) => batch::run(&self, folder, handout),
            (Some(_), _) => Err(Error::usage(
                "compare --batch DIR LAB: found a picture beside the folder",
            )),
            (None, []) => Err(Error::usage(format!(
                "compare: found no picture, expected compare MINE.png {}",
                handout.name
            ))),
            (None, [mine, without @ ..]) => self.one(handout, mine, without.first()),
        }
    }

    fn one(
        &self,
        handout: &'static Handout,
        mine: &Path,
        without: Option<&PathBuf>,
    ) -> Result<ExitCode> {
        if let Some(output) = &self.output {
            picture::check_name(output, &["html"])?;
        }
        let judged = match without {
            None => alone::judge(self, handout, mine)?,
            Some(without) => pair::judge(self, handout, mine, without)?,
        };
        if let Some(output) = &self.output {
            judged.write_page(output)?;
        }
        print(&match self.json {
            true => format!("{:#}\n", judged.json()),
            false => judged.to_string(),
        })?;
        Ok(ExitCode::from(match judged.is_same() {
            true => SAME,
            false => DIFFERENT,
        }))
    }

    /// The window whose picture this may be: the scene's, or the course's.
    fn window(&self, handout: &Handout) -> Result<[u32; 2]> {
        let scene = self.state(handout).students_scene()?;
        Ok(scene.and_then(|scene| scene.size).unwrap_or(handout.size))
    }

    fn state(&self, handout: &Handout) -> State {
        State {
            lab: handout.name.to_owned(),
            changes: self.changes.clone(),
        }
    }

    /// The options of one picture's comparison, as another command line would repeat them.
    fn state_options(&self, handout: &Handout) -> Vec<String> {
        let mut options = self.state(handout).all_options();
        if let Some([width, height]) = self.changes.size {
            options.extend(["--size".to_owned(), format!("{width}x{height}")]);
        }
        if let Some([x, y, width, height]) = self.crop {
            options.extend(["--crop".to_owned(), format!("{x},{y},{width}x{height}")]);
        }
        if self.strict {
            options.push("--strict".to_owned());
        }
        options
    }
}
