//! The truth itself, checked: against brute force, against closed forms, against itself in other places and sizes.

mod common;

use std::path::Path;
use std::sync::Arc;

use common::{Bench, Random, differing};
use glam::{DMat4, DVec3, dvec3};
use image::GrayImage;
use shadowlab::ground_truth::{AreaLight, Label, Rays, Truth};
use shadowlab::labs;
use shadowlab::measure::Measure;
use shadowlab::scene::{
    self, Beam, Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, rotate, shapes,
};

const SIZE: [u32; 2] = [320, 240];

fn default_scene() -> Scene {
    (labs::find("cs541").unwrap().scene)().unwrap()
}

/// A floor of 20 × 20 with these meshes on it, seen from the front and lit from the upper left.
fn floor_with(meshes: Vec<(Mesh, DMat4)>, kind: LightKind) -> Scene {
    let floor = (
        shapes::plane(3),
        rotate(-90.0, DVec3::X) * DMat4::from_scale(DVec3::splat(10.0)),
    );
    let material = Material {
        diffuse: DVec3::ONE,
        specular: DVec3::ZERO,
        shininess: 1.0,
        texture: None,
    };
    let object = |(mesh, placement)| Object::new("", mesh, placement, material.clone());
    Scene {
        size: None,
        clear: DVec3::ZERO,
        camera: Camera {
            eye: dvec3(0.0, 6.0, 9.0),
            look: dvec3(0.0, -6.0, -9.0),
            rup: DVec3::Y,
            fov: Fov::Vertical(50.0),
            near: 0.1,
            far: None,
        },
        lights: vec![Light {
            kind,
            position: dvec3(-3.0, 5.0, 2.0),
            direction: dvec3(3.0, -5.0, -2.0),
            color: DVec3::ONE,
            near: 1.0,
            far: 30.0,
        }],
        ambient: DVec3::ZERO,
        sky: None,
        objects: [floor].into_iter().chain(meshes).map(object).collect(),
    }
}

const SPOT: LightKind = LightKind::Spot {
    cone: 90.0,
    beam: Beam::Circular,
};
const POINT: LightKind = LightKind::Point { shadow_fov: 120.0 };
const SUN: LightKind = LightKind::Directional {
    area: [-10.0, 10.0, -10.0, 10.0],
};

/// Every scene that the checks look at.
fn scenes() -> Vec<(&'static str, Scene)> {
    let sphere = || {
        (
            shapes::sphere(24),
            DMat4::from_translation(dvec3(1.0, 1.0, 0.0)),
        )
    };
    let cube = || {
        (
            shapes::cube(),
            DMat4::from_translation(dvec3(-1.0, 0.5, 1.0)) * rotate(20.0, DVec3::Y),
        )
    };
    let rectangular = LightKind::Spot {
        cone: 60.0,
        beam: Beam::Rectangular,
    };
    let five_shapes = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/five_shapes.toml");
    vec![
        ("cs541", default_scene()),
        (
            "five shapes",
            scene::file::load(&five_shapes, false).unwrap(),
        ),
        ("spot", floor_with(vec![sphere(), cube()], SPOT)),
        (
            "rectangular",
            floor_with(vec![sphere(), cube()], rectangular),
        ),
        ("point", floor_with(vec![sphere(), cube()], POINT)),
        ("sun", floor_with(vec![sphere(), cube()], SUN)),
    ]
}

fn truth_of(scene: &Scene) -> Truth {
    Rays::new(scene, 0).truth(SIZE)
}

#[test]
fn the_tree_misses_nothing_that_brute_force_finds() {
    let mut random = Random(1);
    for (name, scene) in scenes() {
        let rays = Rays::new(&scene, 0);
        let truth = rays.truth(SIZE);
        for _ in 0..2000 {
            let [x, y] = SIZE.map(|n| random.below(n));
            let found = truth.labels[(y * SIZE[0] + x) as usize];
            assert_eq!(
                found,
                rays.label_by_brute_force(SIZE, [x, y]),
                "{name}: pixel {x},{y}"
            );
        }
    }
}

/// The points of the floor that are seen, in world space, with the truth's label: but for those where it says nothing.
fn floor_points(scene: &Scene, rays: &Rays, truth: &Truth) -> Vec<(DVec3, Label)> {
    let points = truth.seen.iter().enumerate().filter_map(|(i, seen)| {
        let (triangle, point) = (*seen)?;
        let on_floor = rays.objects[triangle as usize] == 0;
        let sure = truth.labels[i] != Label::NotValid && !truth.ambiguous[i];
        (on_floor && sure).then(|| (point + scene.camera.eye, truth.labels[i]))
    });
    points.collect()
}

