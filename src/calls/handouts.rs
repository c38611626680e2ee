//! What each handout asks for, and where: the places that a report names.

/// A handout with a shadow map.
pub struct Handout {
    pub lab: &'static str,
    /// Storing depth values as a texture.
    pub set_up: &'static str,
    /// Drawing the map.
    pub first_pass: &'static str,
    /// Drawing the picture.
    pub second_pass: &'static str,
    /// The way from a point to its texel.
    pub matrix: &'static str,
    /// The bias, and what else there is against acne.
    pub acne: &'static str,
    /// Its first pass may be drawn by the fixed pipeline.
    pub fixed_pipeline: bool,
    /// It asks whether the framebuffer is complete.
    pub asks_complete: bool,
    /// Its shader asks whether a point lies on the map, so that the wrap mode has no say, but for filters at the edge.
    pub asks_range: bool,
    /// Its shader reads a component behind the first one.
    pub reads_beyond_red: bool,
    /// Its program multiplies by B, and its shader does not.
    pub bias_in_program: bool,
}

pub const MAPS: &[Handout] = &[
    Handout {
        lab: "cs541",
        set_up: "Storing depth values as a texture",
        first_pass: "First pass: drawing the shadow map",
        second_pass: "Second pass: using the shadow map",
        matrix: "Second pass: equation (1)",
        acne: "Shadow acne",
        fixed_pipeline: false,
        asks_complete: false,
        asks_range: true,
        reads_beyond_red: true,
        bias_in_program: false,
    },
    Handout {
        lab: "csci3260",
        set_up: "Rendering the shadow map: the render target",
        first_pass: "Rendering the shadow map: paintGL()",
        second_pass: "Using the shadow map: basic shader",
        matrix: "Using the shadow map: a little trick about depth MVP",
        acne: "Shadow acne, Peter Panning",
        fixed_pipeline: false,
        asks_complete: true,
        asks_range: false,
        reads_beyond_red: true,
        bias_in_program: true,
    },
    Handout {
        lab: "cmsc23700",
        set_up: "2. Description: a depth texture for each light, with fbo.h",
        first_pass: "2. Description: first pass",
        second_pass: "2. Description: second pass",
        matrix: "2.4 Hints: the texture matrix",
        acne: "2. Description: second pass, the test",
        fixed_pipeline: true,
        asks_complete: false,
        asks_range: false,
        reads_beyond_red: false,
        bias_in_program: true,
    },
    Handout {
        lab: "aueb7",
        set_up: "CreateShadowFBO",
        first_pass: "DrawSceneToShadowFBO",
        second_pass: "Render: the second pass",
        matrix: "The spotlight shader: position_lcs",
        acne: "Exercise 3: constant_depth_bias",
        fixed_pipeline: false,
        asks_complete: false,
        asks_range: false,
        reads_beyond_red: false,
        bias_in_program: false,
    },
];

// Projected shadows have a handout of their own: eecs487.
pub const HARD: &str = "1. Hard shadows";
pub const CLIPPED: &str = "2. Clipped projected shadows";
pub const SOFT: &str = "3. Soft shadows";
pub const FBO: &str = "4. Framebuffer object";
