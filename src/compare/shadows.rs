//! The shadows of a picture, apart from its shading: one channel, 255 lit, 0 in shadow.

use image::{GrayImage, Luma, RgbImage};

/// By how many levels of 255 the light must change a pixel, so that its shadow can be read from it: three times of what
/// JPEG does to a channel.
const READABLE: f64 = 12.0;
/// A pixel that is darker with shadows than without by this share is taken for a shadow's.
const DARKENED: f64 = 0.9;

pub struct Shadows {
    pub visibility: GrayImage,
    /// Whether a pixel tells it, row by row; where it does not, the visibility is 255.
    pub known: Vec<bool>,
}

impl Shadows {
    /// Of one picture: each pixel's place between what it is without shadows and what it is in shadow.
    pub fn between(mine: &RgbImage, lit: &RgbImage, dark: &RgbImage) -> Self {
        let pixels = mine.pixels().zip(lit.pixels()).zip(dark.pixels());
        let read = pixels.map(|((mine, lit), dark)| {
            let (mut along, mut length, mut most) = (0.0, 0.0, 0.0_f64);
            for ((mine, lit), dark) in mine.0.into_iter().zip(lit.0).zip(dark.0) {
                let light = f64::from(lit) - f64::from(dark);
                along += (f64::from(mine) - f64::from(dark)) * light;
                length += light * light;
                most = most.max(light.abs());
            }
            (most >= READABLE).then(|| along / length)
        });
        Self::new(mine, read)
    }

    /// Of a picture with shadows and one without: their ratio is free of the shading, whatever that is. What the darkest
    /// tenth of the shadows keeps of its light counts as full shadow.
    pub fn ratio(on: &RgbImage, off: &RgbImage) -> Self {
        let brightness = |channels: [u8; 3]| channels.into_iter().map(f64::from).sum::<f64>();
        let pixels = on.pixels().zip(off.pixels());
        let ratios: Vec<Option<f64>> = pixels
            .map(|(on, off)| {
                let (on, off) = (brightness(on.0), brightness(off.0));
                (off >= 3.0 * READABLE).then(|| on / off)
            })
            .collect();
        let mut darkened: Vec<f64> = ratios
            .iter()
            .flatten()
            .copied()
            .filter(|ratio| *ratio < DARKENED)
            .collect();
        darkened.sort_by(f64::total_cmp);
        // Where nothing is darker with shadows, everything is lit.
        let full = darkened.get(darkened.len() / 10).copied().unwrap_or(0.0);
        let read = ratios
            .into_iter()
            .map(|ratio| ratio.map(|ratio| (ratio - full) / (1.0 - full)));
        Self::new(on, read)
    }

    fn new(picture: &RgbImage, read: impl Iterator<Item = Option<f64>>) -> Self {
        let read: Vec<Option<f64>> = read.collect();
        let mut visibility = GrayImage::new(picture.width(), picture.height());
        for (pixel, value) in visibility.pixels_mut().zip(&read) {
            let value = value.unwrap_or(1.0).clamp(0.0, 1.0);
            *pixel = Luma([(255.0 * value).round() as u8]);
        }
        Self {
            visibility,
            known: read.iter().map(Option::is_some).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use image::Rgb;

    use super::*;

    fn picture(pixels: &[[u8; 3]]) -> RgbImage {
        RgbImage::from_fn(pixels.len() as u32, 1, |x, _| Rgb(pixels[x as usize]))
    }

    #[test]
    fn a_pixel_lies_between_lit_and_dark() {
        let lit = picture(&[[200, 100, 50]; 4]);
        let dark = picture(&[[40, 20, 10]; 4]);
        let mine = picture(&[[200, 100, 50], [40, 20, 10], [120, 60, 30], [255, 140, 70]]);
        let shadows = Shadows::between(&mine, &lit, &dark);
        assert_eq!(shadows.visibility.as_raw(), &[255, 0, 128, 255]);
        assert_eq!(shadows.known, [true; 4]);
    }

    #[test]
    fn where_the_light_changes_nothing_there_is_nothing_to_read() {
        let lit = picture(&[[40, 20, 10], [60, 20, 10]]);
        let dark = picture(&[[40, 20, 10], [40, 20, 10]]);
        let shadows = Shadows::between(&dark, &lit, &dark);
        assert_eq!(shadows.known, [false, true]);
        assert_eq!(shadows.visibility.as_raw(), &[255, 0]);
    }

    #[test]
    fn a_ratio_does_not_see_the_shading() {
        let off = picture(&[[200, 200, 200], [100, 60, 40], [240, 10, 10], [3, 3, 3]]);
        let on = picture(&[[200, 200, 200], [30, 18, 12], [72, 3, 3], [1, 1, 1]]);
        let shadows = Shadows::ratio(&on, &off);
        assert_eq!(shadows.visibility.as_raw(), &[255, 0, 0, 255]);
        assert_eq!(shadows.known, [true, true, true, false]);
        // Without shadows everything is lit.
        let shadows = Shadows::ratio(&off, &off);
        assert_eq!(shadows.visibility.as_raw(), &[255; 4]);
    }
}
