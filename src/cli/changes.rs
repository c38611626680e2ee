//! What a command line changes in a lab.

use std::path::{Path, PathBuf};

use clap::Args;
use shadowlab::hard::{self, Case};
use shadowlab::labs::{Input, parse_keys};
use shadowlab::{Error, Result};

use super::values::{parse_size, parse_time};

/// What the name of a hard case has before it, where a scene's file could stand.
const HARD: &str = "hard:";

/// How a lab's state differs from the one that it starts in.
#[derive(Clone, Args)]
pub struct Changes {
    /// Draw the scene of this file in place of the lab's own; hard:NAME is one of the lab's hard cases
    #[arg(long, value_name = "FILE.toml")]
    pub scene: Option<PathBuf>,
    /// Let the scene name files outside of its folder
    #[arg(long, requires = "scene")]
    pub allow_outside: bool,
    /// Size of the picture in pixels [default: the scene's, or the course's window]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Give a setting another value; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Press keys first, for example "wwa<Left><Left>"; <Drag:12,-5> and <Wheel:1> are the mouse, <Wait:0.5> lets seconds pass
    #[arg(
        long,
        value_name = "KEYS",
        default_value = "",
        hide_default_value = true,
        allow_hyphen_values = true
    )]
    pub keys: String,
    /// Seconds that pass before the first frame
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = parse_time, allow_negative_numbers = true)]
    pub time: f64,
    /// Use the shaders of this folder in place of those with the same names
    #[arg(long, value_name = "DIR")]
    pub glsl: Option<PathBuf>,
    /// Seconds that drawing with the shaders of --glsl may take, or one picture of compare --batch (of the cores' time)
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub limit: u64,
    /// Make one of the classic mistakes; `shadowlab labs` lists those that a lab can make
    #[arg(long, value_name = "NAME", conflicts_with = "glsl")]
    pub mistake: Option<String>,
}

impl Changes {
    pub fn has_scene(&self) -> bool {
        self.scene.is_some()
    }

    /// Whether one of them brings a lab to another state of the same scene.
    pub fn are_of_one_state(&self) -> bool {
        self.glsl.is_some() || !self.set.is_empty() || !self.keys.is_empty() || self.time > 0.0
    }

    /// The hard case that stands in place of a scene's file.
    pub fn hard_case(&self) -> Result<Option<&'static Case>> {
        let name = self.scene.as_deref().and_then(Path::to_str);
        let name = name.and_then(|name| name.strip_prefix(HARD));
        name.map(hard::find).transpose()
    }

    /// Whether one of them has a meaning for one lab only.
    pub fn are_of_one_lab(&self) -> bool {
        self.scene.is_some()
            || self.glsl.is_some()
            || !self.set.is_empty()
            || !self.keys.is_empty()
            || self.mistake.is_some()
    }

    /// A command that is about the lab as it is refuses mistakes.
    pub fn refuse_mistake(&self, command: &str) -> Result<()> {
        match &self.mistake {
            None => Ok(()),
            Some(name) => Err(Error::usage(format!(
                "--mistake {name}: {command} is about the lab without mistakes, expected view, screenshot, trace or \
                 measure"
            ))),
        }
    }

    /// Whether the setting of that name is given a value.
    pub fn sets(&self, name: &str) -> bool {
        self.given(name).is_some()
    }

    /// The value that a setting is given, by `--set` or among the keys; the last one counts.
    fn given(&self, name: &str) -> Option<String> {
        let keys = parse_keys(&self.keys).unwrap_or_default();
        let pressed = keys.into_iter().filter_map(|input| match input {
            Input::Set(assignment) => Some(assignment),
            _ => None,
        });
        let mut assignments: Vec<String> = self.set.iter().cloned().chain(pressed).collect();
        assignments.reverse();
        let mut pairs = assignments
            .iter()
            .filter_map(|assignment| assignment.split_once('='));
        pairs
            .find(|(given, _)| *given == name)
            .map(|(_, value)| value.to_owned())
    }

    /// The shadow test, where it is not the handout's.
    pub fn other_test(&self) -> Option<String> {
        self.given("shadow_test").filter(|test| test != "handout")
    }

    /// Gives a setting another value, after those that the user gives.
    pub fn set(&mut self, assignment: &str) {
        self.set.push(assignment.to_owned());
    }
}
