//! How much memory the driver was asked for, added up from the record.
//!
//! Counted are textures, buffers and renderbuffers that were given storage and have not been deleted. Not counted are the
//! window's own framebuffer, programs, and whatever the driver keeps beside what it was asked for.

use std::collections::{HashMap, HashSet};

use super::{Arg, Call, Event, ObjectKind};
use crate::{Error, Result};

/// What is there, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bytes {
    /// Textures and renderbuffers that a framebuffer draws into: the shadow maps.
    pub drawn_into: u64,
    pub textures: u64,
    pub buffers: u64,
}

impl Bytes {
    pub fn total(&self) -> u64 {
        self.drawn_into + self.textures + self.buffers
    }
}

/// An object's kind and number.
type Key = (ObjectKind, u32);

/// The storage of every object, as of the last event that was noted.
#[derive(Default)]
pub struct Memory {
    unit: u32,
    /// The object of a kind that a target names: the target, and for textures the unit.
    bound: HashMap<(ObjectKind, u32, u32), Key>,
    /// Of each object, its parts: a texture has one for each level of each face, everything else a single one.
    stored: HashMap<Key, HashMap<(u32, i64), u64>>,
    attached: HashSet<Key>,
}

impl Memory {
    /// Takes note of what happened next.
    pub fn note(&mut self, events: &[Event]) -> Result<()> {
        events.iter().try_for_each(|event| match event {
            Event::Call(call) => self.note_call(call),
            Event::Pass(_) => Ok(()),
        })
    }

    pub fn bytes(&self) -> Bytes {
        let mut bytes = Bytes::default();
        for (key, parts) in &self.stored {
            let size: u64 = parts.values().sum();
            match key {
                _ if self.attached.contains(key) => bytes.drawn_into += size,
                (ObjectKind::Buffer, _) => bytes.buffers += size,
                _ => bytes.textures += size,
            }
        }
        bytes
    }

    fn note_call(&mut self, call: &Call) -> Result<()> {
        match (call.name, call.args.as_slice()) {
            ("glActiveTexture", [Arg::Enum(_, unit)]) => self.unit = *unit,
            (
                "glBindTexture" | "glBindBuffer" | "glBindRenderbuffer",
                [Arg::Enum(_, target), Arg::Object(object)],
            ) => {
                let place = self.place(object.kind, *target);
                self.bound.insert(place, (object.kind, object.id));
            }
            (
                "glTexImage2D",
                [
                    Arg::Enum(_, target),
                    Arg::Int(level),
                    Arg::Enum(_, format),
                    Arg::Int(width),
                    Arg::Int(height),
                    ..,
                ],
            ) => {
                let size = texel_bytes(*format)? * (width * height) as u64;
                self.store(ObjectKind::Texture, *target, (*target, *level), size);
            }
            (
                "glRenderbufferStorage",
                [
                    Arg::Enum(_, target),
                    Arg::Enum(_, format),
                    Arg::Int(width),
                    Arg::Int(height),
                ],
            ) => {
                let size = texel_bytes(*format)? * (width * height) as u64;
                self.store(ObjectKind::Renderbuffer, *target, (0, 0), size);
            }
            ("glBufferData", [Arg::Enum(_, target), Arg::Int(size), ..]) => {
                self.store(ObjectKind::Buffer, *target, (0, 0), *size as u64);
            }
            (name, args)
                if name.starts_with("glFramebufferTexture")
                    || name == "glFramebufferRenderbuffer" =>
            {
                let objects = args.iter().filter_map(|arg| match arg {
                    Arg::Object(object) => Some((object.kind, object.id)),
                    _ => None,
                });
                self.attached.extend(objects);
            }
            (name, [_, Arg::Objects(objects)]) if name.starts_with("glDelete") => {
                for object in objects {
                    self.stored.remove(&(object.kind, object.id));
                    self.attached.remove(&(object.kind, object.id));
                }
            }
            // Better no figure than one that leaves something out.
            (
                "glTexImage1D"
                | "glTexImage3D"
                | "glTexImage2DMultisample"
                | "glCopyTexImage2D"
                | "glGenerateMipmap"
                | "glRenderbufferStorageMultisample",
                _,
            ) => {
                let expected = "expected glTexImage2D, glBufferData or glRenderbufferStorage";
                return Err(Error::gl(format!(
                    "the memory of {} is not counted: {expected}",
                    call.name
                )));
            }
            _ => {}
        }
        Ok(())
    }

    /// Each texture unit has bindings of its own. A buffer and a texture may be bound to targets of one name:
    /// GL_TEXTURE_BUFFER.
    fn place(&self, kind: ObjectKind, target: u32) -> (ObjectKind, u32, u32) {
        match (kind, target) {
            (
                ObjectKind::Texture,
                glow::TEXTURE_CUBE_MAP_POSITIVE_X..=glow::TEXTURE_CUBE_MAP_NEGATIVE_Z,
            ) => (kind, glow::TEXTURE_CUBE_MAP, self.unit),
            (ObjectKind::Texture, _) => (kind, target, self.unit),
            _ => (kind, target, 0),
        }
    }