/// Whether the way from a point on the floor to the light, or against parallel rays, goes through a box.
fn through_box(point: DVec3, towards: DVec3, end: f64, least: DVec3, most: DVec3) -> bool {
    let (a, b) = ((least - point) / towards, (most - point) / towards);
    let enters = a.min(b).max_element().max(0.0);
    let leaves = a.max(b).min_element().min(end);
    enters < leaves
}

#[test]
fn the_shadow_of_a_box_is_the_closed_form() {
    let (least, most) = (dvec3(-0.5, 0.25, -0.25), dvec3(0.5, 1.5, 0.75));
    for (name, kind) in [("spot", SPOT), ("point", POINT), ("sun", SUN)] {
        let placement =
            DMat4::from_translation(0.5 * (least + most)) * DMat4::from_scale(most - least);
        let scene = floor_with(vec![(shapes::cube(), placement)], kind);
        let rays = Rays::new(&scene, 0);
        let truth = rays.truth(SIZE);
        let (mut floor_pixels, mut shadowed) = (0, 0);
        for (point, label) in floor_points(&scene, &rays, &truth) {
            let light = &scene.lights[0];
            let expected = match kind {
                LightKind::Directional { .. } => {
                    through_box(point, -light.direction, f64::INFINITY, least, most)
                }
                _ => through_box(point, light.position - point, 1.0, least, most),
            };
            assert_eq!(label == Label::Shadowed, expected, "{name}: {point}");
            floor_pixels += 1;
            shadowed += usize::from(expected);
        }
        assert!(
            floor_pixels > 20_000 && shadowed > 300,
            "{name}: {floor_pixels}, {shadowed}"
        );
    }
}

#[test]
fn the_shadow_of_a_sphere_lies_between_its_inner_and_its_outer_one() {
    let centre = dvec3(0.3, 1.2, 0.2);
    let n = 64;
    let scene = floor_with(
        vec![(shapes::sphere(n), DMat4::from_translation(centre))],
        SPOT,
    );
    let rays = Rays::new(&scene, 0);
    let truth = rays.truth(SIZE);
    // Faces of a sphere in 2n slices and n stacks stay outside of this radius.
    let step = std::f64::consts::PI / f64::from(n);
    let inner = (step / 2.0).cos() * (step / 2.0).cos();
    let mut counts = [0; 2];
    for (point, label) in floor_points(&scene, &rays, &truth) {
        let towards = (scene.lights[0].position - point).normalize();
        let distance = (centre - point).cross(towards).length();
        if distance < inner {
            assert_eq!(label, Label::Shadowed, "{point}");
            counts[0] += 1;
        } else if distance > 1.0 {
            assert_eq!(label, Label::Lit, "{point}");
            counts[1] += 1;
        }
    }
    assert!(counts[0] > 1000 && counts[1] > 10_000, "{counts:?}");
}

#[test]
fn the_penumbra_of_a_disc_behind_a_half_plane_is_the_closed_form() {
    // A sheet from x = −40 to 0 at height 2, a disc of radius 0.8 at height 5, points on the floor.
    let sheet = DMat4::from_translation(dvec3(-20.0, 2.0, 0.0))
        * rotate(-90.0, DVec3::X)
        * DMat4::from_scale(dvec3(20.0, 20.0, 1.0));
    let scene = floor_with(vec![(shapes::plane(1), sheet)], POINT);
    let rays = Rays::new(&scene, 0);
    let eye = scene.camera.eye;
    let light = AreaLight {
        centre: dvec3(0.0, 5.0, 0.0) - eye,
        u: dvec3(0.8, 0.0, 0.0),
        v: dvec3(0.0, 0.0, 0.8),
        disc: true,
    };
    let mut largest_error: f64 = 0.0;
    for step in -30..=30 {
        let x = f64::from(step) / 20.0;
        // The sheet's edge, seen from the point, cuts the disc at this x; what lies beyond is visible.
        let cut = ((x - x * 5.0 / 2.0) / 0.8).clamp(-1.0, 1.0);
        let visible = (cut.acos() - cut * (1.0 - cut * cut).sqrt()) / std::f64::consts::PI;
        let point = dvec3(x, 0.0, 0.01) - eye;
        // Triangles 0 to 17 are the floor's.
        let found = rays.penumbra(0, point, &light, 4096);
        let error = (found.visibility - visible).abs();
        assert!(
            error <= 5.0 * found.standard_error + 1e-9,
            "x = {x}: {found:?}, expected {visible}"
        );
        largest_error = largest_error.max(error);
    }
    // A low-discrepancy set is much better than the 1/√n of random points, which would be 0.008.
    assert!(largest_error < 0.003, "{largest_error}");
    // The control: a disc of another size.
    let wrong = AreaLight {
        u: 1.2 * light.u,
        ..light
    };
    let found = rays.penumbra(0, dvec3(0.4, 0.0, 0.01) - eye, &wrong, 4096);
    let cut: f64 = -0.6 / 0.8;
    let visible = (cut.acos() - cut * (1.0 - cut * cut).sqrt()) / std::f64::consts::PI;
    assert!((found.visibility - visible).abs() > 0.02);
}

