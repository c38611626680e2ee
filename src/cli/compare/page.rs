//! One picture's page, which needs no other file.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, RgbImage};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use shadowlab::compare::heat_map;
use shadowlab::diagnosis::{Diagnosis, Explanation};

use super::judged::{Judged, difference_words, names};

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    .same { background: #d9f0dd; } .different { background: #fbe3d6; }
    .same, .different { padding: 0.5rem 0.8rem; font-weight: bold; }
    figure { display: inline-block; vertical-align: top; width: 20rem; margin: 0 1.4rem 1.4rem 0; }
    figcaption { font-size: 0.9rem; }
    img { width: 20rem; border: 1px solid #ccc; image-rendering: pixelated; }
    td, th { vertical-align: top; text-align: left; padding: 0.1rem 0.8rem 0.1rem 0; }
    th { color: #666; font-weight: normal; white-space: nowrap; }
    pre { font-size: 0.85rem; overflow-x: auto; }
    code { font-size: 0.85rem; color: #555; }
    .red { color: #b01818; } .blue { color: #2048c0; }
";

pub fn page(judged: &Judged) -> Markup {
    let class = if judged.is_same() {
        "same"
    } else {
        "different"
    };
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { (judged.name) " against " (judged.handout.name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (judged.name) }
                p { "Held against " (judged.handout.title) ". " code { (judged.options.join(" ")) } }
                p class=(class) { (judged.verdict()) }
                @if let Some(difference) = &judged.difference { p { (difference_words(difference)) } }
                @for forgiven in &judged.forgiven { p { "Forgiven: " (forgiven) } }
                @for note in &judged.notes { p { "Note: " (note) } }
                @if !judged.findings.is_empty() {
                    h2 { "The shaders" }
                    ul { @for finding in &judged.findings { li { code { (finding) } } } }
                }
                (diagnosis(judged))
                (pictures(judged))
                @if let Some(read) = &judged.read {
                    h2 { "The shadows against rays in f64" }
                    p { (read.judged) " of the pixels that count can be read from the picture." }
                    pre { (read.figures) }
                }
            }
        }
    }
}

fn diagnosis(judged: &Judged) -> Markup {
    html! {
        @match &judged.diagnosis {
            None | Some(Diagnosis::Right) => {}
            Some(Diagnosis::NoneOfThese) => {
                h2 { "Diagnosis" }
                p { "None of the mistakes that are known explains this picture." }
            }
            Some(Diagnosis::Explained(found)) => {
                h2 { "Diagnosis" }
                @for (rank, found) in found.iter().enumerate() { (explanation(rank, found)) }
            }
        }
    }
}

fn explanation(rank: usize, found: &Explanation) -> Markup {
    html! {
        p {
            @if rank > 0 { "Or: " }
            b { (names(found)) }
            ", which explains " (format!("{:.0} %", 100.0 * found.explained)) " of what differs."
        }
        @if rank == 0 {
            @for (mistake, made) in &found.mistakes {
                table {
                    tr { th { "mistake" } td { (mistake.name) } }
                    tr { th { "looks like" } td { (mistake.symptom) } }
                    tr { th { "comes from" } td { (mistake.cause) } }
                    tr { th { "mended by" } td { (mistake.fix) } }
                    tr { th { "handout" } td { (made.place) } }
                }
            }
        }
    }
}

fn pictures(judged: &Judged) -> Markup {
    html! {
        section {
            (figure(&judged.mine, "mine", html! { "mine, after what was forgiven" }))
            (figure(&judged.reference, "the reference", html! { "the reference" }))
            @if let Some(Diagnosis::Explained(found)) = &judged.diagnosis {
                (figure(&found[0].picture, "the mistake", html! { "the lab with " (names(&found[0])) }))
            }
            @if judged.difference.is_some() {
                (figure(
                    &heat_map(&judged.mine, &judged.reference),
                    "the difference",
                    html! { "where they differ: black not at all, then red, yellow, white" },
                ))
            }
            @if let Some(read) = &judged.read {
                (figure(&read.mistakes, "wrong shadows", html! {
                    "the shadows against the truth: " span.red { "false shadow" } ", " span.blue { "false light" }
                }))
            }
        }
    }
}

fn figure(picture: &RgbImage, alt: &str, caption: Markup) -> Markup {
    let mut png = Cursor::new(Vec::new());
    picture
        .write_to(&mut png, ImageFormat::Png)
        .expect("memory takes every picture");
    let source = format!(
        "data:image/png;base64,{}",
        STANDARD.encode(png.into_inner())
    );
    html! {
        figure {
            img src=(source) alt=(alt);
            figcaption { (caption) }
        }
    }
}
