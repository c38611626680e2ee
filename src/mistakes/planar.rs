//! Mistakes of projected shadows.

use super::values::never;
use super::{Made, Mistake};
use crate::gl::edits::Make;

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "no_polygon_offset",
        symptom: "shadows flicker: wall and shadow show through each other in stripes",
        cause: "wall and shadow lie in one plane, and their depths differ by rounding only",
        fix: "glPolygonOffset for the shadows",
        made: &[Made {
            lab: "eecs487",
            place: "1. Hard shadows: glPolygonOffset",
            edits: edits! {
                file "wall.frag": "gl_FragDepth = dot(planeDepth, vec3(gl_FragCoord.xy, 1));" =>
                    "gl_FragDepth = gl_FragCoord.z + 0.0 * planeDepth.z;";
                file "shadow.frag": "gl_FragDepth = dot(planeDepth, vec3(gl_FragCoord.xy, 1)) - nearer;" =>
                    "gl_FragDepth = gl_FragCoord.z + 0.0 * planeDepth.z;";
            },
        }],
    },
    Mistake {
        name: "plane_sign",
        symptom: "no shadow",
        cause: "the plane's equation has the wrong sign, so that everything is behind it",
        fix: "the plane's normal points into the room, and A·x + B·y + C·z + D is positive there",
        made: &[Made {
            lab: "eecs487",
            place: "1. Hard shadows: multShadowMat",
            edits: edits! {
                file "shadow.vert": "dot(wall, vec4(position, 1))" => "-dot(wall, vec4(position, 1))";
            },
        }],
    },
    Mistake {
        name: "divided_early",
        symptom: "anti-shadows: shadows of what lies beyond the light",
        cause: "the projected point is divided by w before clipping, which then cannot see that w was negative",
        fix: "keep w, and let the clipping drop what is behind the light",
        made: &[Made {
            lab: "eecs487",
            place: "1. Hard shadows: multShadowMat",
            edits: edits! {
                file "shadow.vert": "gl_Position = modelViewProjection * vec4(position, 1);" =>
                    "gl_Position = modelViewProjection * vec4(position, 1);\n    gl_Position /= gl_Position.w;";
            },
        }],
    },
    Mistake {
        name: "weights_wrong",
        symptom: "the picture is too bright, or burnt out",
        cause: "the weights of the accumulated pictures do not sum up to 1",
        fix: "give each of n pictures the weight 1/n",
        made: &[Made {
            lab: "eecs487",
            place: "4. fbo_accum(weight)",
            edits: edits! { call "glBlendColor" in "": Make::Instead(&[(3, 1)]); },
        }],
    },
    Mistake {
        name: "accumulator_not_cleared",
        symptom: "ghosts of the frames before, brighter and brighter; the first frame is right where the driver gives cleared \
                  memory",
        cause: "the accumulation buffer keeps what the frames before added up",
        fix: "clear it before the first of a frame's pictures is accumulated",
        made: &[Made {
            lab: "eecs487",
            place: "4. fbo_accum(weight)",
            edits: edits! { call "glClearBufferfv" in "soft shadows": Make::Nothing; },
        }],
    },
    Mistake {
        name: "shadow_matrix_row_major",
        symptom: "shadows are sheared out of place, or gone",
        cause: "the shadow matrix is uploaded row by row",
        fix: "GLSL and OpenGL take matrices column by column: transpose it",
        made: &[Made {
            lab: "eecs487",
            place: "1. Hard shadows: multShadowMat",
            edits: edits! {
                file "shadow.vert": "modelViewProjection * vec4(position, 1)" =>
                    "transpose(modelViewProjection) * vec4(position, 1)";
            },
        }],
    },
    Mistake {
        name: "shadow_color_never_set",
        symptom: "shadows are black",
        cause: "the shadow's color is a uniform that was misspelt or never set",
        fix: "set it to 0.3 times the wall's color",
        made: &[Made {
            lab: "eecs487",
            place: "1. Hard shadows: the shadow's color",
            edits: edits! { uniform "shadowColor" in "": never; },
        }],
    },
];
