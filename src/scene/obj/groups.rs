//! The faces with one name and one material: a part, in the order in which these came.

use std::collections::HashMap;
use std::path::Path;

use super::lines::Checked;
use super::{Part, mtl};
use crate::Error;
use crate::error::{did_you_mean, quoted};
use crate::scene::reading::Files;
use crate::scene::{Material, Mesh};

/// With more parts than this, faces belong together by material alone: some programs name every single face.
const MOST_NAMED_PARTS: usize = 4095;

#[derive(Default)]
pub struct Groups {
    /// Each name of an object or group, and each of a material with the line that used it first, if it has faces.
    names: Vec<String>,
    materials: Vec<Used>,
    material_numbers: HashMap<String, usize>,
    /// What the next face belongs to, and names that have no number yet because they have no face.
    current: Key,
    new_name: Option<String>,
    new_material: Option<Used>,
    groups: Vec<(Key, String)>,
    numbers: HashMap<Key, usize>,
}

/// A name and a material, by number.
type Key = (Option<usize>, Option<usize>);

struct Used {
    name: String,
    line: usize,
}

impl Groups {
    pub fn start(&mut self, name: &str) {
        self.new_name = Some(name.to_owned());
    }

    pub fn use_material(&mut self, line: usize, name: &str) {
        let name = name.to_owned();
        self.new_material = Some(Used { name, line });
    }

    /// Where the next face goes.
    pub fn faces(&mut self) -> Checked<&mut String> {
        self.number_names()?;
        let count = self.groups.len();
        let mut key = self.current;
        if count >= MOST_NAMED_PARTS && !self.numbers.contains_key(&key) {
            key.0 = None;
        }
        let number = *self.numbers.entry(key).or_insert(count);
        if number == count {
            self.groups.push((key, String::new()));
        }
        Ok(&mut self.groups[number].1)
    }

    /// Numbers for the names that the face at hand is the first to belong to.
    fn number_names(&mut self) -> Checked<()> {
        if let Some(name) = self.new_name.take() {
            let room = self.names.len() < MOST_NAMED_PARTS;
            self.current.0 = room.then_some(self.names.len());
            self.names.extend(room.then_some(name));
        }
        if let Some(used) = self.new_material.take() {
            let count = self.materials.len();
            let known = self.material_numbers.get(&used.name).copied();
            self.current.1 = Some(known.unwrap_or(count));
            if known.is_none() {
                mtl::check_count(count)?;
                self.material_numbers.insert(used.name.clone(), count);
                self.materials.push(used);
            }
        }
        Ok(())
    }

    /// The parts, still without their meshes, and the faces of each as tobj reads them.
    pub fn parts(
        self,
        library: &mtl::Library,
        path: &Path,
        files: &Files,
    ) -> (Vec<Part>, Vec<String>) {
        let materials = self.resolved_materials(library, path, files);
        let name_of = |number: usize| self.names[number].clone();
        let mut numbers = HashMap::new();
        let mut parts: Vec<Part> = Vec::new();
        let mut texts: Vec<String> = Vec::new();
        for ((name, used), faces) in self.groups {
            // What is not there is no material of its own.
            let used = used.filter(|number| materials[*number].is_some());
            let part = *numbers.entry((name, used)).or_insert(parts.len());
            if part < parts.len() {
                texts[part].push_str(&faces);
                continue;
            }
            texts.push(faces);
            parts.push(Part {
                name: name.map_or("object".to_owned(), name_of),
                mesh: Mesh::default(),
                material: used.and_then(|number| materials[number].cloned()),
            });
        }
        (parts, texts)
    }

    /// The materials that faces use, by number; a note for each that there is not.
    fn resolved_materials<'a>(
        &self,
        library: &'a mtl::Library,
        path: &Path,
        files: &Files,
    ) -> Vec<Option<&'a Material>> {
        let resolve = |used: &Used| {
            let found = library.materials.get(&used.name);
            if found.is_none() && files.takes_notes() {
                let names = library.materials.keys().map(String::as_str);
                let hint = did_you_mean(&used.name, names);
                let name = quoted(&used.name);
                let message = format!("found no material {name}{hint}, drawn with the default");
                files.note(&Error::input(path, used.line, message));
            }
            found
        };
        self.materials.iter().map(resolve).collect()
    }
}
