//! The commands and their options.

mod changes;
mod check_shaders;
mod check_trace;
mod child;
mod compare;
mod gallery;
mod measuring;
mod mistakes;
mod report;
mod screenshot;
mod state;
mod timings;
mod values;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};
use glam::DVec3;
use shadowlab::gl::{self, trace};
use shadowlab::hard;
use shadowlab::labs::{self, Probe, Show, parse_keys};
use shadowlab::window::{self, Api, View};
use shadowlab::{Error, Result, headless};

use screenshot::Screenshot;
use state::{Drawing, State};
use values::{check_light, parse_numbers};

#[derive(Parser)]
#[command(
    name = "shadowlab",
    version,
    arg_required_else_help = false,
    about = "Handouts on real-time shadows in OpenGL 3.3, to hold one's own assignment against"
)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Open a lab in a window; the key ? there lists the keys
    View(ViewOptions),
    /// Draw a lab without a display and write the picture; --all draws every lab's stages
    Screenshot(Screenshot),
    /// Print the GL calls of start-up and of the frames, in C syntax
    Trace(Trace),
    /// Print what the handout's shader computes at one place, step by step
    Explain(Explain),
    /// Cast rays for what is in shadow in truth, and write the mask
    Truth(measuring::TruthCommand),
    /// Hold the lab's shadows, or a visibility picture, against the truth
    Measure(measuring::MeasureCommand),
    /// Hold my own program's picture against the lab's, and tell which mistake explains it
    Compare(compare::CompareCommand),
    /// Hold my own shaders against the lab's: names, types and texture units, then the picture
    CheckShaders(check_shaders::CheckShadersCommand),
    /// Hold a dump of my own program's GL calls against the handout's steps
    CheckTrace(check_trace::CheckTraceCommand),
    /// Show the classic mistakes, each beside the right picture: a page
    Mistakes(mistakes::MistakesCommand),
    /// Hold settings against each other, in time and in wrong pixels: a page, CSV and JSON
    Report(report::ReportCommand),
    /// List the labs with their keys and settings
    Labs,
    /// List the renderers that EGL offers
    Devices,
}

#[derive(Args)]
struct ViewOptions {
    #[command(flatten)]
    state: State,
    /// Whether a frame waits for the screen
    #[arg(long, value_enum, default_value_t = Switch::On)]
    vsync: Switch,
    /// How the window gets its context: GLX and EGL for X11, EGL for Wayland
    #[arg(long, value_enum, default_value_t = ApiOption::Auto)]
    api: ApiOption,
    /// Draw N frames without a rest and end; each thousandth is told on standard output
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    frames: Option<u64>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Switch {
    On,
    Off,
}

#[derive(Clone, Copy, ValueEnum)]
enum ApiOption {
    Auto,
    Glx,
    Egl,
}

#[derive(Args)]
struct Trace {
    #[command(flatten)]
    state: State,
    #[command(flatten)]
    drawing: Drawing,
}

#[derive(Args)]
struct Explain {
    #[command(flatten)]
    state: State,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    place: Place,
    /// Which of the lab's lights
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Place {
    /// A pixel of the picture; 0,0 is its top left corner
    #[arg(long, value_name = "X,Y", value_parser = parse_numbers::<u32, 2>, allow_hyphen_values = true)]
    pixel: Option<[u32; 2]>,
    /// A point in world space
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_numbers::<f64, 3>, allow_hyphen_values = true)]
    point: Option<[f64; 3]>,
}

impl Cli {
    pub fn run(self) -> Result<ExitCode> {
        if child::is_one() {
            child::end_with_parent();
        } else if let Some((folder, limit)) = self.students_shaders() {
            return child::again(&folder, limit);
        }
        match self.command {
            Command::Compare(options) => return options.run(),
            Command::CheckShaders(options) => return options.run(),
            Command::CheckTrace(options) => return options.run(),
            Command::View(options) => options.run(),
            Command::Screenshot(options) => options.run(),
            Command::Trace(options) => options.run(),
            Command::Explain(options) => options.run(),
            Command::Truth(options) => options.run(),
            Command::Measure(options) => options.run(),
            Command::Mistakes(options) => options.run(),
            Command::Report(options) => options.run(),
            Command::Labs => print(&labs_text()),
            Command::Devices => print(&devices_text()?),
        }?;
        Ok(ExitCode::SUCCESS)
    }

    /// The folder of shaders, and the limit, of a command that draws a picture or a few with them.
    fn students_shaders(&self) -> Option<(PathBuf, u64)> {
        let changes = match &self.command {
            Command::Screenshot(options) => options.changes(),
            Command::Trace(Trace { state, .. }) | Command::Explain(Explain { state, .. }) => {
                &state.changes
            }
            Command::Truth(options) => options.changes(),
            Command::Measure(options) => options.changes(),
            Command::Compare(options) => options.changes(),
            Command::CheckShaders(options) => return Some(options.folder_and_limit()),
            // These draw for as long as a person likes, and try the shaders first.
            Command::View(_) | Command::Report(_) => return None,
            Command::Mistakes(_) | Command::CheckTrace(_) => return None,
            Command::Labs | Command::Devices => return None,
        };
        Some((changes.glsl.clone()?, changes.limit))
    }

