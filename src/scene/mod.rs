//! Plain data: what is in a scene, in f64, before any lab or driver sees it.
//!
//! Lengths are in world units, angles in degrees where a name says so, colours linear in 0…1.
//! Right-handed; y is up in the scenes that this project made itself.

pub mod camera;
pub mod file;
pub mod graph;
pub mod mesh;
pub mod obj;
pub mod reading;
pub mod shapes;
pub mod texture;

use std::sync::Arc;

use glam::{DMat4, DVec3};

pub use camera::{Camera, Fov};
pub use mesh::Mesh;

/// Everything that a lab draws, and that a ray would meet.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The size of the picture that the scene was made for; None: the course's window.
    pub size: Option<[u32; 2]>,
    /// What is seen where there is neither surface nor sky.
    pub clear: DVec3,
    pub camera: Camera,
    pub lights: Vec<Light>,
    /// Light that comes from everywhere and is never shadowed.
    pub ambient: DVec3,
    pub sky: Option<Arc<image::RgbaImage>>,
    pub objects: Vec<Object>,
}

/// One mesh, placed and given a material.
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    pub mesh: Arc<Mesh>,
    /// Object space to world space, before the spin.
    pub placement: DMat4,
    pub spin: Option<Spin>,
    pub material: Material,
    /// Whether the object is drawn into the shadow map.
    pub casts: bool,
    /// Whether shadows fall on it: where they are projected, onto the walls alone.
    pub receives: bool,
    /// Whether the mesh is the course's Plane: a sheet without volume, whose normal is +z in object space.
    pub plane: bool,
}

/// A steady turn about an axis through the object's own origin, applied before the placement.
#[derive(Clone, Copy, Debug)]
pub struct Spin {
    pub axis: DVec3,
    pub degrees_per_second: f64,
}

#[derive(Clone, Debug)]
pub struct Material {
    pub diffuse: DVec3,
    pub specular: DVec3,
    pub shininess: f64,
    /// With alpha, which a lab may cut holes by, or pass over.
    pub texture: Option<Arc<image::RgbaImage>>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            diffuse: DVec3::ONE,
            specular: DVec3::splat(0.5),
            shininess: 50.0,
            texture: None,
        }
    }
}

/// A light source with the camera that its shadow map is drawn from.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    pub kind: LightKind,
    pub position: DVec3,
    /// The way the light travels; any length.
    pub direction: DVec3,
    pub color: DVec3,
    /// Near and far plane of the shadow map's camera.
    pub near: f64,
    pub far: f64,
}

/// What kinds of light there are; angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// `cone` is the beam's full angle.
    Spot { cone: f64, beam: Beam },
    /// `shadow_fov` is the field of view of its shadow map.
    Point { shadow_fov: f64 },
    /// Parallel rays; left, right, bottom and top of the box that the shadow map covers, seen from the position.
    Directional { area: [f64; 4] },
}

/// The cross-section of a spot light's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beam {
    Rectangular,
    Circular,
}

impl Object {
    /// An object that stands still and casts.
    pub fn new(name: &str, mesh: Mesh, placement: DMat4, material: Material) -> Self {
        Self {
            name: name.to_owned(),
            mesh: Arc::new(mesh),
            placement,
            spin: None,
            material,
            casts: true,
            receives: true,
            plane: false,
        }
    }

    /// Object space to world space at `time` seconds.
    pub fn model(&self, time: f64) -> DMat4 {
        match self.spin {
            None => self.placement,
            Some(spin) => {
                // Whole turns leave first: the angle stays small however long the program runs.
                let degrees = (spin.degrees_per_second * time) % 360.0;
                self.placement * rotate(degrees, spin.axis)
            }
        }
    }
}

impl Scene {
    /// The same scene somewhere else: every object, the camera and the lights moved by `offset`.
    pub fn moved(mut self, offset: DVec3) -> Self {
        self.camera.eye += offset;
        for light in &mut self.lights {
            light.position += offset;
        }
        for object in &mut self.objects {
            object.placement = DMat4::from_translation(offset) * object.placement;
        }
        self
    }

    /// The same scene in another size: every length, of the camera and the lights too, times `factor`.
    pub fn scaled(mut self, factor: f64) -> Self {
        let camera = &mut self.camera;
        camera.eye *= factor;
        camera.near *= factor;
        camera.far = camera.far.map(|far| factor * far);
        for light in &mut self.lights {
            light.position *= factor;
            light.near *= factor;
            light.far *= factor;
            if let LightKind::Directional { area } = &mut light.kind {
                *area = area.map(|side| factor * side);
            }
        }
        for object in &mut self.objects {
            object.placement = DMat4::from_scale(DVec3::splat(factor)) * object.placement;
        }
        self
    }
}

/// `Affine.h`'s `rotate`: degrees about an axis through the origin.
pub fn rotate(degrees: f64, axis: DVec3) -> DMat4 {
    DMat4::from_axis_angle(axis.normalize(), degrees.to_radians())
}
