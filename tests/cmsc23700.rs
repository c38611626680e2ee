//! What the handout promises, held against the lab's pictures.

mod common;

use std::sync::Arc;

use common::{Bench, differing, work_folder};
use glam::{DVec3, dvec3};
use image::{GrayImage, RgbImage};
use shadowlab::gl;
use shadowlab::ground_truth::{Label, Rays, Truth};
use shadowlab::labs::{self, Lab};
use shadowlab::measure::{Figures, Measure};
use shadowlab::picture::{Grey, Projection};
use shadowlab::scene::{Beam, Light, LightKind, Scene, file};

const SIZE: [u32; 2] = [320, 320];
const DIRECTIONAL: usize = 1;
const SPOT: usize = 2;
const MODES: [(&str, &[usize]); 3] = [
    ("lights=directional", &[DIRECTIONAL]),
    ("lights=spotlight", &[SPOT]),
    ("lights=both", &[DIRECTIONAL, SPOT]),
];

fn the_box() -> Scene {
    (labs::find("cmsc23700").unwrap().scene)().unwrap()
}

fn bench(settings: &[&str]) -> Bench {
    Bench::new("cmsc23700", SIZE, settings)
}

fn with_scene(scene: Scene, settings: &[&str]) -> Bench {
    Bench::with_scene("cmsc23700", scene, SIZE, settings)
}

fn dark(visibility: &GrayImage) -> usize {
    visibility.pixels().filter(|pixel| pixel.0[0] < 128).count()
}

/// What the truth sees of a lab's present state, for a light.
fn truth(lab: &dyn Lab, light: usize) -> (Rays, Truth) {
    let rays = Rays::new(&lab.now(), light - 1);
    let truth = rays.truth(SIZE);
    (rays, truth)
}

/// The lab's own test against the truth.
fn figures(settings: &[&str], light: usize) -> Figures {
    let mut bench = bench(settings);
    let visibility = bench.visibility_of(light);
    let (rays, truth) = truth(bench.lab.as_ref(), light);
    let map = bench.lab.shadow_texture(light).unwrap().scale;
    Measure::new(&rays, &truth)
        .measure(&visibility, Some(&map))
        .0
}

#[test]
fn full_shadow_is_0_and_light_is_255() {
    for light in [DIRECTIONAL, SPOT] {
        let mut grades = bench(&[]).visibility_of(light).into_raw();
        grades.sort_unstable();
        grades.dedup();
        assert_eq!(grades, [0, 255]);
        assert_eq!(dark(&bench(&["shadows=off"]).visibility_of(light)), 0);
    }
}

// --- the box and its lights ---

#[test]
fn the_box_fills_the_pixels_that_it_fills_in_the_course() {
    let mut bench = Bench::new("cmsc23700", [800, 800], &["balls=0"]);
    let picture = bench.picture();
    let clear = picture.get_pixel(0, 0).0;
    assert_eq!(clear, [51, 51, 102]);
    // A row below the middle crosses both walls and the back; the columns' ends are the box's.
    let row: Vec<[u8; 3]> = (0..800).map(|x| picture.get_pixel(x, 450).0).collect();
    let columns = |belongs: &dyn Fn(&[u8; 3]) -> bool| {
        let first = row.iter().position(belongs).unwrap();
        [first, row.iter().rposition(belongs).unwrap()]
    };
    assert_eq!(columns(&|pixel| *pixel != clear), [86, 713]);
    let green = |pixel: &[u8; 3]| pixel[1] > 3 * pixel[0] && pixel[1] > 3 * pixel[2];
    assert_eq!(columns(&green), [243, 556]);
    // The bottom: red, in the middle column, down to the front edge.
    let column: Vec<[u8; 3]> = (0..800).map(|y| picture.get_pixel(400, y).0).collect();
    let red = column.iter().rposition(|pixel| *pixel != clear).unwrap();
    assert_eq!(red, 713);
    // The camera looks along +z: the viewer's left is the wall at x = 1, which is violet.
    let [r, g, b] = picture.get_pixel(150, 450).0;
    assert!(r > g && b > g, "{:?}", [r, g, b]);
}

/// The sphere of radius √3 around the box lies between each light's planes, and the directional light's map holds it.
#[test]
fn the_maps_hold_the_bounding_sphere() {
    let [directional, spot] = &the_box().lights[..] else {
        panic!("two lights")
    };
    let radius = 3_f64.sqrt();
    let to_centre = -directional.position.dot(directional.direction.normalize());
    assert!((directional.near - (to_centre - radius)).abs() < 1e-12);
    assert!((directional.far - (to_centre + radius)).abs() < 1e-12);
    let kind = LightKind::Directional {
        area: [-radius, radius, -radius, radius],
    };
    assert_eq!(directional.kind, kind);
    let distance = spot.position.length();
    assert!(spot.near > 0.0 && (spot.near - (distance - radius)).abs() < 1e-12);
    assert!((spot.far - (distance + radius)).abs() < 1e-12);
    assert!(spot.position.y > 1.0, "above the open top");
}

