//! What a program makes and sets, each with the line that did it.

use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use glam::DMat4;

use super::glsl::{Source, Uniform};

/// The name of an object: a number, or in `shadowlab trace` a variable. "0" is none.
pub type Id = String;

/// A value, and the line that set it; 0 is GL's own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Set<T> {
    pub value: T,
    pub line: u64,
}

impl<T> Set<T> {
    pub fn at(line: u64, value: T) -> Self {
        Self { value, line }
    }
}

#[derive(Clone, Debug)]
pub struct Texture {
    /// As glCreateTextures has it.
    pub target: Option<String>,
    /// Width, height and internal format of level 0.
    pub image: Option<Set<(i64, i64, String)>>,
    pub has_mipmaps: bool,
    /// By glTexStorage: a mipmap filter then takes the levels that there are.
    pub is_immutable: bool,
    /// By the name of the parameter.
    pub parameters: BTreeMap<String, Set<Parameter>>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Parameter {
    Word(String),
    Numbers(Vec<f64>),
}

impl Texture {
    pub fn new() -> Self {
        Self {
            target: None,
            image: None,
            has_mipmaps: false,
            is_immutable: false,
            parameters: BTreeMap::new(),
        }
    }

    pub fn holds_depth(&self) -> bool {
        let image = self.image.as_ref();
        image.is_some_and(|image| image.value.2.starts_with("GL_DEPTH"))
    }

    pub fn size(&self) -> Option<(i64, i64)> {
        let image = self.image.as_ref()?;
        Some((image.value.0, image.value.1))
    }

    /// A parameter's word, or what GL starts with.
    pub fn word(&self, parameter: &str) -> Set<String> {
        let start = match parameter {
            "GL_TEXTURE_MIN_FILTER" => "GL_NEAREST_MIPMAP_LINEAR",
            "GL_TEXTURE_MAG_FILTER" => "GL_LINEAR",
            "GL_TEXTURE_WRAP_S" | "GL_TEXTURE_WRAP_T" => "GL_REPEAT",
            _ => "GL_NONE",
        };
        match self.parameters.get(parameter) {
            Some(Set {
                value: Parameter::Word(word),
                line,
            }) => Set::at(*line, word.clone()),
            set => Set::at(set.map_or(0, |set| set.line), start.to_owned()),
        }
    }

    pub fn compares(&self) -> Set<bool> {
        let mode = self.word("GL_TEXTURE_COMPARE_MODE");
        let compares = matches!(
            mode.value.as_str(),
            "GL_COMPARE_REF_TO_TEXTURE" | "GL_COMPARE_R_TO_TEXTURE"
        );
        Set::at(mode.line, compares)
    }
}

#[derive(Clone, Debug, Default)]
pub struct Framebuffer {
    /// By the attachment point.
    pub attachments: BTreeMap<String, Set<Attachment>>,
    /// None: the first color buffer, as a framebuffer starts.
    pub draw_buffers: Option<Set<Vec<String>>>,
    /// Whether it is GL_NONE.
    pub read_buffer: Option<Set<bool>>,
    /// What glCheckFramebufferStatus said.
    pub status: Option<Set<String>>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Attachment {
    Texture {
        id: Id,
        /// Its face, level and layer, as the call has them.
        part: String,
    },
    Renderbuffer(Id),
}

impl Framebuffer {
    pub fn depth(&self) -> Option<&Set<Attachment>> {
        let points = ["GL_DEPTH_ATTACHMENT", "GL_DEPTH_STENCIL_ATTACHMENT"];
        points.iter().find_map(|point| self.attachments.get(*point))
    }

    pub fn depth_texture(&self) -> Option<&Id> {
        match &self.depth()?.value {
            Attachment::Texture { id, .. } => Some(id),
            Attachment::Renderbuffer(_) => None,
        }
    }

    /// Whether glDrawBuffer chose no color buffer.
    pub fn draws_no_color(&self) -> bool {
        let chosen = self.draw_buffers.as_ref();
        chosen.is_some_and(|set| set.value.iter().all(|buffer| is_none(buffer)))
    }

    /// The color buffers that are drawn to.
    pub fn drawn_to(&self) -> impl Iterator<Item = &Set<Attachment>> {
        let first = vec!["GL_COLOR_ATTACHMENT0".to_owned()];
        let chosen = self
            .draw_buffers
            .as_ref()
            .map_or(first, |set| set.value.clone());
        let attached = self.attachments.iter();
        attached
            .filter(move |(point, _)| chosen.contains(point))
            .map(|(_, attachment)| attachment)
    }

    pub fn color(&self) -> Option<&Set<Attachment>> {
        let mut points = self.attachments.iter();
        points
            .find(|(point, _)| point.starts_with("GL_COLOR_ATTACHMENT"))
            .map(|(_, attachment)| attachment)
    }

    pub fn holds(&self, texture: &Id) -> bool {
        let mut attached = self.attachments.values();
        attached.any(|at| matches!(&at.value, Attachment::Texture { id, .. } if id == texture))
    }
}

/// apitrace says GL_ZERO for GL_NONE.
pub fn is_none(buffer: &str) -> bool {
    matches!(buffer, "GL_NONE" | "GL_ZERO")
}

/// A linked program.
#[derive(Clone, Debug)]
pub struct Program {
    pub id: Id,
    /// Whether the sources of its shaders were in the dump.
    pub source: Option<Rc<Source>>,
    /// Names by the location that glGetUniformLocation gave.
    pub names: BTreeMap<i64, Set<String>>,
    /// Names that have no location, with the line that asked.
    pub missing: BTreeMap<String, u64>,
    /// What was set, by location.
    pub values: HashMap<i64, Set<Value>>,
}

#[derive(Clone, Debug)]
pub enum Value {
    Matrix(Box<DMat4>),
    Int(i64),
    Float(f64),
    Other,
}

/// A uniform that says from which unit a texture is read.
#[derive(Clone, Debug)]
pub struct Sampler {
    pub name: String,
    /// As GLSL names its type; not known without the source.
    pub kind: Option<String>,
    pub unit: Set<i64>,
}

impl Sampler {
    /// Whether it compares.
    pub fn is_shadow(&self) -> Option<bool> {
        self.kind.as_ref().map(|kind| kind.contains("Shadow"))
    }

