//! What an exact GPU would compute, in f64, to hold a real one's values against: where a pixel's ray meets a triangle, and
//! the depth that is stored in each texel of a shadow map.

use std::collections::HashMap;

use glam::{DMat3, DVec2, DVec3, DVec4, dvec2};

/// Vertices are snapped to a grid of 1/256 pixel, in the picture and in the map; the nearest grid point is at most half
/// of that away along each axis, and rasterisers differ in where pixels start: the other half is for them.
pub const SNAP: f64 = 1.0 / 256.0;
/// Rounding of the shaders' products and of the interpolation: 8 roundings of 2⁻²⁴, relative to the largest terms.
pub const ROUNDING: f64 = 8.0 / 16_777_216.0;
/// A linear filter's weights may have as few as 8 bits.
const FILTER_WEIGHT: f64 = 1.0 / 256.0;

/// A triangle in clip space, ready to be asked what of it lies at a point of the screen.
pub struct ClipTriangle {
    /// From (x, y, 1) to the weights of the three vertices, whose sum is 1/w there.
    weights: DMat3,
    z: DVec3,
    /// Counter-clockwise on the screen, which GL calls the front.
    pub front: bool,
}

impl ClipTriangle {
    /// None if it is seen edge-on or has no area.
    pub fn new([a, b, c]: [DVec4; 3]) -> Option<Self> {
        let xyw = |v: DVec4| DVec3::new(v.x, v.y, v.w);
        let corners = DMat3::from_cols(xyw(a), xyw(b), xyw(c));
        let area = corners.determinant();
        (area != 0.0).then(|| Self {
            weights: corners.inverse(),
            z: DVec3::new(a.z, b.z, c.z),
            front: area > 0.0,
        })
    }

    /// The share of each vertex in what is seen at a place of a picture of this size, in pixels from the bottom left.
    pub fn shares(&self, size: [u32; 2], place: DVec2) -> DVec3 {
        let size = dvec2(f64::from(size[0]), f64::from(size[1]));
        let weights = self.weights * (2.0 * place / size - 1.0).extend(1.0);
        weights / weights.element_sum()
    }

    /// The same where the triangle covers the place, between near and far.
    pub fn covers(&self, size: [u32; 2], place: DVec2) -> Option<DVec3> {
        let screen = 2.0 * place / dvec2(f64::from(size[0]), f64::from(size[1])) - 1.0;
        self.depth(screen).map(|_| self.shares(size, place))
    }

    /// The depth in 0…1 at a point of the screen in −1…1; None outside of the triangle and of near and far.
    fn depth(&self, screen: DVec2) -> Option<f64> {
        let weights = self.weights * screen.extend(1.0);
        let z = weights.dot(self.z);
        (weights.min_element() >= 0.0 && z.abs() <= 1.0).then_some(0.5 * z + 0.5)
    }
}

/// A value, and the smallest and largest that it may be.
#[derive(Clone, Copy)]
pub struct Range {
    pub value: f64,
    pub least: f64,
    pub most: f64,
}

impl Range {
    pub fn over(value: f64, others: impl IntoIterator<Item = f64>) -> Self {
        let start = Self {
            value,
            least: value,
            most: value,
        };
        others.into_iter().fold(start, |range, other| Self {
            value,
            least: range.least.min(other),
            most: range.most.max(other),
        })
    }

    pub fn radius(&self) -> f64 {
        (self.most - self.value).max(self.value - self.least)
    }
}

/// The corners of a square of half the side `r` around nothing.
pub fn corners(r: f64) -> [DVec2; 4] {
    [dvec2(-r, -r), dvec2(r, -r), dvec2(-r, r), dvec2(r, r)]
}

/// The shadow map that an exact rasteriser would draw, texel by texel as it is asked for.
pub struct ExactMap {
    triangles: Vec<ClipTriangle>,
    size: f64,
    linear: bool,
    texels: HashMap<(i64, i64), Range>,
}

impl ExactMap {
    pub fn new(triangles: Vec<ClipTriangle>, size: u32, linear: bool) -> Self {
        Self {
            triangles,
            size: f64::from(size),
            linear,
            texels: HashMap::new(),
        }
    }

    /// The depth that is stored at a place on the map, in texels.
    fn depth(&self, place: DVec2) -> f64 {
        let screen = 2.0 * place / self.size - 1.0;
        let depths = self
            .triangles
            .iter()
            .filter_map(|triangle| triangle.depth(screen));
        depths.fold(1.0, f64::min)
    }

    /// A texel's depth, at its centre and as far around it as a snapped vertex may have moved the surface.
    fn texel(&mut self, x: i64, y: i64) -> Range {
        // GL_CLAMP_TO_EDGE.
        let last = self.size as i64 - 1;
        let (x, y) = (x.clamp(0, last), y.clamp(0, last));
        if let Some(known) = self.texels.get(&(x, y)) {
            return *known;
        }
        let centre = dvec2(x as f64 + 0.5, y as f64 + 0.5);
        let around = corners(SNAP).map(|offset| self.depth(centre + offset));
        let texel = Range::over(self.depth(centre), around);
        self.texels.insert((x, y), texel);
        texel
    }

    /// What `texture(…)` returns for the map.
    pub fn lookup(&mut self, uv: DVec2) -> Range {
        let place = uv * self.size;
        if !place.is_finite() {
            return Range::over(1.0, [0.0]);
        }
        if !self.linear {
            return self.texel(place.x.floor() as i64, place.y.floor() as i64);
        }
        let corner = (place - 0.5).floor();
        let share = place - 0.5 - corner;
        let (x, y) = (corner.x as i64, corner.y as i64);
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| self.texel(x + i, y + j));
        let mix = |depth: fn(&Range) -> f64| {
            let [a, b, c, d] = texels.each_ref().map(depth);
            let (lower, upper) = (a + share.x * (b - a), c + share.x * (d - c));
            lower + share.y * (upper - lower)
        };
        let slack = {
            let values = texels.map(|texel| texel.value);
            let all = Range::over(values[0], values);
            FILTER_WEIGHT * (all.most - all.least)
        };
        Range {
            value: mix(|texel| texel.value),
            least: mix(|texel| texel.least) - slack,
            most: mix(|texel| texel.most) + slack,
        }
    }
}
