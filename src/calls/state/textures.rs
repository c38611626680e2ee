//! Textures, sampler objects, and which unit has which.

use std::rc::Rc;

use super::State;
use crate::calls::objects::{Id, Parameter, Set, Texture};
use crate::calls::syntax::{Call, Value};

/// So many units a driver has, or twice as many.
const MOST_UNITS: usize = 64;

impl State {
    /// What a sampler at this unit reads: its texture, with the parameters that hold. Of several textures at a unit it
    /// is the one of the sampler's target.
    pub fn texture_at(&self, unit: i64, target: Option<&str>) -> Option<(Set<Id>, Rc<Texture>)> {
        let mut at_unit = self.bound.iter().filter(|((at, bound), set)| {
            *at == unit && set.value != "0" && target.is_none_or(|target| target == bound)
        });
        let (_, bound) = at_unit.next()?;
        let texture = self.textures.get(&bound.value)?;
        match self
            .bound_samplers
            .get(&unit)
            .and_then(|id| self.samplers.get(id))
        {
            Some(sampler) => {
                let mut seen = Texture::clone(texture);
                for (name, set) in &sampler.parameters {
                    seen.parameters.insert(name.clone(), set.clone());
                }
                // A sampler object has its own start, whatever the texture says.
                for name in [
                    "GL_TEXTURE_MIN_FILTER",
                    "GL_TEXTURE_WRAP_S",
                    "GL_TEXTURE_WRAP_T",
                    "GL_TEXTURE_COMPARE_MODE",
                ] {
                    if !sampler.parameters.contains_key(name) {
                        seen.parameters.remove(name);
                    }
                }
                Some((bound.clone(), Rc::new(seen)))
            }
            None => Some((bound.clone(), texture.clone())),
        }
    }

    pub fn has_sampler_objects(&self) -> bool {
        !self.samplers.is_empty()
    }

    /// The line that last bound something to the unit.
    pub fn bound_at(&self, unit: i64) -> u64 {
        let of_unit = self.bound.iter().filter(|((at, _), _)| *at == unit);
        of_unit.map(|(_, set)| set.line).max().unwrap_or(0)
    }

    /// The textures that are bound, by unit.
    pub fn units(&self) -> Vec<(i64, Set<Id>)> {
        let bound = self.bound.iter().filter(|(_, set)| set.value != "0");
        bound
            .map(|((unit, _), set)| (*unit, set.clone()))
            .take(MOST_UNITS)
            .collect()
    }

    fn texture(&mut self, id: &Id) -> &mut Texture {
        let entry = self.textures.entry(id.clone());
        Rc::make_mut(entry.or_insert_with(|| Rc::new(Texture::new())))
    }

    /// The texture that a classic call works on.
    fn bound_texture(&self, target: &str) -> Id {
        let target = if target.starts_with("GL_TEXTURE_CUBE_MAP") {
            "GL_TEXTURE_CUBE_MAP"
        } else {
            target
        };
        let bound = self.bound.get(&(self.unit, target.to_owned()));
        bound.map_or_else(|| "0".to_owned(), |set| set.value.clone())
    }

    fn bind(&mut self, unit: i64, target: &str, id: Id, line: u64) {
        if id != "0" {
            let texture = self.texture(&id);
            if target == "GL_TEXTURE_RECTANGLE" && texture.image.is_none() {
                // It has no mipmaps, and wants none.
                texture.is_immutable = true;
            }
        }
        self.bound
            .insert((unit, target.to_owned()), Set::at(line, id));
    }

    /// Binds a texture to the target that it was made for; none unbinds them all.
    fn bind_unit(&mut self, unit: i64, id: Id, line: u64) {
        if id == "0" {
            self.bound.retain(|(at, _), _| *at != unit);
        }
        let target = self
            .textures
            .get(&id)
            .and_then(|texture| texture.target.clone());
        let target = target.unwrap_or_else(|| "GL_TEXTURE_2D".to_owned());
        self.bind(unit, &target, id, line);
    }

