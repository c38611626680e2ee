//! Scene files: a scene as a student writes it down, in TOML.
//!
//! Of all keys, these must be given: the camera's `eye` and its `target` or `look`, the `position` of a spot or point
//! light, the `target` or `direction` of a directional one, and the `mesh` of an object. A key that the light's kind or
//! the mesh has no use for is checked and then passed over; an unknown key is an error. Lengths are from −1e12 to 1e12.
//!
//! | key | default | what it is |
//! |---|---|---|
//! | `size` | the lab's window | width and height of the picture in pixels, 1…16384; `--size` goes before it |
//! | `clear` | `[0.1, 0.1, 0.15]` | the colour where there is nothing |
//! | `ambient` | `[0.2, 0.2, 0.2]` | light from everywhere, never shadowed |
//! | `sky` | none | a picture: across is the azimuth, up the elevation |
//! | **`[camera]`** | | must be there |
//! | `eye` | must be given | where it is |
//! | `target` or `look` | must be given | the point, or the direction, that it looks at |
//! | `up` | `[0, 1, 0]` | a direction that is up in the picture; not along the look |
//! | `fovy` or `fovx` | `fovy = 45` | the vertical or horizontal field of view in degrees, 0.01…179 |
//! | `near` | `0.1` | above 0 |
//! | `far` | infinite | above `near` |
//! | **`[light]`** | | or `[[light]]` for each of several |
//! | `kind` | `"spot"` | `spot`, `point` or `directional` |
//! | `position` | must be given | a directional light has one by default, outside of the scene |
//! | `target` or `direction` | `target = [0, 0, 0]` | the point that it shines at, or the way that the light travels; a point light's shadow map looks there |
//! | `cone` | `60` | spot: the beam's full angle in degrees, 0.01…179 |
//! | `beam` | `"circular"` | spot: `circular` or `rectangular` |
//! | `shadow_fov` | `120` | point: the shadow map's field of view in degrees, 0.01…179 |
//! | `box` | fitted to the scene | directional: left, right, bottom, top, near and far of the shadow map, seen from the position |
//! | `near`, `far` | `1`, `30` | spot and point: the shadow map's planes |
//! | `color` | `[1, 1, 1]` | |
//! | **`[[object]]`** | | at least one |
//! | `mesh` | must be given | `plane`, `sphere`, `torus`, `cube`, `teapot`, or an OBJ file beside the scene |
//! | `mesh_size` | `20` | how finely a mesh of the course is cut, 1…1000; sphere from 2, torus from 3 |
//! | `thickness` | `0.5` | torus: the tube's radius over the ring's, 0.001…1000 |
//! | `scale` | `1` | a number, or one along each axis; done first |
//! | `rotate` | none | `{ axis = [x, y, z], degrees = d }`, or a list of them, done in order |
//! | `translate` | `[0, 0, 0]` | done last |
//! | `diffuse`, `specular`, `shininess` | `[1, 1, 1]`, `[0.5, 0.5, 0.5]`, `50` | the material; an OBJ file's own goes before the default |
//! | `texture` | none | a picture, which the diffuse colour is multiplied with; PNG or JPEG |
//! | `casts` | `true` | whether it is drawn into the shadow map |
//! | `spin` | none | `{ axis = [x, y, z], degrees_per_second = d }`: a turn before scale, rotate and translate |

mod camera;
mod light;
mod numbers;
mod object;
mod table;

use std::path::Path;

use glam::DVec3;

use super::Scene;
use super::obj::MOST_TRIANGLES;
use super::reading::{Files, SCENE_LIMIT};
use crate::{Error, Result};
use numbers::Kind;
use object::Meshes;
use table::{Source, Table};

/// Each object is a draw call.
const MOST_OBJECTS: usize = 65_536;

/// Reads a scene. It may name files of its own folder, or of any if `allow_outside`.
pub fn load(path: &Path, allow_outside: bool) -> Result<Scene> {
    let files = if allow_outside {
        Files::anywhere()
    } else {
        Files::within(path.parent().unwrap_or(Path::new("")))?
    };
    // The scene itself may be a link to somewhere else: it is what the user asked for.
    let text = super::reading::read_text(path, SCENE_LIMIT)?;
    let scene = parse(path, &text, &files)?;
    files.print_notes();
    Ok(scene)
}

/// A scene in memory: `path` is its name in messages, and `files` gives what it names.
pub fn parse(path: &Path, text: &str, files: &Files) -> Result<Scene> {
    let source = Source::new(path, text);
    let entries = source.entries()?;
    let root = Table::new(
        &source,
        "a scene",
        0,
        &entries,
        &[
            "size", "clear", "ambient", "sky", "camera", "light", "object",
        ],
    )?;

    let camera = camera::camera(&root.required("camera")?.table("[camera]", camera::KEYS)?)?;
    let objects = objects(path, &root, files)?;
    let mut lights = Vec::new();
    if let Some(value) = root.value("light") {
        for table in value.tables("[light]", light::KEYS)? {
            lights.push(light::light(&table, &objects)?);
        }
    }
    let size = root.value("size").map(|value| {
        let sides = value.numbers::<2>(Kind::Whole(1, 16_384))?;
        Ok(sides.map(|side| side as u32))
    });
    let sky = root.value("sky").map(|value| value.picture(path, files));
    Ok(Scene {
        size: size.transpose()?,
        clear: root.vector("clear", Kind::Share, [0.1, 0.1, 0.15].into())?,
        camera,
        lights,
        ambient: root.vector("ambient", Kind::Color, DVec3::splat(0.2))?,
        sky: sky.transpose()?,
        objects,
    })
}

fn objects(path: &Path, root: &Table, files: &Files) -> Result<Vec<super::Object>> {
    let mut meshes = Meshes::default();
    let mut objects = Vec::new();
    let mut triangles = 0;
    for table in root
        .required("object")?
        .tables("[[object]]", object::KEYS)?
    {
        let first = objects.len();
        objects.extend(object::objects(path, &table, &mut meshes, files)?);
        let new = objects[first..]
            .iter()
            .map(|object| object.mesh.faces.len());
        triangles += new.sum::<usize>();
        if triangles > MOST_TRIANGLES || objects.len() > MOST_OBJECTS {
            return Err(table.wrong(format!(
                "found {triangles} triangles in {} objects up to here, expected at most {MOST_TRIANGLES} in {MOST_OBJECTS}",
                objects.len()
            )));
        }
    }
    if objects.is_empty() {
        return Err(Error::input(
            path,
            None,
            "found no objects, expected at least one [[object]]",
        ));
    }
    Ok(objects)
}

#[cfg(test)]
mod tests;
