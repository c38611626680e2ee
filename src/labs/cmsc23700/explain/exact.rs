//! The same in f64, from the unrounded scene.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, dvec2};

use super::super::lights::{cos_cutoff, in_eye_space, spot_position};
use super::super::{Cmsc23700, SPOT};
use super::fragment::Fragment;
use crate::labs::Probe;
use crate::labs::exact::{ClipTriangle, ExactMap, ROUNDING, Range, SNAP, corners};
use crate::scene::Mesh;

/// One point of a surface on its way through the shadow test.
#[derive(Clone, Copy)]
struct Place {
    eye_position: DVec3,
    coord: DVec4,
    place: DVec3,
    spot_dot: f64,
}

/// The values of the test, each with the range that rounding and rasterisation leave it.
pub struct Exact {
    pub eye_position: [Range; 3],
    pub coord: [Range; 4],
    pub place: [Range; 3],
    pub spot_dot: Range,
    pub nearer: Range,
    pub stored: Range,
    pub shadow: Range,
}

/// How far rounding may drive the values of a [`Place`] apart.
struct Rounding {
    eye_position: DVec3,
    coord: DVec4,
    place: DVec3,
    spot_dot: f64,
}

impl Cmsc23700 {
    /// `light` counts from 0.
    pub(super) fn exact(&self, probe: Probe, fragment: &Fragment, light: usize) -> Exact {
        let (centre, around) = match probe {
            Probe::Point(point) => {
                let eye_position = self.model_view(DMat4::from_translation(point));
                let eye_position = eye_position.transform_point3(DVec3::ZERO);
                (self.place_of(eye_position, light), vec![])
            }
            Probe::Pixel([x, y]) => {
                let place = dvec2(f64::from(x) + 0.5, f64::from(self.size[1] - 1 - y) + 0.5);
                let at = |offset: DVec2| self.place_of(self.seen(fragment, place + offset), light);
                (at(DVec2::ZERO), corners(SNAP).map(at).to_vec())
            }
        };
        let rounding = self.rounding(probe, fragment, &centre, light);
        let range = |value: &dyn Fn(&Place) -> f64, rounding: f64| {
            let spread = Range::over(value(&centre), around.iter().map(value));
            widened(spread, rounding)
        };
        let place = [0, 1, 2].map(|i| range(&|p| p.place[i], rounding.place[i]));
        let spot_dot = range(&|p| p.spot_dot, rounding.spot_dot);
        let nearer = {
            let (depth, bias) = (&place[2], self.bias(light));
            let nearer = |depth: f64| depth.min(1.0) - bias;
            let range = Range::over(
                nearer(depth.value),
                [nearer(depth.least), nearer(depth.most)],
            );
            widened(range, ROUNDING * bias)
        };
        let stored = self.exact_stored(&place, light);
        Exact {
            eye_position: [0, 1, 2]
                .map(|i| range(&|p| p.eye_position[i], rounding.eye_position[i])),
            coord: [0, 1, 2, 3].map(|i| range(&|p| p.coord[i], rounding.coord[i])),
            shadow: self.exact_shadow(&spot_dot, &nearer, &stored, light),
            place,
            spot_dot,
            nearer,
            stored,
        }
    }

    fn place_of(&self, eye_position: DVec3, light: usize) -> Place {
        let coord = self.light_cameras[light].texture_matrix * eye_position.extend(1.0);
        let to_light = (spot_position(&self.scene) - eye_position).normalize_or_zero();
        let spot_direction = in_eye_space(&self.scene, self.scene.lights[SPOT].direction);
        Place {
            eye_position,
            coord,
            place: coord.truncate() / coord.w,
            spot_dot: -to_light.dot(spot_direction),
        }
    }

    /// The mesh of what has this number among all that is drawn.
    fn mesh(&self, number: usize) -> &Mesh {
        match self.scene.objects.get(number) {
            Some(object) => &object.mesh,
            None => &self.balls.mesh,
        }
    }

    /// The corners of the fragment's triangle, in its object's space.
    fn triangle(&self, fragment: &Fragment) -> [DVec3; 3] {
        let mesh = self.mesh(fragment.object);
        mesh.faces[fragment.triangle].map(|i| mesh.positions[i as usize])
    }

    /// Where in eye space the ray through a place of the picture, in pixels from the bottom left, meets the fragment's
    /// triangle.
    fn seen(&self, fragment: &Fragment, place: DVec2) -> DVec3 {
        let model_view = self.model_view(self.placed(fragment.object));
        let corners = self.triangle(fragment);
        let corners = corners.map(|corner| model_view.transform_point3(corner));
        let clip = corners.map(|corner| self.projection() * corner.extend(1.0));
        let shares = ClipTriangle::new(clip).map_or(DVec3::X, |t| t.shares(self.size, place));
        DMat3::from_cols(corners[0], corners[1], corners[2]) * shares
    }

