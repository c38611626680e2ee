//! What the handout promises, held against the lab's pictures.

mod common;

use common::{Bench, differing, work_folder};
use glam::{DMat4, DVec3, dvec3};
use image::{GrayImage, RgbImage};
use shadowlab::ground_truth::Rays;
use shadowlab::labs::{self, Key};
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::{Light, LightKind, Scene, Spin, camera};

const SIZE: [u32; 2] = [320, 320];
const FILTERS: [(&str, u32); 3] = [("filter=none", 1), ("filter=pcf_5", 5), ("filter=pcf_9", 9)];
const SCENES: [&str; 3] = ["scene=example", "scene=pirate", "scene=knossos"];

fn example() -> Scene {
    (labs::find("aueb7").unwrap().scene)().unwrap()
}

fn bench(settings: &[&str]) -> Bench {
    Bench::new("aueb7", SIZE, settings)
}

fn with_scene(scene: Scene, settings: &[&str]) -> Bench {
    Bench::with_scene("aueb7", scene, SIZE, settings)
}

fn pressed(settings: &[&str], keys: &str) -> Bench {
    let mut bench = bench(settings);
    bench.press(keys);
    bench
}

fn dark(visibility: &GrayImage) -> usize {
    visibility.pixels().filter(|pixel| pixel.0[0] < 128).count()
}

/// The lab's own test against the truth.
fn figures(settings: &[&str]) -> Figures {
    let mut bench = bench(settings);
    let visibility = bench.visibility();
    let rays = Rays::new(&bench.lab.now(), 0);
    let truth = rays.truth(SIZE);
    let map = bench.map_scale();
    Measure::new(&rays, &truth)
        .measure(&visibility, map.as_ref())
        .0
}

