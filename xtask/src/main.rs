//! `cargo xtask COMMAND`: what this repository does beside building.
//!
//! [`setup`] finds a driver, and what else a command needs; [`assets`] makes the files of `assets/`;
//! everything else is cargo, called with the right words.
#![forbid(unsafe_code)]

mod assets;
mod setup;

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::{Command, ExitCode};

use setup::Need;

const HELP: &str = "\
cargo xtask COMMAND

  run [LAB] [-- OPTION…]   open the lab (cs541 where none is named) in a window, or, where there is no
                           display, write a screenshot to LAB.png; the options go to `shadowlab view`,
                           or to `shadowlab screenshot`
  test [FILTER…]           run every test of the workspace, without a display
  soak [FRAMES]            100,000 frames in the viewer, and the memory that they leave behind
  bless [CASE…]            rewrite the golden pictures of tests/golden
  fuzz [COUNT]             run the fuzzers with COUNT inputs for each parser (a million where none is said)
  assets                   rewrite the models, textures and scene files of assets
  help                     this text

`run`, `test`, `soak` and `bless` look for an OpenGL 3.3 driver first, and for what else they need. Where
something is missing, they install it on Debian and its kin (as root or through sudo), and elsewhere name the packages and stop.";

/// A wrong command line: exit code 2, where every other failure is 1 or the code of the program called.
#[derive(Debug)]
struct Usage(String);

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} (see `cargo xtask help`)", self.0)
    }
}

impl Error for Usage {}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match dispatch(&words) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("xtask: {error}");
            ExitCode::from(if error.is::<Usage>() { 2 } else { 1 })
        }
    }
}

fn dispatch(words: &[&str]) -> Result<ExitCode, Box<dyn Error>> {
    match words {
        [] | ["help" | "--help" | "-h"] => {
            println!("{HELP}");
            Ok(ExitCode::SUCCESS)
        }
        ["run", rest @ ..] => run(rest),
        ["test", filters @ ..] => test(filters),
        ["soak"] => soak("100000"),
        ["soak", frames] => soak(frames),
        ["bless", cases @ ..] => bless(cases),
        ["fuzz"] => fuzz("1000000"),
        ["fuzz", count] => fuzz(count),
        ["assets"] => {
            assets::write_all(&root().join("assets"))?;
            Ok(ExitCode::SUCCESS)
        }
        // Not in the help: `setup` asks a new process what drivers there are.
        [setup::PROBE, need] => Ok(setup::probe(need)),
        ["soak" | "fuzz", _, extra, ..] | ["help" | "--help" | "-h" | "assets", extra, ..] => {
            Err(Usage(format!("{}: unexpected argument \"{extra}\"", words[0])).into())
        }
        [command, ..] => Err(Usage(format!("there is no command \"{command}\"")).into()),
    }
}

fn run(words: &[&str]) -> Result<ExitCode, Box<dyn Error>> {
    let (lab, options) = lab_and_options(words)?;
    let display = DISPLAYS[..2]
        .iter()
        .any(|name| env::var_os(name).is_some_and(|value| !value.is_empty()));
    let command = if display { "view" } else { "screenshot" };
    setup::ensure(if display {
        &[Need::AnyDriver, Need::WindowLibraries]
    } else {
        &[Need::AnyDriver]
    })?;
    // The screenshot writes LAB.png where no option says otherwise, and prints the file's name itself.
    exit_code(
        cargo_with_display("run")
            .args(["--quiet", "--package", "shadowlab", "--"])
            .args([command, lab])
            .args(options),
    )
}

/// `[LAB] [-- OPTION…]`.
fn lab_and_options<'a>(words: &'a [&'a str]) -> Result<(&'a str, &'a [&'a str]), Usage> {
    match words {
        [] => Ok(("cs541", &[])),
        ["--", options @ ..] => Ok(("cs541", options)),
        [option, ..] if option.starts_with('-') => Err(Usage(format!(
            "run: the program's options come after \"--\", found \"{option}\" before it"
        ))),
        [lab] => Ok((lab, &[])),
        [lab, "--", options @ ..] => Ok((lab, options)),
        [_, extra, ..] => Err(Usage(format!("run: unexpected argument \"{extra}\""))),
    }
}

