//! Files that other programs have written, against what these programs say of them (`scripts/make-file-fixtures.py` made both).

use std::path::PathBuf;

use morse_smooth::io::{MeshData, ReadOptions, WriteOptions, read_mesh, read_table, write_mesh};
use serde_json::Value;

use crate::io_data::area;

pub(crate) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden/files")
}

fn load(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).expect("a file of tests/golden/files")
}

fn expected() -> serde_json::Map<String, Value> {
    let text = load("expected.json");
    match serde_json::from_slice(&text).expect("valid JSON") {
        Value::Object(map) => map,
        other => panic!("{other}"),
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Text has the digits that its writer gave it.
fn tolerance(name: &str) -> f64 {
    if name.contains("ascii") { 2e-5 } else { 1e-9 }
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * (1.0 + expected.abs()), "{what}: {found} instead of {expected}");
}

/// Twice the signed volume under a closed surface, which is negative where its triangles look inwards.
fn volume(data: &MeshData) -> f64 {
    let point = |corner: u32| [0, 1, 2].map(|axis| data.positions[3 * corner as usize + axis]);
    let parts = data.triangles.chunks_exact(3).map(|corners| {
        let [a, b, c] = [point(corners[0]), point(corners[1]), point(corners[2])];
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    });
    parts.sum::<f64>() / 6.0
}

fn check_mesh(name: &str, facts: &Value) {
    let data = read_mesh(&load(name), &ReadOptions::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
    let near = tolerance(name);
    assert_eq!(Some(data.positions.len() as u64 / 3), facts["vertices"].as_u64(), "{name}: vertices");
    assert_eq!(Some(data.triangles.len() as u64 / 3), facts["triangles"].as_u64(), "{name}: triangles");
    for axis in 0..3 {
        let values = || data.positions.iter().skip(axis).step_by(3).copied();
        assert_near(values().fold(f64::MAX, f64::min), number(&facts["bounds"][0][axis]), near, name);
        assert_near(values().fold(f64::MIN, f64::max), number(&facts["bounds"][1][axis]), near, name);
    }
    if let Some(expected) = facts["area"].as_f64() {
        assert_near(area(&data), expected, near, &format!("{name}: area"));
    }
    for (kind, found) in [("fields", &data.fields), ("triangleFields", &data.triangle_fields)] {
        for (field, sum) in facts[kind].as_object().expect("sums by name") {
            let values = found.iter().find(|(name, _)| name == field);
            let (_, values) = values.unwrap_or_else(|| panic!("{name} has no {field} in {found:?}"));
            // Quadrilaterals may be cut along either diagonal, but the values of their triangles are the same.
            assert_near(values.iter().sum(), number(sum), near * 100.0, &format!("{name}: {field}"));
        }
    }
    if let Some(facts) = facts["someFields"].as_object() {
        for (field, sum) in facts {
            let (_, values) = data.fields.iter().find(|(name, _)| name == field).expect("the field");
            assert_near(values.iter().filter(|value| !value.is_nan()).sum(), number(sum), near, name);
        }
    }
    if name.starts_with("block") || name.starts_with("gmsh") || name.starts_with("rectilinear") {
        assert!(volume(&data) > 0.5, "{name}: the surface looks inwards");
    }
}

fn check_table(name: &str, facts: &serde_json::Map<String, Value>) {
    let table = read_table(&load(name), None).unwrap_or_else(|error| panic!("{name}: {error}"));
    let names: Vec<&str> = table.columns.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names.len(), facts.len(), "{name}: {names:?}");
    for (column, facts) in facts {
        let (_, values) = table.columns.iter().find(|(name, _)| name == column).expect(column);
        assert_eq!(Some(values.len() as u64), facts[0].as_u64(), "{name}: {column}");
        assert_near(values.iter().filter(|value| !value.is_nan()).sum(), number(&facts[1]), tolerance(name), name);
        let missing = values.iter().filter(|value| value.is_nan()).count();
        assert_eq!(Some(missing as u64), facts[2].as_u64(), "{name}: {column}");
    }
}

#[test]
fn files_of_other_programs_hold_what_these_say() {
    let expected = expected();
    let mut count = 0;
    for (name, facts) in &expected {
        match facts["columns"].as_object() {
            Some(columns) => check_table(name, columns),
            None => check_mesh(name, facts),
        }
        count += 1;
    }
    assert!(count >= 60, "only {count} files");
}

/// Formats that hold a whole mesh in double precision: what is read from any file comes back.
#[test]
fn what_other_programs_wrote_goes_through_every_writer() {
    for name in ["torus-raw.vtp", "block-ascii.vtu", "meshio.ply", "grid.asc"] {
        let data = read_mesh(&load(name), &ReadOptions::default()).expect("a mesh");
        for listed in morse_smooth::io::formats().iter().filter(|listed| listed.writes) {
            let Ok(format) = listed.name.parse() else { continue };
            for binary in [false, true] {
                let options = WriteOptions { format, binary, ..WriteOptions::default() };
                let fields: Vec<(&str, &[f64])> =
                    data.fields.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
                let mut has_fields = true;
                let bytes = match write_mesh(&data.positions, &data.triangles, &fields, &options) {
                    Err(error) if error.code() == "FieldsNotSupported" => {
                        has_fields = false;
                        write_mesh(&data.positions, &data.triangles, &[], &options).expect("a file")
                    }
                    Err(error) if error.code() == "BinaryNotSupported" => continue,
                    other => other.expect("a file"),
                };
                let back = read_mesh(&bytes, &ReadOptions::default()).expect("what was written");
                assert_eq!(back.triangles.len(), data.triangles.len(), "{name} {}", listed.name);
                assert_near(area(&back), area(&data), 1e-6, listed.name);
                if has_fields {
                    assert_eq!(back.fields.len(), data.fields.len(), "{name} {}", listed.name);
                }
            }
        }
    }
}
