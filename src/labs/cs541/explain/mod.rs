//! `shadowlab explain cs541`: the shadow test's values at one place, from the GPU, and in f64 beside them.
//!
//! The GPU's values come from the lab's own vertex shader with `explain.frag`. The f64 ones are computed here from the
//! unrounded scene: the point where the pixel's ray meets the triangle that the GPU drew there, its place in the
//! light's clip space, and the depth that an exact rasteriser would store in each texel that is looked up.

mod exact;
mod fragment;

use glam::{DMat4, DVec2, DVec3, DVec4, dvec2};

use super::{Cs541, HANDOUT, second_pass};
use crate::gl;
use crate::labs::exact::{ROUNDING, Range, SNAP, corners};
use crate::labs::{Explanation, LookUp, Probe, Show, Step};
use crate::scene::camera;
use crate::{Error, Result};
use exact::ShadowPosition;
use fragment::Fragment;

/// B of the handout's equation (1): the standard cube to the unit cube.
fn unit_cube() -> DMat4 {
    let half = DVec3::splat(0.5);
    DMat4::from_translation(half) * DMat4::from_scale(half)
}

impl Cs541 {
    /// What a stored depth may be off by its format and by the rasteriser's own f32 arithmetic.
    fn depth_quantum(&self) -> f64 {
        let quantum = match self.shadow_buffer.kind.depth_format {
            "16" => 1.0 / 65_536.0,
            _ => 1.0 / 16_777_216.0,
        };
        quantum + 8.0 / 16_777_216.0
    }

    pub(super) fn explain_at(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        if !self.settings.switch("shadows") {
            return Err(Error::usage(
                "shadows=off makes no shadow test to explain, expected shadows=on",
            ));
        }
        let test = self.settings.choice("shadow_test");
        if test != "handout" {
            return Err(Error::usage(format!(
                "shadow_test={test} is no test of the handout to explain, expected shadow_test=handout"
            )));
        }
        probe.check(self.size)?;
        super::Lab::render(self, gl, Show::Picture)?;
        let color = match probe {
            Probe::Pixel([x, y]) => Some(gl::read_rgb(gl, self.size).get_pixel(x, y).0),
            Probe::Point(_) => None,
        };
        let place = match probe {
            Probe::Pixel([x, y]) => format!("{}: pixel {x},{y}", HANDOUT.name),
            Probe::Point(p) => format!("{}: the point ({}, {}, {})", HANDOUT.name, p.x, p.y, p.z),
        };
        let Some(fragment) = self.fragment(gl, probe)? else {
            return Ok(Explanation::of_nothing(
                format!("{place} shows no surface"),
                color,
            ));
        };
        let seen = match probe {
            Probe::Pixel(_) => {
                let name = &self.scene.objects[fragment.object].name;
                format!(" shows \"{name}\", triangle {}", fragment.triangle)
            }
            Probe::Point(_) => String::new(),
        };
        Ok(self.compare(probe, &fragment, place + &seen, color))
    }

