//! The laws that the balls keep. Each is a function from numbers to a complaint, so that the controls can give it wrong
//! numbers.

use glam::DVec3;
use shadowlab::labs::cmsc23700::simulation::{Ball, Bounce, Meeting, RADIUS, REACH};

/// How deep balls may overlap, or leave the box, in box units.
pub const DEPTH: f64 = 1e-9;
/// The share of the kinetic energy that may be lost or won over a whole run.
pub const ENERGY: f64 = 1e-9;
/// The share of Σ|mv| that the momentum may change by when two balls meet.
pub const MOMENTUM: f64 = 1e-12;

pub type Law = Result<(), String>;

pub fn holds(right: bool, complaint: impl FnOnce() -> String) -> Law {
    if right { Ok(()) } else { Err(complaint()) }
}

/// Kinetic energy of balls of mass 1.
pub fn energy(balls: &[Ball]) -> f64 {
    let squares = balls.iter().map(|ball| ball.velocity().length_squared());
    squares.sum::<f64>() / 2.0
}

pub fn keeps_energy(before: f64, after: f64) -> Law {
    let drift = (after - before).abs() / before.max(f64::MIN_POSITIVE);
    holds(drift <= ENERGY, || format!("energy drifts by {drift:e}"))
}

pub fn keeps_momentum(before: [DVec3; 2], after: [DVec3; 2]) -> Law {
    let change = (after[0] + after[1] - before[0] - before[1]).length();
    let scale = before[0].length() + before[1].length();
    holds(change <= MOMENTUM * scale, || {
        format!("momentum changes by {change:e} of {scale}")
    })
}

pub fn none_escapes(positions: &[DVec3]) -> Law {
    for (k, position) in positions.iter().enumerate() {
        let depth = position.abs().max_element() - REACH;
        holds(depth <= DEPTH, || {
            format!("ball {k} is {depth:e} past a wall")
        })?;
    }
    Ok(())
}

pub fn none_overlap(positions: &[DVec3]) -> Law {
    for (b, second) in positions.iter().enumerate() {
        for (a, first) in positions[..b].iter().enumerate() {
            let depth = 2.0 * RADIUS - first.distance(*second);
            holds(depth <= DEPTH, || {
                format!("balls {a} and {b} overlap by {depth:e}")
            })?;
        }
    }
    Ok(())
}

/// The law for all times from `from` to `to`, in which every ball flies straight: the closest that each pair comes.
pub fn none_overlap_between(balls: &[Ball], from: f64, to: f64) -> Law {
    for (b, second) in balls.iter().enumerate() {
        for (a, first) in balls[..b].iter().enumerate() {
            let distance = second.position_at(from) - first.position_at(from);
            let velocity = second.velocity() - first.velocity();
            let closest = -distance.dot(velocity) / velocity.length_squared().max(1e-300);
            let after = closest.clamp(0.0, to - from);
            let depth = 2.0 * RADIUS - (distance + velocity * after).length();
            holds(depth <= DEPTH, || {
                format!("balls {a} and {b} overlap by {depth:e} at {}", from + after)
            })?;
        }
    }
    Ok(())
}

/// What a meeting does: those who meet touch, approach before it and part after it just as fast, and keep their places
/// and what of their velocities is across the normal of the contact. The other balls fly on.
pub fn bounces_right(bounce: &Bounce, before: &[Ball], after: &[Ball]) -> Law {
    let fails = |what: String| format!("{bounce:?}: {what}");
    // A wall has a place and a normal, as a second ball has, and stands still.
    let second = |balls: &[Ball]| match bounce.meeting {
        Meeting::Wall { ball, axis } => {
            let place = balls[ball].position_at(bounce.time);
            let outward = DVec3::AXES[axis] * place[axis].signum();
            (place + outward * (1.0 - place[axis].abs()), DVec3::ZERO)
        }
        Meeting::Balls { b, .. } => (balls[b].position_at(bounce.time), balls[b].velocity()),
    };
    let (first, touching) = match bounce.meeting {
        Meeting::Wall { ball, .. } => (ball, RADIUS),
        Meeting::Balls { a, .. } => (a, 2.0 * RADIUS),
    };
    let [old, new] = [before, after].map(|balls| {
        let ball = &balls[first];
        let (place, velocity) = second(balls);
        let distance = place - ball.position_at(bounce.time);
        (distance, velocity - ball.velocity())
    });

    let gap = old.0.length() - touching;
    holds(gap.abs() <= DEPTH, || fails(format!("{gap:e} apart")))?;
    let normal = old.0.normalize();
    let (closing, parting) = (-old.1.dot(normal), new.1.dot(normal));
    let small = 1e-9 * (before[first].velocity().length() + second(before).1.length());
    holds(closing >= -small, || {
        fails(format!("they part at {closing}"))
    })?;
    holds((closing - parting).abs() <= small, || {
        fails(format!("they close at {closing} and part at {parting}"))
    })?;
    for (k, (old, new)) in before.iter().zip(after).enumerate() {
        let met = match bounce.meeting {
            Meeting::Wall { ball, .. } => k == ball,
            Meeting::Balls { a, b } => k == a || k == b,
        };
        holds(met || old == new, || {
            fails(format!("ball {k} is disturbed"))
        })?;
        let moved = new.position_at(bounce.time) - old.position_at(bounce.time);
        holds(moved.length() <= DEPTH, || {
            fails(format!("ball {k} jumps by {moved}"))
        })?;
        let across = (new.velocity() - old.velocity()).reject_from_normalized(normal);
        holds(across.length() <= small, || {
            fails(format!("ball {k} is pushed by {across}"))
        })?;
    }
    if let Meeting::Balls { a, b } = bounce.meeting {
        let both = |balls: &[Ball]| [balls[a].velocity(), balls[b].velocity()];
        keeps_momentum(both(before), both(after))?;
    }
    Ok(())
}

/// What is the same for two runs: every event to the last bit.
pub fn same_events(first: &[Bounce], second: &[Bounce]) -> Law {
    holds(first.len() == second.len(), || {
        format!("{} events, and {}", first.len(), second.len())
    })?;
    for (k, (a, b)) in first.iter().zip(second).enumerate() {
        let same = a.time.to_bits() == b.time.to_bits() && a.meeting == b.meeting;
        holds(same, || format!("event {k}: {a:?}, and {b:?}"))?;
    }
    Ok(())
}

/// Where the balls are at that time of their present flights.
pub fn at(balls: &[Ball], time: f64) -> Vec<DVec3> {
    balls.iter().map(|ball| ball.position_at(time)).collect()
}
