//! The setting `shadow_test`, which every lab with a shadow map has: which test a state asks for.

use super::Settings;
use crate::{Error, Result};

/// The chosen test's name: with shadows=off none is made, as the handouts' shaders do it.
pub fn chosen_test(settings: &Settings) -> &'static str {
    match settings.switch("shadows") {
        true => settings.choice("shadow_test"),
        false => "handout",
    }
}

/// An error where the state has no shadow map.
pub fn check_map(settings: &Settings) -> Result<()> {
    if !settings.switch("shadows") {
        return Err(Error::usage(
            "shadows=off draws no shadow map, expected shadows=on",
        ));
    }
    if chosen_test(settings) == "exact" {
        return Err(Error::usage(
            "shadow_test=exact draws no shadow map, expected shadow_test=handout or offset",
        ));
    }
    Ok(())
}
