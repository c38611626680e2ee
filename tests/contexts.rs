//! Contexts come and go, on threads that come and go, and leave no memory behind.

mod common;

use std::thread;

use common::{Bench, memory};

const SIZE: [u32; 2] = [200, 200];
/// Threads that warm up what a process has once, and threads that are watched.
const FIRST: usize = 4;
const WATCHED: usize = 24;
/// In KiB. A context that stays with its lab is 8 MiB and more.
const MOST_LEFT: u64 = 2 * 1024 * WATCHED as u64;

/// A lab's first picture, and what it was drawn with.
fn draw() -> Bench {
    let mut bench = Bench::new("csci3260", SIZE, &[]);
    bench.picture();
    bench
}

/// By how many KiB the process grows while so many threads draw, one after the other.
fn growth(threads: usize, draw: fn()) -> u64 {
    let before = memory("VmRSS");
    for _ in 0..threads {
        thread::spawn(draw).join().unwrap();
    }
    memory("VmRSS").saturating_sub(before)
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
