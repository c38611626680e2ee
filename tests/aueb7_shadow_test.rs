//! The exercises' shadow test: one function in the lighting, in the visibility, and in a reference on the CPU.

mod common;

use common::{Bench, differing};
use glam::{DMat4, DVec3};
use image::{GrayImage, RgbImage};
use shadowlab::ground_truth::{Rays, Truth};
use shadowlab::labs;
use shadowlab::scene::{Scene, camera};

const FILTERS: [(&str, u32); 3] = [("filter=none", 1), ("filter=pcf_5", 5), ("filter=pcf_9", 9)];
const SIZE: [u32; 2] = [320, 320];

fn example() -> Scene {
    (labs::find("aueb7").unwrap().scene)().unwrap()
}

fn bench(settings: &[&str]) -> Bench {
    Bench::new("aueb7", SIZE, settings)
}

fn with_scene(scene: Scene, settings: &[&str]) -> Bench {
    Bench::with_scene("aueb7", scene, SIZE, settings)
}

fn dark(visibility: &GrayImage) -> usize {
    visibility.pixels().filter(|pixel| pixel.0[0] < 128).count()
}

/// How many pixels are not the picture that the visibility foretells, between the one without light and the one without
/// shadows.
fn differs_from_foretold(
    picture: &RgbImage,
    visibility: &GrayImage,
    unshadowed: &RgbImage,
    ambient: &RgbImage,
) -> usize {
    let differs = |x, y| {
        let share = f64::from(visibility.get_pixel(x, y).0[0]) / 255.0;
        (0..3).any(|c| {
            let at = |picture: &RgbImage| f64::from(picture.get_pixel(x, y).0[c]);
            let foretold = at(ambient) + share * (at(unshadowed) - at(ambient));
            // The roundings to bytes may drive them so far apart.
            (at(picture) - foretold).abs() > 1.5
        })
    };
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    pixels.filter(|(x, y)| differs(*x, *y)).count()
}

#[test]
fn visibility_is_the_shadow_factor_of_the_lighting() {
    for test in [
        &["filter=none"][..],
        &["filter=pcf_5"],
        &["filter=pcf_9"],
        &["shadow_test=offset"],
        &["shadow_test=offset", "filter=pcf_9"],
        &["shadow_test=exact"],
    ] {
        for outside in ["outside=dark", "outside=lit"] {
            let settings = [test, &[outside]].concat();
            let mut bench = with_scene(example(), &settings);
            let visibility = bench.visibility();
            let picture = bench.picture();
            bench.set(&["shadows=off"]);
            let unshadowed = bench.picture();
            assert_eq!(dark(&bench.visibility()), 0, "shadows=off");
            let mut unlit = example();
            unlit.lights[0].color = DVec3::ZERO;
            let ambient = with_scene(unlit, &settings).picture();

            let wrong = differs_from_foretold(&picture, &visibility, &unshadowed, &ambient);
            assert_eq!(wrong, 0, "{settings:?}");
            // The control: shadows elsewhere, and the two no longer agree.
            let shifted = image::imageops::flip_horizontal(&visibility);
            assert!(differs_from_foretold(&picture, &shifted, &unshadowed, &ambient) > 1000);
        }
    }
}

#[test]
fn visibility_has_one_grade_more_than_samples() {
    for (filter, samples) in FILTERS {
        let visibility = bench(&["map_size=256", filter]).visibility();
        let mut found: Vec<u8> = visibility.into_raw();
        found.sort_unstable();
        found.dedup();
        let grade = |i| (255.0 * f64::from(i) / f64::from(samples)).round() as u8;
        let grades: Vec<u8> = (0..=samples).map(grade).collect();
        assert_eq!(found, grades, "{filter}");
    }
}

