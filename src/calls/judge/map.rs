//! The shadow map: how it is made, and how it is drawn.

use super::{Map, Second};
use crate::calls::frame::{Frame, Pass};
use crate::calls::handouts::Handout;
use crate::calls::objects::Attachment;
use crate::calls::report::{Mark, Steps};
use crate::calls::state::State;

const DRAW: &str = "draw what casts a shadow into the depth texture";

/// Nothing is drawn into a depth texture: why not, as far as one can see.
pub fn no_map(steps: &mut Steps, handout: &Handout, state: &State) {
    let step = (handout.set_up, "a framebuffer object with a depth texture");
    let framebuffers = || state.framebuffers.iter().filter(|(id, _)| *id != "0");
    let depth = |id: &String| {
        state
            .textures
            .get(id)
            .is_some_and(|texture| texture.holds_depth())
    };
    let effect = "there is no shadow map, and so no shadow, or everything is in shadow";
    let fix = "attach a depth texture with glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, …), and draw the scene into it";

    for (id, framebuffer) in framebuffers() {
        if framebuffer.depth_texture().is_some() {
            let line = framebuffer.depth().map_or(0, |at| at.line);
            let found = format!("framebuffer {id} has one, and no draw call goes into it");
            steps.found(step, line, format!("framebuffer {id}"));
            steps.other(
                (handout.first_pass, DRAW),
                Mark::Missing,
                line,
                found,
                effect,
                "bind the framebuffer before the first pass, and draw the scene",
            );
            return;
        }
        for (point, attachment) in &framebuffer.attachments {
            if let Attachment::Texture(texture) = &attachment.value
                && depth(texture)
            {
                let found = format!("the depth texture {texture} is attached as {point}");
                steps.other(
                    step,
                    Mark::OtherArguments,
                    attachment.line,
                    found,
                    effect,
                    "attach it as GL_DEPTH_ATTACHMENT",
                );
                return;
            }
        }
        if let Some(attachment) = framebuffer.depth() {
            let found = format!(
                "framebuffer {id} keeps its depth in a renderbuffer, which no shader can read"
            );
            steps.other(
                step,
                Mark::OtherArguments,
                attachment.line,
                found,
                effect,
                fix,
            );
            return;
        }
    }
    let made = state
        .textures
        .iter()
        .find(|(_, texture)| texture.holds_depth());
    match made {
        Some((id, texture)) => {
            let line = texture.image.as_ref().map_or(0, |image| image.line);
            let found = format!("the depth texture {id} is attached to no framebuffer");
            steps.other(step, Mark::Missing, line, found, effect, fix);
        }
        None => steps.other(
            step,
            Mark::Missing,
            0,
            "there is no depth texture",
            effect,
            fix,
        ),
    }
}