    fn compare(
        &self,
        probe: Probe,
        fragment: &Fragment,
        place: String,
        color: Option<[u8; 3]>,
    ) -> Explanation {
        let eye = self.camera().eye;
        let light = self.light_camera();
        let light_view = camera::view(light.eye - eye, light.look, light.rup);
        let light_persp = light.perspective(1.0);
        let to_map = unit_cube() * light_persp * light_view;

        // The point, and the points around it that a snapped vertex may have put there.
        let (point, around) = match probe {
            Probe::Point(point) => (point - eye, vec![]),
            Probe::Pixel([x, y]) => {
                let place = dvec2(f64::from(x) + 0.5, f64::from(self.size[1] - 1 - y) + 0.5);
                let at = |offset| self.seen_point(fragment, place + offset);
                (at(DVec2::ZERO), corners(SNAP).map(at).to_vec())
            }
        };
        let exact = ShadowPosition::new(to_map, point);

        // Bounds: rounding, relative to the largest terms of the products, and the spread of the points around.
        let magnitude = point.abs().max_element() + (light.eye - eye).abs().max_element();
        let rounding = ROUNDING
            * (to_map_magnitude(light_persp, light_view)
                * DVec4::new(point.x.abs(), point.y.abs(), point.z.abs(), 1.0));
        let w = exact.position.w.abs();
        let divided = |i: usize, quotient: f64| (rounding[i] + quotient.abs() * rounding.w) / w;
        let rounding = [
            rounding.x,
            rounding.y,
            rounding.z,
            rounding.w,
            divided(0, exact.uv.x),
            divided(1, exact.uv.y),
            divided(2, exact.depth),
        ];
        let spread = |i: usize| {
            let others = around
                .iter()
                .map(|p| ShadowPosition::new(to_map, *p).values()[i]);
            Range::over(exact.values()[i], others).radius()
        };
        let bound: Vec<f64> = (0..7).map(|i| rounding[i] + spread(i)).collect();
        let point_bound: Vec<f64> = (0..3)
            .map(|i| {
                let others = around.iter().map(|p| p[i]);
                Range::over(point[i], others).radius() + ROUNDING * magnitude
            })
            .collect();

        let mut map = self.exact_map();
        let stored = map.lookup(exact.uv);
        let uv_bound = bound[4].max(bound[5]);
        let nearby = corners(uv_bound).map(|offset| map.lookup(exact.uv + offset));
        let nearby = nearby.iter().flat_map(|range| [range.least, range.most]);
        let stored = Range::over(stored.value, nearby.chain([stored.least, stored.most]));

        let xyz: &[&str] = &["x", "y", "z"];
        let epsilon = self.epsilon();
        let gpu = fragment.shadow_position;
        let gpu_world = fragment.position + eye;
        let world = point + eye;
        let steps = vec![
            Step {
                name: "world position",
                components: xyz,
                gpu: gpu_world.to_array().to_vec(),
                exact: world.to_array().to_vec(),
                bound: point_bound,
            },
            Step {
                name: "vshadow_position",
                components: &["x", "y", "z", "w"],
                gpu: gpu.to_array().to_vec(),
                exact: exact.position.to_array().to_vec(),
                bound: bound[..4].to_vec(),
            },
            Step {
                name: "uv = xy/w",
                components: &["u", "v"],
                gpu: fragment.uv.to_array().to_vec(),
                exact: exact.uv.to_array().to_vec(),
                bound: bound[4..6].to_vec(),
            },
            Step {
                name: "point_depth = z/w",
                components: &[""],
                gpu: vec![fragment.point_depth],
                exact: vec![exact.depth],
                bound: vec![bound[6]],
            },
            Step {
                name: "point_depth - epsilon",
                components: &[""],
                gpu: vec![fragment.nearer_depth],
                exact: vec![exact.depth - epsilon],
                bound: vec![bound[6] + ROUNDING * epsilon],
            },
            Step {
                name: "shadow_depth (stored)",
                components: &[""],
                gpu: vec![fragment.shadow_depth],
                exact: vec![stored.value],
                bound: vec![stored.radius() + self.depth_quantum()],
            },
        ];

        let uv_inside = exact.uv.min_element() >= 0.0 && exact.uv.max_element() <= 1.0;
        let in_front = exact.position.w > 0.0;
        let circle =
            self.beam() != second_pass::CIRCULAR || exact.uv.distance(DVec2::splat(0.5)) <= 0.5;
        let inside_beam = in_front && uv_inside && circle;
        let nearer = stored.value < exact.depth - epsilon;
        let gpu_nearer = fragment.shadow_depth < fragment.nearer_depth;
        let mut tests = vec![
            (
                "in front of the light: vshadow_position.w > 0",
                fragment.in_front,
                in_front,
            ),
            ("on the map: uv in [0, 1]", fragment.uv_inside, uv_inside),
        ];
        if self.beam() == second_pass::CIRCULAR {
            tests.push((
                "inside the circular beam",
                fragment.inside_beam,
                inside_beam,
            ));
        }
        tests.push((
            "behind the map's surface: shadow_depth < point_depth - epsilon",
            gpu_nearer,
            nearer,
        ));
        tests.push((
            "in shadow: inside the beam and behind the map's surface",
            fragment.in_shadow,
            inside_beam && nearer,
        ));
        Explanation {
            place,
            color,
            matrices: self.labelled_matrices(probe, fragment.object),
            steps,
            tests,
            in_shadow: Some(fragment.in_shadow),
            look_up: fragment.in_front.then_some(LookUp {
                uv: fragment.uv,
                depth: fragment.nearer_depth,
            }),
        }
    }

    /// Every matrix of both passes, in the world's own coordinates.
    fn labelled_matrices(&self, probe: Probe, object: usize) -> Vec<(&'static str, DMat4)> {
        let camera = self.camera();
        let light = self.light_camera();
        let mut matrices = Vec::new();
        let mut model = DMat4::IDENTITY;
        if let Probe::Pixel(_) = probe {
            model = self.scene.objects[object].model(self.time);
            matrices.push(("model_matrix, M_o: object to world", model));
        }
        matrices.extend([
            ("view_matrix of the eye: world to camera", camera.view()),
            (
                "persp_matrix of the eye: camera to clip space",
                camera.perspective(self.aspect()),
            ),
            (
                "view_matrix of the light, M_c⁻¹: world to the light's camera",
                light.view(),
            ),
            (
                "persp_matrix of the light, Π: the light's camera to clip space",
                light.perspective(1.0),
            ),
            ("B: standard cube to unit cube", unit_cube()),
            (
                "B ∘ Π ∘ M_c⁻¹ ∘ M_o, equation (1)",
                unit_cube() * light.perspective(1.0) * light.view() * model,
            ),
        ]);
        matrices
    }
}

/// The entries' absolute values multiplied: what the largest terms of equation (1) can be.
fn to_map_magnitude(persp: DMat4, view: DMat4) -> DMat4 {
    unit_cube().abs() * persp.abs() * view.abs()
}
