//! What a setting asks to be made anew takes the old one's place. Alone in its program, and one
//! after the other: others would share its memory.

mod common;

use std::sync::Mutex;

use common::{Bench, memory};
use shadowlab::gl;

static ALONE: Mutex<()> = Mutex::new(());

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
    let grown = least_growth(|| {
        (0..3).for_each(|_| round(&mut bench));
        gl::finish(&bench.context.gl);
    });
    // In each round two meshes of 4 MiB are made, and as much in accumulation buffers and in masks.
    assert!(grown < LEAK / 4, "{grown} KiB");
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
    let grown = least_growth(|| {
        round(&mut bench);
        gl::finish(&bench.context.gl);
    });
    assert!(grown < LEAK / 4, "{grown} KiB");

    // The control: what a program keeps is seen here. Each page is written, so that it is there.
    // So large that it does not come out of what was free already.
    let mut kept: Vec<Vec<u8>> = Vec::new();
    let grown = least_growth(|| kept.push((0..4 * LEAK * 1024).map(|i| i as u8).collect()));
    assert!(grown > LEAK && kept[0][7] == 7, "{grown} KiB");
}

/// By how many KiB memory grows each time, at least: a driver takes a large piece more once in a while, and gives back
/// late; what leaks grows every time.
fn least_growth(mut again: impl FnMut()) -> u64 {
    let after = [(); 5].map(|()| {
        again();
        memory("VmRSS")
    });
    println!("{after:?} KiB");
    let growth = after.windows(2).map(|pair| pair[1].saturating_sub(pair[0]));
    growth.min().expect("some windows")
}

/// In KiB: less than a mask of 32 lights in each of the frames above would come to.
const LEAK: u64 = 32 * 1024;
