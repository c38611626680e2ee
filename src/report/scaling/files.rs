//! The scaling for other programs: CSV with a line for each axis, test and size, and JSON, which has the slopes, too.

use serde_json::{Value, json};

use super::growth::{self, COSTS};
use super::page::ratios;
use super::{Axis, Point, ScalingReport, Series};
use crate::report::files::{self, machine_json, optional};
use crate::report::statistics::Sample;

const COLUMNS: &[&str] = &[
    "axis",
    "shadow_test",
    "count",
    "rounds",
    "frame_ratio",
    "frame_ratio_low",
    "frame_ratio_high",
    "frame_ms",
    "rest_ms",
    "shadow_pass_ms",
    "lighting_ms",
    "bytes_drawn_into",
    "bytes_textures",
    "bytes_buffers",
    "wrong",
    "wrong_interior",
];

pub fn csv(report: &ScalingReport) -> String {
    let series = report
        .axes
        .iter()
        .flat_map(|axis| axis.series.iter().map(move |series| (axis, series)));
    let records = series.flat_map(|(axis, series)| {
        let points = series.points.iter();
        points.map(move |point| record(axis, series, point))
    });
    files::table(COLUMNS, records)
}

/// Lighting is what the costs of the plots leave out.
fn medians(point: &Point) -> [f64; 4] {
    let times = || point.row.times.iter();
    [
        Sample::new(times().map(|times| times.frame)),
        Sample::new(times().map(|times| times.rest)),
        Sample::new(times().map(|times| times.shadow_pass)),
        Sample::new(times().map(|times| times.lighting)),
    ]
    .map(|sample| sample.median())
}

fn record(axis: &Axis, series: &Series, point: &Point) -> Vec<String> {
    let mut record = vec![
        axis.unit.to_owned(),
        series.shadow_test.to_owned(),
        point.count.to_string(),
        point.row.times.len().to_string(),
    ];
    let ratios = ratios(axis, point);
    record.push(optional(ratios.as_ref().map(Sample::median)));
    let interval = ratios.and_then(|ratios| ratios.interval_95());
    record.extend([0, 1].map(|end| optional(interval.map(|ends| ends[end]))));
    record.extend(medians(point).map(|milliseconds| milliseconds.to_string()));
    let bytes = point.row.bytes;
    record.extend([bytes.drawn_into, bytes.textures, bytes.buffers].map(|b| b.to_string()));
    let figures = &point.row.figures[0];
    let (shadow, light) = (&figures.false_shadow, &figures.false_light);
    record.push((shadow.total() + light.total()).to_string());
    record.push((shadow.interior + light.interior).to_string());
    record
}

pub fn json(report: &ScalingReport) -> Value {
    json!({
        "shadowlab": env!("CARGO_PKG_VERSION"),
        "machine": machine_json(&report.machine),
        "interrupted": report.interrupted,
        "width": report.size[0],
        "height": report.size[1],
        "rounds": report.rounds,
        "summary": report.summary(),
        "axes": report.axes.iter().map(axis_json).collect::<Vec<_>>(),
    })
}

fn axis_json(axis: &Axis) -> Value {
    let slopes = growth::growths(axis);
    let slopes = slopes.iter().map(|growth| {
        json!({
            "shadow_test": growth.shadow_test,
            "cost": growth.cost,
            "slope": growth.slope,
            "slope_95": growth.slope_95,
            "faster": growth.is_faster(),
        })
    });
    let point = |point: &Point| {
        let ratios = ratios(axis, point);
        let costs = COSTS.iter().map(|cost| {
            let (median, interval) = cost.of(&point.row);
            (
                cost.name.to_owned(),
                json!({ "median": median, "interval_95": interval }),
            )
        });
        json!({
            "count": point.count,
            "frame_ratio": ratios.as_ref().map(Sample::median),
            "frame_ratio_95": ratios.and_then(|ratios| ratios.interval_95()),
            "costs": costs.collect::<serde_json::Map<_, _>>(),
            "errors": point.row.figures[0].json(),
        })
    };
    let series = axis.series.iter().map(|series| {
        json!({
            "shadow_test": series.shadow_test,
            "points": series.points.iter().map(point).collect::<Vec<_>>(),
        })
    });
    json!({
        "unit": axis.unit,
        "rounds": axis.rounds,
        "series": series.collect::<Vec<_>>(),
        "slopes": slopes.collect::<Vec<_>>(),
    })
}
