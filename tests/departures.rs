//! A departure from a handout is told twice: where it happens, in a comment `// DEVIATES: what, why`, and in
//! the README's table. This test holds the two against each other.
//!
//! `what` is the comment's text up to the first comma or colon, and the first cell of the row, word for word.
//! A departure that happens in several places has as many tags and one row.

mod source;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use source::Source;

const HEADING: &str = "## Departures from the handouts";
const COLUMNS: [&str; 3] = ["departure", "where", "why"];

#[test]
fn every_departure_stands_in_the_readme() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = source::files("src");
    if root.join("glsl").is_dir() {
        sources.extend(source::files("glsl"));
    }
    let readme = fs::read_to_string(root.join("README.md")).expect("README.md");
    let complaints = check(&sources, &readme);
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// What is wrong, one line each.
fn check(sources: &[Source], readme: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    let rows = rows(readme, &mut complaints);
    let mut tagged = BTreeSet::new();
    for source in sources {
        for (line, tag) in tags(&source.text) {
            let place = format!("{}:{line}", source.path);
            match tag {
                None => complaints.push(format!("{place}: expected `DEVIATES: what, why`")),
                Some(what) => {
                    if !rows.contains(&what) {
                        complaints.push(format!("{place}: README.md has no row \"{what}\""));
                    }
                    tagged.insert(what);
                }
            }
        }
    }
    for row in rows.difference(&tagged) {
        complaints.push(format!(
            "README.md: no source has a tag `DEVIATES: {row}, …`"
        ));
    }
    complaints
}

/// The tags of one file: the line, counted from 1, and `what`; None where what or why is not there.
fn tags(text: &str) -> Vec<(usize, Option<String>)> {
    let comments: Vec<Option<&str>> = text.lines().map(comment).collect();
    let mut tags = Vec::new();
    for (index, first) in comments.iter().enumerate() {
        let Some(rest) = first.and_then(|text| text.strip_prefix("DEVIATES")) else {
            continue;
        };
        // A tag may go on over the lines of its comment, up to the next tag.
        let more = comments[index + 1..]
            .iter()
            .map_while(|comment| comment.filter(|text| !text.starts_with("DEVIATES")));
        let whole: Vec<&str> = std::iter::once(rest).chain(more).collect();
        let whole = whole.join(" ");
        let what = whole
            .strip_prefix(':')
            .and_then(|text| text.split_once([',', ':']))
            .map(|(what, why)| (words(what), words(why)))
            .filter(|(what, why)| !what.is_empty() && !why.is_empty())
            .map(|(what, _)| what);
        tags.push((index + 1, what));
    }
    tags
}

/// The text of a line's comment, without its slashes.
fn comment(line: &str) -> Option<&str> {
    let (_, text) = line.split_once("//")?;
    Some(text.trim_start_matches(['/', '!']).trim())
}

/// The first cells of the table under the heading.
fn rows(readme: &str, complaints: &mut Vec<String>) -> BTreeSet<String> {
    let mut rows = BTreeSet::new();
    let mut table = readme
        .lines()
        .skip_while(|line| line.trim_end() != HEADING)
        .skip(1)
        .take_while(|line| !line.starts_with('#'))
        .filter_map(cells);
    if table.next().is_none_or(|head| head != COLUMNS) {
        let columns = COLUMNS.join(" | ");
        complaints.push(format!(
            "README.md: expected a table | {columns} | under \"{HEADING}\""
        ));
        return rows;
    }
    // The line of dashes.
    table.next();
    for cells in table {
        if cells.len() != COLUMNS.len() || cells.iter().any(String::is_empty) {
            complaints.push(format!(
                "README.md: a row of three full cells, not {cells:?}"
            ));
        } else if !rows.insert(cells[0].clone()) {
            complaints.push(format!("README.md: two rows \"{}\"", cells[0]));
        }
    }
    rows
}

/// The cells of a line of a table; None for any other line.
fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    Some(inner.split('|').map(words).collect())
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

// --- controls: what must be reported ---

fn complaints(text: &str, table: &str) -> Vec<String> {
    let source = Source {
        path: "src/labs/made_up.rs".to_owned(),
        text: text.to_owned(),
    };
    let readme = format!("# Name\n\n{HEADING}\n\n{table}\n## Next\n\n| not | of | this |\n");
    check(&[source], &readme)
}

const TABLE: &str = "| departure | where | why |\n|---|---|---|\n";

#[test]
fn a_tag_with_its_row_passes() {
    let row = format!("{TABLE}| red copied to blue | labs | `.z` reads 0 |\n");
    let whole = "fn f() {\n    // DEVIATES: red copied to blue, as `.z` reads 0.\n}\n";
    assert_eq!(complaints(whole, &row), [""; 0]);
    let wrapped = "g(); // DEVIATES: red copied\n    // to blue: as `.z` reads 0.\n";
    assert_eq!(complaints(wrapped, &row), [""; 0]);
    let twice = [whole, wrapped].concat();
    assert_eq!(complaints(&twice, &row), [""; 0]);
}

#[test]
fn a_tag_without_a_row_fails() {
    let text =
        "// DEVIATES: red copied to blue, as `.z` reads 0\n// DEVIATES: no alpha, it is unused\n";
    let row = format!("{TABLE}| no alpha | labs | unused |\n");
    assert_eq!(
        complaints(text, &row),
        ["src/labs/made_up.rs:1: README.md has no row \"red copied to blue\""]
    );
}

#[test]
fn a_row_without_a_tag_fails() {
    let row = format!("{TABLE}| no alpha | labs | unused |\n");
    // The word in the middle of a comment, or in the code, is no tag.
    for text in [
        "",
        "// see DEVIATES: no alpha, unused\n",
        "let s = \"DEVIATES: no alpha, x\";\n",
    ] {
        assert_eq!(
            complaints(text, &row),
            ["README.md: no source has a tag `DEVIATES: no alpha, …`"]
        );
    }
}

#[test]
fn a_tag_without_a_reason_fails() {
    for text in [
        "// DEVIATES: no alpha\n",
        "// DEVIATES no alpha, unused\n",
        "// DEVIATES: , unused\n",
        "// DEVIATES: no alpha,\nlet a = 1;\n",
    ] {
        assert_eq!(
            complaints(text, TABLE),
            ["src/labs/made_up.rs:1: expected `DEVIATES: what, why`"],
            "{text}"
        );
    }
}

#[test]
fn a_broken_table_fails() {
    let no_table = complaints("", "Nothing here.\n");
    assert!(no_table[0].contains("expected a table"), "{no_table:?}");

    let tag = "// DEVIATES: no alpha, unused\n";
    let empty_cell = complaints(tag, &format!("{TABLE}| no alpha | labs | |\n"));
    assert!(empty_cell[0].contains("three full cells"), "{empty_cell:?}");

    let row = "| no alpha | labs | unused |\n";
    let twice = complaints(tag, &format!("{TABLE}{row}{row}"));
    assert_eq!(twice, ["README.md: two rows \"no alpha\""]);
}
