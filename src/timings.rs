//! How long the parts of a command took, for `--timings`.

use std::fmt;
use std::time::Instant;

/// Wall time, from one lap to the next.
pub struct Timings {
    start: Instant,
    last: Instant,
    laps: Vec<(&'static str, f64)>,
}

impl Timings {
    pub fn new() -> Self {
        let now = Instant::now();
        Self {
            start: now,
            last: now,
            laps: Vec::new(),
        }
    }

    pub fn lap(&mut self, name: &'static str) {
        let now = Instant::now();
        let seconds = now.duration_since(self.last).as_secs_f64();
        self.laps.push((name, 1000.0 * seconds));
        self.last = now;
    }
}

impl fmt::Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, milliseconds) in &self.laps {
            writeln!(f, "{name:28}{milliseconds:8.1} ms")?;
        }
        let total = self.last.duration_since(self.start).as_secs_f64();
        writeln!(f, "{:28}{:8.1} ms", "total", 1000.0 * total)
    }
}
