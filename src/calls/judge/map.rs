//! How the shadow map is made: the depth texture and its framebuffer.

use super::faults::{INCOMPLETE, NO_IMAGE, NO_MAP, NOTHING_DRAWN, READ_BUFFER, UNCHECKED};
use super::{Map, Second};
use crate::calls::frame::{Pass, Reading};
use crate::calls::handouts::Handout;
use crate::calls::objects::{Attachment, Framebuffer, Id, Parameter, Texture};
use crate::calls::report::{Asked, Mark, Steps};
use crate::calls::state::State;

pub const DRAW: &str = "draw what casts a shadow into the depth texture";

/// Nothing is drawn into a depth texture: why not, as far as one can see.
pub fn no_map(steps: &mut Steps, handout: &Handout, state: &State) {
    let step = (handout.set_up, "a framebuffer object with a depth texture");
    let framebuffers = state.framebuffers.iter().filter(|(id, _)| *id != "0");
    if let Some((line, told, drawn)) = framebuffers
        .filter_map(|(id, framebuffer)| not_a_map(id, framebuffer, state))
        .min()
    {
        if drawn {
            return steps.fault(
                (handout.first_pass, DRAW),
                Mark::Missing,
                line,
                told,
                &NOTHING_DRAWN,
            );
        }
        return steps.fault(step, Mark::OtherArguments, line, told, &NO_MAP);
    }
    let made = state
        .textures
        .iter()
        .find(|(_, texture)| texture.holds_depth());
    let (line, told) = match made {
        Some((id, texture)) => (
            texture.image.as_ref().map_or(0, |image| image.line),
            format!("the depth texture {id} is attached to no framebuffer"),
        ),
        None => (0, "there is no depth texture".to_owned()),
    };
    steps.fault(step, Mark::Missing, line, told, &NO_MAP);
}

/// Why nothing was drawn to this framebuffer's depth texture, with a line; and whether it has one.
fn not_a_map(id: &Id, framebuffer: &Framebuffer, state: &State) -> Option<(u64, String, bool)> {
    if framebuffer.depth_texture().is_some() {
        let line = framebuffer.depth()?.line;
        let told = format!("framebuffer {id} has one, and no draw call goes into it");
        return Some((line, told, true));
    }
    for (point, attachment) in &framebuffer.attachments {
        if let Attachment::Texture { id: texture, .. } = &attachment.value
            && state
                .textures
                .get(texture)
                .is_some_and(|texture| texture.holds_depth())
        {
            let told = format!("the depth texture {texture} is attached as {point}");
            return Some((attachment.line, told, false));
        }
    }
    let line = framebuffer.depth()?.line;
    let told = format!("framebuffer {id} keeps its depth in a renderbuffer, which no shader reads");
    Some((line, told, false))
}

pub fn set_up(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, state: &State) {
    let place = handout.set_up;
    let Some(framebuffer) = &map.pass.framebuffer else {
        return;
    };
    let id = map.id;
    let read = second.draws.iter().find_map(|draw| draw.reads(id));

    let step = (place, "glTexImage2D(…, GL_DEPTH_COMPONENT, …)");
    match &map.texture.image {
        Some(image) => {
            let (width, height, format) = &image.value;
            steps.found(
                step,
                image.line,
                format!("texture {id}, {width}×{height}, {format}"),
            );
        }
        None => {
            let told = format!("texture {id} has no image");
            steps.fault(step, Mark::Missing, 0, told, &NO_IMAGE);
        }
    }
    // A sampler object may have a say in the parameters: so they are taken as they are read. Where nothing reads the
    // map, which object would is not known.
    let seen = read
        .and_then(|reading| reading.texture.as_ref())
        .map(|(_, texture)| texture);
    if let Some(texture) = seen.or(Some(map.texture).filter(|_| !state.has_sampler_objects())) {
        filters(
            steps,
            (place, "GL_TEXTURE_MIN_FILTER without mipmaps"),
            texture,
        );
        wrap_mode(steps, handout, texture);
        comparison(steps, handout, texture, read);
        swizzle(steps, handout, texture, read, state);
    }

    if let Some(depth) = framebuffer.depth() {
        let told = format!("to framebuffer {}", map.pass.target.value);
        steps.found((place, "attached as GL_DEPTH_ATTACHMENT"), depth.line, told);
    }
    buffers(steps, (place, "glDrawBuffer(GL_NONE)"), framebuffer);
    complete(steps, handout, map.pass);
}

fn filters(steps: &mut Steps, step: Asked, texture: &Texture) {
    let filter = texture.word("GL_TEXTURE_MIN_FILTER");
    let level = texture.parameters.get("GL_TEXTURE_MAX_LEVEL");
    let one_level = level.is_some_and(|set| set.value == Parameter::Word("GL_NONE".to_owned()));
    let has_its_levels = texture.has_mipmaps || texture.is_immutable || one_level;
    if !filter.value.contains("MIPMAP") || has_its_levels {
        return steps.found(step, filter.line, filter.value);
    }
    let (mark, line, told) = match filter.line {
        0 => {
            let line = texture.image.as_ref().map_or(0, |image| image.line);
            (Mark::Missing, line, format!("it stays at {}", filter.value))
        }
        line => (Mark::OtherArguments, line, filter.value),
    };
    steps.mistake(step, mark, line, "mipmap_filter", told);
}

