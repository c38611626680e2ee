//! The proof of the diagnosis: every mistake in random states, each picture as drawn and as one perturbation leaves it;
//! how often the mistake is found, and how often a right picture is accused.

use std::collections::BTreeMap;
use std::path::PathBuf;

use image::RgbImage;
use rayon::prelude::*;
use shadowlab::diagnosis::{Diagnosis, Suspects};
use shadowlab::labs::Handout;
use shadowlab::mistakes;
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, picture};

use super::perturbed::{ALL, MOST_TINT, Perturbed};
use super::{MistakesCommand, proof_page, states};

/// So many states are drawn for each that is wanted, before a mistake that has not been seen in enough of them is given
/// up.
const MOST_DRAWN: u32 = 8;

/// How often a mistake was found.
#[derive(Clone, Copy, Default)]
pub struct Tally {
    pub asked: u32,
    pub first: u32,
    pub among_first: u32,
}

impl Tally {
    fn add(&mut self, rank: Option<usize>) {
        self.asked += 1;
        self.first += u32::from(rank == Some(0));
        self.among_first += u32::from(rank.is_some());
    }

    pub fn join(&mut self, other: &Self) {
        self.asked += other.asked;
        self.first += other.first;
        self.among_first += other.among_first;
    }
}

/// Right pictures: how many were asked about, how many were accused of a mistake.
#[derive(Clone, Copy, Default)]
pub struct Accused {
    pub asked: u32,
    pub accused: u32,
}

/// What one lab's states proved.
#[derive(Default)]
pub struct Proof {
    /// States that were drawn.
    pub drawn: u32,
    pub mistakes: BTreeMap<&'static str, Found>,
    pub right: BTreeMap<Perturbed, Accused>,
    /// What was told first in place of what: how often.
    pub confusions: BTreeMap<(&'static str, String), u32>,
}

#[derive(Default)]
pub struct Found {
    /// States that showed it.
    pub states: u32,
    /// States that were drawn until enough did.
    pub drawn: u32,
    pub tallies: BTreeMap<Perturbed, Tally>,
}

impl Proof {
    /// Over all mistakes, of the pictures that pass.
    pub fn total(&self, passes: impl Fn(Perturbed) -> bool) -> Tally {
        let mut total = Tally::default();
        let all = self.mistakes.values().flat_map(|found| &found.tallies);
        for (_, tally) in all.filter(|(perturbed, _)| passes(**perturbed)) {
            total.join(tally);
        }
        total
    }

