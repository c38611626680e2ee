//! Rows of the panel: a name, and a control that keyboard and mouse can change.
//!
//! Tab and the arrows up and down go from row to row, as egui has it; the arrows left and right change a row.

use egui::scroll_area::ScrollSource;
use egui::style::ScrollAnimation;
use egui::{
    EventFilter, FontId, Id, InputState, Key, Pos2, Rect, Response, ScrollArea, Sense, Ui, Vec2,
    pos2, vec2,
};

use super::look;

/// Left and right arrows as one step each, where the control has the focus; then they do not move it.
pub fn steps(ui: &Ui, response: &Response) -> i32 {
    if !response.has_focus() {
        return 0;
    }
    let filter = EventFilter {
        horizontal_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    ui.input(|input| {
        input.num_presses(Key::ArrowRight) as i32 - input.num_presses(Key::ArrowLeft) as i32
    })
}

/// Where the pointer has just come to on a control. One that rests does not take part: the keyboard may be elsewhere.
pub fn pointed(ui: &Ui, response: &Response) -> Option<Pos2> {
    let acts =
        |input: &InputState| input.pointer.delta() != Vec2::ZERO || input.pointer.any_click();
    response.hover_pos().filter(|_| ui.input(acts))
}

/// Several values of which one is chosen, side by side, in as many lines as they need; `marked` has a dot below it.
/// Returns which one was chosen now.
pub fn choice(
    ui: &mut Ui,
    id: &str,
    values: &[&str],
    chosen: usize,
    marked: Option<usize>,
) -> (Option<usize>, Response) {
    let font = FontId::proportional(12.5);
    let color = look::INK;
    let texts: Vec<_> = values
        .iter()
        .map(|value| {
            ui.fonts_mut(|fonts| fonts.layout_no_wrap((*value).to_owned(), font.clone(), color))
        })
        .collect();

    // Where each value stands, line by line.
    let room = ui.available_width();
    let mut places: Vec<(Vec2, f32)> = Vec::new();
    let mut at = Vec2::ZERO;
    for text in &texts {
        let width = text.size().x + 14.0;
        if at.x > 0.0 && at.x + width > room {
            at = vec2(0.0, at.y + look::ROW + 2.0);
        }
        places.push((at, width));
        at.x += width + 2.0;
    }
    let widest = places.iter().map(|(at, width)| at.x + width);
    let size = vec2(widest.fold(0.0, f32::max), at.y + look::ROW);
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    let id: Id = ui.id().with(id);
    let response = ui.interact(area, id, Sense::click());

    let mut now = None;
    for (i, ((at, width), text)) in places.iter().zip(texts).enumerate() {
        let value = Rect::from_min_size(area.min + *at, vec2(*width, look::ROW));
        let pointed = response.hover_pos().is_some_and(|pos| value.contains(pos));
        if response.clicked() && pointed {
            now = Some(i);
        }
        let fill = match (i == chosen, pointed) {
            (true, _) => look::CHOSEN,
            (false, true) => look::RAISED.gamma_multiply(1.6),
            (false, false) => look::RAISED,
        };
        let painter = ui.painter();
        painter.rect_filled(value, look::ROUND, fill);
        let place = value.center() - 0.5 * text.size();
        painter.galley(place, text, color);
        if marked == Some(i) {
            let below = pos2(value.center().x, value.bottom() - 2.5);
            painter.circle_filled(below, 1.5, look::CHANGED);
        }
    }
    let ring = look::focus_ring(response.has_focus());
    let outside = egui::StrokeKind::Outside;
    ui.painter()
        .rect_stroke(area.expand(1.0), look::ROUND, ring, outside);

    let steps = steps(ui, &response);
    let stepped = (chosen as i32 + steps).clamp(0, values.len() as i32 - 1) as usize;
    if stepped != chosen {
        now = Some(stepped);
    }
    if response.has_focus() && steps != 0 {
        response.scroll_to_me(None);
    }
    (now.filter(|now| *now != chosen), response)
}

/// On or off: returns what it was turned to now. Space and Enter turn it, too.
pub fn switch(ui: &mut Ui, id: &str, on: bool, marked: Option<bool>) -> (Option<bool>, Response) {
    let place = |on: bool| usize::from(!on);
    let (chosen, response) = choice(ui, id, &["on", "off"], place(on), marked.map(place));
    let pressed = response.has_focus()
        && ui.input(|input| input.key_pressed(Key::Space) || input.key_pressed(Key::Enter));
    let turned = if pressed { Some(!on) } else { None };
    (chosen.map(|chosen| chosen == 0).or(turned), response)
}

/// Which of the lab's lights.
pub fn light(ui: &mut Ui, light: &mut usize, lights: usize) {
    let names: Vec<String> = (1..=lights).map(|n| format!("light {n}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    if let (Some(chosen), _) = choice(ui, "light", &names, *light - 1, None) {
        *light = chosen + 1;
    }
    ui.add_space(6.0);
}

/// What may be longer than there is room. The wheel scrolls it and not its bar, which would be a stop on the keyboard's way.
pub fn scrolled(id: &str) -> ScrollArea {
    ScrollArea::vertical()
        .id_salt(id)
        .scroll_source(ScrollSource::MOUSE_WHEEL)
        .auto_shrink([false, false])
}

/// Home and End scroll what does not fit, up and down.
pub fn scroll(ui: &Ui) {
    let pages =
        ui.input(|input| input.num_presses(Key::Home) as f32 - input.num_presses(Key::End) as f32);
    if pages != 0.0 {
        let page = 0.5 * ui.clip_rect().height();
        ui.scroll_with_delta_animation(vec2(0.0, pages * page), ScrollAnimation::none());
    }
}