// ---- The shadow test -------------------------------------------------------------------------------------------------

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
    for (filter, _) in FILTERS {
        for outside in ["outside=dark", "outside=lit"] {
            let settings = [filter, outside];
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
    truth: shadowlab::ground_truth::Truth,
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

// ---- What was measured of the course's program -----------------------------------------------------------------------

fn window(settings: &[&str]) -> Bench {
    Bench::new("aueb7", [500, 500], settings)
}

#[test]
fn the_colors_are_those_of_the_course() {
    let picture = window(&[]).picture();
    assert_eq!(picture.get_pixel(0, 0).0, [8, 51, 56], "clear");
    // The far plane, outside of the map; and the middle of a shadow.
    assert_eq!(picture.get_pixel(250, 140).0, [3, 15, 22]);
    assert_eq!(picture.get_pixel(60, 350).0, [3, 15, 22]);
    let below_the_spheres = image::imageops::crop_imm(&picture, 0, 300, 500, 200).to_image();
    let brightest = below_the_spheres
        .pixels()
        .max_by_key(|pixel| pixel.0.map(u32::from).iter().sum::<u32>());
    assert_eq!(brightest.unwrap().0, [116, 80, 41]);
}

#[test]
fn the_edge_of_the_map_is_a_slanted_line_across_the_plane() {
    let visibility = window(&["map_size=1024"]).visibility();
    // The first lit row of a column.
    let edge = |x| {
        (120..500)
            .find(|y| visibility.get_pixel(x, *y).0[0] == 255)
            .unwrap()
    };
    let [left, right] = [10, 430].map(edge);
    assert!(left > 200 && right > left + 20, "{left} {right}");
    for x in [100, 200, 270] {
        let between = f64::from(left) + f64::from(right - left) * f64::from(x - 10) / 420.0;
        assert!((f64::from(edge(x)) - between).abs() < 1.5, "at {x}");
    }
    // The control: lit outside, and there is no line.
    let lit = window(&["map_size=1024", "outside=lit"]).visibility();
    assert_eq!(lit.get_pixel(250, 130).0[0], 255);
    assert_eq!(visibility.get_pixel(250, 130).0[0], 0);
}

/// At 128 the spheres wear rings of acne; the plane has none with the bias at any size, and is full of it without.
#[test]
fn acne_is_where_the_course_has_it() {
    let plane = || {
        let mut scene = example();
        scene.objects.retain(|object| object.name == "plane");
        scene
    };
    let spheres = || {
        let mut scene = example();
        scene.objects.retain(|object| object.name != "plane");
        scene
    };
    let false_shadow = |scene: Scene, settings: &[&str]| {
        let mut bench = with_scene(scene, settings);
        let visibility = bench.visibility();
        let rays = Rays::new(&bench.lab.now(), 0);
        let truth = rays.truth(SIZE);
        let map = bench.map_scale();
        let figures = Measure::new(&rays, &truth)
            .measure(&visibility, map.as_ref())
            .0;
        figures.false_shadow.interior
    };
    for size in [
        "map_size=128",
        "map_size=256",
        "map_size=512",
        "map_size=1024",
    ] {
        assert_eq!(false_shadow(plane(), &[size]), 0, "{size}");
        assert!(false_shadow(plane(), &[size, "constant_depth_bias=0"]) > 10_000);
    }
    assert!(false_shadow(spheres(), &["map_size=128"]) > 100);
    assert!(false_shadow(spheres(), &["map_size=1024"]) < 20);
}

/// Pixels that differ from the hard test at 1024. The course's program has 859, 402 and 135 of them at 128, 256 and 512;
/// the spheres here are cut in other triangles and wear other pictures.
#[test]
fn maps_differ_from_the_finest_about_as_much_as_in_the_course() {
    let finest = window(&["map_size=1024"]).picture();
    for (size, course) in [("128", 859), ("256", 402), ("512", 135)] {
        let picture = window(&[&format!("map_size={size}")]).picture();
        let pairs = finest.pixels().zip(picture.pixels());
        // A rounding apart is no difference.
        let differ = |(a, b): &(&image::Rgb<u8>, &image::Rgb<u8>)| {
            a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 1)
        };
        let found = pairs.filter(differ).count();
        let share = found as f64 / f64::from(course);
        assert!(
            (0.85..1.15).contains(&share),
            "{size}: {found}, not {course}"
        );
    }
}

// ---- Settings and edges ----------------------------------------------------------------------------------------------

/// A plane that looks at the light and is as large as the map: its edges are the map's.
fn facing_the_light(scale: f64) -> Scene {
    let mut scene = example();
    scene.objects.retain(|object| object.name == "plane");
    // Seen from above by the light, and from beside it by the eye.
    scene.lights[0].position = dvec3(0.0, 10.0, 0.0);
    scene.lights[0].direction = dvec3(0.0, -1.0, 0.0);
    scene.objects[0].placement =
        shadowlab::scene::rotate(-90.0, DVec3::X) * DMat4::from_scale(dvec3(scale, scale, 1.0));
    scene.camera.eye = dvec3(0.0, 60.0, 1.0);
    scene.camera.look = dvec3(0.0, -60.0, -1.0);
    scene
}

#[test]
fn outside_of_the_map_is_dark_or_lit_and_its_border_belongs_to_it() {
    // From 10 above, 90 degrees reach 10 to each side.
    let dark_share = |scale: f64, settings: &[&str]| {
        let visibility = with_scene(facing_the_light(scale), settings).visibility();
        let off = with_scene(facing_the_light(scale), &["shadows=off"]).visibility();
        assert_eq!(dark(&off), 0);
        dark(&visibility)
    };
    assert_eq!(dark_share(9.99, &[]), 0);
    assert!(dark_share(12.0, &[]) > 1000);
    assert_eq!(dark_share(12.0, &["outside=lit"]), 0);

    let in_shadow = |point: DVec3, settings: &[&str]| {
        let mut scene = facing_the_light(12.0);
        // Along the axes nothing is rounded on the way.
        scene.camera.eye = dvec3(0.0, 0.0, 16.0);
        scene.camera.look = DVec3::NEG_Z;
        let mut bench = with_scene(scene, settings);
        let probe = labs::Probe::Point(point);
        let explanation = bench.lab.explain(&bench.context.gl, probe, 1).unwrap();
        let uv = explanation
            .steps
            .iter()
            .find(|step| step.name == "position_lcs");
        let [u, v, ..] = uv.unwrap().gpu[..] else {
            panic!("two coordinates")
        };
        ([u, v], explanation.in_shadow.unwrap())
    };
    let (uv, shadowed) = in_shadow(dvec3(10.0, 0.0, 0.0), &[]);
    assert!(
        uv[0] == 0.0 || uv[0] == 1.0,
        "exactly on the border: {uv:?}"
    );
    assert!(!shadowed);
    let (uv, shadowed) = in_shadow(dvec3(10.0, 0.0, 10.0), &[]);
    assert!(
        uv.iter().all(|c| *c == 0.0 || *c == 1.0),
        "in a corner: {uv:?}"
    );
    assert!(!shadowed);
    assert!(in_shadow(dvec3(10.001, 0.0, 0.0), &[]).1);
    assert!(!in_shadow(dvec3(10.001, 0.0, 0.0), &["outside=lit"]).1);
    // Behind the light there is no second beam; nor is there light beyond the far plane.
    for beyond in [dvec3(0.5, 20.0, 0.5), dvec3(0.0, -95.0, 0.0)] {
        assert!(in_shadow(beyond, &[]).1, "{beyond}");
        assert!(!in_shadow(beyond, &["outside=lit"]).1, "{beyond}");
    }
}

/// Across the border, each sample that is outside counts as outside.
#[test]
fn pcf_fades_towards_what_is_outside() {
    let visibility = with_scene(facing_the_light(12.0), &["filter=pcf_9", "map_size=32"]);
    let grades = |mut bench: Bench| {
        let mut found = bench.visibility().into_raw();
        found.sort_unstable();
        found.dedup();
        found
    };
    // Outside; one row of three samples, or a corner's one, inside; and so on.
    let found = grades(visibility);
    assert!(found.len() > 3, "{found:?}");
    assert!([0, 85, 170, 255].iter().all(|grade| found.contains(grade)));
    let lit = with_scene(
        facing_the_light(12.0),
        &["filter=pcf_9", "map_size=32", "outside=lit"],
    );
    assert_eq!(grades(lit), [255]);
}

#[test]
fn every_setting_is_read() {
    let changes = |base: &[&str], setting: &str| {
        let before = bench(base).picture();
        differing(&before, &bench(&[base, &[setting]].concat()).picture()) > 0
    };
    for (base, setting) in [
        (&[][..], "scene=pirate"),
        (&[], "scene=knossos"),
        (&[], "filter=pcf_5"),
        (&["filter=pcf_5"], "filter=pcf_9"),
        (&["filter=pcf_5"], "step=1"),
        (&[], "map_size=256"),
        (&[], "constant_depth_bias=0"),
        (&[], "outside=lit"),
        (&[], "shadows=off"),
    ] {
        assert!(changes(base, setting), "{setting}");
    }
    // The control: what has no say in the hard test.
    assert!(!changes(&[], "step=1"));

    let mut spinning = example();
    spinning.objects[1].spin = Some(Spin {
        axis: DVec3::X,
        degrees_per_second: 90.0,
    });
    let mut still = with_scene(spinning, &["rotation=off"]);
    let before = still.picture();
    still.lab.advance(1.0);
    assert!(!still.lab.moves());
    assert_eq!(differing(&before, &still.picture()), 0, "rotation=off");
    still.set(&["rotation=on"]);
    assert!(still.lab.moves());
    assert!(differing(&before, &still.picture()) > 0, "rotation=on");
}

#[test]
fn shadows_are_right_but_for_their_edges() {
    for scene in SCENES {
        let found = figures(&[scene, "map_size=4096"]);
        assert!(
            found.lit > 10_000 && found.shadowed > 500,
            "{scene}: {found}"
        );
        let wrong = found.false_shadow.interior + found.false_light.interior;
        assert!(wrong * 100 < found.lit + found.shadowed, "{scene}: {found}");
        // The controls: no shadows, no bias.
        let lit_by_mistake = figures(&[scene, "shadows=off"]).false_light;
        assert_eq!(
            lit_by_mistake.total() + lit_by_mistake.ambiguous,
            found.shadowed
        );
        let acne = figures(&[scene, "map_size=4096", "constant_depth_bias=0"]);
        assert!(acne.false_shadow.interior > 10 * found.false_shadow.interior.max(100));
    }
}

/// The white sphere at the light is in the picture alone.
#[test]
fn the_marker_at_the_light_is_neither_shadowed_nor_measured() {
    // From above, it stands before the dark part of the plane.
    let mut bench = pressed(&[], &"r".repeat(30));
    let picture = bench.picture();
    let white = picture
        .enumerate_pixels()
        .filter(|(_, _, pixel)| pixel.0 == [255; 3]);
    let white: Vec<(u32, u32)> = white.map(|(x, y, _)| (x, y)).collect();
    assert!((3..40).contains(&white.len()), "{}", white.len());
    let visibility = bench.visibility();
    for (x, y) in white {
        assert_eq!(visibility.get_pixel(x, y).0[0], 0, "at {x},{y}");
    }
    assert_eq!(bench.lab.now().objects.len(), 3);
}

/// The test is a file of its own: a student may write that one alone.
#[test]
fn a_students_own_shadow_test_takes_the_place_of_the_handouts() {
    let own = include_str!("../glsl/aueb7/is_point_in_shadow.frag");
    let with_test = |text: &str, settings: &[&str]| {
        let folder = work_folder("aueb7_glsl");
        std::fs::write(folder.join("is_point_in_shadow.frag"), text).unwrap();
        let mut bench = Bench::with_glsl("aueb7", &folder, SIZE);
        bench.set(settings);
        [bench.visibility().into_raw(), bench.picture().into_raw()]
    };
    let hard = ["filter=none"];
    let mut bench = bench(&hard);
    let handouts = [bench.visibility().into_raw(), bench.picture().into_raw()];
    assert_eq!(with_test(own, &hard), handouts);
    let other_way_round = own.replace("shadow_map_z <", "shadow_map_z >");
    assert_ne!(other_way_round, own);
    let wrong = with_test(&other_way_round, &hard);
    assert!(wrong[0] != handouts[0] && wrong[1] != handouts[1]);

    // What is wrong in it is told with its name and line.
    let folder = work_folder("aueb7_glsl_wrong");
    let path = folder.join("is_point_in_shadow.frag");
    std::fs::write(&path, own.replace("return 1.0;", "return 1.0 1.0;")).unwrap();
    let start = labs::find("aueb7").unwrap().start;
    let started = start(&bench.context.gl, example(), Some(&folder));
    let told = started.err().unwrap().to_string();
    let line = 1 + own
        .lines()
        .position(|line| line.contains("return 1.0;"))
        .unwrap();
    let place = format!("is_point_in_shadow.frag:{line}: does not compile");
    assert!(told.contains(&place), "{told}");
    // A file without one of the functions does not link.
    std::fs::write(&path, own.replace("pcf_9(", "pcf_8(")).unwrap();
    let started = start(&bench.context.gl, example(), Some(&folder));
    let told = started.err().unwrap().to_string();
    assert!(
        told.contains("does not link") && told.contains("pcf_9"),
        "{told}"
    );
}

// ---- Keys, mouse and time --------------------------------------------------------------------------------------------

#[test]
fn every_key_of_the_list_changes_the_picture() {
    let handout = labs::find("aueb7").unwrap();
    let listed = handout.keys.iter().flat_map(|(keys, _)| keys.split(' '));
    let mut count = 0;
    for key in listed {
        let mut bench = bench(&[]);
        let before = bench.picture();
        bench.press(key);
        // The light's turn takes time.
        bench.lab.advance(1.0);
        assert!(differing(&before, &bench.picture()) > 100, "{key}");
        count += 1;
    }
    assert_eq!(count, 16);
    assert!(
        !bench(&[]).lab.key(Key::Char('z')),
        "the control: a key of no meaning"
    );
}

#[test]
fn the_keys_move_the_eye_and_not_its_target() {
    let eye = dvec3(0.0, 30.0, 80.0);
    for (key, to) in [
        ("w", dvec3(0.0, 0.0, -1.0)),
        ("s", dvec3(0.0, 0.0, 1.0)),
        ("a", dvec3(-1.0, 0.0, 0.0)),
        ("d", dvec3(1.0, 0.0, 0.0)),
        ("r", dvec3(0.0, 1.0, 0.0)),
        ("f", dvec3(0.0, -1.0, 0.0)),
    ] {
        let camera = pressed(&[], key).lab.now().camera;
        assert_eq!(camera.eye, eye + to, "{key}");
        assert_eq!(camera.eye + camera.look, DVec3::ZERO, "{key}");
    }
}

#[test]
fn the_eye_never_stands_in_its_target_or_above_it() {
    // Over the light's side of the world, down to its floor, and to the target.
    for keys in [
        "w".repeat(200),
        "w".repeat(80),
        "f".repeat(30) + &"w".repeat(300),
    ] {
        let mut bench = pressed(&[], &keys);
        let camera = bench.lab.now().camera;
        assert!(camera.look.normalize().cross(DVec3::Y).length() > 1e-3);
        assert!(camera.view().is_finite());
        bench.picture();
    }
    let there = pressed(&[], &"w".repeat(80)).lab.now().camera.eye;
    assert_eq!(there, dvec3(0.0, 30.0, 1.0), "the last step is not taken");
}

/// World translation: objects, light and target go together, and the shadows with them.
#[test]
fn the_light_follows_the_worlds_translation() {
    let before = bench(&[]).lab.now();
    for (key, to) in [
        ("<Up>", dvec3(0.0, 0.0, -1.0)),
        ("<Down>", dvec3(0.0, 0.0, 1.0)),
        ("<Left>", dvec3(-1.0, 0.0, 0.0)),
        ("<Right>", dvec3(1.0, 0.0, 0.0)),
        ("<PageUp>", dvec3(0.0, 1.0, 0.0)),
        ("<PageDown>", dvec3(0.0, -1.0, 0.0)),
    ] {
        let after = pressed(&[], key).lab.now();
        assert_eq!(after.camera.eye, before.camera.eye, "{key}");
        let (light, old) = (&after.lights[0], &before.lights[0]);
        assert_eq!(light.position, old.position + to, "{key}");
        assert_eq!(light.direction, old.direction, "the target goes too: {key}");
        for (object, old) in after.objects.iter().zip(&before.objects) {
            assert_eq!(
                object.placement,
                DMat4::from_translation(to) * old.placement
            );
        }
    }
    // The same movement of the eye: the same picture, the shadows at the same place of the floor.
    let moved = pressed(&[], "<Right><Right><Up>").visibility();
    let mut scene = example();
    scene.camera.eye -= dvec3(2.0, 0.0, -1.0);
    assert_eq!(differing(&moved, &with_scene(scene, &[]).visibility()), 0);
    assert!(
        differing(&moved, &bench(&[]).visibility()) > 1000,
        "the control"
    );
}

#[test]
fn a_right_drag_turns_the_world_under_a_light_that_stays() {
    let before = bench(&[]).lab.now();
    let after = pressed(&[], "<RightDrag:300,0>").lab.now();
    assert_eq!(after.lights[0].position, before.lights[0].position);
    let place = |scene: &Scene, object: usize| scene.objects[object].placement.w_axis.truncate();
    let turned = shadowlab::scene::rotate(30.0, DVec3::Y);
    let expected = turned.transform_point3(place(&before, 1));
    assert!(place(&after, 1).distance(expected) < 1e-12);
    let back = pressed(&[], "<RightDrag:300,40><RightDrag:-300,-40>").visibility();
    assert_eq!(differing(&back, &bench(&[]).visibility()), 0);
}

#[test]
fn a_left_drag_moves_the_target() {
    let camera = pressed(&[], "<Drag:50,-20>").lab.now().camera;
    let target = camera.eye + camera.look;
    assert!(target.distance(dvec3(5.0, 2.0, 0.0)) < 1e-12, "{target}");
}

#[test]
fn f1_draws_wireframe_then_points_then_filled_in_both_passes() {
    let mut bench = bench(&["map_size=512"]);
    let covered = |bench: &mut Bench| {
        let picture = bench.picture();
        let is_drawn = |pixel: &&image::Rgb<u8>| pixel.0 != [8, 51, 56];
        let map = bench.lab.shadow_texture(1).unwrap();
        let depths = shadowlab::gl::read_depths(&bench.context.gl, map.texture, [512; 2]).depths;
        [
            picture.pixels().filter(is_drawn).count(),
            depths.iter().filter(|depth| **depth < 1.0).count(),
        ]
    };
    let filled = covered(&mut bench);
    bench.press("<F1>");
    let wireframe = covered(&mut bench);
    bench.press("<F1>");
    let points = covered(&mut bench);
    bench.press("<F1>");
    assert_eq!(covered(&mut bench), filled);
    for what in [0, 1] {
        assert!(points[what] > 100, "{points:?}");
        assert!(
            wireframe[what] > 2 * points[what],
            "{wireframe:?} {points:?}"
        );
        assert!(
            filled[what] > 2 * wireframe[what],
            "{filled:?} {wireframe:?}"
        );
    }
}

#[test]
fn the_light_turns_with_time_however_that_is_cut() {
    let after = |cuts: u32| {
        let mut bench = pressed(&[], "l");
        for _ in 0..cuts {
            bench.lab.advance(4.0 / f64::from(cuts));
        }
        bench.lab.now().lights[0].position
    };
    // 0.4 degrees in each frame of 16 ms.
    let turned = shadowlab::scene::rotate(100.0, DVec3::Y).transform_point3(dvec3(5.0, 20.0, 0.0));
    for cuts in [1, 7, 250] {
        assert!(after(cuts).distance(turned) < 1e-9, "{cuts}");
    }
    let mut bench = bench(&["rotate_light=on"]);
    assert!(bench.lab.moves());
    bench.lab.advance(4.0);
    let light = bench.lab.now().lights[0].clone();
    assert!(light.position.distance(turned) < 1e-12);
    assert!(
        (light.position + light.direction).length() < 1e-12,
        "it looks at its target"
    );
    // The key again, and it is back at its place.
    bench.press("l");
    assert!(!bench.lab.moves());
    assert_eq!(bench.lab.now().lights[0].position, dvec3(5.0, 20.0, 0.0));
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let straight = bench(&["filter=pcf_9", "map_size=512"]).picture();
    let mut bench = bench(&["scene=knossos", "rotate_light=on"]);
    bench.lab.advance(3.0);
    bench.picture();
    bench.visibility();
    bench.press("<F1>ww<Up><RightDrag:9,5>");
    bench.picture();
    bench.set(&["scene=pirate"]);
    bench.picture();
    bench.press("<F1><F1>ss<Down><RightDrag:-9,-5>");
    bench.set(&["scene=example", "rotate_light=off"]);
    bench.set(&["filter=pcf_9", "map_size=512"]);
    assert_eq!(differing(&straight, &bench.picture()), 0);
}

// ---- Scenes ----------------------------------------------------------------------------------------------------------

#[test]
fn the_scenes_stand_where_the_course_has_them() {
    for (scene, eye, light) in [
        ("scene=example", [0.0, 30.0, 80.0], [5.0, 20.0, 0.0]),
        ("scene=pirate", [80.0, 60.0, 100.0], [30.0, 60.0, 0.0]),
        ("scene=knossos", [0.0, 100.0, 170.0], [60.0, 30.0, 0.0]),
    ] {
        let now = bench(&[scene]).lab.now();
        let [eye, position] = [eye, light].map(DVec3::from_array);
        assert_eq!((now.camera.eye, now.camera.look), (eye, -eye));
        assert_eq!(now.lights[0].position, position);
        assert_eq!(now.lights[0].direction, -position);
        assert_eq!([now.lights[0].near, now.lights[0].far], [1.0, 100.0]);
    }
    let now = bench(&["scene=pirate"]).lab.now();
    let corners = |name: &str| {
        let objects = now.objects.iter().filter(|object| object.name == name);
        let points = objects.flat_map(|object| {
            let positions = object.mesh.positions.iter();
            positions.map(|p| object.placement.transform_point3(*p))
        });
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(p), high.max(p))
        })
    };
    // The skeleton, its face towards the viewer, stands behind the chest.
    let (low, high) = corners("skull");
    let middle = (low + high) / 2.0;
    assert!((middle - dvec3(0.0, 9.0, -18.0)).length() < 1.5, "{middle}");
    let (low, high) = corners("chest");
    assert!(
        low.y > 1.9 && high.y < 7.0 && low.z > -7.0 && high.z < 7.0,
        "{low} {high}"
    );
}

