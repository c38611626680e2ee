//! What the slides promise, held against the lab's pictures.

mod common;

use common::{Bench, differing};
use glam::{DVec3, dvec3};
use image::{GrayImage, RgbImage};
use shadowlab::ground_truth::Rays;
use shadowlab::labs::{self, Key};
use shadowlab::measure::{Figures, Measure};
use shadowlab::picture::Projection;
use shadowlab::scene::{Light, LightKind, Scene, Spin};

const SIZE: [u32; 2] = [320, 240];
const STAGES: [&str; 6] = ["no_bias", "constant", "slope", "culling", "thick", "pcf"];

fn course() -> Scene {
    (labs::find("csci3260").unwrap().scene)().unwrap()
}

fn bench(settings: &[&str]) -> Bench {
    Bench::new("csci3260", SIZE, settings)
}

fn with_scene(scene: Scene, settings: &[&str]) -> Bench {
    Bench::with_scene("csci3260", scene, SIZE, settings)
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

/// The picture that the visibility foretells, between the one without light and the one without shadows, and how far
/// the three roundings to bytes may drive them apart.
fn differs_from_foretold(
    picture: &RgbImage,
    visibility: &GrayImage,
    unshadowed: &RgbImage,
    ambient: &RgbImage,
) -> usize {
    let differs = |x, y| {
        let share = 0.5 + 0.5 * f64::from(visibility.get_pixel(x, y).0[0]) / 255.0;
        (0..3).any(|c| {
            let at = |picture: &RgbImage| f64::from(picture.get_pixel(x, y).0[c]);
            let foretold = at(ambient) + share * (at(unshadowed) - at(ambient));
            // What is brighter than white is cut off, and foretells nothing.
            at(unshadowed) < 255.0 && (at(picture) - foretold).abs() > 1.5
        })
    };
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    pixels.filter(|(x, y)| differs(*x, *y)).count()
}

#[test]
fn visibility_is_the_shadow_test_of_the_shading() {
    let stages = STAGES.map(|stage| format!("stage={stage}"));
    let others = ["shadow_test=offset", "shadow_test=exact"].map(str::to_owned);
    for stage in stages.into_iter().chain(others) {
        let mut bench = with_scene(course(), &[&stage]);
        let visibility = bench.visibility();
        let picture = bench.picture();
        bench.set(&["shadows=off"]);
        let unshadowed = bench.picture();
        let mut dark_scene = course();
        dark_scene.lights[0].color = DVec3::ZERO;
        let ambient = with_scene(dark_scene, &[&stage]).picture();

        assert!(dark(&visibility) > 200, "{stage}");
        let wrong = differs_from_foretold(&picture, &visibility, &unshadowed, &ambient);
        assert_eq!(wrong, 0, "{stage}");

        // The control: shadows elsewhere, and the two no longer agree.
        let shifted = image::imageops::flip_horizontal(&visibility);
        assert!(differs_from_foretold(&picture, &shifted, &unshadowed, &ambient) > 100);
    }
}

#[test]
fn full_shadow_is_0_and_pcf_has_grades_between() {
    let grades = |stage: &str| {
        let visibility = bench(&["scene=room", stage]).visibility();
        let mut found: Vec<u8> = visibility.into_raw();
        found.sort_unstable();
        found.dedup();
        found
    };
    assert_eq!(grades("stage=constant"), [0, 255]);
    assert_eq!(grades("stage=pcf"), [0, 51, 102, 153, 204, 255]);
}

#[test]
fn half_of_the_lit_surfaces_are_dark_without_bias_and_each_remedy_removes_that() {
    let without = figures(&["scene=room", "stage=no_bias"]);
    let share = without.false_shadow.total() as f64 / without.lit as f64;
    assert!((0.48..0.52).contains(&share), "{share}");
    for stage in &STAGES[1..] {
        let found = figures(&["scene=room", &format!("stage={stage}")]);
        assert_eq!(found.false_shadow.interior, 0, "{stage}");
    }
}

#[test]
fn the_bias_is_told_in_world_units_and_texels() {
    let bias = figures(&["scene=room"]).bias.unwrap();
    // The box is 30 deep and 20 wide.
    assert!((bias.world - 0.15).abs() < 1e-12, "{bias:?}");
    assert!(
        (bias.texels - 0.15 / (20.0 / 1024.0)).abs() < 1e-9,
        "{bias:?}"
    );
    let map = bench(&[]).map_scale().unwrap();
    assert_eq!(map.projection, Projection::Orthographic);
}

#[test]
fn a_thin_wall_loses_the_beginning_of_its_shadow_and_a_thick_one_does_not() {
    let lost = |settings: &[&str]| {
        let settings = [&["scene=room", "map_size=4096"], settings].concat();
        figures(&settings).false_light.interior
    };
    let thin = lost(&["stage=constant"]);
    assert!(thin > 80, "{thin}");
    // Adding bias makes it worse.
    assert!(lost(&["stage=constant", "bias=0.02"]) > 2 * thin);
    assert!(lost(&["stage=thick"]) < thin / 4);
    assert!(lost(&["stage=culling"]) < thin / 4);
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_shadows() {
    let here = with_scene(course(), &[]).visibility();
    for distance in [1e5, 1e6] {
        let offset = distance * dvec3(1.0, -2.0, 0.5);
        let there = with_scene(course().moved(offset), &[]).visibility();
        assert_eq!(differing(&here, &there), 0, "moved by {offset}");
    }
    // The control: what an f32 world would do to the light, 1e6 from the origin.
    let mut scene = course();
    scene.lights[0].position += dvec3(1.0, 0.0, 0.0) / 16.0;
    scene.lights[0].direction += dvec3(1.0, 0.0, 0.0) / 16.0;
    assert!(differing(&here, &with_scene(scene, &[]).visibility()) > 10);
}

#[test]
fn a_light_along_its_up_vector_works() {
    for direction in [-DVec3::Y, dvec3(1e-9, -3.0, 0.0)] {
        let mut scene = course();
        scene.lights[0].direction = direction;
        let dark = dark(&with_scene(scene, &[]).visibility());
        assert!((50..20_000).contains(&dark), "{direction}: {dark}");
    }
}

#[test]
fn another_kind_of_light_is_refused_with_the_lab_that_draws_it() {
    let refused = |lights: Vec<Light>| {
        let scene = Scene { lights, ..course() };
        let context = bench(&[]).context;
        let started = (labs::find("csci3260").unwrap().start)(&context.gl, scene, None);
        started.err().unwrap().to_string()
    };
    let point = Light {
        kind: LightKind::Point { shadow_fov: 90.0 },
        ..course().lights[0]
    };
    assert!(refused(vec![point]).contains("cs541"));
    assert!(refused(vec![]).contains("0 lights"));
}

#[test]
fn the_mouse_orbits_around_the_centre_and_never_over_the_top() {
    let after = |keys: &str| {
        let mut bench = bench(&[]);
        bench.press(keys);
        let camera = bench.lab.now().camera;
        assert!((camera.eye + camera.look).distance(dvec3(0.0, -1.0, 0.0)) < 1e-9);
        assert!((camera.look.length() - dvec3(0.0, 3.0, 7.7).length()) < 1e-9);
        camera.eye
    };
    let start = after("");
    assert!(after("<Drag:60,0>").distance(start) > 1.0);
    assert!(after("<Drag:60,20><Drag:-60,-20>").distance(start) < 1e-9);
    let top = after("<Drag:0,100000>");
    assert!(top.distance(after("<Drag:0,100000><Drag:0,50>")) < 1e-9);
    assert!(top.y > 5.0 && after("<Drag:0,-100000>").y < -5.0);
}

#[test]
fn every_key_of_the_list_changes_the_picture() {
    let handout = labs::find("csci3260").unwrap();
    let listed = handout.keys.iter().flat_map(|(keys, _)| keys.split(' '));
    let mut count = 0;
    for key in listed {
        let mut bench = bench(&[]);
        // The first textures are those of the start.
        bench.press(match key {
            "1" => "2",
            "3" => "4",
            _ => "",
        });
        let before = bench.picture();
        bench.press(key);
        assert!(differing(&before, &bench.picture()) > 100, "{key}");
        count += 1;
    }
    assert_eq!(count, 11);
    assert!(
        !bench(&[]).lab.key(Key::Char('z')),
        "the control: a key of no meaning"
    );
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let straight = bench(&["stage=pcf", "map_size=512"]).picture();
    let mut bench = bench(&["scene=room", "stage=culling"]);
    bench.picture();
    bench.visibility();
    bench.set(&["scene=course"]);
    bench.press("24<Left><Drag:9,0>");
    bench.picture();
    bench.press("13<Right><Drag:-9,0>");
    bench.set(&["stage=pcf", "map_size=512"]);
    assert!(differing(&straight, &bench.picture()) < 20);
}

/// "Can set different visibilities to diffuse and specular light."
#[test]
fn the_specular_light_has_a_visibility_of_its_own() {
    // The eye where the sea mirrors the light beside the dolphin's shadow.
    let mut scene = course();
    let mirror = dvec3(0.0, -1.0, 2.8);
    scene.camera.look = -dvec3(-0.5, 2.0, -2.0);
    scene.camera.eye = mirror - scene.camera.look;
    let start = |settings: &[&str]| with_scene(scene.clone(), settings);
    let with = |settings: &[&str]| start(settings).picture();
    let (half, none) = (with(&[]), with(&["specular_visibility=0"]));
    let visibility = start(&[]).visibility();
    let mut darker = 0;
    for (x, y, pixel) in half.enumerate_pixels() {
        let less = none.get_pixel(x, y);
        if visibility.get_pixel(x, y).0[0] == 255 {
            assert_eq!(pixel, less, "a lit pixel, {x},{y}");
        } else {
            assert!(pixel.0.iter().zip(less.0).all(|(a, b)| *a >= b), "{x},{y}");
            darker += usize::from(pixel != less);
        }
    }
    assert!(darker > 100, "{darker}");
    // The control: unshadowed there is nothing to weaken.
    let off = ["shadows=off", "specular_visibility=0"];
    assert_eq!(differing(&with(&off[..1]), &with(&off)), 0);
}

#[test]
fn every_setting_is_read() {
    let changes = |base: &[&str], setting: &str| {
        let before = bench(base).picture();
        differing(&before, &bench(&[base, &[setting]].concat()).picture()) > 0
    };
    let room = &["scene=room"][..];
    for (base, setting) in [
        (&[][..], "scene=room"),
        (room, "stage=no_bias"),
        (room, "stage=slope"),
        (room, "stage=culling"),
        (room, "stage=thick"),
        (room, "stage=pcf"),
        (room, "bias=0.02"),
        (&["scene=room", "stage=slope"], "bias=0.02"),
        (room, "map_size=256"),
        (room, "shadow_test=offset"),
        (&["scene=room", "shadow_test=offset"], "stage=pcf"),
        (&["scene=room", "shadow_test=offset"], "stage=thick"),
        (room, "shadow_test=exact"),
        (room, "shadows=off"),
    ] {
        assert!(changes(base, setting), "{setting}");
    }
    // The control: what has no say in a stage without bias.
    assert!(!changes(&["stage=no_bias"], "bias=0.02"));
    for without_effect in ["bias=0.02", "stage=slope", "stage=culling"] {
        let offset = ["scene=room", "shadow_test=offset"];
        assert!(!changes(&offset, without_effect), "{without_effect}");
    }

    let mut spinning = course();
    spinning.objects[0].spin = Some(Spin {
        axis: DVec3::Z,
        degrees_per_second: 90.0,
    });
    let mut still = with_scene(spinning, &["rotation=off"]);
    let before = still.picture();
    still.lab.advance(1.0);
    assert!(!still.lab.moves());
    assert_eq!(differing(&before, &still.picture()), 0, "rotation=off");
    still.set(&["rotation=on"]);
    still.lab.advance(1.0);
    assert!(still.lab.moves());
    assert!(differing(&before, &still.picture()) > 0, "rotation=on");
}
