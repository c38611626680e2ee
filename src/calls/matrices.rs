//! Whether the second pass goes to the map by the way on which the first pass drew it, as far as matrices show it.
//!
//! Where the first pass takes a mesh to the light's clipping space by a matrix L, the second pass takes it to the map by
//! B·L, B = T(1/2)·H(1/2); or by L, where the shader has B. Which of a program's matrices make up L nobody says: products
//! of up to three are tried. That is decided for each mesh that both passes draw, because a model matrix may differ.

use glam::{DMat3, DMat4, DVec4};

use super::frame::Draw;
use super::objects::{Matrix, Set};

/// To [0,1] from the standard cube [−1,1]: T(1/2)·H(1/2).
pub const B: DMat4 = half([0.5, 0.5, 0.5]);
/// H(1/2)·T(1/2).
const SWAPPED: DMat4 = half([0.25, 0.25, 0.25]);

/// Of the largest element. apitrace prints seven digits, and a product of three floats loses one or two of them.
const TOLERANCE: f64 = 3e-4;
/// A scene has fewer meshes, and products are many.
const MOST_DRAWS: usize = 96;
/// With more matrices than that a program does something else, too.
const MOST_MATRICES: usize = 9;

const fn half(moved: [f64; 3]) -> DMat4 {
    DMat4::from_cols(
        DVec4::new(0.5, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 0.5, 0.0, 0.0),
        DVec4::new(0.0, 0.0, 0.5, 0.0),
        DVec4::new(moved[0], moved[1], moved[2], 1.0),
    )
}

/// What the second pass's matrix is, where L is the first pass's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// B·L.
    WithBias,
    /// L: the shader has B, or nobody has.
    Plain,
    /// B·B·L.
    Twice,
    /// H·T·L.
    Swapped,
    /// One of them, with a matrix of it transposed.
    Transposed,
}

#[derive(Debug, Default)]
pub struct Relations {
    /// The first that was found, and the left matrix of the second pass's product.
    pub found: Option<(Relation, Matrix)>,
    /// Draw calls of the first and the second pass that draw one mesh with different matrices.
    pub differs: Option<(u64, u64)>,
}

pub fn relations(first: &[&Draw], second: &[&Draw]) -> Relations {
    let mut all = Relations::default();
    let mut unpaired = None;
    let mut lone = None;
    for draw in second.iter().take(MOST_DRAWS) {
        let same: Vec<&Draw> = first
            .iter()
            .filter(|other| other.mesh == draw.mesh)
            .take(8)
            .copied()
            .collect();
        let paired = !same.is_empty();
        let others = if paired {
            same
        } else {
            first.iter().take(8).copied().collect()
        };
        let found = others.iter().find_map(|other| relation(other, draw));
        match found {
            Some(found) if paired => {
                all.found.get_or_insert(found);
            }
            Some(found) => {
                unpaired.get_or_insert(found);
            }
            None if paired && lone.is_none() => {
                lone = Some((others[0].line, draw.line, others[0], *draw))
            }
            None => {}
        }
    }
    if let Some((a, b, first, second)) = lone
        && (all.found.is_some() || camera_is_the_same(first, second))
    {
        all.differs = Some((a, b));
    }
    all.found = all.found.or(unpaired);
    all
}

/// From the mesh to the light's clipping space, by every order that the names allow.
pub fn to_light(draw: &Draw) -> Vec<DMat4> {
    if draw.matrices.is_empty() {
        return vec![draw.fixed.projection.value * draw.fixed.modelview.value];
    }
    let values: Vec<DMat4> = draw.matrices.iter().map(|matrix| matrix.value).collect();
    if values.len() > 3 {
        return Vec::new();
    }
    let mut ranked: Vec<(u8, DMat4)> = draw
        .matrices
        .iter()
        .map(|m| (rank(&m.name), m.value))
        .collect();
    ranked.sort_by_key(|(rank, _)| *rank);
    let says_all = ranked.windows(2).all(|pair| pair[0].0 < pair[1].0)
        && ranked.iter().all(|(rank, _)| *rank < 3);
    if says_all {
        return vec![
            ranked
                .iter()
                .fold(DMat4::IDENTITY, |product, (_, matrix)| product * *matrix),
        ];
    }
    products(&values, values.len())
        .into_iter()
        .map(|(product, _)| product)
        .collect()
}

