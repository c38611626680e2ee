//! What can happen, and in which order.

use std::cmp::Ordering;

use super::Ball;

/// A ball and a wall, or two balls. Their order decides between events of the same instant: walls first, then the
/// older balls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meeting {
    /// The wall stands on the axis 0, 1 or 2, on the side to which the ball flies.
    Wall { ball: usize, axis: usize },
    /// a < b.
    Balls { a: usize, b: usize },
}

/// A meeting and its time, in seconds since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounce {
    pub time: f64,
    pub meeting: Meeting,
}

/// A predicted bounce. It holds while the balls are on the flights that it was predicted for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) bounce: Bounce,
    flights: [Option<u64>; 2],
}

impl Event {
    pub(super) fn new(bounce: Bounce, balls: &[Ball]) -> Event {
        let flights = flights(bounce.meeting, balls);
        Event { bounce, flights }
    }

    /// Whether all its balls are still there, and on the same flights.
    pub(super) fn holds(&self, balls: &[Ball]) -> bool {
        flights(self.bounce.meeting, balls) == self.flights
    }
}

/// The numbers of the flights that the balls of a meeting are on: none for a wall, and none for a ball that is gone.
fn flights(meeting: Meeting, balls: &[Ball]) -> [Option<u64>; 2] {
    let flight = |ball: usize| balls.get(ball).map(|ball| ball.flight);
    match meeting {
        Meeting::Wall { ball, .. } => [flight(ball), None],
        Meeting::Balls { a, b } => [flight(a), flight(b)],
    }
}

/// Earlier before later; at the same instant as their meetings are ordered, so that the same events always happen in
/// the same order.
impl Ord for Event {
    fn cmp(&self, other: &Event) -> Ordering {
        let (a, b) = (&self.bounce, &other.bounce);
        a.time
            .total_cmp(&b.time)
            .then(a.meeting.cmp(&b.meeting))
            .then(self.flights.cmp(&other.flights))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Event) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Event) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Event {}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn event(time: f64, meeting: Meeting) -> Event {
        Event::new(Bounce { time, meeting }, &[])
    }

    #[test]
    fn events_are_ordered_by_time_then_kind_then_balls() {
        let wall = |ball, axis| Meeting::Wall { ball, axis };
        let balls = |a, b| Meeting::Balls { a, b };
        let ordered = [
            event(1.0, wall(7, 1)),
            event(2.0, wall(3, 0)),
            event(2.0, wall(3, 2)),
            event(2.0, wall(4, 1)),
            event(2.0, balls(0, 5)),
            event(2.0, balls(1, 2)),
            event(3.0, wall(0, 0)),
        ];
        assert!(ordered.is_sorted());
        assert!(ordered.windows(2).all(|pair| pair[0] != pair[1]));
    }

    #[test]
    fn an_event_holds_until_one_of_its_balls_flies_on_or_is_gone() {
        let mut balls = vec![Ball::new(DVec3::ZERO, DVec3::X, 0.0, [0; 3]); 2];
        let meeting = Meeting::Balls { a: 0, b: 1 };
        let event = Event::new(Bounce { time: 1.0, meeting }, &balls);
        assert!(event.holds(&balls));
        balls[1].flight += 1;
        assert!(!event.holds(&balls));
        balls.pop();
        assert!(!event.holds(&balls));
    }
}
