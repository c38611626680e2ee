//! The handout's user interface, the settings, and time, held against the lab's pictures.

mod common;

use common::{Bench, differing};
use shadowlab::labs::{self, Key, Show};

const SIZE: [u32; 2] = [320, 320];
const DIRECTIONAL: usize = 1;
const SPOT: usize = 2;

fn bench(settings: &[&str]) -> Bench {
    Bench::new("cmsc23700", SIZE, settings)
}

#[test]
fn every_key_of_the_list_changes_the_picture_but_the_one_that_quits() {
    let handout = labs::find("cmsc23700").unwrap();
    let listed = handout.keys.iter().flat_map(|(keys, _)| keys.split(' '));
    let mut changed = 0;
    for key in listed {
        let mut bench = bench(&[]);
        let before = bench.picture();
        bench.press(key);
        let changes = differing(&before, &bench.picture()) > 20;
        let quits = handout.quit == Some(Key::Char(key.chars().next().unwrap()));
        assert_eq!(changes, !quits, "{key}");
        changed += u32::from(changes);
    }
    assert_eq!(changed, 4);
    assert!(
        !bench(&[]).lab.key(Key::Char('z')),
        "the control: a key of no meaning"
    );
}

#[test]
fn l_toggles_between_directional_spotlight_and_both() {
    let mut bench = bench(&["lights=directional"]);
    let mut seen = Vec::new();
    for _ in 0..4 {
        seen.push(bench.lab.settings().choice("lights"));
        bench.press("l");
    }
    assert_eq!(seen, ["directional", "spotlight", "both", "directional"]);
}

fn balls(bench: &Bench) -> usize {
    let objects = bench.lab.now().objects;
    objects.iter().filter(|o| o.name == "ball").count()
}

#[test]
fn balls_are_from_0_to_100() {
    let mut bench = bench(&[]);
    assert_eq!(balls(&bench), 20);
    bench.press(&"+".repeat(300));
    assert_eq!(balls(&bench), 100);
    let full = bench.picture();
    bench.press("+");
    assert_eq!(differing(&full, &bench.picture()), 0);
    bench.press(&"-".repeat(300));
    assert_eq!(balls(&bench), 0);
    assert!(!bench.lab.moves());
    bench.press("-");
    assert_eq!(bench.lab.settings().number("balls"), 0.0);
    bench.press("+");
    assert_eq!(balls(&bench), 1);
    assert!(bench.lab.moves());
}

/// The setting and the keys are two ways to the same balls; the setting counts as soon as it is made.
#[test]
fn the_setting_adds_and_removes_as_the_keys_do() {
    let by_keys = |keys: &str| {
        let mut bench = bench(&[]);
        bench.press(keys);
        bench.picture()
    };
    let by_setting = |setting: &str| bench(&[setting]).picture();
    assert_eq!(differing(&by_keys("+++"), &by_setting("balls=23")), 0);
    assert_eq!(differing(&by_keys("---"), &by_setting("balls=17")), 0);
    assert_eq!(balls(&bench(&["balls=57"])), 57);
}

#[test]
fn the_picture_is_the_same_however_time_was_cut() {
    let after = |steps: &[f64]| {
        let mut bench = bench(&["balls=100"]);
        for dt in steps {
            bench.lab.advance(*dt);
            bench.picture();
        }
        bench.picture()
    };
    let whole = after(&[2.0]);
    assert_eq!(differing(&whole, &after(&[1.0 / 60.0; 120])), 0);
    assert_eq!(differing(&whole, &after(&[0.5, 1.25, 0.25])), 0);
    // The control: another time is another picture.
    assert!(differing(&whole, &after(&[1.99])) > 1000);
}

#[test]
fn the_same_state_is_the_same_picture_whatever_came_before() {
    let straight = bench(&["map_size=512", "lights=spotlight"]).picture();
    let mut bench = bench(&["balls=100"]);
    bench.picture();
    bench.visibility_of(SPOT);
    bench.set(&["shadows=off", "balls=20"]);
    bench.picture();
    bench.set(&["shadows=on", "map_size=512"]);
    bench.press("ll");
    assert_eq!(differing(&straight, &bench.picture()), 0);
}

#[test]
fn every_setting_is_read() {
    let changes = |base: &[&str], setting: &str| {
        let before = bench(base).picture();
        differing(&before, &bench(&[base, &[setting]].concat()).picture()) > 0
    };
    for setting in [
        "lights=directional",
        "lights=spotlight",
        "shadows=off",
        "balls=21",
        "map_size=256",
        "directional_bias=0",
        "spot_bias=0",
        "shadow_test=exact",
    ] {
        assert!(changes(&[], setting), "{setting}");
    }
    // The controls: what has no say where its light is off.
    assert!(!changes(&["lights=spotlight"], "directional_bias=0"));
    assert!(!changes(&["lights=directional"], "spot_bias=0"));
    // And what has none where there is no map.
    assert!(!changes(&["shadow_test=exact"], "directional_bias=0"));
}

#[test]
fn a_light_that_is_off_has_no_shadow_to_ask_for() {
    for (setting, light, expected) in [
        ("lights=spotlight", DIRECTIONAL, "lights=directional"),
        ("lights=directional", SPOT, "lights=spotlight"),
    ] {
        let mut bench = bench(&[setting]);
        let show = Show::Visibility { light };
        let errors = [
            bench.lab.render(&bench.context.gl, show).unwrap_err(),
            bench.lab.shadow_texture(light).unwrap_err(),
            bench.lab.check_light(light).unwrap_err(),
        ];
        for error in errors {
            assert_eq!(error.exit_code(), 2);
            let told = error.to_string();
            assert!(told.contains(setting) && told.contains(expected), "{told}");
        }
    }
}
