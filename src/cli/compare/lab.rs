//! The lab's pictures, in the state that a student's picture is of.

use image::{Rgb, RgbImage};
use shadowlab::Result;
use shadowlab::compare::Shadows;
use shadowlab::diagnosis::Suspects;
use shadowlab::ground_truth::Rays;
use shadowlab::headless::Choice;
use shadowlab::labs::Handout;
use shadowlab::measure::{Measure, only_known};
use shadowlab::mistakes::{self, Edits};

use super::judged::Read;
use crate::cli::changes::Changes;
use crate::cli::state::{Drawing, State};

/// From here on a pixel is lit.
const LIT: u8 = 128;

/// A lab in one state and size. Every picture is drawn in a context of its own.
pub struct LabPictures<'a> {
    pub handout: &'static Handout,
    pub state: State,
    device: &'a Choice,
}

impl<'a> LabPictures<'a> {
    pub fn new(
        handout: &'static Handout,
        changes: &Changes,
        size: [u32; 2],
        device: &'a Choice,
    ) -> Self {
        let mut changes = changes.clone();
        changes.size = Some(size);
        let state = State {
            lab: handout.name.to_owned(),
            changes,
        };
        Self {
            handout,
            state,
            device,
        }
    }

    pub fn right(&self) -> Result<RgbImage> {
        self.with(Edits::default())
    }

    fn with(&self, edits: Edits) -> Result<RgbImage> {
        self.state.picture(self.device, edits)
    }

    /// Without shadows.
    pub fn lit(&self) -> Result<RgbImage> {
        match mistakes::none_in_shadow(self.handout.name) {
            Some(edits) => self.with(edits),
            None => self.off(Edits::default()),
        }
    }

    /// Everything that the light reaches in shadow: by the handout's test, whose shader is the one that is edited.
    pub fn dark(&self) -> Result<RgbImage> {
        let mut state = self.state.clone();
        if state.changes.other_test().is_some() {
            state.changes.set("shadow_test=handout");
        }
        state.picture(self.device, mistakes::all_in_shadow(self.handout.name))
    }

    fn off(&self, edits: Edits) -> Result<RgbImage> {
        let mut state = self.state.clone();
        state.changes.set("shadows=off");
        state.picture(self.device, edits)
    }

    /// The mistakes' pictures.
    pub fn suspects(&self) -> Result<Suspects> {
        Suspects::new(self.handout.name, |edits| self.with(edits))
    }

    /// The mistakes' shadows alone, as a pair of pictures tells them.
    pub fn suspected_shadows(&self) -> Result<Suspects> {
        let lit = match mistakes::none_in_shadow(self.handout.name) {
            Some(_) => Some(self.lit()?),
            None => None,
        };
        Suspects::new(self.handout.name, |edits| {
            let on = self.with(edits)?;
            let off = match &lit {
                Some(lit) => lit.clone(),
                None => self.off(edits)?,
            };
            Ok(black_and_white(&Shadows::ratio(&on, &off)))
        })
    }

    /// The shadows against the truth, if they are of one light.
    pub fn read(&self, shadows: Shadows) -> Result<Option<Read>> {
        let running = self.state.start(&Drawing::on(self.device), &[], false)?;
        let is_on = |light: &usize| running.lab.check_light(*light).is_ok();
        let lights: Vec<usize> = (1..=self.handout.lights).filter(is_on).collect();
        let &[light] = lights.as_slice() else {
            return Ok(None);
        };
        drop(running);
        self.read_of(light, shadows).map(Some)
    }

    /// The shadows of a light (from 1) against the truth.
    pub fn read_of(&self, light: usize, shadows: Shadows) -> Result<Read> {
        let running = self.state.start(&Drawing::on(self.device), &[], false)?;
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

/// Lit or in shadow, and nothing between: how dark a shadow is belongs to the shading. What cannot be read is lit.
pub fn black_and_white(shadows: &Shadows) -> RgbImage {
    let visibility = &shadows.visibility;
    RgbImage::from_fn(visibility.width(), visibility.height(), |x, y| {
        let is_lit = visibility.get_pixel(x, y).0[0] >= LIT;
        Rgb([if is_lit { 255 } else { 0 }; 3])
    })
}
