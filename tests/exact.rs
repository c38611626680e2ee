//! `shadow_test=exact` in the labs: against the truth, and what it does not have.

mod common;
mod hard;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use common::{Bench, differing};
use glam::{DMat4, DVec3};
use hard::{Case, cases, five_shapes};
use shadowlab::gl::trace;
use shadowlab::ground_truth::{Label, Rays};
use shadowlab::labs;
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::{LightKind, Scene, rotate, shapes};

const SIZE: [u32; 2] = [320, 240];

/// The lab that draws a scene's light.
fn lab_for(scene: &Scene) -> &'static str {
    match scene.lights[0].kind {
        LightKind::Directional { .. } => "csci3260",
        _ => "cs541",
    }
}

/// Of the first light.
fn figures(lab: &str, scene: Scene, settings: &[&str]) -> Figures {
    figures_of(1, &mut Bench::with_scene(lab, scene, SIZE, settings))
}

fn figures_of(light: usize, bench: &mut Bench) -> Figures {
    let visibility = bench.visibility_of(light);
    let rays = Rays::new(&bench.lab.now(), light - 1);
    let truth = rays.truth(SIZE);
    let map = bench.lab.shadow_texture(light).ok().map(|map| map.scale);
    Measure::new(&rays, &truth)
        .measure(&visibility, map.as_ref())
        .0
}

/// Pixels that are wrong and not ambiguous.
fn wrong(figures: &Figures) -> [usize; 2] {
    [figures.false_shadow.total(), figures.false_light.total()]
}

fn default_scene(lab: &str) -> Scene {
    (labs::find(lab).unwrap().scene)().unwrap()
}

#[test]
fn no_pixel_of_a_labs_scene_is_wrong() {
    let states: [(&str, Scene, &[&str]); 13] = [
        ("cs541", default_scene("cs541"), &[]),
        ("cs541", default_scene("cs541"), &["beam=circular"]),
        ("cs541", default_scene("cs541"), &["light=point"]),
        ("cs541", default_scene("cs541"), &["spot_angle=150"]),
        ("cs541", default_scene("cs541"), &["spot_angle=170"]),
        ("cs541", five_shapes(), &[]),
        ("cs541", five_shapes(), &["light=point"]),
        ("csci3260", default_scene("csci3260"), &[]),
        ("csci3260", default_scene("csci3260"), &["scene=room"]),
        ("aueb7", default_scene("aueb7"), &[]),
        ("aueb7", default_scene("aueb7"), &["outside=lit"]),
        ("aueb7", default_scene("aueb7"), &["scene=pirate"]),
        ("aueb7", default_scene("aueb7"), &["scene=knossos"]),
    ];
    for (lab, scene, settings) in states {
        let exact = [settings, &["shadow_test=exact"]].concat();
        let found = figures(lab, scene.clone(), &exact);
        assert_eq!(wrong(&found), [0, 0], "{lab} {settings:?}: {found}");
        assert!(found.ambiguous < 60, "{lab} {settings:?}: {found}");
        assert!(found.shadowed > 500, "{lab} {settings:?}: {found}");
        // The control: the handout's map cannot be that good.
        let map = figures(lab, scene, settings);
        assert!(
            wrong(&map).iter().sum::<usize>() > 5,
            "{lab} {settings:?}: {map}"
        );
    }
}

/// Each of two lights has a light buffer of its own; the balls are one mesh, drawn once, and each casts.
#[test]
fn no_pixel_is_wrong_under_either_light() {
    for balls in ["balls=0", "balls=20", "balls=100"] {
        for time in [0.0, 3.7] {
            let scene = default_scene("cmsc23700");
            let mut bench = Bench::with_scene("cmsc23700", scene, SIZE, &[balls]);
            bench.lab.advance(time);
            let mut wrong_by_map = 0;
            for light in [1, 2] {
                bench.set(&["shadow_test=exact"]);
                let found = figures_of(light, &mut bench);
                let of = format!("{balls} at {time} s, light {light}: {found}");
                assert_eq!(wrong(&found), [0, 0], "{of}");
                assert!(found.ambiguous < 150, "{of}");
                assert!(found.shadowed > 100 || balls == "balls=0", "{of}");
                bench.set(&["shadow_test=handout"]);
                let map = figures_of(light, &mut bench);
                wrong_by_map += wrong(&map).iter().sum::<usize>();
            }
            // The control: the handout's maps cannot be that good where there is more than straight edges.
            assert!(
                wrong_by_map > 10 || balls == "balls=0",
                "{balls}: {wrong_by_map}"
            );
        }
    }
}

