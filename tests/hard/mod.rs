//! Small scenes in which shadow tests go wrong.
#![allow(dead_code)]

use std::path::Path;
use std::sync::Arc;

use glam::{DMat4, DVec3, dvec3};
use shadowlab::labs;
use shadowlab::scene::{
    self, Beam, Camera, Fov, Light, LightKind, Material, Mesh, Object, Scene, rotate, shapes,
};

pub struct Case {
    pub name: String,
    pub scene: Scene,
    /// How many triangles a pixel may be tested against, on average.
    pub most_tests: f64,
}

pub const SPOT: LightKind = LightKind::Spot {
    cone: 60.0,
    beam: Beam::Circular,
};
pub const POINT: LightKind = LightKind::Point { shadow_fov: 90.0 };
pub const SUN: LightKind = LightKind::Directional {
    area: [-10.0, 10.0, -10.0, 10.0],
};

pub fn at(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(dvec3(x, y, z))
}

pub fn sized(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_scale(dvec3(x, y, z))
}

/// A sheet of 2 × 2 with the normal +y.
pub fn sheet() -> DMat4 {
    rotate(-90.0, DVec3::X)
}

/// A floor of 20 × 20 with these meshes on it, seen from the front; the light shines at the origin.
pub fn on_floor(meshes: Vec<(Mesh, DMat4)>, kind: LightKind, light: DVec3) -> Scene {
    let floor = (shapes::plane(20), sheet() * sized(10.0, 10.0, 1.0));
    scene_of([vec![floor], meshes].concat(), kind, light)
}

pub fn scene_of(meshes: Vec<(Mesh, DMat4)>, kind: LightKind, light: DVec3) -> Scene {
    let object = |(mesh, placement)| Object::new("", mesh, placement, Material::default());
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
            position: light,
            direction: -light,
            color: DVec3::ONE,
            near: 0.1,
            far: 100.0,
        }],
        ambient: DVec3::ZERO,
        sky: None,
        objects: meshes.into_iter().map(object).collect(),
    }
}

pub fn scaled(mut scene: Scene, scale: f64) -> Scene {
    scene.camera.eye *= scale;
    scene.camera.near *= scale;
    scene.camera.far = scene.camera.far.map(|far| scale * far);
    scene.lights[0].position *= scale;
    for object in &mut scene.objects {
        object.placement = DMat4::from_scale(DVec3::splat(scale)) * object.placement;
    }
    scene
}

pub fn five_shapes() -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/five_shapes.toml");
    scene::file::load(&path, false).unwrap()
}

pub fn lit_by(mut scene: Scene, kind: LightKind) -> Scene {
    scene.lights[0].kind = kind;
    scene
}

/// A sphere of unit radius whose surface goes up and down, in about 4n² triangles.
pub fn bumpy_sphere(n: u32) -> Mesh {
    let mut mesh = shapes::sphere(n);
    for position in &mut mesh.positions {
        let p = *position;
        let bump = (9.0 * p.x).sin() * (8.0 * p.y).sin() * (7.0 * p.z).sin();
        *position *= 1.0 + 0.05 * bump;
    }
    mesh
}

/// Four walls, a floor and a ceiling, each wall with a window: boxes as beams around the openings.
pub fn room_with_windows() -> Vec<(Mesh, DMat4)> {
    let beam = |low: DVec3, high: DVec3| {
        let placement = DMat4::from_translation(0.5 * (low + high)) * DMat4::from_scale(high - low);
        (shapes::cube(), placement)
    };
    let mut beams = vec![beam(dvec3(-2.1, 3.0, -2.1), dvec3(2.1, 3.1, 2.1))];
    for side in [-1.0, 1.0] {
        let wall = |low: [f64; 2], high: [f64; 2]| {
            let (near, far) = (
                f64::min(2.0 * side, 2.1 * side),
                f64::max(2.0 * side, 2.1 * side),
            );
            [
                beam(dvec3(near, low[1], low[0]), dvec3(far, high[1], high[0])),
                beam(dvec3(low[0], low[1], near), dvec3(high[0], high[1], far)),
            ]
        };
        beams.extend(wall([-2.0, 0.0], [2.0, 1.0]));
        beams.extend(wall([-2.0, 2.0], [2.0, 3.0]));
        beams.extend(wall([-2.0, 1.0], [-0.8, 2.0]));
        beams.extend(wall([0.8, 1.0], [2.0, 2.0]));
    }
    beams
}

