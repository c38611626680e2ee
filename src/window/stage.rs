//! The lab on the window's stage: how it is started, with a mistake or without, and everything that was done to it since,
//! so that it can be started again in the same state and a command line can draw the same picture.

use std::path::PathBuf;

use super::canvas::Canvas;
use super::{Prepare, View, shot};
use crate::Result;
use crate::gl::edits::{self, Edited, Edits};
use crate::labs::{Handout, Input, Kind, Lab};
use crate::mistakes::Mistake;
use crate::scene::Scene;

pub struct Stage {
    // GL objects go before their context does, which the viewer holds.
    pub lab: Box<dyn Lab>,
    pub handout: &'static Handout,
    pub mistake: Option<&'static Mistake>,
    pub glsl: Option<PathBuf>,
    /// While it lives, the mistake is made. Only between two mistakes there is none.
    edited: Option<Edited>,
    scene: Scene,
    prepare: Prepare,
    size: [u32; 2],

    options: Vec<String>,
    inputs: Vec<Input>,
    /// In seconds.
    time: f64,
    /// How much of it the waits among the inputs tell.
    waited: f64,
    /// Counts whatever may change the picture.
    changes: u64,
}

impl Stage {
    /// `size` is that of the picture, in pixels; `edited` is what [`make`] returned before the context was made.
    pub fn open(view: View, edited: Edited, canvas: &Canvas, size: [u32; 2]) -> Result<Self> {
        let lab = (view.handout.start)(&canvas.gl, view.scene.clone(), view.glsl.as_deref())?;
        let mut stage = Self {
            lab,
            handout: view.handout,
            mistake: view.mistake,
            glsl: view.glsl,
            edited: Some(edited),
            scene: view.scene,
            prepare: view.prepare,
            size,
            options: view.options,
            inputs: view.inputs,
            time: view.time,
            waited: 0.0,
            changes: 0,
        };
        stage.bring()?;
        Ok(stage)
    }

    /// Starts the lab again, with this mistake or without any, and brings it to where it was. It gets a context of its
    /// own: a mistake leaves something behind.
    pub fn restart(
        &mut self,
        canvas: &mut Canvas,
        mistake: Option<&'static Mistake>,
    ) -> Result<()> {
        self.edited = None;
        self.edited = Some(make(mistake, self.handout));
        self.mistake = mistake;
        canvas.renew()?;
        let (scene, glsl) = (self.scene.clone(), self.glsl.as_deref());
        self.lab = (self.handout.start)(&canvas.gl, scene, glsl)?;
        self.changes += 1;
        self.bring()
    }

    /// Brings a new lab to where the person has brought the one before it.
    fn bring(&mut self) -> Result<()> {
        if !self.size.contains(&0) {
            self.lab.resize(self.size);
        }
        (self.prepare)(self.lab.as_mut(), &self.inputs, self.time - self.waited)
    }

    /// The size of the picture, in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    pub fn resize(&mut self, size: [u32; 2]) {
        // A minimised window may have no pixels: the lab keeps the size that it had.
        if size != self.size && !size.contains(&0) {
            self.size = size;
            self.lab.resize(size);
            self.changes += 1;
        }
    }

    /// A number that is another one whenever the picture may be another one.
    pub fn changes(&self) -> u64 {
        self.changes
    }

    pub fn advance(&mut self, dt: f64) {
        self.lab.advance(dt);
        self.time += dt;
        self.changes += 1;
    }

    pub fn reload(&mut self, gl: &glow::Context) -> Result<()> {
        self.changes += 1;
        self.lab.reload(gl)
    }

    /// Whether the lab has a use for it. What it has no use for is not kept either.
    pub fn input(&mut self, input: Input) -> bool {
        let used = self.lab.input(input.clone());
        if used {
            self.changes += 1;
            self.keep(input);
        }
        used
    }

    fn keep(&mut self, input: Input) {
        let number = number_of(&input, self.handout);
        let is_choice = matches!(input, Input::Set(_)) && number.is_none();
        if (self.lab.keys_ask_time() || is_choice) && self.time > self.waited {
            self.inputs.push(Input::Wait(self.time - self.waited));
            self.waited = self.time;
        }
        // A slider that is dragged is at one place in the end.
        let last = self.inputs.last();
        if number.is_some() && last.and_then(|last| number_of(last, self.handout)) == number {
            self.inputs.pop();
        }
        self.inputs.push(input);
    }

    /// The state that another command line is to draw.
    pub fn with_state<T>(&self, use_it: impl FnOnce(&shot::State) -> T) -> T {
        let mut options = self.options.clone();
        if let Some(mistake) = self.mistake {
            options.extend(["--mistake".to_owned(), mistake.name.to_owned()]);
        }
        use_it(&shot::State {
            lab: self.handout.name,
            size: self.size,
            options: &options,
            inputs: &self.inputs,
            time: self.time - self.waited,
        })
    }
}

/// Makes the mistake, or none, as long as what is returned lives.
pub fn make(mistake: Option<&Mistake>, handout: &Handout) -> Edited {
    let made = mistake.and_then(|mistake| mistake.made(handout.name));
    edits::set(made.map_or(Edits::default(), |made| made.edits))
}

/// The number setting that an input sets.
fn number_of<'a>(input: &'a Input, handout: &Handout) -> Option<&'a str> {
    let Input::Set(assignment) = input else {
        return None;
    };
    let (name, _) = assignment.split_once('=')?;
    let is_number = |kind: &Kind| matches!(kind, Kind::Number { .. });
    let mut settings = handout.settings.iter();
    settings
        .any(|setting| setting.name == name && is_number(&setting.kind))
        .then_some(name)
}
