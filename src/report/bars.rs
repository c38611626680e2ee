//! A frame taken apart: a bar for each row, the parts one behind the other.

use plotters::prelude::*;

use super::summary::Summary;

/// In the page's pixels: the plot's width, a bar's height with the gaps around it, a gap, and what the axis needs.
const WIDTH: u32 = 860;
const BAR: u32 = 18;
const GAP: u32 = 3;
const AXIS: u32 = 56;

/// The parts in their order, each with its colour, of those that the plot of errors has: the colour-blind tell them apart.
pub const PARTS: [(&str, [u8; 3]); 5] = [
    ("shadow pass", [0, 114, 178]),
    ("look-ups", [213, 94, 0]),
    ("shading", [86, 180, 233]),
    ("lighting, look-ups and all", [204, 121, 167]),
    ("outside GL", [0, 0, 0]),
];

/// The parts of a row's frame in milliseconds, in the order of [`PARTS`]; what it does not have is 0.
fn parts(row: &Summary) -> [f64; 5] {
    let (shadow_pass, outside) = (row.shadow_pass_in_gl, row.outside_gl_ms);
    match (&row.look_ups, row.shading()) {
        // Noise may make look-ups cost less than nothing.
        (Some(look_ups), Some(shading)) => {
            let look_ups = look_ups.ms.max(0.0);
            [shadow_pass, look_ups, shading.max(0.0), 0.0, outside]
        }
        _ => [shadow_pass, 0.0, 0.0, row.lighting_in_gl, outside],
    }
}

/// The parts that some row has.
pub fn legend(summaries: &[Summary]) -> Vec<(&'static str, [u8; 3])> {
    let is_there = |part: usize| summaries.iter().any(|row| parts(row)[part] > 0.0);
    let there = PARTS.into_iter().enumerate();
    there
        .filter(|(part, _)| is_there(*part))
        .map(|(_, part)| part)
        .collect()
}

/// The plot as SVG, to stand in a page.
pub fn svg(summaries: &[Summary]) -> String {
    let mut svg = String::new();
    // Nothing that draws into memory can fail.
    draw(summaries, &mut svg).expect("a plot can be drawn into memory");
    svg
}

fn draw(summaries: &[Summary], svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let most = summaries.iter().map(|row| parts(row).iter().sum::<f64>());
    let most = 1.05 * most.fold(0.0, f64::max);
    let height = BAR * summaries.len() as u32 + AXIS;
    let root = SVGBackend::with_string(svg, (WIDTH, height)).into_drawing_area();
    // From the bottom up: the first row is on top.
    let rows = summaries.len() as i32;
    let number = |height: &SegmentValue<i32>| match height {
        SegmentValue::CenterOf(height) | SegmentValue::Exact(height) => rows - height,
        SegmentValue::Last => rows,
    };
    let mut chart = ChartBuilder::on(&root)
        .margin(8)
        .x_label_area_size(40)
        .y_label_area_size(36)
        .build_cartesian_2d(0.0..most, (0..rows - 1).into_segmented())?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .y_labels(summaries.len())
        .y_label_formatter(&|height| number(height).to_string())
        .x_label_formatter(&|ms| format!("{}", (1000.0 * ms).round() / 1000.0))
        .x_desc("milliseconds of a frame while light or casters move, each pass waited for")
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    for (summary, height) in summaries.iter().zip((0..rows).rev()) {
        let mut from = 0.0;
        for ((_, [red, green, blue]), ms) in PARTS.into_iter().zip(parts(summary)) {
            let corners = [
                (from, SegmentValue::Exact(height)),
                (from + ms, SegmentValue::Exact(height + 1)),
            ];
            let mut bar = Rectangle::new(corners, RGBColor(red, green, blue).filled());
            bar.set_margin(GAP, GAP, 0, 0);
            if ms > 0.0 {
                chart.draw_series([bar])?;
            }
            from += ms;
        }
    }
    root.present()?;
    Ok(())
}
