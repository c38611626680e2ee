//! Boxes with balls to try the laws on, and a close watch over a stretch of time.

use glam::{DVec3, dvec3};
use shadowlab::labs::cmsc23700::simulation::{Bounce, Simulation};

use crate::laws::*;

/// Numbers for the tests, by a rule of their own (a linear congruence).
pub struct Numbers(pub u64);

impl Numbers {
    /// Evenly from 0 up to, and without, 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }

    pub fn vector(&mut self) -> DVec3 {
        dvec3(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

pub fn with_balls(seed: u64, count: usize) -> Simulation {
    let mut simulation = Simulation::new(seed);
    for _ in 0..count {
        simulation.new_ball().unwrap();
    }
    simulation
}

/// A box set up by hand: centres and velocities.
pub fn with(balls: &[([f64; 3], [f64; 3])]) -> Simulation {
    let mut simulation = Simulation::new(0);
    for (position, velocity) in balls {
        simulation
            .place_ball((*position).into(), (*velocity).into())
            .unwrap();
    }
    simulation
}

pub fn positions(simulation: &Simulation) -> Vec<DVec3> {
    simulation.positions().collect()
}

/// Lets the time pass in these steps, and returns every event.
pub fn events(simulation: &mut Simulation, steps: impl IntoIterator<Item = f64>) -> Vec<Bounce> {
    let mut events = Vec::new();
    for dt in steps {
        simulation.simulate_watched(dt, |bounce, _| events.push(*bounce));
    }
    events
}

/// Lets `seconds` pass and holds every law against every moment of them; returns how many events there were.
pub fn watch_closely(simulation: &mut Simulation, seconds: f64) -> Result<usize, String> {
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
            .and_then(|()| holds(bounce.time >= from, || format!("{bounce:?} after {from}")));
        balls = after.to_vec();
        from = bounce.time;
        count += 1;
    });
    law?;
    let now = simulation.now();
    holds(from <= now, || format!("an event at {from}, after {now}"))?;
    none_overlap_between(&balls, from, now)?;
    none_escapes(&positions(simulation))?;
    keeps_energy(before, energy(simulation.balls()))?;
    Ok(count)
}
