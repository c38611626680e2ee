//! One call, read from the line of text that stands for it: as `apitrace dump` writes it, or as C.
//!
//! ```text
//! 29 glBindTexture(target = GL_TEXTURE_2D, texture = 1)
//! 55 @1 glGetUniformLocation(program = 1, name = "shadow_map") = 1
//! GLint location = glGetUniformLocation(program, "shadow_map");  // 1
//! ```

/// A list is kept up to here: no call that is looked at has more, and a hostile one could hold millions.
const LONGEST_LIST: usize = 4096;
/// Lists in lists, as deep as no dump has them.
const DEEPEST: usize = 16;

/// A GL call, and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Of the text, counted from 1.
    pub line: u64,
    /// Without the suffix of an extension: `glBindFramebuffer`, and not `glBindFramebufferEXT`.
    pub name: String,
    pub args: Vec<Value>,
    pub result: Option<Value>,
    /// Written by apitrace, not made by the program.
    pub fake: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    /// A name of GL's, several joined by `|`, or what a program calls an object.
    Word(String),
    /// In quotes.
    Text(String),
    List(Vec<Value>),
}

impl Call {
    pub fn arg(&self, place: usize) -> &Value {
        static NOTHING: Value = Value::Number(0.0);
        self.args.get(place).unwrap_or(&NOTHING)
    }

    pub fn word(&self, place: usize) -> &str {
        self.arg(place).word()
    }

    pub fn number(&self, place: usize) -> f64 {
        self.arg(place).number()
    }

    pub fn int(&self, place: usize) -> i64 {
        self.arg(place).int()
    }

    /// The name of an object; "0" is none.
    pub fn id(&self, place: usize) -> String {
        self.arg(place).id()
    }

    pub fn is_true(&self, place: usize) -> bool {
        match self.arg(place) {
            Value::Number(number) => *number != 0.0,
            value => matches!(value.word(), "GL_TRUE" | "True"),
        }
    }
}

impl Value {
    pub fn word(&self) -> &str {
        match self {
            Self::Word(word) | Self::Text(word) => word,
            // `&1` and `{1}`: one thing that a pointer points to.
            Self::List(list) if list.len() == 1 => list[0].word(),
            Self::List(_) => "",
            Self::Number(number) if *number == 0.0 => "GL_NONE",
            Self::Number(_) => "",
        }
    }

    /// 0 for what is no number.
    pub fn number(&self) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::List(list) if list.len() == 1 => list[0].number(),
            Self::Word(word) if word == "GL_ONE" || word == "GL_TRUE" => 1.0,
            _ => 0.0,
        }
    }

    /// A whole number as GL has them, of 32 bits: what is larger ends there.
    pub fn int(&self) -> i64 {
        i64::from(self.number() as i32)
    }

    pub fn id(&self) -> String {
        match self {
            Self::Number(number) => (*number as i64).to_string(),
            Self::Word(word) if word == "NULL" => "0".to_owned(),
            Self::List(list) if list.len() == 1 => list[0].id(),
            value => value.word().to_owned(),
        }
    }

    /// The elements of a list; what is no list is its own only element.
    pub fn items(&self) -> &[Self] {
        match self {
            Self::List(list) => list,
            one => std::slice::from_ref(one),
        }
    }

    pub fn numbers(&self) -> Vec<f64> {
        self.items().iter().map(Self::number).collect()
    }
}

/// Whether the text stops inside of a string: the call goes on in the next line.
#[derive(Default)]
pub struct Quotes {
    open: bool,
    escaped: bool,
}

impl Quotes {
    /// Reads on; says whether a string is open at the end.
    pub fn read(&mut self, text: &[u8]) -> bool {
        for &byte in text {
            match byte {
                _ if self.escaped => self.escaped = false,
                b'\\' if self.open => self.escaped = true,
                b'"' => self.open = !self.open,
                _ => {}
            }
        }
        self.open
    }
}

/// The call that a text holds; none, where it holds something else.
pub fn call(text: &str, line: u64) -> Option<Call> {
    let text = without_number(text.trim());
    let (head, rest) = text.split_once('(')?;
    // `GLuint program = glCreateProgram();` names its result.
    let (declared, name) = match head.split_once('=') {
        Some((declared, name)) => (
            declared.split([' ', '*']).rfind(|word| !word.is_empty()),
            name,
        ),
        None => (None, head),
    };
    let name = name.trim();
    let mut letters = name.chars();
    let begins = letters.next().is_some_and(|c| c.is_ascii_alphabetic());
    if !begins || !letters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return None;
    }

    let mut reader = Reader { text: rest, at: 0 };
    let args = reader.list(b')', 0)?;
    let after = rest[reader.at..].trim_start_matches(';').trim();
    let (after, comment) = match after.split_once("//") {
        Some((after, comment)) => (after.trim(), comment.trim()),
        None => (after, ""),
    };
    let result = match (after.strip_prefix('='), declared) {
        (Some(result), _) => Some(Reader::whole(result)),
        // A comment says what came back, where the variable is not the object's own name.
        (None, Some(_)) if !comment.is_empty() => Some(Reader::whole(comment)),
        (None, Some(variable)) => Some(Value::Word(variable.to_owned())),
        (None, None) => None,
    };
    Some(Call {
        line,
        name: function(name),
        args,
        result,
        fake: comment == "fake",
    })
}

/// Without the number of the call and of its thread.
fn without_number(text: &str) -> &str {
    let rest = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let rest = if rest.len() < text.len() && rest.starts_with(' ') {
        rest.trim_start()
    } else {
        text
    };
    match rest.strip_prefix('@').and_then(|rest| rest.split_once(' ')) {
        Some((_, rest)) => rest.trim_start(),
        None => rest,
    }
}

