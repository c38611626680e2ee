//! The handout's two passes as GL calls, held against `shadowlab trace cmsc23700`, and against what apitrace sees from
//! outside when the program draws its picture. The handout shows no calls: these are the lab's own, as they were found
//! right.

mod calls;
mod common;

use calls::record::{dropping_and_swapping_fails, other_arguments_fail, seen_from_outside, traced};
use calls::{Line, exactly, find_in_order, in_pass};
use common::{Bench, work_folder};
use shadowlab::gl::trace;

const DIRECTIONAL_SET_UP: &str = "set-up: the directional light's shadow map";
const SPOT_SET_UP: &str = "set-up: the spotlight's shadow map";
const PLACES: &str = "the balls' places";
const FIRST: &str = "first pass";
const DIRECTIONAL_PASS: &str = "first pass: the directional light's shadow map";
const SPOT_PASS: &str = "first pass: the spotlight's shadow map";
const SECOND_PASS: &str = "second pass";
const PASSES: [&str; 7] = [
    DIRECTIONAL_SET_UP,
    SPOT_SET_UP,
    PLACES,
    FIRST,
    DIRECTIONAL_PASS,
    SPOT_PASS,
    SECOND_PASS,
];

/// "Support for using FBOs": a depth texture, and a frame-buffer object that draws into it.
const SET_UP: &[&str] = &[
    "glGenTextures(1, $map)",
    "glBindTexture(GL_TEXTURE_2D, $map)",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024, 1024, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER)",
    "glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, {1, 1, 1, 1})",
    "glGenFramebuffers(1, $fbo)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $fbo)",
    "glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, $map, 0)",
    "glDrawBuffer(GL_NONE)",
    "glReadBuffer(GL_NONE)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
];

/// The places of 20 balls, three floats each.
const MOVE_BALLS: &[&str] = &[
    "glBindBuffer(GL_ARRAY_BUFFER, $ball_positions)",
    "glBufferSubData(GL_ARRAY_BUFFER, 0, 240, _)",
];

const BEGIN_FIRST_PASS: &[&str] = &[
    "glUseProgram($shadow_program)",
    "glViewport(0, 0, 1024, 1024)",
];

/// The walls, and all balls at once.
const SCENE: &[&str] = &[
    "glBindVertexArray($bottom)",
    "glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($back)",
    "glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($left)",
    "glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($right)",
    "glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, 0)",
    "glBindVertexArray($ball)",
    "glDrawElementsInstanced(GL_TRIANGLES, 1080, GL_UNSIGNED_INT, 0, 20)",
];

const FROM_DIRECTIONAL: &[&str] = &[
    "glBindFramebuffer(GL_FRAMEBUFFER, $directionalFBO)",
    "glClear(GL_DEPTH_BUFFER_BIT)",
    "glUniformMatrix4fv($lightModelViewProjection, 1, GL_FALSE, _)",
];

const FROM_SPOT: &[&str] = &[
    "glBindFramebuffer(GL_FRAMEBUFFER, $spotFBO)",
    "glClear(GL_DEPTH_BUFFER_BIT)",
    "glUniformMatrix4fv($lightModelViewProjection, 1, GL_FALSE, _)",
];

const TO_WINDOW: &[&str] = &["glBindFramebuffer(GL_FRAMEBUFFER, 0)"];

const LIGHTING: &[&str] = &[
    "glUseProgram($lighting_program)",
    "glViewport(0, 0, 800, 800)",
    "glClearColor(0.2, 0.2, 0.4, 1)",
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    "glActiveTexture(GL_TEXTURE0)",
    "glBindTexture(GL_TEXTURE_2D, $directionalMap)",
    "glUniform1f($directionalBias, _)",
    "glActiveTexture(GL_TEXTURE1)",
    "glBindTexture(GL_TEXTURE_2D, $spotMap)",
    "glUniform1f($spotBias, _)",
    "glUniform1i($shadows, 1)",
    "glUniform1i($directionalEnabled, 1)",
    "glUniform1i($spotEnabled, 1)",
    "glUniformMatrix4fv($projection, 1, GL_FALSE, _)",
    "glUniformMatrix4fv($modelView, 1, GL_FALSE, _)",
    "glUniformMatrix3fv($normalMatrix, 1, GL_FALSE, _)",
];

