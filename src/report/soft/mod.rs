//! Soft shadows from many lights: what each light more, each accumulation buffer and each method of drawing is worth.
//!
//! | file | what |
//! |---|---|
//! | `cube.rs` | the truth: which share of the light's cube a pixel sees |
//! | `errors.rs` | against that truth, and against the mean of the same renders |
//! | `checks.rs` | hard shadows on each wall; renders that are all the same; the fast method against the handout's |
//! | `times.rs` | the two methods timed in rounds, and what a light more costs |
//! | `fit.rs` | straight lines through points |
//! | `plot.rs`, `page.rs`, `files.rs` | the plots and the page; CSV and JSON |

mod checks;
mod cube;
mod errors;
mod files;
mod fit;
mod page;
mod plot;
mod times;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use image::{GrayImage, RgbImage};

pub use checks::{Equal, Hard, Methods};
pub use errors::{Draws, Errors};
pub use times::Times;

use super::{Machine, Subject};
use crate::gl;
use crate::labs::{Handout, Kind, Setting, Show};
use crate::progress::Progress;
use crate::{Error, Result, picture};

/// How many lights make a soft shadow.
pub const COUNTS: [usize; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];
/// How far they are jittered: the course's own amount, and one at which penumbrae are wide.
pub const AMOUNTS: [f64; 2] = [0.009, 0.1];
pub const JITTERS: [&str; 2] = ["random", "low-discrepancy"];
pub const METHODS: [&str; 2] = ["handout", "fast"];

/// Large enough for pictures whose errors are measured: they are drawn many thousand times.
pub const ERROR_SIZE: u32 = 160;

/// Settings that the report gives values of its own.
const OWN: [&str; 11] = [
    "scene",
    "clipped_to",
    "stencil_clipping",
    "soft_shadows",
    "num_jitters",
    "jitter_amount",
    "jitter",
    "first_jitter",
    "soft_method",
    "accumulator",
    "accumulation",
];

/// Everything that was found.
#[derive(Default)]
pub struct Found {
    pub hard: Vec<Hard>,
    pub errors: Vec<Errors>,
    pub draws: Vec<Draws>,
    pub equal: Vec<Equal>,
    pub methods: Vec<Methods>,
    /// Of each method, amount and number of lights; empty if no round was finished.
    pub times: Vec<Times>,
}

pub struct SoftReport {
    pub machine: Machine,
    pub handout: &'static Handout,
    /// The options that brought the lab to its state.
    pub options: Vec<String>,
    pub size: [u32; 2],
    pub rounds: usize,
    pub found: Found,
    /// Whether it was stopped before everything was measured.
    pub interrupted: bool,
}

/// Whether a lab averages renders, and so has this report.
pub fn is_for(handout: &Handout) -> bool {
    setting(handout, "accumulator").is_some()
}

/// The first of these settings that the report would overrule.
pub fn own_setting(is_set: impl Fn(&str) -> bool) -> Option<&'static str> {
    OWN.into_iter().find(|name| is_set(name))
}

fn setting(handout: &Handout, name: &str) -> Option<&'static Setting> {
    handout.settings.iter().find(|setting| setting.name == name)
}

/// The names that a choice has.
fn choices(handout: &Handout, name: &str) -> &'static [&'static str] {
    match setting(handout, name).map(|setting| setting.kind) {
        Some(Kind::Choice(names)) => names,
        _ => &[],
    }
}

/// How much there is to do, in lights drawn.
pub fn steps(handout: &Handout, rounds: usize) -> u64 {
    let lights = errors::lights(handout) + checks::lights(handout) + times::lights(rounds);
    lights as u64
}

/// Measures everything, until `stop` is raised.
pub fn measure(
    subject: &mut Subject,
    rounds: usize,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Found> {
    let mut found = Found::default();
    let mut run = Run {
        subject,
        progress,
        stop,
    };
    let window = run.subject.size;
    run.resize(window.map(|side| side.min(ERROR_SIZE)));
    checks::hard(&mut run, &mut found.hard)?;
    checks::equal(&mut run, &mut found.equal)?;
    checks::methods(&mut run, &mut found.methods)?;
    errors::measure(&mut run, &mut found)?;
    run.resize(window);
    found.times = times::measure(&mut run, rounds)?;
    Ok(found)
}

/// A lab at work.
struct Run<'a, 'b> {
    subject: &'a mut Subject<'b>,
    progress: &'a Progress,
    stop: &'a AtomicBool,
}

impl Run<'_, '_> {
    fn resize(&mut self, size: [u32; 2]) {
        self.subject.size = size;
        self.subject.lab.resize(size);
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn set(&mut self, assignments: &[&str]) -> Result<()> {
        let settings = self.subject.lab.settings();
        assignments.iter().try_for_each(|text| settings.set(text))
    }

    /// So many lights, jittered by an amount.
    fn set_lights(&mut self, count: usize, amount: f64) -> Result<()> {
        let count = format!("num_jitters={count}");
        self.set(&[&count, &format!("jitter_amount={amount}")])
    }

    fn draw(&mut self, show: Show) -> Result<()> {
        let gl = &self.subject.context.gl;
        self.subject.lab.render(gl, show)?;
        gl::check_errors(gl, "drawing")
    }

    fn picture(&mut self) -> Result<RgbImage> {
        self.draw(Show::Picture)?;
        Ok(gl::read_rgb(&self.subject.context.gl, self.subject.size))
    }

    fn visibility(&mut self) -> Result<GrayImage> {
        self.draw(Show::Visibility { light: 1 })?;
        Ok(gl::read_grey(&self.subject.context.gl, self.subject.size))
    }
}

impl SoftReport {
    /// What a person wants to know first, a line each.
    pub fn summary(&self) -> Vec<String> {
        page::sentences(self)
    }

    /// Writes `report.csv`, `report.json` and `index.html`, each whole or not at all; returns the page's name.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        std::fs::create_dir_all(folder).map_err(|cause| Error::writing(folder, cause))?;
        let write = |name: &str, text: &str| {
            let path = folder.join(name);
            picture::write_whole(&path, |file| file.write_all(text.as_bytes()))?;
            Ok(path)
        };
        write("report.csv", &files::csv(self))?;
        write("report.json", &format!("{:#}\n", files::json(self)))?;
        write("index.html", &page::page(self).into_string())
    }
}