#[test]
fn no_pixel_of_a_hard_case_is_wrong() {
    for Case { name, scene, .. } in cases() {
        let found = figures(lab_for(&scene), scene, &["shadow_test=exact"]);
        assert_eq!(wrong(&found), [0, 0], "{name}: {found}");
        assert!(found.ambiguous < 100, "{name}: {found}");
    }
}

/// A folder with the test's shader, edited.
fn edited(name: &str, from: &str, to: &str) -> PathBuf {
    let shader = std::fs::read_to_string("glsl/shadow_tests/exact.frag").unwrap();
    assert_eq!(shader.matches(from).count(), 1, "{from}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(folder.join("shadow_tests")).unwrap();
    std::fs::write(
        folder.join("shadow_tests/exact.frag"),
        shader.replace(from, to),
    )
    .unwrap();
    folder
}

/// Of an open mesh what faces the light casts, too, and not onto itself.
#[test]
fn a_triangle_that_faces_the_light_does_not_shadow_itself() {
    let size = [800, 600];
    let scene = (shadowlab::hard::find("open-mesh").unwrap().scene)();
    let rays = Rays::new(&scene, 0);
    let truth = rays.truth(size);
    let measure = Measure::new(&rays, &truth);
    let exact = ["shadow_test=exact"];
    let mut bench = Bench::with_scene("cs541", scene.clone(), size, &exact);
    let found = measure.measure(&bench.visibility(), None).0;
    assert_eq!(wrong(&found), [0, 0], "{found}");
    // The control: nothing is in the plane of anything.
    let folder = edited("exact-own-plane", "IN_PLANE = 1e-5", "IN_PLANE = -1e5");
    let mut bench = Bench::with_scene_and_glsl("cs541", scene, &folder, size, &exact);
    let [shadow, _] = wrong(&measure.measure(&bench.visibility(), None).0);
    assert!(shadow > 0);
}

/// Smooth normals face the light on some triangles that do not, under a spot light and under the sun.
#[test]
fn what_faces_away_from_the_light_is_in_its_own_shadow() {
    for lab in ["cs541", "csci3260"] {
        let mut scene = default_scene(lab);
        let light = scene.lights[0].clone();
        let shines = light.direction.normalize();
        let centre = light.position + 8.0 * shines;
        scene.objects.truncate(1);
        scene.objects[0].mesh = Arc::new(shapes::sphere(8));
        // Turned, so that the light sees no triangle edge-on.
        scene.objects[0].placement =
            DMat4::from_translation(centre) * rotate(20.0, DVec3::new(1.0, 2.0, 3.0));
        // Seen from the side, half of it is lit.
        scene.camera.look = shines.any_orthonormal_vector();
        scene.camera.rup = shines;
        scene.camera.eye = centre - 4.0 * scene.camera.look;
        let truth = Rays::new(&scene, 0).truth(SIZE);
        let faces_away =
            |i: &usize| truth.seen[*i].is_some() && truth.labels[*i] == Label::NotValid;
        let away: Vec<usize> = (0..truth.labels.len()).filter(faces_away).collect();
        assert!(away.len() > 1000, "{lab}: {} pixels", away.len());
        let lit = |mut bench: Bench| {
            let visibility = bench.visibility().into_raw();
            away.iter().filter(|i| visibility[**i] != 0).count()
        };
        let exact = ["shadow_test=exact"];
        let found = lit(Bench::with_scene(lab, scene.clone(), SIZE, &exact));
        assert_eq!(found, 0, "{lab}");
        // The control: nothing faces away.
        let folder = edited(&format!("exact-away-{lab}"), "> 1e-3;", "> 2;");
        let control = Bench::with_scene_and_glsl(lab, scene, &folder, SIZE, &exact);
        assert!(lit(control) > 100, "{lab}");
    }
}

/// The control of both: a light buffer of a light that is elsewhere by a fiftieth.
#[test]
fn a_light_elsewhere_is_noticed() {
    let here = five_shapes();
    let mut there = here.clone();
    there.lights[0].position.x += 0.02 * there.lights[0].position.length();
    let picture = |scene: &Scene| {
        let exact = ["shadow_test=exact"];
        Bench::with_scene("cs541", scene.clone(), SIZE, &exact).visibility()
    };
    let rays = Rays::new(&here, 0);
    let truth = rays.truth(SIZE);
    let measure = Measure::new(&rays, &truth);
    assert_eq!(wrong(&measure.measure(&picture(&here), None).0), [0, 0]);
    let [shadow, light] = wrong(&measure.measure(&picture(&there), None).0);
    assert!(shadow + light > 20, "{shadow} {light}");
}

#[test]
fn there_is_no_map_to_show_or_to_explain() {
    for lab in ["cs541", "csci3260", "cmsc23700", "aueb7"] {
        for command in [
            &["screenshot", "--show", "shadow-map"][..],
            &["screenshot", "--show", "depth-raw"],
            &["explain", "--pixel", "3,3"],
        ] {
            let output = Command::new(env!("CARGO_BIN_EXE_shadowlab"))
                .arg(command[0])
                .args([lab, "--size", "16x16", "--set", "shadow_test=exact"])
                .args(&command[1..])
                .output()
                .unwrap();
            let told = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(2), "{told}");
            assert!(told.contains("expected shadow_test=handout"), "{told}");
            assert_eq!(told.lines().count(), 1, "{told}");
        }
    }
}

