//! Pictures for textures: PNG and JPEG of every kind, as RGB with 8 bits each, and alpha: opaque where a file has none.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits, RgbaImage};

use super::reading;
use crate::{Error, Result};

/// The largest texture that today's drivers take.
const MOST_SIDE: u32 = 16_384;
/// What all pictures of a scene may take in memory, and what the decoder may take for one.
pub const MOST_BYTES: u64 = 1 << 30;

/// A picture in memory, which messages call `path`; `room` is the most bytes that it may have as RGBA.
pub fn decode(path: &Path, bytes: &[u8], room: u64) -> Result<RgbaImage> {
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
    let needed = 4 * u64::from(width) * u64::from(height);
    if needed > room {
        return Err(wrong(format!(
            "found {width}×{height} pixels, which take {} MiB, expected at most {} MiB here",
            needed >> 20,
            room >> 20
        )));
    }
    let mut reader = reader();
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    Ok(reader.decode().map_err(damaged)?.into_rgba8())
}

/// A picture from a file that nobody has checked.
pub fn load(path: &Path) -> Result<RgbaImage> {
    decode(
        path,
        &reading::read(path, reading::PICTURE_LIMIT)?,
        MOST_BYTES,
    )
}

/// What a picture takes in memory.
pub fn bytes(picture: &RgbaImage) -> u64 {
    picture.as_raw().len() as u64
}

#[cfg(test)]
mod tests {
    use image::{DynamicImage, ExtendedColorType};

    use super::*;

    fn written(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn every_kind_becomes_rgb_and_alpha() {
        let grey = DynamicImage::from(image::GrayImage::from_pixel(3, 2, image::Luma([200])));
        let decoded = |bytes: &[u8]| decode(Path::new("a.png"), bytes, MOST_BYTES).unwrap();
        for kind in [
            grey.clone(),
            grey.to_luma_alpha8().into(),
            grey.to_luma16().into(),
            grey.to_luma_alpha16().into(),
            grey.to_rgb8().into(),
            grey.to_rgba8().into(),
            grey.to_rgb16().into(),
            grey.to_rgba16().into(),
        ] {
            let picture = decoded(&written(&kind, ImageFormat::Png));
            let kind = ExtendedColorType::from(kind.color());
            assert_eq!(picture.dimensions(), (3, 2), "{kind:?}");
            let opaque = |pixel: &image::Rgba<u8>| pixel.0 == [200, 200, 200, 255];
            assert!(picture.pixels().all(opaque), "{kind:?}");
        }
        for kind in [grey.clone(), grey.to_rgb8().into()] {
            let picture = decoded(&written(&kind, ImageFormat::Jpeg));
            let near = |pixel: &image::Rgba<u8>| pixel.0[..3].iter().all(|b| b.abs_diff(200) <= 2);
            assert!(
                picture
                    .pixels()
                    .all(|pixel| near(pixel) && pixel.0[3] == 255)
            );
        }
    }

    #[test]
    fn alpha_is_kept() {
        let mut picture = RgbaImage::from_pixel(2, 1, image::Rgba([10, 20, 30, 255]));
        picture.put_pixel(1, 0, image::Rgba([40, 50, 60, 70]));
        let bytes = written(&picture.clone().into(), ImageFormat::Png);
        let decoded = decode(Path::new("a.png"), &bytes, MOST_BYTES).unwrap();
        assert_eq!(decoded, picture);
    }

    #[test]
    fn a_palette_becomes_colors() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(vec![1, 2, 3, 40, 50, 60]);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[1, 0]).unwrap();
        writer.finish().unwrap();
        let picture = decode(Path::new("a.png"), &bytes, MOST_BYTES).unwrap();
        assert_eq!(picture.as_raw(), &[40, 50, 60, 255, 1, 2, 3, 255]);
    }

    #[test]
    fn pictures_have_room_in_common() {
        let bytes = written(&DynamicImage::new_rgb8(10, 10), ImageFormat::Png);
        assert!(decode(Path::new("a.png"), &bytes, 400).is_ok());
        let error = decode(Path::new("a.png"), &bytes, 399).unwrap_err();
        assert!(error.to_string().contains("10×10 pixels"), "{error}");
    }
}
