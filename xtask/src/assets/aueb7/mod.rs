//! What the last handout draws: the balls of its example, the pirate's island, and the palace.

mod balls;
mod island;
mod palace;
mod skeleton;
mod treasure;
mod walls;

use std::path::Path;

use super::{Outcome, write_pictures, write_text};

pub fn write(dir: &Path) -> Outcome {
    std::fs::create_dir_all(dir)?;
    write_pictures(
        dir,
        &[
            ("ball_01.png", balls::beach()),
            ("ball_02.png", balls::stars()),
            ("sand.png", island::sand()),
            ("bone.png", skeleton::bone_picture()),
            ("wood.png", treasure::wood()),
            ("gold.png", treasure::gold()),
            ("wall.png", walls::wall()),
            ("fresco.png", walls::fresco()),
            ("paving.png", walls::paving()),
        ],
    )?;
    for (name, obj, mtl) in [
        ("terrain", island::obj(), island::MTL),
        ("skeleton", skeleton::obj(), skeleton::MTL),
        ("treasure", treasure::obj(), treasure::MTL),
        ("palace", palace::obj(), palace::MTL),
    ] {
        write_text(&dir.join(format!("{name}.obj")), &obj)?;
        write_text(&dir.join(format!("{name}.mtl")), mtl)?;
    }
    Ok(())
}
