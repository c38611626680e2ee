//! The panel beside the picture, to look inside: hidden until its key is pressed.
//!
//! It draws with a context of its own into the same window, so that whatever it does there the lab's state is the lab's.
//! Hidden, it makes no call.
//!
//! | file | what it shows |
//! |---|---|
//! | `settings` | every setting of the lab's one table |
//! | `mistakes` | the classic mistakes, one at a time |
//! | `passes` | how long each pass takes |
//! | `shadows` | visibility, the depth map, and what is wrong by the rays |
//! | `pixel`, `texels` | what `shadowlab explain` prints, and the texels around the look-up |
//! | `draw` | a frame of it |
//! | `rows`, `track`, `look` | what all of them are made of |
//! | `truth` | the rays, on threads of their own |

mod draw;
mod look;
mod mistakes;
mod passes;
mod pixel;
mod rows;
mod settings;
mod shadows;
mod texels;
mod track;
mod truth;

use std::time::Instant;

use egui::{Context, ViewportId};
use egui_glow::Painter;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::app::Wake;
use super::canvas::{Beside, Canvas};
use crate::labs::{Handout, Settings};
use crate::mistakes::Mistake;
use crate::{Error, Result};

/// In logical pixels: what the longest line of an explanation needs.
const WIDTH: f64 = 400.0;

/// What a person has done in the panel.
pub enum Wish {
    /// `name=value`
    Set(String),
    /// The lab with this mistake, or without any.
    Mistake(Option<&'static Mistake>),
    /// The depth map of this light over the picture, or of none.
    DepthMap(Option<usize>),
}

/// What the viewer shows.
pub struct Seen {
    /// The window's size in pixels.
    pub window: [u32; 2],
    /// The light whose depth map is shown.
    pub depth_map: Option<usize>,
}

#[derive(Clone, Copy, PartialEq)]
enum Tab {
    Settings,
    Mistakes,
    Passes,
    Shadows,
    Pixel,
}

const TABS: [(Tab, &str); 5] = [
    (Tab::Settings, "settings"),
    (Tab::Mistakes, "mistakes"),
    (Tab::Passes, "passes"),
    (Tab::Shadows, "shadows"),
    (Tab::Pixel, "pixel"),
];

/// What the tabs know of the lab.
struct Facts<'a> {
    handout: &'static Handout,
    settings: &'a Settings,
    mistake: Option<&'static Mistake>,
    /// Whether the shaders are a student's own.
    own_shaders: bool,
    /// The picture's size in pixels.
    picture: [u32; 2],
    depth_map: Option<usize>,
    /// See `Stage::changes`.
    changes: u64,
}

pub struct Panel {
    egui: Context,
    events: egui_winit::State,
    painter: Painter,
    beside: Beside,

    is_open: bool,
    has_keys: bool,
    tab: Tab,
    /// The row of tabs gets the keyboard's focus.
    focus_tabs: bool,
    next_frame: Option<Instant>,

    /// From 1; the one that the tabs about shadows and pixels are about.
    light: usize,
    settings: settings::Tab,
    mistakes: mistakes::Tab,
    passes: passes::Tab,
    shadows: shadows::Tab,
    pixel: pixel::Tab,
}

impl Panel {
    pub fn new(canvas: &Canvas, wake: EventLoopProxy<Wake>) -> Result<Self> {
        let beside = canvas.beside()?;
        let mut painter = Err(Error::gl("the panel has no context"));
        let gl = beside.gl.clone();
        canvas.draw_beside(&beside, || {
            painter = Painter::new(gl, "", None, false)
                .map_err(|error| Error::gl(format!("the panel cannot be drawn: {error}")));
        })?;
        let painter = painter?;
        let egui = Context::default();
        look::apply(&egui);
        let window = &canvas.window;
        let mut events = egui_winit::State::new(
            egui.clone(),
            ViewportId::ROOT,
            window,
            Some(window.scale_factor() as f32),
            None,
            Some(painter.max_texture_side()),
        );
        events.egui_input_mut().focused = true;
        Ok(Self {
            egui,
            events,
            painter,
            beside,
            is_open: false,
            has_keys: false,
            tab: Tab::Settings,
            focus_tabs: false,
            next_frame: None,
            light: 1,
            settings: settings::Tab::default(),
            mistakes: mistakes::Tab::default(),
            passes: passes::Tab::default(),
            shadows: shadows::Tab::new(wake),
            pixel: pixel::Tab::default(),
        })
    }

    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Whether keys are the panel's and not the lab's.
    pub fn has_keys(&self) -> bool {
        self.is_open && self.has_keys
    }

    /// In pixels.
    pub fn width(&self, scale: f64) -> u32 {
        (WIDTH * scale).round() as u32
    }

    /// Opens the panel, gives an open one the keyboard, or closes it. Whether it opened or closed.
    pub fn press_key(&mut self) -> bool {
        let closes = self.has_keys();
        let changes = closes || !self.is_open;
        self.is_open = !closes;
        self.take_keys(!closes);
        self.focus_tabs = !closes;
        changes
    }

    /// Gives the keyboard back, or closes the panel. Whether it closed.
    pub fn leave(&mut self) -> bool {
        if self.has_keys {
            self.take_keys(false);
            return false;
        }
        self.is_open = false;
        true
    }

    fn take_keys(&mut self, keys: bool) {
        self.has_keys = keys;
        if !keys {
            self.egui.memory_mut(|memory| {
                if let Some(focused) = memory.focused() {
                    memory.surrender_focus(focused);
                }
            });
        }
    }

    /// When the panel wants to be drawn again, by itself.
    pub fn next_frame(&mut self) -> Option<Instant> {
        self.next_frame.filter(|_| self.is_open)
    }

    // ---- Events ----

    /// Whether an event is the panel's alone; `pointer` is in pixels from the window's top left.
    pub fn take(
        &mut self,
        window: &Window,
        event: &WindowEvent,
        pointer: Option<[i32; 2]>,
    ) -> bool {
        if !self.is_open {
            return false;
        }
        let left = f64::from(window.inner_size().width) - self.width(window.scale_factor()) as f64;
        let is_over = pointer.is_some_and(|[x, _]| f64::from(x) >= left);
        let is_drawn_on = self.egui.is_using_pointer();
        match event {
            WindowEvent::KeyboardInput { .. } if !self.has_keys => return false,
            WindowEvent::MouseInput { state, .. } => {
                if *state == ElementState::Pressed {
                    self.take_keys(is_over);
                }
                if !is_over && !is_drawn_on {
                    return false;
                }
            }
            WindowEvent::MouseWheel { .. } if !is_over => return false,
            WindowEvent::RedrawRequested | WindowEvent::CloseRequested => return false,
            _ => {}
        }
        let response = self.events.on_window_event(window, event);
        let is_own = match event {
            WindowEvent::KeyboardInput { .. }
            | WindowEvent::MouseInput { .. }
            | WindowEvent::MouseWheel { .. } => true,
            WindowEvent::CursorMoved { .. } => is_over || is_drawn_on,
            _ => false,
        };
        if response.repaint && !is_own {
            self.next_frame = Some(Instant::now());
        }
        is_own
    }

    /// The pointer is at a place, in pixels from the picture's top left. Whether something hangs on it.
    pub fn point(&mut self, place: [i32; 2], picture: [u32; 2]) -> bool {
        self.is_open && self.tab == Tab::Pixel && self.pixel.point(place, picture)
    }

    /// The picture was clicked at.
    pub fn pin(&mut self) {
        if self.is_open && self.tab == Tab::Pixel {
            self.pixel.pin();
        }
    }
}
