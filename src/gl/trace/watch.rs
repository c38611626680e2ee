//! What the shims do beside forwarding a call: write it down, take its time, or nothing.

use std::cell::Cell;
use std::time::{Duration, Instant};

#[derive(Clone, Copy, PartialEq)]
enum Watch {
    Record,
    /// The sum of the time in the driver so far.
    Time(Duration),
    Nothing,
}

thread_local! {
    static WATCH: Cell<Watch> = const { Cell::new(Watch::Record) };
}

/// The calls that `draw` makes are not recorded: a recorded context is then as fast as any other, but for a look at a
/// flag in each call.
pub fn unrecorded<T>(draw: impl FnOnce() -> T) -> T {
    let before = WATCH.replace(Watch::Nothing);
    let drawn = draw();
    WATCH.set(before);
    drawn
}

/// How long `draw` was in the driver, of a recorded context. What the clock itself takes counts as outside of it.
pub fn in_calls<T>(draw: impl FnOnce() -> T) -> (T, Duration) {
    let before = WATCH.replace(Watch::Time(Duration::ZERO));
    let drawn = draw();
    match WATCH.replace(before) {
        Watch::Time(inside) => (drawn, inside),
        _ => unreachable!("what is set within is set back within"),
    }
}

/// How long the draw that [`in_calls`] watches was in the driver until now; nothing where none is watched.
pub fn so_far() -> Duration {
    match WATCH.get() {
        Watch::Time(inside) => inside,
        Watch::Record | Watch::Nothing => Duration::ZERO,
    }
}

/// From now on, nothing is recorded on this thread.
pub(super) fn stop() {
    WATCH.set(Watch::Nothing);
}

/// From now on, everything is.
pub(super) fn start() {
    WATCH.set(Watch::Record);
}

pub(super) fn records() -> bool {
    WATCH.get() == Watch::Record
}

pub(super) fn before_call() -> Option<Instant> {
    matches!(WATCH.get(), Watch::Time(_)).then(Instant::now)
}

pub(super) fn after_call(begun: Option<Instant>) {
    if let (Some(begun), Watch::Time(inside)) = (begun, WATCH.get()) {
        WATCH.set(Watch::Time(inside + begun.elapsed()));
    }
}
