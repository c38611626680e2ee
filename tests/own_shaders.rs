//! What is drawn with a student's own shaders: the picture held against the lab's, the shadows that are read from it, and a
//! limit for what never ends.

mod common;

use std::path::Path;
use std::process::{Command, Output};

use common::{Bench, work_folder};
use shadowlab::labs::Show;
use shadowlab::{gl, own_shaders};

fn line_of(text: &str, passage: &str) -> usize {
    1 + text
        .lines()
        .position(|line| line.contains(passage))
        .unwrap()
}

/// The file of each lab that has its shadow test and its lighting in one.
const TESTS: [(&str, &str, &str, &str); 4] = [
    (
        "cs541",
        "lighting.frag",
        "shadow_depth < point_depth",
        "shadow_depth > point_depth",
    ),
    (
        "csci3260",
        "FragmentShaderCode.glsl",
        ".z < ShadowCoord.z - bias",
        ".z > ShadowCoord.z - bias",
    ),
    (
        "cmsc23700",
        "lighting.frag",
        ".r < depth - bias",
        ".r > depth - bias",
    ),
    (
        "aueb7",
        "SpotLight.frag",
        "shadow_factor * diffuse",
        "(1.0 - shadow_factor) * diffuse",
    ),
];

/// The shadows are read from pictures, and are those that the lab's own visibility program shows; a student's test that
/// answers the other way round is seen to, although the lab's program knows nothing of it.
#[test]
fn the_shadows_are_those_of_the_students_own_test() {
    let size = [200, 160];
    for (lab, file, right, wrong) in TESTS {
        let expected = Bench::new(lab, size, &[]).visibility();
        for (from, to, is_right) in [(right, right, true), (right, wrong, false)] {
            let folder = work_folder("own_shaders_visibility");
            let text = std::fs::read_to_string(format!("glsl/{lab}/{file}")).unwrap();
            assert!(text.contains(from), "{lab}");
            std::fs::write(folder.join(file), text.replace(from, to)).unwrap();
            let mut bench = Bench::with_glsl(lab, &folder, size);
            assert!(bench.lab.has_students_test(), "{lab}");
            let found =
                own_shaders::visibility(bench.lab.as_mut(), &bench.context, size, 1).unwrap();
            gl::check_errors(&bench.context.gl, "drawing").unwrap();
            let pairs = found
                .visibility
                .pixels()
                .zip(expected.pixels())
                .zip(&found.known);
            let known: Vec<_> = pairs
                .filter(|(_, known)| **known)
                .map(|(pair, _)| pair)
                .collect();
            // The light reaches a good part of every lab's picture.
            assert!(known.len() > 8_000, "{lab}: {} known", known.len());
            let alike = known
                .iter()
                .filter(|(a, b)| a.0[0].abs_diff(b.0[0]) < 64)
                .count();
            let share = alike as f64 / known.len() as f64;
            assert_eq!(share > 0.999, is_right, "{lab}: {share}");

            // What the lab's own program shows is not the student's test.
            bench
                .lab
                .render(&bench.context.gl, Show::Visibility { light: 1 })
                .unwrap();
            let labs = gl::read_grey(&bench.context.gl, size);
            assert_eq!(common::differing(&labs, &expected), 0, "{lab}");
        }
    }
}

