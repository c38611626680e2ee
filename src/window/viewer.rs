//! A lab in an open window: what keys and mouse do. Frames and time are in `frame`.

use std::io::Write;
use std::time::{Duration, Instant};

use notify::RecommendedWatcher;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::keyboard::ModifiersState;

use super::app::Wake;
use super::canvas::Canvas;
use super::frame::Pace;
use super::keys::{self, Own};
use super::mouse::Mouse;
use super::panel::{Panel, Wish};
use super::panels::{Panels, Shown};
use super::stage::{self, Stage};
use super::trial::Trial;
use super::{View, watch};
use crate::Result;
use crate::labs::{Input, Pointer};

/// How long the folder of shaders must be quiet before it is read: a save is several events, and an editor may empty a
/// file before it writes it.
const QUIET: Duration = Duration::from_millis(30);

/// After an event.
pub enum Next {
    GoOn,
    End,
}

pub struct Viewer {
    // GL objects go before their contexts do.
    pub(super) stage: Stage,
    pub(super) panels: Panels,
    /// None until somebody has asked for it: then neither its context nor its letters are made.
    pub(super) panel: Option<Panel>,
    pub(super) canvas: Canvas,
    _watcher: Option<RecommendedWatcher>,
    wake: EventLoopProxy<Wake>,
    /// Of the window in pixels, as the desktop last told it: the picture's and the panel's beside it.
    pub(super) size: [u32; 2],
    /// Nothing of the window is to be seen.
    pub(super) hidden: bool,
    /// When the window must have the size that was asked for; else the picture takes the one that it has.
    pub(super) fit_at: Option<Instant>,

    /// What stands over the picture.
    pub(super) shown: Shown,
    /// A screenshot is wanted of the next frame.
    pub(super) shot: bool,
    pub(super) reload_at: Option<Instant>,
    /// Of the shaders that were saved last.
    pub(super) trial: Option<Trial>,
    pub(super) paused: bool,
    pub(super) pace: Pace,

    modifiers: ModifiersState,
    mouse: Mouse,
}

impl Viewer {
    pub fn open(
        event_loop: &ActiveEventLoop,
        view: View,
        wake: EventLoopProxy<Wake>,
    ) -> Result<Self> {
        let pace = Pace::new(&view);
        let edited = stage::make(view.mistake, view.handout);
        let canvas = Canvas::open(event_loop, &view)?;
        let panels = Panels::new(&canvas.gl)?;
        let size = canvas.size();
        let stage = Stage::open(view, edited, &canvas, size)?;
        let saved = wake.clone();
        // The window may have closed since: then nobody needs to know.
        let saved = move || drop(saved.send_event(Wake::Saved));
        let folder = stage.glsl.as_deref();
        let watcher = folder
            .map(|folder| watch::watch(folder, saved))
            .transpose()?;
        tell(&format!(
            "{} in a window, {}, {}; the key ? shows the keys",
            stage.handout.name, canvas.renderer, canvas.api
        ));
        canvas.window.request_redraw();
        Ok(Self {
            stage,
            panels,
            panel: None,
            canvas,
            _watcher: watcher,
            wake,
            size,
            hidden: false,
            fit_at: None,
            shown: Shown::default(),
            shot: false,
            reload_at: None,
            trial: None,
            paused: false,
            pace,
            modifiers: ModifiersState::empty(),
            mouse: Mouse::default(),
        })
    }

    pub fn take(&mut self, event: WindowEvent) -> Result<Next> {
        if let WindowEvent::ModifiersChanged(modifiers) = &event {
            self.modifiers = modifiers.state();
        }
        if let WindowEvent::CursorMoved { position, .. } = event {
            self.point(position);
        }
        if let WindowEvent::KeyboardInput {
            event,
            is_synthetic: false,
            ..
        } = &event
            && let Some(next) = self.press_own(event)?
        {
            return Ok(next);
        }
        // What the panel has a use for is not the lab's.
        if let Some(panel) = &mut self.panel
            && panel.take(&self.canvas.window, &event, self.mouse.position)
        {
            self.canvas.window.request_redraw();
            return Ok(Next::GoOn);
        }
        match event {
            WindowEvent::CloseRequested => return Ok(Next::End),
            WindowEvent::RedrawRequested => return self.draw(),
            WindowEvent::Resized(size) => self.resize([size.width, size.height]),
            WindowEvent::Occluded(hidden) => {
                self.hidden = hidden;
                self.canvas.window.request_redraw();
            }
            WindowEvent::KeyboardInput {
                event,
                is_synthetic: false,
                ..
            } => {
                return Ok(self.press(&event));
            }
            WindowEvent::MouseInput { state, button, .. } => {
                self.drag();
                if self.mouse.press(state, button) {
                    self.pin();
                }
            }
            WindowEvent::MouseWheel { delta, .. } => {
                if let Some(wheel) = self.mouse.scroll(delta) {
                    self.drag();
                    self.input(Input::Pointer(wheel));
                }
            }
            _ => {}
        }
        Ok(Next::GoOn)
    }

