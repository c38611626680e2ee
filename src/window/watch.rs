//! The student's folder of shaders: says when a file there was saved.

use std::path::Path;

use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Event, RecommendedWatcher, RecursiveMode, Watcher};

use crate::{Error, Result};

/// Calls `saved` when a shader of the folder has been written, until the returned watcher is dropped.
///
/// The folder is watched and not its files: many editors write a new file and give it the old one's name.
pub fn watch(folder: &Path, saved: impl Fn() + Send + 'static) -> Result<RecommendedWatcher> {
    let cannot = |error: notify::Error| {
        let message = format!("cannot watch it for saved shaders: {error}");
        Error::input(folder, None, message)
    };
    let heard = move |event: notify::Result<Event>| {
        if event.is_ok_and(|event| is_saved(&event)) {
            saved();
        }
    };
    let mut watcher = notify::recommended_watcher(heard).map_err(cannot)?;
    watcher
        .watch(folder, RecursiveMode::NonRecursive)
        .map_err(cannot)?;
    Ok(watcher)
}

fn is_saved(event: &Event) -> bool {
    // Reading a file is an event too, and the viewer reads them itself.
    let changes = match event.kind {
        EventKind::Access(access) => access == AccessKind::Close(AccessMode::Write),
        _ => true,
    };
    let is_shader = |path: &Path| {
        path.extension()
            .is_some_and(|kind| kind == "vert" || kind == "frag" || kind == "glsl")
    };
    changes && event.paths.iter().any(|path| is_shader(path))
}
