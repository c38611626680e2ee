//! A lab that is started for a report, with a scene of the report's own.

use crate::Result;
use crate::headless::Headless;
use crate::labs::{Handout, Kind, Lab, Settings};
use crate::scene::Scene;

/// Starts the lab. Several labs of one kind may share a context: each frame binds what it uses.
pub fn start(
    handout: &Handout,
    context: &Headless,
    scene: Scene,
    size: [u32; 2],
) -> Result<Box<dyn Lab>> {
    let mut lab = (handout.start)(&context.gl, scene, None)?;
    lab.resize(size);
    Ok(lab)
}

/// The setting that chooses between a lab's shadow tests.
pub const SHADOW_TEST: &str = "shadow_test";
/// Its value that draws no map: neither a map's size nor its format is anything to it.
pub const EXACT: &str = "exact";

/// The shadow tests of a lab, the handout's first; one that offers no choice has the handout's alone.
pub fn shadow_tests(handout: &Handout) -> &'static [&'static str] {
    let setting = handout.settings.iter().find(|s| s.name == SHADOW_TEST);
    match setting.map(|setting| &setting.kind) {
        Some(Kind::Choice(names)) => names,
        _ => &["handout"],
    }
}

/// What chooses one of them, as `--set` writes it; nothing where it is the default.
pub fn choosing(handout: &Handout, shadow_test: &str) -> Vec<String> {
    if shadow_tests(handout)[0] == shadow_test {
        return Vec::new();
    }
    vec![format!("{SHADOW_TEST}={shadow_test}")]
}

/// The settings after these assignments.
pub fn assigned(now: &Settings, assignments: &[String]) -> Result<Settings> {
    let mut settings = now.clone();
    let mut each = assignments.iter();
    each.try_for_each(|assignment| settings.set(assignment))?;
    Ok(settings)
}
