//! How long the parts of a command took, for `--timings`.

use std::time::Instant;

/// Wall time, from one lap to the next; printed on standard error at the end, if a person asked for it.
pub struct Timings {
    shown: bool,
    start: Instant,
    last: Instant,
    laps: Vec<(&'static str, f64)>,
}

impl Timings {
    pub fn new(shown: bool) -> Self {
        let now = Instant::now();
        Self {
            shown,
            start: now,
            last: now,
            laps: Vec::new(),
        }
    }

    /// What has happened since the last lap is called `name`.
    pub fn lap(&mut self, name: &'static str) {
        let now = Instant::now();
        let seconds = now.duration_since(self.last).as_secs_f64();
        self.laps.push((name, 1000.0 * seconds));
        self.last = now;
    }
}

impl Drop for Timings {
    fn drop(&mut self) {
        if !self.shown {
            return;
        }
        self.lap("the rest");
        let total = 1000.0 * self.last.duration_since(self.start).as_secs_f64();
        for (name, milliseconds) in self.laps.iter().chain([&("total", total)]) {
            eprintln!("{name:28}{milliseconds:8.1} ms");
        }
    }
}
