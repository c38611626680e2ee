//! `shadowlab compare`: right pictures, mistaken ones, pictures that are perturbed, pairs, and a folder of them.

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::work_folder;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::FilterType;
use image::{Rgb, RgbImage, Rgba, RgbaImage, imageops};
use serde_json::Value;
use shadowlab::labs::LABS;
use shadowlab::mistakes;

/// Half of the course's windows and less: enough to see what is wrong.
const SIZE: &str = "200x200";

fn shadowlab(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowlab"));
    command.current_dir(folder);
    command.args(arguments.split_whitespace());
    command.args(["--device", "software"]).output().unwrap()
}

fn draw(folder: &Path, arguments: &str, file: &str) -> RgbImage {
    let drawn = shadowlab(
        folder,
        &format!("screenshot {arguments} --size {SIZE} -o {file}"),
    );
    assert!(drawn.status.success(), "{drawn:?}");
    image::open(folder.join(file)).unwrap().into_rgb8()
}

/// The exit code and what `--json` said.
fn compare(folder: &Path, arguments: &str) -> (i32, Value) {
    let compared = shadowlab(folder, &format!("compare {arguments} --json"));
    let code = compared.status.code().unwrap();
    assert!(code < 2, "{arguments}: {compared:?}");
    (code, serde_json::from_slice(&compared.stdout).unwrap())
}

/// The first explanation's mistakes.
fn first(found: &Value) -> Vec<&str> {
    let names = found["diagnosis"][0]["mistakes"].as_array();
    names
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect()
}

fn words(list: &Value) -> String {
    let words = list
        .as_array()
        .unwrap()
        .iter()
        .map(|word| word.as_str().unwrap());
    words.collect::<Vec<_>>().join("; ")
}

#[test]
fn a_right_picture_is_not_accused() {
    let folder = work_folder("compare_right");
    for lab in LABS {
        draw(&folder, lab.name, "mine.png");
        let (code, found) = compare(&folder, &format!("mine.png {}", lab.name));
        assert_eq!(
            (code, &found["same"]),
            (0, &Value::Bool(true)),
            "{}: {found}",
            lab.name
        );
        assert_eq!(found["difference"]["differing"], 0);
        assert_eq!(found["diagnosis"], Value::Array(Vec::new()));
        // Two lights' shadows are not told apart in one picture.
        assert_eq!(found["shadows"].is_null(), lab.lights > 1, "{}", lab.name);
    }
    // Of one of them they are.
    draw(&folder, "cmsc23700 --set lights=directional", "mine.png");
    let (code, found) = compare(&folder, "mine.png cmsc23700 --set lights=directional");
    assert_eq!((code, found["shadows"].is_null()), (0, false));
}

#[test]
fn a_mistake_is_named() {
    let folder = work_folder("compare_mistakes");
    for (lab, mistake) in [
        ("cs541", "no_bias"),
        ("cs541", "viewport_not_restored"),
        ("eecs487", "divided_early"),
        ("csci3260", "comparison_reversed"),
        ("cmsc23700", "bias_matrix_swapped"),
        ("aueb7", "row_major"),
    ] {
        draw(&folder, &format!("{lab} --mistake {mistake}"), "mine.png");
        let (code, found) = compare(&folder, &format!("mine.png {lab}"));
        assert_eq!(code, 1);
        assert!(
            first(&found).contains(&mistake),
            "{lab}, {mistake}: {found}"
        );
    }
}

/// So dark that it is like the lab's either way up, until it is known what it shows.
#[test]
fn a_mistaken_picture_may_be_upside_down_or_brightened() {
    let folder = work_folder("compare_turned");
    let mine = draw(&folder, "aueb7 --mistake bias_matrix_missing", "mine.png");
    let (_, upright) = compare(&folder, "mine.png aueb7");
    imageops::flip_vertical(&mine)
        .save(folder.join("turned.png"))
        .unwrap();
    let (_, turned) = compare(&folder, "turned.png aueb7");
    assert!(
        words(&turned["forgiven"]).contains("upside down"),
        "{turned}"
    );
    assert!(!words(&upright["forgiven"]).contains("upside down"));
    assert_eq!(turned["shadows"], upright["shadows"]);
    assert_eq!(first(&turned), ["bias_matrix_missing"]);
    // So is another curve: its shadows are read after it is undone, up to what levels have lost.
    let mut brightened = mine;
    for Rgb(channels) in brightened.pixels_mut() {
        let gamma = |v: u8| (255.0 * (f64::from(v) / 255.0).powf(1.0 / 2.2)).round() as u8;
        *channels = channels.map(gamma);
    }
    brightened.save(folder.join("brightened.png")).unwrap();
    let (_, brightened) = compare(&folder, "brightened.png aueb7");
    assert!(
        words(&brightened["forgiven"]).contains("1/2.2"),
        "{brightened}"
    );
    let wrong = |found: &Value| found["shadows"]["false_shadow"]["pixels"].as_f64().unwrap();
    let (wrong, expected) = (wrong(&brightened), wrong(&upright));
    assert!(
        (wrong - expected).abs() < 0.01 * expected,
        "{wrong} {expected}"
    );
}

