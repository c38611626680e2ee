//! GLSL text to words and signs, each with its line. Comments are gone, and so is what the preprocessor is told; of that
//! the version alone is kept.

/// A word, a number, or a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Token<'t> {
    pub text: &'t str,
    /// From 1.
    pub line: usize,
}

impl Token<'_> {
    pub fn is(&self, text: &str) -> bool {
        self.text == text
    }

    pub fn is_word(&self) -> bool {
        self.text
            .starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
    }
}

/// `#version 330 core`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Version<'t> {
    pub number: u32,
    /// `core`, `compatibility`, `es`, or nothing.
    pub profile: &'t str,
    pub line: usize,
}

pub fn tokens(text: &str) -> (Option<Version<'_>>, Vec<Token<'_>>) {
    let mut version = None;
    let mut tokens = Vec::new();
    let mut skipped = Skipped::default();
    let (mut rest, mut line) = (text, 1);
    // Whether nothing but space has come on this line: a # is for the preprocessor there alone.
    let mut begins = true;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '\n' => {
                begins = true;
                1
            }
            '\\' | '\r' => 1,
            _ if first.is_whitespace() => first.len_utf8(),
            '/' if rest.starts_with("//") => until_end_of_line(rest),
            '/' if rest.starts_with("/*") => rest[2..].find("*/").map_or(rest.len(), |end| end + 4),
            '#' if begins => {
                let length = until_end_of_line(rest);
                let told = &rest[1..length];
                skipped.take(told);
                version = version.or_else(|| read_version(told, line));
                length
            }
            _ => {
                begins = false;
                let length = match first {
                    'a'..='z' | 'A'..='Z' | '_' | '0'..='9' => rest
                        .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
                        .unwrap_or(rest.len()),
                    _ => first.len_utf8(),
                };
                if !skipped.now() {
                    let text = &rest[..length];
                    tokens.push(Token { text, line });
                }
                length
            }
        };
        line += rest[..length].matches('\n').count();
        rest = &rest[length..];
    }
    (version, tokens)
}

/// Up to the end of the line, which a backslash puts off.
fn until_end_of_line(text: &str) -> usize {
    let mut from = 0;
    while let Some(end) = text[from..].find('\n').map(|end| from + end) {
        if !text[..end].trim_end_matches('\r').ends_with('\\') {
            return end;
        }
        from = end + 1;
    }
    text.len()
}

fn read_version(told: &str, line: usize) -> Option<Version<'_>> {
    let mut words = told.trim().strip_prefix("version")?.split_whitespace();
    let number = words.next()?.parse().ok()?;
    Some(Version {
        number,
        profile: words.next().unwrap_or(""),
        line,
    })
}

/// What `#if 0` takes out. Every other condition is taken to hold: which does, the driver knows.
#[derive(Default)]
struct Skipped {
    /// Whether each open #if takes out what is there now.
    open: Vec<bool>,
}

impl Skipped {
    fn now(&self) -> bool {
        self.open.contains(&true)
    }

    fn take(&mut self, told: &str) {
        let mut words = told.split_whitespace();
        match words.next() {
            Some("if") => self.open.push(words.next() == Some("0")),
            Some("ifdef" | "ifndef") => self.open.push(false),
            Some("else" | "elif") => {
                if let Some(open) = self.open.last_mut() {
                    *open = false;
                }
            }
            Some("endif") => {
                self.open.pop();
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(&str, usize)> {
        let (_, tokens) = tokens(text);
        tokens
            .iter()
            .map(|token| (token.text, token.line))
            .collect()
    }

    #[test]
    fn comments_are_gone_and_lines_are_kept() {
        assert_eq!(
            words("in /* in\n */ vec3 p; // in\nout vec4 c;"),
            [
                ("in", 1),
                ("vec3", 2),
                ("p", 2),
                (";", 2),
                ("out", 3),
                ("vec4", 3),
                ("c", 3),
                (";", 3)
            ]
        );
        assert_eq!(words("a /* without an end"), [("a", 1)]);
        assert_eq!(words("a / b"), [("a", 1), ("/", 1), ("b", 1)]);
    }

    #[test]
    fn a_backslash_joins_lines() {
        assert_eq!(words("// a comment \\\nb\nc"), [("c", 3)]);
        assert_eq!(words("#define A \\\r\n in b\r\nc"), [("c", 3)]);
        assert_eq!(words("a\\\nb"), [("a", 1), ("b", 2)]);
    }

    #[test]
    fn the_preprocessor_keeps_the_version_and_what_holds() {
        let (version, _) = tokens("// one\n  # version 330   core\nin vec3 p;");
        let found = version.unwrap();
        assert_eq!((found.number, found.profile, found.line), (330, "core", 2));
        assert_eq!(tokens("a # version 330").0, None);
        assert_eq!(
            words("#if 0\na\n#if 1\nb\n#endif\n#else\nc\n#endif\nd"),
            [("c", 7), ("d", 9)]
        );
        assert_eq!(words("#ifdef A\na\n#endif"), [("a", 2)]);
        assert_eq!(words("#endif\n#else\na"), [("a", 3)]);
    }
}
