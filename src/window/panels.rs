//! What stands over the picture: the keys, a message, the depth map.

use image::RgbaImage;

use super::keys;
use super::stage::Stage;
use super::text::{Ground, Letters, wrap};
use crate::Result;
use crate::gl::{Area, Overlay};
use crate::labs::{Handout, Lab};

/// What is to be seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    pub help: bool,
    /// The light whose depth map is shown, from 1.
    pub depth_map: Option<usize>,
    /// What went wrong, until it goes well again.
    pub message: Option<String>,
}

#[derive(PartialEq)]
struct Block {
    /// Its top left corner.
    place: [u32; 2],
    lines: Vec<String>,
    ground: Ground,
}

/// A sheet's texts, and what else decides how it looks.
#[derive(PartialEq)]
struct Sheet {
    size: [u32; 2],
    letter_height: u32,
    blocks: Vec<Block>,
}

pub struct Panels {
    overlay: Overlay,
    /// The sheet that the driver has.
    sheet: Option<Sheet>,
}

impl Panels {
    pub fn new(gl: &glow::Context) -> Result<Self> {
        Ok(Self {
            overlay: Overlay::new(gl)?,
            sheet: None,
        })
    }

    /// Draws over the picture that the lab has just drawn.
    pub fn draw(&mut self, gl: &glow::Context, shown: &Shown, stage: &Stage, scale: f64) {
        let (handout, lab, size) = (stage.handout, stage.lab.as_ref(), stage.size());
        let letters = Letters::new(scale);
        let columns = letters.columns(size[0]);
        let mut blocks = Vec::new();

        // From the top left downwards.
        let mut top = 0;
        let mut stack = |lines: Vec<String>, ground| {
            let [_, height] = letters.block(&lines);
            let place = [0, top];
            blocks.push(Block {
                place,
                lines,
                ground,
            });
            top += height;
        };
        if let Some(message) = &shown.message {
            stack(wrap(message, columns, 2), Ground::Wrong);
        }
        if shown.help {
            stack(help(handout, columns), Ground::Plain);
        }

        if let Some(light) = shown.depth_map {
            blocks.push(self.draw_inset(gl, lab, light, size, letters));
        }

        if blocks.is_empty() {
            return;
        }
        let sheet = Sheet {
            size,
            letter_height: letters.height,
            blocks,
        };
        if self.sheet.as_ref() != Some(&sheet) {
            let mut image = RgbaImage::new(size[0], size[1]);
            for block in &sheet.blocks {
                letters.write(&mut image, block.place, &block.lines, block.ground);
            }
            self.overlay.set_sheet(gl, &image);
            self.sheet = Some(sheet);
        }
        self.overlay.draw_sheet(gl);
    }

    /// Draws the light's depth map at the bottom right; returns what is to be written below it.
    fn draw_inset(
        &self,
        gl: &glow::Context,
        lab: &dyn Lab,
        light: usize,
        size: [u32; 2],
        letters: Letters,
    ) -> Block {
        let map = lab.shadow_texture(light);
        let text = match &map {
            Ok(map) => format!(
                "light {light}: near {} (black), far {} (white)",
                short(map.scale.near),
                short(map.scale.far)
            ),
            Err(error) => error.to_string(),
        };
        let lines = wrap(&text, letters.columns(size[0]), 0);
        let [width, height] = letters.block(&lines);
        if let Ok(map) = map {
            let side = size[0].min(size[1].saturating_sub(height)) / 3;
            let area = Area {
                left: size[0] - side,
                bottom: height,
                size: [side, side],
            };
            self.overlay.draw_inset(
                gl,
                map.texture,
                lab.grey().of(map.scale.projection),
                [map.scale.near, map.scale.far],
                area,
            );
        }
        Block {
            place: [
                size[0].saturating_sub(width),
                size[1].saturating_sub(height),
            ],
            lines,
            ground: Ground::Plain,
        }
    }
}

/// A number to four digits.
fn short(number: f64) -> f64 {
    let text = format!("{number:.3e}");
    text.parse().expect("a number that was just written")
}

/// The lab's keys and the viewer's own, in two columns where there is room for them.
fn help(handout: &Handout, columns: usize) -> Vec<String> {
    let all = || handout.keys.iter().chain(&keys::OWN);
    let widest = all().map(|(keys, _)| keys.chars().count()).max();
    let first = widest.unwrap_or(0) + 2;
    let line = |(keys, help): &(&str, &str)| {
        if columns >= 2 * first {
            wrap(&format!("{keys:first$}{help}"), columns, first)
        } else {
            wrap(&format!("{keys}: {help}"), columns, 4)
        }
    };
    all().flat_map(line).collect()
}
