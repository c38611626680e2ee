//! The same soft shadows faster: geometry and depth do not change, only the light does.
//!
//! Walls and occluders are drawn once, each vertex with the mean of what the lights give it. The umbra, which no light
//! reaches, is drawn over them at once. Then, wall by wall, each light's shadows set a bit of a mask, as far as they are not
//! in the umbra; and where a bit is set, the wall is mixed anew from the lights that are seen there.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::dvec3;
use glow::HasContext;

use super::Eecs487;
use super::draw_scene::View;
use super::look::{Look, set_light};
use super::masks::{JittersSent, LIGHTS_PER_MASK, Masks};
use super::scene::Wall;
use super::selection::{MadeFor, Selection};
use crate::{Result, gl};

/// What is seen at a pixel, as the stencil buffer has it: one of the walls by its number, or something that hides them.
fn wall_bit(wall: &Wall) -> i32 {
    1 << wall.number()
}
/// Whether a mask has a bit there.
const MASKED: i32 = 1 << 6;
/// No wall's shadow is to be drawn there: something else hides the walls, or it is in the umbra.
const DONE: i32 = 1 << 7;
const ALL_BITS: u32 = 0xFF;

impl Eecs487 {
    /// Once, and again for another size or for more lights; and what the lights' jitters are, when that has changed.
    pub(super) fn make_masks(&mut self, gl: &glow::Context) -> Result<()> {
        let count = self.num_jitters().div_ceil(LIGHTS_PER_MASK);
        let fits = |masks: &Masks| masks.size == self.size && masks.count() >= count;
        if !self.masks.as_ref().is_some_and(fits) {
            if let Some(old) = self.masks.take() {
                old.delete(gl);
            }
            self.masks = Some(Masks::new(gl, self.size, count)?);
        }
        let wanted = JittersSent {
            kind: self.settings.choice("jitter"),
            amount: self.settings.number("jitter_amount"),
            first: self.settings.number("first_jitter"),
            count: self.num_jitters(),
        };
        if !self
            .masks
            .as_ref()
            .is_some_and(|masks| masks.is_sent(&wanted))
        {
            let jitters = (0..wanted.count).map(|index| self.jitter(index)).collect();
            let masks = self.masks.as_mut().expect("made above");
            masks.send_jitters(gl, wanted, jitters);
        }
        if self.selection.is_none() {
            self.selection = Some(Selection::new(gl, &self.occluders)?);
        }
        let wanted = MadeFor {
            light: self.light(),
            amount: wanted.amount,
            rotation: self.rotation,
            has_walls: self.wall_mesh.is_some(),
            beyond: !self.settings.switch("stencil_clipping") && !self.walls_fill_the_window(),
        };
        let selection = self.selection.as_mut().expect("made above");
        selection.bring_up_to_date(gl, wanted, &self.walls, &self.occluders);
        Ok(())
    }

    /// Whether all walls are shown, and nothing else is seen around them: so it is if the rays through the window's corners
    /// meet walls, for the room is convex.
    fn walls_fill_the_window(&self) -> bool {
        let eye = self.scene.camera.eye;
        let to_world = self.view(eye).from_eye.inverse();
        // The middles of the pixels in the corners are what is drawn.
        let [x, y] = self.size.map(|side| 1.0 - 1.0 / f64::from(side));
        let corners = [(-x, -y), (x, -y), (-x, y), (x, y)];
        let meets = |(x, y): (f64, f64), wall: &Wall| {
            let ray = to_world.project_point3(dvec3(x, y, -1.0));
            let height = wall.plane.dot(eye.extend(1.0));
            let t = -height / wall.plane.truncate().dot(ray);
            let on_wall = wall.placement.inverse().transform_point3(eye + t * ray);
            // From the inside, behind the near plane, and on the wall.
            height > 0.0 && t > 1.0 && on_wall.abs().max_element() <= 1.0
        };
        self.shown().count() == self.walls.len()
            && corners
                .into_iter()
                .all(|corner| self.walls.iter().any(|wall| meets(corner, wall)))
    }

