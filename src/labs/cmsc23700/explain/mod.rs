//! `shadowlab explain cmsc23700`: the shadow test's values for one light at one place, from the GPU, and in f64.

mod exact;
mod fragment;

use glam::{DMat4, DVec3};

use super::lights::{cos_cutoff, to_texture};
use super::{Cmsc23700, HANDOUT, SPOT};
use crate::gl;
use crate::labs::{Explanation, Lab, LookUp, Probe, Show, Step};
use crate::{Error, Result};
use exact::Exact;
use fragment::Fragment;

const XYZ: &[&str] = &["x", "y", "z"];

impl Cmsc23700 {
    pub(super) fn explain_at(
        &mut self,
        gl: &glow::Context,
        probe: Probe,
        light: usize,
    ) -> Result<Explanation> {
        self.check_probe(probe, light)?;
        self.draw(gl, Show::Picture)?;
        let name = HANDOUT.name;
        let (mut place, color) = match probe {
            Probe::Pixel([x, y]) => (
                format!("{name}: pixel {x},{y}"),
                Some(gl::read_rgb(gl, self.size).get_pixel(x, y).0),
            ),
            Probe::Point(p) => (
                format!("{name}: the point ({}, {}, {})", p.x, p.y, p.z),
                None,
            ),
        };
        let Some(fragment) = self.fragment(gl, probe, light)? else {
            return Ok(Explanation::of_nothing(place + " shows no surface", color));
        };
        let exact = self.exact(probe, &fragment, light - 1);
        if let Probe::Pixel(_) = probe {
            let name = match self.scene.objects.get(fragment.object) {
                Some(object) => format!("\"{}\"", object.name),
                None => format!("ball {}", self.ball(fragment.object) + 1),
            };
            let [x, y, z] = self.in_world(&exact).to_array();
            place += &format!(
                " shows {name}, triangle {}, at ({x:.4}, {y:.4}, {z:.4})",
                fragment.triangle
            );
        }
        Ok(Explanation {
            place,
            color,
            matrices: self.labelled_matrices(probe, fragment.object, light - 1),
            steps: self.steps(&fragment, &exact, light - 1),
            tests: self.tests(&fragment, &exact, light - 1),
            // As the visibility is read: dark below the half of it.
            in_shadow: Some(fragment.shadow < 0.75),
            look_up: self
                .is_asked(fragment.spot_dot, light - 1)
                .then_some(LookUp {
                    uv: fragment.place.truncate(),
                    depth: fragment.nearer,
                }),
        })
    }

    fn check_probe(&self, probe: Probe, light: usize) -> Result<()> {
        self.check_light(light)?;
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
        probe.check(self.size)
    }

    /// Which ball has this number among all that is drawn; both count from 0.
    fn ball(&self, number: usize) -> usize {
        number - self.scene.objects.len()
    }

    fn in_world(&self, exact: &Exact) -> DVec3 {
        let [x, y, z] = [0, 1, 2].map(|i| exact.eye_position[i].value);
        let to_world = self.scene.camera.view().inverse();
        to_world.transform_point3(DVec3::new(x, y, z))
    }

    fn steps(&self, gpu: &Fragment, exact: &Exact, light: usize) -> Vec<Step> {
        let (coord, bias) = [
            ("directionalCoord", "depth - directionalBias"),
            ("spotCoord", "depth - spotBias"),
        ][light];
        let mut steps = vec![Step::new(
            "eyePosition",
            XYZ,
            &gpu.eye_position.to_array(),
            &exact.eye_position,
        )];
        if light == SPOT {
            steps.push(Step::new(
                "spotDot",
                &[""],
                &[gpu.spot_dot],
                &[exact.spot_dot],
            ));
            if !self.is_asked(gpu.spot_dot, light) {
                return steps;
            }
        }
        steps.extend([
            Step::new(
                coord,
                &["x", "y", "z", "w"],
                &gpu.coord.to_array(),
                &exact.coord,
            ),
            Step::new(
                "place = xyz / w",
                &["x", "y", "z"],
                &gpu.place.to_array(),
                &exact.place,
            ),
            Step::new(bias, &[""], &[gpu.nearer], &[exact.nearer]),
            Step::new("in the map (stored)", &[""], &[gpu.stored], &[exact.stored]),
            Step::new("S_l", &[""], &[gpu.shadow], &[exact.shadow]),
        ]);
        steps
    }

    /// The spotlight asks its map within its cone only.
    fn is_asked(&self, spot_dot: f64, light: usize) -> bool {
        light != SPOT || spot_dot >= cos_cutoff(&self.scene.lights[SPOT])
    }

    fn tests(
        &self,
        gpu: &Fragment,
        exact: &Exact,
        light: usize,
    ) -> Vec<(&'static str, bool, bool)> {
        let [asked, exactly_asked] =
            [gpu.spot_dot, exact.spot_dot.value].map(|dot| self.is_asked(dot, light));
        let mut tests = Vec::new();
        if light == SPOT {
            let question = "inside the cone of light: spotDot >= spotCosCutoff";
            tests.push((question, asked, exactly_asked));
        }
        if asked {
            tests.push((
                "behind the map's surface: stored < depth - bias",
                gpu.stored < gpu.nearer,
                exact.stored.value < exact.nearer.value,
            ));
        }
        tests
    }

    /// Every matrix of both passes, in the world's own coordinates.
    fn labelled_matrices(
        &self,
        probe: Probe,
        number: usize,
        light: usize,
    ) -> Vec<(&'static str, DMat4)> {
        let camera = &self.light_cameras[light];
        let mut matrices = Vec::new();
        let mut model = DMat4::IDENTITY;
        if let Probe::Pixel(_) = probe {
            model = self.placed(number);
            matrices.push(("model: object to world", model));
        }
        let light_view = camera.model_view * DMat4::from_translation(-camera.position);
        let model_view = self.scene.camera.view() * model;
        matrices.extend([
            ("modelView: object to eye space", model_view),
            ("projection: eye space to clipping space", self.projection()),
            ("the light's view: world to the light", light_view),
            ("the light's projection", camera.projection),
            (
                "lightModelViewProjection: object to the light's clipping space",
                camera.projection * light_view * model,
            ),
            ("clipping space to 0…1", to_texture()),
            (
                "the texture matrix: eye space to the map",
                camera.texture_matrix,
            ),
        ]);
        matrices
    }

    /// Object space to world space of what has this number among all that is drawn.
    fn placed(&self, number: usize) -> DMat4 {
        match self.scene.objects.get(number) {
            Some(object) => self.model(object),
            None => {
                let place = self.simulation.positions().nth(self.ball(number));
                DMat4::from_translation(place.expect("a ball that was drawn"))
            }
        }
    }
}
