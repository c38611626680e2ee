//! Many events at one instant, balls that touch from the start, and balls at rest.

use glam::{DVec3, dvec3};
use shadowlab::labs::cmsc23700::simulation::{Meeting, RADIUS, REACH, Simulation};

use crate::boxes::*;

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