/// The light buffer is built anew when the light or something in the scene has moved, and only then.
#[test]
fn the_light_buffer_is_built_when_light_or_casters_have_moved() {
    let mut bench = Bench::recorded("cs541", [64, 64], &["shadow_test=exact"]);
    bench.picture();
    let mut is_built = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        let text = trace::to_c(&trace::take());
        assert!(!text.contains("// first pass"));
        text.contains("// the light buffer")
    };
    assert!(!is_built(&|_| ()), "nothing has changed");
    assert!(!is_built(&|bench| bench.press("wdqo")), "the eye has moved");
    assert!(
        !is_built(&|bench| bench.set(&["epsilon=0.01", "map_size=512"])),
        "settings of the map"
    );
    assert!(
        is_built(&|bench| bench.press("<Left>")),
        "the light has moved"
    );
    assert!(
        is_built(&|bench| bench.lab.advance(0.1)),
        "the torus has turned"
    );
    assert!(
        is_built(&|bench| bench.set(&["light=point"])),
        "another light"
    );
    assert!(
        !is_built(&|bench| bench.set(&["shadows=off"])),
        "nothing is tested"
    );
    let redraw = ["shadows=on", "redraw=every_frame"];
    assert!(is_built(&|bench| bench.set(&redraw)), "in every frame");
}

/// Which light buffers the next picture builds, after a change: the headings of their passes.
fn built(bench: &mut Bench, change: &dyn Fn(&mut Bench)) -> Vec<String> {
    change(bench);
    trace::take();
    bench.picture();
    let text = trace::to_c(&trace::take());
    let headings = text.lines().filter_map(|line| line.strip_prefix("// "));
    let built =
        headings.filter(|heading| heading.ends_with("buffer") && heading.starts_with("the "));
    built.map(str::to_owned).collect()
}

#[test]
fn each_light_has_its_buffer_built_while_it_is_on() {
    let exact = ["shadow_test=exact"];
    let mut bench = Bench::recorded("cmsc23700", [64, 64], &exact);
    let [directional, spot] = ["the directional light's buffer", "the spotlight's buffer"];
    bench.picture();
    for (what, change, expected) in [
        ("nothing", "s s", &[][..]),
        ("time", "<Wait:0.01>", &[directional, spot]),
        ("a ball more", "+", &[directional, spot]),
        ("the first light alone, which knows the ball", "l", &[]),
        ("a ball less", "-", &[directional]),
        ("the spotlight alone", "l", &[spot]),
        ("both", "l", &[]),
        ("no shadows", "s", &[]),
        ("shadows", "s", &[]),
    ] {
        let keys = change.replace(' ', "");
        let found = built(&mut bench, &|bench| bench.press(&keys));
        assert_eq!(found, expected, "{what}");
    }
    let found = built(&mut bench, &|bench| {
        bench.set(&["map_size=512", "spot_bias=0"])
    });
    assert_eq!(found, [""; 0], "settings of the maps");
}

#[test]
fn the_spotlights_buffer_is_built_when_light_or_objects_have_moved() {
    let mut bench = Bench::recorded("aueb7", [64, 64], &["shadow_test=exact"]);
    bench.picture();
    for (what, keys, settings, expected) in [
        ("the eye", "wadrf", &[][..], 0),
        ("the world", "<Left>", &[], 1),
        ("the world, turned", "<RightDrag:9,0>", &[], 1),
        ("wireframe", "<F1>", &[], 0),
        (
            "what only the map has",
            "",
            &["filter=pcf_9", "step=4", "map_size=64"],
            0,
        ),
        ("what lies outside", "", &["outside=lit"], 0),
        ("the light", "<Wait:0.2>", &["rotate_light=on"], 1),
        ("the scene", "", &["scene=pirate"], 1),
    ] {
        let found = built(&mut bench, &|bench| {
            bench.set(settings);
            bench.press(keys);
        });
        assert_eq!(found.len(), expected, "{what}: {found:?}");
    }
}

