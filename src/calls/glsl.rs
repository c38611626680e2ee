//! What a shader's source says of its uniforms. It is read as far as the calls need it, and not compiled.

use std::collections::BTreeMap;

/// The most uniforms that are remembered of one source.
const MOST_UNIFORMS: usize = 4096;

/// What is kept of a shader's source, or of all sources of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// By name.
    pub uniforms: BTreeMap<String, Uniform>,
    /// One half is in it twice at least: the way from [−1,1] to [0,1] may be made here. Once, it may be a shadow's grey.
    pub has_halves: bool,
    /// The depth is the shader's own.
    pub writes_depth: bool,
    /// The samplers of which `.y`, `.z`, `.g` or `.b` is read.
    pub beyond_red: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Uniform {
    /// As GLSL names it: `mat4`, `sampler2D`.
    pub kind: String,
    /// `layout(binding = …)`.
    pub binding: i64,
    /// `layout(location = …)`.
    pub location: Option<i64>,
    /// It has a value from the start.
    pub has_value: bool,
    /// It is named outside of its declaration.
    pub is_used: bool,
}

impl Source {
    pub fn read(text: &str) -> Self {
        let text = without_comments(text);
        let words: Vec<&str> = words(&text);
        let mut source = Self {
            has_halves: words.iter().filter(|word| is_half(word)).count() > 1,
            writes_depth: words.contains(&"gl_FragDepth"),
            ..Self::default()
        };
        let mut at = 0;
        while let Some(found) = words[at..].iter().position(|word| *word == "uniform") {
            let place = at + found;
            at = place + 1;
            let end = words[at..]
                .iter()
                .position(|word| matches!(*word, ";" | "{"));
            let Some(end) = end.map(|end| at + end) else {
                break;
            };
            if words[end] == ";" {
                source.declare(&layout(&words[..place]), &words[at..end]);
            }
            at = end;
        }
        for (name, uniform) in &mut source.uniforms {
            uniform.is_used = words.iter().filter(|word| *word == name).count() > 1;
        }
        let names = source
            .uniforms
            .iter()
            .filter(|(_, uniform)| uniform.is_sampler());
        source.beyond_red = names
            .map(|(name, _)| name.clone())
            .filter(|name| reads_beyond_red(&words, name))
            .collect();
        source
    }

    /// `highp sampler2D a, b[2] = …`
    fn declare(&mut self, layout: &BTreeMap<&str, i64>, words: &[&str]) {
        let qualifiers = ["highp", "mediump", "lowp"];
        let mut words = words.iter().filter(|word| !qualifiers.contains(*word));
        let Some(kind) = words.next() else { return };
        let rest: Vec<&str> = words.copied().collect();
        for part in rest.split(|word| *word == ",") {
            let Some(name) = part.first() else { continue };
            let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
            if is_name && self.uniforms.len() < MOST_UNIFORMS {
                let uniform = Uniform {
                    kind: (*kind).to_owned(),
                    binding: layout.get("binding").copied().unwrap_or(0),
                    location: layout.get("location").copied(),
                    has_value: part.contains(&"="),
                    is_used: false,
                };
                self.uniforms.insert((*name).to_owned(), uniform);
            }
        }
    }

    /// The sources of a program are one.
    pub fn join(&mut self, other: &Self) {
        for (name, uniform) in &other.uniforms {
            let known = self
                .uniforms
                .entry(name.clone())
                .or_insert_with(|| uniform.clone());
            known.is_used |= uniform.is_used;
        }
        self.has_halves |= other.has_halves;
        self.writes_depth |= other.writes_depth;
        self.beyond_red.extend(other.beyond_red.iter().cloned());
    }
}

impl Uniform {
    pub fn is_sampler(&self) -> bool {
        self.kind.contains("sampler")
    }
}

fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut left = String::with_capacity(text.len());
    while let Some(at) = rest.find('/') {
        left.push_str(&rest[..at]);
        let comment = &rest[at..];
        let end = if comment.starts_with("//") {
            comment.find('\n').unwrap_or(comment.len())
        } else if comment.starts_with("/*") {
            comment.find("*/").map_or(comment.len(), |end| end + 2)
        } else {
            left.push('/');
            1
        };
        rest = &comment[end..];
    }
    left + rest
}

