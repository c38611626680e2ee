//! What the handout promises, held against the lab's pictures.

mod common;

use common::{Bench, differing, work_folder};
use glam::{DMat4, DVec3, dvec3};
use image::{GrayImage, RgbImage};
use shadowlab::ground_truth::Rays;
use shadowlab::labs::{self, Key};
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::{Light, LightKind, Material, Object, Scene, rotate, shapes};

const SIZE: [u32; 2] = [320, 320];
const WALLS: [&str; 5] = ["floor", "left", "right", "ceiling", "rear"];

fn course() -> Scene {
    (labs::find("eecs487").unwrap().scene)().unwrap()
}

fn bench(settings: &[&str]) -> Bench {
    Bench::new("eecs487", SIZE, settings)
}

fn with_scene(scene: Scene, settings: &[&str]) -> Bench {
    Bench::with_scene("eecs487", scene, SIZE, settings)
}

fn lit_from(light: DVec3) -> Scene {
    let mut scene = course();
    scene.lights[0].position = light;
    scene
}

/// The lab's shadows against the truth.
fn figures(bench: &mut Bench) -> Figures {
    let visibility = bench.visibility();
    against_truth(bench, &visibility)
}

fn against_truth(bench: &Bench, visibility: &GrayImage) -> Figures {
    let rays = Rays::new(&bench.lab.now(), 0);
    let truth = rays.truth(bench.size);
    Measure::new(&rays, &truth).measure(visibility, None).0
}

fn wrong(figures: &Figures) -> usize {
    figures.false_shadow.total() + figures.false_light.total()
}

fn count(picture: &RgbImage, color: [u8; 3]) -> usize {
    picture.pixels().filter(|pixel| pixel.0 == color).count()
}

// ---- 1. Hard shadows ----

/// What was measured on the running lab.
#[test]
fn the_default_picture_is_the_courses() {
    let picture = Bench::new("eecs487", [600, 600], &[]).picture();
    assert_eq!(
        picture.get_pixel(310, 85).0,
        [103, 181, 206],
        "the hot spot"
    );
    assert_eq!(picture.get_pixel(310, 171).0, [255, 255, 204], "the light");
    let corner = picture.get_pixel(0, 0).0;
    for (found, measured) in corner.into_iter().zip([39_u8, 68, 78]) {
        assert!(found.abs_diff(measured) <= 3, "{corner:?}");
    }
    // Teapot and torus alone have such colors; left, top, right and bottom of each.
    let bounds = |belongs: fn([u8; 3]) -> bool| {
        let pixels = picture
            .enumerate_pixels()
            .filter(|(.., pixel)| belongs(pixel.0));
        pixels.fold([600, 600, 0, 0], |[left, top, right, bottom], (x, y, _)| {
            [left.min(x), top.min(y), right.max(x), bottom.max(y)]
        })
    };
    let near = |found: [u32; 4], measured: [u32; 4]| {
        let apart = found.into_iter().zip(measured).map(|(a, b)| a.abs_diff(b));
        assert!(apart.max() <= Some(2), "{found:?}, measured {measured:?}");
    };
    let teapot = bounds(|[r, g, b]| b > 30 && i32::from(b) > 17 * i32::from(r) / 10 && r > g);
    near(teapot, [188, 241, 293, 292]);
    let torus = bounds(|[r, g, b]| r > 30 && i32::from(r) > 17 * i32::from(g) / 10 && g > b);
    near(torus, [238, 238, 359, 359]);
}