/// Which object and location is which, from the set-up on.
const MEANINGS: &[&str] = &[
    "glGenTextures(1, $directionalMap)",
    "glGenFramebuffers(1, $directionalFBO)",
    "glGenTextures(1, $spotMap)",
    "glGenFramebuffers(1, $spotFBO)",
    "$shadow_program = glCreateProgram()",
    "glLinkProgram($shadow_program)",
    "$lightModelViewProjection = glGetUniformLocation($shadow_program, \"lightModelViewProjection\")",
    "$lighting_program = glCreateProgram()",
    "glLinkProgram($lighting_program)",
    "$modelView = glGetUniformLocation($lighting_program, \"modelView\")",
    "$projection = glGetUniformLocation($lighting_program, \"projection\")",
    "$directionalBias = glGetUniformLocation($lighting_program, \"directionalBias\")",
    "$spotBias = glGetUniformLocation($lighting_program, \"spotBias\")",
    "$normalMatrix = glGetUniformLocation($lighting_program, \"normalMatrix\")",
    "$shadows = glGetUniformLocation($lighting_program, \"shadows\")",
    "$directionalEnabled = glGetUniformLocation($lighting_program, \"directionalEnabled\")",
    "$spotEnabled = glGetUniformLocation($lighting_program, \"spotEnabled\")",
];

/// The passes must be these calls and no others, and speak of the objects that the set-up made.
fn check(lines: &[Line]) -> Result<(), String> {
    for pass in [DIRECTIONAL_SET_UP, SPOT_SET_UP] {
        exactly(in_pass(lines, pass), SET_UP)?;
    }
    let first_pass = [FROM_DIRECTIONAL, SCENE].concat();
    let last_of_first = [FROM_SPOT, SCENE, TO_WINDOW].concat();
    let second_pass = [LIGHTING, SCENE].concat();
    exactly(in_pass(lines, PLACES), MOVE_BALLS)?;
    exactly(in_pass(lines, FIRST), BEGIN_FIRST_PASS)?;
    exactly(in_pass(lines, DIRECTIONAL_PASS), &first_pass)?;
    exactly(in_pass(lines, SPOT_PASS), &last_of_first)?;
    exactly(in_pass(lines, SECOND_PASS), &second_pass)?;
    let all = [
        MEANINGS,
        MOVE_BALLS,
        BEGIN_FIRST_PASS,
        &first_pass,
        &last_of_first,
        &second_pass,
    ];
    find_in_order(lines, &all.concat()).map(|_| ())
}

/// The calls until the picture is drawn: what follows asks for errors and pixels.
fn until_drawn(mut lines: Vec<Line>) -> Vec<Line> {
    let second_pass = lines
        .iter()
        .position(|line| line.heading() == Some(SECOND_PASS));
    let after = &lines[second_pass.unwrap()..];
    let calls = after.iter().position(|line| line.name == "glGetError");
    lines.truncate(second_pass.unwrap() + calls.unwrap());
    lines
}

#[test]
fn the_trace_is_the_labs_sequence() {
    check(&until_drawn(traced("cmsc23700"))).unwrap();
}

#[test]
fn apitrace_sees_the_labs_sequence() {
    let folder = work_folder("apitrace-cmsc23700");
    check(&until_drawn(seen_from_outside("cmsc23700", &folder))).unwrap();
}

