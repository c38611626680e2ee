//! `shadowlab explain aueb7`: the shadow test's values at one place, from the GPU, and in f64 beside them.

mod exact;
mod fragment;

use glam::{DMat4, DVec3};

use super::{Aueb7, HANDOUT};
use crate::gl;
use crate::labs::{Explanation, Lab, LookUp, Probe, Show, Step};
use crate::{Error, Result};
use exact::Exact;
use fragment::Fragment;

const XYZW: &[&str] = &["x", "y", "z", "w"];
/// The samples of PCF: center, top, bottom, left, right, and the diagonals.
const SAMPLES: &[&str] = &["C", "T", "B", "L", "R", "TL", "TR", "BL", "BR"];

/// What each sample is asked.
const QUESTIONS: [&str; 9] = [
    "lit: on the map, and not behind its surface",
    "the same one step above",
    "the same one step below",
    "the same one step to the left",
    "the same one step to the right",
    "the same above to the left",
    "the same above to the right",
    "the same below to the left",
    "the same below to the right",
];

impl Aueb7 {
    pub(super) fn explain_at(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        self.check_probe(probe)?;
        self.render(gl, Show::Picture)?;
        let (mut place, color) = match probe {
            Probe::Pixel([x, y]) => (
                format!("{}: pixel {x},{y}", HANDOUT.name),
                Some(gl::read_rgb(gl, self.size).get_pixel(x, y).0),
            ),
            Probe::Point(p) => (
                format!("{}: the point ({}, {}, {})", HANDOUT.name, p.x, p.y, p.z),
                None,
            ),
        };
        let Some(fragment) = self.fragment(gl, probe)? else {
            return Ok(Explanation::of_nothing(place + " shows no surface", color));
        };
        if let Probe::Pixel(_) = probe {
            let name = &self.geometry()[fragment.object].0.name;
            place += &format!(" shows \"{name}\", triangle {}", fragment.triangle);
        }
        let exact = self.exact(probe, &fragment);
        Ok(Explanation {
            place,
            color,
            matrices: self.labelled_matrices(probe, fragment.object),
            steps: self.steps(&fragment, &exact),
            tests: self.tests(&fragment, &exact),
            in_shadow: Some(fragment.shadow_factor < 0.5),
            look_up: Some(LookUp {
                uv: fragment.position_lcs.truncate().truncate(),
                depth: fragment.nearer,
            }),
        })
    }

    fn check_probe(&self, probe: Probe) -> Result<()> {
        if !self.settings.switch("shadows") {
            return Err(Error::usage(
                "shadows=off makes no shadow test to explain, expected shadows=on",
            ));
        }
        let test = self.settings.choice("shadow_test");
        if test != "handout" {
            return Err(Error::usage(format!(
                "shadow_test={test} is no test of the exercises to explain, expected shadow_test=handout"
            )));
        }
        if self.polygon_mode != glow::FILL {
            return Err(Error::usage(
                "F1 has chosen wireframe or points, expected the filled surfaces that are explained",
            ));
        }
        probe.check(self.size)
    }

    fn steps(&self, gpu: &Fragment, exact: &Exact) -> Vec<Step> {
        let count = self.samples();
        // A single sample needs no name.
        let names = if count == 1 {
            &[""][..]
        } else {
            &SAMPLES[..count]
        };
        vec![
            Step::new(
                "position_ecs",
                &XYZW[..3],
                &gpu.position_ecs.to_array(),
                &exact.position_ecs,
            ),
            Step::new(
                "position_lcs",
                XYZW,
                &gpu.position_lcs.to_array(),
                &exact.position_lcs,
            ),
            Step::new(
                "z - constant_depth_bias",
                &[""],
                &[gpu.nearer],
                &[exact.nearer],
            ),
            Step::new("shadow_map_z", names, &gpu.stored[..count], &exact.stored),
            Step::new(
                "is_point_in_shadow",
                names,
                &gpu.visible[..count],
                &exact.visible,
            ),
            Step::new(
                "shadow_factor",
                &[""],
                &[gpu.shadow_factor],
                &[exact.shadow_factor],
            ),
        ]
    }

    fn tests(&self, gpu: &Fragment, exact: &Exact) -> Vec<(&'static str, bool, bool)> {
        let lit = |visible: f64| visible == 1.0;
        let test = |i: usize| {
            (
                QUESTIONS[i],
                lit(gpu.visible[i]),
                lit(exact.visible[i].value),
            )
        };
        (0..self.samples()).map(test).collect()
    }

    /// Every matrix of both passes, in the world's own coordinates.
    fn labelled_matrices(&self, probe: Probe, object: usize) -> Vec<(&'static str, DMat4)> {
        let camera = self.camera();
        let light_view = self.light_view(DVec3::ZERO);
        let light_view_projection = self.light_projection() * light_view;
        let mut matrices = Vec::new();
        let mut model = DMat4::IDENTITY;
        if let Probe::Pixel(_) = probe {
            model = self.geometry()[object].1;
            matrices.push(("uniform_m: object to world", model));
        }
        matrices.extend([
            ("uniform_v: world to eye space", camera.view()),
            ("uniform_p: eye space to clip space", self.projection()),
            (
                "uniform_view_inverse: eye space to world",
                camera.view().inverse(),
            ),
            ("the light's view: world to the light", light_view),
            ("the light's projection", self.light_projection()),
            ("uniform_light_view_projection", light_view_projection),
            (
                "uniform_mvp of the shadow map: object to the light's clip space",
                light_view_projection * model,
            ),
        ]);
        matrices
    }
}
