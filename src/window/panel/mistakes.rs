//! The classic mistakes that the lab can make, one at a time. The lab is started again with it, in the state that it has.

use egui::{Label, RichText, ScrollArea, Sense, Ui};

use super::{Facts, Wish, look};
use crate::mistakes::{self, Made, Mistake};

/// Room for what a mistake is, at the bottom, in points.
const TOLD: f32 = 190.0;

#[derive(Default)]
pub struct Tab {
    /// The one that the pointer or the keyboard was last at.
    at: Option<&'static str>,
}

impl Tab {
    pub fn show(&mut self, ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
        if facts.own_shaders {
            ui.label("The lab draws with shaders of your own, whose mistakes are your own, too.");
            return;
        }
        let of_lab: Vec<_> = mistakes::of_lab(facts.handout.name).collect();
        let height = ui.available_height() - TOLD;
        ScrollArea::vertical()
            .max_height(height)
            .auto_shrink([false, false])
            .show(ui, |ui| {
                let made = facts.mistake.map(|mistake| mistake.name);
                let none = ui.selectable_label(made.is_none(), "none: as the handout has it");
                if none.has_focus() || none.hovered() {
                    self.at = None;
                }
                if none.clicked() && made.is_some() {
                    wishes.push(Wish::Mistake(None));
                }
                for (mistake, _) in &of_lab {
                    let name = RichText::new(mistake.name).monospace();
                    let response = ui.selectable_label(made == Some(mistake.name), name);
                    if response.has_focus() || response.hovered() {
                        self.at = Some(mistake.name);
                    }
                    if response.gained_focus() {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() && made != Some(mistake.name) {
                        wishes.push(Wish::Mistake(Some(mistake)));
                    }
                }
            });
        ui.separator();
        let at = self.at.or(facts.mistake.map(|mistake| mistake.name));
        match of_lab.iter().find(|(mistake, _)| Some(mistake.name) == at) {
            Some((mistake, made)) => tell(ui, mistake, made),
            None => {
                ui.weak("Enter, Space or a click makes a mistake: the lab starts again with it.");
            }
        }
    }
}

fn tell(ui: &mut Ui, mistake: &Mistake, made: &Made) {
    ScrollArea::vertical().id_salt("told").show(ui, |ui| {
        for (what, text) in [
            ("what it looks like", mistake.symptom),
            ("where it comes from", mistake.cause),
            ("how it is mended", mistake.fix),
            ("in the handout", made.place),
        ] {
            ui.colored_label(look::CHANGED, RichText::new(what).size(11.0));
            let text = Label::new(RichText::new(text).size(12.0));
            ui.add(text.sense(Sense::hover()));
        }
    });
}