/// Overlapping shadows are no darker than one: each wall has a single color in shadow.
#[test]
fn a_shadow_is_three_tenths_of_its_wall() {
    let mut scene = course();
    // Two sheets, one over the other, and torus and teapot over both.
    for height in [-0.3, -0.5] {
        let sheet = DMat4::from_translation(dvec3(0.1, height, 0.0))
            * rotate(-90.0, DVec3::X)
            * DMat4::from_scale(DVec3::splat(0.3));
        scene.objects.push(Object::new(
            "sheet",
            shapes::plane(3),
            sheet,
            Material::default(),
        ));
    }
    let mut bench = with_scene(scene, &[]);
    let picture = bench.picture();
    let visibility = bench.visibility();
    let colors = [[31, 61, 54], [61, 54, 31], [54, 61, 31], [61, 31, 54]];
    let shadowed = visibility.pixels().filter(|pixel| pixel.0[0] == 0).count();
    let found: usize = colors.map(|color| count(&picture, color)).iter().sum();
    assert!(
        shadowed > 5000 && found.abs_diff(shadowed) < 20,
        "{found}, {shadowed}"
    );
    for color in &colors[..2] {
        assert!(count(&picture, *color) > 500, "{color:?}");
    }
}

#[test]
fn no_pixel_of_a_wall_is_wrong() {
    let mut shadowed = 0;
    let mut check = |bench: &mut Bench, what: &str| {
        let found = figures(bench);
        assert_eq!(wrong(&found), 0, "{what}\n{found}");
        assert!(found.ambiguous < 200, "{what}: {found}");
        shadowed += found.shadowed;
    };
    for clipping in ["stencil_clipping=off", "stencil_clipping=on"] {
        for shown in ["all"].iter().chain(&WALLS) {
            let shown = format!("clipped_to={shown}");
            check(
                &mut bench(&[clipping, &shown]),
                &format!("{clipping} {shown}"),
            );
        }
        for keys in [
            "rrrr",
            "rrrrrrrrrrrrrrrrrrrr",
            "jjjjjjjjjjjjjjjjjjjjhhhhhhhhhh",
            "WWWW",
        ] {
            let mut bench = bench(&[clipping]);
            bench.press(keys);
            check(&mut bench, &format!("{clipping} {keys}"));
        }
    }
    assert!(shadowed > 100_000, "{shadowed}");

    // The controls: another light, and no shadows.
    let bench = bench(&[]);
    let other = with_scene(lit_from(dvec3(0.07, 0.6, 0.2)), &[]).visibility();
    assert!(wrong(&against_truth(&bench, &other)) > 100);
    let none = GrayImage::from_pixel(SIZE[0], SIZE[1], image::Luma([255]));
    assert!(against_truth(&bench, &none).false_light.interior > 3000);
}

/// A plate that floats, or stands, somewhere in the room.
fn plate(centre: DVec3, half: DVec3, turn: DMat4) -> Object {
    let placement = DMat4::from_translation(centre) * turn * DMat4::from_scale(2.0 * half);
    Object::new("plate", shapes::cube(), placement, Material::default())
}

fn room_with(light: DVec3, plates: Vec<Object>) -> Scene {
    let mut scene = lit_from(light);
    scene
        .objects
        .retain(|object| !["torus", "teapot"].contains(&object.name.as_str()));
    scene.objects.extend(plates);
    scene
}

