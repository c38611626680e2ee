//! The offset test: the best that one plain depth map can do with no constant that depends on the scene.
//!
//! | step | here |
//! |---|---|
//! | which meshes can cast onto something | `shape.rs` |
//! | the map's camera, fitted to what they cover of the light's view | `fit.rs` |
//! | the first pass, with `glPolygonOffset` | in the lab |
//! | the test | `glsl/shadow_tests/offset.frag` |
//!
//! The map knows the depth of one point of each texel, its centre; what is asked about lies elsewhere in the texel. Of a
//! surface with the slopes a = |dz/dx| and b = |dz/dy|, in depth per texel, that is up to (a + b)/2 nearer or farther:
//! half of a lit surface is behind its own map. Two rules, of which one is enough for a point to be lit, mend that:
//!
//! - The point's depth is not behind the map's, which `glPolygonOffset` has put farther by the *caster's* slope. It
//!   is right where a surface meets itself, and where two of them meet in a concave edge.
//! - The plane of the point's own triangle is not behind the map's depth at the texel's centre, where it was stored. It
//!   is right where a surface meets itself, and where two of them meet in a convex edge: the *receiver's* slope, which
//!   may be the steeper one, is in it.
//!
//! Neither leaves a constant to be chosen. What is left falls short by no more than a texel: the map's resolution.
//!
//! SAFETY: see [`crate::gl`]; every call here has the current context and passes no pointer of its own.
#![allow(unsafe_code)]

mod fit;
mod shape;

use glam::DVec3;
use glow::HasContext;

pub use fit::{Casts, Fit, Fitter};

use crate::gl::Program;
use crate::scene::{Light, LightKind};
use crate::shadow_tests::Placed;

/// The file of [`super::SHADERS`]; one of [`Taps`] belongs to it.
pub const SHADER: &str = "shadow_tests/offset.frag";

/// The uniforms of a program with one fitted map.
pub const FITTED_MAP: [&str; 3] = [
    "fitted_map.depths",
    "fitted_map.rectangle",
    "fitted_map.nearness",
];

/// The second number of `glPolygonOffset`, in what the depth format can tell apart: the stored depth and the point's are
/// each rounded when they are projected, interpolated and stored.
pub const UNITS: f32 = 4.0;
/// How far the rasteriser moves a vertex on its way to a grid point, in texels; the point's own place is as unsure.
const SNAP: f32 = 1.0 / 256.0;

/// Which texels are asked about a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Taps {
    /// The one around it.
    One,
    /// Its own and one on each side, whose mean is taken.
    Five,
    /// And the four at its corners.
    Nine,
}

impl Taps {
    /// The first number of `glPolygonOffset`: how far away a texel's centre is, across and up together, in texels. GL
    /// takes the larger one of the two slopes for both.
    pub fn factor(self) -> f32 {
        let reach = match self {
            Self::One => 0.5 + 0.5,
            Self::Five => 1.5 + 0.5,
            Self::Nine => 1.5 + 1.5,
        };
        reach + 2.0 * SNAP
    }

    /// The file of [`super::SHADERS`].
    pub fn shader(self) -> &'static str {
        match self {
            Self::One => "shadow_tests/offset_one.frag",
            Self::Five => "shadow_tests/offset_five.frag",
            Self::Nine => "shadow_tests/offset_nine.frag",
        }
    }
}

/// Culls back faces or not, where that is a change; returns what then holds.
pub fn set_culling(gl: &glow::Context, wanted: bool, now: bool) -> bool {
    unsafe {
        match (wanted, now) {
            (true, false) => gl.enable(glow::CULL_FACE),
            (false, true) => gl.disable(glow::CULL_FACE),
            _ => (),
        }
    }
    wanted
}

/// Everything that decides what the map holds.
#[derive(PartialEq)]
struct Inputs {
    kind: LightKind,
    position: DVec3,
    direction: DVec3,
    scene: Vec<Placed>,
    size: u32,
    taps: Taps,
}

/// A fitted map as far as no driver is needed.
#[derive(Default)]
pub struct OffsetTest {
    fitter: Fitter,
    /// What the map was drawn from, while that still holds.
    fitted: Option<(Inputs, Fit)>,
}

impl OffsetTest {
    /// Fits the map if the light or something in the scene has moved, or `always`; says whether it has to be drawn.
    /// `scene` is in the order in which it is drawn.
    pub fn prepare(
        &mut self,
        light: &Light,
        scene: Vec<Placed>,
        size: u32,
        taps: Taps,
        always: bool,
    ) -> bool {
        let inputs = Inputs {
            kind: light.kind,
            position: light.position,
            direction: light.direction,
            scene,
            size,
            taps,
        };
        let fitted = self.fitted.as_ref();
        if !always && fitted.is_some_and(|(fitted, _)| *fitted == inputs) {
            return false;
        }
        let fit = self.fitter.fit(light, &inputs.scene, size);
        self.fitted = Some((inputs, fit));
        true
    }

    /// The map is gone, or something else was drawn into it.
    pub fn forget(&mut self) {
        self.fitted = None;
    }

    pub fn fit(&self) -> &Fit {
        &self.fitted().1
    }

    fn fitted(&self) -> &(Inputs, Fit) {
        self.fitted
            .as_ref()
            .expect("a frame prepares the test first")
    }

    /// Tells a program, which must be in use, of the map that is bound to this texture unit. The uniforms are those of a
    /// `FittedMap`, as [`FITTED_MAP`] has them.
    pub fn send(
        &self,
        gl: &glow::Context,
        program: &Program,
        uniforms: &[&'static str; 3],
        unit: i32,
    ) {
        let (inputs, fit) = self.fitted();
        let [depths, rectangle, nearness] = *uniforms;
        program.set(gl, depths, unit);
        program.set(gl, rectangle, fit.rectangle(inputs.size));
        program.set(gl, nearness, fit.depths(inputs.size));
    }

    /// How much of the light's own field of view (or box) the map covers, across and up.
    pub fn share(&self) -> [f64; 2] {
        let (inputs, fit) = self.fitted();
        let covered = fit.most - fit.least;
        match inputs.kind {
            LightKind::Directional {
                area: [left, right, bottom, top],
            } => {
                let unit = fit.space.unit;
                [
                    unit * covered.x / (right - left),
                    unit * covered.y / (top - bottom),
                ]
            }
            LightKind::Spot { .. } | LightKind::Point { .. } => (0.5 * covered).to_array(),
        }
    }

    /// Its near and far plane, in world units.
    pub fn planes(&self) -> [f64; 2] {
        let fit = self.fit();
        [fit.near, fit.far].map(|distance| fit.space.unit * distance)
    }
}
