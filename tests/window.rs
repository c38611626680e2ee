//! The viewer in a real window: what it shows, what keys and mouse do, and how it ends.

mod common;
mod desktop;

use std::process::Command;
use std::time::Duration;

use common::{SHARE_BEYOND, compare, work_folder};
use desktop::{Desktop, Viewer, assert_shot_is_headless, headless};
use image::{DynamicImage, RgbImage};

fn is_same(expected: &DynamicImage, screen: &RgbImage) -> bool {
    compare(expected, &screen.clone().into(), SHARE_BEYOND).is_ok()
}

fn keys_and_sizes(api: &str) {
    let folder = work_folder(&format!("window-{api}"));
    let desktop = Desktop::new(&folder);
    let mut viewer = Viewer::open(&desktop, &format!("--size 320x300 --api {api} --keys d"));

    viewer.press("w w Left Page_Up o e");
    desktop.xdotool(&["mousemove", "100", "100", "mousedown", "1"]);
    desktop.xdotool(&["mousemove", "130", "90", "mouseup", "1"]);
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert_eq!(shot.dimensions(), (320, 300));
    assert!(line.contains("--keys 'dww<Left><PageUp>oe<Drag:"), "{line}");
    assert!(line.contains(" --time "), "{line}");

    // The controls: one key less, one pixel of the mouse less, another time.
    let shot = DynamicImage::from(shot);
    for (from, to) in [
        ("dww", "dw"),
        ("<Drag:", "<Drag:-"),
        ("--time ", "--time 1"),
    ] {
        let other = headless(&folder, &line.replace(from, to));
        assert!(
            compare(&shot, &other, SHARE_BEYOND).is_err(),
            "{from} -> {to}"
        );
    }

    // What stands over the picture does not come into it, and another size is another picture.
    viewer.press("question m");
    assert_shot_is_headless(&folder, &viewer);
    viewer.window("windowsize", &["401", "257"]);
    desktop.wait_for_screen([401, 257], |screen| screen.get_pixel(400, 256).0 != [0; 3]);
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert_eq!(shot.dimensions(), (401, 257));
    assert!(line.contains("--size 401x257"), "{line}");

    // A window as small as it gets, and one that is put away.
    viewer.window("windowsize", &["1", "1"]);
    viewer.window("windowunmap", &[]);
    viewer.window("windowmap", &[]);
    viewer.window("windowsize", &["200", "150"]);
    desktop.xdotool(&["mousemove", "50", "50"]);
    viewer.window("windowfocus", &[]);
    let (shot, _) = assert_shot_is_headless(&folder, &viewer);
    assert_eq!(shot.dimensions(), (200, 150));

    viewer.press("Escape");
    assert_eq!(viewer.end().code(), Some(0));
}

#[test]
fn the_window_draws_what_the_headless_command_draws_by_glx() {
    keys_and_sizes("glx");
}

#[test]
fn the_window_draws_what_the_headless_command_draws_by_egl() {
    keys_and_sizes("egl");
}

/// On such a screen the window is as large as on any other, and the picture has more pixels.
#[test]
fn a_hidpi_screen_gets_all_its_pixels() {
    let folder = work_folder("window-hidpi");
    let mut desktop = Desktop::new(&folder);
    desktop.scale = 2;
    let viewer = Viewer::open(&desktop, "--size 150x140");
    viewer.press("question m");
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert_eq!(shot.dimensions(), (300, 280));
    assert!(line.contains("--size 300x280"), "{line}");
}

#[test]
fn a_person_sees_the_picture_the_keys_and_the_depth_map() {
    let folder = work_folder("window-panels");
    let desktop = Desktop::new(&folder);
    let size = [500, 500];
    let viewer = Viewer::open(&desktop, "--set rotation=off");
    let plain = headless(&folder, "shadowlab screenshot cs541 --set rotation=off");
    let is_plain = |screen: &RgbImage| is_same(&plain, screen);
    assert!(is_plain(&desktop.wait_for_screen(size, is_plain)));

    // The depth map is grey; the help is not, where the picture is not.
    let inset = |screen: &RgbImage| {
        let [x, y] = [size[0] - 70, size[1] - 100];
        let [r, g, b] = screen.get_pixel(x, y).0;
        r == g && g == b && !is_plain(screen)
    };
    let other = |screen: &RgbImage| !is_plain(screen);
    for (key, seen) in [
        ("question", &other as &dyn Fn(&RgbImage) -> bool),
        ("m", &inset),
    ] {
        viewer.press(key);
        assert!(seen(&desktop.wait_for_screen(size, seen)), "{key}");
        viewer.press(key);
        assert!(
            is_plain(&desktop.wait_for_screen(size, is_plain)),
            "{key} again"
        );
    }

    let title = viewer.title();
    assert!(
        title.starts_with("cs541, ") && title.contains(" ms a frame, "),
        "{title}"
    );
    assert!(title.contains("llvmpipe"), "{title}");
}

