//! What OpenGL's state is after each call, as far as a shadow depends on it, with the line that set it.
//!
//! Classic calls, those of extensions (see [`super::syntax`]) and those of direct state access lead to the same state.
//! One context is followed: a program that draws with several makes one stream of them.

mod fixed;
mod framebuffers;
mod programs;
mod textures;

use std::collections::{BTreeMap, HashMap};

use super::objects::{Framebuffer, Id, Objects, Program, Set, Texture};
use super::syntax::Call;
use fixed::Matrices;

/// So many objects a program may have at a time; a hostile dump has more.
const MOST_OBJECTS: usize = 1 << 20;

#[derive(Default)]
pub struct State {
    pub textures: Objects<Texture>,
    /// Sampler objects have a texture's parameters.
    samplers: Objects<Texture>,
    pub framebuffers: Objects<Framebuffer>,
    /// Formats.
    pub renderbuffers: HashMap<Id, Set<String>>,
    shaders: HashMap<Id, super::glsl::Source>,
    attached: HashMap<Id, Vec<Id>>,
    pub programs: Objects<Program>,

    pub draw_framebuffer: Set<Id>,
    read_framebuffer: Id,
    renderbuffer: Id,
    pub program: Set<Id>,
    unit: i64,
    /// By unit and target.
    bound: BTreeMap<(i64, String), Set<Id>>,
    bound_samplers: BTreeMap<i64, Id>,
    pub pipeline: Pipeline,
    saved: Vec<Pipeline>,
    pub matrices: Matrices,
    /// What tells one mesh from another: the vertex array, or the buffers and pointers of the time before.
    vertex_array: Id,
    pointers: BTreeMap<&'static str, String>,
    /// While a display list is compiled.
    list: bool,
    /// The vertices between glBegin and glEnd, as a number that tells them from others.
    vertices: u64,

    /// The window, as the dump says it.
    pub window: Option<(i64, i64)>,
    pub is_core: bool,
    /// Uniforms that went wrong.
    pub slips: Vec<Slip>,
}

/// What glPushAttrib saves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pipeline {
    pub viewport: Set<[i64; 4]>,
    /// What glEnable and glDisable set.
    pub enabled: BTreeMap<String, Set<bool>>,
    pub depth_mask_off: Set<bool>,
    /// 1 minus it, so that the default is 0.
    pub clear_nearer: Set<f64>,
    pub cull_face: Set<String>,
    pub polygon_offset: Set<[f64; 2]>,
    /// Function, reference.
    pub stencil: Set<(String, i64)>,
    /// What happens where both tests pass.
    pub stencil_pass: Set<String>,
    pub blend: Set<[String; 2]>,
    pub blend_alpha: Set<f64>,
}

impl Pipeline {
    pub fn is_on(&self, what: &str) -> bool {
        self.enabled.get(what).is_some_and(|set| set.value)
    }

    pub fn line_of(&self, what: &str) -> u64 {
        self.enabled.get(what).map_or(0, |set| set.line)
    }
}

/// A uniform that did not go where it should.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    pub line: u64,
    pub kind: SlipKind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SlipKind {
    /// glUniform at location −1, and the names that the program does not have, each with the nearest right one.
    Nowhere { program: Id, names: Vec<String> },
    /// glUniform with no program in use.
    NoProgram { location: i64 },
    /// The location is another program's.
    OtherProgram { used: Id, meant: Id, name: String },
    /// Its type is not the uniform's.
    OtherType {
        name: String,
        kind: String,
        call: String,
    },
}

/// So many slips are told; a loop makes thousands of one.
const MOST_SLIPS: usize = 64;

/// What a call was, besides a change of state.
pub enum Event {
    Nothing,
    /// A mesh was drawn.
    Draw(String),
    Clear(Cleared),
    /// The accumulation buffer of old: glAccum's operation and its value.
    Accumulate(String, f64),
    /// A copy from one framebuffer to another.
    Blit {
        from: Id,
        to: Id,
    },
    Swap,
}

pub struct Cleared {
    pub framebuffer: Id,
    pub color: bool,
    pub depth: bool,
    pub stencil: bool,
    pub accumulation: bool,
}

impl State {
    pub fn new() -> Self {
        let none = || Set::at(0, "0".to_owned());
        Self {
            draw_framebuffer: none(),
            read_framebuffer: "0".to_owned(),
            program: none(),
            vertex_array: "0".to_owned(),
            pipeline: Pipeline {
                cull_face: Set::at(0, "GL_BACK".to_owned()),
                stencil: Set::at(0, ("GL_ALWAYS".to_owned(), 0)),
                stencil_pass: Set::at(0, "GL_KEEP".to_owned()),
                blend: Set::at(0, ["GL_ONE", "GL_ZERO"].map(str::to_owned)),
                ..Pipeline::default()
            },
            ..Self::default()
        }
    }

