//! `explain` says what the shader computed: it agrees with the lab's own picture, and with f64 within its bounds.

mod common;
mod explaining;

use explaining::explained;

#[test]
fn a_thousand_pixels_agree_with_the_picture_and_with_f64() {
    let states: [&[&str]; 8] = [
        &[],
        &["remedy=none"],
        &["filter=nearest"],
        &["light=point"],
        &["beam=circular", "depth_format=16", "remedy=culling"],
        &[
            "depth_format=32F",
            "map_size=256",
            "remedy=both",
            "second_plane=on",
        ],
        &["depth_format=24", "map_size=300", "spot_angle=110"],
        &["filter=nearest", "map_size=4096", "epsilon=0.01"],
    ];
    let surfaces: u32 = states
        .iter()
        .zip(1..)
        .map(|(settings, seed)| explained("cs541", settings, 125, seed))
        .sum();
    // The sky takes about a third of the picture.
    assert!(surfaces > 600, "only {surfaces} pixels showed a surface");
}