    fn is_wanted(&self, mistake: &str, states: u32) -> bool {
        self.mistakes[mistake].states < states
    }
}

/// Draws states of each lab until every mistake that a picture can show was seen in so many of them.
pub fn write(command: &MistakesCommand, labs: &[&'static Handout], states: u32) -> Result<PathBuf> {
    std::fs::create_dir_all(&command.output)
        .map_err(|cause| Error::writing(&command.output, cause))?;
    let wanted = |lab: &Handout| mistakes::of_lab(lab.name).count() as u32 * states;
    let all: u32 = labs.iter().map(|lab| wanted(lab)).sum();
    let progress = Progress::new("proving", all.into());
    let mut proofs = Vec::new();
    for lab in labs {
        let mut random = fastrand::Rng::with_seed(command.seed);
        let mut proof = Proof::default();
        for (mistake, _) in mistakes::of_lab(lab.name) {
            proof.mistakes.insert(mistake.name, Found::default());
        }
        let mut counted = 0;
        while counted < wanted(lab) && proof.drawn < MOST_DRAWN * states {
            proof.drawn += 1;
            let options = states::random(lab, &mut random);
            match prove(command, lab, &options, states, &mut random, &mut proof) {
                // A state that the lab refuses: a format that the driver lacks.
                Err(Error::Usage(_)) => (),
                proved => {
                    let new = proved?;
                    counted += new;
                    progress.add(new.into());
                }
            }
        }
        progress.add((wanted(lab) - counted).into());
        proofs.push((*lab, proof));
    }
    drop(progress);
    proof_page::write_tables(command, &proofs)?;
    let index = command.output.join("proof.html");
    picture::write_whole(&index, |file| {
        let page = proof_page::page(command, states, &proofs);
        std::io::Write::write_all(file, page.into_string().as_bytes())
    })?;
    Ok(index)
}

/// One state: each mistake that it shows and that is still wanted, and the right picture. Tells how many mistakes.
fn prove(
    command: &MistakesCommand,
    lab: &Handout,
    options: &str,
    states: u32,
    random: &mut fastrand::Rng,
    proof: &mut Proof,
) -> Result<u32> {
    let size = command.size(lab);
    let suspects = |size| {
        let state = states::state(lab, options, size);
        Suspects::new(lab.name, |edits| state.picture(&command.device, edits))
    };
    let drawn = suspects(size)?;
    for found in proof.mistakes.values_mut() {
        found.drawn += u32::from(found.states < states);
    }
    // The picture of a group, and which of its mistakes are asked about.
    let mut asked = Vec::new();
    for (names, picture) in drawn.pictures() {
        let wanted = names
            .into_iter()
            .filter(|name| proof.is_wanted(name, states));
        let names: Vec<_> = wanted.collect();
        if !names.is_empty() {
            asked.push((names, picture));
        }
    }
    if asked.is_empty() {
        return Ok(0);
    }

    let perturbed = ALL[random.usize(1..ALL.len())];
    let tint = [(); 3].map(|()| random.i16(-MOST_TINT..=MOST_TINT));
    // As `compare` does it: a picture of another size is one of a smaller window, or one that was scaled.
    let resized = match perturbed.size(size) {
        other if other == size => None,
        other => Some((suspects(other)?, drawn.resized(other))),
    };
    // The right picture is told from the mistaken ones by having no names.
    asked.push((Vec::new(), &drawn.right));
    let told: Vec<_> = asked
        .par_iter()
        .map(|(_, picture)| {
            let again = perturbed.of(picture, tint);
            let diagnose = |suspects: &Suspects, picture: &RgbImage| {
                suspects.diagnose(picture, perturbed.tolerance(), false)
            };
            let told_again = match &resized {
                None => diagnose(&drawn, &again),
                Some((smaller, scaled)) => {
                    diagnose(smaller, &again).or_better(diagnose(scaled, &again))
                }
            };
            [
                (
                    Perturbed::Not,
                    drawn.diagnose(picture, Perturbed::Not.tolerance(), false),
                ),
                (perturbed, told_again),
            ]
        })
        .collect();
    let mut counted = 0;
    for ((names, _), told) in asked.iter().zip(&told) {
        for name in names {
            counted += 1;
            proof.count(name, told);
        }
        if names.is_empty() {
            for (perturbed, diagnosis) in told {
                let right = proof.right.entry(*perturbed).or_default();
                right.asked += 1;
                right.accused += u32::from(matches!(diagnosis, Diagnosis::Explained(_)));
            }
        }
    }
    Ok(counted)
}

impl Proof {
    /// One state that shows a mistake, and what was told of its pictures.
    fn count(&mut self, name: &'static str, told: &[(Perturbed, Diagnosis)]) {
        let found = self.mistakes.entry(name).or_default();
        found.states += 1;
        for (perturbed, diagnosis) in told {
            let rank = rank(diagnosis, name);
            found.tallies.entry(*perturbed).or_default().add(rank);
            if rank != Some(0) {
                let told = first(diagnosis);
                *self.confusions.entry((name, told)).or_default() += 1;
            }
        }
    }
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

fn first(diagnosis: &Diagnosis) -> String {
    match diagnosis {
        Diagnosis::Right => "right".to_owned(),
        Diagnosis::NoneOfThese => "none of these".to_owned(),
        Diagnosis::Explained(found) => found[0].mistakes[0].0.name.to_owned(),
    }
}