    /// More objects than a program has.
    pub fn is_overfull(&self) -> bool {
        let objects = self.textures.len() + self.framebuffers.len() + self.programs.len();
        objects + self.renderbuffers.len() + self.shaders.len() + self.bound.len() > MOST_OBJECTS
    }

    pub fn apply(&mut self, call: &Call) -> Event {
        if let Some(event) = self.window_call(call) {
            return event;
        }
        if !call.name.starts_with("gl") {
            return Event::Nothing;
        }
        match call.name.as_str() {
            "glNewList" => self.list = call.word(1) == "GL_COMPILE",
            "glEndList" => self.list = false,
            _ if self.list => return Event::Nothing,
            _ => {}
        }
        let event = self.draw(call);
        if !matches!(event, Event::Nothing) {
            return event;
        }
        let _ = self.pipeline_call(call)
            || self.texture_call(call)
            || self.framebuffer_call(call)
            || self.program_call(call)
            || self.matrices.apply(call, self.unit)
            || self.mesh_call(call);
        Event::Nothing
    }

    /// Calls to the window system.
    fn window_call(&mut self, call: &Call) -> Option<Event> {
        match call.name.as_str() {
            "glXSwapBuffers"
            | "eglSwapBuffers"
            | "wglSwapBuffers"
            | "SwapBuffers"
            | "CGLFlushDrawable"
            | "glFrameTerminatorGREMEDY"
            | "eglSwapBuffersWithDamageKHR" => Some(Event::Swap),
            "glXCreateContextAttribs" | "eglCreateContext" | "wglCreateContextAttribs" => {
                let text = format!("{:?}", call.args);
                self.is_core = text.contains("CORE_PROFILE_BIT");
                Some(Event::Nothing)
            }
            // apitrace says by a call of its own what a window's viewport is.
            "glViewport" if call.fake => {
                self.window = Some((call.int(2), call.int(3)));
                None
            }
            _ => None,
        }
    }

    fn draw(&mut self, call: &Call) -> Event {
        let name = call.name.as_str();
        match name {
            "glClear" => {
                let mask = call.word(0);
                let bits = |name: &str| mask.split('|').any(|bit| bit.trim() == name);
                return Event::Clear(Cleared {
                    framebuffer: self.draw_framebuffer.value.clone(),
                    color: bits("GL_COLOR_BUFFER_BIT"),
                    depth: bits("GL_DEPTH_BUFFER_BIT"),
                    stencil: bits("GL_STENCIL_BUFFER_BIT"),
                    accumulation: bits("GL_ACCUM_BUFFER_BIT"),
                });
            }
            "glClearBufferfv" | "glClearBufferfi" | "glClearBufferiv" | "glClearBufferuiv" => {
                return Event::Clear(self.cleared_buffer(
                    self.draw_framebuffer.value.clone(),
                    call,
                    0,
                ));
            }
            "glClearNamedFramebufferfv"
            | "glClearNamedFramebufferfi"
            | "glClearNamedFramebufferiv"
            | "glClearNamedFramebufferuiv" => {
                return Event::Clear(self.cleared_buffer(call.id(0), call, 1));
            }
            "glAccum" => return Event::Accumulate(call.word(0).to_owned(), call.number(1)),
            "glBlitFramebuffer" => {
                return Event::Blit {
                    from: self.read_framebuffer.clone(),
                    to: self.draw_framebuffer.value.clone(),
                };
            }
            "glBlitNamedFramebuffer" => {
                return Event::Blit {
                    from: call.id(0),
                    to: call.id(1),
                };
            }
            "glBegin" => self.vertices = hash(0, call),
            _ if name.starts_with("glVertex")
                && !name.contains("Pointer")
                && !name.contains("Attrib")
                && !name.contains("Array") =>
            {
                self.vertices = hash(self.vertices, call);
            }
            "glEnd" => return Event::Draw(format!("glBegin {:x}", self.vertices)),
            "glCallList" | "glCallLists" => return Event::Draw(format!("list {:?}", call.args)),
            "glDrawPixels" | "glDrawBuffer" | "glDrawBuffers" => {}
            _ if name.starts_with("glDraw") || name.starts_with("glMultiDraw") => {
                let mesh = if self.vertex_array == "0" {
                    format!("{:?}", self.pointers)
                } else {
                    self.vertex_array.clone()
                };
                let args: Vec<_> = call.args.iter().map(|arg| arg.id()).collect();
                return Event::Draw(format!("{mesh} {}", args.join(" ")));
            }
            _ => {}
        }
        Event::Nothing
    }

