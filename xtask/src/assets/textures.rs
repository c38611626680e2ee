//! Pictures from noise and simple shapes. In every formula u goes right and v goes up, from 0 to 1.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use image::RgbImage;

use super::paint::{clouds, hash, mix, noise, picture, smooth, step, supersampled};

/// Light oak planks in eight courses. Repeats in both directions; shadows stay readable on it.
pub fn floor() -> RgbImage {
    picture(512, 512, 6, |u, v| {
        let plank = Plank::at(u, v, 8, 2);
        let wood = plank.wood(u, DVec3::new(0.80, 0.66, 0.49));
        // The joints are the only dark lines.
        let joint = step(0.035, 0.012, plank.to_side).max(step(0.006, 0.002, plank.to_end));
        mix(wood, DVec3::new(0.42, 0.31, 0.21), 0.75 * joint)
    })
}

/// A sky dome: u is the azimuth, v the elevation; v = 1 is the zenith and v = ½ the horizon.
pub fn sky() -> RgbImage {
    picture(512, 256, 4, |u, v| {
        let elevation = PI * (v - 0.5);
        let haze = DVec3::new(0.86, 0.90, 0.93);
        if elevation <= 0.0 {
            // Below the horizon: the haze, and then the far ground.
            let depth = smooth(0.0, 0.35, -elevation);
            return mix(haze, DVec3::new(0.52, 0.54, 0.52), depth);
        }
        let blue = mix(
            DVec3::new(0.60, 0.77, 0.93),
            DVec3::new(0.22, 0.45, 0.78),
            elevation.sin().powf(0.8),
        );
        let clear = mix(haze, blue, smooth(0.0, 0.45, elevation));
        // The clouds lie on a flat layer above: a function of the direction has no seam.
        let azimuth = TAU * u;
        let reach = elevation.cos() / (elevation.sin() + 0.18);
        let on_layer = reach * DVec2::new(azimuth.cos(), azimuth.sin()) * 1.7;
        let cover = clouds(on_layer + DVec2::splat(40.0));
        let thick = smooth(0.50, 0.72, cover);
        let shade = smooth(0.62, 0.85, cover);
        let cloud = mix(DVec3::splat(0.99), DVec3::new(0.80, 0.84, 0.90), shade);
        mix(clear, cloud, 0.92 * thick * smooth(0.03, 0.30, elevation))
    })
}

/// A framed painting: hills, a lake and the sun.
pub fn painting() -> RgbImage {
    supersampled(256, 256, |u, v| {
        let to_edge = u.min(1.0 - u).min(v.min(1.0 - v));
        if to_edge < 0.09 {
            return frame(u, v, to_edge);
        }
        canvas((u - 0.09) / 0.82, (v - 0.09) / 0.82)
    })
}

/// One side of a crate: boards, a frame around them and a brace across, all nailed.
pub fn wooden_crate() -> RgbImage {
    picture(256, 256, 10, |u, v| {
        let across = (u - v).abs() / 2f64.sqrt();
        let (in_u, in_v) = (u.min(1.0 - u), v.min(1.0 - v));
        let base = DVec3::new(0.66, 0.47, 0.28);
        // Upright beams go from edge to edge, the others fit between them, the brace between all four.
        let (wood, to_side) = if in_u < BEAM {
            (Plank::at(v, u, 7, 1).wood(v, base), in_u.min(BEAM - in_u))
        } else if in_v < BEAM {
            (
                Plank::at(u, v, 7, 1).wood(u, base),
                in_v.min(BEAM - in_v).min(in_u - BEAM),
            )
        } else if across < BEAM / 2.0 {
            let brace = Plank::at((u + v) / 2.0, u - v + 0.5, 5, 1);
            let to_beam = in_u.min(in_v) - BEAM;
            (
                brace.wood((u + v) / 2.0, base),
                (BEAM / 2.0 - across).min(to_beam),
            )
        } else {
            let board = Plank::at(v, u, 6, 1);
            let under = (across - BEAM / 2.0).min(in_u.min(in_v) - BEAM);
            // The beams lie on the boards and darken them beside their edges.
            let shadow = 0.62 + 0.20 * smooth(0.0, 0.05, under);
            (board.wood(v, base) * shadow, board.to_side / 6.0)
        };
        let groove = mix(wood, wood * 0.35, step(0.012, 0.003, to_side));
        mix(groove, DVec3::new(0.24, 0.22, 0.21), nails(in_u, in_v))
    })
}

