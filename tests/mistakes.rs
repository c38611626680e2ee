//! `shadowlab mistakes`: the page of the classic mistakes, and the proof that `compare` finds them.

mod common;

use std::path::Path;
use std::process::Command;

use common::work_folder;
use shadowlab::compare::{Envelope, SAME, TOLERANCE};
use shadowlab::mistakes;

fn shadowlab(folder: &Path, arguments: &str) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
    command.current_dir(folder);
    command.args(arguments.split_whitespace());
    let done = command.args(["--device", "software"]).output().unwrap();
    assert!(done.status.success(), "{done:?}");
    String::from_utf8(done.stdout).unwrap()
}

fn rows(path: &Path) -> Vec<csv::StringRecord> {
    let mut csv = csv::Reader::from_path(path).unwrap();
    csv.records().map(Result::unwrap).collect()
}

/// As a page has it.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

#[test]
fn the_gallery_shows_each_mistake_beside_the_right_picture() {
    let folder = work_folder("mistakes_gallery");
    let told = shadowlab(&folder, "mistakes eecs487 --percent 25 -o gallery");
    assert_eq!(told, "gallery/index.html\n");
    let page = std::fs::read_to_string(folder.join("gallery/index.html")).unwrap();
    for (mistake, made) in mistakes::of_lab("eecs487") {
        assert!(page.contains(&format!("<h3>{}</h3>", mistake.name)));
        for sentence in [mistake.symptom, mistake.cause, mistake.fix, made.place] {
            assert!(page.contains(&escaped(sentence)), "{sentence}");
        }
        // Of the first frame nobody sees it; it is told all the same.
        if mistake.name == "accumulator_not_cleared" {
            assert_eq!(page.matches("No picture of this lab shows it").count(), 1);
            continue;
        }
        let picture = |what| {
            let path = folder.join(format!("gallery/eecs487/{}-{what}.png", mistake.name));
            image::open(path).unwrap().into_rgb8()
        };
        let (right, wrong) = (picture("right"), picture("wrong"));
        assert_eq!(right.dimensions(), (150, 150));
        let right = Envelope::new(&right);
        assert!(
            right.share_outside(&wrong, TOLERANCE) > SAME,
            "{}",
            mistake.name
        );
    }
    // The command under a pair shows it: the state is the one that the pair is of.
    let view = "shadowlab view eecs487 ";
    assert_eq!(
        page.matches(view).count(),
        mistakes::of_lab("eecs487").count() - 1
    );
}

#[test]
fn the_proof_counts_what_it_asked() {
    let folder = work_folder("mistakes_proof");
    shadowlab(
        &folder,
        "mistakes eecs487 --prove 2 --percent 25 --seed 5 -o proof",
    );
    let found = rows(&folder.join("proof/proof.csv"));
    let number = |row: &csv::StringRecord, column: usize| row[column].parse::<u32>().unwrap();
    let mut asked = 0;
    for (mistake, _) in mistakes::of_lab("eecs487") {
        let of_name: Vec<_> = found.iter().filter(|row| &row[1] == mistake.name).collect();
        let (states, drawn) = (number(of_name[0], 2), number(of_name[0], 3));
        assert!(
            states <= 2 && (states == 2 || drawn == 16),
            "{}",
            mistake.name
        );
        // Each state asks once as drawn and once perturbed.
        let (as_drawn, perturbed): (Vec<_>, Vec<_>) =
            of_name.iter().partition(|row| &row[4] == "as drawn");
        let sum = |rows: &[&&csv::StringRecord]| rows.iter().map(|row| number(row, 5)).sum::<u32>();
        assert_eq!(
            [sum(&as_drawn), sum(&perturbed)],
            [states; 2],
            "{}",
            mistake.name
        );
        asked += 2 * states;
        // What was drawn is among the suspects itself.
        for row in as_drawn {
            assert_eq!(row[5], row[6], "{row:?}");
        }
    }
    // Of what was asked, what was not told first was told otherwise.
    let first: u32 = found.iter().map(|row| number(row, 6)).sum();
    let confused = rows(&folder.join("proof/confusions.csv"));
    let confused: u32 = confused.iter().map(|row| number(row, 3)).sum();
    assert!(
        asked > 10 && first + confused == asked,
        "{asked} {first} {confused}"
    );
    for row in rows(&folder.join("proof/right.csv")) {
        assert!(number(&row, 2) > 0 && number(&row, 3) == 0, "{row:?}");
    }
    let page = std::fs::read_to_string(folder.join("proof/proof.html")).unwrap();
    assert!(page.contains("How often compare finds the mistake") && page.contains("seed 5"));
}
