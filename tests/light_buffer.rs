//! The light buffer against the truth, without a GPU: the shader's steps in f32, at every point that the truth has seen.
//! Beside the labels, the number of triangles that a point is tested against is checked: a builder that keeps the wrong
//! side of a solid may still be right everywhere, and is slow.

mod hard;

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3, Vec3Swizzles};
use hard::{Case, cases};
use shadowlab::ground_truth::{Label, Rays as TruthRays, Truth};
use shadowlab::scene::Scene;
use shadowlab::shadow_tests::exact::{Builder, DARK, FACES_LIGHT, LightBuffer, SLAB};
use shadowlab::shadow_tests::{Placed, Rays};

const SIZE: [u32; 2] = [320, 240];

fn placed(scene: &Scene) -> Vec<Placed> {
    let objects = scene.objects.iter();
    objects
        .map(|object| Placed {
            mesh: object.mesh.clone(),
            model: object.model(0.0),
            casts: object.casts,
        })
        .collect()
}

/// `IN_PLANE` and `ONE_PLANE` of `exact.frag`.
const IN_PLANE: f32 = 1e-5;
const ONE_PLANE: f32 = 0.1;

/// Whether a point is in shadow, and how many triangles were asked: `exact.frag`, line by line. The normal is that of the
/// point's own triangle, which is known to face the light here.
fn test(light_buffer: &LightBuffer, position_lcs: Vec3, normal_lcs: Vec3) -> (bool, usize) {
    let rays = light_buffer.space.rays;
    let (face, place, nearness, ray, reach) = match rays {
        Rays::Parallel => {
            let ray = position_lcs.xy().extend(-1.0);
            (0, position_lcs.xy(), position_lcs.z, ray, position_lcs.z)
        }
        Rays::Spot | Rays::Point => {
            let size = position_lcs.abs();
            let axis = match rays {
                Rays::Point if size.x.max(size.y) > size.z => usize::from(size.x <= size.y),
                _ => 2,
            };
            let turned = match axis {
                0 => position_lcs.yzx(),
                1 => position_lcs.zxy(),
                _ => position_lcs,
            };
            let face = match rays {
                Rays::Point => 2 * axis + usize::from(turned.z < 0.0),
                _ => 0,
            };
            let nearness = 1.0 / turned.z.abs();
            (face, turned.xy() * nearness, nearness, position_lcs, 1.0)
        }
    };
    let layout = light_buffer.layout;
    let within = (place - layout.least.as_vec2()) * layout.scale.as_vec2();
    let side = layout.side as f32;
    if within.cmplt(Vec2::ZERO).any() || within.cmpgt(Vec2::splat(side)).any() {
        return (false, 0);
    }
    let [column, row] = within
        .to_array()
        .map(|place| (place as usize).min(layout.side as usize - 1));
    let cell =
        light_buffer.cells[(face * layout.side as usize + row) * layout.side as usize + column];
    if nearness > cell.lit_above {
        return (false, 0);
    }
    if nearness < cell.dark_below {
        return (true, 0);
    }
    let own_plane = match rays {
        Rays::Parallel => normal_lcs.xy().extend(normal_lcs.dot(position_lcs)) / -normal_lcs.z,
        Rays::Spot | Rays::Point => normal_lcs / normal_lcs.dot(position_lcs),
    };
    let own_reach = reach + IN_PLANE * (1.0 + own_plane.abs().dot(ray.abs()));
    let apart = ONE_PLANE * ONE_PLANE * own_plane.length_squared();
    let (mut at, mut next, mut tests) = (cell.first, cell.first, 0);
    while at < cell.end {
        let [x, y, z, on] = light_buffer.nodes[at as usize];
        let plane = Vec3::from_array([x, y, z].map(f32::from_bits));
        let product = plane.dot(ray);
        let own = on & FACES_LIGHT != 0
            && product < own_reach
            && plane.distance_squared(own_plane) < apart;
        let through_light = at < cell.first || on & SLAB != 0;
        let least = if through_light { 0.0 } else { reach };
        tests += usize::from(at >= cell.first);
        next = next.max(at + 1);
        at = match product >= least && !own {
            true => on & DARK,
            false => next,
        };
    }
    (at == DARK, tests)
}