#[test]
fn the_shadows_of_a_mistaken_picture_are_measured() {
    let folder = work_folder("compare_shadows");
    draw(
        &folder,
        "cs541 --mistake no_bias --set filter=nearest",
        "acne.png",
    );
    let (_, acne) = compare(&folder, "acne.png cs541 --set filter=nearest");
    draw(&folder, "cs541 --set shadows=off", "lit.png");
    let (_, lit) = compare(&folder, "lit.png cs541");
    let pixels = |found: &Value, kind: &str| found["shadows"][kind]["pixels"].as_u64().unwrap();
    assert!(pixels(&acne, "false_shadow") > 1000 && pixels(&acne, "false_light") < 50);
    assert!(pixels(&lit, "false_light") > 1000 && pixels(&lit, "false_shadow") == 0);
}

#[test]
fn what_is_no_mistake_is_forgiven_unless_strict() {
    let folder = work_folder("compare_forgiven");
    let right = draw(&folder, "cs541", "right.png");
    let mapped = |change: &dyn Fn(usize, u8) -> u8| {
        let mut picture = right.clone();
        for Rgb(channels) in picture.pixels_mut() {
            *channels = [0, 1, 2].map(|i| change(i, channels[i]));
        }
        picture
    };
    let gamma = |power: f64| {
        mapped(&|_, value| (255.0 * (f64::from(value) / 255.0).powf(power)).round() as u8)
    };
    let mut moved = right.clone();
    imageops::replace(&mut moved, &right, 2, 1);
    for (mine, what) in [
        (imageops::flip_vertical(&right), "upside down"),
        (gamma(2.2), "2.2"),
        (gamma(1.0 / 2.2), "1/2.2"),
        (
            mapped(&|i, value| value.saturating_add([7, 0, 3][i])),
            "tint",
        ),
        (moved, "shift"),
    ] {
        mine.save(folder.join("mine.png")).unwrap();
        let (code, found) = compare(&folder, "mine.png cs541");
        assert_eq!(code, 0, "{what}: {found}");
        assert!(words(&found["forgiven"]).contains(what), "{what}: {found}");
        // A tint of so few levels is within the tolerance anyway.
        let (code, found) = compare(&folder, "mine.png cs541 --strict");
        assert_eq!(code, i32::from(what != "tint"), "{what}");
        assert_eq!(words(&found["forgiven"]), "", "{what}");
    }
    let jpeg = std::fs::File::create(folder.join("mine.jpg")).unwrap();
    right
        .write_with_encoder(JpegEncoder::new_with_quality(jpeg, 85))
        .unwrap();
    let (code, found) = compare(&folder, "mine.jpg cs541");
    assert!(
        code == 0 && words(&found["forgiven"]).contains("JPEG"),
        "{found}"
    );
    assert_eq!(compare(&folder, "mine.jpg cs541 --strict").0, 1);

    // Alpha is left out, and that is said.
    let clear = RgbaImage::from_fn(200, 200, |x, y| {
        let Rgb([r, g, b]) = *right.get_pixel(x, y);
        Rgba([r, g, b, 0])
    });
    clear.save(folder.join("clear.png")).unwrap();
    let (code, found) = compare(&folder, "clear.png cs541");
    assert!(
        code == 0 && words(&found["notes"]).contains("alpha"),
        "{found}"
    );

    // A window's frame is cut off, where it is said to be; another size is, against a picture.
    let mut framed = RgbImage::from_pixel(216, 239, Rgb([90, 90, 90]));
    imageops::replace(&mut framed, &right, 8, 31);
    framed.save(folder.join("framed.png")).unwrap();
    assert_eq!(
        compare(&folder, "framed.png cs541 --crop 8,31,200x200").0,
        0
    );
    assert_eq!(compare(&folder, "framed.png cs541").0, 1);
    draw(&folder, "cs541", "small.png");
    let drawn = shadowlab(&folder, "screenshot cs541 --size 300x300 -o large.png");
    assert!(drawn.status.success());
    let (code, found) = compare(&folder, "large.png cs541 --reference small.png");
    assert!(
        words(&found["forgiven"]).contains("another size, 300×300"),
        "{found}"
    );
    assert!(
        code == 0 || found["difference"]["share"].as_f64().unwrap() < 0.02,
        "{found}"
    );
}

