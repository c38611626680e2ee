//! The classic mistakes: what each looks like, where it comes from, how it is mended, and how each lab would make it.
//!
//! No lab contains a mistake. A mistake is an edit of a shader file, of a uniform or of a call, made where they pass
//! through (see [`crate::gl::edits`]), in the way in which students make it.
//!
//! | file | which mistakes |
//! |---|---|
//! | `comparing.rs` | of the comparison of two depths, and its bias |
//! | `mapping.rs` | of the way from a point to its texel |
//! | `frustum.rs` | of the light's camera |
//! | `drawing.rs` | of the first pass and of the map's state |
//! | `shading.rs` | of what is done with the answer |
//! | `planar.rs` | of projected shadows |
//! | `values.rs` | what happens to a matrix on its way |

/// Edits, as a table: of files, of uniforms in passes (a part of the heading; "" is every pass), of calls in passes.
macro_rules! edits {
    ($(file $file:literal: $from:literal => $to:literal;)*
     $(uniform $name:literal in $pass:literal: $change:path;)*
     $(call $call:literal $([$($place:literal: $value:expr),*])? in $of:literal: $make:expr;)*) => {
        crate::gl::edits::Edits {
            shaders: &[$(crate::gl::edits::ShaderEdit { file: $file, from: $from, to: $to }),*],
            uniforms: &[$(crate::gl::edits::UniformEdit { pass: $pass, name: $name, change: $change }),*],
            calls: &[$(crate::gl::edits::CallEdit {
                pass: $of,
                call: $call,
                with: &[$($(($place, $value as i64)),*)?],
                make: $make,
            }),*],
        }
    };
}

mod comparing;
mod drawing;
mod frustum;
mod mapping;
mod planar;
mod shading;
mod values;

pub use crate::gl::edits::Edits;
use crate::{Error, Result, error};

/// A mistake that students make.
#[derive(Debug)]
pub struct Mistake {
    /// As `--mistake` names it.
    pub name: &'static str,
    /// What the picture looks like.
    pub symptom: &'static str,
    pub cause: &'static str,
    pub fix: &'static str,
    /// How the labs that can make it make it.
    pub made: &'static [Made],
}

/// A mistake as one lab makes it.
#[derive(Debug)]
pub struct Made {
    pub lab: &'static str,
    /// Where the handout says how it is done.
    pub place: &'static str,
    pub edits: Edits,
}

/// All of them, theme by theme.
pub fn all() -> impl Iterator<Item = &'static Mistake> {
    [
        comparing::MISTAKES,
        mapping::MISTAKES,
        frustum::MISTAKES,
        drawing::MISTAKES,
        shading::MISTAKES,
        planar::MISTAKES,
    ]
    .into_iter()
    .flatten()
}

/// Those that a lab can make.
pub fn of_lab(lab: &str) -> impl Iterator<Item = (&'static Mistake, &'static Made)> + use<'_> {
    all().filter_map(move |mistake| Some((mistake, mistake.made(lab)?)))
}

impl Mistake {
    pub fn made(&self, lab: &str) -> Option<&'static Made> {
        self.made.iter().find(|made| made.lab == lab)
    }
}

/// The mistake of that name, as a lab makes it.
pub fn find(name: &str, lab: &str) -> Result<(&'static Mistake, &'static Made)> {
    let mut known = of_lab(lab);
    known
        .find(|(mistake, _)| mistake.name == name)
        .ok_or_else(|| {
            let names: Vec<_> = of_lab(lab).map(|(mistake, _)| mistake.name).collect();
            let hint = error::did_you_mean(name, names.iter().copied());
            Error::usage(format!(
                "--mistake {name}: {lab} cannot make it{hint}: expected one of {}",
                names.join(", ")
            ))
        })
}

/// Everything that the light reaches in shadow: no mistake, but what a picture is held against to find its shadows.
pub fn all_in_shadow(lab: &str) -> Edits {
    shading::ALL_IN_SHADOW
        .iter()
        .find(|made| made.lab == lab)
        .expect("every lab has shadows")
        .edits
}

/// Nothing in shadow, where a lab has no setting for that.
pub fn none_in_shadow(lab: &str) -> Option<Edits> {
    let (_, made) = find("plane_sign", lab).ok()?;
    Some(made.edits)
}
