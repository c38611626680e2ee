//! The desktop viewer: a lab in a window, with its keys, the mouse, and shaders that are read again when saved.
//!
//! | file | what it does |
//! |---|---|
//! | `app` | from the connection to the desktop to the exit |
//! | `viewer` | what happens when: keys and mouse |
//! | `frame` | frames and time |
//! | `stage` | the lab, with everything that was done to it |
//! | `mouse` | the mouse over the picture |
//! | `canvas` | the window with its OpenGL 3.3 core context, by GLX or EGL |
//! | `keys` | the desktop's keys and mouse as the labs know them, and the viewer's own keys |
//! | `panels` | what stands over the picture: keys, messages, the depth map |
//! | `panel` | what stands beside it on a key: settings, mistakes, what is inside |
//! | `text` | letters into an image |
//! | `shot` | F12: a file, and the command line that draws it again |
//! | `trial` | a saved shader, tried in a process of its own |
//! | `watch` | the student's folder of shaders |

#[cfg(target_os = "linux")]
mod app;
#[cfg(target_os = "linux")]
mod canvas;
#[cfg(target_os = "linux")]
mod frame;
#[cfg(target_os = "linux")]
mod keys;
#[cfg(target_os = "linux")]
mod mouse;
#[cfg(target_os = "linux")]
mod panel;
#[cfg(target_os = "linux")]
mod panels;
#[cfg(target_os = "linux")]
mod shot;
#[cfg(target_os = "linux")]
mod stage;
#[cfg(target_os = "linux")]
mod text;
#[cfg(target_os = "linux")]
mod trial;
#[cfg(target_os = "linux")]
mod viewer;
#[cfg(target_os = "linux")]
mod watch;

use std::path::PathBuf;

use crate::Result;
use crate::labs::{Handout, Input, Lab};
use crate::mistakes::Mistake;
use crate::scene::Scene;

/// What to show, and how.
pub struct View {
    pub handout: &'static Handout,
    pub scene: Scene,
    /// In logical pixels: a HiDPI screen shows the window as large as any other, with more pixels.
    pub size: [u32; 2],
    /// The one that the lab is started with.
    pub mistake: Option<&'static Mistake>,
    pub prepare: Prepare,
    /// What has been done to the lab when the window opens.
    pub inputs: Vec<Input>,
    /// After them, in seconds.
    pub time: f64,
    /// The other options, for a command line that draws the same picture.
    pub options: Vec<String>,
    /// A folder with a student's own shaders.
    pub glsl: Option<PathBuf>,
    pub vsync: bool,
    pub api: Api,
    /// Draw this many frames without a rest, then end.
    pub frames: Option<u64>,
}

/// Brings a lab that has just started to the state that the options, these inputs and so many seconds after them make.
pub type Prepare = Box<dyn Fn(&mut dyn Lab, &[Input], f64) -> Result<()>>;

/// How the window gets its context.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Api {
    /// Whatever the desktop has; GLX first.
    Auto,
    Glx,
    Egl,
}

/// Shows a lab in a window until the person ends it.
#[cfg(target_os = "linux")]
pub fn open(view: View) -> Result<()> {
    app::run(view)
}

#[cfg(not(target_os = "linux"))]
pub fn open(_: View) -> Result<()> {
    Err(crate::Error::gl(
        "the viewer needs X11 or Wayland and runs on Linux only: expected Linux",
    ))
}
