//! The handout's sequence of GL calls, held against `shadowlab trace cs541`, and against what apitrace sees from
//! outside when the program draws its picture.

mod calls;
mod common;

use calls::record::{dropping_and_swapping_fails, other_arguments_fail, seen_from_outside, traced};
use calls::{Line, exactly, find_in_order, in_pass};
use common::{Bench, work_folder};
use shadowlab::gl::trace;

/// "Storing depth values as a texture", with the departures of the README: wrap mode, swizzle, draw and read buffer,
/// completeness check.
const SET_UP: &[&str] = &[
    "glGenFramebuffers(1, $frame_buffer)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $frame_buffer)",
    "glGenTextures(1, $depth_texture_buffer)",
    "glBindTexture(GL_TEXTURE_2D, $depth_texture_buffer)",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024, 1024, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)",
    "glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, _)",
    "glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, $depth_texture_buffer, 0)",
    "glDrawBuffer(GL_NONE)",
    "glReadBuffer(GL_NONE)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
];

/// "Vertex and fragment shaders": the uniforms of the shadow program, and those that the second pass adds. The handout
/// looks a location up where it sets it; here that is done once.
const LOOK_UPS: &[&str] = &[
    "$shadow_program = glCreateProgram()",
    "glLinkProgram($shadow_program)",
    "$shadow_persp = glGetUniformLocation($shadow_program, \"persp_matrix\")",
    "$shadow_view = glGetUniformLocation($shadow_program, \"view_matrix\")",
    "$shadow_model = glGetUniformLocation($shadow_program, \"model_matrix\")",
    "$program = glCreateProgram()",
    "glLinkProgram($program)",
    "$shadow_sampler = glGetUniformLocation($program, \"shadow_sampler\")",
    "$usampler = glGetUniformLocation($program, \"usampler\")",
];

/// "First pass: drawing the shadow map", for a scene of fourteen meshes. The last eight are the lighthouse's, which
/// stands as a whole: its model matrix is sent once.
fn first_pass() -> Vec<&'static str> {
    let mut steps = vec![
        "glBindFramebuffer(GL_FRAMEBUFFER, $frame_buffer)",
        "glViewport(0, 0, 1024, 1024)",
        "glUseProgram($shadow_program)",
        "glClear(GL_DEPTH_BUFFER_BIT)",
        "glUniformMatrix4fv($shadow_persp, 1, GL_FALSE, _)",
        "glUniformMatrix4fv($shadow_view, 1, GL_FALSE, _)",
    ];
    for mesh in 0..14 {
        if mesh <= 14 - 8 {
            steps.push("glUniformMatrix4fv($shadow_model, 1, GL_FALSE, _)");
        }
        steps.extend([
            "glBindVertexArray(_)",
            "glDrawElements(GL_TRIANGLES, _, GL_UNSIGNED_INT, _)",
        ]);
    }
    steps.push("glBindFramebuffer(GL_FRAMEBUFFER, 0)");
    steps
}

/// "Second pass: using the shadow map".
const SECOND_PASS: &[&str] = &[
    "glViewport(0, 0, 500, 500)",
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    "glUseProgram($program)",
    "glActiveTexture(GL_TEXTURE1)",
    "glBindTexture(GL_TEXTURE_2D, $depth_texture_buffer)",
    "glUniform1i($shadow_sampler, 1)",
    "glUniform1i($usampler, 0)",
    "glActiveTexture(GL_TEXTURE0)",
    "glBindTexture(GL_TEXTURE_2D, $floor_texture)",
    "glDrawElements(GL_TRIANGLES, _, GL_UNSIGNED_INT, _)",
];

/// Set-up and first pass must be these calls and no others; the rest must be there, in order.
fn check(lines: &[Line]) -> Result<(), String> {
    exactly(
        in_pass(lines, "set-up: storing depth values as a texture"),
        SET_UP,
    )?;
    exactly(
        in_pass(lines, "first pass: drawing the shadow map"),
        &first_pass(),
    )?;
    let all = [SET_UP, LOOK_UPS, &first_pass(), SECOND_PASS].concat();
    find_in_order(lines, &all).map(|_| ())
}

#[test]
fn the_trace_is_the_handouts_sequence() {
    check(&traced("cs541")).unwrap();
}

#[test]
fn apitrace_sees_the_handouts_sequence() {
    check(&seen_from_outside("cs541", &work_folder("apitrace"))).unwrap();
}

/// The controls: every call that the handout asks for, dropped, swapped with the next one, given another argument.
#[test]
fn an_edited_stream_fails() {
    let lines = traced("cs541");
    check(&lines).unwrap();
    let exact = [
        "set-up: storing depth values as a texture",
        "first pass: drawing the shadow map",
    ];
    let others = [
        (
            "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024",
            "1024 → 512",
        ),
        (
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR",
            "GL_LINEAR → GL_NEAREST",
        ),
        (
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S",
            "GL_CLAMP_TO_EDGE → GL_REPEAT",
        ),
        (
            "glFramebufferTexture2D",
            "GL_DEPTH_ATTACHMENT → GL_COLOR_ATTACHMENT0",
        ),
        ("glFramebufferTexture2D", "depth_texture_buffer → white"),
        ("glDrawBuffer", "GL_NONE → GL_COLOR_ATTACHMENT0"),
        ("glViewport(0, 0, 1024, 1024)", "1024 → 500"),
        ("glViewport(0, 0, 500, 500)", "500 → 1024"),
        (
            "glClear(GL_DEPTH_BUFFER_BIT)",
            "GL_DEPTH_BUFFER_BIT → GL_COLOR_BUFFER_BIT",
        ),
        ("glUseProgram(shadow_program)", "shadow_program → program"),
        ("glActiveTexture(GL_TEXTURE1)", "GL_TEXTURE1 → GL_TEXTURE0"),
        ("glUniform1i(14, 1)", "1 → 0"),
    ];
    let edits = dropping_and_swapping_fails(&lines, &exact, check)
        + other_arguments_fail(&lines, &others, check);
    assert!(edits > 100, "{edits} edits");
}

/// The map is drawn anew when the light or a caster has changed, and only then.
#[test]
fn the_first_pass_is_drawn_when_the_map_has_changed() {
    let mut bench = Bench::recorded("cs541", [64, 64], &["redraw=when_changed"]);
    bench.picture();
    let mut map_is_drawn = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        trace::to_c(&trace::take()).contains("// first pass")
    };
    assert!(!map_is_drawn(&|_| ()), "nothing has changed");
    assert!(
        !map_is_drawn(&|bench| bench.press("wdqo")),
        "the eye has moved"
    );
    assert!(
        !map_is_drawn(&|bench| bench.set(&["epsilon=0.01"])),
        "the second pass has changed"
    );
    assert!(
        map_is_drawn(&|bench| bench.press("<Left>")),
        "the light has moved"
    );
    assert!(
        map_is_drawn(&|bench| bench.lab.advance(0.1)),
        "the torus has turned"
    );
    assert!(
        map_is_drawn(&|bench| bench.set(&["map_size=512"])),
        "the map is a new one"
    );
    assert!(
        map_is_drawn(&|bench| bench.set(&["remedy=culling"])),
        "other faces cast"
    );
    assert!(
        !map_is_drawn(&|bench| bench.set(&["shadows=off"])),
        "no map is looked at"
    );
    assert!(
        map_is_drawn(&|bench| bench.set(&["shadows=on", "redraw=every_frame"])),
        "as in the course"
    );
}
