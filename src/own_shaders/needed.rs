//! What the handouts' shadows do not come about without. Everything else that a lab sets, a student's shader may go
//! without.

pub struct Needed {
    /// What places the scene, in the window and in the map.
    pub uniforms: &'static [&'static str],
    /// The shadow maps.
    pub maps: &'static [&'static str],
    /// Where a point is on the map, from the vertex shader.
    pub coordinates: &'static [&'static str],
}

pub fn needed(lab: &str) -> Needed {
    match lab {
        "cs541" => Needed {
            uniforms: &[
                "persp_matrix",
                "view_matrix",
                "model_matrix",
                "shadow_persp_matrix",
                "shadow_view_matrix",
            ],
            maps: &["shadow_sampler"],
            coordinates: &["vshadow_position"],
        },
        "eecs487" => Needed {
            uniforms: &["modelViewProjection"],
            maps: &[],
            coordinates: &[],
        },
        "csci3260" => Needed {
            uniforms: &["depthMVP", "MVP", "DepthBiasMVP"],
            maps: &["shadowMap"],
            coordinates: &["ShadowCoord"],
        },
        "cmsc23700" => Needed {
            uniforms: &[
                "lightModelViewProjection",
                "modelView",
                "projection",
                "directionalTextureMatrix",
                "spotTextureMatrix",
            ],
            maps: &["directionalMap", "spotMap"],
            coordinates: &["directionalCoord", "spotCoord"],
        },
        "aueb7" => Needed {
            uniforms: &[
                "uniform_mvp",
                "uniform_m",
                "uniform_v",
                "uniform_p",
                "uniform_light_view_projection",
            ],
            maps: &["uniform_sampler_shadow_map"],
            coordinates: &[],
        },
        _ => unreachable!("every lab is here, as a test holds"),
    }
}
