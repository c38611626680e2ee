//! What happens to a picture on its way from one program to another.

use std::io::Cursor;

use image::codecs::jpeg::JpegEncoder;
use image::imageops::{self, FilterType};
use image::{ImageFormat, Rgb, RgbImage};
use shadowlab::compare::{TOLERANCE, TOLERANCE_OF_JPEG};

/// What happens to a picture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Perturbed {
    Not,
    Jpeg,
    Smaller,
    Larger,
    Darkened,
    Brightened,
    Tinted,
}

/// As drawn, and then every perturbation.
pub const ALL: [Perturbed; 7] = [
    Perturbed::Not,
    Perturbed::Jpeg,
    Perturbed::Smaller,
    Perturbed::Larger,
    Perturbed::Darkened,
    Perturbed::Brightened,
    Perturbed::Tinted,
];
/// Another filter than the one that `compare` scales with: nobody knows which one a picture went through.
const SCALING: FilterType = FilterType::Triangle;
const QUALITY: u8 = 85;
/// In levels of 255, each way.
pub const MOST_TINT: i16 = 8;

impl Perturbed {
    pub fn name(self) -> &'static str {
        match self {
            Self::Not => "as drawn",
            Self::Jpeg => "JPEG, quality 85",
            Self::Smaller => "scaled by 0.75",
            Self::Larger => "scaled by 1.5",
            Self::Darkened => "gamma 2.2",
            Self::Brightened => "gamma 1/2.2",
            Self::Tinted => "a tint of up to 8 levels",
        }
    }

    /// What `compare` allows such a picture, in levels of 255.
    pub fn tolerance(self) -> u8 {
        match self {
            Self::Jpeg => TOLERANCE_OF_JPEG,
            _ => TOLERANCE,
        }
    }

    /// The size that the lab is drawn at for it.
    pub fn size(self, size: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Smaller => size.map(|side| side * 3 / 4),
            Self::Larger => size.map(|side| side * 3 / 2),
            _ => size,
        }
    }

    /// The picture after it has happened; `tint` in levels of 255.
    pub fn of(self, picture: &RgbImage, tint: [i16; 3]) -> RgbImage {
        let size = picture.dimensions().into();
        let mapped = |change: &dyn Fn(usize, u8) -> u8| {
            let mut changed = picture.clone();
            for Rgb(channels) in changed.pixels_mut() {
                *channels = [0, 1, 2].map(|i| change(i, channels[i]));
            }
            changed
        };
        let gamma = |power: f64| {
            mapped(&|_, value| (255.0 * (f64::from(value) / 255.0).powf(power)).round() as u8)
        };
        match self {
            Self::Not => picture.clone(),
            Self::Jpeg => {
                let mut bytes = Cursor::new(Vec::new());
                let encoder = JpegEncoder::new_with_quality(&mut bytes, QUALITY);
                picture
                    .write_with_encoder(encoder)
                    .expect("memory takes every picture");
                image::load_from_memory_with_format(bytes.get_ref(), ImageFormat::Jpeg)
                    .expect("it was written so")
                    .into_rgb8()
            }
            Self::Smaller | Self::Larger => {
                let [width, height] = self.size(size);
                imageops::resize(picture, width, height, SCALING)
            }
            Self::Darkened => gamma(2.2),
            Self::Brightened => gamma(1.0 / 2.2),
            Self::Tinted => mapped(&|i, value| (i16::from(value) + tint[i]).clamp(0, 255) as u8),
        }
    }
}
