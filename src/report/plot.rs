//! Error against time: a point for each row, both axes logarithmic, the Pareto front drawn through.

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Compared;
use super::labels::{RADIUS, labels};
use super::run::Row;
use super::summary::Summary;
use super::words;
use crate::labs::{Kind, Setting};

/// In the page's pixels.
const SIZE: (u32, u32) = (860, 500);

/// Told apart by the colour-blind, too: Okabe and Ito (2008), without their yellow, which white paper swallows; then a
/// grey, a brown and a dark purple.
pub const COLORS: [RGBColor; 10] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(140, 140, 140),
    RGBColor(130, 70, 20),
    RGBColor(90, 40, 140),
];

/// No wrong pixel at all has no place on a logarithmic axis: it is drawn here, in a band of its own.
const FLOOR: f64 = 0.5;
/// Where the band ends.
const FLOOR_TOP: f64 = 0.72;

/// How far beyond the points their intervals can stretch the axis of cost.
const BEYOND: f64 = 1.5;

/// Maps of several sizes are one method: their rows are joined, whatever else tells rows apart.
const MAP_SIZE: &str = "map_size";

/// Rows that are drawn in one colour, and joined.
pub struct Series {
    pub name: String,
    pub color: [u8; 3],
    /// Discs, and squares for those that find no colour of their own any more.
    pub round: bool,
    /// From the cheapest on.
    rows: Vec<usize>,
}

pub fn series(table: &[Setting], compared: &Compared, summaries: &[Summary]) -> Vec<Series> {
    let mut series: Vec<Series> = Vec::new();
    for (i, row) in compared.rows.iter().enumerate() {
        let name = series_name(table, row);
        match series.iter_mut().find(|series| series.name == name) {
            Some(series) => series.rows.push(i),
            None => {
                let RGBColor(red, green, blue) = COLORS[series.len() % COLORS.len()];
                series.push(Series {
                    name,
                    color: [red, green, blue],
                    round: series.len() < COLORS.len(),
                    rows: vec![i],
                });
            }
        }
    }
    for series in &mut series {
        let cost = |i: &usize| summaries[*i].frame.ratio;
        series.rows.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    }
    series
}

/// What a row sets, of numbers only that they are set.
fn series_name(table: &[Setting], row: &Row) -> String {
    let is_number = |name: &str| {
        let setting = table.iter().find(|setting| setting.name == name);
        setting.is_some_and(|setting| matches!(setting.kind, Kind::Number { .. }))
    };
    let parts = row.differences.iter().filter_map(|assignment| {
        let name = assignment.split('=').next()?;
        match name {
            MAP_SIZE => None,
            name if is_number(name) => Some(name),
            _ => Some(assignment.as_str()),
        }
    });
    let parts: Vec<_> = parts.collect();
    if parts.is_empty() {
        "the handout's settings".to_owned()
    } else {
        parts.join(" ")
    }
}

