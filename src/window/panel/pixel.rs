//! What `shadowlab explain` prints of a pixel, live, with the texels around the look-up.

use std::time::{Duration, Instant};

use egui::{Color32, Key, Painter, Rect, RichText, Sense, Stroke, Ui, vec2};

use super::texels::Texels;
use super::{Facts, look, rows};
use crate::labs::{Explanation, Probe};
use crate::window::stage::Stage;

/// A pixel is explained again only after this many times as long as that takes: the rest is for the frames.
const REST: u32 = 2;

#[derive(Default)]
pub struct Tab {
    /// From the picture's top left corner. None until the pointer has been over the picture: its middle.
    at: Option<[u32; 2]>,
    /// It stays, wherever the pointer goes.
    is_pinned: bool,
    asked: Option<Asked>,
    /// When it may be asked again.
    rested: Option<Instant>,
    /// Whether another pixel, or another state, waits for that.
    waits: bool,
}

/// An explanation, and of what.
struct Asked {
    of: ([u32; 2], usize, u64),
    told: Result<(Explanation, Option<Texels>), String>,
}

impl Tab {
    /// The pointer is there, in pixels from the picture's top left corner. Whether that is another pixel.
    pub fn point(&mut self, [x, y]: [i32; 2], [width, height]: [u32; 2]) -> bool {
        let inside = |at: i32, size: u32| u32::try_from(at).ok().filter(|at| *at < size);
        let (Some(x), Some(y)) = (inside(x, width), inside(y, height)) else {
            return false;
        };
        let moves = !self.is_pinned && self.at != Some([x, y]);
        if moves {
            self.at = Some([x, y]);
        }
        moves
    }

    pub fn pin(&mut self) {
        self.is_pinned = !self.is_pinned;
    }

    fn place(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        let [x, y] = self.at.unwrap_or([width / 2, height / 2]);
        [x.min(width - 1), y.min(height - 1)]
    }

    /// When the pixel that waits is to be explained.
    pub fn next_frame(&self) -> Option<Instant> {
        self.rested.filter(|_| self.waits)
    }

    /// Explains the pixel, where it or the state is another one than last time. Draws into the window.
    pub fn ask(&mut self, gl: &glow::Context, stage: &mut Stage, light: usize) {
        let place = self.place(stage.size());
        let of = (place, light, stage.changes());
        let is_known = self.asked.as_ref().is_some_and(|asked| asked.of == of);
        let now = Instant::now();
        self.waits = !is_known && self.rested.is_some_and(|rested| now < rested);
        if is_known || self.waits {
            return;
        }
        self.asked = Some(Asked {
            of,
            told: explain(gl, stage, place, light),
        });
        let took: Duration = now.elapsed();
        self.rested = Some(Instant::now() + REST * took);
    }

    /// The pixel, in the picture.
    pub fn mark(&self, painter: &Painter, picture: Rect, size: [u32; 2]) {
        let [x, y] = self.place(size);
        let scale = painter.ctx().pixels_per_point();
        let corner = picture.min + vec2(x as f32, y as f32) / scale;
        let pixel = Rect::from_min_size(corner, vec2(1.0, 1.0) / scale).expand(4.0);
        let outside = egui::StrokeKind::Outside;
        painter.rect_stroke(pixel, 0.0, Stroke::new(3.0, Color32::BLACK), outside);
        painter.rect_stroke(pixel, 0.0, Stroke::new(1.5, look::FOCUS), outside);
    }

    pub fn show(&mut self, ui: &mut Ui, facts: &Facts) {
        self.row(ui, facts);
        let Some(asked) = &self.asked else { return };
        ui.separator();
        rows::scrolled("explained").show(ui, |ui| {
            rows::scroll(ui);
            match &asked.told {
                Err(refused) => {
                    ui.colored_label(look::WRONG, refused);
                }
                Ok((explanation, texels)) => {
                    verdict(ui, explanation);
                    if let Some(texels) = texels {
                        texels.show(ui);
                    }
                    steps(ui, explanation);
                    matrices(ui, explanation);
                }
            }
        });
    }

    /// Which pixel. With the keyboard's focus the arrows move it: by one, with shift by ten.
    fn row(&mut self, ui: &mut Ui, facts: &Facts) {
        let [x, y] = self.place(facts.picture);
        ui.horizontal(|ui| {
            let text = RichText::new(format!("pixel {x},{y}")).monospace();
            let button = ui.selectable_label(self.is_pinned, text);
            if button.clicked() {
                self.is_pinned = !self.is_pinned;
            }
            if button.has_focus() {
                self.step(ui, button.id, [x, y]);
            }
            ui.weak(if self.is_pinned {
                "stays; a click lets it go"
            } else {
                "follows the pointer; a click keeps it"
            });
        });
    }

