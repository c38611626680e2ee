//! The proof of the diagnosis: every mistake in random states, each picture also perturbed as pictures are on their way
//! from one program to another; how often the mistake is found, and how often a right picture is accused.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::PathBuf;

use image::codecs::jpeg::JpegEncoder;
use image::{ImageFormat, Rgb, RgbImage};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use rayon::prelude::*;
use shadowlab::compare::{TOLERANCE, TOLERANCE_OF_JPEG, resized};
use shadowlab::diagnosis::{Diagnosis, Suspects};
use shadowlab::labs::Handout;
use shadowlab::mistakes;
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, picture};

use super::MistakesCommand;
use super::states;

/// What happens to a picture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Perturbed {
    Not,
    Jpeg,
    Smaller,
    Larger,
    Darkened,
    Brightened,
    Tinted,
}

const ALL: [Perturbed; 7] = [
    Perturbed::Not,
    Perturbed::Jpeg,
    Perturbed::Smaller,
    Perturbed::Larger,
    Perturbed::Darkened,
    Perturbed::Brightened,
    Perturbed::Tinted,
];
const QUALITY: u8 = 85;
const MOST_TINT: i16 = 8;

impl Perturbed {
    fn name(self) -> &'static str {
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

    fn tolerance(self) -> u8 {
        match self {
            Self::Jpeg => TOLERANCE_OF_JPEG,
            _ => TOLERANCE,
        }
    }

    /// The size that the lab is drawn at for it.
    fn size(self, size: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Smaller => size.map(|side| side * 3 / 4),
            Self::Larger => size.map(|side| side * 3 / 2),
            _ => size,
        }
    }

    fn of(self, picture: &RgbImage, tint: [i16; 3]) -> RgbImage {
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
            Self::Smaller | Self::Larger => resized(picture, self.size(size)),
            Self::Darkened => gamma(2.2),
            Self::Brightened => gamma(1.0 / 2.2),
            Self::Tinted => mapped(&|i, value| (i16::from(value) + tint[i]).clamp(0, 255) as u8),
        }
    }
}

/// How often a mistake was found.
#[derive(Clone, Copy, Default)]
struct Tally {
    asked: u32,
    first: u32,
    among_first: u32,
}

impl Tally {
    fn add(&mut self, rank: Option<usize>) {
        self.asked += 1;
        self.first += u32::from(rank == Some(0));
        self.among_first += u32::from(rank.is_some());
    }

    fn join(&mut self, other: &Self) {
        self.asked += other.asked;
        self.first += other.first;
        self.among_first += other.among_first;
    }

    fn percent(part: u32, of: u32) -> String {
        match of {
            0 => String::new(),
            _ => format!("{:.1}", 100.0 * f64::from(part) / f64::from(of)),
        }
    }
}

