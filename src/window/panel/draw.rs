//! A frame of the panel: what it wants to know of the lab, what it shows, and what a person has done in it.

use std::time::{Duration, Instant};

use egui::{
    Context, Event, Key, LayerId, Modifiers, RawInput, Rect, SidePanel, Ui, ViewportId, pos2, vec2,
};
use winit::window::Window;

use super::{Facts, Panel, Seen, TABS, Tab, WIDTH, Wish, look, rows};
use crate::window::canvas::Canvas;
use crate::window::stage::Stage;
use crate::{Result, gl};

impl Panel {
    /// Draws the lab as the panel wants to see it, after what the panel wants to know of it.
    pub fn draw_lab(&mut self, gl: &glow::Context, stage: &mut Stage) -> Result<()> {
        let light = self.light;
        self.shadows.ask(gl, stage, light)?;
        if self.tab == Tab::Pixel {
            self.pixel.ask(gl, stage, light);
        }
        let show = self.shadows.show(stage, light);
        if self.tab == Tab::Passes {
            let (drawn, times) = gl::time_passes(|| stage.lab.render(gl, show));
            self.passes.add(&times);
            drawn
        } else {
            stage.lab.render(gl, show)
        }
    }

    /// Draws the panel beside the picture.
    pub fn draw(&mut self, canvas: &Canvas, stage: &mut Stage, seen: &Seen) -> Result<Vec<Wish>> {
        let settings = stage.lab.settings().clone();
        let facts = Facts {
            handout: stage.handout,
            settings: &settings,
            mistake: stage.mistake,
            own_shaders: stage.glsl.is_some(),
            picture: stage.size(),
            depth_map: seen.depth_map,
            changes: stage.changes(),
        };
        let window = &canvas.window;
        let input = self.next_events(window);
        let behind = RawInput {
            events: Vec::new(),
            ..input.clone()
        };
        let mut wishes = Vec::new();
        let egui = self.egui.clone();
        let mut output = egui.run(input, |egui| self.lay_out(egui, &facts, &mut wishes));
        output.append(egui.run(behind, |egui| self.lay_out(egui, &facts, &mut wishes)));
        self.events
            .handle_platform_output(window, output.platform_output);
        let delay = output.viewport_output.get(&ViewportId::ROOT);
        let delay = delay.map_or(Duration::MAX, |output| output.repaint_delay);
        let now = Instant::now();
        let waiting = !self.events.egui_input().events.is_empty();
        let next = [
            now.checked_add(delay),
            self.pixel.next_frame(),
            waiting.then_some(now),
        ];
        self.next_frame = next.into_iter().flatten().min();

        let scale = output.pixels_per_point;
        let shapes = self.egui.tessellate(output.shapes, scale);
        canvas.draw_beside(&self.beside, || {
            let textures = &output.textures_delta;
            self.painter
                .paint_and_update_textures(seen.window, scale, &shapes, textures);
        })?;
        Ok(wishes)
    }

    /// Up to the first press of a key; what comes after it waits for the next frame. For egui moves its focus by one key
    /// in a pass, and learns in the pass behind it which keys the control that has it now keeps for itself.
    fn next_events(&mut self, window: &Window) -> RawInput {
        let mut input = self.events.take_egui_input(window);
        let is_press = |event: &Event| matches!(event, Event::Key { pressed: true, .. });
        if let Some(first) = input.events.iter().position(is_press) {
            let later = input.events.split_off(first + 1);
            self.events.egui_input_mut().events = later;
        }
        input
    }

    fn lay_out(&mut self, egui: &Context, facts: &Facts, wishes: &mut Vec<Wish>) {
        let scale = egui.pixels_per_point();
        let picture = Rect::from_min_size(
            pos2(0.0, 0.0),
            vec2(facts.picture[0] as f32, facts.picture[1] as f32) / scale,
        );
        let over_picture = egui.layer_painter(LayerId::background());
        self.shadows.mark(&over_picture, picture);
        if self.tab == Tab::Pixel {
            self.pixel.mark(&over_picture, picture, facts.picture);
        }
        SidePanel::right("panel")
            .exact_width(WIDTH as f32)
            .resizable(false)
            .frame(look::ground(self.has_keys))
            .show(egui, |ui| {
                self.head(ui, facts);
                ui.add_space(6.0);
                let lights = facts.handout.lights;
                if lights > 1 && matches!(self.tab, Tab::Shadows | Tab::Pixel) {
                    rows::light(ui, &mut self.light, lights);
                }
                match self.tab {
                    Tab::Settings => self.settings.show(ui, facts, wishes),
                    Tab::Mistakes => self.mistakes.show(ui, facts, wishes),
                    Tab::Passes => self.passes.show(ui),
                    Tab::Shadows => self.shadows.lay_out(ui, facts, self.light, wishes),
                    Tab::Pixel => self.pixel.show(ui, facts),
                }
            });
    }

    /// The tabs, and whose the keyboard is.
    fn head(&mut self, ui: &mut Ui, facts: &Facts) {
        ui.horizontal(|ui| {
            ui.strong(facts.handout.name);
            if let Some(mistake) = facts.mistake {
                ui.colored_label(look::WRONG, format!("with {}", mistake.name));
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let whose = if self.has_keys {
                    "Escape: keys to the lab"
                } else {
                    "F2: keys to the panel"
                };
                ui.weak(whose);
            });
        });
        // PageUp and PageDown turn the tabs from wherever the focus is.
        if self.has_keys {
            let turned = ui.input_mut(|input| {
                let none = Modifiers::NONE;
                i32::from(input.consume_key(none, Key::PageDown))
                    - i32::from(input.consume_key(none, Key::PageUp))
            });
            if turned != 0 {
                let at = TABS.iter().position(|(tab, _)| *tab == self.tab);
                let at = at.expect("a tab of the table") as i32 + turned;
                self.tab = TABS[at.rem_euclid(TABS.len() as i32) as usize].0;
                self.focus_tabs = true;
            }
        }
        let names = TABS.map(|(_, name)| name);
        let at = TABS.iter().position(|(tab, _)| *tab == self.tab);
        let (chosen, response) = rows::choice(ui, "tabs", &names, at.unwrap_or(0), None);
        if std::mem::take(&mut self.focus_tabs) {
            response.request_focus();
        }
        if let Some(chosen) = chosen {
            self.tab = TABS[chosen].0;
        }
    }
}
