//! Keys and movements of the mouse, as a person makes them and as `--keys` writes them: `wwa<Left><Drag:12,-5>`.

use std::fmt;

use crate::{Error, Result, error};

/// What a person does to a lab.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    Key(Key),
    Pointer(Pointer),
    /// Another value for a setting, in the viewer's panel: `name=value`, as `--set` writes it.
    Set(String),
    /// Nothing, for so many seconds.
    Wait(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A key that writes a character; capitals are keys of their own.
    Char(char),
    Left,
    Right,
    Up,
    Down,
    PageUp,
    PageDown,
    Tab,
    F1,
}

/// What the mouse does over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pointer {
    /// A movement with a button held, in pixels of the picture: to the right and down.
    Drag { button: Button, dx: i32, dy: i32 },
    /// Steps of the wheel, away from the person.
    Wheel(i32),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    Left,
    Right,
}

/// The keys that `--keys` writes as `<Name>`; `<lt>` is the character `<` itself.
const NAMED: [(&str, Key); 9] = [
    ("Left", Key::Left),
    ("Right", Key::Right),
    ("Up", Key::Up),
    ("Down", Key::Down),
    ("PageUp", Key::PageUp),
    ("PageDown", Key::PageDown),
    ("Tab", Key::Tab),
    ("F1", Key::F1),
    ("lt", Key::Char('<')),
];

/// The longest wait, in seconds: a year.
const LONGEST_WAIT: f64 = 31_557_600.0;

/// What `--keys` writes as `<Name:…>` beside the keys, and what stands behind each name.
const MOVEMENTS: [(&str, &str); 5] = [
    ("Drag", "<Drag:12,-5>: right and down, in pixels"),
    ("RightDrag", "<RightDrag:12,-5>: right and down, in pixels"),
    ("Wheel", "<Wheel:1>: steps away from the person"),
    ("Wait", "<Wait:0.5>: seconds that pass"),
    ("Set", "<Set:name=value>: another value for a setting"),
];

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key(key) => key.fmt(f),
            Self::Pointer(Pointer::Drag { button, dx, dy }) => match button {
                Button::Left => write!(f, "<Drag:{dx},{dy}>"),
                Button::Right => write!(f, "<RightDrag:{dx},{dy}>"),
            },
            Self::Pointer(Pointer::Wheel(steps)) => write!(f, "<Wheel:{steps}>"),
            Self::Set(assignment) => write!(f, "<Set:{assignment}>"),
            Self::Wait(seconds) => write!(f, "<Wait:{seconds}>"),
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (NAMED.iter().find(|(_, key)| key == self), self) {
            (Some((name, _)), _) => write!(f, "<{name}>"),
            (None, Key::Char(c)) => write!(f, "{c}"),
            (None, other) => unreachable!("{other:?} has a name"),
        }
    }
}

/// What a `--keys` text does, in order.
pub fn parse_keys(text: &str) -> Result<Vec<Input>> {
    let mut inputs = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if first != '<' {
            inputs.push(Input::Key(Key::Char(first)));
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (name, after) = rest[1..].split_once('>').ok_or_else(|| {
            Error::usage(format!(
                "--keys: \"{rest}\" has no closing \">\", expected <Name>, or <lt> for the key \"<\""
            ))
        })?;
        inputs.push(match name.split_once(':') {
            Some((movement, numbers)) => parse_movement(movement, numbers)?,
            None => Input::Key(parse_named(name)?),
        });
        rest = after;
    }
    Ok(inputs)
}

fn parse_named(name: &str) -> Result<Key> {
    let known = NAMED.iter().find(|(known, _)| *known == name);
    let (_, key) = known.ok_or_else(|| {
        let names = NAMED.map(|(name, _)| name);
        let hint = error::did_you_mean(name, names);
        Error::usage(format!(
            "--keys: unknown key <{name}>{hint}: expected one of <{}>",
            names.join(">, <")
        ))
    })?;
    Ok(*key)
}

fn parse_movement(name: &str, numbers: &str) -> Result<Input> {
    if name == "Set" && numbers.contains('=') {
        return Ok(Input::Set(numbers.to_owned()));
    }
    // A NaN is in no range.
    let seconds = numbers.parse().ok();
    if let Some(seconds) = seconds.filter(|s| (0.0..=LONGEST_WAIT).contains(s))
        && name == "Wait"
    {
        return Ok(Input::Wait(seconds));
    }
    let parsed: Option<Vec<i32>> = numbers.split(',').map(|n| n.parse().ok()).collect();
    let drag = |button, dx, dy| Ok(Input::Pointer(Pointer::Drag { button, dx, dy }));
    match (name, parsed.as_deref()) {
        ("Drag", Some(&[dx, dy])) => drag(Button::Left, dx, dy),
        ("RightDrag", Some(&[dx, dy])) => drag(Button::Right, dx, dy),
        ("Wheel", Some(&[steps])) => Ok(Input::Pointer(Pointer::Wheel(steps))),
        _ => {
            let known = MOVEMENTS.iter().find(|(known, _)| *known == name);
            let expected = match known {
                Some((_, example)) => (*example).to_owned(),
                None => format!(
                    "one of {}",
                    MOVEMENTS.map(|(_, example)| example).join("; ")
                ),
            };
            Err(Error::usage(format!(
                "--keys: unknown movement <{name}:{numbers}>, expected {expected}"
            )))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_parsed_is_written_the_same() {
        let text = "wwa<Left><PageUp>W<lt>é<F1><Drag:12,-5><RightDrag:0,7><Wheel:-2><Wait:0.25><Set:filter=nearest>";
        let keys = parse_keys(text).unwrap();
        assert_eq!(keys.len(), 14);
        let written: String = keys.iter().map(Input::to_string).collect();
        assert_eq!(written, text);
    }

    #[test]
    fn unknown_and_unclosed_names_are_told() {
        let error = parse_keys("w<Lft>").unwrap_err().to_string();
        assert!(error.contains("<Lft>") && error.contains("Left"), "{error}");
        for (text, told) in [
            ("w<Left", "closing"),
            ("<Drag:1>", "right and down"),
            ("<Drag:1.5,2>", "right and down"),
            ("<Wheel:>", "steps"),
            ("<Wait:-1>", "seconds"),
            ("<Wait:NaN>", "seconds"),
            ("<Wait:1,2>", "seconds"),
            ("<Set:filter>", "name=value"),
            ("<Swipe:1,2>", "<Wheel:1>"),
        ] {
            let error = parse_keys(text).unwrap_err().to_string();
            assert!(error.contains(told), "{text}: {error}");
        }
    }
}
