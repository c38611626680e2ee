//! Contexts come and go, on threads that come and go, and leave no memory behind.

use std::thread;

use shadowlab::headless::{Choice, Headless};
use shadowlab::labs::{self, Lab, Show};

const SIZE: [u32; 2] = [200, 200];
/// Threads that warm up what a process has once, and threads that are watched.
const FIRST: usize = 4;
const WATCHED: usize = 24;
/// In KiB. A context that stays with its lab is 8 MiB and more.
const MOST_LEFT: u64 = 2 * 1024 * WATCHED as u64;

/// Resident memory in KiB.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status
        .lines()
        .find(|line| line.starts_with("VmRSS"))
        .unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// A lab's first picture, and the context that it was drawn in.
fn draw() -> (Box<dyn Lab>, Headless) {
    let context = Headless::open(&Choice::Software, SIZE, false).unwrap();
    let handout = labs::find("csci3260").unwrap();
    let mut lab = (handout.start)(&context.gl, (handout.scene)().unwrap(), None).unwrap();
    lab.resize(SIZE);
    lab.render(&context.gl, Show::Picture).unwrap();
    // What a lab has on the GPU goes before its context.
    (lab, context)
}

/// By how many KiB the process grows while so many threads draw, one after the other.
fn growth(threads: usize, draw: fn()) -> u64 {
    let before = resident();
    for _ in 0..threads {
        thread::spawn(draw).join().unwrap();
    }
    resident().saturating_sub(before)
}

#[test]
fn a_thread_ends_and_leaves_no_context() {
    growth(FIRST, || drop(draw()));
    let left = growth(WATCHED, || drop(draw()));
    println!("{left} KiB");
    assert!(left < MOST_LEFT, "{left} KiB are left");
    // A control: contexts that are kept are seen.
    let kept = growth(WATCHED, || std::mem::forget(draw()));
    println!("{kept} KiB");
    assert!(kept > MOST_LEFT, "{kept} KiB are kept");
}
