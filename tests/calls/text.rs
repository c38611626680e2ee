//! The two texts that calls are read from, and the one spelling that both are brought to.

use super::{HEADING, Line};

/// Reads what `shadowlab::gl::trace::to_c` writes, a line at a time. Panics on a line that is no call.
pub fn parse_c(text: &str) -> Vec<Line> {
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .map(|line| match line.strip_prefix(HEADING) {
            Some(heading) => Line::new_heading(heading),
            None => {
                let call = Parts::read(line).unwrap_or_else(|| panic!("not a C call: {line}"));
                // `GLint location = f();  // 1` has the result in the comment, `GLuint program = f();` in the variable.
                let comment = call.after.split_once(HEADING).map(|(_, text)| text.trim());
                let result = call.variable.map(|name| comment.unwrap_or(name));
                line_of(call.name, call.args.clone(), result)
            }
        })
        .collect()
}

/// Reads the GL calls of `apitrace dump --verbose --color=never` (without --verbose, apitrace leaves out questions
/// such as glGetError). A debug group is the heading of a pass. EGL calls, and the calls that apitrace marks as its
/// own, are left out. Panics on a numbered line that is no call.
pub fn parse_apitrace(text: &str) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut rest = text.lines();
    while let Some(first) = rest.next() {
        let mut text = first.to_owned();
        // Strings are printed as they are: a shader's source goes on over many lines.
        while in_string(&text) {
            let next = rest.next().unwrap_or_else(|| panic!("unfinished: {first}"));
            text = text + "\n" + next;
        }
        let Some((number, call)) = text.split_once(' ') else {
            continue;
        };
        if number.parse::<u64>().is_err() {
            continue;
        }
        let call = Parts::read(call).unwrap_or_else(|| panic!("not a call: {text}"));
        let fake = call.after.ends_with("// fake");
        if fake || !call.name.starts_with("gl") || call.name.starts_with("glX") {
            continue;
        }
        match call.name {
            "glPushDebugGroup" => {
                let message = call.args.last().and_then(|arg| arg.split('"').nth(1));
                lines.push(Line::new_heading(message.unwrap_or_default()));
            }
            "glPopDebugGroup" => {}
            _ => {
                let result = call.after.trim_start().strip_prefix('=').map(str::trim);
                let args = call.args.iter().map(|arg| unnamed(call.name, arg));
                lines.push(line_of(call.name, args.collect(), result));
            }
        }
    }
    lines
}

/// The parts of `GLint variable = name(args) after`.
pub struct Parts<'a> {
    pub variable: Option<&'a str>,
    pub name: &'a str,
    pub args: Vec<String>,
    after: &'a str,
}

impl<'a> Parts<'a> {
    pub fn read(text: &'a str) -> Option<Self> {
        let (head, list) = text.split_once('(')?;
        let (variable, name) = match head.split_once('=') {
            Some((declared, name)) => (
                declared.split([' ', '*']).rfind(|word| !word.is_empty()),
                name,
            ),
            None => (None, head),
        };
        let name = name.trim();
        if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
            return None;
        }
        let (args, after) = split_list(list, ')')?;
        Some(Self {
            variable,
            name,
            args,
            after,
        })
    }
}

/// Splits a list at its commas, up to the bracket that closes it; says what follows. Brackets and strings inside the
/// list are left whole.
fn split_list(text: &str, close: char) -> Option<(Vec<String>, &str)> {
    let mut items = Vec::new();
    let (mut depth, mut quoted, mut escaped, mut start) = (0, false, false, 0);
    for (index, c) in text.char_indices() {
        let ends = !quoted && depth == 0 && (c == ',' || c == close);
        if ends {
            let item = text[start..index].trim();
            if !item.is_empty() {
                items.push(item.to_owned());
            }
            start = index + c.len_utf8();
        }
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ if quoted => {}
            _ if ends && c == close => return Some((items, &text[start..])),
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// Whether the text stops inside a string.
fn in_string(text: &str) -> bool {
    let (mut quoted, mut escaped) = (false, false);
    for c in text.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ => {}
        }
    }
    quoted
}

/// An argument of apitrace without its name, and with C's words for the places whose contents apitrace prints.
fn unnamed(function: &str, arg: &str) -> String {
    let (name, value) = arg.split_once(" = ").unwrap_or(("", arg));
    match name {
        _ if value == "NULL" => "0",
        "string" if function == "glShaderSource" => "source",
        "length" if value.starts_with('&') => "length",
        "infoLog" => "info_log",
        "params" | "data" if function.starts_with("glGet") && !function.ends_with("Data") => {
            "value"
        }
        "pixels" | "data" => "data",
        _ => value,
    }
    .to_owned()
}

/// A call in the spelling that all texts share.
pub fn line_of(name: &str, args: Vec<String>, result: Option<&str>) -> Line {
    let mut args: Vec<_> = args.iter().map(|arg| normal(arg)).collect();
    // Numbers whose names apitrace does not know, or knows another name for.
    let none = match (name, args.as_slice()) {
        ("glDrawBuffer" | "glReadBuffer" | "glDrawBuffers", _) => true,
        ("glTexParameteri", [_, parameter, _]) => parameter == "GL_TEXTURE_COMPARE_MODE",
        _ => false,
    };
    let swizzle = args.iter().any(|arg| arg == "GL_TEXTURE_SWIZZLE_RGBA");
    for arg in &mut args {
        if none {
            *arg = arg.replace("GL_ZERO", "GL_NONE");
        }
        if swizzle && let Some((values, _)) = arg.strip_prefix('{').and_then(|a| split_list(a, '}'))
        {
            let values: Vec<_> = values.iter().map(|value| swizzle_name(value)).collect();
            *arg = format!("{{{}}}", values.join(", "));
        }
    }
    Line {
        name: name.to_owned(),
        args,
        result: result.map(normal),
    }
}

fn swizzle_name(value: &str) -> &str {
    match value {
        "0" => "GL_ZERO",
        "1" => "GL_ONE",
        "6403" => "GL_RED",
        "6404" => "GL_GREEN",
        "6405" => "GL_BLUE",
        "6406" => "GL_ALPHA",
        name => name,
    }
}

/// One spelling for an argument: no `&`, no cast, decimal numbers, sorted bits, and an array of one is its element.
fn normal(arg: &str) -> String {
    let mut arg = arg.trim().trim_start_matches('&').trim();
    if arg.starts_with('"') {
        return arg.to_owned();
    }
    if let Some(cast) = arg.strip_prefix('(') {
        arg = cast.split_once(')').map_or(arg, |(_, value)| value.trim());
    }
    if let Some((values, _)) = arg.strip_prefix('{').and_then(|list| split_list(list, '}')) {
        let values: Vec<_> = values.iter().map(|value| normal(value)).collect();
        return match values.as_slice() {
            [one] => one.clone(),
            values => format!("{{{}}}", values.join(", ")),
        };
    }
    if arg.contains('|') {
        let mut bits: Vec<_> = arg.split('|').map(str::trim).collect();
        bits.sort_unstable();
        return bits.join(" | ");
    }
    if let Some(digits) = arg.strip_prefix("0x")
        && let Ok(number) = u64::from_str_radix(digits, 16)
    {
        return number.to_string();
    }
    // apitrace rounds floats to seven digits, so six are kept of either text.
    match arg.parse::<f32>() {
        Ok(number) if arg.contains(['.', 'e', 'E']) => {
            let rounded = format!("{number:.5e}");
            rounded.parse::<f32>().unwrap_or(number).to_string()
        }
        _ => arg.to_owned(),
    }
}