/// A floor, and a screen above it whose texture has a square of this alpha in its middle, from a scene file.
fn screen(alpha: u8) -> Scene {
    let folder = work_folder(&format!("aueb7_alpha_{alpha}"));
    let mut picture = image::RgbaImage::from_pixel(64, 64, image::Rgba([200, 200, 200, 255]));
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        if (16..48).contains(&x) && (16..48).contains(&y) {
            pixel.0[3] = alpha;
        }
    }
    picture.save(folder.join("screen.png")).unwrap();
    let scene = "\
        clear = [0.03, 0.2, 0.22]\nambient = [0.02, 0.1, 0.15]\n\
        [camera]\neye = [0, 30, 80]\ntarget = [0, 0, 0]\nfovy = 30\n\
        [light]\nposition = [5, 20, 0]\ncone = 90\nfar = 100\n\
        [[object]]\nmesh = \"plane\"\nscale = 100\n\
        rotate = { axis = [1, 0, 0], degrees = -90 }\ntranslate = [0, -10, 0]\n\
        [[object]]\nmesh = \"plane\"\nscale = 8\ntexture = \"screen.png\"\n\
        rotate = { axis = [1, 0, 0], degrees = -60 }\ntranslate = [0, 2, 0]\n";
    std::fs::write(folder.join("s.toml"), scene).unwrap();
    shadowlab::scene::file::load(&folder.join("s.toml"), false).unwrap()
}

