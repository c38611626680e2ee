//! The reader of calls and its steps, before any lab is judged by them: what must be found is found, and what must
//! not be found is missed.

mod calls;

use calls::{Line, exactly, find_in_order, in_pass, parse_apitrace, parse_c};

/// What `trace::to_c` writes: another texture comes first, and the shadow map's objects are not named.
const C: &str = r#"
// setting up
GLuint program = glCreateProgram();
glShaderSource(shader_1, 1, &source, &length);
glGetShaderiv(shader_1, GL_COMPILE_STATUS, &value);  // 1
glGenTextures(1, &texture_1);
glBindTexture(GL_TEXTURE_2D, texture_1);
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, data);  // 12 bytes
glGenFramebuffers(1, &framebuffer_1);
glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_1);
glGenTextures(1, &texture_2);
glBindTexture(GL_TEXTURE_2D, texture_2);
glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1024, 1024, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0);
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);
glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, (const GLint[]){GL_RED, GL_RED, GL_RED, GL_ONE});
glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_2, 0);
glDrawBuffer(GL_NONE);
GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);  // GL_FRAMEBUFFER_COMPLETE

// first pass
glViewport(0, 0, 1024, 1024);
glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
GLint location = glGetUniformLocation(program, "a (shadow), b");  // 1
glUniform1i(1, 3);  // a (shadow), b
glUniform3fv(2, 1, (const GLfloat[]){0.70710677, 0, 1});  // light
glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 24, (const void *)12);
glStencilMask(0xFF);
glDrawBuffers(1, (const GLenum[]){GL_BACK});
"#;

