//! `shadowlab truth` and `shadowlab measure`: the ground truth of a lab's scene, and the lab's picture against it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use image::{GrayImage, Rgb, RgbImage};
use serde_json::json;
use shadowlab::compare::Shadows;
use shadowlab::gl;
use shadowlab::ground_truth::{Label, Rays, Truth};
use shadowlab::labs::{self, MapScale, Show};
use shadowlab::measure::{Measure, only_known};
use shadowlab::progress::Progress;
use shadowlab::scene::texture;
use shadowlab::{Error, Result, picture};

use super::changes::Changes;
use super::print;
use super::state::{Drawing, Running, State};
use super::values::check_light;

#[derive(Args)]
pub struct TruthCommand {
    #[command(flatten)]
    state: State,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    output: Output,
}

#[derive(Args)]
pub struct MeasureCommand {
    #[command(flatten)]
    state: State,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    output: Output,
    /// Measure this visibility picture (255 lit, 0 in shadow) in place of the lab's own
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
}

#[derive(Args)]
struct Output {
    /// The picture to write: for truth the mask, for measure the mistakes
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Which of the lab's lights
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
}

impl Output {
    fn check(&self, lab: &str) -> Result<()> {
        check_light(labs::find(lab)?, self.light)?;
        self.output
            .iter()
            .try_for_each(|path| picture::check_name(path, &["png"]))
    }
}

/// The truth of a running lab's present state, and how long it took.
struct Asked {
    rays: Rays,
    truth: Truth,
    seconds: f64,
}

fn ask(running: &Running, light: usize) -> Result<Asked> {
    running.lab.check_light(light)?;
    let start = Instant::now();
    let rays = Rays::new(&running.lab.now(), light - 1);
    let progress = Progress::new("casting rays", running.size[1].into());
    let truth = rays.truth_row_by_row(running.size, || progress.add(1));
    Ok(Asked {
        rays,
        truth,
        seconds: start.elapsed().as_secs_f64(),
    })
}

impl Asked {
    /// Millions of rays a second, the tree's building counted in.
    fn rate(&self) -> f64 {
        self.truth.rays as f64 / self.seconds / 1e6
    }

    fn speed(&self) -> String {
        format!(
            "{:.1} million rays in {:.2} s: {:.1} million a second\n",
            self.truth.rays as f64 / 1e6,
            self.seconds,
            self.rate()
        )
    }
}

impl TruthCommand {
    pub fn changes(&self) -> &Changes {
        &self.state.changes
    }

    pub fn run(&self) -> Result<()> {
        self.output.check(&self.state.lab)?;
        self.state.changes.refuse_mistake("truth")?;
        let running = self.state.start(&self.drawing, &[], false)?;
        let asked = ask(&running, self.output.light)?;
        let truth = &asked.truth;
        let edges = truth.edges();
        if let Some(path) = &self.output.output {
            picture::write_rgb(path, &mask(truth, &edges), &[])?;
        }
        let [lit, shadowed, not_valid] =
            [Label::Lit, Label::Shadowed, Label::NotValid].map(|label| truth.count(label));
        let count = |flags: &[bool]| flags.iter().filter(|flag| **flag).count();
        let (ambiguous, edges) = (count(&truth.ambiguous), count(&edges));
        print(&if self.output.json {
            format!(
                "{:#}\n",
                json!({
                    "lab": self.state.lab, "width": truth.size[0], "height": truth.size[1],
                    "lit": lit, "shadowed": shadowed, "not_valid": not_valid,
                    "ambiguous": ambiguous, "edges": edges,
                    "rays": truth.rays, "seconds": asked.seconds,
                })
            )
        } else {
            format!(
                "lit {lit}, shadowed {shadowed}, not valid {not_valid}; ambiguous {ambiguous}; \
                 within a pixel of a change {edges}\n{}",
                asked.speed()
            )
        })
    }
}

/// Lit light grey, shadowed dark grey, not valid white; edges darker or lighter, ambiguous orange.
fn mask(truth: &Truth, edges: &[bool]) -> RgbImage {
    let [width, height] = truth.size;
    RgbImage::from_fn(width, height, |x, y| {
        let i = (y * width + x) as usize;
        Rgb(match (truth.labels[i], truth.ambiguous[i], edges[i]) {
            (_, true, _) => [255, 150, 0],
            (Label::NotValid, ..) => [255, 255, 255],
            (Label::Lit, _, true) => [190, 190, 190],
            (Label::Lit, ..) => [215, 215, 215],
            (Label::Shadowed, _, true) => [120, 120, 120],
            (Label::Shadowed, ..) => [90, 90, 90],
        })
    })
}