#[test]
fn a_texture_with_alpha_has_holes_in_the_picture_and_none_in_the_shadow() {
    let settings = ["map_size=1024"];
    let drawn = |alpha: u8| {
        let mut bench = with_scene(screen(alpha), &settings);
        (bench.picture(), bench.visibility())
    };
    let (solid, covered) = drawn(255);
    let (holed, open) = drawn(0);
    // Through the middle of the screen the floor is seen. Beside it all is as before, its shadow too.
    let mut beside_the_hole = 0;
    for (x, y, pixel) in holed.enumerate_pixels() {
        if x.abs_diff(160) > 50 || y.abs_diff(150) > 40 {
            assert_eq!(solid.get_pixel(x, y), pixel, "at {x},{y}");
            beside_the_hole += 1;
        }
    }
    assert!(beside_the_hole > 70_000);
    assert!(differing(&solid, &holed) > 500);
    // The visibility is that of what shows through; the screen's shadow has no hole.
    assert!(differing(&covered, &open) > 100);
    assert!(dark(&open) >= dark(&covered));
    // However little is missing, the lighting discards; at the hole's edge the filter mixes the two alphas.
    let (nearly_opaque, _) = drawn(254);
    assert!(differing(&solid, &nearly_opaque) > 2000);
    assert!(differing(&holed, &nearly_opaque) < 300);
}

