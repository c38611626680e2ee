//! A lab, brought to the state that a command line names.

use clap::Args;
use image::RgbImage;
use shadowlab::compare::Shadows;
use shadowlab::gl;
use shadowlab::gl::edits::{self, Edited, Edits};
use shadowlab::hard::Case;
use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, Handout, Input, Lab, Show, parse_keys};
use shadowlab::mistakes::{self, Mistake};
use shadowlab::own_shaders;
use shadowlab::scene::{self, Scene};
use shadowlab::{Error, Result};

use super::changes::Changes;
use super::timings::Timings;
use super::values::MOST_TIME;

/// The step of time between the frames of --frames, in seconds.
const FRAME: f64 = 1.0 / 60.0;

/// Which state of which lab.
#[derive(Clone, Args)]
pub struct State {
    /// The lab's name, as `shadowlab labs` lists it
    pub lab: String,
    #[command(flatten)]
    pub changes: Changes,
}

/// How frames are drawn without a display.
#[derive(Args)]
pub struct Drawing {
    /// Frames to draw, 1/60 s apart; the last one is kept
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    pub device: Choice,
    /// Print how long each part took, on standard error
    #[arg(long)]
    timings: bool,
}

impl Drawing {
    /// One frame on that renderer.
    pub fn on(device: &Choice) -> Self {
        Self {
            frames: 1,
            device: device.clone(),
            timings: false,
        }
    }
}

/// A lab in a context, brought to the state that the options name, before its first frame.
pub struct Running {
    // The lab's GL objects go before their context does.
    pub lab: Box<dyn Lab>,
    pub context: Headless,
    pub name: &'static str,
    pub size: [u32; 2],
    // Last: it counts their end, too.
    pub timings: Timings,
    _mistake: Option<Edited>,
}

