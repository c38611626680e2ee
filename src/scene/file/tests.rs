use std::io;

use glam::{DVec2, dvec3};

use super::*;
use crate::scene::{Beam, Fov, Light, LightKind};

const CAMERA: &str = "[camera]\neye = [0, 5, 10]\ntarget = [0, 0, 0]\n";
const OBJECT: &str = "[[object]]\nmesh = \"cube\"\n";
const TRIANGLE: &str = "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn parsed(text: &str) -> Result<Scene> {
    let files = Files::new(|path, _| match path.to_str() {
        Some("folder/models/m.obj") => Ok(TRIANGLE.into()),
        Some("folder/models/m.mtl") => Ok("newmtl red\nKd 1 0 0\nNs 7\n".into()),
        _ => Err(Error::reading(path, io::ErrorKind::NotFound.into())),
    });
    parse(Path::new("folder/s.toml"), text, &files)
}

fn with_light(light: &str) -> Result<Light> {
    parsed(&format!("{CAMERA}[light]\n{light}\n{OBJECT}")).map(|mut scene| scene.lights.remove(0))
}

#[test]
fn the_defaults_are_those_of_the_documentation() {
    let text = format!("{CAMERA}[light]\nposition = [4, 7, 5]\n{OBJECT}");
    let scene = parsed(&text).unwrap();
    assert_eq!(scene.size, None);
    assert_eq!(scene.clear, dvec3(0.1, 0.1, 0.15));
    assert_eq!(scene.ambient, DVec3::splat(0.2));
    assert!(scene.sky.is_none());
    assert_eq!(scene.camera.fov, Fov::Vertical(45.0));
    assert_eq!((scene.camera.near, scene.camera.far), (0.1, None));
    assert_eq!(scene.camera.look, dvec3(0.0, -5.0, -10.0));
    let light = &scene.lights[0];
    let beam = Beam::Circular;
    assert_eq!(light.kind, LightKind::Spot { cone: 60.0, beam });
    assert_eq!((light.near, light.far), (1.0, 30.0));
    assert_eq!(light.direction, -light.position);
    let object = &scene.objects[0];
    assert_eq!(object.model(3.0), glam::DMat4::IDENTITY);
    assert_eq!(object.material.specular, DVec3::splat(0.5));
    assert_eq!(object.material.shininess, 50.0);
    assert!(object.casts && !object.plane);
}

#[test]
fn scale_comes_first_then_the_turns_in_order_then_the_move() {
    let text = format!(
        "{CAMERA}[[object]]\nmesh = \"plane\"\nscale = [2, 3, 4]\ntranslate = [10, 0, 0]\n\
         rotate = [{{ axis = [0, 0, 1], degrees = 90 }}, {{ axis = [1, 0, 0], degrees = 90 }}]\n\
         spin = {{ axis = [0, 0, 1], degrees_per_second = 90 }}\n"
    );
    let scene = parsed(&text).unwrap();
    let object = &scene.objects[0];
    assert!(object.plane);
    // x scaled by 2, then to y, then to z, then moved.
    let moved = object.model(0.0).transform_point3(DVec3::X);
    assert!(moved.abs_diff_eq(dvec3(10.0, 0.0, 2.0), 1e-12), "{moved}");
    // The spin goes before: x to y, which is scaled by 3.
    let spun = object.model(1.0).transform_point3(DVec3::X);
    assert!(spun.abs_diff_eq(dvec3(7.0, 0.0, 0.0), 1e-12), "{spun}");
}

#[test]
fn a_model_keeps_its_material_unless_the_scene_gives_one() {
    let text = format!(
        "{CAMERA}[[object]]\nmesh = \"models/m.obj\"\n[[object]]\nmesh = 'models\\m.obj'\ndiffuse = [0, 1, 0]\n"
    );
    let scene = parsed(&text).unwrap();
    let [own, given] = &scene.objects[..] else {
        panic!("{} objects", scene.objects.len())
    };
    assert_eq!(own.material.diffuse, DVec3::X);
    assert_eq!(given.material.diffuse, DVec3::Y);
    assert_eq!(given.material.shininess, 7.0);
    assert!(std::sync::Arc::ptr_eq(&own.mesh, &given.mesh));
}

#[test]
fn every_kind_of_light() {
    let light = with_light("kind = \"point\"\nposition = [0, 1, 0]\nshadow_fov = 100").unwrap();
    assert_eq!(light.kind, LightKind::Point { shadow_fov: 100.0 });
    let light = with_light("beam = \"rectangular\"\nposition = [0, 1, 0]\ncone = 30").unwrap();
    let beam = Beam::Rectangular;
    assert_eq!(light.kind, LightKind::Spot { cone: 30.0, beam });
    let light = with_light(
        "kind = \"directional\"\ndirection = [0, -1, 0]\nposition = [0, 9, 0]\nbox = [-1, 2, -3, 4, -5, 6]",
    )
    .unwrap();
    let area = [-1.0, 2.0, -3.0, 4.0];
    assert_eq!(light.kind, LightKind::Directional { area });
    assert_eq!((light.near, light.far), (-5.0, 6.0));
}

/// The fitted box holds the scene, and not much more; wherever the light is said to be.
#[test]
fn a_directional_light_is_fitted_to_the_scene() {
    for position in ["", "position = [3, 9, 2]\n"] {
        let light = with_light(&format!(
            "kind = \"directional\"\n{position}direction = [0, -2, 0]"
        ));
        let light = light.unwrap();
        let LightKind::Directional { area } = light.kind else {
            panic!("{:?}", light.kind)
        };
        let [left, right, bottom, top] = area;
        let size = dvec3(right - left, top - bottom, light.far - light.near);
        assert!(size.abs_diff_eq(DVec3::splat(1.02), 1e-9), "{size}");
        let middle = light.position.y - (light.near + light.far) / 2.0;
        assert!(middle.abs() < 1e-9, "{middle}");
        if position.is_empty() {
            assert!(light.near.abs() < 1e-9 && light.position.y > 0.5);
            assert!(DVec2::new(left + right, bottom + top).length() < 1e-9);
        }
    }
}

#[test]
fn lights_may_be_several() {
    let light = "[[light]]\nposition = [4, 7, 5]\n";
    let scene = parsed(&format!("{CAMERA}{light}{light}{OBJECT}")).unwrap();
    assert_eq!(scene.lights.len(), 2);
    assert!(
        parsed(&format!("{CAMERA}{OBJECT}"))
            .unwrap()
            .lights
            .is_empty()
    );
}

/// What stands in the table of the module's documentation is what is known.
#[test]
fn every_key_is_documented() {
    let documentation = include_str!("mod.rs");
    let known = [camera::KEYS, light::KEYS, object::KEYS].concat();
    for key in known.iter().chain(&["size", "clear", "ambient", "sky"]) {
        assert!(documentation.contains(&format!("`{key}`")), "{key}");
    }
}
