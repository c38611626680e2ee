//! The fast method: what of a wall's shadow every light has in common, and what each light has to draw for itself.
//!
//! As the light moves within its cube, the shadow changes only where the shadow of a silhouette edge can fall: of an edge
//! that has a triangle on one side alone, or whose two triangles face the light differently. Between these edges a point
//! that one light does not reach is reached by none. A grid over the wall says where they fall.

use std::ops::Range;

use glam::{DVec2, DVec3, Vec3Swizzles, dvec2, dvec3};

use super::scene::Wall;
use super::topology::{Edge, Topology};

/// Along a wall's edge. Some pixels fall into a cell of the course's window.
const CELLS: usize = 128;
/// What GL may snap a corner by, and more, in the wall's own −1…1: a tenth of a cell.
const PADDING: f64 = 0.1 * 2.0 / CELLS as f64;

/// The lights: a cube around the light's own place.
#[derive(Clone, Copy)]
pub struct Cube {
    pub centre: DVec3,
    /// Half the length of an edge.
    pub reach: f64,
}

impl Cube {
    fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
            self.centre + self.reach * dvec3(sign(1), sign(2), sign(4))
        })
    }
}

/// A caster where it stands, in the world.
pub struct Caster<'a> {
    pub positions: Vec<DVec3>,
    pub faces: &'a [[u32; 3]],
    pub topology: &'a Topology,
}

/// What is to be drawn of the shadows on one wall.
pub struct Parts {
    /// Rectangles of the wall, in its own −1…1, that no light reaches: two opposite corners.
    pub umbra: Vec<[DVec2; 2]>,
    /// Of each caster the triangles that each light has to draw, three vertices each.
    pub penumbra: Vec<Vec<u32>>,
    /// Whether a caster reaches behind the wall, or as far as a light: there planes cut it.
    pub is_cut: bool,
}

/// A rectangle of the wall.
#[derive(Clone, Copy, PartialEq)]
struct Bounds {
    low: DVec2,
    high: DVec2,
}

impl Bounds {
    fn around(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    fn leaves_the_wall(&self) -> bool {
        self.low.min_element() < -1.0 || self.high.max_element() > 1.0
    }

    /// The columns and rows of cells that it touches.
    fn spans(&self) -> [Range<usize>; 2] {
        let cell = |at: f64| (0.5 * (at + 1.0) * CELLS as f64).clamp(0.0, CELLS as f64);
        let range = |low: f64, high: f64| cell(low).floor() as usize..cell(high).ceil() as usize;
        [
            range(self.low.x, self.high.x),
            range(self.low.y, self.high.y),
        ]
    }

    fn cells(&self) -> impl Iterator<Item = usize> + use<> {
        let [columns, rows] = self.spans();
        rows.flat_map(move |row| columns.clone().map(move |column| row * CELLS + column))
    }
}

/// A cell's middle.
fn middle(cell: usize) -> DVec2 {
    let at = |i: usize| (i as f64 + 0.5) * 2.0 / CELLS as f64 - 1.0;
    dvec2(at(cell % CELLS), at(cell / CELLS))
}

impl Parts {
    /// `beyond` says whether shadows beyond the wall's edges can be seen.
    pub fn new(wall: &Wall, lights: Cube, casters: &[Caster], beyond: bool) -> Self {
        let shadows = casters
            .iter()
            .map(|caster| Shadow::of(wall, lights, caster));
        let shadows: Vec<Shadow> = shadows.collect();
        let mut dark = vec![false; CELLS * CELLS];
        let mut kept: Vec<Vec<u32>> = Vec::new();
        for (caster, shadow) in casters.iter().zip(&shadows) {
            shadow.darken(caster, &mut dark);
        }
        for (caster, shadow) in casters.iter().zip(&shadows) {
            kept.push(shadow.kept(caster, &dark, beyond));
        }
        let is_cut = |(shadow, kept): (&Shadow, &Vec<u32>)| shadow.is_cut && !kept.is_empty();
        Self {
            umbra: rectangles(&dark),
            is_cut: shadows.iter().zip(&kept).any(is_cut),
            penumbra: kept,
        }
    }

    /// Where there is no wall to draw an umbra on, each light draws all shadows as they are.
    pub fn whole(casters: &[Caster]) -> Self {
        let all = casters
            .iter()
            .map(|caster| caster.faces.as_flattened().to_vec());
        Self {
            umbra: Vec::new(),
            penumbra: all.collect(),
            is_cut: true,
        }
    }
}

/// The shadow of one caster.
struct Shadow {
    /// Of each vertex.
    places: Vec<Place>,
    /// Of each triangle.
    facing: Vec<Facing>,
    /// Of each cell: whether the shadow of a silhouette edge can fall there.
    changes: Vec<bool>,
    /// Whether a vertex is not between the wall and all lights: there planes cut the caster.
    is_cut: bool,
}

/// Where the shadow of a vertex falls.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Nowhere: the vertex is behind the wall,
    Behind,
    /// or beyond all lights.
    Beyond,
    /// The vertex is beyond some of the lights.
    Anywhere,
    OnWall {
        /// From the light in the middle.
        middle: DVec2,
        /// From any of the lights.
        bounds: Bounds,
    },
}

