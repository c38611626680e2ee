//! The traced functions: their C declarations, with a type for each argument's meaning.

use std::ffi::{CStr, c_char, c_void};
use std::mem::transmute;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicPtr, Ordering};

use super::args::*;
use super::{Call, record, watch};
use crate::gl::edits::{self, Make};

/// Makes, from the declarations below, [`FUNCTIONS`] and a shim for each of them. Where an argument's type does not
/// say enough (how long is this array?), `= expression` says what the record shows.
macro_rules! traced {
    ($(fn $name:ident($($arg:ident: $kind:ty $(= $shown:expr)?),*) $(-> $result:ty)?;)*) => {
        /// The GL functions that are recorded. A recorded context has no others, but for [`FORWARDED`].
        pub const FUNCTIONS: &[&str] = &[$(stringify!($name)),*];

        /// The shim of a traced function; null for a function that is not in the list or that the driver lacks.
        #[allow(non_snake_case)]
        fn traced(name: &str, driver: *const c_void) -> *const c_void {
            match name {
                $(stringify!($name) => {
                    static DRIVER: AtomicPtr<c_void> = AtomicPtr::new(null_mut());

                    unsafe extern "system" fn $name($($arg: $kind),*) $(-> $result)? {
                        type Function = unsafe extern "system" fn($($kind),*) $(-> $result)?;
                        unsafe {
                            let driver: Function = transmute(DRIVER.load(Ordering::Relaxed));
                            let call = |$($arg: $kind),*| {
                                let begun = watch::before_call();
                                // First the driver, so that what it answers can be recorded.
                                let result = driver($($arg),*);
                                watch::after_call(begun);
                                if watch::records() {
                                    record(Call {
                                        name: stringify!($name),
                                        args: vec![$(shown!($arg $(= $shown)?)),*],
                                        result: returned!(result $(-> $result)?),
                                    });
                                }
                                result
                            };
                            edited!($name, call, ($($arg: $kind $(= $shown)?),*) $(-> $result)?)
                        }
                    }

                    DRIVER.store(driver.cast_mut(), Ordering::Relaxed);
                    $name as *const c_void
                })*
                _ => null(),
            }
        }
    };
}

/// The call, or what an edit makes of it; a function that answers is not edited.
macro_rules! edited {
    ($name:ident, $call:ident, ()) => {
        $call()
    };
    ($name:ident, $call:ident, ($($arg:ident: $kind:ty $(= $shown:expr)?),*)) => {{
        let edit = edits::call(stringify!($name), || vec![$(shown!($arg $(= $shown)?)),*]);
        let with = |changes: &[(usize, i64)]| {
            let mut places = 0..;
            $(
                let place = places.next().expect("a call has few arguments");
                let $arg = edits::argument(changes, place).map_or($arg, |number| $arg.with(number));
            )*
            $call($($arg),*)
        };
        match edit {
            None => $call($($arg),*),
            Some(Make::Nothing) => (),
            Some(Make::Instead(changes)) => with(changes),
            Some(Make::Also(changes)) => {
                $call($($arg),*);
                with(changes)
            }
        }
    }};
    ($name:ident, $call:ident, ($($arg:ident: $kind:ty $(= $shown:expr)?),*) -> $result:ty) => {
        $call($($arg),*)
    };
}

macro_rules! shown {
    ($arg:ident) => {
        $arg.arg()
    };
    ($arg:ident = $shown:expr) => {
        $shown
    };
}

macro_rules! returned {
    ($result:ident) => {
        None
    };
    ($result:ident -> $kind:ty) => {
        Some($result.arg())
    };
}

/// Debug output (KHR_debug), which goes to the driver unrecorded: no handout has it, and it changes no picture.
pub const FORWARDED: &[&str] = &[
    "glDebugMessageCallback",
    "glDebugMessageControl",
    "glDebugMessageInsert",
    "glGetDebugMessageLog",
    "glGetObjectLabel",
    "glGetObjectPtrLabel",
    "glGetPointerv",
    "glObjectLabel",
    "glObjectPtrLabel",
    "glPopDebugGroup",
    "glPushDebugGroup",
];

/// What the recorded context calls instead of `driver`.
pub(super) fn shim(name: &CStr, driver: *const c_void) -> *const c_void {
    match name.to_str() {
        Ok(name) if FORWARDED.contains(&name) => driver,
        Ok(name) if !driver.is_null() => traced(name, driver),
        _ => null(),
    }
}