#[test]
fn hard_places_of_the_light_are_right() {
    let flat = dvec3(0.2, 0.0002, 0.3);
    let upright = dvec3(0.02, 0.5, 0.3);
    let level = DMat4::IDENTITY;
    let tilted = rotate(25.0, dvec3(0.3, 0.2, 1.0));
    let cases = [
        (
            "1e-3 above the floor, beside what lies below it",
            room_with(
                dvec3(0.5, -0.999, 0.1),
                vec![plate(dvec3(-0.1, -0.9997, 0.0), flat, level)],
            ),
            true,
        ),
        (
            "1e-3 before the rear wall",
            room_with(
                dvec3(0.2, 0.3, -0.999),
                vec![plate(
                    dvec3(0.1, 0.1, -0.9998),
                    dvec3(0.03, 0.05, 0.0001),
                    level,
                )],
            ),
            true,
        ),
        (
            "in the floor's plane: it lights nothing of it",
            room_with(
                dvec3(0.0, -1.0, 0.0),
                vec![plate(dvec3(0.4, -0.7, 0.0), upright, level)],
            ),
            true,
        ),
        (
            "a caster through the light's planes",
            room_with(
                dvec3(0.1, 0.1, 0.1),
                vec![plate(dvec3(0.0, 0.1, -0.3), dvec3(0.9, 0.01, 0.1), tilted)],
            ),
            true,
        ),
        (
            "a caster that goes through the floor",
            room_with(
                dvec3(0.1, 0.7, 0.1),
                vec![plate(dvec3(-0.3, -1.0, 0.0), upright, tilted)],
            ),
            true,
        ),
        (
            "a caster all around the light",
            room_with(
                dvec3(0.1, 0.1, 0.1),
                vec![plate(dvec3(0.1, 0.1, 0.1), dvec3(0.2, 0.2, 0.2), tilted)],
            ),
            true,
        ),
        (
            "grazing: the light hangs low, casters stand up",
            room_with(
                dvec3(0.8, -0.9, 0.6),
                vec![plate(
                    dvec3(-0.2, -0.95, 0.0),
                    dvec3(0.02, 0.05, 0.2),
                    level,
                )],
            ),
            true,
        ),
        (
            "a caster beyond the light has no anti-shadow on the floor",
            room_with(
                dvec3(0.0, -0.5, 0.0),
                vec![plate(dvec3(0.0, 1.5, 0.0), dvec3(0.2, 0.2, 0.2), level)],
            ),
            false,
        ),
    ];
    for (what, scene, shadows) in cases {
        for clipping in ["stencil_clipping=off", "stencil_clipping=on"] {
            let found = figures(&mut with_scene(scene.clone(), &[clipping]));
            println!("{what}, {clipping}: wrong {}, {found}", wrong(&found));
            assert_eq!(wrong(&found), 0, "{what}, {clipping}\n{found}");
            assert_eq!(found.shadowed > 0, shadows, "{what}\n{found}");
        }
    }
}

/// The control of the above: who divides by w too early makes anti-shadows of what lies beyond the light.
#[test]
fn dividing_by_w_early_is_noticed() {
    let folder = work_folder("eecs487-early");
    let shader = include_str!("../glsl/eecs487/shadow.vert");
    let early = shader.replace(
        "    // DEVIATES",
        "    gl_Position = gl_Position.w < 0 ? -gl_Position : gl_Position;\n    // DEVIATES",
    );
    assert_ne!(shader, early);
    std::fs::write(folder.join("shadow.vert"), early).unwrap();
    let mut bench = Bench::with_glsl("eecs487", &folder, SIZE);
    assert!(figures(&mut bench).false_shadow.interior > 500);
}

/// Wherever the light is, no shadow fights with its wall, nor with itself: the depth is the plane's own.
#[test]
fn no_shadow_flickers() {
    let flicker = |bench: &mut Bench| {
        let found = figures(bench);
        found.false_light.interior + found.false_shadow.interior
    };
    let lights = || {
        let steps = (0..12).map(f64::from);
        steps.map(|i| {
            dvec3(
                0.9 * (1.7 * i).sin(),
                0.9 * (2.3 * i).cos(),
                -0.94 + 0.12 * i,
            )
        })
    };
    for light in lights() {
        assert_eq!(flicker(&mut with_scene(lit_from(light), &[])), 0, "{light}");
    }
    // The control: the depths of the projected triangles, as near as the handout's shadows are without an offset.
    let folder = work_folder("eecs487-flicker");
    let shader = include_str!("../glsl/eecs487/shadow.frag");
    let lines: Vec<_> = shader
        .lines()
        .filter(|line| !line.contains("gl_FragDepth"))
        .collect();
    let fights = lines.join("\n").replace(
        "vec4(shadowColor, 1)",
        "vec4(shadowColor, 1) + 1e-20 * planeDepth.x",
    );
    std::fs::write(folder.join("shadow.frag"), fights).unwrap();
    let mut bench = Bench::with_glsl("eecs487", &folder, SIZE);
    assert!(flicker(&mut bench) > 500);
}

