//! What is no mistake of a shadow and is taken out of a picture before it is judged.

use std::fmt;

use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

/// What was found and taken out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Forgiven {
    /// What JPEG does to colors.
    Jpeg,
    /// The picture had this size.
    Size([u32; 2]),
    UpsideDown,
    /// Another tone curve.
    Curve(Curve),
    /// So many levels too much in each channel.
    Tint([i16; 3]),
    /// So many pixels too far to the right and down.
    Shift([i32; 2]),
}

/// How a picture's values follow from the reference's, both 0…1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// v^2.2
    Darkened,
    /// v^(1/2.2)
    Brightened,
    /// sRGB's curve, from encoded to linear
    SrgbDecoded,
    /// sRGB's curve, from linear to encoded
    SrgbEncoded,
}

const CURVES: [Curve; 4] = [
    Curve::Darkened,
    Curve::Brightened,
    Curve::SrgbDecoded,
    Curve::SrgbEncoded,
];

/// A tint is no more than so many levels of 255.
const MOST_TINT: i16 = 8;
/// A shift is no more than so many pixels each way.
const MOST_SHIFT: i32 = 3;
/// By how much more a picture must be like the reference when it is turned.
const CLEARLY: f64 = 0.1;
/// Of two pictures that differ in their curve alone, half of all pixels differ by no more than this after it is undone.
const UNDONE: f64 = 6.0;
/// Differences beyond this count as this: a mistake in the shadows must not decide on the rest of the picture.
const CLIPPED: f64 = 64.0;
/// So many pixels are enough to find out what a whole picture has in common.
const ENOUGH_PIXELS: usize = 1 << 14;

/// A picture in another size.
pub fn resized(picture: &RgbImage, [width, height]: [u32; 2]) -> RgbImage {
    imageops::resize(picture, width, height, FilterType::CatmullRom)
}

/// A picture after everything was forgiven that is no mistake.
pub struct Forgiving {
    pub mine: RgbImage,
    pub forgiven: Vec<Forgiven>,
    /// The reference as `mine` is to be compared with it: a picture that was darkened has lost levels that nothing brings
    /// back, so the reference is darkened, too.
    pub darkened_reference: Option<RgbImage>,
    darkened: Option<Curve>,
}

impl Forgiving {
    /// The picture in the reference's own curve.
    pub fn brightened(&self) -> RgbImage {
        match self.darkened {
            Some(curve) => curve.undone(&self.mine),
            None => self.mine.clone(),
        }
    }
}

/// Makes a picture as like to a reference of the same size as can be done without touching its shadows, and says what
/// was done.
pub fn forgive(mine: RgbImage, reference: &RgbImage) -> Forgiving {
    assert_eq!(mine.dimensions(), reference.dimensions());
    let mut found = Forgiving {
        mine,
        forgiven: Vec::new(),
        darkened_reference: None,
        darkened: None,
    };

    let turned = imageops::flip_vertical(&found.mine);
    if correlation(&turned, reference) > correlation(&found.mine, reference) + CLEARLY {
        found.mine = turned;
        found.forgiven.push(Forgiven::UpsideDown);
    }
    if let Some(curve) = curve_of(&found.mine, reference) {
        found.forgiven.push(Forgiven::Curve(curve));
        if curve.darkens() {
            found.darkened = Some(curve);
            found.darkened_reference = Some(curve.applied(reference));
        } else {
            found.mine = curve.undone(&found.mine);
        }
    }
    let reference = found.darkened_reference.as_ref().unwrap_or(reference);
    if let Some((tint, undone)) = without_tint(&found.mine, reference) {
        found.mine = undone;
        found.forgiven.push(Forgiven::Tint(tint));
    }
    if let Some((shift, undone)) = without_shift(&found.mine, reference) {
        found.mine = undone;
        found.forgiven.push(Forgiven::Shift(shift));
    }
    found
}

