//! `shadow_test=offset` in the labs: against the truth, with each of its parts taken away in turn, and when its map is
//! drawn. On the hard cases it is one of the tests of `hard_cases.rs`.

mod common;
mod hard;

use std::path::PathBuf;
use std::process::Command;

use common::{Bench, differing, work_folder};
use hard::five_shapes;
use shadowlab::gl::trace;
use shadowlab::ground_truth::Rays;
use shadowlab::measure::{Figures, Measure};
use shadowlab::scene::Scene;
use shadowlab::{hard as hard_cases, labs};

const SIZE: [u32; 2] = [320, 240];
const OFFSET: &str = "shadow_test=offset";

fn default_scene(lab: &str) -> Scene {
    (labs::find(lab).unwrap().scene)().unwrap()
}

fn figures(bench: &mut Bench) -> Figures {
    figures_of(1, bench)
}

/// Of a light, counted from 1.
fn figures_of(light: usize, bench: &mut Bench) -> Figures {
    let visibility = bench.visibility_of(light);
    let rays = Rays::new(&bench.lab.now(), light - 1);
    let truth = rays.truth(bench.size);
    let map = bench.lab.shadow_texture(light).unwrap().scale;
    Measure::new(&rays, &truth)
        .measure(&visibility, Some(&map))
        .0
}

/// Wrong pixels that no edge of a shadow excuses.
fn interior(figures: &Figures) -> [usize; 2] {
    [figures.grey, figures.false_light.interior]
}

