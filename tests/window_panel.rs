//! The viewer's panel: it opens beside the picture and leaves no trace, and what is done in it is what the options do.

mod common;
mod desktop;

use std::path::Path;
use std::process::Command;

use common::{SHARE_BEYOND, compare, differing, work_folder};
use desktop::{Desktop, Viewer, assert_shot_is_headless, headless};
use image::{DynamicImage, Rgb, RgbImage};
use shadowlab::measure::{FALSE_LIGHT, FALSE_SHADOW};

/// Of the picture, and of the window with the panel beside it.
const SIZE: [u32; 2] = [320, 420];
const WIDE: [u32; 2] = [720, 420];
const OPTIONS: &str = "--set rotation=off --size 320x420";

/// The panel's ground, where nothing is written on it.
const GROUND: Rgb<u8> = Rgb([18, 20, 27]);

fn picture(screen: &RgbImage) -> RgbImage {
    image::imageops::crop_imm(screen, 0, 0, SIZE[0], SIZE[1]).to_image()
}

fn has_panel(screen: &RgbImage) -> bool {
    *screen.get_pixel(SIZE[0] + 5, 5) == GROUND
}

fn open(viewer: &Viewer, desktop: &Desktop) -> RgbImage {
    viewer.press("F2");
    let screen = desktop.wait_for_screen(WIDE, has_panel);
    assert!(has_panel(&screen));
    screen
}

/// The lab's picture without the viewer.
fn drawn(folder: &Path, options: &str) -> DynamicImage {
    let line = format!("shadowlab screenshot cs541 {OPTIONS} {options}");
    headless(folder, &line)
}

#[test]
fn the_panel_stands_beside_the_picture_and_goes_without_a_trace() {
    let folder = work_folder("panel-beside");
    let desktop = Desktop::new(&folder);
    let viewer = Viewer::open(&desktop, OPTIONS);
    let expected = drawn(&folder, "");
    let is_plain = |screen: &RgbImage| {
        compare(&expected, &picture(screen).into(), SHARE_BEYOND).is_ok() && !has_panel(screen)
    };
    let plain = desktop.wait_for_screen(WIDE, is_plain);
    assert!(is_plain(&plain));

    let with_panel = open(&viewer, &desktop);
    assert_eq!(differing(&picture(&with_panel), &picture(&plain)), 0);
    // The keys go back to the lab, which moves; then the panel goes, and the movement back.
    viewer.step("Escape", WIDE);
    let moved = viewer.step("w", WIDE);
    assert!(differing(&picture(&moved), &picture(&plain)) > 0);
    assert!(has_panel(&moved));
    viewer.press("Escape");
    let is_narrow = |screen: &RgbImage| !has_panel(screen);
    assert!(is_narrow(&desktop.wait_for_screen(WIDE, is_narrow)));
    viewer.press("s");
    let is_back = |screen: &RgbImage| differing(screen, &plain) == 0;
    assert!(is_back(&desktop.wait_for_screen(WIDE, is_back)));

    // While the panel has the keyboard, the lab has not.
    open(&viewer, &desktop);
    viewer.press("w");
    let (_, line) = assert_shot_is_headless(&folder, &viewer);
    assert!(line.contains("--keys ws"), "{line}");
    viewer.press("F2");
    assert!(is_back(&desktop.wait_for_screen(WIDE, is_back)));
}

#[test]
fn a_setting_is_changed_by_the_keyboard_as_by_set() {
    let folder = work_folder("panel-settings");
    let desktop = Desktop::new(&folder);
    let viewer = Viewer::open(&desktop, OPTIONS);
    open(&viewer, &desktop);
    // The first row is the light's, the third the beam's angle.
    viewer.step("Down", WIDE);
    viewer.step("Right", WIDE);
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert!(line.contains("<Set:light=point>"), "{line}");
    let shot = DynamicImage::from(shot);
    let set = drawn(&folder, "--set light=point");
    assert_eq!(compare(&set, &shot, SHARE_BEYOND), Ok(()));
    // The control: the setting matters.
    assert!(compare(&drawn(&folder, ""), &shot, SHARE_BEYOND).is_err());

    viewer.step("Left", WIDE);
    viewer.step("Down", WIDE);
    viewer.step("Down", WIDE);
    for _ in 0..3 {
        viewer.step("Right", WIDE);
    }
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    let sets = "<Set:light=point><Set:light=spot><Set:spot_angle=63>";
    assert!(line.contains(&format!("--keys '{sets}'")), "{line}");
    let set = drawn(&folder, "--set spot_angle=63");
    assert_eq!(compare(&set, &shot.into(), SHARE_BEYOND), Ok(()));
}

