//! The classic mistakes that the lab can make, one at a time. The lab is started again with it, in the state that it has.

use egui::{EventFilter, FontId, Key, Label, Rect, RichText, Sense, Ui, pos2, vec2};

use super::{Facts, Wish, look, rows};
use crate::mistakes::{self, Made, Mistake};

/// Room for what a mistake is, at the bottom, in points.
const TOLD: f32 = 190.0;
/// Of a row of the list.
const ROW: f32 = 19.0;
/// What stands before the mistakes.
const NONE: &str = "none: as the handout has it";

#[derive(Default)]
pub struct Tab {
    /// The row that the pointer or the keyboard was last at; 0 is none.
    at: usize,
}

impl Tab {
    pub fn show(&mut self, ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
        if facts.own_shaders {
            ui.label("The lab draws with shaders of your own, whose mistakes are your own, too.");
            return;
        }
        if let Some(test) = other_test(facts) {
            ui.label(format!(
                "The mistakes are of the handout's test, expected shadow_test=handout, found {test}."
            ));
            return;
        }
        let of_lab: Vec<_> = mistakes::of_lab(facts.handout.name).collect();
        let is_made = |(mistake, _): &(&Mistake, &Made)| {
            facts.mistake.is_some_and(|made| made.name == mistake.name)
        };
        let made = of_lab.iter().position(is_made).map_or(0, |row| row + 1);
        let height = ui.available_height() - TOLD;
        let chosen = rows::scrolled("list")
            .max_height(height)
            .show(ui, |ui| self.list(ui, &of_lab, made))
            .inner;
        if let Some(row) = chosen.filter(|row| *row != made) {
            let mistake = row.checked_sub(1).map(|row| of_lab[row].0);
            wishes.push(Wish::Mistake(mistake));
        }
        ui.separator();
        match self.at.checked_sub(1).and_then(|row| of_lab.get(row)) {
            Some((mistake, made)) => tell(ui, mistake, made),
            None => {
                ui.weak("Enter, Space or a click makes a mistake: the lab starts again with it.");
            }
        }
    }

    /// One control for the keyboard: up and down move in it, Enter and Space choose. The row that was chosen now.
    fn list(&mut self, ui: &mut Ui, of_lab: &[(&Mistake, &Made)], made: usize) -> Option<usize> {
        let names = of_lab.iter().map(|(mistake, _)| mistake.name);
        let names: Vec<&str> = std::iter::once(NONE).chain(names).collect();
        let size = vec2(ui.available_width(), ROW * names.len() as f32);
        let (area, response) = ui.allocate_exact_size(size, Sense::click());
        if let Some(pointer) = rows::pointed(ui, &response) {
            self.at = ((pointer.y - area.top()) / ROW) as usize;
        }
        let mut chosen = response.clicked().then_some(self.at);
        if response.has_focus() {
            let filter = EventFilter {
                vertical_arrows: true,
                ..EventFilter::default()
            };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
            let (steps, enter) = ui.input(|input| {
                let presses = |key| input.num_presses(key) as i32;
                let steps = presses(Key::ArrowDown) - presses(Key::ArrowUp);
                (steps, presses(Key::Enter) + presses(Key::Space) > 0)
            });
            self.at = self.at.saturating_add_signed(steps as isize);
            if enter {
                chosen = Some(self.at);
            }
        }
        self.at = self.at.min(names.len() - 1);

        let row = |at: usize| {
            let corner = pos2(area.left(), area.top() + ROW * at as f32);
            Rect::from_min_size(corner, vec2(area.width(), ROW))
        };
        let painter = ui.painter();
        for (at, name) in names.iter().enumerate() {
            if at == made {
                painter.rect_filled(row(at), look::ROUND, look::CHOSEN);
            }
            if at == self.at {
                let ring = look::focus_ring(response.has_focus());
                let inside = egui::StrokeKind::Inside;
                painter.rect_stroke(row(at), look::ROUND, ring, inside);
            }
            let place = row(at).left_center() + vec2(6.0, 0.0);
            let font = if at == 0 {
                FontId::proportional(12.5)
            } else {
                look::digits()
            };
            painter.text(place, egui::Align2::LEFT_CENTER, name, font, look::INK);
        }
        if response.has_focus() {
            ui.scroll_to_rect(row(self.at), None);
        }
        chosen
    }
}

/// The shadow test in the handout's place, if there is one.
fn other_test(facts: &Facts) -> Option<&'static str> {
    let mut settings = facts.handout.settings.iter();
    let has_tests = settings.any(|setting| setting.name == "shadow_test");
    let test = has_tests.then(|| facts.settings.choice("shadow_test"))?;
    (test != "handout").then_some(test)
}

fn tell(ui: &mut Ui, mistake: &Mistake, made: &Made) {
    rows::scrolled("told").show(ui, |ui| {
        for (what, text) in [
            ("what it looks like", mistake.symptom),
            ("where it comes from", mistake.cause),
            ("how it is mended", mistake.fix),
            ("in the handout", made.place),
        ] {
            ui.colored_label(look::CHANGED, RichText::new(what).size(11.0));
            ui.add(Label::new(RichText::new(text).size(12.0)).selectable(false));
        }
    });
}
