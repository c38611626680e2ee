//! The text files of this repository, for the tests that hold its own source to its rules.

use std::fs;
use std::path::Path;

/// A file's path from the root of the repository, with `/`, and its text.
pub struct Source {
    pub path: String,
    pub text: String,
}

/// Every file under `folder`, in the order of their paths.
pub fn files(folder: &str) -> Vec<Source> {
    let mut found = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    collect(&root.join(folder), folder, &mut found);
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

fn collect(folder: &Path, name: &str, found: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|cause| panic!("{name}: {cause}")) {
        let path = entry.expect("a folder that can be read").path();
        let name = format!("{name}/{}", path.file_name().unwrap().to_string_lossy());
        if path.is_dir() {
            collect(&path, &name, found);
        } else {
            let text = fs::read_to_string(&path).unwrap_or_else(|cause| panic!("{name}: {cause}"));
            found.push(Source { path: name, text });
        }
    }
}
