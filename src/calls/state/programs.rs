//! Shaders, programs, and what is set in them.

use std::rc::Rc;

use glam::DMat4;

use super::{MOST_SLIPS, Slip, SlipKind, State};
use crate::calls::glsl::Source;
use crate::calls::objects::{Id, Program, Set, Value, looks_like_matrix};
use crate::calls::syntax::Call;
use crate::error::did_you_mean;

/// So many names and values are remembered of a program.
const MOST_UNIFORMS: usize = 4096;

impl State {
    fn program_mut(&mut self, id: &Id) -> &mut Program {
        let entry = self.programs.entry(id.clone());
        Rc::make_mut(entry.or_insert_with(|| Rc::new(Program::new(id.clone()))))
    }

    pub(super) fn program_call(&mut self, call: &Call) -> bool {
        match call.name.as_str() {
            "glShaderSource" => {
                let texts = call.arg(2).items().iter();
                let text: String = texts.map(|text| text.word().to_owned() + "\n").collect();
                // `shadowlab trace` says "source" in its place.
                if text.trim() != "source" {
                    self.shaders.insert(call.id(0), Source::read(&text));
                }
            }
            "glAttachShader" => {
                let shaders = self.attached.entry(call.id(0)).or_default();
                if shaders.len() < 64 {
                    shaders.push(call.id(1));
                }
            }
            "glLinkProgram" => self.link(&call.id(0)),
            "glCreateShaderProgramv" => {
                let id = call
                    .result
                    .as_ref()
                    .map(|result| result.id())
                    .unwrap_or_default();
                let texts = call.arg(2).items().iter();
                let text: String = texts.map(|text| text.word().to_owned() + "\n").collect();
                self.program_mut(&id).source = Some(Rc::new(Source::read(&text)));
            }
            "glUseProgram" => self.program = Set::at(call.line, call.id(0)),
            "glDeleteProgram" if call.id(0) != self.program.value => {
                self.programs.remove(&call.id(0));
                self.attached.remove(&call.id(0));
            }
            "glGetUniformLocation" => self.located(call),
            name if name.starts_with("glProgramUniform") => {
                let (id, location) = (call.id(0), call.int(1));
                self.set(&id, location, call, 2, name.replacen("Program", "", 1));
            }
            name if name.starts_with("glUniform") && name != "glUniformBlockBinding" => {
                let (id, location) = (self.program.value.clone(), call.int(0));
                if id == "0" {
                    self.slip(call, SlipKind::NoProgram { location });
                } else {
                    self.set(&id, location, call, 1, name.to_owned());
                }
            }
            _ => return false,
        }
        true
    }

    fn link(&mut self, id: &Id) {
        let shaders = self.attached.get(id).cloned().unwrap_or_default();
        let sources: Option<Vec<_>> = shaders
            .iter()
            .map(|shader| self.shaders.get(shader))
            .collect();
        let source = sources
            .filter(|sources| !sources.is_empty())
            .map(|sources| {
                let mut all = Source::default();
                for source in sources {
                    all.join(source);
                }
                all
            });
        let program = self.program_mut(id);
        // What was set is gone.
        *program = Program::new(id.clone());
        program.source = source.map(Rc::new);
    }

    fn located(&mut self, call: &Call) {
        let (id, name) = (call.id(0), call.word(1).to_owned());
        let location = call.result.as_ref().map_or(-1, |result| result.int());
        let known = self.programs.get(&id).is_some_and(|program| {
            program
                .names
                .get(&location)
                .is_some_and(|known| known.value == name)
                || location == -1 && program.missing.contains_key(&name)
        });
        if known {
            return;
        }
        let program = self.program_mut(&id);
        if program.names.len() + program.missing.len() >= MOST_UNIFORMS {
            return;
        }
        if location == -1 {
            program.missing.insert(name, call.line);
        } else {
            program.names.insert(location, Set::at(call.line, name));
        }
    }