/// The labels of both, where neither hangs on a hair.
fn differences(a: &Truth, b: &Truth) -> usize {
    let sure = |i: usize| !a.ambiguous[i] && !b.ambiguous[i];
    (0..a.labels.len())
        .filter(|i| sure(*i) && a.labels[*i] != b.labels[*i])
        .count()
}

/// The triangles of every object in another order, each beginning with another corner.
fn shuffled(mut scene: Scene) -> Scene {
    let mut random = Random(7);
    for object in &mut scene.objects {
        let faces = &mut Arc::make_mut(&mut object.mesh).faces;
        for i in (1..faces.len()).rev() {
            faces.swap(i, random.below(i as u32 + 1) as usize);
        }
        faces
            .iter_mut()
            .for_each(|face| face.rotate_left(random.below(3) as usize));
    }
    scene.objects.reverse();
    scene
}

/// Every triangle twice, the second time from another corner; and one that has no area.
fn doubled(mut scene: Scene) -> Scene {
    for object in &mut scene.objects {
        let faces = &mut Arc::make_mut(&mut object.mesh).faces;
        let again: Vec<[u32; 3]> = faces.iter().map(|[a, b, c]| [*b, *c, *a]).collect();
        faces.extend(again);
        faces.push([0, 0, 1]);
    }
    scene
}

/// Every object cut in two, and every triangle into objects' own vertices.
fn split(mut scene: Scene) -> Scene {
    let halves = |object: &Object| {
        let middle = object.mesh.faces.len() / 2;
        [&object.mesh.faces[..middle], &object.mesh.faces[middle..]].map(|faces| Object {
            mesh: Arc::new(Mesh {
                faces: faces.to_vec(),
                ..(*object.mesh).clone()
            }),
            ..object.clone()
        })
    };
    scene.objects = scene.objects.iter().flat_map(halves).collect();
    scene
}

#[test]
fn the_truth_is_the_same_elsewhere_in_other_sizes_and_in_pieces() {
    for (name, scene) in scenes() {
        let truth = truth_of(&scene);
        let ambiguous = truth.ambiguous.iter().filter(|a| **a).count();
        assert!(ambiguous < 100, "{name}: {ambiguous} ambiguous pixels");
        for (how, other) in [
            ("moved by 1e5", scene.clone().moved(dvec3(1e5, -1e5, 1e5))),
            ("scaled by 1e-3", scene.clone().scaled(1e-3)),
            ("scaled by 1e4", scene.clone().scaled(1e4)),
            ("shuffled", shuffled(scene.clone())),
            ("split", split(scene.clone())),
            ("doubled", doubled(scene.clone())),
        ] {
            let other = truth_of(&other);
            let ambiguous = other.ambiguous.iter().filter(|a| **a).count();
            assert!(
                ambiguous < 100,
                "{name} {how}: {ambiguous} ambiguous pixels"
            );
            assert_eq!(differences(&truth, &other), 0, "{name} {how}");
        }
        // The control: the light moved by a hundredth.
        let mut other = scene;
        other.lights[0].position.x += 0.01;
        other.lights[0].direction.x += 0.01;
        assert!(differences(&truth, &truth_of(&other)) > 0, "{name}");
    }
}