/// What the lights were chosen for.
#[test]
fn most_of_the_bottom_is_lit_and_the_edge_of_the_cone_is_seen() {
    let lab = bench(&["balls=0"]);
    let scene = lab.lab.now();
    let of_bottom = |light: usize, label: Label| {
        let (rays, truth) = truth(lab.lab.as_ref(), light);
        let on_bottom = |seen: &Option<(u32, DVec3)>| {
            seen.is_some_and(|(triangle, _)| {
                let object = rays.objects[triangle as usize] as usize;
                scene.objects[object].name == "bottom"
            })
        };
        let pixels = truth.seen.iter().zip(&truth.labels);
        let labels = pixels.filter(|(seen, _)| on_bottom(seen));
        let labels: Vec<_> = labels.map(|(_, found)| *found == label).collect();
        let count = labels.iter().filter(|is| **is).count();
        count as f64 / labels.len() as f64
    };
    let lit = of_bottom(DIRECTIONAL, Label::Lit);
    assert!((0.7..1.0).contains(&lit), "{lit}");
    let outside = of_bottom(SPOT, Label::NotValid);
    assert!((0.1..0.6).contains(&outside), "{outside}");
}

#[test]
fn the_default_biases_leave_next_to_nothing_wrong_inside_and_none_leaves_acne() {
    for (setting, lights) in MODES {
        for light in lights {
            let found = figures(&[setting], *light);
            assert!(found.shadowed > 300, "{found:?}");
            assert!(found.false_shadow.interior <= 3, "{found:?}");
            assert_eq!(found.false_light.interior, 0, "{found:?}");
            let biases = ["directional_bias=0", "spot_bias=0"];
            let without = figures(&[&[setting][..], &biases].concat(), *light);
            assert!(without.false_shadow.interior > without.lit / 4);
        }
    }
}

// --- the maps ---

/// "Map the depth values to a grey scale (i.e., -1 maps to black and 1 maps to white)."
#[test]
fn the_maps_are_shown_by_depth() {
    let mut bench = bench(&["map_size=256"]);
    bench.picture();
    assert_eq!(bench.lab.grey(), Grey::Depth);
    for (light, projection) in [
        (DIRECTIONAL, Projection::Orthographic),
        (SPOT, Projection::Perspective),
    ] {
        let map = bench.lab.shadow_texture(light).unwrap();
        assert_eq!(map.scale.projection, projection);
        let depths = gl::read_depths(&bench.context.gl, map.texture, [256; 2]);
        let shown = |projection| {
            let (near, far) = (map.scale.near, map.scale.far);
            depths.linearised(projection, near, far).into_raw()
        };
        let clipping = depths
            .depths
            .iter()
            .map(|depth| 2.0 * f64::from(*depth) - 1.0);
        let expected: Vec<u8> = clipping
            .map(|z| (255.0 * (z + 1.0) / 2.0).round() as u8)
            .collect();
        assert_eq!(shown(bench.lab.grey().of(projection)), expected);
        // The control: distances are another picture, in perspective.
        let by_distance = shown(Grey::Distance.of(projection)) == expected;
        assert_eq!(by_distance, light == DIRECTIONAL);
    }
}

// --- other scenes ---

#[test]
fn other_lights_are_refused_with_the_lab_that_draws_them() {
    let [directional, spot] = &the_box().lights[..] else {
        panic!("two lights")
    };
    let [directional, spot] = [directional, spot].map(|light| vec![light.clone()]);
    let rectangular = LightKind::Spot {
        cone: 40.0,
        beam: Beam::Rectangular,
    };
    let rectangular = vec![Light {
        kind: rectangular,
        ..spot[0].clone()
    }];
    for (lights, told) in [
        (vec![], "found the lights: none"),
        (directional.clone(), "csci3260"),
        (spot.clone(), "cs541"),
        (
            [spot.clone(), directional.clone()].concat(),
            "spot, directional",
        ),
        ([directional.clone(), rectangular].concat(), "rectangular"),
        (
            [directional, spot.clone(), spot].concat(),
            "directional, spot, spot",
        ),
    ] {
        let scene = Scene {
            lights,
            ..the_box()
        };
        let context = bench(&[]).context;
        let started = (labs::find("cmsc23700").unwrap().start)(&context.gl, scene, None);
        let error = started.err().unwrap();
        assert_eq!(error.exit_code(), 2);
        let error = error.to_string();
        assert!(
            error.contains(told) && error.contains("expected two"),
            "{error}"
        );
    }
}