impl MeasureCommand {
    pub fn changes(&self) -> &Changes {
        &self.state.changes
    }

    pub fn run(&self) -> Result<()> {
        self.output.check(&self.state.lab)?;
        let light = self.output.light;
        let mut running = self.state.start(&self.drawing, &[], false)?;
        let shadows = match &self.reference {
            Some(path) => {
                let visibility = reference(path, running.size)?;
                let known = vec![true; visibility.len()];
                Shadows { visibility, known }
            }
            None => running.visibility(self.drawing.frames, light)?,
        };
        let asked = ask(&running, light)?;
        let measure = Measure::new(&asked.rays, &asked.truth);
        let map = if self.reference.is_some() {
            None
        } else {
            running.map_scale(light)
        };
        let Shadows { visibility, known } = shadows;
        let (visibility, judged) = only_known(visibility, &known, &asked.truth);
        let (mut figures, mistakes) = measure.measure(&visibility, map.as_ref());
        // A student's own test has a bias of its own, which nobody knows.
        let is_students = self.reference.is_none() && running.lab.has_students_test();
        if is_students {
            figures.bias = None;
        }
        if let Some(path) = &self.output.output {
            picture::write_rgb(path, &mistakes, &[])?;
        }
        let least = match map {
            Some(_) if !is_students => Some(least_bias(&mut running, &measure, light)?),
            _ => None,
        };
        print(&if self.output.json {
            let mut figures = figures.json();
            figures["lab"] = json!(self.state.lab);
            figures["judged"] = json!(judged);
            figures["least_bias"] = json!(least.flatten());
            figures["rays"] = json!(asked.truth.rays);
            figures["seconds"] = json!(asked.seconds);
            format!("{figures:#}\n")
        } else {
            let least = match least {
                None => String::new(),
                Some(Some(bias)) => {
                    format!("least bias without interior false shadow: {bias:.6} in depth\n")
                }
                Some(None) => {
                    format!("no bias up to {MOST_BIAS} is without interior false shadow\n")
                }
            };
            let judged = match is_students {
                true => format!("shadows, as far as they can be read from pictures: {judged} of\n"),
                false => String::new(),
            };
            format!("{judged}{figures}{least}{}", asked.speed())
        })
    }
}

impl Running {
    /// None where the state draws no map.
    fn map_scale(&self, light: usize) -> Option<MapScale> {
        self.lab.shadow_texture(light).ok().map(|map| map.scale)
    }
}

/// A visibility picture from anywhere: grey, or whatever its red channel shows.
fn reference(path: &Path, size: [u32; 2]) -> Result<GrayImage> {
    let picture = texture::load(path)?;
    let [width, height] = [picture.width(), picture.height()];
    if [width, height] != size {
        let message = format!("{width}×{height} pixels, expected {}×{}", size[0], size[1]);
        return Err(Error::input(path, None, message));
    }
    Ok(GrayImage::from_fn(width, height, |x, y| {
        image::Luma([picture.get_pixel(x, y).0[0]])
    }))
}

/// Biases that are tried, in depth.
const LEAST_BIAS: f64 = 1e-8;
const MOST_BIAS: f64 = 0.1;

/// The least bias without a falsely shadowed pixel in the interior, to one part in a thousand; found by halving, since
/// more bias never shadows more.
fn least_bias(running: &mut Running, measure: &Measure, light: usize) -> Result<Option<f64>> {
    let handout = labs::find(running.name)?;
    let mut is_enough = |bias: f64| -> Result<bool> {
        (handout.set_bias)(running.lab.settings(), bias)?;
        running
            .lab
            .render(&running.context.gl, Show::Visibility { light })?;
        let visibility = gl::read_grey(&running.context.gl, running.size);
        let map = running.map_scale(light);
        Ok(measure.interior_false_shadow(&visibility, map.as_ref()) == 0)
    };
    if is_enough(0.0)? {
        return Ok(Some(0.0));
    }
    if !is_enough(MOST_BIAS)? {
        return Ok(None);
    }
    let (mut least, mut most) = (LEAST_BIAS, MOST_BIAS);
    while most / least > 1.001 {
        let middle = (least * most).sqrt();
        if is_enough(middle)? {
            most = middle;
        } else {
            least = middle;
        }
    }
    Ok(Some(most))
}
