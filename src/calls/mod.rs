//! A program's GL calls, read from a dump and held against a handout.
//!
//! | file | what it does |
//! |---|---|
//! | `reader.rs`, `syntax.rs` | the text, call by call |
//! | `state` | OpenGL's state after each call, with the line that set it |
//! | `glsl.rs` | what a shader's source says of its uniforms |
//! | `frame.rs` | what is drawn between two buffer swaps, pass by pass |
//! | `matrices.rs` | whether both passes go to the map by the same way |
//! | `handouts.rs` | what each handout asks for, and where |
//! | `judge` | the steps, found or not |
//! | `report.rs` | what came of it |
//!
//! A program is judged by what is drawn, and not by a sequence of calls: a shadow map is a depth texture that something
//! is drawn into, and the second pass is what reads it. So names, sizes, the order of independent calls, and how many
//! objects there are may differ, and what a library of helpers does in between does not matter.
//!
//! The judged frame is the last whole one that draws with a map, because a program's first frames differ; what was set
//! up before counts as it is then. A dump without a buffer swap is one frame.

mod frame;
mod glsl;
mod handouts;
mod judge;
mod matrices;
mod objects;
mod reader;
mod report;
mod state;
mod syntax;

use std::io::BufRead;
use std::path::Path;

pub use report::{Mark, Report, Step};

use crate::progress::Progress;
use crate::{Error, Result};
use frame::{Frame, Kept, Pass, StepKind};
use reader::Calls;
use state::{Event, State};

/// So many passes of earlier frames are remembered, one for each map.
const MOST_MAPS: usize = 16;

/// Reads a dump and holds it against a lab's handout. `path` is how messages name it.
pub fn check(
    dump: impl BufRead,
    path: &Path,
    lab: &'static str,
    progress: &Progress,
) -> Result<Report> {
    let mut calls = Calls::new(dump, path);
    let mut watcher = Watcher::new(lab);
    let mut told = 0;
    let mut count = 0;
    while let Some(call) = calls.read()? {
        count += 1;
        watcher.read(&call);
        if watcher.state.is_overfull() {
            let message = "found more than a million GL objects, expected a program's";
            return Err(Error::input(path, call.line as usize, message));
        }
        progress.add(calls.bytes - told);
        told = calls.bytes;
    }
    Ok(watcher.report(count, calls.other))
}

/// Follows the calls, frame by frame.
struct Watcher {
    lab: &'static str,
    state: State,
    kept: Kept,
    frame: Frame,
    frames: u64,
    /// Passes of earlier frames that drew into a depth texture, the latest of each.
    maps: Vec<Pass>,
    /// Of the last whole frame that counts, and its lines.
    judged: Option<([u64; 2], Vec<Step>)>,
    /// How well the judged frame fits what is looked for.
    rank: u8,
}

impl Watcher {
    fn new(lab: &'static str) -> Self {
        Self {
            lab,
            state: State::new(),
            kept: Kept::default(),
            frame: Frame::beginning_at(1),
            frames: 0,
            maps: Vec::new(),
            judged: None,
            rank: 0,
        }
    }

    fn read(&mut self, call: &syntax::Call) {
        match self.state.apply(call) {
            Event::Nothing => {}
            Event::Draw(mesh) => self
                .frame
                .draw(call.line, mesh, &self.state, &mut self.kept),
            Event::Clear(cleared) => self.frame.clear(call.line, &cleared, &self.state),
            Event::Accumulate(operation, value) => {
                self.frame
                    .step(call.line, StepKind::Accumulate { operation, value });
            }
            Event::Blit { from, to } => self.frame.step(call.line, StepKind::Blit { from, to }),
            Event::Swap => {
                self.frame.last = call.line;
                self.end_of_frame();
                self.frames += 1;
                self.frame = Frame::beginning_at(call.line + 1);
            }
        }
    }

    fn end_of_frame(&mut self) {
        let frame = std::mem::take(&mut self.frame);
        if frame.draws == 0 {
            return;
        }
        // A frame in which shadows are switched off says less than one before it.
        let rank = if frame.passes.iter().any(|pass| pass.map.is_some()) {
            2
        } else {
            1
        };
        if rank >= self.rank || self.judged.is_none() {
            self.rank = rank;
            let steps = judge::judge(self.lab, &frame, &self.maps, &self.state);
            self.judged = Some(([frame.first, frame.last], steps));
        }
        for pass in frame.passes {
            let Some((id, _)) = &pass.map else { continue };
            let known = self
                .maps
                .iter()
                .position(|old| old.map.as_ref().is_some_and(|(old, _)| old == id));
            match known {
                Some(place) => self.maps[place] = pass,
                None if self.maps.len() < MOST_MAPS => self.maps.push(pass),
                None => {}
            }
        }
    }

    fn report(mut self, calls: u64, other: Option<(u64, usize)>) -> Report {
        // What comes behind the last swap is a part of a frame, or, without any swap, all of it.
        if self.judged.is_none() {
            self.end_of_frame();
        }
        let (judged, steps) = match self.judged {
            Some((lines, steps)) => (Some(lines), steps),
            None => (
                None,
                judge::judge(self.lab, &Frame::default(), &[], &self.state),
            ),
        };
        Report {
            lab: self.lab,
            calls,
            frames: self.frames,
            judged,
            steps,
            other,
        }
    }
}
