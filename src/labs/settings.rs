//! A lab's settings: one table that drives `--set`, the list in `shadowlab labs`, and whatever else is configurable.

use std::fmt;

use crate::{Error, Result, error};

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    pub name: &'static str,
    pub kind: Kind,
    /// One line, in the handout's words.
    pub help: &'static str,
}

/// What values a setting takes, and the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Number {
        default: f64,
        least: f64,
        most: f64,
        whole: bool,
    },
    /// The first one is the default.
    Choice(&'static [&'static str]),
    Switch {
        default: bool,
    },
}

impl Kind {
    /// The default as `--set` would write it.
    pub fn default_text(&self) -> String {
        match self {
            Self::Number { default, .. } => default.to_string(),
            Self::Choice(names) => names[0].to_owned(),
            Self::Switch { default } => on_off(*default).to_owned(),
        }
    }

    /// The values that it takes, for a person.
    pub fn expected(&self) -> String {
        match self {
            Self::Number {
                least, most, whole, ..
            } => {
                let number = if *whole { "a whole number" } else { "a number" };
                format!("{number} from {least} to {most}")
            }
            Self::Choice(names) => names.join(" | "),
            Self::Switch { .. } => "on | off".to_owned(),
        }
    }

    fn parse(&self, text: &str) -> Option<Value> {
        match self {
            Self::Number {
                least, most, whole, ..
            } => {
                let number: f64 = text.parse().ok()?;
                // A NaN is in no range.
                let fits = (*least..=*most).contains(&number) && (!whole || number.fract() == 0.0);
                fits.then_some(Value::Number(number))
            }
            Self::Choice(names) => names
                .iter()
                .find(|name| **name == text)
                .map(|name| Value::Choice(name)),
            Self::Switch { .. } => match text {
                "on" => Some(Value::Switch(true)),
                "off" => Some(Value::Switch(false)),
                _ => None,
            },
        }
    }
}

fn on_off(on: bool) -> &'static str {
    if on { "on" } else { "off" }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    Number(f64),
    Choice(&'static str),
    Switch(bool),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Choice(name) => f.write_str(name),
            Self::Switch(on) => f.write_str(on_off(*on)),
        }
    }
}

/// The values of a lab's settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    table: &'static [Setting],
    values: Vec<Value>,
}

impl Settings {
    pub fn new(table: &'static [Setting]) -> Self {
        let default = |setting: &Setting| match setting.kind {
            Kind::Number { default, .. } => Value::Number(default),
            Kind::Choice(names) => Value::Choice(names[0]),
            Kind::Switch { default } => Value::Switch(default),
        };
        Self {
            table,
            values: table.iter().map(default).collect(),
        }
    }

    /// Sets `name=value`, as `--set` writes it.
    pub fn set(&mut self, assignment: &str) -> Result<()> {
        let (name, text) = assignment
            .split_once('=')
            .ok_or_else(|| Error::usage(format!("--set {assignment}: expected name=value")))?;
        self.assign(name, text)
            .map_err(|wrong| Error::usage(format!("--set {assignment}: {wrong}")))
    }

    /// The same of a name and a value; what is wrong is said without the option that asked for it.
    pub fn assign(&mut self, name: &str, text: &str) -> std::result::Result<(), String> {
        let index = self.table.iter().position(|setting| setting.name == name);
        let index = index.ok_or_else(|| {
            let names: Vec<_> = self.table.iter().map(|setting| setting.name).collect();
            let hint = error::did_you_mean(name, names.iter().copied());
            format!(
                "unknown setting \"{name}\"{hint}: expected one of {}",
                names.join(", ")
            )
        })?;
        let kind = &self.table[index].kind;
        self.values[index] = kind.parse(text).ok_or_else(|| {
            format!(
                "\"{text}\" is no value of {name}, expected {}",
                kind.expected()
            )
        })?;
        Ok(())
    }

    /// The settings whose values differ from `others`, as `--set` would write them, in the table's order.
    pub fn differences(&self, others: &Self) -> Vec<String> {
        let values = self.values.iter().zip(&others.values);
        let settings = self.table.iter().zip(values);
        settings
            .filter(|(_, (value, other))| value != other)
            .map(|(setting, (value, _))| format!("{}={value}", setting.name))
            .collect()
    }

    pub fn number(&self, name: &str) -> f64 {
        match self.value(name) {
            Value::Number(number) => number,
            other => panic!("{name} is no number: {other:?}"),
        }
    }

    pub fn choice(&self, name: &str) -> &'static str {
        match self.value(name) {
            Value::Choice(choice) => choice,
            other => panic!("{name} is no choice: {other:?}"),
        }
    }

    pub fn switch(&self, name: &str) -> bool {
        match self.value(name) {
            Value::Switch(on) => on,
            other => panic!("{name} is no switch: {other:?}"),
        }
    }

    fn value(&self, name: &str) -> Value {
        let index = self.table.iter().position(|setting| setting.name == name);
        self.values[index.unwrap_or_else(|| panic!("no setting {name}"))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[Setting] = &[
        Setting {
            name: "map_size",
            kind: Kind::Number {
                default: 1024.0,
                least: 256.0,
                most: 8192.0,
                whole: true,
            },
            help: "",
        },
        Setting {
            name: "filter",
            kind: Kind::Choice(&["linear", "nearest"]),
            help: "",
        },
    ];

    #[test]
    fn values_are_taken_and_defaults_kept() {
        let mut settings = Settings::new(TABLE);
        settings.set("filter=nearest").unwrap();
        assert_eq!(settings.choice("filter"), "nearest");
        assert_eq!(settings.number("map_size"), 1024.0);
    }

    #[test]
    fn differences_are_told_as_they_are_set() {
        let default = Settings::new(TABLE);
        let mut settings = default.clone();
        assert_eq!(settings.differences(&default), [""; 0]);
        for assignment in ["filter=nearest", "map_size=512"] {
            settings.set(assignment).unwrap();
        }
        assert_eq!(
            settings.differences(&default),
            ["map_size=512", "filter=nearest"]
        );
        assert_ne!(settings, default);
    }

    #[test]
    fn what_does_not_fit_is_told_with_what_was_expected() {
        let mut settings = Settings::new(TABLE);
        for (assignment, told) in [
            ("map_size", "name=value"),
            ("map_sise=512", "did you mean \"map_size\"?"),
            ("map_size=NaN", "a whole number from 256 to 8192"),
            ("map_size=inf", "from 256 to 8192"),
            ("map_size=255", "from 256 to 8192"),
            ("map_size=512.5", "a whole number"),
            ("filter=cubic", "linear | nearest"),
        ] {
            let error = settings.set(assignment).unwrap_err();
            assert_eq!(error.exit_code(), 2);
            assert!(error.to_string().contains(told), "{error}");
        }
    }
}
