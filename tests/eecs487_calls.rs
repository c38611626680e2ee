//! The handout's sequence of GL calls, held against `shadowlab trace eecs487`, and against what apitrace sees from outside
//! when the program draws its picture.

mod calls;
mod common;

use calls::record::{dropping_and_swapping_fails, other_arguments_fail, seen_from_outside, traced};
use calls::{Line, exactly, find_in_order, in_pass};
use common::{Bench, work_folder};
use shadowlab::gl::trace;

/// The floor alone, clipped; hard and soft.
const HARD: &str = "eecs487 --keys xc";
const SOFT: &str = "eecs487 --keys xcf";

const SET_UP_PASS: &str = "set-up: fbo_accum_init";

/// Section 4, with the departure of the README: two framebuffers.
const SET_UP: &[&str] = &[
    "glGenFramebuffers(1, $frame_fbo)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $frame_fbo)",
    "glGenTextures(1, $frame)",
    "glBindTexture(GL_TEXTURE_2D, $frame)",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 600, 600, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)",
    "glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, $frame, 0)",
    "glGenRenderbuffers(1, $depth_stencil)",
    "glBindRenderbuffer(GL_RENDERBUFFER, $depth_stencil)",
    "glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 600, 600)",
    "glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, $depth_stencil)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glGenFramebuffers(1, $accum_fbo)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $accum_fbo)",
    "glGenRenderbuffers(1, $accum)",
    "glBindRenderbuffer(GL_RENDERBUFFER, $accum)",
    "glRenderbufferStorage(GL_RENDERBUFFER, GL_RGB32F, 600, 600)",
    "glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, $accum)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
    "glGenVertexArrays(1, $quad)",
    "glGenVertexArrays(1, $ramp)",
];

/// `drawScene()`: the light, the wall, the stencil buffer in three steps, the shadows, the occluders.
const DRAW_SCENE: &[&str] = &[
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)",
    "glUseProgram($light)",
    "glBindVertexArray($light_mesh)",
    "glDrawElements(GL_TRIANGLES, 1080, GL_UNSIGNED_INT, 0)",
    "glUseProgram($wall)",
    "glBindVertexArray($wall_mesh)",
    "glDrawElements(GL_TRIANGLES, 1536, GL_UNSIGNED_INT, 0)",
    "glUseProgram($shadow)",
    "glEnable(GL_CLIP_DISTANCE0)",
    "glEnable(GL_STENCIL_TEST)",
    "glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)",
    "glDisable(GL_DEPTH_TEST)",
    "glStencilFunc(GL_ALWAYS, 1, _)",
    "glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)",
    "glDrawElements(GL_TRIANGLES, 1536, GL_UNSIGNED_INT, 0)",
    "glStencilFunc(GL_EQUAL, 1, _)",
    "glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)",
    "glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)",
    "glEnable(GL_DEPTH_TEST)",
    "glBindVertexArray($torus)",
    "glDrawElements(GL_TRIANGLES, 2304, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($teapot)",
    "glDrawElements(GL_TRIANGLES, 9240, GL_UNSIGNED_INT, 0)",
    "glDisable(GL_CLIP_DISTANCE0)",
    "glDisable(GL_STENCIL_TEST)",
    "glUseProgram($lighting)",
    "glBindVertexArray($torus)",
    "glDrawElements(GL_TRIANGLES, 2304, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($teapot)",
    "glDrawElements(GL_TRIANGLES, 9240, GL_UNSIGNED_INT, 0)",
];

/// `fbo_accum(0.5)`: blending weighs the quad. Its color is set before the first one alone.
const FBO_ACCUM: &[&str] = &[
    "glBindVertexArray($quad)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $accum_fbo)",
    "glUseProgram($accum_program)",
    "glEnable(GL_BLEND)",
    "glDrawArrays(GL_TRIANGLES, 0, 3)",
];

/// Without the uniforms, which the pictures test, and with the pass's own heading.
fn without_uniforms(lines: &[Line]) -> Vec<Line> {
    let uniform = |line: &&Line| line.name.starts_with("glUniform");
    lines
        .iter()
        .filter(|line| !uniform(line))
        .cloned()
        .collect()
}

fn the_end(pass: &[Line]) -> Vec<Line> {
    // What asks for errors belongs to the program, not to the lab; apitrace sees more of it.
    let end = pass.iter().position(|line| {
        ["glGetError", "glPixelStorei", "glReadPixels"].contains(&line.name.as_str())
    });
    without_uniforms(&pass[..end.unwrap_or(pass.len())])
}

fn check_hard(lines: &[Line]) -> Result<(), String> {
    let expected = [&["glBindFramebuffer(GL_FRAMEBUFFER, 0)"], DRAW_SCENE].concat();
    exactly(&the_end(in_pass(lines, "drawScene")), &expected)?;
    // What does not change is set before.
    find_in_order(
        lines,
        &[
            "glEnable(GL_DEPTH_TEST)",
            "glViewport(0, 0, 600, 600)",
            "// drawScene",
        ],
    )?;
    Ok(())
}