impl Shadow {
    fn of(wall: &Wall, lights: Cube, caster: &Caster) -> Self {
        let height = |point: DVec3| wall.plane.dot(point.extend(1.0));
        let corners = lights.corners();
        let lowest = corners
            .map(height)
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let highest = corners
            .map(height)
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max);
        let to_wall = wall.placement.inverse();
        let shadow = |light: DVec3, vertex: DVec3| {
            let (of_light, of_vertex) = (height(light), height(vertex));
            let on_wall = (of_light * vertex - of_vertex * light) / (of_light - of_vertex);
            to_wall.transform_point3(on_wall).xy()
        };
        let place = |vertex: &DVec3| match height(*vertex) {
            height if height <= 0.0 => Place::Behind,
            height if height >= highest => Place::Beyond,
            height if height >= lowest => Place::Anywhere,
            _ => {
                // From any light in the cube the shadow lies between those from its corners.
                let all = corners.map(|light| shadow(light, *vertex));
                Place::OnWall {
                    middle: shadow(lights.centre, *vertex),
                    bounds: Bounds {
                        low: all.into_iter().fold(DVec2::INFINITY, DVec2::min) - PADDING,
                        high: all.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max) + PADDING,
                    },
                }
            }
        };
        let places: Vec<Place> = caster.positions.iter().map(place).collect();
        let facing = facing(lights, caster);
        let mut changes = vec![false; CELLS * CELLS];
        for Edge { ends, faces } in &caster.topology.edges {
            let is_silhouette = faces.is_none_or(|[one, other]| {
                facing[one] != facing[other] || facing[one] == Facing::Both
            });
            let ends = ends.map(|i| places[i]);
            if !is_silhouette || is_nowhere(&ends) {
                continue;
            }
            match bounds(&ends) {
                Some(bounds) => bounds.cells().for_each(|cell| changes[cell] = true),
                None => changes.fill(true),
            }
        }
        Self {
            is_cut: places
                .iter()
                .any(|place| !matches!(place, Place::OnWall { .. })),
            places,
            facing,
            changes,
        }
    }

    fn corners(&self, face: &[u32; 3]) -> [Place; 3] {
        face.map(|i| self.places[i as usize])
    }

    /// Adds the cells that none of the lights reaches.
    fn darken(&self, caster: &Caster, dark: &mut [bool]) {
        for face in caster.faces {
            let corners = self.corners(face);
            let [
                Place::OnWall { middle: a, .. },
                Place::OnWall { middle: b, .. },
                Place::OnWall { middle: c, .. },
            ] = corners
            else {
                continue;
            };
            for cell in bounds(&corners).iter().flat_map(Bounds::cells) {
                dark[cell] |= !self.changes[cell] && is_within(middle(cell), [a, b, c]);
            }
        }
    }

    /// The triangles that each light has to draw where it is not dark anyway.
    fn kept(&self, caster: &Caster, dark: &[bool], beyond: bool) -> Vec<u32> {
        let is_front_alone = caster.topology.is_closed && !self.is_cut;
        let changes = |cell: usize| self.changes[cell] && !dark[cell];
        let is_kept = |(face, facing): &(&[u32; 3], &Facing)| {
            let corners = self.corners(face);
            let is_drawn = match bounds(&corners) {
                Some(bounds) => (beyond && bounds.leaves_the_wall()) || bounds.cells().any(changes),
                None => !is_nowhere(&corners),
            };
            is_drawn && !(is_front_alone && **facing == Facing::Away)
        };
        let kept = caster.faces.iter().zip(&self.facing).filter(is_kept);
        kept.flat_map(|(face, _)| *face).collect()
    }
}

/// Whether an edge or a triangle is behind the wall, or beyond the lights.
fn is_nowhere(corners: &[Place]) -> bool {
    [Place::Behind, Place::Beyond]
        .iter()
        .any(|nowhere| corners.iter().all(|corner| corner == nowhere))
}

/// Where the shadow of an edge or of a triangle can fall, unless a plane cuts it.
fn bounds(corners: &[Place]) -> Option<Bounds> {
    let bounds = corners.iter().map(|corner| match corner {
        Place::OnWall { bounds, .. } => Some(*bounds),
        _ => None,
    });
    bounds.reduce(|a, b| Some(a?.around(b?))).flatten()
}

/// Which side of a triangle the lights see.
#[derive(Clone, Copy, PartialEq)]
enum Facing {
    Towards,
    Away,
    /// Some see the one, some the other, or it is edge-on.
    Both,
}

fn facing(lights: Cube, caster: &Caster) -> Vec<Facing> {
    let of_face = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|i| caster.positions[i as usize]);
        let normal = (b - a).cross(c - a);
        let middle = normal.dot(lights.centre - a);
        // How far it may be off at a corner of the cube; and what rounding may do to a triangle that is edge-on.
        let rounding = 1e-9 * normal.length() * (lights.centre - a).length();
        let most = lights.reach * normal.abs().element_sum() + rounding;
        match middle {
            _ if middle > most => Facing::Towards,
            _ if middle < -most => Facing::Away,
            _ => Facing::Both,
        }
    };
    caster.faces.iter().map(of_face).collect()
}

/// Whether a point lies in a triangle, whichever way round that is.
fn is_within(point: DVec2, [a, b, c]: [DVec2; 3]) -> bool {
    let side = |from: DVec2, to: DVec2| (to - from).perp_dot(point - from);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// Neighbours in a row become one rectangle.
fn rectangles(cells: &[bool]) -> Vec<[DVec2; 2]> {
    let half = DVec2::splat(1.0 / CELLS as f64);
    let mut rectangles = Vec::new();
    for row in 0..CELLS {
        let mut column = 0;
        for run in cells[row * CELLS..(row + 1) * CELLS].chunk_by(|a, b| a == b) {
            let first = row * CELLS + column;
            column += run.len();
            if run[0] {
                let last = row * CELLS + column - 1;
                rectangles.push([middle(first) - half, middle(last) + half]);
            }
        }
    }
    rectangles
}

#[cfg(test)]
mod tests;
