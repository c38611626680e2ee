//! What is drawn between two pictures, pass by pass.
//!
//! A pass is what is drawn into one framebuffer without another one between. Of each draw call is kept what the checks
//! look at, up to a number that a lab's scene does not reach.

use std::collections::HashMap;
use std::rc::Rc;

use glam::DMat4;

use super::objects::{Framebuffer, Id, Matrix, Program, Sampler, Set, Texture};
use super::state::{Cleared, Pipeline, State};

/// So many passes, draw calls of a pass, and other steps are kept of a frame. Behind that they are counted only.
const MOST_PASSES: usize = 256;
const MOST_DRAWS: usize = 512;
const MOST_STEPS: usize = 4096;

#[derive(Clone, Default)]
pub struct Frame {
    /// The lines that it is about.
    pub first: u64,
    pub last: u64,
    pub passes: Vec<Pass>,
    pub draws: u64,
    /// By framebuffer: the last clearing of its depth.
    cleared: HashMap<Id, Clear>,
    /// All clearings, accumulations and copies.
    pub steps: Vec<Step>,
}

#[derive(Clone)]
pub struct Pass {
    pub target: Set<Id>,
    /// None for the window.
    pub framebuffer: Option<Rc<Framebuffer>>,
    /// Where its depths go, with the texture as it is.
    pub map: Option<(Id, Rc<Texture>)>,
    /// The line of its first draw call.
    pub first: u64,
    pub last: u64,
    pub count: u64,
    pub draws: Vec<Draw>,
    /// How its depth was cleared before, in this frame.
    pub clear: Option<Clear>,
    /// A clearing of its depth behind the first draw call.
    pub late_clear: Option<Clear>,
}

#[derive(Clone, Debug)]
pub struct Clear {
    pub line: u64,
    /// The line that turned the depth mask off, where it is off.
    pub mask_off: Option<u64>,
    /// What it was cleared with, 1 by default.
    pub depth: Set<f64>,
}

#[derive(Clone)]
pub struct Draw {
    pub line: u64,
    /// The same for the same mesh.
    pub mesh: String,
    /// None for the fixed pipeline.
    pub program: Option<Rc<Program>>,
    /// The line that chose it.
    pub used: u64,
    pub pipeline: Rc<Pipeline>,
    /// The program's matrices.
    pub matrices: Vec<Matrix>,
    pub fixed: Fixed,
    /// The fixed pipeline's factor that projects onto a plane, and its line.
    pub projector: Option<(u64, DMat4)>,
    /// What the program's samplers read.
    pub samplers: Vec<Reading>,
    /// What is bound, by unit.
    pub units: Vec<(i64, Set<Id>)>,
}

/// The matrices of the fixed pipeline.
#[derive(Clone)]
pub struct Fixed {
    pub modelview: Set<DMat4>,
    pub projection: Set<DMat4>,
    /// Of the units whose matrix was ever changed.
    pub textures: Vec<Set<DMat4>>,
}

/// A sampler, and the texture at its unit.
#[derive(Clone)]
pub struct Reading {
    pub sampler: Sampler,
    pub texture: Option<(Set<Id>, Rc<Texture>)>,
    /// The line that last bound something at its unit.
    pub bound: u64,
}

#[derive(Clone, Debug)]
pub struct Step {
    pub line: u64,
    pub what: StepKind,
}

#[derive(Clone, Debug)]
pub enum StepKind {
    Clear {
        target: Id,
        color: bool,
        depth: bool,
        stencil: bool,
        accumulation: bool,
    },
    Accumulate {
        operation: String,
        value: f64,
    },
    Blit {
        from: Id,
        to: Id,
    },
}

impl Frame {
    pub fn beginning_at(line: u64) -> Self {
        Self {
            first: line,
            ..Self::default()
        }
    }

