//! Which mistake explains a picture: the lab makes each of them in the same state, and the pictures are held against the
//! student's.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use image::{RgbImage, imageops};

use crate::Result;
use crate::compare::{Envelope, Forgiven, SAME, TOLERANCE, forgive, resized, unlikeness};
use crate::mistakes::{self, Edits, Made, Mistake};

/// A mistake explains a picture that is nearer to its own by this factor than to the right one.
const EXPLAINS: f64 = 0.5;
/// So much of a picture may differ from the mistake's own picture: a student's constants are not ours.
const MOST_LEFT: f64 = 0.1;
/// How many of the mistakes are looked at closely: those that are like the picture at a glance.
const LOOKED_AT: usize = 8;
/// How many explanations are told.
const MOST_TOLD: usize = 3;

/// A lab's pictures in one state: the right one, and those of the mistakes that can be seen in it.
pub struct Suspects {
    pub right: RgbImage,
    right_range: Envelope,
    /// Mistakes whose pictures are the same in this state are one group.
    groups: Vec<Group>,
    /// Mistakes that change no picture in this state.
    pub unseen: Vec<&'static Mistake>,
}

struct Group {
    mistakes: Vec<(&'static Mistake, &'static Made)>,
    picture: RgbImage,
    range: Envelope,
}

/// Mistakes that explain a picture.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// One, or several whose pictures are alike in this state.
    pub mistakes: Vec<(&'static Mistake, &'static Made)>,
    /// The share of the pixels that are not as they are in the mistake's own picture.
    pub left: f64,
    /// How much of what differs from the right picture the mistake explains, 0…1.
    pub explained: f64,
    /// Their picture in this state.
    pub picture: RgbImage,
    /// What is forgiven of the picture for it.
    pub forgiven: Vec<Forgiven>,
}

#[derive(Clone, Debug)]
pub enum Diagnosis {
    /// No more differs than between two right pictures.
    Right,
    /// The best explanation first.
    Explained(Vec<Explanation>),
    NoneOfThese,
}

impl Diagnosis {
    /// The one that leaves less unexplained: of a picture at its own size, and at the size of the window that it may have
    /// been scaled from.
    pub fn or_better(self, other: Self) -> Self {
        let left = |diagnosis: &Self| match diagnosis {
            Self::Right => 0.0,
            Self::Explained(found) => found[0].left,
            Self::NoneOfThese => 1.0,
        };
        match left(&other) < left(&self) {
            true => other,
            false => self,
        }
    }
}

impl Suspects {
    /// `draw` draws the lab's picture with edits, on several threads at once.
    pub fn new(lab: &str, draw: impl Fn(Edits) -> Result<RgbImage> + Sync) -> Result<Self> {
        let made: Vec<_> = mistakes::of_lab(lab).collect();
        let edits: Vec<_> = std::iter::once(Edits::default())
            .chain(made.iter().map(|(_, made)| made.edits))
            .collect();
        let mut pictures = all_drawn(&edits, draw)?.into_iter();
        let right = pictures.next().expect("the right one is drawn");
        let right_range = Envelope::new(&right);
        let mut groups: Vec<Group> = Vec::new();
        let mut unseen = Vec::new();
        for ((mistake, made), picture) in made.into_iter().zip(pictures) {
            if right_range.share_outside(&picture, TOLERANCE) <= SAME {
                unseen.push(mistake);
                continue;
            }
            let mut alike = groups
                .iter_mut()
                .filter(|group| group.range.share_outside(&picture, TOLERANCE) <= SAME);
            match alike.next() {
                Some(group) => group.mistakes.push((mistake, made)),
                None => groups.push(Group {
                    mistakes: vec![(mistake, made)],
                    range: Envelope::new(&picture),
                    picture,
                }),
            }
        }
        Ok(Self {
            right,
            right_range,
            groups,
            unseen,
        })
    }

    /// The mistakes' names and their pictures, group by group.
    pub fn pictures(&self) -> impl Iterator<Item = (Vec<&'static str>, &RgbImage)> {
        self.groups.iter().map(|group| {
            let names = group.mistakes.iter().map(|(mistake, _)| mistake.name);
            (names.collect(), &group.picture)
        })
    }

    /// The pictures in another size.
    pub fn resized(&self, size: [u32; 2]) -> Self {
        let right = resized(&self.right, size);
        let groups = self.groups.iter().map(|group| {
            let picture = resized(&group.picture, size);
            Group {
                mistakes: group.mistakes.clone(),
                range: Envelope::new(&picture),
                picture,
            }
        });
        Self {
            right_range: Envelope::new(&right),
            right,
            groups: groups.collect(),
            unseen: self.unseen.clone(),
        }
    }

    /// Of a picture of the same size. What is no mistake is forgiven against each picture anew, unless `strict`.
    pub fn diagnose(&self, mine: &RgbImage, tolerance: u8, strict: bool) -> Diagnosis {
        // What is left, and what was forgiven for it.
        let left = |picture: &RgbImage, range: &Envelope| {
            if strict {
                return (range.share_outside(mine, tolerance), Vec::new());
            }
            let found = forgive(mine.clone(), picture);
            let left = match &found.darkened_reference {
                Some(darkened) => Envelope::new(darkened).share_outside(&found.mine, tolerance),
                None => range.share_outside(&found.mine, tolerance),
            };
            (left, found.forgiven)
        };
        let (wrong, _) = left(&self.right, &self.right_range);
        if wrong <= SAME {
            return Diagnosis::Right;
        }
        let turned = imageops::flip_vertical(mine);
        let mut nearest: Vec<&Group> = self.groups.iter().collect();
        nearest.sort_by_cached_key(|group| {
            let either_way = [mine, &turned].map(|mine| unlikeness(mine, &group.picture));
            // In thousandths of a level: whole numbers have an order.
            (1000.0 * either_way[0].min(either_way[1])) as u64
        });
        let explanations = nearest.into_iter().take(LOOKED_AT).map(|group| {
            let (left, forgiven) = left(&group.picture, &group.range);
            Explanation {
                picture: group.picture.clone(),
                forgiven,
                mistakes: group.mistakes.clone(),
                left,
                explained: 1.0 - left / wrong,
            }
        });
        let mut explanations: Vec<_> = explanations
            .filter(|found| found.left <= EXPLAINS * wrong && found.left <= MOST_LEFT)
            .collect();
        explanations.sort_by(|a, b| a.left.total_cmp(&b.left));
        explanations.truncate(MOST_TOLD);
        match explanations.is_empty() {
            true => Diagnosis::NoneOfThese,
            false => Diagnosis::Explained(explanations),
        }
    }
}

/// The picture of each of the edits. Most of a picture's time is the start of its lab, on one core, so that all cores
/// draw: plain threads, because edits and contexts belong to the thread that has them.
fn all_drawn(
    edits: &[Edits],
    draw: impl Fn(Edits) -> Result<RgbImage> + Sync,
) -> Result<Vec<RgbImage>> {
    let drawn: Vec<_> = edits.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(edits) = edits.get(i) else { break };
            *drawn[i].lock().expect("no holder panics") = Some(draw(*edits));
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..cores.min(edits.len()) {
            scope.spawn(work);
        }
    });
    let pictures = drawn.into_iter().map(|picture| {
        let picture = picture.into_inner().expect("no holder panics");
        picture.expect("every picture was drawn")
    });
    pictures.collect()
}
