//! A process of its own for what may never end or take all memory: a student's picture, or a student's shader.

use std::ffi::{OsStr, OsString};
use std::io::Read as _;
use std::path::Path;
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use shadowlab::{Error, Result};

use super::state::State;

/// What it may take, in KiB of addresses: a picture of 16,384 × 16,384 pixels and the driver.
const MOST_KIB: u64 = 6 << 20;
/// How often it is looked at.
const PATIENCE: Duration = Duration::from_millis(10);
/// Set in the environment of a process that draws with a student's shaders.
const MARK: &str = "SHADOWLAB_CHILD";
/// The size at which shaders are tried, in pixels.
const SMALL: &str = "64x64";

/// This program with other words behind it, within the limit on memory; where there is a lower one already, within that.
pub fn command(words: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Result<Command> {
    let program = std::env::current_exe().map_err(|cause| Error::reading("shadowlab", cause))?;
    let mut command = Command::new("sh");
    command
        .args([
            "-c",
            &format!("ulimit -v {MOST_KIB} 2>/dev/null; exec \"$0\" \"$@\""),
        ])
        .arg(program)
        .args(words)
        .stdin(Stdio::null());
    Ok(command)
}

/// How long a process may take.
#[derive(Clone, Copy)]
pub enum Limit {
    /// By the clock on the wall: a shader may keep a GPU busy, and no core.
    Wall(Duration),
    /// Of the cores' time: other work on the machine does not count. By the clock it may take [`PATIENT`] times as long.
    Cores(Duration),
}

const PATIENT: u32 = 10;
/// In which Linux counts a process's time, in seconds.
const TICK: f64 = 0.01;

impl Limit {
    fn is_over(self, child: &Child, started: Instant) -> bool {
        match self {
            Self::Wall(limit) => started.elapsed() > limit,
            Self::Cores(limit) => {
                started.elapsed() > PATIENT * limit
                    || cores_time(child).is_some_and(|seconds| seconds > limit.as_secs_f64())
            }
        }
    }
}

/// User's and system's time of a process, in seconds: the 14th and 15th word of its line, of which the second is its name
/// in parentheses.
fn cores_time(child: &Child) -> Option<f64> {
    let line = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    let (_, behind_name) = line.rsplit_once(')')?;
    let words = behind_name.split_whitespace().skip(11).take(2);
    let ticks: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    Some(TICK * ticks?.iter().sum::<f64>())
}

/// None: it was still running at its limit, and was killed.
pub fn wait(child: &mut Child, limit: Limit) -> std::io::Result<Option<ExitStatus>> {
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if limit.is_over(child, started) {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(PATIENCE);
    }
}

/// Whether this process is the one that draws with a student's shaders.
pub fn is_one() -> bool {
    std::env::var_os(MARK).is_some()
}

/// Ends this process with the one that started it, whose end of the pipe nobody holds then.
pub fn end_with_parent() {
    std::thread::spawn(|| {
        let _ = std::io::stdin().read(&mut [0]);
        // A driver whose shader does not end can hold up an orderly exit.
        std::process::abort();
    });
}

/// Runs this very command line again, in a process that is killed after its limit: a shader of `changes` may never end.
pub fn again(folder: &Path, limit: u64) -> Result<ExitCode> {
    run(std::env::args_os().skip(1), folder, limit, false)
}

/// Draws a small picture of the state in a process of its own; an error where that cannot be done.
pub fn try_first(state: &State, folder: &Path) -> Result<()> {
    let picture = std::env::temp_dir().join(format!("shadowlab-{}.png", std::process::id()));
    let mut words: Vec<OsString> = ["screenshot", &state.lab, "--size", SMALL, "--output"]
        .map(OsString::from)
        .to_vec();
    words.push(picture.clone().into_os_string());
    words.extend(state.all_options().into_iter().map(OsString::from));
    let tried = run(words, folder, state.changes.limit, true);
    let _ = std::fs::remove_file(picture);
    tried.map(|_| ())
}

/// The exit code; with `quiet`, what the process says is kept for the error where that is not 0.
fn run(
    words: impl IntoIterator<Item = OsString>,
    folder: &Path,
    limit: u64,
    quiet: bool,
) -> Result<ExitCode> {
    let failed = |cause: std::io::Error| {
        Error::input(
            folder,
            None,
            format!("cannot start a process for its shaders: {cause}"),
        )
    };
    let mut command = command(words)?;
    command.env(MARK, "1").stdin(Stdio::piped());
    if quiet {
        command.stdout(Stdio::null()).stderr(Stdio::piped());
    }
    let mut child = command.spawn().map_err(failed)?;
    // Its end tells the process that this one is gone.
    let _alive = child.stdin.take();
    let said = child.stderr.take().map(read_all);
    let status = wait(&mut child, Limit::Wall(Duration::from_secs(limit))).map_err(failed)?;
    let said = said.map(|said| said.join().unwrap_or_default());
    let Some(status) = status else {
        return Err(Error::input(
            folder,
            None,
            format!(
                "drawing with its shaders took longer than {limit} s, expected a picture by then: a loop there may \
                 never end (--limit SECONDS allows more)"
            ),
        ));
    };
    match (status.code(), said) {
        (Some(0), _) => Ok(ExitCode::SUCCESS),
        (Some(code), None) => Ok(ExitCode::from(u8::try_from(code).unwrap_or(u8::MAX))),
        (Some(_), Some(said)) => {
            let said = String::from_utf8_lossy(&said);
            let last = said.lines().next_back().unwrap_or_default();
            Err(Error::gl(last.trim_start_matches("shadowlab: ")))
        }
        (None, _) => Err(Error::input(
            folder,
            None,
            format!("drawing with its shaders ended with {status}, expected a picture"),
        )),
    }
}

/// What comes out of a pipe, read while the process writes, since pipes have an end.
pub fn read_all(mut pipe: impl std::io::Read + Send + 'static) -> std::thread::JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What a killed process has not written is not missed.
        let _ = pipe.read_to_end(&mut bytes);
        bytes
    })
}
