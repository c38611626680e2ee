//! A cost over a size, both axes logarithmic: a line for each shadow test, beside one that grows as the size does.

use std::ops::Range;

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;

use super::Axis;
use super::growth::Cost;
use super::run::TEXELS;
use crate::report::plot::{COLORS, ticks};

/// In the page's pixels: two stand side by side.
const SIZE: (u32, u32) = (620, 400);
const RADIUS: i32 = 4;

/// A point and the interval of its cost.
type Place = (f64, f64, [f64; 2]);

/// The plot as SVG, to stand in a page.
pub fn svg(axis: &Axis, cost: &Cost) -> String {
    let mut svg = String::new();
    // Nothing that draws into memory can fail.
    draw(axis, cost, &mut svg).expect("a plot can be drawn into memory");
    svg
}

/// The colour of the series of that number, as CSS writes it.
pub fn color(series: usize) -> String {
    let RGBColor(red, green, blue) = COLORS[series];
    format!("rgb({red}, {green}, {blue})")
}

fn places(axis: &Axis, cost: &Cost) -> Vec<Vec<Place>> {
    let series = axis.series.iter().map(|series| {
        let points = series.points.iter().map(|point| {
            let (median, interval) = cost.of(&point.row);
            (point.count as f64, median, interval.unwrap_or([median; 2]))
        });
        points.collect()
    });
    series.collect()
}

fn draw(axis: &Axis, cost: &Cost, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let places = places(axis, cost);
    let largest = places.iter().max_by_key(|series| series.len());
    let sizes: Vec<f64> = largest.iter().flat_map(|s| s.iter().map(|p| p.0)).collect();
    let (least, most) = (sizes[0], sizes[sizes.len() - 1]);
    let ends = || places.iter().flatten().flat_map(|(_, _, ends)| *ends);
    let low = ends().fold(f64::INFINITY, f64::min);
    let high = ends().fold(0.0, f64::max);
    let x = 0.8 * least..1.25 * most;
    // At least a decade high: what hardly grows must not look as if it did.
    let y = (0.7 * low).min(0.1 * high)..1.5 * high;

    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let mut chart = ChartBuilder::on(&root)
        .margin(8)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d(
            x.clone().log_scale().with_key_points(x_ticks(axis, &sizes)),
            y.clone().log_scale().with_key_points(ticks(&y)),
        )?;
    let unit = axis.unit;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_label_formatter(&|x| x_label(unit, *x))
        .y_label_formatter(&|y| format!("{}", (1e6 * y).round() / 1e6))
        .x_desc(x_description(unit))
        .y_desc(if cost.name == "memory" { "MiB" } else { "ms" })
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 17))
        .draw()?;

    for guide in guides(&y, least, most, high) {
        chart.draw_series([PathElement::new(guide, BLACK.mix(0.3))])?;
    }
    for (i, series) in places.iter().enumerate() {
        let color = COLORS[i];
        let line: Vec<_> = match series[..] {
            // It has no such size: the same at all of them.
            [(_, y, _)] => vec![(least, y), (most, y)],
            _ => series.iter().map(|(x, y, _)| (*x, *y)).collect(),
        };
        chart.draw_series([PathElement::new(line, color.stroke_width(2))])?;
        if series.len() == 1 {
            continue;
        }
        for (x, y, [low, high]) in series {
            let interval = vec![(*x, *low), (*x, *high)];
            chart.draw_series([PathElement::new(interval, color.mix(0.6))])?;
            chart.draw_series([Circle::new((*x, *y), RADIUS, color.filled())])?;
        }
    }
    root.present()?;
    Ok(())
}

/// Lines of slope 1 a decade apart, from the lower edge or the left to the upper edge or the right.
fn guides(y: &Range<f64>, least: f64, most: f64, high: f64) -> Vec<Vec<(f64, f64)>> {
    let decades = (0..).map(|i| 10_f64.powi(i));
    // From the line that ends in the highest point, to the left.
    let costs = decades.map(|decade| decade * high / most);
    let visible = costs.take_while(|per_size| per_size * least < y.end);
    let line = |per_size: f64| {
        let from = least.max(y.start / per_size);
        let to = most.min(y.end / per_size);
        vec![(from, per_size * from), (to, per_size * to)]
    };
    visible.map(line).collect()
}

fn x_ticks(axis: &Axis, sizes: &[f64]) -> Vec<f64> {
    match axis.unit {
        TEXELS => sizes.to_vec(),
        _ => (3..8).map(|power| 10_f64.powi(power)).collect(),
    }
}

fn x_description(unit: &str) -> &'static str {
    match unit {
        TEXELS => "texels of the map",
        _ => "triangles",
    }
}

fn x_label(unit: &str, x: f64) -> String {
    match unit {
        TEXELS => format!("{}²", x.sqrt().round()),
        _ => format!(
            "10{}",
            ["³", "⁴", "⁵", "⁶", "⁷"][x.log10().round() as usize - 3]
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guides_have_slope_1_and_stay_inside() {
        let y = 0.1..20.0;
        let guides = guides(&y, 1e3, 1e6, 10.0);
        assert_eq!(guides.len(), 4, "{guides:?}");
        for guide in guides {
            let [(x0, y0), (x1, y1)] = guide[..] else {
                panic!("{guide:?}")
            };
            assert!((y1 / y0 / (x1 / x0) - 1.0).abs() < 1e-12);
            assert!(x0 >= 1e3 && x1 <= 1e6 && y0 >= 0.099 && y1 <= 20.001);
        }
    }
}
