//! Every key and every movement of the mouse that a lab lists, once each in a real window.

mod common;
mod desktop;

use common::{differing, work_folder};
use desktop::{Desktop, Viewer, assert_shot_is_headless};
use shadowlab::labs::{Button, Input, Key, LABS, Pointer, parse_keys};

/// Where the mouse is before it moves.
const PLACE: [i32; 2] = [100, 80];

/// Does in the window what `--keys` does without one.
fn act(desktop: &Desktop, viewer: &Viewer, input: Input) {
    let mouse = |words: &[&str]| desktop.xdotool(words);
    match input {
        Input::Key(key) => viewer.press(&match key {
            Key::Char('+') => "plus".to_owned(),
            Key::Char('-') => "minus".to_owned(),
            Key::Char(character) => character.to_string(),
            Key::PageUp => "Page_Up".to_owned(),
            Key::PageDown => "Page_Down".to_owned(),
            named => format!("{named:?}"),
        }),
        Input::Pointer(Pointer::Drag { button, dx, dy }) => {
            let [x, y] = PLACE.map(|n| n.to_string());
            let [to_x, to_y] = [PLACE[0] + dx, PLACE[1] + dy].map(|n| n.to_string());
            let button = match button {
                Button::Left => "1",
                Button::Right => "3",
            };
            mouse(&["mousemove", &x, &y, "mousedown", button]);
            mouse(&["mousemove", &to_x, &to_y, "mouseup", button]);
        }
        Input::Pointer(Pointer::Wheel(steps)) => {
            // X has a button for each way that the wheel turns.
            let button = if steps > 0 { "4" } else { "5" };
            mouse(&["click", "--repeat", &steps.abs().to_string(), button]);
        }
        Input::Set(_) | Input::Wait(_) => unreachable!("no lab lists it"),
    }
}

#[test]
fn every_key_works_in_the_window() {
    let folder = work_folder("window-keys");
    let desktop = Desktop::new(&folder);
    for lab in LABS {
        let mut viewer = Viewer::open_lab(&desktop, lab.name, "--size 200x160");
        viewer.press("space");
        let (mut before, _) = assert_shot_is_headless(&folder, &viewer);
        let mut pressed = String::new();
        let mut changes = 0;
        let listed = lab.keys.iter().flat_map(|(keys, _)| keys.split(' '));
        for key in listed.clone() {
            let inputs = parse_keys(key).unwrap();
            if lab.quit.is_some_and(|quit| inputs == [Input::Key(quit)]) {
                continue;
            }
            inputs
                .into_iter()
                .for_each(|input| act(&desktop, &viewer, input));
            pressed += key;
            // winit 0.30 counts press and release where a wheel is a click as xdotool's (rust-windowing/winit#4386); a
            // real wheel is a movement to it.
            if key.starts_with("<Wheel") {
                pressed += key;
            }
            let (after, line) = assert_shot_is_headless(&folder, &viewer);
            assert!(line.contains(&pressed), "{key}: {line}");
            changes += usize::from(differing(&before, &after) > 0);
            before = after;
        }
        // Some keys ask for what is there already.
        let keys = listed.count();
        assert!(changes > keys / 2, "{}: {changes} of {keys}", lab.name);
        println!(
            "{}: {keys} keys, {changes} of them change the picture",
            lab.name
        );
        viewer.press(if lab.quit.is_some() { "q" } else { "Escape" });
        assert_eq!(viewer.end().code(), Some(0), "{}", lab.name);
    }
}