/// The exercises' filter is a mean of tests of the map: without a map there is none.
#[test]
fn a_filter_of_the_map_has_no_say() {
    let visibility = |settings: &[&str]| Bench::new("aueb7", SIZE, settings).visibility();
    let hard = visibility(&["shadow_test=exact"]);
    let filtered = visibility(&["shadow_test=exact", "filter=pcf_9", "step=5", "map_size=64"]);
    assert_eq!(differing(&hard, &filtered), 0);
    assert!(hard.pixels().all(|pixel| matches!(pixel.0[0], 0 | 255)));
    // The control.
    let [map, filtered] = [&[][..], &["filter=pcf_9"]].map(visibility);
    assert!(differing(&map, &filtered) > 100);
}

/// What lies outside of the beam is dark or lit, as the lab's own setting says; and beyond the map's far plane it is inside.
#[test]
fn outside_of_the_beam_it_is_dark_or_lit() {
    let dark = |settings: &[&str]| {
        let visibility = Bench::new("aueb7", SIZE, settings).visibility();
        visibility.pixels().filter(|pixel| pixel.0[0] == 0).count()
    };
    for scene in ["scene=example", "scene=pirate"] {
        let exact = dark(&[scene, "shadow_test=exact"]);
        let lit = dark(&[scene, "shadow_test=exact", "outside=lit"]);
        assert!(exact > lit + 2000 && lit > 500, "{scene}: {exact} {lit}");
    }
    // The control: without the test nothing is dark.
    assert_eq!(dark(&["shadow_test=exact", "shadows=off"]), 0);
}

/// What the report calls bytes on the GPU has the light buffers in it, and only while the test is chosen.
#[test]
fn the_light_buffers_are_counted_until_another_test_is_chosen() {
    for lab in ["cs541", "csci3260", "cmsc23700", "aueb7"] {
        let mut bench = Bench::recorded(lab, [16, 16], &[]);
        let mut memory = trace::Memory::default();
        let mut buffers = |test: &str| {
            bench.set(&[test]);
            bench.render();
            memory.note(&trace::take()).unwrap();
            memory.bytes().buffers
        };
        let without = buffers("shadow_test=handout");
        let with = buffers("shadow_test=exact");
        // 64² cells of 16 bytes are the least that a light buffer has.
        assert!(with >= without + 65_536, "{lab}: {without} {with}");
        assert_eq!(buffers("shadow_test=handout"), without, "{lab}");
        assert_eq!(buffers("shadow_test=exact"), with, "{lab}");
    }
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    for (lab, other, back) in [
        ("cs541", "light=point", "light=spot"),
        ("csci3260", "scene=room", "scene=course"),
        ("cmsc23700", "lights=spotlight", "lights=both"),
        ("aueb7", "scene=knossos", "scene=example"),
    ] {
        let exact = ["shadow_test=exact"];
        let straight = Bench::new(lab, SIZE, &exact).picture();
        let mut bench = Bench::new(lab, SIZE, &[other]);
        bench.picture();
        bench.set(&exact);
        bench.picture();
        bench.visibility_of(if lab == "cmsc23700" { 2 } else { 1 });
        bench.lab.reload(&bench.context.gl).unwrap();
        bench.set(&[back, "shadow_test=handout"]);
        bench.picture();
        bench.set(&exact);
        assert_eq!(differing(&straight, &bench.picture()), 0, "{lab}");
        // Where the map shows its texels, the exact test does not: the pictures are two.
        let map = Bench::new(lab, SIZE, &[]).picture();
        assert!(differing(&straight, &map) > 20, "{lab}");
    }
}

/// Far from the origin everything is the same, balls or none.
#[test]
fn two_lights_far_from_the_origin_have_the_same_shadows() {
    let visibilities = |scene: Scene| {
        let settings = ["shadow_test=exact", "balls=0"];
        let mut bench = Bench::with_scene("cmsc23700", scene, SIZE, &settings);
        [1, 2].map(|light| bench.visibility_of(light))
    };
    let here = visibilities(default_scene("cmsc23700"));
    let offset = 1e6 * glam::dvec3(1.0, -2.0, 0.5);
    let there = visibilities(default_scene("cmsc23700").moved(offset));
    for (here, there) in here.iter().zip(&there) {
        assert!(differing(here, there) < 5);
    }
}
