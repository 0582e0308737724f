//! Malformed input: an error with its code, or consistent data; never a panic, a hang or memory that a header made up.

use std::time::Instant;

use morse_smooth::error::ParseError;
use morse_smooth::io::{
    Column, FieldFormat, FieldReadOptions, MeshData, MeshFormat, ReadOptions, WriteOptions, read_field, read_mesh,
    read_table, write_mesh,
};
use proptest::prelude::*;

const FORMATS: [MeshFormat; 4] = [MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Vtk];

fn code(bytes: impl AsRef<[u8]>) -> &'static str {
    read_mesh(bytes.as_ref(), &ReadOptions::default()).expect_err("an invalid file").code()
}

#[test]
fn a_table_of_errors() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0\n1 0 0\n0 1 0\n\
        POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nSCALARS s float\n1 2 3\n";
    for valid in [ply, off, obj, vtk] {
        assert!(read_mesh(valid.as_bytes(), &ReadOptions::default()).is_ok());
    }
    let cases = [
        (ply, "ply\n", "ply\nhello\n", "InvalidSyntax"),
        (ply, "format ascii 1.0\n", "", "InvalidSyntax"),
        (ply, "ascii", "binary_middle_endian", "InvalidSyntax"),
        (ply, "end_header\n", "", "InvalidSyntax"),
        (ply, "float x", "real x", "InvalidSyntax"),
        (ply, "float x", "float w", "MissingElement"),
        (ply, "float x", "list uchar float x", "MissingElement"),
        (ply, "list uchar", "list float", "InvalidSyntax"),
        (ply, "vertex_indices", "vertices", "MissingElement"),
        (ply, "element vertex 3", "element point 3", "MissingElement"),
        (ply, "element face 1", "element vertex 1", "InvalidSyntax"),
        (ply, "element vertex 3\n", "", "InvalidSyntax"),
        (ply, "vertex 3", "vertex -3", "InvalidNumber"),
        (ply, "vertex 3", "vertex 1e9", "InvalidNumber"),
        (ply, "vertex 3", "vertex 4", "InvalidSyntax"),
        (ply, "vertex 3", "vertex 0", "MissingElement"),
        (ply, "vertex 3", "vertex 4000000000", "Truncated"),
        (ply, "vertex 3", "vertex 40000000000", "TooLarge"),
        (ply, "vertex 3", "vertex 99999999999999999999", "InvalidNumber"),
        (ply, "face 1", "face 4000000000", "Truncated"),
        (ply, "face 1", "face 18446744073709551615", "Truncated"),
        (ply, "3 0 1 2", "4000000000 0 1 2", "InvalidSyntax"),
        (ply, "3 0 1 2", "3 0 1 3", "FaceIndexOutOfBounds"),
        (ply, "3 0 1 2", "3 0 1 -1", "FaceIndexOutOfBounds"),
        (ply, "3 0 1 2", "3 0 1 1.5", "InvalidNumber"),
        (ply, "3 0 1 2", "2 0 1", "MissingElement"),
        (ply, "face 1\n", "face 0\n", "MissingElement"),
        (ply, "1 0 0", "1 0,5 0", "InvalidNumber"),
        (ply, "1 0 0", "1 0x1 0", "InvalidNumber"),
        (off, "3 1 0", "", "MissingElement"),
        (off, "3 1 0", "3", "InvalidSyntax"),
        (off, "3 1 0", "x 1 0", "InvalidNumber"),
        (off, "3 1 0", "-3 1 0", "InvalidNumber"),
        (off, "3 1 0", "3 2 0", "UnexpectedEnd"),
        (off, "3 1 0", "4000000000 1 0", "Truncated"),
        (off, "3 1 0", "3 4000000000 0", "Truncated"),
        (off, "3 1 0", "5000000000 1 0", "TooLarge"),
        (off, "3 1 0", "18446744073709551615 1 0", "TooLarge"),
        (off, "3 0 1 2", "3 0 1", "InvalidSyntax"),
        (off, "3 0 1 2", "4000000000 0 1 2", "InvalidSyntax"),
        (off, "3 0 1 2", "3 0 1 3", "FaceIndexOutOfBounds"),
        (off, "3 0 1 2", "3 0 1 -1", "FaceIndexOutOfBounds"),
        (off, "3 0 1 2", "3 0 1 4294967296", "FaceIndexOutOfBounds"),
        (off, "1 0 0", "1 0", "InvalidSyntax"),
        (off, "1 0 0", "1 zero 0", "InvalidNumber"),
        // A keyword is nothing but the keyword, or a count follows at once.
        (off, "OFF\n", "OFFSET ", "UnknownFormat"),
        (off, "OFF\n", "OFF-", "UnknownFormat"),
        (obj, "v 1 0 0", "v 1 0", "InvalidSyntax"),
        (obj, "v 1 0 0", "v 1 0 0.0.0", "InvalidNumber"),
        (obj, "v 1 0 0", "", "FaceIndexOutOfBounds"),
        (obj, "f 1 2 3", "f 1 2 4", "FaceIndexOutOfBounds"),
        (obj, "f 1 2 3", "f 1 2 -9223372036854775808", "FaceIndexOutOfBounds"),
        (obj, "f 1 2 3", "f 1 2 9223372036854775807", "FaceIndexOutOfBounds"),
        (obj, "f 1 2 3", "f 1 2 4294967295", "FaceIndexOutOfBounds"),
        (obj, "f 1 2 3", "f 1 2 99999999999999999999", "InvalidNumber"),
        (obj, "f 1 2 3", "f 1 2", "MissingElement"),
        (obj, "f 1 2 3", "", "MissingElement"),
        (vtk, "ASCII", "TEXT", "InvalidSyntax"),
        (vtk, "ASCII", "BINARY", "InvalidSyntax"),
        (vtk, "POINTS 3", "POINTS 4", "InvalidNumber"),
        (vtk, "POINTS 3", "POINTS 2", "InvalidSyntax"),
        (vtk, "POINTS 3", "POINTS 4000000000", "Truncated"),
        (vtk, "POINTS 3", "POINTS 40000000000", "TooLarge"),
        (vtk, "POINTS 3 float", "POINTS 3 number", "InvalidSyntax"),
        (vtk, "POINTS 3 float\n0 0 0\n1 0 0\n0 1 0\n", "", "InvalidSyntax"),
        (vtk, "POLYGONS 1 4", "POLYGONS 1 4000000000", "Truncated"),
        (vtk, "POLYGONS 1 4", "POLYGONS 4000000000 4", "InvalidSyntax"),
        (vtk, "POLYGONS 1 4", "POLYGONS 1 18446744073709551615", "Truncated"),
        (vtk, "3 0 1 2", "-3 0 1 2", "InvalidSyntax"),
        (vtk, "3 0 1 2", "3 0 1 3", "FaceIndexOutOfBounds"),
        (vtk, "3 0 1 2", "3 0 1 -1", "FaceIndexOutOfBounds"),
        (vtk, "POINT_DATA 3", "POINT_DATA 4000000000", "LengthMismatch"),
        (vtk, "SCALARS s float", "SCALARS s float 4000000000", "Truncated"),
        (vtk, "SCALARS s float", "SCALARS s", "InvalidSyntax"),
        (vtk, "SCALARS s float", "GLYPHS s float", "InvalidSyntax"),
        (vtk, "SCALARS s float", "FIELD f 4000000000\ns 1 3 float", "UnexpectedEnd"),
        (vtk, "POINT_DATA 3", "CELL_DATA 4000000000", "Truncated"),
        (vtk, "SCALARS s float", "SCALARS s string", "UnexpectedEnd"),
    ];
    let mut wrong = Vec::new();
    for (file, from, to, expected) in cases {
        assert!(file.contains(from), "{from}");
        let start = Instant::now();
        let found = code(file.replacen(from, to, 1));
        if found != expected {
            wrong.push(format!("{from:?} -> {to:?}: {found} instead of {expected}"));
        }
        assert!(start.elapsed().as_millis() < 200, "{from:?} -> {to:?} took {:?}", start.elapsed());
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn text_that_is_too_short_for_its_numbers_is_refused_before_there_is_room_for_them() {
    // Ten vertices take 59 bytes, a blank or line end after each number but the last.
    let head = "ply\nformat ascii 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for lines in [0, 5, 9] {
        let file = format!("{head}{}", "1 1 1\n".repeat(lines));
        let Err(ParseError::Truncated { expected, available }) = read_mesh(file.as_bytes(), &ReadOptions::default())
        else {
            panic!("{lines} lines");
        };
        assert_eq!((expected, available), (59, 6 * lines as u64));
    }
    let whole = format!("{head}{}3 0 1 2\n", "1 1 1\n".repeat(10));
    assert!(read_mesh(whole.as_bytes(), &ReadOptions::default()).is_ok());
}