/// glow 0.17 asks for the result of a query by an extension's name unless the context has a function of GL 4.5. The
/// core function is the same one.
pub(super) fn core_name(name: &CStr) -> &CStr {
    match name.to_bytes() {
        b"glGetQueryObjectuivEXT" => c"glGetQueryObjectuiv",
        b"glGetQueryObjectui64vEXT" => c"glGetQueryObjectui64v",
        _ => name,
    }
}

traced! {
    // The state.
    fn glEnable(capability: Enum);
    fn glDisable(capability: Enum);
    fn glEnablei(capability: Enum, index: u32);
    fn glDisablei(capability: Enum, index: u32);
    fn glIsEnabled(capability: Enum) -> Bool;
    fn glViewport(x: i32, y: i32, width: i32, height: i32);
    fn glScissor(x: i32, y: i32, width: i32, height: i32);
    fn glDepthFunc(function: Enum);
    fn glDepthMask(write: Bool);
    fn glDepthRange(near: f64, far: f64);
    fn glColorMask(red: Bool, green: Bool, blue: Bool, alpha: Bool);
    fn glColorMaski(buffer: u32, red: Bool, green: Bool, blue: Bool, alpha: Bool);
    fn glStencilFunc(function: Enum, reference: i32, mask: Mask);
    fn glStencilFuncSeparate(face: Enum, function: Enum, reference: i32, mask: Mask);
    fn glStencilOp(stencil_fail: Factor, depth_fail: Factor, pass: Factor);
    fn glStencilOpSeparate(face: Enum, stencil_fail: Factor, depth_fail: Factor, pass: Factor);
    fn glStencilMask(mask: Mask);
    fn glStencilMaskSeparate(face: Enum, mask: Mask);
    fn glCullFace(face: Enum);
    fn glFrontFace(direction: Enum);
    fn glPolygonMode(face: Enum, mode: Enum);
    fn glPolygonOffset(factor: f32, units: f32);
    fn glLineWidth(width: f32);
    fn glBlendFunc(source: Factor, destination: Factor);
    fn glBlendFuncSeparate(source: Factor, destination: Factor, source_alpha: Factor, destination_alpha: Factor);
    fn glBlendEquation(equation: Enum);
    fn glBlendEquationSeparate(equation: Enum, equation_alpha: Enum);
    fn glBlendColor(red: f32, green: f32, blue: f32, alpha: f32);
    fn glSampleCoverage(value: f32, invert: Bool);
    fn glHint(target: Enum, mode: Enum);
    fn glPixelStorei(name: Enum, value: i32);

    // Clearing, drawing, finishing.
    fn glClear(buffers: Buffers);
    fn glClearColor(red: f32, green: f32, blue: f32, alpha: f32);
    fn glClearDepth(depth: f64);
    fn glClearStencil(stencil: i32);
    fn glClearBufferfv(buffer: Enum, index: i32, values: *const f32 = floats(values, 1, clear_components(buffer)));
    fn glClearBufferiv(buffer: Enum, index: i32, values: *const i32 = ints(values, 1, clear_components(buffer)));
    fn glClearBufferuiv(buffer: Enum, index: i32, values: *const u32 = ints(values, 1, clear_components(buffer)));
    fn glClearBufferfi(buffer: Enum, index: i32, depth: f32, stencil: i32);
    fn glDrawArrays(mode: Primitive, first: i32, count: i32);
    fn glDrawArraysInstanced(mode: Primitive, first: i32, count: i32, instances: i32);
    fn glDrawElements(mode: Primitive, count: i32, kind: Enum, indices: Offset);
    fn glDrawElementsInstanced(mode: Primitive, count: i32, kind: Enum, indices: Offset, instances: i32);
    fn glDrawElementsBaseVertex(mode: Primitive, count: i32, kind: Enum, indices: Offset, base_vertex: i32);
    fn glFlush();
    fn glFinish();

    // Questions.
    fn glGetError() -> Error;
    fn glGetString(name: Enum) -> UStr;
    fn glGetStringi(name: Enum, index: u32) -> UStr;
    fn glGetBooleanv(name: Enum, values: *mut u8);
    fn glGetIntegerv(name: Enum, values: *mut i32);
    fn glGetIntegeri_v(name: Enum, index: u32, values: *mut i32);
    fn glGetInteger64v(name: Enum, values: *mut i64);
    fn glGetFloatv(name: Enum, values: *mut f32);

    // Framebuffers and renderbuffers.
    fn glGenFramebuffers(count: i32, framebuffers: *mut Framebuffer = objects(framebuffers, count));
    fn glDeleteFramebuffers(count: i32, framebuffers: *const Framebuffer = objects(framebuffers, count));
    fn glBindFramebuffer(target: Enum, framebuffer: Framebuffer);
    fn glIsFramebuffer(framebuffer: Framebuffer) -> Bool;
    fn glCheckFramebufferStatus(target: Enum) -> Enum;
    fn glFramebufferTexture(target: Enum, attachment: Enum, texture: Texture, level: i32);
    fn glFramebufferTexture2D(target: Enum, attachment: Enum, texture_target: Enum, texture: Texture, level: i32);
    fn glFramebufferTextureLayer(target: Enum, attachment: Enum, texture: Texture, level: i32, layer: i32);
    fn glFramebufferRenderbuffer(target: Enum, attachment: Enum, buffer_target: Enum, renderbuffer: Renderbuffer);
    fn glGetFramebufferAttachmentParameteriv(target: Enum, attachment: Enum, name: Enum, values: *mut i32);
    fn glDrawBuffer(buffer: Enum);
    fn glDrawBuffers(count: i32, buffers: *const u32 = enums(buffers, count));
    fn glReadBuffer(buffer: Enum);
    fn glReadPixels(x: i32, y: i32, width: i32, height: i32, format: Enum, kind: Enum,
        pixels: *mut c_void = data(pixels, image_bytes(format, kind, &[width, height])));
    fn glBlitFramebuffer(from_left: i32, from_bottom: i32, from_right: i32, from_top: i32,
        to_left: i32, to_bottom: i32, to_right: i32, to_top: i32, buffers: Buffers, filter: Enum);
    fn glGenRenderbuffers(count: i32, renderbuffers: *mut Renderbuffer = objects(renderbuffers, count));
    fn glDeleteRenderbuffers(count: i32, renderbuffers: *const Renderbuffer = objects(renderbuffers, count));
    fn glBindRenderbuffer(target: Enum, renderbuffer: Renderbuffer);
    fn glIsRenderbuffer(renderbuffer: Renderbuffer) -> Bool;
    fn glRenderbufferStorage(target: Enum, format: Enum, width: i32, height: i32);
    fn glRenderbufferStorageMultisample(target: Enum, samples: i32, format: Enum, width: i32, height: i32);
    fn glGetRenderbufferParameteriv(target: Enum, name: Enum, values: *mut i32);

    // Textures and samplers.
    fn glGenTextures(count: i32, textures: *mut Texture = objects(textures, count));
    fn glDeleteTextures(count: i32, textures: *const Texture = objects(textures, count));
    fn glActiveTexture(unit: Enum);
    fn glBindTexture(target: Enum, texture: Texture);
    fn glIsTexture(texture: Texture) -> Bool;
    fn glTexImage1D(target: Enum, level: i32, internal_format: Format, width: i32, border: i32,
        format: Enum, kind: Enum, pixels: *const c_void = data(pixels, image_bytes(format, kind, &[width])));
    fn glTexImage2D(target: Enum, level: i32, internal_format: Format, width: i32, height: i32, border: i32,
        format: Enum, kind: Enum, pixels: *const c_void = data(pixels, image_bytes(format, kind, &[width, height])));
    fn glTexImage2DMultisample(target: Enum, samples: i32, internal_format: Enum, width: i32, height: i32,
        fixed_places: Bool);
    fn glTexImage3D(target: Enum, level: i32, internal_format: Format, width: i32, height: i32, depth: i32,
        border: i32, format: Enum, kind: Enum,
        pixels: *const c_void = data(pixels, image_bytes(format, kind, &[width, height, depth])));
    fn glTexSubImage2D(target: Enum, level: i32, x: i32, y: i32, width: i32, height: i32, format: Enum, kind: Enum,
        pixels: *const c_void = data(pixels, image_bytes(format, kind, &[width, height])));
    fn glTexSubImage3D(target: Enum, level: i32, x: i32, y: i32, z: i32, width: i32, height: i32, depth: i32,
        format: Enum, kind: Enum,
        pixels: *const c_void = data(pixels, image_bytes(format, kind, &[width, height, depth])));
    fn glCopyTexImage2D(target: Enum, level: i32, internal_format: Enum, x: i32, y: i32, width: i32, height: i32,
        border: i32);
    fn glCopyTexSubImage2D(target: Enum, level: i32, to_x: i32, to_y: i32, x: i32, y: i32, width: i32, height: i32);
    fn glTexBuffer(target: Enum, internal_format: Enum, buffer: Buffer);
    fn glTexParameteri(target: Enum, name: Enum, value: i32 = texture_parameter(name, value));
    fn glTexParameterf(target: Enum, name: Enum, value: f32);
    fn glTexParameteriv(target: Enum, name: Enum, values: *const i32 = texture_parameters(name, values));
    fn glTexParameterfv(target: Enum, name: Enum, values: *const f32 = texture_floats(name, values));
    fn glGetTexParameteriv(target: Enum, name: Enum, values: *mut i32);
    fn glGetTexParameterfv(target: Enum, name: Enum, values: *mut f32);
    fn glGetTexLevelParameteriv(target: Enum, level: i32, name: Enum, values: *mut i32);
    fn glGetTexLevelParameterfv(target: Enum, level: i32, name: Enum, values: *mut f32);
    fn glGenerateMipmap(target: Enum);
    fn glGetTexImage(target: Enum, level: i32, format: Enum, kind: Enum, pixels: Out);
    fn glGenSamplers(count: i32, samplers: *mut Sampler = objects(samplers, count));
    fn glDeleteSamplers(count: i32, samplers: *const Sampler = objects(samplers, count));
    fn glBindSampler(unit: u32, sampler: Sampler);
    fn glSamplerParameteri(sampler: Sampler, name: Enum, value: i32 = texture_parameter(name, value));
    fn glSamplerParameterf(sampler: Sampler, name: Enum, value: f32);
    fn glSamplerParameterfv(sampler: Sampler, name: Enum, values: *const f32 = texture_floats(name, values));

    // Buffers and vertex arrays.
    fn glGenBuffers(count: i32, buffers: *mut Buffer = objects(buffers, count));
    fn glDeleteBuffers(count: i32, buffers: *const Buffer = objects(buffers, count));
    fn glBindBuffer(target: Enum, buffer: Buffer);
    fn glBindBufferBase(target: Enum, index: u32, buffer: Buffer);
    fn glBindBufferRange(target: Enum, index: u32, buffer: Buffer, offset: isize, size: isize);
    fn glIsBuffer(buffer: Buffer) -> Bool;
    fn glBufferData(target: Enum, size: isize, contents: *const c_void = data(contents, usize::try_from(size).ok()),
        usage: Enum);
    fn glBufferSubData(target: Enum, offset: isize, size: isize,
        contents: *const c_void = data(contents, usize::try_from(size).ok()));
    fn glCopyBufferSubData(from: Enum, to: Enum, from_offset: isize, to_offset: isize, size: isize);
    fn glGetBufferSubData(target: Enum, offset: isize, size: isize,
        contents: *mut c_void = data(contents, usize::try_from(size).ok()));
    fn glGetBufferParameteriv(target: Enum, name: Enum, values: *mut i32);
    fn glGenVertexArrays(count: i32, arrays: *mut VertexArray = objects(arrays, count));
    fn glDeleteVertexArrays(count: i32, arrays: *const VertexArray = objects(arrays, count));
    fn glBindVertexArray(array: VertexArray);
    fn glEnableVertexAttribArray(index: u32);
    fn glDisableVertexAttribArray(index: u32);
    fn glVertexAttribPointer(index: u32, size: i32, kind: Enum, normalized: Bool, stride: i32, offset: Offset);
    fn glVertexAttribIPointer(index: u32, size: i32, kind: Enum, stride: i32, offset: Offset);
    fn glVertexAttribDivisor(index: u32, divisor: u32);
    fn glVertexAttrib1f(index: u32, x: f32);
    fn glVertexAttrib2f(index: u32, x: f32, y: f32);
    fn glVertexAttrib3f(index: u32, x: f32, y: f32, z: f32);
    fn glVertexAttrib4f(index: u32, x: f32, y: f32, z: f32, w: f32);

    // Shaders and programs.
    fn glCreateShader(kind: Enum) -> Shader;
    fn glDeleteShader(shader: Shader);
    fn glIsShader(shader: Shader) -> Bool;
    fn glShaderSource(shader: Shader, count: i32, source: *const *const c_char = Arg::Place("&source"),
        length: *const i32 = Arg::Place("&length"));
    fn glCompileShader(shader: Shader);
    fn glGetShaderiv(shader: Shader, name: Enum, answer: *mut i32 = value(answer));
    fn glGetShaderInfoLog(shader: Shader, size: i32, length: *mut i32 = Arg::Place("&length"),
        log: *mut c_char = Arg::Place("info_log"));
    fn glCreateProgram() -> Program;
    fn glDeleteProgram(program: Program);
    fn glIsProgram(program: Program) -> Bool;
    fn glAttachShader(program: Program, shader: Shader);
    fn glDetachShader(program: Program, shader: Shader);
    fn glBindAttribLocation(program: Program, index: u32, name: Str);
    fn glBindFragDataLocation(program: Program, index: u32, name: Str);
    fn glLinkProgram(program: Program);
    fn glValidateProgram(program: Program);
    fn glGetProgramiv(program: Program, name: Enum, answer: *mut i32 = value(answer));
    fn glGetProgramInfoLog(program: Program, size: i32, length: *mut i32 = Arg::Place("&length"),
        log: *mut c_char = Arg::Place("info_log"));
    fn glUseProgram(program: Program);
    fn glGetAttribLocation(program: Program, name: Str) -> i32;
    fn glGetFragDataLocation(program: Program, name: Str) -> i32;
    fn glGetActiveAttrib(program: Program, index: u32, size: i32, length: *mut i32 = Arg::Place("&length"),
        count: *mut i32 = Arg::Place("&size"), kind: *mut u32 = Arg::Place("&type"),
        name: *mut c_char = Arg::Place("name"));

    // Uniforms.
    fn glGetUniformLocation(program: Program, name: Str) -> Location;
    fn glGetActiveUniform(program: Program, index: u32, size: i32, length: *mut i32 = Arg::Place("&length"),
        count: *mut i32 = Arg::Place("&size"), kind: *mut u32 = Arg::Place("&type"),
        name: *mut c_char = Arg::Place("name"));
    fn glGetUniformfv(program: Program, location: i32, values: *mut f32);
    fn glGetUniformiv(program: Program, location: i32, values: *mut i32);
    fn glGetUniformBlockIndex(program: Program, name: Str) -> u32;
    fn glUniformBlockBinding(program: Program, index: u32, binding: u32);
    fn glUniform1f(location: Location, x: f32);
    fn glUniform2f(location: Location, x: f32, y: f32);
    fn glUniform3f(location: Location, x: f32, y: f32, z: f32);
    fn glUniform4f(location: Location, x: f32, y: f32, z: f32, w: f32);
    fn glUniform1i(location: Location, x: i32);
    fn glUniform2i(location: Location, x: i32, y: i32);
    fn glUniform3i(location: Location, x: i32, y: i32, z: i32);
    fn glUniform4i(location: Location, x: i32, y: i32, z: i32, w: i32);
    fn glUniform1ui(location: Location, x: u32);
    fn glUniform2ui(location: Location, x: u32, y: u32);
    fn glUniform3ui(location: Location, x: u32, y: u32, z: u32);
    fn glUniform4ui(location: Location, x: u32, y: u32, z: u32, w: u32);
    fn glUniform1fv(location: Location, count: i32, values: *const f32 = floats(values, count, 1));
    fn glUniform2fv(location: Location, count: i32, values: *const f32 = floats(values, count, 2));
    fn glUniform3fv(location: Location, count: i32, values: *const f32 = floats(values, count, 3));
    fn glUniform4fv(location: Location, count: i32, values: *const f32 = floats(values, count, 4));
    fn glUniform1iv(location: Location, count: i32, values: *const i32 = ints(values, count, 1));
    fn glUniform2iv(location: Location, count: i32, values: *const i32 = ints(values, count, 2));
    fn glUniform3iv(location: Location, count: i32, values: *const i32 = ints(values, count, 3));
    fn glUniform4iv(location: Location, count: i32, values: *const i32 = ints(values, count, 4));
    fn glUniform1uiv(location: Location, count: i32, values: *const u32 = ints(values, count, 1));
    fn glUniform2uiv(location: Location, count: i32, values: *const u32 = ints(values, count, 2));
    fn glUniform3uiv(location: Location, count: i32, values: *const u32 = ints(values, count, 3));
    fn glUniform4uiv(location: Location, count: i32, values: *const u32 = ints(values, count, 4));
    fn glUniformMatrix2fv(location: Location, count: i32, transpose: Bool,
        values: *const f32 = floats(values, count, 4));
    fn glUniformMatrix3fv(location: Location, count: i32, transpose: Bool,
        values: *const f32 = floats(values, count, 9));
    fn glUniformMatrix4fv(location: Location, count: i32, transpose: Bool,
        values: *const f32 = floats(values, count, 16));

    // Queries.
    fn glGenQueries(count: i32, queries: *mut Query = objects(queries, count));
    fn glDeleteQueries(count: i32, queries: *const Query = objects(queries, count));
    fn glBeginQuery(target: Enum, query: Query);
    fn glEndQuery(target: Enum);
    fn glQueryCounter(query: Query, target: Enum);
    fn glGetQueryObjectiv(query: Query, name: Enum, answer: *mut i32);
    fn glGetQueryObjectuiv(query: Query, name: Enum, answer: *mut u32);
    fn glGetQueryObjecti64v(query: Query, name: Enum, answer: *mut i64);
    fn glGetQueryObjectui64v(query: Query, name: Enum, answer: *mut u64);
}
