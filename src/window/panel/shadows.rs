//! What the lab's shadows are, and which of them are wrong by the rays.

use egui::{Color32, ColorImage, Painter, Rect, RichText, TextureHandle, TextureOptions, Ui, pos2};
use image::{Rgb, RgbImage};
use winit::event_loop::EventLoopProxy;

use super::truth::{Answer, Question, Truth};
use super::{Facts, Wish, look, rows};
use crate::labs::Show;
use crate::measure::{FALSE_LIGHT, FALSE_SHADOW, Figures, Wrong};
use crate::window::app::Wake;
use crate::window::stage::Stage;
use crate::{Result, gl};

/// How much is left of marks that are of an older state than the picture below them.
const OLD: f32 = 0.5;

pub struct Tab {
    wake: EventLoopProxy<Wake>,
    shows_visibility: bool,
    shows_truth: bool,
    /// None until somebody has asked.
    truth: Option<Truth>,
    answer: Option<Answer>,
    /// The answer's marks, once they are drawn.
    marks: Option<TextureHandle>,
    /// Why there is nothing to ask about.
    refused: Option<String>,
    /// Whether the answer is of the state in the picture.
    is_of_picture: bool,
}

impl Tab {
    pub fn new(wake: EventLoopProxy<Wake>) -> Self {
        Self {
            wake,
            shows_visibility: false,
            shows_truth: false,
            truth: None,
            answer: None,
            marks: None,
            refused: None,
            is_of_picture: false,
        }
    }

    /// What the window is to show.
    pub fn show(&self, stage: &Stage, light: usize) -> Show {
        match self.shows_visibility && refusal(stage, light).is_none() {
            true => Show::Visibility { light },
            false => Show::Picture,
        }
    }

    /// Takes an answer, and asks about the present state once the last answer is there.
    pub fn ask(&mut self, gl: &glow::Context, stage: &mut Stage, light: usize) -> Result<()> {
        if !self.shows_truth {
            return Ok(());
        }
        let wake = &self.wake;
        let truth = self.truth.get_or_insert_with(|| Truth::new(wake.clone()));
        if let Some(answer) = truth.answer() {
            self.answer = Some(answer);
            self.marks = None;
        }
        self.refused = refusal(stage, light);
        let now = (stage.changes(), light);
        let answered = self.answer.as_ref();
        self.is_of_picture = answered.is_some_and(|answer| (answer.changes, answer.light) == now);
        if self.refused.is_some() || self.is_of_picture || truth.is_busy() {
            return Ok(());
        }
        stage.lab.render(gl, Show::Visibility { light })?;
        truth.ask(Question {
            scene: stage.lab.now(),
            light,
            visibility: gl::read_grey(gl, stage.size()),
            map: stage.lab.shadow_texture(light).ok().map(|map| map.scale),
            changes: stage.changes(),
        });
        Ok(())
    }

    /// Red and blue over the picture.
    pub fn mark(&mut self, painter: &Painter, picture: Rect) {
        let Some(answer) = &self.answer else { return };
        if !self.shows_truth || self.refused.is_some() {
            return;
        }
        let marks = self.marks.get_or_insert_with(|| {
            let image = marks(&answer.mistakes);
            painter
                .ctx()
                .load_texture("mistakes", image, TextureOptions::NEAREST)
        });
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let strength = if self.is_of_picture { 1.0 } else { OLD };
        let tint = Color32::WHITE.gamma_multiply(strength);
        painter.image(marks.id(), picture, whole, tint);
    }

    pub fn lay_out(&mut self, ui: &mut Ui, facts: &Facts, light: usize, wishes: &mut Vec<Wish>) {
        ui.label("the window shows");
        let shows = usize::from(self.shows_visibility);
        let values = ["the picture", "visibility, by the lab's own test"];
        if let (Some(chosen), _) = rows::choice(ui, "shows", &values, shows, None) {
            self.shows_visibility = chosen == 1;
        }
        ui.add_space(6.0);

        ui.label("the depth map over it (the key m, too)");
        let is_shown = facts.depth_map == Some(light);
        if let (Some(on), _) = rows::switch(ui, "map", is_shown, None) {
            wishes.push(Wish::DepthMap(on.then_some(light)));
        }
        ui.add_space(6.0);

        ui.label("what is wrong by the rays, in f64");
        if let (Some(on), _) = rows::switch(ui, "truth", self.shows_truth, None) {
            self.shows_truth = on;
        }
        if !self.shows_truth {
            return;
        }
        ui.add_space(6.0);
        match (&self.refused, &self.answer) {
            (Some(refused), _) => {
                ui.colored_label(look::WRONG, refused);
            }
            (None, None) => {
                ui.weak("the first rays are on their way");
            }
            (None, Some(answer)) => {
                self.tell_age(ui, answer, facts);
                figures(ui, &answer.figures);
            }
        }
    }