#[test]
fn binary_headers_that_promise_billions_fail_at_once() {
    let ply = |vertices: &str, properties: &str| {
        format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n{properties}element face 1\n\
            property list uint int vertex_indices\nend_header\n\0\0\0\0"
        )
    };
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    assert_eq!(
        read_mesh(ply("4000000000", xyz).as_bytes(), &ReadOptions::default()),
        Err(ParseError::Truncated { expected: 48_000_000_000, available: 4 })
    );
    // Elements without properties take no bytes: nothing bounds their number, so it must not cost time.
    assert_eq!(code(ply("4000000000", "")), "MissingElement");
    let empty = ply("0", &format!("{xyz}element nothing 18446744073709551615\n"));
    assert_eq!(code(empty), "MissingElement");
    // A face that promises 2^32 − 1 corners.
    let mut face = ply("1", xyz).into_bytes();
    face.extend([0; 8]);
    face.extend([0xff; 4]);
    face.extend([0; 40]);
    assert_eq!(code(&face), "Truncated");
    let vtk = |rest: &str| format!("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\n{rest}");
    for rest in [
        "POINTS 4000000000 float\n",
        "POINTS 0 float\n\nPOLYGONS 4 4000000000\n",
        "POINTS 0 float\n\nPOLYGONS 4000000000 4000000000\nOFFSETS vtktypeint64\n",
        "FIELD f 1\na 4294967296 4294967296 double\n",
        "FIELD f 1\na 1 4000000000 bit\n",
        "FIELD f 1\na 1 4000000000 string\n",
        "FIELD f 1\na 1 1 string\n\x3f\x7f\x7f\x7f\x7f\x7f\x7f\x7f",
        "POINTS 0 float\n\nPOINT_DATA 0\nLOOKUP_TABLE t 9999999999999999999\n",
        "POINTS 0 float\n\nPOINT_DATA 0\nFIELD f 1\na 4000000000 0 float\n",
    ] {
        let start = Instant::now();
        let found = code(vtk(rest));
        assert!(["Truncated", "MissingElement"].contains(&found), "{rest:?}: {found}");
        assert!(start.elapsed().as_millis() < 200, "{rest:?}");
    }
}

