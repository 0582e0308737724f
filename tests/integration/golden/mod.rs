//! Pictures compared with those that were looked at, to the last byte. `tests/js/golden.test.js` compares the same cases drawn in
//! WebAssembly with the same files.
//!
//! `UPDATE_GOLDEN=1 cargo test --features render golden` makes the files anew; look at them before they are committed.

mod cases;
pub(crate) mod compare;
mod rules;

use std::path::Path;

use compare::Folders;

fn folders() -> Folders {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    Folders { golden: root.join("tests/golden"), artifacts: root.join("artifacts/golden") }
}

#[test]
fn golden_pictures_are_as_they_were() {
    let folders = folders();
    let update = std::env::var_os("UPDATE_GOLDEN").is_some_and(|value| value != "0" && value != "");
    let cases = cases::read(&folders.golden);
    let failures: Vec<String> = cases
        .iter()
        .filter_map(|case| compare::check(&case.name, &case.draw(&folders.golden), &folders, update).err())
        .collect();
    assert!(failures.is_empty(), "\n{}\n", failures.join("\n"));
}

#[test]
fn every_golden_picture_has_a_case() {
    let folders = folders();
    let names: Vec<String> = cases::read(&folders.golden).into_iter().map(|case| case.name).collect();
    for entry in std::fs::read_dir(&folders.golden).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "png") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            assert!(names.contains(&name), "{} is the picture of no case", path.display());
        }
    }
    for (k, name) in names.iter().enumerate() {
        assert!(!names[..k].contains(name), "two cases are called {name}");
    }
}
