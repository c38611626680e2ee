//! OBJ models through tobj.
//!
//! tobj does not say where it stopped, panics at a colour of two numbers, and passes over materials
//! that do not exist. So each line is checked here first, and tobj sees only what passed.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Material, Mesh};
use crate::error::did_you_mean;
use crate::{Error, Result};

/// The faces of one object that have one material.
#[derive(Clone, Debug)]
pub struct Part {
    pub name: String,
    pub mesh: Mesh,
    pub material: Material,
}

/// Reads a model; its materials and its textures are looked for beside it.
pub fn load(path: &Path) -> Result<Vec<Part>> {
    let read = |path: &Path| std::fs::read(path).map_err(|cause| Error::reading(path, cause));
    let text = read(path)?;
    parse(path, &text, |name| {
        // Programs on Windows write the names of textures with backslashes.
        read(&path.with_file_name(name.replace('\\', "/")))
    })
}

/// A model in memory: `path` is its name in messages, `read` gives a material library or texture by name.
pub fn parse(
    path: &Path,
    text: &[u8],
    read: impl Fn(&str) -> Result<Vec<u8>>,
) -> Result<Vec<Part>> {
    // Old files have comments that are not UTF-8.
    let text = String::from_utf8_lossy(text);
    let (text, libraries) = checked_model(path, &text, &read)?;
    let options = tobj::LoadOptions {
        triangulate: true,
        single_index: true,
        ..Default::default()
    };
    let library = |name: &Path| Ok(libraries[&*name.to_string_lossy()].clone());
    let (models, materials) = tobj::load_obj_buf(&mut text.as_bytes(), &options, library)
        .and_then(|(models, materials)| Ok((models, materials?)))
        .map_err(|cause| Error::input(path, None, format!("{cause}, expected an OBJ model")))?;

    let materials = materials.iter().map(|found| material(path, found, &read));
    let materials: Vec<Material> = materials.collect::<Result<_>>()?;
    let default = material(path, &tobj::Material::default(), &read)?;

    let mut parts = Vec::new();
    for model in models {
        if model.mesh.indices.is_empty() {
            continue;
        }
        let mesh = mesh(&model.mesh).map_err(|message| {
            Error::input(path, None, format!("object \"{}\": {message}", model.name))
        })?;
        let material = model.mesh.material_id.map_or(&default, |id| &materials[id]);
        parts.push(Part {
            name: model.name,
            mesh,
            material: material.clone(),
        });
    }
    if parts.is_empty() {
        let message = "found no faces, expected at least one";
        return Err(Error::input(path, None, message));
    }
    Ok(parts)
}

/// What is wrong with a line or object: what was found, and what was expected.
type Checked<T> = std::result::Result<T, String>;

/// Materials, and the index of each by name.
type Library = (Vec<tobj::Material>, HashMap<String, usize>);

/// The lines of a model that matter here, and the material libraries that they name.
fn checked_model(
    path: &Path,
    text: &str,
    read: &impl Fn(&str) -> Result<Vec<u8>>,
) -> Result<(String, HashMap<String, Library>)> {
    let mut kept = String::new();
    let mut libraries = HashMap::new();
    // How many positions, texture coordinates and normals there are so far.
    let mut counts = [0; 3];
    for (number, keyword, rest) in lines(text) {
        let at_line = |message| Error::input(path, number, message);
        let rest = match keyword {
            "v" | "vt" | "vn" => {
                let (kind, length) = match keyword {
                    "v" => (0, 3),
                    "vt" => (1, 2),
                    _ => (2, 3),
                };
                counts[kind] += 1;
                numbers(rest, length).map_err(at_line)?
            }
            "f" => corners(rest, counts).map_err(at_line)?,
            "mtllib" => {
                libraries.insert(rest.to_owned(), library(path, rest, read)?);
                rest.to_owned()
            }
            "usemtl" => known(rest, &libraries).map_err(at_line)?,
            "o" | "g" => rest.to_owned(),
            // Points and lines have no area, the rest says nothing about faces.
            _ => continue,
        };
        kept += &format!("{keyword} {rest}\n");
    }
    Ok((kept, libraries))
}

/// The lines of a material library that a [`Material`] has a place for.
fn library(path: &Path, name: &str, read: &impl Fn(&str) -> Result<Vec<u8>>) -> Result<Library> {
    let path = path.with_file_name(name);
    let bytes = read(name)?;
    let mut kept = String::new();
    for (number, keyword, rest) in lines(&String::from_utf8_lossy(&bytes)) {
        let rest = match keyword {
            "Kd" | "Ks" => numbers(rest, 3),
            "Ns" => numbers(rest, 1),
            "newmtl" | "map_Kd" if rest.is_empty() => Err("found nothing, expected a name".into()),
            "newmtl" | "map_Kd" => Ok(rest.to_owned()),
            _ => continue,
        };
        let rest = rest.map_err(|message| Error::input(&path, number, message))?;
        kept += &format!("{keyword} {rest}\n");
    }
    tobj::load_mtl_buf(&mut kept.as_bytes())
        .map_err(|cause| Error::input(&path, None, format!("{cause}, expected materials")))
}