fn check_soft(lines: &[Line]) -> Result<(), String> {
    exactly(in_pass(lines, SET_UP_PASS), SET_UP)?;
    let begin: &[&str] = &[
        "glActiveTexture(GL_TEXTURE0)",
        "glBindTexture(GL_TEXTURE_2D, $frame)",
        "glBindFramebuffer(GL_FRAMEBUFFER, $accum_fbo)",
        "glClearBufferfv(GL_COLOR, 0, _)",
        "glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE)",
    ];
    let render: &[&str] = &["glBindFramebuffer(GL_FRAMEBUFFER, $frame_fbo)"];
    let mut first = FBO_ACCUM.to_vec();
    first.insert(3, "glBlendColor(0, 0, 0, 0.5)");
    let next: &[&str] = &["glDisable(GL_BLEND)"];
    let end: &[&str] = &[
        "glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0)",
        "glBlitFramebuffer(0, 0, 600, 600, 0, 0, 600, 600, GL_COLOR_BUFFER_BIT, GL_NEAREST)",
        "glBindFramebuffer(GL_READ_FRAMEBUFFER, 0)",
    ];
    let frame = [
        begin, render, DRAW_SCENE, &first, render, next, DRAW_SCENE, FBO_ACCUM, next, end,
    ]
    .concat();
    exactly(&the_end(in_pass(lines, "soft shadows")), &frame)?;
    // The objects are those that were set up.
    let all = [SET_UP, begin, render, DRAW_SCENE, &first].concat();
    find_in_order(lines, &all).map(|_| ())
}

#[test]
fn the_traces_are_the_handouts_sequences() {
    check_hard(&traced(HARD)).unwrap();
    check_soft(&traced(SOFT)).unwrap();
}

#[test]
fn apitrace_sees_the_handouts_sequences() {
    check_hard(&seen_from_outside(HARD, &work_folder("apitrace-eecs487"))).unwrap();
    check_soft(&seen_from_outside(
        SOFT,
        &work_folder("apitrace-eecs487-soft"),
    ))
    .unwrap();
}

/// Only the calls that are held against the handout, so that each edit of them must fail.
fn checked(lab: &str, pass: &str) -> Vec<Line> {
    let lines = traced(lab);
    let start = lines
        .iter()
        .position(|line| line.heading() == Some(pass))
        .unwrap();
    let mut kept = lines[..=start].to_vec();
    kept.extend(the_end(&lines[start + 1..]));
    kept
}

/// The controls: every call dropped, swapped with the next one, given another argument.
#[test]
fn an_edited_stream_fails() {
    let hard = checked(HARD, "drawScene");
    check_hard(&hard).unwrap();
    let edits = dropping_and_swapping_fails(&hard, &["drawScene"], check_hard)
        + other_arguments_fail(
            &hard,
            &[
                ("glStencilFunc(GL_ALWAYS", "GL_ALWAYS → GL_EQUAL"),
                ("glStencilFunc(GL_ALWAYS", "1 → 0"),
                ("glStencilFunc(GL_EQUAL", "GL_EQUAL → GL_NOTEQUAL"),
                ("GL_REPLACE", "GL_REPLACE → GL_INCR"),
                ("glViewport", "600 → 512"),
                ("glDrawElements(GL_TRIANGLES, 1536", "1536 → 36"),
                ("glColorMask(GL_FALSE", "GL_FALSE → GL_TRUE"),
                ("glEnable(GL_STENCIL_TEST)", "GL_STENCIL_TEST → GL_BLEND"),
            ],
            check_hard,
        );
    assert!(edits > 50, "{edits} edits");

    let soft = checked(SOFT, "soft shadows");
    check_soft(&soft).unwrap();
    let edits = dropping_and_swapping_fails(&soft, &[SET_UP_PASS, "soft shadows"], check_soft)
        + other_arguments_fail(
            &soft,
            &[
                ("glBlendFunc", "GL_ONE → GL_ZERO"),
                ("glBlendColor", "0.5 → 1"),
                ("GL_RGB32F", "GL_RGB32F → GL_RGB8"),
                (
                    "GL_DEPTH_STENCIL_ATTACHMENT",
                    "GL_DEPTH_STENCIL_ATTACHMENT → GL_DEPTH_ATTACHMENT",
                ),
                ("glBindFramebuffer(GL_DRAW_FRAMEBUFFER", "0 → frame_fbo"),
                (
                    "glBlitFramebuffer",
                    "GL_COLOR_BUFFER_BIT → GL_DEPTH_BUFFER_BIT",
                ),
                ("glBindTexture(GL_TEXTURE_2D, frame)", "frame → 0"),
            ],
            check_soft,
        );
    assert!(edits > 150, "{edits} edits");
}

/// Once, and not per frame; again for another size or another format alone.
#[test]
fn the_buffers_are_made_once() {
    for (method, set_up) in [
        ("soft_method=handout", "// set-up: fbo_accum_init"),
        ("soft_method=fast", "// set-up: masks of the fast method"),
    ] {
        let mut bench = Bench::recorded("eecs487", [64, 64], &["soft_shadows=on", method]);
        bench.picture();
        let mut makes = |change: &dyn Fn(&mut Bench)| {
            change(&mut bench);
            trace::take();
            bench.render();
            trace::to_c(&trace::take()).contains(set_up)
        };
        assert!(!makes(&|bench| bench.press("hjr+acxX")), "{method}");
        assert!(
            !makes(&|bench| bench.set(&["jitter=low-discrepancy"])),
            "{method}"
        );
        assert!(makes(&|bench| bench.lab.resize([48, 64])), "{method}");
        // The control of each: what asks for more room.
        let more = ["accumulator=RGBA16F", "num_jitters=33"];
        assert!(makes(&|bench| bench.set(&more)), "{method}");
        assert!(!makes(&|_| ()), "{method}");
    }
}
