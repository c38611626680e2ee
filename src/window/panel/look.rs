//! Colours, letters and distances.

use egui::{Color32, CornerRadius, FontFamily, FontId, Frame, Margin, Stroke, TextStyle, Theme};

/// As the viewer's other texts have them (see `text`).
pub const GROUND: Color32 = Color32::from_rgb(18, 20, 27);
pub const INK: Color32 = Color32::from_rgb(226, 226, 220);
const WEAK: Color32 = Color32::from_rgb(140, 144, 152);
/// What a row stands on.
pub const RAISED: Color32 = Color32::from_rgb(36, 40, 50);
/// What is chosen, and what has the keyboard's focus.
pub const CHOSEN: Color32 = Color32::from_rgb(62, 92, 148);
pub const FOCUS: Color32 = Color32::from_rgb(255, 200, 92);
/// What differs from the handout.
pub const CHANGED: Color32 = Color32::from_rgb(255, 200, 92);
pub const WRONG: Color32 = Color32::from_rgb(255, 120, 110);

/// Of a row that holds a control.
pub const ROW: f32 = 21.0;
pub const ROUND: CornerRadius = CornerRadius::same(4);

/// Around what has the keyboard's focus.
pub fn focus_ring(has_focus: bool) -> Stroke {
    Stroke::new(if has_focus { 1.5 } else { 0.0 }, FOCUS)
}

/// Numbers stand below each other.
pub fn digits() -> FontId {
    FontId::monospace(11.0)
}

/// The panel's own ground; its edge tells whether it has the keyboard.
pub fn ground(has_keys: bool) -> Frame {
    let edge = if has_keys { FOCUS } else { RAISED };
    Frame::new()
        .fill(GROUND)
        .inner_margin(Margin::same(10))
        .stroke(Stroke::new(1.0, edge))
}

pub fn apply(egui: &egui::Context) {
    egui.set_theme(Theme::Dark);
    egui.style_mut_of(Theme::Dark, |style| {
        let of = |family, size| FontId::new(size, family);
        for (text, font) in [
            (TextStyle::Body, of(FontFamily::Proportional, 13.0)),
            (TextStyle::Button, of(FontFamily::Proportional, 13.0)),
            (TextStyle::Small, of(FontFamily::Proportional, 11.0)),
            (TextStyle::Monospace, of(FontFamily::Monospace, 11.5)),
        ] {
            style.text_styles.insert(text, font);
        }
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        style.spacing.interact_size.y = ROW;
        // Nothing slides: a picture of the panel is the same whenever it is taken.
        style.animation_time = 0.0;
        style.visuals.panel_fill = GROUND;
        style.visuals.override_text_color = Some(INK);
        style.visuals.weak_text_color = Some(WEAK);
        style.visuals.selection.bg_fill = CHOSEN;
        style.visuals.selection.stroke.color = INK;
        let widgets = &mut style.visuals.widgets;
        for state in [&mut widgets.hovered, &mut widgets.active] {
            state.bg_stroke = Stroke::new(1.5, FOCUS);
        }
        widgets.inactive.weak_bg_fill = RAISED;
    });
}