/// Line number, keyword, and the rest of the line.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str, &str)> {
    text.lines().enumerate().map(|(index, line)| {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        (index + 1, keyword, rest.trim())
    })
}

/// The first `length` numbers. A fourth of a position would be a weight, more would be a colour.
fn numbers(rest: &str, length: usize) -> Checked<String> {
    let words: Vec<&str> = rest.split_whitespace().take(length).collect();
    let finite = |word: &&str| word.parse().is_ok_and(f64::is_finite);
    if words.len() == length && words.iter().all(finite) {
        Ok(words.join(" "))
    } else {
        Err(format!(
            "found \"{rest}\", expected {length} finite numbers"
        ))
    }
}

/// The corners of a face: `position/texture coordinate/normal`, the last two of which may be missing.
fn corners(rest: &str, counts: [i64; 3]) -> Checked<String> {
    for corner in rest.split_whitespace() {
        let indices: Vec<&str> = corner.split('/').collect();
        if indices.len() > 3 || indices[0].is_empty() {
            return Err(format!(
                "found the corner \"{corner}\", expected v, v/vt, v//vn or v/vt/vn"
            ));
        }
        for (index, count) in indices.iter().zip(counts) {
            // From the front they count from 1, from the back from −1.
            let exists = |index: i64| index != 0 && (-count..=count).contains(&index);
            if !index.is_empty() && !index.parse().is_ok_and(exists) {
                return Err(format!(
                    "found the index \"{index}\" in \"{corner}\", expected 1 to {count}, or −1 to −{count}"
                ));
            }
        }
    }
    match rest.split_whitespace().count() {
        0..=2 => Err(format!(
            "found the face \"{rest}\", expected at least 3 corners"
        )),
        _ => Ok(rest.to_owned()),
    }
}

fn known(name: &str, libraries: &HashMap<String, Library>) -> Checked<String> {
    let names = || libraries.values().flat_map(|library| library.1.keys());
    if names().any(|known| known == name) {
        return Ok(name.to_owned());
    }
    let hint = did_you_mean(name, names().map(String::as_str));
    Err(format!(
        "found the material \"{name}\", expected one of the mtllib above{hint}"
    ))
}

fn material(
    path: &Path,
    found: &tobj::Material,
    read: &impl Fn(&str) -> Result<Vec<u8>>,
) -> Result<Material> {
    let texture = match &found.diffuse_texture {
        None => None,
        Some(name) => {
            let picture = image::load_from_memory(&read(name)?).map_err(|cause| {
                let message = format!("found no picture ({cause}), expected a PNG");
                Error::input(path.with_file_name(name), None, message)
            })?;
            Some(Arc::new(picture.to_rgb8()))
        }
    };
    Ok(Material {
        diffuse: found.diffuse.unwrap_or([0.8; 3]).into(),
        specular: found.specular.unwrap_or_default().into(),
        shininess: found.shininess.unwrap_or(1.0),
        texture,
    })
}

fn mesh(found: &tobj::Mesh) -> Checked<Mesh> {
    let vertices = found.positions.len() / 3;
    let points =
        |array: &[f64]| -> Vec<DVec3> { array.chunks_exact(3).map(DVec3::from_slice).collect() };
    let mut mesh = Mesh {
        positions: points(&found.positions),
        normals: points(&found.normals),
        texture_coords: found
            .texcoords
            .chunks_exact(2)
            .map(DVec2::from_slice)
            .collect(),
        faces: found
            .indices
            .chunks_exact(3)
            .map(|face| [face[0], face[1], face[2]])
            .collect(),
    };
    if mesh.texture_coords.is_empty() {
        mesh.texture_coords = vec![DVec2::ZERO; vertices];
    }
    for (what, length) in [
        ("normals", mesh.normals.len()),
        ("texture coordinates", mesh.texture_coords.len()),
    ] {
        if length != 0 && length != vertices {
            return Err(format!(
                "found {what} at some corners, expected them at all or at none"
            ));
        }
    }
    if mesh.normals.is_empty() {
        return Ok(flat(&mesh));
    }
    // A file holds few digits: the length is made 1 again.
    for normal in &mut mesh.normals {
        *normal = normal
            .try_normalize()
            .ok_or_else(|| format!("found the normal {normal}, expected a direction"))?;
    }
    Ok(mesh)
}

