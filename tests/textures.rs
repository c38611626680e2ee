//! A picture that several objects wear is sent to the driver once.

mod common;

use std::sync::Arc;

use common::Bench;
use image::{Rgba, RgbaImage};
use shadowlab::gl::trace;
use shadowlab::labs;
use shadowlab::scene::Scene;

/// No other picture has this size.
const SIZE: [u32; 2] = [13, 7];

fn picture() -> Arc<RgbaImage> {
    Arc::new(RgbaImage::from_pixel(SIZE[0], SIZE[1], Rgba([200; 4])))
}

/// How often the picture's largest level is sent before the first frame is drawn.
fn sent(lab: &str, scene: Scene) -> usize {
    let mut bench = Bench::recorded_with_scene(lab, scene, [16, 16], &[]);
    bench.render();
    let record = trace::to_c(&trace::take());
    let [width, height] = SIZE;
    let size = format!(", {width}, {height}, 0, GL_RGBA");
    let level = |line: &&str| line.starts_with("glTexImage2D") && line.contains(&size);
    record.lines().filter(level).count()
}

#[test]
fn a_picture_is_sent_once_however_many_objects_wear_it() {
    for lab in ["cs541", "csci3260", "aueb7"] {
        let scene = |wear: &dyn Fn() -> Arc<RgbaImage>| {
            let mut scene = (labs::find(lab).unwrap().scene)().unwrap();
            for object in &mut scene.objects {
                object.material.texture = Some(wear());
            }
            scene
        };
        let objects = scene(&picture).objects.len();
        let shared = picture();
        assert_eq!(sent(lab, scene(&|| Arc::clone(&shared))), 1, "{lab}");
        // The control: as many pictures as objects, all alike.
        assert_eq!(sent(lab, scene(&picture)), objects, "{lab}");
    }
}