    pub(super) fn soft_shadows_fast(&self, gl: &glow::Context, look: &Look) {
        let masks = self.masks.as_ref().expect("made before they are used");
        let selection = self.selection.as_ref().expect("made before it is used");
        let view = self.view(self.light());
        let _pass = gl::pass(gl, "soft shadows, fast");
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(masks.frame));
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT | glow::STENCIL_BUFFER_BIT);
            gl.enable(glow::STENCIL_TEST);
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::REPLACE);
        }
        self.draw_what_stays(gl, &view, look);

        self.draw_umbrae(gl, selection, &view, look);
        masks.bind(gl);
        unsafe {
            // From here on the depth buffer is the masks'.
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.enable(glow::BLEND);
            gl.stencil_mask(MASKED as u32);
        }
        let has_penumbra = |wall: &&Wall| selection.has_penumbra(wall.number());
        for wall in self.shown().filter(has_penumbra) {
            let (reference, bits) = match self.settings.switch("stencil_clipping") {
                true => (wall_bit(wall) | MASKED, ALL_BITS),
                // Where nothing else is than this wall.
                false => (MASKED, ALL_BITS & !(wall_bit(wall) as u32)),
            };
            // Each bit of a mask leaves its trace in the stencil buffer, and only there something is to be mixed.
            unsafe { gl.stencil_func(glow::EQUAL, reference, bits & !(MASKED as u32)) };
            self.draw_masks(gl, masks, selection, &view, wall);
            unsafe { gl.stencil_func(glow::EQUAL, reference, bits) };
            self.draw_penumbra(gl, masks, &view, wall, look);
        }
        unsafe {
            gl.stencil_mask(ALL_BITS);
            gl.disable(glow::BLEND);
            gl.disable(glow::STENCIL_TEST);
        }
        masks.to_window(gl);
    }

    /// Everything once, as all lights light it in the mean.
    fn draw_what_stays(&self, gl: &glow::Context, view: &View, look: &Look) {
        unsafe { gl.stencil_func(glow::ALWAYS, DONE, ALL_BITS) };
        self.position_and_draw_light(gl, look);

        let program = &self.programs.fast.wall;
        unsafe { gl.use_program(Some(program.handle)) };
        program.set(gl, "numJitters", self.num_jitters() as i32);
        set_light(gl, program, look);
        self.bind_wall(gl);
        for wall in self.shown() {
            unsafe { gl.stencil_func(glow::ALWAYS, wall_bit(wall), ALL_BITS) };
            self.set_wall(gl, program, view, wall, look);
            self.draw_wall(gl);
        }

        let program = &self.programs.fast.lighting;
        unsafe {
            gl.stencil_func(glow::ALWAYS, DONE, ALL_BITS);
            gl.use_program(Some(program.handle));
        }
        program.set(gl, "numJitters", self.num_jitters() as i32);
        self.draw_occluders(gl, program, view, look);
    }

    /// What no light reaches has the shadow's color at once, where the wall is seen; and there it is done with.
    fn draw_umbrae(&self, gl: &glow::Context, selection: &Selection, view: &View, look: &Look) {
        let has_umbra = |wall: &&Wall| selection.has_umbra(wall.number());
        if !self.shown().any(|wall| has_umbra(&wall)) {
            return;
        }
        let program = &self.programs.light;
        unsafe {
            gl.disable(glow::DEPTH_TEST);
            gl.use_program(Some(program.handle));
        }
        selection.bind_umbrae(gl);
        for wall in self.shown().filter(has_umbra) {
            let (reference, bits) = (wall_bit(wall) | DONE, ALL_BITS & !(DONE as u32));
            unsafe { gl.stencil_func(glow::EQUAL, reference, bits) };
            program.set(gl, "modelViewProjection", self.wall_mvp(view, wall));
            program.set(gl, "lightColor", look.shadow(wall));
            selection.draw_umbra(gl, wall.number());
        }
        unsafe { gl.enable(glow::DEPTH_TEST) };
    }
}
