//! The proof as a page and as tables.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use shadowlab::compare::{SAME, TOLERANCE};
use shadowlab::labs::Handout;
use shadowlab::{Result, picture};

use super::MistakesCommand;
use super::perturbed::{ALL, Perturbed};
use super::proof::{Accused, Proof, Tally};

/// `proof.csv`, `right.csv` and `confusions.csv`.
pub fn write_tables(command: &MistakesCommand, proofs: &[(&Handout, Proof)]) -> Result<()> {
    let mut found = vec![row([
        "lab",
        "mistake",
        "states",
        "drawn",
        "picture",
        "asked",
        "first",
        "among_first",
    ])];
    let mut right = vec![row(["lab", "picture", "asked", "accused"])];
    let mut confusions = vec![row(["lab", "mistake", "told", "times"])];
    for (lab, proof) in proofs {
        for (name, of_name) in &proof.mistakes {
            let states = [of_name.states, of_name.drawn].map(|count| count.to_string());
            let [states, drawn] = &states;
            // A mistake that no picture showed has its row, too.
            if of_name.tallies.is_empty() {
                found.push(row([lab.name, name, states, drawn, "", "0", "0", "0"]));
            }
            for (perturbed, tally) in &of_name.tallies {
                let counts =
                    [tally.asked, tally.first, tally.among_first].map(|count| count.to_string());
                let [asked, first, among_first] = &counts;
                found.push(row([
                    lab.name,
                    name,
                    states,
                    drawn,
                    perturbed.name(),
                    asked,
                    first,
                    among_first,
                ]));
            }
        }
        for (perturbed, Accused { asked, accused }) in &proof.right {
            right.push(row([
                lab.name,
                perturbed.name(),
                &asked.to_string(),
                &accused.to_string(),
            ]));
        }
        for ((name, told), times) in &proof.confusions {
            confusions.push(row([lab.name, name, told, &times.to_string()]));
        }
    }
    for (name, rows) in [
        ("proof.csv", found),
        ("right.csv", right),
        ("confusions.csv", confusions),
    ] {
        picture::write_whole(&command.output.join(name), |file| {
            let mut csv = csv::Writer::from_writer(file);
            rows.iter().try_for_each(|row| csv.write_record(row))?;
            csv.flush()
        })?;
    }
    Ok(())
}

fn row<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).into()
}

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
    th, td { border-bottom: 1px solid #ddd; padding: 0.15rem 0.6rem; text-align: right; }
    td.name { text-align: left; }
";

pub fn page(command: &MistakesCommand, states: u32, proofs: &[(&Handout, Proof)]) -> Markup {
    let everything: Vec<_> = proofs.iter().map(|(_, proof)| proof).collect();
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
                    "Random states of each lab (seed " (command.seed) "), at " (command.percent) " % of the course's \
                     window, until each mistake was seen in " (states) " of them. A mistake is seen in a state where it \
                     changes more than " (100.0 * SAME) " % of the pixels by more than " (TOLERANCE) " levels. Each \
                     picture is asked about as drawn, and once more under one of the perturbations. First: the mistake \
                     is told first, or is in the group that is. Figures in percent."
                }
                h2 { "All of them" }
                (by_picture(&everything))
                @for (lab, proof) in proofs { (of_lab(lab, proof)) }
            }
        }
    }
}

fn of_lab(lab: &Handout, proof: &Proof) -> Markup {
    let (seen, unseen): (Vec<_>, Vec<_>) = proof
        .mistakes
        .iter()
        .partition(|(_, found)| found.states > 0);
    let unseen: Vec<_> = unseen.into_iter().map(|(name, _)| *name).collect();
    html! {
        h2 { (lab.title) }
        p { (proof.drawn) " states were drawn." }
        @if !unseen.is_empty() {
            p { "No picture showed " (unseen.join(", ")) ": for a check of the calls, or of the shaders." }
        }
        (by_picture(&[proof]))
        h3 { "By mistake" }
        table {
            tr {
                th { "mistake" } th { "seen in" } th { "of states" }
                th { "as drawn" } th { "perturbed" } th { "among the first three" }
                th { "told instead" }
            }
            @for (name, found) in seen {
                @let of = |is_drawn: bool| {
                    let mut sum = Tally::default();
                    let tallies = found.tallies.iter();
                    tallies.filter(|(of, _)| (**of == Perturbed::Not) == is_drawn).for_each(|(_, tally)| sum.join(tally));
                    sum
                };
                @let (drawn, perturbed) = (of(true), of(false));
                tr {
                    td.name { (name) } td { (found.states) } td { (found.drawn) }
                    td { (percent(drawn.first, drawn.asked)) }
                    td { (percent(perturbed.first, perturbed.asked)) }
                    td { (percent(drawn.among_first + perturbed.among_first, drawn.asked + perturbed.asked)) }
                    td.name { (told_instead(proof, name)) }
                }
            }
        }
    }
}

fn by_picture(proofs: &[&Proof]) -> Markup {
    let line = |title: &str, passes: &dyn Fn(Perturbed) -> bool| {
        let (mut tally, mut right) = (Tally::default(), Accused::default());
        for proof in proofs {
            tally.join(&proof.total(passes));
            for (_, of) in proof.right.iter().filter(|(of, _)| passes(**of)) {
                right.asked += of.asked;
                right.accused += of.accused;
            }
        }
        html! {
            tr {
                td.name { (title) } td { (tally.asked) }
                td { (percent(tally.first, tally.asked)) }
                td { (percent(tally.among_first, tally.asked)) }
                td { (right.asked) } td { (right.accused) } td { (percent(right.accused, right.asked)) }
            }
        }
    };
    html! {
        table {
            tr {
                th { "picture" } th { "asked" } th { "first" } th { "among the first three" }
                th { "right pictures" } th { "accused" } th { "%" }
            }
            @for perturbed in ALL { (line(perturbed.name(), &|of| of == perturbed)) }
            (line("all", &|_| true))
        }
    }
}

fn told_instead(proof: &Proof, name: &str) -> String {
    let confusions = proof.confusions.iter();
    let of_name = confusions.filter(|((mistake, _), _)| *mistake == name);
    let words = of_name.map(|((_, told), times)| format!("{told} {times}×"));
    words.collect::<Vec<_>>().join(", ")
}

fn percent(part: u32, of: u32) -> String {
    match of {
        0 => String::new(),
        _ => format!("{:.1}", 100.0 * f64::from(part) / f64::from(of)),
    }
}
