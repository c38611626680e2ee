//! The fast method's shadows on one wall: the umbra at once, a bit for each light elsewhere, and what the bits come to.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3, DVec4};
use glow::HasContext;

use super::Eecs487;
use super::draw_scene::View;
use super::look::{Look, set_light};
use super::masks::{LIGHTS_PER_MASK, Masks};
use super::scene::Wall;
use super::selection::Selection;
use super::settings::MOST_JITTERS;
use super::shadow_matrix::plane_from;

/// Each light's shadows on each wall have a depth of their own, from the far end on: so many steps are enough.
const DEPTHS: f64 = (8 * MOST_JITTERS) as f64;

impl Eecs487 {
    /// A bit for each light at each pixel that it does not reach. Where shadows of one light overlap, the first one is
    /// enough: the others have the same depth. The next light is nearer.
    pub(super) fn draw_masks(
        &self,
        gl: &glow::Context,
        masks: &Masks,
        selection: &Selection,
        view: &View,
        wall: &Wall,
    ) {
        let program = &self.programs.fast.mask;
        let number = wall.number();
        let is_cut = selection.is_cut(number);
        unsafe {
            gl.use_program(Some(program.handle));
            gl.blend_func(glow::ONE, glow::ONE);
            if is_cut {
                gl.enable(glow::CLIP_DISTANCE0);
            }
        }
        let lights = self.num_jitters();
        let mut bound = None;
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
            for (caster, occluder) in self.occluders.iter().enumerate() {
                if !selection.casts(caster, number) {
                    continue;
                }
                let (to_clip, wall) = self.projection(&jittered, wall, occluder);
                program.set(gl, "modelViewProjection", to_clip);
                program.set(gl, "wall", wall);
                if bound.replace(caster) != Some(caster) {
                    selection.bind_caster(gl, caster);
                }
                selection.draw_caster(gl, caster, number);
            }
        }
        unsafe {
            gl.depth_range_f64(0.0, 1.0);
            if is_cut {
                gl.disable(glow::CLIP_DISTANCE0);
            }
        }
    }

    /// The wall again, where one of the lights at least is hidden.
    pub(super) fn draw_penumbra(
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
