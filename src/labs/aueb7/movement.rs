//! Key input, the mouse, and what they and time have moved.

use glam::{DMat4, DVec2, DVec3, dvec2};

use super::Aueb7;
use super::settings::{DEGREES_PER_SECOND, STEP, TARGET_STEP, TURN_STEP};
use crate::labs::{Button, Key, Pointer};
use crate::scene::{Camera, rotate};

/// F1's rendering modes.
const MODES: [u32; 3] = [glow::FILL, glow::LINE, glow::POINT];
/// The sine of the smallest angle between the camera's look and its up vector.
const LEAST_ACROSS: f64 = 1e-3;

/// What keys and mouse have moved.
#[derive(Clone, Copy, Default)]
pub struct Moved {
    pub eye: DVec3,
    pub target: DVec3,
    pub world: DVec3,
    /// The world's turn about y, then about x, in degrees.
    pub turned: DVec2,
}

impl Aueb7 {
    pub(super) fn press(&mut self, key: Key) -> bool {
        match key {
            Key::F1 => self.next_rendering_mode(),
            Key::Char('l') => self.toggle_rotate_light(),
            Key::Char('w') => self.move_by(|moved| moved.eye.z -= STEP),
            Key::Char('s') => self.move_by(|moved| moved.eye.z += STEP),
            Key::Char('a') => self.move_by(|moved| moved.eye.x -= STEP),
            Key::Char('d') => self.move_by(|moved| moved.eye.x += STEP),
            Key::Char('r') => self.move_by(|moved| moved.eye.y += STEP),
            Key::Char('f') => self.move_by(|moved| moved.eye.y -= STEP),
            Key::Up => self.moved.world.z -= STEP,
            Key::Down => self.moved.world.z += STEP,
            Key::Left => self.moved.world.x -= STEP,
            Key::Right => self.moved.world.x += STEP,
            Key::PageUp => self.moved.world.y += STEP,
            Key::PageDown => self.moved.world.y -= STEP,
            _ => return false,
        }
        true
    }

    pub(super) fn drag(&mut self, pointer: Pointer) -> bool {
        let Pointer::Drag { button, dx, dy } = pointer else {
            return false;
        };
        let pixels = dvec2(f64::from(dx), f64::from(dy));
        match button {
            Button::Left => self.move_by(|moved| {
                moved.target += TARGET_STEP * dvec2(pixels.x, -pixels.y).extend(0.0);
            }),
            Button::Right => self.moved.turned += TURN_STEP * pixels,
        }
        true
    }

    /// What the graph's root hangs under: the world, translated and turned.
    pub(super) fn world(&self) -> DMat4 {
        let Moved { world, turned, .. } = self.moved;
        DMat4::from_translation(world) * rotate(turned.y, DVec3::X) * rotate(turned.x, DVec3::Y)
    }

    pub(super) fn camera(&self) -> Camera {
        let camera = self.scene().camera;
        Camera {
            eye: camera.eye + self.moved.eye,
            look: camera.look + self.moved.target - self.moved.eye,
            ..camera
        }
    }

    pub(super) fn spin_time(&self) -> f64 {
        match self.settings.switch("rotation") {
            true => self.time,
            false => 0.0,
        }
    }

    /// How far the light has turned, in degrees.
    pub(super) fn light_angle(&self) -> f64 {
        match self.settings.switch("rotate_light") {
            // Whole turns leave first: the angle stays small however long the program runs.
            true => (DEGREES_PER_SECOND * self.time) % 360.0,
            false => 0.0,
        }
    }

    fn move_by(&mut self, movement: impl FnOnce(&mut Moved)) {
        let before = self.moved;
        movement(&mut self.moved);
        // In its target, or straight above it, the camera has no right.
        let Camera { look, rup, .. } = self.camera();
        let across = look.normalize_or_zero().cross(rup.normalize());
        if across.length() < LEAST_ACROSS {
            self.moved = before;
        }
    }

    fn next_rendering_mode(&mut self) {
        let present = MODES.iter().position(|mode| *mode == self.polygon_mode);
        let next = present.map_or(0, |present| (present + 1) % MODES.len());
        self.polygon_mode = MODES[next];
    }

    fn toggle_rotate_light(&mut self) {
        let other = match self.settings.switch("rotate_light") {
            true => "rotate_light=off",
            false => "rotate_light=on",
        };
        self.settings.set(other).expect("a switch has both values");
    }
}
