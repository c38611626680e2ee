//! GLSL text, looked over for what it declares, and in which lines. Only the driver knows what of it has an effect.
//!
//! A parser it is not: what it does not understand it passes by, as text from anywhere is not always GLSL.

mod tokens;

use std::collections::HashMap;

pub use tokens::Version;
use tokens::{Token, tokens};

/// What a shader's text has at its top level.
#[derive(Debug, Default)]
pub struct Scan<'t> {
    pub version: Option<Version<'t>>,
    pub declared: Vec<Declared<'t>>,
    pub functions: Vec<Function<'t>>,
    /// Every word of it, those of the declarations included: the first line that has it, and how often it is there.
    words: HashMap<&'t str, (usize, usize)>,
}

/// A variable that another stage or the program fills or reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared<'t> {
    pub storage: Storage,
    /// The type, as it is written.
    pub kind: &'t str,
    pub name: &'t str,
    /// Of `layout(location = 0)`.
    pub location: Option<u32>,
    pub line: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Storage {
    In,
    Out,
    Uniform,
    /// The `in` of a vertex shader, up to version 120.
    Attribute,
    /// The `out` of a vertex shader and the `in` of a fragment shader, up to version 120.
    Varying,
}

/// A function that is defined, and not only declared.
#[derive(Clone, Debug, PartialEq)]
pub struct Function<'t> {
    pub name: &'t str,
    pub line: usize,
}

impl<'t> Scan<'t> {
    pub fn new(text: &'t str) -> Self {
        let (version, tokens) = tokens(text);
        let mut scan = Self {
            version,
            ..Self::default()
        };
        for word in tokens.iter().filter(|token| token.is_word()) {
            let (_, count) = scan.words.entry(word.text).or_insert((word.line, 0));
            *count += 1;
        }
        let mut rest = tokens.as_slice();
        while !rest.is_empty() {
            rest = scan.take_statement(rest);
        }
        scan
    }

    pub fn find(&self, storage: Storage, name: &str) -> Option<&Declared<'t>> {
        let mut declared = self.declared.iter();
        declared.find(|found| found.storage == storage && found.name == name)
    }

    /// What is declared of these kinds, in the order of the text.
    pub fn of<'s>(&'s self, storages: &'s [Storage]) -> impl Iterator<Item = &'s Declared<'t>> {
        let declared = self.declared.iter();
        declared.filter(move |found| storages.contains(&found.storage))
    }

    /// Whether a variable is mentioned anywhere but where it is declared.
    pub fn mentions(&self, declared: &Declared) -> bool {
        let found = self.words.get(declared.name);
        found.is_some_and(|(_, count)| *count > 1)
    }

    /// The first line that has the word.
    pub fn line_of(&self, word: &str) -> Option<usize> {
        self.words.get(word).map(|(line, _)| *line)
    }

    /// Takes what is up to the next semicolon, or to the end of a function's body, and returns what is left.
    fn take_statement<'s>(&mut self, tokens: &'s [Token<'t>]) -> &'s [Token<'t>] {
        let mut depth = 0_usize;
        for (place, token) in tokens.iter().enumerate() {
            match token.text {
                "(" | "[" => depth += 1,
                ")" | "]" => depth = depth.saturating_sub(1),
                ";" if depth == 0 => {
                    self.take_declaration(&tokens[..place]);
                    return &tokens[place + 1..];
                }
                "{" if depth == 0 => {
                    let head = &tokens[..place];
                    let behind = behind_braces(&tokens[place..]);
                    // The list of an array, behind its =, and the members of a block or a struct have more behind them.
                    let is_function = head.last().is_some_and(|last| last.is(")"));
                    if is_function {
                        self.take_function(head);
                        return behind;
                    }
                    return behind_semicolon(behind);
                }
                _ => {}
            }
        }
        &[]
    }

    /// `layout(location = 0) in vec3 a, b[2] = …`
    fn take_declaration(&mut self, tokens: &[Token<'t>]) {
        let mut storage = None;
        let mut location = None;
        let mut tokens = tokens;
        let kind = loop {
            let [token, rest @ ..] = tokens else {
                return;
            };
            tokens = rest;
            match token.text {
                "layout" => {
                    let (layout, behind) = in_brackets(rest);
                    location = location_in(layout).or(location);
                    tokens = behind;
                }
                "in" => storage = Some(Storage::In),
                "out" => storage = Some(Storage::Out),
                "uniform" => storage = Some(Storage::Uniform),
                "attribute" => storage = Some(Storage::Attribute),
                "varying" => storage = Some(Storage::Varying),
                "flat" | "smooth" | "noperspective" | "centroid" | "invariant" | "precise"
                | "highp" | "mediump" | "lowp" => {}
                _ if token.is_word() => break token.text,
                _ => return,
            }
        };
        let Some(storage) = storage else {
            return;
        };
        // `vec3[2] a` has its size at the type.
        let mut names = match tokens {
            [open, ..] if open.is("[") => in_brackets(tokens).1,
            _ => tokens,
        };
        while let [name, rest @ ..] = names {
            if !name.is_word() {
                return;
            }
            self.declared.push(Declared {
                storage,
                kind,
                name: name.text,
                location,
                line: name.line,
            });
            names = behind_comma(rest);
        }
    }

    /// `float f(vec3 p)`
    fn take_function(&mut self, head: &[Token<'t>]) {
        let open = head.iter().position(|token| token.is("("));
        if let Some(open) = open
            && let Some(name) = open.checked_sub(1).map(|place| head[place])
            && name.is_word()
        {
            let Token { text: name, line } = name;
            self.functions.push(Function { name, line });
        }
    }
}

/// What is in the brackets that begin here, and what is behind them.
fn in_brackets<'s, 't>(tokens: &'s [Token<'t>]) -> (&'s [Token<'t>], &'s [Token<'t>]) {
    let closes = tokens
        .iter()
        .position(|token| token.is(")") || token.is("]"));
    match closes {
        Some(end) if end > 0 => (&tokens[1..end], &tokens[end + 1..]),
        _ => (&[], &[]),
    }
}

