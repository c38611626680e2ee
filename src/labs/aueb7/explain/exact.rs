//! The same in f64, from the unrounded scene.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, dvec2};

use super::super::Aueb7;
use super::fragment::Fragment;
use crate::labs::Probe;
use crate::labs::exact::{ClipTriangle, ExactMap, ROUNDING, Range, SNAP, corners};
use crate::scene::Object;

/// The samples of PCF in `is_point_in_shadow.frag`, in steps: center, top, bottom, left, right, and the diagonals.
const SAMPLES: [DVec2; 9] = [
    dvec2(0.0, 0.0),
    dvec2(0.0, 1.0),
    dvec2(0.0, -1.0),
    dvec2(-1.0, 0.0),
    dvec2(1.0, 0.0),
    dvec2(-1.0, 1.0),
    dvec2(1.0, 1.0),
    dvec2(-1.0, -1.0),
    dvec2(1.0, -1.0),
];

/// A point of a surface as the eye has it and as the light has it.
#[derive(Clone, Copy)]
struct Place {
    ecs: DVec3,
    lcs: DVec4,
}

/// The values of the test, each with the range that rounding and rasterisation leave it.
pub struct Exact {
    pub position_ecs: [Range; 3],
    pub position_lcs: [Range; 4],
    pub nearer: Range,
    pub stored: Vec<Range>,
    pub visible: Vec<Range>,
    pub shadow_factor: Range,
}

impl Aueb7 {
    pub(super) fn exact(&self, probe: Probe, fragment: &Fragment) -> Exact {
        let (centre, around) = match probe {
            Probe::Point(point) => {
                let ecs = self.view().transform_point3(point - self.camera().eye);
                (self.place_of(ecs), vec![])
            }
            Probe::Pixel([x, y]) => {
                let place = dvec2(f64::from(x) + 0.5, f64::from(self.size[1] - 1 - y) + 0.5);
                let at = |offset: DVec2| self.place_of(self.seen(fragment, place + offset));
                (at(DVec2::ZERO), corners(SNAP).map(at).to_vec())
            }
        };
        let ecs_rounding = self.ecs_rounding(probe, fragment, centre.ecs);
        let lcs_rounding = self.lcs_rounding(centre.ecs, ecs_rounding);
        let position_ecs = [0, 1, 2].map(|i| {
            let others = around.iter().map(|place| place.ecs[i]);
            widened(Range::over(centre.ecs[i], others), ecs_rounding[i])
        });
        let position_lcs = [0, 1, 2, 3].map(|i| {
            let others = around.iter().map(|place| place.lcs[i]);
            widened(Range::over(centre.lcs[i], others), lcs_rounding[i])
        });
        let nearer = shifted(&position_lcs[2], -self.bias());
        let nearer = widened(nearer, ROUNDING);
        let stored = self.exact_stored(&position_lcs);
        let samples = SAMPLES.iter().zip(&stored);
        let visible = samples
            .map(|(sample, stored)| self.exact_visible(*sample, &position_lcs, &nearer, stored));
        let visible: Vec<Range> = visible.collect();
        let mean = |value: fn(&Range) -> f64| {
            visible.iter().map(value).sum::<f64>() / visible.len() as f64
        };
        let shadow_factor = Range {
            value: mean(|range| range.value),
            least: mean(|range| range.least),
            most: mean(|range| range.most),
        };
        Exact {
            position_ecs,
            position_lcs,
            nearer,
            stored,
            visible,
            shadow_factor: widened(shadow_factor, ROUNDING),
        }
    }

    /// How many places of the map are looked at.
    pub(super) fn samples(&self) -> usize {
        match self.settings.choice("filter") {
            "pcf_5" => 5,
            "pcf_9" => 9,
            _ => 1,
        }
    }

    /// From one sample to the next one, in the map's coordinates.
    fn sample_step(&self) -> f64 {
        self.settings.number("step") / f64::from(self.shadow_fbo.shadow_dimensions)
    }