/// The depth texture and its framebuffer.
pub fn set_up(steps: &mut Steps, handout: &Handout, map: &Map, second: &Second, state: &State) {
    let place = handout.set_up;
    let Some(framebuffer) = &map.pass.framebuffer else {
        return;
    };
    let id = map.id;
    // A sampler object may have a say in the parameters, so they are taken as they are read, where they are.
    let read = second.draws.iter().find_map(|draw| draw.reads(id));
    let texture = read
        .and_then(|reading| reading.texture.as_ref())
        .map_or(map.texture, |(_, texture)| texture);

    let step = (place, "glTexImage2D(…, GL_DEPTH_COMPONENT, …)");
    match &texture.image {
        Some(image) => {
            let (width, height, format) = &image.value;
            steps.found(
                step,
                image.line,
                format!("texture {id}, {width}×{height}, {format}"),
            );
        }
        None => steps.other(
            step,
            Mark::Missing,
            0,
            format!("texture {id} has no image"),
            "no shadow, or everything is in shadow",
            "give it a size before it is attached",
        ),
    }
    filters(
        steps,
        (place, "GL_TEXTURE_MIN_FILTER without mipmaps"),
        texture,
    );
    wrap_mode(steps, handout, texture);

    let step = (
        place,
        "GL_TEXTURE_COMPARE_MODE as the sampler's type wants it",
    );
    let compares = texture.compares();
    let is_shadow = read.and_then(|reading| reading.sampler.is_shadow);
    let sampler = read.map_or("the shader's sampler", |reading| {
        reading.sampler.name.as_str()
    });
    match (compares.value, is_shadow) {
        (true, Some(true)) => steps.found(
            step,
            compares.line,
            format!("{sampler} is a sampler2DShadow"),
        ),
        (true, Some(false)) => steps.mistake(
            step,
            Mark::Wrong,
            compares.line,
            "compare_mode",
            format!("the texture compares, and {sampler} is no sampler2DShadow"),
        ),
        (false, Some(true)) => steps.mistake(
            step,
            Mark::Missing,
            compares.line,
            "compare_mode",
            format!("{sampler} is a sampler2DShadow, and the texture does not compare"),
        ),
        // The source is not in the dump; the handouts' samplers are plain.
        (true, None) if second.reads => steps.mistake(
            step,
            Mark::Wrong,
            compares.line,
            "compare_mode",
            "the texture compares, and the handout's sampler2D does not",
        ),
        _ => {}
    }
    swizzle(steps, handout, texture, read, state);

    if let Some(depth) = framebuffer.depth() {
        steps.found(
            (place, "attached as GL_DEPTH_ATTACHMENT"),
            depth.line,
            format!("to framebuffer {}", map.pass.target.value),
        );
    }
    buffers(steps, (place, "glDrawBuffer(GL_NONE)"), map.pass);
    complete(steps, handout, map.pass);
}

fn filters(
    steps: &mut Steps,
    step: (&'static str, &'static str),
    texture: &crate::calls::objects::Texture,
) {
    let filter = texture.word("GL_TEXTURE_MIN_FILTER");
    let level = texture.parameters.get("GL_TEXTURE_MAX_LEVEL");
    let one_level = level.is_some_and(|set| {
        set.value == crate::calls::objects::Parameter::Word("GL_NONE".to_owned())
    });
    if filter.value.contains("MIPMAP")
        && !texture.has_mipmaps
        && !texture.is_immutable
        && !one_level
    {
        if filter.line == 0 {
            let line = texture.image.as_ref().map_or(0, |image| image.line);
            steps.mistake(
                step,
                Mark::Missing,
                line,
                "mipmap_filter",
                format!("it stays at {}", filter.value),
            );
        } else {
            steps.mistake(
                step,
                Mark::OtherArguments,
                filter.line,
                "mipmap_filter",
                filter.value,
            );
        }
    } else {
        steps.found(step, filter.line, filter.value);
    }
}

fn wrap_mode(steps: &mut Steps, handout: &Handout, texture: &crate::calls::objects::Texture) {
    let step = (handout.set_up, "a wrap mode that does not repeat");
    let wrap = ["S", "T"].map(|axis| texture.word(&format!("GL_TEXTURE_WRAP_{axis}")));
    let Some(repeats) = wrap.iter().find(|mode| mode.value.contains("REPEAT")) else {
        return steps.found(step, wrap[0].line, wrap[0].value.clone());
    };
    let mark = match repeats.line {
        // The handout does without, because its shader asks where the point is.
        _ if handout.asks_range => Mark::Unclear,
        0 => Mark::Missing,
        _ => Mark::OtherArguments,
    };
    let found = match repeats.line {
        0 => format!("it stays at {}", repeats.value),
        _ => repeats.value.clone(),
    };
    let found = if handout.asks_range {
        found + ": right, where the shader asks whether uv is in [0, 1]"
    } else {
        found
    };
    steps.mistake(step, mark, repeats.line, "repeat_outside", found);
}