/// Each face gets its own three vertices, with the face's normal.
fn flat(mesh: &Mesh) -> Mesh {
    let mut flat = Mesh::default();
    for face in &mesh.faces {
        let first = flat.positions.len() as u32;
        let corners = face.map(|i| mesh.positions[i as usize]);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        flat.positions.extend(corners);
        flat.normals.extend([normal.normalize_or_zero(); 3]);
        flat.texture_coords
            .extend(face.map(|i| mesh.texture_coords[i as usize]));
        flat.faces.push([first, first + 1, first + 2]);
    }
    flat
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    /// Parses a model whose material library is `mtl`.
    fn parsed(obj: &str, mtl: &str) -> Result<Vec<Part>> {
        parse(Path::new("m.obj"), obj.as_bytes(), |name| match name {
            "m.mtl" => Ok(mtl.into()),
            _ => Err(Error::input(name, None, "not there")),
        })
    }

    fn message(obj: &str, mtl: &str) -> String {
        parsed(obj, mtl).expect_err(obj).to_string()
    }

    #[test]
    fn a_square_with_a_material() {
        let obj = "mtllib m.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
                   vt 0 0\nvt 1 1\nvn 0 0 2\nusemtl red\nl 1 2 3\nf 1/1/1 2/2/1 3/2/1 -1/1/1\n";
        let parts = parsed(obj, "newmtl red\nKa 1\nKd 1 0 0\nKs .5 .5 .5\nNs 20\n").unwrap();
        let [part] = &parts[..] else {
            panic!("{}", parts.len())
        };
        assert_eq!(part.name, "square");
        assert_eq!(part.mesh.positions.len(), 4);
        assert_eq!(part.mesh.faces, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(part.mesh.normals, [DVec3::Z; 4]);
        assert_eq!(part.material.diffuse, DVec3::X);
        assert_eq!(part.material.shininess, 20.0);
        assert!(part.material.texture.is_none());
    }

    #[test]
    fn what_is_missing_is_made_up() {
        let obj = format!("{TRIANGLE}v 0 0 1\nf 1 2 3\nf 1 3 4\n");
        let mesh = &parsed(&obj, "").unwrap()[0].mesh;
        assert_eq!(mesh.positions.len(), 6);
        assert_eq!(mesh.normals[0], DVec3::Z);
        assert_eq!(mesh.normals[5], DVec3::X);
        assert_eq!(mesh.texture_coords, [DVec2::ZERO; 6]);
    }

    #[test]
    fn bad_models_are_told_in_one_line() {
        let face = |face: &str| format!("{TRIANGLE}vt 0 0\n{face}\n");
        for (obj, mtl, expected) in [
            ("", "", "m.obj: found no faces"),
            (TRIANGLE, "", "m.obj: found no faces"),
            (
                "v 1 2\n",
                "",
                "m.obj:1: found \"1 2\", expected 3 finite numbers",
            ),
            ("\nv 1 nan 2\n", "", "m.obj:2: found \"1 nan 2\""),
            ("v 1 1e999 2\n", "", "m.obj:1: found \"1 1e999 2\""),
            (
                &face("f 1 2 4"),
                "",
                "m.obj:5: found the index \"4\" in \"4\", expected 1 to 3",
            ),
            (&face("f 1 2 0"), "", "m.obj:5: found the index \"0\""),
            (&face("f 1 2 -4"), "", "m.obj:5: found the index \"-4\""),
            (
                &face("f 1 2 9223372036854775807"),
                "",
                "m.obj:5: found the index",
            ),
            (&face("f 1 2 x"), "", "m.obj:5: found the index \"x\""),
            (
                &face("f 1/2 2/1 3/1"),
                "",
                "m.obj:5: found the index \"2\" in \"1/2\"",
            ),
            (&face("f 1 2"), "", "m.obj:5: found the face \"1 2\""),
            (&face("f"), "", "m.obj:5: found the face"),
            (&face("f /1 2 3"), "", "m.obj:5: found the corner \"/1\""),
            (
                &face("f 1/1 2 3"),
                "",
                "m.obj: object \"unnamed_object\": found texture coordinates",
            ),
            ("usemtl red\n", "", "m.obj:1: found the material \"red\""),
            (
                "mtllib m.mtl\nusemtl redd\n",
                "newmtl red\n",
                "m.obj:2: found the material \"redd\", expected one of the mtllib above (did you mean \"red\"?)",
            ),
            (
                "mtllib m.mtl\n",
                "newmtl red\nKd 1 0\n",
                "m.mtl:2: found \"1 0\"",
            ),
            ("mtllib m.mtl\n", "newmtl\n", "m.mtl:1: found nothing"),
            ("mtllib n.mtl\n", "", "n.mtl: not there"),
        ] {
            let message = message(obj, mtl);
            assert!(message.starts_with(expected), "{message}");
        }
    }

    #[test]
    fn a_texture_that_is_no_picture_is_told() {
        let obj = format!("mtllib m.mtl\n{TRIANGLE}f 1 2 3\n");
        let message = message(&obj, "newmtl red\nmap_Kd m.mtl\n");
        assert!(message.starts_with("m.mtl: found no picture"), "{message}");
    }
}