    pub fn wake(&mut self, wake: Wake) {
        match wake {
            Wake::Saved => self.reload_at = Some(Instant::now() + QUIET),
            Wake::Truth => self.canvas.window.request_redraw(),
        }
    }

    // ---- Keys and mouse ----

    fn is_plain_press(&self, event: &KeyEvent) -> bool {
        let others = ModifiersState::CONTROL | ModifiersState::ALT | ModifiersState::SUPER;
        event.state == ElementState::Pressed && !self.modifiers.intersects(others)
    }

    /// The viewer's own keys; None where it is no such key, or one that the panel needs.
    fn press_own(&mut self, event: &KeyEvent) -> Result<Option<Next>> {
        let own = keys::own(&event.logical_key).filter(|_| self.is_plain_press(event));
        let panel_has_keys = self.panel.as_ref().is_some_and(Panel::has_keys);
        let Some(own) = own.filter(|own| !panel_has_keys || own.is_of_window()) else {
            return Ok(None);
        };
        // Held down, a switch would flicker.
        if event.repeat {
            return Ok(Some(Next::GoOn));
        }
        match own {
            Own::Help => self.shown.help = !self.shown.help,
            Own::DepthMap => self.next_depth_map(),
            Own::Pause => self.paused = !self.paused,
            Own::Screenshot => self.shot = true,
            Own::Panel => self.press_panel_key(),
            Own::End => {
                if !self.leave_panel() {
                    return Ok(Some(Next::End));
                }
            }
        }
        // The title says whether time stands still.
        self.pace.write_title_soon();
        self.canvas.window.request_redraw();
        Ok(Some(Next::GoOn))
    }

    fn press(&mut self, event: &KeyEvent) -> Next {
        if self.is_plain_press(event)
            && let Some(key) = keys::key(&event.logical_key)
        {
            if self.stage.handout.quit == Some(key) {
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
        self.shown.depth_map = (next <= self.stage.handout.lights).then_some(next);
    }

    fn input(&mut self, input: Input) {
        if self.stage.input(input) {
            self.canvas.window.request_redraw();
        }
    }

    fn point(&mut self, position: winit::dpi::PhysicalPosition<f64>) {
        let dragged = self.mouse.move_to(position);
        let watched = match (&mut self.panel, self.mouse.position) {
            (Some(panel), Some(place)) if !dragged => panel.point(place, self.stage.size()),
            _ => false,
        };
        if dragged || watched {
            self.canvas.window.request_redraw();
        }
    }

    /// Hands the lab what the mouse has moved since.
    pub(super) fn drag(&mut self) {
        if let Some(drag @ Pointer::Drag { .. }) = self.mouse.drag() {
            self.input(Input::Pointer(drag));
        }
    }

    // ---- The panel ----

    /// The key opens the panel and gives it the keyboard; where the panel has that, it closes.
    fn press_panel_key(&mut self) {
        if self.panel.is_none() {
            match Panel::new(&self.canvas, self.wake.clone()) {
                Ok(panel) => self.panel = Some(panel),
                Err(error) => self.shown.message = Some(error.to_string()),
            }
        }
        if self.panel.as_mut().is_some_and(Panel::press_key) {
            self.widen();
        }
    }

    /// One step out of the panel: the keyboard goes back to the lab, and then the panel closes. False where there is none.
    fn leave_panel(&mut self) -> bool {
        let Some(panel) = self.panel.as_mut().filter(|panel| panel.is_open()) else {
            return false;
        };
        if panel.leave() {
            self.widen();
        }
        true
    }

    /// A click on the picture keeps the pixel, or lets it go.
    fn pin(&mut self) {
        if let Some(panel) = &mut self.panel {
            panel.pin();
            self.canvas.window.request_redraw();
        }
    }

    /// What a person has done in the panel.
    pub(super) fn grant(&mut self, wish: Wish) -> Result<()> {
        match wish {
            Wish::Set(assignment) => self.set(assignment),
            Wish::Mistake(mistake) => {
                self.stage.restart(&mut self.canvas, mistake)?;
                self.panels = Panels::new(&self.canvas.gl)?;
            }
            Wish::DepthMap(light) => self.shown.depth_map = light,
        }
        self.canvas.window.request_redraw();
        Ok(())
    }
}

/// A line on standard output. A closed pipe is no reason to close the window.
pub(super) fn tell(text: &str) {
    let mut output = std::io::stdout();
    let _ = writeln!(output, "{text}").and_then(|()| output.flush());
}
