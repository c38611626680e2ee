//! The record as C, one call a line, as the handouts write it.

use std::borrow::Cow;
use std::fmt::{Display, Write};

use super::{Arg, Call, Event, Names, Object, ObjectKind, names};

/// The record as C text. A pass is a heading; what a call answered, and what its numbers stand for, follows it as a
/// comment. Objects that the lab has not named are called by kind and number, `texture_3`.
pub fn to_c(events: &[Event]) -> String {
    let mut text = String::new();
    for event in events {
        match event {
            Event::Pass(name) => {
                if !text.is_empty() {
                    text.push('\n');
                }
                text += &format!("// {name}\n");
            }
            Event::Call(call) => {
                text += &call_to_c(call);
                text.push('\n');
            }
        }
    }
    text
}

fn call_to_c(call: &Call) -> String {
    let args: Vec<_> = call.args.iter().map(arg_to_c).collect();
    let mut line = format!("{}({});", call.name, args.join(", "));
    let mut comments: Vec<String> = Vec::new();
    if let Some(result) = &call.result {
        let (variable, value) = result_to_c(call.name, result);
        line.insert_str(0, &format!("{variable} = "));
        comments.extend(value);
    }
    comments.extend(call.args.iter().filter_map(comment));
    if !comments.is_empty() {
        let _ = write!(line, "  // {}", comments.join(", "));
    }
    line
}

/// The variable that takes a result, and the value that it got, unless the variable's name says it.
fn result_to_c(function: &str, result: &Arg) -> (String, Option<String>) {
    let variable = match result {
        Arg::Object(object) => return (format!("GLuint {}", object_to_c(object)), None),
        Arg::Bool(_) => "GLboolean answer",
        Arg::Enum(Names::Error, _) => "GLenum error",
        Arg::Enum(..) => "GLenum status",
        Arg::Str(_) | Arg::Null => "const GLubyte *text",
        _ if function == "glGetUniformBlockIndex" => "GLuint index",
        _ => "GLint location",
    };
    (variable.to_owned(), Some(arg_to_c(result)))
}

fn arg_to_c(arg: &Arg) -> String {
    match arg {
        Arg::Int(value) => value.to_string(),
        Arg::Float(value) => float_to_c(*value),
        Arg::Double(value) => float_to_c(*value),
        Arg::Bool(true) => "GL_TRUE".to_owned(),
        Arg::Bool(false) => "GL_FALSE".to_owned(),
        Arg::Enum(names, value) => enum_to_c(*names, *value).into_owned(),
        Arg::Buffers(bits) => buffers_to_c(*bits),
        Arg::Mask(bits) => format!("{bits:#X}").replacen("0X", "0x", 1),
        Arg::Object(object) => object_to_c(object),
        Arg::Objects(objects) => match objects.as_slice() {
            [object] => format!("&{}", object_to_c(object)),
            objects => array_to_c("GLuint", objects.iter().map(object_to_c)),
        },
        Arg::Location { index, .. } => index.to_string(),
        Arg::Str(text) => format!("{text:?}"),
        Arg::Ints(values) => array_to_c("GLint", values.iter().map(i64::to_string)),
        Arg::Floats(values) => array_to_c("GLfloat", values.iter().copied().map(float_to_c)),
        Arg::Enums(element, names, values) => {
            let values = values.iter().map(|value| enum_to_c(*names, *value));
            array_to_c(element, values.map(Cow::into_owned))
        }
        Arg::Data { .. } => "data".to_owned(),
        Arg::Offset(0) | Arg::Null => "0".to_owned(),
        Arg::Offset(bytes) => format!("(const void *){bytes}"),
        Arg::Value(_) => "&value".to_owned(),
        Arg::Place(place) => (*place).to_owned(),
    }
}

/// What the line's reader would want to know of an argument.
fn comment(arg: &Arg) -> Option<String> {
    match arg {
        Arg::Location { name, .. } => name.clone(),
        Arg::Data { bytes: Some(bytes) } => Some(format!("{bytes} bytes")),
        Arg::Value(value) => Some(value.to_string()),
        _ => None,
    }
}

/// The shortest text that reads back as the same number; `1`, where Rust would say `1.0`.
fn float_to_c(value: impl Display + Into<f64> + Copy + std::fmt::LowerExp) -> String {
    match value.into() {
        wide if wide.is_nan() => "NAN".to_owned(),
        f64::INFINITY => "INFINITY".to_owned(),
        f64::NEG_INFINITY => "-INFINITY".to_owned(),
        wide if wide != 0.0 && !(1e-4..1e7).contains(&wide.abs()) => format!("{value:e}"),
        _ => value.to_string(),
    }
}

fn array_to_c(element: &str, values: impl Iterator<Item = String>) -> String {
    let values: Vec<_> = values.collect();
    format!("(const {element}[]){{{}}}", values.join(", "))
}