/// Where the lists are.
fn lists(light_buffer: &LightBuffer) -> std::ops::Range<usize> {
    light_buffer.first_list as usize..light_buffer.nodes.len()
}

/// How a light buffer does on a scene.
#[derive(Debug, Default)]
struct Score {
    valid: usize,
    shadowed: usize,
    ambiguous: usize,
    false_shadow: usize,
    false_light: usize,
    /// For each valid pixel.
    tests: f64,
}

fn score(scene: &Scene, rays: &TruthRays, truth: &Truth, light_buffer: &LightBuffer) -> Score {
    let mut score = Score::default();
    let eye = scene.camera.eye;
    for (i, seen) in truth.seen.iter().enumerate() {
        let Some((triangle, point)) = seen else {
            continue;
        };
        if truth.labels[i] == Label::NotValid {
            continue;
        }
        score.valid += 1;
        score.ambiguous += usize::from(truth.ambiguous[i]);
        let to_light = |point: DVec3| light_buffer.space.from_world(point + eye);
        let [a, b, c] = rays.surfaces.triangle(*triangle).map(to_light);
        let normal_lcs = (b - a).cross(c - a).as_vec3();
        let (shadowed, tests) = test(light_buffer, to_light(*point).as_vec3(), normal_lcs);
        score.tests += tests as f64;
        let expected = truth.labels[i] == Label::Shadowed;
        score.shadowed += usize::from(expected);
        if !truth.ambiguous[i] {
            score.false_shadow += usize::from(shadowed && !expected);
            score.false_light += usize::from(!shadowed && expected);
        }
    }
    score.tests /= score.valid as f64;
    score
}