#[derive(Default)]
struct Proof {
    /// By mistake: states that showed it, states that were drawn, and how often it was found, by perturbation.
    mistakes: BTreeMap<&'static str, Found>,
    /// Right pictures, by perturbation: how many were asked about, how many were accused.
    right: BTreeMap<Perturbed, (u32, u32)>,
    /// What was told first in place of what: how often.
    confusions: BTreeMap<(&'static str, String), u32>,
}

#[derive(Default)]
struct Found {
    states: u32,
    drawn: u32,
    tallies: BTreeMap<Perturbed, Tally>,
}

pub fn write(command: &MistakesCommand, labs: &[&'static Handout], states: u32) -> Result<PathBuf> {
    std::fs::create_dir_all(&command.output)
        .map_err(|cause| Error::writing(&command.output, cause))?;
    let progress = Progress::new("proving", u64::from(states) * labs.len() as u64);
    let mut proofs = Vec::new();
    for lab in labs {
        let mut random = fastrand::Rng::with_seed(command.seed);
        let mut proof = Proof::default();
        for _ in 0..states {
            let options = states::random(lab, &mut random);
            match prove(command, lab, &options, &mut random, &mut proof) {
                // A state that the lab refuses: a format that the driver lacks.
                Err(Error::Usage(_)) => (),
                proved => proved?,
            }
            progress.add(1);
        }
        proofs.push((*lab, proof));
    }
    drop(progress);
    write_csv(command, &proofs)?;
    let index = command.output.join("proof.html");
    picture::write_whole(&index, |file| {
        let page = page(command, states, &proofs);
        std::io::Write::write_all(file, page.into_string().as_bytes())
    })?;
    Ok(index)
}

/// One state: every mistake that it shows, and the right picture, each as drawn and perturbed.
fn prove(
    command: &MistakesCommand,
    lab: &Handout,
    options: &str,
    random: &mut fastrand::Rng,
    proof: &mut Proof,
) -> Result<()> {
    let size = command.size(lab);
    let suspects = |perturbed: Perturbed| {
        let state = states::state(lab, options, perturbed.size(size));
        Suspects::new(lab.name, |edits| state.picture(&command.device, edits))
    };
    let drawn = suspects(Perturbed::Not)?;
    let (smaller, larger) = (suspects(Perturbed::Smaller)?, suspects(Perturbed::Larger)?);
    let of = |perturbed: Perturbed| match perturbed {
        Perturbed::Smaller => &smaller,
        Perturbed::Larger => &larger,
        _ => &drawn,
    };
    for (mistake, _) in mistakes::of_lab(lab.name) {
        proof.mistakes.entry(mistake.name).or_default().drawn += 1;
    }
    let tint = [(); 3].map(|()| random.i16(-MOST_TINT..=MOST_TINT));
    let right = ALL.into_par_iter().map(|perturbed| {
        let picture = perturbed.of(&drawn.right, tint);
        (
            perturbed,
            of(perturbed).diagnose(&picture, perturbed.tolerance(), false),
        )
    });
    for (perturbed, diagnosis) in right.collect::<Vec<_>>() {
        let (asked, accused) = proof.right.entry(perturbed).or_default();
        *asked += 1;
        *accused += u32::from(matches!(diagnosis, Diagnosis::Explained(_)));
    }
    for (names, picture) in drawn.pictures() {
        let asked = ALL.into_par_iter().map(|perturbed| {
            let picture = perturbed.of(picture, tint);
            (
                perturbed,
                of(perturbed).diagnose(&picture, perturbed.tolerance(), false),
            )
        });
        let asked: Vec<_> = asked.collect();
        for name in names {
            let found = proof.mistakes.entry(name).or_default();
            found.states += 1;
            for (perturbed, diagnosis) in &asked {
                let rank = rank(diagnosis, name);
                found.tallies.entry(*perturbed).or_default().add(rank);
                if rank != Some(0) {
                    let told = told(diagnosis);
                    *proof.confusions.entry((name, told)).or_default() += 1;
                }
            }
        }
    }
    Ok(())
}

/// The place of the group that has the mistake.
fn rank(diagnosis: &Diagnosis, name: &str) -> Option<usize> {
    match diagnosis {
        Diagnosis::Explained(found) => found.iter().position(|found| {
            found
                .mistakes
                .iter()
                .any(|(mistake, _)| mistake.name == name)
        }),
        _ => None,
    }
}

fn told(diagnosis: &Diagnosis) -> String {
    match diagnosis {
        Diagnosis::Right => "right".to_owned(),
        Diagnosis::NoneOfThese => "none of these".to_owned(),
        Diagnosis::Explained(found) => found[0].mistakes[0].0.name.to_owned(),
    }
}

fn write_csv(command: &MistakesCommand, proofs: &[(&Handout, Proof)]) -> Result<()> {
    picture::write_whole(&command.output.join("proof.csv"), |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record([
            "lab",
            "mistake",
            "states",
            "drawn",
            "picture",
            "asked",
            "first",
            "among_first",
        ])?;
        for (lab, proof) in proofs {
            for (name, found) in &proof.mistakes {
                for (perturbed, tally) in &found.tallies {
                    let counts = [found.states, found.drawn].map(|count| count.to_string());
                    let tally =
                        [tally.asked, tally.first, tally.among_first].map(|n| n.to_string());
                    let words = [lab.name, name]
                        .map(str::to_owned)
                        .into_iter()
                        .chain(counts);
                    csv.write_record(words.chain([perturbed.name().to_owned()]).chain(tally))?;
                }
            }
        }
        csv.flush()
    })
}

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
    th, td { border-bottom: 1px solid #ddd; padding: 0.15rem 0.6rem; text-align: right; }
    td.name { text-align: left; }
";

fn page(command: &MistakesCommand, states: u32, proofs: &[(&Handout, Proof)]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "shadowlab: the proof of the diagnosis" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "How often compare finds the mistake" }
                p {
                    (states) " random states of each lab (seed " (command.seed) "), at " (command.percent)
                    " % of the course's window. A mistake counts in a state where it changes more than 0.2 % of the pixels \
                     by more than 8 levels. First: it is told first, or is in the group that is. Every figure in percent."
                }
                @for (lab, proof) in proofs { (of_lab(lab, proof)) }
            }
        }
    }
}

fn of_lab(lab: &Handout, proof: &Proof) -> Markup {
    let total = |perturbed: Option<Perturbed>| {
        let mut total = Tally::default();
        let all = proof.mistakes.values().flat_map(|found| &found.tallies);
        for (of, tally) in all {
            if perturbed.is_none_or(|perturbed| perturbed == *of) {
                total.join(tally);
            }
        }
        total
    };
    html! {
        h2 { (lab.title) }
        table {
            tr {
                th { "picture" } th { "asked" } th { "first" } th { "among the first three" } th { "right pictures" } th { "accused" }
            }
            @for perturbed in ALL {
                @let tally = total(Some(perturbed));
                @let (asked, accused) = proof.right.get(&perturbed).copied().unwrap_or_default();
                tr {
                    td.name { (perturbed.name()) } td { (tally.asked) }
                    td { (Tally::percent(tally.first, tally.asked)) }
                    td { (Tally::percent(tally.among_first, tally.asked)) }
                    td { (asked) } td { (accused) }
                }
            }
        }
        h3 { "By mistake" }
        table {
            tr {
                th { "mistake" } th { "states that show it" } th { "of" }
                @for perturbed in ALL { th { (perturbed.name()) } }
                th { "told instead" }
            }
            @for (name, found) in &proof.mistakes {
                tr {
                    td.name { (name) } td { (found.states) } td { (found.drawn) }
                    @for perturbed in ALL {
                        @let tally = found.tallies.get(&perturbed).copied().unwrap_or_default();
                        td { (Tally::percent(tally.first, tally.asked)) }
                    }
                    td.name { (confusions(proof, name)) }
                }
            }
        }
    }
}

fn confusions(proof: &Proof, name: &str) -> String {
    let of_name = proof
        .confusions
        .iter()
        .filter(|((mistake, _), _)| *mistake == name);
    let words = of_name.map(|((_, told), count)| format!("{told} {count}×"));
    words.collect::<Vec<_>>().join(", ")
}
