//! A visibility picture against the truth: how many pixels are wrong, which way, and why they may be.

mod nearest;

use std::collections::VecDeque;
use std::fmt;

use glam::DVec3;
use image::{GrayImage, Luma, Rgb, RgbImage};
use serde_json::{Value, json};

use crate::ground_truth::{Label, MapWidth, Ray, Rays, Truth};
use crate::labs::MapScale;
use crate::picture::Projection;
use nearest::Clumps;

/// A visibility that is not known everywhere, with the truth where it is not: what cannot be told is not called wrong. And
/// how many of the valid pixels are known.
pub fn only_known(visibility: GrayImage, known: &[bool], truth: &Truth) -> (GrayImage, usize) {
    let mut filled = visibility;
    let mut judged = 0;
    for ((pixel, known), label) in filled.pixels_mut().zip(known).zip(&truth.labels) {
        match (label, known) {
            (Label::NotValid, _) => (),
            (_, true) => judged += 1,
            (Label::Lit, false) => *pixel = Luma([255]),
            (Label::Shadowed, false) => *pixel = Luma([0]),
        }
    }
    (filled, judged)
}

/// A pixel counts as dark below this, of 255.
const HALF: u8 = 128;
/// A lit pixel is called grey below this: half-dark acne that the threshold above would hide.
const GREY: u8 = 242;

/// The colours of the mistakes in a picture of them; what is right is grey.
pub const FALSE_SHADOW: Rgb<u8> = Rgb([220, 30, 30]);
pub const FALSE_LIGHT: Rgb<u8> = Rgb([40, 80, 230]);

/// What kind of mistake a pixel is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    NotValid,
    Right,
    FalseShadow(Place),
    FalseLight(Place),
}

/// Where a mistake lies, as seen from the truth's boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// The truth itself hangs on a hair there.
    Ambiguous,
    /// Within a pixel of a change of the truth's label.
    Edge1,
    /// Within a texel of it, in light space on the receiver's plane: what the map's resolution cannot resolve.
    EdgeT,
    /// None of these: a fault of the method.
    Interior,
}

/// Wrong pixels of one kind, by place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrong {
    pub edge1: usize,
    pub edge_t: usize,
    pub interior: usize,
    /// Counted apart.
    pub ambiguous: usize,
}

impl Wrong {
    /// All but the ambiguous ones.
    pub fn total(&self) -> usize {
        self.edge1 + self.edge_t + self.interior
    }

    fn add(&mut self, place: Place) {
        match place {
            Place::Ambiguous => self.ambiguous += 1,
            Place::Edge1 => self.edge1 += 1,
            Place::EdgeT => self.edge_t += 1,
            Place::Interior => self.interior += 1,
        }
    }
}

/// The strip of light between a caster and its shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactGap {
    pub world: f64,
    /// None without a map.
    pub texels: Option<f64>,
}

/// The bias in the units that it can be thought of in, at the median of the pixels that the truth calls lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    pub depth: f64,
    pub world: f64,
    pub texels: f64,
}

/// A visibility picture's errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    pub lit: usize,
    pub shadowed: usize,
    /// Of the valid pixels.
    pub ambiguous: usize,
    /// Lit in truth, dark in the picture.
    pub false_shadow: Wrong,
    /// Dark in truth, lit in the picture.
    pub false_light: Wrong,
    /// Lit in truth, away from any edge, and below 95 % in the picture.
    pub grey: usize,
    pub contact_gap: Option<ContactGap>,
    pub bias: Option<Bias>,
}

/// The truth of a scene, with what measuring a picture against it needs again and again.
pub struct Measure<'a> {
    rays: &'a Rays,
    truth: &'a Truth,
    edge1: Vec<bool>,
    clumps: Clumps,
}

impl<'a> Measure<'a> {
    pub fn new(rays: &'a Rays, truth: &'a Truth) -> Self {
        Self {
            rays,
            truth,
            edge1: truth.edges(),
            clumps: Clumps::new(rays),
        }
    }

