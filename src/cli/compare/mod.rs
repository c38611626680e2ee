//! `shadowlab compare`: a student's picture, held against the lab's.

mod batch;
mod judged;
mod page;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use image::{DynamicImage, RgbImage, imageops};
use shadowlab::compare::{Difference, Forgiven, Matching, TOLERANCE, TOLERANCE_OF_JPEG};
use shadowlab::compare::{Shadows, forgive, resized};
use shadowlab::diagnosis::{Diagnosis, Suspects};
use shadowlab::ground_truth::Rays;
use shadowlab::headless::Choice;
use shadowlab::labs::{self, Handout, Show};
use shadowlab::measure::{Measure, only_known};
use shadowlab::mistakes::{self, Edits};
use shadowlab::scene::{reading, texture};
use shadowlab::{Error, Result, gl, picture};

use super::print;
use super::state::{Changes, Drawing, Running, State};
use super::values::{check_light, parse_crop};
pub use judged::Judged;
use judged::Read;

/// What the pictures are the same within their tolerance, differ, or could not be compared, as diff has it.
pub const SAME: u8 = 0;
pub const DIFFERENT: u8 = 1;
pub const TROUBLE: u8 = 2;

#[derive(Args)]
pub struct CompareCommand {
    /// The picture (or one with shadows and one without) and the lab's name; with --batch, the name alone
    #[arg(required = true, num_args = 1..=3, value_names = ["MINE.png", "WITHOUT.png", "LAB"])]
    what: Vec<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    /// Hold it against this picture in place of the lab's
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Look at this part alone, without a window's frame
    #[arg(long, value_name = "X,Y,WxH", value_parser = parse_crop)]
    crop: Option<[u32; 4]>,
    /// Forgive nothing: no flip, gamma, tint, shift, and no edge that is a pixel off
    #[arg(long)]
    strict: bool,
    /// Print the figures as JSON
    #[arg(long)]
    json: bool,
    /// Write a page (LAB.html), or with --batch a folder of them
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Which of the lab's lights the shadows are of
    #[arg(long, value_name = "N", default_value_t = 1)]
    light: usize,
    /// Compare every picture of this folder, each in a process of its own
    #[arg(long, value_name = "DIR", conflicts_with_all = ["json", "reference"])]
    batch: Option<PathBuf>,
    /// Which renderer draws: auto, software, or part of a renderer's name
    #[arg(long, value_name = "NAME", default_value = "auto")]
    device: Choice,
}

impl CompareCommand {
    pub fn changes(&self) -> &Changes {
        &self.changes
    }

    pub fn run(self) -> Result<ExitCode> {
        let Some((lab, pictures)) = self.what.split_last() else {
            unreachable!("clap asks for one");
        };
        let handout = labs::find(&lab.to_string_lossy())?;
        check_light(handout, self.light)?;
        self.changes.refuse_mistake("compare")?;
        match (&self.batch, pictures) {
            (Some(folder), []) => batch::run(&self, folder, handout),
            (Some(_), _) => Err(Error::usage(
                "compare --batch DIR LAB: found a picture beside the folder",
            )),
            (None, []) => Err(Error::usage(format!(
                "compare: found no picture, expected compare MINE.png {}",
                handout.name
            ))),
            (None, [mine, without @ ..]) => self.one(handout, mine, without.first()),
        }
    }

    fn one(
        &self,
        handout: &'static Handout,
        mine: &Path,
        without: Option<&PathBuf>,
    ) -> Result<ExitCode> {
        if let Some(output) = &self.output {
            picture::check_name(output, &["html"])?;
        }
        let judged = match without {
            None => self.picture(handout, mine)?,
            Some(without) => self.pair(handout, mine, without)?,
        };
        if let Some(output) = &self.output {
            judged.write_page(output)?;
        }
        print(&match self.json {
            true => format!("{:#}\n", judged.json()),
            false => judged.to_string(),
        })?;
        Ok(ExitCode::from(match judged.is_same() {
            true => SAME,
            false => DIFFERENT,
        }))
    }

    /// A picture with shadows against the lab's.
    fn picture(&self, handout: &'static Handout, path: &Path) -> Result<Judged> {
        let loaded = self.load(path)?;
        self.judge(handout, path, loaded, None)
    }

    /// The command for a picture that a student's own shaders drew in this state.
    pub fn of_shaders(changes: &Changes, light: usize, device: &Choice) -> Self {
        Self {
            what: Vec::new(),
            changes: changes.clone(),
            reference: None,
            crop: None,
            strict: false,
            json: false,
            output: None,
            light,
            batch: None,
            device: device.clone(),
        }
    }

