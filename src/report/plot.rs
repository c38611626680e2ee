//! Error against time: a point for each row, both axes logarithmic, the Pareto front drawn through.

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Compared;
use super::summary::Summary;
use super::words;

/// In the page's pixels.
const SIZE: (u32, u32) = (860, 500);

/// Told apart by the colour-blind, too: Okabe and Ito (2008), without their yellow, which white paper swallows.
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// No wrong pixel at all has no place on a logarithmic axis: it is drawn here, and the axis says 0.
const FLOOR: f64 = 0.5;

/// The series that a row belongs to, by everything that it sets but numbers; those of one series are joined.
pub struct Series {
    pub name: String,
    pub color: [u8; 3],
    /// In the order of their costs.
    rows: Vec<usize>,
}

pub fn series(compared: &Compared, summaries: &[Summary]) -> Vec<Series> {
    let mut series: Vec<Series> = Vec::new();
    for (i, row) in compared.rows.iter().enumerate() {
        let is_number = |assignment: &&String| {
            let value = assignment.split_once('=').map(|(_, value)| value);
            value.is_some_and(|value| value.parse::<f64>().is_ok())
        };
        let choices: Vec<_> = row
            .differences
            .iter()
            .filter(|text| !is_number(text))
            .collect();
        let numbers = row.differences.iter().filter(is_number);
        let numbers: Vec<&str> = numbers.filter_map(|text| text.split('=').next()).collect();
        let mut name = choices
            .iter()
            .map(|text| text.as_str())
            .collect::<Vec<_>>()
            .join(" ");
        // A number that is swept apart from the map's size has a line of its own.
        let other_numbers: Vec<_> = numbers.iter().filter(|name| **name != "map_size").collect();
        for number in other_numbers {
            name += &format!(" {number}");
        }
        let name = if name.is_empty() {
            "the handout's".to_owned()
        } else {
            name.trim().to_owned()
        };
        match series.iter_mut().find(|series| series.name == name) {
            Some(series) => series.rows.push(i),
            None => {
                let RGBColor(red, green, blue) = COLORS[series.len() % COLORS.len()];
                series.push(Series {
                    name,
                    color: [red, green, blue],
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

/// The plot as SVG, to stand in a page.
pub fn svg(compared: &Compared, summaries: &[Summary]) -> String {
    let mut svg = String::new();
    // Nothing that draws into memory can fail.
    draw(compared, summaries, &mut svg).expect("a plot can be drawn into memory");
    svg
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(compared: &Compared, summaries: &[Summary], svg: &mut String) -> Drawn {
    let place = |summary: &Summary| (summary.frame.ratio, (summary.wrong as f64).max(FLOOR));
    let ends = summaries
        .iter()
        .flat_map(|row| row.frame.ratio_95.unwrap_or([row.frame.ratio; 2]));
    let (low, high) = ends.fold((1.0_f64, 1.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let most = summaries
        .iter()
        .map(|row| place(row).1)
        .fold(10.0, f64::max);
    let x = 0.93 * low..1.12 * high;
    let y = 0.7 * FLOOR..1.6 * most;

    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let (x_ticks, y_ticks) = (ticks(&x), [vec![FLOOR], decades(most)].concat());
    let mut chart = ChartBuilder::on(&root)
        .margin(8)
        .x_label_area_size(44)
        .y_label_area_size(62)
        .build_cartesian_2d(
            x.clone().log_scale().with_key_points(x_ticks),
            y.clone().log_scale().with_key_points(y_ticks),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_label_formatter(&|x| format!("{}", (1000.0 * x).round() / 1000.0))
        .y_label_formatter(&|y| {
            if *y < 1.0 {
                "0".to_owned()
            } else {
                format!("{y}")
            }
        })
        .x_desc(format!(
            "frame time while light or casters move, × the handout's ({} ms)",
            words::milliseconds(summaries[0].frame.ms)
        ))
        .y_desc("wrong pixels")
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()?;

    // The front: whatever lies to the right of and above it is beaten.
    let mut front: Vec<(f64, f64)> = summaries
        .iter()
        .filter(|row| row.on_front)
        .map(place)
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut stairs: Vec<(f64, f64)> = front.iter().map(|first| (first.0, y.end)).take(1).collect();
    for point in &front {
        let height = stairs.last().map_or(y.end, |last| last.1);
        stairs.extend([(point.0, height), *point]);
    }
    stairs.extend(front.last().map(|last| (x.end, last.1)));
    chart.draw_series([PathElement::new(stairs, BLACK.mix(0.3).stroke_width(6))])?;

    for series in series(compared, summaries) {
        let [red, green, blue] = series.color;
        let color = RGBColor(red, green, blue);
        let line: Vec<_> = series.rows.iter().map(|i| place(&summaries[*i])).collect();
        chart.draw_series([PathElement::new(line, color.mix(0.35))])?;
        for i in series.rows {
            let point = place(&summaries[i]);
            if let Some([from, to]) = summaries[i].frame.ratio_95 {
                let interval = vec![(from, point.1), (to, point.1)];
                chart.draw_series([PathElement::new(interval, color.stroke_width(1))])?;
            }
            // Hollow: wrong in the interior, too.
            let inside = if summaries[i].interior == 0 {
                color
            } else {
                WHITE
            };
            chart.draw_series([Circle::new(point, 5, inside.filled())])?;
            chart.draw_series([Circle::new(point, 5, color.stroke_width(2))])?;
            let right = point.0 > (x.start * x.end).sqrt();
            let side = if right { HPos::Right } else { HPos::Left };
            let style =
                ("sans-serif", if summaries[i].on_front { 13 } else { 10 }).into_text_style(&root);
            let style = style.color(&BLACK).pos(Pos::new(side, VPos::Bottom));
            let label = if summaries[i].on_front {
                format!("{} {}", i + 1, words::name(&compared.rows[i]))
            } else {
                (i + 1).to_string()
            };
            let beside = if right { -7 } else { 7 };
            let label = EmptyElement::at(point) + Text::new(label, (beside, -4), style);
            chart.draw_series([label])?;
        }
    }
    root.present()?;
    drop(chart);
    drop(root);
    Ok(())
}

/// Round numbers within a range, close enough for a reader to see the factors between them.
fn ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let narrow = range.end / range.start < 4.0;
    let steps: &[f64] = if narrow {
        &[
            1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0,
        ]
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
        let narrow = ticks(&(0.95..1.25));
        assert_eq!(narrow.len(), 3, "{narrow:?}");
    }
}
