//! The hard cases: scenes, by name, on which shadow tests are known to break.
//!
//! Each case says which lab draws it, and what must come of the tests: the control, which must fail on it by so many
//! pixels at least, and the one that must hold. The scenes are plain data; who draws and measures them stands above
//! this room. `--scene hard:NAME` shows one.
//!
//! | module | what is hard there |
//! |---|---|
//! | `grazing` | light that skims over the floor |
//! | `contact` | thin, single-sided and touching things |
//! | `light` | where the light stands, what its beam and its depths span |
//! | `place` | far from the origin, very small, very large |
//! | `mesh` | wires, bumps, and triangles that a careful modeller would not make |
//! | `border` | where the map ends |
//! | [`anchor`] | no case, but a plane whose error is known in closed form |

pub mod anchor;
mod border;
mod build;
mod contact;
mod expected;
mod grazing;
mod light;
mod mesh;
mod place;

pub use expected::Expected;
pub use mesh::bumpy_ball;

use crate::scene::Scene;
use crate::{Error, Result, error};

/// A scene and what the tests make of it.
pub struct Case {
    pub name: &'static str,
    /// What is seen, and what is hard about it.
    pub about: &'static str,
    /// The lab that draws it.
    pub lab: &'static str,
    pub scene: fn() -> Scene,
    /// What comes of tests of [`TESTS`], where it is another thing than their rule, and of tests of the case's own.
    pub expected: &'static [(&'static str, Expected)],
}

/// The size of a case's picture, in pixels.
pub const SIZE: [u32; 2] = [320, 240];

/// A shadow test that every case of a lab is put to.
pub struct Test {
    pub lab: &'static str,
    /// The assignments that choose it, with spaces between them.
    pub settings: &'static str,
    /// What comes of it where a case says nothing else.
    pub rule: Expected,
}

/// The handouts' tests, none of which holds everywhere: their rule is no more than to be shown. The offset test, which
/// holds wherever one map sees what casts. And the exact one.
pub const TESTS: &[Test] = &[
    handout("cs541", "remedy=none filter=nearest"),
    handout("cs541", "remedy=epsilon"),
    handout("cs541", "remedy=culling"),
    handout("cs541", "remedy=both"),
    handout("csci3260", "stage=no_bias"),
    handout("csci3260", "stage=constant"),
    handout("csci3260", "stage=slope"),
    handout("csci3260", "stage=culling"),
    handout("csci3260", "stage=pcf"),
    offset("cs541", "shadow_test=offset"),
    offset("csci3260", "shadow_test=offset"),
    offset("csci3260", "shadow_test=offset stage=pcf"),
    exact("cs541"),
    exact("csci3260"),
];

const fn handout(lab: &'static str, settings: &'static str) -> Test {
    Test {
        lab,
        settings,
        rule: Expected::Shown,
    }
}

const fn offset(lab: &'static str, settings: &'static str) -> Test {
    Test {
        lab,
        settings,
        rule: Expected::Holds(0, 0),
    }
}

const fn exact(lab: &'static str) -> Test {
    Test {
        lab,
        settings: "shadow_test=exact",
        rule: Expected::Exact,
    }
}

/// Cases that are hard for one reason.
pub struct Theme {
    pub title: &'static str,
    pub cases: &'static [Case],
}

pub const THEMES: &[Theme] = &[
    Theme {
        title: "Light that skims over the floor",
        cases: grazing::CASES,
    },
    Theme {
        title: "Thin, single-sided and touching things",
        cases: contact::CASES,
    },
    Theme {
        title: "Where the light stands, what its beam and its depths span",
        cases: light::CASES,
    },
    Theme {
        title: "Far from the origin, very small, very large",
        cases: place::CASES,
    },
    Theme {
        title: "Wires, bumps, and triangles that a careful modeller would not make",
        cases: mesh::CASES,
    },
    Theme {
        title: "Where the map ends",
        cases: border::CASES,
    },
];

/// Every case, by theme.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    THEMES.iter().flat_map(|theme| theme.cases)
}

/// The case of that name.
pub fn find(name: &str) -> Result<&'static Case> {
    cases().find(|case| case.name == name).ok_or_else(|| {
        let known: Vec<_> = cases().map(|case| case.name).collect();
        let hint = error::did_you_mean(name, known.iter().copied());
        Error::usage(format!(
            "unknown hard case \"{name}\"{hint}: expected one of {}",
            known.join(", ")
        ))
    })
}

impl Case {
    /// The tests of its lab, then those of its own, each with what must come of it.
    pub fn tests(&self) -> Vec<(&'static str, Expected)> {
        let said = |settings: &str| self.expected.iter().find(|(own, _)| *own == settings);
        let of_lab = TESTS.iter().filter(|test| test.lab == self.lab);
        let mut tests: Vec<_> = of_lab
            .map(|test| {
                (
                    test.settings,
                    said(test.settings).map_or(test.rule, |own| own.1),
                )
            })
            .collect();
        let known = |settings: &str| TESTS.iter().any(|test| test.settings == settings);
        tests.extend(self.expected.iter().filter(|(own, _)| !known(own)));
        tests
    }
}