    fn place_of(&self, ecs: DVec3) -> Place {
        let clip = self.light_view_projection() * self.view().inverse() * ecs.extend(1.0);
        let lcs = 0.5 * clip.truncate() / clip.w + 0.5;
        Place {
            ecs,
            lcs: lcs.extend(clip.w),
        }
    }

    /// What the ray through a place of the picture, in pixels from the bottom left, meets of the fragment's triangle; in
    /// eye space.
    fn seen(&self, fragment: &Fragment, place: DVec2) -> DVec3 {
        let (corners, to_eye) = self.triangle(fragment);
        let ecs = corners.map(|corner| to_eye.transform_point3(corner));
        let clip = ecs.map(|corner| self.projection() * corner.extend(1.0));
        let shares = ClipTriangle::new(clip).map_or(DVec3::X, |t| t.shares(self.size, place));
        let [a, b, c] = ecs;
        DMat3::from_cols(a, b, c) * shares
    }

    /// The corners of the fragment's triangle in object space, and the object's matrix to eye space.
    fn triangle(&self, fragment: &Fragment) -> ([DVec3; 3], DMat4) {
        let (object, model) = self.geometry()[fragment.object];
        let indices = object.mesh.faces[fragment.triangle];
        let corners = indices.map(|i| object.mesh.positions[i as usize]);
        (corners, self.view() * self.model_from_eye(model))
    }

    /// Of `position_ecs`: rounding relative to the largest terms of `uniform_v * (uniform_m * position)`.
    fn ecs_rounding(&self, probe: Probe, fragment: &Fragment, ecs: DVec3) -> DVec3 {
        let terms = |model: DMat4, point: DVec3| {
            let terms =
                self.view().abs() * (self.model_from_eye(model).abs() * point.abs().extend(1.0));
            ROUNDING * terms.truncate()
        };
        match probe {
            Probe::Point(point) => terms(DMat4::from_translation(point), DVec3::ZERO),
            Probe::Pixel(_) => {
                let (_, model) = self.geometry()[fragment.object];
                let (corners, to_eye) = self.triangle(fragment);
                let largest = corners.map(|corner| terms(model, corner));
                let largest = largest.into_iter().fold(DVec3::ZERO, DVec3::max);
                self.stretch(corners, to_eye, ecs) * largest
            }
        }
    }

    /// How much nearer than the point its triangle comes to the eye: a rasteriser interpolates values divided by w over
    /// the whole triangle, and their rounding is that of the largest one.
    fn stretch(&self, corners: [DVec3; 3], to_eye: DMat4, ecs: DVec3) -> f64 {
        let nearest = corners.map(|corner| -to_eye.transform_point3(corner).z);
        let nearest = nearest.into_iter().fold(f64::INFINITY, f64::min);
        (-ecs.z / nearest.max(self.camera().near)).max(1.0)
    }

    /// Of `position_lcs`: what comes of the rounding of `position_ecs`, and that of the products and of the division.
    fn lcs_rounding(&self, ecs: DVec3, ecs_rounding: DVec3) -> DVec4 {
        let through = |matrix: DMat4, point: DVec4, rounding: DVec4| {
            matrix.abs() * rounding + ROUNDING * (matrix.abs() * point.abs())
        };
        let view_inverse = self.view().inverse();
        let wcs = view_inverse * ecs.extend(1.0);
        let wcs_rounding = through(view_inverse, ecs.extend(1.0), ecs_rounding.extend(0.0));
        let to_clip = self.light_view_projection();
        let clip = to_clip * wcs;
        let rounding = through(to_clip, wcs, wcs_rounding);
        let divided = clip.truncate() / clip.w;
        let lcs = (rounding.truncate() + divided.abs() * rounding.w) / clip.w.abs();
        (0.5 * lcs + ROUNDING * (divided.abs() + 1.0)).extend(rounding.w)
    }

