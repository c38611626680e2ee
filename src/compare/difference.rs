//! How far two pictures differ.

use image::{Rgb, RgbImage};

/// In levels of 255, of the channel that differs most: drivers round.
pub const TOLERANCE: u8 = 8;
/// The same of a JPEG, which stores colors in blocks: at quality 85 it leaves one pixel in a thousand beyond this.
pub const TOLERANCE_OF_JPEG: u8 = 24;
/// The share of pixels that may differ by more than that between pictures that are called the same: along edges,
/// rasterisers do not agree on which pixel is whose.
pub const SAME: f64 = 0.002;

/// Which pixel of the reference one of mine has to be like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matching {
    /// The one in the same place.
    Exact,
    /// What lies between the darkest and the lightest of the nine around it, channel by channel: a picture that was
    /// resized or compressed has other edges, and the same shadows.
    WithinAPixel,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    pub pixels: usize,
    /// In levels of 255.
    pub tolerance: u8,
    /// Pixels that differ by more than that.
    pub differing: usize,
    /// The mean of all channels' differences, in levels of 255.
    pub mean: f64,
    pub largest: u8,
    /// Structural similarity of the brightness, 1 for the same picture: the mean over windows of 8×8 pixels.
    pub ssim: f64,
}

impl Difference {
    /// Of two pictures of one size.
    pub fn new(mine: &RgbImage, reference: &RgbImage, matching: Matching, tolerance: u8) -> Self {
        let range = match matching {
            Matching::Exact => Envelope::exact(reference),
            Matching::WithinAPixel => Envelope::new(reference),
        };
        let mut differing = 0;
        let mut sum = 0.0;
        let mut largest = 0;
        for off in range.outside(mine) {
            sum += off.into_iter().map(f64::from).sum::<f64>();
            let worst = off.into_iter().max().expect("a pixel has channels");
            differing += usize::from(worst > tolerance);
            largest = largest.max(worst);
        }
        let pixels = mine.as_raw().len() / 3;
        Self {
            pixels,
            tolerance,
            differing,
            mean: sum / (3 * pixels) as f64,
            largest,
            ssim: ssim(mine, reference),
        }
    }

    /// The share of the pixels that differ.
    pub fn share(&self) -> f64 {
        self.differing as f64 / self.pixels as f64
    }

    pub fn is_same(&self) -> bool {
        self.share() <= SAME
    }
}

/// The least and the most that each channel of each pixel may be.
pub struct Envelope {
    least: RgbImage,
    most: RgbImage,
}

impl Envelope {
    /// Within a pixel of the reference.
    pub fn new(reference: &RgbImage) -> Self {
        Self {
            least: spread(reference, u8::min),
            most: spread(reference, u8::max),
        }
    }

    fn exact(reference: &RgbImage) -> Self {
        Self {
            least: reference.clone(),
            most: reference.clone(),
        }
    }

    /// By how many levels each channel of each pixel is outside.
    fn outside(&self, mine: &RgbImage) -> impl Iterator<Item = [u8; 3]> {
        assert_eq!(mine.dimensions(), self.least.dimensions());
        let range = self.least.pixels().zip(self.most.pixels());
        mine.pixels().zip(range).map(|(mine, (least, most))| {
            let off = |channel: usize| {
                let value = mine.0[channel];
                let below = least.0[channel].saturating_sub(value);
                below.max(value.saturating_sub(most.0[channel]))
            };
            [off(0), off(1), off(2)]
        })
    }

    /// The share of the pixels that differ by more than so many levels.
    pub fn share_outside(&self, mine: &RgbImage, tolerance: u8) -> f64 {
        let differs = |off: &[u8; 3]| off.iter().any(|levels| *levels > tolerance);
        let differing = self.outside(mine).filter(differs).count();
        differing as f64 / (mine.as_raw().len() / 3) as f64
    }
}

