//! What is no dump, the exit codes, and JSON.

use std::process::{Command, Output};

use super::{dump, folder, try_check};

fn told(text: &[u8]) -> String {
    match try_check(text, "cs541") {
        Err(error) => error.to_string(),
        Ok(report) => panic!("{}", report.text()),
    }
}

#[test]
fn what_is_no_dump_is_told_in_a_line() {
    let right = dump("core33");
    let cut = |at: usize| right.as_bytes()[..at].to_vec();
    let in_call = right.find("glTexImage2D").unwrap() + 20;
    let in_source = right.find("#version 330").unwrap() + 20;
    let many_lines = "hello, world\n".repeat(200);
    let endless = [
        b"1 glShaderSource(shader = 1, count = 1, string = &\"".to_vec(),
        vec![b'x'; 20 << 20],
    ]
    .concat();
    for (what, text, words) in [
        (
            "empty",
            Vec::new(),
            &["dump.txt: found no GL call", "apitrace dump"][..],
        ),
        ("blank", b"\n\n \n".to_vec(), &["found no GL call"]),
        (
            "prose",
            b"hello\nworld\n".to_vec(),
            &["dump.txt:1: found no GL call"],
        ),
        (
            "much prose",
            many_lines.into_bytes(),
            &["dump.txt:1: found \"hello, world\"", "expected a GL call"],
        ),
        (
            "binary",
            vec![0; 5000],
            &[
                "dump.txt:1: found a binary file",
                "apitrace dump program.trace",
            ],
        ),
        (
            "a trace of apitrace",
            b"at\x01\xff\xfe\x00\x80\n".to_vec(),
            &["found a binary file"],
        ),
        (
            "cut in a call",
            cut(in_call),
            &["expected a GL call", "glTexImage2D"],
        ),
        (
            "cut in a source",
            cut(in_source),
            &["ends inside of this call", "a whole dump"],
        ),
        (
            "an endless call",
            endless,
            &["dump.txt:1: a call of more than 16 MiB"],
        ),
        (
            "a line without end",
            vec![b'x'; 20 << 20],
            &["dump.txt:1: a call of more than 16 MiB"],
        ),
    ] {
        let told = told(&text);
        for word in words {
            assert!(told.contains(word), "{what}: {told}");
        }
        assert_eq!(told.lines().count(), 1, "{what}: {told}");
        assert!(told.len() < 300, "{what}: {told}");
    }
}

/// What a shell or a driver wrote between the calls is left out, and told.
#[test]
fn a_few_other_lines_are_left_out() {
    let text = format!(
        "$ apitrace dump a.trace\n{}Segmentation fault\n",
        dump("core33")
    );
    let report = try_check(text.as_bytes(), "cs541").unwrap();
    assert_eq!(report.other, Some((1, 2)));
    assert!(report.is_clean() && report.text().contains("2 lines are no call"));
}

/// More objects than a program has, deep lists, long lists: an end, and no more memory than a little.
#[test]
fn hostile_dumps_end() {
    let mut objects = String::new();
    for id in 0..(1 << 20) + 2 {
        objects += &format!("glBindTexture(GL_TEXTURE_2D, {id})\n");
    }
    assert!(told(objects.as_bytes()).contains("more than a million GL objects"));
    let deep = format!("1 glFoo({})\n2 glClear(mask = 0)\n", "{".repeat(1 << 20));
    assert!(told(deep.as_bytes()).contains("expected a GL call"));
    let long = format!("1 glUniform1iv(0, 1, {{{}}})\n", "1, ".repeat(1 << 20));
    assert!(!try_check(long.as_bytes(), "cs541").unwrap().is_clean());
    let huge = "glGetUniformLocation(1, \"map\") = 1e300\nglUseProgram(1)\n\
                glUniform1iv(9223372036854775807, 2, {1e300, 2})\nglBindTextures(1e300, 2, {1, 2})\n\
                glBegin(GL_POINTS)\nglEnd()\n";
    assert!(!try_check(huge.as_bytes(), "cs541").unwrap().is_clean());
    let mut stacks = "glPushMatrix()\nglPushAttrib(1)\n".repeat(100_000);
    stacks += "glNewList(1, GL_COMPILE)\nglViewport(NAN, 1e300, -INFINITY, 3)\nglEndList()\n";
    assert!(!try_check(stacks.as_bytes(), "eecs487").unwrap().is_clean());
}

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .arg("check-trace")
        .args(args)
        .output()
        .unwrap()
}

#[test]
fn exit_codes_and_json() {
    let path = |name: &str| folder().join(name).to_str().unwrap().to_owned();
    let [right, wrong] = ["core33.txt", "core33-row_major.txt"].map(path);
    for (args, code) in [
        (vec![right.as_str(), "cs541"], 0),
        (vec![wrong.as_str(), "cs541"], 1),
        (vec![wrong.as_str(), "cs541", "--json"], 1),
        (vec![wrong.as_str(), "cs999"], 2),
        (vec!["/nonexistent/dump.txt", "cs541"], 2),
        (vec!["/", "cs541"], 2),
        (vec![right.as_str()], 2),
    ] {
        let ran = run(&args);
        let errors = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(code), "{args:?}: {errors}");
        assert_eq!(
            errors.lines().count(),
            usize::from(code == 2),
            "{args:?}: {errors}"
        );
        assert_eq!(ran.stdout.is_empty(), code == 2, "{args:?}");
    }

    let text = String::from_utf8(run(&[&wrong, "cs541"]).stdout).unwrap();
    let json = run(&[&wrong, "cs541", "--json"]).stdout;
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(json["lab"], "cs541");
    assert_eq!(json["frames"], 2);
    let steps = json["steps"].as_array().unwrap();
    let step = steps
        .iter()
        .find(|step| step["mistake"] == "row_major")
        .unwrap();
    assert_eq!(step["verdict"], "other arguments");
    assert!(text.contains(step["found"].as_str().unwrap()));
    assert!(text.contains("✗") && text.contains("✓") && text.contains("mistake: row_major"));
    let wrong = steps
        .iter()
        .filter(|step| step["verdict"] != "found" && step["verdict"] != "not certain");
    assert_eq!(json["wrong"], wrong.count());
}
