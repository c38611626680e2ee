//! Frames and time.
//!
//! A frame is drawn when something has changed or moves. Otherwise the program sleeps until the next event.

use std::time::{Duration, Instant};

use winit::dpi::PhysicalSize;
use winit::event_loop::ControlFlow;

use super::View;
use super::panel::Seen;
use super::shot;
use super::trial::{self, Trial};
use super::viewer::{Next, Viewer, tell};
use crate::labs::{Input, Show};
use crate::{Result, gl, picture};

/// How often the title is written.
const TITLE: Duration = Duration::from_millis(500);
/// How long a desktop may take to give the window another size.
const FIT: Duration = Duration::from_millis(500);

/// When frames follow each other, and how many.
pub struct Pace {
    vsync: bool,
    /// When the last frame began, while frames follow each other.
    last: Option<Instant>,
    next: Option<Instant>,
    frames: u64,
    most: Option<u64>,
    title: Title,
}

/// What the title says of the frames since it was written.
#[derive(Default)]
struct Title {
    written: Option<Instant>,
    frames: u32,
    drawing: Duration,
}

impl Pace {
    pub fn new(view: &View) -> Self {
        Self {
            vsync: view.vsync,
            last: None,
            next: None,
            frames: 0,
            most: view.frames,
            title: Title::default(),
        }
    }

    pub fn write_title_soon(&mut self) {
        self.title.written = None;
    }
}

impl Viewer {
    fn moves(&self) -> bool {
        self.stage.lab.moves() && !self.paused
    }

    /// Asks for the next frame where there is to be one, and says how long the program may sleep.
    pub fn wait(&mut self) -> ControlFlow {
        let now = Instant::now();
        if self.reload_at.is_some_and(|at| at <= now) {
            self.reload_at = None;
            self.try_shaders();
        }
        if let Some(tried) = self.trial.as_mut().and_then(Trial::result) {
            self.trial = None;
            self.reload(tried);
        }
        if self.fit_at.is_some_and(|at| at <= now) {
            self.fit();
        }
        if !self.is_visible() || !(self.moves() || self.pace.most.is_some()) {
            self.pace.last = None;
            self.pace.next = None;
        } else if self.pace.next.is_none_or(|at| at <= now) {
            self.pace.next = None;
            self.canvas.window.request_redraw();
        }
        let panel = self.panel.as_mut().and_then(|panel| panel.next_frame());
        let panel = panel.filter(|_| self.is_visible());
        if panel.is_some_and(|at| at <= now) {
            self.canvas.window.request_redraw();
        }
        let look_again = self.trial.as_ref().map(|_| now + trial::PATIENCE);
        let times = [
            self.reload_at,
            self.fit_at,
            self.pace.next,
            panel,
            look_again,
        ];
        match times.into_iter().flatten().filter(|at| *at > now).min() {
            Some(at) => ControlFlow::WaitUntil(at),
            None => ControlFlow::Wait,
        }
    }

    fn is_visible(&self) -> bool {
        !self.size.contains(&0) && !self.hidden
    }

    // ---- Sizes ----

