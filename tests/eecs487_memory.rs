//! What a setting asks to be made anew takes the old one's place. Alone in its program, and one
//! after the other: others would share its memory.

mod common;

use std::sync::Mutex;

use common::Bench;
use shadowlab::gl;

static ALONE: Mutex<()> = Mutex::new(());

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
    let _alone = ALONE.lock();
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

/// `+` pressed 300 times, `t` and `T` beyond sense, the light driven into every wall, all of it drawn on the way.
#[test]
fn keys_held_down_take_no_more_each_time() {
    let _alone = ALONE.lock();
    let settings = ["soft_shadows=on", "soft_method=fast", "num_jitters=1"];
    let mut bench = Bench::new("eecs487", [64, 64], &settings);
    let round = |bench: &mut Bench| {
        for (keys, times) in [("+", 300), ("-", 300), ("T", 40), ("t", 60), ("TT", 1)] {
            for press in 0..times {
                bench.press(keys);
                // Some frames on the way are enough.
                if press % 30 == 0 {
                    bench.render();
                }
            }
        }
        for wall in ["h", "l", "j", "k", "w"] {
            for _ in 0..4 {
                bench.press(&wall.repeat(30));
                bench.render();
            }
        }
    };
    // A driver takes a large piece more once in a while, and gives back late. What leaks grows every time.
    let mut least = |rounds: usize| {
        let after = (0..rounds).map(|_| {
            round(&mut bench);
            gl::finish(&bench.context.gl);
            resident()
        });
        after.min().expect("some rounds")
    };
    let windows = [(); 4].map(|()| least(2));
    let growth = windows
        .windows(2)
        .map(|pair| pair[1].saturating_sub(pair[0]));
    let grown = growth.min().expect("some windows");
    println!("{windows:?} KiB");
    assert!(grown < LEAK / 4, "{windows:?} KiB");

    // The control: what a program keeps is seen here. Each page is written, so that it is there.
    let before = resident();
    let kept: Vec<u8> = (0..LEAK * 1024).map(|i| i as u8).collect();
    let found = resident().saturating_sub(before);
    assert!(found > LEAK / 2 && kept[7] == 7, "{found} KiB");
}

/// In KiB: less than a mask of 32 lights in each of the frames above would come to.
const LEAK: u64 = 32 * 1024;
