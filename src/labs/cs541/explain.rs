//! `shadowlab explain cs541`: the shadow test's values at one place, from the GPU, and in f64 beside them.
//!
//! The GPU's values come from the lab's own vertex shader with `explain.frag`. The f64 ones are computed here from the
//! unrounded scene: the point where the pixel's ray meets the triangle that the GPU drew there, its place in the
//! light's clip space, and the depth that an exact rasteriser would store in each texel that is looked up.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, dvec2};
use glow::HasContext;

use super::{Cs541, HANDOUT, MATRICES, SHADOW_TEST};
use crate::gl::{self, Program, Shaders};
use crate::labs::{Explanation, Probe, Show, Step};
use crate::scene::camera;
use crate::{Error, Result};

/// B of the handout's equation (1): the standard cube to the unit cube.
fn unit_cube() -> DMat4 {
    let half = DVec3::splat(0.5);
    DMat4::from_translation(half) * DMat4::from_scale(half)
}

// ---- How far the GPU may be off --------------------------------------------------------------------------------------

/// Vertices are snapped to a grid of 1/256 pixel, in the picture and in the map; the nearest grid point is at most half
/// of that away along each axis, and rasterisers differ in where pixels start: the other half is for them.
const SNAP: f64 = 1.0 / 256.0;
/// Rounding of the shaders' products and of the interpolation: 8 roundings of 2⁻²⁴, relative to the largest terms.
const ROUNDING: f64 = 8.0 / 16_777_216.0;
/// A linear filter's weights may have as few as 8 bits.
const FILTER_WEIGHT: f64 = 1.0 / 256.0;

impl Cs541 {
    /// What a stored depth may be off by its format and by the rasteriser's own f32 arithmetic.
    fn depth_quantum(&self) -> f64 {
        let quantum = match self.first_pass.buffer.kind.depth_format {
            "16" => 1.0 / 65_536.0,
            _ => 1.0 / 16_777_216.0,
        };
        quantum + 8.0 / 16_777_216.0
    }
}

// ---- The GPU's values ------------------------------------------------------------------------------------------------

/// What `explain.frag` tells of one fragment.
struct Fragment {
    /// Relative to the eye.
    position: DVec3,
    shadow_position: DVec4,
    uv: DVec2,
    point_depth: f64,
    /// `point_depth` less epsilon.
    nearer_depth: f64,
    shadow_depth: f64,
    in_front: bool,
    uv_inside: bool,
    inside_beam: bool,
    in_shadow: bool,
    object: usize,
    triangle: usize,
}

impl Cs541 {
    /// Draws with the explaining program and reads one fragment: a pixel of the picture, or a point of the world.
    /// None where nothing is drawn.
    fn fragment(&mut self, gl: &glow::Context, probe: Probe) -> Result<Option<Fragment>> {
        if self.explainer.is_none() {
            self.explainer = Some(explain_program(gl, &self.shaders)?);
        }
        let program = self.explainer.as_ref().expect("made above");
        let read = |objects: &[usize], value| match probe {
            Probe::Pixel(pixel) => self.pixel_value(gl, program, pixel, objects, value),
            Probe::Point(point) => self.point_value(gl, program, point, value),
        };
        // The whole scene decides what is seen; after that its own object is enough.
        let all: Vec<usize> = (0..self.scene.objects.len()).collect();
        let number = read(&all, 0)?;
        if number == 0.0 {
            return Ok(None);
        }
        let object = number as usize - 1;
        let mut values = [0.0; 16];
        for (number, value) in values.iter_mut().enumerate() {
            *value = read(&[object], number as i32)?;
        }
        let [
            _,
            triangle,
            lx,
            ly,
            lz,
            x,
            y,
            z,
            w,
            u,
            v,
            point_depth,
            nearer_depth,
            shadow_depth,
            tests,
            in_shadow,
        ] = values;
        // The shader gets the light's position in f32: less light_vector, that is its own world position.
        let light = self.light().position - self.camera().eye;
        let tests = tests as u32;
        Ok(Some(Fragment {
            position: light.as_vec3().as_dvec3() - DVec3::new(lx, ly, lz),
            shadow_position: DVec4::new(x, y, z, w),
            uv: dvec2(u, v),
            point_depth,
            nearer_depth,
            shadow_depth,
            in_front: tests & 1 != 0,
            uv_inside: tests & 2 != 0,
            inside_beam: tests & 4 != 0,
            in_shadow: in_shadow != 0.0,
            object,
            triangle: triangle as usize,
        }))
    }

