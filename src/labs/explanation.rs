//! What a shader computes at one place, step by step, to hold against one's own printout.

use std::fmt;

use glam::{DMat4, DVec2, DVec3};

use super::exact::Range;
use crate::{Error, Result};

/// Where to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Probe {
    /// A pixel of the picture, from its top left corner.
    Pixel([u32; 2]),
    /// A point in world space.
    Point(DVec3),
}

impl Probe {
    /// An error where the picture has no such pixel.
    pub(super) fn check(self, [width, height]: [u32; 2]) -> Result<()> {
        match self {
            Self::Pixel([x, y]) if x >= width || y >= height => Err(Error::usage(format!(
                "pixel {x},{y} is outside of the picture, expected 0,0 to {},{}",
                width - 1,
                height - 1
            ))),
            _ => Ok(()),
        }
    }
}

/// The values of a shadow test at one place.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// What is seen there, in words.
    pub place: String,
    /// The colour of the pixel in the lab's picture.
    pub color: Option<[u8; 3]>,
    /// Each matrix with its label; world space is the scene's own, wherever its origin is.
    pub matrices: Vec<(&'static str, DMat4)>,
    pub steps: Vec<Step>,
    /// Each yes-or-no question of the test in words, with the GPU's answer and that of the f64 values.
    pub tests: Vec<(&'static str, bool, bool)>,
    /// None where no surface is.
    pub in_shadow: Option<bool>,
    /// None where no depth map is looked at.
    pub look_up: Option<LookUp>,
}

/// Where a test looks into its depth map, and what it compares, as the GPU has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookUp {
    /// 0…1 from the map's left and bottom edge; of PCF the sample in the middle.
    pub uv: DVec2,
    /// The place's own depth with the bias in it: a texel that stores less puts it in shadow.
    pub depth: f64,
}

/// One value of the test: as the GPU has it, in f64, and how far apart rounding and rasterisation may drive them.
#[derive(Clone, Debug)]
pub struct Step {
    pub name: &'static str,
    pub components: &'static [&'static str],
    pub gpu: Vec<f64>,
    pub exact: Vec<f64>,
    pub bound: Vec<f64>,
}

impl Step {
    pub(super) fn new(
        name: &'static str,
        components: &'static [&'static str],
        gpu: &[f64],
        exact: &[Range],
    ) -> Self {
        Self {
            name,
            components,
            gpu: gpu.to_vec(),
            exact: exact.iter().map(|range| range.value).collect(),
            bound: exact.iter().map(Range::radius).collect(),
        }
    }

    /// Whether each of the GPU's values lies within the bound of the f64 one.
    pub fn agrees(&self) -> bool {
        let apart = self.gpu.iter().zip(&self.exact).map(|(a, b)| (a - b).abs());
        apart.zip(&self.bound).all(|(apart, bound)| apart <= *bound)
    }
}

impl Explanation {
    /// Where there is no surface, there is no test.
    pub(super) fn of_nothing(place: String, color: Option<[u8; 3]>) -> Self {
        Self {
            place,
            color,
            matrices: Vec::new(),
            steps: Vec::new(),
            tests: Vec::new(),
            in_shadow: None,
            look_up: None,
        }
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.place)?;
        if let Some([red, green, blue]) = self.color {
            writeln!(
                f,
                "the picture's colour there: ({red}, {green}, {blue}) of 255"
            )?;
        }
        for (label, matrix) in &self.matrices {
            writeln!(f, "\n{label}")?;
            for row in 0..4 {
                let row = matrix.row(row).to_array().map(|n| format!("{n:14.6}"));
                writeln!(f, "  [{} ]", row.concat())?;
            }
        }
        if !self.steps.is_empty() {
            let heads = ["", "GPU, f32", "in f64", "apart", "bound"];
            writeln!(
                f,
                "\n{:32}{:>18}{:>18}{:>11}{:>11}",
                heads[0], heads[1], heads[2], heads[3], heads[4]
            )?;
        }
        for step in &self.steps {
            for (i, component) in step.components.iter().enumerate() {
                let name = if i == 0 { step.name } else { "" };
                let (gpu, exact, bound) = (step.gpu[i], step.exact[i], step.bound[i]);
                let apart = (gpu - exact).abs();
                let mark = if apart <= bound {
                    ""
                } else {
                    "  beyond the bound"
                };
                writeln!(
                    f,
                    "{name:29}{component:>3}{gpu:18.9}{exact:18.9}{apart:11.1e}{bound:11.1e}{mark}"
                )?;
            }
        }
        if !self.tests.is_empty() {
            writeln!(f)?;
        }
        let answer = |yes: bool| if yes { "yes" } else { "no" };
        for (question, gpu, exact) in &self.tests {
            write!(f, "{question:64}{}", answer(*gpu))?;
            if gpu != exact {
                write!(f, "  (in f64: {})", answer(*exact))?;
            }
            writeln!(f)?;
        }
        match self.in_shadow {
            Some(true) => writeln!(f, "verdict: in shadow"),
            Some(false) => writeln!(f, "verdict: not in shadow"),
            None => Ok(()),
        }
    }
}
