//! Every setting of the lab's one table, with what it does, and the handout's value marked by a dot.

use egui::{Align2, Button, RichText, Sense, Ui, vec2};

use super::track::Track;
use super::{Facts, Wish, look, rows};
use crate::labs::{Kind, Setting, Settings};

/// Room for the longest name, in points.
const NAMES: f32 = 128.0;
/// Room for what the setting does, at the bottom.
const HELP: f32 = 76.0;

#[derive(Default)]
pub struct Tab {
    /// The setting that the pointer or the keyboard was last at.
    at: usize,
}

impl Tab {
    pub fn show(&mut self, ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
        let table = facts.handout.settings;
        let height = ui.available_height() - HELP;
        rows::scrolled("settings")
            .max_height(height)
            .show(ui, |ui| {
                for (i, setting) in table.iter().enumerate() {
                    let is_at = row(ui, setting, facts.settings, wishes);
                    if is_at {
                        self.at = i;
                    }
                }
            });
        ui.separator();
        help(ui, &table[self.at.min(table.len() - 1)]);
    }
}

/// One setting. Whether pointer or keyboard is at it.
fn row(ui: &mut Ui, setting: &Setting, settings: &Settings, wishes: &mut Vec<Wish>) -> bool {
    let default = setting.kind.default_text();
    let value = value_text(setting, settings);
    let mut set = |value: String| wishes.push(Wish::Set(format!("{}={value}", setting.name)));
    let is_changed = value != default;
    ui.horizontal_top(|ui| {
        let color = if is_changed { look::CHANGED } else { look::INK };
        let font = look::digits();
        let (place, name) = ui.allocate_exact_size(vec2(NAMES, look::ROW), Sense::hover());
        ui.painter().text(
            place.left_center(),
            Align2::LEFT_CENTER,
            setting.name,
            font,
            color,
        );
        let control = ui.vertical(|ui| {
            // As wide with the button behind it as without.
            ui.set_width(ui.available_width() - look::ROW - ui.spacing().item_spacing.x);
            control(ui, setting, settings, &mut set)
        });
        if is_changed {
            let button = ui.add(Button::new("↺").frame(false));
            if button
                .on_hover_text(format!("back to the handout's {default}"))
                .clicked()
            {
                set(default);
            }
        }
        let control = control.inner;
        let pointed = [&name, &control].map(|part| rows::pointed(ui, part).is_some());
        pointed.contains(&true) || control.has_focus()
    })
    .inner
}

fn control(
    ui: &mut Ui,
    setting: &Setting,
    settings: &Settings,
    set: &mut impl FnMut(String),
) -> egui::Response {
    match &setting.kind {
        Kind::Number { .. } => {
            let track = Track::new(&setting.kind).expect("it is a number");
            let number = settings.number(setting.name);
            let (changed, response) = track.show(ui, setting.name, number);
            changed.iter().for_each(|number| set(number.to_string()));
            response
        }
        Kind::Choice(values) => {
            let value = settings.choice(setting.name);
            let chosen = values.iter().position(|name| *name == value);
            let chosen = chosen.expect("a value of the table");
            let (now, response) = rows::choice(ui, setting.name, values, chosen, Some(0));
            now.iter().for_each(|now| set(values[*now].to_owned()));
            response
        }
        Kind::Switch { default } => {
            let on = settings.switch(setting.name);
            let (now, response) = rows::switch(ui, setting.name, on, Some(*default));
            let text = |on: bool| if on { "on" } else { "off" };
            now.iter().for_each(|now| set(text(*now).to_owned()));
            response
        }
    }
}

/// The value as `--set` writes it.
fn value_text(setting: &Setting, settings: &Settings) -> String {
    match setting.kind {
        Kind::Number { .. } => settings.number(setting.name).to_string(),
        Kind::Choice(_) => settings.choice(setting.name).to_owned(),
        Kind::Switch { .. } => {
            let on = settings.switch(setting.name);
            if on { "on" } else { "off" }.to_owned()
        }
    }
}

/// What the setting does, and what it takes: as hover text would have it, but for the keyboard, too.
fn help(ui: &mut Ui, setting: &Setting) {
    let (default, expected) = (setting.kind.default_text(), setting.kind.expected());
    ui.label(RichText::new(setting.help).size(12.0));
    let takes = match setting.kind {
        Kind::Number { .. } => format!("{expected}; the handout's: {default}"),
        _ => format!("the handout's: {default}"),
    };
    ui.weak(RichText::new(takes).size(12.0));
}