#[test]
fn a_large_a_small_and_a_far_room_have_the_same_shadows() {
    let here = figures(&mut bench(&[]));
    let scaled = |factor: f64| {
        let mut scene = course();
        let scale = DMat4::from_scale(DVec3::splat(factor));
        for object in &mut scene.objects {
            object.placement = scale * object.placement;
        }
        scene.camera.eye *= factor;
        scene.camera.near *= factor;
        scene.camera.far = scene.camera.far.map(|far| far * factor);
        scene.lights[0].position *= factor;
        scene
    };
    let check = |scene: Scene, what: &str| {
        let found = figures(&mut with_scene(scene, &[]));
        assert_eq!(wrong(&found), 0, "{what}\n{found}");
        // The sphere around the light keeps its size, and hides more or less of the rear wall.
        assert!(found.lit.abs_diff(here.lit) < 500, "{what}\n{found}");
        assert!(
            found.shadowed.abs_diff(here.shadowed) < 5,
            "{what}\n{found}"
        );
    };
    check(scaled(1e4), "1e4 times as large");
    check(scaled(1e-4), "1e-4 times as large");
    check(course().moved(dvec3(1e5, -2e5, 0.5e5)), "moved");

    // The control: what an f32 world would do to the light, 1e5 from the origin.
    let moved = with_scene(lit_from(dvec3(0.05 + 1.0 / 128.0, 0.6, 0.2)), &[]).visibility();
    assert!(wrong(&against_truth(&bench(&[]), &moved)) > 100);
}

// ---- 2. Clipping ----

/// Unclipped, shadows extend beyond the edges of the only wall; clipped they do not. In the full room only pixels on the
/// seams can differ.
#[test]
fn the_stencil_clips_at_the_walls_edges() {
    let picture = |shown: &str, clipping: &str| bench(&[shown, clipping]).picture();
    let shadow = [31, 61, 54];
    let [off, on] = ["stencil_clipping=off", "stencil_clipping=on"];
    let unclipped = count(&picture("clipped_to=floor", off), shadow);
    let clipped = count(&picture("clipped_to=floor", on), shadow);
    let full = count(&picture("clipped_to=all", on), shadow);
    assert!(unclipped > clipped + 500, "{unclipped}, {clipped}");
    assert_eq!(clipped, full);
    let seams = differing(
        &picture("clipped_to=all", off),
        &picture("clipped_to=all", on),
    );
    assert!(seams < 600, "{seams}");
}

// ---- Table 1 ----

#[test]
fn every_key_does_what_the_table_says() {
    let after = |keys: &str| {
        let mut bench = bench(&[]);
        bench.press(keys);
        bench
    };
    let light = |keys: &str| after(keys).lab.now().lights[0].position;
    let start = dvec3(0.05, 0.6, 0.2);
    for (key, step) in [
        ("h", dvec3(-0.02, 0.0, 0.0)),
        ("l", dvec3(0.02, 0.0, 0.0)),
        ("j", dvec3(0.0, -0.02, 0.0)),
        ("k", dvec3(0.0, 0.02, 0.0)),
        ("w", dvec3(0.0, 0.0, -0.02)),
        ("s", dvec3(0.0, 0.0, 0.02)),
    ] {
        assert!((light(key) - start).distance(step) < 1e-12, "{key}");
    }
    let number = |keys: &str, name: &str| after(keys).lab.settings().number(name);
    assert_eq!(number("+", "num_jitters"), 3.0);
    assert_eq!(number("-----", "num_jitters"), 1.0, "at least 1");
    assert!((number("a", "jitter_amount") - 0.010).abs() < 1e-15);
    assert!((number("d", "jitter_amount") - 0.008).abs() < 1e-15);
    assert_eq!(number("dddddddddddd", "jitter_amount"), 0.0);
    assert_eq!(number("T", "tessellation"), 24.0);
    assert_eq!(number("tttt", "tessellation"), 0.0);
    let eye = |keys: &str| after(keys).lab.now().camera.eye.z;
    assert!((eye("W") - 2.9).abs() < 1e-12 && (eye("S") - 3.1).abs() < 1e-12);
    assert_eq!([eye(&"W".repeat(99)), eye(&"S".repeat(99))], [1.0, 6.0]);
    assert!(after("f").lab.settings().switch("soft_shadows"));
    assert!(!after("ff").lab.settings().switch("soft_shadows"));
    assert!(after("c").lab.settings().switch("stencil_clipping"));
    let cycle = ["floor", "left", "right", "ceiling", "rear", "all"];
    for presses in 1..=7 {
        let shown = |key: &str| {
            after(&key.repeat(presses))
                .lab
                .settings()
                .choice("clipped_to")
        };
        assert_eq!(shown("x"), cycle[(presses - 1) % 6]);
        assert_eq!(shown("X"), cycle[(11 - presses) % 6]);
    }
    let placement = |keys: &str| {
        let scene = after(keys).lab.now();
        scene
            .objects
            .iter()
            .find(|o| o.name == "torus")
            .unwrap()
            .placement
    };
    assert!(placement("r") != placement("") && placement("rr") != placement("r"));
    assert!(after("").lab.key(Key::Char('q')), "quit");
    assert!(
        !after("").lab.key(Key::Char('z')),
        "the control: a key of no meaning"
    );
}

