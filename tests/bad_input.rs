//! Files that nobody checked: each is written into a folder, the program is run on it, and it must say one line that
//! names the place, what was found and what was expected. `--nocapture` prints the table of all of them.

mod common;

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::work_folder;

/// Longer than any of them takes, on a slow machine too; a wait for a pipe would be for ever.
const PATIENCE: Duration = Duration::from_secs(20);
/// What the program may hold while it reads any of these, in bytes of address space: the driver's part is most of it.
const ADDRESS_SPACE_KIB: u64 = 3 << 20;

const CAMERA: &str = "[camera]\neye = [0, 5, 10]\ntarget = [0, 0, 0]\n";
const LIGHT: &str = "[light]\nposition = [4, 7, 5]\n";
const OBJECT: &str = "[[object]]\nmesh = \"cube\"\n";
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A scene around a few lines of one of its tables.
fn scene(root: &str, camera: &str, light: &str, object: &str) -> String {
    format!("{root}\n{CAMERA}{camera}\n{LIGHT}{light}\n{OBJECT}{object}\n")
}

/// The bytes of `bad.toml`, and what the line must say.
struct Bad {
    what: &'static str,
    text: Vec<u8>,
    words: &'static [&'static str],
}

fn bad(what: &'static str, text: impl Into<Vec<u8>>, words: &'static [&'static str]) -> Bad {
    Bad {
        what,
        text: text.into(),
        words,
    }
}

fn in_root(line: &'static str, words: &'static [&'static str]) -> Bad {
    bad(line, scene(line, "", "", ""), words)
}

fn in_light(line: &'static str, words: &'static [&'static str]) -> Bad {
    bad(line, scene("", "", line, ""), words)
}

fn in_object(line: &'static str, words: &'static [&'static str]) -> Bad {
    bad(line, scene("", "", "", line), words)
}

/// A camera of these lines alone.
fn camera(lines: &'static str, words: &'static [&'static str]) -> Bad {
    bad(lines, format!("[camera]\n{lines}\n{LIGHT}{OBJECT}"), words)
}

/// A light of these lines alone.
fn light(lines: &'static str, words: &'static [&'static str]) -> Bad {
    bad(lines, format!("{CAMERA}[light]\n{lines}\n{OBJECT}"), words)
}

/// An object of these lines alone.
fn object(lines: &'static str, words: &'static [&'static str]) -> Bad {
    bad(
        lines,
        format!("{CAMERA}{LIGHT}[[object]]\n{lines}\n"),
        words,
    )
}

fn scenes() -> Vec<Bad> {
    let many = 70_000;
    vec![
        bad(
            "nothing",
            "",
            &["bad.toml:1:1", "found no camera", "expected one"],
        ),
        bad(
            "random bytes",
            random_bytes(4096),
            &["bad.toml", "UTF-8", "expected text"],
        ),
        bad("zeros", [0; 4096], &["bad.toml:1:4097", "found no TOML"]),
        bad(
            "cut off",
            &scene("", "", "", "")[..40],
            &["bad.toml:4:13", "found no TOML"],
        ),
        bad(
            "[[[[…",
            "[".repeat(100_000),
            &["bad.toml:1:", "found no TOML"],
        ),
        bad(
            "x = [[[[…",
            format!("x = {}", "[".repeat(100_000)),
            &["bad.toml:1:", "found no TOML"],
        ),
        bad(
            "a.a.a.…",
            format!("{} = 1", vec!["a"; 50_000].join(".")),
            &["bad.toml:1:1", "found no TOML", "recursion"],
        ),
        bad(
            "a key of 1 MB",
            format!("{} = 1", "k".repeat(1 << 20)),
            &["bad.toml:1:1", "kkk…\"", "expected one of"],
        ),
        bad(
            "an escape sequence",
            "\"\\u001b[2J\" = 1",
            &["bad.toml:1:1", "\\u{1b}[2J", "expected one of"],
        ),
        bad(
            "camera twice",
            format!("{CAMERA}{CAMERA}{OBJECT}"),
            &["bad.toml:4:", "duplicate", "found no TOML"],
        ),
        bad("no camera", OBJECT, &["bad.toml:1:1", "found no camera"]),
        bad(
            "no object",
            format!("{CAMERA}{LIGHT}"),
            &["bad.toml:1:1", "found no object"],
        ),
        bad(
            "object = []",
            format!("object = []\n{CAMERA}{LIGHT}"),
            &["bad.toml", "found no objects", "[[object]]"],
        ),
        bad(
            "no light",
            format!("{CAMERA}{OBJECT}"),
            &["bad.toml", "0 lights", "expected 1"],
        ),
        bad(
            "two lights",
            format!("{CAMERA}[{LIGHT}[{LIGHT}{OBJECT}").replace("[[light]", "[[light]]"),
            &["bad.toml", "2 lights", "expected 1"],
        ),
        bad(
            "70,000 objects",
            format!("{CAMERA}{}", OBJECT.repeat(many)),
            &["bad.toml:131", "65537 objects", "expected at most"],
        ),
        bad(
            "many triangles",
            format!(
                "{CAMERA}{}",
                "[[object]]\nmesh = \"sphere\"\nmesh_size = 900\n".repeat(4)
            ),
            &[
                "bad.toml:13:1",
                "12945600 triangles in 4 objects",
                "expected at most 10000000",
            ],
        ),
        in_root(
            "camra = 1",
            &[
                "bad.toml:1:1",
                "\"camra\"",
                "did you mean \"camera\"",
                "expected one of",
            ],
        ),
        in_root(
            "size = [0, 10]",
            &["bad.toml:1:8", "[0, 10]", "2 whole numbers from 1 to 16384"],
        ),
        in_root(
            "size = [60000, 60000]",
            &["bad.toml:1:8", "from 1 to 16384"],
        ),
        in_root("size = [1.5, 2]", &["bad.toml:1:8", "whole"]),
        in_root("clear = [0, 0]", &["bad.toml:1:9", "3 numbers from 0 to 1"]),
        in_root("clear = [0, 0, 2]", &["bad.toml:1:9", "[0, 0, 2]"]),
        in_root(
            "ambient = \"grey\"",
            &["bad.toml:1:11", "grey", "3 numbers"],
        ),
        in_root("sky = 3", &["bad.toml:1:7", "\"3\"", "text in quotes"]),
        camera(
            "eye = [0, 5, 10]",
            &[
                "bad.toml:1:1",
                "no target and no look",
                "expected one of the two",
            ],
        ),
        camera("target = [0, 0, 0]", &["bad.toml:1:1", "found no eye"]),
        camera(
            "eye = [1, 2, 3]\ntarget = [1, 2, 3]",
            &["bad.toml:3:10", "[1, 2, 3]", "a target away from the eye"],
        ),
        camera(
            "eye = [1, 2, 3]\nlook = [0, 0, 0]",
            &["bad.toml:3:8", "a direction"],
        ),
        camera(
            "eye = [1, 2, 3]\nlook = [0, 0, 1]\ntarget = [0, 0, 0]",
            &["bad.toml:3:8", "found target and look", "one of the two"],
        ),
        camera(
            "eye = [1, 2, nan]\nlook = [0, 0, 1]",
            &["bad.toml:2:7", "nan", "3 numbers"],
        ),
        camera(
            "eye = [1, inf, 2]\nlook = [0, 0, 1]",
            &["bad.toml:2:7", "inf", "3 numbers"],
        ),
        camera(
            "eye = [1, 1e300, 2]\nlook = [0, 0, 1]",
            &["bad.toml:2:7", "1e300", "from -1e12 to 1e12"],
        ),
        camera(
            "eye = [0, 5, 0]\ntarget = [0, 0, 0]",
            &["bad.toml:1:1", "up along the look"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nup = [0, 0, -3]",
            &["bad.toml:4:6", "up along the look"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nup = [0, 0, 0]",
            &["bad.toml:4:6", "a direction"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nnear = 0",
            &["bad.toml:4:8", "\"0\"", "from 1e-9"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nnear = -1",
            &["bad.toml:4:8", "\"-1\""],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nnear = 2\nfar = 2",
            &["bad.toml:5:7", "\"2\"", "more than near"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nfovy = 180",
            &["bad.toml:4:8", "\"180\"", "from 0.01 to 179"],
        ),
        camera(
            "eye = [0, 5, 0]\nlook = [0, 0, 1]\nfovx = 90\nfovy = 60",
            &["bad.toml:4:8", "found fovy and fovx"],
        ),
        light("target = [0, 0, 0]", &["bad.toml:4:1", "found no position"]),
        light(
            "position = [0, 0, 0]",
            &["bad.toml:4:1", "[0, 0, 0]", "another target"],
        ),
        light(
            "position = [1, 1, 1]\ntarget = [1, 1, 1]",
            &["bad.toml:6:10", "away from the light"],
        ),
        light(
            "kind = \"directional\"",
            &["bad.toml:4:1", "no direction", "expected one"],
        ),
        light(
            "kind = \"directional\"\ndirection = [0, -1, 0]",
            &[
                "bad.toml:",
                "a directional light",
                "expected spot or point: csci3260",
            ],
        ),
        in_light(
            "kind = \"sopt\"",
            &["bad.toml:8:8", "\"sopt\"", "did you mean \"spot\""],
        ),
        in_light(
            "cone = 180",
            &["bad.toml:8:8", "\"180\"", "from 0.01 to 179"],
        ),
        in_light("cone = 0", &["bad.toml:8:8", "\"0\"", "from 0.01"]),
        in_light(
            "cone = 0.5",
            &["bad.toml:", "spot_angle", "0.5", "1 to 179"],
        ),
        in_light("near = 3\nfar = 2", &["bad.toml:9:7", "more than near"]),
        in_light(
            "near = 40",
            &["bad.toml:6:1", "far = 30, its default", "more than near"],
        ),
        in_light(
            "box = [1, -1, -1, 1, 0, 9]",
            &["bad.toml:8:7", "left < right"],
        ),
        in_light(
            "color = [-1, 0, 0]",
            &["bad.toml:8:9", "[-1, 0, 0]", "from 0 to 1000"],
        ),
        in_light("direction = [0, 0, 0]", &["bad.toml:8:13", "a direction"]),
        in_object("scale = 0", &["bad.toml:11:9", "\"0\"", "1e-6 to 1e6"]),
        in_object("scale = [1, 0, 1]", &["bad.toml:11:9", "[1, 0, 1]"]),
        in_object(
            "mesh_size = 1001",
            &["bad.toml:11:13", "\"1001\"", "from 1 to 1000"],
        ),
        in_object(
            "mesh_size = 99999999999999999999",
            &["bad.toml:11:13", "from 1 to 1000"],
        ),
        in_object("thickness = 0", &["bad.toml:11:13", "from 0.001 to 1000"]),
        in_object(
            "rotate = { axis = [0, 0, 0], degrees = 3 }",
            &["bad.toml:11:19", "a direction"],
        ),
        in_object(
            "rotate = { degrees = 3 }",
            &["bad.toml:11:10", "found no axis"],
        ),
        in_object(
            "rotate = 3",
            &["bad.toml:11:10", "\"3\"", "the table rotate"],
        ),
        in_object(
            "spin = { axis = [0, 0, 1], degrees = 3 }",
            &["bad.toml:11:28", "degrees_per_second"],
        ),
        in_object("casts = 1", &["bad.toml:11:9", "\"1\"", "true or false"]),
        in_object(
            "texture = \"none.png\"",
            &["bad.toml:11:11", "none.png", "cannot read it"],
        ),
        in_object("texture = \"\"", &["bad.toml:11:11", "a file's name"]),
        object(
            "mesh = \"teapot\"\nmesh_size = 1000",
            &["bad.toml:8:13", "64000000 triangles", "at most 10000000"],
        ),
        in_object(
            "texture = \"pipe\"",
            &["bad.toml:11:11", "a pipe", "expected a file"],
        ),
        in_object(
            "texture = \"huge.png\"",
            &["bad.toml:11:11", "60000×60000", "at most 16384×16384"],
        ),
        in_object(
            "texture = \"large.png\"",
            &["bad.toml:11:11", "large.png", "expected a PNG or JPEG"],
        ),
        in_object(
            "texture = \"cut.png\"",
            &["bad.toml:11:11", "cut.png", "expected a PNG or JPEG"],
        ),
        in_object(
            "texture = \"cut.jpg\"",
            &["bad.toml:11:11", "cut.jpg", "expected a PNG or JPEG"],
        ),
        in_object(
            "texture = \"noise.png\"",
            &["bad.toml:11:11", "noise.png: found no picture"],
        ),
        object("scale = 1", &["bad.toml:6:1", "found no mesh"]),
        object(
            "mesh = \"spere\"",
            &["bad.toml:7:8", "\"spere\"", "did you mean \"sphere\""],
        ),
        object(
            "mesh = \"sphere\"\nmesh_size = 1",
            &["bad.toml:8:13", "from 2 to 1000"],
        ),
        object(
            "mesh = \"torus\"\nmesh_size = 2",
            &["bad.toml:8:13", "from 3 to 1000"],
        ),
        object(
            "mesh = \"none.obj\"",
            &["bad.toml:7:8", "none.obj", "No such file"],
        ),
        object("mesh = \"folder.obj\"", &["bad.toml:7:8", "a directory"]),
        object(
            "mesh = \"pipe.obj\"",
            &["bad.toml:7:8", "a pipe", "expected a file"],
        ),
        object(
            "mesh = \"device.obj\"",
            &["bad.toml:7:8", "outside of the scene's folder"],
        ),
        object(
            "mesh = \"loop.obj\"",
            &["bad.toml:7:8", "loop.obj", "cannot read it"],
        ),
        object(
            "mesh = \"../outside.obj\"",
            &[
                "bad.toml:7:8",
                "outside of the scene's folder",
                "--allow-outside",
            ],
        ),
        object(
            "mesh = \"link.obj\"",
            &["bad.toml:7:8", "outside of the scene's folder"],
        ),
        object(
            "mesh = \"through/outside.obj\"",
            &["bad.toml:7:8", "outside of the scene's folder"],
        ),
        object(
            "mesh = \"C:\\\\models\\\\a.obj\"",
            &["bad.toml:7:8", "C:/models/a.obj", "cannot read it"],
        ),
        object(
            "mesh = \"a\\u0000.obj\"",
            &["bad.toml:7:8", "cannot read it"],
        ),
        object("mesh = \"empty.obj\"", &["bad.toml:7:8", "found no faces"]),
        object(
            "mesh = \"noise.obj\"",
            &["bad.toml:7:8", "noise.obj", "found no faces"],
        ),
        object(
            "mesh = \"large.obj\"",
            &["bad.toml:7:8", "large.obj", "larger than 1024 MiB"],
        ),
        object(
            "mesh = \"index.obj\"",
            &["index.obj:5:", "\"1000000000\"", "expected 1 to 3"],
        ),
        object(
            "mesh = \"nan.obj\"",
            &["nan.obj:1:", "nan", "3 finite numbers"],
        ),
        object(
            "mesh = \"library_outside.obj\"",
            &["outside.mtl", "outside of the scene's folder"],
        ),
        object("mesh = \"texture_pipe.obj\"", &["pipe", "expected a file"]),
    ]
}

fn random_bytes(count: usize) -> Vec<u8> {
    let mut random = common::Random(541);
    (0..count).map(|_| random.below(256) as u8).collect()
}

/// A PNG that announces a size, and goes on for a kilobyte.
fn announced_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    // A zlib stream whose first block is 1000 bytes as they are.
    let mut data = vec![0x78, 0x01, 0x00, 0xe8, 0x03, 0x17, 0xfc];
    data.resize(7 + 1000, 0);
    writer.write_chunk(png::chunk::IDAT, &data).unwrap();
    drop(writer);
    bytes
}

/// A whole picture, packed by the encoder's fastest way.
fn picture(format: image::ImageFormat) -> Vec<u8> {
    let noise = random_bytes(3 * 64 * 64);
    let picture = image::RgbImage::from_raw(64, 64, noise).unwrap();
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// The files that bad scenes name, in a folder of their own beside one that is not theirs.
fn prepare(name: &str) -> std::path::PathBuf {
    let outside = work_folder(name);
    let folder = outside.join("scene");
    std::fs::create_dir(&folder).unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.join(name), bytes).unwrap();
    std::fs::write(outside.join("outside.obj"), TRIANGLE).unwrap();
    std::fs::write(outside.join("outside.mtl"), "newmtl a\n").unwrap();
    std::fs::create_dir(folder.join("folder.obj")).unwrap();
    for (name, target) in [
        ("loop.obj", "loop.obj"),
        ("device.obj", "/dev/zero"),
        ("link.obj", "../outside.obj"),
        ("through", ".."),
    ] {
        std::os::unix::fs::symlink(target, folder.join(name)).unwrap();
    }
    for pipe in ["pipe", "pipe.obj"] {
        let made = Command::new("mkfifo").arg(folder.join(pipe)).status();
        assert!(made.unwrap().success());
    }
    write("empty.obj", b"");
    write("noise.obj", &random_bytes(100_000));
    write("noise.png", &random_bytes(100_000));
    write(
        "index.obj",
        format!("{TRIANGLE}f 1 2 1000000000\n").as_bytes(),
    );
    write("nan.obj", b"v 0 nan 0\n");
    write(
        "library_outside.obj",
        format!("mtllib ../outside.mtl\n{TRIANGLE}").as_bytes(),
    );
    write(
        "texture_pipe.obj",
        format!("mtllib pipe.mtl\n{TRIANGLE}").as_bytes(),
    );
    write("pipe.mtl", b"newmtl a\nmap_Kd pipe\n");
    write("huge.png", &announced_png(60_000, 60_000));
    write("large.png", &announced_png(16_000, 16_000));
    let whole = picture(image::ImageFormat::Png);
    write("cut.png", &whole[..whole.len() / 2]);
    write("cut.jpg", &[0xff, 0xd8, 0xff, 0xe0, 0, 16]);
    // A hole takes no room on the disk.
    let large = std::fs::File::create(folder.join("large.obj")).unwrap();
    large.set_len((1 << 30) + 1).unwrap();
    folder
}

/// Runs the program with bounded memory, and stops it when it takes too long.
fn shadowlab(folder: &Path, arguments: &[&str]) -> Output {
    let limited = format!("ulimit -v {ADDRESS_SPACE_KIB}; exec \"$0\" \"$@\"");
    let mut child = Command::new("sh")
        .args(["-c", &limited, env!("CARGO_BIN_EXE_shadowlab")])
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("{arguments:?} takes more than {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.wait_with_output().unwrap()
}

/// The one line that the program says about `what`, or how it falls short of what it should say.
fn told(
    folder: &Path,
    arguments: &[&str],
    code: i32,
    words: &[&str],
    what: &str,
) -> Result<String, String> {
    let output = shadowlab(folder, arguments);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let missing = words.iter().find(|word| !told.contains(**word));
    let problem = match missing {
        _ if output.status.code() != Some(code) => format!("{:?}, expected {code}", output.status),
        _ if told.lines().count() != 1 || !told.starts_with("shadowlab: ") => "not one line".into(),
        _ if told.trim_end().contains(char::is_control) => "a control character".into(),
        _ if told.len() > 1000 => "too long".into(),
        _ if !output.stdout.is_empty() => "something on standard output".into(),
        Some(word) => format!("no \"{word}\""),
        None => return Ok(told),
    };
    Err(format!("{}: {problem} in: {}", cell(what), cell(&told)))
}

/// A cell of a table: one line, and not a long one.
fn cell(text: &str) -> String {
    let text = text.trim().replace('\n', " ⏎ ").replace('|', "\\|");
    text.chars().take(300).collect()
}

#[test]
fn bad_scenes_get_one_line_and_leave_nothing_behind() {
    let folder = prepare("bad_scenes");
    let call = [
        "screenshot",
        "cs541",
        "--size",
        "16x16",
        "--scene",
        "bad.toml",
        "-o",
        "a.png",
    ];
    let all = scenes();
    println!(
        "| {} bad scenes | exit code | what is said |\n|---|---|---|",
        all.len()
    );
    let mut problems = Vec::new();
    for Bad { what, text, words } in all {
        std::fs::write(folder.join("bad.toml"), text).unwrap();
        match told(&folder, &call, 1, words, what) {
            Ok(told) => println!("| `{}` | 1 | {} |", cell(what), cell(&told)),
            Err(problem) => problems.push(problem),
        }
        assert!(!folder.join("a.png").exists(), "{what}");
    }
    assert!(problems.is_empty(), "\n{}", problems.join("\n"));
}

/// What stands in the place of the scene, or of a shader.
#[test]
fn bad_places_get_one_line() {
    let folder = prepare("bad_places");
    std::fs::create_dir_all(folder.join("shaders")).unwrap();
    for (name, target) in [("shadow.vert", "../pipe"), ("shadow.frag", "shadow.frag")] {
        std::os::unix::fs::symlink(target, folder.join("shaders").join(name)).unwrap();
    }
    let large = std::fs::File::create(folder.join("large.toml")).unwrap();
    large.set_len((4 << 20) + 1).unwrap();
    std::fs::write(folder.join("good.toml"), scene("", "", "", "")).unwrap();
    for (arguments, code, words) in [
        (
            "--scene none.toml",
            1,
            &["none.toml", "cannot read it", "No such file"][..],
        ),
        (
            "--scene folder.obj",
            1,
            &["folder.obj", "a directory, expected a file"],
        ),
        ("--scene none/none.toml", 1, &["none", "cannot read it"]),
        ("--scene pipe", 1, &["pipe", "a pipe, a socket or a device"]),
        (
            "--scene /dev/zero",
            1,
            &["/dev/zero", "a device, expected a file"],
        ),
        ("--scene loop.obj", 1, &["loop.obj", "cannot read it"]),
        (
            "--scene large.toml",
            1,
            &["large.toml", "larger than 4 MiB"],
        ),
        (
            "--scene good.toml --glsl shaders",
            1,
            &["shadow.vert", "a pipe"],
        ),
        ("--allow-outside", 2, &["--scene"]),
        ("--scene", 2, &["--scene", "FILE.toml"]),
    ] {
        let call: Vec<&str> = ["screenshot", "cs541"]
            .into_iter()
            .chain(arguments.split_whitespace())
            .collect();
        let told = told(&folder, &call, code, words, arguments).unwrap();
        println!("| `{arguments}` | {code} | {} |", cell(&told));
    }
    std::fs::remove_file(folder.join("shaders/shadow.vert")).unwrap();
    let call = ["screenshot", "cs541", "--glsl", "shaders"];
    let words = ["shadow.frag", "cannot read it"];
    told(&folder, &call, 1, &words, "a link to itself").unwrap();
}

/// A file that grows for as long as it is read: the limit holds where the size does not warn.
#[test]
fn a_file_that_grows_is_read_up_to_its_limit() {
    let folder = work_folder("grows");
    let path = folder.join("grows.txt");
    std::fs::write(&path, [b'#'; 1000]).unwrap();
    let grows = std::sync::atomic::AtomicBool::new(true);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let mut file = std::fs::OpenOptions::new()
                .append(true)
                .open(&path)
                .unwrap();
            let start = Instant::now();
            while grows.load(std::sync::atomic::Ordering::Relaxed) && start.elapsed() < PATIENCE {
                std::io::Write::write_all(&mut file, &[b'#'; 1 << 16]).unwrap();
                if file.metadata().unwrap().len() > 1 << 26 {
                    file.set_len(1000).unwrap();
                }
            }
        });
        for _ in 0..20 {
            if let Ok(bytes) = shadowlab::scene::reading::read(&path, 1 << 20) {
                assert!(bytes.len() <= 1 << 20);
            }
        }
        grows.store(false, std::sync::atomic::Ordering::Relaxed);
    });
    let error = shadowlab::scene::reading::read(Path::new("/proc/self/smaps"), 100).unwrap_err();
    assert!(error.to_string().contains("larger than"), "{error}");
}

/// The controls: the scene that the bad ones were made from is drawn, and what is odd but harmless is drawn too.
#[test]
fn good_scenes_are_drawn() {
    let folder = prepare("good_scenes");
    let degenerate = format!("{TRIANGLE}f 1 1 1\nf 1 2 2\nf 1 2 3\nf 3 2 1\nf 1 2 3 1 2 3\n");
    std::fs::write(folder.join("degenerate.obj"), degenerate).unwrap();
    for format in [image::ImageFormat::Png, image::ImageFormat::Jpeg] {
        let name = format!("noise.{}", format.extensions_str()[0]);
        std::fs::write(folder.join(name), picture(format)).unwrap();
    }
    for (text, outside) in [
        (scene("", "", "", ""), false),
        (scene("", "far = 100", "cone = 1", "scale = -1"), false),
        (scene("", "", "kind = \"point\"", "casts = false"), false),
        (
            scene("sky = \"noise.jpg\"", "", "", "texture = \"noise.png\""),
            false,
        ),
        (
            scene("", "", "", "").replace("cube", "degenerate.obj"),
            false,
        ),
        (
            scene("", "", "", "").replace("cube", "../outside.obj"),
            true,
        ),
        (
            scene("", "", "", "").replace("cube", "../scene/degenerate.obj"),
            false,
        ),
        (
            scene("", "", "", "").replace("cube", "library_outside.obj"),
            true,
        ),
    ] {
        std::fs::write(folder.join("good.toml"), &text).unwrap();
        let mut call = vec![
            "screenshot",
            "cs541",
            "--scene",
            "good.toml",
            "--size",
            "16x16",
        ];
        if outside {
            call.push("--allow-outside");
        }
        let output = shadowlab(&folder, &call);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{text}: {told}");
        assert_eq!(told, "", "{text}");
    }
}
