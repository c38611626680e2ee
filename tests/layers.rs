//! The house's invariants: which room may import which, who speaks to the driver, and where `unsafe` may stand.
//!
//! The sources under `src` are read as text, without comments and strings, and held against one small table.
//! A new room fails here until it has a line in the table.

mod source;

use std::collections::BTreeSet;

use source::Source;

/// A room is a module of the crate's root; `main` is the program, of the files in [`PROGRAM`].
struct Room {
    name: &'static str,
    /// The rooms below it that it may import.
    imports: &'static [&'static str],
    /// The external crates that it may name, of those in [`FENCED`].
    crates: &'static [&'static str],
    /// Whether it calls the driver, and so may hold `unsafe` code.
    may_be_unsafe: bool,
}

const ROOMS: &[Room] = &[
    Room {
        name: "main",
        imports: &[
            "headless",
            "window",
            "report",
            "diagnosis",
            "calls",
            "mistakes",
            "own_shaders",
            "compare",
            "hard",
            "measure",
            "ground_truth",
            "labs",
            "gl",
            "scene",
            "picture",
            "progress",
            "error",
        ],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "window",
        imports: &[
            "mistakes",
            "measure",
            "ground_truth",
            "labs",
            "gl",
            "scene",
            "picture",
            "error",
        ],
        crates: &[
            "glow",
            "glutin",
            "glutin_winit",
            "winit",
            "egui",
            "egui_glow",
            "egui_winit",
        ],
        may_be_unsafe: true,
    },
    Room {
        name: "headless",
        imports: &["labs", "gl", "scene", "picture", "error"],
        crates: &["glow", "glutin"],
        may_be_unsafe: true,
    },
    // Holds a student's shaders against a lab's; makes no GL call of its own.
    Room {
        name: "own_shaders",
        imports: &[
            "headless", "compare", "labs", "gl", "glsl", "scene", "error",
        ],
        crates: &[],
        may_be_unsafe: false,
    },
    // Measures a lab in a context, whatever lab and context they are; makes no GL call of its own.
    Room {
        name: "report",
        imports: &[
            "own_shaders",
            "compare",
            "headless",
            "hard",
            "measure",
            "ground_truth",
            "labs",
            "gl",
            "scene",
            "picture",
            "progress",
            "error",
        ],
        crates: &[],
        may_be_unsafe: false,
    },
    // Holds a picture against those that somebody draws for it; knows no GL.
    Room {
        name: "diagnosis",
        imports: &["mistakes", "compare", "error"],
        crates: &[],
        may_be_unsafe: false,
    },
    // Reads the calls that somebody else's program made; makes none.
    Room {
        name: "calls",
        imports: &["mistakes", "progress", "error"],
        crates: &[],
        may_be_unsafe: false,
    },
    // Edits of what goes through `gl`; knows the labs by their names only.
    Room {
        name: "mistakes",
        imports: &["gl", "error"],
        crates: &["glow"],
        may_be_unsafe: false,
    },
    // Two pictures: needs no GL, and knows no lab.
    Room {
        name: "compare",
        imports: &[],
        crates: &[],
        may_be_unsafe: false,
    },
    // Scenes, and what is expected of figures; knows the labs by their names only.
    Room {
        name: "hard",
        imports: &["measure", "scene", "error"],
        crates: &[],
        may_be_unsafe: false,
    },
    // Knows a picture and the truth; of a lab no more than the size of its map.
    Room {
        name: "measure",
        imports: &["ground_truth", "labs", "picture"],
        crates: &[],
        may_be_unsafe: false,
    },
    // Knows no matrix of a lab, so that it cannot share its faults.
    Room {
        name: "ground_truth",
        imports: &["scene"],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "labs",
        imports: &["shadow_tests", "gl", "scene", "picture", "error"],
        crates: &["glow"],
        may_be_unsafe: true,
    },
    Room {
        name: "shadow_tests",
        imports: &["gl", "scene", "error"],
        crates: &["glow"],
        may_be_unsafe: true,
    },
    Room {
        name: "gl",
        imports: &["glsl", "scene", "picture", "error"],
        crates: &["glow"],
        may_be_unsafe: true,
    },
    // Shaders as text: needs no GL.
    Room {
        name: "glsl",
        imports: &[],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "scene",
        imports: &["picture", "progress", "error"],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "picture",
        imports: &["error"],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "progress",
        imports: &[],
        crates: &[],
        may_be_unsafe: false,
    },
    Room {
        name: "error",
        imports: &[],
        crates: &[],
        may_be_unsafe: false,
    },
];

