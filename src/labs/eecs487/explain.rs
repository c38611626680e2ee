//! `shadowlab explain eecs487`: which wall a pixel shows, the matrix that projects onto it, and what casts the shadow.
//!
//! There is no shadow test to read values from: a shadow is drawn or not. What the GPU has is the depth buffer, which says
//! where on the wall the pixel lies, the stencil buffer, and whether a shadow was drawn; f64 says the same from the
//! projected triangles.

use glam::{DMat4, DVec3, DVec4, dvec2};

use super::draw_scene::View;
use super::scene::Wall;
use super::shadow_matrix::{mult_shadow_mat, plane_from};
use super::{Eecs487, HANDOUT};
use crate::labs::exact::{ClipTriangle, ROUNDING};
use crate::labs::{Explanation, Probe, Show, Step};
use crate::{Error, Result, gl};

/// By how much a depth may be off: what `shadow.frag` moves it nearer, a step of 24 bits, and rounding.
const DEPTH_BOUND: f64 = 1.0 / 4_194_304.0 + 1.0 / 16_777_216.0 + ROUNDING;

/// What stands between a point of a wall and the light, in f64.
struct Caster {
    name: String,
    triangle: usize,
    point: DVec3,
}

impl Eecs487 {
    pub(super) fn explain_at(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        let pixel @ [x, y] = self.probed(probe)?;
        self.display(gl, Show::Picture)?;
        let from_bottom = [x, self.size[1] - 1 - y];
        let color = gl::read_rgb(gl, self.size).get_pixel(x, y).0;
        let depth = f64::from(gl::read_depth(gl, from_bottom));
        let in_stencil = gl::read_stencil(gl, from_bottom) == 1;
        self.display(gl, Show::Visibility { light: 1 })?;
        let in_shadow = gl::read_grey(gl, self.size).get_pixel(x, y).0[0] < 128;

        let place = format!("{}: pixel {x},{y}", HANDOUT.name);
        let view = self.view(self.light());
        let Some(wall) = self.wall_at(&view, pixel, depth, in_shadow) else {
            let nothing = place + " shows no wall, and nothing else receives shadows";
            return Ok(Explanation::of_nothing(nothing, Some(color)));
        };
        let exact = self.plane_depth(&view, wall).dot(self.window(pixel));
        let caster = self.caster(&view, wall, pixel);
        let mut tests = vec![(
            "an occluder, projected onto the wall, covers the pixel",
            in_shadow,
            caster.is_some(),
        )];
        if self.settings.switch("stencil_clipping") {
            let inside = self.is_inside(&view, wall, pixel);
            tests.push(("the pixel is within the stencil", in_stencil, inside));
        }
        Ok(Explanation {
            place: format!("{place} shows \"{}\"{}", wall.name, self.told(wall, caster)),
            color: Some(color),
            matrices: vec![
                (
                    "shadowMat: world to the wall",
                    mult_shadow_mat(wall.plane, view.light),
                ),
                (
                    "projection * view: world to clip space",
                    view.from_eye * DMat4::from_translation(-self.scene.camera.eye),
                ),
            ],
            steps: self.steps(&view, wall, pixel, [depth, exact]),
            tests,
            in_shadow: Some(in_shadow),
            look_up: None,
        })
    }

    fn probed(&self, probe: Probe) -> Result<[u32; 2]> {
        let refused = |message: &str| Err(Error::usage(message.to_owned()));
        if self.settings.choice("scene") == "ramp" {
            return refused("scene=ramp has no shadows to explain, expected scene=room");
        }
        if self.settings.switch("soft_shadows") {
            return refused(
                "soft shadows are an average, and no single shadow explains them, expected soft_shadows=off",
            );
        }
        probe.check(self.size)?;
        match probe {
            Probe::Pixel(pixel) => Ok(pixel),
            Probe::Point(_) => refused(
                "eecs487 tests no point: its shadows are drawn on what is seen, expected a pixel",
            ),
        }
    }

    /// The pixel's centre in the window, and a 1.
    fn window(&self, [x, y]: [u32; 2]) -> DVec3 {
        let y = f64::from(self.size[1] - 1 - y);
        DVec3::new(f64::from(x) + 0.5, y + 0.5, 1.0)
    }

    /// The wall whose depth the GPU has there. Beyond the edges of a wall, that of the shadow alone.
    fn wall_at(&self, view: &View, pixel: [u32; 2], depth: f64, in_shadow: bool) -> Option<&Wall> {
        let window = self.window(pixel);
        self.shown().find(|wall| {
            let apart = (self.plane_depth(view, wall).dot(window) - depth).abs();
            apart <= DEPTH_BOUND && (in_shadow || self.is_inside(view, wall, pixel))
        })
    }

