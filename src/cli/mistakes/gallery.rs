//! A page of the mistakes: what each looks like, where it comes from, how it is mended.

use std::path::PathBuf;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use shadowlab::compare::{Envelope, SAME, TOLERANCE};
use shadowlab::labs::Handout;
use shadowlab::mistakes::{self, Edits, Made, Mistake};
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, picture};

use super::MistakesCommand;
use super::states;

/// In how many random states a mistake is looked for that the lab's first state does not show.
const TRIES: usize = 60;

struct Entry {
    mistake: &'static Mistake,
    made: &'static Made,
    /// The options of the state that shows it; None if none of the states that were tried does.
    options: Option<String>,
}

pub fn write(command: &MistakesCommand, labs: &[&'static Handout]) -> Result<PathBuf> {
    let count = labs.iter().map(|lab| mistakes::of_lab(lab.name).count());
    let progress = Progress::new("drawing the mistakes", count.sum::<usize>() as u64);
    let mut sections = Vec::new();
    for lab in labs {
        let mut entries = Vec::new();
        for (mistake, made) in mistakes::of_lab(lab.name) {
            entries.push(Entry {
                mistake,
                made,
                options: draw(command, lab, mistake, made)?,
            });
            progress.add(1);
        }
        sections.push((*lab, entries));
    }
    let index = command.output.join("index.html");
    picture::write_whole(&index, |file| {
        std::io::Write::write_all(file, page(&sections).into_string().as_bytes())
    })?;
    Ok(index)
}

/// Writes both pictures of the first state that shows the mistake.
fn draw(
    command: &MistakesCommand,
    lab: &Handout,
    mistake: &Mistake,
    made: &Made,
) -> Result<Option<String>> {
    let folder = command.output.join(lab.name);
    std::fs::create_dir_all(&folder).map_err(|cause| Error::writing(&folder, cause))?;
    let mut random = fastrand::Rng::with_seed(1);
    let others = (0..TRIES).map(|_| states::random(lab, &mut random));
    for options in std::iter::once(String::new()).chain(others) {
        let state = states::state(lab, &options, command.size(lab));
        let right = state.picture(&command.device, Edits::default())?;
        let wrong = state.picture(&command.device, made.edits)?;
        if Envelope::new(&right).share_outside(&wrong, TOLERANCE) > SAME {
            for (picture, name) in [(right, "right"), (wrong, "wrong")] {
                let path = folder.join(format!("{}-{name}.png", mistake.name));
                picture::write_rgb(&path, &picture, &[])?;
            }
            return Ok(Some(options));
        }
    }
    Ok(None)
}

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 70rem; padding: 0 1rem; color: #222; }
    h3 { margin: 1.6rem 0 0.4rem; font-family: monospace; }
    td, th { vertical-align: top; text-align: left; }
    td.picture { width: 14rem; padding-right: 1.2rem; font-size: 0.85rem; }
    img { width: 14rem; border: 1px solid #ccc; }
    th { color: #666; font-weight: normal; white-space: nowrap; padding-right: 0.8rem; }
    code { font-size: 0.8rem; color: #555; }
";

fn page(sections: &[(&Handout, Vec<Entry>)]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "shadowlab: the classic mistakes" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "The classic mistakes" }
                p {
                    "Each mistake beside the right picture of the same state. The command under it shows it in a window, \
                     where it can be walked around. Which of them a picture of your own shows: "
                    code { "shadowlab compare MINE.png LAB" }
                }
                @for (lab, entries) in sections {
                    h2 id=(lab.name) { (lab.title) }
                    @for entry in entries { (article(lab, entry)) }
                }
            }
        }
    }
}

fn article(lab: &Handout, entry: &Entry) -> Markup {
    let Mistake {
        name,
        symptom,
        cause,
        fix,
        ..
    } = entry.mistake;
    html! {
        h3 { (name) }
        table {
            tr {
                @if entry.options.is_some() {
                    @for (file, caption) in [("right", "right"), ("wrong", "with the mistake")] {
                        @let file = format!("{}/{name}-{file}.png", lab.name);
                        td.picture {
                            a href=(file) { img src=(file) alt=(caption) loading="lazy"; }
                            (caption)
                        }
                    }
                }
                td {
                    @if entry.options.is_none() {
                        p {
                            "No picture of this lab shows it, in any state that was tried. "
                            code { "check-trace" } " or " code { "check-shaders" } " may."
                        }
                    }
                    table {
                        tr { th { "looks like" } td { (symptom) } }
                        tr { th { "comes from" } td { (cause) } }
                        tr { th { "mended by" } td { (fix) } }
                        tr { th { "handout" } td { (entry.made.place) } }
                    }
                    @if let Some(options) = &entry.options {
                        code { "shadowlab view " (lab.name) " " (quoted(options)) " --mistake " (name) }
                    }
                }
            }
        }
    }
}

/// Keys have characters that a shell takes for its own.
fn quoted(options: &str) -> String {
    let words = options
        .split_whitespace()
        .map(|word| match word.contains(['<', '>']) {
            true => format!("\"{word}\""),
            false => word.to_owned(),
        });
    words.collect::<Vec<_>>().join(" ")
}
