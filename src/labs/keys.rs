//! Keys, as a person presses them and as `--keys` writes them: `wwa<Left><Left>`.

use std::fmt;

use crate::{Error, Result, error};

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
}

/// The keys that `--keys` writes as `<Name>`; `<lt>` is the character `<` itself.
const NAMED: [(&str, Key); 8] = [
    ("Left", Key::Left),
    ("Right", Key::Right),
    ("Up", Key::Up),
    ("Down", Key::Down),
    ("PageUp", Key::PageUp),
    ("PageDown", Key::PageDown),
    ("Tab", Key::Tab),
    ("lt", Key::Char('<')),
];

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (NAMED.iter().find(|(_, key)| key == self), self) {
            (Some((name, _)), _) => write!(f, "<{name}>"),
            (None, Key::Char(c)) => write!(f, "{c}"),
            (None, other) => unreachable!("{other:?} has a name"),
        }
    }
}

/// The keys of a `--keys` text, in order.
pub fn parse_keys(text: &str) -> Result<Vec<Key>> {
    let mut keys = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if first != '<' {
            keys.push(Key::Char(first));
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (name, after) = rest[1..].split_once('>').ok_or_else(|| {
            Error::usage(format!(
                "--keys: \"{rest}\" has no closing \">\", expected <Name>, or <lt> for the key \"<\""
            ))
        })?;
        let known = NAMED.iter().find(|(known, _)| *known == name);
        let (_, key) = known.ok_or_else(|| {
            let names = NAMED.map(|(name, _)| name);
            let hint = error::did_you_mean(name, names);
            Error::usage(format!(
                "--keys: unknown key <{name}>{hint}: expected one of <{}>",
                names.join(">, <")
            ))
        })?;
        keys.push(*key);
        rest = after;
    }
    Ok(keys)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_parsed_is_written_the_same() {
        let text = "wwa<Left><PageUp>W<lt>é";
        let keys = parse_keys(text).unwrap();
        assert_eq!(keys.len(), 8);
        let written: String = keys.iter().map(Key::to_string).collect();
        assert_eq!(written, text);
    }

    #[test]
    fn unknown_and_unclosed_names_are_told() {
        let error = parse_keys("w<Lft>").unwrap_err().to_string();
        assert!(error.contains("<Lft>") && error.contains("Left"), "{error}");
        assert!(
            parse_keys("w<Left")
                .unwrap_err()
                .to_string()
                .contains("closing")
        );
    }
}
