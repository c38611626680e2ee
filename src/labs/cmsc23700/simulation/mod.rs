//! The balls in the box, from one bounce to the next.
//!
//! The box is the cube [−1,1]³. All six sides reflect the balls, the open front and the open top too: light passes
//! there, balls do not. There is no gravity, so a ball flies straight from bounce to bounce, and everything that
//! happens is a list of events: this ball meets that wall, these two balls meet.
//!
//! 1. [`Simulation::predict_event`] computes, for one ball, when it meets a wall and when it meets other balls.
//! 2. [`Simulation::simulate`] takes the earliest event from a queue, lets the ball or balls bounce, and predicts anew
//!    for these only.
//!
//! Nothing is ever moved by a time step: a ball remembers where its present flight began, and its place at any time is
//! computed from there. So how a time is cut into steps changes nothing, and a scene is the same on every machine: the
//! arithmetic is + − · / and √, which IEEE 754 rounds the same everywhere.
//!
//! Lengths are in box units (the box is 2 wide), times in seconds, speeds in box units per second. Times are f64 since
//! the start: after a month their rounding moves a ball by some 10⁻⁹.

mod ball;
mod clock;
mod event;
mod random;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fmt;

use glam::DVec3;

pub use ball::{Ball, RADIUS, REACH, ball_bounce, hit_test, wall_bounce, wall_test};
pub use event::{Bounce, Meeting};

use clock::Clock;
use event::Event;
use random::Random;

/// As many balls as the course allows.
pub const MAX_BALLS: usize = 100;
/// Balls begin within this distance of the centre, on each axis.
pub const SPAWN_REACH: f64 = 0.9;
/// No ball begins faster: far above, a ball would cross the box within the rounding of a late time.
pub const MAX_SPEED: f64 = 100.0;
/// Balls that touch when they are placed may overlap by this much, which is rounding.
pub const TOUCH: f64 = 1e-12;
/// How many places are tried for a new ball. A hundred balls keep 7 % of the places from it.
const TRIES: usize = 1000;

/// The eight colours of the balls, as RGB from 0 to 255.
///
/// Colour k has the hue 80° − 40°·k, its largest part 255 and its smallest 102. The course gives the first and the
/// last; between them the hues go the long way round the circle, because the short way all eight would be green.
pub const COLORS: [[u8; 3]; 8] = [
    [204, 255, 102],
    [255, 204, 102],
    [255, 102, 102],
    [255, 102, 204],
    [204, 102, 255],
    [102, 102, 255],
    [102, 204, 255],
    [102, 255, 204],
];

/// Balls in the box, and what will happen to them.
#[derive(Clone, Debug)]
pub struct Simulation {
    balls: Vec<Ball>,
    clock: Clock,
    /// The earliest event is on top. Events that no longer hold are left in, and dropped when they come up.
    events: BinaryHeap<Reverse<Event>>,
    /// How many flights have begun, which numbers them.
    flights: u64,
    random: Random,
}

/// Why a ball was not added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotAdded {
    /// There are [`MAX_BALLS`] already.
    Full,
    /// Every place that was tried is taken or outside the box.
    NoPlace,
    /// Its speed is not a number up to [`MAX_SPEED`].
    TooFast,
}

impl fmt::Display for NotAdded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotAdded::Full => write!(f, "there are {MAX_BALLS} balls, which is the most"),
            NotAdded::NoPlace => write!(f, "there is no room for another ball there"),
            NotAdded::TooFast => write!(f, "a ball's speed is a number from 0 to {MAX_SPEED}"),
        }
    }
}

impl Simulation {
    /// An empty box at time 0. The seed decides where balls will begin, and in which direction.
    pub fn new(seed: u64) -> Simulation {
        Simulation {
            balls: Vec::new(),
            clock: Clock::default(),
            events: BinaryHeap::new(),
            flights: 0,
            random: Random::new(seed),
        }
    }

    /// Seconds since the start.
    pub fn now(&self) -> f64 {
        self.clock.now()
    }

    /// The balls, oldest first; where they are now is `ball.position_at(simulation.now())`.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// Where each ball's centre is now.
    pub fn positions(&self) -> impl Iterator<Item = DVec3> {
        let now = self.now();
        self.balls.iter().map(move |ball| ball.position_at(now))
    }

    /// Adds a ball now, at a random place that no other ball touches, with unit speed in a random direction.
    ///
    /// # Errors
    /// [`NotAdded`] says why there is no new ball; the others go on as if nothing had been asked.
    #[doc(alias = "NewBall")]
    pub fn new_ball(&mut self) -> Result<(), NotAdded> {
        // Asked before any random number is drawn: what cannot be done leaves no trace.
        if self.balls.len() == MAX_BALLS {
            return Err(NotAdded::Full);
        }
        let place = self.free_place(SPAWN_REACH).ok_or(NotAdded::NoPlace)?;
        let velocity = self.random.direction();
        self.place_ball(place, velocity)
    }

