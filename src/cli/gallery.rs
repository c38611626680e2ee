//! `shadowlab screenshot --all`: every lab in every stage of its handout, and a page that shows them side by side.

use std::path::{Path, PathBuf};

use clap::Parser;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use shadowlab::headless::Choice;
use shadowlab::labs::{Handout, LABS, Stage};
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, picture};

use super::screenshot::Screenshot;

/// What a stage's options are part of.
#[derive(Parser)]
struct Line {
    #[command(flatten)]
    screenshot: Screenshot,
}

/// Draws the pictures and writes the page, whose name is returned. Every picture is whole or not there; what an earlier
/// run has drawn is replaced one by one.
pub fn write(folder: &Path, size: Option<[u32; 2]>, device: &Choice) -> Result<PathBuf> {
    let stages: Vec<_> = LABS
        .iter()
        .flat_map(|lab| lab.stages.iter().map(move |stage| (*lab, stage)))
        .collect();
    let progress = Progress::new("drawing the stages", stages.len() as u64);
    for (lab, stage) in stages {
        let file = folder.join(file(lab, stage));
        let pictures = file.parent().expect("a file is in a folder");
        std::fs::create_dir_all(pictures).map_err(|cause| Error::writing(pictures, cause))?;
        let words = command(lab, stage);
        let line = Line::try_parse_from(words.split_whitespace().skip(1));
        let mut screenshot = line.expect("a stage is a command line").screenshot;
        screenshot.output = Some(file);
        screenshot.draw_on(size, device);
        screenshot.write()?;
        progress.add(1);
    }
    let index = folder.join("index.html");
    picture::write_whole(&index, |file| {
        std::io::Write::write_all(file, page().into_string().as_bytes())
    })?;
    Ok(index)
}

/// The picture's file, below the gallery's folder.
fn file(lab: &Handout, stage: &Stage) -> String {
    format!("{}/{}.png", lab.name, stage.name)
}

/// What draws the picture alone.
fn command(lab: &Handout, stage: &Stage) -> String {
    let line = format!("shadowlab screenshot {} {}", lab.name, stage.options);
    line.trim_end().to_owned()
}

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    section { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem; }
    figure { margin: 0; }
    img { width: 100%; image-rendering: auto; border: 1px solid #ccc; }
    code { font-size: 0.85rem; color: #555; }
";

fn page() -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "shadowlab: the handouts' stages" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "The handouts, stage by stage" }
                p { "Under each picture stands the command that draws it alone." }
                @for lab in LABS {
                    h2 id=(lab.name) { (lab.title) }
                    section {
                        @for stage in lab.stages { (figure(lab, stage)) }
                    }
                }
            }
        }
    }
}

fn figure(lab: &Handout, stage: &Stage) -> Markup {
    let file = file(lab, stage);
    html! {
        figure {
            a href=(file) { img src=(file) alt=(stage.caption) loading="lazy"; }
            figcaption {
                (stage.caption) br;
                code { (command(lab, stage)) }
            }
        }
    }
}
