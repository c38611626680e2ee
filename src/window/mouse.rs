//! The mouse over the picture, in whole pixels and whole steps, as a lab takes them.

use winit::dpi::PhysicalPosition;
use winit::event::{ElementState, MouseButton, MouseScrollDelta};

use super::keys;
use crate::labs::{Button, Pointer};

/// Pixels of a touch pad's scrolling that count as one step of a wheel.
const WHEEL_STEP: f64 = 40.0;

#[derive(Default)]
pub struct Mouse {
    /// In whole pixels from the window's top left, once the pointer has been over the window.
    pub position: Option<[i32; 2]>,
    held: Option<Button>,
    /// Where the left button went down.
    pressed_at: Option<[i32; 2]>,
    /// Movements that no frame has shown yet, so that a fast mouse makes one drag of each frame.
    moved: [i32; 2],
    scrolled: f64,
}

impl Mouse {
    /// Whether a button is held that drags.
    pub fn move_to(&mut self, position: PhysicalPosition<f64>) -> bool {
        let now = [position.x.round() as i32, position.y.round() as i32];
        let before = self.position.replace(now).unwrap_or(now);
        if self.held.is_some() {
            self.moved[0] += now[0] - before[0];
            self.moved[1] += now[1] - before[1];
        }
        self.held.is_some()
    }

    /// Whether it was a click: the left button, pressed and released in one place.
    pub fn press(&mut self, state: ElementState, button: MouseButton) -> bool {
        let pressed = state == ElementState::Pressed;
        self.held = keys::button(button).filter(|_| pressed);
        if pressed {
            self.pressed_at = self.position.filter(|_| button == MouseButton::Left);
            return false;
        }
        self.pressed_at
            .take()
            .is_some_and(|at| Some(at) == self.position)
    }

    /// What the mouse has moved since, with a button held.
    pub fn drag(&mut self) -> Option<Pointer> {
        let [dx, dy] = std::mem::take(&mut self.moved);
        let button = self.held?;
        ([dx, dy] != [0, 0]).then_some(Pointer::Drag { button, dx, dy })
    }

    /// The whole steps of the wheel; the rest is kept.
    pub fn scroll(&mut self, delta: MouseScrollDelta) -> Option<Pointer> {
        self.scrolled += match delta {
            MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / WHEEL_STEP,
        };
        let steps = self.scrolled.trunc();
        self.scrolled -= steps;
        (steps != 0.0).then_some(Pointer::Wheel(steps as i32))
    }
}