    pub(super) fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
        if !size.contains(&0) {
            self.canvas.resize(size);
            self.fit();
        }
    }

    /// The picture gets what the panel leaves of the window.
    fn fit(&mut self) {
        self.fit_at = None;
        let [width, height] = self.size;
        // A window without room for both has the panel over its picture.
        let picture = width.saturating_sub(self.panel_width()).max(1);
        self.stage.resize([picture, height]);
        self.canvas.window.request_redraw();
    }

    /// In pixels.
    fn panel_width(&self) -> u32 {
        let panel = self.panel.as_ref().filter(|panel| panel.is_open());
        panel.map_or(0, |panel| panel.width(self.canvas.window.scale_factor()))
    }

    /// Asks for a window that has room for the panel, or no longer has it: the picture keeps its size.
    pub(super) fn widen(&mut self) {
        let [width, height] = self.stage.size();
        let wanted = PhysicalSize::new(width + self.panel_width(), height);
        match self.canvas.window.request_inner_size(wanted) {
            Some(size) => self.resize(size.into()),
            None => self.fit_at = Some(Instant::now() + FIT),
        }
    }

    // ---- Saved shaders ----

    /// Has the state drawn with the saved shaders elsewhere, where no window hangs on it.
    fn try_shaders(&mut self) {
        // The one that still draws has older shaders.
        self.trial = None;
        match self.stage.with_state(Trial::start) {
            Ok(trial) => self.trial = Some(trial),
            Err(error) => self.shown.message = Some(error.to_string()),
        }
    }

    /// Takes the saved shaders, if they have drawn a picture; else goes on with those that it has.
    fn reload(&mut self, tried: Result<()>) {
        let reloaded = tried.and_then(|()| self.stage.reload(&self.canvas.gl));
        let error = reloaded.err();
        self.shown.message = error.map(|error| error.to_string());
        self.canvas.window.request_redraw();
    }

    // ---- A frame ----

    pub(super) fn draw(&mut self) -> Result<Next> {
        if !self.is_visible() {
            return Ok(Next::GoOn);
        }
        self.drag();
        let began = Instant::now();
        if self.moves() {
            let before = self.pace.last.replace(began).unwrap_or(began);
            self.stage.advance((began - before).as_secs_f64());
        }
        let gl = &self.canvas.gl;
        match &mut self.panel {
            // A screenshot is of the picture, whatever the panel shows in its place.
            Some(panel) if panel.is_open() && !self.shot => panel.draw_lab(gl, &mut self.stage)?,
            _ => self.stage.lab.render(gl, Show::Picture)?,
        }
        gl::check_errors(gl, "drawing")?;
        // The title tells how long the lab draws, not how long the screen lets it wait.
        self.canvas.finish();
        self.pace.title.frames += 1;
        self.pace.title.drawing += began.elapsed();
        if std::mem::take(&mut self.shot)
            && let Err(error) = self.shoot()
        {
            self.shown.message = Some(error.to_string());
        }
        let scale = self.canvas.window.scale_factor();
        let gl = &self.canvas.gl;
        self.panels.draw(gl, &self.shown, &self.stage, scale);
        self.draw_panel()?;
        self.canvas.show()?;
        self.write_title();

        // Where the driver does not wait for the screen, as no software renderer does, the clock does it.
        let period = self.canvas.period();
        if self.pace.vsync && began.elapsed() < period / 2 {
            self.pace.next = Some(began + period);
        }
        Ok(self.count())
    }

    /// The panel beside the picture, and what a person has done in it.
    fn draw_panel(&mut self) -> Result<()> {
        let Some(panel) = self.panel.as_mut().filter(|panel| panel.is_open()) else {
            return Ok(());
        };
        let seen = Seen {
            window: self.size,
            depth_map: self.shown.depth_map,
        };
        let wishes = panel.draw(&self.canvas, &mut self.stage, &seen)?;
        for wish in wishes {
            self.grant(wish)?;
        }
        Ok(())
    }

    /// Gives a setting another value. Where the lab cannot draw that, it keeps the value that it had.
    pub(super) fn set(&mut self, assignment: String) {
        let before = self.stage.lab.settings().clone();
        self.shown.message = None;
        self.stage.input(Input::Set(assignment));
        if let Err(error) = self.stage.lab.render(&self.canvas.gl, Show::Picture) {
            self.shown.message = Some(error.to_string());
            for old in before.differences(&self.stage.lab.settings().clone()) {
                self.stage.input(Input::Set(old));
            }
        }
    }

    /// Whether this was the last of the frames that were asked for.
    fn count(&mut self) -> Next {
        self.pace.frames += 1;
        match self.pace.most {
            Some(most) => {
                if self.pace.frames.is_multiple_of(1000) {
                    tell(&format!("{} frames", self.pace.frames));
                }
                if self.pace.frames < most {
                    Next::GoOn
                } else {
                    Next::End
                }
            }
            None => Next::GoOn,
        }
    }

    fn write_title(&mut self) {
        let title = &self.pace.title;
        if title.written.is_some_and(|at| at.elapsed() < TITLE) {
            return;
        }
        let milliseconds = 1000.0 * title.drawing.as_secs_f64() / f64::from(title.frames);
        let paused = if self.paused { ", paused" } else { "" };
        self.canvas.window.set_title(&format!(
            "{}, {milliseconds:.1} ms a frame{paused}, {}",
            self.stage.handout.name, self.canvas.renderer
        ));
        self.pace.title = Title {
            written: Some(Instant::now()),
            ..Title::default()
        };
    }

    /// The lab's picture as it stands in the back buffer, before anything is drawn over it.
    fn shoot(&self) -> Result<()> {
        let pixels = gl::read_rgb(&self.canvas.gl, self.stage.size());
        let name = shot::free_name(self.stage.handout.name);
        picture::write_rgb(&name, &pixels, &picture::notes(&self.canvas.renderer))?;
        let line = self.stage.with_state(shot::command_line);
        tell(&format!(
            "{}
{line}",
            name.display()
        ));
        Ok(())
    }
}
