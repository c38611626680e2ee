//! The truth of every scene that a report meets, cast once each.

use crate::compare::Shadows;
use crate::ground_truth::{Rays, Truth};
use crate::labs::MapScale;
use crate::measure::{Figures, Measure, only_known};
use crate::scene::Scene;

/// A scene under one of its lights, and what is in shadow there.
struct Known {
    scene: Scene,
    light: usize,
    rays: Rays,
    truth: Truth,
}

/// What was asked so far, for pictures of one size.
pub struct Truths {
    size: [u32; 2],
    known: Vec<Known>,
}

impl Truths {
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            known: Vec::new(),
        }
    }

    /// The errors of the shadows in a picture of the scene, as far as they are known, and the picture that shows them. `light` counts from 1.
    pub fn measure(
        &mut self,
        scene: Scene,
        light: usize,
        shadows: Shadows,
        map: Option<&MapScale>,
    ) -> (Figures, image::RgbImage) {
        let asked_before =
            |known: &Known| known.light == light && looks_alike(&known.scene, &scene);
        let index = self.known.iter().position(asked_before);
        let index = index.unwrap_or_else(|| {
            let rays = Rays::new(&scene, light - 1);
            let truth = rays.truth(self.size);
            self.known.push(Known {
                scene,
                light,
                rays,
                truth,
            });
            self.known.len() - 1
        });
        let Known { rays, truth, .. } = &self.known[index];
        let (visibility, _) = only_known(shadows.visibility, &shadows.known, truth);
        Measure::new(rays, truth).measure(&visibility, map)
    }
}

/// Whether two states of one lab are the same to the truth. Their meshes are the lab's own, made once.
fn looks_alike(a: &Scene, b: &Scene) -> bool {
    let objects = a.objects.iter().zip(&b.objects);
    let mut same = objects.map(|(a, b)| {
        std::sync::Arc::ptr_eq(&a.mesh, &b.mesh) && a.placement == b.placement && a.casts == b.casts
    });
    a.objects.len() == b.objects.len()
        && same.all(|same| same)
        && a.camera == b.camera
        && a.lights == b.lights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labs;

    #[test]
    fn scenes_that_differ_to_the_truth_are_told_apart() {
        let scene = (labs::find("cs541").unwrap().scene)().unwrap();
        assert!(looks_alike(&scene, &scene.clone()));
        let edits: [fn(&mut Scene); 5] = [
            |scene| scene.objects[1].placement.w_axis.x += 1e-9,
            |scene| scene.objects[1].casts = false,
            |scene| scene.objects.truncate(2),
            |scene| scene.camera.eye.x += 1e-9,
            |scene| scene.lights[0].position.x += 1e-9,
        ];
        for edit in edits {
            let mut edited = scene.clone();
            edit(&mut edited);
            assert!(!looks_alike(&scene, &edited));
        }
    }
}
