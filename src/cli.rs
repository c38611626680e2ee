//! The commands and their options.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};
use glam::DVec3;
use shadowlab::gl::{self, trace};
use shadowlab::headless::{self, Choice, Headless};
use shadowlab::labs::{self, Handout, Input, Lab, Probe, Show, parse_keys};
use shadowlab::scene::{self, Scene};
use shadowlab::window::{self, Api, View};
use shadowlab::{Error, Result, picture};

use crate::measuring;
use crate::timings::Timings;

/// The step of time between the frames of --frames, in seconds.
const FRAME: f64 = 1.0 / 60.0;
/// The most that --time takes, in seconds.
const MOST_TIME: f64 = 3e10;

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
    /// Draw a lab without a display and write the picture
    Screenshot(Screenshot),
    /// Print the GL calls of start-up and of the frames, in C syntax
    Trace(Trace),
    /// Print what the handout's shader computes at one place, step by step
    Explain(Explain),
    /// Cast rays for what is in shadow in truth, and write the mask
    Truth(measuring::TruthCommand),
    /// Hold the lab's shadows, or a visibility picture, against the truth
    Measure(measuring::MeasureCommand),
    /// List the labs with their keys and settings
    Labs,
    /// List the renderers that EGL offers
    Devices,
}

/// Which state of which lab.
#[derive(Args)]
pub struct State {
    /// The lab's name, as `shadowlab labs` lists it
    pub lab: String,
    /// Draw the scene of this file in place of the lab's own
    #[arg(long, value_name = "FILE.toml")]
    scene: Option<PathBuf>,
    /// Let the scene name files outside of its folder
    #[arg(long, requires = "scene")]
    allow_outside: bool,
    /// Size of the picture in pixels [default: the scene's, or the course's window]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<[u32; 2]>,
    /// Give a setting another value; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Press keys first, for example "wwa<Left><Left>"; <Drag:12,-5> and <Wheel:1> are the mouse, <Wait:0.5> lets seconds pass
    #[arg(
        long,
        value_name = "KEYS",
        default_value = "",
        hide_default_value = true,
        allow_hyphen_values = true
    )]
    keys: String,
    /// Seconds that pass before the first frame
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = parse_time, allow_negative_numbers = true)]
    time: f64,
    /// Use the shaders of this folder in place of those with the same names
    #[arg(long, value_name = "DIR")]
    glsl: Option<PathBuf>,
}

/// How frames are drawn without a display.
#[derive(Args)]
pub struct Drawing {
    /// Frames to draw, 1/60 s apart; the last one is kept
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
    /// Print how long each part took, on standard error
    #[arg(long)]
    timings: bool,
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
struct Screenshot {
    #[command(flatten)]
    state: State,
    #[command(flatten)]
    drawing: Drawing,
    /// The file to write [default: LAB.png]
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// What the picture shows
    #[arg(long, value_enum, default_value_t = Shown::Picture)]
    show: Shown,
    /// Which of the lab's lights, for visibility and the maps
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Shown {
    /// The lab's picture
    Picture,
    /// 255 lit, 0 in shadow by the lab's own test, 255 where there is no surface
    Visibility,
    /// The depth map for the eye: black near, white far; by distance, or by depth where the handout says so
    ShadowMap,
    /// The depth texture as it is: 16-bit PNG, or 32-bit floats if the file ends in .pfm
    DepthRaw,
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
    pub fn run(self) -> Result<()> {
        match self.command {
            Command::View(options) => options.run(),
            Command::Screenshot(options) => options.run(),
            Command::Trace(options) => options.run(),
            Command::Explain(options) => options.run(),
            Command::Truth(options) => options.run(),
            Command::Measure(options) => options.run(),
            Command::Labs => print(&labs_text()),
            Command::Devices => print(&devices_text()?),
        }
    }
}

// ---- A lab in a state ------------------------------------------------------------------------------------------------

/// A lab in a context, brought to the state that the options name, before its first frame.
pub struct Running {
    // The lab's GL objects go before their context does.
    pub lab: Box<dyn Lab>,
    pub context: Headless,
    pub name: &'static str,
    pub size: [u32; 2],
    // Last: it counts their end, too.
    timings: Timings,
}

impl State {
    /// `first` are settings of the command's own, which the user's `--set` may overrule.
    pub fn start(&self, drawing: &Drawing, first: &[&str], record: bool) -> Result<Running> {
        let mut timings = Timings::new(drawing.timings);
        let handout = labs::find(&self.lab)?;
        parse_keys(&self.keys)?;
        // A scene file says the size that the context must have, so it goes first.
        let students_scene = self.students_scene()?;
        let scene_size = students_scene.as_ref().and_then(|scene| scene.size);
        let size = self.size.or(scene_size).unwrap_or(handout.size);

        // The driver's start and the lab's own scene have nothing to do with each other, so they go side by side.
        let (context, scene) = std::thread::scope(|scope| {
            let scene = scope.spawn(move || students_scene.map_or_else(handout.scene, Ok));
            let context = Headless::open(&drawing.device, size, record);
            (
                context,
                scene.join().expect("a scene is built without panic"),
            )
        });
        let (context, scene) = (context?, scene?);
        timings.lap("EGL, context, scene");

        let mut lab = (handout.start)(&context.gl, scene, self.glsl.as_deref())
            .map_err(|error| self.about_scene(error))?;
        lab.resize(size);
        for assignment in first {
            lab.settings().set(assignment)?;
        }
        self.bring(handout, lab.as_mut())?;
        timings.lap("shaders, meshes, textures");
        Ok(Running {
            lab,
            context,
            name: handout.name,
            size,
            timings,
        })
    }