#[test]
fn what_no_mistake_explains_is_called_so() {
    let folder = work_folder("compare_none");
    let right = draw(&folder, "cs541", "right.png");
    let mut inverted = right;
    image::imageops::invert(&mut inverted);
    inverted.save(folder.join("mine.png")).unwrap();
    let (code, found) = compare(&folder, "mine.png cs541");
    assert_eq!(
        (code, found["diagnosis"].as_str()),
        (1, Some("none of these"))
    );
}

/// A student's program has a shading of its own: what is compared of a pair is the shadows alone.
#[test]
fn a_pair_is_judged_by_its_shadows() {
    let folder = work_folder("compare_pair");
    let shaded = |options: &str, file: &str| {
        let mut picture = draw(
            &folder,
            &format!("cs541 --set filter=nearest {options}"),
            file,
        );
        for Rgb([red, green, blue]) in picture.pixels_mut() {
            [*red, *green, *blue] = [*blue / 2 + 30, *red / 2 + *red / 4, *green / 2];
        }
        picture.save(folder.join(file)).unwrap();
    };
    shaded("", "on.png");
    shaded("--set shadows=off", "off.png");
    let (code, found) = compare(&folder, "on.png off.png cs541 --set filter=nearest");
    assert_eq!((code, &found["difference"]), (0, &Value::Null), "{found}");
    shaded("--mistake no_bias", "acne.png");
    let (code, found) = compare(&folder, "acne.png off.png cs541 --set filter=nearest");
    assert_eq!(code, 1);
    assert!(
        found["shadows"]["false_shadow"]["interior"]
            .as_u64()
            .unwrap()
            > 500,
        "{found}"
    );
    assert!(first(&found).contains(&"no_bias"), "{found}");
    // Without shadows there are none to tell a mistake from, but that they are missing.
    let (code, found) = compare(&folder, "off.png off.png cs541 --set filter=nearest");
    assert_eq!(code, 1);
    assert!(!first(&found).contains(&"no_bias"), "{found}");
}

#[test]
fn a_page_needs_no_other_file() {
    let folder = work_folder("compare_page");
    draw(&folder, "cs541 --mistake no_bias", "mine.png");
    let compared = shadowlab(&folder, "compare mine.png cs541 -o page.html");
    assert_eq!(compared.status.code(), Some(1));
    let page = std::fs::read_to_string(folder.join("page.html")).unwrap();
    for word in ["no_bias", "comes from", "mended by", "false shadow", "SSIM"] {
        assert!(page.contains(word), "{word}");
    }
    let sources: Vec<_> = page.match_indices("src=\"").collect();
    // Mine, the reference, the mistake's own, the difference, the shadows.
    assert_eq!(sources.len(), 5);
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 5);
    assert!(!page.contains("href="));
}

/// A PNG that announces more than anybody has, in a few bytes.
fn announced_png(side: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    // A zlib stream that has only begun.
    writer
        .write_chunk(
            png::chunk::IDAT,
            &[0x78, 0x01, 0x00, 0xe8, 0x03, 0x17, 0xfc],
        )
        .unwrap();
    drop(writer);
    bytes
}

