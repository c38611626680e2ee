//! An OpenGL 3.3 core context on an EGL pbuffer: no display, no window, no environment variable.
//!
//! A pbuffer rather than a surfaceless context, because it has a true default framebuffer (24-bit depth,
//! 8-bit stencil): the handouts' `glBindFramebuffer(GL_FRAMEBUFFER, 0)` stays literal.
//!
//! SAFETY of this module: the display and the surface are made without any window-system handle, and the
//! context is current on the calling thread for as long as [`Headless`] lives, which is not `Send`.
#![allow(unsafe_code)]

use crate::{Error, Result};

/// One renderer that EGL offers.
pub struct Device {
    /// `GL_RENDERER` where a context could be made, else what EGL calls the device.
    pub name: String,
    /// Whether it draws on the CPU.
    pub software: bool,
    /// `GL_VERSION` of an OpenGL 3.3 core context made on it, or why there is none.
    pub version: std::result::Result<String, String>,
}

/// Which of several devices draws.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Choice {
    /// A GPU that gives OpenGL 3.3, else the software renderer.
    #[default]
    Auto,
    /// The software renderer, whose pictures are the same on every machine: tests and goldens.
    Software,
    /// The device whose name contains this text, in whatever case.
    Named(String),
}

impl std::str::FromStr for Choice {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> std::result::Result<Self, Self::Err> {
        Ok(match text {
            "auto" => Self::Auto,
            "software" => Self::Software,
            name => Self::Named(name.to_owned()),
        })
    }
}

/// A current context with a default framebuffer of a fixed size.
pub struct Headless {
    pub gl: glow::Context,
    /// `GL_RENDERER`, for the record in every picture.
    pub renderer: String,
    /// `GL_VERSION`, in which drivers name themselves.
    pub version: String,
    /// Whether it draws on the CPU.
    pub software: bool,
    #[cfg(target_os = "linux")]
    _egl: egl::Current,
}

#[cfg(not(target_os = "linux"))]
mod elsewhere {
    use super::*;

    const REASON: &str = "the headless commands need EGL and run on Linux only: expected Linux";

    pub fn devices() -> Result<Vec<Device>> {
        Err(Error::gl(REASON))
    }

    impl Headless {
        pub fn open(_: &Choice, _: [u32; 2], _: bool) -> Result<Self> {
            Err(Error::gl(REASON))
        }
    }
}

#[cfg(target_os = "linux")]
pub use egl::devices;
#[cfg(not(target_os = "linux"))]
pub use elsewhere::devices;

#[cfg(target_os = "linux")]
mod egl {
    use std::ffi::CStr;
    use std::num::NonZeroU32;

