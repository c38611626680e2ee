//! One error type. Every message is one line: where, what was found, what was expected.

use std::fmt;
use std::path::PathBuf;

pub type Result<T> = std::result::Result<T, Error>;

#[derive(Debug)]
pub enum Error {
    /// The command line asks for something that does not exist: exit code 2.
    Usage(String),
    /// A file that was read is not what it should be. Line and column count from 1, the column in characters.
    Input {
        path: PathBuf,
        line: Option<usize>,
        column: Option<usize>,
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
    /// The user pressed Ctrl-C: exit code 130, as shells have it.
    Interrupted(String),
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
            column: None,
            message: message.into(),
        }
    }

    /// Wrong input at a line and a column.
    pub fn input_at(
        path: impl Into<PathBuf>,
        [line, column]: [usize; 2],
        message: impl Into<String>,
    ) -> Self {
        Self::Input {
            path: path.into(),
            line: Some(line),
            column: Some(column),
            message: message.into(),
        }
    }

    /// Whether a file could not be read because there is none of that name.
    pub fn is_missing(&self) -> bool {
        matches!(self, Self::File { cause, .. } if cause.kind() == std::io::ErrorKind::NotFound)
    }

    /// 2 for a wrong command line, 130 for Ctrl-C, 1 for everything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Interrupted(_) => 130,
            _ => 1,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Usage(message) | Self::Gl(message) | Self::Interrupted(message) => {
                message.clone()
            }
            Self::Input {
                path,
                line,
                column,
                message,
            } => {
                let numbers = [line, column].into_iter().flatten();
                let place: String = numbers.map(|number| format!(":{number}")).collect();
                format!("{}{place}: {message}", path.display())
            }
            Self::File { path, doing, cause } => {
                format!("{}: cannot {doing} it: {cause}", path.display())
            }
        };
        f.write_str(&one_line(&text))
    }
}

/// One line of readable length, whatever a driver, a file or a file's name put into the text: a terminal must not be
/// steered by what a stranger wrote.
pub fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ").replace(char::is_control, "\u{fffd}");
    shortened(&line, LONGEST_MESSAGE)
}

/// In characters.
const LONGEST_MESSAGE: usize = 600;
const LONGEST_QUOTE: usize = 60;

/// What was found, in quotes and in one line, without its end where it is long.
pub fn quoted(found: &str) -> String {
    let found = shortened(found, LONGEST_QUOTE);
    format!(
        "\"{}\"",
        found
            .escape_debug()
            .collect::<String>()
            .replace("\\'", "'")
            .replace("\\\"", "\"")
    )
}

fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

impl std::error::Error for Error {}

/// ` (did you mean "x"?)` when one of `known` is close to `found`, else nothing.
pub fn did_you_mean<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    // Comparing takes time and memory in proportion to the length, and nothing long is a slip of the pen.
    if found.len() > LONGEST_QUOTE {
        return String::new();
    }
    known
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(found, name), name))
        .filter(|(distance, name)| *distance <= 1 + name.len() / 4)
        .min()
        .map(|(_, name)| format!(" (did you mean \"{name}\"?)"))
        .unwrap_or_default()
}