    /// Adds a ball now, with its centre at `position`. It may touch walls and balls, and be at rest.
    ///
    /// # Errors
    /// [`NotAdded`] says why there is no new ball; the others go on as if nothing had been asked.
    pub fn place_ball(&mut self, position: DVec3, velocity: DVec3) -> Result<(), NotAdded> {
        if self.balls.len() == MAX_BALLS {
            return Err(NotAdded::Full);
        }
        let inside = position.abs().max_element() <= REACH + TOUCH && !position.is_nan();
        if !inside || !self.is_free(position) {
            return Err(NotAdded::NoPlace);
        }
        // NaN is no speed either.
        if velocity.is_nan() || velocity.length() > MAX_SPEED {
            return Err(NotAdded::TooFast);
        }
        let color = COLORS[self.balls.len() % COLORS.len()];
        let now = self.now();
        self.balls.push(Ball::new(position, velocity, now, color));
        let new = self.balls.len() - 1;
        self.begin_flight(new);
        self.predict_event(new, now);
        Ok(())
    }

    /// Removes the newest ball; false where there is none. What was predicted for it no longer holds.
    #[doc(alias = "KillBall")]
    pub fn kill_ball(&mut self) -> bool {
        self.balls.pop().is_some()
    }

    /// Lets `dt` seconds pass, with everything that happens in them.
    ///
    /// # Panics
    /// If `dt` is negative or not finite: time does not run backwards.
    #[doc(alias = "Simulate")]
    pub fn simulate(&mut self, dt: f64) {
        self.simulate_watched(dt, |_, _| {});
    }

    /// [`Simulation::simulate`], and `watch` sees each bounce, with the balls as they are after it.
    ///
    /// # Panics
    /// If `dt` is negative or not finite.
    pub fn simulate_watched(&mut self, dt: f64, mut watch: impl FnMut(&Bounce, &[Ball])) {
        self.clock.advance(dt);
        while let Some(bounce) = self.next_bounce() {
            watch(&bounce, &self.balls);
        }
    }

    /// Lets the earliest event happen, if its time has come.
    fn next_bounce(&mut self) -> Option<Bounce> {
        let bounce = self.next_event()?.bounce;
        let time = bounce.time;
        match bounce.meeting {
            Meeting::Wall { ball, axis } => {
                wall_bounce(&mut self.balls[ball], axis, time);
                self.begin_flight(ball);
                self.predict_event(ball, time);
            }
            Meeting::Balls { a, b } => {
                let (first, second) = self.balls.split_at_mut(b);
                ball_bounce(&mut first[a], &mut second[0], time);
                self.begin_flight(a);
                self.begin_flight(b);
                self.predict_event(a, time);
                self.predict_event(b, time);
            }
        }
        Some(bounce)
    }

    /// Takes the earliest event that still holds from the queue, if its time has come.
    fn next_event(&mut self) -> Option<Event> {
        let now = self.now();
        while let Some(Reverse(event)) = self.events.peek() {
            if event.bounce.time > now {
                break;
            }
            let Reverse(event) = self.events.pop()?;
            if event.holds(&self.balls) {
                return Some(event);
            }
        }
        None
    }

    /// Queues what can happen next to a ball whose flight begins at `time`: a wall, or balls before that wall.
    #[doc(alias = "PredictEvent")]
    fn predict_event(&mut self, ball: usize, time: f64) {
        let wall = wall_test(&self.balls[ball], time);
        if let Some((time, axis)) = wall {
            self.queue(time, Meeting::Wall { ball, axis });
        }
        // After the wall another flight begins, for which everything is predicted anew.
        let last = wall.map_or(f64::INFINITY, |(time, _)| time);
        for other in 0..self.balls.len() {
            if other == ball {
                continue;
            }
            let hit = hit_test(&self.balls[ball], &self.balls[other], time);
            if let Some(hit) = hit.filter(|hit| *hit <= last) {
                let (a, b) = (ball.min(other), ball.max(other));
                self.queue(hit, Meeting::Balls { a, b });
            }
        }
    }

    fn queue(&mut self, time: f64, meeting: Meeting) {
        let event = Event::new(Bounce { time, meeting }, &self.balls);
        self.events.push(Reverse(event));
    }

    /// Gives the ball's flight a number of its own: events of its earlier flights no longer hold.
    fn begin_flight(&mut self, ball: usize) {
        self.flights += 1;
        self.balls[ball].flight = self.flights;
    }

    /// A random place, within `reach` of the centre on each axis, where a ball would overlap no other.
    fn free_place(&mut self, reach: f64) -> Option<DVec3> {
        for _ in 0..TRIES {
            let place = self.random.in_cube() * reach;
            if self.is_free(place) {
                return Some(place);
            }
        }
        None
    }

    fn is_free(&self, place: DVec3) -> bool {
        self.positions()
            .all(|position| position.distance(place) >= 2.0 * RADIUS - TOUCH)
    }
}

#[cfg(test)]
mod tests;
