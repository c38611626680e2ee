//! The same soft shadows faster: geometry and depth do not change, only the light does.
//!
//! Walls and occluders are drawn once, each vertex with the mean of what the lights give it. Then, wall by wall, each
//! light's shadows set a bit of a mask; and where a bit is set, the wall is mixed anew from the lights that are seen there.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3, DVec4};
use glow::HasContext;

use super::Eecs487;
use super::draw_scene::{Look, View, set_light};
use super::masks::{JittersSent, LIGHTS_PER_MASK, Masks};
use super::occluders::Occluder;
use super::scene::Wall;
use super::settings::MOST_JITTERS;
use super::shadow_matrix::plane_from;
use crate::{Result, gl};

/// What is seen at a pixel, as the stencil buffer has it: one of the walls by its number, or something that hides them.
fn wall_bit(number: usize) -> i32 {
    1 << number
}
const HIDES_WALLS: i32 = 1 << 7;
const ALL_BITS: u32 = 0xFF;

/// Each light's shadows on each wall have a depth of their own, from the far end on: so many steps are enough.
const DEPTHS: f64 = (8 * MOST_JITTERS) as f64;

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
        Ok(())
    }

    pub(super) fn soft_shadows_fast(&self, gl: &glow::Context, look: &Look) {
        let masks = self.masks.as_ref().expect("made before they are used");
        let view = self.view(self.light());
        let _pass = gl::pass(gl, "soft shadows, fast");
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(masks.frame));
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT | glow::STENCIL_BUFFER_BIT);
            gl.enable(glow::STENCIL_TEST);
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::REPLACE);
        }
        self.draw_what_stays(gl, &view, look);
        unsafe {
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::KEEP);
            // From here on the depth buffer is the masks'.
            gl.clear(glow::DEPTH_BUFFER_BIT);
            gl.enable(glow::BLEND);
        }
        masks.bind(gl);
        for (number, wall) in self.shown().enumerate() {
            if self.casters(wall).next().is_none() {
                continue;
            }
            let bit = wall_bit(number);
            let clipping = self.settings.switch("stencil_clipping");
            let (reference, bits) = match clipping {
                true => (bit, ALL_BITS),
                // Where nothing else is than this wall.
                false => (0, ALL_BITS & !(bit as u32)),
            };
            unsafe { gl.stencil_func(glow::EQUAL, reference, bits) };
            self.draw_masks(gl, masks, &view, number, wall);
            self.draw_penumbra(gl, masks, &view, wall, look);
        }
        unsafe {
            gl.disable(glow::BLEND);
            gl.disable(glow::STENCIL_TEST);
        }
        masks.to_window(gl);
    }

    /// Everything once, as all lights light it in the mean.
    fn draw_what_stays(&self, gl: &glow::Context, view: &View, look: &Look) {
        unsafe { gl.stencil_func(glow::ALWAYS, HIDES_WALLS, ALL_BITS) };
        self.position_and_draw_light(gl, look);

        let program = &self.programs.fast.wall;
        unsafe { gl.use_program(Some(program.handle)) };
        program.set(gl, "numJitters", self.num_jitters() as i32);
        set_light(gl, program, look);
        self.bind_wall(gl);
        for (number, wall) in self.shown().enumerate() {
            unsafe { gl.stencil_func(glow::ALWAYS, wall_bit(number), ALL_BITS) };
            self.set_wall(gl, program, view, wall, look);
            self.draw_wall(gl);
        }

        let program = &self.programs.fast.lighting;
        unsafe {
            gl.stencil_func(glow::ALWAYS, HIDES_WALLS, ALL_BITS);
            gl.use_program(Some(program.handle));
        }
        program.set(gl, "numJitters", self.num_jitters() as i32);
        self.draw_occluders(gl, program, view, look);
    }

    /// The occluders that may come between the wall and one of the lights: a part of them is nearer to the wall.
    fn casters(&self, wall: &Wall) -> impl Iterator<Item = &Occluder> {
        let amount = self.settings.number("jitter_amount");
        let reach = amount * wall.plane.truncate().abs().element_sum();
        let farthest = wall.plane.dot(self.light().extend(1.0)) + reach;
        let casters = self.occluders.iter().filter(|o| o.object.casts);
        casters.filter(move |occluder| {
            let plane = occluder.model(self.rotation).transpose() * wall.plane;
            occluder.least(plane) < farthest
        })
    }

    /// A bit for each light at each pixel that it does not reach. Where shadows of one light overlap, the first one is
    /// enough: the others have the same depth. The next light is nearer.
    fn draw_masks(
        &self,
        gl: &glow::Context,
        masks: &Masks,
        view: &View,
        number: usize,
        wall: &Wall,
    ) {
        let program = &self.programs.fast.mask;
        let behind = |o: &Occluder| o.least(o.model(self.rotation).transpose() * wall.plane) < 0.0;
        let reaches_behind = self.casters(wall).any(behind);
        unsafe {
            gl.use_program(Some(program.handle));
            gl.blend_func(glow::ONE, glow::ONE);
            if reaches_behind {
                gl.enable(glow::CLIP_DISTANCE0);
            }
        }
        let lights = self.num_jitters();
        let mut drawn: Option<&Occluder> = None;
        for index in 0..lights {
            let (mask, place) = (index / LIGHTS_PER_MASK, index % LIGHTS_PER_MASK);
            let depth = 1.0 - (number * lights + index + 1) as f64 / DEPTHS;
            unsafe {
                if place == 0 {
                    gl.bind_framebuffer(glow::FRAMEBUFFER, Some(masks.framebuffers[mask]));
                    gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.0; 4]);
                }
                gl.depth_range_f64(depth, depth);
            }
            let mut bit = [0.0; 4];
            bit[place / 8] = f64::from(1 << (place % 8)) / 255.0;
            program.set(gl, "bit", DVec4::from_array(bit));
            // Made as the handout's method makes it, to the last bit.
            let jittered = self.view(view.light + masks.jitters[index]);
            for occluder in self.casters(wall) {
                let (to_clip, wall) = self.projection(&jittered, wall, occluder);
                program.set(gl, "modelViewProjection", to_clip);
                program.set(gl, "wall", wall);
                if !drawn
                    .replace(occluder)
                    .is_some_and(|last| std::ptr::eq(last, occluder))
                {
                    occluder.buffers.bind(gl);
                }
                occluder.buffers.draw_again(gl);
            }
        }
        unsafe {
            gl.depth_range_f64(0.0, 1.0);
            if reaches_behind {
                gl.disable(glow::CLIP_DISTANCE0);
            }
        }
    }

    /// The wall again, where one of the lights at least is hidden.
    fn draw_penumbra(
        &self,
        gl: &glow::Context,
        masks: &Masks,
        view: &View,
        wall: &Wall,
        look: &Look,
    ) {
        let program = &self.programs.fast.penumbra;
        // The points of the near plane at the corners of the window, as the eye sees them.
        let from_clip = view.from_eye.inverse();
        let ray = DMat3::from_cols(
            from_clip.x_axis.truncate(),
            from_clip.y_axis.truncate(),
            (from_clip.w_axis - from_clip.z_axis).truncate(),
        );
        let to_wall = DMat4::from_translation(-view.light) * wall.placement;
        let eye: DVec3 = self.scene.camera.eye - view.light;
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(masks.frame));
            gl.use_program(Some(program.handle));
            gl.blend_func(glow::ONE, glow::SRC_ALPHA);
            gl.disable(glow::DEPTH_TEST);
        }
        program.set(gl, "masks", 0);
        program.set(gl, "numJitters", self.num_jitters() as i32);
        program.set(gl, "ray", ray);
        program.set(gl, "eye", eye);
        program.set(gl, "wall", plane_from(view.light, wall.plane));
        program.set(gl, "wallFromWorld", to_wall.inverse());
        set_light(gl, program, look);
        program.set(gl, "material", look.material(wall.color));
        program.set(gl, "shadowColor", look.shadow(wall));
        masks.draw_quad(gl);
        unsafe {
            gl.enable(glow::DEPTH_TEST);
        }
    }
}