    /// Rounding is relative to the largest terms of the products.
    fn rounding(&self, probe: Probe, fragment: &Fragment, at: &Place, light: usize) -> Rounding {
        let (terms, stretch) = match probe {
            Probe::Point(_) => (at.eye_position.abs(), 1.0),
            Probe::Pixel(_) => {
                let model_view = self.model_view(self.placed(fragment.object)).abs();
                let corners = self.triangle(fragment);
                let terms = corners.map(|p| (model_view * p.abs().extend(1.0)).truncate());
                let terms = terms.into_iter().fold(DVec3::ZERO, DVec3::max);
                (terms, self.stretch(fragment, at.eye_position))
            }
        };
        let to_map = self.light_cameras[light].texture_matrix.abs();
        let eye_position = stretch * ROUNDING * terms;
        // The eye position's rounding, carried on, and the product's own.
        let coord = 2.0 * stretch * ROUNDING * (to_map * terms.extend(1.0));
        let (place, w) = (at.place.abs(), at.coord.w.abs());
        let spot = spot_position(&self.scene);
        let distance = spot.distance(at.eye_position);
        Rounding {
            eye_position,
            coord,
            place: (coord.truncate() + place * coord.w) / w + ROUNDING * place,
            spot_dot: 2.0 * ROUNDING
                + (eye_position.length() + ROUNDING * spot.length()) / distance,
        }
    }

    /// How much nearer than the point its triangle comes to the eye: a rasteriser interpolates values divided by w over
    /// the whole triangle, and their rounding is that of the largest one.
    fn stretch(&self, fragment: &Fragment, eye_position: DVec3) -> f64 {
        let model_view = self.model_view(self.placed(fragment.object));
        let depths = self
            .triangle(fragment)
            .map(|p| -model_view.transform_point3(p).z);
        let nearest = depths.into_iter().fold(f64::INFINITY, f64::min);
        (-eye_position.z / nearest.max(self.scene.camera.near)).max(1.0)
    }

    /// What an exact rasteriser would store where the map is asked, and in the texels beside it as far as that may be
    /// off.
    fn exact_stored(&self, place: &[Range; 3], light: usize) -> Range {
        let mut map = self.exact_map(light);
        let mut at = |uv: DVec2| {
            let on_map = uv.min_element() >= 0.0 && uv.max_element() <= 1.0;
            // GL_CLAMP_TO_BORDER.
            if on_map {
                map.lookup(uv)
            } else {
                Range::over(1.0, [])
            }
        };
        let [s, t, _] = place;
        let uv = dvec2(s.value, t.value);
        let found = at(uv);
        let nearby = corners(s.radius().max(t.radius())).map(|offset| at(uv + offset));
        let nearby = nearby.iter().flat_map(|range| [range.least, range.most]);
        let all = Range::over(found.value, nearby.chain([found.least, found.most]));
        // The format's steps are 2⁻²⁴, and the rasteriser's own arithmetic is f32.
        widened(all, 1.0 / 16_777_216.0 + ROUNDING)
    }

    fn exact_map(&self, light: usize) -> ExactMap {
        let camera = &self.light_cameras[light];
        let objects = self.scene.objects.iter().map(|object| object.casts);
        let balls = self.simulation.balls().iter().map(|_| true);
        let casts = objects.chain(balls).enumerate();
        let mut triangles = Vec::new();
        for (number, _) in casts.filter(|(_, casts)| *casts) {
            let mesh = self.mesh(number);
            let matrix = camera.model_view_projection(self.placed(number));
            let clip = mesh.positions.iter().map(|p| matrix * p.extend(1.0));
            let clip: Vec<DVec4> = clip.collect();
            let of_face = |face: &[u32; 3]| ClipTriangle::new(face.map(|i| clip[i as usize]));
            triangles.extend(mesh.faces.iter().filter_map(of_face));
        }
        ExactMap::new(triangles, self.shadow_maps[light].size, false)
    }

    /// Surely in shadow, or perhaps, and what the f64 values say.
    fn exact_shadow(
        &self,
        spot_dot: &Range,
        nearer: &Range,
        stored: &Range,
        light: usize,
    ) -> Range {
        let cutoff = cos_cutoff(&self.scene.lights[SPOT]);
        let shadow = |spot_dot: f64, nearer: f64, stored: f64| {
            let asked = light != SPOT || spot_dot >= cutoff;
            if asked && stored < nearer { 0.5 } else { 1.0 }
        };
        Range {
            value: shadow(spot_dot.value, nearer.value, stored.value),
            least: shadow(spot_dot.most, nearer.most, stored.least),
            most: shadow(spot_dot.least, nearer.least, stored.most),
        }
    }
}

fn widened(range: Range, by: f64) -> Range {
    Range {
        value: range.value,
        least: range.least - by,
        most: range.most + by,
    }
}
