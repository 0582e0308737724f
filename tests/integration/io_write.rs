//! What is written reads back the same, bit by bit, and looks as other programs expect it.

use morse_smooth::error::ParseError;
use morse_smooth::io::{MeshFormat, ReadOptions, WriteOptions, read_mesh, write_mesh};
use proptest::prelude::*;

const VARIETIES: [(MeshFormat, bool); 6] = [
    (MeshFormat::Obj, false),
    (MeshFormat::Off, false),
    (MeshFormat::Ply, false),
    (MeshFormat::Ply, true),
    (MeshFormat::Vtk, false),
    (MeshFormat::Vtk, true),
];

const TRIANGLE: [f64; 9] = [0.0, 0.5, -1e-300, 1.0, 0.1, 3e200, -0.0, 1.0, 123_456_789.123_456_78];

fn can_hold_fields(format: MeshFormat) -> bool {
    matches!(format, MeshFormat::Ply | MeshFormat::Vtk)
}

fn text(format: MeshFormat, fields: &[(&str, &[f64])]) -> String {
    let bytes =
        write_mesh(&TRIANGLE, &[0, 1, 2], fields, &WriteOptions { format, binary: false, ..WriteOptions::default() });
    String::from_utf8(bytes.expect("a valid mesh")).expect("text")
}

#[test]
fn missing_values_are_written_where_that_is_asked_for() {
    for (format, binary) in VARIETIES.into_iter().filter(|&(format, _)| can_hold_fields(format)) {
        let options = WriteOptions { format, binary, missing: true };
        let values = [f64::NAN, 0.1, 2.0];
        let bytes = write_mesh(&TRIANGLE, &[0, 1, 2], &[("f", &values)], &options).expect("valid");
        let data = read_mesh(&bytes, &ReadOptions::default()).expect("a mesh");
        assert!(data.fields[0].1[0].is_nan() && data.fields[0].1[1..] == values[1..], "{:?}", data.fields);
        for bad in [f64::INFINITY, f64::NEG_INFINITY] {
            let refused = write_mesh(&TRIANGLE, &[0, 1, 2], &[("f", &[f64::NAN, bad, 1.0])], &options);
            assert_eq!(refused, Err(ParseError::NonFiniteValue { field: "f".to_owned(), vertex: 1 }));
        }
    }
}

#[test]
fn text_looks_as_it_should() {
    let rows = "0 0.5 -1e-300\n1 0.1 3e200\n-0 1 123456789.12345678\n";
    assert_eq!(text(MeshFormat::Off, &[]), format!("OFF\n3 1 0\n{rows}3 0 1 2\n"));
    let v = format!("v {}", rows.trim_end().replace('\n', "\nv "));
    assert_eq!(text(MeshFormat::Obj, &[]), format!("{v}\nf 1 2 3\n"));
    assert_eq!(
        text(MeshFormat::Vtk, &[("my field", &[1.0, 2.0, 3.5])]),
        format!(
            "# vtk DataFile Version 3.0\nmorse-smooth\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n{rows}POLYGONS 1 4\n3 0 1 2\n\
            POINT_DATA 3\nSCALARS my%20field double 1\nLOOKUP_TABLE default\n1\n2\n3.5\n"
        )
    );
    assert_eq!(
        text(MeshFormat::Ply, &[("my field", &[1.0, 2.0, 3.5])]),
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
            comment morse-smooth: my_field is my%20field\nproperty double my_field\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n{}3 0 1 2\n",
            rows.replacen("300\n", "300 1\n", 1).replacen("200\n", "200 2\n", 1).replacen("678\n", "678 3.5\n", 1)
        )
    );
}