    pub fn clear(&mut self, line: u64, cleared: &Cleared, state: &State) {
        let target = cleared.framebuffer.clone();
        self.step(
            line,
            StepKind::Clear {
                target: target.clone(),
                color: cleared.color,
                depth: cleared.depth,
                stencil: cleared.stencil,
                accumulation: cleared.accumulation,
            },
        );
        if !cleared.depth {
            return;
        }
        let mask = &state.pipeline.depth_mask_off;
        let nearer = &state.pipeline.clear_nearer;
        let clear = Clear {
            line,
            mask_off: mask.value.then_some(mask.line),
            depth: Set::at(nearer.line, 1.0 - nearer.value),
        };
        let last = self.passes.last_mut();
        if let Some(pass) =
            last.filter(|pass| pass.target.value == target && pass.is_attached(state))
        {
            pass.late_clear = Some(clear.clone());
        }
        if self.cleared.len() < MOST_PASSES {
            self.cleared.insert(target, clear);
        }
    }

    pub fn step(&mut self, line: u64, what: StepKind) {
        if self.steps.len() < MOST_STEPS {
            self.steps.push(Step { line, what });
        }
    }

    pub fn draw(&mut self, line: u64, mesh: String, state: &State, kept: &mut Kept) {
        self.draws += 1;
        self.last = line;
        let target = &state.draw_framebuffer;
        let last = self.passes.last();
        let goes_on =
            last.is_some_and(|pass| pass.target.value == target.value && pass.is_attached(state));
        if !goes_on {
            if self.passes.len() >= MOST_PASSES {
                return;
            }
            let framebuffer = state
                .framebuffers
                .get(&target.value)
                .filter(|_| target.value != "0");
            let map = framebuffer.and_then(|framebuffer| {
                let id = framebuffer.depth_texture()?;
                Some((id.clone(), state.textures.get(id)?.clone()))
            });
            self.passes.push(Pass {
                target: target.clone(),
                framebuffer: framebuffer.cloned(),
                map,
                first: line,
                last: line,
                count: 0,
                draws: Vec::new(),
                clear: self.cleared.get(&target.value).cloned(),
                late_clear: None,
            });
        }
        let Some(pass) = self.passes.last_mut() else {
            return;
        };
        pass.last = line;
        pass.count += 1;
        if pass.draws.len() < MOST_DRAWS {
            pass.draws.push(kept.draw(line, mesh, state));
        }
    }
}

impl Pass {
    /// Whether its framebuffer still has what it was drawn into: each face of a cube is a pass of its own.
    fn is_attached(&self, state: &State) -> bool {
        let now = state.framebuffers.get(&self.target.value);
        self.framebuffer.as_ref().is_none_or(|framebuffer| {
            now.is_some_and(|now| now.attachments == framebuffer.attachments)
        })
    }
}

/// What did not change since the last draw call is shared with it.
#[derive(Default)]
pub struct Kept {
    pipeline: Option<Rc<Pipeline>>,
}

impl Kept {
    fn draw(&mut self, line: u64, mesh: String, state: &State) -> Draw {
        let same = self.pipeline.take().filter(|kept| **kept == state.pipeline);
        let pipeline = same.unwrap_or_else(|| Rc::new(state.pipeline.clone()));
        self.pipeline = Some(pipeline.clone());
        let program = state
            .programs
            .get(&state.program.value)
            .filter(|_| state.program.value != "0");
        let samplers = program
            .map(|program| program.samplers())
            .unwrap_or_default();
        let reading = |sampler: Sampler| Reading {
            texture: state.texture_at(sampler.unit.value, sampler.target()),
            bound: state.bound_at(sampler.unit.value),
            sampler,
        };
        Draw {
            line,
            mesh,
            program: program.cloned(),
            used: state.program.line,
            pipeline,
            matrices: program
                .map(|program| program.matrices())
                .unwrap_or_default(),
            fixed: Fixed {
                modelview: state.matrices.modelview(),
                projection: state.matrices.projection(),
                textures: state.matrices.textures().collect(),
            },
            projector: state.matrices.projector(),
            samplers: samplers.into_iter().map(reading).collect(),
            units: state.units(),
        }
    }
}

impl Draw {
    /// Whether its shader reads this texture, and by which sampler.
    pub fn reads(&self, texture: &Id) -> Option<&Reading> {
        self.samplers.iter().find(|reading| {
            reading
                .texture
                .as_ref()
                .is_some_and(|(id, _)| id.value == *texture)
        })
    }
}
