//! Where `explain` says that a test looks into its map: the texels around that place tell the verdict.

mod common;

use common::{Bench, Random};
use shadowlab::gl;
use shadowlab::labs::Probe;

const SIZE: [u32; 2] = [320, 240];
const PIXELS: u32 = 60;
/// Texels around the look-up, to each side: PCF takes its samples within them.
const AROUND: i64 = 3;

/// What the texels around say, where they are all on the map and say the same.
fn unanimous(bench: &Bench, light: usize, [u, v]: [f64; 2], depth: f64) -> Option<bool> {
    let map = bench.lab.shadow_texture(light).unwrap();
    let side = 2 * AROUND + 1;
    let first = [u, v].map(|at| (at * f64::from(map.scale.size)).floor() as i64 - AROUND);
    let last = i64::from(map.scale.size) - side;
    if first.iter().any(|at| !(0..=last).contains(at)) {
        return None;
    }
    let (first, count) = (first.map(|at| at as u32), [side as u32; 2]);
    let texels = gl::read_depth_texels(&bench.context.gl, map.texture, first, count).unwrap();
    let dark = texels.iter().filter(|stored| f64::from(**stored) < depth);
    match dark.count() {
        0 => Some(false),
        all if all == texels.len() => Some(true),
        _ => None,
    }
}

/// How many verdicts the texels tell, and how many of these are otherwise; with the map upside down, too.
fn told(lab: &str, light: usize, settings: &[&str]) -> [[usize; 2]; 2] {
    let mut bench = Bench::new(lab, SIZE, settings);
    let mut random = Random(7);
    let mut counts = [[0; 2]; 2];
    for _ in 0..PIXELS {
        let pixel = [random.below(SIZE[0]), random.below(SIZE[1])];
        let gl = &bench.context.gl;
        let explanation = bench.lab.explain(gl, Probe::Pixel(pixel), light).unwrap();
        let (Some(look_up), Some(in_shadow)) = (explanation.look_up, explanation.in_shadow) else {
            continue;
        };
        let [u, v] = look_up.uv.to_array();
        for (uv, [told, otherwise]) in [[u, v], [u, 1.0 - v]].into_iter().zip(&mut counts) {
            if let Some(dark) = unanimous(&bench, light, uv, look_up.depth) {
                *told += 1;
                *otherwise += usize::from(dark != in_shadow);
            }
        }
    }
    counts
}

#[test]
fn the_texels_around_a_look_up_tell_the_verdict() {
    for (lab, light, settings) in [
        ("cs541", 1, &["filter=nearest"][..]),
        ("cs541", 1, &[]),
        ("csci3260", 1, &[]),
        ("cmsc23700", 1, &[]),
        ("cmsc23700", 2, &[]),
        ("aueb7", 1, &["map_size=1024"]),
    ] {
        let [[right, otherwise], [_, upside_down]] = told(lab, light, settings);
        println!(
            "{lab} light {light} {settings:?}: {right} told, {upside_down} otherwise upside down"
        );
        assert!(right > 5, "{lab}: {right}");
        assert_eq!(otherwise, 0, "{lab}: of {right}");
        // The control: another place of the map tells something else.
        assert!(upside_down > 0, "{lab}: upside down");
    }
}