fn shadowlab(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// More than any machine takes for it; the limit's own test has a small one.
const PATIENT: [&str; 2] = ["--limit", "600"];

#[test]
fn the_command_tells_findings_then_the_picture_and_its_exit_code_is_diffs() {
    let folder = work_folder("own_shaders_command");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let write = |name: &str, text: &str| {
        std::fs::create_dir(folder.join(name)).unwrap();
        std::fs::write(folder.join(name).join("lighting.frag"), text).unwrap();
    };
    write("right", &own);
    write(
        "reversed",
        &own.replace("shadow_depth < point_depth", "shadow_depth > point_depth"),
    );
    write(
        "misspelt",
        &own.replace("shadow_sampler", "shadow_sampeler"),
    );
    write(
        "broken",
        &own.replace("float shadow_depth", "float shadow_depht"),
    );
    let run = |name: &str, more: &[&str]| {
        let arguments = [
            &["check-shaders", name, "cs541", "--size", "160x160"][..],
            &PATIENT,
            more,
        ]
        .concat();
        shadowlab(&folder, &arguments)
    };

    let right = run("right", &[]);
    let text = out(&right);
    assert_eq!(right.status.code(), Some(0), "{text}{}", err(&right));
    assert!(
        text.starts_with("right in cs541: 0 wrong, 0 to note\nright against cs541: the same"),
        "{text}"
    );
    assert!(
        text.contains("shadows, as far as they can be read") && text.contains("false shadow"),
        "{text}"
    );

    // Nothing is wrong with it but what it draws.
    let reversed = run("reversed", &["-o", "reversed.html"]);
    let text = out(&reversed);
    assert_eq!(reversed.status.code(), Some(1), "{text}");
    assert!(
        text.starts_with("reversed in cs541: 0 wrong") && text.contains("not the same"),
        "{text}"
    );
    assert!(
        text.contains("diagnosis: comparison_reversed") || text.contains("diagnosis: "),
        "{text}"
    );
    let page = std::fs::read_to_string(folder.join("reversed.html")).unwrap();
    assert!(page.contains("data:image/png") && page.contains("not the same"));

    let misspelt = run("misspelt", &["--json", "-o", "misspelt.html"]);
    let page = std::fs::read_to_string(folder.join("misspelt.html")).unwrap();
    assert!(page.contains("<li><code>misspelt/lighting.frag:17: sampler2D shadow_sampeler"));
    assert_eq!(misspelt.status.code(), Some(1));
    let found: serde_json::Value = serde_json::from_slice(&misspelt.stdout).unwrap();
    let finding = &found["findings"][0];
    assert_eq!(finding["wrong"], true);
    assert_eq!(finding["file"], "misspelt/lighting.frag");
    assert_eq!(
        finding["line"],
        line_of(&own, "uniform sampler2D shadow_sampler")
    );
    assert_eq!(found["compared"]["same"], false);

    // What does not compile has no picture.
    let broken = run("broken", &["-o", "broken.html"]);
    let text = out(&broken);
    assert_eq!(broken.status.code(), Some(1), "{text}");
    assert!(
        text.contains("broken/lighting.frag:") && text.contains("no picture: "),
        "{text}"
    );
    assert!(!folder.join("broken.html").exists());
}

/// The figures of `measure` are the student's own: the lab's are those of the control.
#[test]
fn measure_is_of_the_students_test() {
    let folder = work_folder("own_shaders_measure");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    std::fs::create_dir(folder.join("mine")).unwrap();
    let measure = |text: &str| {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let arguments = [
            "measure", "cs541", "--size", "160x160", "--json", "--glsl", "mine",
        ];
        shadowlab(&folder, &[&arguments[..], &PATIENT].concat())
    };
    let figures = |text: &str| -> serde_json::Value {
        let ran = measure(text);
        assert!(ran.status.success(), "{}", err(&ran));
        serde_json::from_slice(&ran.stdout).unwrap()
    };
    let bias = "point_depth = point_depth - epsilon";
    let too_much = own.replace(bias, "point_depth = point_depth - 0.02");
    assert_ne!(own, too_much);
    let reported = |text: &str| -> u64 {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let arguments =
            "report cs541 --size 160x160 --rounds 1 --sweep map_size=1024 --glsl mine -o out";
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let ran = shadowlab(&folder, &[&arguments[..], &PATIENT].concat());
        assert!(ran.status.success(), "{}", err(&ran));
        let mut csv = csv::Reader::from_path(folder.join("out/report.csv")).unwrap();
        let columns = csv.headers().unwrap().clone();
        let row = csv.records().next().unwrap().unwrap();
        let place = columns.iter().position(|name| name == "false_light");
        row[place.unwrap()].parse().unwrap()
    };
    let reports = (reported(&own), reported(&too_much));
    let (right, too_much) = (figures(&own), figures(&too_much));
    let false_light =
        |figures: &serde_json::Value| figures["false_light"]["pixels"].as_u64().unwrap();
    assert!(false_light(&right) < 100, "{right:#}");
    assert!(
        false_light(&too_much) > 3 * false_light(&right),
        "{too_much:#}"
    );
    assert_eq!(reports, (false_light(&right), false_light(&too_much)));
    assert!(right["judged"].as_u64().unwrap() > 10_000, "{right:#}");

    // Without a shadow test there is nothing to read, and that is no good figure.
    let none = measure(&own.replace("shadows && inside_beam", "false && inside_beam"));
    assert_eq!(none.status.code(), Some(1), "{}", out(&none));
    assert!(
        err(&none).contains("the same whatever the shadow map holds"),
        "{}",
        err(&none)
    );
}

/// Files that nobody checked: there are findings, or one line says why there are none; nothing hangs, and nothing is left
/// behind.
#[test]
fn a_broken_or_hostile_file_is_told() {
    let folder = work_folder("own_shaders_hostile");
    let own = std::fs::read_to_string("glsl/cs541/lighting.frag").unwrap();
    let half = &own[..own.len() / 2];
    let head = "#version 330 core\n";
    let texts = [
        ("empty", String::new()),
        ("cut off", half.to_owned()),
        ("zeros", "\0".repeat(1000)),
        ("a byte order mark", format!("\u{feff}{own}")),
        ("an open comment", format!("{head}/* {own}")),
        ("open braces", format!("{head}{}", "{".repeat(100_000))),
        (
            "open brackets",
            format!("{head}void main() {{ int i = {}", "(".repeat(100_000)),
        ),
        (
            "many inputs",
            format!("{head}{}", "in vec3 a;".repeat(2_000)),
        ),
        (
            "an endless line",
            format!("{head}// {}", "\\\n".repeat(500_000)),
        ),
        (
            "no end of #if",
            format!("{head}{}", "#if 0\n".repeat(100_000)),
        ),
        (
            "a memory full",
            format!(
                "{head}out vec4 c; void main() {{ float a[2000000000]; a[int(gl_FragCoord.x)] = 1.0; c = vec4(a[7]); }}"
            ),
        ),
        ("steering", format!("{head}in vec3 \u{1b}[2J;")),
    ];
    std::fs::create_dir(folder.join("mine")).unwrap();
    for (name, text) in texts {
        std::fs::write(folder.join("mine/lighting.frag"), text).unwrap();
        let ran = shadowlab(
            &folder,
            &[
                &["check-shaders", "mine", "cs541", "--size", "32x32"][..],
                &PATIENT,
            ]
            .concat(),
        );
        let (said, error) = (out(&ran), err(&ran));
        match ran.status.code() {
            Some(1) => {
                assert!(said.starts_with("mine/lighting.frag"), "{name}: {said}");
                assert!(!said.contains('\u{1b}'), "{name}: {said}");
                let has_mark = name == "a byte order mark";
                let is_told = said.contains("byte order mark, expected none");
                assert_eq!(is_told, has_mark, "{name}: {said}");
                assert!(said.lines().all(|line| line.len() < 3000), "{name}: {said}");
            }
            Some(2) => {
                assert!(
                    error.lines().last().unwrap().starts_with("shadowlab: mine"),
                    "{name}: {error}"
                );
                assert!(said.is_empty(), "{name}: {said}");
            }
            code => panic!("{name}: {code:?}: {said}{error}"),
        }
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "{name}");
        println!(
            "| {name} | {:?} | {} |",
            ran.status.code(),
            said.lines().next().unwrap_or(error.trim())
        );
    }
}