    /// A picture that was drawn and not loaded, with its shadows, where they are known of each light.
    pub fn shaders(
        &self,
        handout: &'static Handout,
        name: &Path,
        picture: RgbImage,
        shadows: Option<Shadows>,
    ) -> Result<Judged> {
        let drawn = Loaded {
            picture,
            is_jpeg: false,
            notes: Vec::new(),
        };
        self.judge(handout, name, drawn, shadows)
    }

    /// `shadows` are the picture's, where they need not be read from it alone.
    fn judge(
        &self,
        handout: &'static Handout,
        path: &Path,
        loaded: Loaded,
        shadows: Option<Shadows>,
    ) -> Result<Judged> {
        let Loaded {
            picture: mine,
            is_jpeg,
            mut notes,
        } = loaded;
        let mut state = self.state(handout, &mine);
        let mut forgiven = Vec::new();
        let mut tolerance = TOLERANCE;
        if is_jpeg && !self.strict {
            tolerance = TOLERANCE_OF_JPEG;
            forgiven.push(Forgiven::Jpeg);
        }
        let (mine, right) = match &self.reference {
            None => (mine, self.draw(&state, Edits::default())?),
            Some(reference) => {
                let reference = self.load(reference)?.picture;
                let size: [u32; 2] = reference.dimensions().into();
                let found: [u32; 2] = mine.dimensions().into();
                state.changes.size = Some(size);
                if found == size {
                    (mine, reference)
                } else if self.strict {
                    let [width, height] = size;
                    let message = format!(
                        "{}×{} pixels, expected {width}×{height}",
                        found[0], found[1]
                    );
                    return Err(Error::input(path, None, message));
                } else {
                    forgiven.push(Forgiven::Size(found));
                    (resized(&mine, size), reference)
                }
            }
        };
        let given = mine.clone();
        let (difference, mine) = if self.strict {
            (
                Difference::new(&mine, &right, Matching::Exact, tolerance),
                mine,
            )
        } else {
            let found = forgive(mine, &right);
            let reference = found.darkened_reference.as_ref().unwrap_or(&right);
            let difference =
                Difference::new(&found.mine, reference, Matching::WithinAPixel, tolerance);
            forgiven.extend(&found.forgiven);
            (difference, found.brightened())
        };
        let diagnosis = match difference.is_same() {
            true => Diagnosis::Right,
            false => Suspects::new(handout.name, |edits| self.draw(&state, edits))?.diagnose(
                &given,
                tolerance,
                self.strict,
            ),
        };
        let read = match shadows {
            Some(shadows) => Some(self.read_of(&state, self.light, shadows)?),
            None => {
                let lit = self.draw_lit(&state)?;
                let dark = self.draw(&state, mistakes::all_in_shadow(handout.name))?;
                self.read(&state, Shadows::between(&mine, &lit, &dark))?
            }
        };
        if read.is_none() {
            notes.push(format!(
                "the shadows of {} lights cannot be told apart in one picture: no figures of them",
                handout.lights
            ));
        }
        Ok(Judged {
            name: path.display().to_string(),
            handout,
            options: state.options(),
            forgiven,
            notes,
            findings: Vec::new(),
            difference: Some(difference),
            diagnosis: Some(diagnosis),
            read,
            mine,
            reference: right,
        })
    }

    /// A picture with shadows and one without: the shadows alone.
    fn pair(&self, handout: &'static Handout, on: &Path, off: &Path) -> Result<Judged> {
        let (on_loaded, off_loaded) = (self.load(on)?, self.load(off)?);
        let notes = [on_loaded.notes, off_loaded.notes].concat();
        let (mine, without) = (on_loaded.picture, off_loaded.picture);
        let ([width, height], found): ([u32; 2], [u32; 2]) =
            (mine.dimensions().into(), without.dimensions().into());
        if found != [width, height] {
            let message = format!(
                "{}×{} pixels, expected {width}×{height} as {} has",
                found[0],
                found[1],
                on.display()
            );
            return Err(Error::input(off, None, message));
        }
        let state = self.state(handout, &mine);
        let lit = self.draw_lit(&state)?;
        let mut forgiven = Vec::new();
        let (mut mine, mut without) = (mine, without);
        if !self.strict {
            forgiven = forgive(without.clone(), &lit).forgiven;
            // Their shading is not looked at, and their curve is the same in both.
            forgiven.retain(|found| *found == Forgiven::UpsideDown);
        }
        if !forgiven.is_empty() {
            mine = imageops::flip_vertical(&mine);
            without = imageops::flip_vertical(&without);
        }
        let read = self.read(&state, Shadows::ratio(&mine, &without))?;
        let Some(read) = read else {
            return Err(Error::usage(format!(
                "compare: {} lights cast shadows, which a pair of pictures cannot tell apart, expected one: \
                 --set lights=…",
                handout.lights
            )));
        };
        Ok(Judged {
            name: format!("{} and {}", on.display(), off.display()),
            handout,
            options: state.options(),
            forgiven,
            notes,
            findings: Vec::new(),
            difference: None,
            diagnosis: None,
            read: Some(read),
            mine,
            reference: self.draw(&state, Edits::default())?,
        })
    }