    fn tell_age(&self, ui: &mut Ui, answer: &Answer, facts: &Facts) {
        let took = format!("{:.2} s of rays", answer.seconds);
        if self.is_of_picture {
            ui.label(format!("of what you see; {took}"));
        } else {
            let ago = facts.changes.saturating_sub(answer.changes);
            let text = format!("of {ago} changes ago; {took}; the next are on their way");
            ui.colored_label(look::CHANGED, text);
        }
    }
}

/// Why the lab's own visibility is not that of the picture.
fn refusal(stage: &Stage, light: usize) -> Option<String> {
    if stage.lab.has_students_test() {
        let told = "the test is in a shader of yours together with the lighting, expected the lab's own; `shadowlab \
                    measure --glsl` reads its shadows from pictures";
        return Some(told.to_owned());
    }
    let off = stage.lab.check_light(light).err();
    off.map(|error| error.to_string())
}

/// What is right is left out.
fn marks(mistakes: &RgbImage) -> ColorImage {
    let size = [mistakes.width() as usize, mistakes.height() as usize];
    let pixels = mistakes.pixels().map(|pixel| match *pixel {
        FALSE_SHADOW | FALSE_LIGHT => colour(*pixel),
        _ => Color32::TRANSPARENT,
    });
    ColorImage::new(size, pixels.collect())
}

fn colour(Rgb([red, green, blue]): Rgb<u8>) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

/// The figures of `shadowlab measure`.
fn figures(ui: &mut Ui, figures: &Figures) {
    let digits = |text: String| RichText::new(text).font(look::digits());
    ui.add_space(4.0);
    egui::Grid::new("figures")
        .spacing([10.0, 4.0])
        .show(ui, |ui| {
            for head in ["", "pixels", "share", "edge1", "edgeT", "interior"] {
                ui.weak(RichText::new(head).size(11.0));
            }
            ui.end_row();
            let mut row = |name, color, wrong: &Wrong, of: usize| {
                ui.horizontal(|ui| {
                    let side = egui::vec2(10.0, 10.0);
                    let (square, _) = ui.allocate_exact_size(side, egui::Sense::hover());
                    ui.painter().rect_filled(square, 2.0, colour(color));
                    ui.label(name);
                });
                let share = 100.0 * wrong.total() as f64 / of.max(1) as f64;
                ui.label(digits(wrong.total().to_string()));
                ui.label(digits(format!("{share:.3}%")));
                for count in [wrong.edge1, wrong.edge_t, wrong.interior] {
                    ui.label(digits(count.to_string()));
                }
                ui.end_row();
            };
            row(
                "false shadow",
                FALSE_SHADOW,
                &figures.false_shadow,
                figures.lit,
            );
            row(
                "false light",
                FALSE_LIGHT,
                &figures.false_light,
                figures.shadowed,
            );
        });
    ui.add_space(4.0);
    let ambiguous = figures.false_shadow.ambiguous + figures.false_light.ambiguous;
    ui.label(format!(
        "{} pixels lit in truth, {} in shadow; {ambiguous} more wrong where the truth itself hangs on a hair",
        figures.lit, figures.shadowed
    ));
    if let Some(bias) = figures.bias {
        ui.label(format!(
            "bias {} in depth: {:.4} world units, {:.2} texels at the median lit pixel",
            bias.depth, bias.world, bias.texels
        ));
    }
    ui.add_space(4.0);
    let told = "edge1: within a pixel of the truth's edge. edgeT: within a texel of it, which the map cannot resolve. \
                interior: neither, so a fault of the method.";
    ui.weak(RichText::new(told).size(12.0));
}