/// Each channel's least or most of the nine pixels around: first along the rows, then along the columns.
fn spread(picture: &RgbImage, choose: impl Fn(u8, u8) -> u8) -> RgbImage {
    let (width, height) = picture.dimensions();
    let pass = |from: &RgbImage, [dx, dy]: [u32; 2]| {
        RgbImage::from_fn(width, height, |x, y| {
            let own = from.get_pixel(x, y).0;
            let before = from.get_pixel(x.saturating_sub(dx), y.saturating_sub(dy)).0;
            let after = from
                .get_pixel((x + dx).min(width - 1), (y + dy).min(height - 1))
                .0;
            let of = |channel: usize| choose(choose(own[channel], before[channel]), after[channel]);
            Rgb([of(0), of(1), of(2)])
        })
    };
    pass(&pass(picture, [1, 0]), [0, 1])
}

fn ssim(mine: &RgbImage, reference: &RgbImage) -> f64 {
    let grey = |picture: &RgbImage| image::DynamicImage::from(picture.clone()).into_luma8();
    let algorithm = image_compare::Algorithm::MSSIMSimple;
    let (mine, reference) = (grey(mine), grey(reference));
    let similarity = image_compare::gray_similarity_structure(&algorithm, &mine, &reference);
    similarity.expect("the pictures have one size").score
}

/// Where two pictures differ: black where they do not, then red, yellow and, from 128 levels, white.
pub fn heat_map(mine: &RgbImage, reference: &RgbImage) -> RgbImage {
    RgbImage::from_fn(mine.width(), mine.height(), |x, y| {
        let (a, b) = (mine.get_pixel(x, y).0, reference.get_pixel(x, y).0);
        let off = a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(b))).max();
        let heat = 6 * off.expect("a pixel has channels");
        Rgb([0, 255, 510].map(|from| heat.saturating_sub(from).min(255) as u8))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves(dark: u8, edge: u32) -> RgbImage {
        RgbImage::from_fn(40, 30, |x, _| {
            Rgb(if x < edge { [200; 3] } else { [dark; 3] })
        })
    }

    #[test]
    fn a_picture_is_like_itself() {
        let picture = halves(50, 20);
        let same = Difference::new(&picture, &picture, Matching::Exact, TOLERANCE);
        assert_eq!((same.differing, same.largest, same.mean), (0, 0, 0.0));
        assert!(same.ssim > 0.9999 && same.is_same());
        assert!(heat_map(&picture, &picture).pixels().all(|p| p.0 == [0; 3]));
    }

    #[test]
    fn what_differs_is_counted() {
        // The right half is 20 levels lighter, in 600 of 1,200 pixels.
        let found = Difference::new(&halves(70, 20), &halves(50, 20), Matching::Exact, TOLERANCE);
        assert_eq!(
            (found.pixels, found.differing, found.largest),
            (1200, 600, 20)
        );
        assert_eq!(found.mean, 10.0);
        assert!(!found.is_same() && found.ssim < 1.0);
        // Within the tolerance nothing differs.
        let found = Difference::new(&halves(58, 20), &halves(50, 20), Matching::Exact, TOLERANCE);
        assert_eq!((found.differing, found.largest), (0, 8));
    }

    #[test]
    fn an_edge_may_be_a_pixel_off_where_a_picture_was_resized() {
        let (mine, reference) = (halves(50, 21), halves(50, 20));
        let exact = Difference::new(&mine, &reference, Matching::Exact, TOLERANCE);
        let near = Difference::new(&mine, &reference, Matching::WithinAPixel, TOLERANCE);
        assert_eq!((exact.differing, near.differing), (30, 0));
        // Two pixels are too many.
        let far = Difference::new(
            &halves(50, 22),
            &reference,
            Matching::WithinAPixel,
            TOLERANCE,
        );
        assert_eq!(far.differing, 30);
    }

    #[test]
    fn heat_grows_with_the_difference() {
        let picture = |value| RgbImage::from_pixel(1, 1, Rgb([value; 3]));
        let heat = |off: u8| {
            heat_map(&picture(100 + off), &picture(100))
                .get_pixel(0, 0)
                .0
        };
        assert_eq!(heat(20), [120, 0, 0]);
        assert_eq!(heat(60), [255, 105, 0]);
        assert_eq!(heat(150), [255; 3]);
    }
}