/// A loop that no compiler can take out, since what ends it is read from a texture. llvmpipe gives every loop up after 65,536 rounds
/// (other drivers do not), so a round takes long enough for hours of them.
const ENDLESS: &str = "#version 330 core
uniform sampler2D usampler;
out vec4 frag_color;
#define READ sum += texture(usampler, vec2(sum, 0.5 * sum)).r;
#define READS READ READ READ READ READ READ READ READ READ READ
#define ROUND READS READS READS READS READS READS READS READS READS READS
void main(void)
{
    float sum = 0.0;
    for (int i = 0; sum >= 0.0; i = 1 - i) {
        ROUND ROUND
        if (sum > 100.0)
            sum = float(i);
    }
    frag_color = vec4(sum);
}
";

#[test]
fn a_shader_that_never_ends_is_ended() {
    let folder = work_folder("own_shaders_endless");
    let mine = folder.join("mine");
    std::fs::create_dir(&mine).unwrap();
    let draw = |text: &str, command: &[&str], limit: &str| {
        std::fs::write(mine.join("lighting.frag"), text).unwrap();
        shadowlab(&folder, &[command, &["--limit", limit]].concat())
    };
    let commands: [(&[&str], i32); 5] = [
        (&["screenshot", "cs541", "--glsl", "mine"], 1),
        (&["trace", "cs541", "--glsl", "mine"], 1),
        (&["measure", "cs541", "--glsl", "mine"], 1),
        (&["view", "cs541", "--glsl", "mine"], 1),
        (&["check-shaders", "mine", "cs541"], 2),
    ];
    for (command, code) in commands {
        let ended = draw(ENDLESS, command, "2");
        assert_eq!(
            ended.status.code(),
            Some(code),
            "{command:?}: {}",
            err(&ended)
        );
        let told = err(&ended);
        let last = told.lines().last().unwrap();
        assert_eq!(
            last,
            "shadowlab: mine: drawing with its shaders took longer than 2 s, expected a picture by then: a loop there may \
             never end (--limit SECONDS allows more)",
            "{command:?}"
        );
        assert!(out(&ended).is_empty(), "{command:?}");
    }
    assert!(!folder.join("cs541.png").exists());
    // The control: with loops that end it is drawn.
    let ends = ENDLESS
        .replace("sum >= 0.0;", "i < 1;")
        .replace("i = 1 - i", "i++");
    let drawn = draw(&ends, commands[0].0, "600");
    assert!(drawn.status.success(), "{}", err(&drawn));
    assert!(folder.join("cs541.png").exists());
}