#[test]
fn names_are_cleaned_without_collisions() {
    let values = [1.0, 2.0, 3.0];
    let names = ["a b", "a_b", "a\tb", "x", "", "", "50% \"é\"", "a_b_2"];
    let fields: Vec<(&str, &[f64])> = names.iter().map(|&name| (name, &values[..])).collect();
    let read_names = |format, binary| {
        let bytes =
            write_mesh(&TRIANGLE, &[0, 1, 2], &fields, &WriteOptions { format, binary, ..WriteOptions::default() })
                .expect("valid");
        let data = read_mesh(&bytes, &ReadOptions::default()).expect("valid");
        assert!(data.warnings.is_empty(), "{:?}", data.warnings);
        data.fields.into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    for binary in [false, true] {
        // PLY files have other names, and what these stand for in comments.
        let expected = ["a b", "a_b", "a\tb", "x", "field", "field_2", "50% \"é\"", "a_b_2"];
        assert_eq!(read_names(MeshFormat::Ply, binary), expected);
        assert_eq!(read_names(MeshFormat::Vtk, binary), expected);
    }
}

#[test]
fn headers_of_ply_files_are_plain() {
    let text = text(MeshFormat::Ply, &[("Höhe (m)", &[1.0, 2.0, 3.0]), ("x", &[1.0, 2.0, 3.0])]);
    assert!(text.is_ascii());
    assert!(text.contains("\nproperty double H_he_(m)\n") && text.contains("\nproperty double x_2\n"), "{text}");
}

#[test]
fn what_cannot_be_written_is_refused() {
    let field: &[(&str, &[f64])] = &[("f", &[1.0, 2.0, 3.0])];
    let write = |positions: &[f64], triangles: &[u32], fields: &[(&str, &[f64])], format, binary| {
        write_mesh(positions, triangles, fields, &WriteOptions { format, binary, ..WriteOptions::default() })
            .expect_err("refused")
    };
    for format in [MeshFormat::Obj, MeshFormat::Off] {
        let name = format.name().to_owned();
        let refused = write(&TRIANGLE, &[0, 1, 2], field, format, false);
        assert_eq!(refused, ParseError::FieldsNotSupported { format: name.clone() });
        let refused = write(&TRIANGLE, &[0, 1, 2], &[], format, true);
        assert_eq!(refused, ParseError::BinaryNotSupported { format: name });
    }
    for (format, binary) in VARIETIES {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut positions = TRIANGLE;
            positions[4] = bad;
            assert_eq!(write(&positions, &[0, 1, 2], &[], format, binary), ParseError::NonFinitePosition { vertex: 1 });
            if can_hold_fields(format) {
                let refused = write(&TRIANGLE, &[0, 1, 2], &[("f", &[1.0, 2.0, bad])], format, binary);
                assert_eq!(refused, ParseError::NonFiniteValue { field: "f".to_owned(), vertex: 2 });
            }
        }
        let refused = write(&TRIANGLE, &[0, 1, 2, 2, 1, 3], &[], format, binary);
        assert_eq!(refused, ParseError::FaceIndexOutOfBounds { face: 1, index: 3, vertices: 3 });
        assert_eq!(write(&TRIANGLE[..8], &[0, 1, 1], &[], format, binary).code(), "LengthMismatch");
        assert_eq!(write(&TRIANGLE, &[0, 1], &[], format, binary).code(), "LengthMismatch");
        if can_hold_fields(format) {
            let refused = write(&TRIANGLE, &[0, 1, 2], &[("f", &[1.0])], format, binary);
            assert_eq!(refused, ParseError::LengthMismatch { field: "f".to_owned(), expected: 3, actual: 1 });
        }
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Any finite double, subnormal and −0 included.
fn finite() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

proptest! {
    #[test]
    fn what_is_written_reads_back_bit_by_bit(
        (positions, triangles, first, second) in (3_usize..40).prop_flat_map(|vertices| (
            prop::collection::vec(finite(), 3 * vertices),
            prop::collection::vec(0..vertices as u32, 3..=3).prop_flat_map(move |start| {
                prop::collection::vec(prop::array::uniform3(0..vertices as u32), 0..60).prop_map(move |more| {
                    start.iter().copied().chain(more.into_iter().flatten()).collect::<Vec<u32>>()
                })
            }),
            prop::collection::vec(finite(), vertices),
            prop::collection::vec(finite(), vertices),
        ))
    ) {
        for (format, binary) in VARIETIES {
            let fields: &[(&str, &[f64])] =
                if can_hold_fields(format) { &[("one", &first), ("two", &second)] } else { &[] };
            let bytes = write_mesh(&positions, &triangles, fields, &WriteOptions { format, binary, ..WriteOptions::default() }).expect("valid");
            let data = read_mesh(&bytes, &ReadOptions::default()).expect("valid");
            prop_assert_eq!(data.format, format);
            prop_assert!(data.warnings.is_empty(), "{:?}", data.warnings);
            prop_assert_eq!(bits(&data.positions), bits(&positions));
            prop_assert_eq!(&data.triangles, &triangles);
            prop_assert_eq!(data.fields.len(), fields.len());
            for ((name, values), (expected_name, expected)) in data.fields.iter().zip(fields) {
                prop_assert_eq!(name, expected_name);
                prop_assert_eq!(bits(values), bits(expected));
            }
        }
    }
}
