//! Sections 1 and 2: `drawScene()`. The light, the walls, wall by wall the shadows, and the occluders over them.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

use glam::{DMat3, DMat4, DVec3, DVec4, dvec2};
use glow::HasContext;

use super::Eecs487;
use super::look::{Look, set_light};
use super::occluders::Occluder;
use super::scene::{LIGHT_COLOR, LIGHT_RADIUS, Wall};
use super::shadow_matrix::{mult_shadow_mat, plane_from};
use crate::gl::{self, Program};
use crate::scene::camera;

/// A place of the light, and everything that a matrix needs that is made relative to it.
#[derive(Clone, Copy)]
pub struct View {
    pub light: DVec3,
    /// World space to clip space, the world's origin moved to the light, and to the eye.
    pub from_light: DMat4,
    pub from_eye: DMat4,
}

impl Eecs487 {
    pub(super) fn view(&self, light: DVec3) -> View {
        let camera = self.scene.camera;
        let aspect = f64::from(self.size[0]) / f64::from(self.size[1]);
        let look = camera::view(DVec3::ZERO, camera.look, camera.rup);
        // DEVIATES: origin, the products are made in f64 and rounded once, and the world's origin is moved to the light
        // or to the eye: far from it the f32 products of the fixed pipeline would cancel.
        let from_eye = camera.perspective(aspect) * look;
        View {
            light,
            from_light: from_eye * DMat4::from_translation(light - camera.eye),
            from_eye,
        }
    }

    /// The walls that are shown.
    pub(super) fn shown(&self) -> impl Iterator<Item = &Wall> {
        let only = self.settings.choice("clipped_to");
        let walls = self.walls.iter();
        walls.filter(move |wall| only == "all" || only == wall.name)
    }

    /// One rendering, into the framebuffer that is bound.
    #[doc(alias = "drawScene")]
    pub(super) fn draw_scene(&self, gl: &glow::Context, light: DVec3, look: &Look) {
        let view = self.view(light);
        let clipping = self.settings.switch("stencil_clipping");
        let stencil = if clipping {
            glow::STENCIL_BUFFER_BIT
        } else {
            0
        };
        unsafe { gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT | stencil) };
        self.position_and_draw_light(gl, look);

        let program = &self.programs.wall;
        unsafe { gl.use_program(Some(program.handle)) };
        set_light(gl, program, look);
        self.bind_wall(gl);
        for wall in self.shown() {
            self.set_wall(gl, program, &view, wall, look);
            self.draw_wall(gl);
        }

