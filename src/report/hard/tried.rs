//! Which tests a case is put to.

use crate::Result;
use crate::hard::{Case, Expected};
use crate::labs::{Handout, Settings};
use crate::report::bench::{EXACT, assigned, choosing, shadow_tests};

/// A test before it is made.
pub struct Test {
    pub settings: Settings,
    pub assignments: Vec<String>,
    pub expected: Expected,
    pub shadow_test: Option<&'static str>,
    pub depth_format: String,
}

/// Every value of `shadow_test`, in every format of the depth texture where the case is about that; then what the case
/// and its lab expect something of: the controls, and what must hold. `now` is what the lab's settings are at the start.
pub fn of_case(case: &Case, handout: &Handout, now: &Settings) -> Result<Vec<Test>> {
    let mut tests: Vec<Test> = Vec::new();
    let formats = depth_formats(case);
    for format in std::iter::once("").chain(formats) {
        for shadow_test in shadow_tests(handout) {
            if *shadow_test == EXACT && !format.is_empty() {
                continue;
            }
            let mut assignments = choosing(handout, shadow_test);
            assignments.extend((!format.is_empty()).then(|| format.to_owned()));
            tests.push(Test {
                settings: assigned(now, &assignments)?,
                assignments,
                expected: Expected::Shown,
                shadow_test: Some(shadow_test),
                depth_format: format.to_owned(),
            });
        }
    }
    for (text, expected) in case.tests() {
        let assignments: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
        let settings = assigned(now, &assignments)?;
        match tests.iter_mut().find(|test| test.settings == settings) {
            Some(known) if known.expected == Expected::Shown => known.expected = expected,
            Some(_) => {}
            None => tests.push(Test {
                settings,
                assignments,
                expected,
                shadow_test: None,
                depth_format: String::new(),
            }),
        }
    }
    Ok(tests)
}

/// The formats that the case itself says something of.
fn depth_formats(case: &Case) -> Vec<&'static str> {
    let words = case
        .expected
        .iter()
        .flat_map(|(text, _)| text.split_whitespace());
    let mut formats: Vec<&'static str> = words
        .filter(|word| word.starts_with("depth_format="))
        .collect();
    formats.dedup();
    formats
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hard;
    use crate::labs;

    fn tests(name: &str) -> Vec<Test> {
        let case = hard::find(name).unwrap();
        let handout = labs::find(case.lab).unwrap();
        of_case(case, handout, &Settings::new(handout.settings)).unwrap()
    }

    #[test]
    fn a_case_is_put_to_every_shadow_test_and_to_what_is_expected_of_it() {
        let wall = tests("wall");
        let values = shadow_tests(labs::find("cs541").unwrap());
        let shown: Vec<_> = wall.iter().filter_map(|test| test.shadow_test).collect();
        assert_eq!(shown, values);
        // The handout's settings are one of the case's own tests.
        assert_eq!(wall[0].assignments, [""; 0]);
        assert_eq!(wall[0].expected, Expected::FalseLight(50));
        let exact = wall.iter().find(|test| test.shadow_test == Some(EXACT));
        assert_eq!(exact.unwrap().expected, Expected::Exact);
        let own = "remedy=epsilon epsilon=0.0001 map_size=4096";
        assert!(wall.iter().any(|test| test.assignments.join(" ") == own));
        for (i, test) in wall.iter().enumerate() {
            assert!(
                wall[..i]
                    .iter()
                    .all(|other| other.settings != test.settings)
            );
        }
    }

    #[test]
    fn depth_formats_are_asked_where_the_case_is_about_them() {
        let formats = ["depth_format=16", "depth_format=24", "depth_format=32F"];
        assert_eq!(depth_formats(hard::find("near-far").unwrap()), formats);
        let near_far = tests("near-far");
        let asked = near_far
            .iter()
            .filter(|test| test.shadow_test == Some("handout"));
        let asked: Vec<_> = asked.map(|test| test.depth_format.as_str()).collect();
        assert_eq!(asked, ["", formats[0], formats[1], formats[2]]);
        let exact = near_far
            .iter()
            .filter(|test| test.shadow_test == Some(EXACT));
        assert_eq!(exact.count(), 1);
        // The control.
        assert!(
            tests("wall")
                .iter()
                .all(|test| test.depth_format.is_empty())
        );
    }
}
