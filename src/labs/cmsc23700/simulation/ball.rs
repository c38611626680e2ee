//! One ball: its flight, when it meets a wall or another ball, and how it bounces.

use glam::DVec3;

/// In box units.
pub const RADIUS: f64 = 0.05;
/// How far from the box's centre a ball's centre can be on each axis, in box units.
pub const REACH: f64 = 1.0 - RADIUS;

/// Balls that touch, and approach no faster than this share of their speeds, rest against each other.
///
/// A speed's rounding is 10⁻¹⁶ of it, and so can be what is left of an approach after a bounce. Were a bounce made of
/// that, it would change nothing, and balls that touch could meet for ever with no time passing.
const RESTING: f64 = 1e-14;

/// A ball on its present flight, which is straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball {
    /// Where and when the flight began.
    position: DVec3,
    time: f64,
    velocity: DVec3,
    /// The number of the flight, which no other flight has.
    pub(super) flight: u64,
    color: [u8; 3],
}

impl Ball {
    /// A ball with its centre at `position` at `time`.
    pub fn new(position: DVec3, velocity: DVec3, time: f64, color: [u8; 3]) -> Ball {
        Ball {
            position,
            time,
            velocity,
            flight: 0,
            color,
        }
    }

    /// Where the centre is at a time of this flight, in seconds since the start.
    pub fn position_at(&self, time: f64) -> DVec3 {
        self.position + self.velocity * (time - self.time)
    }

    /// In box units per second.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// RGB, from 0 to 255.
    pub fn color(&self) -> [u8; 3] {
        self.color
    }

    /// Ends the flight where the ball is at `time`, and begins the next one there.
    fn fly_to(&mut self, time: f64) {
        self.position = self.position_at(time);
        self.time = time;
    }
}

