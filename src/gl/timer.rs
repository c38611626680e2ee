//! How long each pass takes: off, and then no more than a look at a flag, until [`time_passes`] asks.

use std::cell::RefCell;
use std::time::Instant;

use glow::HasContext;

thread_local! {
    /// Of the passes that have ended: the heading, and milliseconds. None while nobody asks.
    static PASSES: RefCell<Option<Vec<(String, f64)>>> = const { RefCell::new(None) };
}

/// The passes that `draw` makes, in their order: each one's heading, and how many milliseconds it took.
///
/// The driver finishes before and after each pass, so that a pass pays for its own work and for no other's; the sum may
/// be more than the frame takes when nobody waits between its passes.
pub fn time_passes<T>(draw: impl FnOnce() -> T) -> (T, Vec<(String, f64)>) {
    PASSES.set(Some(Vec::new()));
    let drawn = draw();
    (drawn, PASSES.take().unwrap_or_default())
}

/// The driver has done everything that it was asked to.
pub fn finish(gl: &glow::Context) {
    unsafe { gl.finish() };
}

/// A pass whose time is taken.
pub(super) struct Timed {
    name: String,
    begun: Instant,
}

/// None while nobody asks.
pub(super) fn begin(gl: &glow::Context, name: &str) -> Option<Timed> {
    let asked = PASSES.with_borrow(Option::is_some);
    asked.then(|| {
        let name = name.to_owned();
        finish(gl);
        let begun = Instant::now();
        Timed { name, begun }
    })
}

pub(super) fn end(gl: &glow::Context, Timed { name, begun }: Timed) {
    finish(gl);
    let milliseconds = 1000.0 * begun.elapsed().as_secs_f64();
    PASSES.with_borrow_mut(|passes| {
        if let Some(passes) = passes {
            passes.push((name, milliseconds));
        }
    });
}