/// How unlike two pictures are at a glance, in levels, whatever their curves: what tells which of many to look at.
pub fn unlikeness(mine: &RgbImage, reference: &RgbImage) -> f64 {
    let with_curve = CURVES.map(|curve| misfit(with(mine, reference, curve)));
    let as_it_is = misfit(sampled(mine, reference));
    with_curve.into_iter().fold(as_it_is, f64::min)
}

impl Curve {
    fn apply(self, value: f64) -> f64 {
        match self {
            Self::Darkened => value.powf(2.2),
            Self::Brightened => value.powf(1.0 / 2.2),
            Self::SrgbDecoded if value <= 0.04045 => value / 12.92,
            Self::SrgbDecoded => ((value + 0.055) / 1.055).powf(2.4),
            Self::SrgbEncoded if value <= 0.0031308 => 12.92 * value,
            Self::SrgbEncoded => 1.055 * value.powf(1.0 / 2.4) - 0.055,
        }
    }

    fn table(self) -> Vec<u8> {
        (0..=255)
            .map(|value| (255.0 * self.apply(f64::from(value) / 255.0)).round() as u8)
            .collect()
    }

    fn applied(self, picture: &RgbImage) -> RgbImage {
        let table = self.table();
        mapped(picture, |channels| channels.map(|v| table[usize::from(v)]))
    }
}

/// The pairs, with a curve on the reference.
fn with<'a>(
    mine: &'a RgbImage,
    reference: &'a RgbImage,
    curve: Curve,
) -> impl Iterator<Item = ([u8; 3], [u8; 3])> + use<'a> {
    let table = curve.table();
    sampled(mine, reference).map(move |(a, b)| (a, b.map(|value| table[usize::from(value)])))
}

fn curve_of(mine: &RgbImage, reference: &RgbImage) -> Option<Curve> {
    let fits = CURVES.map(|curve| (curve, misfit(with(mine, reference, curve))));
    let (curve, after) = fits.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let is_it = after < misfit(sampled(mine, reference)) / 2.0
        && median(with(mine, reference, curve)) <= UNDONE;
    is_it.then_some(curve)
}

impl Curve {
    /// A picture without it, as far as levels can tell.
    pub fn undone(self, picture: &RgbImage) -> RgbImage {
        self.inverse().applied(picture)
    }

    fn darkens(self) -> bool {
        matches!(self, Self::Darkened | Self::SrgbDecoded)
    }

    fn inverse(self) -> Self {
        match self {
            Self::Darkened => Self::Brightened,
            Self::Brightened => Self::Darkened,
            Self::SrgbDecoded => Self::SrgbEncoded,
            Self::SrgbEncoded => Self::SrgbDecoded,
        }
    }
}

/// A tint is what most pixels have in common, so it is the median that finds it.
fn without_tint(mine: &RgbImage, reference: &RgbImage) -> Option<([i16; 3], RgbImage)> {
    let tint = [0, 1, 2].map(|channel| {
        let mut off: Vec<i16> = sampled(mine, reference)
            .map(|(a, b)| i16::from(a[channel]) - i16::from(b[channel]))
            .collect();
        let middle = off.len() / 2;
        *off.select_nth_unstable(middle).1
    });
    let most = tint.iter().map(|levels| levels.abs()).max()?;
    if most == 0 || most > MOST_TINT {
        return None;
    }
    let undone = mapped(mine, |channels| {
        let mut channels = channels;
        for (value, levels) in channels.iter_mut().zip(tint) {
            *value = (i16::from(*value) - levels).clamp(0, 255) as u8;
        }
        channels
    });
    let [before, after] = [mine, &undone].map(|picture| misfit(sampled(picture, reference)));
    (after < 0.75 * before).then_some((tint, undone))
}