type State = (&'static str, fn() -> Scene, &'static [&'static str]);

const STATES: [State; 12] = [
    ("cs541", || default_scene("cs541"), &[OFFSET]),
    (
        "cs541",
        || default_scene("cs541"),
        &[OFFSET, "beam=circular"],
    ),
    (
        "cs541",
        || default_scene("cs541"),
        &[OFFSET, "depth_format=16"],
    ),
    ("cs541", five_shapes, &[OFFSET]),
    ("cs541", five_shapes, &[OFFSET, "map_size=256"]),
    ("csci3260", || default_scene("csci3260"), &[OFFSET]),
    (
        "csci3260",
        || default_scene("csci3260"),
        &[OFFSET, "scene=room"],
    ),
    (
        "csci3260",
        || default_scene("csci3260"),
        &[OFFSET, "scene=room", "stage=pcf"],
    ),
    // Even at the exercises' 128 texels; but a filter that is wider than a texel is seen beside the edge there.
    ("aueb7", || default_scene("aueb7"), &[OFFSET]),
    (
        "aueb7",
        || default_scene("aueb7"),
        &[OFFSET, "map_size=512"],
    ),
    (
        "aueb7",
        || default_scene("aueb7"),
        &[OFFSET, "map_size=512", "filter=pcf_5"],
    ),
    (
        "aueb7",
        || default_scene("aueb7"),
        &[OFFSET, "map_size=1024", "filter=pcf_9"],
    ),
];

#[test]
fn nothing_is_wrong_off_the_shadows_edges() {
    for (lab, scene, settings) in STATES {
        let mut bench = Bench::with_scene(lab, scene(), SIZE, settings);
        let found = figures(&mut bench);
        assert_eq!(interior(&found), [0, 0], "{lab} {settings:?}: {found}");
        assert!(found.shadowed > 500, "{lab} {settings:?}: {found}");
    }
}

/// Each of two lights has a fitted map of its own; the balls are one mesh, drawn once, and each casts.
#[test]
fn nothing_is_wrong_under_either_light() {
    for balls in ["balls=0", "balls=20", "balls=100"] {
        let mut bench = Bench::new("cmsc23700", SIZE, &[balls]);
        for light in [1, 2] {
            for (time, size) in [(0.0, "map_size=1024"), (1.3, "map_size=512")] {
                bench.lab.advance(time);
                bench.set(&[size, OFFSET]);
                let found = figures_of(light, &mut bench);
                let of = format!("{balls} {size}, light {light}: {found}");
                assert_eq!(interior(&found), [0, 0], "{of}");
                assert!(found.shadowed > 100 || balls == "balls=0", "{of}");
                // The control: the handout's map, which needs its bias.
                bench.set(&["directional_bias=0", "spot_bias=0"]);
                assert_eq!(found, figures_of(light, &mut bench), "{of}");
                bench.set(&["shadow_test=handout"]);
                let map = figures_of(light, &mut bench);
                assert!(map.grey > 1000, "{of}, without bias: {map}");
            }
        }
    }
}

/// A folder with one shader file, edited; the text that is replaced is in it.
fn edited(name: &str, file: &str, from: &str, to: &str) -> PathBuf {
    let folder = work_folder(name);
    let text = std::fs::read_to_string(format!("glsl/{file}")).unwrap();
    assert!(text.contains(from), "{from}");
    let path = folder.join(file);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text.replace(from, to)).unwrap();
    folder
}

/// The controls: without one of its two rules the test has false shadow where with both it has none.
#[test]
fn each_rule_is_needed() {
    const TEST: &str = "shadow_tests/offset.frag";
    const BOTH: &str = "depth_at_centre <= stored || depth <= stored";
    // Of the caster's slope alone, a steep side beside a flat one knows too little; of the receiver's plane alone, a
    // steep side that meets another one.
    for (name, rule, case, least) in [
        ("offset_caster", "depth <= stored", "here", 15),
        ("offset_receiver", "depth_at_centre <= stored", "corner", 3),
    ] {
        let folder = edited(name, TEST, BOTH, rule);
        let scene = (hard_cases::find(case).unwrap().scene)();
        let size = hard_cases::SIZE;
        let off_edge = |mut bench: Bench| {
            let wrong = figures(&mut bench).false_shadow;
            wrong.interior + wrong.edge_t
        };
        let with = Bench::with_scene("cs541", scene.clone(), size, &[OFFSET]);
        assert_eq!(off_edge(with), 0, "{case}");
        let without = Bench::with_scene_and_glsl("cs541", scene, &folder, size, &[OFFSET]);
        let found = off_edge(without);
        assert!(found >= least, "{rule}: {case}: {found}");
    }
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

/// Where the exact test's shaders are the handout's but for the test, so are these: a test holds those.
#[test]
fn the_shaders_differ_from_those_of_the_exact_test_in_the_test_alone() {
    let read = |path: &str| std::fs::read_to_string(format!("glsl/{path}")).unwrap();
    let of_the_test = [
        "LightBuffer",
        "FittedMap",
        "sampler2D depths;",
        "vec4 nearness;",
        "samplerBuffer",
        "vec4 rectangle;",
        "int side;",
        "is_in_shadow_of",
        "light_share_of",
        "normal_lcs",
        "visibility = ",
        "dot(n, l) > 0)",
        "if (inside_beam",
        "shadow_factor = 1.0;",
        "shadow_factor = 0.0;",
        "instance",
        "Normal = cross",
        "float S(",
        "return in_shadow",
        "return mix(0.5",
        "}",
    ];
    for exact in [
        "cs541/lighting_exact.frag",
        "cs541/visibility_exact.frag",
        "csci3260/FragmentShaderCode_exact.glsl",
        "csci3260/visibility_exact.frag",
        "aueb7/SpotLight_exact.frag",
        "aueb7/visibility_exact.frag",
        "cmsc23700/lighting_exact.frag",
        "cmsc23700/visibility_exact.frag",
    ] {
        let others = |text: &str| {
            let mut lines = lines(text);
            lines.retain(|line| !of_the_test.iter().any(|word| line.contains(word)));
            lines
        };
        let own = read(&exact.replace("exact", "offset"));
        assert_eq!(others(&read(exact)), others(&own), "{exact}");
        assert_ne!(lines(&read(exact)), lines(&own), "{exact}");
        // The control: a line of the rest, edited.
        let changed = own.replace("out vec4", "out vec3");
        assert_ne!(others(&read(exact)), others(&changed), "{exact}");
    }
    // What the visibility asks is what the lighting asks, but for the surfaces that are dark anyway.
    for (lighting, visibility) in [
        ("cs541/lighting_offset.frag", "cs541/visibility_offset.frag"),
        (
            "csci3260/FragmentShaderCode_offset.glsl",
            "csci3260/visibility_offset.frag",
        ),
        (
            "cmsc23700/lighting_offset.frag",
            "cmsc23700/visibility_offset.frag",
        ),
        (
            "aueb7/SpotLight_offset.frag",
            "aueb7/visibility_offset.frag",
        ),
    ] {
        let asking = ["normal_lcs", "Normal = cross", "S_l = S("];
        let asks = |path: &str| {
            let mut lines = lines(&read(path));
            lines.retain(|line| asking.iter().any(|word| line.contains(word)));
            lines
        };
        let same = |line: &String| line.trim_start_matches("float ").to_owned();
        let [a, b] =
            [lighting, visibility].map(|path| asks(path).iter().map(same).collect::<Vec<_>>());
        assert!(a.len() >= 3, "{lighting}");
        assert_eq!(a, b);
    }
}

/// The map is drawn anew when the light or something in the scene has moved, and only then.
#[test]
fn the_map_is_drawn_when_light_or_casters_have_moved() {
    let mut bench = Bench::recorded("cs541", [64, 64], &[OFFSET]);
    bench.picture();
    let mut is_drawn = |change: &dyn Fn(&mut Bench)| {
        change(&mut bench);
        trace::take();
        bench.picture();
        let text = trace::to_c(&trace::take());
        let drawn = text.contains("// first pass: drawing the fitted shadow map");
        assert_eq!(text.contains("glPolygonOffset("), drawn, "{text}");
        drawn
    };
    assert!(!is_drawn(&|_| ()), "nothing has changed");
    assert!(!is_drawn(&|bench| bench.press("wdqo")), "the eye has moved");
    let handouts = ["epsilon=0.01", "remedy=culling", "second_plane=on"];
    assert!(
        !is_drawn(&|bench| bench.set(&handouts)),
        "settings of the handout's test"
    );
    assert!(
        is_drawn(&|bench| bench.press("<Left>")),
        "the light has moved"
    );
    assert!(
        is_drawn(&|bench| bench.lab.advance(0.1)),
        "the torus has turned"
    );
    assert!(
        is_drawn(&|bench| bench.set(&["map_size=512"])),
        "another map"
    );
    assert!(
        is_drawn(&|bench| bench.set(&["light=point"])),
        "another light"
    );
    assert!(
        !is_drawn(&|bench| bench.set(&["shadows=off"])),
        "nothing is tested"
    );
    let redraw = ["shadows=on", "redraw=every_frame"];
    assert!(is_drawn(&|bench| bench.set(&redraw)), "in every frame");
}

#[test]
fn the_spotlights_map_is_drawn_when_light_or_casters_have_moved() {
    let mut bench = Bench::recorded("aueb7", [64, 64], &[OFFSET]);
    bench.picture();
    for (what, keys, settings, expected) in [
        ("the eye", "wadrf", &[][..], false),
        ("the world", "<Left>", &[], true),
        ("wireframe", "<F1>", &[], false),
        (
            "what only the exercises' test has",
            "",
            &["step=4", "constant_depth_bias=0"],
            false,
        ),
        ("what lies outside", "", &["outside=lit"], false),
        ("a filter reaches farther", "", &["filter=pcf_9"], true),
        ("another map", "", &["map_size=512"], true),
        ("the light", "<Wait:0.2>", &["rotate_light=on"], true),
        ("the scene", "", &["rotate_light=off", "scene=pirate"], true),
        ("nothing", "", &[], false),
    ] {
        bench.set(settings);
        bench.press(keys);
        trace::take();
        bench.picture();
        let text = trace::to_c(&trace::take());
        let drawn = text.contains("// first pass: DrawSceneToShadowFBO, fitted");
        assert_eq!(drawn, expected, "{what}");
        assert_eq!(text.contains("glPolygonOffset("), drawn, "{what}");
    }
}

/// Of two lights, each map for itself.
#[test]
fn the_maps_of_the_enabled_lights_are_drawn_when_balls_have_moved() {
    let settings = [OFFSET, "lights=spotlight"];
    let mut bench = Bench::recorded("cmsc23700", [64, 64], &settings);
    bench.picture();
    for (what, keys, settings, expected) in [
        ("at rest", "", &[][..], 0),
        ("the other light is on, too", "", &["lights=both"], 1),
        ("only the other", "", &["lights=directional"], 0),
        ("one ball more", "+", &[], 1),
        ("both again", "", &["lights=both"], 1),
        ("the balls", "<Wait:0.1>", &[], 2),
        (
            "what only the handout's test has",
            "",
            &["directional_bias=0", "spot_bias=0"],
            0,
        ),
        ("other maps", "", &["map_size=512"], 2),
    ] {
        bench.set(settings);
        bench.press(keys);
        trace::take();
        bench.picture();
        let text = trace::to_c(&trace::take());
        let drawn = text.matches("'s fitted shadow map").count();
        assert_eq!(drawn, expected, "{what}");
        assert_eq!(text.contains("glPolygonOffset("), drawn > 0, "{what}");
    }
}

/// Both tests draw into one texture, by turns.
#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    for (lab, size) in [
        ("cs541", "map_size=1024"),
        ("csci3260", "map_size=1024"),
        ("aueb7", "map_size=128"),
        ("cmsc23700", "map_size=1024"),
    ] {
        let straight = Bench::new(lab, SIZE, &[OFFSET]).picture();
        let handouts = Bench::new(lab, SIZE, &[]).picture();
        assert!(differing(&straight, &handouts) > 20, "{lab}");
        let mut bench = Bench::new(lab, SIZE, &["map_size=512"]);
        bench.picture();
        bench.set(&[OFFSET]);
        bench.picture();
        bench.set(&[size, "shadow_test=handout"]);
        bench.picture();
        bench.set(&[OFFSET]);
        bench.visibility();
        bench.lab.reload(&bench.context.gl).unwrap();
        assert_eq!(differing(&straight, &bench.picture()), 0, "{lab}");
        bench.set(&["shadow_test=handout"]);
        assert_eq!(differing(&handouts, &bench.picture()), 0, "{lab}");
    }
}

#[test]
fn the_map_can_be_shown_and_the_test_not_be_explained() {
    let folder = work_folder("offset_map");
    for lab in ["cs541", "csci3260", "aueb7", "cmsc23700"] {
        let run = |arguments: &[&str]| {
            Command::new(env!("CARGO_BIN_EXE_shadowlab"))
                .current_dir(&folder)
                .arg(arguments[0])
                .args([lab, "--size", "16x16", "--set", OFFSET])
                .args(&arguments[1..])
                .output()
                .unwrap()
        };
        let shown = run(&["screenshot", "--show", "shadow-map", "-o", "map.png"]);
        assert!(shown.status.success(), "{shown:?}");
        let refused = run(&["explain", "--pixel", "3,3"]);
        let told = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2), "{told}");
        assert!(told.contains("expected shadow_test=handout"), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
    }
}