fn test(filters: &[&str]) -> Result<ExitCode, Box<dyn Error>> {
    setup::ensure(&[
        Need::SoftwareDriver,
        Need::Apitrace,
        Need::WindowLibraries,
        Need::Xvfb,
        Need::Xdotool,
    ])?;
    exit_code(cargo("test").args(["--workspace", "--"]).args(filters))
}

fn soak(frames: &str) -> Result<ExitCode, Box<dyn Error>> {
    // The memory is measured from the thousandth frame on.
    if !frames.parse::<u32>().is_ok_and(|frames| frames >= 2000) {
        return Err(Usage(format!("soak: \"{frames}\", expected 2000 frames or more")).into());
    }
    setup::ensure(&[Need::WindowLibraries, Need::Xvfb, Need::Xdotool])?;
    exit_code(
        cargo("test")
            .args(["--test", "soak", "--", "--ignored", "--nocapture"])
            .env("SHADOWLAB_SOAK_FRAMES", frames),
    )
}

fn fuzz(count: &str) -> Result<ExitCode, Box<dyn Error>> {
    if count.parse::<u64>().is_err() {
        return Err(Usage(format!(
            "fuzz: found \"{count}\", expected a number of inputs"
        ))
        .into());
    }
    exit_code(
        cargo("test")
            // One after the other: the memory that is printed is the whole program's.
            .args(["--test", "fuzz", "--"])
            .args(["--nocapture", "--test-threads=1"])
            .env("SHADOWLAB_FUZZ", count),
    )
}

fn bless(cases: &[&str]) -> Result<ExitCode, Box<dyn Error>> {
    setup::ensure(&[Need::SoftwareDriver])?;
    exit_code(
        cargo("test")
            .args(["--test", "goldens", "--"])
            .args(cases)
            .env("SHADOWLAB_BLESS", "1"),
    )
}

/// Where a program finds a display.
const DISPLAYS: [&str; 3] = ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"];

/// `cargo SUBCOMMAND` on this workspace, from whatever folder the user stands in.
///
/// The display is taken away: what runs here must not come to depend on one.
fn cargo(subcommand: &str) -> Command {
    let mut command = cargo_with_display(subcommand);
    for display in DISPLAYS {
        command.env_remove(display);
    }
    command
}

fn cargo_with_display(subcommand: &str) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .args([subcommand, "--release", "--manifest-path"])
        .arg(root().join("Cargo.toml"));
    command
}

/// Runs the command and hands its exit code on; 1 where a signal ended it.
fn exit_code(command: &mut Command) -> Result<ExitCode, Box<dyn Error>> {
    let program = command.get_program().to_string_lossy().into_owned();
    let status = command
        .status()
        .map_err(|cause| format!("{program}: cannot start it: {cause}"))?;
    let code = status.code().and_then(|code| u8::try_from(code).ok());
    Ok(ExitCode::from(code.unwrap_or(1)))
}

/// The root of the repository.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("xtask lies in the root")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lab_comes_before_the_options() {
        let parsed = |words: &[&str]| {
            lab_and_options(words)
                .map(|(lab, options)| format!("{lab}: {}", options.join(" ")))
                .ok()
        };
        assert_eq!(parsed(&[]).as_deref(), Some("cs541: "));
        assert_eq!(parsed(&["aueb7"]).as_deref(), Some("aueb7: "));
        assert_eq!(
            parsed(&["--", "--time", "2"]).as_deref(),
            Some("cs541: --time 2")
        );
        assert_eq!(
            parsed(&["aueb7", "--", "--time", "2"]).as_deref(),
            Some("aueb7: --time 2")
        );
        assert_eq!(parsed(&["aueb7", "cs541"]), None);
        assert_eq!(parsed(&["--time", "2"]), None);
    }

    #[test]
    fn an_unknown_command_is_a_wrong_command_line() {
        for words in [
            &["tset"][..],
            &["help", "run"],
            &["assets", "all"],
            &["soak", "many"],
            &["soak", "1000"],
            &["soak", "2000", "more"],
            &["fuzz", "many"],
        ] {
            assert!(dispatch(words).unwrap_err().is::<Usage>(), "{words:?}");
        }
    }
}
