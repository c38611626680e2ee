//! Soft shadows and their accumulation buffers: how far from the mean they are, and how far that is from the truth.

mod common;

use common::{Bench, Random};
use glam::{DVec3, dvec3};
use image::RgbImage;
use shadowlab::ground_truth::{Label, Ray, Rays, Truth};
use shadowlab::labs;
use shadowlab::labs::eecs487::jitter::jitter;

const SIZE: [u32; 2] = [160, 160];
const FORMATS: [&str; 6] = ["RGB32F", "RGBA32F", "RGB16F", "RGBA16F", "RGB8", "RGBA8"];

fn bench(settings: &[&str]) -> Bench {
    Bench::new("eecs487", SIZE, settings)
}

/// `soft_shadows=on` and these settings.
fn soft(n: usize, amount: f64, others: &[&str]) -> Vec<String> {
    let own = [
        "soft_shadows=on".to_owned(),
        format!("num_jitters={n}"),
        format!("jitter_amount={amount}"),
    ];
    own.into_iter()
        .chain(others.iter().map(|s| (*s).to_owned()))
        .collect()
}

fn set(bench: &mut Bench, settings: &[String]) {
    let settings: Vec<_> = settings.iter().map(String::as_str).collect();
    bench.set(&settings);
}

/// The largest difference of any channel, in levels.
fn largest(a: &RgbImage, b: &RgbImage) -> u8 {
    let pairs = a.as_raw().iter().zip(b.as_raw());
    pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// The same without the pixels whose centres lie on the seam of two walls: the shadows of either wall are as near there.
fn largest_beside_seams(a: &RgbImage, b: &RgbImage) -> u8 {
    let mut without = b.clone();
    for (x, y, pixel) in a.enumerate_pixels() {
        if x == y || x + y + 1 == SIZE[0] {
            without.put_pixel(x, y, *pixel);
        }
    }
    largest(a, &without)
}

fn column(picture: &RgbImage) -> Vec<u8> {
    (0..picture.height())
        .map(|y| picture.get_pixel(0, y).0[0])
        .collect()
}

fn ramp(accumulator: &str, accumulation: &str) -> Vec<u8> {
    let settings = [
        "scene=ramp".to_owned(),
        format!("accumulator={accumulator}"),
        format!("accumulation={accumulation}"),
    ];
    let mut bench = Bench::new("eecs487", [8, 256], &[]);
    set(&mut bench, &settings);
    column(&bench.picture())
}

// ---- 5. Banding ----

/// "Pixels with red component 240-255 will all be mapped to the final color 240", and so on down in 16 bands.
#[test]
fn eight_bits_with_sign_leave_sixteen_bands() {
    for (level, found) in (0..=255).rev().zip(ramp("S8", "weighted")) {
        assert_eq!(found, level / 16 * 16, "{level}");
    }
    // The control: 32 bits lose nothing.
    assert!((0..=255).rev().eq(ramp("RGBA32F", "weighted")));
}

/// "Adding up the individual renders will cause overflow into the negative numbers": Fig. 2(b).
#[test]
fn adding_up_first_overflows_into_the_negative() {
    let ramp = ramp("S8", "sum_then_divide");
    for (level, found) in (0..=255_i32).rev().zip(&ramp) {
        // Eight times the upper seven bits, wrapped.
        let sum = (8 * (level / 2) + 128).rem_euclid(256) - 128;
        let expected = if sum < 0 { 0 } else { sum / 8 * 2 };
        assert_eq!(i32::from(*found), expected, "{level}");
    }
    assert!(ramp.iter().all(|level| *level <= 30), "mostly in the dark");
    assert!(ramp.iter().filter(|level| **level == 0).count() > 128);
}

#[test]
fn what_each_format_makes_of_the_ramp() {
    for accumulation in ["weighted", "sum_then_divide"] {
        for (format, most) in [
            ("RGB32F", 0),
            ("RGBA32F", 0),
            ("RGB16F", 1),
            ("RGBA16F", 1),
            ("RGB8", 4),
            ("RGBA8", 4),
        ] {
            let ramp = ramp(format, accumulation);
            let off = ramp
                .iter()
                .zip((0..=255_u8).rev())
                .map(|(a, b)| a.abs_diff(b));
            let off = off.max().unwrap();
            let mut values = ramp.clone();
            values.dedup();
            println!(
                "{format} {accumulation}: {} values, off by at most {off} levels",
                values.len()
            );
            if accumulation == "weighted" || !format.ends_with('8') {
                assert!(off <= most, "{format} {accumulation}: {off}");
            } else {
                // Eight bits without sign saturate at 1, an eighth of what is asked for.
                assert!(ramp.iter().all(|level| *level <= 32), "{format}");
            }
        }
    }
}

/// Renders that are all the same give back that one, whatever their number.
#[test]
fn equal_renders_give_back_the_picture() {
    let mut bench = Bench::new("eecs487", [48, 48], &[]);
    // Into a framebuffer object: Mesa turns a window upside down, and rounds otherwise.
    set(&mut bench, &soft(1, 0.0, &[]));
    let single = bench.picture();
    let off = |bench: &mut Bench, n: usize, format: &str, way: &str| {
        let accumulation = [
            format!("accumulator={format}"),
            format!("accumulation={way}"),
        ];
        set(bench, &soft(n, 0.0, &[]));
        set(bench, &accumulation);
        largest(&single, &bench.picture())
    };
    for n in (1..=33).chain([50, 63, 64, 65, 100, 127, 128, 129, 200, 255, 256]) {
        for format in ["RGB32F", "RGBA32F"] {
            assert_eq!(off(&mut bench, n, format, "weighted"), 0, "{n} {format}");
        }
    }
    for format in FORMATS.iter().chain(&["S8"]) {
        let found = [1, 2, 4, 8, 16, 64, 256].map(|n| off(&mut bench, n, format, "weighted"));
        println!("{format}: off by {found:?} levels for n = 1, 2, 4, 8, 16, 64, 256");
        assert!(
            format.contains("32F") || found[6] > 0,
            "the control: {format}"
        );
    }
}

// ---- 3. Soft shadows ----

/// The renders of each light on its own, in f64, and which pixels the sphere around the light touches in any of them.
struct Mean {
    /// The sum after each render.
    sums: Vec<Vec<f64>>,
    sphere: Vec<bool>,
}

fn renders(kind: &str, amount: f64, most: usize) -> Mean {
    let handout = labs::find("eecs487").unwrap();
    let mut bench = bench(&[]);
    let mut mean = Mean {
        sums: Vec::new(),
        sphere: vec![false; 3 * (SIZE[0] * SIZE[1]) as usize],
    };
    for index in 0..most {
        let mut scene = (handout.scene)().unwrap();
        scene.lights[0].position += amount * jitter(kind, index);
        bench.lab = (handout.start)(&bench.context.gl, scene, None).unwrap();
        bench.lab.resize(SIZE);
        set(&mut bench, &soft(1, 0.0, &[]));
        let picture = bench.picture();
        for (i, pixel) in picture.pixels().enumerate() {
            let light = pixel.0 == [255, 255, 204];
            (0..3).for_each(|c| mean.sphere[3 * i + c] |= light);
        }
        let before = mean.sums.last();
        let add = |(i, value): (usize, &u8)| before.map_or(0.0, |sum| sum[i]) + f64::from(*value);
        let sum = picture.as_raw().iter().enumerate().map(add).collect();
        mean.sums.push(sum);
    }
    mean
}

impl Mean {
    /// The largest distance of a picture of `n` renders from their mean, in levels.
    fn largest_error(&self, n: usize, picture: &RgbImage) -> f64 {
        let sums = self.sums[n - 1].iter().zip(picture.as_raw());
        let errors = sums.map(|(sum, found)| (sum / n as f64 - f64::from(*found)).abs());
        let outside = errors.zip(&self.sphere).filter(|(_, sphere)| !**sphere);
        outside.map(|(error, _)| error).fold(0.0, f64::max)
    }
}

/// Against the f64 mean of the same renders: what the accumulation buffer alone loses.
#[test]
fn the_accumulators_error_is_known() {
    for amount in [0.009, 0.1] {
        let mean = renders("random", amount, 64);
        let mut bench = bench(&[]);
        for format in FORMATS.iter().chain(&["S8"]) {
            let setting = format!("accumulator={format}");
            let counts = [1, 2, 4, 8, 16, 32, 64];
            let errors = counts.map(|n| {
                set(&mut bench, &soft(n, amount, &[&setting]));
                mean.largest_error(n, &bench.picture())
            });
            println!("jitter {amount}, {format}: {errors:.2?} levels for n = {counts:?}");
            for (n, error) in counts.into_iter().zip(errors) {
                // Half a level is what 8 bits cost in the end. RGB16F has 11 bits, and rounds n times.
                let bound = match *format {
                    "RGB32F" | "RGBA32F" => 0.51,
                    "RGB16F" | "RGBA16F" => 1.0 + n as f64 / 12.0,
                    "RGB8" | "RGBA8" => 1.0 + n as f64 / 2.0,
                    _ => 2.0 + 2.0 * n as f64,
                };
                assert!(error <= bound, "{format} {n}: {error}");
            }
            if *format == "S8" {
                assert!(errors[4] > 8.0, "the control: {errors:?}");
            }
        }
    }
}

/// Places on the walls, and the share of the light's cube that each sees.
struct Penumbrae {
    pixels: Vec<(usize, f64)>,
}

/// Points in the cube that no jitter has: a grid of cells, one point in each.
fn filled_cube(side: usize) -> impl Iterator<Item = DVec3> {
    let at = move |i: usize| (i as f64 + 0.5) / side as f64 * 2.0 - 1.0;
    (0..side * side * side)
        .map(move |i| dvec3(at(i % side), at(i / side % side), at(i / side / side)))
}

fn visible_share(rays: &Rays, truth: &Truth, pixel: usize, lights: &[DVec3]) -> f64 {
    let (triangle, point) = truth.seen[pixel].unwrap();
    let seen = |light: &&DVec3| {
        let light = rays.source.position + **light;
        !rays.is_blocked(&Ray::new(light, point - light), triangle)
    };
    lights.iter().filter(seen).count() as f64 / lights.len() as f64
}

impl Penumbrae {
    fn new(rays: &Rays, truth: &Truth, amount: f64) -> Self {
        let corners: Vec<_> = filled_cube(3).map(|p| 1.5 * amount * p).collect();
        let cube: Vec<_> = filled_cube(12).map(|p| amount * p).collect();
        let valid = (0..truth.labels.len()).filter(|i| truth.labels[*i] != Label::NotValid);
        let pixels = valid.map(|pixel| {
            let share = visible_share(rays, truth, pixel, &corners);
            let certain = share == 0.0 || share == 1.0;
            let share = if certain {
                share
            } else {
                visible_share(rays, truth, pixel, &cube)
            };
            (pixel, share)
        });
        Self {
            pixels: pixels.collect(),
        }
    }

    /// Root mean square of the error of a visibility, in 0…1.
    fn error(&self, visibility: impl Fn(usize) -> f64 + Sync) -> f64 {
        let error = |(pixel, share): &(usize, f64)| (visibility(*pixel) - share).powi(2);
        (self.pixels.iter().map(error).sum::<f64>() / self.pixels.len() as f64).sqrt()
    }
}

/// Against the integral over the light: more lights are better, evenly spread ones need fewer.
#[test]
fn soft_shadows_approach_the_lights_integral() {
    let amount = 0.1;
    let mut bench = bench(&["soft_method=fast", "stencil_clipping=on"]);
    let rays = Rays::new(&bench.lab.now(), 0);
    let truth = rays.truth(SIZE);
    let penumbrae = Penumbrae::new(&rays, &truth, amount);
    let counts = [1, 2, 4, 8, 16, 32, 64, 128, 256];
    let mut errors = |kind: &str| {
        counts.map(|n| {
            set(&mut bench, &soft(n, amount, &[&format!("jitter={kind}")]));
            let visibility = bench.visibility();
            penumbrae.error(|pixel| f64::from(visibility.as_raw()[pixel]) / 255.0)
        })
    };
    let (random, even) = (errors("random"), errors("low-discrepancy"));
    println!("n: {counts:?}\nrandom: {random:.4?}\nlow-discrepancy: {even:.4?}");
    assert!(random[8] < random[0] / 8.0, "{random:?}");
    assert!(even[6] < even[0] / 8.0, "{even:?}");

    // What 256 random lights have in the mean, one draw of them apart from the next.
    let draws = (1..=6).map(|draw| {
        let lights: Vec<_> = (0..256)
            .map(|i| amount * jitter("random", 256 * draw + i))
            .collect();
        penumbrae.error(|pixel| visible_share(&rays, &truth, pixel, &lights))
    });
    let chance = (draws.map(|error| error * error).sum::<f64>() / 6.0).sqrt();
    println!("256 random lights in the mean: {chance:.4}");
    assert!(even[6] <= chance, "{} {chance}", even[6]);
    assert!(random[6] > chance, "the control: 64 random ones");
}

// ---- The fast method ----

/// The same picture within one level, for a jitter of up to 0.1.
#[test]
fn the_fast_method_draws_the_same() {
    let compare = |n: usize, amount: f64, others: &[&str]| {
        let mut bench = bench(&[]);
        set(&mut bench, &soft(n, amount, others));
        let handout = bench.picture();
        let visibility = in_rgb(&mut bench);
        bench.set(&["soft_method=fast"]);
        let fast = bench.picture();
        let masks = largest_beside_seams(&visibility, &in_rgb(&mut bench));
        assert!(
            masks <= 1,
            "{n} {amount} {others:?}: {masks} levels of visibility"
        );
        let levels = largest_beside_seams(&handout, &fast);
        println!("n {n}, jitter {amount}, {others:?}: {levels} levels");
        levels
    };
    for clipping in ["stencil_clipping=on", "stencil_clipping=off"] {
        for (n, amount) in [
            (1, 0.1),
            (2, 0.009),
            (7, 0.05),
            (32, 0.1),
            (33, 0.1),
            (64, 0.009),
            (64, 0.1),
        ] {
            assert!(compare(n, amount, &[clipping]) <= 1, "{n} {amount}");
        }
        for shown in ["floor", "left", "rear"] {
            let shown = format!("clipped_to={shown}");
            assert!(
                compare(16, 0.1, &[clipping, &shown]) <= 1,
                "{clipping} {shown}"
            );
        }
    }
    assert!(compare(16, 0.1, &["tessellation=4", "jitter=low-discrepancy"]) <= 1);
    for amount in [0.2, 0.4] {
        compare(16, amount, &[]);
    }

    // Lights that nobody chose: near walls, beside and within the casters.
    let mut random = Random(7);
    for round in 0..12 {
        let key = |keys: &str, most: u32, random: &mut Random| {
            let at = random.below(keys.len() as u32) as usize;
            keys[at..=at].repeat(random.below(most) as usize)
        };
        let keys = [
            key("hl", 40, &mut random),
            key("jk", 60, &mut random),
            key("ws", 40, &mut random),
            key("r", 70, &mut random),
            key("c", 2, &mut random),
            key("xX", 4, &mut random),
            key("WS", 4, &mut random),
        ]
        .concat();
        let amount = [0.009, 0.03, 0.1][round % 3];
        let mut bench = bench(&[]);
        set(&mut bench, &soft(16, amount, &[]));
        bench.press(&keys);
        let handout = bench.picture();
        bench.set(&["soft_method=fast"]);
        let levels = largest_beside_seams(&handout, &bench.picture());
        println!("{keys}, jitter {amount}: {levels} levels");
        assert!(levels <= 1, "{keys} {amount}: {levels} levels");
    }

    // What an earlier state left is gone when light, jitter or casters have changed.
    let settings = ["soft_method=fast", "soft_shadows=on", "jitter_amount=0.02"];
    let mut kept = bench(&settings);
    kept.picture();
    for change in ["h", "r", "a", "c", "x", "t", "tt", "TTT"] {
        kept.press(change);
        let fast = kept.picture();
        kept.set(&["soft_method=handout"]);
        let levels = largest_beside_seams(&kept.picture(), &fast);
        assert!(levels <= 1, "{change}: {levels} levels");
        kept.set(&["soft_method=fast"]);
    }

    // The control: another jitter is another picture.
    let mut bench = bench(&[]);
    set(&mut bench, &soft(16, 0.1, &["soft_method=fast"]));
    let fast = bench.picture();
    bench.set(&["soft_method=handout", "jitter_amount=0.09"]);
    assert!(largest_beside_seams(&fast, &bench.picture()) > 10);
}

fn in_rgb(bench: &mut Bench) -> RgbImage {
    image::DynamicImage::from(bench.visibility()).into_rgb8()
}
