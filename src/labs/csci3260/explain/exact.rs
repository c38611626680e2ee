//! The same in f64, from the unrounded scene.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, dvec2};

use super::super::Csci3260;
use super::super::basic_shader::bias_matrix;
use super::fragment::Fragment;
use crate::labs::Probe;
use crate::labs::exact::{ClipTriangle, ExactMap, ROUNDING, Range, SNAP, corners};
use crate::scene::Object;

/// By how much the angle may be off: GLSL promises no precision of `acos`, drivers take polynomials. Radians.
const ANGLE: f64 = 1e-3;

/// The taps of PCF in `FragmentShaderCode.glsl`, in texels.
const TAPS: [DVec2; 5] = [
    dvec2(0.0, 0.0),
    dvec2(-1.0, 0.0),
    dvec2(1.0, 0.0),
    dvec2(0.0, -1.0),
    dvec2(0.0, 1.0),
];

/// One point of a surface: relative to the eye, in the map, and how it is turned to the light.
#[derive(Clone, Copy)]
struct Place {
    point: DVec3,
    shadow_coord: DVec3,
    cos_theta: f64,
}

/// The values of the test, each with the range that rounding and rasterisation leave it.
pub struct Exact {
    pub point: [Range; 3],
    pub shadow_coord: [Range; 3],
    pub cos_theta: Range,
    pub bias: Range,
    pub nearer: Range,
    pub stored: [Range; 5],
    pub visibility: Range,
}

impl Csci3260 {
    pub(super) fn exact(&self, probe: Probe, fragment: &Fragment) -> Exact {
        let (centre, around) = match probe {
            Probe::Point(point) => (self.place_of(point - self.scene().camera.eye, 0.0), vec![]),
            Probe::Pixel([x, y]) => {
                let place = dvec2(f64::from(x) + 0.5, f64::from(self.size[1] - 1 - y) + 0.5);
                let at = |offset: DVec2| self.seen(fragment, place + offset);
                (at(DVec2::ZERO), corners(SNAP).map(at).to_vec())
            }
        };
        let (point_rounding, coord_rounding) = self.rounding(probe, fragment, centre.point);
        let range = |value: fn(&Place) -> f64, rounding: f64| {
            let spread = Range::over(value(&centre), around.iter().map(value));
            widened(spread, rounding)
        };
        let point = [
            range(|p| p.point.x, point_rounding.x),
            range(|p| p.point.y, point_rounding.y),
            range(|p| p.point.z, point_rounding.z),
        ];
        let shadow_coord = [
            range(|p| p.shadow_coord.x, coord_rounding.x),
            range(|p| p.shadow_coord.y, coord_rounding.y),
            range(|p| p.shadow_coord.z, coord_rounding.z),
        ];
        let cos_theta = range(|p| p.cos_theta, 2.0 * ROUNDING);
        let bias = self.exact_bias(&cos_theta);
        let depth = &shadow_coord[2];
        let nearer = Range {
            value: depth.value - bias.value,
            least: depth.least - bias.most - ROUNDING,
            most: depth.most - bias.least + ROUNDING,
        };
        let stored = self.exact_stored(&shadow_coord);
        let visibility = self.exact_visibility(&nearer, &stored);
        Exact {
            point,
            shadow_coord,
            cos_theta,
            bias,
            nearer,
            stored,
            visibility,
        }
    }

    fn place_of(&self, point: DVec3, cos_theta: f64) -> Place {
        let eye = self.scene().camera.eye;
        let to_map = bias_matrix() * self.depth_projection_matrix() * self.depth_view_matrix(eye);
        Place {
            point,
            shadow_coord: to_map.transform_point3(point),
            cos_theta,
        }
    }

    /// What the ray through a place of the picture, in pixels from the bottom left, meets of the fragment's triangle.
    fn seen(&self, fragment: &Fragment, place: DVec2) -> Place {
        let (object, indices) = self.triangle(fragment);
        let positions = indices.map(|i| object.mesh.positions[i as usize]);
        let normals = indices.map(|i| object.mesh.normals[i as usize]);
        let mvp = self.mvp(object);
        let clip = positions.map(|p| mvp * p.extend(1.0));
        let shares = ClipTriangle::new(clip).map_or(DVec3::X, |t| t.shares(self.size, place));
        let model = self.model_from_eye(object);
        let [a, b, c] = positions;
        let position = DMat3::from_cols(a, b, c) * shares;
        let [a, b, c] = normals;
        let normal = DMat3::from_cols(a, b, c) * shares;
        let turned = DMat3::from_mat4(model).inverse().transpose() * normal;
        let to_light = -self.light().direction.normalize();
        let cos_theta = turned.normalize_or_zero().dot(to_light);
        self.place_of(
            model.transform_point3(position),
            cos_theta.clamp(0.001, 1.0),
        )
    }

    fn triangle(&self, fragment: &Fragment) -> (&Object, [u32; 3]) {
        let object = &self.scene().objects[fragment.object];
        (object, object.mesh.faces[fragment.triangle])
    }