/// The wall of the lighthouse: courses of stone, red and white stripes, windows and the door.
pub fn lighthouse() -> RgbImage {
    supersampled(256, 256, |u, v| {
        let stripe = ((v - 0.10) * 5.0 / 0.90).floor() as i64;
        let paint = match stripe.rem_euclid(2) {
            _ if v < 0.10 => masonry(u, v),
            0 => DVec3::new(0.93, 0.91, 0.87),
            _ => DVec3::new(0.78, 0.16, 0.13),
        };
        // Rain leaves faint streaks, and the paint is darker at the foot of the wall.
        let streak = noise(u * 48.0, v * 3.0, 48, 3, 7) - 0.5;
        let wall = paint * (1.0 + 0.07 * streak) * (0.90 + 0.10 * smooth(0.0, 0.3, v));
        let wall = opening(wall, u - 0.25, v, 0.065, 0.01, 0.19, Fill::Door);
        // Windows wind up the tower with the stair inside.
        [(0.25, 0.36), (0.58, 0.50), (0.92, 0.64), (0.25, 0.80)]
            .iter()
            .fold(wall, |wall, &(x, y)| {
                opening(wall, wrapped(u - x), v, 0.032, y, 0.085, Fill::Window)
            })
    })
}

/// The width of the crate's beams.
const BEAM: f64 = 0.14;

/// A place on a floor of boards that run along u.
struct Plank {
    seed: i64,
    /// Across the board, from 0 to 1.
    across: f64,
    /// How far the board's sides and its ends are, in widths and in lengths of boards.
    to_side: f64,
    to_end: f64,
}

impl Plank {
    /// `courses` rows of `per_course` boards each; every other course is moved by half a board.
    fn at(u: f64, v: f64, courses: i64, per_course: i64) -> Self {
        let course = (v * courses as f64).floor() as i64;
        let across = v * courses as f64 - course as f64;
        let shift = if per_course > 1 {
            0.5 * (course % 2) as f64 + 0.17 * hash(course, 3, 5)
        } else {
            0.0
        };
        let along = u * per_course as f64 + shift;
        let board = (along.floor() as i64).rem_euclid(per_course);
        let end = along - along.floor();
        Self {
            seed: course.rem_euclid(courses) * 64 + board,
            across,
            to_side: across.min(1.0 - across),
            to_end: if per_course > 1 {
                end.min(1.0 - end)
            } else {
                1.0
            },
        }
    }

    /// Wood with its own tone and grain. Repeats along u.
    fn wood(&self, u: f64, base: DVec3) -> DVec3 {
        let tone = 0.90 + 0.16 * hash(self.seed, 11, 1);
        let seed = self.seed + 100;
        // Year rings, cut lengthwise: lines that wander along the board and crowd together.
        let wander = noise(u * 5.0, self.across * 1.5, 5, 64, seed);
        let rings = ((self.across * 5.0 + 2.4 * wander) * TAU).sin();
        let fibre = noise(u * 16.0, self.across * 24.0, 16, 64, seed + 1) - 0.5;
        base * (tone + 0.035 * rings + 0.07 * fibre)
    }
}

/// Gilt wood with mitred corners, lit from above left.
fn frame(u: f64, v: f64, to_edge: f64) -> DVec3 {
    let facing = if to_edge == v {
        -0.7
    } else if to_edge == 1.0 - v {
        0.9
    } else if to_edge == u {
        0.5
    } else {
        -0.4
    };
    // A round moulding between two flat steps.
    let bulge = ((to_edge / 0.09 - 0.15) / 0.6).clamp(0.0, 1.0);
    let slope = (PI * bulge).cos();
    let lit = 0.78 + 0.22 * facing * slope;
    let line = step(0.004, 0.001, (to_edge - 0.070).abs()).max(step(0.006, 0.002, to_edge));
    DVec3::new(0.72, 0.52, 0.22) * lit * (1.0 - 0.55 * line)
}

