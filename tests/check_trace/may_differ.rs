//! What may differ between two right programs: names, what stands in between, the order of independent calls.

use super::{assert_clean, check, dump, lab_of, wrong};

const RIGHT: &[&str] = &["legacy", "core33", "dsa45", "planar", "planar-fbo"];

/// The calls of a dump, each with all of its lines.
fn calls(text: &str) -> Vec<String> {
    let mut calls: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in text.lines() {
        match calls.last_mut().filter(|_| is_open) {
            Some(call) => *call += &format!("\n{line}"),
            None => calls.push(line.to_owned()),
        }
        is_open ^= line.matches('"').count() % 2 == 1;
    }
    calls
}

fn edited(name: &str, edit: impl Fn(usize, &str) -> String) -> String {
    let text = dump(name);
    let calls = calls(&text);
    let edited: Vec<String> = calls
        .iter()
        .enumerate()
        .map(|(at, call)| edit(at, call))
        .collect();
    edited.join("\n") + "\n"
}

#[test]
fn helpers_between_the_calls_do_not_matter() {
    const NOISE: &[&str] = &[
        "9 glGetError() = GL_NO_ERROR",
        "9 glGetIntegerv(pname = GL_VIEWPORT, params = {0, 0, 1, 1})",
        "9 glPushDebugGroup(source = GL_DEBUG_SOURCE_APPLICATION, id = 1, length = -1, message = \"a (b, c\")",
        "9 glPopDebugGroup()",
        "9 glIsEnabled(cap = GL_DEPTH_TEST) = GL_TRUE",
        "9 @3 glFlush()",
        "// a comment",
        "",
        "9 glXQueryDrawable(dpy = 0x5, draw = 2, attribute = GLX_WIDTH, value = &1)",
        "9 glObjectLabel(identifier = GL_TEXTURE, name = 1, length = -1, label = \"glClear(\")",
        "9 glPushAttrib(mask = GL_ALL_ATTRIB_BITS)\n9 glDisable(cap = GL_DEPTH_TEST)\n\
         9 glViewport(x = 0, y = 0, width = 7, height = 7)\n9 glPopAttrib()",
    ];
    for name in RIGHT {
        let whole = check(&dump(name), lab_of(name)).steps.len();
        for noise in NOISE {
            let text = edited(name, |_, call| format!("{call}\n{noise}"));
            let report = check(&text, lab_of(name));
            assert_clean(&report, 1, &format!("{name} with {noise}"));
            assert_eq!(
                report.steps.len(),
                whole,
                "{name} with {noise}: {}",
                report.text()
            );
        }
    }
}

/// The same call in another spelling.
type Spelling = fn(&str) -> String;

#[test]
fn the_spelling_of_a_dump_does_not_matter() {
    let spellings: [(&str, Spelling); 5] = [
        ("without numbers", |call| {
            call.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim_start()
                .to_owned()
        }),
        ("with threads", |call| match call.split_once(' ') {
            Some((number, rest)) if number.parse::<u64>().is_ok() => format!("{number} @0 {rest}"),
            _ => call.to_owned(),
        }),
        ("with colors", |call| {
            call.replacen(" gl", " \x1b[1mgl", 1)
                .replacen('(', "\x1b[0m(", 1)
        }),
        ("with carriage returns", |call| format!("{call}\r")),
        ("with ARB in place of EXT", |call| {
            call.replacen("EXT(", "ARB(", 1)
        }),
    ];
    for name in RIGHT {
        let found = check(&dump(name), lab_of(name));
        for (what, spell) in spellings {
            let report = check(&edited(name, |_, call| spell(call)), lab_of(name));
            assert_eq!(
                report.steps.len(),
                found.steps.len(),
                "{name} {what}: {}",
                report.text()
            );
            assert!(report.is_clean(), "{name} {what}: {}", report.text());
        }
    }
}

