//! What every page begins with: its style, what it was measured on, and what is to be said aloud.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Machine;

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    .loud { background: #b00020; color: #fff; padding: 0.6rem 1rem; font-weight: bold; }
    .advice { border-left: 4px solid #0072b2; padding-left: 0.8rem; max-width: 60rem; }
    .plot svg { max-width: 100%; height: auto; }
    .legend { list-style: none; padding: 0; font-size: 0.9rem; }
    .legend li { display: inline-block; margin-right: 1.4rem; }
    .legend b { display: inline-block; width: 0.8rem; height: 0.8rem; margin-right: 0.4rem; }
    .legend b.round { border-radius: 50%; }
    .wide { overflow-x: auto; }
    table { border-collapse: collapse; font-size: 0.8rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
    th, td { border-bottom: 1px solid #ddd; padding: 0.15rem 0.5rem; text-align: right; }
    th { border-bottom-color: #888; vertical-align: bottom; }
    th.name, td.name { text-align: left; }
    tr.chosen { background: #e3f0f8; }
    tr.front td:first-child { font-weight: bold; }
    figure { display: inline-block; vertical-align: top; width: 16rem; margin: 0 1rem 1rem 0; font-size: 0.8rem; }
    img { width: 100%; border: 1px solid #ccc; image-rendering: pixelated; }
    code { font-size: 0.85rem; color: #555; }
";

/// A page that needs no other file.
pub fn sheet(title: &str, machine: &Machine, interrupted: Option<String>, body: Markup) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "shadowlab: " (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (title) }
                @if machine.software {
                    p.loud { "SOFTWARE RENDERER: these are the times of a CPU. A GPU has others, and other ratios." }
                }
                @if let Some(interrupted) = interrupted { p.loud { (interrupted) } }
                p {
                    "Drawn by " b { (machine.renderer) } ", driver " b { (machine.driver) } ", on "
                    b { (machine.cpu) } " (" (machine.threads) " threads, " (machine.system) ")."
                }
                (body)
            }
        }
    }
}
