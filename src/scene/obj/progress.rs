//! How far the reading of a large model has come, for a person who waits.

use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use crate::error::one_line;

/// Nobody needs to be told before that.
const PATIENCE: Duration = Duration::from_secs(1);
/// Looking at the clock takes longer than reading a line.
const BYTES_BETWEEN_LOOKS: usize = 1 << 20;

/// A line of percentages on standard error, if that is a terminal; it is wiped out at the end.
pub struct Progress<'a> {
    path: &'a Path,
    total: usize,
    next_look: usize,
    start: Instant,
    shown: Option<usize>,
}

impl<'a> Progress<'a> {
    pub fn new(path: &'a Path, total: usize) -> Self {
        Self {
            path,
            total,
            next_look: BYTES_BETWEEN_LOOKS,
            start: Instant::now(),
            shown: None,
        }
    }

    pub fn at(&mut self, bytes: usize) {
        if bytes < self.next_look {
            return;
        }
        self.next_look = bytes + BYTES_BETWEEN_LOOKS;
        let mut terminal = std::io::stderr();
        if self.start.elapsed() > PATIENCE && terminal.is_terminal() {
            let percent = 100 * bytes / self.total;
            if self.shown.replace(percent) == Some(percent) {
                return;
            }
            // Where standard error cannot be written, there is nobody to tell.
            let _ = write!(
                terminal,
                "\r{}: {percent} %",
                one_line(&self.path.display().to_string())
            );
        }
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if self.shown.is_some() {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}