/// When, from `now` on, the ball meets a wall, and the axis (0, 1, 2) on which that wall stands; None for a ball at
/// rest. Of walls that are met at once, the one with the lowest axis.
pub fn wall_test(ball: &Ball, now: f64) -> Option<(f64, usize)> {
    let position = ball.position_at(now);
    (0..3)
        .filter(|axis| ball.velocity[*axis] != 0.0)
        .map(|axis| {
            let speed = ball.velocity[axis];
            // Rounding may have carried the ball past the wall: then it meets it now.
            let wait = (REACH.copysign(speed) - position[axis]) / speed;
            (now + wait.max(0.0), axis)
        })
        .filter(|(time, _)| time.is_finite())
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// When, from `now` on, two balls meet if nothing else happens to them; None if they never do.
#[doc(alias = "HitTest")]
pub fn hit_test(a: &Ball, b: &Ball, now: f64) -> Option<f64> {
    let distance = b.position_at(now) - a.position_at(now);
    let velocity = b.velocity - a.velocity;
    // |distance + velocity·t| = 2·RADIUS is (velocity²)·t² + 2·approach·t + gap = 0.
    let approach = distance.dot(velocity);
    let gap = distance.length_squared() - (2.0 * RADIUS).powi(2);
    if approach >= 0.0 {
        return None;
    }
    if gap <= 0.0 {
        // They touch already.
        let speeds = a.velocity.length() + b.velocity.length();
        let resting = -approach <= RESTING * speeds * distance.length();
        return (!resting).then_some(now);
    }
    let discriminant = approach * approach - velocity.length_squared() * gap;
    if discriminant < 0.0 {
        return None;
    }
    // The earlier root, written so that nothing cancels: both terms of the sum are positive.
    let time = now + gap / (discriminant.sqrt() - approach);
    time.is_finite().then_some(time)
}

/// The wall on that axis, on the side to which the ball flies, throws it back at `time`.
#[doc(alias = "WallBounce")]
pub fn wall_bounce(ball: &mut Ball, axis: usize, time: f64) {
    ball.fly_to(time);
    // Exactly at the wall, so that rounding never adds up to an escape.
    ball.position[axis] = REACH.copysign(ball.velocity[axis]);
    ball.velocity[axis] = -ball.velocity[axis];
}

/// Two balls of equal mass, which touch at `time`, exchange what of their velocities is along the contact normal.
///
/// What is exchanged is q = d·(w·d)/(d·d), with d from centre to centre and w the difference of the velocities. Both
/// change by the same q, which keeps the momentum. The kinetic energy changes by q·q − q·w, which is 0 whatever the
/// length of d: so nothing but the last bits is lost, to either side. Over 10⁶ collisions that is 3·10⁻¹⁵ of the energy;
/// with d/|d| for the normal, 4·10⁻¹⁴; with (2·RADIUS)² in the place of d·d, which it is but for the rounding of the
/// time, more than 10⁻⁹.
#[doc(alias = "BallBounce")]
pub fn ball_bounce(a: &mut Ball, b: &mut Ball, time: f64) {
    a.fly_to(time);
    b.fly_to(time);
    let distance = b.position - a.position;
    let velocity = b.velocity - a.velocity;
    let exchanged = distance * (velocity.dot(distance) / distance.length_squared());
    a.velocity += exchanged;
    b.velocity -= exchanged;
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn ball(position: [f64; 3], velocity: [f64; 3]) -> Ball {
        Ball::new(position.into(), velocity.into(), 0.0, [0; 3])
    }

    #[test]
    fn balls_meet_when_their_centres_are_two_radii_apart() {
        let still = ball([0.0; 3], [0.0; 3]);
        // Head-on: 0.5 apart, 0.4 to go.
        let head_on = ball([0.5, 0.0, 0.0], [-1.0, 0.0, 0.0]);
        assert!((hit_test(&still, &head_on, 0.0).unwrap() - 0.4).abs() < 1e-15);
        // Aimed 0.06 beside the centre: they meet where the other side of the triangle is 0.08.
        let beside = ball([0.5, 0.06, 0.0], [-1.0, 0.0, 0.0]);
        assert!((hit_test(&still, &beside, 0.0).unwrap() - 0.42).abs() < 1e-15);
        // From a later time on, the answer is the same time.
        assert!((hit_test(&still, &beside, 0.3).unwrap() - 0.42).abs() < 1e-15);
        // Past each other by a hair, and away from each other.
        assert!(hit_test(&still, &ball([0.5, 0.0999, 0.0], [-1.0, 0.0, 0.0]), 0.0).is_some());
        assert!(hit_test(&still, &ball([0.5, 0.1001, 0.0], [-1.0, 0.0, 0.0]), 0.0).is_none());
        assert!(hit_test(&still, &ball([0.5, 0.0, 0.0], [1.0, 0.0, 0.0]), 0.0).is_none());
        assert!(hit_test(&still, &still, 0.0).is_none());
    }

    #[test]
    fn balls_that_touch_meet_only_if_they_approach() {
        let still = ball([0.0; 3], [0.0; 3]);
        let touching = |velocity| ball([0.0, 2.0 * RADIUS, 0.0], velocity);
        assert_eq!(
            hit_test(&still, &touching([0.0, -1.0, 0.0]), 0.25),
            None,
            "they have flown through each other by then, and part"
        );
        assert_eq!(
            hit_test(&still, &touching([0.0, -1.0, 0.0]), 0.0),
            Some(0.0)
        );
        assert_eq!(
            hit_test(&still, &touching([3.0, -1e-9, 0.0]), 0.0),
            Some(0.0)
        );
        assert_eq!(hit_test(&still, &touching([0.0, 1.0, 0.0]), 0.0), None);
        assert_eq!(hit_test(&still, &touching([1.0, 0.0, 0.0]), 0.0), None);
        // An approach that is rounding: the difference of the speeds is 10⁻¹⁶ of them.
        let (a, b) = (
            ball([0.0; 3], [1.0, 1.0, 0.0]),
            touching([1.0, 1.0 - 1e-16, 0.0]),
        );
        assert!((b.velocity - a.velocity).dot(dvec3(0.0, 1.0, 0.0)) < 0.0);
        assert_eq!(hit_test(&a, &b, 0.0), None);
    }

    #[test]
    fn the_nearest_wall_in_the_way_is_met() {
        // Half a unit from the walls of two axes.
        let half = REACH - 0.5;
        let at = |velocity| wall_test(&ball([half, 0.0, -half], velocity), 0.0);
        assert_eq!(at([1.0, 1.0, 1.0]), Some((0.5, 0)));
        assert_eq!(at([-1.0, 1.0, -2.0]), Some((0.25, 2)));
        assert_eq!(at([1.0, 0.0, -1.0]), Some((0.5, 0)), "the lower axis first");
        assert_eq!(at([0.0; 3]), None);
        // Past the wall by rounding: outwards it is met now, inwards it is left behind.
        let past = |speed| ball([REACH + 1e-15, 0.0, 0.0], [speed, 0.0, 0.0]);
        assert_eq!(wall_test(&past(1.0), 0.0), Some((0.0, 0)));
        let (time, _) = wall_test(&past(-1.0), 0.0).unwrap();
        assert!((time - 2.0 * REACH).abs() < 1e-12);
    }

    #[test]
    fn a_wall_turns_one_part_of_the_velocity_round() {
        let mut ball = ball([0.45, 0.1, 0.0], [1.0, -0.5, 0.25]);
        wall_bounce(&mut ball, 0, 0.5);
        assert_eq!(ball.velocity(), dvec3(-1.0, -0.5, 0.25));
        assert_eq!(ball.position_at(0.5), dvec3(REACH, 0.1 - 0.25, 0.125));
        assert!((ball.position_at(1.0) - dvec3(0.45, -0.4, 0.25)).length() < 1e-15);
    }

    #[test]
    fn balls_exchange_velocity_along_the_contact_normal_only() {
        // The normal is x; y and z are each ball's own.
        let mut a = ball([0.0; 3], [2.0, 0.5, 0.0]);
        let mut b = ball([2.0 * RADIUS, 0.0, 0.0], [-1.0, 0.25, 3.0]);
        ball_bounce(&mut a, &mut b, 0.0);
        let expected = [dvec3(-1.0, 0.5, 0.0), dvec3(2.0, 0.25, 3.0)];
        assert!((a.velocity() - expected[0]).length() < 1e-15);
        assert!((b.velocity() - expected[1]).length() < 1e-15);
    }
}