/// The files beside `src/main.rs` that belong to the program and not to the library.
const PROGRAM: &[&str] = &["cli"];

/// The crates that only some rooms may name: the driver's calls, its contexts, windows, and the panel in one.
const FENCED: &[&str] = &[
    "glow",
    "glutin",
    "glutin_winit",
    "winit",
    "egui",
    "egui_glow",
    "egui_winit",
];

/// The files beside the labs that all labs share. Every other file or folder in `src/labs` is a lab.
const SEAM: &[&str] = &[
    "mod",
    "settings",
    "keys",
    "explanation",
    "exact",
    "chosen_test",
];

/// What the root re-exports, and the room that it comes from.
const ROOT_ITEMS: &[(&str, &str)] = &[("Error", "error"), ("Result", "error")];

#[test]
fn the_sources_keep_to_the_house() {
    let sources = source::files("src");
    let complaints = check(&sources);
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn every_room_of_the_table_exists() {
    let sources = source::files("src");
    let found: BTreeSet<String> = sources.iter().map(|s| module(&s.path)[0].clone()).collect();
    for room in ROOMS {
        assert!(found.contains(room.name), "src has no room {}", room.name);
    }
}

/// What is wrong, one line each.
fn check(sources: &[Source]) -> Vec<String> {
    let labs: BTreeSet<String> = sources
        .iter()
        .filter_map(|source| lab(&module(&source.path)).map(str::to_owned))
        .collect();
    sources
        .iter()
        .flat_map(|source| check_file(source, &labs))
        .collect()
}

fn check_file(source: &Source, labs: &BTreeSet<String>) -> Vec<String> {
    let module = module(&source.path);
    let tokens = tokens(&source.text);
    let mut complaints = Vec::new();
    let mut complain = |line: usize, text: String| {
        complaints.push(format!("{}:{line}: {text}", source.path));
    };

    // The library's root and the program's root deny unsafe code, and let nobody off.
    if matches!(module[0].as_str(), "lib" | "main") && module.len() == 1 {
        let denials = ["#![deny(unsafe_code)]", "#![forbid(unsafe_code)]"];
        let denied = source
            .text
            .lines()
            .any(|line| denials.contains(&line.trim()));
        if !denied || tokens.iter().filter(|t| t.text == "unsafe_code").count() != 1 {
            complain(1, "a root says #![deny(unsafe_code)], once".to_owned());
        }
    }
    if module[0] == "lib" {
        return complaints;
    }

    let Some(room) = ROOMS.iter().find(|room| room.name == module[0]) else {
        complain(1, format!("the room {} is not in the table", module[0]));
        return complaints;
    };

    for token in &tokens {
        let name = token.text;
        if FENCED.contains(&name) && !room.crates.contains(&name) {
            complain(token.line, format!("{} names {name}", room.name));
        }
        let root = module.len() == 1 && room.name == "main";
        let loosens = name == "unsafe" || (name == "unsafe_code" && !root);
        if loosens && !room.may_be_unsafe {
            complain(token.line, format!("{} holds `{name}`", room.name));
        }
    }

    for (line, path) in imports(&tokens, &module) {
        let shown = path.join("::");
        let target = ROOT_ITEMS
            .iter()
            .find(|(item, _)| *item == path[0])
            .map_or(path[0].as_str(), |(_, room)| room);
        if target != room.name && !room.imports.contains(&target) {
            complain(line, format!("{} imports {shown}", room.name));
        }
        // Only labs/mod.rs, the list of labs, knows the labs; each lab knows itself.
        let foreign = path.len() > 1 && labs.contains(&path[1]) && lab(&module) != Some(&path[1]);
        if target == "labs" && foreign && module != ["labs"] {
            complain(
                line,
                format!("{} imports the lab {shown}", module.join("::")),
            );
        }
    }
    complaints
}

/// The module path of a file: `src/labs/cs541/mod.rs` is `["labs", "cs541"]`, `src/cli/mod.rs` is `["main", "cli"]`.
fn module(path: &str) -> Vec<String> {
    let path = path.trim_start_matches("src/").trim_end_matches(".rs");
    let path = path.strip_suffix("/mod").unwrap_or(path);
    let names = path.split('/').map(str::to_owned);
    if PROGRAM
        .iter()
        .any(|file| path.split('/').next() == Some(file))
    {
        std::iter::once("main".to_owned()).chain(names).collect()
    } else {
        names.collect()
    }
}

/// The lab that a module belongs to.
fn lab(module: &[String]) -> Option<&str> {
    match module {
        [room, lab, ..] if room == "labs" && !SEAM.contains(&lab.as_str()) => Some(lab),
        _ => None,
    }
}

// --- reading Rust, as far as imports need it ---

/// A name, `::`, or a single sign.
#[derive(Clone, Copy, Debug)]
struct Token<'a> {
    line: usize,
    text: &'a str,
}

