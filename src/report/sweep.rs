//! Which rows a report has: every combination of the values that settings are given.

use crate::labs::{Comparison, Handout, Kind, Setting, Settings};
use crate::{Error, Result};

/// The setting that chooses between a lab's scenes: figures of two scenes do not belong into one plot.
const SCENE: &str = "scene";
/// The setting that each row is measured under both values of.
const REDRAW: &str = "redraw";
/// More would be neither waited for nor read.
const MOST_ROWS: usize = 500;

/// One setting with several values.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    name: String,
    values: Vec<String>,
}

/// The rows of one plot, before they are measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub title: String,
    /// What all rows have in common, as `--set` writes it.
    pub set: Vec<String>,
    /// What each row sets beside. The first one sets nothing: it is the handout's.
    rows: Vec<Vec<String>>,
}

impl Sweep {
    /// `NAME=v1,v2,…`, or `NAME=A..B`, which is A, 2A, 4A and so on, and B.
    pub fn parse(text: &str, table: &'static [Setting]) -> Result<Self> {
        let wrong = |message: String| Error::usage(format!("--sweep {text}: {message}"));
        let expected = "expected NAME=A..B or NAME=VALUE,VALUE,…";
        let (name, list) = text
            .split_once('=')
            .ok_or_else(|| wrong(expected.to_owned()))?;
        if name == REDRAW {
            let message = "every row is measured with the shadow pass drawn and at rest";
            return Err(wrong(message.to_owned()));
        }
        let number = |setting: &&Setting| matches!(setting.kind, Kind::Number { .. });
        let setting = table.iter().find(|setting| setting.name == name);
        let values: Vec<String> = match (setting.filter(number), list.split_once("..")) {
            (Some(_), Some((first, last))) => doublings(first, last).ok_or_else(|| {
                wrong(
                    "expected A..B with 0 < A, and B not below A and at most 2^20 times as large"
                        .to_owned(),
                )
            })?,
            _ => list.split(',').map(str::to_owned).collect(),
        };
        let mut settings = Settings::new(table);
        for value in &values {
            settings.assign(name, value).map_err(wrong)?;
        }
        Ok(Self {
            name: name.to_owned(),
            values,
        })
    }
}

/// The first number, doubled as long as it is below the last, and the last.
fn doublings(first: &str, last: &str) -> Option<Vec<String>> {
    let [first, last] = [first, last].map(|text| text.parse::<f64>().ok());
    let (first, last) = (first?, last?);
    // A NaN is in no range.
    if !(first > 0.0 && last >= first && last <= first * f64::from(1 << 20)) {
        return None;
    }
    let doubled = std::iter::successors(Some(first), |value| Some(2.0 * value));
    let below = doubled.take_while(|value| *value < last);
    Some(below.chain([last]).map(|value| value.to_string()).collect())
}

/// Every combination, the last sweep's values changing fastest.
fn combinations(sweeps: &[Sweep]) -> Vec<Vec<String>> {
    sweeps.iter().fold(vec![Vec::new()], |rows, sweep| {
        let with = |row: &Vec<String>| {
            let row = row.clone();
            let assignments = sweep
                .values
                .iter()
                .map(|value| format!("{}={value}", sweep.name));
            assignments
                .map(|assignment| [&row[..], &[assignment]].concat())
                .collect::<Vec<_>>()
        };
        rows.iter().flat_map(with).collect()
    })
}

impl Plan {
    /// What the lab itself would compare.
    pub fn of_lab(handout: &Handout) -> Result<Vec<Self>> {
        let plan = |comparison: &Comparison| {
            let mut rows = vec![Vec::new()];
            for group in comparison.sweeps {
                let sweeps = group
                    .iter()
                    .map(|text| Sweep::parse(text, handout.settings));
                rows.extend(combinations(&sweeps.collect::<Result<Vec<_>>>()?));
            }
            let set = comparison.set.iter().map(|text| (*text).to_owned());
            Ok(Self {
                title: comparison.title.to_owned(),
                set: set.collect(),
                rows,
            })
        };
        handout.comparisons.iter().map(plan).collect()
    }

    /// Rows that somebody else has chosen: what each sets, the handout's first.
    pub fn of_rows(title: &str, rows: Vec<Vec<String>>) -> Self {
        Self {
            title: title.to_owned(),
            set: Vec::new(),
            rows,
        }
    }

