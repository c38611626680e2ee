//! Golden pictures: `shadowlab screenshot` must still draw what a person has looked at and found right.
//!
//! Only `cargo xtask bless` writes them. A golden that is missing, or has another size, is a failure.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use common::{Bench, SHARE_BEYOND, compare, work_folder};
use image::DynamicImage;

/// The same as [`SHARE_BEYOND`] for acne of 16-bit depths, whose every dot hangs on how a depth was rounded. Measured: 0.21 %.
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

const fn eecs487(name: &'static str, options: &'static str) -> Case {
    Case {
        lab: "eecs487",
        name,
        options,
        share_beyond: SHARE_BEYOND,
    }
}

const CASES: &[Case] = &[
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
