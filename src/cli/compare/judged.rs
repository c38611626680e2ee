//! What was found of a picture, as text and as JSON.

use std::fmt;
use std::io::Write as _;
use std::path::Path;

use image::RgbImage;
use serde_json::{Value, json};
use shadowlab::compare::{Difference, Forgiven, SAME};
use shadowlab::diagnosis::{Diagnosis, Explanation};
use shadowlab::labs::Handout;
use shadowlab::measure::Figures;
use shadowlab::{Result, picture};

pub struct Judged {
    pub name: String,
    pub handout: &'static Handout,
    /// What brought the lab to its state.
    pub options: Vec<String>,
    pub forgiven: Vec<Forgiven>,
    pub notes: Vec<String>,
    /// What was found in the shaders that drew it.
    pub findings: Vec<String>,
    /// Not of a pair, whose shading is not looked at.
    pub difference: Option<Difference>,
    pub diagnosis: Option<Diagnosis>,
    /// Not where several lights cast shadows.
    pub read: Option<Read>,
    /// After what was forgiven.
    pub mine: RgbImage,
    pub reference: RgbImage,
}

/// The shadows, as they could be read from the picture.
pub struct Read {
    /// How many of the pixels that count could be read.
    pub judged: usize,
    pub figures: Figures,
    pub mistakes: RgbImage,
}

impl Read {
    fn valid(&self) -> usize {
        self.figures.lit + self.figures.shadowed
    }

    /// The share of the pixels that count whose shadow is wrong away from any edge.
    fn wrong(&self) -> f64 {
        let wrong = self.figures.false_shadow.interior + self.figures.false_light.interior;
        wrong as f64 / self.valid().max(1) as f64
    }

    pub fn is_right(&self) -> bool {
        self.wrong() <= SAME
    }
}

impl Judged {
    /// The pictures, or of a pair the shadows.
    pub fn is_same(&self) -> bool {
        match (&self.difference, &self.read) {
            (Some(difference), _) => difference.is_same(),
            (None, read) => read.as_ref().is_some_and(Read::is_right),
        }
    }

    /// Writes its page.
    pub fn write_page(&self, output: &Path) -> Result<()> {
        let page = super::page::page(self).into_string();
        picture::write_whole(output, |file| file.write_all(page.as_bytes()))
    }

    pub fn verdict(&self) -> &'static str {
        match self.is_same() {
            true => "the same within the tolerance",
            false => "not the same",
        }
    }

    pub fn json(&self) -> Value {
        let explanation = |found: &Explanation| {
            json!({
                "mistakes": found.mistakes.iter().map(|(mistake, _)| mistake.name).collect::<Vec<_>>(),
                "explained": found.explained,
                "left": found.left,
            })
        };
        let diagnosis = self.diagnosis.as_ref().map(|diagnosis| match diagnosis {
            Diagnosis::Right => json!([]),
            Diagnosis::NoneOfThese => json!("none of these"),
            Diagnosis::Explained(found) => found.iter().map(explanation).collect(),
        });
        json!({
            "picture": self.name,
            "lab": self.handout.name,
            "same": self.is_same(),
            "width": self.mine.width(),
            "height": self.mine.height(),
            "forgiven": self.forgiven.iter().map(Forgiven::to_string).collect::<Vec<_>>(),
            "notes": self.notes,
            "difference": self.difference.map(|difference| json!({
                "pixels": difference.pixels,
                "tolerance": difference.tolerance,
                "differing": difference.differing,
                "share": difference.share(),
                "mean": difference.mean,
                "largest": difference.largest,
                "ssim": difference.ssim,
            })),
            "shadows": self.read.as_ref().map(|read| {
                let mut figures = read.figures.json();
                figures["judged"] = json!(read.judged);
                figures
            }),
            "diagnosis": diagnosis,
        })
    }
}

/// What was found, in a sentence.
pub fn difference_words(difference: &Difference) -> String {
    format!(
        "{} of {} pixels ({:.2} %, at most {:.2} % may) differ by more than {} levels; mean {:.2}, \
         largest {}; SSIM {:.4}",
        difference.differing,
        difference.pixels,
        100.0 * difference.share(),
        100.0 * SAME,
        difference.tolerance,
        difference.mean,
        difference.largest,
        difference.ssim
    )
}

/// The mistakes of a group, which look alike.
pub fn names(found: &Explanation) -> String {
    let names: Vec<_> = found
        .mistakes
        .iter()
        .map(|(mistake, _)| mistake.name)
        .collect();
    names.join(" or ")
}

impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} against {}: {}",
            self.name,
            self.handout.name,
            self.verdict()
        )?;
        for forgiven in &self.forgiven {
            writeln!(f, "forgiven: {forgiven}")?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        if let Some(difference) = &self.difference {
            writeln!(f, "{}", difference_words(difference))?;
        }
        if let Some(read) = &self.read {
            writeln!(f, "shadows, as far as they can be read: {} of", read.judged)?;
            write!(f, "{}", read.figures)?;
        }
        match &self.diagnosis {
            None | Some(Diagnosis::Right) => Ok(()),
            Some(Diagnosis::NoneOfThese) => writeln!(
                f,
                "diagnosis: none of the mistakes that are known explains it"
            ),
            Some(Diagnosis::Explained(found)) => {
                for (rank, found) in found.iter().enumerate() {
                    let what = if rank == 0 { "diagnosis" } else { "or" };
                    let percent = 100.0 * found.explained;
                    writeln!(f, "{what}: {}, which explains {percent:.0} %", names(found))?;
                    if rank > 0 {
                        continue;
                    }
                    for (mistake, made) in &found.mistakes {
                        writeln!(f, "  {}", mistake.name)?;
                        writeln!(f, "    looks like: {}", mistake.symptom)?;
                        writeln!(f, "    comes from: {}", mistake.cause)?;
                        writeln!(f, "    mended by:  {}", mistake.fix)?;
                        writeln!(f, "    handout:    {}", made.place)?;
                    }
                }
                Ok(())
            }
        }
    }
}