    /// The object that the target names has this much storage in one of its parts.
    fn store(&mut self, kind: ObjectKind, target: u32, part: (u32, i64), size: u64) {
        if let Some(key) = self.bound.get(&self.place(kind, target)) {
            self.stored.entry(*key).or_default().insert(part, size);
        }
    }
}

/// What drivers store for a texel: three channels take the room of four. GL_DEPTH_COMPONENT leaves the choice to the
/// driver, and they choose four bytes.
fn texel_bytes(internal_format: u32) -> Result<u64> {
    Ok(match internal_format {
        glow::R8 | glow::RED => 1,
        glow::RG8 | glow::R16 | glow::R16F | glow::DEPTH_COMPONENT16 => 2,
        glow::RGB
        | glow::RGB8
        | glow::RGBA
        | glow::RGBA8
        | glow::SRGB8_ALPHA8
        | glow::RG16F
        | glow::R32F
        | glow::R32UI
        | glow::DEPTH_COMPONENT
        | glow::DEPTH_COMPONENT24
        | glow::DEPTH_COMPONENT32
        | glow::DEPTH_COMPONENT32F
        | glow::DEPTH24_STENCIL8 => 4,
        glow::RGB16F | glow::RGBA16F | glow::RG32F | glow::RG32UI | glow::DEPTH32F_STENCIL8 => 8,
        glow::RGB32F | glow::RGBA32F | glow::RGB32UI | glow::RGBA32UI => 16,
        other => {
            return Err(Error::gl(format!(
                "the memory of a texture of format {other:#06X} is not counted: expected one of GL 3.3's common ones"
            )));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Names, Object};
    use super::*;

    fn general(value: u32) -> Arg {
        Arg::Enum(Names::General, value)
    }

    fn call(name: &'static str, args: &[Arg]) -> Event {
        Event::Call(Call {
            name,
            args: args.to_vec(),
            result: None,
        })
    }

    fn bind(id: u32) -> Event {
        let texture = Arg::Object(Object::new(ObjectKind::Texture, id));
        call("glBindTexture", &[general(glow::TEXTURE_2D), texture])
    }

    fn image(level: i64, format: u32, [width, height]: [i64; 2]) -> Event {
        let target = general(glow::TEXTURE_2D);
        let size = [Arg::Int(width), Arg::Int(height)];
        let args = [&[target, Arg::Int(level), general(format)], &size[..]].concat();
        call("glTexImage2D", &args)
    }

    #[test]
    fn what_is_stored_is_counted_until_it_is_deleted() {
        let mut memory = Memory::default();
        let buffer = Arg::Object(Object::new(ObjectKind::Buffer, 1));
        let array = general(glow::ARRAY_BUFFER);
        let events = [
            bind(1),
            image(0, glow::RGB, [2, 2]),
            image(1, glow::RGB, [1, 1]),
            bind(2),
            image(0, glow::DEPTH_COMPONENT16, [8, 8]),
            // Once more, larger.
            image(0, glow::DEPTH_COMPONENT16, [16, 16]),
            call("glBindBuffer", &[array.clone(), buffer]),
            call("glBufferData", &[array, Arg::Int(100)]),
        ];
        memory.note(&events).unwrap();
        let map = Object::new(ObjectKind::Texture, 2);
        assert_eq!(memory.bytes().textures, 20 + 512);
        let attach = [
            general(0),
            general(0),
            Arg::Object(map.clone()),
            Arg::Int(0),
        ];
        memory
            .note(&[call("glFramebufferTexture", &attach)])
            .unwrap();
        let expected = Bytes {
            drawn_into: 512,
            textures: 20,
            buffers: 100,
        };
        assert_eq!(memory.bytes(), expected);
        let delete = [Arg::Int(1), Arg::Objects(vec![map])];
        memory.note(&[call("glDeleteTextures", &delete)]).unwrap();
        assert_eq!(memory.bytes().total(), 120);
    }

    /// A buffer texture's storage is its buffer's, whatever was bound last and wherever.
    #[test]
    fn a_buffer_texture_is_counted_as_its_buffer() {
        let mut memory = Memory::default();
        let target = || general(glow::TEXTURE_BUFFER);
        let object = |kind, id| Arg::Object(Object::new(kind, id));
        let events = [
            call("glBindBuffer", &[target(), object(ObjectKind::Buffer, 1)]),
            call("glActiveTexture", &[general(glow::TEXTURE0 + 3)]),
            call("glBindTexture", &[target(), object(ObjectKind::Texture, 1)]),
            call("glBufferData", &[target(), Arg::Int(64)]),
        ];
        memory.note(&events).unwrap();
        let buffers = 64;
        let expected = Bytes {
            buffers,
            ..Bytes::default()
        };
        assert_eq!(memory.bytes(), expected);
        // Given back.
        let events = [call("glBufferData", &[target(), Arg::Int(0)])];
        memory.note(&events).unwrap();
        assert_eq!(memory.bytes().total(), 0);
    }

    /// The control: what it cannot count, it says.
    #[test]
    fn what_cannot_be_counted_is_an_error() {
        for event in [
            image(0, 0xBEEF, [1, 1]),
            call("glGenerateMipmap", &[general(glow::TEXTURE_2D)]),
        ] {
            let error = Memory::default().note(&[event]).unwrap_err();
            assert!(error.to_string().contains("not counted"), "{error}");
        }
    }
}