#[test]
fn keys_of_the_table_change_the_picture() {
    let handout = labs::find("eecs487").unwrap();
    let mut changing = 0;
    for key in handout.keys.iter().flat_map(|(keys, _)| keys.split(' ')) {
        // What only soft shadows show; the room's seams; the handout's own key to end.
        let before = match key {
            "-" | "+" | "d" | "a" => "faaaaaaaaaaaaaaaaaaaaa",
            "c" => "x",
            "f" => "aaaaaaaaaaaaaaaaaaaaa",
            _ => "",
        };
        let picture = |keys: &str| {
            let mut bench = bench(&[]);
            bench.press(keys);
            bench.picture()
        };
        let differ = differing(&picture(before), &picture(&format!("{before}{key}")));
        assert_eq!(differ > 50, key != "q", "{key}: {differ}");
        changing += usize::from(differ > 0);
    }
    assert_eq!(changing, 19);
}

/// "Light limits: left/right ±.95, down −.94, up .94, back −.94; forward is not limited."
#[test]
fn the_light_stops_before_every_wall() {
    let light = |key: &str| {
        let mut bench = bench(&[]);
        bench.press(&key.repeat(150));
        let found = figures(&mut bench);
        assert_eq!(wrong(&found), 0, "{key}: {found}");
        bench.lab.now().lights[0].position
    };
    assert!((light("h").x + 0.95).abs() < 1e-9);
    assert!((light("l").x - 0.95).abs() < 1e-9);
    assert!((light("j").y + 0.94).abs() < 1e-9);
    assert!((light("k").y - 0.94).abs() < 1e-9);
    assert!((light("w").z + 0.94).abs() < 1e-9);
    assert!((light("s").z - 3.2).abs() < 1e-9);
}

/// Nothing breaks at the end of any range, and what was there before comes back.
#[test]
fn keys_held_down_break_nothing() {
    let mut bench = Bench::new("eecs487", [64, 64], &["soft_method=fast"]);
    let before = bench.picture();
    bench.press(&format!("f{}", "+".repeat(300)));
    assert_eq!(bench.lab.settings().number("num_jitters"), 302.0);
    bench.picture();
    bench.press(&format!("{}{}", "-".repeat(300), "T".repeat(40)));
    assert_eq!(bench.lab.settings().number("tessellation"), 256.0);
    bench.picture();
    bench.press(&"t".repeat(40));
    assert_eq!(bench.lab.settings().number("tessellation"), 0.0);
    bench.picture();
    bench.press("TTfa");
    bench.press(&"d".repeat(30));
    bench.picture();
    bench.press("aaaaaaaaa");
    assert_eq!(differing(&before, &bench.picture()), 0);
}