#[test]
fn a_saved_shader_is_seen_and_a_broken_one_is_told() {
    let folder = work_folder("window-glsl");
    let glsl = folder.join("mine");
    std::fs::create_dir(&glsl).unwrap();
    let good = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let red = good.replacen(
        "frag_color = ",
        "frag_color = vec4(1.0, 0.0, 0.0, 0.0) + ",
        1,
    );
    assert_ne!(red, good);
    let file = glsl.join("lighting.frag");
    std::fs::write(&file, &good).unwrap();

    let desktop = Desktop::new(&folder);
    let size = [300, 300];
    let line = "shadowlab screenshot cs541 --set rotation=off --size 300x300 --glsl mine";
    let mut viewer = Viewer::open(&desktop, "--set rotation=off --size 300x300 --glsl mine");
    let before = headless(&folder, line);
    let is_before = |screen: &RgbImage| is_same(&before, screen);
    assert!(is_before(&desktop.wait_for_screen(size, is_before)));

    // In place, as `cat` writes.
    std::fs::write(&file, &red).unwrap();
    let reddened = headless(&folder, line);
    let is_red = |screen: &RgbImage| is_same(&reddened, screen);
    assert!(is_red(&desktop.wait_for_screen(size, is_red)));
    assert!(
        !is_red(&before.to_rgb8()),
        "the control: red is another picture"
    );

    // By another name first, as many editors write. The message stands on red over the last good picture.
    let broken = glsl.join("lighting.frag.new");
    std::fs::write(&broken, good.replace("void main", "void mian")).unwrap();
    std::fs::rename(&broken, &file).unwrap();
    let told = |screen: &RgbImage| {
        let [r, g, b] = screen.get_pixel(2, 2).0;
        !is_red(screen) && r > 60 && g < 60 && b < 60
    };
    let screen = desktop.wait_for_screen(size, told);
    assert!(told(&screen));
    let lower_half =
        |picture: &RgbImage| DynamicImage::from(picture.clone()).crop_imm(0, 150, 300, 150);
    let kept = lower_half(&reddened.to_rgb8());
    assert_eq!(compare(&kept, &lower_half(&screen), SHARE_BEYOND), Ok(()));
    viewer.press("x x");

    std::fs::write(&file, &good).unwrap();
    assert!(is_before(&desktop.wait_for_screen(size, is_before)));
    viewer.press("Escape");
    assert_eq!(viewer.end().code(), Some(0));
}

/// A saved shader that never ends is not taken: the window goes on with the one it had, and says why.
#[test]
fn a_saved_shader_that_never_ends_is_refused() {
    let folder = work_folder("window-endless");
    let glsl = folder.join("mine");
    std::fs::create_dir(&glsl).unwrap();
    let good = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let file = glsl.join("lighting.frag");
    std::fs::write(&file, &good).unwrap();
    let desktop = Desktop::new(&folder);
    let size = [300, 300];
    let options = "--set rotation=off --size 300x300 --glsl mine";
    let mut viewer = Viewer::open(&desktop, options);
    let line = format!("shadowlab screenshot cs541 {options}");
    let before = headless(&folder, &line);
    let is_before = |screen: &RgbImage| is_same(&before, screen);
    assert!(is_before(&desktop.wait_for_screen(size, is_before)));

    // Each round of the loop reads a texture often, since llvmpipe gives a loop up after some rounds.
    let read = "sum += texture(usampler, vec2(sum, 0.5 * sum)).r; ".repeat(200);
    let endless = format!(
        "#version 330 core\nuniform sampler2D usampler;\nout vec4 frag_color;\nvoid main(void)\n{{\nfloat sum = 0.0;\n\
         for (int i = 0; sum >= 0.0; i = 1 - i) {{ {read} if (sum > 100.0) sum = float(i); }}\nfrag_color = vec4(sum);\n}}\n"
    );
    std::fs::write(&file, endless).unwrap();
    let told = |screen: &RgbImage| {
        let [r, g, b] = screen.get_pixel(2, 2).0;
        r > 60 && g < 60 && b < 60
    };
    assert!(!told(&before.to_rgb8()), "the control: no message yet");
    // Meanwhile the window lives.
    viewer.press("w");
    let moved = headless(
        &folder,
        "shadowlab screenshot cs541 --set rotation=off --size 300x300 --keys w",
    );
    let is_moved = |screen: &RgbImage| is_same(&moved, screen);
    assert!(is_moved(&desktop.wait_for_screen(size, is_moved)));
    let screen = desktop.wait_for_screen(size, told);
    assert!(told(&screen));
    let lower_half =
        |picture: &RgbImage| DynamicImage::from(picture.clone()).crop_imm(0, 150, 300, 150);
    let kept = lower_half(&moved.to_rgb8());
    assert_eq!(compare(&kept, &lower_half(&screen), SHARE_BEYOND), Ok(()));
    viewer.press("Escape");
    assert_eq!(viewer.end().code(), Some(0));
}