fn buffers_to_c(bits: u32) -> String {
    let mut left = bits;
    let mut text = Vec::new();
    for (bit, name) in [
        (glow::COLOR_BUFFER_BIT, "GL_COLOR_BUFFER_BIT"),
        (glow::DEPTH_BUFFER_BIT, "GL_DEPTH_BUFFER_BIT"),
        (glow::STENCIL_BUFFER_BIT, "GL_STENCIL_BUFFER_BIT"),
    ] {
        if left & bit != 0 {
            text.push(name.to_owned());
            left &= !bit;
        }
    }
    if left != 0 || text.is_empty() {
        text.push(hexadecimal(left).into_owned());
    }
    text.join(" | ")
}

fn enum_to_c(names: Names, value: u32) -> Cow<'static, str> {
    let name = match (names, value) {
        (Names::General, glow::NONE) => "GL_NONE",
        (Names::Error, glow::NO_ERROR) => "GL_NO_ERROR",
        (Names::Factor, glow::ZERO) => "GL_ZERO",
        (Names::Factor, glow::ONE) => "GL_ONE",
        (Names::Primitive, value) => {
            return names::primitive(value).map_or(hexadecimal(value), Cow::Borrowed);
        }
        (_, value) => match names::name(value) {
            Some(name) => name,
            None => return numbered(value),
        },
    };
    Cow::Borrowed(name)
}

/// The names that end in a number, and, failing that, the value in hexadecimal, as the specification's tables have it.
fn numbered(value: u32) -> Cow<'static, str> {
    match value {
        glow::TEXTURE0..=glow::TEXTURE31 => {
            Cow::Owned(format!("GL_TEXTURE{}", value - glow::TEXTURE0))
        }
        glow::COLOR_ATTACHMENT0..=glow::COLOR_ATTACHMENT31 => Cow::Owned(format!(
            "GL_COLOR_ATTACHMENT{}",
            value - glow::COLOR_ATTACHMENT0
        )),
        _ => hexadecimal(value),
    }
}

fn hexadecimal(value: u32) -> Cow<'static, str> {
    Cow::Owned(format!("0x{value:04X}"))
}

