//! What an argument of a GL call means: for C, `4` is a number, GL_TRIANGLES, a bit or the fourth texture.

use std::ffi::{CStr, c_char, c_void};

/// An argument or a result, with its meaning.
#[derive(Clone, Debug, PartialEq)]
pub enum Arg {
    Int(i64),
    Float(f32),
    Double(f64),
    /// GL_TRUE or GL_FALSE.
    Bool(bool),
    /// One value of an enumeration.
    Enum(Names, u32),
    /// The buffers that glClear or glBlitFramebuffer touches.
    Buffers(u32),
    /// A bit mask that is a number: the stencil masks.
    Mask(u32),
    Object(Object),
    /// The objects that a glGen or glDelete function lists.
    Objects(Vec<Object>),
    /// A uniform location, with the uniform's name where the record knows it.
    Location {
        index: i32,
        name: Option<String>,
    },
    Str(String),
    Ints(Vec<i64>),
    Floats(Vec<f32>),
    /// Names, in an array of the C type that is given.
    Enums(&'static str, Names, Vec<u32>),
    /// Memory that GL reads or fills, with its size where the call tells it (rows of pixels are counted unpadded).
    Data {
        bytes: Option<usize>,
    },
    /// A byte offset into the bound buffer.
    Offset(usize),
    /// A null pointer: no data.
    Null,
    /// A place for one number, and the number that GL put there.
    Value(i64),
    /// A place for something that the record does not keep, as C would write it.
    Place(&'static str),
}

/// Which enumeration a number is from. The small numbers mean something else in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// 0 is GL_NONE.
    General,
    /// 0 is GL_POINTS, 4 is GL_TRIANGLES.
    Primitive,
    /// 0 is GL_ZERO and 1 is GL_ONE: blend factors, stencil operations, swizzles.
    Factor,
    /// 0 is GL_NO_ERROR.
    Error,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ObjectKind {
    Buffer,
    Framebuffer,
    Program,
    Query,
    Renderbuffer,
    Sampler,
    Shader,
    Texture,
    VertexArray,
}

/// An object by its number; 0 is the default framebuffer, or none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Object {
    pub kind: ObjectKind,
    pub id: u32,
    /// What the lab calls it, once it has said so.
    pub name: Option<String>,
}

impl Object {
    pub fn new(kind: ObjectKind, id: u32) -> Self {
        Self {
            kind,
            id,
            name: None,
        }
    }
}

/// A parameter type of a shim: laid out as GL's own type, and knowing what it means.
pub(super) trait Meaning: Copy {
    fn arg(self) -> Arg;
}

/// A parameter that can have another number in it. A pointer stays as it is.
pub(super) trait Editable: Copy {
    fn with(self, _number: i64) -> Self {
        self
    }
}

impl<T> Editable for *const T {}
impl<T> Editable for *mut T {}

/// The newtypes: `Name(what GL passes) => the meaning`. Those of numbers can have another number in them.
macro_rules! meanings {
    ($($name:ident($raw:ty) => |$value:ident| $arg:expr;)*) => {$(
        meaning!($name($raw) => |$value| $arg; number => number as $raw);
    )*};
}

/// Those of pointers cannot.
macro_rules! pointers {
    ($($name:ident($raw:ty) => |$value:ident| $arg:expr;)*) => {$(
        meaning!($name($raw) => |$value| $arg);
    )*};
}

macro_rules! meaning {
    ($name:ident($raw:ty) => |$value:ident| $arg:expr $(; $number:ident => $other:expr)?) => {
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(super) struct $name(pub $raw);

        impl Meaning for $name {
            fn arg(self) -> Arg {
                let $value = self.0;
                $arg
            }
        }

        impl Editable for $name {
            $(fn with(self, $number: i64) -> Self {
                Self($other)
            })?
        }
    };
}

meanings! {
    Enum(u32) => |value| Arg::Enum(Names::General, value);
    // glTexImage takes the internal format as a signed number.
    Format(i32) => |value| Arg::Enum(Names::General, value as u32);
    Primitive(u32) => |value| Arg::Enum(Names::Primitive, value);
    Factor(u32) => |value| Arg::Enum(Names::Factor, value);
    Error(u32) => |value| Arg::Enum(Names::Error, value);
    Buffers(u32) => |value| Arg::Buffers(value);
    Mask(u32) => |value| Arg::Mask(value);
    Bool(u8) => |value| Arg::Bool(value != 0);
    Location(i32) => |index| Arg::Location { index, name: None };
    Buffer(u32) => |id| Arg::Object(Object::new(ObjectKind::Buffer, id));
    Framebuffer(u32) => |id| Arg::Object(Object::new(ObjectKind::Framebuffer, id));
    Program(u32) => |id| Arg::Object(Object::new(ObjectKind::Program, id));
    Query(u32) => |id| Arg::Object(Object::new(ObjectKind::Query, id));
    Renderbuffer(u32) => |id| Arg::Object(Object::new(ObjectKind::Renderbuffer, id));
    Sampler(u32) => |id| Arg::Object(Object::new(ObjectKind::Sampler, id));
    Shader(u32) => |id| Arg::Object(Object::new(ObjectKind::Shader, id));
    Texture(u32) => |id| Arg::Object(Object::new(ObjectKind::Texture, id));
    VertexArray(u32) => |id| Arg::Object(Object::new(ObjectKind::VertexArray, id));
}

pointers! {
    Str(*const c_char) => |pointer| unsafe { string(pointer) };
    // The same, as glGetString returns it.
    UStr(*const u8) => |pointer| unsafe { string(pointer.cast()) };
    Offset(*const c_void) => |pointer| Arg::Offset(pointer as usize);
    // Memory that GL fills.
    Out(*mut c_void) => |pointer| {
        if pointer.is_null() { Arg::Null } else { Arg::Data { bytes: None } }
    };
}

macro_rules! numbers {
    ($($raw:ty => $arg:expr;)*) => {$(
        impl Meaning for $raw {
            fn arg(self) -> Arg {
                $arg(self.into())
            }
        }

        impl Editable for $raw {
            fn with(self, number: i64) -> Self {
                number as $raw
            }
        }
    )*};
}

numbers! {
    i32 => Arg::Int;
    u32 => Arg::Int;
    f32 => Arg::Float;
    f64 => Arg::Double;
}

impl Meaning for isize {
    fn arg(self) -> Arg {
        Arg::Int(self as i64)
    }
}

impl Editable for isize {}

/// Where GL puts its answers.
impl<T> Meaning for *mut T {
    fn arg(self) -> Arg {
        Arg::Place("&value")
    }
}

unsafe fn string(text: *const c_char) -> Arg {
    if text.is_null() {
        return Arg::Null;
    }
    let text = unsafe { CStr::from_ptr(text) };
    Arg::Str(text.to_string_lossy().into_owned())
}

/// `count` values from `first`; nothing where there is nothing to read.
unsafe fn values<T: Copy>(first: *const T, count: i32) -> Vec<T> {
    match usize::try_from(count) {
        Ok(count) if !first.is_null() => {
            unsafe { std::slice::from_raw_parts(first, count) }.to_vec()
        }
        _ => Vec::new(),
    }
}

pub(super) unsafe fn objects<T: Meaning>(first: *const T, count: i32) -> Arg {
    let objects = unsafe { values(first, count) }.into_iter();
    Arg::Objects(
        objects
            .filter_map(|object| match object.arg() {
                Arg::Object(object) => Some(object),
                _ => None,
            })
            .collect(),
    )
}

/// The buffers of glDrawBuffers.
pub(super) unsafe fn enums(first: *const u32, count: i32) -> Arg {
    Arg::Enums("GLenum", Names::General, unsafe { values(first, count) })
}

/// The numbers of `count` vectors with `components` numbers each.
pub(super) unsafe fn ints<T: Copy + Into<i64>>(
    first: *const T,
    count: i32,
    components: i32,
) -> Arg {
    let values = unsafe { values(first, count.saturating_mul(components)) };
    Arg::Ints(values.into_iter().map(Into::into).collect())
}

/// The numbers of `count` vectors or matrices with `components` numbers each.
pub(super) unsafe fn floats(first: *const f32, count: i32, components: i32) -> Arg {
    Arg::Floats(unsafe { values(first, count.saturating_mul(components)) })
}

/// The one number that glGetShaderiv and its like give back.
pub(super) unsafe fn value(place: *const i32) -> Arg {
    if place.is_null() {
        Arg::Null
    } else {
        Arg::Value(unsafe { *place }.into())
    }
}

/// Memory of a size that the call tells.
pub(super) fn data(pointer: *const c_void, bytes: Option<usize>) -> Arg {
    if pointer.is_null() {
        Arg::Null
    } else {
        Arg::Data { bytes }
    }
}

/// The bytes of an image without padding between its rows; `None` for a format that is not in the table.
pub(super) fn image_bytes(format: Enum, component: Enum, sides: &[i32]) -> Option<usize> {
    let components = match format.0 {
        glow::RED | glow::RED_INTEGER | glow::DEPTH_COMPONENT | glow::STENCIL_INDEX => 1,
        glow::RG | glow::RG_INTEGER => 2,
        glow::RGB | glow::BGR | glow::RGB_INTEGER => 3,
        glow::RGBA | glow::BGRA | glow::RGBA_INTEGER => 4,
        _ => return None,
    };
    let bytes = match component.0 {
        glow::UNSIGNED_BYTE | glow::BYTE => 1,
        glow::UNSIGNED_SHORT | glow::SHORT | glow::HALF_FLOAT => 2,
        glow::UNSIGNED_INT | glow::INT | glow::FLOAT => 4,
        _ => return None,
    };
    sides.iter().try_fold(components * bytes, |size, side| {
        usize::try_from(*side).ok()?.checked_mul(size)
    })
}

/// The one value of a texture or sampler parameter: the levels are numbers, all others are names.
pub(super) fn texture_parameter(name: Enum, value: i32) -> Arg {
    match name.0 {
        glow::TEXTURE_BASE_LEVEL | glow::TEXTURE_MAX_LEVEL => Arg::Int(value.into()),
        _ => Arg::Enum(parameter_names(name), value as u32),
    }
}

/// The values of glTexParameteriv.
pub(super) unsafe fn texture_parameters(name: Enum, first: *const i32) -> Arg {
    let count = match name.0 {
        glow::TEXTURE_BASE_LEVEL | glow::TEXTURE_MAX_LEVEL => return unsafe { ints(first, 1, 1) },
        glow::TEXTURE_BORDER_COLOR => return unsafe { ints(first, 4, 1) },
        glow::TEXTURE_SWIZZLE_RGBA => 4,
        _ => 1,
    };
    let values = unsafe { values(first.cast(), count) };
    Arg::Enums("GLint", parameter_names(name), values)
}

/// A swizzle's 0 and 1 are the numbers; a comparison mode's 0 is GL_NONE.
fn parameter_names(name: Enum) -> Names {
    match name.0 {
        glow::TEXTURE_COMPARE_MODE => Names::General,
        _ => Names::Factor,
    }
}

/// The values of glTexParameterfv.
pub(super) unsafe fn texture_floats(name: Enum, values: *const f32) -> Arg {
    let count = if name.0 == glow::TEXTURE_BORDER_COLOR {
        4
    } else {
        1
    };
    unsafe { floats(values, count, 1) }
}

/// How many numbers glClearBuffer reads.
pub(super) fn clear_components(buffer: Enum) -> i32 {
    if buffer.0 == glow::COLOR { 4 } else { 1 }
}
