//! Files of the data folder: what is read of them is what the reference found.

use std::io::Write;
use std::path::PathBuf;

use morse_smooth::io::{FieldReadOptions, MeshData, read_field};

use crate::io_read::read;

/// The area of a mesh that was read.
pub(crate) fn area(data: &MeshData) -> f64 {
    let point = |corner: u32| [0, 1, 2].map(|axis| data.positions[3 * corner as usize + axis]);
    let doubled = data.triangles.chunks_exact(3).map(|corners| {
        let [a, b, c] = [point(corners[0]), point(corners[1]), point(corners[2])];
        let (u, v) = ([0, 1, 2].map(|axis| b[axis] - a[axis]), [0, 1, 2].map(|axis| c[axis] - a[axis]));
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        cross.iter().map(|part| part * part).sum::<f64>().sqrt()
    });
    doubled.sum::<f64>() / 2.0
}

/// The folder with `expected.json`: the variable `MORSE_SMOOTH_DATA`, else next to this project if it is there.
fn data_folder() -> Option<PathBuf> {
    let beside = || Some(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data")).filter(|path| path.is_dir());
    std::env::var_os("MORSE_SMOOTH_DATA").map(PathBuf::from).or_else(beside)
}

#[test]
fn data_sets_hold_what_the_reference_found() {
    let Some(folder) = data_folder() else {
        // Not `eprintln!`, which the test harness hides when a test passes.
        let _ =
            writeln!(std::io::stderr(), "NOT RUN: the data sets are not there; MORSE_SMOOTH_DATA names their folder");
        return;
    };
    let load = |name: &str| std::fs::read(folder.join(name)).expect("a readable file");
    let expected: serde_json::Value = serde_json::from_slice(&load("expected.json")).expect("valid JSON");
    let mut fields_checked = 0;
    for (file, facts) in expected.as_object().expect("files by name") {
        let data = read(load(file));
        assert!(data.warnings.is_empty(), "{file}: {:?}", data.warnings);
        assert_eq!(Some(data.positions.len() as u64 / 3), facts["mesh"]["vertices"].as_u64(), "{file}");
        assert_eq!(Some(data.triangles.len() as u64 / 3), facts["mesh"]["triangles"].as_u64(), "{file}");
        let expected_area = facts["mesh"]["area"].as_f64().expect("an area");
        assert!((area(&data) / expected_area - 1.0).abs() < 1e-12, "{file}: {} {expected_area}", area(&data));
        for (name, facts) in facts["fields"].as_object().expect("fields by name") {
            let beside = || read_field(&load(&format!("spot_{name}.txt")), &FieldReadOptions::default());
            let values = match data.fields.iter().find(|field| field.0 == *name) {
                Some((_, values)) => values.clone(),
                None => beside().expect("a field"),
            };
            assert_eq!(values.len(), data.positions.len() / 3, "{file} {name}");
            let range =
                [values.iter().copied().fold(f64::MAX, f64::min), values.iter().copied().fold(f64::MIN, f64::max)];
            assert_eq!(range.map(Some), [facts["range"][0].as_f64(), facts["range"][1].as_f64()], "{file} {name}");
            fields_checked += 1;
        }
    }
    assert!(fields_checked >= 15, "only {fields_checked} fields were checked");
}