    fn step(&mut self, ui: &Ui, id: egui::Id, [x, y]: [u32; 2]) {
        let filter = egui::EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..egui::EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
        let [dx, dy] = ui.input(|input| {
            let far = if input.modifiers.shift { 10 } else { 1 };
            let presses = |key| input.num_presses(key) as i32 * far;
            [
                presses(Key::ArrowRight) - presses(Key::ArrowLeft),
                presses(Key::ArrowDown) - presses(Key::ArrowUp),
            ]
        });
        if [dx, dy] != [0, 0] {
            self.at = Some([x.saturating_add_signed(dx), y.saturating_add_signed(dy)]);
            self.is_pinned = true;
            ui.ctx().request_repaint();
        }
    }
}

fn explain(
    gl: &glow::Context,
    stage: &mut Stage,
    place: [u32; 2],
    light: usize,
) -> Result<(Explanation, Option<Texels>), String> {
    if let Some(mistake) = stage.mistake {
        return Err(format!(
            "the lab makes the mistake {}, expected none: the values in f64 beside the GPU's are those of the handout",
            mistake.name
        ));
    }
    if stage.lab.has_students_test() {
        let told =
            "the test is in a shader of yours, expected the lab's own, whose values are explained";
        return Err(told.to_owned());
    }
    let told = |error: crate::Error| error.to_string();
    let explanation = stage
        .lab
        .explain(gl, Probe::Pixel(place), light)
        .map_err(told)?;
    let map = stage.lab.shadow_texture(light).ok();
    let texels = match (&explanation.look_up, map) {
        (Some(look_up), Some(map)) => Some(Texels::read(gl, &map, look_up).map_err(told)?),
        _ => None,
    };
    Ok((explanation, texels))
}

fn verdict(ui: &mut Ui, explanation: &Explanation) {
    ui.horizontal_wrapped(|ui| {
        if let Some([red, green, blue]) = explanation.color {
            let (square, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
            let color = Color32::from_rgb(red, green, blue);
            ui.painter().rect_filled(square, 2.0, color);
            let text = format!("({red}, {green}, {blue})");
            ui.label(RichText::new(text).font(look::digits()));
        }
        match explanation.in_shadow {
            Some(true) => ui.strong("in shadow"),
            Some(false) => ui.strong("not in shadow"),
            None => ui.strong("no surface"),
        };
    });
    // The lab's name and the pixel stand above.
    let place = explanation.place.split_once(" shows ");
    ui.label(place.map_or(explanation.place.as_str(), |(_, seen)| seen));
    for (question, gpu, exact) in &explanation.tests {
        let answer = |yes: &bool| if *yes { "yes" } else { "no" };
        let mut text = format!("{question}: {}", answer(gpu));
        if gpu != exact {
            text += &format!(" (in f64: {})", answer(exact));
        }
        ui.label(RichText::new(text).size(12.0));
    }
    ui.add_space(4.0);
}

/// Each value, the GPU's and in f64, with how far they are apart.
fn steps(ui: &mut Ui, explanation: &Explanation) {
    if explanation.steps.is_empty() {
        return;
    }
    ui.separator();
    let digits = |text: String| RichText::new(text).font(look::digits());
    ui.weak(digits(format!(
        "{:>18}{:>16}{:>9}{:>9}",
        "GPU, f32", "in f64", "apart", "bound"
    )));
    for step in &explanation.steps {
        ui.label(RichText::new(step.name).size(12.0));
        for (i, component) in step.components.iter().enumerate() {
            let (gpu, exact, bound) = (step.gpu[i], step.exact[i], step.bound[i]);
            let apart = (gpu - exact).abs();
            let [apart_text, bound_text] = [apart, bound].map(short);
            let text =
                format!("{component:>4}{gpu:14.7}{exact:16.9}{apart_text:>9}{bound_text:>9}");
            let color = if apart <= bound {
                look::INK
            } else {
                look::WRONG
            };
            ui.label(digits(text).color(color));
        }
    }
}

/// A small number to one digit.
fn short(number: f64) -> String {
    match number {
        0.0 => "0".to_owned(),
        number => format!("{number:.0e}"),
    }
}

fn matrices(ui: &mut Ui, explanation: &Explanation) {
    if explanation.matrices.is_empty() {
        return;
    }
    ui.collapsing("matrices", |ui| {
        for (label, matrix) in &explanation.matrices {
            ui.label(RichText::new(*label).size(12.0));
            for row in 0..4 {
                let row = matrix.row(row).to_array().map(|n| format!("{n:12.5}"));
                ui.label(RichText::new(row.concat()).font(look::digits()));
            }
        }
    });
}
