//! A window whose default framebuffer is what a lab draws on: OpenGL 3.3 core, depth 24, stencil 8, one sample.
//!
//! SAFETY of this module: the display and the window outlive what is made of them (see the order of [`Canvas`]'s
//! fields), and the context is current on the calling thread for as long as the canvas lives.
#![allow(unsafe_code)]

use std::ffi::CStr;
use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use glow::HasContext;
use glutin::config::{ColorBufferType, Config, ConfigTemplateBuilder, GlConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, GlProfile, NotCurrentContext, PossiblyCurrentContext,
    Version,
};
use glutin::display::{Display, DisplayApiPreference, GetGlDisplay, GlDisplay};
use glutin::prelude::{NotCurrentGlContext, PossiblyCurrentGlContext};
use glutin::surface::{GlSurface, Surface, SurfaceAttributesBuilder, SwapInterval, WindowSurface};
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::platform::x11::register_xlib_error_hook;
use winit::raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::window::{Window, WindowAttributes};

use super::{Api, View};
use crate::gl::{keep_heap, trace};
use crate::{Error, Result};

/// In Hz, where the desktop does not say.
const USUAL_REFRESH: f64 = 60.0;

pub struct Canvas {
    pub gl: glow::Context,
    /// `GL_RENDERER`, for the title and for the record in every picture.
    pub renderer: String,
    /// What gave the context: `GLX 1.4`, for example.
    pub api: String,
    surface: Surface<WindowSurface>,
    context: PossiblyCurrentContext,
    config: Config,
    vsync: bool,
    pub window: Window,
}

/// A context that draws into the same window and has a state of its own. It is the panel's, whose painter has a glow of
/// its own, too.
pub struct Beside {
    pub gl: Arc<egui_glow::glow::Context>,
    context: PossiblyCurrentContext,
}

impl Canvas {
    pub fn open(event_loop: &ActiveEventLoop, view: &View) -> Result<Self> {
        keep_heap();
        let refused = |what: &'static str| move |error| refused(what, error);
        let display = open_display(event_loop, view.api)?;
        let config = choose_config(&display)?;
        let attributes = WindowAttributes::default()
            .with_title(format!("shadowlab {}", view.handout.name))
            .with_inner_size(LogicalSize::new(view.size[0], view.size[1]));
        let window = glutin_winit::finalize_window(event_loop, attributes, &config)
            .map_err(|error| Error::gl(format!("the desktop refuses a window: {error}")))?;
        let handle = window
            .window_handle()
            .map_err(|error| Error::gl(format!("the desktop refuses a window: {error}")))?
            .as_raw();

        let PhysicalSize { width, height } = window.inner_size();
        let at_least_one = |n| NonZeroU32::new(n).unwrap_or(NonZeroU32::MIN);
        let surface = SurfaceAttributesBuilder::<WindowSurface>::new().build(
            handle,
            at_least_one(width),
            at_least_one(height),
        );
        unsafe {
            let surface = display
                .create_window_surface(&config, &surface)
                .map_err(refused("a surface for the window"))?;
            let context = new_context(&config, &window)?
                .make_current(&surface)
                .map_err(refused("making the context current"))?;
            let gl = trace::edited(|name| display.get_proc_address(name));
            let canvas = Self {
                renderer: gl.get_parameter_string(glow::RENDERER),
                api: display.version_string(),
                gl,
                surface,
                context,
                config,
                vsync: view.vsync,
                window,
            };
            canvas.wait_for_screen();
            Ok(canvas)
        }
    }

    fn wait_for_screen(&self) {
        let interval = match self.vsync {
            true => SwapInterval::Wait(NonZeroU32::MIN),
            false => SwapInterval::DontWait,
        };
        // A renderer without a screen of its own may refuse either: the viewer keeps time by the clock too.
        let _ = self.surface.set_swap_interval(&self.context, interval);
    }

    /// Another context in place of the one that there is, with all that was made in it.
    pub fn renew(&mut self) -> Result<()> {
        self.context = new_context(&self.config, &self.window)?
            .make_current(&self.surface)
            .map_err(|error| refused("making the context current", error))?;
        let display = self.config.display();
        self.gl = trace::edited(|name| display.get_proc_address(name));
        self.wait_for_screen();
        Ok(())
    }