#[test]
fn a_folder_is_compared_whatever_is_in_it() {
    let folder = work_folder("compare_batch");
    let class: PathBuf = folder.join("class");
    std::fs::create_dir(&class).unwrap();
    let right = draw(&folder, "cs541", "class/right.png");
    draw(&folder, "cs541 --mistake map_not_cleared", "class/dark.png");
    let mut jpeg = Vec::new();
    right
        .write_with_encoder(JpegEncoder::new_with_quality(&mut jpeg, 85))
        .unwrap();
    std::fs::write(class.join("cut.jpg"), &jpeg[..jpeg.len() / 3]).unwrap();
    std::fs::write(class.join("empty.png"), "").unwrap();
    std::fs::write(class.join("text.png"), "my homework").unwrap();
    std::fs::write(class.join("huge.png"), announced_png(60_000)).unwrap();
    std::os::unix::fs::symlink("itself.png", class.join("itself.png")).unwrap();
    std::fs::create_dir(class.join("folder")).unwrap();

    let compared = shadowlab(&folder, "compare --batch class cs541 -o out");
    assert_eq!(compared.status.code(), Some(1), "{compared:?}");
    let told = String::from_utf8(compared.stdout).unwrap();
    assert!(
        told.contains("7 pictures: 1 the same within the tolerance, 1 not, 5 broken"),
        "{told}"
    );
    let mut csv = csv::Reader::from_path(folder.join("out/compared.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    let row = |file: &str| rows.iter().find(|row| &row[0] == file).unwrap();
    assert_eq!(&row("right.png")[1], "true");
    assert!(row("dark.png")[10].contains("map_not_cleared"));
    for (file, word) in [
        ("cut.jpg", "JPEG"),
        ("empty.png", "expected a PNG or JPEG"),
        ("text.png", "expected a PNG or JPEG"),
        ("huge.png", "60000×60000"),
        ("itself.png", "itself.png"),
    ] {
        let trouble = &row(file)[12];
        assert!(trouble.contains(word), "{file}: {trouble}");
    }
    // The right picture is at the end, and every picture that was compared has its page.
    assert_eq!(&rows.last().unwrap()[0], "right.png");
    let index = std::fs::read_to_string(folder.join("out/index.html")).unwrap();
    for file in ["right.png.html", "dark.png.html"] {
        assert!(folder.join("out").join(file).exists() && index.contains(file));
    }
}

#[test]
fn what_takes_too_long_is_a_row() {
    let folder = work_folder("compare_limit");
    std::fs::create_dir(folder.join("class")).unwrap();
    draw(&folder, "cs541", "class/right.png");
    let compared = shadowlab(&folder, "compare --batch class cs541 -o out --limit 0");
    assert_eq!(compared.status.code(), Some(1));
    let csv = std::fs::read_to_string(folder.join("out/compared.csv")).unwrap();
    assert!(csv.contains("took longer than 0 s"), "{csv}");
}

#[test]
fn wrong_input_is_one_line_and_2() {
    let folder = work_folder("compare_wrong");
    draw(&folder, "cs541", "mine.png");
    std::fs::create_dir(folder.join("none")).unwrap();
    for (arguments, words) in [
        ("compare", vec!["MINE.png"]),
        ("compare cs541", vec!["found no picture"]),
        (
            "compare mine.png cs542",
            vec!["cs542", "did you mean \"cs541\""],
        ),
        ("compare gone.png cs541", vec!["gone.png", "cannot read"]),
        (
            "compare mine.png cs541 --crop 1,2,3",
            vec!["X,Y,WIDTHxHEIGHT"],
        ),
        (
            "compare mine.png cs541 --crop 100,0,200x200",
            vec!["200×200 pixels"],
        ),
        (
            "compare mine.png cs541 -o page.png",
            vec!["page.png", ".html"],
        ),
        (
            "compare mine.png cs541 --mistake no_bias",
            vec!["no_bias", "without mistakes"],
        ),
        (
            "compare mine.png mine.png cs541 --size 300x300",
            vec!["--size", "200×200", "not scaled"],
        ),
        (
            "compare --batch none cs541",
            vec!["none", "expected pictures"],
        ),
        (
            "compare mine.png --batch none cs541",
            vec!["beside the folder"],
        ),
        ("compare mine.png mine.png cmsc23700", vec!["2 lights"]),
    ] {
        let refused = shadowlab(&folder, arguments);
        let told = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(
            (refused.status.code(), told.lines().count()),
            (Some(2), 1),
            "{arguments}: {told}"
        );
        for word in words {
            assert!(told.contains(word), "{arguments}: {told}");
        }
    }
    let refused = shadowlab(&folder, "screenshot aueb7 --mistake no_swizle");
    let told = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(told.contains("aueb7 cannot make it"), "{told}");
    let refused = shadowlab(&folder, "explain cs541 --pixel 1,1 --mistake no_bias");
    assert_eq!(refused.status.code(), Some(2));
    // Their shaders are others, in which nothing would be edited.
    for state in ["--set shadow_test=exact", "--keys <Set:shadow_test=exact>"] {
        let drawn = format!("screenshot cs541 --mistake no_bias {state}");
        let refused = shadowlab(&folder, &drawn);
        let told = String::from_utf8(refused.stderr).unwrap();
        assert_eq!((refused.status.code(), told.lines().count()), (Some(2), 1));
        assert!(told.contains("shadow_test=handout, found exact"), "{told}");
    }
}

/// The reference is then another test's picture, and the shadows are judged as ever.
#[test]
fn a_picture_is_held_against_another_test() {
    let folder = work_folder("compare_exact");
    for (lab, state) in [
        ("csci3260", "--set shadow_test=exact"),
        ("aueb7", "--set shadow_test=offset"),
    ] {
        draw(&folder, &format!("{lab} {state}"), "exact.png");
        let (code, right) = compare(&folder, &format!("exact.png {lab} {state}"));
        assert_eq!(
            (code, &right["notes"]),
            (0, &serde_json::json!([])),
            "{right}"
        );
        draw(&folder, lab, "mine.png");
        let (_, mine) = compare(&folder, &format!("mine.png {lab} {state}"));
        let wrong = |found: &Value| {
            ["false_shadow", "false_light"]
                .map(|kind| found["shadows"][kind]["pixels"].as_u64().unwrap())
        };
        assert!(
            wrong(&mine).iter().sum::<u64>() > 2 * wrong(&right).iter().sum::<u64>(),
            "{mine}"
        );
        draw(&folder, &format!("{lab} --mistake no_bias"), "acne.png");
        let (code, acne) = compare(&folder, &format!("acne.png {lab} {state}"));
        assert_eq!(code, 1);
        assert!(words(&acne["notes"]).contains("handout's test"), "{acne}");
        assert!(acne["diagnosis"].is_null(), "{acne}");
    }
}

/// A picture that was made larger or smaller is one of the course's window; `--size` tells of another.
#[test]
fn a_scaled_picture_is_diagnosed_in_its_window() {
    let folder = work_folder("compare_scaled");
    let drawn = shadowlab(
        &folder,
        "screenshot csci3260 --mistake viewport_not_restored -o whole.png",
    );
    assert!(drawn.status.success());
    let whole = image::open(folder.join("whole.png")).unwrap().into_rgb8();
    let smaller = shadowlab::compare::resized(&whole, [600, 450]);
    smaller.save(folder.join("smaller.png")).unwrap();
    for size in ["", "--size 800x600"] {
        let (_, found) = compare(&folder, &format!("smaller.png csci3260 {size}"));
        assert!(
            first(&found).contains(&"viewport_not_restored"),
            "{size}: {found}"
        );
    }
    // The right one is the same, whatever filter has scaled it.
    let drawn = shadowlab(&folder, "screenshot cs541 -o whole.png");
    assert!(drawn.status.success());
    let whole = image::open(folder.join("whole.png")).unwrap().into_rgb8();
    for filter in [
        FilterType::Triangle,
        FilterType::CatmullRom,
        FilterType::Lanczos3,
    ] {
        let smaller = imageops::resize(&whole, 375, 375, filter);
        smaller.save(folder.join("right.png")).unwrap();
        let (code, found) = compare(&folder, "right.png cs541");
        assert_eq!(code, 0, "{filter:?}: {found}");
    }
    // In a window that had another shape it has another picture.
    let (_, found) = compare(&folder, "smaller.png csci3260 --size 600x600");
    assert!(!first(&found).contains(&"viewport_not_restored"), "{found}");
}

/// Each edit meets what it edits, and changes the picture in some state; in the lab's first one, unless told here.
#[test]
fn every_mistake_can_be_made_and_most_can_be_seen() {
    const UNSEEN_AT_FIRST: &[(&str, &str)] = &[
        ("cs541", "bias_on_xyz"),
        ("cs541", "light_along_up"),
        ("cs541", "no_w_test"),
        ("cs541", "specular_in_shadow"),
        ("cs541", "too_much_bias"),
        ("csci3260", "frustum_too_large"),
        ("csci3260", "no_draw_buffer_none"),
        ("csci3260", "repeat_outside"),
        ("csci3260", "specular_in_shadow"),
        ("csci3260", "too_much_bias"),
        ("cmsc23700", "beyond_far"),
        ("cmsc23700", "bias_on_xyz"),
        ("cmsc23700", "degrees_for_radians"),
        ("cmsc23700", "near_too_small"),
        ("cmsc23700", "repeat_outside"),
        ("aueb7", "beyond_far"),
        ("aueb7", "bias_on_xyz"),
        ("aueb7", "no_draw_buffer_none"),
        ("aueb7", "no_w_test"),
        ("aueb7", "too_much_bias"),
        ("eecs487", "accumulator_not_cleared"),
        ("eecs487", "weights_wrong"),
    ];
    let folder = work_folder("mistakes");
    for lab in LABS {
        let right = draw(&folder, lab.name, "right.png");
        for (mistake, _) in mistakes::of_lab(lab.name) {
            let name = mistake.name;
            let mine = draw(
                &folder,
                &format!("{} --mistake {name}", lab.name),
                "mine.png",
            );
            let differs = shadowlab::compare::Envelope::new(&right)
                .share_outside(&mine, shadowlab::compare::TOLERANCE)
                > shadowlab::compare::SAME;
            let expected = !UNSEEN_AT_FIRST.contains(&(lab.name, name));
            assert_eq!(differs, expected, "{}, {name}", lab.name);
        }
    }
}