    /// A value that goes to a location of a program; `place` is that of the first value among the arguments.
    fn set(&mut self, id: &Id, location: i64, call: &Call, place: usize, function: String) {
        if location == -1 {
            let names = self.missing_names(id);
            if !names.is_empty() {
                self.slip(
                    call,
                    SlipKind::Nowhere {
                        program: id.clone(),
                        names,
                    },
                );
            }
            return;
        }
        if let Some(kind) = self.wrong_place(id, location, &function) {
            self.slip(call, kind);
            return;
        }
        let is_matrix = function.contains("Matrix4");
        let value = if is_matrix {
            let numbers = call.arg(place + 2).numbers();
            match numbers.first_chunk::<16>() {
                Some(columns) => {
                    let matrix = DMat4::from_cols_array(columns);
                    let transposed = call.is_true(place + 1);
                    Value::Matrix(Box::new(if transposed {
                        matrix.transpose()
                    } else {
                        matrix
                    }))
                }
                None => Value::Other,
            }
        } else {
            match function.trim_start_matches("glUniform") {
                "1i" => Value::Int(call.int(place)),
                "1iv" => Value::Int(call.arg(place + 1).items().first().map_or(0, |n| n.int())),
                "1f" => Value::Float(call.number(place)),
                "1fv" => Value::Float(
                    call.arg(place + 1)
                        .items()
                        .first()
                        .map_or(0.0, |n| n.number()),
                ),
                _ => Value::Other,
            }
        };
        let line = call.line;
        let program = self.program_mut(id);
        if program.values.len() < MOST_UNIFORMS {
            program.values.insert(location, Set::at(line, value));
            // `maps[0]`, and those behind it.
            if function.ends_with("1iv") {
                for (more, unit) in call.arg(place + 1).items().iter().enumerate().take(32) {
                    let unit = Value::Int(unit.int());
                    program
                        .values
                        .insert(location + more as i64, Set::at(line, unit));
                }
            }
        }
    }

    /// The names that were asked for and that no source declares, each with the nearest one that there is.
    fn missing_names(&self, id: &Id) -> Vec<String> {
        let Some(program) = self.programs.get(id) else {
            return Vec::new();
        };
        let known: Vec<&str> = match &program.source {
            Some(source) => source.uniforms.keys().map(String::as_str).collect(),
            None => program
                .names
                .values()
                .map(|name| name.value.as_str())
                .collect(),
        };
        // What is declared and not used has no location either: that is no slip.
        let missing = program
            .missing
            .keys()
            .filter(|name| program.declared(name).is_none());
        missing
            .take(8)
            .map(|name| format!("\"{name}\"{}", did_you_mean(name, known.iter().copied())))
            .collect()
    }

    /// Why a value cannot be meant for this place, where that is certain.
    fn wrong_place(&self, id: &Id, location: i64, function: &str) -> Option<SlipKind> {
        let program = self.programs.get(id)?;
        if let Some(name) = program.name_of(location) {
            let kind = &program.declared(name)?.kind;
            let fits = match function.trim_start_matches("glUniform") {
                call if call.starts_with("Matrix") => kind.starts_with("mat"),
                call if call.starts_with("1i") => {
                    !kind.starts_with("mat") && !kind.starts_with("vec") && kind != "float"
                }
                call if call.starts_with("1f") => kind == "float" || kind == "bool",
                call if call.starts_with(['2', '3', '4']) => kind.contains("vec"),
                _ => true,
            };
            return (!fits).then(|| SlipKind::OtherType {
                name: name.to_owned(),
                kind: kind.clone(),
                call: function.to_owned(),
            });
        }
        // Nobody asked this program for the location, and another one was asked.
        let mut others = self.programs.values();
        let meant = others.find(|other| {
            other.id != *id
                && other.names.get(&location).is_some_and(|name| {
                    !function.contains("Matrix4")
                        || looks_like_matrix(&name.value)
                        || other
                            .declared(&name.value)
                            .is_some_and(|uniform| uniform.kind == "mat4")
                })
        })?;
        Some(SlipKind::OtherProgram {
            used: id.clone(),
            meant: meant.id.clone(),
            name: meant.names[&location].value.clone(),
        })
    }

    fn slip(&mut self, call: &Call, kind: SlipKind) {
        let known = self.slips.iter().any(|slip| slip.kind == kind);
        if !known && self.slips.len() < MOST_SLIPS {
            self.slips.push(Slip {
                line: call.line,
                kind,
            });
        }
    }
}