#[test]
fn empty_and_foreign_bytes_are_refused() {
    for bytes in [&b""[..], b" \n\r\n\t", b"\xef\xbb\xbf", b"\xef\xbb\xbf\n"] {
        assert_eq!(code(bytes), "EmptyFile");
        assert_eq!(read_field(bytes, &FieldReadOptions::default()), Err(ParseError::EmptyFile {}));
        for format in FORMATS {
            let options = ReadOptions { format: Some(format), file_name: None };
            assert_eq!(read_mesh(bytes, &options), Err(ParseError::EmptyFile {}));
        }
    }
    assert_eq!(code([0_u8; 1000]), "UnknownFormat");
    assert_eq!(code(b"\xff\xfeO\0F\0F\0"), "UnknownFormat");
    assert_eq!(code(b"PK\x03\x04"), "UnknownFormat");
}

#[test]
fn long_lines_and_many_names_do_not_hang() {
    let mut obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf".to_vec();
    for corner in 0..300_000 {
        obj.extend(format!(" {}", corner % 3 + 1).bytes());
    }
    let data = read_mesh(&obj, &ReadOptions::default()).expect("one long face");
    assert_eq!(data.triangles.len(), 3 * 299_998);
    let mut ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n".to_owned();
    ply.push_str(&"property float a\n".repeat(20_000));
    ply.push_str("element face 1\nproperty list uchar int vertex_indices\nend_header\n");
    ply.push_str(&format!("0 0 0{0}\n1 0 0{0}\n0 1 0{0}\n3 0 1 2\n", " 1".repeat(20_000)));
    let start = Instant::now();
    let data = read_mesh(ply.as_bytes(), &ReadOptions::default()).expect("many fields of one name");
    assert_eq!(data.fields.len(), 20_000);
    assert!(start.elapsed().as_secs() < 5);
    many_columns();
    // Backslashes that join all lines of a file.
    let joined = "f 1 2 3 \\\n".repeat(100_000);
    assert_eq!(code(joined), "InvalidNumber");
}

