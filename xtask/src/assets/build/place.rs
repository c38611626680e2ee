//! Meshes moved, mirrored, joined and fitted; and boxes whose pictures keep their scale.

use glam::{DMat3, DMat4, DVec2, DVec3};
use shadowlab::scene::{Mesh, shapes};

pub fn placed(mut mesh: Mesh, placement: DMat4) -> Mesh {
    // Normals go with the inverse transpose: a stretched ball is an ellipsoid with right normals.
    let normal_matrix = DMat3::from_mat4(placement).inverse().transpose();
    for position in &mut mesh.positions {
        *position = placement.transform_point3(*position);
    }
    for normal in &mut mesh.normals {
        *normal = (normal_matrix * *normal).normalize();
    }
    mesh
}

pub fn moved(mesh: Mesh, offset: DVec3) -> Mesh {
    placed(mesh, DMat4::from_translation(offset))
}

/// The mirror image in the plane x = 0, its faces turned round so that they look outwards again.
pub fn mirrored(mut mesh: Mesh) -> Mesh {
    for vector in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        vector.x = -vector.x;
    }
    for face in &mut mesh.faces {
        face.swap(1, 2);
    }
    mesh
}

pub fn joined(solids: impl IntoIterator<Item = Mesh>) -> Mesh {
    let mut all = Mesh::default();
    for solid in solids {
        let first = all.positions.len() as u32;
        all.positions.extend(solid.positions);
        all.normals.extend(solid.normals);
        all.texture_coords.extend(solid.texture_coords);
        let faces = solid.faces.iter().map(|face| face.map(|i| first + i));
        all.faces.extend(faces);
    }
    all
}

/// Stretched along the axes so that it fills the box exactly.
pub fn fitted(mesh: Mesh, low: DVec3, high: DVec3) -> Mesh {
    let least = mesh.positions.iter().copied().reduce(DVec3::min);
    let most = mesh.positions.iter().copied().reduce(DVec3::max);
    let (least, most) = (least.expect("a mesh"), most.expect("a mesh"));
    let scale = (high - low) / (most - least);
    let placement = DMat4::from_translation(low - least * scale) * DMat4::from_scale(scale);
    placed(mesh, placement)
}

/// A box from corner to corner; `picture` gives the texture coordinates from the position and the normal.
pub fn block(low: DVec3, high: DVec3, picture: impl Fn(DVec3, DVec3) -> DVec2) -> Mesh {
    let mut mesh = shapes::cube();
    for i in 0..mesh.positions.len() {
        let position = low + (mesh.positions[i] + 0.5) * (high - low);
        mesh.positions[i] = position;
        mesh.texture_coords[i] = picture(position, mesh.normals[i]);
    }
    mesh
}
