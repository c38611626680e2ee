//! `shadow_test=offset`: each light's map from a camera that is fitted to what casts, with `glPolygonOffset`. No part of the
//! handout.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::DMat4;
use glow::HasContext;

use super::exact_test::MODEL_MATRICES;
use super::lights::{self, CONE, LIGHTING};
use super::second_pass::MATRICES;
use super::{Cmsc23700, NAMES};
use crate::Result;
use crate::gl::{self, Program, Shaders};
use crate::scene::Scene;
use crate::shadow_tests::offset::{self, Casts, Fit, OffsetTest, Taps, UNITS, set_culling};

/// One look-up, as in the handout.
const TAPS: Taps = Taps::One;

/// Of each light: the uniforms of its map.
const FITTED_MAPS: [[&str; 3]; 2] = [
    [
        "directionalMap.depths",
        "directionalMap.rectangle",
        "directionalMap.nearness",
    ],
    ["spotMap.depths", "spotMap.rectangle", "spotMap.nearness"],
];

/// The test of each light and the programs that are linked with it; made when it is first asked for.
pub struct Offset {
    pub tests: [OffsetTest; 2],
    pub lighting: Program,
    pub visibility: Program,
}

impl Offset {
    fn new(gl: &glow::Context, shaders: &Shaders, scene: &Scene) -> Result<Self> {
        let [lighting, visibility] = programs(gl, shaders)?;
        let offset = Self {
            tests: Default::default(),
            lighting,
            visibility,
        };
        offset.set_lights(gl, scene);
        Ok(offset)
    }

    /// Compiles the shaders again. After an error it goes on with those it had.
    pub fn reload(&mut self, gl: &glow::Context, shaders: &Shaders, scene: &Scene) -> Result<()> {
        let [lighting, visibility] = programs(gl, shaders)?;
        std::mem::replace(&mut self.lighting, lighting).delete(gl);
        std::mem::replace(&mut self.visibility, visibility).delete(gl);
        self.set_lights(gl, scene);
        Ok(())
    }

    /// What holds for as long as the programs do.
    fn set_lights(&self, gl: &glow::Context, scene: &Scene) {
        for program in [&self.visibility, &self.lighting] {
            unsafe { gl.use_program(Some(program.handle)) };
            lights::set_cone(gl, program, scene);
        }
        lights::set_lighting(gl, &self.lighting, scene);
    }
}

/// The second pass with the offset test, and the test alone.
fn programs(gl: &glow::Context, shaders: &Shaders) -> Result<[Program; 2]> {
    let _pass = gl::pass(gl, "set-up: the programs with the offset test");
    let test = [
        &MATRICES[..],
        &MODEL_MATRICES,
        &CONE,
        FITTED_MAPS.as_flattened(),
    ]
    .concat();
    let linked = |fragment: &str, others: &[&'static str]| {
        let uniforms = [&test[..], others].concat();
        let fragments = [fragment, offset::SHADER, TAPS.shader()];
        Program::linked(gl, shaders, "lighting_lcs.vert", &fragments, &uniforms)
    };
    let switches = ["normalMatrix", "directionalEnabled", "spotEnabled"];
    let lighting = linked("lighting_offset.frag", &[&LIGHTING[..], &switches].concat())?;
    let visibility =
        linked("visibility_offset.frag", &["light"]).inspect_err(|_| lighting.delete(gl))?;
    Ok([lighting, visibility])
}

impl Cmsc23700 {
    /// The first pass of each enabled light whose map does not serve on.
    pub(super) fn prepare_offset_tests(&mut self, gl: &glow::Context) -> Result<()> {
        let mut offset = match self.offset.take() {
            Some(offset) => offset,
            None => Offset::new(gl, &self.shaders, &self.scene)?,
        };
        if self.renew_shadow_maps(gl)? {
            offset.tests.iter_mut().for_each(OffsetTest::forget);
        }
        let redraw = self.settings.choice("redraw") == "every_frame";
        let (scene, size) = (self.placed_scene(), self.shadow_maps[0].size);
        let due = self.enabled_lights().filter(|light| {
            let source = &self.scene.lights[*light];
            offset.tests[*light].prepare(source, scene.clone(), size, TAPS, redraw)
        });
        let due: Vec<_> = due.collect();
        self.draw_fitted_maps(gl, &offset, &due);
        for light in due {
            // The handout's map is no more.
            self.shadow_maps[light].drawn = None;
        }
        self.offset = Some(offset);
        Ok(())
    }

    fn draw_fitted_maps(&self, gl: &glow::Context, offset: &Offset, due: &[usize]) {
        if due.is_empty() {
            return;
        }
        let program = &self.programs.shadow;
        {
            let _pass = gl::pass(gl, "first pass: with fitted cameras");
            let size = self.shadow_maps[0].size as i32;
            unsafe {
                gl.use_program(Some(program.handle));
                gl.viewport(0, 0, size, size);
                gl.enable(glow::POLYGON_OFFSET_FILL);
                gl.polygon_offset(TAPS.factor(), UNITS);
                // What is nearer than near casts all the same.
                gl.enable(glow::DEPTH_CLAMP);
            }
        }
        let mut culling = false;
        for light in due {
            let (name, map) = (NAMES[*light], &self.shadow_maps[*light]);
            let _pass = gl::pass(gl, &format!("first pass: the {name}'s fitted shadow map"));
            unsafe {
                gl.bind_framebuffer(glow::FRAMEBUFFER, Some(map.fbo));
                gl.clear(glow::DEPTH_BUFFER_BIT);
            }
            let fit = offset.tests[*light].fit();
            self.draw_scene(
                gl,
                |number| self.casts(fit, number) != Casts::Nothing,
                |number, model| {
                    let is_solid = self.casts(fit, number) == Casts::FrontFaces;
                    culling = set_culling(gl, is_solid, culling);
                    let matrix = fit.projection() * fit.space.from_object(model);
                    program.set(gl, "lightModelViewProjection", matrix);
                },
            );
        }
        set_culling(gl, false, culling);
        unsafe {
            gl.disable(glow::DEPTH_CLAMP);
            gl.disable(glow::POLYGON_OFFSET_FILL);
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        }
    }

    /// What is drawn into a map of an object or, behind the objects' numbers, of all balls: they are drawn at once, and as
    /// the one of them that needs most.
    fn casts(&self, fit: &Fit, number: usize) -> Casts {
        let (objects, balls) = fit.casts.split_at(self.scene.objects.len());
        let of_balls = || {
            let mut most_first = [Casts::BothFaces, Casts::FrontFaces].into_iter();
            let most = most_first.find(|casts| balls.contains(casts));
            most.unwrap_or(Casts::Nothing)
        };
        objects.get(number).copied().unwrap_or_else(of_balls)
    }

    /// The fitted map of each enabled light on its own texture unit.
    pub(super) fn use_fitted_maps(&self, gl: &glow::Context, offset: &Offset, program: &Program) {
        for light in self.enabled_lights() {
            let texture = self.shadow_maps[light].depth_texture;
            unsafe {
                gl.active_texture(glow::TEXTURE0 + light as u32);
                gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            }
            offset.tests[light].send(gl, program, &FITTED_MAPS[light], light as i32);
        }
    }

    /// Where something is as the enabled lights see it.
    pub(super) fn set_offset_test(
        &self,
        gl: &glow::Context,
        offset: &Offset,
        program: &Program,
        model: DMat4,
    ) {
        for light in self.enabled_lights() {
            let space = offset.tests[light].fit().space;
            program.set(gl, MODEL_MATRICES[light], space.from_object(model));
        }
    }
}
