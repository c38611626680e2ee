//! A frame asks no more of the driver than its scene needs: every object is drawn once in each pass, nothing is set to
//! what it is already, nothing is set in vain, and nothing is made once the program has started.

mod calls;
mod common;

use std::collections::HashMap;

use calls::{Line, in_pass, parse_c};
use common::Bench;
use shadowlab::gl::trace;
use shadowlab::labs::{Handout, Kind, LABS, Setting};

/// A lab in a state, with the passes of its frame and the draws of each.
struct Case {
    lab: &'static str,
    settings: &'static [&'static str],
    passes: &'static [(&'static str, usize)],
}

const CASES: &[Case] = &[
    Case {
        lab: "cs541",
        settings: &["redraw=every_frame"],
        passes: &[
            ("first pass: drawing the shadow map", 14),
            // The sky and the marker at the light, too.
            ("second pass: using the shadow map", 16),
        ],
    },
    Case {
        lab: "cs541",
        settings: &["redraw=every_frame", "second_plane=on", "remedy=culling"],
        passes: &[
            // The floor and the painting have a second copy.
            ("first pass: drawing the shadow map", 16),
            ("second pass: using the shadow map", 16),
        ],
    },
    Case {
        lab: "cs541",
        settings: &["redraw=every_frame", "shadows=off"],
        passes: &[("second pass: local illumination alone", 16)],
    },
    Case {
        lab: "cs541",
        settings: &["redraw=every_frame", "shadow_test=exact"],
        passes: &[
            ("the light buffer", 0),
            ("second pass: using the light buffer", 16),
        ],
    },
    Case {
        lab: "cs541",
        settings: &["redraw=every_frame", "shadow_test=offset"],
        passes: &[
            // The floor casts on nothing.
            ("first pass: drawing the fitted shadow map", 13),
            ("second pass: using the fitted shadow map", 16),
        ],
    },
    Case {
        lab: "csci3260",
        settings: &["redraw=every_frame", "shadow_test=offset"],
        passes: &[
            // The sea casts on nothing.
            ("rendering the fitted shadow map", 1),
            ("using the fitted shadow map", 2),
        ],
    },
    Case {
        lab: "csci3260",
        settings: &["redraw=every_frame", "shadow_test=offset", "scene=room"],
        passes: &[
            // The ground casts on nothing.
            ("rendering the fitted shadow map", 3),
            ("using the fitted shadow map", 4),
        ],
    },
    Case {
        lab: "csci3260",
        settings: &["redraw=every_frame", "shadow_test=exact"],
        passes: &[("the light buffer", 0), ("using the light buffer", 2)],
    },
    Case {
        lab: "csci3260",
        settings: &["redraw=every_frame"],
        passes: &[("rendering the shadow map", 2), ("using the shadow map", 2)],
    },
    Case {
        lab: "csci3260",
        settings: &["redraw=every_frame", "scene=room", "stage=culling"],
        passes: &[("rendering the shadow map", 4), ("using the shadow map", 4)],
    },
    Case {
        lab: "aueb7",
        settings: &["redraw=every_frame", "rotate_light=on"],
        passes: &[
            ("first pass: DrawSceneToShadowFBO", 3),
            // The marker at the light, too.
            ("second pass: Render", 4),
        ],
    },
    Case {
        lab: "aueb7",
        settings: &["redraw=every_frame", "scene=knossos"],
        passes: &[
            ("first pass: DrawSceneToShadowFBO", 8),
            ("second pass: Render", 9),
        ],
    },
    Case {
        lab: "cmsc23700",
        settings: &["redraw=every_frame", "balls=100"],
        passes: &[
            ("the balls' places", 0),
            ("first pass", 0),
            // Four walls, and all balls at once.
            ("first pass: the directional light's shadow map", 5),
            ("first pass: the spotlight's shadow map", 5),
            ("second pass", 5),
        ],
    },
    Case {
        lab: "cmsc23700",
        settings: &["redraw=every_frame", "balls=0", "lights=spotlight"],
        passes: &[
            ("first pass", 0),
            ("first pass: the spotlight's shadow map", 4),
            ("second pass", 4),
        ],
    },
    Case {
        lab: "aueb7",
        settings: &["redraw=every_frame", "shadow_test=exact"],
        passes: &[
            ("the light buffer", 0),
            ("second pass: Render, with the light buffer", 4),
        ],
    },
    Case {
        lab: "aueb7",
        settings: &["redraw=every_frame", "shadow_test=offset"],
        passes: &[
            // The plane casts on nothing.
            ("first pass: DrawSceneToShadowFBO, fitted", 2),
            ("second pass: Render, with the fitted map", 4),
        ],
    },
    Case {
        lab: "aueb7",
        settings: &["redraw=every_frame", "shadow_test=offset", "scene=knossos"],
        passes: &[
            // Here nothing is a floor under all the rest.
            ("first pass: DrawSceneToShadowFBO, fitted", 8),
            ("second pass: Render, with the fitted map", 9),
        ],
    },
    Case {
        lab: "cmsc23700",
        settings: &["redraw=every_frame", "shadow_test=offset"],
        passes: &[
            ("the balls' places", 0),
            ("first pass: with fitted cameras", 0),
            // Bottom and back cast on nothing, and neither does the wall that the light comes over.
            ("first pass: the directional light's fitted shadow map", 2),
            ("first pass: the spotlight's fitted shadow map", 1),
            ("second pass: with the fitted maps", 5),
        ],
    },
    Case {
        lab: "cmsc23700",
        settings: &["redraw=every_frame", "shadow_test=exact"],
        passes: &[
            ("the balls' places", 0),
            ("the directional light's buffer", 0),
            ("the spotlight's buffer", 0),
            ("second pass: with the light buffers", 5),
        ],
    },
    Case {
        lab: "eecs487",
        settings: &[],
        // The light, five walls, two occluders, and the shadows of both on each wall.
        passes: &[("drawScene", 1 + 5 + 2 + 5 * 2)],
    },
    Case {
        lab: "eecs487",
        settings: &["stencil_clipping=on"],
        // Each wall once more into the stencil buffer.
        passes: &[("drawScene", 1 + 5 + 2 + 5 * 3)],
    },
    Case {
        lab: "eecs487",
        settings: &["stencil_clipping=on", "soft_shadows=on", "num_jitters=3"],
        // Everything for each light, and one quad that accumulates it.
        passes: &[("soft shadows", 3 * (1 + 5 + 2 + 5 * 3 + 1))],
    },
    Case {
        lab: "eecs487",
        settings: &[
            "soft_shadows=on",
            "accumulator=S8",
            "accumulation=sum_then_divide",
        ],
        // And one that returns the sum.
        passes: &[("soft shadows", 2 * (1 + 5 + 2 + 5 * 2 + 1) + 1)],
    },
    Case {
        lab: "eecs487",
        settings: &["scene=ramp", "accumulation=sum_then_divide"],
        passes: &[("the ramp", 8 * 2 + 1)],
    },
    Case {
        lab: "eecs487",
        settings: &["soft_shadows=on", "soft_method=fast", "num_jitters=40"],
        // Everything once, and the umbra on two walls. The ceiling has nothing before it, and the right wall no teapot: seven
        // shadows of each light on four walls, and a quad for each of these.
        passes: &[("soft shadows, fast", 1 + 5 + 2 + 2 + 40 * 7 + 4)],
    },
];