    pub(super) fn texture_call(&mut self, call: &Call) -> bool {
        let line = call.line;
        // The direct calls name the texture where the classic ones name the target.
        let name = call.name.as_str();
        let direct = name.starts_with("glTexture") || name.starts_with("glGenerateTexture");
        let (id, classic) = if direct {
            (call.id(0), name.replacen("Texture", "Tex", 1))
        } else if name.starts_with("glTex")
            || name == "glGenerateMipmap"
            || name.starts_with("glCopyTexImage")
        {
            (self.bound_texture(call.word(0)), name.to_owned())
        } else {
            ("0".to_owned(), name.to_owned())
        };
        match classic.as_str() {
            "glActiveTexture" => self.unit = unit(call.arg(0)),
            "glBindTexture" => self.bind(self.unit, call.word(0), call.id(1), line),
            "glBindTextureUnit" => self.bind_unit(call.int(0), call.id(1), line),
            "glCreateTextures" => {
                for id in call.arg(2).items() {
                    self.texture(&id.id()).target = Some(call.word(0).to_owned());
                }
            }
            "glBindTextures" => {
                for (place, id) in call.arg(2).items().iter().enumerate().take(256) {
                    self.bind_unit(call.int(0) + place as i64, id.id(), line);
                }
            }
            "glBindMultiTexture" => self.bind(unit(call.arg(0)), call.word(1), call.id(2), line),
            "glBindSampler" => {
                self.bound_samplers.insert(call.int(0), call.id(1));
            }
            "glSamplerParameteri" | "glSamplerParameterf" => {
                let entry = self.samplers.entry(call.id(0));
                let sampler = Rc::make_mut(entry.or_insert_with(|| Rc::new(Texture::new())));
                set_parameter(sampler, call);
            }
            "glTexImage2D" | "glCopyTexImage2D" if call.int(1) == 0 => {
                let [width, height] = if name == "glCopyTexImage2D" {
                    [5, 6]
                } else {
                    [3, 4]
                };
                let image = (call.int(width), call.int(height), call.word(2).to_owned());
                self.texture(&id).image = Some(Set::at(line, image));
            }
            "glTexImage2D" | "glGenerateMipmap" | "glGenerateTexMipmap" => {
                self.texture(&id).has_mipmaps = true;
            }
            "glTexImage3D" if call.int(1) == 0 => {
                let image = (call.int(3), call.int(4), call.word(2).to_owned());
                self.texture(&id).image = Some(Set::at(line, image));
            }
            "glTexStorage2D" | "glTexStorage3D" => {
                let image = (call.int(3), call.int(4), call.word(2).to_owned());
                let texture = self.texture(&id);
                texture.image = Some(Set::at(line, image));
                texture.is_immutable = true;
            }
            _ if classic.starts_with("glTexParameter") => set_parameter(self.texture(&id), call),
            "glDeleteTextures" => {
                for id in call.arg(1).items() {
                    let id = id.id();
                    self.textures.remove(&id);
                    self.bound.retain(|_, set| set.value != id);
                }
            }
            _ => return false,
        }
        true
    }
}

/// GL_TEXTURE1, or what an old program adds up.
fn unit(value: &Value) -> i64 {
    let word = value.word();
    word.strip_prefix("GL_TEXTURE")
        .and_then(|digits| digits.parse().ok())
        .unwrap_or(0)
}

fn set_parameter(texture: &mut Texture, call: &Call) {
    let value = match call.arg(2) {
        Value::Word(word) => Parameter::Word(word.clone()),
        Value::List(list) if list.len() == 1 && list[0].number() == 0.0 => {
            Parameter::Word(list[0].word().to_owned())
        }
        Value::List(list) => Parameter::Numbers(list.iter().map(component).collect()),
        Value::Number(0.0) => Parameter::Word("GL_NONE".to_owned()),
        value => Parameter::Numbers(vec![value.number()]),
    };
    let parameter = match call.word(1) {
        // Four at once are the same as all four.
        "GL_TEXTURE_SWIZZLE_RGBA" => "GL_TEXTURE_SWIZZLE",
        name if name.starts_with("GL_TEXTURE_SWIZZLE") => "GL_TEXTURE_SWIZZLE",
        name => name,
    };
    // There are some twenty parameters.
    if texture.parameters.len() < 64 {
        texture
            .parameters
            .insert(parameter.to_owned(), Set::at(call.line, value));
    }
}

/// A number, also of what GL has a word for.
fn component(value: &Value) -> f64 {
    match value.word() {
        "GL_RED" => 6403.0,
        _ => value.number(),
    }
}
