//! What the dolphin's handout draws: the dolphin with two skins, and the sea with two surfaces.

mod dolphin;
mod sea;
mod skins;

use std::path::Path;

use super::{Outcome, write_pictures, write_text};

pub fn write(dir: &Path) -> Outcome {
    std::fs::create_dir_all(dir)?;
    write_pictures(
        dir,
        &[
            ("dolphin_01.png", skins::grey()),
            ("dolphin_02.png", skins::orca()),
            ("sea_01.png", sea::caustics()),
            ("sea_02.png", sea::swell()),
        ],
    )?;
    write_text(&dir.join("dolphin.obj"), &dolphin::obj())?;
    write_text(&dir.join("dolphin.mtl"), dolphin::MTL)
}