impl State {
    /// `first` are settings of the command's own, which the user's `--set` may overrule.
    pub fn start(&self, drawing: &Drawing, first: &[&str], record: bool) -> Result<Running> {
        let mut timings = Timings::new(drawing.timings);
        let handout = labs::find(&self.lab)?;
        parse_keys(&self.changes.keys)?;
        let mistake = self.make_mistake()?;
        // A scene file says the size that the context must have, so it goes first.
        let students_scene = self.students_scene()?;
        let scene_size = students_scene.as_ref().and_then(|scene| scene.size);
        let size = self.changes.size.or(scene_size).unwrap_or(handout.size);

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

        let mut lab = (handout.start)(&context.gl, scene, self.changes.glsl.as_deref())
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
            _mistake: mistake,
        })
    }

    /// The lab's picture, drawn in a context of its own: a mistake leaves something behind.
    pub fn picture(&self, device: &Choice, with: Edits) -> Result<RgbImage> {
        let _edited = edits::set(with);
        let mut running = self.start(&Drawing::on(device), &[], false)?;
        running.draw(1, Show::Picture)?;
        Ok(gl::read_rgb(&running.context.gl, running.size))
    }

    /// Makes the mistake that is asked for, until what is returned is dropped.
    fn make_mistake(&self) -> Result<Option<Edited>> {
        let mistake = self.mistake()?;
        let made = mistake.and_then(|mistake| mistake.made(&self.lab));
        Ok(made.map(|made| edits::set(made.edits)))
    }

    /// The mistake that is asked for.
    pub fn mistake(&self) -> Result<Option<&'static Mistake>> {
        let Some(name) = &self.changes.mistake else {
            return Ok(None);
        };
        let (mistake, _) = mistakes::find(name, &self.lab)?;
        if let Some(test) = self.changes.other_test() {
            return Err(Error::usage(format!(
                "--mistake {name}: it is one of the handout's test, expected shadow_test=handout, found {test}"
            )));
        }
        Ok(Some(mistake))
    }

    /// The options but for size, keys and time, as another command line would repeat them.
    pub fn options(&self) -> Vec<String> {
        let mut options = self.options_but_mistake();
        if let Some(name) = &self.changes.mistake {
            options.extend(["--mistake".to_owned(), name.clone()]);
        }
        options
    }

    /// The same without --mistake, which the viewer's panel can change.
    pub fn options_but_mistake(&self) -> Vec<String> {
        let mut options = Vec::new();
        if let Some(path) = &self.changes.scene {
            options.extend(["--scene".to_owned(), path.display().to_string()]);
        }
        if self.changes.allow_outside {
            options.push("--allow-outside".to_owned());
        }
        for assignment in &self.changes.set {
            options.extend(["--set".to_owned(), assignment.clone()]);
        }
        if let Some(folder) = &self.changes.glsl {
            options.extend(["--glsl".to_owned(), folder.display().to_string()]);
        }
        options
    }

    /// The options but for the size.
    pub fn all_options(&self) -> Vec<String> {
        let mut options = self.options();
        let Changes { keys, time, .. } = &self.changes;
        if !keys.is_empty() {
            options.extend(["--keys".to_owned(), keys.clone()]);
        }
        if *time > 0.0 {
            options.extend(["--time".to_owned(), time.to_string()]);
        }
        options
    }

    /// Brings a lab that has just started to this state.
    pub fn bring(&self, handout: &Handout, lab: &mut dyn Lab) -> Result<()> {
        let inputs = parse_keys(&self.changes.keys)?;
        self.bring_by(handout, lab, &inputs, self.changes.time)
    }

    /// The same with other inputs in place of --keys, and another time behind them in place of --time.
    pub fn bring_by(
        &self,
        handout: &Handout,
        lab: &mut dyn Lab,
        inputs: &[Input],
        time: f64,
    ) -> Result<()> {
        for assignment in &self.changes.set {
            lab.settings().set(assignment)?;
        }
        let after_inputs = time;
        let waits = inputs.iter().map(|input| match input {
            Input::Wait(seconds) => *seconds,
            _ => 0.0,
        });
        let time = waits.sum::<f64>() + after_inputs;
        let most = lab.most_time().min(MOST_TIME);
        if time > most {
            return Err(Error::usage(format!(
                "--time {time}: {} expected a number of seconds, 0 to {most}",
                handout.name
            )));
        }
        for input in inputs {
            if let Input::Set(assignment) = input {
                lab.settings().set(assignment)?;
            } else if !lab.input(input.clone()) {
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
        lab.advance(after_inputs);
        Ok(())
    }

    /// The hard case that stands in place of a scene's file, if the lab is the one that draws it.
    fn hard_case(&self) -> Result<Option<&'static Case>> {
        match self.changes.hard_case()? {
            Some(case) if case.lab != self.lab => Err(Error::usage(format!(
                "the hard case {} is drawn by {}, found {}",
                case.name, case.lab, self.lab
            ))),
            case => Ok(case),
        }
    }

    /// What is drawn in place of the lab's own scene.
    pub fn students_scene(&self) -> Result<Option<Scene>> {
        if let Some(case) = self.hard_case()? {
            return Ok(Some((case.scene)()));
        }
        let load = |path| scene::file::load(path, self.changes.allow_outside);
        self.changes.scene.as_deref().map(load).transpose()
    }

    /// A scene that a lab has no use for is wrong in its file, not on the command line.
    fn about_scene(&self, error: Error) -> Error {
        match (&self.changes.scene, error) {
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

    /// Where the light (from 1) arrives in the last of so many frames, by the state's own test.
    pub fn visibility(&mut self, frames: u32, light: usize) -> Result<Shadows> {
        if frames > 1 {
            self.draw(frames - 1, Show::Picture)?;
            self.lab.advance(FRAME);
        }
        let shadows = own_shaders::visibility(self.lab.as_mut(), &self.context, self.size, light)?;
        gl::check_errors(&self.context.gl, "drawing")?;
        Ok(shadows)
    }
}
