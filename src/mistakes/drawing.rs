//! Mistakes of the first pass and of the state of the map.

use super::values::first_unit;
use super::{Made, Mistake};
use crate::gl::edits::Make;

pub const MISTAKES: &[Mistake] = &[
    Mistake {
        name: "same_texture_unit",
        symptom: "the objects wear the depth map, or the shadows follow the texture",
        cause: "two samplers read the same texture unit: glUniform1i was forgotten, or went to another program",
        fix: "give each sampler a unit of its own, while its program is in use",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: shadow_sampler on texture unit 1",
                edits: edits! { uniform "shadow_sampler" in "": first_unit; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: shadowMap on texture unit 1",
                edits: edits! { uniform "shadowMap" in "": first_unit; },
            },
            Made {
                lab: "cmsc23700",
                place: "Second pass: a texture unit for each light's map",
                edits: edits! { uniform "spotMap" in "": first_unit; },
            },
            Made {
                lab: "aueb7",
                place: "The spotlight shader: the shadow map on texture unit 4",
                edits: edits! { uniform "uniform_sampler_shadow_map" in "": first_unit; },
            },
        ],
    },
    Mistake {
        name: "viewport_not_set",
        symptom: "shadows are shrunk and moved, or cut off: the map is filled in a corner, or overfull",
        cause: "the first pass draws with the window's viewport",
        fix: "glViewport with the map's size before the first pass",
        made: &[
            Made {
                lab: "cs541",
                place: "First pass: glViewport",
                edits: edits! { call "glViewport" in "first pass": Make::Nothing; },
            },
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: glViewport",
                edits: edits! { call "glViewport" in "rendering the shadow map": Make::Nothing; },
            },
            Made {
                lab: "cmsc23700",
                place: "First pass",
                edits: edits! { call "glViewport" in "first pass": Make::Nothing; },
            },
            Made {
                lab: "aueb7",
                place: "DrawSceneToShadowFBO: glViewport",
                edits: edits! { call "glViewport" in "first pass": Make::Nothing; },
            },
        ],
    },
    Mistake {
        name: "viewport_not_restored",
        symptom: "the whole picture is cropped, or fills only a corner of the window",
        cause: "the second pass draws with the map's viewport",
        fix: "glViewport with the window's size after the first pass",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: glViewport",
                edits: edits! { call "glViewport" in "second pass": Make::Nothing; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: glViewport",
                edits: edits! { call "glViewport" in "using the shadow map": Make::Nothing; },
            },
            Made {
                lab: "cmsc23700",
                place: "Second pass",
                edits: edits! { call "glViewport" in "second pass": Make::Nothing; },
            },
            Made {
                lab: "aueb7",
                place: "Render: glViewport",
                edits: edits! { call "glViewport" in "second pass": Make::Nothing; },
            },
        ],
    },
    Mistake {
        name: "map_not_cleared",
        symptom: "everything is dark, or shadows smear as the light moves",
        cause: "the map is drawn over what it held before, and a depth can only become nearer",
        fix: "glClear(GL_DEPTH_BUFFER_BIT) in the first pass, with the depth mask on",
        made: &[
            Made {
                lab: "cs541",
                place: "First pass: glClear",
                edits: edits! { call "glClear" in "first pass": Make::Nothing; },
            },
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: glClear",
                edits: edits! { call "glClear" in "rendering the shadow map": Make::Nothing; },
            },
            Made {
                lab: "cmsc23700",
                place: "First pass",
                edits: edits! { call "glClear" in "first pass": Make::Nothing; },
            },
            Made {
                lab: "aueb7",
                place: "DrawSceneToShadowFBO: glClear",
                edits: edits! { call "glClear" in "first pass": Make::Nothing; },
            },
        ],
    },
    Mistake {
        name: "mipmap_filter",
        symptom: "everything is in shadow",
        cause: "the default filter wants mipmaps, the depth texture has none: it is incomplete, and reads as 0",
        fix: "GL_NEAREST or GL_LINEAR as GL_TEXTURE_MIN_FILTER",
        made: &[
            Made {
                lab: "cs541",
                place: "Storing depth values as a texture",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MIN_FILTER] in "storing depth values": Make::Nothing;
                },
            },
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: the render target",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MIN_FILTER] in "render target": Make::Nothing;
                },
            },
            Made {
                lab: "cmsc23700",
                place: "First pass: a depth texture for each light",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MIN_FILTER] in "shadow map": Make::Nothing;
                },
            },
            Made {
                lab: "aueb7",
                place: "CreateShadowFBO",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MIN_FILTER] in "CreateShadowFBO": Make::Nothing;
                },
            },
        ],
    },
    Mistake {
        name: "compare_mode",
        symptom: "everything lit or everything in shadow, and another answer from another driver",
        cause: "GL_TEXTURE_COMPARE_MODE is set, and the shader has a plain sampler2D: what it reads is undefined",
        fix: "a comparison mode wants a sampler2DShadow, a sampler2D none",
        made: &[
            Made {
                lab: "cs541",
                place: "Storing depth values as a texture",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MAG_FILTER] in "storing depth values":
                        Make::Also(COMPARE);
                },
            },
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: the render target",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MAG_FILTER] in "render target":
                        Make::Also(COMPARE);
                },
            },
            Made {
                lab: "cmsc23700",
                place: "First pass: a depth texture for each light",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MAG_FILTER] in "shadow map":
                        Make::Also(COMPARE);
                },
            },
            Made {
                lab: "aueb7",
                place: "CreateShadowFBO",
                edits: edits! {
                    call "glTexParameteri" [1: glow::TEXTURE_MAG_FILTER] in "CreateShadowFBO":
                        Make::Also(COMPARE);
                },
            },
        ],
    },
    Mistake {
        name: "no_draw_buffer_none",
        symptom: "no shadows on some drivers, and nothing amiss on others",
        cause: "the framebuffer has no color buffer, and yet is told to draw into one: strict drivers call it incomplete",
        fix: "glDrawBuffer(GL_NONE) and glReadBuffer(GL_NONE), and ask glCheckFramebufferStatus",
        made: &[
            Made {
                lab: "csci3260",
                place: "Rendering the shadow map: glDrawBuffer(GL_NONE)",
                edits: edits! {
                    call "glDrawBuffer" in "render target": Make::Nothing;
                    call "glReadBuffer" in "render target": Make::Nothing;
                },
            },
            Made {
                lab: "aueb7",
                place: "CreateShadowFBO: glDrawBuffer(GL_NONE)",
                edits: edits! {
                    call "glDrawBuffer" in "CreateShadowFBO": Make::Nothing;
                    call "glReadBuffer" in "CreateShadowFBO": Make::Nothing;
                },
            },
        ],
    },
    Mistake {
        name: "no_swizzle",
        symptom: "everything is in shadow",
        cause: "in a core profile a depth texture reads as (d, 0, 0, 1): its .z and .g are 0",
        fix: "read .r, or set GL_TEXTURE_SWIZZLE_RGBA",
        made: &[
            Made {
                lab: "cs541",
                place: "Second pass: \"texture(shadow_sampler,uv).z\"",
                edits: edits! { call "glTexParameteriv" in "storing depth values": Make::Nothing; },
            },
            Made {
                lab: "csci3260",
                place: "Using the shadow map: \"texture(shadowMap, ShadowCoord.xy).z\"",
                edits: edits! { call "glTexParameteriv" in "render target": Make::Nothing; },
            },
        ],
    },
];

/// glTexParameteri(…, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE)
const COMPARE: &[(usize, i64)] = &[
    (1, glow::TEXTURE_COMPARE_MODE as i64),
    (2, glow::COMPARE_REF_TO_TEXTURE as i64),
];