/// Box, camera and lights are the file's; the balls bounce on where the box was.
#[test]
fn a_students_scene_is_drawn() {
    let path = work_folder("two_lights").join("s.toml");
    let text = "\
[camera]
eye = [0, 3, 6]
target = [0, 0, 0]
[[light]]
kind = \"directional\"
direction = [-0.3, -1, -0.3]
[[light]]
position = [2, 5, 1]
cone = 50
[[object]]
mesh = \"plane\"
rotate = { axis = [1, 0, 0], degrees = -90 }
scale = 4
translate = [0, -1, 0]
[[object]]
mesh = \"torus\"
translate = [0, 0.5, 0]
spin = { axis = [1, 0, 0], degrees_per_second = 90 }
casts = true
[[object]]
mesh = \"cube\"
translate = [-2, 0, 0]
casts = false
";
    std::fs::write(&path, text).unwrap();
    let scene = file::load(&path, false).unwrap();
    for light in [DIRECTIONAL, SPOT] {
        for balls in ["balls=0", "balls=10"] {
            let mut bench = with_scene(scene.clone(), &[balls]);
            bench.lab.advance(0.4);
            let visibility = bench.visibility_of(light);
            assert!(dark(&visibility) > 500, "light {light}");
            let (rays, truth) = truth(bench.lab.as_ref(), light);
            let scale = bench.lab.shadow_texture(light).unwrap().scale;
            let measure = Measure::new(&rays, &truth);
            let (found, _) = measure.measure(&visibility, Some(&scale));
            let share = found.false_light.total() as f64 / found.shadowed as f64;
            assert!(share < 0.05, "light {light}: {found:?}");
            assert!(bench.lab.moves());
        }
    }
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_shadows() {
    let visibilities = |scene: Scene| {
        let mut bench = with_scene(scene, &["balls=0"]);
        [DIRECTIONAL, SPOT].map(|light| bench.visibility_of(light))
    };
    let scene = || {
        let mut scene = the_box();
        // Something to be seen in the cone.
        let mut sphere = shadowlab::scene::shapes::sphere(20);
        sphere.positions.iter_mut().for_each(|p| *p *= 0.3);
        let mut ball = scene.objects[0].clone();
        ball.mesh = Arc::new(sphere);
        scene.objects.push(ball);
        scene
    };
    let here = visibilities(scene());
    for distance in [1e5, 1e6] {
        let offset = distance * dvec3(1.0, -2.0, 0.5);
        let there = visibilities(scene().moved(offset));
        for (here, there) in here.iter().zip(&there) {
            assert!(dark(here) > 500);
            assert!(differing(here, there) < 5, "moved by {offset}");
        }
    }
    // The control: what an f32 world would do to a light, 1e6 from the origin.
    let mut moved = scene();
    moved.lights[1].position += dvec3(1.0, 0.0, 0.0) / 16.0;
    assert!(differing(&here[1], &visibilities(moved)[1]) > 20);
}

/// Light straight from above, along the usual up vector.
#[test]
fn lights_along_their_up_vector_work() {
    let mut scene = the_box();
    for light in &mut scene.lights {
        light.direction = dvec3(0.0, -2.0, 0.0);
        light.position = dvec3(0.0, light.position.length(), 0.0);
    }
    let mut bench = with_scene(scene, &[]);
    for light in [DIRECTIONAL, SPOT] {
        let dark = dark(&bench.visibility_of(light));
        assert!((50..20_000).contains(&dark), "{light}: {dark}");
    }
}

/// Visibility is the shadow test of the picture: where both say light, the picture is the one without shadows.
#[test]
fn visibility_is_the_shadow_test_of_the_lighting() {
    let wrong = |picture: &RgbImage, unshadowed: &RgbImage, visibility: &[GrayImage; 2]| {
        let pixels = picture.enumerate_pixels();
        let lit =
            pixels.filter(|(x, y, _)| visibility.iter().all(|v| v.get_pixel(*x, *y).0[0] == 255));
        lit.filter(|(x, y, pixel)| unshadowed.get_pixel(*x, *y) != *pixel)
            .count()
    };
    for test in [
        "shadow_test=handout",
        "shadow_test=offset",
        "shadow_test=exact",
    ] {
        let mut bench = bench(&["balls=60", test]);
        let picture = bench.picture();
        let visibility = [DIRECTIONAL, SPOT].map(|light| bench.visibility_of(light));
        bench.set(&["shadows=off"]);
        let unshadowed = bench.picture();
        assert_eq!(wrong(&picture, &unshadowed, &visibility), 0, "{test}");
        // The control: shadows elsewhere.
        let shifted = visibility.map(|v| image::imageops::flip_horizontal(&v));
        assert!(wrong(&picture, &unshadowed, &shifted) > 100, "{test}");
    }
}
