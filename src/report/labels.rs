//! What is written beside the points of a plot, and where there is room for it.

use super::summary::Summary;

/// Of a point, in pixels.
pub const RADIUS: i32 = 5;
/// Of a label: the width of a letter, half the height of a line, and how far it is from its point.
const LETTER: i32 = 7;
const HALF_LINE: i32 = 6;
const BESIDE: (i32, i32) = (9, 11);

/// A text, and where its middle is.
pub struct Label {
    pub text: String,
    pub at: (i32, i32),
}

impl Label {
    fn half_width(&self) -> i32 {
        LETTER * self.text.chars().count() as i32 / 2 + 1
    }
}

/// The rows' numbers and where to write them: beside each point, where neither point nor label is in the way yet. The
/// front's come first and have their names, too: to the left of and below the front there is nothing else. A label that
/// finds no room within the axes, whose corner is given, is left out.
pub fn labels(
    points: &[(i32, i32)],
    summaries: &[Summary],
    names: &[String],
    (left, bottom): (i32, i32),
) -> Vec<Label> {
    let mut rows: Vec<usize> = (0..points.len()).collect();
    rows.sort_by_key(|i| !summaries[*i].on_front);
    let mut labels: Vec<Label> = Vec::new();
    for i in rows {
        let number = (i + 1).to_string();
        let named = format!("{number} {}", names[i]);
        let beside = |text: &String, right: i32, down: i32| {
            let mut label = Label {
                text: text.clone(),
                at: points[i],
            };
            label.at.0 += right * (BESIDE.0 + label.half_width());
            label.at.1 += down * BESIDE.1;
            label
        };
        let with_name =
            [(-1, 1), (-1, -1), (1, -1)].map(|(right, down)| beside(&named, right, down));
        let around = [(1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (0, 1)];
        let alone = around.map(|(right, down)| beside(&number, right, down));
        let named_first = with_name.into_iter().filter(|_| summaries[i].on_front);
        let is_free = |label: &Label| {
            let width = label.half_width();
            let apart = |other: (i32, i32), by: (i32, i32)| {
                (label.at.0 - other.0).abs() >= by.0 || (label.at.1 - other.1).abs() >= by.1
            };
            let from_point = (width + RADIUS, HALF_LINE + RADIUS);
            let from_label = |other: &Label| (width + other.half_width() + LETTER, 2 * HALF_LINE);
            label.at.0 - width >= left
                && label.at.1 + HALF_LINE <= bottom
                && points.iter().all(|point| apart(*point, from_point))
                && labels
                    .iter()
                    .all(|other| apart(other.at, from_label(other)))
        };
        labels.extend(named_first.chain(alone).find(is_free));
    }
    labels
}
