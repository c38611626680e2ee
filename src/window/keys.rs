//! The desktop's keys and mouse, as the labs know them, and the keys that the viewer has for itself.

use winit::event::MouseButton;
use winit::keyboard::{Key as Pressed, NamedKey};

use crate::labs::{Button, Key};

/// The viewer's own keys: none that a lab has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Own {
    Help,
    DepthMap,
    Pause,
    Screenshot,
    Panel,
    End,
}

impl Own {
    /// Whether the key is the window's even while the panel has the keyboard.
    pub fn is_of_window(self) -> bool {
        matches!(self, Self::Screenshot | Self::Panel | Self::End)
    }
}

pub const OWN: [(&str, &str); 6] = [
    ("?", "show these keys, and hide them"),
    ("<F2>", "open the panel: settings, mistakes, what is inside"),
    ("m", "show the depth map, and hide it"),
    ("<Space>", "let time stand still, and go on"),
    ("<F12>", "write a screenshot"),
    ("<Escape>", "end"),
];

pub fn own(pressed: &Pressed) -> Option<Own> {
    match pressed {
        Pressed::Character(text) if text == "?" => Some(Own::Help),
        Pressed::Character(text) if text == "m" => Some(Own::DepthMap),
        Pressed::Named(NamedKey::Space) => Some(Own::Pause),
        Pressed::Named(NamedKey::F2) => Some(Own::Panel),
        Pressed::Named(NamedKey::F12) => Some(Own::Screenshot),
        Pressed::Named(NamedKey::Escape) => Some(Own::End),
        _ => None,
    }
}

/// The key as a lab knows it.
pub fn key(pressed: &Pressed) -> Option<Key> {
    match pressed {
        Pressed::Character(text) => {
            let mut characters = text.chars();
            let first = characters.next()?;
            characters.next().is_none().then_some(Key::Char(first))
        }
        Pressed::Named(name) => match name {
            NamedKey::ArrowLeft => Some(Key::Left),
            NamedKey::ArrowRight => Some(Key::Right),
            NamedKey::ArrowUp => Some(Key::Up),
            NamedKey::ArrowDown => Some(Key::Down),
            NamedKey::PageUp => Some(Key::PageUp),
            NamedKey::PageDown => Some(Key::PageDown),
            NamedKey::Tab => Some(Key::Tab),
            NamedKey::F1 => Some(Key::F1),
            _ => None,
        },
        _ => None,
    }
}

pub fn button(pressed: MouseButton) -> Option<Button> {
    match pressed {
        MouseButton::Left => Some(Button::Left),
        MouseButton::Right => Some(Button::Right),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::OWN;
    use crate::labs::LABS;

    #[test]
    fn no_lab_has_a_key_of_the_viewers() {
        for lab in LABS {
            let keys = lab
                .keys
                .iter()
                .flat_map(|(keys, _)| keys.split_whitespace());
            for key in keys {
                assert!(
                    !OWN.iter().any(|(own, _)| *own == key),
                    "{}: {key}",
                    lab.name
                );
            }
        }
    }
}
