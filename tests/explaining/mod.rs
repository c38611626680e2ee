//! What `explain` says of a lab, held against the lab's own pictures and against f64.
#![allow(dead_code)] // A lab with one light has no use for the choice of one.

use shadowlab::labs::Probe;

use super::common::{Bench, Random};

const SIZE: [u32; 2] = [320, 240];

/// Draws the pixels for a state, and returns how many of them were explained as surfaces.
pub fn explained(lab: &str, settings: &[&str], pixels: u32, seed: u64) -> u32 {
    explained_for(lab, 1, settings, pixels, seed)
}

/// The same for a light (from 1).
pub fn explained_for(lab: &str, light: usize, settings: &[&str], pixels: u32, seed: u64) -> u32 {
    let mut bench = Bench::new(lab, SIZE, settings);
    let visibility = bench.visibility_of(light);
    let picture = bench.picture();
    let mut random = Random(seed);
    let mut surfaces = 0;
    let mut nearest_to_bound: f64 = 0.0;
    for _ in 0..pixels {
        let pixel = [random.below(SIZE[0]), random.below(SIZE[1])];
        let explanation = bench
            .lab
            .explain(&bench.context.gl, Probe::Pixel(pixel), light)
            .unwrap();
        let [x, y] = pixel;
        assert_eq!(explanation.color, Some(picture.get_pixel(x, y).0));
        let lit = visibility.get_pixel(x, y).0[0] >= 128;
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
        "{lab} {settings:?}: {surfaces} surfaces of {pixels} pixels, at most {nearest_to_bound:.2} of a bound"
    );
    surfaces
}
