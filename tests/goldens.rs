//! Golden pictures: `shadowlab screenshot` must still draw what a person has looked at and found right.
//!
//! Only `cargo xtask bless` writes them. A golden that is missing, or has another size, is a failure.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::{Bench, SHARE_BEYOND, compare, work_folder};
use image::{DynamicImage, RgbImage, imageops};

/// The same as [`SHARE_BEYOND`] for acne of 16-bit depths, and of two maps at once, whose every dot hangs on how a depth
/// was rounded. Measured: 0.21 %, 0.05 %.
const SHARE_OF_DOTS: f64 = 0.004;

struct Case {
    lab: &'static str,
    name: &'static str,
    options: &'static str,
    share_beyond: f64,
}

const fn cs541(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "cs541",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const fn csci3260(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "csci3260",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const fn aueb7(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "aueb7",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const fn cmsc23700(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "cmsc23700",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const fn eecs487(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "eecs487",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const CASES: &[Case] = &[
    aueb7("default", ""),
    aueb7("depth-map", "--show shadow-map --set map_size=512"),
    aueb7("visibility", "--size 320x320 --show visibility"),
    aueb7("256", "--size 320x320 --set map_size=256"),
    aueb7("512", "--size 320x320 --set map_size=512"),
    aueb7("1024", "--size 320x320 --set map_size=1024"),
    aueb7(
        "pcf-5",
        "--size 320x320 --set map_size=512 --set filter=pcf_5",
    ),
    aueb7(
        "pcf-9",
        "--size 320x320 --set map_size=512 --set filter=pcf_9",
    ),
    aueb7(
        "pcf-9-visibility",
        "--size 320x320 --set map_size=256 --set filter=pcf_9 --show visibility",
    ),
    aueb7(
        "bias-0",
        "--size 320x320 --set map_size=512 --set constant_depth_bias=0",
    ),
    aueb7(
        "outside-lit",
        "--size 320x320 --set map_size=512 --set outside=lit",
    ),
    aueb7("shadows-off", "--size 320x320 --set shadows=off"),
    aueb7("wireframe", "--size 320x320 --set map_size=512 --keys <F1>"),
    aueb7(
        "points",
        "--size 320x320 --set map_size=512 --keys <F1><F1>",
    ),
    aueb7(
        "rotated-light",
        "--size 320x320 --set map_size=512 --set rotate_light=on --time 4",
    ),
    aueb7(
        "moved-keys",
        "--size 320x320 --set map_size=512 --keys wwddrrr<Left><Left><Up><PageUp><Drag:40,20><RightDrag:200,-50>",
    ),
    aueb7(
        "pirate",
        "--set scene=pirate --set map_size=1024 --set filter=pcf_5",
    ),
    aueb7("pirate-128", "--size 320x320 --set scene=pirate"),
    aueb7(
        "knossos",
        "--set scene=knossos --set map_size=1024 --set filter=pcf_5",
    ),
    aueb7("knossos-128", "--size 320x320 --set scene=knossos"),
    aueb7(
        "knossos-evening",
        "--size 320x320 --set scene=knossos --set map_size=1024 --set rotate_light=on --time 2",
    ),
    cmsc23700("default", ""),
    cmsc23700("directional", "--size 320x320 --set lights=directional"),
    cmsc23700("spotlight", "--size 320x320 --set lights=spotlight"),
    cmsc23700("shadows-off", "--size 320x320 --set shadows=off"),
    Case {
        share_beyond: SHARE_OF_DOTS,
        ..cmsc23700(
            "no-bias",
            "--size 320x320 --set directional_bias=0 --set spot_bias=0",
        )
    },
    cmsc23700("map-256", "--size 320x320 --set map_size=256"),
    cmsc23700("hundred-balls", "--size 320x320 --set balls=100 --time 3"),
    cmsc23700("moved-keys", "--size 320x320 --time 1.5 --keys +++l-"),
    cmsc23700(
        "depth-map-directional",
        "--show shadow-map --light 1 --set map_size=320",
    ),
    cmsc23700(
        "depth-map-spotlight",
        "--show shadow-map --light 2 --set map_size=320",
    ),
    cmsc23700(
        "visibility-directional",
        "--size 320x320 --show visibility --light 1",
    ),
    cmsc23700(
        "visibility-spotlight",
        "--size 320x320 --show visibility --light 2",
    ),
    eecs487("default", ""),
    eecs487("visibility", "--size 320x320 --show visibility"),
    eecs487("floor", "--size 320x320 --keys x"),
    eecs487("floor-clipped", "--size 320x320 --keys xc"),
    eecs487("left-clipped", "--size 320x320 --keys xxc"),
    eecs487("full-room-clipped", "--size 320x320 --keys c"),
    eecs487(
        "moved-keys",
        "--size 320x320 --keys rrrrrrrrrrrrjjjjjjjjjjjjjjjjjjhhhhhhhhwwwwSS",
    ),
    eecs487("tessellation-2", "--size 320x320 --set tessellation=2"),
    eecs487("soft-2", "--size 320x320 --keys f --set jitter_amount=0.05"),
    eecs487(
        "soft-16",
        "--size 320x320 --keys f --set jitter_amount=0.05 --set num_jitters=16",
    ),
    eecs487(
        "soft-64",
        "--size 320x320 --keys f --set jitter_amount=0.05 --set num_jitters=64",
    ),
    eecs487(
        "soft-64-fast",
        "--size 320x320 --keys fc --set jitter_amount=0.05 --set num_jitters=64 --set soft_method=fast --set jitter=low-discrepancy",
    ),
    eecs487(
        "soft-visibility",
        "--size 320x320 --keys f --set jitter_amount=0.05 --set num_jitters=16 --show visibility",
    ),
    eecs487(
        "soft-s8",
        "--size 320x320 --keys f --set num_jitters=8 --set accumulator=S8",
    ),
    eecs487(
        "soft-s8-sum",
        "--size 320x320 --keys f --set num_jitters=8 --set accumulator=S8 --set accumulation=sum_then_divide",
    ),
    eecs487("ramp", "--size 320x320 --set scene=ramp"),
    eecs487(
        "ramp-rgba16f",
        "--size 320x320 --set scene=ramp --set accumulator=RGBA16F",
    ),
    eecs487(
        "ramp-rgba8",
        "--size 320x320 --set scene=ramp --set accumulator=RGBA8",
    ),
    eecs487(
        "ramp-s8",
        "--size 320x320 --set scene=ramp --set accumulator=S8",
    ),
    eecs487(
        "ramp-s8-sum",
        "--size 320x320 --set scene=ramp --set accumulator=S8 --set accumulation=sum_then_divide",
    ),
    csci3260("default", ""),
    csci3260("depth-map", "--show shadow-map --set map_size=512"),
    csci3260("visibility", "--size 320x240 --show visibility"),
    csci3260("second-textures", "--size 320x240 --keys 24"),
    csci3260(
        "moved-keys",
        "--size 320x240 --keys ww<Up><Left><Left><Drag:80,40>",
    ),
    csci3260("no-bias", "--size 320x240 --set stage=no_bias"),
    csci3260("slope", "--size 320x240 --set stage=slope"),
    csci3260("culling", "--size 320x240 --set stage=culling"),
    csci3260("thick", "--size 320x240 --set stage=thick"),
    csci3260("pcf", "--size 320x240 --set stage=pcf"),
    csci3260("shadows-off", "--size 320x240 --set shadows=off"),
    csci3260("room", "--size 320x240 --set scene=room"),
    csci3260(
        "room-no-bias",
        "--size 320x240 --set scene=room --set stage=no_bias",
    ),
    csci3260(
        "room-slope",
        "--size 320x240 --set scene=room --set stage=slope",
    ),
    csci3260(
        "room-culling",
        "--size 320x240 --set scene=room --set stage=culling",
    ),
    csci3260(
        "room-thick",
        "--size 320x240 --set scene=room --set stage=thick",
    ),
    csci3260(
        "room-pcf",
        "--size 320x240 --set scene=room --set stage=pcf",
    ),
    csci3260(
        "room-256",
        "--size 320x240 --set scene=room --set map_size=256",
    ),
    cs541("default", ""),
    cs541("depth-map", "--show shadow-map --set map_size=512"),
    cs541("visibility", "--show visibility"),
    cs541("shadows-off", "--size 320x320 --set shadows=off"),
    cs541(
        "remedy-none",
        "--size 320x320 --set remedy=none --set filter=nearest",
    ),
    cs541("remedy-culling", "--size 320x320 --set remedy=culling"),
    cs541(
        "remedy-culling-second-plane",
        "--size 320x320 --set remedy=culling --set second_plane=on",
    ),
    cs541("remedy-both", "--size 320x320 --set remedy=both"),
    cs541("circular", "--size 320x320 --set beam=circular"),
    cs541("point", "--size 320x320 --set light=point"),
    Case {
        share_beyond: SHARE_OF_DOTS,
        ..cs541(
            "format-16",
            "--size 320x320 --set depth_format=16 --set epsilon=0.000004",
        )
    },
    cs541(
        "format-24",
        "--size 320x320 --set depth_format=24 --set epsilon=0.000004",
    ),
    cs541(
        "format-32F",
        "--size 320x320 --set depth_format=32F --set epsilon=0.000004",
    ),
    cs541(
        "nearest-256",
        "--size 320x320 --set filter=nearest --set map_size=256",
    ),
    cs541("from-light", "--size 320x320 --keys x"),
    cs541(
        "moved-keys",
        "--size 320x320 --time 1.5 --keys wwddq<Left><Left><PageUp>oo",
    ),
    cs541(
        "five-shapes",
        "--scene assets/five_shapes.toml --size 400x300",
    ),
    cs541(
        "five-shapes-visibility",
        "--scene assets/five_shapes.toml --size 400x300 --show visibility",
    ),
];

impl Case {
    fn golden(&self) -> PathBuf {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
        folder.join(self.lab).join(format!("{}.png", self.name))
    }

    /// Draws the case with the program itself, on the software renderer.
    fn draw(&self, output: &Path, cpu_caps: Option<&str>) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
        command.args(["screenshot", self.lab, "--device", "software", "-o"]);
        command.arg(output).args(self.options.split_whitespace());
        if let Some(caps) = cpu_caps {
            command.env("GALLIUM_OVERRIDE_CPU_CAPS", caps);
        }
        let ran = command.output().unwrap();
        let told = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{}: {told}", self.name);
    }
}

/// Draws all cases and returns a line for each that is not as its golden.
fn differences(folder: &Path, cpu_caps: Option<&str>) -> Vec<String> {
    let mut lines = Vec::new();
    for case in CASES {
        let drawn = folder.join(format!("{}-{}.png", case.lab, case.name));
        case.draw(&drawn, cpu_caps);
        let found = match image::open(case.golden()) {
            Ok(golden) => compare(&golden, &image::open(&drawn).unwrap(), case.share_beyond),
            Err(error) => Err(format!("no golden: {error}")),
        };
        if let Err(found) = found {
            lines.push(format!(
                "{}/{}: {found} ({})",
                case.lab,
                case.name,
                drawn.display()
            ));
        }
    }
    lines
}

#[test]
fn every_case_is_as_its_golden() {
    if std::env::var_os("SHADOWLAB_BLESS").is_some() {
        for case in CASES {
            std::fs::create_dir_all(case.golden().parent().unwrap()).unwrap();
            case.draw(&case.golden(), None);
        }
        return;
    }
    let lines = differences(&work_folder("goldens"), None);
    assert!(
        lines.is_empty(),
        "look at them, then `cargo xtask bless`:\n{}",
        lines.join("\n")
    );
}

/// Exercise 3 of aueb7 as a whole: a ball and its shadow by each kernel and step, from 128 to 1024 texels.
fn pcf_sheet() -> DynamicImage {
    const PART: [u32; 2] = [120, 140];
    let kernels = [
        ("none", 2),
        ("pcf_5", 1),
        ("pcf_5", 2),
        ("pcf_5", 4),
        ("pcf_9", 1),
        ("pcf_9", 2),
        ("pcf_9", 4),
    ];
    let sizes = [128, 256, 512, 1024];
    let mut bench = Bench::new("aueb7", [400, 400], &[]);
    let mut sheet = RgbImage::new(PART[0] * sizes.len() as u32, PART[1] * kernels.len() as u32);
    for ((filter, step), row) in kernels.iter().zip(0..) {
        for (size, column) in sizes.iter().zip(0..) {
            bench.set(&[
                &format!("filter={filter}"),
                &format!("step={step}"),
                &format!("map_size={size}"),
            ]);
            let picture = bench.picture();
            let part = imageops::crop_imm(&picture, 250, 180, PART[0], PART[1]).to_image();
            let place = [column * PART[0], row * PART[1]].map(i64::from);
            imageops::replace(&mut sheet, &part, place[0], place[1]);
        }
    }
    sheet.into()
}

#[test]
fn each_kernel_step_and_map_size_is_as_in_the_golden() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/aueb7/pcf-sheet.png");
    let sheet = pcf_sheet();
    if std::env::var_os("SHADOWLAB_BLESS").is_some() {
        sheet.save(golden).unwrap();
        return;
    }
    let golden = image::open(golden).unwrap();
    assert_eq!(compare(&golden, &sheet, SHARE_BEYOND), Ok(()));
    // The control: two steps that change places.
    let (four, two) = (
        sheet.crop_imm(0, 840, 480, 140),
        sheet.crop_imm(0, 700, 480, 140),
    );
    assert!(compare(&four, &two, SHARE_BEYOND).is_err());
}

#[test]
fn the_tolerance_holds_on_another_processor() {
    let lines = differences(&work_folder("goldens-sse"), Some("sse4.1"));
    assert!(lines.is_empty(), "{}", lines.join("\n"));
}

/// A golden's neighbours must not pass for it, not even where the most is forgiven.
#[test]
fn a_wrong_picture_fails() {
    let size = [320, 320];
    let mut bench = Bench::new("cs541", size, &[]);
    let right = DynamicImage::from(bench.picture());
    let check = |drawn: &DynamicImage| compare(&right, drawn, SHARE_OF_DOTS);
    assert_eq!(check(&right), Ok(()));
    for setting in [
        "shadows=off",
        "remedy=none",
        "remedy=culling",
        "beam=circular",
        "light=point",
    ] {
        let mut bench = Bench::new("cs541", size, &[setting]);
        assert!(check(&bench.picture().into()).is_err(), "{setting}");
    }
    assert!(check(&right.flipv()).is_err());
    let smaller = right.crop_imm(0, 0, 319, 320);
    assert!(check(&smaller).unwrap_err().contains("pixels"));
}