    /// The errors of `visibility` (255 lit, 0 in shadow, of the truth's size), and the picture that shows them.
    pub fn measure(&self, visibility: &GrayImage, map: Option<&MapScale>) -> (Figures, RgbImage) {
        let verdicts = self.verdicts(visibility, map);
        let mut figures = Figures {
            lit: self.truth.count(Label::Lit),
            shadowed: self.truth.count(Label::Shadowed),
            ambiguous: self.count(|i| self.is_valid(i) && self.truth.ambiguous[i]),
            false_shadow: Wrong::default(),
            false_light: Wrong::default(),
            grey: 0,
            contact_gap: self.contact_gap(&verdicts, map),
            bias: map.and_then(|map| self.bias(map)),
        };
        for verdict in &verdicts {
            match verdict {
                Verdict::FalseShadow(place) => figures.false_shadow.add(*place),
                Verdict::FalseLight(place) => figures.false_light.add(*place),
                Verdict::Right | Verdict::NotValid => (),
            }
        }
        figures.grey = self.count(|i| {
            self.truth.labels[i] == Label::Lit
                && visibility.as_raw()[i] < GREY
                && self.place(i, map) == Place::Interior
        });
        (figures, self.picture(&verdicts))
    }

    /// How many pixels are falsely shadowed in the interior: what a bias is there to remove.
    pub fn interior_false_shadow(&self, visibility: &GrayImage, map: Option<&MapScale>) -> usize {
        let verdicts = self.verdicts(visibility, map);
        let wrong = |verdict: &&Verdict| **verdict == Verdict::FalseShadow(Place::Interior);
        verdicts.iter().filter(wrong).count()
    }

    fn count(&self, holds: impl Fn(usize) -> bool) -> usize {
        (0..self.truth.labels.len()).filter(|i| holds(*i)).count()
    }

    fn is_valid(&self, i: usize) -> bool {
        self.truth.labels[i] != Label::NotValid
    }

    fn verdicts(&self, visibility: &GrayImage, map: Option<&MapScale>) -> Vec<Verdict> {
        assert_eq!([visibility.width(), visibility.height()], self.truth.size);
        let verdict = |(i, value): (usize, &u8)| match (self.truth.labels[i], *value < HALF) {
            (Label::NotValid, _) => Verdict::NotValid,
            (Label::Lit, false) | (Label::Shadowed, true) => Verdict::Right,
            (Label::Lit, true) => Verdict::FalseShadow(self.place(i, map)),
            (Label::Shadowed, false) => Verdict::FalseLight(self.place(i, map)),
        };
        visibility
            .as_raw()
            .iter()
            .enumerate()
            .map(verdict)
            .collect()
    }

    fn place(&self, i: usize, map: Option<&MapScale>) -> Place {
        if self.truth.ambiguous[i] {
            Place::Ambiguous
        } else if self.edge1[i] {
            Place::Edge1
        } else if map.is_some_and(|map| self.within_a_texel_of_a_change(i, map)) {
            Place::EdgeT
        } else {
            Place::Interior
        }
    }

