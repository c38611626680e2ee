//! A student's picture from a file.

use std::path::Path;

use image::{DynamicImage, RgbImage, imageops};
use shadowlab::scene::{reading, texture};
use shadowlab::{Error, Result};

/// What a picture may take in memory: 8192×8192 pixels, which is more than any screen has.
const MOST_BYTES: u64 = 4 << 26;

/// A picture, as far as it is asked for.
pub struct Loaded {
    pub picture: RgbImage,
    pub is_jpeg: bool,
    /// What is odd about it.
    pub notes: Vec<String>,
}

/// Reads a picture, or the part of it that `crop` names: x, y, width and height in pixels.
pub fn load(path: &Path, crop: Option<[u32; 4]>) -> Result<Loaded> {
    let bytes = reading::read(path, reading::PICTURE_LIMIT)?;
    let picture = texture::decode(path, &bytes, MOST_BYTES)?;
    if is_jpeg(&bytes) && is_cut_off(&bytes) {
        let message = "found a JPEG that is cut off, expected a whole one";
        return Err(Error::input(path, None, message));
    }
    let mut notes = Vec::new();
    if picture.pixels().any(|pixel| pixel.0[3] < 255) {
        notes.push(format!(
            "{}: its alpha is left out: a window shows the colors without it",
            path.display()
        ));
    }
    let mut picture = DynamicImage::from(picture).into_rgb8();
    if let Some([x, y, width, height]) = crop {
        let [right, bottom] =
            [[x, width], [y, height]].map(|[from, size]| from.saturating_add(size));
        if right > picture.width() || bottom > picture.height() {
            return Err(Error::usage(format!(
                "--crop {x},{y},{width}x{height}: {} has {}×{} pixels",
                path.display(),
                picture.width(),
                picture.height()
            )));
        }
        picture = imageops::crop_imm(&picture, x, y, width, height).to_image();
    }
    Ok(Loaded {
        picture,
        is_jpeg: is_jpeg(&bytes),
        notes,
    })
}

fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xff, 0xd8])
}

/// A JPEG ends with a marker of its own, behind the last of those that begin a scan; decoders fill up what is missing.
fn is_cut_off(bytes: &[u8]) -> bool {
    const SCAN: [u8; 2] = [0xff, 0xda];
    const END: [u8; 2] = [0xff, 0xd9];
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    last(END) < last(SCAN)
}
