//! C_out = C_in · max(A, clamp(Σ S_l (A_l + D_l))): the handout's formula in f64, held against the lab's pictures.

mod common;

use common::{Bench, Random};
use glam::{DMat3, DVec3, dvec3};
use shadowlab::ground_truth::{Rays, Truth};
use shadowlab::scene::{Light, LightKind, Scene};

const SIZE: [u32; 2] = [320, 320];
const MODES: [(&str, &[usize]); 3] = [
    ("lights=directional", &[1]),
    ("lights=spotlight", &[2]),
    ("lights=both", &[1, 2]),
];

/// The formula, and what the controls change of it.
struct Formula {
    in_shadow: f64,
    with_ambient: fn(DVec3, DVec3) -> DVec3,
}

const HANDOUTS: Formula = Formula {
    in_shadow: 0.5,
    with_ambient: DVec3::max,
};

/// What a pixel shows, from the scene's fields.
struct Surface {
    color: DVec3,
    /// In the world.
    point: DVec3,
    normal: DVec3,
}

/// The surface of a pixel away from any edge; None at an edge, or where nothing is seen.
fn surface(scene: &Scene, rays: &Rays, truth: &Truth, [x, y]: [u32; 2]) -> Option<Surface> {
    let seen = |x: u32, y: u32| truth.seen[(y * SIZE[0] + x) as usize];
    let object = |x: u32, y: u32| seen(x, y).map(|(triangle, _)| rays.objects[triangle as usize]);
    let own = object(x, y)?;
    let around = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
    if around.into_iter().any(|(x, y)| object(x, y) != Some(own)) {
        return None;
    }
    let (triangle, point) = seen(x, y)?;
    let first = rays.objects.iter().position(|object| *object == own)?;
    let object = &scene.objects[own as usize];
    let face = object.mesh.faces[triangle as usize - first];
    // The normal between those of the corners.
    let [a, b, c] = *rays.surfaces.triangle(triangle);
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).length();
    let shares = dvec3(area(point, b, c), area(point, c, a), area(point, a, b)) / area(a, b, c);
    let [a, b, c] = face.map(|i| object.mesh.normals[i as usize]);
    let turn = DMat3::from_mat4(object.placement).inverse().transpose();
    Some(Surface {
        color: object.material.diffuse,
        point: point + scene.camera.eye,
        normal: (turn * DMat3::from_cols(a, b, c) * shares).normalize(),
    })
}

/// A_l + D_l, by the rules of the fixed pipeline that the course's lights follow; None at the very edge of the cone.
fn light_on(light: &Light, surface: &Surface) -> Option<DVec3> {
    let ambient_and_diffuse = |to_light: DVec3| {
        let diffuse = surface.normal.dot(to_light).max(0.0);
        light.color * (0.25 + diffuse)
    };
    let LightKind::Spot { cone, .. } = light.kind else {
        return Some(ambient_and_diffuse(-light.direction.normalize()));
    };
    let from_light = surface.point - light.position;
    let d = from_light.length();
    let cosine = (from_light / d).dot(light.direction.normalize());
    let cutoff = (cone / 2.0).to_radians().cos();
    if (cosine - cutoff).abs() < 1e-5 {
        None
    } else if cosine < cutoff {
        Some(DVec3::ZERO)
    } else {
        let attenuation = cosine.powi(2) / (1.0 + 0.05 * d + 0.02 * d * d);
        Some(attenuation * ambient_and_diffuse(-from_light / d))
    }
}

/// Random pixels of a state, as the formula has them and as the picture does: how many differ, of how many.
fn differing_from(formula: &Formula, mode: (&str, &[usize]), seed: u64) -> [usize; 2] {
    let (setting, lights) = mode;
    differing_with(formula, &[setting, "balls=60"], lights, seed)
}

fn differing_with(formula: &Formula, settings: &[&str], lights: &[usize], seed: u64) -> [usize; 2] {
    let mut bench = Bench::new("cmsc23700", SIZE, settings);
    let picture = bench.picture();
    let visibilities: Vec<_> = lights.iter().map(|l| bench.visibility_of(*l)).collect();
    let scene = bench.lab.now();
    let rays = Rays::new(&scene, 0);
    let truth = rays.truth(SIZE);
    let mut random = Random(seed);
    let (mut differing, mut asked) = (0, 0);
    'pixels: for _ in 0..2000 {
        let [x, y] = SIZE.map(|n| 1 + random.below(n - 2));
        let Some(surface) = surface(&scene, &rays, &truth, [x, y]) else {
            continue;
        };
        let mut sum = DVec3::ZERO;
        for (light, visibility) in lights.iter().zip(&visibilities) {
            let Some(light) = light_on(&scene.lights[light - 1], &surface) else {
                continue 'pixels;
            };
            let in_shadow = visibility.get_pixel(x, y).0[0] < 128;
            sum += light * if in_shadow { formula.in_shadow } else { 1.0 };
        }
        let sum = sum.clamp(DVec3::ZERO, DVec3::ONE);
        let color = surface.color * (formula.with_ambient)(scene.ambient, sum);
        let found = picture.get_pixel(x, y).0.map(f64::from);
        let apart = (DVec3::from_array(found) - 255.0 * color).abs();
        // The rounding to bytes, and that of f32 before it.
        differing += usize::from(apart.max_element() > 0.51);
        asked += 1;
    }
    [differing, asked]
}

#[test]
fn the_picture_has_the_handouts_formula() {
    for mode in MODES {
        let [differing, asked] = differing_from(&HANDOUTS, mode, 1);
        assert!(asked > 700, "{mode:?}: {asked}");
        assert_eq!(differing, 0, "{mode:?}, of {asked}");
    }
}

/// The formula asks for S_l, whoever tells it.
#[test]
fn the_picture_with_another_test_has_the_formula_too() {
    for test in ["shadow_test=offset", "shadow_test=exact"] {
        for (lights, numbers) in MODES {
            let settings = [lights, "balls=60", test];
            let [differing, asked] = differing_with(&HANDOUTS, &settings, numbers, 1);
            assert!(asked > 700, "{test} {lights}: {asked}");
            assert_eq!(differing, 0, "{test} {lights}, of {asked}");
        }
    }
}

/// The controls: the slip that the handout's history tells of, and a shadow of another depth.
#[test]
fn another_formula_is_not_that_of_the_picture() {
    let min = Formula {
        with_ambient: DVec3::min,
        ..HANDOUTS
    };
    let darker = Formula {
        in_shadow: 0.4,
        ..HANDOUTS
    };
    for mode in MODES {
        let [differing, asked] = differing_from(&min, mode, 1);
        assert!(differing > asked / 3, "{mode:?}: {differing} of {asked}");
    }
    for mode in [MODES[0], MODES[2]] {
        let [differing, asked] = differing_from(&darker, mode, 1);
        assert!(differing > asked / 50, "{mode:?}: {differing} of {asked}");
    }
}
