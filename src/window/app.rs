//! From the connection to the desktop to the exit: which event reaches the viewer, and how the program ends.

use std::panic;

use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop, EventLoopProxy};
use winit::window::WindowId;

use super::View;
use super::viewer::{Next, Viewer};
use crate::{Error, Result};

/// What another thread has for the viewer.
#[derive(Debug)]
pub enum Wake {
    /// A shader was saved.
    Saved,
    /// The rays of the panel's question have come back.
    Truth,
}

pub fn run(view: View) -> Result<()> {
    let no_display = |error: String| {
        Error::gl(format!(
            "no window: {error}, expected an X11 or Wayland display; `shadowlab screenshot {}` needs none",
            view.handout.name
        ))
    };
    let event_loop = connect().map_err(no_display)?;
    let mut app = App {
        wake: event_loop.create_proxy(),
        view: Some(view),
        open: None,
        failed: None,
    };
    let ended = event_loop.run_app(&mut app);
    if let Some(error) = app.failed {
        return Err(error);
    }
    ended.map_err(|error| Error::gl(format!("the window's events ended: {error}")))
}

/// The connection to the desktop, or why there is none.
fn connect() -> std::result::Result<EventLoop<Wake>, String> {
    // winit panics where a library is missing: its message is kept, its backtrace is for nobody.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let built = panic::catch_unwind(|| EventLoop::with_user_event().build());
    panic::set_hook(hook);
    let reason = match built {
        Ok(Ok(event_loop)) => return Ok(event_loop),
        // Before the reason stands a line of winit's source.
        Ok(Err(error)) => match error.to_string().rsplit_once(": ") {
            Some((_, reason)) => reason.to_owned(),
            None => error.to_string(),
        },
        Err(panic) => match panic.downcast_ref::<String>() {
            Some(reason) => reason.clone(),
            None => "winit cannot start".to_owned(),
        },
    };
    Err(reason.trim_end_matches('.').to_owned())
}

/// From start to end: `view`, until the desktop lets a window open, then `open`.
struct App {
    wake: EventLoopProxy<Wake>,
    view: Option<View>,
    open: Option<Viewer>,
    failed: Option<Error>,
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(view) = self.view.take() {
            match Viewer::open(event_loop, view, self.wake.clone()) {
                Ok(viewer) => self.open = Some(viewer),
                Err(error) => self.fail(event_loop, error),
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(viewer) = &mut self.open else {
            return;
        };
        match viewer.take(event) {
            Ok(Next::GoOn) => {}
            Ok(Next::End) => event_loop.exit(),
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, wake: Wake) {
        if let Some(viewer) = &mut self.open {
            viewer.wake(wake);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(viewer) = &mut self.open {
            event_loop.set_control_flow(viewer.wait());
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // The window and its context go before the connection to the desktop does.
        self.open = None;
    }
}

impl App {
    fn fail(&mut self, event_loop: &ActiveEventLoop, error: Error) {
        self.failed = Some(error);
        event_loop.exit();
    }
}
