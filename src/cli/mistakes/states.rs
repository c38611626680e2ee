//! Random states of a lab, as command lines name them.

use clap::Parser;
use shadowlab::labs::{Handout, Input, Kind, Setting, parse_keys};

use crate::cli::changes::Changes;
use crate::cli::state::State;

/// What decides on shadows as a whole, or on nothing that a picture shows.
const LEFT_ALONE: [&str; 4] = ["shadows", "shadow_test", "redraw", "soft_method"];
/// How often a setting is changed, and how far a number then is from its default.
const CHANGED: f64 = 0.25;
const FARTHEST: f64 = 2.0;
/// Keys are pressed up to so often.
const MOST_KEYS: usize = 12;
/// In seconds.
const MOST_TIME: f64 = 3.0;
/// Scenes of the lab that show what its own does not, and how often they are chosen.
const SCENES: [(&str, &str); 2] = [
    ("cs541", "hard:overhead"),
    ("csci3260", "hard:overhead-sun"),
];
const ANOTHER_SCENE: f64 = 0.3;

/// The options of a state, with spaces between them.
pub fn random(handout: &Handout, random: &mut fastrand::Rng) -> String {
    let mut options = Vec::new();
    for setting in handout.settings {
        if !LEFT_ALONE.contains(&setting.name) && random.f64() < CHANGED {
            options.push(format!("--set {}={}", setting.name, value(setting, random)));
        }
    }
    let keys = keys(handout);
    let pressed = (0..random.usize(0..=MOST_KEYS))
        .map(|_| random.choice(&keys).expect("a lab has keys").as_str());
    let pressed: String = pressed.collect();
    if !pressed.is_empty() {
        options.push(format!("--keys {pressed}"));
    }
    options.push(format!("--time {:.2}", MOST_TIME * random.f64()));
    let scenes = SCENES.iter().filter(|(lab, _)| *lab == handout.name);
    if let Some((_, scene)) = random.choice(scenes.collect::<Vec<_>>())
        && random.f64() < ANOTHER_SCENE
    {
        options.push(format!("--scene {scene}"));
    }
    options.join(" ")
}

fn value(setting: &Setting, random: &mut fastrand::Rng) -> String {
    match setting.kind {
        Kind::Choice(names) => (*random.choice(names).expect("a choice has names")).to_owned(),
        Kind::Switch { .. } => ["on", "off"][random.usize(0..2)].to_owned(),
        Kind::Number {
            default,
            least,
            most,
            whole,
        } => {
            let factor = FARTHEST.powf(2.0 * random.f64() - 1.0);
            let value = (default * factor).clamp(least, most);
            match whole {
                true => value.round().to_string(),
                false => format!("{value:.5}"),
            }
        }
    }
}

/// The keys and movements that the lab's table names, but for the one that ends the viewer.
fn keys(handout: &Handout) -> Vec<String> {
    let words = handout
        .keys
        .iter()
        .flat_map(|(keys, _)| keys.split_whitespace());
    let inputs = words.filter_map(|word| parse_keys(word).ok()).flatten();
    let quits = |input: &Input| matches!(input, Input::Key(key) if Some(*key) == handout.quit);
    inputs
        .filter(|input| !quits(input))
        .map(|input| input.to_string())
        .collect()
}

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    changes: Changes,
}

/// The state that a lab is in after these options, at a size.
pub fn state(handout: &Handout, options: &str, size: [u32; 2]) -> State {
    let words = std::iter::once("shadowlab").chain(options.split_whitespace());
    let mut changes = Line::try_parse_from(words)
        .expect("the options are our own")
        .changes;
    changes.size = Some(size);
    State {
        lab: handout.name.to_owned(),
        changes,
    }
}