#[test]
fn a_mirrored_object_is_seen_from_outside() {
    let mirrored = |turned: bool| {
        let mut scene = example();
        let ball = &mut scene.objects[1];
        // A sphere is its own mirror image; its texture is white then, so that the two are alike.
        ball.material.texture = None;
        if turned {
            ball.placement *= DMat4::from_scale(dvec3(-1.0, 1.0, 1.0));
        }
        with_scene(scene, &["map_size=1024"])
    };
    let (right, mirror) = (mirrored(false).picture(), mirrored(true).picture());
    // Its triangles are cut along other diagonals.
    assert!(
        differing(&right, &mirror) < 300,
        "{}",
        differing(&right, &mirror)
    );
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_shadows() {
    let here = with_scene(example(), &["map_size=1024"]).visibility();
    for distance in [1e5, 1e6] {
        let offset = distance * dvec3(1.0, -2.0, 0.5);
        let there = with_scene(example().moved(offset), &["map_size=1024"]).visibility();
        let found = differing(&here, &there);
        assert!(found < 10, "moved by {offset}: {found}");
    }
    // The control: what an f32 world would do to the light, 1e6 from the origin.
    let mut scene = example();
    scene.lights[0].position += dvec3(1.0, 0.0, 0.0) / 16.0;
    let found = differing(&here, &with_scene(scene, &["map_size=1024"]).visibility());
    assert!(found > 100, "{found}");
}

#[test]
fn a_light_along_its_up_vector_works() {
    for direction in [-DVec3::Y, dvec3(1e-9, -3.0, 0.0)] {
        let mut scene = example();
        scene.lights[0].direction = direction;
        let dark = dark(&with_scene(scene, &["outside=lit"]).visibility());
        assert!((500..20_000).contains(&dark), "{direction}: {dark}");
    }
}

#[test]
fn another_kind_of_light_is_refused_with_the_lab_that_draws_it() {
    let refused = |lights: Vec<Light>| {
        let scene = Scene {
            lights,
            ..example()
        };
        let context = bench(&[]).context;
        let started = (labs::find("aueb7").unwrap().start)(&context.gl, scene, None);
        started.err().unwrap().to_string()
    };
    let light = |kind| Light {
        kind,
        ..example().lights[0]
    };
    let point = light(LightKind::Point { shadow_fov: 90.0 });
    assert!(refused(vec![point]).contains("cs541"));
    let area = [-1.0, 1.0, -1.0, 1.0];
    assert!(refused(vec![light(LightKind::Directional { area })]).contains("csci3260"));
    assert!(refused(vec![]).contains("0 lights"));
}

/// The map's angle is the cone that a scene asks for.
#[test]
fn a_scenes_own_cone_is_the_maps_angle() {
    let mut scene = facing_the_light(12.0);
    scene.lights[0].kind = LightKind::Spot {
        cone: 60.0,
        beam: shadowlab::scene::Beam::Circular,
    };
    let narrow = dark(&with_scene(scene.clone(), &[]).visibility());
    let wide = dark(&with_scene(facing_the_light(12.0), &[]).visibility());
    assert!(narrow > 2 * wide, "{narrow} {wide}");
    // What the map covers is square, and so is the beam of the truth.
    let now = with_scene(scene, &[]).lab.now();
    let LightKind::Spot { cone, beam } = now.lights[0].kind else {
        panic!("a spotlight")
    };
    assert_eq!((cone, beam), (60.0, shadowlab::scene::Beam::Rectangular));
}
