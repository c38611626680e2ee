//! A desktop for tests: an X server without a screen, and the viewer in it, driven by xdotool as by a person.
#![allow(dead_code)]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::sleep;
use std::time::{Duration, Instant};

use image::{DynamicImage, Rgb, RgbImage};
use x11rb::protocol::xproto::{ClientMessageEvent, ConnectionExt, EventMask};

use super::common::{SHARE_BEYOND, compare};

/// How long a test waits for what must come, on a busy machine too.
const PATIENCE: Duration = Duration::from_secs(60);

/// An X server of the test's own; it ends with the test, however that ends.
pub struct Desktop {
    server: Child,
    name: String,
    folder: PathBuf,
    /// Pixels for each logical pixel, along one side.
    pub scale: u32,
}

impl Desktop {
    pub fn new(folder: &Path) -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "800x600x24"])
            // No key repeats itself, however slow the machine is between press and release.
            .args(["-nolisten", "tcp", "-r", "-fbdir"])
            .arg(folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb (`cargo xtask test` installs it)");
        let mut number = String::new();
        let output = server.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut number).unwrap();
        Self {
            server,
            name: format!(":{}", number.trim()),
            folder: folder.to_owned(),
            scale: 1,
        }
    }

    /// As `DISPLAY` has it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The program on this display, in the test's folder.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command
            .current_dir(&self.folder)
            .env("DISPLAY", &self.name)
            .env("WINIT_X11_SCALE_FACTOR", self.scale.to_string());
        for other in ["WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(other);
        }
        command
    }

    pub fn xdotool(&self, words: &[&str]) -> String {
        let ran = self.command("xdotool").args(words).output();
        let ran = ran.expect("xdotool (`cargo xtask test` installs it)");
        String::from_utf8(ran.stdout).unwrap().trim().to_owned()
    }

    /// What a person sees in the top left of the screen, where the windows open.
    pub fn screen(&self, [width, height]: [u32; 2]) -> RgbImage {
        // The server's screen is a file in the format of xwd: a header of 32-bit numbers, colours, rows of pixels.
        let bytes = std::fs::read(self.folder.join("Xvfb_screen0")).unwrap();
        let number = |at: usize| u32::from_be_bytes(bytes[4 * at..4 * at + 4].try_into().unwrap());
        let [header, bits, row, colours] = [0, 11, 12, 19].map(|at| number(at) as usize);
        assert_eq!(bits, 32, "bits a pixel");
        let first = header + 12 * colours;
        RgbImage::from_fn(width, height, |x, y| {
            let at = first + row * y as usize + 4 * x as usize;
            Rgb([bytes[at + 2], bytes[at + 1], bytes[at]])
        })
    }

    /// The screen once it is right, or as it still is when patience ends.
    pub fn wait_for_screen(&self, size: [u32; 2], right: impl Fn(&RgbImage) -> bool) -> RgbImage {
        let began = Instant::now();
        loop {
            let screen = self.screen(size);
            if right(&screen) || began.elapsed() > PATIENCE {
                return screen;
            }
            sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The viewer on a desktop.
pub struct Viewer<'a> {
    desktop: &'a Desktop,
    pub process: Child,
    pub lines: Receiver<String>,
    id: String,
}

impl<'a> Viewer<'a> {
    /// Returns once the window has its first frame and the keyboard.
    pub fn open(desktop: &'a Desktop, options: &str) -> Self {
        Self::open_lab(desktop, "cs541", options)
    }

    pub fn open_lab(desktop: &'a Desktop, lab: &str, options: &str) -> Self {
        let program = desktop.command(env!("CARGO_BIN_EXE_shadowlab"));
        Self::open_by(desktop, program, lab, options)
    }

    /// The same by a command that may be another program's, with the viewer's as its arguments.
    pub fn open_by(desktop: &'a Desktop, mut program: Command, lab: &str, options: &str) -> Self {
        let mut process = program
            .args(["view", lab])
            .args(options.split_whitespace())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let output = process.stdout.take().unwrap();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                let _ = sender.send(line);
            }
        });
        let mut viewer = Self {
            desktop,
            process,
            lines,
            id: String::new(),
        };
        let first = viewer.line();
        assert!(first.contains(&format!("{lab} in a window")), "{first}");
        let began = Instant::now();
        // The first frame writes the title.
        while viewer.id.is_empty() {
            assert!(began.elapsed() < PATIENCE, "no window");
            sleep(Duration::from_millis(20));
            let title = format!("^{lab}, ");
            viewer.id = desktop.xdotool(&["search", "--onlyvisible", "--name", &title]);
        }
        // Without a window manager nobody else gives the window the keyboard.
        desktop.xdotool(&["windowfocus", "--sync", &viewer.id]);
        viewer
    }

    /// The next line of the viewer's output.
    pub fn line(&self) -> String {
        self.lines.recv_timeout(PATIENCE).expect("a line of output")
    }

    pub fn title(&self) -> String {
        self.desktop.xdotool(&["getwindowname", &self.id])
    }

    /// Presses keys, by their names in X.
    pub fn press(&self, keys: &str) {
        let words: Vec<_> = std::iter::once("key")
            .chain(keys.split_whitespace())
            .collect();
        self.desktop.xdotool(&words);
    }

    /// Presses a key and waits until something is seen of that.
    pub fn step(&self, key: &str, size: [u32; 2]) -> RgbImage {
        let before = self.desktop.screen(size);
        self.press(key);
        let screen = self
            .desktop
            .wait_for_screen(size, |screen| *screen != before);
        assert!(screen != before, "nothing is seen of {key}");
        screen
    }

    /// An xdotool command that takes a window.
    pub fn window(&self, command: &str, words: &[&str]) {
        self.desktop
            .xdotool(&[&[command, &self.id], words].concat());
    }

    /// Asks the window to close, as the button of a window manager does.
    pub fn close(&self) {
        let (server, _) = x11rb::connect(Some(&self.desktop.name)).unwrap();
        let atom = |name: &[u8]| {
            server
                .intern_atom(false, name)
                .unwrap()
                .reply()
                .unwrap()
                .atom
        };
        let window = self.id.parse().unwrap();
        let question = [atom(b"WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let event = ClientMessageEvent::new(32, window, atom(b"WM_PROTOCOLS"), question);
        let sent = server.send_event(false, window, EventMask::NO_EVENT, event);
        sent.unwrap().check().unwrap();
    }

    /// Presses F12: the picture's file, and the command line that the viewer prints with it.
    pub fn shoot(&self) -> (PathBuf, String) {
        self.press("F12");
        let file = self.desktop.folder.join(self.line());
        (file, self.line())
    }

    /// How the program ended.
    pub fn end(&mut self) -> ExitStatus {
        let began = Instant::now();
        loop {
            if let Some(status) = self.process.try_wait().unwrap() {
                return status;
            }
            assert!(began.elapsed() < PATIENCE, "the viewer goes on");
            sleep(Duration::from_millis(20));
        }
    }

    /// Processor time that the program has used.
    pub fn cpu_time(&self) -> Duration {
        let stat = format!("/proc/{}/stat", self.process.id());
        let stat = std::fs::read_to_string(stat).unwrap();
        // Behind the name in brackets, user and system time are the 12th and 13th field, in 1/100 s.
        let (_, fields) = stat.rsplit_once(')').unwrap();
        let fields = fields.split_whitespace().skip(11).take(2);
        let ticks: u64 = fields.map(|field| field.parse::<u64>().unwrap()).sum();
        Duration::from_millis(10 * ticks)
    }
}

impl Drop for Viewer<'_> {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The picture that a command line of the viewer's draws without a display.
pub fn headless(folder: &Path, line: &str) -> DynamicImage {
    let program = Path::new(env!("CARGO_BIN_EXE_shadowlab"));
    let file = folder.join("headless.png");
    let path = std::env::var("PATH").unwrap();
    let ran = Command::new("sh")
        .arg("-c")
        .arg(format!("{line} --device software --output headless.png"))
        .current_dir(folder)
        .env(
            "PATH",
            format!("{}:{path}", program.parent().unwrap().display()),
        )
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{line}: {told}");
    image::open(file).unwrap()
}

/// A screenshot of the viewer's, and what its own command line draws headless, are one picture.
pub fn assert_shot_is_headless(folder: &Path, viewer: &Viewer) -> (RgbImage, String) {
    let (file, line) = viewer.shoot();
    let shot = image::open(&file).unwrap();
    assert_eq!(
        compare(&headless(folder, &line), &shot, SHARE_BEYOND),
        Ok(()),
        "{line}"
    );
    (shot.to_rgb8(), line)
}