/// The tokens of a source without its comments, strings and characters.
fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let skipped = blank_or_literal(rest);
        let length = if skipped > 0 {
            skipped
        } else if first.is_alphanumeric() || first == '_' {
            name_length(rest)
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        if skipped == 0 {
            let line = 1 + text[..text.len() - rest.len()].matches('\n').count();
            let text = &rest[..length];
            tokens.push(Token { line, text });
        }
        rest = &rest[length..];
    }
    tokens
}

fn name_length(text: &str) -> usize {
    text.find(|c: char| !c.is_alphanumeric() && c != '_')
        .unwrap_or(text.len())
}

/// How many bytes of white space, comment, string or character the text begins with.
fn blank_or_literal(text: &str) -> usize {
    let to = |from: usize, end: &str| {
        text[from..]
            .find(end)
            .map_or(text.len(), |at| from + at + end.len())
    };
    if text.starts_with(char::is_whitespace) {
        return text.len() - text.trim_start().len();
    }
    if text.starts_with("//") {
        return to(2, "\n");
    }
    if text.starts_with("/*") {
        return to(2, "*/");
    }
    // A raw string ends at a quote with as many # as it began with.
    let raw = text.trim_start_matches(['b', 'c']);
    if let Some(raw) = raw.strip_prefix('r') {
        let quote = raw.trim_start_matches('#');
        if quote.starts_with('"') {
            let end = format!("\"{}", "#".repeat(raw.len() - quote.len()));
            return to(text.len() - quote.len() + 1, &end);
        }
    }
    // 'x' and '\n' are characters, 'x without the second quote is a lifetime.
    let mut chars = text.chars();
    match (chars.next(), chars.next(), chars.next()) {
        (Some('"'), ..) => quoted(text, '"'),
        (Some('\''), Some('\\'), _) | (Some('\''), _, Some('\'')) => quoted(text, '\''),
        _ => 0,
    }
}

/// The length of a literal that begins and ends with `quote`, where `\` takes the next sign with it.
fn quoted(text: &str, quote: char) -> usize {
    let mut signs = text.char_indices().skip(1);
    while let Some((at, sign)) = signs.next() {
        if sign == quote {
            return at + 1;
        }
        if sign == '\\' {
            signs.next();
        }
    }
    text.len()
}

