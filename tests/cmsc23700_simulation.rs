//! The balls of the lab `cmsc23700`: exact, whatever the seed and however time is cut into steps.
//!
//! Each law is a function from numbers to a complaint, so that wrong numbers show that it complains.
//! `SHADOWLAB_SIMULATIONS=n` tries n random boxes instead of 300.

use std::ops::ControlFlow;

use glam::{DVec3, dvec3};
use shadowlab::labs::cmsc23700::simulation::{
    Ball, Bounce, MAX_BALLS, Meeting, NotAdded, RADIUS, REACH, Simulation,
};

// --- the laws ---

/// How deep balls may overlap, or leave the box, in box units.
const DEPTH: f64 = 1e-9;
/// The share of the kinetic energy that may be lost or won over a whole run.
const ENERGY: f64 = 1e-9;
/// The share of Σ|mv| that the momentum may change by when two balls meet.
const MOMENTUM: f64 = 1e-12;

type Law = Result<(), String>;

fn complain(wrong: bool, complaint: impl FnOnce() -> String) -> Law {
    if wrong { Err(complaint()) } else { Ok(()) }
}

/// Kinetic energy of balls of mass 1.
fn energy(balls: &[Ball]) -> f64 {
    let squares = balls.iter().map(|ball| ball.velocity().length_squared());
    squares.sum::<f64>() / 2.0
}

fn keeps_energy(before: f64, after: f64) -> Law {
    let drift = (after - before).abs() / before.max(f64::MIN_POSITIVE);
    complain(drift > ENERGY, || format!("energy drifts by {drift:e}"))
}

fn keeps_momentum(before: [DVec3; 2], after: [DVec3; 2]) -> Law {
    let change = (after[0] + after[1] - before[0] - before[1]).length();
    let scale = before[0].length() + before[1].length();
    complain(change > MOMENTUM * scale, || {
        format!("momentum changes by {change:e} of {scale}")
    })
}

fn none_escapes(positions: &[DVec3]) -> Law {
    for (k, position) in positions.iter().enumerate() {
        let depth = position.abs().max_element() - REACH;
        complain(depth > DEPTH || depth.is_nan(), || {
            format!("ball {k} is {depth:e} past a wall")
        })?;
    }
    Ok(())
}

fn none_overlap(positions: &[DVec3]) -> Law {
    for (b, second) in positions.iter().enumerate() {
        for (a, first) in positions[..b].iter().enumerate() {
            let depth = 2.0 * RADIUS - first.distance(*second);
            complain(depth > DEPTH, || {
                format!("balls {a} and {b} overlap by {depth:e}")
            })?;
        }
    }
    Ok(())
}

/// The law for all times from `from` to `to`, in which every ball flies straight: the closest that each pair comes.
fn none_overlap_between(balls: &[Ball], from: f64, to: f64) -> Law {
    for (b, second) in balls.iter().enumerate() {
        for (a, first) in balls[..b].iter().enumerate() {
            let distance = second.position_at(from) - first.position_at(from);
            let velocity = second.velocity() - first.velocity();
            let closest = -distance.dot(velocity) / velocity.length_squared().max(1e-300);
            let after = closest.clamp(0.0, to - from);
            let depth = 2.0 * RADIUS - (distance + velocity * after).length();
            complain(depth > DEPTH, || {
                format!("balls {a} and {b} overlap by {depth:e} at {}", from + after)
            })?;
        }
    }
    Ok(())
}