/// Names and numbers whole, every other sign alone.
fn words(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = match first {
            '.' if !rest[1..].starts_with(|c: char| c.is_ascii_digit()) => 1,
            c if c.is_ascii_digit() || c == '.' => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
            c if is_part(c) => rest.find(|c| !is_part(c) || c == '.').unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        words.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    words
}

fn is_half(word: &str) -> bool {
    word.trim_end_matches(['f', 'F']).parse() == Ok(0.5)
}

/// The numbers of the `layout(…)` that stands at the end of these words.
fn layout<'a>(before: &[&'a str]) -> BTreeMap<&'a str, i64> {
    let Some(start) = before.iter().rposition(|word| *word == "layout") else {
        return BTreeMap::new();
    };
    if before.last() != Some(&")") || before[start..].contains(&";") {
        return BTreeMap::new();
    }
    let pairs = before[start..].windows(3).filter(|part| part[1] == "=");
    pairs
        .filter_map(|part| Some((part[0], part[2].parse().ok()?)))
        .collect()
}

/// `texture(name, …).z`
fn reads_beyond_red(words: &[&str], name: &str) -> bool {
    words.windows(3).enumerate().any(|(at, part)| {
        let looks_up = part[0].starts_with("texture") && part[1] == "(" && part[2] == name;
        if !looks_up {
            return false;
        }
        let mut open = 0;
        let close = words[at + 1..].iter().position(|word| {
            open += i32::from(*word == "(") - i32::from(*word == ")");
            open == 0
        });
        let Some(close) = close.map(|close| at + 1 + close) else {
            return false;
        };
        words.get(close + 1) == Some(&".")
            && words
                .get(close + 2)
                .is_some_and(|swizzle| swizzle.starts_with(['y', 'z', 'g', 'b']))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniforms_are_found() {
        let source = Source::read(
            "#version 420\nlayout(binding = 3) uniform highp sampler2DShadow shadow_map;\n\
             // uniform float old;\nuniform vec3 a, b[2]; uniform float c = 1.5;\n\
             uniform Block { mat4 m; };\n/* uniform int d; */ layout(location=2) in vec3 p;\n\
             void main() { gl_Position = vec4(a * p + b[0], .5f); }",
        );
        let told: Vec<_> = source
            .uniforms
            .iter()
            .map(|(name, u)| {
                (
                    name.as_str(),
                    u.kind.as_str(),
                    u.binding,
                    u.has_value,
                    u.is_used,
                )
            })
            .collect();
        assert_eq!(
            told,
            [
                ("a", "vec3", 0, false, true),
                ("b", "vec3", 0, false, true),
                ("c", "float", 0, true, false),
                ("shadow_map", "sampler2DShadow", 3, false, false),
            ]
        );
        assert!(!source.has_halves);
        assert!(Source::read("a = 0.5 * b + vec3(.50f);").has_halves);
        assert!(!Source::read("a = 1.5; b = 5; c = 0.55 * x.z;").has_halves);
    }

    #[test]
    fn which_component_is_read() {
        for (text, beyond) in [
            ("float d = texture(map, (a + b).xy).z;", true),
            ("float d = texture2D (map,uv) . g;", true),
            ("float d = texture(map, uv).x;", false),
            ("float d = texture(map, uv).r + v.z;", false),
            ("vec3 d = texture(other, uv).xyz;", false),
        ] {
            let source = Source::read(&format!("uniform sampler2D map, other; {text}"));
            assert_eq!(!source.beyond_red.is_empty(), beyond, "{text}");
        }
    }

    #[test]
    fn any_text_is_read() {
        for text in [
            "",
            "uniform",
            "uniform ;",
            "uniform mat4",
            "layout(",
            "/*",
            "/",
            "texture(",
            "uniform sampler2D m; texture(m",
        ] {
            assert!(Source::read(text).uniforms.len() < 2, "{text}");
        }
    }
}