/// The painting itself, from back to front.
fn canvas(u: f64, v: f64) -> DVec3 {
    let mut color = mix(
        DVec3::new(0.99, 0.80, 0.52),
        DVec3::new(0.36, 0.60, 0.80),
        smooth(0.35, 1.0, v),
    );
    let from_sun = DVec2::new(u - 0.66, v - 0.68).length();
    for (radius, glow) in [(0.24, 0.25), (0.18, 0.35), (0.115, 1.0)] {
        color = mix(
            color,
            DVec3::new(1.0, 0.91, 0.62),
            glow * step(radius + 0.003, radius, from_sun),
        );
    }
    let ridges = [
        (0.50, 0.10, 1.3, 0.4, [0.55, 0.56, 0.68]),
        (0.40, 0.09, 1.0, 2.6, [0.36, 0.49, 0.52]),
        (0.30, 0.07, 1.6, 4.4, [0.29, 0.47, 0.33]),
    ];
    for (height, swing, waves, phase, [red, green, blue]) in ridges {
        let ridge = height + swing * (waves * TAU * u + phase).sin();
        // Each hill is lighter along its crest.
        let below = smooth(0.0, 0.22, ridge - v);
        let hill = DVec3::new(red, green, blue) * (1.12 - 0.22 * below);
        color = mix(color, hill, step(0.002, -0.002, v - ridge));
    }
    let shore = 0.17 + 0.025 * (TAU * u * 0.8 + 1.0).sin();
    let ripple = 0.5 + 0.5 * (v * 170.0 + 3.0 * (u * 9.0).sin()).sin();
    // The sun's path on the water is narrower the farther away it is.
    let path = step(0.05 + 0.9 * (shore - v), 0.0, (u - 0.66).abs()) * step(0.35, 0.65, ripple);
    let water = mix(
        DVec3::new(0.30, 0.52, 0.66),
        DVec3::new(0.98, 0.86, 0.62),
        0.75 * path,
    );
    mix(color, water, step(0.002, -0.002, v - shore))
}

/// Where the nails are: two at each end of the four beams.
fn nails(in_u: f64, in_v: f64) -> f64 {
    let beside = DVec2::new(in_u - BEAM / 2.0, in_v);
    let near = |v: f64| (beside - DVec2::new(0.0, v)).length();
    step(0.013, 0.008, near(0.035).min(near(BEAM - 0.035)))
}

/// Blocks of stone in three courses up to v = 0.1, each course moved by half a block.
fn masonry(u: f64, v: f64) -> DVec3 {
    let course = (v * 30.0).floor();
    let along = u * 16.0 + 0.5 * course;
    let (x, y) = (along.fract(), (v * 30.0).fract());
    let block = hash((along.floor() as i64).rem_euclid(16), course as i64, 21);
    let joint = step(0.10, 0.04, x.min(1.0 - x)).max(step(0.14, 0.06, y.min(1.0 - y)));
    let stone = DVec3::new(0.60, 0.58, 0.54) * (0.88 + 0.20 * block);
    mix(stone, DVec3::new(0.40, 0.39, 0.37), joint)
}

#[derive(Clone, Copy)]
enum Fill {
    Door,
    Window,
}

/// A round-headed opening in a stone surround, `half` wide to each side and `height` high above `foot`.
///
/// Lengths are in v: the wall is longer around than it is high, so u counts more.
fn opening(wall: DVec3, x: f64, v: f64, half: f64, foot: f64, height: f64, fill: Fill) -> DVec3 {
    let x = 1.6 * x;
    let spring = foot + height - half;
    let from_axis = if v > spring {
        DVec2::new(x, v - spring).length()
    } else {
        x.abs()
    };
    let outside = (from_axis - half).max(foot - v);
    let inside = match fill {
        Fill::Door => {
            let board = ((x / half + 1.0) * 2.5).fract();
            let gap = step(0.14, 0.05, board.min(1.0 - board));
            let knob = step(
                0.006,
                0.004,
                DVec2::new(x - 0.6 * half, v - foot - 0.4 * height).length(),
            );
            let wood = DVec3::new(0.20, 0.36, 0.34) * (1.0 - 0.35 * gap);
            mix(wood, DVec3::new(0.85, 0.70, 0.35), knob)
        }
        Fill::Window => {
            let glass = mix(
                DVec3::new(0.16, 0.22, 0.30),
                DVec3::new(0.42, 0.55, 0.66),
                smooth(foot, foot + height, v),
            );
            let middle = (v - foot - 0.45 * height).abs().min(x.abs());
            mix(glass, DVec3::splat(0.85), step(0.0045, 0.0025, middle))
        }
    };
    let surround = mix(
        wall,
        DVec3::new(0.70, 0.68, 0.63),
        step(0.016, 0.013, outside),
    );
    mix(surround, inside, step(0.002, -0.002, outside))
}

/// A difference of two u, the short way round.
fn wrapped(difference: f64) -> f64 {
    difference - difference.round()
}