    /// A picture, as far as it is asked for, and what is odd about it.
    fn load(&self, path: &Path) -> Result<Loaded> {
        let bytes = reading::read(path, reading::PICTURE_LIMIT)?;
        let picture = texture::decode(path, &bytes, texture::MOST_BYTES)?;
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
        if let Some([x, y, width, height]) = self.crop {
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

    /// The lab's state, at the picture's size.
    fn state(&self, handout: &Handout, mine: &RgbImage) -> State {
        let mut changes = self.changes.clone();
        changes.size = changes.size.or(Some(mine.dimensions().into()));
        State {
            lab: handout.name.to_owned(),
            changes,
        }
    }

    /// The options of one picture's comparison, as another command line would repeat them.
    fn state_options(&self, handout: &Handout) -> Vec<String> {
        let state = State {
            lab: handout.name.to_owned(),
            changes: self.changes.clone(),
        };
        let mut options = state.all_options();
        if let Some([width, height]) = self.changes.size {
            options.extend(["--size".to_owned(), format!("{width}x{height}")]);
        }
        if let Some([x, y, width, height]) = self.crop {
            options.extend(["--crop".to_owned(), format!("{x},{y},{width}x{height}")]);
        }
        if self.strict {
            options.push("--strict".to_owned());
        }
        options.extend(["--light".to_owned(), self.light.to_string()]);
        options
    }

    fn start(&self, state: &State) -> Result<Running> {
        state.start(&Drawing::on(&self.device), &[], false)
    }

    fn draw(&self, state: &State, with: Edits) -> Result<RgbImage> {
        state.picture(&self.device, with)
    }

    /// Without shadows.
    fn draw_lit(&self, state: &State) -> Result<RgbImage> {
        let handout = labs::find(&state.lab)?;
        let Some(edits) = mistakes::none_in_shadow(handout.name) else {
            let mut running = self.start(state)?;
            running.lab.settings().set("shadows=off")?;
            running.draw(1, Show::Picture)?;
            return Ok(gl::read_rgb(&running.context.gl, running.size));
        };
        self.draw(state, edits)
    }

    /// The shadows against the truth, if they are of one light.
    fn read(&self, state: &State, shadows: Shadows) -> Result<Option<Read>> {
        let running = self.start(state)?;
        let handout = labs::find(&state.lab)?;
        let is_on = |light: &usize| running.lab.check_light(*light).is_ok();
        let lights: Vec<usize> = (1..=handout.lights).filter(is_on).collect();
        let &[light] = lights.as_slice() else {
            return Ok(None);
        };
        drop(running);
        self.read_of(state, light, shadows).map(Some)
    }

    /// The shadows of a light (from 1) against the truth.
    fn read_of(&self, state: &State, light: usize, shadows: Shadows) -> Result<Read> {
        let running = self.start(state)?;
        running.lab.check_light(light)?;
        let rays = Rays::new(&running.lab.now(), light - 1);
        let truth = rays.truth(running.size);
        let Shadows { visibility, known } = shadows;
        let (filled, judged) = only_known(visibility, &known, &truth);
        let map = running.lab.shadow_texture(light).ok().map(|map| map.scale);
        let (mut figures, mistakes) = Measure::new(&rays, &truth).measure(&filled, map.as_ref());
        // The lab's, not the picture's.
        figures.bias = None;
        Ok(Read {
            judged,
            figures,
            mistakes,
        })
    }
}

/// A picture from a file, as far as it is asked for.
struct Loaded {
    picture: RgbImage,
    is_jpeg: bool,
    /// What is odd about it.
    notes: Vec<String>,
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