/// Every path that begins with `crate`, `shadowlab`, `self` or `super`, written from the crate's root,
/// with its line. `use crate::{gl::{mesh, check}, Error}` is three paths.
fn imports(tokens: &[Token<'_>], module: &[String]) -> Vec<(usize, Vec<String>)> {
    let mut found = Vec::new();
    // The inline modules around the token, and the depth of braces at which each began.
    let mut inside: Vec<(String, usize)> = Vec::new();
    let mut depth = 0;
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let text = |offset: usize| tokens.get(at + offset).map_or("", |t| t.text);
        let follows_path = at > 0 && tokens[at - 1].text == "::";
        match token.text {
            "mod" if text(2) == "{" => inside.push((text(1).to_owned(), depth)),
            "{" => depth += 1,
            "}" => {
                depth -= 1;
                inside.pop_if(|(_, began)| *began == depth);
            }
            "crate" | "shadowlab" | "self" | "super" if !follows_path && text(1) == "::" => {
                let mut base: Vec<String> = module.to_vec();
                base.extend(inside.iter().map(|(name, _)| name.clone()));
                let began = found.len();
                at = path(tokens, at, &base, &mut found);
                // A path that names nothing more, as a bare `super::*` of a root, imports nothing.
                let imported = found.split_off(began);
                found.extend(imported.into_iter().filter(|(_, path)| !path.is_empty()));
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// Reads one path, or one tree of paths, from `at`; returns where it ends.
fn path(
    tokens: &[Token<'_>],
    mut at: usize,
    base: &[String],
    found: &mut Vec<(usize, Vec<String>)>,
) -> usize {
    let line = tokens.get(at).map_or(0, |token| token.line);
    let mut path = base.to_vec();
    while let Some(token) = tokens.get(at) {
        match token.text {
            // The program is a crate of its own, with no rooms but itself.
            "crate" if base[0] == "main" => path.truncate(1),
            "crate" | "shadowlab" => path.clear(),
            "super" => {
                path.pop();
            }
            "self" => {}
            "{" => {
                at += 1;
                while tokens.get(at).is_some_and(|token| token.text != "}") {
                    let end = self::path(tokens, at, &path, found);
                    // Past the comma, or past `as name`.
                    at = end.max(at + 1);
                    while tokens.get(at).is_some_and(|t| !matches!(t.text, "," | "}")) {
                        at += 1;
                    }
                    at += usize::from(tokens.get(at).is_some_and(|token| token.text == ","));
                }
                return at + 1;
            }
            name => path.push(name.to_owned()),
        }
        at += 1;
        if tokens.get(at).is_none_or(|token| token.text != "::") {
            break;
        }
        at += 1;
    }
    found.push((line, path));
    at
}

// --- controls: what must be reported, and what must not ---

fn complaints(path: &str, text: &str) -> Vec<String> {
    let file = |path: &str, text: &str| Source {
        path: path.to_owned(),
        text: text.to_owned(),
    };
    // A second lab, for the first one to import.
    check(&[
        file("src/labs/made_up.rs", ""),
        file("src/labs/other/mod.rs", ""),
        file(path, text),
    ])
}

#[test]
fn an_import_upward_is_reported() {
    for (path, text) in [
        ("src/gl/mesh.rs", "use crate::labs::Show;"),
        ("src/gl/mod.rs", "use super::labs;"),
        ("src/gl/mod.rs", "use crate::{Error, labs::{Show, Lab}};"),
        ("src/gl/mesh.rs", "fn f() -> super::super::labs::Show {}"),
        (
            "src/gl/mesh.rs",
            "mod tests { mod more { use super::super::super::super::labs; } }",
        ),
        (
            "src/gl/mesh.rs",
            "mod tests { } use super::super::labs::Show;",
        ),
        ("src/labs/made_up.rs", "let c = crate::headless::open()?;"),
        ("src/labs/made_up.rs", "use crate::window::View;"),
        ("src/headless.rs", "use crate::window::View;"),
        ("src/window/app.rs", "use crate::headless::Headless;"),
        ("src/scene/mod.rs", "use crate::gl::mesh as upload;"),
        ("src/picture.rs", "use crate::scene::{self};"),
        ("src/error.rs", "use crate::picture::DepthMap;"),
        ("src/scene/mod.rs", "use crate::*;"),
        (
            "src/scene/mod.rs",
            "let s = 'r'; let t = \"\\\"//\"; use crate::gl;",
        ),
        ("src/scene/mod.rs", "let s = r#\"a \" b\"#; use crate::gl;"),
        (
            "src/scene/mod.rs",
            "fn f<'a>(x: &'a str) { crate::gl::g('\\'', x) }",
        ),
    ] {
        let found = complaints(path, text);
        assert!(
            found.iter().any(|c| c.contains(" imports ")),
            "{path}: {text}: {found:?}"
        );
    }
}

#[test]
fn a_lab_that_imports_a_lab_is_reported() {
    for (path, text) in [
        ("src/labs/made_up.rs", "use super::other::Picture;"),
        ("src/labs/made_up.rs", "use crate::labs::{Show, other};"),
        (
            "src/labs/other/first_pass.rs",
            "use super::super::made_up::LIGHT;",
        ),
        ("src/labs/settings.rs", "use crate::labs::other;"),
    ] {
        let found = complaints(path, text);
        assert!(
            found.iter().any(|c| c.contains("imports the lab")),
            "{path}: {text}: {found:?}"
        );
    }
}

#[test]
fn a_room_that_names_a_fenced_crate_is_reported() {
    for (path, text) in [
        ("src/scene/mesh.rs", "use glow::HasContext;"),
        ("src/picture.rs", "fn read(gl: &glow::Context) {}"),
        ("src/gl/mod.rs", "use glutin::display::Display;"),
        ("src/headless.rs", "use winit::event_loop::EventLoop;"),
        ("src/headless.rs", "glutin_winit::finalize_window();"),
        ("src/labs/mod.rs", "use egui::Ui;"),
        ("src/labs/mod.rs", "fn key(key: winit::keyboard::Key) {}"),
        ("src/cli/mod.rs", "fn draw(gl: &glow::Context) {}"),
        (
            "src/main.rs",
            "#![deny(unsafe_code)]\nuse glow::HasContext;",
        ),
    ] {
        let found = complaints(path, text);
        assert!(
            found.iter().any(|c| c.contains(" names ")),
            "{path}: {text}: {found:?}"
        );
    }
}

#[test]
fn unsafe_code_outside_its_fence_is_reported() {
    for (path, text) in [
        ("src/scene/obj.rs", "#![allow(unsafe_code)]"),
        ("src/picture.rs", "fn f() { unsafe { g() } }"),
        ("src/main.rs", "fn main() {}"),
        ("src/lib.rs", "pub mod gl;"),
        ("src/lib.rs", "// #![deny(unsafe_code)]\npub mod gl;"),
        (
            "src/lib.rs",
            "#![deny(unsafe_code)]\n#[allow(unsafe_code)]\nmod scene;",
        ),
    ] {
        let found = complaints(path, text);
        assert!(
            found.iter().any(|c| c.contains("unsafe")),
            "{path}: {text}: {found:?}"
        );
    }
}

#[test]
fn a_room_outside_the_table_is_reported() {
    let found = complaints("src/engine/mod.rs", "");
    assert_eq!(
        found,
        ["src/engine/mod.rs:1: the room engine is not in the table"]
    );
}

#[test]
fn what_the_house_allows_is_not_reported() {
    for (path, text) in [
        (
            "src/labs/made_up.rs",
            "use super::settings::Setting; use crate::gl::{mesh, shader};",
        ),
        (
            "src/labs/made_up.rs",
            "use crate::labs::made_up::LIGHT; use super::{Lab, Show};",
        ),
        (
            "src/labs/other/mod.rs",
            "mod first_pass; use self::first_pass::draw;",
        ),
        (
            "src/labs/other/first_pass.rs",
            "use super::{super::Show, Shadow};",
        ),
        (
            "src/labs/mod.rs",
            "pub mod other; fn list() { self::other::open(); super::gl::f(); }",
        ),
        (
            "src/gl/mesh.rs",
            "#![allow(unsafe_code)]\nuse glow::HasContext; use crate::Result;",
        ),
        (
            "src/gl/mesh.rs",
            "pub(crate) fn f() {} mod tests { use super::*; }",
        ),
        (
            "src/window/canvas.rs",
            "use super::View; use crate::labs::Show; use winit::window::Window;",
        ),
        (
            "src/scene/mod.rs",
            "//! `crate::gl` draws it with glow.\n/* crate::gl */ const S: &str = \"crate::gl glow\";",
        ),
        (
            "src/scene/mod.rs",
            "const S: &str = r##\"crate::gl \"# glow\"##;",
        ),
        (
            "src/main.rs",
            "#![forbid(unsafe_code)]\nuse shadowlab::{headless, labs::{self, Show}}; use crate::f;",
        ),
        (
            "src/cli/mod.rs",
            "use shadowlab::{Error, headless}; use crate::cli::state::State; use super::fail;",
        ),
        (
            "src/lib.rs",
            "#![deny(unsafe_code)]\npub mod gl;\npub use error::Error;",
        ),
    ] {
        assert_eq!(complaints(path, text), [""; 0], "{path}: {text}");
    }
}
