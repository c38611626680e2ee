//! What a setting asks to be made anew takes the old one's place. Alone in its program: others would share its memory.

mod common;

use common::Bench;

/// Resident memory in KiB.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status
        .lines()
        .find(|line| line.starts_with("VmRSS:"))
        .unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

#[test]
fn changes_leave_nothing_behind() {
    let settings = ["soft_shadows=on", "soft_method=fast", "num_jitters=1"];
    let mut bench = Bench::new("eecs487", [256, 256], &settings);
    let round = |bench: &mut Bench| {
        for change in [
            "tessellation=256",
            "tessellation=255",
            "tessellation=1",
            "num_jitters=65",
            "num_jitters=1",
            "soft_method=handout",
            "accumulator=S8",
            "accumulator=RGBA32F",
        ] {
            bench.set(&[change]);
            bench.picture();
        }
        bench.set(&["soft_method=fast"]);
        for size in [[250, 256], [256, 256]] {
            bench.lab.resize(size);
            bench.render();
        }
    };
    (0..3).for_each(|_| round(&mut bench));
    let before = resident();
    (0..12).for_each(|_| round(&mut bench));
    // In each round two meshes of 4 MiB are made, and as much in accumulation buffers and in masks.
    let grown = resident().saturating_sub(before);
    println!("{grown} KiB more");
    assert!(grown < 32 * 1024, "{grown} KiB");
}
