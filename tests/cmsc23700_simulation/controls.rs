//! The controls: each law complains about what breaks it.

use std::ops::ControlFlow;

use glam::{DVec3, dvec3};
use shadowlab::labs::cmsc23700::simulation::{Ball, Bounce, Meeting, RADIUS, REACH};

use crate::boxes::*;
use crate::laws::*;

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
    // Someone else is pushed; and one of them is carried on.
    let mut other = after.clone();
    let third = (0..).find(|k| ![a, b].contains(k)).unwrap();
    other[third] = turned(&after[third], bounce.time, -after[third].velocity());
    bounces_right(&bounce, &before, &other).unwrap_err();
    let mut carried = after.clone();
    let place = after[a].position_at(bounce.time) + 2e-9;
    carried[a] = Ball::new(place, new[0], bounce.time, after[a].color());
    bounces_right(&bounce, &before, &carried).unwrap_err();
    // They meet a moment too soon.
    let soon = Bounce {
        time: bounce.time - 1e-6,
        ..bounce
    };
    bounces_right(&soon, &before, &after).unwrap_err();
    // A normal that is a billionth too long, for each of 10⁶ collisions.
    let (_, momentum, now) = wrong(new[0] + lost * 1e-8, new[1] - lost * 1e-8);
    let after_many = right_energy + (now - right_energy) * 1e6;
    assert!(momentum.is_ok() && keeps_energy(right_energy, after_many).is_err());
}

#[test]
fn overlaps_escapes_and_numbers_that_are_none_are_complained_about() {
    let touch = dvec3(2.0 * RADIUS, 0.0, 0.0);
    none_overlap(&[DVec3::ZERO, touch]).unwrap();
    none_overlap(&[DVec3::ZERO, touch * (1.0 - 2e-8)]).unwrap_err();
    none_overlap(&[touch, -touch, DVec3::ZERO, touch * 1.5]).unwrap_err();
    none_escapes(&[DVec3::splat(-REACH)]).unwrap();
    for axis in DVec3::AXES {
        none_escapes(&[DVec3::ZERO, axis * (REACH + 2e-9)]).unwrap_err();
        none_escapes(&[DVec3::ZERO, -axis * (REACH + 2e-9)]).unwrap_err();
    }
    // What is no number keeps no law.
    none_escapes(&[DVec3::NAN]).unwrap_err();
    none_overlap(&[DVec3::ZERO, DVec3::NAN]).unwrap_err();
    keeps_energy(1.0, f64::NAN).unwrap_err();
    keeps_momentum([DVec3::ZERO; 2], [DVec3::NAN; 2]).unwrap_err();
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
    let first = events(&mut with_balls(1, 10), [10.0]);
    same_events(&first, &first).unwrap();
    same_events(&first, &first[1..]).unwrap_err();
    let mut other = first.clone();
    other[20].time = other[20].time.next_up();
    same_events(&first, &other).unwrap_err();
    let mut other = first.clone();
    other[20].meeting = Meeting::Wall { ball: 9, axis: 3 };
    same_events(&first, &other).unwrap_err();
}