/// As many that looking at all earlier ones for each would take minutes.
fn many_columns() {
    const COUNT: usize = 300_000;
    let start = Instant::now();
    let three = |row: &str| format!("0 0 0{row}\n1 0 0{row}\n0 1 0{row}\n");
    let ones = " 1".repeat(COUNT);
    let mut ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n".to_owned();
    (0..COUNT).for_each(|i| ply.push_str(&format!("property float a{i}\n")));
    ply.push_str("element face 1\nproperty list uchar int vertex_indices\nend_header\n");
    ply.push_str(&three(&ones));
    ply.push_str("3 0 1 2\n");
    let vtk = format!(
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0\n1 0 0\n0 1 0\n\
        POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nFIELD f 1\na {COUNT} 3 float\n{ones}{ones}{ones}\n"
    );
    for file in [ply, vtk] {
        let data = read_mesh(file.as_bytes(), &ReadOptions::default()).expect("many fields");
        assert_eq!(data.fields.len(), COUNT);
        assert!(data.fields.iter().all(|(_, values)| *values == [1.0; 3]));
    }
    // Names of a table, of which half are there twice.
    let mut csv: String = (0..COUNT).map(|i| format!("c{},", i % (COUNT / 2))).collect();
    csv.push_str("z\n");
    for _ in 0..3 {
        csv.push_str(&"1,".repeat(COUNT));
        csv.push_str("1\n");
    }
    let table = read_table(csv.as_bytes(), None).expect("many columns");
    assert_eq!((table.columns.len(), table.warnings.len()), (COUNT + 1, COUNT / 2));
    // Few rows take little room.
    assert!(table.columns.iter().all(|(_, values)| values.len() == 3 && values.capacity() <= 16));
    assert!(start.elapsed().as_secs() < 60);
}

/// Valid files of every format.
fn samples() -> Vec<Vec<u8>> {
    let positions: Vec<f64> = (0..18).map(|place| f64::from(place * place % 7) * 0.37 - 1.0).collect();
    let triangles = [0, 1, 2, 2, 1, 3, 3, 4, 5, 0, 5, 4];
    let values = [0.25, -1.5, 3e-9, 4.0, 5.0, 1e12];
    let mut samples = Vec::new();
    for format in FORMATS {
        for binary in [false, true] {
            let fields: &[(&str, &[f64])] = if matches!(format, MeshFormat::Ply | MeshFormat::Vtk) {
                &[("height", &values), ("b c", &values)]
            } else {
                &[]
            };
            samples.extend(write_mesh(
                &positions,
                &triangles,
                fields,
                &WriteOptions { format, binary, ..WriteOptions::default() },
            ));
        }
    }
    for text in [
        "COFF\n# c\n4 2 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n4 0 1 2 3 0 0 1\n2 0 1\n",
        "o a\nv 0 0 0\nv 1 0 0 .1 .2 .3\nvt 0 0\nv 1 \\\n1 0\nv 0 1 0\nf 1/1/1 2//1 -2 -1\nl 1 2\np 1\nf 1 3 4 # end\n",
        "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_index\nproperty int q\nelement vertex 4\n\
        property float x\nproperty float y\nproperty float z\nproperty list uchar int t\nproperty int q\nend_header\n\
        3 0 1 2 9\n4 0 1 2 3 9\n0 0 0 0 1\n1 0 0 2 1 1 1\n1 1 0 1 2 1\n0 1 0 0 nan\n",
        "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nFIELD F 1\nT 1 1 string\nabc\nPOINTS 4 float\n0 0 0 1 0 0\n\
        1 1 0 0 1 0\nMETADATA\nX\n\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n\
        TRIANGLE_STRIPS 1 5\n4 0 1 2 3\nLINES 1 3\n2 0 1\nCELL_DATA 2\nSCALARS c int\nLOOKUP_TABLE default\n1 2\n\
        POINT_DATA 4\nVECTORS v float\n1 2 3 4 5 6 7 8 9 0 1 2\nLOOKUP_TABLE t 1\n0 0 0 1\nFIELD G 1\ng 2 4 int\n1 2 3 4 5 6 7 8\n",
    ] {
        samples.push(text.as_bytes().to_vec());
    }
    samples
}

