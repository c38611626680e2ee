//! The command line: parse, dispatch, exit code.

#![forbid(unsafe_code)]

mod cli;

use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

fn main() -> ExitCode {
    match cli::Cli::try_parse() {
        Err(asked)
            if matches!(
                asked.kind(),
                ErrorKind::DisplayHelp | ErrorKind::DisplayVersion
            ) =>
        {
            print!("{asked}");
            ExitCode::SUCCESS
        }
        Err(wrong) => fail(&one_line(&wrong), 2),
        Ok(command) => {
            let trouble = command.trouble_code();
            command.run().unwrap_or_else(|error| {
                fail(
                    &error.to_string(),
                    trouble.unwrap_or_else(|| error.exit_code()),
                )
            })
        }
    }
}

fn fail(message: &str, code: u8) -> ExitCode {
    eprintln!("shadowlab: {message}");
    ExitCode::from(code)
}

/// What clap found, without its paragraphs of usage.
fn one_line(wrong: &clap::Error) -> String {
    let text = wrong.to_string();
    let paragraph = text.split("\n\nUsage:").next().unwrap_or(&text);
    let paragraph = paragraph.split("\n\nFor more").next().unwrap_or(paragraph);
    let paragraph = paragraph.strip_prefix("error: ").unwrap_or(paragraph);
    let line = paragraph.split_whitespace().collect::<Vec<_>>().join(" ");
    match wrong.kind() {
        ErrorKind::ValueValidation | ErrorKind::InvalidValue => line,
        _ => format!("{line} (shadowlab --help lists what there is)"),
    }
}
