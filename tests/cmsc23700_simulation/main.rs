//! The balls of the lab `cmsc23700`: exact, whatever the seed and however time is cut into steps.
//!
//! `SHADOWLAB_SIMULATIONS=n` tries n random boxes instead of 300.

mod boxes;
mod controls;
mod instants;
mod laws;

use boxes::*;
use glam::{DVec3, dvec3};
use laws::*;
use shadowlab::labs::cmsc23700::simulation::{
    Ball, MAX_BALLS, Meeting, NotAdded, REACH, Simulation,
};

// --- the same events, however time is cut ---

#[test]
fn the_cuts_of_time_change_nothing() {
    for (seed, count) in [(1, 100), (2, 37), (3, 2)] {
        let run = |steps: Vec<f64>| {
            let mut simulation = with_balls(seed, count);
            let events = events(&mut simulation, steps);
            (events, positions(&simulation))
        };
        let whole = run(vec![20.0]);
        assert!(whole.0.len() > 10 * count);

        // The course's steps; and cuts at random 2⁻²⁰ths of a second, whose lengths are exact.
        let mut numbers = Numbers(seed);
        let mut cuts: Vec<f64> = (0..500)
            .map(|_| (numbers.next() * 20.0 * 1_048_576.0).floor() / 1_048_576.0)
            .chain([0.0, 20.0])
            .collect();
        cuts.sort_by(f64::total_cmp);
        let random: Vec<f64> = cuts.windows(2).map(|cut| cut[1] - cut[0]).collect();
        for steps in [vec![0.01; 2000], random] {
            let cut = run(steps);
            same_events(&whole.0, &cut.0).unwrap();
            assert_eq!(whole.1, cut.1);
        }

        // Steps of any length end at another last bit of the time: the same events, and places that are as near.
        let mut steps: Vec<f64> = (0..700).map(|_| numbers.next() * 0.02).collect();
        let rest = 20.0 - steps.iter().sum::<f64>();
        steps.push(rest);
        let cut = run(steps);
        same_events(&whole.0, &cut.0).unwrap();
        let apart = whole.1.iter().zip(&cut.1).map(|(a, b)| a.distance(*b));
        assert!(apart.fold(0.0, f64::max) < 1e-12);
    }
}

/// The control, and the reason for a tolerance of no bit at all: what differs at the start by a rounding has nothing
/// in common after 20 s.
#[test]
fn another_start_has_other_events() {
    let run = |x: f64| {
        let mut simulation = with_balls(1, 50);
        while simulation.place_ball(dvec3(x, 0.0, 0.0), DVec3::X).is_err() {
            simulation.simulate(0.1);
        }
        let events = events(&mut simulation, [20.0]);
        (events, positions(&simulation))
    };
    let (plain, moved) = (run(0.25), run(0.25 + 1e-15));
    same_events(&plain.0, &run(0.25).0).unwrap();
    same_events(&plain.0, &moved.0).unwrap_err();
    let apart = plain.1.iter().zip(&moved.1).map(|(a, b)| a.distance(*b));
    assert!(apart.fold(0.0, f64::max) > 0.1);
}

