//! What must come of a test on a case.

use crate::measure::Figures;

/// In pixels of a picture of [`super::SIZE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// A control: so many lit pixels of the interior are dark, at least.
    FalseShadow(usize),
    /// A control: so many dark pixels of the interior are lit, at least.
    FalseLight(usize),
    /// A control: so many lit pixels of the interior are below 95 %, at least: half of the taps are in acne.
    Grey(usize),
    /// A control: so many dark pixels are lit within a texel of a shadow's edge, at least: the map cannot resolve it.
    Unresolved(usize),
    /// In the interior, at most so many lit pixels are below 95 %, and so many dark ones lit.
    Holds(usize, usize),
    /// No pixel is wrong but where the truth itself is ambiguous.
    Exact,
    /// Nothing is promised.
    Shown,
}

impl Expected {
    /// Whether it came so.
    pub fn is_met(&self, figures: &Figures) -> bool {
        let (shadow, light) = (&figures.false_shadow, &figures.false_light);
        match *self {
            Self::FalseShadow(least) => shadow.interior >= least,
            Self::FalseLight(least) => light.interior >= least,
            Self::Grey(least) => figures.grey >= least,
            Self::Unresolved(least) => light.edge_t >= least,
            Self::Holds(most_grey, most_light) => {
                figures.grey <= most_grey && light.interior <= most_light
            }
            Self::Exact => shadow.total() + light.total() == 0,
            Self::Shown => true,
        }
    }
}