/// Which of two triangles in the same place is seen is a tie; where it matters, the truth says so.
#[test]
fn a_triangle_and_its_own_back_are_ambiguous() {
    let mut scene = floor_with(vec![], SPOT);
    let valid = |truth: &Truth| truth.labels.len() - truth.count(Label::NotValid);
    let before = truth_of(&scene);
    assert!(before.ambiguous.iter().filter(|a| **a).count() < 1000);
    let faces = &mut Arc::make_mut(&mut scene.objects[0].mesh).faces;
    let backs: Vec<[u32; 3]> = faces.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    faces.extend(backs);
    let after = truth_of(&scene);
    let of_floor = after.seen.iter().filter(|seen| seen.is_some()).count();
    let ambiguous = after.ambiguous.iter().filter(|a| **a).count();
    assert!(
        valid(&before) > 10_000 && ambiguous >= of_floor,
        "{ambiguous} of {of_floor}"
    );
}

#[test]
fn a_right_picture_scores_well_and_a_wrong_one_badly() {
    let scene = default_scene();
    let rays = Rays::new(&scene, 0);
    let truth = rays.truth(SIZE);
    let measure = Measure::new(&rays, &truth);
    let picture = |value: &dyn Fn(u32, u32) -> u8| {
        GrayImage::from_fn(SIZE[0], SIZE[1], |x, y| image::Luma([value(x, y)]))
    };
    let label = |x: u32, y: u32| truth.labels[(y * SIZE[0] + x) as usize];
    let right = picture(&|x, y| {
        if label(x, y) == Label::Shadowed {
            0
        } else {
            255
        }
    });
    let (figures, shown) = measure.measure(&right, None);
    assert_eq!(
        (
            figures.false_shadow.total(),
            figures.false_light.total(),
            figures.grey
        ),
        (0, 0, 0)
    );
    assert_eq!(figures.contact_gap, None);
    assert!(
        !shown
            .pixels()
            .any(|pixel| pixel.0 == [220, 30, 30] || pixel.0 == [40, 80, 230])
    );

    let wrong = |visibility: &GrayImage| {
        let figures = measure.measure(visibility, None).0;
        (
            figures.false_shadow.total(),
            figures.false_light.total(),
            figures,
        )
    };
    let (shadow, light, figures) = wrong(&picture(&|_, _| 255));
    assert_eq!(shadow, 0, "all lit");
    assert_eq!(
        light + figures.false_light.ambiguous,
        figures.shadowed,
        "all lit"
    );
    let (shadow, light, figures) = wrong(&picture(&|_, _| 0));
    assert_eq!(
        (shadow + figures.false_shadow.ambiguous, light),
        (figures.lit, 0),
        "all dark"
    );
    let inverted = picture(&|x, y| 255 - right.get_pixel(x, y).0[0]);
    let (shadow, light, figures) = wrong(&inverted);
    assert!(
        shadow > figures.lit * 9 / 10 && light > figures.shadowed * 9 / 10,
        "inverted"
    );
    let (shadow, light, _) = wrong(&image::imageops::flip_vertical(&right));
    assert!(shadow > 1000 && light > 1000, "flipped: {shadow} {light}");
    let shifted = picture(&|x, y| right.get_pixel((x + 2) % SIZE[0], y).0[0]);
    let (shadow, light, figures) = wrong(&shifted);
    assert!(shadow > 300 && light > 300, "shifted: {shadow} {light}");
    let interior = figures.false_shadow.interior + figures.false_light.interior;
    assert!(
        interior > 100,
        "a shift by 2 pixels is no matter of an edge: {interior}"
    );
    let (_, _, figures) = wrong(&picture(&|x, y| right.get_pixel(x, y).0[0].min(200)));
    assert!(figures.grey > 10_000, "grey");

    // The light moved by the width that a texel of the default map has in the middle of the scene.
    let mut other = scene.clone();
    other.lights[0].position.x += 0.012;
    let other = truth_of(&other);
    let moved = picture(&|x, y| match other.labels[(y * SIZE[0] + x) as usize] {
        Label::Shadowed => 0,
        _ => 255,
    });
    let (shadow, light, _) = wrong(&moved);
    assert!(shadow + light >= 10, "moved light: {shadow} {light}");
}

