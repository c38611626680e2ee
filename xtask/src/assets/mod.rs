//! Every asset is made here, from formulas: the same on every run, and nobody else's work.

mod lighthouse;
mod textures;

use std::path::Path;

use shadowlab::picture::{write_rgb, write_whole};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Writes all pictures and models, and the README that says where each comes from.
pub fn write_all(dir: &Path) -> Outcome {
    std::fs::create_dir_all(dir)?;
    let pictures = [
        ("floor.png", textures::floor()),
        ("sky.png", textures::sky()),
        ("painting.png", textures::painting()),
        ("crate.png", textures::wooden_crate()),
        ("lighthouse.png", textures::lighthouse()),
    ];
    for (name, picture) in &pictures {
        write_rgb(&dir.join(name), picture, &[])?;
    }
    write_text(&dir.join("lighthouse.obj"), &lighthouse::obj())?;
    write_text(&dir.join("lighthouse.mtl"), lighthouse::MTL)?;
    write_text(&dir.join("README.md"), README)
}

fn write_text(path: &Path, text: &str) -> Outcome {
    Ok(write_whole(path, |file| {
        std::io::Write::write_all(file, text.as_bytes())
    })?)
}

const README: &str = "\
# Assets

Everything in this folder is made by `cargo xtask assets` from formulas in `xtask/src/assets/`: no scan, no photo,
no downloaded model. Licence: MIT OR Apache-2.0, as the rest of the project. Do not edit a file here: change the
function and run the command again.

| file | made by | shows |
|---|---|---|
| `floor.png` | `textures::floor` | light oak planks; repeats in both directions |
| `sky.png` | `textures::sky` | a sky dome: across is the azimuth, up is the elevation, the horizon is in the middle |
| `painting.png` | `textures::painting` | a framed painting of hills, a lake and the sun |
| `crate.png` | `textures::wooden_crate` | one side of a wooden crate |
| `lighthouse.png` | `textures::lighthouse` | the lighthouse's wall: across once around, up from the foot to the gallery |
| `lighthouse.obj`, `lighthouse.mtl` | `lighthouse::obj` | a lighthouse, 2 high, y up, on y = 0; railing and pillars cast thin shadows |
";