    /// What each sample finds in the map of an exact rasteriser, and in the texels beside it as far as the lookup may be
    /// off.
    fn exact_stored(&self, [s, t, ..]: &[Range; 4]) -> Vec<Range> {
        let (mut map, terms) = self.exact_map();
        let off = s.radius().max(t.radius()) + ROUNDING;
        let light = self.light();
        let (near, far) = (light.near, light.far);
        let at_sample = |sample: &DVec2| {
            let uv = dvec2(s.value, t.value) + self.sample_step() * *sample;
            let found = map.lookup(uv);
            let nearby = corners(off).map(|offset| map.lookup(uv + offset));
            let nearby = nearby.iter().flat_map(|range| [range.least, range.most]);
            let all = Range::over(found.value, nearby.chain([found.least, found.most]));
            // Rounding of the surface's depth before its division by w, the distance from the light.
            let distance = near * far / (far - all.least * (far - near));
            widened(all, ROUNDING * (1.0 + terms / distance))
        };
        SAMPLES[..self.samples()].iter().map(at_sample).collect()
    }

    /// The map, and the largest terms of the depths in it, before the division by w.
    fn exact_map(&self) -> (ExactMap, f64) {
        let mut triangles = Vec::new();
        let mut terms: f64 = 0.0;
        for ((object, _), mvp) in self.geometry().iter().zip(self.map_inputs().mvps) {
            let Some(mvp) = mvp else { continue };
            let positions = &object.mesh.positions;
            let of_vertex = |p: &DVec3| (mvp.abs() * p.abs().extend(1.0)).z;
            terms = positions.iter().map(of_vertex).fold(terms, f64::max);
            triangles.extend(front_faces(object, mvp));
        }
        let map = ExactMap::new(triangles, self.shadow_fbo.shadow_dimensions, false);
        (map, terms)
    }

    /// What `is_point_in_shadow` can be at a sample.
    fn exact_visible(
        &self,
        sample: DVec2,
        position_lcs: &[Range; 4],
        nearer: &Range,
        stored: &Range,
    ) -> Range {
        let offset = self.sample_step() * sample;
        let [s, t, depth, w] = position_lcs;
        let xyz = [shifted(s, offset.x), shifted(t, offset.y), *depth];
        let is_inside = w.value > 0.0 && xyz.iter().all(|c| (0.0..=1.0).contains(&c.value));
        let may_be_outside = w.least <= 0.0 || xyz.iter().any(|c| c.least < 0.0 || c.most > 1.0);
        let may_be_inside = w.most > 0.0 && xyz.iter().all(|c| c.most >= 0.0 && c.least <= 1.0);
        let tested = |is_dark: bool| if is_dark { 0.0 } else { 1.0 };
        let value = match is_inside {
            true => tested(stored.value < nearer.value),
            false => self.outside(),
        };
        let mut others = Vec::new();
        if may_be_outside {
            others.push(self.outside());
        }
        if may_be_inside {
            others.push(tested(stored.least < nearer.most));
            others.push(tested(stored.most < nearer.least));
        }
        Range::over(value, others)
    }
}

/// The triangles that are drawn into the map.
fn front_faces(object: &Object, mvp: DMat4) -> Vec<ClipTriangle> {
    let mesh = &object.mesh;
    let clip = mesh.positions.iter().map(|p| mvp * p.extend(1.0));
    let clip: Vec<DVec4> = clip.collect();
    let of_face = |face: &[u32; 3]| ClipTriangle::new(face.map(|i| clip[i as usize]));
    let triangles = mesh.faces.iter().filter_map(of_face);
    triangles.filter(|triangle| triangle.front).collect()
}

fn shifted(range: &Range, by: f64) -> Range {
    Range {
        value: range.value + by,
        least: range.least + by,
        most: range.most + by,
    }
}

fn widened(range: Range, by: f64) -> Range {
    Range {
        value: range.value,
        least: range.least - by,
        most: range.most + by,
    }
}