#[test]
fn the_labs_picture_scores_as_it_should() {
    let measured = |settings: &[&str]| {
        let mut bench = Bench::new("cs541", SIZE, settings);
        let visibility = bench.visibility();
        let rays = Rays::new(&bench.lab.now(), 0);
        let truth = rays.truth(SIZE);
        let map = bench.map_scale();
        Measure::new(&rays, &truth)
            .measure(&visibility, map.as_ref())
            .0
    };
    let good = measured(&[]);
    assert_eq!(
        (good.false_shadow.interior, good.false_light.interior),
        (0, 0),
        "{good}"
    );
    assert!(good.ambiguous < 50, "{good}");
    // Controls: no bias, a bias that is too large, no shadows.
    assert!(measured(&["remedy=none"]).false_shadow.interior > 1000);
    let peter_panning = measured(&["epsilon=0.02"]);
    assert!(peter_panning.false_light.interior > 150, "{peter_panning}");
    assert!(
        peter_panning.contact_gap.unwrap().texels.unwrap() > 10.0,
        "{peter_panning}"
    );
    let none = measured(&["shadows=off"]);
    assert_eq!(
        none.false_light.total() + none.false_light.ambiguous,
        none.shadowed,
        "{none}"
    );
}

/// Behind a wall, with its back face in the map, the floor is lit as far as the bias reaches: a length that can be told.
#[test]
fn the_contact_gap_of_a_wall_is_the_closed_form() {
    let kind = LightKind::Spot {
        cone: 60.0,
        beam: Beam::Rectangular,
    };
    let wall =
        DMat4::from_translation(dvec3(-0.25, 1.0, 0.0)) * DMat4::from_scale(dvec3(0.5, 2.0, 4.0));
    let mut scene = floor_with(vec![(shapes::cube(), wall)], kind);
    // The light is to the left of the wall, the camera to the right: the shadow and its gap are in full view.
    let Light {
        position,
        direction,
        near,
        far,
        ..
    } = &mut scene.lights[0];
    (*position, *direction) = (dvec3(-4.0, 6.0, 0.0), dvec3(4.5, -5.5, 0.0));
    let (light, axis, near, far) = (*position, direction.normalize(), *near, *far);
    scene.camera.eye = dvec3(4.0, 4.0, 0.0);
    scene.camera.look = dvec3(-4.0, -4.0, 0.0);

    let depth = |point: DVec3| {
        let distance = (point - light).dot(axis);
        far / (far - near) * (1.0 - near / distance)
    };
    for bias in [0.002, 0.004, 0.008] {
        // On the floor at x, behind the wall's foot at x = 0; the ray to the light meets the wall's back at x = 0.
        let is_lit = |x: f64| {
            let foot = dvec3(x, 0.0, 0.0);
            let towards = light - foot;
            let back = foot + towards * (x / (x - light.x));
            depth(foot) - bias < depth(back)
        };
        let expected = (0..20_000)
            .map(|i| f64::from(i) / 20_000.0)
            .take_while(|x| is_lit(*x))
            .last()
            .unwrap();

        let settings = [
            "remedy=both",
            &format!("epsilon={bias}"),
            "map_size=4096",
            "filter=nearest",
        ];
        let mut bench = Bench::with_scene("cs541", scene.clone(), [600, 600], &settings);
        let visibility = bench.visibility();
        let rays = Rays::new(&bench.lab.now(), 0);
        let truth = rays.truth([600, 600]);
        let figures = Measure::new(&rays, &truth)
            .measure(&visibility, bench.map_scale().as_ref())
            .0;
        let gap = figures.contact_gap.expect("a gap").world;
        // A pixel is 0.01 wide there, a texel 0.002. Along the wall the gap is a little wider than in the middle.
        assert!(
            (gap - expected).abs() < 0.012 + 0.05 * expected,
            "bias {bias}: {gap}, expected {expected}\n{figures}"
        );
        assert!(expected > 0.03, "{expected}");
        println!("bias {bias}: {gap:.4}, expected {expected:.4}");
    }
}

#[test]
fn keys_settings_and_time_reach_the_truth() {
    let mut bench = Bench::new("cs541", SIZE, &["light=point"]);
    let before = truth_of(&bench.lab.now());
    bench.press("<Left><Left>w");
    bench.lab.advance(1.0);
    bench.set(&["light=spot", "beam=circular", "spot_angle=50"]);
    let after = truth_of(&bench.lab.now());
    assert!(differences(&before, &after) > 1000);
    // And there the lab and the truth still agree.
    let visibility = bench.visibility();
    let rays = Rays::new(&bench.lab.now(), 0);
    let figures = Measure::new(&rays, &after)
        .measure(&visibility, bench.map_scale().as_ref())
        .0;
    assert_eq!(
        (figures.false_shadow.interior, figures.false_light.interior),
        (0, 0),
        "{figures}"
    );
    assert!(differing(&visibility, &Bench::default_visibility()) > 100);
}