/// Every object but the floor with some triangles twice, and some of no area. Only what faces away from the light is
/// there twice: of two lit triangles on one place neither the truth nor anybody can say which of them shadows the other.
pub fn with_duplicates(mut scene: Scene) -> Scene {
    let light = scene.lights[0].clone();
    for object in &mut scene.objects[1..] {
        let model = object.placement;
        let mesh = Arc::make_mut(&mut object.mesh);
        let own = mesh.faces.clone();
        let faces_away = |face: &&[u32; 3]| {
            let [a, b, c] = face.map(|i| model.transform_point3(mesh.positions[i as usize]));
            let along = match light.kind {
                LightKind::Directional { .. } => light.direction,
                _ => a - light.position,
            };
            (b - a).cross(c - a).dot(along) > 0.0
        };
        let again = own.iter().filter(faces_away).step_by(7);
        mesh.faces.extend(again);
        mesh.faces
            .extend(own.iter().step_by(3).map(|[a, b, _]| [*a, *b, *b]));
        mesh.faces
            .extend(own.iter().step_by(7).map(|[a, _, _]| [*a; 3]));
    }
    scene
}

pub fn with_inconsistent_winding(mut scene: Scene) -> Scene {
    for object in &mut scene.objects[1..] {
        let mesh = Arc::make_mut(&mut object.mesh);
        for face in mesh.faces.iter_mut().step_by(5) {
            face.swap(0, 1);
        }
    }
    scene
}