    /// Of the point and of `ShadowCoord`: rounding relative to the largest terms of the products.
    fn rounding(&self, probe: Probe, fragment: &Fragment, point: DVec3) -> (DVec3, DVec3) {
        let eye = self.scene().camera.eye;
        let largest = |matrix: DMat4, vertices: &[DVec3]| {
            let terms = |p: &DVec3| (matrix.abs() * p.abs().extend(1.0)).truncate();
            let most = vertices.iter().map(terms).fold(DVec3::ZERO, DVec3::max);
            ROUNDING * most
        };
        match probe {
            Probe::Point(_) => {
                let to_point = DMat4::from_translation(point);
                let to_light = self.depth_projection_matrix() * self.depth_view_matrix(eye);
                let to_map = bias_matrix() * to_light * to_point;
                (
                    largest(to_point, &[DVec3::ZERO]),
                    largest(to_map, &[DVec3::ZERO]),
                )
            }
            Probe::Pixel(_) => {
                let (object, indices) = self.triangle(fragment);
                let vertices = indices.map(|i| object.mesh.positions[i as usize]);
                let stretch = self.stretch(object, &vertices, point);
                let to_map = bias_matrix() * self.depth_mvp(object);
                (
                    stretch * largest(self.model_from_eye(object), &vertices),
                    stretch * largest(to_map, &vertices),
                )
            }
        }
    }

    /// How much nearer than the point its triangle comes to the eye: a rasteriser interpolates values divided by w over
    /// the whole triangle, and their rounding is that of the largest one.
    fn stretch(&self, object: &Object, vertices: &[DVec3; 3], point: DVec3) -> f64 {
        let camera = self.scene().camera;
        let mvp = self.mvp(object);
        let nearest = vertices.map(|p| (mvp * p.extend(1.0)).w);
        let nearest = nearest.into_iter().fold(f64::INFINITY, f64::min);
        let own = point.dot(camera.look.normalize());
        (own / nearest.max(camera.near)).max(1.0)
    }

    fn exact_bias(&self, cos_theta: &Range) -> Range {
        let bias = self.bias();
        if self.settings.choice("stage") != "slope" {
            return widened(Range::over(bias, []), ROUNDING * bias);
        }
        let of_angle = |angle: f64| {
            let angle = angle.clamp(0.0, std::f64::consts::FRAC_PI_2 - 1e-6);
            (bias * angle.tan()).clamp(0.0, 2.0 * bias)
        };
        let angle = |cosine: f64| cosine.clamp(0.001, 1.0).acos();
        let steepest = angle(cos_theta.least) + ANGLE;
        let flattest = angle(cos_theta.most) - ANGLE;
        let range = Range::over(
            of_angle(angle(cos_theta.value)),
            [of_angle(steepest), of_angle(flattest)],
        );
        widened(range, ROUNDING * 2.0 * bias)
    }

    /// What each tap finds in the map of an exact rasteriser, and in the texels beside it as far as the lookup may be off.
    fn exact_stored(&self, shadow_coord: &[Range; 3]) -> [Range; 5] {
        let mut map = self.exact_map();
        let [s, t, _] = shadow_coord;
        let off = s.radius().max(t.radius()) + ROUNDING;
        // The format's steps are 2⁻²⁴, and the rasteriser's own arithmetic is f32.
        let quantum = 1.0 / 16_777_216.0 + ROUNDING;
        TAPS.map(|tap| {
            let uv = dvec2(s.value, t.value) + tap / f64::from(self.target.size);
            let found = map.lookup(uv);
            let nearby = corners(off).map(|offset| map.lookup(uv + offset));
            let nearby = nearby.iter().flat_map(|range| [range.least, range.most]);
            let all = Range::over(found.value, nearby.chain([found.least, found.most]));
            widened(all, quantum)
        })
    }

    fn exact_map(&self) -> ExactMap {
        let inputs = self.map_inputs();
        let mut triangles = Vec::new();
        for (object, depth_mvp) in self.scene().objects.iter().zip(&inputs.depth_mvps) {
            let Some(depth_mvp) = depth_mvp else { continue };
            let mesh = &object.mesh;
            let clip = mesh.positions.iter().map(|p| *depth_mvp * p.extend(1.0));
            let clip: Vec<DVec4> = clip.collect();
            let of_face = |face: &[u32; 3]| ClipTriangle::new(face.map(|i| clip[i as usize]));
            let kept = |t: &ClipTriangle| !(inputs.front_face_culling && t.front);
            triangles.extend(mesh.faces.iter().filter_map(of_face).filter(kept));
        }
        ExactMap::new(triangles, self.target.size, false)
    }

    /// The taps that are surely in shadow, those that may be, and those that the f64 values call so.
    fn exact_visibility(&self, nearer: &Range, stored: &[Range; 5]) -> Range {
        let (taps, dark) = match self.settings.choice("stage") {
            "pcf" => (5, 0.1),
            _ => (1, 0.5),
        };
        let count = |is_dark: &dyn Fn(&Range) -> bool| {
            let dark_taps = stored[..taps].iter().filter(|depth| is_dark(depth)).count();
            1.0 - dark * dark_taps as f64
        };
        let range = Range {
            value: count(&|depth| depth.value < nearer.value),
            least: count(&|depth| depth.least < nearer.most),
            most: count(&|depth| depth.most < nearer.least),
        };
        widened(range, ROUNDING)
    }
}

fn widened(range: Range, by: f64) -> Range {
    Range {
        value: range.value,
        least: range.least - by,
        most: range.most + by,
    }
}
