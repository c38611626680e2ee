//! Mistakes of the light's camera.

use super::values::{
    degrees_for_radians, mapped_degrees_for_radians, mapped_too_narrow, mapped_too_near,
    mapped_too_wide, too_narrow, too_near, too_wide, unrotated, without_right,
};
use super::{Made, Mistake};

/// Both passes use the light's camera; in each lab, these are their matrices.
macro_rules! both_passes {
    ($clipped:path, $mapped:path) => {
        &[
            both_passes!(cs541 $clipped),
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: depthProjectionMatrix",
                edits: edits! {
                    uniform "depthMVP" in "": $clipped;
                    uniform "DepthBiasMVP" in "": $mapped;
                },
            },
            both_passes!(cmsc23700 $clipped, $mapped),
            both_passes!(aueb7 $clipped),
        ]
    };
    (perspective $clipped:path, $mapped:path) => {
        &[
            both_passes!(cs541 $clipped),
            both_passes!(cmsc23700 $clipped, $mapped),
            both_passes!(aueb7 $clipped),
        ]
    };
    (cs541 $clipped:path) => {
        Made {
            lab: "cs541",
            place: "First pass: the camera with its center of projection at the light",
            edits: edits! {
                uniform "persp_matrix" in "first pass": $clipped;
                uniform "shadow_persp_matrix" in "": $clipped;
            },
        }
    };
    (cmsc23700 $clipped:path, $mapped:path) => {
        Made {
            lab: "cmsc23700",
            place: "Hints: the light's projection",
            edits: edits! {
                uniform "lightModelViewProjection" in "": $clipped;
                uniform "directionalTextureMatrix" in "": $mapped;
                uniform "spotTextureMatrix" in "": $mapped;
            },
        }
    };
    (aueb7 $clipped:path) => {
        Made {
            lab: "aueb7",
            place: "DrawSceneToShadowFBO: the light's projection",
            edits: edits! {
                uniform "uniform_mvp" in "first pass": $clipped;
                uniform "uniform_light_view_projection" in "": $clipped;
            },
        }
    };
}

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "light_along_up",
        symptom: "with the light straight overhead the shadows are gone",
        cause: "the light looks along the up vector: their cross product is zero, and the view matrix is NaN",
        fix: "choose another up vector where the light looks along it",
        made: &[Made {
            lab: "cs541",
            place: "First pass: the camera with its center of projection at the light",
            edits: edits! {
                uniform "view_matrix" in "first pass": without_right;
                uniform "shadow_view_matrix" in "": without_right;
            },
        }],
    },
    Mistake {
        name: "frustum_too_small",
        symptom: "shadows are cut off along a straight line",
        cause: "the light's field of view or box does not hold the whole scene",
        fix: "fit it to everything that casts a shadow",
        made: both_passes!(too_narrow, mapped_too_narrow),
    },
    Mistake {
        name: "frustum_too_large",
        symptom: "shadows are made of large blocks",
        cause: "the light's field of view or box is many times larger than the scene: most texels see nothing of it",
        fix: "fit it to everything that casts a shadow",
        made: both_passes!(too_wide, mapped_too_wide),
    },
    Mistake {
        name: "near_too_small",
        symptom: "all depths are near 1, so that the bias is too large: shadows shrink or are gone",
        cause: "a perspective depth spends its values near the near plane, which is almost at 0",
        fix: "put the near plane as far out as the scene allows",
        made: both_passes!(perspective too_near, mapped_too_near),
    },
    Mistake {
        name: "degrees_for_radians",
        symptom: "the light's view is wild: shadows are huge, tiny or mirrored",
        cause: "an angle in degrees goes into a function that takes radians",
        fix: "convert it",
        made: both_passes!(perspective degrees_for_radians, mapped_degrees_for_radians),
    },
    Mistake {
        name: "model_matrix_differs",
        symptom: "shadows do not have the shape, the size or the turn of what casts them",
        cause: "the first pass leaves out a part of an object's model matrix",
        fix: "draw both passes with one function and the same matrices",
        made: &[Made {
            lab: "cs541",
            place: "First pass: model_matrix",
            edits: edits! { uniform "model_matrix" in "first pass": unrotated; },
        }],
    },
];