/// What a meeting does: those who meet touch, approached, and now part; and it changes nothing but the velocity along
/// the normal of the contact.
fn bounces_right(bounce: &Bounce, before: &[Ball], after: &[Ball]) -> Law {
    let met = |balls: &[Ball]| match bounce.meeting {
        Meeting::Wall { ball, axis } => {
            let velocity = balls[ball].velocity();
            let normal = DVec3::AXES[axis];
            let normal = normal * -balls[ball].position_at(bounce.time)[axis].signum();
            (velocity, normal, None)
        }
        Meeting::Balls { a, b } => {
            let normal = balls[a].position_at(bounce.time) - balls[b].position_at(bounce.time);
            let other = balls[b].velocity();
            (balls[a].velocity(), normal.normalize(), Some(other))
        }
    };
    let (velocity_before, normal, other_before) = met(before);
    let (velocity_after, _, other_after) = met(after);
    let approach = |velocity: DVec3, other: Option<DVec3>| {
        (velocity - other.unwrap_or(DVec3::ZERO)).dot(normal)
    };
    let closing = approach(velocity_before, other_before);
    let parting = approach(velocity_after, other_after);
    let scale = velocity_before.length() + other_before.unwrap_or(DVec3::ZERO).length();
    let small = 1e-9 * scale;
    complain(closing > small, || {
        format!("{bounce:?}: they part at {closing}")
    })?;
    complain((closing + parting).abs() > small, || {
        format!("{bounce:?}: they close at {closing} and part at {parting}")
    })?;
    let sideways = (velocity_after - velocity_before).reject_from(normal);
    complain(sideways.length() > small, || {
        format!("{bounce:?}: pushed sideways by {sideways}")
    })?;
    if let (Some(before), Some(after)) = (other_before, other_after) {
        keeps_momentum([velocity_before, before], [velocity_after, after])?;
    }
    let gap = match bounce.meeting {
        Meeting::Wall { ball, axis } => REACH - before[ball].position_at(bounce.time)[axis].abs(),
        Meeting::Balls { a, b } => {
            let of = |k: usize| before[k].position_at(bounce.time);
            of(a).distance(of(b)) - 2.0 * RADIUS
        }
    };
    complain(gap.abs() > DEPTH, || {
        format!("{bounce:?}: they meet {gap:e} apart")
    })
}

/// What is the same for two runs: every event to the last bit.
fn same_events(first: &[Bounce], second: &[Bounce]) -> Law {
    complain(first.len() != second.len(), || {
        format!("{} events, and {}", first.len(), second.len())
    })?;
    for (k, (a, b)) in first.iter().zip(second).enumerate() {
        let same = a.time.to_bits() == b.time.to_bits() && a.meeting == b.meeting;
        complain(!same, || format!("event {k}: {a:?}, and {b:?}"))?;
    }
    Ok(())
}

// --- boxes to try them on ---

/// Numbers for the tests, by a rule of their own (a linear congruence).
struct Numbers(u64);

