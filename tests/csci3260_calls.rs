//! The slides' sequence of GL calls, held against `shadowlab trace csci3260`, and against what apitrace sees from outside
//! when the program draws its picture.

mod calls;
mod common;

use calls::record::{dropping_and_swapping_fails, other_arguments_fail, seen_from_outside, traced};
use calls::{Line, exactly, find_in_order, in_pass};
use common::{Bench, work_folder};
use shadowlab::gl::trace;

const SET_UP_PASS: &str = "set-up: the render target of the shadow map";
const FIRST_PASS: &str = "rendering the shadow map";

/// "Setting up the render target", with the departures of the README: swizzle and read buffer.
const SET_UP: &[&str] = &[
    "glGenFramebuffers(1, $shadowFramebuffer)",
    "glGenTextures(1, $depthTexture)",
    "glBindTexture(GL_TEXTURE_2D, $depthTexture)",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024, 1024, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE)",
    "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE)",
    "glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, _)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $shadowFramebuffer)",
    "glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, $depthTexture, 0)",
    "glDrawBuffer(GL_NONE)",
    "glReadBuffer(GL_NONE)",
    "GL_FRAMEBUFFER_COMPLETE = glCheckFramebufferStatus(GL_FRAMEBUFFER)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
];

/// `installShaders` and `installShadowMapShaders`. The slides look a location up where they set it; here that is done
/// once.
const LOOK_UPS: &[&str] = &[
    "$programID = glCreateProgram()",
    "glLinkProgram($programID)",
    "$MVP = glGetUniformLocation($programID, \"MVP\")",
    "$DepthBiasMVP = glGetUniformLocation($programID, \"DepthBiasMVP\")",
    "$shadowMapID = glGetUniformLocation($programID, \"shadowMap\")",
    "$TextureID = glGetUniformLocation($programID, \"objTexture\")",
    "$shadowMapProgramID = glCreateProgram()",
    "glLinkProgram($shadowMapProgramID)",
    "$depthMatrixLocation = glGetUniformLocation($shadowMapProgramID, \"depthMVP\")",
];

/// "Render shadow map", of the dolphin and the sea.
const RENDER_SHADOW_MAP: &[&str] = &[
    "glUseProgram($shadowMapProgramID)",
    "glBindFramebuffer(GL_FRAMEBUFFER, $shadowFramebuffer)",
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    "glViewport(0, 0, 1024, 1024)",
    "glUniformMatrix4fv($depthMatrixLocation, 1, GL_FALSE, _)",
    "glBindVertexArray($dolphinObj)",
    "glDrawElements(GL_TRIANGLES, _, GL_UNSIGNED_INT, 0)",
    "glUniformMatrix4fv($depthMatrixLocation, 1, GL_FALSE, _)",
    "glBindVertexArray($seaObj)",
    "glDrawElements(GL_TRIANGLES, 36, GL_UNSIGNED_INT, 0)",
];

/// "Using the basic shader". Texture unit 1 and the samplers' units are set once, for all models.
const USE_SHADOW_MAP: &[&str] = &[
    "glUseProgram($programID)",
    "glBindFramebuffer(GL_FRAMEBUFFER, 0)",
    "glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)",
    "glViewport(0, 0, 800, 600)",
    "glActiveTexture(GL_TEXTURE1)",
    "glBindTexture(GL_TEXTURE_2D, $depthTexture)",
    "glUniform1i($shadowMapID, 1)",
    "glUniform1i($TextureID, 0)",
    "glActiveTexture(GL_TEXTURE0)",
    "glBindTexture(GL_TEXTURE_2D, $dolphin_texture)",
    "glUniformMatrix4fv($MVP, 1, GL_FALSE, _)",
    "glUniformMatrix4fv($DepthBiasMVP, 1, GL_FALSE, _)",
    "glBindVertexArray($dolphinObj)",
    "glDrawElements(GL_TRIANGLES, _, GL_UNSIGNED_INT, 0)",
    "glBindTexture(GL_TEXTURE_2D, $sea_texture)",
    "glBindVertexArray($seaObj)",
    "glDrawElements(GL_TRIANGLES, 36, GL_UNSIGNED_INT, 0)",
];