    /// One value of the fragment that is seen at a pixel, when these objects are drawn.
    fn pixel_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        [x, y]: [u32; 2],
        objects: &[usize],
        value: i32,
    ) -> Result<f64> {
        let row = self.size[1] - 1 - y;
        // Into the window, not a framebuffer of floats: there a driver may count rows the other way, and round
        // otherwise than in the picture that is explained.
        unsafe {
            gl.enable(glow::SCISSOR_TEST);
            gl.scissor(x as i32, row as i32, 1, 1);
        }
        self.select_window(gl, [0.0; 4]);
        self.use_explainer(gl, program, value);
        let eye = self.camera().eye;
        for index in objects {
            program.set(gl, "object_number", *index as i32 + 1);
            program.set(
                gl,
                "model_matrix",
                self.model_from(eye, &self.scene.objects[*index]),
            );
            self.meshes[*index].draw(gl);
        }
        unsafe { gl.disable(glow::SCISSOR_TEST) };
        Ok(f64::from(gl::read_float_in_bytes(gl, [x, row])))
    }

    /// One value at a point of the world: a single vertex at the object's origin (what an attribute without an array
    /// holds), moved to the point, and projected onto the middle of a viewport of one pixel.
    fn point_value(
        &self,
        gl: &glow::Context,
        program: &Program,
        point: DVec3,
        value: i32,
    ) -> Result<f64> {
        self.select_window(gl, [0.0; 4]);
        self.use_explainer(gl, program, value);
        let middle = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        program.set(gl, "object_number", 1);
        program.set(gl, "persp_matrix", middle);
        program.set(
            gl,
            "model_matrix",
            DMat4::from_translation(point - self.camera().eye),
        );
        unsafe {
            gl.viewport(0, 0, 1, 1);
            let nothing = gl.create_vertex_array().map_err(Error::gl)?;
            gl.bind_vertex_array(Some(nothing));
            gl.draw_arrays(glow::POINTS, 0, 1);
            gl.delete_vertex_array(nothing);
        }
        Ok(f64::from(gl::read_float_in_bytes(gl, [0, 0])))
    }

    fn use_explainer(&self, gl: &glow::Context, program: &Program, value: i32) {
        unsafe { gl.use_program(Some(program.handle)) };
        self.use_shadow_map(gl, program);
        program.set(
            gl,
            "light_position",
            self.light().position - self.camera().eye,
        );
        program.set(gl, "value_number", value);
    }
}

fn explain_program(gl: &glow::Context, shaders: &Shaders) -> Result<Program> {
    let own = ["light_position", "object_number", "value_number"];
    let uniforms = [&MATRICES[..], &SHADOW_TEST, &own].concat();
    Program::new(gl, shaders, "lighting.vert", "explain.frag", &uniforms)
}

// ---- The same in f64 -------------------------------------------------------------------------------------------------

/// A triangle in clip space, ready to be asked what of it lies at a point of the screen.
struct ClipTriangle {
    /// From (x, y, 1) to the weights of the three vertices, whose sum is 1/w there.
    weights: DMat3,
    z: DVec3,
    /// Counter-clockwise on the screen, which GL calls the front.
    front: bool,
}

impl ClipTriangle {
    /// None if it is seen edge-on or has no area.
    fn new([a, b, c]: [DVec4; 3]) -> Option<Self> {
        let xyw = |v: DVec4| DVec3::new(v.x, v.y, v.w);
        let corners = DMat3::from_cols(xyw(a), xyw(b), xyw(c));
        let area = corners.determinant();
        (area != 0.0).then(|| Self {
            weights: corners.inverse(),
            z: DVec3::new(a.z, b.z, c.z),
            front: area > 0.0,
        })
    }

    /// The depth in 0…1 at a point of the screen in −1…1; None outside of the triangle and of near and far.
    fn depth(&self, screen: DVec2) -> Option<f64> {
        let weights = self.weights * screen.extend(1.0);
        let z = weights.dot(self.z);
        (weights.min_element() >= 0.0 && z.abs() <= 1.0).then_some(0.5 * z + 0.5)
    }
}

/// A value, and the smallest and largest that it may be.
#[derive(Clone, Copy)]
struct Range {
    value: f64,
    least: f64,
    most: f64,
}

impl Range {
    fn over(value: f64, others: impl IntoIterator<Item = f64>) -> Self {
        let start = Self {
            value,
            least: value,
            most: value,
        };
        others.into_iter().fold(start, |range, other| Self {
            value,
            least: range.least.min(other),
            most: range.most.max(other),
        })
    }

    fn radius(&self) -> f64 {
        (self.most - self.value).max(self.value - self.least)
    }
}

/// The corners of a square of half the side `r` around nothing.
fn corners(r: f64) -> [DVec2; 4] {
    [dvec2(-r, -r), dvec2(r, -r), dvec2(-r, r), dvec2(r, r)]
}

/// The shadow map that an exact rasteriser would draw, texel by texel as it is asked for.
struct ExactMap {
    triangles: Vec<ClipTriangle>,
    size: f64,
    linear: bool,
    texels: HashMap<(i64, i64), Range>,
}

impl ExactMap {
    /// The depth that is stored at a place on the map, in texels.
    fn depth(&self, place: DVec2) -> f64 {
        let screen = 2.0 * place / self.size - 1.0;
        let depths = self
            .triangles
            .iter()
            .filter_map(|triangle| triangle.depth(screen));
        depths.fold(1.0, f64::min)
    }