    /// The point of the world that has this depth at a pixel.
    fn point(&self, view: &View, pixel: [u32; 2], depth: f64) -> DVec3 {
        let size = dvec2(f64::from(self.size[0]), f64::from(self.size[1]));
        let screen = 2.0 * self.window(pixel).truncate() / size - 1.0;
        let from_eye = view.from_eye.inverse() * screen.extend(2.0 * depth - 1.0).extend(1.0);
        self.scene.camera.eye + from_eye.truncate() / from_eye.w
    }

    fn is_inside(&self, view: &View, wall: &Wall, pixel: [u32; 2]) -> bool {
        let depth = self.plane_depth(view, wall).dot(self.window(pixel));
        let point = self.point(view, pixel, depth);
        let on_wall = wall.placement.inverse().transform_point3(point);
        on_wall.truncate().abs().max_element() <= 1.0
    }

    /// The nearest to the wall of all triangles whose projections cover the pixel.
    fn caster(&self, view: &View, wall: &Wall, pixel: [u32; 2]) -> Option<Caster> {
        let plane = plane_from(view.light, wall.plane);
        let to_clip = view.from_light * mult_shadow_mat(plane, DVec3::ZERO);
        let place = self.window(pixel).truncate();
        let mut nearest: Option<(f64, Caster)> = None;
        for occluder in self.occluders.iter().filter(|o| o.object.casts) {
            let mesh = &occluder.object.mesh;
            let model = DMat4::from_translation(-view.light) * occluder.model(self.rotation);
            for (triangle, face) in mesh.faces.iter().enumerate() {
                let corners: [DVec4; 3] =
                    face.map(|i| model * mesh.positions[i as usize].extend(1.0));
                let Some(projected) = ClipTriangle::new(corners.map(|corner| to_clip * corner))
                else {
                    continue;
                };
                let Some(shares) = projected.covers(self.size, place) else {
                    continue;
                };
                let [a, b, c] = corners;
                let point = a * shares.x + b * shares.y + c * shares.z;
                let height = plane.dot(point);
                if height >= 0.0 && nearest.as_ref().is_none_or(|(least, _)| height < *least) {
                    let caster = Caster {
                        name: occluder.object.name.clone(),
                        triangle,
                        point: view.light + point.truncate(),
                    };
                    nearest = Some((height, caster));
                }
            }
        }
        nearest.map(|(_, caster)| caster)
    }

    /// The wall's implicit function, at the light and at what casts the shadow.
    fn told(&self, wall: &Wall, caster: Option<Caster>) -> String {
        let [a, b, c, d] = wall.plane.to_array();
        let light = self.light();
        let at = |point: DVec3| wall.plane.dot(point.extend(1.0));
        let mut text = format!(
            "\n(A, B, C, D) = ({a}, {b}, {c}, {d}): Ax + By + Cz + D is {:.6} at the light",
            at(light)
        );
        if let Some(Caster {
            name,
            triangle,
            point,
        }) = caster
        {
            let projected = mult_shadow_mat(wall.plane, light) * point.extend(1.0);
            let on_wall = projected.truncate() / projected.w;
            text += &format!(
                ",\n{:.6} at ({:.6}, {:.6}, {:.6}) on \"{name}\", triangle {triangle}, which goes to \
                 ({:.6}, {:.6}, {:.6}) with w {:.6}",
                at(point),
                point.x,
                point.y,
                point.z,
                on_wall.x,
                on_wall.y,
                on_wall.z,
                projected.w
            );
        }
        text
    }

    fn steps(&self, view: &View, wall: &Wall, pixel: [u32; 2], depths: [f64; 2]) -> Vec<Step> {
        let [gpu, exact] = depths.map(|depth| self.point(view, pixel, depth));
        // What the depth's own bound makes of the point.
        let moved = self.point(view, pixel, depths[1] + DEPTH_BOUND) - exact;
        let rounding = ROUNDING * exact.abs().max_element();
        let bound = 1.01 * moved.abs() + rounding;
        let plane = wall.plane;
        vec![
            Step {
                name: "depth",
                components: &[""],
                gpu: vec![depths[0]],
                exact: vec![depths[1]],
                bound: vec![DEPTH_BOUND],
            },
            Step {
                name: "point of the wall",
                components: &["x", "y", "z"],
                gpu: gpu.to_array().to_vec(),
                exact: exact.to_array().to_vec(),
                bound: bound.to_array().to_vec(),
            },
            Step {
                name: "Ax + By + Cz + D",
                components: &[""],
                gpu: vec![plane.dot(gpu.extend(1.0))],
                exact: vec![plane.dot(exact.extend(1.0))],
                bound: vec![plane.truncate().abs().dot(bound)],
            },
        ]
    }
}