/// Set-up and first pass must be these calls and no others; the rest must be there, in order.
fn check(lines: &[Line]) -> Result<(), String> {
    exactly(in_pass(lines, SET_UP_PASS), SET_UP)?;
    exactly(in_pass(lines, FIRST_PASS), RENDER_SHADOW_MAP)?;
    let all = [SET_UP, LOOK_UPS, RENDER_SHADOW_MAP, USE_SHADOW_MAP].concat();
    find_in_order(lines, &all).map(|_| ())
}

#[test]
fn the_trace_is_the_slides_sequence() {
    check(&traced("csci3260")).unwrap();
}

#[test]
fn apitrace_sees_the_slides_sequence() {
    check(&seen_from_outside(
        "csci3260",
        &work_folder("apitrace-csci3260"),
    ))
    .unwrap();
}

/// The controls: every call that the slides ask for, dropped, swapped with the next one, given another argument.
#[test]
fn an_edited_stream_fails() {
    let lines = traced("csci3260");
    check(&lines).unwrap();
    let others = [
        (
            "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024",
            "1024 → 512",
        ),
        (
            "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST",
            "GL_NEAREST → GL_LINEAR",
        ),
        (
            "glFramebufferTexture",
            "GL_DEPTH_ATTACHMENT → GL_COLOR_ATTACHMENT0",
        ),
        ("glFramebufferTexture", "depthTexture → sea_texture"),
        ("glDrawBuffer", "GL_NONE → GL_COLOR_ATTACHMENT0"),
        ("glViewport(0, 0, 1024, 1024)", "1024 → 800"),
        ("glViewport(0, 0, 800, 600)", "800 → 512"),
        (
            "glUseProgram(shadowMapProgramID)",
            "shadowMapProgramID → programID",
        ),
        ("glActiveTexture(GL_TEXTURE1)", "GL_TEXTURE1 → GL_TEXTURE0"),
        // The slip of the slides: with a space behind its name the uniform has no location.
        ("\"depthMVP\"", "\"depthMVP\" → \"depthMVP \""),
    ];
    let edits = dropping_and_swapping_fails(&lines, &[SET_UP_PASS, FIRST_PASS], check)
        + other_arguments_fail(&lines, &others, check);
    assert!(edits > 45, "{edits} edits");
}

/// The original culling face comes back behind the shadow map, and the second pass culls nothing.
#[test]
fn front_faces_are_culled_in_the_shadow_map_alone() {
    let mut bench = Bench::recorded("csci3260", [64, 64], &["stage=culling"]);
    bench.picture();
    let text = trace::to_c(&trace::take());
    let culling = [
        "// rendering the shadow map",
        "glEnable(GL_CULL_FACE)",
        "glCullFace(GL_FRONT)",
        "glDrawElements(GL_TRIANGLES, ...)",
        "glCullFace(GL_BACK)",
        "glDisable(GL_CULL_FACE)",
        "// using the shadow map",
        "glDrawElements(GL_TRIANGLES, ...)",
    ];
    find_in_order(&calls::parse_c(&text), &culling).unwrap();
    assert_eq!(text.matches("CullFace").count(), 2);
}

/// The map is drawn anew when the light or a caster has changed, and only then.
#[test]
fn the_shadow_map_is_rendered_when_it_has_changed() {
    let mut bench = Bench::recorded("csci3260", [64, 64], &["redraw=when_changed"]);
    bench.picture();
    let mut map_is_drawn = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        trace::to_c(&trace::take()).contains("// rendering the shadow map")
    };
    for (change, drawn) in [
        ("", false),
        ("24ws<Drag:5,5>", false),
        ("<Up>", true),
        ("<Left>", true),
    ] {
        assert_eq!(
            map_is_drawn(&|bench| bench.press(change)),
            drawn,
            "{change}"
        );
    }
    for (change, drawn) in [
        ("bias=0.01", false),
        ("stage=slope", false),
        ("stage=thick", false),
        ("stage=culling", true),
        ("map_size=512", true),
        ("scene=room", true),
        ("stage=thick", true),
        ("shadows=off", false),
    ] {
        assert_eq!(
            map_is_drawn(&|bench| bench.set(&[change])),
            drawn,
            "{change}"
        );
    }
    let every_frame = ["shadows=on", "redraw=every_frame"];
    assert!(map_is_drawn(&|bench| bench.set(&every_frame)));
}