/// The same calls as apitrace dumps them.
const APITRACE: &str = r##"// process.name = "lab"
11 eglInitialize(dpy = 0x7ffb58010f70, major = &1, minor = &5) = EGL_TRUE
21 glViewport(x = 0, y = 0, width = 64, height = 64) // fake
960 glPushDebugGroup(source = GL_DEBUG_SOURCE_APPLICATION, id = 0, length = 10, message = "setting up")
963 glCreateProgram() = 1
965 glShaderSource(shader = 1, count = 1, string = &"#version 330 core
12 in vec4 position; // \"quoted\"
void main() { }", length = &117)
967 glGetShaderiv(shader = 1, pname = GL_COMPILE_STATUS, params = &1)
971 glGenTextures(n = 1, textures = &1)
972 glBindTexture(target = GL_TEXTURE_2D, texture = 1)
973 glTexImage2D(target = GL_TEXTURE_2D, level = 0, internalformat = GL_RGB8, width = 2, height = 2, border = 0, format = GL_RGB, type = GL_UNSIGNED_BYTE, pixels = blob(12))
974 glGenFramebuffers(n = 1, framebuffers = &1)
975 glBindFramebuffer(target = GL_FRAMEBUFFER, framebuffer = 1)
976 glGenTextures(n = 1, textures = &2)
977 glBindTexture(target = GL_TEXTURE_2D, texture = 2)
978 glTexImage2D(target = GL_TEXTURE_2D, level = 0, internalformat = GL_DEPTH_COMPONENT, width = 1024, height = 1024, border = 0, format = GL_DEPTH_COMPONENT, type = GL_FLOAT, pixels = NULL)
979 glTexParameteri(target = GL_TEXTURE_2D, pname = GL_TEXTURE_COMPARE_MODE, param = GL_ZERO)
980 glTexParameteriv(target = GL_TEXTURE_2D, pname = GL_TEXTURE_SWIZZLE_RGBA, params = {6403, 6403, 6403, 1})
981 glFramebufferTexture2D(target = GL_FRAMEBUFFER, attachment = GL_DEPTH_ATTACHMENT, textarget = GL_TEXTURE_2D, texture = 2, level = 0)
982 glDrawBuffer(mode = GL_ZERO)
983 glCheckFramebufferStatus(target = GL_FRAMEBUFFER) = GL_FRAMEBUFFER_COMPLETE
984 glPopDebugGroup()
985 glPushDebugGroup(source = GL_DEBUG_SOURCE_APPLICATION, id = 0, length = 10, message = "first pass")
986 glViewport(x = 0, y = 0, width = 1024, height = 1024)
987 glClear(mask = GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT)
988 glGetUniformLocation(program = 1, name = "a (shadow), b") = 1
989 glUniform1i(location = 1, v0 = 3)
990 glUniform3fv(location = 2, count = 1, value = {0.7071068, 0, 1})
991 glVertexAttribPointer(index = 1, size = 3, type = GL_FLOAT, normalized = GL_FALSE, stride = 24, pointer = 0xc)
992 glStencilMask(mask = 255)
993 glDrawBuffers(n = 1, bufs = &GL_BACK)
994 glPopDebugGroup()
995 eglSwapBuffers(dpy = 0x7ffb58010f70, surface = 0x7ffb58010f71) = EGL_TRUE
"##;

/// Objects have a number in one text, and kind and number in the other.
fn with_numbers(mut lines: Vec<Line>) -> Vec<Line> {
    let kinds = ["texture_", "framebuffer_", "shader_"];
    for line in &mut lines {
        for arg in line.args.iter_mut().chain(&mut line.result) {
            if arg == "program" {
                *arg = "1".to_owned();
            }
            for kind in kinds {
                if let Some(number) = arg.strip_prefix(kind) {
                    *arg = number.to_owned();
                }
            }
        }
    }
    lines
}

#[test]
fn both_texts_are_the_same_lines() {
    let (c, apitrace) = (with_numbers(parse_c(C)), parse_apitrace(APITRACE));
    for (c, apitrace) in c.iter().zip(&apitrace) {
        assert_eq!(c, apitrace);
    }
    assert_eq!(c.len(), apitrace.len());
}

#[test]
fn a_line_has_a_name_arguments_and_a_result() {
    let lines = parse_c(C);
    assert_eq!(lines[0].heading(), Some("setting up"));
    assert_eq!(lines[1].to_string(), "program = glCreateProgram()");
    let status = lines
        .iter()
        .find(|line| line.name == "glCheckFramebufferStatus");
    assert_eq!(
        status.unwrap().result.as_deref(),
        Some("GL_FRAMEBUFFER_COMPLETE")
    );
    let location = lines
        .iter()
        .find(|line| line.name == "glGetUniformLocation");
    let location = location.unwrap();
    assert_eq!(location.args, ["program", "\"a (shadow), b\""]);
    assert_eq!(location.result.as_deref(), Some("1"));
}

#[test]
#[should_panic(expected = "not a C call: glFinish;")]
fn a_line_that_is_no_call_is_not_passed_over() {
    parse_c("glFinish;");
}

/// The handout's steps: the texture is the second one that is generated.
const STEPS: [&str; 8] = [
    "glGenTextures(1, &$depth_texture)",
    "glBindTexture(GL_TEXTURE_2D, $depth_texture);",
    "glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, $size, $size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0);",
    "glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, $depth_texture, 0);",
    "// first pass",
    "glClear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT)",
    "GLint $location = glGetUniformLocation($program, _);",
    "glUniform1i($location, ...)",
];

#[test]
fn steps_are_found_in_both_texts_and_bind_the_right_objects() {
    for (lines, texture, program) in [
        (parse_c(C), "texture_2", "program"),
        (parse_apitrace(APITRACE), "2", "1"),
    ] {
        let bindings = find_in_order(&lines, &STEPS).unwrap();
        assert_eq!(bindings["depth_texture"], texture);
        assert_eq!(bindings["size"], "1024");
        assert_eq!(bindings["program"], program);
        assert_eq!(bindings["location"], "1");
    }
}

/// The controls: each of the calls that a step needs is dropped, moved before its predecessor, or changed.
#[test]
fn a_dropped_call_is_missed() {
    let lines = parse_c(C);
    find_in_order(&lines, &STEPS).unwrap();
    for (name, step) in [
        ("glTexImage2D", 3),
        ("glFramebufferTexture2D", 4),
        ("//", 5),
        ("glClear", 6),
        ("glGetUniformLocation", 7),
        ("glUniform1i", 8),
    ] {
        let dropped: Vec<_> = lines
            .iter()
            .filter(|line| line.name != name)
            .cloned()
            .collect();
        let error = find_in_order(&dropped, &STEPS).unwrap_err();
        let start = format!("step {step} of 8 is missing: {}", STEPS[step - 1]);
        assert!(error.starts_with(&start), "{name}: {error}");
    }
}

#[test]
fn a_swapped_call_is_missed() {
    let lines = parse_c(C);
    let place = |name| lines.iter().position(|line| line.name == name).unwrap();
    for (one, other, step) in [
        ("glUniform1i", "glGetUniformLocation", "step 8"),
        ("glFramebufferTexture2D", "glClear", "step 5"),
        ("glClear", "glUniform1i", "step 7"),
    ] {
        let mut swapped = lines.clone();
        swapped.swap(place(one), place(other));
        let error = find_in_order(&swapped, &STEPS).unwrap_err();
        assert!(error.starts_with(step), "{one} and {other}: {error}");
    }
}

#[test]
fn a_changed_argument_is_missed() {
    for (from, to, step) in [
        (
            "GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_2",
            "GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_1",
            "step 4",
        ),
        ("GL_COLOR_BUFFER_BIT | ", "", "step 6"),
        (
            "1024, 1024, 0, GL_DEPTH",
            "1024, 512, 0, GL_DEPTH",
            "step 3",
        ),
        ("glUniform1i(1, 3)", "glUniform1i(2, 3)", "step 8"),
        ("GL_FLOAT, 0)", "GL_UNSIGNED_INT, 0)", "step 3"),
        ("// first pass", "// second pass", "step 5"),
    ] {
        let changed = C.replace(from, to);
        assert_ne!(changed, C, "{from} is not in the text");
        let error = find_in_order(&parse_c(&changed), &STEPS).unwrap_err();
        assert!(error.starts_with(step), "{to}: {error}");
    }
}

#[test]
fn the_error_says_what_was_bound_and_where_the_search_stood() {
    let lines = parse_c("glGenTextures(1, &texture_4);\nglBindTexture(GL_TEXTURE_2D, texture_5);");
    assert_eq!(
        find_in_order(&lines, &STEPS[..2]).unwrap_err(),
        "step 2 of 2 is missing: glBindTexture(GL_TEXTURE_2D, $depth_texture);, \
         after line 1, glGenTextures(1, texture_4), with {\"depth_texture\": \"texture_4\"}"
    );
    assert_eq!(
        find_in_order(&[], &["glFinish()"]).unwrap_err(),
        "step 1 of 1 is missing: glFinish(), with {}"
    );
}

/// The steps bind an object, and the calls that work on it must do so while it is bound.
#[test]
fn a_call_for_another_object_is_not_the_one_that_is_looked_for() {
    let good = "glGenTextures(1, &shadow_map);\n\
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);\n\
        glUseProgram(program);\n\
        glActiveTexture(GL_TEXTURE1);\n\
        glBindTexture(GL_TEXTURE_2D, shadow_map);\n\
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);\n\
        glUniform1i(3, 1);\n\
        glClear(GL_DEPTH_BUFFER_BIT);\n";
    let steps = [
        "glGenTextures(1, &$shadow_map)",
        "glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer)",
        "glUseProgram(program)",
        "glBindTexture(GL_TEXTURE_2D, $shadow_map)",
        "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)",
        "glUniform1i(_, 1)",
        "glClear(GL_DEPTH_BUFFER_BIT)",
    ];
    find_in_order(&parse_c(good), &steps).unwrap();
    // What is bound elsewhere changes nothing, and unit 0 is the one at start.
    let at_start = good.replace("glActiveTexture(GL_TEXTURE1);\n", "");
    find_in_order(&parse_c(&at_start), &steps).unwrap();
    for (text, before, between) in [
        (
            at_start.as_str(),
            "glTexParameteri",
            "glActiveTexture(GL_TEXTURE0);\n",
        ),
        (
            good,
            "glTexParameteri",
            "glBindTexture(GL_TEXTURE_CUBE_MAP, sky);\n",
        ),
        (
            good,
            "glClear",
            "glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);\n",
        ),
        (good, "glClear", "glUseProgram(0);\n"),
    ] {
        let text = text.replace(before, &format!("{between}{before}"));
        find_in_order(&parse_c(&text), &steps).unwrap();
    }
    // The controls: another object in its place.
    for (before, between, step) in [
        (
            "glTexParameteri",
            "glBindTexture(GL_TEXTURE_2D, wood);\n",
            5,
        ),
        ("glTexParameteri", "glActiveTexture(GL_TEXTURE0);\n", 5),
        ("glUniform1i", "glUseProgram(shadow_program);\n", 6),
        ("glClear", "glBindFramebuffer(GL_FRAMEBUFFER, 0);\n", 7),
        ("glClear", "glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);\n", 7),
    ] {
        let text = good.replace(before, &format!("{between}{before}"));
        let error = find_in_order(&parse_c(&text), &steps).unwrap_err();
        assert!(
            error.starts_with(&format!("step {step} of 7")),
            "{between}{error}"
        );
        assert!(error.ends_with("has it, for another object"), "{error}");
    }
}

/// Sixty textures and steps that no choice of four of them fulfils: the search ends, and says why.
#[test]
fn the_search_is_bounded() {
    let text: String = (0..60)
        .map(|id| format!("glGenTextures(1, &texture_{id});\n"))
        .collect();
    let steps = [
        "glGenTextures(1, $a)",
        "glGenTextures(1, $b)",
        "glGenTextures(1, $c)",
        "glGenTextures(1, $d)",
        "glFinish()",
    ];
    let error = find_in_order(&parse_c(&text), &steps).unwrap_err();
    assert!(error.starts_with("gave up after"), "{error}");
}

#[test]
fn exactly_means_no_call_more_and_none_less() {
    let pass = "// first pass\nglViewport(0, 0, 8, 8);\nglClear(GL_DEPTH_BUFFER_BIT);\n";
    let lines = parse_c(pass);
    let steps = [
        "glViewport(0, 0, $size, $size)",
        "glClear(GL_DEPTH_BUFFER_BIT)",
    ];
    assert_eq!(exactly(&lines, &steps).unwrap()["size"], "8");
    exactly(&lines, &["// first pass", steps[0], steps[1]]).unwrap();
    // The controls.
    for (expected, error) in [
        (
            &steps[..1],
            "after the 1 steps comes glClear(GL_DEPTH_BUFFER_BIT)",
        ),
        (
            &[steps[1], steps[0]][..],
            "step 1 of 2 is glViewport(0, 0, 8, 8), not glClear",
        ),
        (
            &[steps[0], steps[1], "glFinish()"][..],
            "step 3 of 3 is missing at the end: glFinish()",
        ),
        (
            &["// second pass", steps[0], steps[1]][..],
            "step 1 of 3 is // first pass, not // second",
        ),
        (
            &["glViewport(0, 0, $size, $size)", "glClear($size)"][..],
            "step 2 of 2 is glClear",
        ),
        (&["glViewport(0, 0, 8)", steps[1]][..], "step 1 of 2 is"),
    ] {
        let found = exactly(&lines, expected).unwrap_err();
        assert!(found.starts_with(error), "{found}");
    }
}

#[test]
fn a_pass_ends_at_the_next_heading() {
    let lines = parse_c(C);
    let first = in_pass(&lines, "first pass");
    assert_eq!(first[0].name, "glViewport");
    assert_eq!(first.last().unwrap().name, "glDrawBuffers");
    let setting_up = in_pass(&lines, "setting up");
    assert_eq!(setting_up.last().unwrap().name, "glCheckFramebufferStatus");
}