    /// The target of the textures that it reads.
    pub fn target(&self) -> Option<&'static str> {
        let kind = self.kind.as_ref()?;
        let targets = [
            ("Cube", "GL_TEXTURE_CUBE_MAP"),
            ("2DArray", "GL_TEXTURE_2D_ARRAY"),
            ("Rect", "GL_TEXTURE_RECTANGLE"),
            ("2D", "GL_TEXTURE_2D"),
        ];
        targets
            .iter()
            .find(|(word, _)| kind.contains(word))
            .map(|(_, target)| *target)
    }
}

impl Program {
    pub fn new(id: Id) -> Self {
        Self {
            id,
            source: None,
            names: BTreeMap::new(),
            missing: BTreeMap::new(),
            values: HashMap::new(),
        }
    }

    pub fn declared(&self, name: &str) -> Option<&Uniform> {
        let name = name.split('[').next().unwrap_or(name);
        self.source.as_ref()?.uniforms.get(name)
    }

    /// The matrices that were set, by location.
    pub fn matrices(&self) -> Vec<Matrix> {
        let mut matrices: Vec<_> = self
            .values
            .iter()
            .filter_map(|(location, set)| match &set.value {
                Value::Matrix(matrix) => Some((*location, set.line, **matrix)),
                _ => None,
            })
            .collect();
        matrices.sort_by_key(|(location, ..)| *location);
        let name = |location: &i64| self.name_of(*location).unwrap_or_default().to_owned();
        matrices
            .iter()
            .map(|(location, line, value)| Matrix {
                name: name(location),
                value: *value,
                line: *line,
            })
            .collect()
    }

    pub fn name_of(&self, location: i64) -> Option<&str> {
        if let Some(name) = self.names.get(&location) {
            return Some(&name.value);
        }
        let mut declared = self.source.as_ref()?.uniforms.iter();
        let found = declared.find(|(_, uniform)| uniform.location == Some(location));
        found.map(|(name, _)| name.as_str())
    }

    pub fn samplers(&self) -> Vec<Sampler> {
        let mut samplers: Vec<Sampler> = Vec::new();
        for (location, name) in &self.names {
            let declared = self.declared(&name.value);
            let is_sampler = match (declared, &self.source) {
                (Some(uniform), _) => uniform.is_sampler(),
                (None, Some(_)) => false,
                // Without the source a name has to do.
                (None, None) => {
                    looks_like_sampler(&name.value)
                        && !matches!(
                            self.value(*location),
                            Some(Value::Matrix(_) | Value::Other | Value::Float(_))
                        )
                }
            };
            if !is_sampler {
                continue;
            }
            let start = Set::at(0, declared.map_or(0, |uniform| uniform.binding));
            let sampler = |name: String, unit: Set<i64>| Sampler {
                name,
                kind: declared.map(|uniform| uniform.kind.clone()),
                unit,
            };
            let unit = self.unit(*location).unwrap_or(start);
            samplers.push(sampler(name.value.clone(), unit));
            // The elements of an array that glUniform1iv set.
            for place in 1.. {
                let next = location + place;
                let Some(unit) = self.unit(next).filter(|_| !self.names.contains_key(&next)) else {
                    break;
                };
                let base = name.value.split('[').next().unwrap_or_default();
                samplers.push(sampler(format!("{base}[{place}]"), unit));
            }
        }
        // Those that nobody asked for.
        for (name, uniform) in self.source.iter().flat_map(|source| &source.uniforms) {
            let known = samplers
                .iter()
                .any(|sampler| sampler.name.split('[').next() == Some(name.as_str()));
            let is_missing = self.missing.contains_key(name);
            if uniform.is_sampler() && uniform.is_used && !known && !is_missing {
                let set = uniform.location.and_then(|location| self.unit(location));
                samplers.push(Sampler {
                    name: name.clone(),
                    kind: Some(uniform.kind.clone()),
                    unit: set.unwrap_or(Set::at(0, uniform.binding)),
                });
            }
        }
        samplers
    }

    fn value(&self, location: i64) -> Option<&Value> {
        self.values.get(&location).map(|set| &set.value)
    }

    fn unit(&self, location: i64) -> Option<Set<i64>> {
        let set = self.values.get(&location)?;
        match set.value {
            Value::Int(unit) => Some(Set::at(set.line, unit)),
            _ => None,
        }
    }
}

pub fn looks_like_sampler(name: &str) -> bool {
    let name = name.to_lowercase();
    let words = ["sampler", "texture", "map", "frame", "accumulated", "tex"];
    words.iter().any(|word| name.contains(word)) && !looks_like_matrix(&name)
}

pub fn looks_like_matrix(name: &str) -> bool {
    let name = name.to_lowercase();
    let words = ["matrix", "mvp", "projection", "modelview", "proj"];
    words.iter().any(|word| name.contains(word))
}

/// A matrix that a draw call works with, and its line.
#[derive(Clone, Debug)]
pub struct Matrix {
    /// Of the uniform; empty where nobody asked for it.
    pub name: String,
    pub value: DMat4,
    pub line: u64,
}

/// Objects of a kind by their names.
pub type Objects<T> = HashMap<Id, Rc<T>>;
