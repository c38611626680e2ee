//! Framebuffer objects: what is attached, where is drawn to, and what they are told.

use std::rc::Rc;

use super::State;
use crate::calls::objects::{Attachment, Framebuffer, Id, Set, is_none};
use crate::calls::syntax::Call;

impl State {
    fn framebuffer(&mut self, id: &Id) -> &mut Framebuffer {
        let entry = self.framebuffers.entry(id.clone());
        Rc::make_mut(entry.or_default())
    }

    /// The framebuffer that a classic call works on.
    fn bound_framebuffer(&self, target: &str) -> Id {
        if target == "GL_READ_FRAMEBUFFER" {
            self.read_framebuffer.clone()
        } else {
            self.draw_framebuffer.value.clone()
        }
    }

    pub(super) fn framebuffer_call(&mut self, call: &Call) -> bool {
        let line = call.line;
        let name = call.name.as_str();
        let direct = name.contains("NamedFramebuffer")
            || name.starts_with("glFramebufferDrawBuffer")
            || name == "glFramebufferReadBuffer";
        let id = if direct {
            call.id(0)
        } else {
            self.bound_framebuffer(call.word(0))
        };
        match name {
            "glBindFramebuffer" => {
                let (target, id) = (call.word(0), call.id(1));
                if target != "GL_READ_FRAMEBUFFER" {
                    self.draw_framebuffer = Set::at(line, id.clone());
                }
                if target != "GL_DRAW_FRAMEBUFFER" {
                    self.read_framebuffer = id;
                }
            }
            "glFramebufferTexture"
            | "glNamedFramebufferTexture"
            | "glFramebufferTextureLayer"
            | "glNamedFramebufferTextureLayer" => self.attach_texture(&id, call, 2, line),
            "glFramebufferTexture2D" | "glNamedFramebufferTexture2D" => {
                self.attach_texture(&id, call, 3, line);
            }
            "glFramebufferRenderbuffer" | "glNamedFramebufferRenderbuffer" => {
                self.attach(
                    &id,
                    call.word(1),
                    Attachment::Renderbuffer(call.id(3)),
                    line,
                );
            }
            "glDrawBuffer"
            | "glDrawBuffers"
            | "glNamedFramebufferDrawBuffer"
            | "glNamedFramebufferDrawBuffers"
            | "glFramebufferDrawBuffer"
            | "glFramebufferDrawBuffers" => {
                let id = if direct {
                    id
                } else {
                    self.draw_framebuffer.value.clone()
                };
                let buffers = call.args.last().map_or(&[][..], |arg| arg.items());
                let chosen = buffers
                    .iter()
                    .take(16)
                    .map(|buffer| buffer.word().to_owned())
                    .collect();
                self.framebuffer(&id).draw_buffers = Some(Set::at(line, chosen));
            }
            "glReadBuffer" | "glNamedFramebufferReadBuffer" | "glFramebufferReadBuffer" => {
                let id = if direct {
                    id
                } else {
                    self.read_framebuffer.clone()
                };
                let none = is_none(call.args.last().map_or("", |arg| arg.word()));
                self.framebuffer(&id).read_buffer = Some(Set::at(line, none));
            }
            "glCheckFramebufferStatus" | "glCheckNamedFramebufferStatus" => {
                let status = call.result.as_ref().map_or("", |result| result.word());
                let status = Set::at(line, status.to_owned());
                // What is asked before anything is attached says nothing.
                let framebuffer = self.framebuffer(&id);
                if !framebuffer.attachments.is_empty() {
                    framebuffer.status = Some(status);
                }
            }
            "glBindRenderbuffer" => self.renderbuffer = call.id(1),
            "glRenderbufferStorage" => {
                let format = Set::at(line, call.word(1).to_owned());
                self.renderbuffers.insert(self.renderbuffer.clone(), format);
            }
            "glNamedRenderbufferStorage" => {
                let format = Set::at(line, call.word(1).to_owned());
                self.renderbuffers.insert(call.id(0), format);
            }
            "glRenderbufferStorageMultisample" => {
                let format = Set::at(line, call.word(2).to_owned());
                self.renderbuffers.insert(self.renderbuffer.clone(), format);
            }
            "glDeleteFramebuffers" => {
                for id in call.arg(1).items() {
                    self.framebuffers.remove(&id.id());
                }
            }
            "glDeleteRenderbuffers" => {
                for id in call.arg(1).items() {
                    self.renderbuffers.remove(&id.id());
                }
            }
            _ => return false,
        }
        true
    }

    /// `place` is that of the texture among the arguments.
    fn attach_texture(&mut self, id: &Id, call: &Call, place: usize, line: u64) {
        let rest = (2..call.args.len()).filter(|other| *other != place);
        let part: Vec<_> = rest.map(|place| call.id(place)).collect();
        let texture = Attachment::Texture {
            id: call.id(place),
            part: part.join(" "),
        };
        self.attach(id, call.word(1), texture, line);
    }

    fn attach(&mut self, id: &Id, point: &str, what: Attachment, line: u64) {
        let framebuffer = self.framebuffer(id);
        let nothing = matches!(
            &what,
            Attachment::Texture { id, .. } | Attachment::Renderbuffer(id) if id == "0"
        );
        let known = framebuffer
            .attachments
            .get(point)
            .is_some_and(|set| set.value == what);
        if nothing {
            framebuffer.attachments.remove(point);
        } else if !known && framebuffer.attachments.len() < 64 {
            framebuffer
                .attachments
                .insert(point.to_owned(), Set::at(line, what));
        }
    }
}