impl Numbers {
    /// Evenly from 0 up to, and without, 1.
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }

    fn vector(&mut self) -> DVec3 {
        dvec3(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

fn with_balls(seed: u64, count: usize) -> Simulation {
    let mut simulation = Simulation::new(seed);
    for _ in 0..count {
        simulation.new_ball().unwrap();
    }
    simulation
}

/// A box set up by hand: centres and velocities.
fn with(balls: &[([f64; 3], [f64; 3])]) -> Simulation {
    let mut simulation = Simulation::new(0);
    for (position, velocity) in balls {
        simulation
            .place_ball((*position).into(), (*velocity).into())
            .unwrap();
    }
    simulation
}

fn positions(simulation: &Simulation) -> Vec<DVec3> {
    simulation.positions().collect()
}

/// Lets the time pass in these steps, and returns every event.
fn events(simulation: &mut Simulation, steps: impl IntoIterator<Item = f64>) -> Vec<Bounce> {
    let mut events = Vec::new();
    for dt in steps {
        simulation.simulate_watched(dt, |bounce, _| events.push(*bounce));
    }
    events
}

/// Lets `seconds` pass and holds every law against every moment of them; returns how many events there were.
fn watch_closely(simulation: &mut Simulation, seconds: f64) -> Result<usize, String> {
    let before = energy(simulation.balls());
    let mut balls = simulation.balls().to_vec();
    let mut from = simulation.now();
    let mut count = 0;
    let mut law = Ok(());
    simulation.simulate_watched(seconds, |bounce, after| {
        if law.is_err() {
            return;
        }
        law = none_overlap_between(&balls, from, bounce.time)
            .and_then(|()| bounces_right(bounce, &balls, after))
            .and_then(|()| none_escapes(&at(after, bounce.time)))
            .and_then(|()| complain(bounce.time < from, || format!("{bounce:?} after {from}")));
        balls = after.to_vec();
        from = bounce.time;
        count += 1;
    });
    law?;
    none_overlap_between(&balls, from, simulation.now())?;
    none_escapes(&positions(simulation))?;
    keeps_energy(before, energy(simulation.balls()))?;
    Ok(count)
}

fn at(balls: &[Ball], time: f64) -> Vec<DVec3> {
    balls.iter().map(|ball| ball.position_at(time)).collect()
}

/// Lets time pass until `count` events have happened.
fn until_events(
    simulation: &mut Simulation,
    count: usize,
    mut watch: impl FnMut(&Bounce, &[Ball]),
) {
    let mut happened = 0;
    while happened < count {
        simulation.simulate_watched(1.0, |bounce, balls| {
            happened += 1;
            watch(bounce, balls);
        });
    }
}

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

// --- simultaneous events, touching starts, rest ---

#[test]
fn symmetric_pairs_meet_at_the_same_instant() {
    // Three pairs, head-on along each axis, in places of their own; all meet at 0.25 s.
    let mut simulation = with(&[
        ([-0.3, 0.5, 0.5], [1.0, 0.0, 0.0]),
        ([0.3, 0.5, 0.5], [-1.0, 0.0, 0.0]),
        ([0.5, -0.3, -0.5], [0.0, 1.0, 0.0]),
        ([0.5, 0.3, -0.5], [0.0, -1.0, 0.0]),
        ([-0.5, -0.5, -0.3], [0.0, 0.0, 1.0]),
        ([-0.5, -0.5, 0.3], [0.0, 0.0, -1.0]),
    ]);
    let events = events(&mut simulation, [0.5]);
    let pairs: Vec<Meeting> = events.iter().map(|bounce| bounce.meeting).collect();
    let pair = |a: usize| Meeting::Balls { a, b: a + 1 };
    assert_eq!(pairs, [pair(0), pair(2), pair(4)]);
    assert!(
        events
            .iter()
            .all(|bounce| (bounce.time - 0.25).abs() < 1e-15)
    );
    // Each is back where it began.
    assert!((positions(&simulation)[0] - dvec3(-0.3, 0.5, 0.5)).length() < 1e-14);
    watch_closely(&mut simulation, 100.0).unwrap();
}

#[test]
fn four_balls_meet_in_one_point() {
    // Two pairs cross; the four touch around the centre at one instant.
    let mut simulation = with(&[
        ([-0.5, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.5, 0.0, 0.0], [-1.0, 0.0, 0.0]),
        ([0.0, -0.5, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.5, 0.0], [0.0, -1.0, 0.0]),
    ]);
    let count = watch_closely(&mut simulation, 100.0).unwrap();
    assert!(count > 100);
}

#[test]
fn newtons_cradle_passes_the_blow_on() {
    // Five in a row, touching, at rest; a sixth comes. Along each axis, and in each order of the balls' numbers.
    for axis in DVec3::AXES {
        for backwards in [false, true] {
            let place = |k: usize| axis * (2.0 * RADIUS * k as f64 - 0.2);
            let mut row: Vec<(DVec3, DVec3)> = (0..5).map(|k| (place(k), DVec3::ZERO)).collect();
            row.push((-0.6 * axis, axis));
            let last = if backwards { 1 } else { 4 };
            if backwards {
                row.reverse();
            }
            let mut simulation = Simulation::new(0);
            for (position, velocity) in row {
                simulation.place_ball(position, velocity).unwrap();
            }
            watch_closely(&mut simulation, 0.5).unwrap();
            for (k, ball) in simulation.balls().iter().enumerate() {
                let expected = if k == last { axis } else { DVec3::ZERO };
                assert!((ball.velocity() - expected).length() < 1e-14, "ball {k}");
            }
            // It comes back from the wall, and the blow goes the other way.
            assert!(watch_closely(&mut simulation, 100.0).unwrap() > 100);
        }
    }
}

#[test]
fn two_blows_cross_in_a_row() {
    let mut row: Vec<([f64; 3], [f64; 3])> = (0..5)
        .map(|k| ([0.1 * f64::from(k) - 0.2, 0.0, 0.0], [0.0; 3]))
        .collect();
    row.push(([-0.6, 0.0, 0.0], [1.0, 0.0, 0.0]));
    row.push(([0.6, 0.0, 0.0], [-1.0, 0.0, 0.0]));
    let mut simulation = with(&row);
    // Both arrive at 0.3 s, and both outer balls are back where they began at 0.6 s.
    watch_closely(&mut simulation, 0.6).unwrap();
    let places = positions(&simulation);
    assert!((places[5].x + 0.6).abs() < 1e-14 && (places[6].x - 0.6).abs() < 1e-14);
    watch_closely(&mut simulation, 100.0).unwrap();
}

#[test]
fn edges_and_corners_throw_back_like_walls() {
    for corner in 0..8 {
        let sign = |bit: usize| if corner >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let to_corner = dvec3(sign(0), sign(1), sign(2));
        for parts in [
            DVec3::ONE,
            dvec3(1.0, 1.0, 0.0),
            dvec3(0.0, 1.0, 1.0),
            dvec3(1.0, 0.0, 1.0),
        ] {
            // From the centre to the edge or corner and back: the walls are met at one instant.
            let velocity = to_corner * parts;
            let mut simulation = Simulation::new(0);
            simulation.place_ball(DVec3::ZERO, velocity).unwrap();
            let bounces = events(&mut simulation, [1.0]);
            assert_eq!(bounces.len(), parts.element_sum() as usize);
            assert!(bounces.iter().all(|bounce| bounce.time == bounces[0].time));
            assert_eq!(simulation.balls()[0].velocity(), -velocity);
            watch_closely(&mut simulation, 1000.0).unwrap();
            assert_eq!(simulation.balls()[0].velocity().abs(), velocity.abs());
        }
    }
}

#[test]
fn balls_that_start_in_a_corner_and_touch_go_on() {
    // One in the corner, three that touch it along the walls; all fly into the corner.
    let c = REACH;
    let d = REACH - 2.0 * RADIUS;
    let into = [1.0, 1.0, 1.0];
    let mut simulation = with(&[
        ([c, c, c], into),
        ([d, c, c], into),
        ([c, d, c], into),
        ([c, c, d], into),
    ]);
    assert!(watch_closely(&mut simulation, 100.0).unwrap() > 100);
}

#[test]
fn touching_balls_bounce_now_if_they_approach_and_not_otherwise() {
    let after = |first: [f64; 3], second: [f64; 3]| {
        let mut simulation = with(&[([-0.05, 0.0, 0.0], first), ([0.05, 0.0, 0.0], second)]);
        let events = events(&mut simulation, [0.01]);
        watch_closely(&mut simulation, 50.0).unwrap();
        events.len()
    };
    assert_eq!(after([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), 1);
    assert_eq!(after([0.0; 3], [-1e-6, 2.0, 0.0]), 1);
    assert_eq!(after([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), 0);
    assert_eq!(after([0.3, 0.4, 0.5], [0.3, 0.4, 0.5]), 0);
    assert_eq!(after([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]), 0);
    assert_eq!(after([0.0; 3], [0.0; 3]), 0);
}

/// 64 balls that touch all their neighbours, blown at from outside, or each with a velocity of its own.
#[test]
fn a_packed_crystal_comes_apart() {
    let mut numbers = Numbers(11);
    for velocities in 0..20 {
        let mut simulation = Simulation::new(0);
        for k in 0..64 {
            let place = dvec3(f64::from(k % 4), f64::from(k / 4 % 4), f64::from(k / 16));
            let velocity = match velocities {
                0 => DVec3::ZERO,
                // All towards the middle, all alike, all alike but for a rounding.
                1 => dvec3(1.5, 1.5, 1.5) - place,
                2 => dvec3(0.3, 0.5, 0.7),
                3..10 => dvec3(0.3, 0.5, 0.7) + numbers.vector() * 1e-16,
                10 => dvec3(0.3, 0.5, 0.7) + numbers.vector() * 1e-13,
                _ => numbers.vector(),
            };
            let position = (place - 1.5) * 2.0 * RADIUS;
            simulation.place_ball(position, velocity).unwrap();
        }
        simulation
            .place_ball(dvec3(-0.9, 0.01, 0.02), DVec3::X)
            .unwrap();
        let at_once = most_at_one_instant(&mut simulation.clone(), 5.0);
        assert!(at_once < 5000, "{at_once} events at one instant");
        watch_closely(&mut simulation, 5.0).unwrap_or_else(|law| panic!("{velocities}: {law}"));
    }
}

/// Against a corner of the box, where the walls take part.
#[test]
fn a_crystal_in_a_corner_comes_apart() {
    let mut numbers = Numbers(12);
    for velocities in 0..20 {
        let mut simulation = Simulation::new(0);
        for k in 0..64 {
            let place = dvec3(f64::from(k % 4), f64::from(k / 4 % 4), f64::from(k / 16));
            let velocity = match velocities {
                0 => DVec3::NEG_ONE,
                1..5 => DVec3::NEG_ONE + numbers.vector() * 1e-16,
                _ => numbers.vector(),
            };
            let position = place * 2.0 * RADIUS - REACH;
            simulation.place_ball(position, velocity).unwrap();
        }
        let at_once = most_at_one_instant(&mut simulation.clone(), 2.0);
        assert!(at_once < 5000, "{at_once} events at one instant");
        watch_closely(&mut simulation, 2.0).unwrap_or_else(|law| panic!("{velocities}: {law}"));
    }
}

fn most_at_one_instant(simulation: &mut Simulation, seconds: f64) -> usize {
    let (mut most, mut run, mut time) = (0, 0, f64::NAN);
    simulation.simulate_watched(seconds, |bounce, _| {
        run = if bounce.time == time { run + 1 } else { 1 };
        most = most.max(run);
        time = bounce.time;
    });
    most
}

#[test]
fn balls_at_rest_stay_until_they_are_hit() {
    let mut still = with(&[([0.0; 3], [0.0; 3]), ([REACH, REACH, REACH], [0.0; 3])]);
    let began = positions(&still);
    assert_eq!(watch_closely(&mut still, 1e6), Ok(0));
    assert_eq!(positions(&still), began);
    // Hit head-on, the first takes over all of the velocity.
    still.place_ball(dvec3(-0.5, 0.0, 0.0), DVec3::X).unwrap();
    still.simulate(0.5);
    assert_eq!(still.balls()[2].velocity().length(), 0.0);
    assert_eq!(still.balls()[0].velocity(), DVec3::X);
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
            0 => drop(simulation.kill_ball()),
            1 => drop(simulation.new_ball()),
            _ => {}
        }
    }
    let mut whole = simulation.clone();
    let mut cut = simulation.clone();
    let whole_events = self::events(&mut whole, [0.5]);
    let cut_events = self::events(&mut cut, vec![1.0 / 256.0; 128]);
    same_events(&whole_events, &cut_events)?;
    complain(positions(&whole) != positions(&cut), || {
        "the cuts of time move the balls".to_owned()
    })?;
    Ok(events + whole_events.len())
}

// --- the controls: each law complains about what breaks it ---

/// The first bounce between balls of a box, with the balls before and after it.
fn a_bounce() -> (Bounce, Vec<Ball>, Vec<Ball>) {
    let mut simulation = with_balls(1, 50);
    let mut before = simulation.balls().to_vec();
    let mut found = ControlFlow::Continue(());
    simulation.simulate_watched(5.0, |bounce, balls| {
        if found.is_continue() && matches!(bounce.meeting, Meeting::Balls { .. }) {
            found = ControlFlow::Break((*bounce, before.clone(), balls.to_vec()));
        }
        before = balls.to_vec();
    });
    match found {
        ControlFlow::Break(found) => found,
        ControlFlow::Continue(()) => panic!("no balls meet in 5 s"),
    }
}

/// The same ball, with another velocity from that time on.
fn turned(ball: &Ball, time: f64, velocity: DVec3) -> Ball {
    Ball::new(ball.position_at(time), velocity, time, ball.color())
}

#[test]
fn wrong_bounces_are_complained_about() {
    let (bounce, before, after) = a_bounce();
    let Meeting::Balls { a, b } = bounce.meeting else {
        unreachable!()
    };
    bounces_right(&bounce, &before, &after).unwrap();
    let old = [before[a].velocity(), before[b].velocity()];
    let new = [after[a].velocity(), after[b].velocity()];
    let wrong = |first: DVec3, second: DVec3| {
        let mut wrong = after.clone();
        wrong[a] = turned(&after[a], bounce.time, first);
        wrong[b] = turned(&after[b], bounce.time, second);
        let law = bounces_right(&bounce, &before, &wrong);
        (law, keeps_momentum(old, [first, second]), energy(&wrong))
    };
    let right_energy = energy(&before);

    // No bounce at all: energy and momentum are kept, but they do not part.
    let (law, momentum, now) = wrong(old[0], old[1]);
    assert!(law.is_err() && momentum.is_ok() && keeps_energy(right_energy, now).is_ok());
    // All of the velocity exchanged, not only what is along the normal.
    let (law, momentum, now) = wrong(old[1], old[0]);
    assert!(law.is_err() && momentum.is_ok() && keeps_energy(right_energy, now).is_ok());
    // A tenth of the bounce lost: momentum is kept, energy is not.
    let lost = (new[0] - old[0]) * 0.1;
    let (law, momentum, now) = wrong(new[0] - lost, new[1] + lost);
    assert!(law.is_err() && momentum.is_ok() && keeps_energy(right_energy, now).is_err());
    // Only one of them bounces.
    let (law, momentum, now) = wrong(new[0], old[1]);
    assert!(law.is_err() && momentum.is_err() && keeps_energy(right_energy, now).is_err());
    // A normal that is a billionth too long, for each of 10⁶ collisions.
    let (_, momentum, now) = wrong(new[0] + lost * 1e-8, new[1] - lost * 1e-8);
    let after_many = right_energy + (now - right_energy) * 1e6;
    assert!(momentum.is_ok() && keeps_energy(right_energy, after_many).is_err());
}

#[test]
fn overlaps_and_escapes_are_complained_about() {
    let touch = dvec3(2.0 * RADIUS, 0.0, 0.0);
    none_overlap(&[DVec3::ZERO, touch]).unwrap();
    none_overlap(&[DVec3::ZERO, touch * (1.0 - 2e-8)]).unwrap_err();
    none_overlap(&[touch, -touch, DVec3::ZERO, touch * 1.5]).unwrap_err();
    none_escapes(&[DVec3::splat(-REACH)]).unwrap();
    for axis in DVec3::AXES {
        none_escapes(&[DVec3::ZERO, axis * (REACH + 2e-9)]).unwrap_err();
        none_escapes(&[DVec3::ZERO, -axis * (REACH + 2e-9)]).unwrap_err();
    }
    none_escapes(&[DVec3::NAN]).unwrap_err();
}

#[test]
fn a_meeting_that_was_missed_is_complained_about() {
    // Two balls that fly through each other between 0.4 s and 0.6 s: samples at 0 s and 1 s see nothing of it.
    let ball = |x: f64, speed: f64| Ball::new(DVec3::X * x, DVec3::X * speed, 0.0, [0; 3]);
    let balls = [ball(-0.5, 1.0), ball(0.5, -1.0)];
    none_overlap(&at(&balls, 0.0)).unwrap();
    none_overlap(&at(&balls, 1.0)).unwrap();
    none_overlap_between(&balls, 0.0, 0.45).unwrap();
    none_overlap_between(&balls, 0.0, 1.0).unwrap_err();
    none_overlap_between(&balls, 0.46, 0.47).unwrap_err();
    none_overlap_between(&balls, 0.55, 1.0).unwrap();
}

#[test]
fn events_that_differ_are_complained_about() {
    let mut first = Vec::new();
    until_events(&mut with_balls(1, 10), 50, |bounce, _| first.push(*bounce));
    same_events(&first, &first).unwrap();
    same_events(&first, &first[1..]).unwrap_err();
    let mut other = first.clone();
    other[20].time = other[20].time.next_up();
    same_events(&first, &other).unwrap_err();
    let mut other = first.clone();
    other[20].meeting = Meeting::Wall { ball: 9, axis: 3 };
    same_events(&first, &other).unwrap_err();
}
