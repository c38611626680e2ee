//! tobj reads what the guard let through; faces become triangles, and each vertex gets a normal.

use std::io::{self, BufReader, Read};
use std::path::Path;

use glam::{DVec2, DVec3};

use super::guard::Passed;
use super::{Part, polygon};
use crate::error::one_line;
use crate::progress::Progress;
use crate::scene::Mesh;
use crate::{Error, Result};

/// The parts with their meshes.
pub fn parts(path: &Path, (mut parts, text): Passed) -> Result<Vec<Part>> {
    let models = models(path, &text)?;
    drop(text);
    for (part, model) in parts.iter_mut().zip(models) {
        part.mesh = Builder::new(model.mesh).mesh();
    }
    Ok(parts)
}

/// One model for each part.
fn models(path: &Path, text: &str) -> Result<Vec<tobj::Model>> {
    // Equal corners are one vertex; but tobj's triangles are right for convex faces only.
    let options = tobj::LoadOptions {
        single_index: true,
        ..tobj::LoadOptions::default()
    };
    let name = one_line(&path.display().to_string());
    let progress = Progress::new(format!("reading {name}"), text.len() as u64);
    let mut reader = BufReader::new(Watched(text.as_bytes(), progress));
    let no_library = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    match tobj::load_obj_buf(&mut reader, &options, no_library) {
        Ok((models, _)) => Ok(models),
        Err(error) => Err(Error::input(path, None, super::unread(&error))),
    }
}

/// A text that is read while a person waits.
struct Watched<'a>(&'a [u8], Progress);

impl Read for Watched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.0.read(buffer)?;
        self.1.add(count as u64);
        Ok(count)
    }
}

struct Builder {
    model: tobj::Mesh,
    mesh: Mesh,
    /// Where the model's vertices are in the mesh, of those that are there.
    places: Vec<Option<u32>>,
}

impl Builder {
    fn new(model: tobj::Mesh) -> Self {
        Self {
            places: vec![None; model.positions.len() / 3],
            mesh: Mesh::default(),
            model,
        }
    }

    fn mesh(mut self) -> Mesh {
        let indices = std::mem::take(&mut self.model.indices);
        let arities = std::mem::take(&mut self.model.face_arities);
        // tobj leaves the arities out where all faces are triangles.
        let arities = arities.into_iter().chain(std::iter::repeat(3));
        let mut points = Vec::new();
        let mut triangles = Vec::new();
        let mut rest = &indices[..];
        for arity in arities {
            if rest.is_empty() {
                break;
            }
            let (face, after) = rest.split_at(arity as usize);
            rest = after;
            points.clear();
            points.extend(face.iter().map(|index| self.position(*index)));
            polygon::triangles(&points, &mut triangles);
            for triangle in &triangles {
                self.push_triangle(triangle.map(|i| face[i]));
            }
        }
        self.mesh
    }

    fn push_triangle(&mut self, corners: [u32; 3]) {
        let face = corners.map(|index| match self.normal(index) {
            Some(normal) => self.shared(index, normal),
            // Without a normal the triangle has a vertex, and its own normal, to itself.
            None => self.push_vertex(index, self.own_normal(corners)),
        });
        self.mesh.faces.push(face);
    }

    fn position(&self, index: u32) -> DVec3 {
        DVec3::from_slice(&self.model.positions[3 * index as usize..])
    }

    /// None if it has no direction, as programs write for faces without area.
    fn normal(&self, index: u32) -> Option<DVec3> {
        // A file holds few digits: the length is made 1 again.
        DVec3::from_slice(&self.model.normals[3 * index as usize..]).try_normalize()
    }

    fn own_normal(&self, corners: [u32; 3]) -> DVec3 {
        let [a, b, c] = corners.map(|index| self.position(index));
        // A triangle without area is never seen: it may face anywhere.
        (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z)
    }

    fn shared(&mut self, index: u32, normal: DVec3) -> u32 {
        let known = self.places[index as usize];
        let place = known.unwrap_or_else(|| self.push_vertex(index, normal));
        self.places[index as usize] = Some(place);
        place
    }

    fn push_vertex(&mut self, index: u32, normal: DVec3) -> u32 {
        let place = self.mesh.positions.len() as u32;
        let texture_coord = DVec2::from_slice(&self.model.texcoords[2 * index as usize..]);
        self.mesh.positions.push(self.position(index));
        self.mesh.normals.push(normal);
        self.mesh.texture_coords.push(texture_coord);
        place
    }
}
