//! What the handout promises, held against the lab's pictures.

mod common;

use std::sync::Arc;

use common::{Bench, differing, work_folder};
use glam::{DMat4, DVec3, dvec3};
use image::{GrayImage, RgbImage};
use shadowlab::scene::Scene;
use shadowlab::{gl, labs};

const SIZE: [u32; 2] = [320, 240];

fn scene() -> Scene {
    (labs::find("cs541").unwrap().scene)().unwrap()
}

fn dark(visibility: &GrayImage) -> usize {
    visibility.pixels().filter(|pixel| pixel.0[0] == 0).count()
}

/// The picture that the visibility foretells: where it is 0, only ambient light; elsewhere, the picture without shadows.
fn foretold(visibility: &GrayImage, unshadowed: &RgbImage, ambient: &RgbImage) -> RgbImage {
    RgbImage::from_fn(SIZE[0], SIZE[1], |x, y| {
        let source = if visibility.get_pixel(x, y).0[0] == 0 {
            ambient
        } else {
            unshadowed
        };
        *source.get_pixel(x, y)
    })
}

#[test]
fn visibility_is_the_shadow_test_of_the_lighting_shader() {
    let dark_light = {
        let mut scene = scene();
        scene.lights[0].color = DVec3::ZERO;
        scene
    };
    for setting in [
        "remedy=epsilon",
        "remedy=none",
        "filter=nearest",
        "light=point",
        "beam=circular",
        "depth_format=16",
        "shadow_test=offset",
        "shadow_test=exact",
    ] {
        let mut bench = Bench::new("cs541", SIZE, &[setting]);
        let visibility = bench.visibility();
        let picture = bench.picture();
        bench.set(&["shadows=off"]);
        let unshadowed = bench.picture();
        let ambient = Bench::with_scene("cs541", dark_light.clone(), SIZE, &[setting]).picture();

        assert!(dark(&visibility) > 1000, "{setting}");
        let expected = foretold(&visibility, &unshadowed, &ambient);
        assert_eq!(differing(&picture, &expected), 0, "{setting}");

        // The control: one more row of shadow, and the two no longer agree.
        let shifted = image::imageops::flip_vertical(&visibility);
        assert!(differing(&picture, &foretold(&shifted, &unshadowed, &ambient)) > 100);
    }
}

#[test]
fn without_bias_there_is_acne_and_each_remedy_removes_it() {
    let dark_pixels = |settings: &[&str]| dark(&Bench::new("cs541", SIZE, settings).visibility());
    let remedied = dark_pixels(&["remedy=epsilon"]);
    // With GL_LINEAR the map's depths between texels are nearly the surface's own; GL_NEAREST shows half of it dark.
    assert!(dark_pixels(&["remedy=none"]) > 3 * remedied / 2);
    assert!(dark_pixels(&["remedy=none", "filter=nearest"]) > 5 * remedied);
    // Both keep the true shadows, and back faces in shadow or not are a matter of the remedy.
    for settings in [
        &["remedy=culling", "second_plane=on"],
        &["remedy=both", "second_plane=on"],
    ] {
        let found = dark_pixels(settings);
        assert!(
            found.abs_diff(remedied) < remedied / 2,
            "{settings:?}: {found}, epsilon {remedied}"
        );
    }
}