fn assert_consistent(data: &MeshData) {
    let vertices = data.positions.len() / 3;
    assert!(data.positions.len().is_multiple_of(3) && data.triangles.len().is_multiple_of(3));
    assert!(vertices > 0 && !data.triangles.is_empty());
    assert!(data.triangles.iter().all(|&corner| (corner as usize) < vertices));
    for (place, (name, values)) in data.fields.iter().enumerate() {
        assert_eq!(values.len(), vertices, "{name}");
        assert!(data.fields[..place].iter().all(|other| other.0 != *name), "{name} stands twice");
    }
}

fn read_every_way(bytes: &[u8]) {
    for format in [None].into_iter().chain(FORMATS.map(Some)) {
        if let Ok(data) = read_mesh(bytes, &ReadOptions { format, file_name: None }) {
            assert_consistent(&data);
        }
    }
    for format in [None, Some(FieldFormat::Txt), Some(FieldFormat::Csv)] {
        for column in [None, Some(Column::Number(1)), Some(Column::Name("a".to_owned()))] {
            let _ = read_field(bytes, &FieldReadOptions { format, column, ..FieldReadOptions::default() });
        }
        if let Ok(table) = read_table(bytes, format) {
            let rows = table.columns[0].1.len();
            assert!(rows > 0 && table.columns.iter().all(|(_, values)| values.len() == rows));
        }
    }
}

#[test]
fn every_sample_is_valid() {
    let samples = samples();
    assert_eq!(samples.len(), 10);
    for sample in samples {
        assert_consistent(&read_mesh(&sample, &ReadOptions::default()).expect("a valid sample"));
    }
}

#[test]
fn every_truncation_is_an_error_or_consistent() {
    for sample in samples() {
        for length in 0..sample.len() {
            read_every_way(&sample[..length]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_files_are_refused_or_consistent(
        which in 0_usize..10,
        damage in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..4, any::<u8>()), 1..6),
    ) {
        let mut bytes = samples().swap_remove(which);
        for (place, kind, value) in damage {
            if bytes.is_empty() {
                break;
            }
            let place = place.index(bytes.len());
            match kind {
                0 => bytes[place] ^= 1 << (value % 8),
                1 => bytes[place] = b"0123456789-. \n\r\t#\\/n"[usize::from(value) % 20],
                2 => drop(bytes.remove(place)),
                _ => bytes.insert(place, value),
            }
        }
        read_every_way(&bytes);
    }

    #[test]
    fn spliced_files_are_refused_or_consistent(
        (first, second) in (0_usize..10, 0_usize..10),
        cut in any::<prop::sample::Index>(),
        join in any::<prop::sample::Index>(),
    ) {
        let samples = samples();
        let (head, tail) = (&samples[first], &samples[second]);
        let bytes = [&head[..cut.index(head.len())], &tail[join.index(tail.len())..]].concat();
        read_every_way(&bytes);
    }

    #[test]
    fn random_bytes_are_refused_or_consistent(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read_every_way(&bytes);
    }

    #[test]
    fn random_csv_gives_numbers_or_an_error(text in "[0-9a,;\"\t\n\r.#-]{0,60}") {
        read_every_way(text.as_bytes());
    }
}