// ---- What else the lab takes ----

#[test]
fn every_setting_is_read() {
    let changes = |base: &[&str], setting: &str| {
        let before = bench(base).picture();
        differing(&before, &bench(&[base, &[setting]].concat()).picture()) > 0
    };
    let soft = &["soft_shadows=on", "jitter_amount=0.05"][..];
    for (base, setting) in [
        (&[][..], "scene=ramp"),
        (&[], "clipped_to=rear"),
        (&["clipped_to=floor"], "stencil_clipping=on"),
        (&["jitter_amount=0.05"], "soft_shadows=on"),
        (soft, "num_jitters=5"),
        (soft, "jitter_amount=0.06"),
        (soft, "jitter=low-discrepancy"),
        (soft, "first_jitter=1"),
        (soft, "soft_method=fast"),
        (soft, "accumulator=S8"),
        (&["scene=ramp"], "accumulator=RGBA8"),
        (
            &["scene=ramp", "accumulator=S8"],
            "accumulation=sum_then_divide",
        ),
        (&[], "tessellation=3"),
    ] {
        assert!(changes(base, setting), "{base:?} {setting}");
    }
    // The control: hard shadows ask for no jitter.
    assert!(!changes(&[], "num_jitters=5"));
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let soft = ["soft_shadows=on", "jitter_amount=0.05", "num_jitters=3"];
    let straight = bench(&soft).picture();
    let mut bench = bench(&["scene=ramp", "accumulator=S8"]);
    bench.picture();
    bench.set(&[
        "scene=room",
        "soft_shadows=on",
        "soft_method=fast",
        "num_jitters=40",
    ]);
    bench.picture();
    bench.set(&["accumulator=RGB32F", "soft_method=handout"]);
    bench.set(&soft);
    bench.press("xlhcX");
    bench.visibility();
    bench.press("c");
    assert_eq!(differing(&straight, &bench.picture()), 0);
}

#[test]
fn there_is_no_shadow_map() {
    let error = bench(&[]).lab.shadow_texture(1).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains("no shadow map"), "{error}");
    let mut ramp = bench(&["scene=ramp"]);
    let shown = ramp
        .lab
        .render(&ramp.context.gl, labs::Show::Visibility { light: 1 });
    assert!(shown.unwrap_err().to_string().contains("scene=room"));
}

/// The room stays; objects and light are the student's.
#[test]
fn a_students_objects_come_into_the_room() {
    let mut scene = course();
    let cube =
        DMat4::from_translation(dvec3(0.0, -0.4, 0.0)) * DMat4::from_scale(DVec3::splat(0.5));
    scene.objects = vec![Object::new(
        "cube",
        shapes::cube(),
        cube,
        Material::default(),
    )];
    scene.lights[0].position = dvec3(0.3, 0.5, 0.3);
    let mut bench = with_scene(scene, &[]);
    let found = figures(&mut bench);
    assert_eq!(wrong(&found), 0, "{found}");
    assert!(found.lit > 50_000 && found.shadowed > 3000, "{found}");
    let names: Vec<_> = bench
        .lab
        .now()
        .objects
        .iter()
        .map(|o| o.name.clone())
        .collect();
    assert!(names.contains(&"ceiling".to_owned()) && names.contains(&"cube".to_owned()));
}

#[test]
fn another_kind_of_light_is_refused() {
    let context = bench(&[]).context;
    let refused = |lights: Vec<Light>| {
        let scene = Scene { lights, ..course() };
        let started = (labs::find("eecs487").unwrap().start)(&context.gl, scene, None);
        started.err().unwrap().to_string()
    };
    let directional = Light {
        kind: LightKind::Directional {
            area: [-1.0, 1.0, -1.0, 1.0],
        },
        ..course().lights[0].clone()
    };
    assert!(refused(vec![directional]).contains("expected point"));
    assert!(refused(vec![]).contains("0 lights"));
}
