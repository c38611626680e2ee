//! What can be wrong with calls besides the classic mistakes: what it does to the picture, and how it is mended.

pub struct Fault {
    pub effect: &'static str,
    pub fix: &'static str,
}

/// What calls alone do not tell.
pub const NOT_TOLD: Fault = Fault {
    effect: "",
    fix: "",
};

// The map.

pub const NO_MAP: Fault = Fault {
    effect: "there is no shadow map, and so no shadow, or everything is in shadow",
    fix: "attach a depth texture as GL_DEPTH_ATTACHMENT to a framebuffer, and draw the scene into it",
};
pub const NOTHING_DRAWN: Fault = Fault {
    effect: NO_MAP.effect,
    fix: "bind the framebuffer before the first pass, and draw the scene",
};
pub const NO_IMAGE: Fault = Fault {
    effect: "no shadow, or everything is in shadow",
    fix: "give the texture its size before it is attached",
};
pub const READ_BUFFER: Fault = Fault {
    effect: "none here; a driver of OpenGL 3 may call the framebuffer incomplete: no shadows",
    fix: "glReadBuffer(GL_NONE)",
};
pub const UNCHECKED: Fault = Fault {
    effect: "where a driver calls the framebuffer incomplete the map stays empty, and nobody is told",
    fix: "ask when everything is attached, and stop where the status is another",
};
pub const INCOMPLETE: Fault = Fault {
    effect: "nothing is drawn into the map: no shadows, or everything in shadow",
    fix: "attach an image that has a size, and set the draw buffer to GL_NONE",
};
pub const NO_DEPTH_WRITTEN: Fault = Fault {
    effect: "the map stays empty: no shadows",
    fix: "glEnable(GL_DEPTH_TEST), glDepthMask(GL_TRUE)",
};
pub const NO_SHADOW_PROGRAM: Fault = Fault {
    effect: "none, where the fixed pipeline's matrices are the light's",
    fix: "select the shadow program",
};
pub const OTHER_LIGHT: Fault = Fault {
    effect: "where they are another light's, shadows are out of place",
    fix: "",
};

// The picture.

pub const NOT_RESTORED: Fault = Fault {
    effect: "the window stays as it was: empty, or with its last picture",
    fix: "bind framebuffer 0 before the second pass",
};
pub const ATTACHED: Fault = Fault {
    effect: "the window stays empty, and what is read from a texture that is drawn to is undefined",
    fix: NOT_RESTORED.fix,
};
pub const WINDOW_GETS_NO_COLOR: Fault = Fault {
    effect: "the window stays empty",
    fix: "call glDrawBuffer(GL_NONE) while the map's framebuffer is bound: each has its own",
};
pub const CULLING: Fault = Fault {
    effect: "objects are seen from inside",
    fix: "reset the culling face behind the first pass",
};
pub const DEPTH_NOT_CLEARED: Fault = Fault {
    effect: "of the frames behind the first one little or nothing is seen",
    fix: "clear color and depth before the second pass",
};
pub const NOTHING_READS: Fault = Fault {
    effect: "there are no shadows",
    fix: "select the lighting program, and give it a sampler for the map",
};
pub const NOT_BOUND: Fault = Fault {
    effect: "no shadow, or shadows that follow another texture",
    fix: "glActiveTexture with the sampler's unit, then glBindTexture with the depth texture",
};

// Uniforms.

pub const NO_PROGRAM: Fault = Fault {
    effect: "the uniform keeps its old value, which is 0 at first",
    fix: "glUseProgram before glUniform",
};
pub const OTHER_PROGRAM: Fault = Fault {
    effect: "one program's uniform is overwritten or nothing happens, and the other's stays as it was",
    fix: "glUseProgram with the program whose location it is",
};
pub const OTHER_TYPE: Fault = Fault {
    effect: "the driver refuses it, and the uniform keeps its old value",
    fix: "use the function of the uniform's type, with the program that is meant",
};

// Projected shadows.

pub const NO_PROJECTION: Fault = Fault {
    effect: "there is no shadow",
    fix: "multiply by (plane·light)·I − light⊗plane before the occluders are drawn",
};
pub const NOT_CLIPPED: Fault = Fault {
    effect: "shadows go on past the edges of the wall",
    fix: "glStencilFunc(GL_EQUAL, 1, …) behind the wall",
};
pub const CLIPPING_OFF: Fault = Fault {
    effect: NOT_CLIPPED.effect,
    fix: "the key c of the handout's program switches it on",
};
pub const STENCIL_NOT_FILLED: Fault = Fault {
    effect: "the stencil is 1 nowhere, and so there are no shadows",
    fix: "glStencilFunc(GL_ALWAYS, 1, …) and glStencilOp(…, GL_REPLACE) before the wall is drawn",
};
pub const STENCIL_NOT_CLEARED: Fault = Fault {
    effect: "shadows stay allowed where a wall was in an earlier frame",
    fix: "glClear(… | GL_STENCIL_BUFFER_BIT)",
};

// Soft shadows.

pub const HARD: Fault = Fault {
    effect: "shadows are hard",
    fix: "the key f of the handout's program switches to soft shadows",
};
pub const SUM_THEN_DIVIDE: Fault = Fault {
    effect: "a buffer that holds [-1, 1] runs over: most of the picture is dark (Fig. 2(b))",
    fix: "weight each picture by 1/numJitters as it is added",
};
pub const NOT_RETURNED: Fault = Fault {
    effect: "the window shows the last picture alone, or none: no soft shadows",
    fix: "move the accumulated picture to the window with full weight",
};
pub const BANDS: Fault = Fault {
    effect: "bands, as in Fig. 2(a)",
    fix: "GL_RGBA32F, or GL_RGB32F where the driver has it",
};
