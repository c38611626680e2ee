//! A lab in an open window: keys and mouse, frames and time.
//!
//! A frame is drawn when something has changed or moves. Otherwise the program sleeps until the next event.

use std::io::Write;
use std::time::{Duration, Instant};

use notify::RecommendedWatcher;
use winit::dpi::PhysicalPosition;
use winit::event::{ElementState, KeyEvent, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::keyboard::ModifiersState;

use super::canvas::Canvas;
use super::keys::{self, Own};
use super::panels::{Panels, Shown};
use super::trial::{self, Trial};
use super::{View, shot, watch};
use crate::labs::{Button, Handout, Input, Lab, Pointer, Show};
use crate::{Result, gl, picture};

/// How long the folder of shaders must be quiet before it is read: a save is several events, and an editor may empty a
/// file before it writes it.
const QUIET: Duration = Duration::from_millis(30);
/// How often the title is written.
const TITLE: Duration = Duration::from_millis(500);
/// Pixels of a touch pad's scrolling that count as one step of a wheel.
const WHEEL_STEP: f64 = 40.0;

/// After an event.
pub enum Next {
    GoOn,
    End,
}

pub struct Viewer {
    // GL objects go before their context does.
    lab: Box<dyn Lab>,
    panels: Panels,
    canvas: Canvas,
    handout: &'static Handout,
    _watcher: Option<RecommendedWatcher>,
    /// In pixels, as the desktop last told it.
    size: [u32; 2],
    /// Nothing of the window is to be seen.
    hidden: bool,

    /// What stands over the picture.
    shown: Shown,
    /// A screenshot is wanted of the next frame.
    shot: bool,
    reload_at: Option<Instant>,
    /// Of the shaders that were saved last.
    trial: Option<Trial>,

    /// What draws the same picture again.
    options: Vec<String>,
    inputs: Vec<Input>,
    /// In seconds.
    time: f64,
    /// How much of it the waits among the inputs tell.
    waited: f64,

    paused: bool,
    vsync: bool,
    /// When the last frame began, while frames follow each other.
    last_frame: Option<Instant>,
    next_frame: Option<Instant>,
    frames: u64,
    most_frames: Option<u64>,
    title: Title,

    modifiers: ModifiersState,
    mouse: Mouse,
}

/// What the title says of the frames since it was written.
#[derive(Default)]
struct Title {
    written: Option<Instant>,
    frames: u32,
    drawing: Duration,
}

#[derive(Default)]
struct Mouse {
    /// In whole pixels, once the pointer has been over the window.
    position: Option<[i32; 2]>,
    held: Option<Button>,
    /// Movements that no frame has shown yet, so that a fast mouse makes one drag of each frame.
    moved: [i32; 2],
    scrolled: f64,
}

impl Viewer {
    /// `saved` is called, on another thread, when a shader of the student's has been written.
    pub fn open(
        event_loop: &ActiveEventLoop,
        view: View,
        saved: impl Fn() + Send + 'static,
    ) -> Result<Self> {
        let canvas = Canvas::open(event_loop, &view)?;
        let panels = Panels::new(&canvas.gl)?;
        let glsl = view.glsl.as_deref();
        let mut lab = (view.handout.start)(&canvas.gl, view.scene, glsl)?;
        let size = canvas.size();
        if !size.contains(&0) {
            lab.resize(size);
        }
        (view.prepare)(lab.as_mut())?;
        let watcher = glsl.map(|folder| watch::watch(folder, saved)).transpose()?;
        tell(&format!(
            "{} in a window, {}, {}; the key ? shows the keys",
            view.handout.name, canvas.renderer, canvas.api
        ));
        canvas.window.request_redraw();
        Ok(Self {
            lab,
            panels,
            canvas,
            handout: view.handout,
            _watcher: watcher,
            size,
            hidden: false,
            shown: Shown::default(),
            shot: false,
            reload_at: None,
            trial: None,
            options: view.options,
            inputs: view.inputs,
            time: view.time,
            waited: 0.0,
            paused: false,
            vsync: view.vsync,
            last_frame: None,
            next_frame: None,
            frames: 0,
            most_frames: view.frames,
            title: Title::default(),
            modifiers: ModifiersState::empty(),
            mouse: Mouse::default(),
        })
    }

    pub fn take(&mut self, event: WindowEvent) -> Result<Next> {
        match event {
            WindowEvent::CloseRequested => return Ok(Next::End),
            WindowEvent::RedrawRequested => return self.draw(),
            WindowEvent::Resized(size) => self.resize([size.width, size.height]),
            WindowEvent::Occluded(hidden) => {
                self.hidden = hidden;
                self.canvas.window.request_redraw();
            }
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::KeyboardInput {
                event,
                is_synthetic: false,
                ..
            } => return Ok(self.press(&event)),
            WindowEvent::MouseInput { state, button, .. } => {
                self.drag();
                let pressed = state == ElementState::Pressed;
                self.mouse.held = keys::button(button).filter(|_| pressed);
            }
            WindowEvent::CursorMoved { position, .. } => self.move_mouse(position),
            WindowEvent::MouseWheel { delta, .. } => self.scroll(delta),
            _ => {}
        }
        Ok(Next::GoOn)
    }

    // ---- Keys and mouse ----

    fn press(&mut self, event: &KeyEvent) -> Next {
        let others = ModifiersState::CONTROL | ModifiersState::ALT | ModifiersState::SUPER;
        if event.state != ElementState::Pressed || self.modifiers.intersects(others) {
            return Next::GoOn;
        }
        if let Some(own) = keys::own(&event.logical_key) {
            // Held down, a switch would flicker.
            if event.repeat {
                return Next::GoOn;
            }
            match own {
                Own::Help => self.shown.help = !self.shown.help,
                Own::DepthMap => self.next_depth_map(),
                Own::Pause => self.paused = !self.paused,
                Own::Screenshot => self.shot = true,
                Own::End => return Next::End,
            }
            // The title says whether time stands still.
            self.title.written = None;
            self.canvas.window.request_redraw();
        } else if let Some(key) = keys::key(&event.logical_key) {
            if self.handout.quit == Some(key) {
                return Next::End;
            }
            self.drag();
            self.input(Input::Key(key));
        }
        Next::GoOn
    }

    /// None, the first light's, and so on to the last light's.
    fn next_depth_map(&mut self) {
        let next = self.shown.depth_map.map_or(1, |light| light + 1);
        self.shown.depth_map = (next <= self.handout.lights).then_some(next);
    }

    /// What the lab has no use for is not kept either.
    fn input(&mut self, input: Input) {
        if self.lab.input(input) {
            if self.lab.keys_ask_time() && self.time > self.waited {
                self.inputs.push(Input::Wait(self.time - self.waited));
                self.waited = self.time;
            }
            self.inputs.push(input);
            self.canvas.window.request_redraw();
        }
    }

    fn move_mouse(&mut self, position: PhysicalPosition<f64>) {
        let now = [position.x.round() as i32, position.y.round() as i32];
        let before = self.mouse.position.replace(now).unwrap_or(now);
        if self.mouse.held.is_some() {
            self.mouse.moved[0] += now[0] - before[0];
            self.mouse.moved[1] += now[1] - before[1];
            self.canvas.window.request_redraw();
        }
    }

    /// Hands the lab what the mouse has moved since.
    fn drag(&mut self) {
        let [dx, dy] = std::mem::take(&mut self.mouse.moved);
        if let Some(button) = self.mouse.held
            && [dx, dy] != [0, 0]
        {
            self.input(Input::Pointer(Pointer::Drag { button, dx, dy }));
        }
    }

    fn scroll(&mut self, delta: MouseScrollDelta) {
        self.mouse.scrolled += match delta {
            MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / WHEEL_STEP,
        };
        let steps = self.mouse.scrolled.trunc();
        self.mouse.scrolled -= steps;
        if steps != 0.0 {
            self.drag();
            self.input(Input::Pointer(Pointer::Wheel(steps as i32)));
        }
    }

    // ---- Frames and time ----

    fn moves(&self) -> bool {
        self.lab.moves() && !self.paused
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
        if !self.is_visible() || !(self.moves() || self.most_frames.is_some()) {
            self.last_frame = None;
            self.next_frame = None;
        } else if self.next_frame.is_none_or(|at| at <= now) {
            self.next_frame = None;
            self.canvas.window.request_redraw();
        }
        let look_again = self.trial.as_ref().map(|_| now + trial::PATIENCE);
        match [self.reload_at, self.next_frame, look_again]
            .into_iter()
            .flatten()
            .min()
        {
            Some(at) => ControlFlow::WaitUntil(at),
            None => ControlFlow::Wait,
        }
    }

    fn resize(&mut self, size: [u32; 2]) {
        // A minimised window may have no pixels: the lab keeps the size that it had.
        self.size = size;
        if !size.contains(&0) {
            self.canvas.resize(size);
            self.lab.resize(size);
            self.canvas.window.request_redraw();
        }
    }

    fn is_visible(&self) -> bool {
        !self.size.contains(&0) && !self.hidden
    }

    pub fn reload_soon(&mut self) {
        self.reload_at = Some(Instant::now() + QUIET);
    }

    /// Has the state drawn with the saved shaders elsewhere, where no window hangs on it.
    fn try_shaders(&mut self) {
        // The one that still draws has older shaders.
        self.trial = None;
        match Trial::start(&self.state()) {
            Ok(trial) => self.trial = Some(trial),
            Err(error) => self.shown.message = Some(error.to_string()),
        }
    }

    /// Takes the saved shaders, if they have drawn a picture; else goes on with those that it has.
    fn reload(&mut self, tried: Result<()>) {
        let reloaded = tried.and_then(|()| self.lab.reload(&self.canvas.gl));
        let error = reloaded.err();
        self.shown.message = error.map(|error| error.to_string());
        self.canvas.window.request_redraw();
    }

    fn draw(&mut self) -> Result<Next> {
        if !self.is_visible() {
            return Ok(Next::GoOn);
        }
        self.drag();
        let began = Instant::now();
        if self.moves() {
            let before = self.last_frame.replace(began).unwrap_or(began);
            let dt = (began - before).as_secs_f64();
            self.lab.advance(dt);
            self.time += dt;
        }
        let gl = &self.canvas.gl;
        self.lab.render(gl, Show::Picture)?;
        gl::check_errors(gl, "drawing")?;
        // The title tells how long the lab draws, not how long the screen lets it wait.
        self.canvas.finish();
        self.title.frames += 1;
        self.title.drawing += began.elapsed();
        if std::mem::take(&mut self.shot)
            && let Err(error) = self.shoot()
        {
            self.shown.message = Some(error.to_string());
        }
        let scale = self.canvas.window.scale_factor();
        let (gl, lab) = (&self.canvas.gl, self.lab.as_ref());
        self.panels
            .draw(gl, &self.shown, self.handout, lab, self.size, scale);
        self.canvas.show()?;
        self.write_title();

        // Where the driver does not wait for the screen, as no software renderer does, the clock does it.
        let period = self.canvas.period();
        if self.vsync && began.elapsed() < period / 2 {
            self.next_frame = Some(began + period);
        }
        Ok(self.count())
    }

    /// Whether this was the last of the frames that were asked for.
    fn count(&mut self) -> Next {
        self.frames += 1;
        match self.most_frames {
            Some(most) => {
                if self.frames.is_multiple_of(1000) {
                    tell(&format!("{} frames", self.frames));
                }
                if self.frames < most {
                    Next::GoOn
                } else {
                    Next::End
                }
            }
            None => Next::GoOn,
        }
    }

    fn write_title(&mut self) {
        if self.title.written.is_some_and(|at| at.elapsed() < TITLE) {
            return;
        }
        let milliseconds = 1000.0 * self.title.drawing.as_secs_f64() / f64::from(self.title.frames);
        let paused = if self.paused { ", paused" } else { "" };
        self.canvas.window.set_title(&format!(
            "{}, {milliseconds:.1} ms a frame{paused}, {}",
            self.handout.name, self.canvas.renderer
        ));
        self.title = Title {
            written: Some(Instant::now()),
            ..Title::default()
        };
    }

    fn state(&self) -> shot::State<'_> {
        shot::State {
            lab: self.handout.name,
            size: self.size,
            options: &self.options,
            inputs: &self.inputs,
            time: self.time - self.waited,
        }
    }

    /// The lab's picture as it stands in the back buffer, before anything is drawn over it.
    fn shoot(&self) -> Result<()> {
        let pixels = gl::read_rgb(&self.canvas.gl, self.size);
        let name = shot::free_name(self.handout.name);
        picture::write_rgb(&name, &pixels, &picture::notes(&self.canvas.renderer))?;
        let line = shot::command_line(&self.state());
        tell(&format!("{}\n{line}", name.display()));
        Ok(())
    }
}

/// A line on standard output. A closed pipe is no reason to close the window.
fn tell(text: &str) {
    let mut output = std::io::stdout();
    let _ = writeln!(output, "{text}").and_then(|()| output.flush());
}
