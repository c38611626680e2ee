//! A student's picture, held against a reference. It knows no lab and no GL, so that a picture from anywhere is an equal
//! input.
//!
//! | file | what |
//! |---|---|
//! | `forgiven.rs` | what is no mistake, and is taken out first: upside down, another gamma, a tint, a shift |
//! | `difference.rs` | how far two pictures differ |
//! | `shadows.rs` | the shadows of a picture, apart from its shading |

mod difference;
mod forgiven;
mod shadows;

pub use difference::{
    Difference, Envelope, Matching, SAME, TOLERANCE, TOLERANCE_OF_JPEG, heat_map,
};
pub use forgiven::{Forgiven, Forgiving, forgive, resized, unlikeness};
pub use shadows::Shadows;
