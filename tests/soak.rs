//! Many frames in the viewer, with new sizes and new shaders all the while: memory must stay where it is.

mod common;
mod desktop;

use std::time::{Duration, Instant};

use common::{Random, work_folder};
use desktop::{Desktop, Viewer};

/// What resident memory may grow by after the first thousand frames, in KiB: the driver keeps compiled shaders, the
/// allocator keeps what it had for the largest picture. Ten thousand frames that lose 2 KiB each are beyond it.
const GROWTH: u64 = 16 * 1024;

/// Resident memory in KiB; None once the program has ended.
fn resident(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
#[ignore = "takes minutes: cargo xtask soak"]
fn memory_stays_where_it_is() {
    let frames = std::env::var("SHADOWLAB_SOAK_FRAMES").unwrap_or("100000".to_owned());
    let folder = work_folder("soak");
    let glsl = folder.join("mine");
    std::fs::create_dir(&glsl).unwrap();
    let good = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let red = good.replacen("frag_color = ", "frag_color = vec4(1, 0, 0, 0) + ", 1);
    let broken = good.replace("void main", "void mian");
    std::fs::write(glsl.join("lighting.frag"), &good).unwrap();

    let desktop = Desktop::new(&folder);
    let options = "--size 96x96 --set map_size=256 --glsl mine --vsync off --frames";
    let mut viewer = Viewer::open(&desktop, &format!("{options} {frames}"));
    viewer.press("question m");

    let began = Instant::now();
    let mut random = Random(1);
    let (mut changes, mut first, mut last, mut most) = (0, None, 0, 0);
    while viewer.process.try_wait().unwrap().is_none() {
        let [width, height] = [(); 2].map(|()| (48 + random.below(112)).to_string());
        viewer.window("windowsize", &[&width, &height]);
        let text = [&good, &red, &good, &broken][changes % 4];
        std::fs::write(glsl.join("lighting.frag"), text).unwrap();
        changes += 1;
        // Long enough for some frames, and for the folder to be quiet.
        std::thread::sleep(Duration::from_millis(200));
        for line in viewer.lines.try_iter() {
            if let Some(memory) = resident(viewer.process.id()) {
                first.get_or_insert(memory);
                last = memory;
                most = most.max(memory);
                if line.ends_with("0000 frames") {
                    println!("{line}: {memory} KiB resident");
                }
            }
        }
    }
    let first = first.expect("more than 1000 frames");
    println!(
        "{frames} frames, {changes} new sizes and shaders in {:.0} s; resident after 1000 frames {first} KiB, \
         at the end {last} KiB, at most {most} KiB",
        began.elapsed().as_secs_f64()
    );
    assert_eq!(viewer.end().code(), Some(0));
    assert!(last <= first + GROWTH, "{first} KiB became {last} KiB");
}