/// One bit of the arithmetic that differs on some machine, and this number is another; so are all pictures of the lab.
#[test]
fn the_scene_is_the_same_on_every_machine() {
    let mut simulation = with_balls(23700, 100);
    let events = events(&mut simulation, [20.0]);
    let numbers = positions(&simulation)
        .into_iter()
        .flat_map(|position| position.to_array())
        .chain(events.iter().map(|bounce| bounce.time));
    // FNV-1a.
    let hash = numbers
        .flat_map(|number| number.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    assert_eq!((events.len(), hash), (2097, 14_039_530_979_352_387_122));
}

#[test]
fn balls_that_come_and_go_leave_the_cuts_without_effect() {
    let run = |steps: usize| {
        let mut simulation = with_balls(9, 20);
        let mut all = Vec::new();
        for second in 0..30 {
            all.extend(events(&mut simulation, vec![1.0 / steps as f64; steps]));
            for _ in 0..second % 4 {
                simulation.new_ball().unwrap();
            }
            if second % 3 == 0 {
                assert!(simulation.kill_ball());
            }
        }
        (all, positions(&simulation))
    };
    let whole = run(1);
    for steps in [64, 1024] {
        let cut = run(steps);
        same_events(&whole.0, &cut.0).unwrap();
        assert_eq!(whole.1, cut.1);
    }
}

// --- what is kept over a million collisions ---

#[test]
fn a_million_collisions_keep_energy_and_momentum() {
    let mut simulation = with_balls(6, MAX_BALLS);
    let before = energy(simulation.balls());
    let mut velocities: Vec<DVec3> = simulation.balls().iter().map(Ball::velocity).collect();
    let (mut between_balls, mut worst_momentum) = (0, 0.0_f64);
    let mut worst_energy = 0.0_f64;
    let mut count = 0_usize;
    let mut law = Ok(());
    while between_balls < 1_000_000 {
        simulation.simulate_watched(10.0, |bounce, balls| {
            count += 1;
            match bounce.meeting {
                Meeting::Wall { ball, .. } => velocities[ball] = balls[ball].velocity(),
                Meeting::Balls { a, b } => {
                    between_balls += 1;
                    let old = [velocities[a], velocities[b]];
                    let new = [balls[a].velocity(), balls[b].velocity()];
                    [velocities[a], velocities[b]] = new;
                    let change = (new[0] + new[1] - old[0] - old[1]).length();
                    let share = change / (old[0].length() + old[1].length());
                    worst_momentum = worst_momentum.max(share);
                    if law.is_ok() {
                        law = keeps_momentum(old, new);
                    }
                }
            }
        });
        let now = energy(simulation.balls());
        worst_energy = worst_energy.max((now - before).abs() / before);
        keeps_energy(before, now).unwrap();
    }
    law.unwrap();
    println!(
        "{count} events in {} s, {between_balls} of them between balls: \
         energy to {worst_energy:e}, momentum to {worst_momentum:e}",
        simulation.now()
    );
    // Late, too, nothing overlaps and nothing is missed.
    watch_closely(&mut simulation, 5.0).unwrap();
}

#[test]
fn samples_at_random_times_show_no_overlap_and_no_escape() {
    let mut numbers = Numbers(7);
    let mut simulation = with_balls(7, MAX_BALLS);
    for _ in 0..20_000 {
        simulation.simulate(numbers.next() * 0.01);
        let positions = positions(&simulation);
        none_overlap(&positions).unwrap();
        none_escapes(&positions).unwrap();
    }
}

// --- balls that come and go ---

#[test]
fn a_ball_can_be_added_among_balls_that_move() {
    let mut simulation = Simulation::new(31);
    for count in 1..=MAX_BALLS {
        simulation.new_ball().unwrap();
        assert_eq!(simulation.balls().len(), count);
        none_overlap(&positions(&simulation)).unwrap();
        watch_closely(&mut simulation, 0.37).unwrap();
    }
    assert_eq!(simulation.new_ball(), Err(NotAdded::Full));
}

#[test]
fn a_ball_that_is_gone_meets_nobody() {
    // The second would be hit at 0.4 s; it goes before, and the first flies on to the wall.
    let mut simulation = with(&[
        ([-0.45, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.05, 0.0, 0.0], [0.0; 3]),
    ]);
    simulation.simulate(0.3);
    assert!(simulation.kill_ball());
    let wall = events(&mut simulation, [1.2]);
    assert_eq!(wall.len(), 1);
    assert_eq!(wall[0].meeting, Meeting::Wall { ball: 0, axis: 0 });
    // One in its place, with the same number, is hit for itself: what was predicted for the first does not hold.
    let mut simulation = with(&[
        ([-0.45, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.05, 0.0, 0.0], [0.0; 3]),
    ]);
    simulation.simulate(0.3);
    simulation.kill_ball();
    simulation
        .place_ball(dvec3(0.25, 0.0, 0.0), DVec3::ZERO)
        .unwrap();
    let hit = events(&mut simulation, [0.5]);
    assert_eq!(hit.len(), 1);
    assert!((hit[0].time - 0.6).abs() < 1e-15);
    // From an empty box nothing can be removed, and time passes in it.
    let mut empty = Simulation::new(0);
    assert!(!empty.kill_ball());
    empty.simulate(5.0);
    assert_eq!(empty.now(), 5.0);
}

// --- every law at every moment, for random boxes ---

#[test]
fn random_boxes_keep_every_law() {
    let count = std::env::var("SHADOWLAB_SIMULATIONS").map_or(300, |count| {
        count.parse().expect("SHADOWLAB_SIMULATIONS: a number")
    });
    let mut most = 0;
    for seed in 0..count {
        let events = random_box(seed).unwrap_or_else(|law| panic!("seed {seed}: {law}"));
        most = most.max(events);
    }
    println!("{count} boxes, up to {most} events in one");
}

/// A box with a random number of balls, some at rest, some slow, some in the corners; balls come and go.
fn random_box(seed: u64) -> Result<usize, String> {
    let mut numbers = Numbers(seed.wrapping_mul(0x9e37_79b9) ^ 0x5eed);
    numbers.next();
    let mut simulation = Simulation::new(seed);
    for _ in 0..numbers.below(MAX_BALLS + 1) {
        let place = numbers.vector();
        // What does not fit is left out.
        let _ = match numbers.below(8) {
            0 => simulation.place_ball(place * REACH, DVec3::ZERO),
            1 => simulation.place_ball(place * REACH, numbers.vector() * 1e-6),
            2 => simulation.place_ball(place * REACH, numbers.vector() * 10.0),
            3 => simulation.place_ball(place.signum() * REACH, numbers.vector()),
            // On a lattice, in steps of time that many share.
            4 => simulation.place_ball((place * 9.0).round() / 10.0, place.signum()),
            _ => simulation.new_ball(),
        };
    }
    let mut events = 0;
    for _ in 0..3 {
        events += watch_closely(&mut simulation, numbers.next())?;
        match numbers.below(3) {
            0 => {
                simulation.kill_ball();
            }
            // In a full box there will be no new ball, which is as good.
            1 => {
                let _ = simulation.new_ball();
            }
            _ => {}
        }
    }
    // From here on, one step of 0.5 s and 128 short ones.
    let mut whole = simulation.clone();
    let mut cut = simulation.clone();
    let whole_events = self::events(&mut whole, [0.5]);
    let cut_events = self::events(&mut cut, vec![1.0 / 256.0; 128]);
    same_events(&whole_events, &cut_events)?;
    holds(positions(&whole) == positions(&cut), || {
        "the cuts of time move the balls".to_owned()
    })?;
    Ok(events + whole_events.len())
}
