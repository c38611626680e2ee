//! Which pixels are in shadow in truth: by rays in f64, from the fields of camera and light.
//!
//! It knows no matrix of a lab and no depth map, so that it cannot share their faults. For each pixel centre a ray
//! goes from the camera to the nearest triangle, and from there to the light; the triangle that is seen is left out of
//! the second ray by its identity, never by an offset. What casts in OpenGL casts here: the first pass discards
//! nothing, so every triangle of an object that casts is opaque, from both sides. A surface is solid for the camera's ray,
//! too: where a lab cuts holes by a texture's alpha, the picture shows what lies behind, and the truth does not.

mod area;
mod light;
mod rays;

use glam::{DVec2, DVec3, dvec2};
use rayon::prelude::*;

pub use area::{AreaLight, Penumbra};
pub use light::{MapWidth, Source};
pub use rays::{Hit, Ray, Surfaces};

use crate::scene::{Camera, Scene};

/// How far a pixel's sample point is moved to see whether its label hangs on it, in pixels: GL snaps vertices to a
/// grid of this width.
const SHIFT: f64 = 1.0 / 256.0;
/// A surface that is seen by the light under a smaller angle than this (in radians) is called grazing.
const GRAZING: f64 = 1e-4;

/// What the truth says of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Label {
    /// No surface, or one that the light does not reach for another reason than shadow: it faces away from the light,
    /// or lies outside of its beam. Or one that the lab never shadows.
    NotValid,
    Lit,
    Shadowed,
}

/// The truth for every pixel of a picture, top row first.
pub struct Truth {
    pub size: [u32; 2],
    pub labels: Vec<Label>,
    /// Where the label hangs on less than a rasteriser promises: it changes when the pixel's sample point moves by
    /// 1/256 pixel, or the surface is within 1e-4 of grazing.
    pub ambiguous: Vec<bool>,
    /// The triangle that is seen, and where; relative to the eye.
    pub seen: Vec<Option<(u32, DVec3)>>,
    /// How many rays were cast.
    pub rays: u64,
}

/// A scene at one moment, ready for rays. The world's origin is moved to the eye.
pub struct Rays {
    pub surfaces: Surfaces,
    /// Of each triangle: the object that it belongs to.
    pub objects: Vec<u32>,
    /// Of each object: whether it casts.
    casts: Vec<bool>,
    /// Of each object: whether shadows fall on it.
    receives: Vec<bool>,
    pub source: Source,
    view: View,
}

impl Rays {
    /// Takes the scene at its time 0: see [`crate::labs::Lab::now`]. `light` counts from 0.
    pub fn new(scene: &Scene, light: usize) -> Self {
        let eye = scene.camera.eye;
        let mut triangles = Vec::new();
        let mut objects = Vec::new();
        for (object, number) in scene.objects.iter().zip(0..) {
            let model = glam::DMat4::from_translation(-eye) * object.model(0.0);
            let positions = object.mesh.positions.iter();
            let positions: Vec<DVec3> = positions.map(|p| model.transform_point3(*p)).collect();
            triangles.extend(
                object
                    .mesh
                    .faces
                    .iter()
                    .map(|face| face.map(|i| positions[i as usize])),
            );
            objects.resize(triangles.len(), number);
        }
        Self {
            surfaces: Surfaces::new(triangles),
            objects,
            casts: scene.objects.iter().map(|object| object.casts).collect(),
            receives: scene.objects.iter().map(|object| object.receives).collect(),
            source: Source::new(&scene.lights[light], eye),
            view: View::new(&scene.camera),
        }
    }

    /// Asks for every pixel of a picture, on all cores.
    pub fn truth(&self, size: [u32; 2]) -> Truth {
        self.truth_row_by_row(size, || ())
    }

    /// The same, and says so whenever a row is done.
    pub fn truth_row_by_row(&self, size: [u32; 2], row_is_done: impl Fn() + Sync) -> Truth {
        let rows: Vec<Vec<Pixel>> = (0..size[1])
            .into_par_iter()
            .map(|y| {
                let row = (0..size[0]).map(|x| self.pixel(size, [x, y])).collect();
                row_is_done();
                row
            })
            .collect();
        let pixels = || rows.iter().flatten();
        Truth {
            size,
            labels: pixels().map(|pixel| pixel.label).collect(),
            ambiguous: pixels().map(|pixel| pixel.ambiguous).collect(),
            seen: pixels().map(|pixel| pixel.seen).collect(),
            rays: pixels().map(|pixel| u64::from(pixel.rays)).sum(),
        }
    }

    /// One pixel, counted from the top left.
    fn pixel(&self, size: [u32; 2], [x, y]: [u32; 2]) -> Pixel {
        let centre = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let mut pixel = self.sample(size, centre);
        for shift in [
            dvec2(SHIFT, 0.0),
            dvec2(-SHIFT, 0.0),
            dvec2(0.0, SHIFT),
            dvec2(0.0, -SHIFT),
        ] {
            let shifted = self.sample(size, centre + shift);
            pixel.rays += shifted.rays;
            pixel.ambiguous |= shifted.label != pixel.label;
        }
        pixel
    }

