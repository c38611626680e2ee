//! What the handout promises and what the course's program showed, held against the lab's pictures.

mod common;

use common::{Bench, differing, work_folder};
use glam::{DMat4, DVec3, dvec3};
use image::GrayImage;
use shadowlab::ground_truth::Rays;
use shadowlab::labs;
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::{Light, LightKind, Scene, Spin};

const SCENES: [&str; 3] = ["scene=example", "scene=pirate", "scene=knossos"];
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
        (&[], "shadow_test=offset"),
        (&["shadow_test=offset"], "filter=pcf_5"),
        (&["shadow_test=offset", "filter=pcf_5"], "filter=pcf_9"),
        (&["shadow_test=offset"], "outside=lit"),
        (&[], "shadow_test=exact"),
        (&["shadow_test=exact"], "outside=lit"),
        (&[], "shadows=off"),
    ] {
        assert!(changes(base, setting), "{setting}");
    }
    // The control: what has no say in the hard test.
    assert!(!changes(&[], "step=1"));
    for without_effect in ["constant_depth_bias=0.001", "step=1"] {
        let offset = ["shadow_test=offset", "filter=pcf_5"];
        assert!(!changes(&offset, without_effect), "{without_effect}");
    }

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
    let handouts = {
        let mut bench = bench(&hard);
        [bench.visibility().into_raw(), bench.picture().into_raw()]
    };
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
    // The first context is no longer current, since others came after it.
    let fresh = Bench::new("aueb7", SIZE, &[]);
    let started = start(&fresh.context.gl, example(), Some(&folder));
    let told = started.err().unwrap().to_string();
    let line = 1 + own
        .lines()
        .position(|line| line.contains("return 1.0;"))
        .unwrap();
    let place = format!("is_point_in_shadow.frag:{line}: does not compile");
    assert!(told.contains(&place), "{told}");
    // A file without one of the functions does not link.
    std::fs::write(&path, own.replace("pcf_9(", "pcf_8(")).unwrap();
    let started = start(&fresh.context.gl, example(), Some(&folder));
    let told = started.err().unwrap().to_string();
    assert!(
        told.contains("does not link") && told.contains("pcf_9"),
        "{told}"
    );
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
