//! A number on a track, from its least to its most value.

use egui::{DragValue, Response, Sense, Ui, pos2, vec2};

use super::{look, rows};
use crate::labs::Kind;

/// How a number moves along its track.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Along {
    /// Sizes of maps double.
    Doubling,
    /// A bias that is small in a wide range needs room at its small end.
    Cubic,
    Evenly,
}

/// A number setting, as the track has it.
#[derive(Clone, Copy, Debug)]
pub struct Track {
    default: f64,
    least: f64,
    most: f64,
    along: Along,
    step: f64,
}

/// The least size that doubles from step to step.
const SMALLEST_MAP: f64 = 16.0;

impl Track {
    /// None where the setting is no number.
    pub fn new(kind: &Kind) -> Option<Self> {
        let Kind::Number {
            default,
            least,
            most,
            whole,
        } = *kind
        else {
            return None;
        };
        let range = most - least;
        let along = if whole && least >= SMALLEST_MAP {
            Along::Doubling
        } else if !whole && 0.0 < default && default < range / 50.0 {
            Along::Cubic
        } else {
            Along::Evenly
        };
        // A hundredth of the range, and of the default a tenth, as 1, 2 or 5 of a power of ten.
        let fine = if default > 0.0 { default / 10.0 } else { range };
        let step = if whole {
            1.0
        } else {
            round_step(fine.min(range / 100.0))
        };
        Some(Self {
            default,
            least,
            most,
            along,
            step,
        })
    }

    /// 0…1 along the track.
    fn place(&self, value: f64) -> f64 {
        match self.along {
            Along::Doubling => (value / self.least).log2() / (self.most / self.least).log2(),
            Along::Cubic => ((value - self.least) / (self.most - self.least)).cbrt(),
            Along::Evenly => (value - self.least) / (self.most - self.least),
        }
    }

    fn value_at(&self, place: f64) -> f64 {
        let place = place.clamp(0.0, 1.0);
        let range = self.most - self.least;
        self.rounded(match self.along {
            Along::Doubling => {
                let doublings = place * (self.most / self.least).log2();
                self.least * doublings.round().exp2()
            }
            Along::Cubic => self.least + range * place.powi(3),
            Along::Evenly => self.least + range * place,
        })
    }

    fn stepped(&self, value: f64, steps: i32) -> f64 {
        self.rounded(match self.along {
            Along::Doubling => value * f64::from(steps).exp2(),
            _ => value + f64::from(steps) * self.step,
        })
    }

    /// To a whole step, within the range, and without what f64 adds behind the last digit.
    fn rounded(&self, value: f64) -> f64 {
        let steps = (value / self.step).round();
        let value = format!("{:.9}", steps * self.step);
        let value: f64 = value.parse().expect("a number that was just written");
        value.clamp(self.least, self.most)
    }

    /// The control. What the value was changed to now, if anything.
    pub fn show(&self, ui: &mut Ui, id: &str, value: f64) -> (Option<f64>, Response) {
        ui.horizontal(|ui| {
            let size = vec2(ui.available_width() - 72.0, look::ROW);
            let (area, _) = ui.allocate_exact_size(size, Sense::hover());
            let id = ui.id().with(id);
            let response = ui.interact(area, id, Sense::click_and_drag());
            let mut now = value;
            if let Some(pointer) = response.interact_pointer_pos() {
                now = self.value_at(f64::from((pointer.x - area.left()) / area.width()));
                response.request_focus();
            }
            let steps = rows::steps(ui, &response);
            if steps != 0 {
                now = self.stepped(value, steps);
                response.scroll_to_me(None);
            }

            let painter = ui.painter();
            let at = |value: f64| {
                let place = self.place(value).clamp(0.0, 1.0) as f32;
                pos2(area.left() + place * area.width(), area.center().y)
            };
            let thin = 2.0;
            let line = |to: f32, color| {
                let left = pos2(area.left(), area.center().y - thin);
                let right = pos2(to, area.center().y + thin);
                let bar = egui::Rect::from_min_max(left, right);
                painter.rect_filled(bar, thin, color);
            };
            line(area.right(), look::RAISED);
            line(at(now).x, look::CHOSEN);
            // The handout's value.
            let mark = at(self.default);
            painter.circle_filled(pos2(mark.x, area.bottom() - 2.5), 1.5, look::CHANGED);
            painter.circle_filled(at(now), 5.0, look::INK);
            let ring = look::focus_ring(response.has_focus());
            let outside = egui::StrokeKind::Outside;
            painter.rect_stroke(area.expand(1.0), look::ROUND, ring, outside);

            let typed = ui.add_sized(
                vec2(60.0, look::ROW),
                DragValue::new(&mut now)
                    .range(self.least..=self.most)
                    .speed(self.step)
                    .custom_formatter(|number, _| number.to_string())
                    .update_while_editing(false),
            );
            let changed = (now != value).then_some(now);
            (changed, response.union(typed))
        })
        .inner
    }
}

/// Down to 1, 2 or 5 of a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let of = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|of| of * power <= step * 1.000_001);
    of.unwrap_or(1.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(default: f64, least: f64, most: f64, whole: bool) -> Track {
        Track::new(&Kind::Number {
            default,
            least,
            most,
            whole,
        })
        .unwrap()
    }

    #[test]
    fn sizes_double_and_small_numbers_have_small_steps() {
        let size = track(1024.0, 256.0, 8192.0, true);
        assert_eq!(size.stepped(1024.0, 1), 2048.0);
        assert_eq!(size.stepped(8192.0, 1), 8192.0);
        assert_eq!(size.stepped(256.0, -1), 256.0);
        let epsilon = track(0.001, 0.0, 0.1, false);
        assert_eq!(epsilon.stepped(0.001, 2), 0.0012);
        assert_eq!(epsilon.stepped(0.0, -1), 0.0);
        let balls = track(20.0, 0.0, 100.0, true);
        assert_eq!(balls.stepped(20.0, -1), 19.0);
        let angle = track(60.0, 1.0, 179.0, false);
        assert_eq!(angle.stepped(60.0, 1), 61.0);
    }

    #[test]
    fn the_track_has_a_place_for_each_value() {
        for track in [
            track(1024.0, 256.0, 8192.0, true),
            track(0.001, 0.0, 0.1, false),
            track(2.0, 0.0, 64.0, false),
        ] {
            for value in [track.least, track.default, track.most] {
                assert_eq!(track.value_at(track.place(value)), value, "{track:?}");
            }
        }
    }

    #[test]
    fn a_step_is_1_2_or_5() {
        for (step, rounded) in [(0.003, 0.002), (0.0001, 0.0001), (1.79, 1.0), (7.0, 5.0)] {
            assert!((round_step(step) - rounded).abs() < 1e-12, "{step}");
        }
    }
}
