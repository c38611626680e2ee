//! What a report was measured on: figures without it say nothing.

use crate::headless::Headless;

#[derive(Clone, Debug)]
pub struct Machine {
    /// `GL_RENDERER`.
    pub renderer: String,
    /// `GL_VERSION`, in which drivers name themselves.
    pub driver: String,
    /// Whether it draws on the CPU.
    pub software: bool,
    pub cpu: String,
    /// Threads that the system lets the program run at once.
    pub threads: usize,
    pub system: String,
}

impl Machine {
    pub fn new(context: &Headless) -> Self {
        Self {
            renderer: context.renderer.clone(),
            driver: context.version.clone(),
            software: context.software,
            cpu: cpu(),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        }
    }
}

/// What Linux calls the processor; other systems are not asked.
fn cpu() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or("unknown", |(_, name)| name.trim()).to_owned()
}
