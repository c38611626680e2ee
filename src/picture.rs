//! Pictures and depth maps, in memory and in files. Row 0 is the top row.
//!
//! A file is written beside its final name and then renamed: what is there is always whole.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::{Error, Result};

/// What a written PNG says of itself, in text chunks: keyword and text.
pub type Notes<'a> = &'a [(&'a str, String)];

/// The notes of every picture that a lab has drawn.
pub fn notes(renderer: &str) -> [(&'static str, String); 2] {
    let version = env!("CARGO_PKG_VERSION");
    [
        ("Software", format!("shadowlab {version}")),
        ("Renderer", renderer.to_owned()),
    ]
}

/// How a stored depth grows with the distance from the light's plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// As 1 − near/distance: most of the depths are near the camera.
    Perspective,
    /// Evenly.
    Orthographic,
}

/// What the grey of a depth map stands for, from black to white.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grey {
    /// The distance from the light's plane, from near to far.
    Distance,
    /// The depth as it is stored, which is −1…1 in clipping space.
    Depth,
}

impl Grey {
    /// What a map's projection is to be taken for, so that its depths become this grey.
    pub fn of(self, projection: Projection) -> Projection {
        match self {
            Self::Distance => projection,
            // Depths that are even already are left as they are.
            Self::Depth => Projection::Orthographic,
        }
    }
}

/// Depths as the driver stores them, 0 at the near plane and 1 at the far plane.
#[derive(Clone, Debug)]
pub struct DepthMap {
    pub size: [u32; 2],
    pub depths: Vec<f32>,
}

impl DepthMap {
    /// For the eye: the distance from the light's plane, linear in 0…255 from near to far.
    pub fn linearised(&self, projection: Projection, near: f64, far: f64) -> image::GrayImage {
        let grey = |&depth: &f32| match projection {
            Projection::Perspective => {
                let ndc = 2.0 * f64::from(depth) - 1.0;
                let distance = 2.0 * near * far / (far + near - ndc * (far - near));
                (255.0 * (distance - near) / (far - near)).round() as u8
            }
            Projection::Orthographic => (255.0 * f64::from(depth)).round() as u8,
        };
        let pixels = self.depths.iter().map(grey).collect();
        image::GrayImage::from_raw(self.size[0], self.size[1], pixels).expect("one depth a texel")
    }
}

pub fn write_rgb(path: &Path, picture: &image::RgbImage, notes: Notes) -> Result<()> {
    let size = [picture.width(), picture.height()];
    write_png(path, size, PngKind::Rgb8, picture.as_raw(), notes)
}

pub fn write_grey(path: &Path, picture: &image::GrayImage, notes: Notes) -> Result<()> {
    let size = [picture.width(), picture.height()];
    write_png(path, size, PngKind::Grey8, picture.as_raw(), notes)
}

/// The depth texture for other programs: 16-bit PNG, or 32-bit floats where the name ends in `.pfm`.
///
/// Behind its three lines of header a PFM holds the bottom row first and little-endian floats: on such a
/// machine, byte for byte what `glGetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, …)` returns.
pub fn write_depths(path: &Path, map: &DepthMap, notes: Notes) -> Result<()> {
    let [width, height] = map.size;
    if path.extension().is_some_and(|ending| ending == "pfm") {
        return write_whole(path, |file| {
            write!(file, "Pf\n{width} {height}\n-1.0\n")?;
            for row in map.depths.chunks_exact(width as usize).rev() {
                for depth in row {
                    file.write_all(&depth.to_le_bytes())?;
                }
            }
            Ok(())
        });
    }
    let words = map.depths.iter().flat_map(|&depth| {
        let word = (f64::from(depth) * 65535.0).round() as u16;
        word.to_be_bytes()
    });
    let bytes: Vec<u8> = words.collect();
    write_png(path, map.size, PngKind::Grey16, &bytes, notes)
}

#[derive(Clone, Copy)]
enum PngKind {
    Rgb8,
    Grey8,
    Grey16,
}

fn write_png(path: &Path, size: [u32; 2], kind: PngKind, bytes: &[u8], notes: Notes) -> Result<()> {
    write_whole(path, |file| {
        let mut encoder = png::Encoder::new(file, size[0], size[1]);
        let (color, depth) = match kind {
            PngKind::Rgb8 => (png::ColorType::Rgb, png::BitDepth::Eight),
            PngKind::Grey8 => (png::ColorType::Grayscale, png::BitDepth::Eight),
            PngKind::Grey16 => (png::ColorType::Grayscale, png::BitDepth::Sixteen),
        };
        encoder.set_color(color);
        encoder.set_depth(depth);
        encoder.set_compression(png::Compression::Fast);
        for (keyword, text) in notes {
            encoder.add_itxt_chunk((*keyword).to_owned(), text.clone())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()?;
        Ok(())
    })
}

/// The name of a file to write must end as one of the kinds that can be written.
pub fn check_name(path: &Path, endings: &[&str]) -> Result<()> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    if ending.is_some_and(|ending| endings.contains(&ending)) {
        return Ok(());
    }
    let expected = endings.join(" or .");
    Err(Error::usage(format!(
        "{}: expected the name of a file that ends in .{expected}",
        path.display()
    )))
}

/// Writes a file as a whole or not at all: beside its name first, then renamed.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<()> {
    let name = path
        .file_name()
        .ok_or_else(|| Error::usage(format!("{}: expected the name of a file", path.display())))?;
    if path.is_dir() {
        return Err(Error::usage(format!(
            "{}: is a directory, expected the name of a file",
            path.display()
        )));
    }
    let mut part_name = name.to_owned();
    part_name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(part_name);

    let written = File::create(&part).and_then(|file| {
        let mut file = BufWriter::new(file);
        write(&mut file)?;
        file.flush()
    });
    written
        .and_then(|()| std::fs::rename(&part, path))
        .map_err(|cause| {
            // Nothing half-written stays behind; the first error is the one to tell.
            let _ = std::fs::remove_file(&part);
            Error::writing(path, cause)
        })
}