        let program = &self.programs.shadow;
        unsafe {
            gl.use_program(Some(program.handle));
            gl.enable(glow::CLIP_DISTANCE0);
            if clipping {
                gl.enable(glow::STENCIL_TEST);
            }
        }
        for (number, wall) in self.shown().enumerate() {
            program.set(gl, "planeDepth", self.plane_depth(&view, wall));
            if clipping {
                // Before the first wall's shadows its mesh is bound already.
                if number > 0 {
                    self.bind_wall(gl);
                }
                self.populate_stencil(gl, &view, wall);
            }
            program.set(gl, "shadowColor", look.shadow(wall));
            self.draw_shadows(gl, &view, wall);
        }
        unsafe {
            gl.disable(glow::CLIP_DISTANCE0);
            if clipping {
                gl.disable(glow::STENCIL_TEST);
            }
        }
        let program = &self.programs.lighting;
        unsafe { gl.use_program(Some(program.handle)) };
        self.draw_occluders(gl, program, &view, look);
    }

    /// Section 2: three steps of one call each leave 1 in the stencil buffer wherever the wall is, and let the shadows
    /// pass there alone.
    fn populate_stencil(&self, gl: &glow::Context, view: &View, wall: &Wall) {
        let program = &self.programs.shadow;
        program.set(gl, "modelViewProjection", self.wall_mvp(view, wall));
        // Nothing of the wall itself is behind it.
        program.set(gl, "wall", DVec4::W);
        unsafe {
            gl.color_mask(false, false, false, false);
            gl.disable(glow::DEPTH_TEST);

            // 1. Set the reference value to 1 and always accept a fragment.
            gl.stencil_func(glow::ALWAYS, 1, !0);
            // 2. Replace the contents with the reference value wherever a fragment of the wall is drawn.
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::REPLACE);
            self.draw_wall(gl);
            // 3. Accept a fragment only if it is within the boundaries of the wall.
            gl.stencil_func(glow::EQUAL, 1, !0);

            // DEVIATES: stencil operation, left at GL_REPLACE each shadow would write the 1 that is there already.
            gl.stencil_op(glow::KEEP, glow::KEEP, glow::KEEP);
            gl.color_mask(true, true, true, true);
            gl.enable(glow::DEPTH_TEST);
        }
    }

    /// Each occluder, projected onto the wall.
    #[doc(alias = "drawShadows")]
    fn draw_shadows(&self, gl: &glow::Context, view: &View, wall: &Wall) {
        let program = &self.programs.shadow;
        for occluder in self.occluders.iter().filter(|o| o.object.casts) {
            let (to_clip, wall) = self.projection(view, wall, occluder);
            program.set(gl, "modelViewProjection", to_clip);
            program.set(gl, "wall", wall);
            occluder.buffers.draw(gl);
        }
    }

    /// From the occluder's own space by way of `shadowMat` to clip space, and the wall's implicit function there.
    pub(super) fn projection(
        &self,
        view: &View,
        wall: &Wall,
        occluder: &Occluder,
    ) -> (DMat4, DVec4) {
        let plane = plane_from(view.light, wall.plane);
        let shadow_mat = mult_shadow_mat(plane, DVec3::ZERO);
        let model = DMat4::from_translation(-view.light) * occluder.model(self.rotation);
        (
            view.from_light * shadow_mat * model,
            model.transpose() * plane,
        )
    }

    /// The sphere stays at the light's own place, whatever the jitter.
    #[doc(alias = "positionAndDrawLight")]
    pub(super) fn position_and_draw_light(&self, gl: &glow::Context, look: &Look) {
        let program = &self.programs.light;
        let view = self.view(self.scene.lights[0].position);
        let sphere = DMat4::from_scale(DVec3::splat(LIGHT_RADIUS));
        unsafe { gl.use_program(Some(program.handle)) };
        program.set(gl, "modelViewProjection", view.from_light * sphere);
        program.set(gl, "lightColor", look.material(LIGHT_COLOR));
        self.sphere.draw(gl);
    }

    /// All walls have one mesh. A tessellation of 0 leaves none.
    pub(super) fn bind_wall(&self, gl: &glow::Context) {
        if let Some(mesh) = &self.wall_mesh {
            mesh.buffers.bind(gl);
        }
    }

    /// The mesh, as `set_wall` has placed it.
    #[doc(alias = "drawWall")]
    pub(super) fn draw_wall(&self, gl: &glow::Context) {
        if let Some(mesh) = &self.wall_mesh {
            mesh.buffers.draw_again(gl);
        }
    }

    #[doc(alias = "drawOccluders")]
    pub(super) fn draw_occluders(
        &self,
        gl: &glow::Context,
        program: &Program,
        view: &View,
        look: &Look,
    ) {
        set_light(gl, program, look);
        for occluder in &self.occluders {
            let model = occluder.model(self.rotation);
            self.set_model(gl, program, view, model);
            program.set(
                gl,
                "material",
                look.material(occluder.object.material.diffuse),
            );
            occluder.buffers.draw(gl);
        }
    }

    /// Places a wall and gives it its material.
    pub(super) fn set_wall(
        &self,
        gl: &glow::Context,
        program: &Program,
        view: &View,
        wall: &Wall,
        look: &Look,
    ) {
        self.set_model(gl, program, view, wall.placement);
        program.set(gl, "material", look.material(wall.color));
        program.set(gl, "planeDepth", self.plane_depth(view, wall));
    }

    fn set_model(&self, gl: &glow::Context, program: &Program, view: &View, model: DMat4) {
        let eye = self.scene.camera.eye;
        let from_eye = DMat4::from_translation(-eye) * model;
        program.set(gl, "modelViewProjection", view.from_eye * from_eye);
        let from_light = DMat4::from_translation(-view.light) * model;
        program.set(gl, "modelFromLight", from_light);
        let normal_matrix = DMat3::from_mat4(model).inverse().transpose();
        // Its length is nothing to the shader; kept near 1, it is nothing to f32 either.
        let scale = normal_matrix.x_axis.length();
        program.set(gl, "normalMatrix", normal_matrix * scale.recip());
    }

    pub(super) fn wall_mvp(&self, view: &View, wall: &Wall) -> DMat4 {
        let eye = self.scene.camera.eye;
        view.from_eye * DMat4::from_translation(-eye) * wall.placement
    }

    /// The depth that a wall's plane has at a pixel: its part for each pixel right and up, and at the bottom left corner.
    ///
    /// Planes stay planes in clip space: a x + b y + c z + d w = 0, so z/w is the same sum of x/w and y/w everywhere.
    pub(super) fn plane_depth(&self, view: &View, wall: &Wall) -> DVec3 {
        let plane = plane_from(self.scene.camera.eye, wall.plane);
        let in_clip = view.from_eye.inverse().transpose() * plane;
        let depth = -DVec3::new(in_clip.x, in_clip.y, in_clip.w) / in_clip.z;
        // −1…1 to 0…1 for the depth, and to pixels for the place.
        let per_pixel = depth.truncate() / dvec2(f64::from(self.size[0]), f64::from(self.size[1]));
        let corner = 0.5 + 0.5 * (depth.z - depth.x - depth.y);
        per_pixel.extend(corner)
    }
}

/// What the wall meshes are cut into, and the mesh on the GPU.
pub struct WallMesh {
    pub tessellation: u32,
    pub buffers: gl::Mesh,
}