fn without_shift(mine: &RgbImage, reference: &RgbImage) -> Option<([i32; 2], RgbImage)> {
    let reach = -MOST_SHIFT..=MOST_SHIFT;
    let shifts = reach
        .clone()
        .flat_map(|y| reach.clone().map(move |x| [x, y]));
    let fits = shifts.map(|shift| (shift, misfit(sampled_shifted(mine, reference, shift))));
    let (shift, after) = fits.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let is_it = shift != [0, 0] && after < 0.6 * misfit(sampled(mine, reference));
    is_it.then(|| (shift, shifted(mine, shift)))
}

/// Moved back: to the left and up. What comes in at the border is the border.
fn shifted(picture: &RgbImage, [right, down]: [i32; 2]) -> RgbImage {
    let (width, height) = picture.dimensions();
    let from =
        |place: u32, by: i32, size: u32| (place as i32 + by).clamp(0, size as i32 - 1) as u32;
    RgbImage::from_fn(width, height, |x, y| {
        *picture.get_pixel(from(x, right, width), from(y, down, height))
    })
}

fn from(place: u32, by: i32, size: u32) -> u32 {
    (place as i32 + by).clamp(0, size as i32 - 1) as u32
}

fn mapped(picture: &RgbImage, change: impl Fn([u8; 3]) -> [u8; 3]) -> RgbImage {
    let mut changed = picture.clone();
    for pixel in changed.pixels_mut() {
        *pixel = Rgb(change(pixel.0));
    }
    changed
}

/// Pixels from all over both pictures, in pairs.
fn sampled<'a>(
    a: &'a RgbImage,
    b: &'a RgbImage,
) -> impl Iterator<Item = ([u8; 3], [u8; 3])> + use<'a> {
    let pairs = a.pixels().zip(b.pixels()).step_by(step(a));
    pairs.map(|(a, b)| (a.0, b.0))
}

/// The same pairs after [`shifted`] has moved the first picture.
fn sampled_shifted<'a>(
    a: &'a RgbImage,
    b: &'a RgbImage,
    [right, down]: [i32; 2],
) -> impl Iterator<Item = ([u8; 3], [u8; 3])> + use<'a> {
    let (width, height) = a.dimensions();
    let places = (0..a.as_raw().len() / 3).step_by(step(a));
    places.map(move |i| {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let moved = a.get_pixel(from(x, right, width), from(y, down, height));
        (moved.0, b.get_pixel(x, y).0)
    })
}

/// From one sampled pixel to the next.
fn step(picture: &RgbImage) -> usize {
    let step = (picture.as_raw().len() / 3).div_ceil(ENOUGH_PIXELS);
    // A step that divides the width would look at the same columns in every row.
    if step > 1 { step | 1 } else { 1 }
}

fn largest_difference((a, b): ([u8; 3], [u8; 3])) -> f64 {
    let off = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
    f64::from(off.expect("a pixel has channels"))
}

/// How unlike pixels are, in levels.
fn misfit(pairs: impl Iterator<Item = ([u8; 3], [u8; 3])>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for pair in pairs {
        sum += largest_difference(pair).min(CLIPPED);
        count += 1.0;
    }
    sum / count
}