    use glow::HasContext;
    use glutin::api::egl::{
        context::PossiblyCurrentContext, device::Device as EglDevice, display::Display,
        surface::Surface,
    };
    use glutin::config::{ConfigSurfaceTypes, ConfigTemplateBuilder, GlConfig};
    use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, Version};
    use glutin::display::GlDisplay;
    use glutin::prelude::{NotCurrentGlContext, PossiblyCurrentGlContext};
    use glutin::surface::{PbufferSurface, SurfaceAttributesBuilder};

    use super::*;
    use crate::gl::{keep_heap, trace};

    /// What must stay alive while the context is in use.
    pub struct Current {
        context: PossiblyCurrentContext,
        _surface: Surface<PbufferSurface>,
        display: Display,
    }

    impl Drop for Current {
        fn drop(&mut self) {
            // EGL destroys a context when no thread has it any more: a thread that ends with it would keep its memory.
            if self.context.is_current() {
                // What fails here has nobody to be told to.
                let _ = self.context.make_not_current_in_place();
            }
        }
    }

    /// Every device of EGL, tried.
    pub fn devices() -> Result<Vec<Device>> {
        let describe = |device: EglDevice| {
            let opened = Headless::on(&device, [1, 1], false);
            Device {
                software: is_software(&device),
                name: match &opened {
                    Ok(headless) => headless.renderer.clone(),
                    Err(_) => device.name().unwrap_or("unnamed").to_owned(),
                },
                version: opened
                    .map(|headless| headless.version)
                    .map_err(|error| error.to_string()),
            }
        };
        Ok(egl_devices()?.into_iter().map(describe).collect())
    }

    impl Headless {
        /// Opens a context whose default framebuffer is `size` pixels, on the device that `choice` names.
        /// With `record`, every call is kept for [`trace::take`].
        pub fn open(choice: &Choice, size: [u32; 2], record: bool) -> Result<Self> {
            let mut devices = egl_devices()?;
            match choice {
                Choice::Software => devices.retain(is_software),
                // GPUs first; the sort is stable, so EGL's own order stays within each kind.
                Choice::Auto | Choice::Named(_) => devices.sort_by_key(is_software),
            }
            let mut refused = None;
            for device in &devices {
                if let Choice::Named(name) = choice
                    && !Self::is_called(device, name)
                {
                    continue;
                }
                match Self::on(device, size, record) {
                    Ok(headless) => return Ok(headless),
                    Err(error) => refused = Some(error),
                }
            }
            Err(match (choice, refused) {
                (_, Some(error)) => error,
                (Choice::Named(name), None) => Error::usage(format!(
                    "--device {name}: no EGL device has that name, expected auto, software, or part \
                     of one of: {}",
                    devices
                        .iter()
                        .map(Self::name)
                        .collect::<Vec<_>>()
                        .join(", ")
                )),
                (Choice::Software, None) => Error::gl(
                    "EGL has no software device, expected Mesa's llvmpipe (Debian: libgl1-mesa-dri, \
                     Fedora: mesa-dri-drivers, Arch: mesa)",
                ),
                (Choice::Auto, None) => Error::gl(
                    "EGL has no device, expected a driver with OpenGL 3.3 (Debian: libgl1-mesa-dri, \
                     Fedora: mesa-dri-drivers, Arch: mesa)",
                ),
            })
        }

        fn is_called(device: &EglDevice, name: &str) -> bool {
            let name = name.to_lowercase();
            Self::name(device).to_lowercase().contains(&name)
        }

        fn name(device: &EglDevice) -> String {
            match Self::on(device, [1, 1], false) {
                Ok(headless) => headless.renderer,
                Err(_) => device.name().unwrap_or("unnamed").to_owned(),
            }
        }

        fn on(device: &EglDevice, size: [u32; 2], record: bool) -> Result<Self> {
            let egl = make_current(device, size)?;
            let find = |name: &CStr| egl.display.get_proc_address(name);
            let gl = match record {
                true => trace::recorded(find),
                false => trace::edited(find),
            };
            check_limits(&gl, size)?;
            let [renderer, version] = [glow::RENDERER, glow::VERSION]
                .map(|name| unsafe { gl.get_parameter_string(name) });
            // The record begins with the lab's first call: these questions are none of its own.
            trace::take();
            Ok(Self {
                gl,
                renderer,
                version,
                software: is_software(device),
                _egl: egl,
            })
        }
    }

    fn egl_devices() -> Result<Vec<EglDevice>> {
        EglDevice::query_devices()
            .map(Iterator::collect)
            .map_err(|error| {
                Error::gl(format!(
                    "EGL: {error}, expected libEGL with device enumeration (Debian: libegl1, \
                     Fedora: libglvnd-egl, Arch: libglvnd)"
                ))
            })
    }

    fn is_software(device: &EglDevice) -> bool {
        device.extensions().contains("EGL_MESA_device_software")
    }

    fn make_current(device: &EglDevice, size: [u32; 2]) -> Result<Current> {
        let refused =
            |what: &'static str| move |error| Error::gl(format!("EGL: {what} failed: {error}"));
        keep_heap();
        let [Some(width), Some(height)] = size.map(NonZeroU32::new) else {
            return Err(Error::usage("a picture of 0 pixels, expected 1×1 or more"));
        };
        unsafe {
            let display =
                Display::with_device(device, None).map_err(refused("opening a display"))?;

            // The template's own default asks for windows, and a device display has none.
            let template = ConfigTemplateBuilder::new()
                .with_surface_type(ConfigSurfaceTypes::PBUFFER)
                .with_alpha_size(8)
                .with_depth_size(24)
                .with_stencil_size(8)
                .build();
            let config = display
                .find_configs(template)
                .map_err(refused("asking for a pbuffer"))?
                .min_by_key(|config| config.num_samples())
                .ok_or_else(|| Error::gl("EGL: no pbuffer with 24-bit depth and 8-bit stencil"))?;

            let attributes = ContextAttributesBuilder::new()
                .with_profile(GlProfile::Core)
                .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
                .build(None);
            let context = display
                .create_context(&config, &attributes)
                .map_err(refused("making an OpenGL 3.3 core context"))?;

            let attributes = SurfaceAttributesBuilder::<PbufferSurface>::new().build(width, height);
            let surface = display
                .create_pbuffer_surface(&config, &attributes)
                .map_err(|error| {
                    Error::gl(format!(
                        "the driver refuses a picture of {width}×{height} pixels: {error}"
                    ))
                })?;
            let context = context
                .make_current(&surface)
                .map_err(refused("making the context current"))?;
            Ok(Current {
                context,
                _surface: surface,
                display,
            })
        }
    }

    /// EGL may grant a pbuffer that OpenGL cannot draw on as a whole.
    fn check_limits(gl: &glow::Context, [width, height]: [u32; 2]) -> Result<()> {
        let mut most = [0; 2];
        unsafe { gl.get_parameter_i32_slice(glow::MAX_VIEWPORT_DIMS, &mut most) };
        if i64::from(width) > i64::from(most[0]) || i64::from(height) > i64::from(most[1]) {
            return Err(Error::usage(format!(
                "a picture of {width}×{height} pixels, expected at most {}×{}, the driver's limit",
                most[0], most[1]
            )));
        }
        Ok(())
    }
}