/// The light's projection, or the whole way where it is no matrix of its own; with its line.
pub fn projection(draw: &Draw) -> Option<Set<DMat4>> {
    let Some(first) = draw.matrices.first() else {
        return Some(draw.fixed.projection.clone());
    };
    let named = draw.matrices.iter().find(|matrix| rank(&matrix.name) == 0);
    match named {
        Some(matrix) => Some(Set::at(matrix.line, matrix.value)),
        None => Some(Set::at(first.line, *to_light(draw).first()?)),
    }
}

impl Relations {
    /// The light's projection, with its view or without, and with no model that could stretch it.
    pub fn of_light(&self) -> Option<DMat4> {
        match self.found.as_ref()? {
            (Relation::WithBias, matrix) => Some(B.inverse() * matrix.value),
            (Relation::Plain, matrix) => Some(matrix.value),
            _ => None,
        }
    }
}

/// Projection, view, model; 3 for a name that says nothing.
fn rank(name: &str) -> u8 {
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if has(&["mvp", "modelview", "viewproj", "space", "lightmatrix"]) {
        3
    } else if has(&["proj", "persp", "ortho"]) {
        0
    } else if has(&["view", "camera"]) {
        1
    } else if has(&["model", "world"]) {
        2
    } else {
        3
    }
}

/// Products of so many different matrices, in every order, with the place of their left one.
fn products(values: &[DMat4], of: usize) -> Vec<(DMat4, usize)> {
    let mut all = Vec::new();
    let mut chosen = Vec::new();
    extend(values, of, DMat4::IDENTITY, &mut chosen, &mut all);
    all
}

fn extend(
    values: &[DMat4],
    of: usize,
    product: DMat4,
    chosen: &mut Vec<usize>,
    all: &mut Vec<(DMat4, usize)>,
) {
    if chosen.len() == of {
        all.push((product, chosen[0]));
        return;
    }
    for (place, value) in values.iter().enumerate() {
        if !chosen.contains(&place) {
            chosen.push(place);
            extend(values, of, product * *value, chosen, all);
            chosen.pop();
        }
    }
}

fn relation(first: &Draw, second: &Draw) -> Option<(Relation, Matrix)> {
    let lights = to_light(first);
    let matrices = second_matrices(second);
    let values: Vec<DMat4> = matrices.iter().map(|matrix| matrix.value).collect();
    let mut best: Option<(Relation, usize)> = None;
    for of in 1..=3 {
        for (product, left) in products(&values, of) {
            let relation = lights
                .iter()
                .filter_map(|light| related(product, *light))
                .min();
            if let Some(relation) = relation
                && best.is_none_or(|(known, _)| relation < known)
            {
                best = Some((relation, left));
            }
        }
    }
    let best =
        best.or_else(|| transposed(&values, &lights).map(|place| (Relation::Transposed, place)));
    best.map(|(relation, place)| (relation, matrices[place].clone()))
}

/// The program's matrices, and the fixed pipeline's that a shader of its time finds.
fn second_matrices(draw: &Draw) -> Vec<Matrix> {
    let fixed = |name: &str, set: &Set<DMat4>| Matrix {
        name: name.to_owned(),
        value: set.value,
        line: set.line,
    };
    let mut all: Vec<Matrix> = draw.matrices.clone();
    let textures = draw.fixed.textures.iter();
    all.extend(textures.map(|matrix| fixed("the texture matrix", matrix)));
    if !draw.fixed.textures.is_empty() {
        all.push(fixed("the modelview matrix", &draw.fixed.modelview));
    }
    all.truncate(MOST_MATRICES);
    all
}

/// Which matrix of a product must be transposed, so that it is right.
fn transposed(values: &[DMat4], lights: &[DMat4]) -> Option<usize> {
    (0..values.len()).find(|place| {
        let mut turned = values.to_vec();
        turned[*place] = turned[*place].transpose();
        (1..=3).any(|of| {
            products(&turned, of).iter().any(|(product, _)| {
                lights
                    .iter()
                    .any(|light| related(*product, *light).is_some())
            })
        })
    })
}

fn related(product: DMat4, light: DMat4) -> Option<Relation> {
    [
        (Relation::WithBias, B),
        (Relation::Plain, DMat4::IDENTITY),
        (Relation::Twice, B * B),
        (Relation::Swapped, SWAPPED),
    ]
    .into_iter()
    .find(|(_, left)| same(product, *left * light))
    .map(|(relation, _)| relation)
}