    /// One point of the picture, in pixels from the top left.
    fn sample(&self, size: [u32; 2], place: DVec2) -> Pixel {
        let camera_ray = self.view.ray(size, place);
        let hit = self
            .surfaces
            .nearest(&camera_ray, self.view.near, self.view.far);
        let Some(Hit { triangle, t }) = hit else {
            return Pixel::new(Label::NotValid, None, 1);
        };
        let point = camera_ray.at(t);
        let seen = Some((triangle, point));
        let facing = self.facing(triangle, point);
        let mut pixel = if facing <= 0.0 || !self.is_reached(triangle, point) {
            Pixel::new(Label::NotValid, seen, 1)
        } else if self.is_shadowed(triangle, point) {
            Pixel::new(Label::Shadowed, seen, 2)
        } else {
            Pixel::new(Label::Lit, seen, 2)
        };
        pixel.ambiguous = facing.abs() < GRAZING;
        pixel
    }

    /// Whether the point of a triangle can be in shadow at all: it lies in the beam, on something that receives shadows.
    fn is_reached(&self, triangle: u32, point: DVec3) -> bool {
        self.receives[self.objects[triangle as usize] as usize] && self.source.reaches(point)
    }

    /// The cosine between a triangle's geometric normal and the direction to the light.
    fn facing(&self, triangle: u32, point: DVec3) -> f64 {
        let [a, b, c] = *self.surfaces.triangle(triangle);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        normal.dot(self.source.towards(point).normalize_or_zero())
    }

    /// Whether something stands between a point of a triangle and the light.
    pub fn is_shadowed(&self, triangle: u32, point: DVec3) -> bool {
        let ray = Ray::new(point, self.source.towards(point));
        self.surfaces.is_met(&ray, self.source.end(), |other| {
            self.blocks(other, triangle)
        })
    }

    /// Whether a caster other than `triangle` meets a ray before `end`.
    pub fn is_blocked(&self, ray: &Ray, end: f64, triangle: u32) -> bool {
        self.surfaces
            .is_met(ray, end, |other| self.blocks(other, triangle))
    }

    /// What stands between a point of a triangle and the light, nearest to the point.
    pub fn nearest_blocker(&self, triangle: u32, point: DVec3) -> Option<Hit> {
        let ray = Ray::new(point, self.source.towards(point));
        let mut near = f64::MIN_POSITIVE;
        // What does not block is stepped over.
        while let Some(hit) = self.surfaces.nearest(&ray, near, self.source.end()) {
            if self.blocks(hit.triangle, triangle) {
                return Some(hit);
            }
            near = hit.t.next_up();
        }
        None
    }

    /// Whether a triangle may shadow a point of another one.
    fn blocks(&self, triangle: u32, point_of: u32) -> bool {
        triangle != point_of && self.casts[self.objects[triangle as usize] as usize]
    }

    /// The same answer for a pixel's centre with every triangle asked, and no tree. For the checks.
    pub fn label_by_brute_force(&self, size: [u32; 2], [x, y]: [u32; 2]) -> Label {
        let ray = self
            .view
            .ray(size, dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let Some(hit) = self
            .surfaces
            .nearest_of_all(&ray, self.view.near, self.view.far)
        else {
            return Label::NotValid;
        };
        let point = ray.at(hit.t);
        if self.facing(hit.triangle, point) <= 0.0 || !self.is_reached(hit.triangle, point) {
            return Label::NotValid;
        }
        let ray = Ray::new(point, self.source.towards(point));
        let blocks = |other| self.blocks(other, hit.triangle);
        match self.surfaces.is_met_by_any(&ray, self.source.end(), blocks) {
            true => Label::Shadowed,
            false => Label::Lit,
        }
    }
}

struct Pixel {
    label: Label,
    ambiguous: bool,
    seen: Option<(u32, DVec3)>,
    rays: u32,
}

impl Pixel {
    fn new(label: Label, seen: Option<(u32, DVec3)>, rays: u32) -> Self {
        Self {
            label,
            ambiguous: false,
            seen,
            rays,
        }
    }
}

/// The camera's rays, from its fields; the eye is the origin.
struct View {
    forward: DVec3,
    /// Half the picture's width and height at distance 1, as vectors.
    right: DVec3,
    up: DVec3,
    camera: Camera,
    near: f64,
    far: f64,
}

impl View {
    fn new(camera: &Camera) -> Self {
        let forward = camera.look.normalize();
        let right = forward.cross(camera.rup).normalize();
        Self {
            forward,
            right,
            up: right.cross(forward),
            camera: *camera,
            near: camera.near,
            far: camera.far.unwrap_or(f64::INFINITY),
        }
    }

    /// The ray through a place of the picture; its `t` is the depth along the look, as near and far measure it.
    fn ray(&self, [width, height]: [u32; 2], place: DVec2) -> Ray {
        let (width, height) = (f64::from(width), f64::from(height));
        let aspect = width / height;
        let slope = (self.camera.fov.horizontal(aspect).to_radians() / 2.0).tan();
        let x = slope * (2.0 * place.x / width - 1.0);
        let y = slope / aspect * (1.0 - 2.0 * place.y / height);
        Ray::new(DVec3::ZERO, self.forward + x * self.right + y * self.up)
    }
}

impl Truth {
    pub fn count(&self, label: Label) -> usize {
        self.labels.iter().filter(|found| **found == label).count()
    }

    /// For every pixel, whether the label changes within one pixel of it, in any of eight directions.
    pub fn edges(&self) -> Vec<bool> {
        let [width, height] = self.size.map(i64::from);
        let label = |x: i64, y: i64| {
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            inside.then(|| self.labels[(y * width + x) as usize])
        };
        let near_change = |x: i64, y: i64| {
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
            let own = label(x, y);
            around
                .filter_map(|(x, y)| label(x, y))
                .any(|other| Some(other) != own)
        };
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        rows.map(|(x, y)| near_change(x, y)).collect()
    }
}