#[test]
fn independent_calls_may_change_places() {
    // The clearing before the viewport, the program before both.
    let text = edited("core33", |_, call| call.to_owned());
    let (viewport, program, clear) = (
        "glViewport(x = 0, y = 0, width = 256, height = 256)",
        "glUseProgram(program = 1)",
        "glClear(mask = GL_DEPTH_BUFFER_BIT)",
    );
    assert!(text.matches(viewport).count() == 2 && text.matches(clear).count() == 2);
    let swapped = text
        .replace(viewport, "FIRST")
        .replace(clear, viewport)
        .replace("FIRST", clear);
    assert_ne!(swapped, text);
    assert_clean(&check(&swapped, "cs541"), 20, "viewport behind clear");
    let swapped = text
        .replace(viewport, "FIRST")
        .replace(program, viewport)
        .replace("FIRST", program);
    assert_ne!(swapped, text);
    assert_clean(&check(&swapped, "cs541"), 20, "program before viewport");

    // The controls: behind the first pass they are too late.
    let restored = "glBindFramebuffer(target = GL_FRAMEBUFFER, framebuffer = 0)";
    for late in [viewport, clear] {
        let moved = text
            .replace(late, "glFlush()")
            .replace(restored, &format!("{restored}\n9 {late}"));
        assert!(!check(&moved, "cs541").is_clean(), "{late}");
    }
}

#[test]
fn names_and_sizes_may_differ() {
    let text = dump("core33");
    let renamed = text
        .replace("framebuffer = 1)", "framebuffer = 4711)")
        .replace("framebuffers = &1)", "framebuffers = &4711)")
        .replace("framebuffers = {1}", "framebuffers = {4711}")
        .replace("256", "2048");
    assert_ne!(renamed, text);
    assert_clean(&check(&renamed, "cs541"), 20, "renamed");
    // The control: the size of the texture alone.
    let resized = text.replace(
        "width = 256, height = 256, border",
        "width = 512, height = 512, border",
    );
    assert_ne!(resized, text);
    assert!(!check(&resized, "cs541").is_clean());
}

/// Every call of the second frame that matters, left out of a right program: a check that looks at nothing passes here.
#[test]
fn a_call_that_is_left_out_is_told() {
    for (name, matter) in [
        (
            "core33",
            &[
                "glViewport(",
                "glClear(mask = GL_DEPTH_BUFFER_BIT)",
                "glUseProgram(",
            ][..],
        ),
        (
            "dsa45",
            &[
                "glViewport(",
                "glClearNamedFramebufferfv(",
                "glBindTextureUnit(unit = 1",
            ],
        ),
        (
            "legacy",
            &[
                "glBindFramebufferEXT(target = GL_FRAMEBUFFER, framebuffer = 0",
                "glClear(",
            ],
        ),
        (
            "planar",
            &[
                "glStencilFunc(func = GL_EQUAL",
                "glPolygonOffset",
                "glClear(mask = GL_STENCIL",
                "glAccum(op = GL_RETURN",
            ],
        ),
        (
            "planar-fbo",
            &[
                "glBlitFramebuffer",
                "glEnable(cap = GL_POLYGON_OFFSET_FILL)",
            ],
        ),
    ] {
        for call in matter {
            let text = edited(name, |_, line| {
                if line.contains(call) {
                    String::new()
                } else {
                    line.to_owned()
                }
            });
            let report = check(&text, lab_of(name));
            assert!(
                !wrong(&report).is_empty(),
                "{name} without {call}: {}",
                report.text()
            );
        }
    }
}

/// Frames that differ: the first draws no map, the last draws no shadows, one behind it is not whole.
#[test]
fn the_steady_frame_is_judged() {
    let text = dump("core33");
    let all = calls(&text);
    let is_swap = |call: &&String| call.contains("eglSwapBuffers");
    let start = all
        .iter()
        .position(|call| call.contains("glClear("))
        .unwrap();
    let swaps: Vec<usize> = (0..all.len()).filter(|at| is_swap(&&all[*at])).collect();
    let frame = &all[swaps[0] + 1..=swaps[1]];
    let no_shadows = "9 glViewport(x = 0, y = 0, width = 320, height = 240)\n9 glDrawArrays(mode = GL_TRIANGLES, first = 0, count = 3)\n9 eglSwapBuffers(dpy = 1, surface = 2) = EGL_TRUE";
    let begun = frame[..frame.len() / 3].join("\n");
    let text = format!(
        "{}\n{no_shadows}\n{}\n{no_shadows}\n{begun}\n",
        all[..start].join("\n"),
        frame.join("\n")
    );
    let report = check(&text, "cs541");
    assert_eq!(report.frames, 3);
    assert_clean(&report, 20, "three frames");
    // The control: the same frame without the clearing of its map.
    let wrong = text.replace("glClear(mask = GL_DEPTH_BUFFER_BIT)", "glFlush()");
    assert!(!check(&wrong, "cs541").is_clean());
}
