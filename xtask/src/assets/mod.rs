//! Every asset is made here, from formulas: the same on every run, and nobody else's work.

mod aueb7;
mod build;
mod csci3260;
mod lighthouse;
mod paint;
mod textures;

use std::path::Path;

use image::RgbImage;
use shadowlab::picture::{write_rgb, write_whole};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Writes all pictures and models, and the README that says where each comes from.
pub fn write_all(dir: &Path) -> Outcome {
    std::fs::create_dir_all(dir)?;
    write_pictures(
        dir,
        &[
            ("floor.png", textures::floor()),
            ("sky.png", textures::sky()),
            ("painting.png", textures::painting()),
            ("crate.png", textures::wooden_crate()),
            ("lighthouse.png", textures::lighthouse()),
        ],
    )?;
    write_text(&dir.join("lighthouse.obj"), &lighthouse::obj())?;
    write_text(&dir.join("lighthouse.mtl"), lighthouse::MTL)?;
    csci3260::write(&dir.join("csci3260"))?;
    aueb7::write(&dir.join("aueb7"))?;
    write_text(&dir.join("README.md"), README)
}

fn write_pictures(dir: &Path, pictures: &[(&str, RgbImage)]) -> Outcome {
    for (name, picture) in pictures {
        write_rgb(&dir.join(name), picture, &[])?;
    }
    Ok(())
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

In `csci3260/`, by the functions of `xtask/src/assets/csci3260/`:

| file | made by | shows |
|---|---|---|
| `dolphin.obj`, `dolphin.mtl` | `dolphin::obj` | a leaping dolphin in the box of the course's own, (−41.1, −111.5, 1) to (41.1, 66, 153.2): z up, the beak towards −y |
| `dolphin_01.png`, `dolphin_02.png` | `skins::grey`, `skins::orca` | its skins, to choose from: a bottlenose dolphin's and an orca's |
| `sea_01.png`, `sea_02.png` | `sea::caustics`, `sea::swell` | water, to choose from: shallow with a net of light, and deep with waves; both repeat in both directions |

In `aueb7/`, by the functions of `xtask/src/assets/aueb7/`; y is up in every model:

| file | made by | shows |
|---|---|---|
| `ball_01.png`, `ball_02.png` | `balls::beach`, `balls::stars` | two balls: across is once around, up is from pole to pole |
| `terrain.obj`, `terrain.mtl` | `island::obj` | an island 18 across, to be drawn ten times as large and 8 lower: at the origin the ground is 1 high, at (0, 0, −1.8) it is 0.8 |
| `sand.png` | `island::sand` | the island's ground; repeats in both directions |
| `skeleton.obj`, `skeleton.mtl` | `skeleton::obj` | a pirate's skeleton with a cutlass, 10 high on y = 0, its face towards −z |
| `bone.png` | `skeleton::bone_picture` | old bone; repeats in both directions |
| `treasure.obj`, `treasure.mtl` | `treasure::obj` | an open treasure chest, 18 wide on y = 0, to be drawn half as large: its front and the spilled coins towards −z |
| `wood.png`, `gold.png` | `treasure::wood`, `treasure::gold` | planks and coins; both repeat in both directions |
| `palace.obj`, `palace.mtl` | `palace::obj` | a palace in the manner of Knossos on a slab 70 wide and 45 deep, 25 high on y = 0, its front towards +z |
| `wall.png`, `fresco.png` | `walls::wall`, `walls::fresco` | one storey's painted wall, and a frieze of dolphins; both repeat across |
| `paving.png` | `walls::paving` | slabs of stone; repeats in both directions |
";