fn location_in(layout: &[Token]) -> Option<u32> {
    let mut triples = layout.windows(3);
    let found = triples.find(|three| three[0].is("location") && three[1].is("="))?;
    found[2].text.parse().ok()
}

/// Behind the brace that closes the one that begins here.
fn behind_braces<'s, 't>(tokens: &'s [Token<'t>]) -> &'s [Token<'t>] {
    let mut depth = 0_usize;
    for (place, token) in tokens.iter().enumerate() {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &tokens[place + 1..];
        }
    }
    &[]
}

fn behind_semicolon<'s, 't>(tokens: &'s [Token<'t>]) -> &'s [Token<'t>] {
    match tokens.iter().position(|token| token.is(";")) {
        Some(end) => &tokens[end + 1..],
        None => &[],
    }
}

/// Behind the next comma that is in no bracket.
fn behind_comma<'s, 't>(tokens: &'s [Token<'t>]) -> &'s [Token<'t>] {
    let mut depth = 0_usize;
    for (place, token) in tokens.iter().enumerate() {
        match token.text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth = depth.saturating_sub(1),
            "," if depth == 0 => return &tokens[place + 1..],
            _ => {}
        }
    }
    &[]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn declared(text: &str) -> Vec<(Storage, &str, &str, Option<u32>, usize)> {
        Scan::new(text)
            .declared
            .into_iter()
            .map(|d| (d.storage, d.kind, d.name, d.location, d.line))
            .collect()
    }

    #[test]
    fn declarations_are_found_as_students_write_them() {
        use Storage::*;
        assert_eq!(
            declared(
                "#version 330\nlayout ( location=1 ) in vec3 a;\nflat out int b , c[2];\nuniform\n  sampler2D\n  s;\n\
                 uniform float e = 0.5, f = max(1, 2);\nattribute vec4 p; varying vec2 q;\nuniform vec3[2] l;"
            ),
            [
                (In, "vec3", "a", Some(1), 2),
                (Out, "int", "b", None, 3),
                (Out, "int", "c", None, 3),
                (Uniform, "sampler2D", "s", None, 6),
                (Uniform, "float", "e", None, 7),
                (Uniform, "float", "f", None, 7),
                (Attribute, "vec4", "p", None, 8),
                (Varying, "vec2", "q", None, 8),
                (Uniform, "vec3", "l", None, 9),
            ]
        );
    }

    #[test]
    fn what_is_no_declaration_of_the_top_level_is_none() {
        let text = "struct L { vec3 p; }; in B { vec3 q; } b; const vec2 t[2] = vec2[](vec2(0), vec2(1));\n\
                    float f(in vec3 x, out float y) { uniform float z; { in vec2 w; } return 1.0; }\n\
                    float g(in vec3 x);\nint a[] = { 1, 2 };\nin vec3 last;";
        assert_eq!(declared(text), [(Storage::In, "vec3", "last", None, 5)]);
    }

    #[test]
    fn a_function_is_defined_and_not_declared() {
        let scan = Scan::new(
            "float f(vec3 x);\nvoid main(void)\n{ f(vec3(1)); }\nfloat g() { return 1.0; }",
        );
        let names: Vec<_> = scan.functions.iter().map(|f| (f.name, f.line)).collect();
        assert_eq!(names, [("main", 2), ("g", 4)]);
    }

    #[test]
    fn a_mention_is_no_declaration() {
        let scan = Scan::new("in vec4 a;\nin vec4 b;\nout vec4 c;\n// a\nvoid main() { c = b; }");
        let mentioned = |name| scan.mentions(scan.find(Storage::In, name).unwrap());
        assert!(mentioned("b") && !mentioned("a"));
        assert_eq!(scan.line_of("main"), Some(5));
        assert_eq!(scan.line_of("texture2D"), None);
    }

    #[test]
    fn text_that_is_no_glsl_ends_somewhere() {
        for text in [
            "",
            "}",
            "{",
            ")",
            "in",
            "in vec3",
            "in ;",
            "layout",
            "layout(",
            "uniform vec3 a",
            "in vec3 é;",
            "([{",
            "}}}};",
            "uniform = ;",
            "layout(location = x) in vec3 a;",
            "\u{feff}in vec3 a;",
            "(){",
            "(",
            "in vec3 a,",
            "in vec3 a[",
        ] {
            let scan = Scan::new(text);
            assert!(scan.declared.len() <= 1, "{text}: {scan:?}");
        }
    }
}
