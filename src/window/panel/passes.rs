//! How long each pass takes, while the tab is open.
//!
//! The driver finishes before and after each pass (see [`gl::time_passes`]), so that a pass pays for its own work alone,
//! on a GPU and on a software renderer, which does its work on threads of its own; nothing overlaps then, and the sum is
//! more than a frame takes that nobody measures.

use std::collections::VecDeque;

use egui::{Label, RichText, Sense, Ui, vec2};

use super::look;
use crate::gl::PassTime;

/// How many frames the median is of.
const FRAMES: usize = 31;

#[derive(Default)]
pub struct Tab {
    passes: Vec<Pass>,
}

struct Pass {
    name: String,
    /// In milliseconds, of the last frames that had it.
    times: VecDeque<f64>,
    /// Whether the last frame had it.
    was_drawn: bool,
}

impl Pass {
    fn median(&self) -> f64 {
        let mut times: Vec<f64> = self.times.iter().copied().collect();
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    }
}

impl Tab {
    /// Those of one frame.
    pub fn add(&mut self, times: &[PassTime]) {
        for pass in &mut self.passes {
            pass.was_drawn = false;
        }
        for time in times {
            let known = self
                .passes
                .iter_mut()
                .position(|pass| pass.name == time.name);
            let at = known.unwrap_or_else(|| {
                self.passes.push(Pass {
                    name: time.name.clone(),
                    times: VecDeque::new(),
                    was_drawn: false,
                });
                self.passes.len() - 1
            });
            let pass = &mut self.passes[at];
            pass.was_drawn = true;
            if pass.times.len() == FRAMES {
                pass.times.pop_front();
            }
            pass.times.push_back(time.ms);
        }
    }

    pub fn show(&self, ui: &mut Ui) {
        // A scene at rest is drawn for the sake of its times.
        ui.ctx().request_repaint();
        let drawn = || self.passes.iter().filter(|pass| pass.was_drawn);
        let slowest = self.passes.iter().map(Pass::median).fold(0.0, f64::max);
        for pass in &self.passes {
            let color = if pass.was_drawn {
                look::INK
            } else {
                look::RAISED.gamma_multiply(2.0)
            };
            let name = RichText::new(&pass.name).color(color);
            ui.add(Label::new(name).sense(Sense::hover()));
            ui.horizontal(|ui| {
                let size = vec2(ui.available_width() - 80.0, 10.0);
                let (area, _) = ui.allocate_exact_size(size, Sense::hover());
                let share = (pass.median() / slowest.max(f64::MIN_POSITIVE)) as f32;
                let mut bar = area;
                bar.set_width(share * area.width());
                ui.painter().rect_filled(area, look::ROUND, look::RAISED);
                if pass.was_drawn {
                    ui.painter().rect_filled(bar, look::ROUND, look::CHOSEN);
                }
                let ms = format!("{:7.2} ms", pass.median());
                ui.label(RichText::new(ms).font(look::digits()).color(color));
            });
            ui.add_space(4.0);
        }
        let sum: f64 = drawn().map(Pass::median).sum();
        ui.separator();
        ui.label(format!("{sum:.2} ms in the passes of this frame"));
        ui.add_space(4.0);
        let told = format!(
            "Each is the median of the last {FRAMES} frames that had the pass, on the clock, with glFinish before it and \
             after it. So no pass works while another one does, and the sum is more than an ordinary frame takes. A pass \
             that is dark was not needed in this frame: nothing had changed that it depends on."
        );
        ui.weak(RichText::new(told).size(12.0));
    }
}