    /// The options but for size, keys and time, as another command line would repeat them.
    fn options(&self) -> Vec<String> {
        let mut options = Vec::new();
        if let Some(path) = &self.scene {
            options.extend(["--scene".to_owned(), path.display().to_string()]);
        }
        if self.allow_outside {
            options.push("--allow-outside".to_owned());
        }
        for assignment in &self.set {
            options.extend(["--set".to_owned(), assignment.clone()]);
        }
        if let Some(folder) = &self.glsl {
            options.extend(["--glsl".to_owned(), folder.display().to_string()]);
        }
        options
    }

    /// Brings a lab that has just started to this state.
    fn bring(&self, handout: &Handout, lab: &mut dyn Lab) -> Result<()> {
        for assignment in &self.set {
            lab.settings().set(assignment)?;
        }
        let inputs = parse_keys(&self.keys)?;
        let waits = inputs.iter().map(|input| match input {
            Input::Wait(seconds) => *seconds,
            _ => 0.0,
        });
        let time = waits.sum::<f64>() + self.time;
        let most = lab.most_time().min(MOST_TIME);
        if time > most {
            return Err(Error::usage(format!(
                "--time {time}: {} expected a number of seconds, 0 to {most}",
                handout.name
            )));
        }
        for input in inputs {
            if !lab.input(input) {
                return Err(Error::usage(format!(
                    "--keys: {} has no key {input}, expected one of {}",
                    handout.name,
                    handout
                        .keys
                        .iter()
                        .map(|(keys, _)| *keys)
                        .collect::<Vec<_>>()
                        .join(" ")
                )));
            }
        }
        lab.advance(self.time);
        Ok(())
    }

    fn students_scene(&self) -> Result<Option<Scene>> {
        let load = |path| scene::file::load(path, self.allow_outside);
        self.scene.as_deref().map(load).transpose()
    }

