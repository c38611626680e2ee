//! Keys, mouse and time.

mod common;

use common::{Bench, differing};
use glam::{DMat4, DVec3, dvec3};
use shadowlab::labs::{self, Key};
use shadowlab::scene::Scene;

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

fn pressed(settings: &[&str], keys: &str) -> Bench {
    let mut bench = bench(settings);
    bench.press(keys);
    bench
}

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
