//! "Load model": a Model is a collection of Meshes; [`obj`] stands for Assimp.

use std::path::Path;
use std::sync::Arc;

use glam::DMat4;
use image::RgbaImage;

use crate::gl;
use crate::scene::{Object, Scene, obj};
use crate::{Error, Result};

/// A file of the course, in the program.
pub type File = (&'static str, &'static [u8]);

/// What hangs together under one name: each of the meshes has a material of its own.
pub struct Model {
    pub name: String,
    pub meshes: Vec<Mesh>,
}

/// The mesh data on the GPU: vertices and indices, and the textures to choose from. Its material and its place stand in
/// the scene.
pub struct Mesh {
    /// Its number in the scene.
    pub object: usize,
    pub buffers: gl::Mesh,
    pub textures: Vec<glow::Texture>,
}

impl Model {
    /// The models of a scene; `others` has a model's further textures, by its name.
    pub fn of_scene(
        gl: &glow::Context,
        scene: &Scene,
        others: impl Fn(&str) -> Option<File>,
    ) -> Result<Vec<Self>> {
        let mut models: Vec<Self> = Vec::new();
        let white = gl::solid_texture(gl)?;
        let mut sent = gl::Textures::default();
        for (object, index) in scene.objects.iter().zip(0..) {
            let name = &object.name;
            let mut textures = vec![match &object.material.texture {
                Some(picture) => sent.of(gl, &format!("{name}_texture"), picture, || {
                    gl::levels(picture)
                })?,
                None => white,
            }];
            if let Some(file) = others(name) {
                let picture = load_texture(file)?;
                textures.push(gl::texture(
                    gl,
                    &format!("{name}_texture_2"),
                    &gl::levels(&picture),
                )?);
            }
            let mesh = Mesh {
                object: index,
                buffers: gl::Mesh::new(gl, name, &object.mesh)?,
                textures,
            };
            match models.last_mut() {
                Some(model) if model.name == *name => model.meshes.push(mesh),
                _ => models.push(Self {
                    name: name.clone(),
                    meshes: vec![mesh],
                }),
            }
        }
        Ok(models)
    }
}

/// A model with the files that belong to it, placed.
#[doc(alias = "loadOBJ")]
pub fn load_obj(name: &str, files: &[File], placement: DMat4) -> Result<Vec<Object>> {
    let (path, text) = files[0];
    let parts = obj::parse(Path::new(path), text, |wanted| {
        let found = files.iter().find(|(known, _)| *known == wanted);
        Ok(found.expect("the model's files are given").1.to_vec())
    })?;
    let placed = |part: obj::Part| {
        let material = part.material.unwrap_or_default();
        Object::new(name, part.mesh, placement, material)
    };
    Ok(parts.into_iter().map(placed).collect())
}

#[doc(alias = "loadTexture")]
pub fn load_texture((name, bytes): File) -> Result<Arc<RgbaImage>> {
    let picture = image::load_from_memory(bytes);
    let picture = picture.map_err(|error| Error::input(name, None, error.to_string()))?;
    Ok(Arc::new(picture.into_rgba8()))
}