    /// Another context beside the one that there is.
    pub fn beside(&self) -> Result<Beside> {
        let context = new_context(&self.config, &self.window)?
            .make_current(&self.surface)
            .map_err(|error| refused("making the context current", error))?;
        let display = self.config.display();
        let load = |name: &CStr| display.get_proc_address(name);
        let gl = unsafe { egui_glow::glow::Context::from_loader_function_cstr(load) };
        self.make_current(&self.context)?;
        Ok(Beside {
            gl: Arc::new(gl),
            context,
        })
    }

    /// Draws with a context beside the usual one, into the same frame.
    pub fn draw_beside(&self, beside: &Beside, draw: impl FnOnce()) -> Result<()> {
        self.make_current(&beside.context)?;
        draw();
        self.make_current(&self.context)
    }

    fn make_current(&self, context: &PossiblyCurrentContext) -> Result<()> {
        context
            .make_current(&self.surface)
            .map_err(|error| refused("making the context current", error))
    }

    /// The window's size in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.window.inner_size().into()
    }

    pub fn resize(&self, size: [u32; 2]) {
        if let [Some(width), Some(height)] = size.map(NonZeroU32::new) {
            self.surface.resize(&self.context, width, height);
        }
    }

    /// Waits until everything is drawn.
    pub fn finish(&self) {
        unsafe { self.gl.finish() };
    }

    pub fn show(&self) -> Result<()> {
        self.window.pre_present_notify();
        self.surface
            .swap_buffers(&self.context)
            .map_err(|error| refused("showing a frame", error))
    }

    /// From one picture of the screen to the next.
    pub fn period(&self) -> Duration {
        let monitor = self.window.current_monitor();
        let rate = monitor.and_then(|monitor| monitor.refresh_rate_millihertz());
        Duration::from_secs_f64(1.0 / rate.map_or(USUAL_REFRESH, |rate| f64::from(rate) / 1000.0))
    }
}

fn new_context(config: &Config, window: &Window) -> Result<NotCurrentContext> {
    let handle = window
        .window_handle()
        .map_err(|error| Error::gl(format!("the desktop refuses a window: {error}")))?;
    let attributes = ContextAttributesBuilder::new()
        .with_profile(GlProfile::Core)
        .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
        .build(Some(handle.as_raw()));
    unsafe { config.display().create_context(config, &attributes) }
        .map_err(|error| refused("an OpenGL 3.3 core context", error))
}

fn refused(what: &str, error: glutin::error::Error) -> Error {
    Error::gl(format!("the window's driver refuses {what}: {error}"))
}

fn open_display(event_loop: &ActiveEventLoop, api: Api) -> Result<Display> {
    let preference = match api {
        Api::Auto => DisplayApiPreference::GlxThenEgl(Box::new(register_xlib_error_hook)),
        Api::Glx => DisplayApiPreference::Glx(Box::new(register_xlib_error_hook)),
        Api::Egl => DisplayApiPreference::Egl,
    };
    let handle = event_loop
        .display_handle()
        .map_err(|error| Error::gl(format!("the desktop gives no display: {error}")))?;
    unsafe { Display::new(handle.as_raw(), preference) }
        .map_err(|error| refused("a display", error))
}

const EIGHT_BITS: ColorBufferType = ColorBufferType::Rgb {
    r_size: 8,
    g_size: 8,
    b_size: 8,
};

/// One sample and 8 bits a colour, as the headless pictures have; alpha if there is, but none that the desktop would look through.
fn choose_config(display: &Display) -> Result<Config> {
    let template = ConfigTemplateBuilder::new()
        .with_alpha_size(0)
        .with_depth_size(24)
        .with_stencil_size(8)
        .build();
    unsafe { display.find_configs(template) }
        .map_err(|error| refused("a list of framebuffers", error))?
        .filter(|config| config.depth_size() == 24)
        .min_by_key(|config| {
            (
                config.num_samples(),
                config.color_buffer_type() != Some(EIGHT_BITS),
                config.supports_transparency() == Some(true),
                config.alpha_size().abs_diff(8),
            )
        })
        .ok_or_else(|| {
            Error::gl("the window's driver has no framebuffer with 24-bit depth and 8-bit stencil")
        })
}