    /// A texel's depth, at its centre and as far around it as a snapped vertex may have moved the surface.
    fn texel(&mut self, x: i64, y: i64) -> Range {
        // GL_CLAMP_TO_EDGE.
        let last = self.size as i64 - 1;
        let (x, y) = (x.clamp(0, last), y.clamp(0, last));
        if let Some(known) = self.texels.get(&(x, y)) {
            return *known;
        }
        let centre = dvec2(x as f64 + 0.5, y as f64 + 0.5);
        let around = corners(SNAP).map(|offset| self.depth(centre + offset));
        let texel = Range::over(self.depth(centre), around);
        self.texels.insert((x, y), texel);
        texel
    }

    /// `texture(shadow_sampler, uv)`.
    fn lookup(&mut self, uv: DVec2) -> Range {
        let place = uv * self.size;
        if !place.is_finite() {
            return Range::over(1.0, [0.0]);
        }
        if !self.linear {
            return self.texel(place.x.floor() as i64, place.y.floor() as i64);
        }
        let corner = (place - 0.5).floor();
        let share = place - 0.5 - corner;
        let (x, y) = (corner.x as i64, corner.y as i64);
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| self.texel(x + i, y + j));
        let mix = |depth: fn(&Range) -> f64| {
            let [a, b, c, d] = texels.each_ref().map(depth);
            let (lower, upper) = (a + share.x * (b - a), c + share.x * (d - c));
            lower + share.y * (upper - lower)
        };
        let slack = {
            let values = texels.map(|texel| texel.value);
            let all = Range::over(values[0], values);
            FILTER_WEIGHT * (all.most - all.least)
        };
        Range {
            value: mix(|texel| texel.value),
            least: mix(|texel| texel.least) - slack,
            most: mix(|texel| texel.most) + slack,
        }
    }
}

/// A point's way through equation (1) and the division.
#[derive(Clone, Copy)]
struct ShadowPosition {
    position: DVec4,
    uv: DVec2,
    depth: f64,
}

impl ShadowPosition {
    fn new(matrix: DMat4, point: DVec3) -> Self {
        let position = matrix * point.extend(1.0);
        let divided = position / position.w;
        Self {
            position,
            uv: divided.truncate().truncate(),
            depth: divided.z,
        }
    }

    fn values(&self) -> [f64; 7] {
        let DVec4 { x, y, z, w } = self.position;
        [x, y, z, w, self.uv.x, self.uv.y, self.depth]
    }
}

impl Cs541 {
    fn exact_map(&self) -> ExactMap {
        let inputs = self.map_inputs();
        let light = inputs.persp_matrix * inputs.view_matrix;
        let mut triangles = Vec::new();
        for ((index, _), model) in self.casters().iter().zip(&inputs.model_matrices) {
            let mesh = &self.scene.objects[*index].mesh;
            let matrix = light * *model;
            let clip: Vec<DVec4> = mesh
                .positions
                .iter()
                .map(|p| matrix * p.extend(1.0))
                .collect();
            let of_face = |face: &[u32; 3]| ClipTriangle::new(face.map(|i| clip[i as usize]));
            let kept = |t: &ClipTriangle| !(inputs.front_face_culling && t.front);
            triangles.extend(mesh.faces.iter().filter_map(of_face).filter(kept));
        }
        ExactMap {
            triangles,
            size: f64::from(self.first_pass.buffer.kind.size),
            linear: self.first_pass.buffer.kind.filter == "linear",
            texels: HashMap::new(),
        }
    }

    /// Where the ray through a place of the picture, in pixels from the bottom left, meets the plane of a triangle;
    /// relative to the eye.
    fn seen_point(&self, fragment: &Fragment, place: DVec2) -> DVec3 {
        let camera = self.camera();
        let object = &self.scene.objects[fragment.object];
        let model = self.model_from(camera.eye, object);
        let corners = object.mesh.faces[fragment.triangle]
            .map(|i| model.transform_point3(object.mesh.positions[i as usize]));
        let clip =
            camera.perspective(self.aspect()) * camera::view(DVec3::ZERO, camera.look, camera.rup);
        let Some(seen) = ClipTriangle::new(corners.map(|corner| clip * corner.extend(1.0))) else {
            return corners[0];
        };
        let size = dvec2(f64::from(self.size[0]), f64::from(self.size[1]));
        let screen = 2.0 * place / size - 1.0;
        let weights = seen.weights * screen.extend(1.0);
        DMat3::from_cols(corners[0], corners[1], corners[2]) * weights / weights.element_sum()
    }
}

// ---- Both side by side -----------------------------------------------------------------------------------------------

impl Cs541 {
    pub(super) fn explain_at(&mut self, gl: &glow::Context, probe: Probe) -> Result<Explanation> {
        if !self.settings.switch("shadows") {
            return Err(Error::usage(
                "shadows=off makes no shadow test to explain, expected shadows=on",
            ));
        }
        if let Probe::Pixel([x, y]) = probe
            && (x >= self.size[0] || y >= self.size[1])
        {
            let [width, height] = self.size;
            return Err(Error::usage(format!(
                "pixel {x},{y} is outside of the picture, expected 0,0 to {},{}",
                width - 1,
                height - 1
            )));
        }
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
        let circle = self.beam() != super::CIRCULAR || exact.uv.distance(DVec2::splat(0.5)) <= 0.5;
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
        if self.beam() == super::CIRCULAR {
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