    /// The exit code of every error, where it does not hang on the error: of those that compare it is diff's.
    pub fn trouble_code(&self) -> Option<u8> {
        match self.command {
            Command::Compare(_) | Command::CheckShaders(_) => Some(compare::TROUBLE),
            Command::CheckTrace(_) => Some(check_trace::TROUBLE),
            _ => None,
        }
    }
}

impl ViewOptions {
    fn run(self) -> Result<()> {
        let state = self.state;
        let handout = labs::find(&state.lab)?;
        let mistake = state.mistake()?;
        let inputs = parse_keys(&state.changes.keys)?;
        let scene = state.students_scene()?.map_or_else(handout.scene, Ok)?;
        if let Some(folder) = &state.changes.glsl {
            child::try_first(&state, folder)?;
        }
        window::open(View {
            handout,
            size: state.changes.size.or(scene.size).unwrap_or(handout.size),
            scene,
            inputs,
            time: state.changes.time,
            glsl: state.changes.glsl.clone(),
            options: state.options_but_mistake(),
            mistake,
            prepare: Box::new(move |lab, inputs, time| state.bring_by(handout, lab, inputs, time)),
            vsync: self.vsync == Switch::On,
            api: match self.api {
                ApiOption::Auto => Api::Auto,
                ApiOption::Glx => Api::Glx,
                ApiOption::Egl => Api::Egl,
            },
            frames: self.frames,
        })
    }
}

impl Trace {
    fn run(&self) -> Result<()> {
        // As the course does it, each frame draws both passes, where there are two.
        let handout = labs::find(&self.state.lab)?;
        let has_redraw = handout.settings.iter().any(|s| s.name == "redraw");
        let first: &[&str] = if has_redraw {
            &["redraw=every_frame"]
        } else {
            &[]
        };
        let mut running = self.state.start(&self.drawing, first, true)?;
        running.draw(self.drawing.frames, Show::Picture)?;
        running.timings.lap("frames");
        let calls = trace::take();
        // Before anything is told: a student's shader that never ends is met here.
        gl::finish(&running.context.gl);
        print(&trace::to_c(&calls))
    }
}

impl Explain {
    fn run(&self) -> Result<()> {
        let probe = match (self.place.pixel, self.place.point) {
            (Some(pixel), _) => Probe::Pixel(pixel),
            (None, Some(point)) => Probe::Point(DVec3::from_array(point)),
            (None, None) => unreachable!("clap asks for one of them"),
        };
        check_light(labs::find(&self.state.lab)?, self.light)?;
        self.state.changes.refuse_mistake("explain")?;
        let mut running = self.state.start(&self.drawing, &[], false)?;
        if running.lab.has_students_test() {
            eprintln!(
                "note: what is explained is the lab's own shadow test, not that of the folder's shaders"
            );
        }
        running.draw(self.drawing.frames - 1, Show::Picture)?;
        let explanation = running
            .lab
            .explain(&running.context.gl, probe, self.light)?;
        running.timings.lap("frames");
        print(&explanation.to_string())
    }
}

fn labs_text() -> String {
    let mut text = String::new();
    for lab in labs::LABS {
        text += &format!("{}  {}\n", lab.name, lab.title);
        text += &format!("  window {}×{}\n\n  keys\n", lab.size[0], lab.size[1]);
        for (keys, help) in lab.keys {
            text += &format!("    {keys:22}{help}\n");
        }
        text += "\n  settings (--set name=value)\n";
        for setting in lab.settings {
            let (default, expected) = (setting.kind.default_text(), setting.kind.expected());
            text += &format!("    {:21}{}\n", setting.name, setting.help);
            text += &format!("    {:21}{expected}; default {default}\n", "");
        }
        text += "\n  mistakes (--mistake NAME)\n";
        for (mistake, _) in shadowlab::mistakes::of_lab(lab.name) {
            text += &format!("    {:22}{}\n", mistake.name, mistake.symptom);
        }
        let cases: Vec<_> = hard::cases().filter(|case| case.lab == lab.name).collect();
        if !cases.is_empty() {
            text += "\n  hard cases (--scene hard:NAME)\n";
        }
        for case in cases {
            text += &format!("    {:20}{}\n", case.name, case.about);
        }
    }
    text
}

fn devices_text() -> Result<String> {
    let describe = |device: headless::Device| {
        let kind = if device.software { "software" } else { "GPU" };
        let version = device
            .version
            .unwrap_or_else(|reason| format!("no OpenGL 3.3: {reason}"));
        format!("{} ({kind}): {version}\n", device.name)
    };
    Ok(headless::devices()?.into_iter().map(describe).collect())
}

/// A closed pipe (`| head`) is no failure of ours.
pub fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::writing("standard output", error))
        }
        _ => Ok(()),
    }
}