    /// What a command line asks for: one plan, or one for each scene.
    pub fn of_sweeps(title: &str, sweeps: &[Sweep]) -> Result<Vec<Self>> {
        for (i, sweep) in sweeps.iter().enumerate() {
            if sweeps[..i].iter().any(|earlier| earlier.name == sweep.name) {
                return Err(Error::usage(format!(
                    "--sweep {}: given twice, expected all its values in one --sweep",
                    sweep.name
                )));
            }
        }
        let count = sweeps.iter().try_fold(1_usize, |count, sweep| {
            count.checked_mul(sweep.values.len())
        });
        if count.is_none_or(|count| count > MOST_ROWS) {
            let message = format!("--sweep: too many rows, expected at most {MOST_ROWS}");
            return Err(Error::usage(message));
        }
        let (scenes, others): (Vec<_>, Vec<_>) = sweeps
            .iter()
            .cloned()
            .partition(|sweep| sweep.name == SCENE);
        let rows = [vec![Vec::new()], combinations(&others)].concat();
        let plan = |scene: Vec<String>| Self {
            title: [&[title.to_owned()], &scene[..]].concat().join(", "),
            set: scene,
            rows: rows.clone(),
        };
        Ok(combinations(&scenes).into_iter().map(plan).collect())
    }

    /// The settings of each row, from those that the lab has now; no two rows are the same.
    pub fn settings(&self, now: &Settings) -> Result<Vec<Settings>> {
        let mut different: Vec<Settings> = Vec::new();
        for row in &self.rows {
            let mut settings = now.clone();
            let mut assignments = self.set.iter().chain(row);
            assignments.try_for_each(|assignment| settings.set(assignment))?;
            if !different.contains(&settings) {
                different.push(settings);
            }
        }
        Ok(different)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labs;

    fn table() -> &'static [Setting] {
        labs::find("cs541").unwrap().settings
    }

    fn rows_from(now: &Settings, sweeps: &[&str]) -> Vec<String> {
        let sweeps = sweeps
            .iter()
            .map(|text| Sweep::parse(text, table()).unwrap());
        let plans = Plan::of_sweeps("", &sweeps.collect::<Vec<_>>()).unwrap();
        assert_eq!(plans.len(), 1);
        let rows = plans[0].settings(now).unwrap();
        rows.iter()
            .map(|row| row.differences(now).join(" "))
            .collect()
    }

    fn rows(sweeps: &[&str]) -> Vec<String> {
        rows_from(&Settings::new(table()), sweeps)
    }

    #[test]
    fn a_range_doubles_up_to_its_end() {
        assert_eq!(
            rows(&["map_size=256..2048"]),
            ["", "map_size=256", "map_size=512", "map_size=2048"],
            "1024 is the handout's row"
        );
        assert_eq!(
            rows(&["epsilon=0.01..0.03"]),
            ["", "epsilon=0.01", "epsilon=0.02", "epsilon=0.03"]
        );
        assert_eq!(rows(&["epsilon=0.02..0.02"]), ["", "epsilon=0.02"]);
    }

    #[test]
    fn the_first_row_is_the_one_that_is_set() {
        let mut now = Settings::new(table());
        now.set("map_size=512").unwrap();
        let found = rows_from(&now, &["map_size=512..1024"]);
        assert_eq!(found, ["", "map_size=1024"]);
    }

    #[test]
    fn rows_are_every_combination_once() {
        assert_eq!(
            rows(&["remedy=none,both,none", "filter=linear,nearest"]),
            [
                "",
                "remedy=none",
                "filter=nearest remedy=none",
                "remedy=both",
                "filter=nearest remedy=both",
            ]
        );
    }

    #[test]
    fn each_scene_has_a_plot_of_its_own() {
        let table = labs::find("csci3260").unwrap().settings;
        let sweeps = ["scene=course,room", "stage=pcf,slope"];
        let sweeps = sweeps.map(|text| Sweep::parse(text, table).unwrap());
        let plans = Plan::of_sweeps("mine", &sweeps).unwrap();
        assert_eq!(plans.len(), 2);
        assert_eq!(plans[1].title, "mine, scene=room");
        let now = Settings::new(table);
        let rows = plans[1].settings(&now).unwrap();
        let rows: Vec<_> = rows
            .iter()
            .map(|row| row.differences(&now).join(" "))
            .collect();
        assert_eq!(
            rows,
            [
                "scene=room",
                "scene=room stage=pcf",
                "scene=room stage=slope"
            ]
        );
    }

    #[test]
    fn the_labs_own_sweeps_are_right() {
        for handout in labs::LABS {
            let now = Settings::new(handout.settings);
            for plan in Plan::of_lab(handout).unwrap() {
                assert!(plan.settings(&now).unwrap().len() > 3, "{}", plan.title);
            }
        }
    }
}
