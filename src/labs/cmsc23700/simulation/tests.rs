//! What only the inside of the simulation shows; the rest is in `tests/cmsc23700_simulation`.

use glam::dvec3;

use super::*;

/// Places, speeds and colours that the course gives.
#[test]
fn new_balls_are_as_the_course_has_them() {
    for seed in 0..50 {
        let mut simulation = Simulation::new(seed);
        for _ in 0..MAX_BALLS {
            simulation.new_ball().unwrap();
        }
        assert_eq!(simulation.new_ball(), Err(NotAdded::Full));
        for (k, ball) in simulation.balls().iter().enumerate() {
            let position = ball.position_at(0.0);
            assert!(position.abs().max_element() <= SPAWN_REACH, "{position}");
            assert!((ball.velocity().length() - 1.0).abs() < 1e-15);
            assert_eq!(ball.color(), COLORS[k % 8]);
            for other in &simulation.balls()[..k] {
                assert!(position.distance(other.position_at(0.0)) >= 2.0 * RADIUS - TOUCH);
            }
        }
    }
}

/// The formula of [`COLORS`], by the usual way from a hue to RGB.
#[test]
fn the_colors_go_round_the_circle_of_hues() {
    for (k, color) in COLORS.iter().enumerate() {
        let hue = (80.0 - 40.0 * k as f64).rem_euclid(360.0);
        let part = |from: f64| {
            let sixth = (from + hue / 60.0).rem_euclid(6.0);
            let share = (2.0 - (sixth - 2.0).abs()).clamp(0.0, 1.0);
            (255.0 - (255.0 - 102.0) * share).round() as u8
        };
        assert_eq!(*color, [part(5.0), part(3.0), part(1.0)], "hue {hue}");
    }
}

#[test]
fn where_no_place_is_free_the_caller_is_told_and_nothing_changes() {
    let mut simulation = Simulation::new(1);
    simulation.place_ball(DVec3::ZERO, DVec3::X).unwrap();
    // Every place so near the centre is taken by the ball there. The control: once it has gone, they are free.
    assert_eq!(simulation.free_place(0.02), None);
    simulation.simulate(0.5);
    assert!(simulation.free_place(0.02).is_some());
}

#[test]
fn balls_are_placed_only_where_they_fit() {
    let mut simulation = Simulation::new(1);
    let mut place = |x: f64, speed: f64| {
        let place = simulation.place_ball(dvec3(x, 0.0, 0.0), dvec3(0.0, speed, 0.0));
        (place, simulation.balls().len())
    };
    assert_eq!(place(0.0, 1.0), (Ok(()), 1));
    assert_eq!(place(0.0999, 1.0), (Err(NotAdded::NoPlace), 1));
    assert_eq!(place(-0.1, 0.0), (Ok(()), 2));
    assert_eq!(place(REACH + 1e-9, 0.0), (Err(NotAdded::NoPlace), 2));
    assert_eq!(place(f64::NAN, 0.0), (Err(NotAdded::NoPlace), 2));
    assert_eq!(place(0.5, f64::NAN), (Err(NotAdded::TooFast), 2));
    assert_eq!(place(0.5, f64::INFINITY), (Err(NotAdded::TooFast), 2));
    assert_eq!(place(0.5, 2.0 * MAX_SPEED), (Err(NotAdded::TooFast), 2));
    assert_eq!(place(REACH, MAX_SPEED), (Ok(()), 3));
}

/// A ball that is asked for in vain draws no random number: the balls after it are the same.
#[test]
fn a_full_box_leaves_no_trace() {
    let next_ball = |asked_in_vain: usize| {
        let mut simulation = Simulation::new(3);
        while simulation.new_ball().is_ok() {}
        for _ in 0..asked_in_vain {
            assert!(simulation.new_ball().is_err());
        }
        simulation.kill_ball();
        simulation.new_ball().unwrap();
        simulation.balls().last().cloned()
    };
    let plain = next_ball(0).map(|ball| ball.position_at(0.0));
    assert_eq!(next_ball(7).map(|ball| ball.position_at(0.0)), plain);
}

/// Events that no longer hold leave the queue when their time comes: it does not grow.
#[test]
fn the_queue_stays_short() {
    let mut simulation = Simulation::new(4);
    while simulation.new_ball().is_ok() {}
    let mut longest = 0;
    for _ in 0..2000 {
        simulation.simulate(0.1);
        longest = longest.max(simulation.events.len());
    }
    assert!(longest < 20 * MAX_BALLS, "{longest} events are queued");
}
