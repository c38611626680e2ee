//! The matrices of the fixed pipeline, as programs before OpenGL 3 have them.

use std::collections::BTreeMap;

use glam::{DMat4, DVec3};

use crate::calls::matrices::light_and_plane;
use crate::calls::objects::Set;
use crate::calls::syntax::Call;

/// GL promises 32 modelview matrices; nobody nests deeper.
const DEEPEST: usize = 256;

/// Stacks by mode; a texture's by unit, too.
#[derive(Default)]
pub struct Matrices {
    mode: String,
    stacks: BTreeMap<(String, i64), Vec<Top>>,
}

#[derive(Clone, Copy, Default)]
struct Top {
    matrix: DMat4,
    /// Of its last change.
    line: u64,
    /// The factor of it that projects onto a plane, and its line.
    projector: Option<(u64, DMat4)>,
}

impl Top {
    fn set(&self) -> Set<DMat4> {
        Set::at(self.line, self.matrix)
    }
}

impl Matrices {
    pub fn modelview(&self) -> Set<DMat4> {
        self.top("GL_MODELVIEW", 0).set()
    }

    pub fn projection(&self) -> Set<DMat4> {
        self.top("GL_PROJECTION", 0).set()
    }

    /// What projects onto a plane in the modelview matrix.
    pub fn projector(&self) -> Option<(u64, DMat4)> {
        self.top("GL_MODELVIEW", 0).projector
    }

    /// Of a unit whose matrix was ever changed.
    pub fn textures(&self) -> impl Iterator<Item = Set<DMat4>> {
        let units = self
            .stacks
            .iter()
            .filter(|((mode, _), _)| mode == "GL_TEXTURE");
        units.filter_map(|(_, stack)| stack.last().map(|top| top.set()))
    }

    fn top(&self, mode: &str, unit: i64) -> Top {
        let stack = self.stacks.get(&(mode.to_owned(), unit));
        stack
            .and_then(|stack| stack.last())
            .copied()
            .unwrap_or_default()
    }

    pub(super) fn apply(&mut self, call: &Call, unit: i64) -> bool {
        let name = call.name.as_str();
        let [x, y, z] = [0, 1, 2].map(|place| call.number(place));
        // Of floats and of doubles.
        let changed = match name.trim_end_matches(['f', 'd']) {
            "glMatrixMode" => {
                self.mode = call.word(0).to_owned();
                return true;
            }
            "glLoadIdentity" => Change::To(DMat4::IDENTITY),
            "glLoadMatrix" => Change::To(sixteen(call)),
            "glMultMatrix" => Change::By(sixteen(call)),
            "glLoadTransposeMatrix" => Change::To(sixteen(call).transpose()),
            "glMultTransposeMatrix" => Change::By(sixteen(call).transpose()),
            "glTranslate" => Change::By(DMat4::from_translation(DVec3::new(x, y, z))),
            "glScale" => Change::By(DMat4::from_scale(DVec3::new(x, y, z))),
            "glRotate" => {
                let axis = [1, 2, 3].map(|place| call.number(place));
                let axis = DVec3::from_array(axis).normalize_or_zero();
                if axis == DVec3::ZERO {
                    return true;
                }
                Change::By(DMat4::from_axis_angle(axis, x.to_radians()))
            }
            "glOrtho" => Change::By(ortho([0, 1, 2, 3, 4, 5].map(|place| call.number(place)))),
            "glFrustum" => Change::By(frustum([0, 1, 2, 3, 4, 5].map(|place| call.number(place)))),
            "glPushMatrix" => Change::Push,
            "glPopMatrix" => Change::Pop,
            _ => return false,
        };
        let mode = if self.mode.is_empty() {
            "GL_MODELVIEW"
        } else {
            &self.mode
        };
        let unit = if mode == "GL_TEXTURE" { unit } else { 0 };
        let stack = self
            .stacks
            .entry((mode.to_owned(), unit))
            .or_insert_with(|| vec![Top::default()]);
        let depth = stack.len();
        let top = stack.last_mut().expect("a stack has a bottom");
        match changed {
            Change::To(matrix) => {
                *top = Top {
                    matrix,
                    line: call.line,
                    projector: None,
                };
            }
            Change::By(matrix) => {
                top.matrix *= matrix;
                top.line = call.line;
                if light_and_plane(matrix).is_some() {
                    top.projector = Some((call.line, matrix));
                }
            }
            Change::Push if depth < DEEPEST => {
                let top = *top;
                stack.push(top);
            }
            Change::Pop if depth > 1 => {
                stack.pop();
            }
            Change::Push | Change::Pop => {}
        }
        true
    }
}

enum Change {
    To(DMat4),
    By(DMat4),
    Push,
    Pop,
}

fn sixteen(call: &Call) -> DMat4 {
    let numbers = call.arg(0).numbers();
    numbers
        .first_chunk()
        .map_or(DMat4::IDENTITY, DMat4::from_cols_array)
}

/// As glOrtho's manual page has it: left, right, bottom, top, near, far.
fn ortho([l, r, b, t, n, f]: [f64; 6]) -> DMat4 {
    let scale = DVec3::new(2.0 / (r - l), 2.0 / (t - b), -2.0 / (f - n));
    let moved = DVec3::new(-(r + l) / (r - l), -(t + b) / (t - b), -(f + n) / (f - n));
    DMat4::from_translation(moved) * DMat4::from_scale(scale)
}

/// As glFrustum's manual page has it.
fn frustum([l, r, b, t, n, f]: [f64; 6]) -> DMat4 {
    DMat4::from_cols_array(&[
        2.0 * n / (r - l),
        0.0,
        0.0,
        0.0,
        0.0,
        2.0 * n / (t - b),
        0.0,
        0.0,
        (r + l) / (r - l),
        (t + b) / (t - b),
        -(f + n) / (f - n),
        -1.0,
        0.0,
        0.0,
        -2.0 * f * n / (f - n),
        0.0,
    ])
}