#[test]
fn front_face_culling_loses_the_shadow_of_a_plane_and_a_second_plane_brings_it_back() {
    // Where the painting's shadow falls on the floor, behind it and to its left.
    let point = dvec3(-5.0, 0.0, -2.6);
    let in_shadow = |settings: &[&str]| {
        let mut bench = Bench::new("cs541", SIZE, settings);
        let probe = labs::Probe::Point(point);
        bench
            .lab
            .explain(&bench.context.gl, probe, 1)
            .unwrap()
            .in_shadow
            .unwrap()
    };
    assert!(in_shadow(&["remedy=epsilon"]));
    assert!(!in_shadow(&["remedy=culling"]));
    assert!(in_shadow(&["remedy=culling", "second_plane=on"]));
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_shadows() {
    let here = Bench::new("cs541", SIZE, &[]).visibility();
    for distance in [1e5, 1e6] {
        let offset = distance * dvec3(1.0, -2.0, 0.5);
        let there = Bench::with_scene("cs541", scene().moved(offset), SIZE, &[]).visibility();
        assert_eq!(differing(&here, &there), 0, "moved by {offset}");
    }
    // The control: what an f32 world would do to the light, 1e6 from the origin.
    let mut scene = scene();
    scene.lights[0].position += 1.0 / 16.0;
    let rounded = Bench::with_scene("cs541", scene, SIZE, &[]).visibility();
    assert!(differing(&here, &rounded) > 50);
}

#[test]
fn a_light_along_its_up_vector_works() {
    for (direction, position) in [
        (-DVec3::Y, dvec3(0.0, 8.0, 0.0)),
        (dvec3(1e-9, -3.0, 0.0), dvec3(0.0, 8.0, 0.0)),
        (-DVec3::Z, dvec3(0.0, 1.0, 9.0)),
    ] {
        let mut scene = scene();
        scene.lights[0].direction = direction;
        scene.lights[0].position = position;
        let visibility = Bench::with_scene("cs541", scene, SIZE, &["remedy=epsilon"]).visibility();
        let dark = dark(&visibility);
        assert!(
            (1000..40_000).contains(&dark),
            "light along {direction}: {dark} dark pixels"
        );
    }
}

#[test]
fn what_casts_no_shadow_is_not_in_the_map() {
    let depths = |scene: Scene| {
        let mut bench = Bench::with_scene("cs541", scene, SIZE, &["map_size=256"]);
        bench.picture();
        let map = bench.lab.shadow_texture(1).unwrap();
        gl::read_depths(&bench.context.gl, map.texture, [map.scale.size; 2]).depths
    };
    let all = scene();
    assert!(depths(all.clone()).iter().any(|depth| *depth < 1.0));

    // Sky dome and light marker are drawn, and cast nothing.
    let mut nothing = all.clone();
    nothing.objects.clear();
    assert!(depths(nothing).iter().all(|depth| *depth == 1.0));

    let mut no_casters = all;
    for object in &mut no_casters.objects {
        object.casts = false;
    }
    assert!(depths(no_casters).iter().all(|depth| *depth == 1.0));
}

#[test]
fn the_mouse_turns_the_look_and_never_over_the_top() {
    let after = |keys: &str| {
        let mut bench = Bench::new("cs541", SIZE, &[]);
        bench.press(keys);
        bench.picture()
    };
    let straight = after("");
    // A turn to the right shows on the left what was in the middle: the same turn back undoes it.
    let turned = after("<Drag:60,0>");
    assert!(differing(&straight, &turned) > 1000);
    assert!(differing(&straight, &after("<Drag:60,0><Drag:-60,0>")) < 100);
    // However far the mouse goes up, the look stops where up still means something.
    let up = after("<Drag:0,-100000>");
    assert_eq!(differing(&up, &after("<Drag:0,-100000><Drag:0,-50>")), 0);
    assert!(differing(&up, &after("<Drag:0,-100000><Drag:0,50>")) > 1000);
    assert!(differing(&up, &after("<Drag:0,100000>")) > 1000);
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let straight = Bench::new("cs541", SIZE, &["filter=nearest", "map_size=512"]).picture();
    let mut bench = Bench::new(
        "cs541",
        SIZE,
        &["light=point", "remedy=culling", "depth_format=16"],
    );
    bench.press("<Left><Up>x");
    bench.picture();
    bench.visibility();
    bench.press("<Right><Down>x");
    bench.set(&[
        "light=spot",
        "remedy=epsilon",
        "depth_format=handout",
        "filter=nearest",
        "map_size=512",
    ]);
    assert_eq!(differing(&straight, &bench.picture()), 0);
}

#[test]
fn every_key_of_the_list_changes_the_picture() {
    let handout = labs::find("cs541").unwrap();
    let before = Bench::new("cs541", SIZE, &[]).picture();
    let listed = handout.keys.iter().flat_map(|(keys, _)| keys.split(' '));
    let mut count = 0;
    for key in listed {
        let mut bench = Bench::new("cs541", SIZE, &[]);
        bench.press(key);
        assert!(differing(&before, &bench.picture()) > 100, "{key}");
        count += 1;
    }
    assert_eq!(count, 19);
    let mut bench = Bench::new("cs541", SIZE, &[]);
    assert!(
        !bench.lab.key(labs::Key::Char('z')),
        "the control: a key of no meaning"
    );
}

#[test]
fn every_setting_is_read() {
    // Each value that is not the default must change the picture of some state, or the map, or what is drawn.
    let changes = |base: &[&str], setting: &str| {
        let before = Bench::new("cs541", SIZE, base).picture();
        let after = Bench::new("cs541", SIZE, &[base, &[setting]].concat()).picture();
        differing(&before, &after) > 0
    };
    for (base, setting) in [
        (&[][..], "light=point"),
        (&[], "beam=circular"),
        (&[], "spot_angle=40"),
        (&["light=point"], "shadow_fov=30"),
        (&[], "map_size=300"),
        (&["epsilon=0"], "depth_format=16"),
        (&["remedy=none"], "depth_format=24"),
        (&["remedy=none"], "depth_format=32F"),
        (&[], "filter=nearest"),
        (&[], "remedy=none"),
        (&[], "remedy=culling"),
        (&[], "remedy=both"),
        (&[], "epsilon=0.01"),
        (&["remedy=culling"], "second_plane=on"),
        (&[], "shadow_test=offset"),
        (&["shadow_test=offset"], "map_size=300"),
        (&[], "shadow_test=exact"),
        (&[], "shadows=off"),
    ] {
        let same_as_handout = setting == "depth_format=24";
        assert_eq!(changes(base, setting), !same_as_handout, "{setting}");
    }
    let mut still = Bench::new("cs541", SIZE, &["rotation=off"]);
    let before = still.picture();
    still.lab.advance(1.0);
    assert_eq!(differing(&before, &still.picture()), 0, "rotation=off");
    still.set(&["rotation=on"]);
    still.lab.advance(1.0);
    assert!(differing(&before, &still.picture()) > 0, "rotation=on");
}

/// The lines of a shader, without comments and without those that have one of these words.
fn without(text: &str, words: &[&str]) -> Vec<String> {
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    let lines = lines.map(|line| line.trim().to_owned());
    let is_meant =
        |line: &String| !line.is_empty() && !words.iter().any(|word| line.contains(word));
    lines.filter(is_meant).collect()
}

#[test]
fn the_shader_for_shadows_off_differs_in_the_test_alone() {
    let read = |name: &str| std::fs::read_to_string(format!("glsl/cs541/{name}")).unwrap();
    let (handouts, unshadowed) = (read("lighting.frag"), read("lighting_unshadowed.frag"));
    let test = [
        "shadow_sampler",
        "shadow_depth",
        "point_depth",
        "epsilon",
        "bool shadows",
        "bool illuminated",
    ];
    let rest = without(&handouts, &test);
    assert!(rest.len() > 30, "{}", rest.len());
    assert_eq!(rest, without(&unshadowed, &test));
    assert!(!unshadowed.contains("sampler2D shadow"));
    // The control.
    let edited = unshadowed.replace("normalize(", "(");
    assert_ne!(rest, without(&edited, &test));
}

/// Without shadows is as it would be if nothing cast one.
#[test]
fn shadows_off_looks_as_if_nothing_cast_a_shadow() {
    let mut no_casters = scene();
    for object in &mut no_casters.objects {
        object.casts = false;
    }
    for setting in ["beam=rectangular", "beam=circular", "light=point"] {
        let off = Bench::new("cs541", SIZE, &[setting, "shadows=off"]).picture();
        let expected = Bench::with_scene("cs541", no_casters.clone(), SIZE, &[setting]).picture();
        assert_eq!(differing(&off, &expected), 0, "{setting}");
        let shadowed = Bench::new("cs541", SIZE, &[setting]).picture();
        assert!(differing(&off, &shadowed) > 1000, "the control: {setting}");
    }
}

/// A student's own lighting is what is seen without shadows, too.
#[test]
fn shadows_off_is_drawn_by_a_students_own_shader() {
    let folder = work_folder("cs541-unshadowed");
    let handouts = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let own = handouts.replace(
        "frag_color = vec4(color, 1)",
        "frag_color = vec4(color.bgr, 1)",
    );
    std::fs::write(folder.join("lighting.frag"), own).unwrap();
    let mut students = Bench::with_glsl("cs541", &folder, SIZE);
    students.set(&["shadows=off"]);
    let students = students.picture();
    let off = Bench::new("cs541", SIZE, &["shadows=off"]).picture();
    assert!(differing(&students, &off) > 10_000);
}

/// The scene with a triangle in the middle of each mesh, too small to be seen: none of them is a solid then.
fn without_solids(mut scene: Scene) -> Scene {
    for object in &mut scene.objects {
        let mesh = Arc::make_mut(&mut object.mesh);
        let middle = mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64;
        let first = mesh.positions.len() as u32;
        for corner in [DVec3::ZERO, DVec3::X, DVec3::Y] {
            mesh.positions.push(middle + 1e-9 * corner);
            mesh.normals.push(DVec3::Z);
            mesh.texture_coords.push(glam::DVec2::ZERO);
        }
        mesh.faces.push([first, first + 1, first + 2]);
    }
    scene
}

/// Back faces are left out where they are hidden and nowhere else.
#[test]
fn what_is_not_drawn_of_a_solid_is_not_seen() {
    let sphere = scene()
        .objects
        .iter()
        .position(|o| o.name == "sphere")
        .unwrap();
    let edited = |edit: &dyn Fn(&mut Scene)| {
        let mut scene = scene();
        edit(&mut scene);
        scene
    };
    let middle = scene().objects[sphere].placement.w_axis.truncate();
    let cases = [
        ("outside", scene()),
        ("inside", edited(&|scene| scene.camera.eye = middle)),
        // The near plane, 0.1 away, cuts a sphere of 0.7 open.
        (
            "at its skin",
            edited(&|scene| {
                scene.camera.eye = middle - 0.75 * scene.camera.look.normalize();
            }),
        ),
        (
            "inside out",
            edited(&|scene| {
                let mesh = Arc::make_mut(&mut scene.objects[sphere].mesh);
                mesh.faces.iter_mut().for_each(|face| face.swap(0, 1));
            }),
        ),
        (
            "mirrored",
            edited(&|scene| {
                scene.objects[sphere].placement *= DMat4::from_scale(dvec3(-1.0, 1.0, 1.0));
            }),
        ),
    ];
    for (name, scene) in cases {
        let drawn = Bench::with_scene("cs541", scene.clone(), SIZE, &[]).picture();
        let all = without_solids(scene.clone());
        let all = Bench::with_scene("cs541", all, SIZE, &[]).picture();
        // At its outline, front and back have the same depth but for rounding.
        assert!(differing(&drawn, &all) < 5, "{name}");
        let mut none = scene;
        none.objects.remove(sphere);
        let none = Bench::with_scene("cs541", none, SIZE, &[]).picture();
        assert!(differing(&drawn, &none) > 200, "the control: {name}");
    }
}

/// The nearest is drawn first, whatever the scene's order.
#[test]
fn the_order_of_the_objects_is_not_seen() {
    let mut backwards = scene();
    backwards.objects.reverse();
    let here = Bench::new("cs541", SIZE, &[]).picture();
    let there = Bench::with_scene("cs541", backwards, SIZE, &[]).picture();
    // Of two surfaces that meet, the first one that is drawn has the pixel where they have the same depth.
    assert!(differing(&here, &there) < 5);
    let mut moved = scene();
    moved.objects[3].placement.w_axis.x += 0.1;
    let moved = Bench::with_scene("cs541", moved, SIZE, &[]).picture();
    assert!(differing(&here, &moved) > 100, "the control");
}
