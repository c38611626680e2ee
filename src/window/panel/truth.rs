//! The ray truth beside the frame: asked of one state, answered on threads of its own, when it is done.
//!
//! While the rays of one state are cast no other one is asked about; then the state that is there by that time. So the
//! frame never waits, and an old state never stands in the way of a new one for longer than one answer takes.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Instant;

use image::{GrayImage, RgbImage};
use winit::event_loop::EventLoopProxy;

use crate::ground_truth::Rays;
use crate::labs::MapScale;
use crate::measure::{Figures, Measure};
use crate::scene::Scene;
use crate::window::app::Wake;

/// A state of the lab, and the shadows that it drew.
pub struct Question {
    pub scene: Scene,
    /// From 1.
    pub light: usize,
    pub visibility: GrayImage,
    pub map: Option<MapScale>,
    /// See `Stage::changes`.
    pub changes: u64,
}

/// What is wrong with them.
pub struct Answer {
    pub light: usize,
    pub changes: u64,
    pub figures: Figures,
    /// As `shadowlab measure -o` draws them.
    pub mistakes: RgbImage,
    pub seconds: f64,
}

pub struct Truth {
    questions: Sender<Question>,
    answers: Receiver<Answer>,
    is_busy: bool,
}

impl Truth {
    pub fn new(wake: EventLoopProxy<Wake>) -> Self {
        let (questions, asked) = channel::<Question>();
        let (told, answers) = channel();
        // Half of the cores are for the frames, which a software renderer draws on them.
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let threads = (cores / 2).max(1);
        thread::spawn(move || {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let Ok(pool) = pool else { return };
            for question in asked {
                let answer = pool.install(|| answer(&question));
                // The window may have closed since: then nobody needs to know.
                if told.send(answer).is_err() || wake.send_event(Wake::Truth).is_err() {
                    return;
                }
            }
        });
        Self {
            questions,
            answers,
            is_busy: false,
        }
    }

    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    pub fn ask(&mut self, question: Question) {
        self.is_busy = self.questions.send(question).is_ok();
    }

    /// What has come back since.
    pub fn answer(&mut self) -> Option<Answer> {
        let answer = self.answers.try_recv().ok()?;
        self.is_busy = false;
        Some(answer)
    }
}

fn answer(question: &Question) -> Answer {
    let began = Instant::now();
    let (width, height) = question.visibility.dimensions();
    let rays = Rays::new(&question.scene, question.light - 1);
    let truth = rays.truth([width, height]);
    let measure = Measure::new(&rays, &truth);
    let (figures, mistakes) = measure.measure(&question.visibility, question.map.as_ref());
    Answer {
        light: question.light,
        changes: question.changes,
        figures,
        mistakes,
        seconds: began.elapsed().as_secs_f64(),
    }
}