fn swizzle(
    steps: &mut Steps,
    handout: &Handout,
    texture: &crate::calls::objects::Texture,
    read: Option<&crate::calls::frame::Reading>,
    state: &State,
) {
    let step = (
        handout.set_up,
        "GL_TEXTURE_SWIZZLE_RGBA, or .r in the shader",
    );
    let sampler = read.map_or("", |reading| reading.sampler.name.as_str());
    // `shadowlab trace` has no sources, and its shaders are the handout's in a core profile.
    let beyond = match read.map(|reading| reading.sampler.is_shadow) {
        Some(Some(false)) => {
            state.is_core
                && state.programs.values().any(|program| {
                    program
                        .source
                        .as_ref()
                        .is_some_and(|source| source.beyond_red.iter().any(|name| name == sampler))
                })
        }
        Some(None) => handout.reads_beyond_red,
        _ => false,
    };
    if !beyond {
        return;
    }
    match texture.parameters.get("GL_TEXTURE_SWIZZLE") {
        Some(set) => steps.found(step, set.line, "set"),
        None => {
            let line = texture.image.as_ref().map_or(0, |image| image.line);
            steps.mistake(
                step,
                Mark::Missing,
                line,
                "no_swizzle",
                "the shader reads .z or .g in a core profile",
            );
        }
    }
}

