//! Which pixels are in shadow in truth: by rays in f64, from the fields of camera and light.
//!
//! It knows no matrix of a lab and no depth map, so that it cannot share their faults. For each pixel centre a ray
//! goes from the camera to the nearest triangle, and from there to the light; the triangle that is seen is left out of
//! the second ray by its identity, never by an offset; another triangle in the same plane, by f64's own rounding. What casts in OpenGL casts here: the first pass discards
//! nothing, so every triangle of an object that casts is opaque, from both sides. A surface is solid for the camera's ray,
//! too: where a lab cuts holes by a texture's alpha, the picture shows what lies behind, and the truth does not.

mod area;
mod light;
mod rays;
mod view;

use glam::{DVec2, DVec3, dvec2};
use rayon::prelude::*;

pub use area::{AreaLight, Penumbra};
pub use light::{MapWidth, Source};
pub use rays::{Hit, Ray, Surfaces};
use view::View;

use crate::scene::Scene;

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
    /// 1/256 pixel, or the surface is within 1e-4 of grazing, or another one in the same place faces the other way.
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
        if let Some((triangle, point)) = pixel.seen {
            pixel.ambiguous |= self.has_another_side(triangle, point);
        }
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

    /// Along a ray that starts or ends on a triangle, the stretch in which it has not left the triangle's plane by more
    /// than rounding: what it meets there is the same surface once more, a triangle that occurs twice.
    fn in_plane(&self, triangle: u32, ray: &Ray) -> f64 {
        let [a, b, c] = *self.surfaces.triangle(triangle);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        self.surfaces.rounding() / normal.dot(ray.direction).abs()
    }

    /// Whether a triangle in the same place faces the other way: which of the two a rasteriser shows is a tie.
    fn has_another_side(&self, triangle: u32, point: DVec3) -> bool {
        let ray = Ray::new(DVec3::ZERO, point);
        let slack = self.in_plane(triangle, &ray);
        let is_lit = self.facing(triangle, point) > 0.0;
        self.surfaces
            .is_met(&ray, 1.0 - slack, 1.0 + slack, |other| {
                other != triangle && (self.facing(other, point) > 0.0) != is_lit
            })
    }

    /// Whether something stands between a point of a triangle and the light.
    pub fn is_shadowed(&self, triangle: u32, point: DVec3) -> bool {
        let ray = Ray::new(point, self.source.towards(point));
        self.is_stopped(&ray, triangle, self.source.end())
    }

    /// Whether a caster meets a ray that starts on a triangle, before `end`.
    fn is_stopped(&self, ray: &Ray, triangle: u32, end: f64) -> bool {
        let near = self.in_plane(triangle, ray);
        self.surfaces
            .is_met(ray, near, end, |other| self.blocks(other, triangle))
    }

    /// Whether a caster meets a ray that comes to a triangle's plane at 1.
    pub fn is_blocked(&self, ray: &Ray, triangle: u32) -> bool {
        let end = 1.0 - self.in_plane(triangle, ray);
        self.surfaces
            .is_met(ray, 0.0, end, |other| self.blocks(other, triangle))
    }

    /// What stands between a point of a triangle and the light, nearest to the point.
    pub fn nearest_blocker(&self, triangle: u32, point: DVec3) -> Option<Hit> {
        let ray = Ray::new(point, self.source.towards(point));
        let mut near = self.in_plane(triangle, &ray);
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
        let near = self.in_plane(hit.triangle, &ray);
        match self
            .surfaces
            .is_met_by_any(&ray, near, self.source.end(), blocks)
        {
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
