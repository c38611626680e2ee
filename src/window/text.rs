//! Letters into an image: blocks of lines on a dark, translucent ground.

use image::{Rgba, RgbaImage};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// What a block stands on: dark and translucent, and red where something went wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ground {
    Plain,
    Wrong,
}

impl Ground {
    fn colour(self) -> Rgba<u8> {
        match self {
            Self::Plain => Rgba([12, 14, 20, 205]),
            Self::Wrong => Rgba([96, 10, 16, 230]),
        }
    }
}

const INK: [u8; 3] = [240, 240, 235];

/// The letters of an ordinary screen, or those of a HiDPI one, where an ordinary letter would be too small to read.
#[derive(Clone, Copy, Debug)]
pub struct Letters {
    /// Of a line, in pixels.
    pub height: u32,
    pub width: u32,
    raster: RasterHeight,
}

impl Letters {
    /// `scale` is how many pixels of the screen a logical pixel has, along one side.
    pub fn new(scale: f64) -> Self {
        let raster = if scale < 1.5 {
            RasterHeight::Size16
        } else {
            RasterHeight::Size32
        };
        Self {
            height: raster.val() as u32 * 9 / 8,
            width: get_raster_width(FontWeight::Regular, raster) as u32,
            raster,
        }
    }

    /// The space around the lines of a block, in pixels.
    pub fn margin(&self) -> u32 {
        self.height / 3
    }

    /// How many letters fit beside each other into a block of this width.
    pub fn columns(&self, width: u32) -> usize {
        (width.saturating_sub(2 * self.margin()) / self.width) as usize
    }

    /// The size of a block of lines, in pixels.
    pub fn block(&self, lines: &[String]) -> [u32; 2] {
        let columns = lines.iter().map(|line| line.chars().count()).max();
        [
            columns.unwrap_or(0) as u32 * self.width + 2 * self.margin(),
            lines.len() as u32 * self.height + 2 * self.margin(),
        ]
    }

    /// Writes a block whose top left corner is at `place`; what does not fit into the image is left out.
    pub fn write(&self, image: &mut RgbaImage, place: [u32; 2], lines: &[String], ground: Ground) {
        let [width, height] = self.block(lines);
        let right = (place[0] + width).min(image.width());
        let bottom = (place[1] + height).min(image.height());
        for y in place[1]..bottom {
            for x in place[0]..right {
                image.put_pixel(x, y, ground.colour());
            }
        }
        for (row, line) in lines.iter().enumerate() {
            let top = place[1] + self.margin() + row as u32 * self.height;
            for (column, letter) in line.chars().enumerate() {
                let left = place[0] + self.margin() + column as u32 * self.width;
                self.write_letter(image, [left, top], letter);
            }
        }
    }

    fn write_letter(&self, image: &mut RgbaImage, [left, top]: [u32; 2], letter: char) {
        let raster = |letter| get_raster(letter, FontWeight::Regular, self.raster);
        let Some(raster) = raster(letter).or_else(|| raster('?')) else {
            return;
        };
        for (y, row) in (top..image.height()).zip(raster.raster()) {
            for (x, &ink) in (left..image.width()).zip(row.iter()) {
                let share = f64::from(ink) / 255.0;
                let mix = |from: u8, to: u8| {
                    (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as u8
                };
                let Rgba([red, green, blue, alpha]) = *image.get_pixel(x, y);
                let [r, g, b] = INK;
                let mixed = [mix(red, r), mix(green, g), mix(blue, b), mix(alpha, 255)];
                image.put_pixel(x, y, Rgba(mixed));
            }
        }
    }
}

/// Breaks a text between words into lines of at most `columns` letters; all but the first are indented.
/// A word that is longer than a line is broken where the line ends.
pub fn wrap(text: &str, columns: usize, indent: usize) -> Vec<String> {
    let columns = columns.max(1);
    let indent = " ".repeat(indent.min(columns / 2));
    let mut lines = Vec::new();
    let mut line: Vec<char> = Vec::new();
    let mut empty = 0;
    for word in text.split_inclusive(' ') {
        let mut word: Vec<char> = word.chars().collect();
        let letters = word.iter().filter(|c| **c != ' ').count();
        while line.len() + letters.min(word.len()) > columns {
            if line.len() <= empty {
                let rest = word.split_off(columns - line.len());
                line.append(&mut std::mem::replace(&mut word, rest));
            }
            lines.push(line);
            line = indent.chars().collect();
            empty = line.len();
        }
        line.extend(word);
    }
    lines.push(line);
    let text = |line: Vec<char>| line.iter().collect::<String>().trim_end().to_owned();
    lines.into_iter().map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_between_words() {
        assert_eq!(wrap("one two three", 8, 2), ["one two", "  three"]);
        assert_eq!(wrap("one two", 80, 2), ["one two"]);
        assert_eq!(wrap("verylongword", 4, 1), ["very", " lon", " gwo", " rd"]);
        assert_eq!(wrap("a", 0, 2), ["a"]);
    }

    #[test]
    fn letters_are_drawn_and_what_does_not_fit_is_left_out() {
        for scale in [1.0, 2.0] {
            let letters = Letters::new(scale);
            let mut image = RgbaImage::new(40, 40);
            letters.write(
                &mut image,
                [0, 0],
                &["×ä?\u{1F980}W".repeat(20)],
                Ground::Plain,
            );
            assert!(
                image.pixels().any(|pixel| pixel.0[0] > 200),
                "scale {scale}"
            );
        }
    }
}
