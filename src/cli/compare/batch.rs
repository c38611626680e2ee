//! `shadowlab compare --batch`: a folder of pictures, each in a process of its own, on all cores.
//!
//! A process that hangs or grows is ended, and is a row like any other.

use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{ExitCode, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;
use shadowlab::labs::Handout;
use shadowlab::progress::Progress;
use shadowlab::{Error, Result, error, picture};

use super::{CompareCommand, DIFFERENT, SAME, TROUBLE};
use crate::cli::{child, print};

struct Row {
    file: String,
    /// What `compare --json` said of it, or why there is nothing.
    found: std::result::Result<Value, String>,
    /// The page, beside the index.
    page: String,
    seconds: f64,
}

pub fn run(command: &CompareCommand, folder: &Path, handout: &Handout) -> Result<ExitCode> {
    let output = command.output.clone().unwrap_or_else(|| "compared".into());
    let files = files(folder)?;
    std::fs::create_dir_all(&output).map_err(|cause| Error::writing(&output, cause))?;
    let cores = thread::available_parallelism().map_or(1, usize::from);

    let progress = Progress::new("comparing", files.len() as u64);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut rows = Vec::new();
        while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
            rows.push(compare(command, handout, file, &output));
            progress.add(1);
        }
        rows
    };
    let mut rows: Vec<Row> = thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        let rows = workers
            .into_iter()
            .map(|worker| worker.join().expect("a worker does not panic"));
        rows.flatten().collect()
    });
    drop(progress);

    // What cannot be judged first, then what differs most.
    rows.sort_by(|a, b| {
        b.share()
            .total_cmp(&a.share())
            .then_with(|| a.file.cmp(&b.file))
    });
    write_csv(&output.join("compared.csv"), &rows)?;
    let index = output.join("index.html");
    picture::write_whole(&index, |file| {
        file.write_all(index_page(handout, &rows).into_string().as_bytes())
    })?;
    let (same, broken) = (
        rows.iter().filter(|row| row.is_same()).count(),
        rows.iter().filter(|row| row.found.is_err()).count(),
    );
    print(&format!(
        "{}\n{} pictures: {same} the same within the tolerance, {} not, {broken} broken\n",
        index.display(),
        rows.len(),
        rows.len() - same - broken
    ))?;
    Ok(ExitCode::from(match same == rows.len() {
        true => SAME,
        false => DIFFERENT,
    }))
}

/// Everything in the folder that is no folder, by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let failed = |cause| Error::reading(folder, cause);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if !path.is_dir() {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(Error::input(
            folder,
            None,
            "found no file, expected pictures",
        ));
    }
    files.sort();
    Ok(files)
}

fn compare(command: &CompareCommand, handout: &Handout, file: &Path, output: &Path) -> Row {
    let name = file
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let page = format!("{name}.html");
    let mut words = vec![
        "compare".into(),
        file.as_os_str().to_owned(),
        handout.name.into(),
        "--json".into(),
        "--output".into(),
        output.join(&page).into_os_string(),
    ];
    words.extend(command.state_options(handout).into_iter().map(Into::into));
    let started = Instant::now();
    let found = limited(&words, Duration::from_secs(command.changes.limit));
    Row {
        file: name,
        found,
        page,
        seconds: started.elapsed().as_secs_f64(),
    }
}

/// Runs the program on itself, within limits.
fn limited(words: &[std::ffi::OsString], limit: Duration) -> std::result::Result<Value, String> {
    let failed = |cause: std::io::Error| format!("cannot start a process for it: {cause}");
    let mut child = child::command(words)
        .map_err(|error| error.to_string())?
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    let out = child::read_all(child.stdout.take().expect("it is piped"));
    let err = child::read_all(child.stderr.take().expect("it is piped"));
    let status = child::wait(&mut child, child::Limit::Cores(limit));
    let (out, err) = (out.join(), err.join());
    let (out, err) = (out.unwrap_or_default(), err.unwrap_or_default());
    match status {
        Ok(Some(status))
            if [SAME, DIFFERENT]
                .map(|code| Some(code.into()))
                .contains(&status.code()) =>
        {
            serde_json::from_slice(&out).map_err(|wrong| format!("unreadable: {wrong}"))
        }
        Ok(Some(status)) => {
            let text = String::from_utf8_lossy(&err);
            let message = text
                .lines()
                .next_back()
                .unwrap_or_default()
                .trim_start_matches("shadowlab: ");
            Err(match status.code() == Some(TROUBLE.into()) {
                true => error::one_line(message),
                false => error::one_line(&format!("ended with {status}: {message}")),
            })
        }
        Ok(None) => Err(format!("took longer than {} s", limit.as_secs())),
        Err(cause) => Err(failed(cause)),
    }
}