fn median(pairs: impl Iterator<Item = ([u8; 3], [u8; 3])>) -> f64 {
    let mut all: Vec<f64> = pairs.map(largest_difference).collect();
    let middle = all.len() / 2;
    *all.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Of the brightness: it does not see a tint, and hardly a curve.
fn correlation(a: &RgbImage, b: &RgbImage) -> f64 {
    let brightness = |[r, g, b]: [u8; 3]| f64::from(r) + 2.0 * f64::from(g) + f64::from(b);
    let pairs: Vec<_> = sampled(a, b)
        .map(|(a, b)| (brightness(a), brightness(b)))
        .collect();
    let count = pairs.len() as f64;
    let (mean_a, mean_b) = pairs.iter().fold((0.0, 0.0), |sum, pair| {
        (sum.0 + pair.0 / count, sum.1 + pair.1 / count)
    });
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in pairs {
        ab += (a - mean_a) * (b - mean_b);
        aa += (a - mean_a).powi(2);
        bb += (b - mean_b).powi(2);
    }
    // A picture of one colour is like no other.
    if aa * bb > 0.0 {
        ab / (aa * bb).sqrt()
    } else {
        0.0
    }
}

impl fmt::Display for Forgiven {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Jpeg => f.write_str("JPEG, which is not exact in its colors"),
            Self::Size([width, height]) => write!(f, "another size, {width}×{height}"),
            Self::UpsideDown => f.write_str("upside down"),
            Self::Curve(Curve::Darkened) => {
                f.write_str("another gamma: darkened by the power of 2.2")
            }
            Self::Curve(Curve::Brightened) => {
                f.write_str("another gamma: brightened by the power of 1/2.2")
            }
            Self::Curve(Curve::SrgbDecoded) => {
                f.write_str("another gamma: sRGB, decoded once too often")
            }
            Self::Curve(Curve::SrgbEncoded) => {
                f.write_str("another gamma: sRGB, encoded once too often")
            }
            Self::Tint([red, green, blue]) => write!(
                f,
                "a tint: {red:+} levels of red, {green:+} of green, {blue:+} of blue"
            ),
            Self::Shift([right, down]) => {
                write!(f, "a shift: {right:+} pixels right, {down:+} down")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture with a sky, a ground in squares, and a dark disc: like no other that is turned or moved.
    fn scene() -> RgbImage {
        RgbImage::from_fn(120, 90, |x, y| {
            let squares = if (x / 7 + y / 5) % 2 == 0 { 30 } else { 0 };
            let disc = (x as i32 - 40).pow(2) + (y as i32 - 60).pow(2) < 200;
            Rgb(match (y < 30, disc) {
                (true, _) => [120, 160 + (y as u8), 220],
                (_, true) => [40 + squares, 30, 20],
                (_, false) => [150 + squares, 120 + squares, 60 + (x as u8)],
            })
        })
    }

    fn found(mine: RgbImage) -> (Vec<Forgiven>, f64) {
        let found = forgive(mine, &scene());
        let reference = found.darkened_reference.unwrap_or_else(scene);
        (found.forgiven, misfit(sampled(&found.mine, &reference)))
    }

    #[test]
    fn a_right_picture_needs_no_forgiveness() {
        assert_eq!(found(scene()), (Vec::new(), 0.0));
    }

    #[test]
    fn what_is_no_mistake_is_found_and_taken_out() {
        let (forgiven, left) = found(imageops::flip_vertical(&scene()));
        assert_eq!((forgiven, left), (vec![Forgiven::UpsideDown], 0.0));

        for curve in CURVES {
            let (forgiven, left) = found(curve.applied(&scene()));
            assert_eq!(forgiven, [Forgiven::Curve(curve)]);
            assert!(left < 2.0, "{curve:?}: {left}");
        }

        let tinted = mapped(&scene(), |[r, g, b]| [r + 8, g - 3, b]);
        assert_eq!(found(tinted), (vec![Forgiven::Tint([8, -3, 0])], 0.0));

        let moved = shifted(&scene(), [-2, 1]);
        let (forgiven, left) = found(moved);
        assert_eq!(forgiven, [Forgiven::Shift([2, -1])]);
        assert!(left < 1.0, "{left}");
    }

    #[test]
    fn a_mistake_is_not_forgiven() {
        // All in shadow; no shadow; a tint that is none; a shift that is none.
        let dark = mapped(&scene(), |channels| channels.map(|v| v / 3));
        assert_eq!(found(dark).0, []);
        let lit = mapped(
            &scene(),
            |[r, g, b]| if r < 80 { [150, 120, 100] } else { [r, g, b] },
        );
        assert_eq!(found(lit).0, []);
        let tinted = mapped(&scene(), |[r, g, b]| [r.saturating_add(20), g, b]);
        assert_eq!(found(tinted).0, []);
        assert_eq!(found(shifted(&scene(), [9, 0])).0, []);
    }
}
