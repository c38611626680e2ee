//! The shaders, and which uniforms the lab sets in them.

use std::rc::Rc;

use crate::Result;
use crate::gl::trace::{ObjectKind, name_object};
use crate::gl::{self, Program, Shaders};

/// The shaders, which are the lesson's other half.
pub const SHADERS: &[(&str, &str)] = &[
    (
        "lighting.vert",
        include_str!("../../../glsl/eecs487/lighting.vert"),
    ),
    (
        "lighting.frag",
        include_str!("../../../glsl/eecs487/lighting.frag"),
    ),
    ("wall.frag", include_str!("../../../glsl/eecs487/wall.frag")),
    (
        "light.vert",
        include_str!("../../../glsl/eecs487/light.vert"),
    ),
    (
        "light.frag",
        include_str!("../../../glsl/eecs487/light.frag"),
    ),
    (
        "shadow.vert",
        include_str!("../../../glsl/eecs487/shadow.vert"),
    ),
    (
        "shadow.frag",
        include_str!("../../../glsl/eecs487/shadow.frag"),
    ),
    ("quad.vert", include_str!("../../../glsl/eecs487/quad.vert")),
    (
        "accum.frag",
        include_str!("../../../glsl/eecs487/accum.frag"),
    ),
    (
        "accum_s8.frag",
        include_str!("../../../glsl/eecs487/accum_s8.frag"),
    ),
    (
        "return_s8.frag",
        include_str!("../../../glsl/eecs487/return_s8.frag"),
    ),
    ("ramp.frag", include_str!("../../../glsl/eecs487/ramp.frag")),
    ("mean.vert", include_str!("../../../glsl/eecs487/mean.vert")),
    ("mask.frag", include_str!("../../../glsl/eecs487/mask.frag")),
    (
        "penumbra.frag",
        include_str!("../../../glsl/eecs487/penumbra.frag"),
    ),
];

/// What lighting.vert and mean.vert have in common.
const LIGHTING: [&str; 6] = [
    "modelViewProjection",
    "modelFromLight",
    "normalMatrix",
    "material",
    "ambient",
    "diffuse",
];

/// All of the lab's programs: those of sections 1 and 2 here.
pub struct Programs {
    pub accumulation: Rc<Accumulation>,
    pub fast: Fast,
    pub lighting: Program,
    pub wall: Program,
    pub light: Program,
    pub shadow: Program,
}

/// Sections 3 to 5.
pub struct Accumulation {
    pub accum: Program,
    pub accum_s8: Program,
    pub return_s8: Program,
    pub ramp: Program,
}

/// The fast method.
pub struct Fast {
    pub lighting: Program,
    pub wall: Program,
    pub mask: Program,
    pub penumbra: Program,
}

/// Where the fast method's block of uniforms is bound.
pub const JITTERS: u32 = 0;

/// Makes programs for one of the structs above.
fn make<const N: usize>(
    gl: &glow::Context,
    shaders: &Shaders,
    wanted: [(&str, &str, &str, &[&'static str]); N],
) -> Result<[Program; N]> {
    let mut made: Vec<Program> = Vec::new();
    for (name, vertex, fragment, uniforms) in wanted {
        let program = Program::new(gl, shaders, vertex, fragment, uniforms);
        // All or none: a lab never draws with half of its shaders.
        let program = program.inspect_err(|_| made.iter().for_each(|made| made.delete(gl)))?;
        name_object(ObjectKind::Program, program.handle.0.get(), name);
        made.push(program);
    }
    Ok(made.try_into().ok().expect("as many as wanted"))
}

impl Programs {
    pub fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let _pass = gl::pass(gl, "set-up: shaders");
        let on_wall = [&LIGHTING[..], &["planeDepth"]].concat();
        let sphere = ["modelViewProjection", "lightColor"];
        let projected = ["modelViewProjection", "wall", "shadowColor", "planeDepth"];
        let [lighting, wall, light, shadow] = make(
            gl,
            shaders,
            [
                ("lighting", "lighting.vert", "lighting.frag", &LIGHTING),
                ("wall", "lighting.vert", "wall.frag", &on_wall),
                ("light", "light.vert", "light.frag", &sphere),
                ("shadow", "shadow.vert", "shadow.frag", &projected),
            ],
        )?;
        let own = [&lighting, &wall, &light, &shadow];
        let refused = || own.iter().for_each(|program| program.delete(gl));
        let accumulation = Accumulation::new(gl, shaders).inspect_err(|_| refused())?;
        let fast = Fast::new(gl, shaders).inspect_err(|_| {
            accumulation.delete(gl);
            refused();
        })?;
        Ok(Self {
            accumulation: Rc::new(accumulation),
            fast,
            lighting,
            wall,
            light,
            shadow,
        })
    }

    pub fn delete(&self, gl: &glow::Context) {
        for program in [&self.lighting, &self.wall, &self.light, &self.shadow] {
            program.delete(gl);
        }
        self.accumulation.delete(gl);
        self.fast.delete(gl);
    }
}

impl Accumulation {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let signed = ["frame", "accumulated", "weight"];
        let [accum, accum_s8, return_s8, ramp] = make(
            gl,
            shaders,
            [
                ("accum", "quad.vert", "accum.frag", &["frame"]),
                ("accum_s8", "quad.vert", "accum_s8.frag", &signed),
                ("return_s8", "quad.vert", "return_s8.frag", &signed[1..]),
                ("ramp", "quad.vert", "ramp.frag", &[]),
            ],
        )?;
        Ok(Self {
            accum,
            accum_s8,
            return_s8,
            ramp,
        })
    }

    fn delete(&self, gl: &glow::Context) {
        for program in [&self.accum, &self.accum_s8, &self.return_s8, &self.ramp] {
            program.delete(gl);
        }
    }
}

impl Fast {
    fn new(gl: &glow::Context, shaders: &Shaders) -> Result<Self> {
        let mean = [&LIGHTING[..], &["numJitters"]].concat();
        let on_wall = [&mean[..], &["planeDepth"]].concat();
        let mask = ["modelViewProjection", "wall", "bit"];
        let penumbra = [
            "masks",
            "numJitters",
            "ray",
            "eye",
            "wall",
            "wallFromWorld",
            "material",
            "ambient",
            "diffuse",
            "shadowColor",
        ];
        let [lighting, wall, mask, penumbra] = make(
            gl,
            shaders,
            [
                ("mean_lighting", "mean.vert", "lighting.frag", &mean),
                ("mean_wall", "mean.vert", "wall.frag", &on_wall),
                ("mask", "shadow.vert", "mask.frag", &mask),
                ("penumbra", "quad.vert", "penumbra.frag", &penumbra),
            ],
        )?;
        for program in [&lighting, &wall, &penumbra] {
            program.bind_block(gl, "Jitters", JITTERS);
        }
        Ok(Self {
            lighting,
            wall,
            mask,
            penumbra,
        })
    }

    fn delete(&self, gl: &glow::Context) {
        for program in [&self.lighting, &self.wall, &self.mask, &self.penumbra] {
            program.delete(gl);
        }
    }
}
