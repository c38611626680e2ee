//! `shadowlab mistakes`: the classic mistakes, each beside the right picture; and the proof that `compare` finds them.

mod gallery;
mod perturbed;
mod proof;
mod proof_page;
mod states;

use std::path::PathBuf;

use clap::Args;
use shadowlab::Result;
use shadowlab::headless::Choice;
use shadowlab::labs::{self, Handout, LABS};

use super::print;

#[derive(Args)]
pub struct MistakesCommand {
    /// The lab's name, as `shadowlab labs` lists it [default: every lab]
    lab: Option<String>,
    /// The folder to write: a page of the mistakes, or of the proof
    #[arg(short, long = "output", value_name = "DIR", default_value = "mistakes")]
    output: PathBuf,
    /// Let `compare` find every mistake in this many random states that show it, and count how often it is right
    #[arg(long, value_name = "STATES", value_parser = clap::value_parser!(u32).range(1..=1000))]
    prove: Option<u32>,
    /// The random states' seed
    #[arg(long, value_name = "N", default_value_t = 1, requires = "prove")]
    seed: u64,
    /// The pictures' size as a share of the course's window, in percent
    #[arg(long, value_name = "PERCENT", default_value_t = 50, value_parser = clap::value_parser!(u32).range(10..=100))]
    percent: u32,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
}

impl MistakesCommand {
    pub fn run(&self) -> Result<()> {
        let labs: Vec<&'static Handout> = match &self.lab {
            Some(name) => vec![labs::find(name)?],
            None => LABS.to_vec(),
        };
        let page = match self.prove {
            Some(states) => proof::write(self, &labs, states)?,
            None => gallery::write(self, &labs)?,
        };
        print(&format!("{}\n", page.display()))
    }

    fn size(&self, handout: &Handout) -> [u32; 2] {
        handout.size.map(|side| side * self.percent / 100)
    }
}
