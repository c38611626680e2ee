//! One error type. Every message is one line: where, what was found, what was expected.

use std::fmt;
use std::path::PathBuf;

pub type Result<T> = std::result::Result<T, Error>;

#[derive(Debug)]
pub enum Error {
    /// The command line asks for something that does not exist: exit code 2.
    Usage(String),
    /// A file that was read is not what it should be. `line` counts from 1.
    Input {
        path: PathBuf,
        line: Option<usize>,
        message: String,
    },
    /// A file could not be read or written.
    File {
        path: PathBuf,
        doing: &'static str,
        cause: std::io::Error,
    },
    /// The driver refused something, or there is no driver.
    Gl(String),
}

impl Error {
    pub fn usage(message: impl Into<String>) -> Self {
        Self::Usage(message.into())
    }

    pub fn gl(message: impl Into<String>) -> Self {
        Self::Gl(message.into())
    }

    pub fn reading(path: impl Into<PathBuf>, cause: std::io::Error) -> Self {
        Self::File {
            path: path.into(),
            doing: "read",
            cause,
        }
    }

    pub fn writing(path: impl Into<PathBuf>, cause: std::io::Error) -> Self {
        Self::File {
            path: path.into(),
            doing: "write",
            cause,
        }
    }

    pub fn input(
        path: impl Into<PathBuf>,
        line: impl Into<Option<usize>>,
        message: impl Into<String>,
    ) -> Self {
        Self::Input {
            path: path.into(),
            line: line.into(),
            message: message.into(),
        }
    }

    /// 2 for a wrong command line, 1 for everything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            _ => 1,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Usage(message) | Self::Gl(message) => message.clone(),
            Self::Input {
                path,
                line: Some(line),
                message,
            } => format!("{}:{line}: {message}", path.display()),
            Self::Input {
                path,
                line: None,
                message,
            } => format!("{}: {message}", path.display()),
            Self::File { path, doing, cause } => {
                format!("{}: cannot {doing} it: {cause}", path.display())
            }
        };
        // One line, whatever a driver or a file name put into the message.
        f.write_str(&text.split_whitespace().collect::<Vec<_>>().join(" "))
    }
}

impl std::error::Error for Error {}

/// ` (did you mean "x"?)` when one of `known` is close to `found`, else nothing.
pub fn did_you_mean<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    known
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(found, name), name))
        .filter(|(distance, name)| *distance <= 1 + name.len() / 4)
        .min()
        .map(|(_, name)| format!(" (did you mean \"{name}\"?)"))
        .unwrap_or_default()
}