/// The controls: every call, dropped, swapped with the next one, given another argument.
#[test]
fn an_edited_stream_fails() {
    let lines = until_drawn(traced("cmsc23700"));
    check(&lines).unwrap();
    let others = [
        (
            "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024",
            "1024 → 512",
        ),
        ("GL_TEXTURE_MAG_FILTER", "GL_NEAREST → GL_LINEAR"),
        ("GL_TEXTURE_BORDER_COLOR", "{1, 1, 1, 1} → {0, 0, 0, 0}"),
        (
            "glFramebufferTexture2D",
            "GL_DEPTH_ATTACHMENT → GL_COLOR_ATTACHMENT0",
        ),
        ("glFramebufferTexture2D", "spotMap → directionalMap"),
        ("glBindFramebuffer", "spotFBO → directionalFBO"),
        ("glDrawBuffer", "GL_NONE → GL_COLOR_ATTACHMENT0"),
        ("glViewport(0, 0, 1024, 1024)", "1024 → 800"),
        ("glViewport(0, 0, 800, 800)", "800 → 1024"),
        (
            "glUseProgram(shadow_program)",
            "shadow_program → lighting_program",
        ),
        // Both maps on one unit.
        ("glActiveTexture(GL_TEXTURE1)", "GL_TEXTURE1 → GL_TEXTURE0"),
        ("glDrawElementsInstanced", "20 → 1"),
        ("glBufferSubData", "240 → 12"),
    ];
    let edits = dropping_and_swapping_fails(&lines, &PASSES, check)
        + other_arguments_fail(&lines, &others, check);
    assert!(edits > 150, "{edits} edits");
}

/// What one more frame of a state does.
fn frame_of(settings: &[&str]) -> String {
    let mut bench = Bench::recorded("cmsc23700", [64, 64], settings);
    bench.set(&["redraw=every_frame"]);
    bench.picture();
    trace::take();
    bench.picture();
    trace::to_c(&trace::take())
}

/// "If there are two lights enabled, then you will have to generate two shadow maps." A light that is off has neither
/// pass nor texture.
#[test]
fn there_is_a_map_for_each_enabled_light() {
    for (settings, directional, spot) in [
        (&["lights=both"][..], 1, 1),
        (&["lights=directional"], 1, 0),
        (&["lights=spotlight"], 0, 1),
        (&["lights=both", "shadows=off"], 0, 0),
    ] {
        let frame = frame_of(settings);
        let count = |text: &str| frame.matches(text).count();
        assert_eq!(count(DIRECTIONAL_PASS), directional, "{settings:?}");
        assert_eq!(count(SPOT_PASS), spot, "{settings:?}");
        assert_eq!(count("glClear(GL_DEPTH_BUFFER_BIT);"), directional + spot);
        assert_eq!(count("glBindTexture"), directional + spot);
        assert_eq!(
            count("glBindTexture(GL_TEXTURE_2D, directionalMap)"),
            directional
        );
        assert_eq!(count("glBindTexture(GL_TEXTURE_2D, spotMap)"), spot);
        // One draw per mesh and pass.
        let passes = 1 + directional + spot;
        assert_eq!(count("glDrawElements("), 4 * passes, "{settings:?}");
        assert_eq!(count("glDrawElementsInstanced("), passes, "{settings:?}");
    }
    // Without balls there is nothing to draw of them.
    assert!(!frame_of(&["balls=0"]).contains("Instanced"));
}

/// Each map is drawn anew when a ball has moved, and only then; what stands still is not uploaded again.
#[test]
fn the_maps_are_drawn_when_they_have_changed() {
    let mut bench = Bench::recorded("cmsc23700", [64, 64], &[]);
    bench.picture();
    let mut drawn = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        let frame = trace::to_c(&trace::take());
        let passes = [DIRECTIONAL_PASS, SPOT_PASS];
        let moved = frame.contains("glBufferSubData");
        let [directional, spot] = passes.map(|pass| frame.contains(pass));
        (moved, directional, spot)
    };
    let (none, both) = ((false, false, false), (true, true, true));
    assert_eq!(drawn(&|_| ()), none);
    assert_eq!(drawn(&|bench| bench.lab.advance(0.01)), both);
    for (keys, expected) in [
        ("q", none),
        ("+", both),
        ("-", both),
        // Directional alone, whose map holds; then the spotlight alone, the same.
        ("l", none),
        ("l", none),
        // With a ball more, each of them is drawn when it is asked for.
        ("+", (true, false, true)),
        ("l", (false, true, false)),
        ("s", none),
        ("s", none),
    ] {
        assert_eq!(drawn(&|bench| bench.press(keys)), expected, "{keys}");
    }
    for (setting, expected) in [
        ("spot_bias=0", none),
        ("map_size=512", (false, true, true)),
        ("balls=0", (false, true, true)),
        ("balls=0", none),
        ("redraw=every_frame", (false, true, true)),
    ] {
        assert_eq!(drawn(&|bench| bench.set(&[setting])), expected, "{setting}");
    }
}