    fn cleared_buffer(&self, framebuffer: Id, call: &Call, place: usize) -> Cleared {
        let buffer = call.word(place);
        Cleared {
            framebuffer,
            color: buffer == "GL_COLOR",
            depth: buffer.starts_with("GL_DEPTH"),
            stencil: buffer.ends_with("STENCIL"),
            accumulation: false,
        }
    }

    fn pipeline_call(&mut self, call: &Call) -> bool {
        let line = call.line;
        let set = &mut self.pipeline;
        match call.name.as_str() {
            "glViewport" => set.viewport = Set::at(line, [0, 1, 2, 3].map(|place| call.int(place))),
            "glViewportIndexedf" | "glViewportArrayv" => {
                let numbers: Vec<f64> = call.args.iter().flat_map(|arg| arg.numbers()).collect();
                if let Some(last) = numbers.last_chunk::<4>() {
                    set.viewport = Set::at(line, last.map(|number| number as i64));
                }
            }
            "glEnable" | "glDisable" => {
                let on = call.name == "glEnable";
                if set.enabled.len() < MOST_OBJECTS {
                    set.enabled
                        .insert(call.word(0).to_owned(), Set::at(line, on));
                }
            }
            "glDepthMask" => set.depth_mask_off = Set::at(line, !call.is_true(0)),
            "glClearDepth" | "glClearDepthf" => {
                set.clear_nearer = Set::at(line, 1.0 - call.number(0))
            }
            "glCullFace" => set.cull_face = Set::at(line, call.word(0).to_owned()),
            "glPolygonOffset" => {
                set.polygon_offset = Set::at(line, [call.number(0), call.number(1)])
            }
            "glStencilFunc" => set.stencil = Set::at(line, (call.word(0).to_owned(), call.int(1))),
            "glStencilFuncSeparate" => {
                set.stencil = Set::at(line, (call.word(1).to_owned(), call.int(2)));
            }
            "glStencilOp" => set.stencil_pass = Set::at(line, call.word(2).to_owned()),
            "glStencilOpSeparate" => set.stencil_pass = Set::at(line, call.word(3).to_owned()),
            "glBlendFunc" => {
                set.blend = Set::at(line, [call.word(0).to_owned(), call.word(1).to_owned()]);
            }
            "glBlendFuncSeparate" => {
                set.blend = Set::at(line, [call.word(0).to_owned(), call.word(1).to_owned()]);
            }
            "glBlendColor" => set.blend_alpha = Set::at(line, call.number(3)),
            "glPushAttrib" if self.saved.len() < 64 => self.saved.push(set.clone()),
            // What was saved of it is not looked at: programs save what they change.
            "glPopAttrib" => {
                if let Some(saved) = self.saved.pop() {
                    *set = saved;
                }
            }
            _ => return false,
        }
        true
    }

    fn mesh_call(&mut self, call: &Call) -> bool {
        let pointer = |name: &'static str, state: &mut Self| {
            let args: Vec<_> = call.args.iter().map(|arg| arg.id()).collect();
            state.pointers.insert(name, args.join(" "));
        };
        match call.name.as_str() {
            "glBindVertexArray" => self.vertex_array = call.id(0),
            "glVertexPointer" => pointer("vertices", self),
            "glVertexAttribPointer" if call.int(0) == 0 => pointer("attribute 0", self),
            "glBindBuffer" if call.word(0) == "GL_ARRAY_BUFFER" => pointer("buffer", self),
            "glBindBuffer" if call.word(0) == "GL_ELEMENT_ARRAY_BUFFER" => pointer("indices", self),
            _ => return false,
        }
        true
    }
}

/// A number that two vertices or more share with no others, all but certainly.
fn hash(before: u64, call: &Call) -> u64 {
    let numbers = call.args.iter().flat_map(|arg| arg.numbers());
    let words = call.word(0).bytes().map(u64::from);
    numbers
        .map(f64::to_bits)
        .chain(words)
        .fold(before, |hash, bits| {
            (hash ^ bits)
                .wrapping_mul(0x9e37_79b9_7f4a_7c15)
                .rotate_left(23)
        })
}