#[test]
fn at_rest_the_program_sleeps() {
    let folder = work_folder("window-rest");
    let desktop = Desktop::new(&folder);
    let used = |options: &str, keys: &str| {
        let viewer = Viewer::open(&desktop, options);
        viewer.press(keys);
        // What the key itself asks for is drawn by then.
        viewer.shoot();
        let before = viewer.cpu_time();
        std::thread::sleep(Duration::from_secs(2));
        viewer.cpu_time() - before
    };
    // The end of the frame that was asked for; each tick of the measure is 10 ms.
    let most = Duration::from_millis(50);
    let resting = used("--set rotation=off --size 200x200", "w");
    assert!(resting <= most, "{resting:?} with rotation=off");
    let paused = used("--size 200x200", "space");
    assert!(paused <= most, "{paused:?} paused");
    let looking = used("--set rotation=off --size 200x200", "F2");
    assert!(looking <= most, "{looking:?} with the panel open");
    // The control: what moves is drawn.
    let moving = used("--size 200x200", "w");
    assert!(moving > 2 * most, "{moving:?} moving");
}

#[test]
fn a_window_that_is_closed_ends_well() {
    let folder = work_folder("window-closed");
    let desktop = Desktop::new(&folder);
    let mut viewer = Viewer::open(&desktop, "--size 100x100 --api glx");
    viewer.close();
    assert_eq!(viewer.end().code(), Some(0));
    let mut viewer = Viewer::open(&desktop, "--size 100x100 --api egl");
    viewer.close();
    assert_eq!(viewer.end().code(), Some(0));
}

/// A ball that is added later is on another way: the screenshot's command line waits as the person did. Each light's map
/// is shown in its turn, and the handout's key ends the viewer.
#[test]
fn balls_are_added_at_their_time_and_the_handouts_key_quits() {
    let folder = work_folder("window-balls");
    let desktop = Desktop::new(&folder);
    let mut viewer = Viewer::open_lab(&desktop, "cmsc23700", "--size 300x300 --keys ++ --time 0.5");
    viewer.press("plus");
    std::thread::sleep(Duration::from_millis(300));
    viewer.press("minus minus plus plus");
    let (shot, line) = assert_shot_is_headless(&folder, &viewer);
    assert!(line.contains("--keys '++<Wait:0."), "{line}");
    // The control: the keys first.
    let waits = line.matches("<Wait:").count();
    assert!(waits >= 2, "{line}");
    let mut words = line.split('\'');
    let keys = words.nth(1).unwrap();
    let without: String = keys
        .split('<')
        .map(|part| part.split('>').next_back().unwrap())
        .collect();
    let other = headless(&folder, &line.replace(keys, &without));
    assert!(compare(&DynamicImage::from(shot), &other, SHARE_BEYOND).is_err());

    // Time stands still; so the corner changes with the inset alone.
    viewer.press("space");
    let paused = || viewer.title().contains("paused");
    let tries = (0..500).take_while(|_| !paused());
    tries.for_each(|_| std::thread::sleep(Duration::from_millis(20)));
    assert!(paused());
    let cut = |screen: &RgbImage| image::imageops::crop_imm(screen, 210, 160, 80, 60).to_image();
    let corner = |differs_from: Option<&RgbImage>| {
        let is_new = |screen: &RgbImage| differs_from.is_none_or(|other| cut(screen) != *other);
        cut(&desktop.wait_for_screen([300, 300], is_new))
    };
    let plain = corner(None);
    viewer.press("m");
    let first = corner(Some(&plain));
    viewer.press("m");
    assert!(corner(Some(&first)) != plain);
    viewer.press("m");
    desktop.wait_for_screen([300, 300], |screen| cut(screen) == plain);
    viewer.press("q");
    assert_eq!(viewer.end().code(), Some(0));
}

#[test]
fn so_many_frames_and_no_more() {
    let folder = work_folder("window-frames");
    let desktop = Desktop::new(&folder);
    let options = "--size 32x32 --set rotation=off --set map_size=256 --vsync off --frames 2000";
    let mut viewer = Viewer::open(&desktop, options);
    assert_eq!(viewer.line(), "1000 frames");
    assert_eq!(viewer.line(), "2000 frames");
    assert_eq!(viewer.end().code(), Some(0));
}

#[test]
fn without_a_display_the_other_command_is_named() {
    // A library that is no library stands for one that is missing.
    let folder = work_folder("window-none");
    std::fs::write(folder.join("libxkbcommon-x11.so.0"), "").unwrap();
    let desktop = Desktop::new(&folder);
    let working = desktop.name();
    for (display, libraries, reason) in [
        (None, "", "DISPLAY is set"),
        (Some(":99999"), "", "X server"),
        (
            Some(working),
            folder.to_str().unwrap(),
            "libxkbcommon-x11.so",
        ),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
        command
            .args(["view", "cs541"])
            .env("LD_LIBRARY_PATH", libraries);
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(name);
        }
        if let Some(display) = display {
            command.env("DISPLAY", display);
        }
        let ran = command.output().unwrap();
        let told = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(1), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(told.contains("`shadowlab screenshot cs541`"), "{told}");
        assert!(told.contains(reason), "{told}");
    }
}