/// The plot as SVG, to stand in a page.
pub fn svg(table: &[Setting], compared: &Compared, summaries: &[Summary]) -> String {
    let mut svg = String::new();
    // Nothing that draws into memory can fail.
    draw(table, compared, summaries, &mut svg).expect("a plot can be drawn into memory");
    svg
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Where a row stands: its cost, and its wrong pixels.
fn place(summary: &Summary) -> (f64, f64) {
    (summary.frame.ratio, (summary.wrong as f64).max(FLOOR))
}

fn draw(table: &[Setting], compared: &Compared, summaries: &[Summary], svg: &mut String) -> Drawn {
    let extent = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
    let costs = summaries.iter().map(|row| row.frame.ratio);
    let (cheapest, dearest) = costs.fold((1.0, 1.0), extent);
    let ends = summaries.iter().flat_map(|row| row.frame.ratio_95);
    let (low, high) = ends.flatten().fold((cheapest, dearest), extent);
    // An interval that goes far beyond all points must not press them together: the axis cuts it off.
    let (low, high) = (low.max(cheapest / BEYOND), high.min(dearest * BEYOND));
    let heights = || summaries.iter().map(|row| place(row).1);
    let least = heights().fold(f64::INFINITY, f64::min);
    let most = heights().fold(10.0, f64::max);
    // The axis begins with a power of ten, or with the place of 0.
    let least = decades(least).last().copied().unwrap_or(FLOOR);
    // And it ends with one, where that is near.
    let next = 10_f64.powf(most.log10().ceil());
    let top = if next < 2.0 * most {
        1.15 * next
    } else {
        1.6 * most
    };
    let (x, y) = (0.93 * low..1.08 * high, 0.8 * least..top);
    let y_ticks = [vec![FLOOR], decades(top)].concat();
    let y_ticks = y_ticks
        .into_iter()
        .filter(|tick| y.contains(tick))
        .collect();

    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let mut chart = ChartBuilder::on(&root)
        .margin(8)
        .x_label_area_size(44)
        .y_label_area_size(78)
        .build_cartesian_2d(
            x.clone().log_scale().with_key_points(ticks(&x)),
            y.clone().log_scale().with_key_points(y_ticks),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_label_formatter(&|x| format!("{}", (1000.0 * x).round() / 1000.0))
        .y_label_formatter(&|y| {
            if *y < 1.0 {
                "none".to_owned()
            } else {
                words::thousands(*y as u64)
            }
        })
        .x_desc(format!(
            "frame time while light or casters move, × the handout's ({} ms)",
            words::milliseconds(summaries[0].frame.ms)
        ))
        .y_desc(format!(
            "wrong pixels, of {} that face the light",
            words::thousands(summaries[0].valid as u64)
        ))
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 17))
        .draw()?;

    if y.start < FLOOR_TOP {
        let band = [(x.start, y.start), (x.end, FLOOR_TOP)];
        chart.draw_series([Rectangle::new(band, BLACK.mix(0.06).filled())])?;
    }

    // The front: whatever lies to the right of and above it is beaten.
    let on_front = summaries.iter().filter(|row| row.on_front);
    let mut front: Vec<(f64, f64)> = on_front.map(place).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut stairs = vec![(front[0].0, y.end)];
    for point in &front {
        let height = stairs[stairs.len() - 1].1;
        stairs.extend([(point.0, height), *point]);
    }
    stairs.push((x.end, stairs[stairs.len() - 1].1));
    chart.draw_series([PathElement::new(stairs, BLACK.mix(0.25).stroke_width(5))])?;

    for series in series(table, compared, summaries) {
        let [red, green, blue] = series.color;
        let color = RGBColor(red, green, blue);
        let line: Vec<_> = series.rows.iter().map(|i| place(&summaries[*i])).collect();
        chart.draw_series([PathElement::new(line, color.mix(0.35))])?;
        for summary in series.rows.iter().map(|i| &summaries[*i]) {
            let point = place(summary);
            if let Some([from, to]) = summary.frame.ratio_95 {
                let (from, to) = (from.max(x.start), to.min(x.end));
                let interval = vec![(from, point.1), (to, point.1)];
                chart.draw_series([PathElement::new(interval, color.mix(0.5))])?;
            }
            // Hollow: wrong in the interior, too.
            let inside = if summary.interior == 0 { color } else { WHITE };
            for style in [inside.filled(), color.stroke_width(2)] {
                let corners = [(-RADIUS, -RADIUS), (RADIUS, RADIUS)];
                let marker = EmptyElement::at(point);
                if series.round {
                    chart.draw_series([marker + Circle::new((0, 0), RADIUS, style)])?;
                } else {
                    chart.draw_series([marker + Rectangle::new(corners, style)])?;
                }
            }
        }
    }

    let points: Vec<_> = summaries
        .iter()
        .map(|row| chart.backend_coord(&place(row)))
        .collect();
    let style = ("sans-serif", 14).into_text_style(&root).color(&BLACK);
    let style = style.pos(Pos::new(HPos::Center, VPos::Center));
    let (across, down) = chart.plotting_area().get_pixel_range();
    let corner = (across.start, down.end);
    let names: Vec<String> = compared.rows.iter().map(words::name).collect();
    for label in labels(&points, summaries, &names, corner) {
        root.draw(&Text::new(label.text, label.at, style.clone()))?;
    }
    root.present()?;
    Ok(())
}

/// Round numbers within a range, close enough for a reader to see the factors between them.
pub fn ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let factor = range.end / range.start;
    let steps: &[f64] = if factor < 4.0 {
        &[
            1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0,
        ]
    } else if factor < 16.0 {
        &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    let decades = (-6..7).map(|power| 10.0_f64.powi(power));
    let all = decades.flat_map(|decade| steps.iter().map(move |step| step * decade));
    all.filter(|tick| range.contains(tick)).collect()
}

/// 1, 10, 100 … up to the last that is not above `most`.
fn decades(most: f64) -> Vec<f64> {
    let powers = std::iter::successors(Some(1.0), |power| Some(10.0 * power));
    powers.take_while(|power| *power <= most).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_round_numbers() {
        assert_eq!(decades(10.0), [1.0, 10.0]);
        let wide = ticks(&(0.3..9.0));
        assert_eq!(wide.len(), 4, "{wide:?}");
        let middle = ticks(&(0.4..2.9));
        assert_eq!(middle.len(), 5, "{middle:?}");
        let narrow = ticks(&(0.95..1.25));
        assert_eq!(narrow.len(), 3, "{narrow:?}");
    }
}
