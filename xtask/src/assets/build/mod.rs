//! The builder that all models share: turned and boxed solids, skins over rings, and OBJ text.
//!
//! Every solid is closed, and its faces are counter-clockwise seen from outside. Models sink their solids a little
//! into each other, so that no two surfaces coincide.

mod obj;
mod place;
mod skin;
mod solids;

pub use obj::Obj;
pub use place::{block, fitted, joined, mirrored, moved, placed};
pub use skin::{bar, bone, capsule, curve, skin, tube};
pub use solids::{Ends, around, ball, boxed, cylinder, ring, turned};
