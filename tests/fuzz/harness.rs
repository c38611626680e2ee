//! Runs a parser on one input after the other and watches what it does.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::{memory, mutate};

pub enum Verdict {
    Accepted,
    Refused,
}

/// A parser, and checks of what it made.
type Parse = fn(&[u8]) -> Verdict;

pub struct Parser {
    pub name: &'static str,
    pub parse: Parse,
    pub seeds: &'static [&'static str],
    pub words: &'static [&'static str],
    pub limits: Limits,
}

/// The most that one input may take. Measured values are far below; a busy machine must not fail the test.
#[derive(Clone, Copy)]
pub struct Limits {
    pub time: Duration,
    pub bytes: isize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: Duration::from_secs(2),
            bytes: 64 << 20,
        }
    }
}

/// How a run went.
#[derive(Default)]
struct Report {
    inputs: u64,
    accepted: u64,
    time: Duration,
    slowest: (Duration, u64),
    largest: (isize, u64),
}

fn number_from(variable: &str) -> Option<u64> {
    let text = std::env::var(variable).ok()?;
    Some(
        text.parse()
            .unwrap_or_else(|_| panic!("{variable}={text}: expected a number")),
    )
}

/// As many inputs as the environment asks for.
pub fn fuzz(parser: &Parser) {
    let numbers = match number_from("SHADOWLAB_FUZZ_INPUT") {
        Some(number) => number..number + 1,
        None => 0..number_from("SHADOWLAB_FUZZ").unwrap_or(10_000),
    };
    // What is made once stays: before the first count, each seed goes through.
    for seed in parser.seeds {
        (parser.parse)(seed.as_bytes());
    }
    let before = memory::resident();
    let report = run(parser, numbers).unwrap_or_else(|found| panic!("{found}"));
    let after = memory::resident();
    println!(
        "{}: {} inputs, {} accepted, {:.1} s; longest {:.1} ms (input {}), most memory {} KiB (input {}), resident {before} KiB before and {after} KiB after",
        parser.name,
        report.inputs,
        report.accepted,
        report.time.as_secs_f64(),
        report.slowest.0.as_secs_f64() * 1e3,
        report.slowest.1,
        report.largest.0 >> 10,
        report.largest.1,
    );
    // A fuzzer whose inputs all end at the door, or all pass, looks at nothing.
    if report.inputs >= 1000 {
        let share = report.accepted as f64 / report.inputs as f64;
        assert!((0.02..0.98).contains(&share), "{}: {share}", parser.name);
    }
}

/// The first input that is not taken as it should be ends the run.
fn run(parser: &Parser, numbers: std::ops::Range<u64>) -> Result<Report, String> {
    let start = Instant::now();
    let mut report = Report::default();
    let current = AtomicU64::new(numbers.start);
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| watch(parser, &current, &done));
        // Whatever happens, the watch must come to its end.
        let result = numbers.clone().try_for_each(|number| {
            current.store(number, Ordering::Relaxed);
            one(parser, number, &mut report)
        });
        done.store(true, Ordering::Relaxed);
        result
    })?;
    report.time = start.elapsed();
    Ok(report)
}

fn one(parser: &Parser, number: u64, report: &mut Report) -> Result<(), String> {
    let input = mutate::input(parser.seeds, parser.words, number);
    let parse = || catch_unwind(AssertUnwindSafe(|| (parser.parse)(&input)));
    let mut start = Instant::now();
    let (result, most, left) = memory::measured(parse);
    let mut time = start.elapsed();
    // The clock counts what other programs did meanwhile: a long time is believed when it comes again.
    for _ in 0..4 {
        if result.is_ok() && time > report.slowest.0 {
            start = Instant::now();
            let _ = parse();
            time = time.min(start.elapsed());
        }
    }

    let complaint = match &result {
        Err(_) => "panics".to_owned(),
        Ok(_) if left != 0 => format!("leaves {left} bytes behind"),
        Ok(_) if time > parser.limits.time => format!("takes {time:?}"),
        Ok(_) if most > parser.limits.bytes => format!("holds {most} bytes"),
        Ok(verdict) => {
            report.inputs += 1;
            report.accepted += u64::from(matches!(verdict, Verdict::Accepted));
            report.slowest = report.slowest.max((time, number));
            report.largest = report.largest.max((most, number));
            return Ok(());
        }
    };
    Err(format!("{complaint}: {}", shown(parser, number)))
}

/// An input in a form that can be run again.
fn shown(parser: &Parser, number: u64) -> String {
    let input = mutate::input(parser.seeds, parser.words, number);
    format!(
        "{} with SHADOWLAB_FUZZ_INPUT={number}, which is b\"{}\"",
        parser.name,
        input.escape_ascii()
    )
}

/// An input that never ends cannot be measured: this ends the program and says which one it was.
fn watch(parser: &Parser, current: &AtomicU64, done: &AtomicBool) {
    let mut last = (u64::MAX, Instant::now());
    while !done.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(20));
        let number = current.load(Ordering::Relaxed);
        if number != last.0 {
            last = (number, Instant::now());
        } else if last.1.elapsed() > 20 * parser.limits.time {
            eprintln!("hangs: {}", shown(parser, number));
            std::process::exit(1);
        }
    }
}

// --- controls: each fault is found, and the input is named ---

fn planted(parse: Parse) -> String {
    let parser = Parser {
        name: "planted",
        parse,
        seeds: &["seed 1 2 3\n"],
        words: &["<fault>"],
        limits: Limits {
            time: Duration::from_millis(200),
            bytes: 1 << 20,
        },
    };
    run(&parser, 0..2000).err().unwrap_or_default()
}

/// Only some of the inputs show the fault.
fn has_fault(input: &[u8]) -> bool {
    input.windows(7).any(|part| part == b"<fault>")
}

#[test]
fn a_planted_fault_is_found() {
    let faults: [(&str, Parse); 4] = [
        ("panics", |input| {
            assert!(!has_fault(input), "the planted panic");
            Verdict::Accepted
        }),
        ("leaves 3 bytes behind", |input| {
            if has_fault(input) {
                std::mem::forget(vec![1_u8; 3]);
            }
            Verdict::Accepted
        }),
        ("takes ", |input| {
            if has_fault(input) {
                std::thread::sleep(Duration::from_millis(300));
            }
            Verdict::Accepted
        }),
        ("holds ", |input| {
            let size = if has_fault(input) { 2 << 20 } else { 0 };
            std::hint::black_box(vec![1_u8; size]);
            Verdict::Accepted
        }),
    ];
    for (expected, parse) in faults {
        let found = planted(parse);
        assert!(found.starts_with(expected), "{expected}: {found}");
        assert!(
            found.contains("SHADOWLAB_FUZZ_INPUT=") && found.contains("<fault>"),
            "{found}"
        );
    }
    assert_eq!(
        planted(|_| Verdict::Refused),
        "",
        "without a fault nothing is found"
    );
}
