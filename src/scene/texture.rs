//! Pictures for textures: PNG and JPEG of every kind, as RGB with 8 bits each.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits, RgbImage};

use super::reading;
use crate::{Error, Result};

/// The largest texture that today's drivers take.
const MOST_SIDE: u32 = 16_384;
/// What all pictures of a scene may take in memory, and what the decoder may take for one.
pub const MOST_BYTES: u64 = 1 << 30;

/// A picture in memory, which messages call `path`; `room` is the most bytes that it may have as RGB.
pub fn decode(path: &Path, bytes: &[u8], room: u64) -> Result<RgbImage> {
    let wrong = |message: String| Error::input(path, None, message);
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        _ => return Err(wrong("found no picture, expected a PNG or JPEG".into())),
    };
    let damaged = |cause| {
        wrong(format!(
            "found no picture ({cause}), expected a PNG or JPEG"
        ))
    };
    let reader = || ImageReader::with_format(Cursor::new(bytes), format);

    // The header tells the size: a file of a few bytes can announce gigabytes of one colour.
    let (width, height) = reader().into_dimensions().map_err(damaged)?;
    if width.max(height) > MOST_SIDE {
        return Err(wrong(format!(
            "found {width}×{height} pixels, expected at most {MOST_SIDE}×{MOST_SIDE}"
        )));
    }
    if 3 * u64::from(width) * u64::from(height) > room {
        return Err(wrong(format!(
            "found {width}×{height} pixels more, expected at most {} MiB of pictures in a scene",
            MOST_BYTES >> 20
        )));
    }
    let mut reader = reader();
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    Ok(reader.decode().map_err(damaged)?.into_rgb8())
}

/// A picture from a file that nobody has checked.
pub fn load(path: &Path) -> Result<RgbImage> {
    decode(
        path,
        &reading::read(path, reading::PICTURE_LIMIT)?,
        MOST_BYTES,
    )
}

/// What a picture takes in memory.
pub fn bytes(picture: &RgbImage) -> u64 {
    picture.as_raw().len() as u64
}
