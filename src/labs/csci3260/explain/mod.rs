//! `shadowlab explain csci3260`: the shadow test's values at one place, from the GPU, and in f64 beside them.

mod exact;
mod fragment;

use glam::{DMat4, DVec3};

use super::basic_shader::bias_matrix;
use super::{Csci3260, HANDOUT};
use crate::gl;
use crate::labs::exact::Range;
use crate::labs::{Explanation, LookUp, Probe, Show, Step};
use crate::{Error, Result};
use exact::Exact;
use fragment::Fragment;

const XYZ: &[&str] = &["x", "y", "z"];

/// What PCF asks at each of its taps, after the first.
const QUESTIONS: [&str; 5] = [
    "behind the map's surface: shadowMap.z < ShadowCoord.z - bias",
    "the same one texel to the left",
    "the same one texel to the right",
    "the same one texel below",
    "the same one texel above",
];

impl Csci3260 {
    pub(super) fn explain_at(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        self.check_probe(probe)?;
        self.paint_gl(gl, Show::Picture)?;
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
            let name = &self.scene().objects[fragment.object].name;
            place += &format!(" shows \"{name}\", triangle {}", fragment.triangle);
        }
        let exact = self.exact(probe, &fragment);
        Ok(Explanation {
            place,
            color,
            matrices: self.labelled_matrices(probe, fragment.object),
            steps: self.steps(&fragment, &exact),
            tests: self.tests(&fragment, &exact),
            // As the visibility is read: dark below the half of it.
            in_shadow: Some(fragment.visibility < 0.75),
            look_up: Some(LookUp {
                uv: fragment.shadow_coord.truncate(),
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
                "shadow_test={test} is no test of the slides to explain, expected shadow_test=handout"
            )));
        }
        probe.check(self.size)?;
        match probe {
            Probe::Point(_) if self.settings.choice("stage") == "slope" => Err(Error::usage(
                "stage=slope takes the bias from the surface's normal, which a point does not have, expected a pixel",
            )),
            _ => Ok(()),
        }
    }

    fn steps(&self, gpu: &Fragment, exact: &Exact) -> Vec<Step> {
        let eye = self.scene().camera.eye;
        let world = [0, 1, 2].map(|i| Range {
            value: exact.point[i].value + eye[i],
            least: exact.point[i].least + eye[i],
            most: exact.point[i].most + eye[i],
        });
        let mut steps = vec![
            Step::new(
                "world position",
                XYZ,
                &(gpu.position + eye).to_array(),
                &world,
            ),
            Step::new(
                "ShadowCoord",
                XYZ,
                &gpu.shadow_coord.to_array(),
                &exact.shadow_coord,
            ),
        ];
        if self.settings.choice("stage") == "slope" {
            let gpu = [gpu.cos_theta];
            steps.push(Step::new("cosTheta", &[""], &gpu, &[exact.cos_theta]));
        }
        let taps = self.taps();
        let names: &[&str] = &["", "−x", "+x", "−y", "+y"];
        steps.extend([
            Step::new("bias", &[""], &[gpu.bias], &[exact.bias]),
            Step::new(
                "ShadowCoord.z - bias",
                &[""],
                &[gpu.nearer],
                &[exact.nearer],
            ),
            Step::new(
                "shadowMap.z (stored)",
                &names[..taps],
                &gpu.stored[..taps],
                &exact.stored[..taps],
            ),
            Step::new("visibility", &[""], &[gpu.visibility], &[exact.visibility]),
        ]);
        steps
    }

    /// How many places of the map are looked at.
    fn taps(&self) -> usize {
        match self.settings.choice("stage") {
            "pcf" => 5,
            _ => 1,
        }
    }

    fn tests(&self, gpu: &Fragment, exact: &Exact) -> Vec<(&'static str, bool, bool)> {
        let test = |i: usize| {
            (
                QUESTIONS[i],
                gpu.stored[i] < gpu.nearer,
                exact.stored[i].value < exact.nearer.value,
            )
        };
        (0..self.taps()).map(test).collect()
    }

    /// Every matrix of both passes, in the world's own coordinates.
    fn labelled_matrices(&self, probe: Probe, object: usize) -> Vec<(&'static str, DMat4)> {
        let camera = self.scene().camera;
        let mut matrices = Vec::new();
        let mut model = DMat4::IDENTITY;
        if let Probe::Pixel(_) = probe {
            model = self.model_matrix(&self.scene().objects[object]);
            matrices.push(("depthModelMatrix, the model's own: object to world", model));
        }
        let depth_projection = self.depth_projection_matrix();
        let depth_view = self.depth_view_matrix(DVec3::ZERO);
        let depth_mvp = depth_projection * depth_view * model;
        matrices.extend([
            (
                "MVP: to the camera's clip space",
                camera.perspective(self.aspect()) * camera.view() * model,
            ),
            ("depthViewMatrix: world to the light's view", depth_view),
            (
                "depthProjectionMatrix: the light's view to clip space",
                depth_projection,
            ),
            (
                "depthMVP = depthProjectionMatrix * depthViewMatrix * depthModelMatrix",
                depth_mvp,
            ),
            ("biasMatrix: [-1, 1] to [0, 1]", bias_matrix()),
            (
                "depthBiasMVP = biasMatrix * depthMVP",
                bias_matrix() * depth_mvp,
            ),
        ]);
        matrices
    }
}
