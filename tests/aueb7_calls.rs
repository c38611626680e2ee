//! The handout's sequence of GL calls, held against `shadowlab trace aueb7`, and against what apitrace sees from outside
//! when the program draws its picture.

mod calls;
mod common;

use calls::record::{dropping_and_swapping_fails, other_arguments_fail, seen_from_outside, traced};
use calls::{Line, exactly, find_in_order, in_pass};
use common::{Bench, work_folder};
use shadowlab::gl::trace;

const SET_UP_PASS: &str = "set-up: CreateShadowFBO";
const FIRST_PASS: &str = "first pass: DrawSceneToShadowFBO";
const SECOND_PASS: &str = "second pass: Render";

/// `CreateShadowFBO`.
const CREATE_SHADOW_FBO: &[&str] = &[
    "glGenFramebuffers(1, $fbo)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $fbo)",
    "glGenTextures(1, $fbo_shadow_texture)",
    "glBindTexture(GL_TEXTURE_2D, $fbo_shadow_texture)",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32, 128, 128, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)",
    "glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, $fbo_shadow_texture, 0)",
    "glDrawBuffer(GL_NONE)",
    "glReadBuffer(GL_NONE)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
];

/// The rest of `InitializeRenderer`. The course looks a location up where it is set; here that is done once.
const INITIALIZE_RENDERER: &[&str] = &[
    "$shadow_map_program = glCreateProgram()",
    "glLinkProgram($shadow_map_program)",
    "$uniform_mvp = glGetUniformLocation($shadow_map_program, \"uniform_mvp\")",
    "$spot_light_program = glCreateProgram()",
    "glLinkProgram($spot_light_program)",
    "$uniform_m = glGetUniformLocation($spot_light_program, \"uniform_m\")",
    "$uniform_v = glGetUniformLocation($spot_light_program, \"uniform_v\")",
    "$uniform_p = glGetUniformLocation($spot_light_program, \"uniform_p\")",
    "$uniform_view_inverse = glGetUniformLocation($spot_light_program, \"uniform_view_inverse\")",
    "$uniform_light_view_projection = glGetUniformLocation($spot_light_program, \"uniform_light_view_projection\")",
    "$uniform_sampler_diffuse = glGetUniformLocation($spot_light_program, \"uniform_sampler_diffuse\")",
    "$uniform_sampler_shadow_map = glGetUniformLocation($spot_light_program, \"uniform_sampler_shadow_map\")",
    "$light_source_program = glCreateProgram()",
    "glLinkProgram($light_source_program)",
    "glEnable(GL_DEPTH_TEST)",
    "glDepthFunc(GL_LEQUAL)",
    "glEnable(GL_CULL_FACE)",
    "glCullFace(GL_BACK)",
];

/// The plane and the two spheres, as viewed from the light.
const DRAW_SCENE_TO_SHADOW_FBO: &[&str] = &[
    "glBindFramebuffer(GL_FRAMEBUFFER, $fbo)",
    "glViewport(0, 0, 128, 128)",
    "glClear(GL_DEPTH_BUFFER_BIT)",
    "glUseProgram($shadow_map_program)",
    "glUniformMatrix4fv($uniform_mvp, 1, GL_FALSE, _)",
    "glBindVertexArray($plane)",
    "glDrawElements(GL_TRIANGLES, 2400, GL_UNSIGNED_INT, 0)",
    "glUniformMatrix4fv($uniform_mvp, 1, GL_FALSE, _)",
    "glBindVertexArray($sphere_1)",
    "glDrawElements(GL_TRIANGLES, 6624, GL_UNSIGNED_INT, 0)",
    "glUniformMatrix4fv($uniform_mvp, 1, GL_FALSE, _)",
    "glBindVertexArray($sphere_2)",
    "glDrawElements(GL_TRIANGLES, 6624, GL_UNSIGNED_INT, 0)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
];

/// "The second pass renders the scene as usual": clear, the marker at the light, the ground, the objects.
const RENDER: &[&str] = &[
    "glViewport(0, 0, 500, 500)",
    "glClearColor(0.03, 0.2, 0.22, 1)",
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    "glUseProgram($light_source_program)",
    "glBindVertexArray($light_source)",
    "glDrawElements(GL_TRIANGLES, _, GL_UNSIGNED_INT, 0)",
    "glUseProgram($spot_light_program)",
    "glActiveTexture(GL_TEXTURE4)",
    "glBindTexture(GL_TEXTURE_2D, $fbo_shadow_texture)",
    "glActiveTexture(GL_TEXTURE0)",
    "glUniform1i($uniform_sampler_shadow_map, 4)",
    "glUniform1i($uniform_sampler_diffuse, 0)",
    "glUniformMatrix4fv($uniform_v, 1, GL_FALSE, _)",
    "glUniformMatrix4fv($uniform_p, 1, GL_FALSE, _)",
    "glUniformMatrix4fv($uniform_view_inverse, 1, GL_FALSE, _)",
    "glUniformMatrix4fv($uniform_light_view_projection, 1, GL_FALSE, _)",
    "glBindTexture(GL_TEXTURE_2D, $white)",
    "glUniformMatrix4fv($uniform_m, 1, GL_FALSE, _)",
    "glBindVertexArray($plane)",
    "glDrawElements(GL_TRIANGLES, 2400, GL_UNSIGNED_INT, 0)",
    "glBindTexture(GL_TEXTURE_2D, $ball_1)",
    "glUniformMatrix4fv($uniform_m, 1, GL_FALSE, _)",
    "glBindVertexArray($sphere_1)",
    "glDrawElements(GL_TRIANGLES, 6624, GL_UNSIGNED_INT, 0)",
    "glBindTexture(GL_TEXTURE_2D, $ball_2)",
    "glUniformMatrix4fv($uniform_m, 1, GL_FALSE, _)",
    "glBindVertexArray($sphere_2)",
    "glDrawElements(GL_TRIANGLES, 6624, GL_UNSIGNED_INT, 0)",
];

