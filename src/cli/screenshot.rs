//! `shadowlab screenshot`: a lab's picture, or what else there is to see of it, in a file.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use shadowlab::headless::Choice;
use shadowlab::labs::{self, Show};
use shadowlab::{Result, gl, picture};

use super::changes::Changes;
use super::state::{Drawing, Running, State};
use super::values::check_light;
use super::{gallery, print};

#[derive(Args)]
pub struct Screenshot {
    /// The lab's name, as `shadowlab labs` lists it
    #[arg(required_unless_present = "all")]
    lab: Option<String>,
    #[command(flatten)]
    changes: Changes,
    #[command(flatten)]
    drawing: Drawing,
    /// The file to write [default: LAB.png]
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// What the picture shows
    #[arg(long, value_enum, default_value_t = Shown::Picture)]
    show: Shown,
    /// Which of the lab's lights, for visibility and the maps
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
    /// Draw every lab in every stage of its handout into this folder, with an index page
    #[arg(long, value_name = "DIR", conflicts_with_all = [
        "lab", "output", "show", "light", "scene", "set", "keys", "time", "glsl", "mistake", "frames", "timings",
    ])]
    all: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Shown {
    /// The lab's picture
    Picture,
    /// 255 lit, 0 in shadow by the lab's own test, 255 where there is no surface
    Visibility,
    /// The depth map for the eye: black near, white far; by distance, or by depth where the handout says so
    ShadowMap,
    /// The depth texture as it is: 16-bit PNG, or 32-bit floats if the file ends in .pfm
    DepthRaw,
}

impl Screenshot {
    pub fn run(self) -> Result<()> {
        let written = match &self.all {
            Some(folder) => gallery::write(folder, self.changes.size, &self.drawing.device)?,
            None => self.write()?,
        };
        print(&format!("{}\n", written.display()))
    }

    pub fn changes(&self) -> &Changes {
        &self.changes
    }

    /// Another size, if one is given, and another renderer.
    pub fn draw_on(&mut self, size: Option<[u32; 2]>, device: &Choice) {
        self.changes.size = size.or(self.changes.size);
        self.drawing.device = device.clone();
    }

    /// Returns the file's name.
    pub fn write(self) -> Result<PathBuf> {
        let state = State {
            lab: self.lab.expect("clap asks for it"),
            changes: self.changes,
        };
        let handout = labs::find(&state.lab)?;
        check_light(handout, self.light)?;
        let output = self.output;
        let output = output.unwrap_or_else(|| format!("{}.png", handout.name).into());
        picture::check_name(
            &output,
            if self.show == Shown::DepthRaw {
                &["png", "pfm"]
            } else {
                &["png"]
            },
        )?;

        let mut running = state.start(&self.drawing, &[], false)?;
        running.write(self.drawing.frames, self.show, self.light, &output)?;
        running.timings.lap("file");
        Ok(output)
    }
}

impl Running {
    fn write(&mut self, frames: u32, shown: Shown, light: usize, output: &Path) -> Result<()> {
        let notes = picture::notes(&self.context.renderer);
        if shown == Shown::Visibility {
            let pixels = self.visibility(frames, light)?.visibility;
            self.timings.lap("frames");
            return picture::write_grey(output, &pixels, &notes);
        }
        self.draw(frames, Show::Picture)?;
        let gl = &self.context.gl;
        match shown {
            Shown::Picture | Shown::Visibility => {
                let pixels = gl::read_rgb(gl, self.size);
                self.timings.lap("frames");
                picture::write_rgb(output, &pixels, &notes)
            }
            Shown::ShadowMap | Shown::DepthRaw => {
                let map = self.lab.shadow_texture(light)?;
                let scale = map.scale;
                let depths = gl::read_depths(gl, map.texture, [scale.size; 2]);
                self.timings.lap("frames");
                if shown == Shown::DepthRaw {
                    return picture::write_depths(output, &depths, &notes);
                }
                let projection = self.lab.grey().of(scale.projection);
                picture::write_grey(
                    output,
                    &depths.linearised(projection, scale.near, scale.far),
                    &notes,
                )
            }
        }
    }
}