    /// A scene that a lab has no use for is wrong in its file, not on the command line.
    fn about_scene(&self, error: Error) -> Error {
        match (&self.scene, error) {
            (Some(path), Error::Usage(message)) => Error::input(path, None, message),
            (_, error) => error,
        }
    }
}

impl Running {
    pub fn draw(&mut self, frames: u32, show: Show) -> Result<()> {
        for frame in 0..frames {
            if frame > 0 {
                self.lab.advance(FRAME);
            }
            self.lab.render(&self.context.gl, show)?;
        }
        gl::check_errors(&self.context.gl, "drawing")
    }
}

// ---- The commands ----------------------------------------------------------------------------------------------------

impl ViewOptions {
    fn run(self) -> Result<()> {
        let state = self.state;
        let handout = labs::find(&state.lab)?;
        let inputs = parse_keys(&state.keys)?;
        let scene = state.students_scene()?.map_or_else(handout.scene, Ok)?;
        window::open(View {
            handout,
            size: state.size.or(scene.size).unwrap_or(handout.size),
            scene,
            inputs,
            time: state.time,
            glsl: state.glsl.clone(),
            options: state.options(),
            prepare: Box::new(move |lab| state.bring(handout, lab)),
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

impl Screenshot {
    fn run(&self) -> Result<()> {
        let handout = labs::find(&self.state.lab)?;
        check_light(handout, self.light)?;
        let output = self.output.clone();
        let output = output.unwrap_or_else(|| format!("{}.png", handout.name).into());
        picture::check_name(
            &output,
            if self.show == Shown::DepthRaw {
                &["png", "pfm"]
            } else {
                &["png"]
            },
        )?;

        let mut running = self.state.start(&self.drawing, &[], false)?;
        let show = match self.show {
            Shown::Visibility => Show::Visibility { light: self.light },
            _ => Show::Picture,
        };
        running.draw(self.drawing.frames, show)?;
        running.write(self.show, self.light, &output)?;
        running.timings.lap("file");
        print(&format!("{}\n", output.display()))
    }
}

impl Running {
    fn write(&mut self, shown: Shown, light: usize, output: &Path) -> Result<()> {
        let gl = &self.context.gl;
        let notes = picture::notes(&self.context.renderer);
        match shown {
            Shown::Picture => {
                let pixels = gl::read_rgb(gl, self.size);
                self.timings.lap("frames");
                picture::write_rgb(output, &pixels, &notes)
            }
            Shown::Visibility => {
                let pixels = gl::read_grey(gl, self.size);
                self.timings.lap("frames");
                picture::write_grey(output, &pixels, &notes)
            }
            Shown::ShadowMap | Shown::DepthRaw => {
                let map = self.lab.shadow_texture(light)?;
                let scale = map.scale;
                let depths = gl::read_depths(gl, map.texture, [scale.size; 2]);
                self.timings.lap("frames");
                if shown == Shown::DepthRaw {
                    return picture::write_depths(output, &depths, &notes);
                }
                let projection = self.lab.grey().of(scale.projection);
                picture::write_grey(
                    output,
                    &depths.linearised(projection, scale.near, scale.far),
                    &notes,
                )
            }
        }
    }
}

impl Trace {
    fn run(&self) -> Result<()> {
        // As the course does it, each frame draws both passes.
        let mut running = self
            .state
            .start(&self.drawing, &["redraw=every_frame"], true)?;
        running.draw(self.drawing.frames, Show::Picture)?;
        running.timings.lap("frames");
        print(&trace::to_c(&trace::take()))
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
        let mut running = self.state.start(&self.drawing, &[], false)?;
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
            text += &format!("    {:16}{}\n", setting.name, setting.help);
            text += &format!("    {:16}{expected}; default {default}\n", "");
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

// ---- Values of options -----------------------------------------------------------------------------------------------

pub fn check_light(handout: &Handout, light: usize) -> Result<()> {
    if (1..=handout.lights).contains(&light) {
        return Ok(());
    }
    let expected = match handout.lights {
        1 => "1, its only light".to_owned(),
        lights => format!("1 to {lights}"),
    };
    Err(Error::usage(format!(
        "--light {light}: {} has no such light, expected {expected}",
        handout.name
    )))
}

fn parse_size(text: &str) -> std::result::Result<[u32; 2], String> {
    let size = text.split_once('x').and_then(|(width, height)| {
        let size = [width.parse().ok()?, height.parse().ok()?];
        size.iter()
            .all(|n| (1..=65_536).contains(n))
            .then_some(size)
    });
    size.ok_or_else(|| {
        "expected WIDTHxHEIGHT in pixels, 1x1 to 65536x65536, for example 800x600".to_owned()
    })
}

fn parse_time(text: &str) -> std::result::Result<f64, String> {
    let time: Option<f64> = text.parse().ok();
    // A NaN is in no range. In a thousand years a turn still has a millisecond's precision.
    time.filter(|time| (0.0..=MOST_TIME).contains(time))
        .ok_or_else(|| format!("expected a number of seconds, 0 to {MOST_TIME}"))
}

fn parse_numbers<T: FromStr + Into<f64> + Copy, const N: usize>(
    text: &str,
) -> std::result::Result<[T; N], String> {
    let numbers: Option<Vec<T>> = text
        .split(',')
        .map(|number| number.trim().parse().ok())
        .collect();
    numbers
        .filter(|numbers| numbers.iter().all(|number| (*number).into().is_finite()))
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("expected {N} numbers with commas between them"))
}