impl Case {
    /// The calls of a frame after the first one.
    fn frame(&self) -> Vec<Line> {
        let mut bench = Bench::recorded(self.lab, [64, 64], self.settings);
        bench.picture();
        bench.lab.advance(0.1);
        trace::take();
        bench.render();
        parse_c(&trace::to_c(&trace::take()))
    }
}

/// What of the context's state a call sets, and to what; None for a call that sets nothing.
fn sets(line: &Line, now: &HashMap<String, String>) -> Option<(String, String)> {
    let args = line.args.join(", ");
    let name = line.name.as_str();
    let key = match name {
        "glUseProgram" | "glBindVertexArray" | "glViewport" | "glActiveTexture"
        | "glClearColor" | "glCullFace" | "glDepthFunc" | "glDepthMask" | "glColorMask"
        | "glPolygonMode" | "glDepthRange" | "glStencilFunc" | "glStencilOp" | "glBlendFunc"
        | "glBlendColor" | "glStencilMask" | "glPolygonOffset" => name.to_owned(),
        "glBindFramebuffer" | "glBindBuffer" => format!("{name} {}", line.args[0]),
        "glBindTexture" => format!("{name} {:?} {}", now.get("glActiveTexture"), line.args[0]),
        "glEnable" | "glDisable" => return Some((args, name.to_owned())),
        _ if name.starts_with("glUniform") => {
            format!("{:?} uniform {}", now.get("glUseProgram"), line.args[0])
        }
        _ => return None,
    };
    Some((key, args))
}

fn draws(line: &Line) -> bool {
    line.name.starts_with("glDraw")
}

/// Whether what was set until here has had a use.
fn uses(line: &Line) -> bool {
    draws(line)
        || line.name.starts_with("glClear") && line.name != "glClearColor"
        || line.name == "glBlitFramebuffer"
}