pub fn with_a_hole(mut scene: Scene) -> Scene {
    for object in &mut scene.objects[1..] {
        let faces = &mut Arc::make_mut(&mut object.mesh).faces;
        let half = faces.len() / 2;
        faces.drain(half..half + half / 8 + 1);
    }
    scene
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, most_tests: f64, scene: Scene| {
        cases.push(Case {
            name: name.to_owned(),
            scene,
            most_tests,
        });
    };
    let lab = |name: &str| (labs::find(name).unwrap().scene)().unwrap();
    let above = dvec3(-3.0, 6.0, 2.0);
    let solids = || {
        vec![
            (shapes::sphere(24), at(1.0, 1.0, 0.0)),
            (shapes::cube(), at(-1.0, 0.5, 1.0) * rotate(20.0, DVec3::Y)),
            (
                shapes::torus(0.35, 24),
                at(-2.5, 1.0, -1.0) * rotate(-60.0, DVec3::X),
            ),
            (shapes::cube(), at(1.0, 1.0, -3.0) * sized(3.0, 2.0, 0.005)),
        ]
    };

    add("cs541", 2.0, lab("cs541"));
    add("csci3260", 2.0, lab("csci3260"));
    add("five shapes", 1.0, five_shapes());
    add("five shapes, point", 1.0, lit_by(five_shapes(), POINT));
    add("five shapes, sun", 1.0, lit_by(five_shapes(), SUN));
    for (how, kind) in [("spot", SPOT), ("point", POINT), ("sun", SUN)] {
        let solids = || on_floor(solids(), kind, above);
        add(&format!("solids, {how}"), 1.0, solids());
        let moved = solids().moved(dvec3(1e5, -1e5, 1e5));
        add(&format!("solids, {how}, 1e5 away"), 1.0, moved);
        let moved = solids().moved(dvec3(1e6, -1e6, 1e6));
        add(&format!("solids, {how}, 1e6 away"), 1.0, moved);
        add(&format!("solids, {how}, 1e-3"), 1.0, scaled(solids(), 1e-3));
        add(&format!("solids, {how}, 1e4"), 1.0, scaled(solids(), 1e4));
        add(
            &format!("duplicates, {how}"),
            1.0,
            with_duplicates(solids()),
        );
        add(&format!("holes, {how}"), 3.0, with_a_hole(solids()));
        add(
            &format!("winding, {how}"),
            3.0,
            with_inconsistent_winding(solids()),
        );
        let overhead = on_floor(self::solids_low(), kind, dvec3(0.0, 6.0, 0.0));
        add(&format!("overhead, {how}"), 1.0, overhead);

        // One sheet, two that touch, a roof of two.
        let canopy = at(0.5, 1.5, 0.0) * rotate(15.0, DVec3::Z) * sheet();
        let beside = at(0.5, 1.5, 0.0) * rotate(15.0, DVec3::Z) * at(2.0, 0.0, 0.0) * sheet();
        let roof = |side: f64| {
            at(-3.0, 2.0, 0.0) * rotate(side * 40.0, DVec3::Z) * at(-side, 0.0, 0.0) * sheet()
        };
        let sheets = [canopy, beside, roof(1.0), roof(-1.0)];
        let sheets = sheets.map(|placement| (shapes::plane(1), placement));
        add(
            &format!("sheets, {how}"),
            2.0,
            on_floor(sheets.to_vec(), kind, above),
        );

        // From 60 to 89.9 degrees from the floor's normal, with poles.
        for degrees in [60.0, 85.0, 89.0, 89.9_f64] {
            let light = 9.0 * rotate(degrees, DVec3::NEG_Z).transform_vector3(DVec3::Y);
            let poles = (0..5).map(|i| {
                let x = f64::from(i) - 2.0;
                (
                    shapes::cube(),
                    at(x, 0.75, 0.3 * x) * sized(0.02, 1.5, 0.02),
                )
            });
            let poles = on_floor(poles.collect(), kind, light);
            add(&format!("grazing {degrees}, {how}"), 2.0, poles);
        }
    }
    for cone in [150.0, 170.0] {
        let beam = Beam::Rectangular;
        let wide = on_floor(
            solids(),
            LightKind::Spot { cone, beam },
            dvec3(-1.5, 2.0, 1.0),
        );
        add(&format!("beam of {cone}"), 2.0, wide);
    }
    // Casters behind the light and across its plane; a corner exactly at w = 0.
    let mut across = on_floor(
        vec![
            (shapes::cube(), at(0.0, 3.0, 0.0) * sized(0.3, 6.0, 0.3)),
            (shapes::sphere(12), at(-4.0, 6.5, 2.5)),
            (shapes::cube(), at(-0.5, 1.5, 1.5) * sized(1.0, 3.0, 1.0)),
        ],
        LightKind::Spot {
            cone: 120.0,
            beam: Beam::Rectangular,
        },
        dvec3(-2.0, 3.0, 1.0),
    );
    across.lights[0].direction = DVec3::X;
    add("across w = 0", 1.0, across);
    add(
        "point light in a room",
        2.0,
        on_floor(room_with_windows(), POINT, dvec3(0.3, 1.6, 0.2)),
    );
    add(
        "light inside a caster",
        1.0,
        on_floor(
            vec![
                (shapes::sphere(16), at(0.3, 1.6, 0.2) * sized(0.5, 0.5, 0.5)),
                (shapes::cube(), at(2.0, 0.5, 0.0)),
            ],
            POINT,
            dvec3(0.3, 1.6, 0.2),
        ),
    );
    let bumpy = || vec![(bumpy_sphere(224), at(0.0, 2.0, 0.0) * sized(2.0, 2.0, 2.0))];
    for (how, kind) in [("spot", SPOT), ("point", POINT), ("sun", SUN)] {
        let scene = on_floor(bumpy(), kind, dvec3(-6.0, 6.0, -1.0));
        add(&format!("bumpy sphere, {how}"), 4.0, scene);
    }
    let mut lamp = on_floor(solids(), POINT, dvec3(1.0, 2.3, 0.0));
    lamp.lights[0].direction = DVec3::NEG_Y;
    add("0.3 from a sphere", 1.0, lamp);
    cases
}

fn solids_low() -> Vec<(Mesh, DMat4)> {
    vec![
        (shapes::sphere(24), at(1.0, 1.0, 0.0)),
        (shapes::cube(), at(-1.0, 0.5, 1.0)),
        (shapes::cube(), at(0.0, 2.0, -2.0) * rotate(30.0, DVec3::X)),
    ]
}
