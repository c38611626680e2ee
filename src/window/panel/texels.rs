//! The texels around a look-up, with what they store against what is compared: lit or in shadow, texel by texel.

use egui::{Align2, Color32, FontId, Rect, RichText, Sense, Stroke, Ui, pos2, vec2};
use glam::DVec2;

use super::look;
use crate::labs::{LookUp, ShadowTexture};
use crate::{Result, gl};

/// Texels along a side; odd, so that one is in the middle.
const SIDE: i64 = 7;
/// Of a texel, in points.
const CELL: f32 = 36.0;

const LIT: Color32 = Color32::from_rgb(205, 196, 160);
const DARK: Color32 = Color32::from_rgb(58, 62, 78);
const OFF_MAP: Color32 = Color32::from_rgb(28, 30, 38);

pub struct Texels {
    /// Of the left bottom one.
    first: [i64; 2],
    /// Row by row from the bottom; None off the map.
    stored: Vec<Option<f64>>,
    compared: f64,
    /// In texels from the map's left and bottom edge.
    place: DVec2,
    size: u32,
}

impl Texels {
    pub fn read(gl: &glow::Context, map: &ShadowTexture, look_up: &LookUp) -> Result<Self> {
        let size = map.scale.size;
        let place = look_up.uv * f64::from(size);
        let first = [place.x, place.y].map(|at| at.floor() as i64 - SIDE / 2);
        // What of the neighbourhood is on the map.
        let clamp = |at: i64| at.clamp(0, size.into());
        let from = first.map(clamp);
        let count = [0, 1].map(|axis| (clamp(first[axis] + SIDE) - from[axis]) as u32);
        let read = if count.contains(&0) {
            Vec::new()
        } else {
            gl::read_depth_texels(gl, map.texture, from.map(|at| at as u32), count)?
        };
        let at = |x: i64, y: i64| {
            let (column, row) = (x - from[0], y - from[1]);
            let is_read =
                (0..count[0].into()).contains(&column) && (0..count[1].into()).contains(&row);
            is_read.then(|| f64::from(read[(row * i64::from(count[0]) + column) as usize]))
        };
        let all = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        Ok(Self {
            first,
            stored: all.map(|(x, y)| at(first[0] + x, first[1] + y)).collect(),
            compared: look_up.depth,
            place,
            size,
        })
    }

    pub fn show(&self, ui: &mut Ui) {
        let told = format!(
            "texel {}, {} of {}²; compared depth {:.7}",
            self.first[0] + SIDE / 2,
            self.first[1] + SIDE / 2,
            self.size,
            self.compared
        );
        ui.label(RichText::new(told).font(look::digits()));
        let unit = self.unit();
        let whole = vec2(CELL, CELL) * SIDE as f32;
        let (area, _) = ui.allocate_exact_size(whole, Sense::hover());
        let painter = ui.painter_at(area);
        for (i, stored) in self.stored.iter().enumerate() {
            let (x, y) = (i as i64 % SIDE, i as i64 / SIDE);
            // The map's rows go up, the panel's down.
            let corner = area.min + vec2(x as f32, (SIDE - 1 - y) as f32) * CELL;
            let cell = Rect::from_min_size(corner, vec2(CELL, CELL)).shrink(0.5);
            let fill = match stored {
                None => OFF_MAP,
                Some(stored) if *stored < self.compared => DARK,
                Some(_) => LIT,
            };
            painter.rect_filled(cell, 0.0, fill);
            let Some(stored) = stored else { continue };
            let ink = if fill == LIT {
                Color32::BLACK
            } else {
                look::INK
            };
            let number = difference((stored - self.compared) / unit);
            let font = FontId::monospace(10.0);
            painter.text(cell.center(), Align2::CENTER_CENTER, number, font, ink);
        }
        self.draw_place(ui, area);
        let told = format!(
            "stored less compared, in {unit} of depth: below zero in shadow. The cross is the look-up."
        );
        ui.weak(RichText::new(told).size(12.0));
    }

    /// The cross where the look-up is, and the texel that it falls into.
    fn draw_place(&self, ui: &Ui, area: Rect) {
        let painter = ui.painter_at(area);
        let at = self.place - DVec2::new(self.first[0] as f64, self.first[1] as f64);
        let at = pos2(
            area.left() + at.x as f32 * CELL,
            area.bottom() - at.y as f32 * CELL,
        );
        let middle = SIDE as f32 * CELL / 2.0;
        let texel = Rect::from_center_size(area.min + vec2(middle, middle), vec2(CELL, CELL));
        let inside = egui::StrokeKind::Inside;
        painter.rect_stroke(texel, 0.0, Stroke::new(2.0, look::FOCUS), inside);
        for (color, width) in [(Color32::BLACK, 4.0), (look::FOCUS, 2.0)] {
            let stroke = Stroke::new(width, color);
            painter.line_segment([at - vec2(6.0, 0.0), at + vec2(6.0, 0.0)], stroke);
            painter.line_segment([at - vec2(0.0, 6.0), at + vec2(0.0, 6.0)], stroke);
        }
    }

    /// The power of ten in which the median difference has one digit before its point.
    fn unit(&self) -> f64 {
        let stored = self.stored.iter().flatten();
        let mut apart: Vec<f64> = stored
            .map(|stored| (stored - self.compared).abs())
            .collect();
        if apart.is_empty() {
            return 1.0;
        }
        let middle = apart.len() / 2;
        let (_, median, _) = apart.select_nth_unstable_by(middle, f64::total_cmp);
        // Finer than a depth buffer's 24 bits there is nothing.
        10f64.powi(median.max(1e-7).log10().floor() as i32)
    }
}

/// In few letters.
fn difference(number: f64) -> String {
    match number.abs() {
        small if small < 99.95 => format!("{number:+.1}"),
        middle if middle < 9999.5 => format!("{number:+.0}"),
        _ => format!("{number:+.0e}"),
    }
}
