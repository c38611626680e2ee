//! A picture's calls, and those of the start-up, held against a handout.

mod faults;
mod first_pass;
mod light;
mod map;
mod picture;
mod planar;
mod soft;
mod uniforms;

use std::rc::Rc;

pub use faults::Fault;

use super::frame::{Draw, Frame, Pass};
use super::handouts::{self, Handout};
use super::objects::{Id, Texture};
use super::report::{Step, Steps};
use super::state::State;

/// A shadow map that the picture uses: the pass that drew it.
pub struct Map<'a> {
    pub id: &'a Id,
    pub texture: &'a Rc<Texture>,
    pub pass: &'a Pass,
    /// Drawn for an earlier picture.
    pub is_old: bool,
}

/// The draw calls of the second pass, and how they were found.
pub struct Second<'a> {
    /// Those that read the map, or else those that should.
    pub draws: Vec<&'a Draw>,
    pub pass: Option<&'a Pass>,
    /// They read it.
    pub reads: bool,
    /// They read the map while they draw into its framebuffer.
    pub attached: bool,
}

/// What the frame has of the lab's steps; `maps` are passes of earlier frames that drew into a depth texture.
pub fn judge(lab: &str, frame: &Frame, maps: &[Pass], state: &State) -> Vec<Step> {
    let mut steps = Steps { all: Vec::new() };
    match handouts::MAPS.iter().find(|handout| handout.lab == lab) {
        Some(handout) => shadow_maps(&mut steps, handout, frame, maps, state),
        None => planar::judge(&mut steps, frame, state),
    }
    // By place, in the handout's order, which is that of their first step.
    let mut places: Vec<&str> = Vec::new();
    let mut all: Vec<Step> = Vec::new();
    for step in steps.all {
        if !places.contains(&step.place) {
            places.push(step.place);
        }
        // What two maps share is told once.
        if !all.contains(&step) {
            all.push(step);
        }
    }
    all.sort_by_key(|step| places.iter().position(|place| *place == step.place));
    all
}

fn shadow_maps(steps: &mut Steps, handout: &Handout, frame: &Frame, old: &[Pass], state: &State) {
    let used = maps(frame, old);
    if used.is_empty() {
        map::no_map(steps, handout, state);
        uniforms::judge(steps, handout, frame, &[], state);
        return;
    }
    for map in &used {
        let second = second_pass(frame, map, &used);
        map::set_up(steps, handout, map, &second, state);
        first_pass::judge(steps, handout, map, &second, frame);
        picture::restored(steps, handout, map, &second, state);
        picture::cleared(steps, handout, &second, frame);
        picture::samplers(steps, handout, map, &second);
        light::judge(steps, handout, map, &second);
    }
    uniforms::judge(steps, handout, frame, &used, state);
}

/// The depth textures that are drawn into for a later look. Where one is drawn several times, the last one counts.
fn maps<'a>(frame: &'a Frame, old: &'a [Pass]) -> Vec<Map<'a>> {
    let mut used: Vec<Map> = Vec::new();
    let new = frame.passes.iter().map(|pass| (pass, false));
    for (pass, is_old) in new.chain(old.iter().map(|pass| (pass, true))) {
        let Some((id, texture)) = &pass.map else {
            continue;
        };
        let mut draws = frame.passes.iter().flat_map(|pass| &pass.draws);
        let is_read = draws.any(|draw| draw.reads(id).is_some());
        let framebuffer = pass.framebuffer.as_ref();
        let has_color = framebuffer.is_some_and(|framebuffer| framebuffer.color().is_some());
        // One of an earlier frame counts where it is read, or where there is no other.
        let counts = is_read || !has_color && (!is_old || used.is_empty());
        let map = Map {
            id,
            texture,
            pass,
            is_old,
        };
        match used.iter().position(|known| known.id == id) {
            Some(place) if counts && !is_old => used[place] = map,
            None if counts => used.push(map),
            _ => {}
        }
    }
    used
}

fn second_pass<'a>(frame: &'a Frame, map: &Map, maps: &[Map]) -> Second<'a> {
    let of = |wanted: &dyn Fn(&Pass, &Draw) -> bool| -> (Vec<&'a Draw>, Option<&'a Pass>) {
        let draws = frame
            .passes
            .iter()
            .flat_map(|pass| pass.draws.iter().map(move |draw| (pass, draw)));
        let all: Vec<_> = draws.filter(|(pass, draw)| wanted(pass, draw)).collect();
        // Behind the map, or, where the map is for the next frame, all of them.
        let is_behind = |(pass, _): &&(&Pass, &Draw)| map.is_old || pass.last > map.pass.last;
        let behind: Vec<_> = all.iter().filter(is_behind).copied().collect();
        let counted = if behind.is_empty() { all } else { behind };
        let first = counted.first().map(|(pass, _)| *pass);
        (counted.into_iter().map(|(_, draw)| draw).collect(), first)
    };
    let into_map = |pass: &Pass| {
        pass.framebuffer
            .as_ref()
            .is_some_and(|framebuffer| framebuffer.holds(map.id))
    };
    let into_any_map = |pass: &Pass| {
        maps.iter().any(|map| {
            pass.framebuffer
                .as_ref()
                .is_some_and(|framebuffer| framebuffer.holds(map.id))
        })
    };

    let (draws, pass) = of(&|pass, draw| !into_map(pass) && draw.reads(map.id).is_some());
    if pass.is_some() {
        return Second {
            draws,
            pass,
            reads: true,
            attached: false,
        };
    }
    let (draws, pass) = of(&|pass, draw| into_map(pass) && draw.reads(map.id).is_some());
    if pass.is_some() {
        return Second {
            draws,
            pass,
            reads: true,
            attached: true,
        };
    }
    // Nothing reads the map: then what has a sampler for it should.
    let (draws, pass) = of(&|pass, draw| {
        !into_any_map(pass)
            && draw
                .samplers
                .iter()
                .any(|reading| is_for_a_map(&reading.sampler))
    });
    if pass.is_some() {
        return Second {
            draws,
            pass,
            reads: false,
            attached: false,
        };
    }
    let (draws, pass) = of(&|pass, draw| !into_any_map(pass) && !draw.samplers.is_empty());
    if pass.is_some() {
        return Second {
            draws,
            pass,
            reads: false,
            attached: false,
        };
    }
    let (draws, pass) = of(&|pass, _| !into_any_map(pass));
    Second {
        draws,
        pass,
        reads: false,
        attached: false,
    }
}

/// As its name or its type says.
fn is_for_a_map(sampler: &super::objects::Sampler) -> bool {
    let name = sampler.name.to_lowercase();
    sampler.is_shadow() == Some(true)
        || ["shadow", "depth", "map"]
            .iter()
            .any(|word| name.contains(word))
}