/// The samples of PCF: center, top, bottom, left, right, and the diagonals.
const OFFSETS: [[f64; 2]; 9] = [
    [0.0, 0.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [-1.0, 0.0],
    [1.0, 0.0],
    [-1.0, 1.0],
    [1.0, 1.0],
    [-1.0, -1.0],
    [1.0, -1.0],
];

/// The shadow test of the exercises, from the depths that the GPU has drawn and the points that the truth's rays meet.
struct Reference {
    truth: Truth,
    to_map: DMat4,
    depths: Vec<f32>,
    map_size: f64,
    bias: f64,
}

impl Reference {
    fn new(bench: &mut Bench) -> Self {
        bench.picture();
        let scene = bench.lab.now();
        let light = &scene.lights[0];
        let up = camera::up_for(light.direction);
        let view = camera::view(light.position - scene.camera.eye, light.direction, up);
        let projection = camera::perspective(90.0, 1.0, light.near, Some(light.far));
        let map = bench.lab.shadow_texture(1).unwrap();
        let size = [map.scale.size; 2];
        let truth = Rays::new(&scene, 0).truth(SIZE);
        Self {
            truth,
            to_map: projection * view,
            depths: shadowlab::gl::read_depths(&bench.context.gl, map.texture, size).depths,
            map_size: f64::from(size[0]),
            bias: map.scale.bias,
        }
    }

    /// None where a hair's breadth decides.
    fn lit(&self, uv: [f64; 2], depth: f64) -> Option<bool> {
        let is_near = |a: f64, b: f64, by: f64| (a - b).abs() < by;
        let all = [uv[0], uv[1], depth];
        if all
            .iter()
            .any(|c| is_near(*c, 0.0, 1e-5) || is_near(*c, 1.0, 1e-5))
        {
            return None;
        }
        if all.iter().any(|c| !(0.0..=1.0).contains(c)) {
            return Some(false);
        }
        let [x, y] = uv.map(|c| c * self.map_size);
        if [x, y].iter().any(|c| is_near(*c, c.round(), 0.02)) {
            return None;
        }
        // The picture's first row is the map's last.
        let row = self.map_size - 1.0 - y.floor();
        let stored = self.depths[(row * self.map_size + x.floor()) as usize];
        let nearer = depth - self.bias;
        (!is_near(f64::from(stored), nearer, 2e-6)).then_some(f64::from(stored) >= nearer)
    }

    /// How many pixels were compared, and how many of them differ.
    fn compare(&self, visibility: &GrayImage, samples: usize, step: f64) -> [usize; 2] {
        let mut counts = [0, 0];
        for (seen, pixel) in self.truth.seen.iter().zip(visibility.pixels()) {
            let Some((_, point)) = seen else { continue };
            let clip = self.to_map * point.extend(1.0);
            assert!(clip.w > 0.0, "nothing is behind the light");
            let place = 0.5 * clip.truncate() / clip.w + 0.5;
            let sample = |offset: &[f64; 2]| {
                let [dx, dy] = offset.map(|o| o * step / self.map_size);
                self.lit([place.x + dx, place.y + dy], place.z)
            };
            let lit: Option<Vec<bool>> = OFFSETS[..samples].iter().map(sample).collect();
            let Some(lit) = lit else { continue };
            let sum = lit.iter().filter(|lit| **lit).count() as f64;
            let expected = (255.0 * sum / samples as f64).round() as u8;
            counts[0] += 1;
            counts[1] += usize::from(pixel.0[0] != expected);
        }
        counts
    }
}

#[test]
fn the_shadow_factor_is_the_mean_of_the_hard_tests_around_a_point() {
    for (filter, samples) in FILTERS {
        for (step, map_size) in [(2.0, 256), (1.0, 256), (3.5, 1024)] {
            let settings = [
                filter.to_owned(),
                format!("step={step}"),
                format!("map_size={map_size}"),
            ];
            let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
            let mut bench = bench(&settings);
            let reference = Reference::new(&mut bench);
            let visibility = bench.visibility();
            let samples = samples as usize;
            let [compared, wrong] = reference.compare(&visibility, samples, step);
            assert!(
                compared > 40_000,
                "{settings:?}: {compared} pixels compared"
            );
            // Where two surfaces meet in a pixel, ray and rasteriser may see different ones.
            assert!(wrong < 20, "{settings:?}: {wrong} of {compared}");
            // The controls: another step, and another number of samples.
            if samples > 1 {
                assert!(reference.compare(&visibility, samples, step + 1.0)[1] > 100);
                assert!(reference.compare(&visibility, 14 - samples, step)[1] > 50);
            }
        }
    }
}

#[test]
fn a_step_of_nothing_is_the_hard_test_and_a_longer_one_blurs_more() {
    let hard = bench(&["map_size=512"]).visibility();
    let grey = |step: &str| {
        let visibility = bench(&["map_size=512", "filter=pcf_5", step]).visibility();
        let is_grey = |pixel: &&image::Luma<u8>| !matches!(pixel.0[0], 0 | 255);
        (visibility.pixels().filter(is_grey).count(), visibility)
    };
    let (none, unblurred) = grey("step=0");
    assert_eq!((none, differing(&hard, &unblurred)), (0, 0));
    let [one, two, four] = ["step=1", "step=2", "step=4"].map(|step| grey(step).0);
    assert!(one > 500 && two > one && four > two, "{one} {two} {four}");
}

#[test]
fn a_larger_map_has_smaller_stairs() {
    let fine = bench(&["map_size=4096"]).visibility();
    let away = |size: &str| differing(&fine, &bench(&[size]).visibility());
    let [a, b, c, d] = ["128", "256", "512", "1024"].map(|size| away(&format!("map_size={size}")));
    assert!(a > b && b > c && c > d && d > 0, "{a} {b} {c} {d}");
}