fn same(a: DMat4, b: DMat4) -> bool {
    let largest = b
        .to_cols_array()
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    largest > 0.0 && a.abs_diff_eq(b, TOLERANCE * largest)
}

/// Projection and view are those of the first pass but for a move of the world, and so it is the model that differs.
fn camera_is_the_same(first: &Draw, second: &Draw) -> bool {
    let named = |rank_of: u8| {
        first
            .matrices
            .iter()
            .find(|matrix| rank(&matrix.name) == rank_of)
    };
    let (Some(projection), Some(view)) = (named(0), named(1)) else {
        return false;
    };
    let light = projection.value * view.value;
    let values: Vec<DMat4> = second
        .matrices
        .iter()
        .map(|matrix| matrix.value)
        .take(MOST_MATRICES)
        .collect();
    let unmoved = |m: DMat4| DMat4::from_cols(m.x_axis, m.y_axis, m.z_axis, DVec4::ZERO);
    (1..=2).any(|of| {
        products(&values, of).iter().any(|(product, _)| {
            [DMat4::IDENTITY, B]
                .iter()
                .any(|left| same(unmoved(*product), unmoved(*left * light)))
        })
    })
}

/// How many times farther the far plane is than the near one; none for a projection without perspective, or without end.
pub fn depth_range(light: DMat4) -> Option<f64> {
    // Depth and w are both linear along the axis, so that each says the other: z = a·w + b.
    let (z, w) = (light.row(2).truncate(), light.row(3).truncate());
    let a = z.dot(w) / w.length_squared();
    (a > 1.0 + 1e-9).then(|| (a + 1.0) / (a - 1.0))
}

/// The whole number of degrees that went into a function of radians, where the field of view says so: it is whole in
/// this way and not in the right one.
pub fn degrees_for_radians(light: DMat4) -> Option<u32> {
    let (across, w) = (light.row(0).truncate(), light.row(3).truncate());
    if w.length() == 0.0 || !light.is_finite() {
        return None;
    }
    let focal = across.length() / w.length();
    let degrees = 2.0 * (1.0 / focal).atan().to_degrees();
    if (degrees - degrees.round()).abs() < 1e-3 {
        return None;
    }
    (10..=170).find(|degrees| {
        let wrong = 1.0 / (f64::from(*degrees) / 2.0).tan().abs();
        (focal / wrong - 1.0).abs() < 1e-5
    })
}

/// The light and the plane of a matrix that projects onto a plane, (plane·light)·I − light ⊗ plane: what it takes to
/// nothing, and what every projected point lies on. None for a matrix that does not project.
pub fn light_and_plane(matrix: DMat4) -> Option<[DVec4; 2]> {
    let largest = matrix
        .to_cols_array()
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    if largest == 0.0 || !matrix.is_finite() {
        return None;
    }
    let matrix = matrix * (1.0 / largest);
    Some([kernel(matrix)?, kernel(matrix.transpose())?])
}

/// The one direction that a matrix of rank 3 takes to nothing.
fn kernel(matrix: DMat4) -> Option<DVec4> {
    // A row of cofactors is orthogonal to the other three rows; of four such, the longest is the most exact one.
    let rows = [0, 1, 2, 3].map(|row| matrix.row(row));
    let candidates = (0..4).map(|left_out| {
        let mut kept = rows
            .iter()
            .enumerate()
            .filter(|(row, _)| *row != left_out)
            .map(|(_, row)| *row);
        let [a, b, c] = std::array::from_fn(|_| kept.next().expect("three rows are left"));
        cross(a, b, c)
    });
    let longest = candidates.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let direction = longest.try_normalize()?;
    let vanishes = (matrix * direction).length() < TOLERANCE;
    // What vanishes twice is no projection onto a plane.
    (vanishes && longest.length() > 1e-6).then_some(direction)
}

/// The vector at right angles to three others.
fn cross(a: DVec4, b: DVec4, c: DVec4) -> DVec4 {
    let minor = |skip: usize| {
        let part = |v: DVec4| {
            let mut left = (0..4).filter(|place| *place != skip).map(|place| v[place]);
            std::array::from_fn(|_| left.next().expect("three are left"))
        };
        DMat3::from_cols_array_2d(&[a, b, c].map(part)).determinant()
    };
    DVec4::new(minor(0), -minor(1), minor(2), -minor(3))
}

/// Whether two directions are one, whatever their sign.
pub fn is_along(a: DVec4, b: DVec4) -> bool {
    a.dot(b).abs() > 1.0 - 1e-5
}