fn buffers(steps: &mut Steps, step: (&'static str, &'static str), pass: &Pass) {
    let Some(framebuffer) = &pass.framebuffer else {
        return;
    };
    if let Some(color) = framebuffer.color() {
        return steps.found(
            step,
            color.line,
            "not needed: the framebuffer has a color buffer",
        );
    }
    let line = framebuffer.depth().map_or(0, |at| at.line);
    let read = framebuffer
        .read_buffer
        .as_ref()
        .is_some_and(|set| set.value);
    let Some(chosen) = &framebuffer.draw_buffers else {
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
    if read {
        return steps.found(step, chosen.line, "and glReadBuffer(GL_NONE)");
    }
    steps.other(
        step,
        Mark::Unclear,
        chosen.line,
        "glReadBuffer(GL_NONE) is not called for the framebuffer",
        "none here; a driver of OpenGL 3 may call the framebuffer incomplete, and then there are no shadows",
        "glReadBuffer(GL_NONE)",
    );
}

fn complete(steps: &mut Steps, handout: &Handout, pass: &Pass) {
    let step = (
        handout.set_up,
        "glCheckFramebufferStatus says GL_FRAMEBUFFER_COMPLETE",
    );
    let Some(framebuffer) = &pass.framebuffer else {
        return;
    };
    let effect = "where a driver calls the framebuffer incomplete nothing is drawn into the map, and nobody is told";
    let fix = "ask for the status when everything is attached, and stop where it is another";
    match &framebuffer.status {
        Some(status) if status.value == "GL_FRAMEBUFFER_COMPLETE" => {
            steps.found(step, status.line, "it does")
        }
        Some(status) => steps.other(
            step,
            Mark::Wrong,
            status.line,
            format!("it says {}", status.value),
            "nothing is drawn into the map: no shadows, or everything in shadow",
            "attach an image of a size, and set the draw buffer to GL_NONE",
        ),
        None => {
            let mark = if handout.asks_complete {
                Mark::Missing
            } else {
                Mark::Unclear
            };
            steps.other(step, mark, 0, "nobody asks", effect, fix);
        }
    }
}

/// The state in which the map is drawn.
pub fn first_pass(steps: &mut Steps, handout: &Handout, map: &Map, frame: &Frame, state: &State) {
    let place = handout.first_pass;
    let pass = map.pass;
    let Some(first) = pass.draws.first() else {
        return;
    };

    let step = (place, "glBindFramebuffer, with the map's framebuffer");
    steps.found(
        step,
        pass.target.line,
        format!("framebuffer {}", pass.target.value),
    );

    let step = (place, "glViewport, with the map's size");
    let viewport = &first.pipeline.viewport;
    match map.texture.size() {
        Some((width, height)) if viewport.value == [0, 0, width, height] => {
            steps.found(step, viewport.line, format!("{width}×{height}"));
        }
        Some((width, height)) => {
            let [x, y, w, h] = viewport.value;
            let told = format!("it is {w}×{h} at ({x}, {y}), and the map {width}×{height}");
            let in_pass = viewport.line > pass.target.line;
            let mark = if in_pass {
                Mark::OtherArguments
            } else {
                Mark::Missing
            };
            steps.mistake(step, mark, viewport.line, "viewport_not_set", told);
        }
        None => {}
    }
    clear(
        steps,
        (
            place,
            "glClear(GL_DEPTH_BUFFER_BIT), with the depth mask on",
        ),
        map,
        frame,
    );

    let step = (place, "the depth test and the depth mask are on");
    let off = pass
        .draws
        .iter()
        .all(|draw| !draw.pipeline.is_on("GL_DEPTH_TEST") || draw.pipeline.depth_mask_off.value);
    if off {
        let mask = &first.pipeline.depth_mask_off;
        let (line, told) = match mask.value {
            true => (mask.line, "glDepthMask(GL_FALSE)"),
            false => (
                first.pipeline.line_of("GL_DEPTH_TEST"),
                "GL_DEPTH_TEST is off, and then no depth is written",
            ),
        };
        steps.other(
            step,
            Mark::Wrong,
            line,
            told,
            "the map stays empty: no shadows",
            "glEnable(GL_DEPTH_TEST), glDepthMask(GL_TRUE)",
        );
    } else {
        steps.found(step, first.pipeline.line_of("GL_DEPTH_TEST"), "they are");
    }

    let step = (place, "the shadow program");
    match &first.program {
        Some(program) => steps.found(step, first.used, format!("program {}", program.id)),
        None if handout.fixed_pipeline => steps.found(step, first.used, "the fixed pipeline"),
        None => steps.other(
            step,
            Mark::Unclear,
            first.used,
            "the fixed pipeline",
            "none, where its matrices are the light's",
            "select the shadow program",
        ),
    }
    let old = if map.is_old {
        ", for an earlier frame"
    } else {
        ""
    };
    steps.found(
        (place, DRAW),
        first.line,
        format!("{} draw calls{old}", pass.count),
    );
    let _ = state;
}

fn clear(steps: &mut Steps, step: (&'static str, &'static str), map: &Map, frame: &Frame) {
    let pass = map.pass;
    match (&pass.clear, &pass.late_clear) {
        (_, Some(late)) => steps.mistake(
            step,
            Mark::OutOfOrder,
            late.line,
            "map_not_cleared",
            format!(
                "it comes behind the first draw call, line {}, and wipes the map",
                pass.first
            ),
        ),
        (
            Some(Clear {
                mask_off: Some(mask),
                line,
                ..
            }),
            _,
        ) => steps.mistake(
            step,
            Mark::Wrong,
            *line,
            "map_not_cleared",
            format!("the depth mask is off since line {mask}, so that nothing is cleared"),
        ),
        (Some(clear), _) if clear.depth.value != 1.0 => steps.mistake(
            step,
            Mark::OtherArguments,
            clear.line,
            "map_not_cleared",
            format!("to {}, and nothing is farther than that", clear.depth.value),
        ),
        (Some(clear), _) => steps.found(step, clear.line, "it is"),
        (None, None) => {
            // A clearing that came too early, with another framebuffer bound, is meant for this one.
            let elsewhere = frame
                .steps
                .iter()
                .rev()
                .find(|step| step.line < pass.target.line);
            match elsewhere {
                Some(Step {
                    line,
                    what:
                        StepKind::Clear {
                            target,
                            depth: true,
                            ..
                        },
                }) if !map.is_old => {
                    steps.mistake(
                        step,
                        Mark::OutOfOrder,
                        *line,
                        "map_not_cleared",
                        format!(
                            "the one before the bind, line {}, clears framebuffer {target}",
                            pass.target.line
                        ),
                    );
                }
                _ => steps.mistake(
                    step,
                    Mark::Missing,
                    pass.first,
                    "map_not_cleared",
                    "there is none before the first draw call",
                ),
            }
        }
    }
}

use crate::calls::frame::{Clear, Step, StepKind};
