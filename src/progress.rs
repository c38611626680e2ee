//! How far a long task has come, for a person who waits at a terminal.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Nobody needs to be told before that.
const PATIENCE: Duration = Duration::from_secs(1);
const BAR_WIDTH: u64 = 30;

/// A bar on standard error, if that is a terminal; it is wiped out at the end. Many threads may move it.
pub struct Progress {
    /// On one line.
    what: String,
    total: u64,
    done: AtomicU64,
    shown_percent: AtomicU64,
    shown: AtomicBool,
    start: Instant,
}

impl Progress {
    pub fn new(what: impl Into<String>, total: u64) -> Self {
        Self {
            what: what.into(),
            total: total.max(1),
            done: AtomicU64::new(0),
            shown_percent: AtomicU64::new(0),
            shown: AtomicBool::new(false),
            start: Instant::now(),
        }
    }

    /// Some more of the total is done.
    pub fn add(&self, more: u64) {
        let done = self.done.fetch_add(more, Ordering::Relaxed) + more;
        let percent = 100 * done.min(self.total) / self.total;
        // Only who moves the bar by a percent looks at the clock.
        if self.shown_percent.fetch_max(percent, Ordering::Relaxed) >= percent
            || self.start.elapsed() < PATIENCE
        {
            return;
        }
        let mut terminal = std::io::stderr();
        if terminal.is_terminal() {
            let filled = BAR_WIDTH * percent / 100;
            let bar: String = (0..BAR_WIDTH)
                .map(|i| if i < filled { '#' } else { '.' })
                .collect();
            let rest = self.total.saturating_sub(done) as f64 / done as f64;
            let left = time_left(self.start.elapsed().mul_f64(rest));
            // Where standard error cannot be written, there is nobody to tell.
            let _ = write!(
                terminal,
                "\r{} [{bar}] {percent} %, {left} left ",
                self.what
            );
            self.shown.store(true, Ordering::Relaxed);
        }
    }
}

/// Minutes and seconds.
fn time_left(left: Duration) -> String {
    let seconds = left.as_secs_f64().round() as u64;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown.load(Ordering::Relaxed) {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_minutes_and_seconds() {
        for (seconds, told) in [(0.0, "0:00"), (0.6, "0:01"), (59.4, "0:59"), (61.0, "1:01")] {
            assert_eq!(time_left(Duration::from_secs_f64(seconds)), told);
        }
    }
}
