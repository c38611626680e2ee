//! How long each pass takes: off, and then no more than a look at a flag, until [`time_passes`] asks.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use glow::HasContext;

use super::trace;

thread_local! {
    /// Those that have ended. None while nobody asks.
    static PASSES: RefCell<Option<Vec<PassTime>>> = const { RefCell::new(None) };
}

/// How long a pass took, in milliseconds.
#[derive(Clone, Debug)]
pub struct PassTime {
    /// Its heading.
    pub name: String,
    pub ms: f64,
    /// What of that was spent in GL calls, where [`trace::in_calls`] watches them.
    pub in_calls_ms: f64,
}

/// The passes that `draw` makes, in their order.
///
/// The driver finishes before and after each pass, so that a pass pays for its own work and for no other's; the sum may
/// be more than the frame takes when nobody waits between its passes.
pub fn time_passes<T>(draw: impl FnOnce() -> T) -> (T, Vec<PassTime>) {
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
    inside: Duration,
}

/// None while nobody asks.
pub(super) fn begin(gl: &glow::Context, name: &str) -> Option<Timed> {
    let asked = PASSES.with_borrow(Option::is_some);
    asked.then(|| {
        let name = name.to_owned();
        finish(gl);
        let (begun, inside) = (Instant::now(), trace::so_far());
        Timed {
            name,
            begun,
            inside,
        }
    })
}

pub(super) fn end(gl: &glow::Context, timed: Timed) {
    finish(gl);
    let ms = |time: Duration| 1000.0 * time.as_secs_f64();
    let ended = PassTime {
        name: timed.name,
        ms: ms(timed.begun.elapsed()),
        in_calls_ms: ms(trace::so_far().saturating_sub(timed.inside)),
    };
    PASSES.with_borrow_mut(|passes| {
        if let Some(passes) = passes {
            passes.push(ended);
        }
    });
}
