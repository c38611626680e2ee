//! `explain` says what the shader computed: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;
mod explaining;

use common::Bench;
use explaining::explained_for;
use glam::{DVec3, dvec3};
use shadowlab::labs::{Explanation, Probe};

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [(usize, &[&str]); 8] = [
        (1, &[]),
        (2, &[]),
        (1, &["directional_bias=0", "lights=directional"]),
        (2, &["spot_bias=0", "lights=spotlight"]),
        (1, &["balls=50", "map_size=300"]),
        (2, &["balls=50", "map_size=300"]),
        (1, &["balls=50", "directional_bias=0"]),
        (2, &["balls=50", "spot_bias=0", "map_size=2048"]),
    ];
    let surfaces: u32 = states
        .iter()
        .zip(1..)
        .map(|((light, settings), seed)| explained_for("cmsc23700", *light, settings, 130, seed))
        .sum();
    // The box takes four ninths of this picture.
    assert!(surfaces > 350, "only {surfaces} pixels showed a surface");
}

fn explained_at(light: usize, point: DVec3) -> Explanation {
    let mut bench = Bench::new("cmsc23700", [320, 240], &["balls=0"]);
    let explanation = bench
        .lab
        .explain(&bench.context.gl, Probe::Point(point), light)
        .unwrap();
    for step in &explanation.steps {
        assert!(step.agrees(), "{}\n{explanation}", step.name);
    }
    explanation
}

/// By hand: the left wall, 2 high, shadows the bottom for 2 · 0.3 from its foot.
#[test]
fn the_shadow_of_the_left_wall_ends_where_it_should() {
    let in_shadow = |x: f64| explained_at(1, dvec3(x, -1.0, 0.5)).in_shadow.unwrap();
    assert!(in_shadow(0.9));
    assert!(in_shadow(0.42));
    assert!(!in_shadow(0.38));
    assert!(!in_shadow(-0.9));
}

#[test]
fn outside_the_cone_the_map_is_not_asked() {
    let inside = explained_at(2, dvec3(0.0, -1.0, 0.0));
    assert!(inside.tests.len() == 2 && inside.tests[0].1);
    let outside = explained_at(2, dvec3(0.95, -1.0, -0.95));
    assert!(outside.tests.len() == 1 && !outside.tests[0].1);
    assert_eq!(outside.in_shadow, Some(false));
    // Behind the light, too, where a division by w would mirror the map.
    assert!(!explained_at(2, dvec3(-0.5, 3.0, -0.5)).tests[0].1);
}

#[test]
fn a_ball_is_told_by_its_number() {
    let mut bench = Bench::new("cmsc23700", [320, 320], &["balls=100"]);
    let camera = bench.lab.now().camera;
    let balls: Vec<DVec3> = {
        let objects = bench.lab.now().objects;
        let balls = objects.iter().filter(|object| object.name == "ball");
        balls.map(|ball| ball.placement.w_axis.truncate()).collect()
    };
    // The nearest ball hides nothing of itself behind another one.
    let nearest = (0..100).min_by(|a, b| balls[*a].z.total_cmp(&balls[*b].z));
    let number = nearest.unwrap();
    let clip = camera.perspective(1.0) * camera.view();
    let place = clip.project_point3(balls[number]);
    let pixel = [place.x, -place.y].map(|n| (160.0 * (n + 1.0)) as u32);
    let explanation = bench
        .lab
        .explain(&bench.context.gl, Probe::Pixel(pixel), 1)
        .unwrap();
    let told = format!("shows ball {},", number + 1);
    assert!(explanation.place.contains(&told), "{}", explanation.place);
}

#[test]
fn what_cannot_be_explained_is_told() {
    let refused = |setting: &str, probe: Probe| {
        let mut bench = Bench::new("cmsc23700", [320, 240], &[setting]);
        let explained = bench.lab.explain(&bench.context.gl, probe, 1);
        explained.err().unwrap().to_string()
    };
    assert!(refused("shadows=off", Probe::Pixel([0, 0])).contains("expected shadows=on"));
    assert!(refused("lights=both", Probe::Pixel([320, 0])).contains("0,0 to 319,239"));
    assert!(refused("lights=spotlight", Probe::Pixel([9, 9])).contains("lights=directional"));
}
