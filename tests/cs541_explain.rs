//! `explain` says what the shader computed: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;

use common::{Bench, Random};
use shadowlab::labs::Probe;

const SIZE: [u32; 2] = [320, 240];

/// Draws the pixels for a state, and returns how many of them were explained as surfaces.
fn check(settings: &[&str], pixels: u32, seed: u64) -> u32 {
    let mut bench = Bench::new("cs541", SIZE, settings);
    let visibility = bench.visibility();
    let picture = bench.picture();
    let mut random = Random(seed);
    let mut surfaces = 0;
    let mut nearest_to_bound: f64 = 0.0;
    for _ in 0..pixels {
        let pixel = [random.below(SIZE[0]), random.below(SIZE[1])];
        let explanation = bench
            .lab
            .explain(&bench.context.gl, Probe::Pixel(pixel))
            .unwrap();
        let [x, y] = pixel;
        assert_eq!(explanation.color, Some(picture.get_pixel(x, y).0));
        let lit = visibility.get_pixel(x, y).0[0] == 255;
        assert_eq!(
            explanation.in_shadow.unwrap_or(false),
            !lit,
            "{settings:?}\n{explanation}"
        );
        if explanation.in_shadow.is_some() {
            surfaces += 1;
        }
        for step in &explanation.steps {
            assert!(step.agrees(), "{settings:?}: {}\n{explanation}", step.name);
            for i in 0..step.gpu.len() {
                let share = (step.gpu[i] - step.exact[i]).abs() / step.bound[i];
                nearest_to_bound = nearest_to_bound.max(share);
                if share > 0.9 {
                    println!("{} {i}: {share} {:e}", step.name, step.bound[i]);
                }
            }
        }
    }
    println!(
        "{settings:?}: {surfaces} surfaces of {pixels} pixels, at most {nearest_to_bound:.2} of a bound"
    );
    surfaces
}

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [&[&str]; 8] = [
        &[],
        &["remedy=none"],
        &["filter=nearest"],
        &["light=point"],
        &["beam=circular", "depth_format=16", "remedy=culling"],
        &[
            "depth_format=32F",
            "map_size=256",
            "remedy=both",
            "second_plane=on",
        ],
        &["depth_format=24", "map_size=300", "spot_angle=110"],
        &["filter=nearest", "map_size=4096", "epsilon=0.01"],
    ];
    let explained: u32 = states
        .iter()
        .zip(1..)
        .map(|(settings, seed)| check(settings, 125, seed))
        .sum();
    // The sky takes about a third of the picture.
    assert!(explained > 600, "only {explained} pixels showed a surface");
}