impl Row {
    fn is_same(&self) -> bool {
        self.found.as_ref().is_ok_and(|found| found["same"] == true)
    }

    /// The share of the pixels that differ; more than all, where nothing could be compared.
    fn share(&self) -> f64 {
        match &self.found {
            Ok(found) => found["difference"]["share"].as_f64().unwrap_or(0.0),
            Err(_) => 2.0,
        }
    }

    /// The first explanation.
    fn diagnosis(&self) -> String {
        let Ok(found) = &self.found else {
            return String::new();
        };
        match &found["diagnosis"] {
            Value::String(none) => none.clone(),
            Value::Array(found) => {
                let names = found.first().and_then(|found| found["mistakes"].as_array());
                let names = names.into_iter().flatten().filter_map(Value::as_str);
                names.collect::<Vec<_>>().join(" or ")
            }
            _ => String::new(),
        }
    }

    fn number(&self, place: &str) -> String {
        let value = self
            .found
            .as_ref()
            .ok()
            .and_then(|found| found.pointer(place));
        value
            .and_then(Value::as_f64)
            .map_or(String::new(), |number| format!("{number}"))
    }
}

const COLUMNS: [(&str, &str); 8] = [
    ("share", "/difference/share"),
    ("differing", "/difference/differing"),
    ("mean", "/difference/mean"),
    ("largest", "/difference/largest"),
    ("ssim", "/difference/ssim"),
    ("false_shadow", "/shadows/false_shadow/pixels"),
    ("false_light", "/shadows/false_light/pixels"),
    ("contact_gap", "/shadows/contact_gap/world"),
];

fn write_csv(path: &Path, rows: &[Row]) -> Result<()> {
    picture::write_whole(path, |file: &mut std::io::BufWriter<File>| {
        let mut csv = csv::Writer::from_writer(file);
        let columns = COLUMNS.map(|(name, _)| name);
        let head = ["file", "same"].into_iter().chain(columns);
        csv.write_record(head.chain(["diagnosis", "seconds", "trouble"]))?;
        for row in rows {
            let mut record = vec![row.file.clone(), row.is_same().to_string()];
            record.extend(COLUMNS.map(|(_, place)| row.number(place)));
            record.push(row.diagnosis());
            record.push(format!("{:.2}", row.seconds));
            record.push(row.found.as_ref().err().cloned().unwrap_or_default());
            csv.write_record(record)?;
        }
        csv.flush()
    })
}

const STYLE: &str = "
    body { font: 16px/1.45 sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
    table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
    th, td { border-bottom: 1px solid #ddd; padding: 0.2rem 0.6rem; text-align: right; }
    td.name { text-align: left; } tr.same { background: #d9f0dd; } tr.broken { background: #eee; }
";

fn index_page(handout: &Handout, rows: &[Row]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "shadowlab: a folder against " (handout.name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Held against " (handout.title) }
                p { "What could not be compared first, then by difference. " a href="compared.csv" { "compared.csv" } }
                table {
                    tr {
                        th { "picture" }
                        th { "pixels that differ" } th { "mean" } th { "SSIM" }
                        th { "false shadow" } th { "false light" } th { "diagnosis" }
                    }
                    @for row in rows { (index_row(row)) }
                }
            }
        }
    }
}

fn index_row(row: &Row) -> Markup {
    match &row.found {
        Err(message) => html! {
            tr.broken { td.name { (row.file) } td.name colspan="6" { (message) } }
        },
        Ok(_) => html! {
            tr.same[row.is_same()] {
                td.name { a href=(row.page) { (row.file) } }
                td { (format!("{:.2} %", 100.0 * row.share())) }
                @for place in ["/difference/mean", "/difference/ssim"] {
                    td { (row.number(place).parse::<f64>().map_or(String::new(), |n| format!("{n:.3}"))) }
                }
                @for place in ["/shadows/false_shadow/pixels", "/shadows/false_light/pixels"] {
                    td { (row.number(place)) }
                }
                td.name { (row.diagnosis()) }
            }
        },
    }
}