    /// Whether the truth changes within one texel, on the plane of the triangle that is seen.
    fn within_a_texel_of_a_change(&self, i: usize, map: &MapScale) -> bool {
        let (triangle, point) = self.truth.seen[i].expect("a valid pixel shows a surface");
        let own = self.truth.labels[i] == Label::Shadowed;
        let source = &self.rays.source;
        let [a, b, c] = *self.rays.surfaces.triangle(triangle);
        let normal = (b - a).cross(c - a);
        let [width, height] = self.texel_size_at(point, map);
        let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (f64::from(x), f64::from(y))));
        around.filter(|offset| *offset != (0.0, 0.0)).any(|(x, y)| {
            let across = x * width * source.right + y * height * source.up;
            let ray = match source.map_width() {
                MapWidth::AtDistance1(_) => {
                    through(source.position, point - source.position, across, normal)
                }
                MapWidth::Everywhere(_) => along(source.axis, point, across, normal, map),
            };
            ray.is_some_and(|ray| self.rays.is_blocked(&ray, triangle) != own)
        })
    }

    /// How large a texel is where a point is, right and up across the light's axis.
    fn texel_size_at(&self, point: DVec3, map: &MapScale) -> [f64; 2] {
        let source = &self.rays.source;
        let [right, up] = map.share.map(|share| share / f64::from(map.size));
        match source.map_width() {
            MapWidth::AtDistance1(width) => {
                let width = (point - source.position).dot(source.axis) * width;
                [width * right, width * up]
            }
            MapWidth::Everywhere([width, height]) => [width * right, height * up],
        }
    }

    /// The longer side of a texel where a point is.
    fn texel_at(&self, point: DVec3, map: &MapScale) -> f64 {
        let [width, height] = self.texel_size_at(point, map);
        width.max(height)
    }

    fn bias(&self, map: &MapScale) -> Option<Bias> {
        let lit = (0..self.truth.labels.len()).filter(|i| self.truth.labels[*i] == Label::Lit);
        let source = &self.rays.source;
        let mut lit: Vec<(f64, DVec3)> = lit
            .filter_map(|i| self.truth.seen[i])
            .map(|(_, point)| ((point - source.position).dot(source.axis), point))
            .collect();
        if lit.is_empty() {
            return None;
        }
        let middle = lit.len() / 2;
        let (_, &mut (distance, point), _) =
            lit.select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0));
        // Depth by length. In perspective the stored depth is far/(far − near) · (1 − near/distance).
        let slope = match map.projection {
            Projection::Perspective => {
                map.far * map.near / ((map.far - map.near) * distance * distance)
            }
            Projection::Orthographic => 1.0 / (map.far - map.near),
        };
        let world = map.bias / slope;
        Some(Bias {
            depth: map.bias,
            world,
            texels: world / self.texel_at(point, map),
        })
    }

    /// The widest strip of false light that begins where a caster touches the receiver.
    ///
    /// A strip is a connected set of falsely lit pixels of which one is at the caster: nearer than a texel, or than the
    /// next pixel but one, whichever is more. Its width is the largest distance of its points from the caster that ought
    /// to shadow them.
    fn contact_gap(&self, verdicts: &[Verdict], map: Option<&MapScale>) -> Option<ContactGap> {
        let wrong = |i: usize| matches!(verdicts[i], Verdict::FalseLight(place) if place != Place::Ambiguous);
        let mut visited = vec![false; verdicts.len()];
        let mut widest: Option<ContactGap> = None;
        for start in 0..verdicts.len() {
            if visited[start] || !wrong(start) {
                continue;
            }
            let strip = self.connected(start, &wrong, &mut visited);
            let distances = strip
                .iter()
                .filter_map(|i| Some((*i, self.distance_to_caster(*i)?)));
            let distances: Vec<(usize, f64)> = distances.collect();
            let at_caster = |(i, distance): &(usize, f64)| {
                let texel = map.and_then(|map| Some(self.texel_at(self.truth.seen[*i]?.1, map)));
                *distance < texel.unwrap_or(0.0).max(1.5 * self.pixel_width(*i))
            };
            let farthest = distances.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((i, world)) = farthest
                && widest.is_none_or(|widest| *world > widest.world)
                && distances.iter().any(at_caster)
            {
                let texel = map.and_then(|map| Some(self.texel_at(self.truth.seen[*i]?.1, map)));
                widest = Some(ContactGap {
                    world: *world,
                    texels: texel.map(|texel| world / texel),
                });
            }
        }
        widest
    }

    /// How far a pixel's point is from those of the four pixels beside it, on the same object.
    fn pixel_width(&self, i: usize) -> f64 {
        let [width, height] = self.truth.size.map(|n| n as usize);
        let (x, y) = (i % width, i / width);
        let object = |seen: (u32, DVec3)| self.rays.objects[seen.0 as usize];
        let beside = [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then(|| i + 1),
            (y > 0).then(|| i - width),
            (y + 1 < height).then(|| i + width),
        ];
        let own = self.truth.seen[i];
        let others = beside
            .into_iter()
            .flatten()
            .filter_map(|i| self.truth.seen[i]);
        let distances = others.filter_map(|other| {
            let own = own?;
            (object(own) == object(other)).then(|| own.1.distance(other.1))
        });
        distances.fold(0.0, f64::max)
    }

    /// The pixels that hang together with `start`, in eight directions.
    fn connected(
        &self,
        start: usize,
        belongs: &impl Fn(usize) -> bool,
        visited: &mut [bool],
    ) -> Vec<usize> {
        let [width, height] = self.truth.size.map(|n| n as usize);
        let mut found = Vec::new();
        let mut next = VecDeque::from([start]);
        visited[start] = true;
        while let Some(i) = next.pop_front() {
            found.push(i);
            let (x, y) = (i % width, i / width);
            for y in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                for x in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    let neighbour = y * width + x;
                    if !visited[neighbour] && belongs(neighbour) {
                        visited[neighbour] = true;
                        next.push_back(neighbour);
                    }
                }
            }
        }
        found
    }

    /// How far a pixel's point is from the object that stands between it and the light.
    fn distance_to_caster(&self, i: usize) -> Option<f64> {
        let (triangle, point) = self.truth.seen[i]?;
        let caster = self.rays.nearest_blocker(triangle, point)?.triangle;
        let object = self.rays.objects[caster as usize];
        Some(self.clumps.distance(point, triangle, object, self.rays))
    }

    fn picture(&self, verdicts: &[Verdict]) -> RgbImage {
        let [width, height] = self.truth.size;
        RgbImage::from_fn(width, height, |x, y| {
            let i = (y * width + x) as usize;
            match (verdicts[i], self.truth.labels[i]) {
                (Verdict::NotValid, _) => Rgb([255, 255, 255]),
                (Verdict::Right, Label::Shadowed) => Rgb([90, 90, 90]),
                (Verdict::Right, _) => Rgb([215, 215, 215]),
                (Verdict::FalseShadow(_), _) => FALSE_SHADOW,
                (Verdict::FalseLight(_), _) => FALSE_LIGHT,
            }
        })
    }
}

