//! OBJ text in which equal positions, texture coordinates and normals are written once.

use std::collections::HashMap;
use std::fmt::Write;

use shadowlab::scene::Mesh;

/// Every file says where it comes from.
pub const ORIGIN: &str = "Made by `cargo xtask assets`. Licence: MIT OR Apache-2.0.";

pub struct Obj {
    text: String,
    known: [HashMap<String, usize>; 3],
    /// How many decimals a position, a texture coordinate and a normal have.
    decimals: [i32; 3],
}

impl Obj {
    pub fn new(title: &str, library: &str, decimals: [i32; 3]) -> Self {
        Self {
            text: format!("# {title}. {ORIGIN}\nmtllib {library}\n"),
            known: Default::default(),
            decimals,
        }
    }

    pub fn object(&mut self, name: &str, material: &str, solids: &[Mesh]) {
        let mut faces = format!("o {name}\nusemtl {material}\n");
        for mesh in solids {
            for face in &mesh.faces {
                let corners = face.map(|i| self.corner(mesh, i as usize));
                let [a, b, c] = corners.map(|corner| corner[0]);
                // With few decimals a very narrow face has two equal corners. Its neighbours close the gap.
                if a == b || b == c || c == a {
                    continue;
                }
                faces.push('f');
                for [v, vt, vn] in corners {
                    write!(faces, " {v}/{vt}/{vn}").expect("a String takes everything");
                }
                faces.push('\n');
            }
        }
        self.text += &faces;
    }

    fn corner(&mut self, mesh: &Mesh, i: usize) -> [usize; 3] {
        [
            self.index(0, "v", &mesh.positions[i].to_array()),
            self.index(1, "vt", &mesh.texture_coords[i].to_array()),
            self.index(2, "vn", &mesh.normals[i].to_array()),
        ]
    }

    /// The index of a line of numbers, which is written if it is new.
    fn index(&mut self, kind: usize, keyword: &str, numbers: &[f64]) -> usize {
        let mut line = keyword.to_owned();
        let scale = 10_f64.powi(self.decimals[kind]);
        for number in numbers {
            // No minus before a zero.
            let rounded = (number * scale).round() / scale + 0.0;
            write!(line, " {rounded}").expect("a String takes everything");
        }
        let next = self.known[kind].len() + 1;
        *self.known[kind].entry(line).or_insert_with_key(|line| {
            self.text += line;
            self.text.push('\n');
            next
        })
    }

    pub fn text(self) -> String {
        self.text
    }
}