#[test]
fn no_pixel_is_wrong_and_few_triangles_are_asked() {
    let mut failures = Vec::new();
    for Case {
        name,
        scene,
        most_tests,
    } in cases()
    {
        let rays = TruthRays::new(&scene, 0);
        let truth = rays.truth(SIZE);
        let mut builder = Builder::default();
        let light_buffer = builder.build(&scene.lights[0], &placed(&scene));
        let score = score(&scene, &rays, &truth, light_buffer);
        println!(
            "{name:30} {:7} valid {:6} dark {:4} ambiguous, wrong {} {}, tests {:.3}, entries {}",
            score.valid,
            score.shadowed,
            score.ambiguous,
            score.false_shadow,
            score.false_light,
            score.tests,
            lists(light_buffer).len(),
        );
        if score.false_shadow + score.false_light > 0 || score.tests > most_tests {
            failures.push(format!("{name}: {score:?}"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The controls, on a scene with solids and one with sheets: a light buffer that is wrong in one way scores badly.
#[test]
fn a_wrong_light_buffer_scores_badly() {
    let wrong = |name: &str, edit: &dyn Fn(&Scene) -> Scene, spoil: &dyn Fn(&mut LightBuffer)| {
        let case = cases().into_iter().find(|case| case.name == name);
        let scene = case.expect("there is such a case").scene;
        let rays = TruthRays::new(&scene, 0);
        let truth = rays.truth(SIZE);
        let mut builder = Builder::default();
        let built = builder.build(&scene.lights[0], &placed(&edit(&scene)));
        let mut spoilt = built.clone();
        spoil(&mut spoilt);
        let score = score(&scene, &rays, &truth, &spoilt);
        println!("{name}: {score:?}");
        score
    };
    let mistakes = |score: Score| [score.false_shadow, score.false_light];
    let as_it_is = |scene: &Scene| scene.clone();
    let turned = |scene: &Scene| {
        let mut scene = scene.clone();
        for object in &mut scene.objects {
            for face in &mut Arc::make_mut(&mut object.mesh).faces {
                face.swap(1, 2);
            }
        }
        scene
    };
    let move_planes = |by: f32| {
        move |buffer: &mut LightBuffer| {
            let lists = lists(buffer);
            for [plane @ .., _] in &mut buffer.nodes[lists] {
                *plane = plane.map(|bits| (f32::from_bits(bits) * by).to_bits());
            }
        }
    };
    for name in ["solids, spot", "solids, point", "solids, sun"] {
        // The controls of the controls.
        let right = wrong(name, &as_it_is, &|_| ());
        let tests = right.tests;
        assert_eq!(mistakes(right), [0, 0], "{name}");
        // The side that faces the light in place of the one that faces away: it casts the same, and onto itself.
        let inside_out = wrong(name, &turned, &|_| ());
        assert!(
            inside_out.tests > 2.0 * tests,
            "{name}: {tests} {inside_out:?}"
        );
        // The lists of other cells.
        let [_, light] = mistakes(wrong(name, &as_it_is, &|buffer| {
            let lists = lists(buffer);
            buffer.nodes[lists].rotate_left(1000);
        }));
        assert!(light > 20, "{name}: {light}");
    }
    // A tolerance on the wrong side: neighbours on an open surface shadow each other.
    for name in ["winding, spot", "winding, point"] {
        let [shadow, _] = mistakes(wrong(name, &as_it_is, &move_planes(1.01)));
        assert!(shadow > 20, "{name}: {shadow}");
        let [_, light] = mistakes(wrong(name, &as_it_is, &move_planes(0.9)));
        assert!(light > 20, "{name}: {light}");
    }
}

/// The control of the number of triangles that are asked: without what is known of whole cells every list is gone
/// through, and no label tells.
#[test]
fn what_is_known_of_cells_saves_most_tests() {
    let scene = hard::five_shapes();
    let rays = TruthRays::new(&scene, 0);
    let truth = rays.truth(SIZE);
    let mut builder = Builder::default();
    let built = builder.build(&scene.lights[0], &placed(&scene));
    let mut blind = built.clone();
    for cell in &mut blind.cells {
        cell.lit_above = f32::INFINITY;
        cell.dark_below = f32::NEG_INFINITY;
    }
    let [informed, blind] = [built, &blind].map(|buffer| score(&scene, &rays, &truth, buffer));
    assert_eq!(blind.false_shadow + blind.false_light, 0);
    assert!(
        blind.tests > 10.0 * informed.tests,
        "{blind:?} {informed:?}"
    );
}

/// The controls of slabs, where lists are long: a ray that passes none of them by is tested against much more, and nothing
/// else changes; one that passes all of them by misses what it should meet.
#[test]
fn slabs_save_tests_and_hide_nothing() {
    for name in [
        "bumpy sphere, spot",
        "bumpy sphere, point",
        "bumpy sphere, sun",
    ] {
        let case = cases().into_iter().find(|case| case.name == name);
        let scene = case.expect("there is such a case").scene;
        let rays = TruthRays::new(&scene, 0);
        let truth = rays.truth(SIZE);
        let mut builder = Builder::default();
        let built = builder.build(&scene.lights[0], &placed(&scene));
        let with_planes = |plane: [f32; 3]| {
            let mut changed = built.clone();
            let slabs = changed.nodes[lists(built)].iter_mut();
            for [words @ .., _] in slabs.filter(|[.., on]| on & SLAB != 0) {
                *words = plane.map(f32::to_bits);
            }
            score(&scene, &rays, &truth, &changed)
        };
        let as_it_is = score(&scene, &rays, &truth, built);
        // No product with this is large enough, and every product with that is.
        let [never, always] = [[f32::NAN; 3], [0.0; 3]].map(with_planes);
        assert_eq!(never.false_shadow + never.false_light, 0, "{name}");
        assert!(
            never.tests > 1.2 * as_it_is.tests,
            "{name}: {as_it_is:?} {never:?}"
        );
        assert!(always.false_light > 20, "{name}: {always:?}");
    }
}
