//! F12: a file with the picture, and the command line that draws it again without a display.

use std::path::PathBuf;

use crate::labs::Input;

/// The first of `LAB-0001.png`, `LAB-0002.png`, … that is not there.
pub fn free_name(lab: &str) -> PathBuf {
    (1..)
        .map(|number| PathBuf::from(format!("{lab}-{number:04}.png")))
        .find(|name| !name.exists())
        .expect("a folder ends before the numbers do")
}

/// What a person did to the lab, and when.
pub struct State<'a> {
    pub lab: &'a str,
    pub size: [u32; 2],
    /// The other options, as they were given to the viewer.
    pub options: &'a [String],
    pub inputs: &'a [Input],
    /// After the inputs, in seconds.
    pub time: f64,
}

/// What a shell is told to draw the state again.
pub fn command_line(state: &State) -> String {
    let words = words(state);
    let words = ["shadowlab".to_owned()].into_iter().chain(words);
    words
        .map(|word| quoted(&word))
        .collect::<Vec<_>>()
        .join(" ")
}

/// The words behind the program's name.
///
/// All keys come before all of the time, however they fell, unless the lab's keys ask what time it is: then there are
/// waits among them.
pub fn words(state: &State) -> Vec<String> {
    let [width, height] = state.size;
    let mut words: Vec<String> = ["screenshot", state.lab, "--size"]
        .map(str::to_owned)
        .to_vec();
    words.push(format!("{width}x{height}"));
    words.extend_from_slice(state.options);
    if !state.inputs.is_empty() {
        let keys = state.inputs.iter().map(Input::to_string).collect();
        words.extend(["--keys".to_owned(), keys]);
    }
    if state.time > 0.0 {
        words.extend(["--time".to_owned(), state.time.to_string()]);
    }
    words
}

/// As a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./,:".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labs::parse_keys;

    #[test]
    fn a_shell_reads_the_line_as_it_was_meant() {
        let state = State {
            lab: "cs541",
            size: [320, 200],
            options: &["--set".to_owned(), "beam=circular".to_owned()],
            inputs: &parse_keys("w<Left><Drag:3,-4>'").unwrap(),
            time: 0.25,
        };
        assert_eq!(
            command_line(&state),
            r"shadowlab screenshot cs541 --size 320x200 --set beam=circular --keys 'w<Left><Drag:3,-4>'\''' --time 0.25"
        );
    }
}
