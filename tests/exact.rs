//! `shadow_test=exact` in the labs: against the truth, against the handout's own shaders, and what it does not have.

mod common;
mod hard;

use std::process::Command;

use common::{Bench, differing};
use hard::{Case, cases, five_shapes};
use shadowlab::gl::trace;
use shadowlab::ground_truth::Rays;
use shadowlab::labs;
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::{LightKind, Scene};

const SIZE: [u32; 2] = [320, 240];

/// The lab that draws a scene's light.
fn lab_for(scene: &Scene) -> &'static str {
    match scene.lights[0].kind {
        LightKind::Directional { .. } => "csci3260",
        _ => "cs541",
    }
}

fn figures(lab: &str, scene: Scene, settings: &[&str]) -> Figures {
    let mut bench = Bench::with_scene(lab, scene, SIZE, settings);
    let visibility = bench.visibility();
    let rays = Rays::new(&bench.lab.now(), 0);
    let truth = rays.truth(SIZE);
    let map = bench.map_scale();
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
    let states: [(&str, Scene, &[&str]); 9] = [
        ("cs541", default_scene("cs541"), &[]),
        ("cs541", default_scene("cs541"), &["beam=circular"]),
        ("cs541", default_scene("cs541"), &["light=point"]),
        ("cs541", default_scene("cs541"), &["spot_angle=150"]),
        ("cs541", default_scene("cs541"), &["spot_angle=170"]),
        ("cs541", five_shapes(), &[]),
        ("cs541", five_shapes(), &["light=point"]),
        ("csci3260", default_scene("csci3260"), &[]),
        ("csci3260", default_scene("csci3260"), &["scene=room"]),
    ];
    for (lab, scene, settings) in states {
        let exact = [settings, &["shadow_test=exact"]].concat();
        let found = figures(lab, scene.clone(), &exact);
        assert_eq!(wrong(&found), [0, 0], "{lab} {settings:?}: {found}");
        assert!(found.ambiguous < 40, "{lab} {settings:?}: {found}");
        assert!(found.shadowed > 500, "{lab} {settings:?}: {found}");
        // The control: the handout's map cannot be that good.
        let map = figures(lab, scene, settings);
        assert!(
            wrong(&map).iter().sum::<usize>() > 5,
            "{lab} {settings:?}: {map}"
        );
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

/// The lines of a shader that are no comments.
fn lines(text: &str) -> Vec<String> {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap().trim());
    lines
        .filter(|line| !line.is_empty())
        .map(str::to_owned)
        .collect()
}

/// The lines without those of the shadow test, which have one of these words.
fn without(text: &str, words: &[&str]) -> Vec<String> {
    let is_of_the_test = |line: &String| words.iter().any(|word| line.contains(word));
    let mut lines = lines(text);
    lines.retain(|line| !is_of_the_test(line));
    lines
}

#[test]
fn the_shaders_differ_from_the_handouts_in_the_test_alone() {
    let read = |path: &str| std::fs::read_to_string(format!("glsl/{path}")).unwrap();
    let cs541 = [
        "shadow_",
        "in_shadow =",
        "bool shadows",
        "position_lcs",
        "first_triangle",
        "epsilon",
        "point_depth",
        "uv.",
        "inside_beam =",
        "if (beam == CIRCULAR)",
        "light_vector) > 0",
    ];
    let vertex = [
        "shadow_",
        "position_lcs",
        "light_model_matrix",
        "mat4 B",
        "0.5",
        "vshadow_position",
    ];
    let csci3260 = [
        "shadowMap",
        "bool shadows",
        "!shadows",
        "in_shadow",
        "stage",
        "NO_BIAS",
        "bias",
        "biasValue",
        "taps",
        "texel",
        "float visibility =",
        "visibility = ",
        "visibility -= ",
        "firstTriangle",
        "cosTheta",
        "for (int i",
        "dot(n, l) > 0",
        "}",
    ];
    for (handouts, exact, words) in [
        (
            "cs541/lighting.frag",
            "cs541/lighting_exact.frag",
            &cs541[..],
        ),
        ("cs541/lighting.vert", "cs541/lighting_lcs.vert", &vertex),
        (
            "csci3260/FragmentShaderCode.glsl",
            "csci3260/FragmentShaderCode_exact.glsl",
            &csci3260,
        ),
    ] {
        let (handouts, text) = (read(handouts), read(exact));
        assert_ne!(lines(&handouts), lines(&text), "{exact}");
        assert_eq!(without(&handouts, words), without(&text, words), "{exact}");
        assert!(without(&text, words).len() > 18, "{exact}");
        // The control: a line of the lighting, edited.
        let edited = match exact.ends_with(".vert") {
            true => text.replace("eye_position - world", "world"),
            false => text.replace("normalize(", "("),
        };
        assert_ne!(
            without(&handouts, words),
            without(&edited, words),
            "{exact}"
        );
    }
    // What the visibility asks is what the lighting asks, but for the surfaces that are dark anyway.
    for (lighting, visibility, dark) in [
        (
            "cs541/lighting_exact.frag",
            "cs541/visibility_exact.frag",
            &["dot(normal_vector, light_vector) > 0"][..],
        ),
        (
            "csci3260/FragmentShaderCode_exact.glsl",
            "csci3260/visibility_exact.frag",
            &["dot(n, l) > 0"],
        ),
    ] {
        let (lighting, visibility) = (lines(&read(lighting)), lines(&read(visibility)));
        let of_the_test = |line: &&String| {
            [
                "inside_beam",
                "in_shadow_of",
                "float visibility",
                "visibility = 0.5",
            ]
            .iter()
            .any(|word| line.contains(word))
                && !line.contains("illuminated")
                && !line.contains("visibilitySpecular")
                && !dark.iter().any(|word| line.contains(word))
                && !line.contains("if (inside_beam || beam == NO_BEAM)")
        };
        let [a, b] = [&lighting, &visibility]
            .map(|lines| lines.iter().filter(of_the_test).collect::<Vec<_>>());
        assert!(a.len() >= 3);
        assert_eq!(a, b);
    }
}

#[test]
fn there_is_no_map_to_show_or_to_explain() {
    for lab in ["cs541", "csci3260"] {
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

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let exact = ["shadow_test=exact"];
    let straight = Bench::new("cs541", SIZE, &exact).picture();
    let mut bench = Bench::new("cs541", SIZE, &["light=point"]);
    bench.picture();
    bench.set(&exact);
    bench.picture();
    bench.visibility();
    bench.lab.reload(&bench.context.gl).unwrap();
    bench.set(&["light=spot", "shadow_test=handout"]);
    bench.picture();
    bench.set(&exact);
    assert_eq!(differing(&straight, &bench.picture()), 0);
    // Where the map shows its texels, the exact test does not: the pictures are two.
    let map = Bench::new("cs541", SIZE, &[]).picture();
    assert!(differing(&straight, &map) > 50);
}
