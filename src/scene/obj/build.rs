//! From the lines of a model to its parts: corners become vertices, faces become triangles.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::model::{Corner, Model, NONE};
use super::{Part, polygon};
use crate::scene::Mesh;
use crate::scene::reading::Files;

/// A model with more parts than this is drawn by material alone: some programs name every single face.
pub const MOST_NAMED_PARTS: usize = 4096;

/// The faces with one name and one material, in the order in which these came.
pub fn parts(model: &Model, files: &Files) -> Vec<Part> {
    let materials = model.resolved_materials(files);
    let mut numbers = HashMap::new();
    let mut parts: Vec<(Part, Vertices)> = Vec::new();
    let mut builder = Builder::default();
    let mut start = 0;
    for face in &model.faces {
        let corners = &model.corners[start..face.end];
        start = face.end;
        let material = materials.get(face.material as usize).copied().flatten();
        // What is not there is no material of its own.
        let material_number = material.map_or(NONE, |_| face.material);
        let named = (face.name, material_number);
        let number = part_number(named, &mut numbers, parts.len());
        if number == parts.len() {
            let part = Part {
                name: model.names[face.name as usize].clone(),
                mesh: Mesh::default(),
                material: material.cloned(),
            };
            parts.push((part, Vertices::new()));
        }
        let (part, vertices) = &mut parts[number];
        builder.add(model, corners, &mut part.mesh, vertices);
    }
    parts.into_iter().map(|(part, _)| part).collect()
}

/// The vertices that a part has already, by the indices of their corner.
type Vertices = HashMap<Corner, u32>;

/// The part of a name and a material, by number; `count` if it is a new one.
fn part_number(named: (u32, u32), numbers: &mut HashMap<(u32, u32), usize>, count: usize) -> usize {
    if let Some(number) = numbers.get(&named) {
        return *number;
    }
    if count < MOST_NAMED_PARTS {
        numbers.insert(named, count);
        return count;
    }
    *numbers.entry((NONE, named.1)).or_insert(count)
}

/// Scratch space for one face after the other.
#[derive(Default)]
struct Builder {
    points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

impl Builder {
    fn add(&mut self, model: &Model, corners: &[Corner], mesh: &mut Mesh, vertices: &mut Vertices) {
        let position = |corner: &Corner| model.positions[corner[0] as usize];
        self.points.clear();
        self.points.extend(corners.iter().map(position));
        polygon::triangles(&self.points, &mut self.triangles);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.points[i]);
            // A triangle without area is never seen: it may face anywhere.
            let own_normal = || (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
            let face = triangle.map(|i| {
                let corner = corners[i];
                match normal(model, &corner) {
                    // Equal corners are one vertex.
                    Some(normal) => *vertices
                        .entry(corner)
                        .or_insert_with(|| push_vertex(model, mesh, &corner, normal)),
                    // Without a normal the triangle has a vertex, and its own normal, to itself.
                    None => push_vertex(model, mesh, &corner, own_normal()),
                }
            });
            mesh.faces.push(face);
        }
    }
}

/// The normal that a corner names; none if it has no direction, as programs write for faces without area.
fn normal(model: &Model, corner: &Corner) -> Option<DVec3> {
    // A file holds few digits: the length is made 1 again.
    model.normals.get(corner[2] as usize)?.try_normalize()
}

fn push_vertex(model: &Model, mesh: &mut Mesh, corner: &Corner, normal: DVec3) -> u32 {
    let number = mesh.positions.len() as u32;
    let texture_coord = model.texture_coords.get(corner[1] as usize);
    mesh.positions.push(model.positions[corner[0] as usize]);
    mesh.normals.push(normal);
    mesh.texture_coords
        .push(texture_coord.copied().unwrap_or(DVec2::ZERO));
    number
}