fn wrap_mode(steps: &mut Steps, handout: &Handout, texture: &Texture) {
    let step = (handout.set_up, "a wrap mode that does not repeat");
    let wrap = ["S", "T"].map(|axis| texture.word(&format!("GL_TEXTURE_WRAP_{axis}")));
    let Some(repeats) = wrap.iter().find(|mode| mode.value.contains("REPEAT")) else {
        return steps.found(step, wrap[0].line, wrap[0].value.clone());
    };
    let (mark, told) = match repeats.line {
        0 => (Mark::Missing, format!("it stays at {}", repeats.value)),
        _ => (Mark::OtherArguments, repeats.value.clone()),
    };
    if handout.asks_range {
        // The handout does without, because its shader asks where the point is.
        let told = told + ": right, where the shader asks whether uv is in [0, 1]";
        return steps.mistake(step, Mark::Unclear, repeats.line, "repeat_outside", told);
    }
    steps.mistake(step, mark, repeats.line, "repeat_outside", told);
}

fn comparison(steps: &mut Steps, handout: &Handout, texture: &Texture, read: Option<&Reading>) {
    let step = (
        handout.set_up,
        "GL_TEXTURE_COMPARE_MODE as the sampler's type wants it",
    );
    let Some(sampler) = read.map(|reading| &reading.sampler) else {
        return;
    };
    let compares = texture.compares();
    let (line, name) = (compares.line, &sampler.name);
    match (compares.value, sampler.is_shadow()) {
        (true, Some(true)) => steps.found(step, line, format!("{name} is a sampler2DShadow")),
        (true, Some(false)) => {
            let told = format!("the texture compares, and {name} is no sampler2DShadow");
            steps.mistake(step, Mark::Wrong, line, "compare_mode", told);
        }
        (false, Some(true)) => {
            let told = format!("{name} is a sampler2DShadow, and the texture does not compare");
            steps.mistake(step, Mark::Missing, line, "compare_mode", told);
        }
        // The source is not in the dump; the handouts' samplers are plain.
        (true, None) => {
            let told = "the texture compares, and the handout's sampler2D does not";
            steps.mistake(step, Mark::Wrong, line, "compare_mode", told);
        }
        (false, _) => {}
    }
}

fn swizzle(
    steps: &mut Steps,
    handout: &Handout,
    texture: &Texture,
    read: Option<&Reading>,
    state: &State,
) {
    let step = (
        handout.set_up,
        "GL_TEXTURE_SWIZZLE_RGBA, or .r in the shader",
    );
    let Some(sampler) = read.map(|reading| &reading.sampler) else {
        return;
    };
    let is_read_so = |name: &str| {
        let mut sources = state
            .programs
            .values()
            .filter_map(|program| program.source.as_ref());
        sources.any(|source| source.beyond_red.iter().any(|read| read == name))
    };
    let wanted = match sampler.is_shadow() {
        // A compatibility profile gives the depth in every component.
        Some(false) => state.is_core && is_read_so(&sampler.name),
        Some(true) => false,
        // `shadowlab trace` has no sources, and its shaders are the handout's in a core profile.
        None => handout.reads_beyond_red,
    };
    if !wanted {
        return;
    }
    match texture.parameters.get("GL_TEXTURE_SWIZZLE") {
        Some(set) => steps.found(step, set.line, "set"),
        None => {
            let line = texture.image.as_ref().map_or(0, |image| image.line);
            let told = "the shader reads .z or .g in a core profile";
            steps.mistake(step, Mark::Missing, line, "no_swizzle", told);
        }
    }
}

fn buffers(steps: &mut Steps, step: Asked, framebuffer: &Framebuffer) {
    if let Some(color) = framebuffer.color() {
        let told = "not needed: the framebuffer has a color buffer";
        return steps.found(step, color.line, told);
    }
    let Some(chosen) = &framebuffer.draw_buffers else {
        let line = framebuffer.depth().map_or(0, |at| at.line);
        let told = "not called while the framebuffer was bound";
        return steps.mistake(step, Mark::Missing, line, "no_draw_buffer_none", told);
    };
    if !framebuffer.draws_no_color() {
        let told = "a color buffer is chosen that the framebuffer does not have";
        return steps.mistake(
            step,
            Mark::OtherArguments,
            chosen.line,
            "no_draw_buffer_none",
            told,
        );
    }
    let reads_none = framebuffer
        .read_buffer
        .as_ref()
        .is_some_and(|set| set.value);
    if reads_none {
        steps.found(step, chosen.line, "and glReadBuffer(GL_NONE)");
    } else {
        let told = "glReadBuffer(GL_NONE) is not called for the framebuffer";
        steps.fault(step, Mark::Unclear, chosen.line, told, &READ_BUFFER);
    }
}

fn complete(steps: &mut Steps, handout: &Handout, pass: &Pass) {
    let step = (
        handout.set_up,
        "glCheckFramebufferStatus says GL_FRAMEBUFFER_COMPLETE",
    );
    let framebuffer = pass.framebuffer.as_ref();
    match framebuffer.and_then(|framebuffer| framebuffer.status.as_ref()) {
        Some(status) if status.value == "GL_FRAMEBUFFER_COMPLETE" => {
            steps.found(step, status.line, "it does");
        }
        Some(status) => {
            let told = format!("it says {}", status.value);
            steps.fault(step, Mark::Wrong, status.line, told, &INCOMPLETE);
        }
        None if handout.asks_complete => {
            steps.fault(step, Mark::Missing, 0, "nobody asks", &UNCHECKED);
        }
        None => steps.fault(step, Mark::Unclear, 0, "nobody asks", &UNCHECKED),
    }
}