/// A function under its name of today.
fn function(name: &str) -> String {
    match without_suffix(name) {
        "glCreateShaderObject" => "glCreateShader",
        "glCreateProgramObject" => "glCreateProgram",
        "glUseProgramObject" => "glUseProgram",
        "glAttachObject" => "glAttachShader",
        name => name,
    }
    .to_owned()
}

fn without_suffix(name: &str) -> &str {
    ["EXT", "ARB", "_EXT", "_ARB"]
        .iter()
        .rev()
        .find_map(|suffix| name.strip_suffix(suffix))
        .unwrap_or(name)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    /// The value that a text is.
    fn whole(text: &str) -> Value {
        let mut reader = Reader {
            text: text.trim(),
            at: 0,
        };
        reader
            .value(b',', 0)
            .unwrap_or_else(|| Value::Word(text.trim().to_owned()))
    }

    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn blank(&mut self) {
        while self.byte().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// The values up to the bracket that closes the list, which is read, too.
    fn list(&mut self, close: u8, depth: usize) -> Option<Vec<Value>> {
        let mut items = Vec::new();
        loop {
            self.blank();
            match self.byte()? {
                byte if byte == close => {
                    self.at += 1;
                    return Some(items);
                }
                b',' => self.at += 1,
                _ => {
                    let value = self.value(close, depth)?;
                    if items.len() < LONGEST_LIST {
                        items.push(value);
                    }
                }
            }
        }
    }

    /// A value, up to the comma or to `close`.
    fn value(&mut self, close: u8, depth: usize) -> Option<Value> {
        if depth > DEEPEST {
            return None;
        }
        self.blank();
        // `&1`, and a cast.
        while self.byte() == Some(b'&') {
            self.at += 1;
        }
        if self.byte() == Some(b'(') {
            self.at += self.text[self.at..].find(')')? + 1;
            self.blank();
        }
        match self.byte() {
            Some(b'{') => {
                self.at += 1;
                return self.list(b'}', depth + 1).map(Value::List);
            }
            Some(b'"') => return self.string(),
            _ => {}
        }
        let start = self.at;
        let mut open = 0;
        while let Some(byte) = self.byte() {
            match byte {
                b'(' => open += 1,
                b')' if open > 0 => open -= 1,
                _ if open > 0 => {}
                b'=' => {
                    // `texture = 1`: an argument's name.
                    self.at += 1;
                    return self.value(close, depth + 1);
                }
                b',' => break,
                _ if byte == close => break,
                _ => {}
            }
            self.at += 1;
        }
        Some(plain(self.text[start..self.at].trim()))
    }

    fn string(&mut self) -> Option<Value> {
        let start = self.at + 1;
        let mut quotes = Quotes::default();
        while let Some(byte) = self.byte() {
            self.at += 1;
            if !quotes.read(&[byte]) {
                let text = &self.text[start..self.at - 1];
                return Some(Value::Text(text.replace("\\\"", "\"").replace("\\n", "\n")));
            }
        }
        None
    }
}

/// A number or a word.
fn plain(text: &str) -> Value {
    if let Some(digits) = text.strip_prefix("0x")
        && let Ok(number) = u64::from_str_radix(digits, 16)
    {
        return Value::Number(number as f64);
    }
    match text.parse() {
        Ok(number) => Value::Number(number),
        Err(_) if text == "NULL" => Value::Number(0.0),
        Err(_) => Value::Word(without_suffix(text).to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(text: &str) -> Value {
        Value::Word(text.to_owned())
    }

    #[test]
    fn apitrace_and_c_are_the_same_call() {
        for (apitrace, c) in [
            (
                "3 glBindFramebufferEXT(target = GL_FRAMEBUFFER_EXT, framebuffer = 1)",
                "glBindFramebuffer(GL_FRAMEBUFFER, 1);",
            ),
            (
                "55 @2 glGetUniformLocation(program = 7, name = \"a, (b\") = -1",
                "GLint location = glGetUniformLocation(7, \"a, (b\");  // -1",
            ),
            (
                "9 glUniformMatrix2fv(location = 1, count = 1, transpose = GL_FALSE, value = {1, -0.5, 2e-3, nan})",
                "glUniformMatrix2fv(1, 1, GL_FALSE, (const GLfloat[]){1, -0.5, 0.002, NAN});  // m",
            ),
            (
                "4 glGenTextures(n = 1, textures = &12)",
                "glGenTextures(1, &12);",
            ),
        ] {
            let [a, b] = [apitrace, c].map(|text| format!("{:?}", call(text, 1).unwrap()));
            assert_eq!(a, b);
        }
    }

    #[test]
    fn values() {
        let read = call(
            "1 f(a = 0x10, b = NULL, c = blob(4), d = {1, {2}}, e = A | B)",
            5,
        )
        .unwrap();
        assert_eq!(read.line, 5);
        assert_eq!(
            read.args,
            [
                Value::Number(16.0),
                Value::Number(0.0),
                word("blob(4)"),
                Value::List(vec![
                    Value::Number(1.0),
                    Value::List(vec![Value::Number(2.0)])
                ]),
                word("A | B"),
            ]
        );
        assert!(call("8 glViewport(x = 0) // fake", 1).unwrap().fake);
    }

    #[test]
    fn what_is_no_call() {
        for text in [
            "",
            "hello",
            "glClear(",
            "glClear(mask = \"",
            "(1)",
            "3 4(5)",
            "f({{{{",
            "a b(1)",
        ] {
            assert_eq!(call(text, 1), None, "{text}");
        }
        // Deep nesting ends, and does not end the stack.
        assert_eq!(call(&format!("f({}", "{".repeat(100_000)), 1), None);
        assert_eq!(call(&format!("f({}", "a=".repeat(100_000)), 1), None);
    }
}
