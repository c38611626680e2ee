//! A picture of mistakes, made small without losing one.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, Rgb, RgbImage};

use crate::measure::{FALSE_LIGHT, FALSE_SHADOW};

/// Several stand side by side on a page.
const WIDTH: u32 = 260;

/// At most [`WIDTH`] pixels wide, as a PNG.
pub fn png(mistakes: &RgbImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let written = reduced(mistakes).write_to(&mut bytes, ImageFormat::Png);
    written.expect("a picture in memory can be written to memory");
    bytes.into_inner()
}

/// A picture that stands in the page itself.
pub fn data_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// Each pixel stands for a square of the picture: it is a mistake where the square has one, however small.
fn reduced(mistakes: &RgbImage) -> RgbImage {
    let step = mistakes.width().div_ceil(WIDTH);
    let [width, height] = [mistakes.width(), mistakes.height()].map(|n| n.div_ceil(step));
    RgbImage::from_fn(width, height, |x, y| {
        let square = (y * step..((y + 1) * step).min(mistakes.height())).flat_map(|y| {
            let columns = x * step..((x + 1) * step).min(mistakes.width());
            columns.map(move |x| *mistakes.get_pixel(x, y))
        });
        let square: Vec<Rgb<u8>> = square.collect();
        let worst = [FALSE_SHADOW, FALSE_LIGHT]
            .into_iter()
            .find(|wrong| square.contains(wrong));
        worst.unwrap_or(square[0])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_wrong_pixel_stays() {
        let grey = Rgb([215; 3]);
        let mut mistakes = RgbImage::from_pixel(801, 3, grey);
        mistakes.put_pixel(800, 2, FALSE_LIGHT);
        mistakes.put_pixel(1, 1, FALSE_SHADOW);
        let small = reduced(&mistakes);
        assert_eq!(small.dimensions(), (201, 1));
        assert_eq!(*small.get_pixel(200, 0), FALSE_LIGHT);
        assert_eq!(*small.get_pixel(0, 0), FALSE_SHADOW);
        assert_eq!(*small.get_pixel(100, 0), grey);
    }
}
