//! `shadowlab screenshot --all`: a picture for every stage of every lab, and a page that shows them all.

mod common;

use std::collections::HashMap;
use std::process::Command;

use common::work_folder;
use shadowlab::labs::LABS;

#[test]
fn every_stage_has_a_picture_of_its_own_on_the_page() {
    let folder = work_folder("gallery");
    let ran = Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .current_dir(&folder)
        .args(["screenshot", "--all", "new/all"])
        .args(["--size", "160x120", "--device", "software"])
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{told}");
    assert_eq!(String::from_utf8_lossy(&ran.stdout), "new/all/index.html\n");

    let folder = folder.join("new/all");
    let page = std::fs::read_to_string(folder.join("index.html")).unwrap();
    let mut shown = page.matches("<img ").count();
    for lab in LABS {
        assert!(lab.stages.len() >= 6, "{}", lab.name);
        let mut pictures: HashMap<Vec<u8>, &str> = HashMap::new();
        for stage in lab.stages {
            let file = format!("{}/{}.png", lab.name, stage.name);
            let picture = image::open(folder.join(&file)).unwrap();
            if !stage.options.contains("shadow-map") {
                assert_eq!((picture.width(), picture.height()), (160, 120), "{file}");
            }
            // A stage that looks like another one shows no point of its own.
            let same = pictures.insert(picture.to_rgb8().into_raw(), stage.name);
            assert_eq!(same, None, "{file}");
            assert!(page.contains(&format!("src=\"{file}\"")), "{file}");
            shown -= 1;
        }
        assert!(page.contains(lab.title));
    }
    assert_eq!(shown, 0, "pictures of no stage");
    // Keys are written with angle brackets, which a page must not take for its own.
    assert!(!page.contains("--keys <"));
}

#[test]
fn a_file_in_the_folders_place_is_told() {
    let folder = work_folder("gallery-file");
    std::fs::write(folder.join("taken"), "").unwrap();
    let ran = Command::new(env!("CARGO_BIN_EXE_shadowlab"))
        .current_dir(&folder)
        .args(["screenshot", "--all", "taken"])
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(1), "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert!(told.contains("taken"), "{told}");
}