fn object_to_c(object: &Object) -> String {
    let kind = match object.kind {
        _ if object.id == 0 => return "0".to_owned(),
        ObjectKind::Buffer => "buffer",
        ObjectKind::Framebuffer => "framebuffer",
        ObjectKind::Program => "program",
        ObjectKind::Query => "query",
        ObjectKind::Renderbuffer => "renderbuffer",
        ObjectKind::Sampler => "sampler",
        ObjectKind::Shader => "shader",
        ObjectKind::Texture => "texture",
        ObjectKind::VertexArray => "vertex_array",
    };
    match &object.name {
        Some(name) => name.clone(),
        None => format!("{kind}_{}", object.id),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(name: &'static str, args: &[Arg], result: Option<Arg>) -> String {
        let call = Call {
            name,
            args: args.to_vec(),
            result,
        };
        to_c(&[Event::Call(call)]).trim_end().to_owned()
    }

    fn object(kind: ObjectKind, id: u32, name: Option<&str>) -> Object {
        Object {
            kind,
            id,
            name: name.map(str::to_owned),
        }
    }

    fn general(value: u32) -> Arg {
        Arg::Enum(Names::General, value)
    }

    #[test]
    fn the_same_number_is_written_by_its_meaning() {
        let four = [
            Arg::Int(4),
            Arg::Enum(Names::Primitive, 4),
            general(4),
            Arg::Mask(4),
            Arg::Offset(4),
        ];
        assert_eq!(
            four.each_ref().map(arg_to_c),
            ["4", "GL_TRIANGLES", "0x0004", "0x4", "(const void *)4"]
        );
        let zero = [
            general(0),
            Arg::Enum(Names::Error, 0),
            Arg::Enum(Names::Factor, 0),
            Arg::Enum(Names::Primitive, 0),
            Arg::Bool(false),
            Arg::Object(object(ObjectKind::Framebuffer, 0, Some("never"))),
            Arg::Null,
            Arg::Offset(0),
            Arg::Buffers(0),
        ];
        assert_eq!(
            zero.each_ref().map(arg_to_c),
            [
                "GL_NONE",
                "GL_NO_ERROR",
                "GL_ZERO",
                "GL_POINTS",
                "GL_FALSE",
                "0",
                "0",
                "0",
                "0x0000"
            ]
        );
    }

    #[test]
    fn objects_have_the_labs_name_or_kind_and_number() {
        let named = object(ObjectKind::Framebuffer, 1, Some("frame_buffer"));
        let unnamed = object(ObjectKind::VertexArray, 7, None);
        assert_eq!(
            line(
                "glGenFramebuffers",
                &[Arg::Int(1), Arg::Objects(vec![named.clone()])],
                None
            ),
            "glGenFramebuffers(1, &frame_buffer);"
        );
        assert_eq!(
            line(
                "glBindFramebuffer",
                &[general(glow::FRAMEBUFFER), Arg::Object(named.clone())],
                None
            ),
            "glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);"
        );
        assert_eq!(
            line("glBindVertexArray", &[Arg::Object(unnamed.clone())], None),
            "glBindVertexArray(vertex_array_7);"
        );
        assert_eq!(
            arg_to_c(&Arg::Objects(vec![named, unnamed])),
            "(const GLuint[]){frame_buffer, vertex_array_7}"
        );
    }

    #[test]
    fn results_are_declared_and_their_values_follow() {
        let program = Arg::Object(object(ObjectKind::Program, 3, Some("program")));
        let location = Arg::Location {
            index: 1,
            name: None,
        };
        let asked = [program.clone(), Arg::Str("shadow_sampler".to_owned())];
        assert_eq!(
            line("glGetUniformLocation", &asked, Some(location)),
            "GLint location = glGetUniformLocation(program, \"shadow_sampler\");  // 1"
        );
        assert_eq!(
            line("glCreateProgram", &[], Some(program)),
            "GLuint program = glCreateProgram();"
        );
        assert_eq!(
            line("glGetError", &[], Some(Arg::Enum(Names::Error, 0))),
            "GLenum error = glGetError();  // GL_NO_ERROR"
        );
        assert_eq!(
            line(
                "glCheckFramebufferStatus",
                &[general(glow::FRAMEBUFFER)],
                Some(general(glow::FRAMEBUFFER_COMPLETE))
            ),
            "GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);  // GL_FRAMEBUFFER_COMPLETE"
        );
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            arg_to_c(&Arg::Floats(vec![
                1.0,
                -0.5,
                0.1,
                std::f32::consts::FRAC_1_SQRT_2,
                1e-8,
                0.0,
                f32::NAN
            ])),
            "(const GLfloat[]){1, -0.5, 0.1, 0.70710677, 1e-8, 0, NAN}"
        );
        assert_eq!(arg_to_c(&Arg::Double(0.1)), "0.1");
        assert_eq!(arg_to_c(&Arg::Mask(0xFF)), "0xFF");
    }

    #[test]
    fn enumerations_have_their_names() {
        let values = [
            glow::TEXTURE0,
            glow::TEXTURE0 + 1,
            glow::COLOR_ATTACHMENT0 + 2,
            glow::DEPTH_COMPONENT,
            0xBEEF,
        ];
        assert_eq!(
            values.map(|value| arg_to_c(&general(value))),
            [
                "GL_TEXTURE0",
                "GL_TEXTURE1",
                "GL_COLOR_ATTACHMENT2",
                "GL_DEPTH_COMPONENT",
                "0xBEEF"
            ]
        );
        assert_eq!(
            arg_to_c(&Arg::Buffers(
                glow::DEPTH_BUFFER_BIT | glow::COLOR_BUFFER_BIT
            )),
            "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT"
        );
        assert_eq!(
            arg_to_c(&Arg::Enums(
                "GLenum",
                Names::General,
                vec![glow::NONE, glow::BACK]
            )),
            "(const GLenum[]){GL_NONE, GL_BACK}"
        );
    }

    #[test]
    fn memory_is_written_by_its_size_only() {
        let filled = Arg::Data { bytes: Some(96) };
        let usage = general(glow::STATIC_DRAW);
        let target = general(glow::ARRAY_BUFFER);
        assert_eq!(
            line("glBufferData", &[target, Arg::Int(96), filled, usage], None),
            "glBufferData(GL_ARRAY_BUFFER, 96, data, GL_STATIC_DRAW);  // 96 bytes"
        );
        assert_eq!(
            line(
                "glShaderSource",
                &[
                    Arg::Object(object(ObjectKind::Shader, 1, None)),
                    Arg::Int(1),
                    Arg::Place("&source"),
                    Arg::Place("&length")
                ],
                None
            ),
            "glShaderSource(shader_1, 1, &source, &length);"
        );
    }

    #[test]
    fn passes_are_headings() {
        let finish = || {
            Event::Call(Call {
                name: "glFinish",
                args: vec![],
                result: None,
            })
        };
        let events = [
            Event::Pass("first pass: drawing the shadow map".to_owned()),
            finish(),
            Event::Pass("second pass: using the shadow map".to_owned()),
            finish(),
        ];
        assert_eq!(
            to_c(&events),
            "// first pass: drawing the shadow map\nglFinish();\n\n\
             // second pass: using the shadow map\nglFinish();\n"
        );
    }
}
