//! Plots with two logarithmic axes.

use std::ops::Range;

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// In the page's pixels.
const SIZE: (u32, u32) = (720, 440);

/// Told apart by the colour-blind, too: Okabe and Ito (2008), without their yellow, which white paper swallows.
pub const COLORS: [[u8; 3]; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [0, 0, 0],
];

/// Points that are joined.
pub struct Curve {
    pub name: String,
    pub color: [u8; 3],
    pub points: Vec<(f64, f64)>,
    /// Below and above each point; empty where nothing is known of it.
    pub ranges: Vec<[f64; 2]>,
}

/// A thin line of a known slope, through a point.
pub struct Guide {
    pub name: &'static str,
    pub slope: f64,
    pub through: (f64, f64),
}

pub struct Plot<'a> {
    pub x: &'a str,
    pub y: &'a str,
    pub curves: &'a [Curve],
    pub guides: &'a [Guide],
    pub x_ticks: Vec<f64>,
}

impl Plot<'_> {
    /// As SVG, to stand in a page. Points at 0 have no place on a logarithmic axis and are left out.
    pub fn svg(&self) -> String {
        let mut svg = String::new();
        // Nothing that draws into memory can fail.
        self.draw(&mut svg)
            .expect("a plot can be drawn into memory");
        svg
    }

    fn draw(&self, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let x = range(points().map(|(x, _)| *x));
        let y = range(points().map(|(_, y)| *y));
        let x_ticks = self.x_ticks.iter().copied().filter(|tick| x.contains(tick));
        let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(8)
            .x_label_area_size(44)
            .y_label_area_size(78)
            .build_cartesian_2d(
                x.clone().log_scale().with_key_points(x_ticks.collect()),
                y.clone().log_scale().with_key_points(ticks(&y)),
            )?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .x_label_formatter(&|x| format!("{x}"))
            .y_label_formatter(&|y| format!("{}", (1e6 * y).round() / 1e6))
            .x_desc(self.x)
            .y_desc(self.y)
            .label_style(("sans-serif", 15))
            .axis_desc_style(("sans-serif", 17))
            .draw()?;
        let grey = BLACK.mix(0.6);
        let label = ("sans-serif", 14).into_text_style(&root).color(&grey);
        let label = label.pos(Pos::new(HPos::Right, VPos::Bottom));
        for Guide {
            name,
            slope,
            through,
        } in self.guides
        {
            // As far as it stays in the plot.
            let at = |x: f64| (x, through.1 * (x / through.0).powf(*slope));
            let steps = (0..=100).map(|i| x.start * (x.end / x.start).powf(f64::from(i) / 100.0));
            let line: Vec<_> = steps.map(at).filter(|(_, y_at)| y.contains(y_at)).collect();
            let Some(end) = line.last().copied() else {
                continue;
            };
            chart.draw_series([PathElement::new(line, BLACK.mix(0.35))])?;
            chart.draw_series([Text::new(*name, end, label.clone())])?;
        }
        for curve in self.curves {
            let [red, green, blue] = curve.color;
            let color = RGBColor(red, green, blue);
            for (point, [low, high]) in curve.points.iter().zip(&curve.ranges) {
                let bar = vec![(point.0, low.max(y.start)), (point.0, high.min(y.end))];
                chart.draw_series([PathElement::new(bar, color.mix(0.4).stroke_width(3))])?;
            }
            let points: Vec<_> = curve
                .points
                .iter()
                .copied()
                .filter(|(_, y)| *y > 0.0)
                .collect();
            chart.draw_series([PathElement::new(points.clone(), color.stroke_width(2))])?;
            let dots = points
                .into_iter()
                .map(|point| Circle::new(point, 4, color.filled()));
            chart.draw_series(dots)?;
        }
        root.present()?;
        Ok(())
    }
}

/// Around the values above 0, with some room.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let values: Vec<f64> = values.filter(|value| *value > 0.0).collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(0.0, f64::max);
    if least > most {
        return 0.1..1.0;
    }
    least / 1.25..most * 1.25
}

/// 1, 2 and 5 of each power of ten.
pub fn ticks(range: &Range<f64>) -> Vec<f64> {
    let decades = (-9..10).flat_map(|power| [1.0, 2.0, 5.0].map(|n| n * 10.0_f64.powi(power)));
    decades.filter(|tick| range.contains(tick)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_what_they_show() {
        let around = range([0.0, 0.02, 3.0].into_iter());
        assert!(around.contains(&0.02) && around.contains(&3.0));
        assert_eq!(ticks(&around), [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0]);
        assert_eq!(range([0.0].into_iter()), 0.1..1.0);
    }
}
