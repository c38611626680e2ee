//! `[[object]]`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DVec3};

use super::numbers::Kind;
use super::table::{Table, Value};
use crate::Result;
use crate::error::did_you_mean;
use crate::scene::reading::Files;
use crate::scene::{Material, Mesh, Object, Spin, obj, rotate, shapes};

pub const KEYS: &[&str] = &[
    "mesh",
    "mesh_size",
    "thickness",
    "scale",
    "rotate",
    "translate",
    "diffuse",
    "specular",
    "shininess",
    "texture",
    "casts",
    "spin",
];

/// The meshes of the course.
const BUILTIN: &[&str] = &["plane", "sphere", "torus", "cube", "teapot"];

/// Each mesh is made once, however many objects have it.
#[derive(Default)]
pub struct Meshes {
    builtin: HashMap<(&'static str, u32, u64), Arc<Mesh>>,
    models: HashMap<PathBuf, Vec<Shared>>,
}

/// A part of a model, or a mesh of the course.
#[derive(Clone)]
struct Shared {
    name: String,
    mesh: Arc<Mesh>,
    /// What its own file says.
    material: Option<Material>,
}

/// One object, or one for each part of a model.
pub fn objects(
    scene: &Path,
    table: &Table,
    meshes: &mut Meshes,
    files: &Files,
) -> Result<Vec<Object>> {
    let placement = placement(table)?;
    let spin = table.value("spin").map(|value| spin(&value)).transpose()?;
    let casts = table.flag("casts", true)?;
    let texture = table.value("texture");
    let texture = texture
        .map(|value| value.picture(scene, files))
        .transpose()?;
    let value = table.required("mesh")?;
    let parts = meshes.parts(scene, table, &value, files)?;
    let mut objects = Vec::new();
    for Shared {
        name,
        mesh,
        material,
    } in parts
    {
        let own = material.unwrap_or_default();
        let material = Material {
            diffuse: table.vector("diffuse", Kind::Color, own.diffuse)?,
            specular: table.vector("specular", Kind::Color, own.specular)?,
            // 0⁰ is undefined in GLSL.
            shininess: table
                .number("shininess", Kind::Between(0.0, 1e6), own.shininess)?
                .max(1e-3),
            texture: texture.clone().or(own.texture),
        };
        objects.push(Object {
            plane: value.text()? == "plane",
            name,
            mesh,
            placement,
            spin,
            material,
            casts,
            receives: true,
        });
    }
    Ok(objects)
}

impl Meshes {
    fn parts(
        &mut self,
        scene: &Path,
        table: &Table,
        value: &Value,
        files: &Files,
    ) -> Result<Vec<Shared>> {
        let name = value.text()?;
        let builtin = BUILTIN.iter().find(|builtin| **builtin == name);
        let Some(builtin) = builtin else {
            // What belongs to other meshes must make sense all the same.
            mesh_size(table, "plane")?;
            thickness(table)?;
            return self.model(scene, value, files);
        };
        let (size, thickness) = (mesh_size(table, builtin)?, thickness(table)?);
        let mesh = self
            .builtin
            .entry((builtin, size, thickness.to_bits()))
            .or_insert_with(|| Arc::new(build(builtin, size, thickness)));
        Ok(vec![Shared {
            name: name.to_owned(),
            mesh: Arc::clone(mesh),
            material: None,
        }])
    }

    /// The parts of an OBJ file.
    fn model(&mut self, scene: &Path, value: &Value, files: &Files) -> Result<Vec<Shared>> {
        let name = value.text()?;
        if !name.to_lowercase().ends_with(".obj") {
            let hint = did_you_mean(name, BUILTIN.iter().copied());
            let builtin = BUILTIN.join(", ");
            return Err(value.wrong(&format!("one of {builtin}, or an .obj file{hint}")));
        }
        let path = value.path(scene)?;
        if let Some(known) = self.models.get(&path) {
            return Ok(known.clone());
        }
        let parts = obj::read(&path, files).map_err(|error| value.naming(&path, error))?;
        let shared = parts.into_iter().map(|part| Shared {
            name: part.name,
            mesh: Arc::new(part.mesh),
            material: part.material,
        });
        let shared: Vec<Shared> = shared.collect();
        self.models.insert(path, shared.clone());
        Ok(shared)
    }
}

/// Below the least size a mesh would have no volume.
fn mesh_size(table: &Table, mesh: &str) -> Result<u32> {
    let least = match mesh {
        "sphere" => 2,
        "torus" => 3,
        _ => 1,
    };
    let size = table.number("mesh_size", Kind::Whole(least, 1000), 20.0)? as u32;
    // Known before it is made: at most so many triangles.
    let triangles = match mesh {
        "teapot" => 64 * size * size,
        _ => 4 * size * size,
    };
    match table.value("mesh_size") {
        Some(value) if triangles as usize > obj::MOST_TRIANGLES => Err(value.error(format!(
            "found a {mesh} of {triangles} triangles, expected at most {}",
            obj::MOST_TRIANGLES
        ))),
        _ => Ok(size),
    }
}

fn thickness(table: &Table) -> Result<f64> {
    table.number("thickness", Kind::Between(0.001, 1000.0), 0.5)
}

fn build(mesh: &str, size: u32, thickness: f64) -> Mesh {
    match mesh {
        "plane" => shapes::plane(size),
        "sphere" => shapes::sphere(size),
        "torus" => shapes::torus(thickness, size),
        "cube" => shapes::cube(),
        _ => shapes::teapot(size),
    }
}

/// Scale first, then each turn in order, then the move.
fn placement(table: &Table) -> Result<DMat4> {
    let mut placement = match table.value("scale") {
        None => DMat4::IDENTITY,
        Some(value) => DMat4::from_scale(scale(&value)?),
    };
    if let Some(value) = table.value("rotate") {
        for turn in value.tables("rotate", &["axis", "degrees"])? {
            let axis = turn.required("axis")?.direction()?;
            let degrees = turn.required("degrees")?.number(Kind::Any)?;
            placement = rotate(degrees, axis) * placement;
        }
    }
    let translate = table.vector("translate", Kind::Any, DVec3::ZERO)?;
    Ok(DMat4::from_translation(translate) * placement)
}

fn scale(value: &Value) -> Result<DVec3> {
    let sides = if value.is_number() {
        DVec3::splat(value.number(Kind::Any)?)
    } else {
        value.vector(Kind::Any)?
    };
    // A scale of 0 flattens the object: it has no normals any more. One below 0 is a mirror.
    let usable = |side: f64| (1e-6..=1e6).contains(&side.abs());
    if sides.to_array().into_iter().all(usable) {
        Ok(sides)
    } else {
        Err(value.wrong("a number of 1e-6 to 1e6, or three, either sign"))
    }
}

fn spin(value: &Value) -> Result<Spin> {
    let table = value.table("spin", &["axis", "degrees_per_second"])?;
    Ok(Spin {
        axis: table.required("axis")?.direction()?,
        degrees_per_second: table
            .required("degrees_per_second")?
            .number(Kind::Between(-1e6, 1e6))?,
    })
}