/// The ray from a light onto the plane of a point that it lies `from_light` away, where it passes `across` from the
/// point: at t = 1.
fn through(light: DVec3, from_light: DVec3, across: DVec3, normal: DVec3) -> Option<Ray> {
    let direction = from_light + across;
    let reach = normal.dot(from_light) / normal.dot(direction);
    (reach.is_finite() && reach > 0.0).then(|| Ray::new(light, reach * direction))
}

/// The same for parallel rays, from before everything that the map holds.
fn along(axis: DVec3, point: DVec3, across: DVec3, normal: DVec3, map: &MapScale) -> Option<Ray> {
    let slide = -normal.dot(across) / normal.dot(axis);
    let path = (map.far - map.near) * axis;
    let on_plane = point + across + slide * axis;
    slide.is_finite().then(|| Ray::new(on_plane - path, path))
}

impl Figures {
    pub fn json(&self) -> Value {
        let wrong = |wrong: &Wrong, of: usize| {
            json!({
                "pixels": wrong.total(),
                "share": wrong.total() as f64 / of.max(1) as f64,
                "edge1": wrong.edge1,
                "edgeT": wrong.edge_t,
                "interior": wrong.interior,
                "ambiguous": wrong.ambiguous,
            })
        };
        json!({
            "valid": self.lit + self.shadowed,
            "lit": self.lit,
            "shadowed": self.shadowed,
            "ambiguous": self.ambiguous,
            "false_shadow": wrong(&self.false_shadow, self.lit),
            "false_light": wrong(&self.false_light, self.shadowed),
            "grey": self.grey,
            "contact_gap": self.contact_gap.map(|gap| json!({ "world": gap.world, "texels": gap.texels })),
            "bias": self.bias.map(|bias| json!({
                "depth": bias.depth, "world": bias.world, "texels": bias.texels,
            })),
        })
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let valid = self.lit + self.shadowed;
        writeln!(
            f,
            "{valid} valid pixels: {} lit, {} shadowed; {} of them ambiguous",
            self.lit, self.shadowed, self.ambiguous
        )?;
        writeln!(
            f,
            "{:14}{:>8}{:>10}{:>8}{:>8}{:>10}{:>11}",
            "", "pixels", "share", "edge1", "edgeT", "interior", "ambiguous"
        )?;
        for (name, wrong, of) in [
            ("false shadow", &self.false_shadow, self.lit),
            ("false light", &self.false_light, self.shadowed),
        ] {
            writeln!(
                f,
                "{name:14}{:8}{:9.3}%{:8}{:8}{:10}{:11}",
                wrong.total(),
                100.0 * wrong.total() as f64 / of.max(1) as f64,
                wrong.edge1,
                wrong.edge_t,
                wrong.interior,
                wrong.ambiguous
            )?;
        }
        writeln!(f, "grey: {} lit interior pixels below 95 %", self.grey)?;
        match self.contact_gap {
            None => writeln!(f, "contact gap: none")?,
            Some(ContactGap {
                world,
                texels: None,
            }) => writeln!(f, "contact gap: {world:.4} world units")?,
            Some(ContactGap {
                world,
                texels: Some(texels),
            }) => {
                writeln!(f, "contact gap: {world:.4} world units, {texels:.2} texels")?;
            }
        }
        if let Some(bias) = self.bias {
            writeln!(
                f,
                "bias: {} in depth, {:.5} world units, {:.2} texels at the median lit pixel",
                bias.depth, bias.world, bias.texels
            )?;
        }
        Ok(())
    }
}
