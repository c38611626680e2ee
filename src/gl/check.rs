//! A failure that GL would keep to itself stops the program here.

use glow::HasContext;

use crate::{Error, Result};

/// The framebuffer bound to `GL_FRAMEBUFFER` must be complete; `name` is what the lab calls it.
pub fn check_framebuffer(gl: &glow::Context, name: &str) -> Result<()> {
    let status = unsafe { gl.check_framebuffer_status(glow::FRAMEBUFFER) };
    let found = match status {
        glow::FRAMEBUFFER_COMPLETE => return Ok(()),
        glow::FRAMEBUFFER_INCOMPLETE_ATTACHMENT => "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT",
        glow::FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT => {
            "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT"
        }
        glow::FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER => "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER",
        glow::FRAMEBUFFER_INCOMPLETE_READ_BUFFER => "GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER",
        glow::FRAMEBUFFER_UNSUPPORTED => "GL_FRAMEBUFFER_UNSUPPORTED",
        other => return Err(Error::gl(format!("{name}: framebuffer status {other:#x}"))),
    };
    Err(Error::gl(format!(
        "{name}: {found}, expected GL_FRAMEBUFFER_COMPLETE"
    )))
}

/// No call since the last check may have left an error; `doing` names what was done.
pub fn check_errors(gl: &glow::Context, doing: &str) -> Result<()> {
    let found = match unsafe { gl.get_error() } {
        glow::NO_ERROR => return Ok(()),
        glow::INVALID_ENUM => "GL_INVALID_ENUM",
        glow::INVALID_VALUE => "GL_INVALID_VALUE",
        glow::INVALID_OPERATION => "GL_INVALID_OPERATION",
        glow::INVALID_FRAMEBUFFER_OPERATION => "GL_INVALID_FRAMEBUFFER_OPERATION",
        glow::OUT_OF_MEMORY => "GL_OUT_OF_MEMORY",
        other => return Err(Error::gl(format!("{doing}: GL error {other:#x}"))),
    };
    Err(Error::gl(format!("{doing}: {found}, expected no GL error")))
}