/// Set-up and first pass must be these calls and no others; the rest must be there, in order.
fn check(lines: &[Line]) -> Result<(), String> {
    exactly(in_pass(lines, SET_UP_PASS), CREATE_SHADOW_FBO)?;
    exactly(in_pass(lines, FIRST_PASS), DRAW_SCENE_TO_SHADOW_FBO)?;
    let all = [
        CREATE_SHADOW_FBO,
        INITIALIZE_RENDERER,
        DRAW_SCENE_TO_SHADOW_FBO,
        RENDER,
    ]
    .concat();
    find_in_order(lines, &all).map(|_| ())
}

#[test]
fn the_trace_is_the_handouts_sequence() {
    check(&traced("aueb7")).unwrap();
}

#[test]
fn apitrace_sees_the_handouts_sequence() {
    check(&seen_from_outside("aueb7", &work_folder("apitrace-aueb7"))).unwrap();
}

/// The controls: every call that the handout asks for, dropped, swapped with the next one, given another argument.
#[test]
fn an_edited_stream_fails() {
    let lines = traced("aueb7");
    check(&lines).unwrap();
    let others = [
        (
            "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32",
            "128 → 512",
        ),
        (
            "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32",
            "GL_DEPTH_COMPONENT32 → GL_DEPTH_COMPONENT24",
        ),
        (
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST",
            "GL_NEAREST → GL_LINEAR",
        ),
        (
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE",
            "GL_CLAMP_TO_EDGE → GL_REPEAT",
        ),
        (
            "glFramebufferTexture2D",
            "GL_DEPTH_ATTACHMENT → GL_COLOR_ATTACHMENT0",
        ),
        ("glDrawBuffer", "GL_NONE → GL_COLOR_ATTACHMENT0"),
        ("glReadBuffer", "GL_NONE → GL_COLOR_ATTACHMENT0"),
        ("glViewport(0, 0, 128, 128)", "128 → 500"),
        ("glViewport(0, 0, 500, 500)", "500 → 128"),
        ("glDepthFunc", "GL_LEQUAL → GL_LESS"),
        ("glCullFace", "GL_BACK → GL_FRONT"),
        (
            "glUseProgram(shadow_map_program)",
            "shadow_map_program → spot_light_program",
        ),
        ("glActiveTexture(GL_TEXTURE4)", "GL_TEXTURE4 → GL_TEXTURE0"),
        (
            "glBindTexture(GL_TEXTURE_2D, fbo_shadow_texture)",
            "fbo_shadow_texture → white",
        ),
        (
            "\"uniform_light_view_projection\"",
            "\"uniform_light_view_projection\" → \"light\"",
        ),
    ];
    let edits = dropping_and_swapping_fails(&lines, &[SET_UP_PASS, FIRST_PASS], check)
        + other_arguments_fail(&lines, &others, check);
    assert!(edits > 55, "{edits} edits");
}

/// F1's mode is set before the first pass, and the next frame's reader finds filled triangles again.
#[test]
fn wireframe_holds_in_both_passes_and_no_longer() {
    let mut bench = Bench::recorded("aueb7", [64, 64], &["redraw=every_frame"]);
    bench.press("<F1>");
    trace::take();
    bench.picture();
    let text = trace::to_c(&trace::take());
    let modes = [
        "glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)".to_owned(),
        format!("// {FIRST_PASS}"),
        "glDrawElements(GL_TRIANGLES, ...)".to_owned(),
        format!("// {SECOND_PASS}"),
        "glDrawElements(GL_TRIANGLES, ...)".to_owned(),
        "glPolygonMode(GL_FRONT_AND_BACK, GL_FILL)".to_owned(),
    ];
    let modes: Vec<&str> = modes.iter().map(String::as_str).collect();
    find_in_order(&calls::parse_c(&text), &modes).unwrap();
    assert_eq!(text.matches("glPolygonMode").count(), 2);
    bench.press("<F1><F1>");
    bench.picture();
    let filled = trace::to_c(&trace::take());
    assert!(!filled.contains("glPolygonMode"));
}

/// The map is drawn anew when the light or a caster has changed, and only then.
#[test]
fn the_shadow_map_is_drawn_when_it_has_changed() {
    let mut bench = Bench::recorded("aueb7", [64, 64], &["redraw=when_changed"]);
    bench.picture();
    let mut map_is_drawn = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        trace::to_c(&trace::take()).contains(&format!("// {FIRST_PASS}"))
    };
    for (keys, drawn) in [
        ("", false),
        ("wasdrf<Drag:5,5>", false),
        ("<RightDrag:5,0>", true),
        ("<F1>", true),
        ("<F1><F1><F1>", false),
    ] {
        assert_eq!(map_is_drawn(&|bench| bench.press(keys)), drawn, "{keys}");
    }
    for (setting, drawn) in [
        ("constant_depth_bias=0.001", false),
        ("filter=pcf_9", false),
        ("step=1", false),
        ("outside=lit", false),
        ("map_size=512", true),
        ("scene=pirate", true),
        ("shadows=off", false),
        ("shadows=on", false),
    ] {
        assert_eq!(
            map_is_drawn(&|bench| bench.set(&[setting])),
            drawn,
            "{setting}"
        );
    }
    assert!(map_is_drawn(&|bench| {
        bench.set(&["rotate_light=on"]);
        bench.lab.advance(1.0);
    }));
    assert!(map_is_drawn(&|bench| bench.set(&["redraw=every_frame"])));
}