#[test]
fn a_mistake_is_made_and_mended_in_the_same_state() {
    let folder = work_folder("panel-mistakes");
    let desktop = Desktop::new(&folder);
    let viewer = Viewer::open(&desktop, &format!("{OPTIONS} --keys ww"));
    let right = open(&viewer, &desktop);
    viewer.step("Next", WIDE);
    viewer.step("Tab", WIDE);
    viewer.step("Down", WIDE);
    let wrong = viewer.step("Return", WIDE);
    assert!(differing(&picture(&wrong), &picture(&right)) > 0);
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert!(line.contains("--mistake no_bias --keys ww"), "{line}");
    let made = drawn(&folder, "--mistake no_bias --keys ww");
    assert_eq!(compare(&made, &shot.into(), SHARE_BEYOND), Ok(()));

    viewer.step("Up", WIDE);
    viewer.step("Return", WIDE);
    let is_right = |screen: &RgbImage| differing(&picture(screen), &picture(&right)) == 0;
    assert!(is_right(&desktop.wait_for_screen(WIDE, is_right)));
}

/// Red and blue stand where `shadowlab measure` has them, and nowhere else.
#[test]
fn the_rays_mark_what_measure_calls_wrong() {
    let folder = work_folder("panel-truth");
    let desktop = Desktop::new(&folder);
    // Without a bias there is much to mark.
    let options = format!("{OPTIONS} --set remedy=none");
    let viewer = Viewer::open(&desktop, &options);
    let ran = Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .args(["measure", "cs541"])
        .args(options.split(' '))
        .args(["--device", "software", "-o"])
        .arg(folder.join("wrong.png"))
        .output()
        .unwrap();
    assert!(ran.status.success());
    let wrong = image::open(folder.join("wrong.png")).unwrap().to_rgb8();
    let is_mark = |pixel: &Rgb<u8>| [FALSE_SHADOW, FALSE_LIGHT].contains(pixel);
    let apart = |screen: &RgbImage| {
        let pairs = wrong.enumerate_pixels();
        let apart = pairs.filter(|(x, y, pixel)| {
            let seen = screen.get_pixel(*x, *y);
            (is_mark(pixel) || is_mark(seen)) && *pixel != seen
        });
        apart.count() as f64 / f64::from(SIZE[0] * SIZE[1])
    };
    let before = open(&viewer, &desktop);
    // The control: the rays find something, and it is not marked yet.
    assert!(apart(&before) > 0.05, "{}", apart(&before));
    for key in ["Next", "Next", "Next", "Tab", "Tab", "Tab", "space"] {
        viewer.step(key, WIDE);
    }
    let is_marked = |screen: &RgbImage| apart(screen) <= SHARE_BEYOND;
    let marked = desktop.wait_for_screen(WIDE, is_marked);
    assert!(is_marked(&marked), "{}", apart(&marked));
}

/// The calls between two frames of a dump, without their numbers.
fn frames(dump: &str) -> Vec<Vec<&str>> {
    let calls = dump.lines().filter_map(|line| {
        let (number, call) = line.split_once(' ')?;
        number.parse::<u64>().ok().map(|_| call)
    });
    let mut frames = vec![Vec::new()];
    for call in calls {
        if call.starts_with("glXSwapBuffers") {
            frames.push(Vec::new());
        } else {
            frames.last_mut().unwrap().push(call);
        }
    }
    // After the last frame comes the end.
    frames.pop();
    frames
}

/// What apitrace sees of a frame is the same before the panel was ever opened and after it was closed.
#[test]
fn a_hidden_panel_makes_no_call() {
    let folder = work_folder("panel-calls");
    let desktop = Desktop::new(&folder);
    let mut apitrace = desktop.command("apitrace");
    apitrace
        .args(["trace", "--api", "gl", "--output"])
        .arg(folder.join("record.trace"))
        .arg(env!("CARGO_BIN_EXE_shadowlab"));
    let options = format!("{OPTIONS} --api glx");
    let mut viewer = Viewer::open_by(&desktop, apitrace, "cs541", &options);
    let paused = |yes: bool| {
        viewer.press("space");
        while viewer.title().contains("paused") != yes {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    };
    paused(true);
    open(&viewer, &desktop);
    viewer.step("Escape", WIDE);
    viewer.press("Escape");
    let is_narrow = |screen: &RgbImage| !has_panel(screen);
    assert!(is_narrow(&desktop.wait_for_screen(WIDE, is_narrow)));
    paused(false);
    viewer.press("Escape");
    assert_eq!(viewer.end().code(), Some(0));

    let dump = Command::new("apitrace")
        .args(["dump", "--verbose", "--color=never"])
        .arg(folder.join("record.trace"))
        .output()
        .unwrap();
    let dump = String::from_utf8_lossy(&dump.stdout);
    let frames = frames(&dump);
    let is_of_panel = |frame: &&Vec<&str>| frame.iter().any(|call| call.contains("Current"));
    let first = frames.iter().skip(1).position(|frame| is_of_panel(&frame));
    let first = first.expect("frames with a panel") + 1;
    let (before, after) = (&frames[first - 1], frames.last().unwrap());
    assert!(before.iter().any(|call| call.starts_with("glDraw")));
    assert_eq!(before, after);
    // The control: an open panel is seen.
    let opened = frames[first..].iter().rfind(is_of_panel).unwrap();
    let draws = |frame: &[&str]| {
        frame
            .iter()
            .filter(|call| call.starts_with("glDraw"))
            .count()
    };
    assert!(draws(opened) > draws(before), "{} draws", draws(opened));
}
