//! A saved shader, tried in a process of its own before the viewer takes it: a loop in it may never end, and would take the
//! window with it.

use std::io::Read;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;
use std::time::Duration;

use super::shot::{self, State};
use crate::{Error, Result};

/// How often the process is looked at.
pub const PATIENCE: Duration = Duration::from_millis(10);
/// Of the picture that it draws, in pixels: what a shader does in every one of them, it does in these.
const SIZE: [u32; 2] = [64, 64];
/// How many seconds it may take, at most; a picture of this size takes well below one.
const LIMIT: &str = "10";

/// A small picture of the viewer's state, while it is drawn.
pub struct Trial {
    child: Child,
    said: Option<JoinHandle<Vec<u8>>>,
    picture: PathBuf,
}

impl Trial {
    /// The command itself ends what takes longer than its limit.
    pub fn start(state: &State) -> Result<Self> {
        let failed = |cause| Error::reading("shadowlab", cause);
        let name = format!("shadowlab-{}-trial.png", std::process::id());
        let picture = std::env::temp_dir().join(name);
        let words = shot::words(&State {
            size: SIZE,
            ..*state
        });
        let mut child = Command::new(std::env::current_exe().map_err(failed)?)
            .args(words)
            .args(["--limit", LIMIT, "--output"])
            .arg(&picture)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let said = child.stderr.take().map(|mut pipe| {
            std::thread::spawn(move || {
                let mut said = Vec::new();
                // What a killed process has not said is not missed.
                let _ = pipe.read_to_end(&mut said);
                said
            })
        });
        Ok(Self {
            child,
            said,
            picture,
        })
    }

    /// Whether there was a picture; None while it is drawn.
    pub fn result(&mut self) -> Option<Result<()>> {
        let status = match self.child.try_wait() {
            Ok(None) => return None,
            Ok(Some(status)) => status,
            Err(cause) => return Some(Err(Error::reading("shadowlab", cause))),
        };
        if status.success() {
            return Some(Ok(()));
        }
        let said = self.said.take().and_then(|said| said.join().ok());
        let said = String::from_utf8_lossy(&said.unwrap_or_default()).into_owned();
        let last = said.lines().next_back().unwrap_or("no message");
        Some(Err(Error::gl(last.trim_start_matches("shadowlab: "))))
    }
}

impl Drop for Trial {
    fn drop(&mut self) {
        // Where it has ended there is nothing to kill.
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_file(&self.picture);
    }
}