/// What is superfluous in a frame's calls, a line each.
fn superfluous(frame: &[Line]) -> Vec<String> {
    let mut found = Vec::new();
    let mut now: HashMap<String, String> = HashMap::new();
    // What was set since something was drawn or cleared, and where.
    let mut unused: HashMap<String, String> = HashMap::new();
    for line in frame.iter().filter(|line| line.heading().is_none()) {
        if uses(line) {
            unused.clear();
        } else if let Some((key, value)) = sets(line, &now) {
            if now.insert(key.clone(), value.clone()).as_ref() == Some(&value) {
                found.push(format!("{line}: so it is already"));
            }
            // One texture unit after the other is no change of mind.
            if key != "glActiveTexture"
                && let Some(earlier) = unused.insert(key, line.to_string())
            {
                found.push(format!("{earlier}: in vain, before {line}"));
            }
        } else if line.name == "glBufferSubData" {
            unused.remove(&format!("glBindBuffer {}", line.args[0]));
        } else {
            found.push(format!("{line}: not in a frame"));
        }
    }
    found
}

fn count(frame: &[Line], wanted: impl Fn(&Line) -> bool) -> usize {
    frame.iter().filter(|line| wanted(line)).count()
}

#[test]
fn a_frame_makes_no_superfluous_call() {
    for case in CASES {
        let frame = case.frame();
        let of = format!("{} {:?}", case.lab, case.settings);
        assert_eq!(superfluous(&frame), [""; 0], "{of}");
        let headings: Vec<_> = frame.iter().filter_map(Line::heading).collect();
        let passes: Vec<_> = case.passes.iter().map(|(name, _)| *name).collect();
        assert_eq!(headings, passes, "{of}");
        for (name, wanted) in case.passes {
            assert_eq!(count(in_pass(&frame, name), draws), *wanted, "{of}: {name}");
        }
        println!("{of}: {} calls", frame.len() - passes.len());
    }
}

/// The controls.
#[test]
fn superfluous_calls_are_found() {
    let frame = CASES[0].frame();
    assert_eq!(superfluous(&frame), [""; 0]);
    let with = |at: usize, call: &str| {
        let mut edited = frame.clone();
        edited.splice(at..at, parse_c(call));
        superfluous(&edited).len()
    };
    let last = frame.len();
    assert_eq!(with(last, "glBindTexture(GL_TEXTURE_2D, 77);"), 0);
    for (at, line) in frame.iter().enumerate() {
        if uses(line) || line.heading().is_some() {
            continue;
        }
        assert!(with(at, &format!("{line};")) > 0, "{line} twice");
    }
    for call in [
        "glGenTextures(1, &texture);",
        "glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, 0);",
        "glBufferData(GL_ARRAY_BUFFER, 4, data, GL_STATIC_DRAW);",
        "GLint location = glGetUniformLocation(program, \"M\");",
        "glDeleteTextures(1, &texture);",
        "glLinkProgram(program);",
        "glGetError();",
    ] {
        assert_eq!(with(last, call), 1, "{call}");
    }
}

/// Where light and casters are at rest, the map that was drawn serves on.
#[test]
fn at_rest_there_is_no_shadow_pass() {
    let has = |lab: &Handout, name: &str| lab.settings.iter().any(|setting| setting.name == name);
    let offers = |lab: &Handout, test: &str| {
        let offers = |setting: &Setting| match setting.kind {
            Kind::Choice(choices) => setting.name == "shadow_test" && choices.contains(&test),
            _ => false,
        };
        lab.settings.iter().any(offers)
    };
    let own = LABS.iter().filter(|lab| has(lab, "redraw"));
    let own = own.map(|lab| (lab, &[][..]));
    let others = ["offset", "exact"].into_iter().flat_map(|test| {
        let assignment: &[&str] = match test {
            "offset" => &["shadow_test=offset"],
            _ => &["shadow_test=exact"],
        };
        let tested = LABS.iter().filter(move |lab| offers(lab, test));
        tested.map(move |lab| (lab, assignment))
    });
    for (lab, test) in own.chain(others) {
        let mut bench = Bench::recorded(lab.name, [64, 64], test);
        let mut calls = || {
            bench.render();
            parse_c(&trace::to_c(&trace::take()))
        };
        let passes = |frame: &[Line]| count(frame, |line| line.heading().is_some());
        calls();
        let resting = calls();
        assert_eq!(passes(&resting), 1, "{}", lab.name);
        bench.set(&["redraw=every_frame"]);
        bench.render();
        let redrawn = parse_c(&trace::to_c(&trace::take()));
        assert!(passes(&redrawn) > 1, "the control: {}", lab.name);
        println!(
            "{} {test:?}: {} calls, with the shadow pass {}",
            lab.name,
            resting.len(),
            redrawn.len()
        );
    }
}
