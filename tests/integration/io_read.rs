//! Files written by hand, with known content.

use morse_smooth::error::{NameList, ParseError};
use morse_smooth::io::{
    Column, FieldFormat, FieldReadOptions, MeshData, MeshFormat, ReadOptions, read_field, read_mesh,
};

/// A square of two triangles; written by hand in every format below.
const SQUARE: [f64; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.5, 0.0, 1.0, -0.1];
const TWO: [u32; 6] = [0, 1, 2, 0, 2, 3];

pub(crate) fn read(bytes: impl AsRef<[u8]>) -> MeshData {
    read_mesh(bytes.as_ref(), &ReadOptions::default()).expect("a valid file")
}

fn fail(bytes: impl AsRef<[u8]>) -> ParseError {
    read_mesh(bytes.as_ref(), &ReadOptions::default()).expect_err("an invalid file")
}

fn fields(data: &MeshData) -> Vec<(&str, &[f64])> {
    data.fields.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect()
}

fn codes(data: &MeshData) -> Vec<(&str, usize)> {
    data.warnings.iter().map(|warning| (warning.code, warning.count)).collect()
}

fn assert_square(data: &MeshData, format: MeshFormat) {
    assert_eq!(data.positions, SQUARE);
    assert_eq!(data.triangles, TWO);
    assert_eq!(data.format, format);
}

// ------------------------------------------------------------------ OFF

#[test]
fn off_is_read_in_all_its_spellings() {
    let body = "0 0 0\n1 0 0\n1 1 0.5\n0 1 -.1\n3 0 1 2\n3 0 2 3\n";
    for head in [
        "OFF\n4 2 5\n",
        "OFF 4 2 5\n",
        "OFF4 2 5\n",
        "off\n4 2\n",
        "\n \n# made by hand\nOFF # keyword\n# counts\n\n4 2 0 # and edges\n#\n",
        "\u{feff}OFF\n4 2 0\n",
    ] {
        let text = format!("{head}{body}");
        for text in [text.clone(), text.replace('\n', "\r\n"), text.replace('\n', "\r"), text.trim_end().to_owned()] {
            let data = read(&text);
            assert_square(&data, MeshFormat::Off);
            assert!(data.warnings.is_empty() && data.fields.is_empty(), "{text:?}");
        }
    }
    let options = ReadOptions { format: Some(MeshFormat::Off), file_name: None };
    let without_keyword = read_mesh(format!("4 2 0\n{body}").as_bytes(), &options);
    assert_square(&without_keyword.expect("the keyword is optional"), MeshFormat::Off);
    let options = ReadOptions { format: None, file_name: Some("a.b/square.OFF".to_owned()) };
    let by_name = read_mesh(format!("4 2 0\n{body}").as_bytes(), &options);
    assert_square(&by_name.expect("the name tells the format"), MeshFormat::Off);
}

#[test]
fn off_colours_and_normals_are_left_out_with_a_warning() {
    let text = "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0.5 0 0 255 255\n0\t1 -0.1 1 2 3\n\
        3 0 1 2 0.5 0.5 0.5\n3 0 2 3\n";
    let data = read(text);
    assert_square(&data, MeshFormat::Off);
    assert_eq!(codes(&data), [("SkippedData", 4), ("SkippedData", 1)]);
    let data =
        read("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n3 0 1 2");
    assert_eq!(data.positions, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
}

#[test]
fn off_varieties_that_are_not_read_are_named() {
    assert_eq!(fail("OFF BINARY\n\0\0\0\x04").code(), "UnsupportedFeature");
    assert_eq!(fail("4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n").code(), "UnsupportedFeature");
    assert_eq!(fail("nOFF\n3\n3 1 0\n").code(), "UnsupportedFeature");
}

#[test]
fn polygons_are_cut_into_fans_and_short_faces_left_out() {
    let text = "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 .5 0\n5 0 1 2 3 4\n2 0 1\n4 3 2 1 0\n1 4\n";
    let data = read(text);
    assert_eq!(data.triangles, [0, 1, 2, 0, 2, 3, 0, 3, 4, 3, 2, 1, 3, 1, 0]);
    assert_eq!(codes(&data), [("SkippedFace", 2), ("PolygonTriangulated", 2)]);
    assert_eq!(data.warnings[0].examples, [1, 3]);
    assert_eq!(data.warnings[1].examples, [0, 2]);
}

// ------------------------------------------------------------------ OBJ

#[test]
fn obj_is_read_with_everything_around_it() {
    let text = "# comment \\\nmtllib a b.mtl\n\no square\nv 0 0 0\nv  1\t0 0 1.0\nvt 0 0\nvn 0 0 1\nvp 0.3\n\
        v 1 1 \\\n 0.5\nv 0 1 -0.1 0.2 0.3 0.4 # coloured\ng a\nusemtl red\ns 1\nf 1/1/1 2/1/1 3/1/1\nl 1 2\np 1\n\
        f -4//1 -2//1 -1//1\ncurv 0 1 1 2 3\n";
    for text in [text.to_owned(), text.replace('\n', "\r\n"), text.trim_end().to_owned()] {
        let data = read(&text);
        assert_square(&data, MeshFormat::Obj);
        assert_eq!(codes(&data), [("SkippedData", 2), ("SkippedData", 2), ("SkippedData", 2)]);
    }
}

#[test]
fn obj_keeps_file_order_and_unused_vertices_and_faces_may_come_first() {
    let data = read("f 5 3 2\nv 9 9 9\nv 1 0 0\nv 0 1 0\nv 8 8 8\nv 0 0 0\nv 1 0 0\n");
    assert_eq!(data.triangles, [4, 2, 1]);
    assert_eq!(data.positions.len(), 18);
    assert_eq!(data.positions[9..12], [8.0; 3]);
    let data = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 \\\n2 3\\\n4\nf 1 2\n");
    assert_eq!(data.triangles, [0, 1, 2, 0, 2, 3]);
    assert_eq!(codes(&data), [("SkippedFace", 1), ("PolygonTriangulated", 1)]);
}

#[test]
fn obj_ids_are_checked_as_written() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (face, index) in [("f 1 2 4", 4), ("f 0 1 2", 0), ("f 1 2 -4", -4), ("f 1 2 9999999999", 9_999_999_999)] {
        let error = fail(format!("{three}{face}\n"));
        assert_eq!(error, ParseError::FaceIndexOutOfBounds { face: 1, index, vertices: 3 });
    }
    assert_eq!(fail(format!("{three}f 1 2 x")), ParseError::InvalidNumber { line: 5, text: "x".to_owned() });
    assert_eq!(fail(format!("{three}f 1 2 /1")), ParseError::InvalidNumber { line: 5, text: "/1".to_owned() });
    assert_eq!(fail("v 1 2\n").code(), "InvalidSyntax");
}

// ------------------------------------------------------------------ PLY

const PLY_FACES: &str = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";

#[test]
fn ply_text_keeps_double_precision_whatever_the_header_declares() {
    let text = format!(
        "ply\nformat ascii 1.0\ncomment by hand\nobj_info x\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nproperty int q\nproperty uchar red\nproperty float nx\n{PLY_FACES}\
        0.1 0 0 1.5 255 -1\n1 0 0 1e-300 0 nan\n1 1 0.123456789012345 2 3 inf\n\n0 1 -0.1 +4 4 .5\n3 0 1 2\n3 0 2 3\n"
    );
    for text in [text.clone(), text.replace('\n', "\r\n"), text.replace('\n', "\r"), text.trim_end().to_owned()] {
        let data = read(&text);
        assert_eq!(data.positions[0], 0.1);
        assert_eq!(data.positions[8], 0.123_456_789_012_345);
        assert_eq!(data.triangles, TWO);
        assert_eq!(data.fields[0], ("q".to_owned(), vec![1.5, 1e-300, 2.0, 4.0]));
        assert_eq!(data.fields[1], ("red".to_owned(), vec![255.0, 0.0, 3.0, 4.0]));
        // What is not finite is left to the mesh and field stages, which know the vertex.
        assert!(data.fields[2].1[1].is_nan() && data.fields[2].1[2] == f64::INFINITY);
        assert!(data.warnings.is_empty());
    }
}

/// Every type, in an order of its own, with lists and elements that nobody asked for in between.
fn binary_ply(big: bool, newline: &str) -> Vec<u8> {
    let encoding = if big { "binary_big_endian" } else { "binary_little_endian" };
    let header = format!(
        "ply\nformat {encoding} 1.0\nelement extra 2\nproperty short a\nproperty list ushort double b\nelement vertex 4\n\
        property char i8\nproperty double z\nproperty uint16 u16\nproperty list uint8 int32 tags\nproperty float32 x\n\
        property int16 i16\nproperty uint u32\nproperty float64 y\nproperty int i32\nproperty uint8 u8\nelement empty 9\n\
        element face 3\nproperty uchar red\nproperty list int uint vertex_index\nproperty list uchar float texcoord\n\
        element edge 1\nproperty int a\nend_header\n"
    );
    let mut out = header.replace('\n', newline).into_bytes();
    let mut put = |raw: &[u8]| {
        if big { out.extend(raw.iter().rev()) } else { out.extend(raw) }
    };
    for items in [0_u16, 2] {
        put(&7_i16.to_le_bytes());
        put(&items.to_le_bytes());
        for _ in 0..items {
            put(&1.0_f64.to_le_bytes());
        }
    }
    for vertex in 0..4_u8 {
        let point = &SQUARE[3 * usize::from(vertex)..][..3];
        put(&(-(vertex as i8)).to_le_bytes());
        put(&point[2].to_le_bytes());
        put(&(65_535 - u16::from(vertex)).to_le_bytes());
        put(&[vertex]);
        for tag in 0..i32::from(vertex) {
            put(&tag.to_le_bytes());
        }
        put(&(point[0] as f32).to_le_bytes());
        put(&(-300 - i16::from(vertex)).to_le_bytes());
        put(&(4_000_000_000 + u32::from(vertex)).to_le_bytes());
        put(&point[1].to_le_bytes());
        put(&(-70_000 - i32::from(vertex)).to_le_bytes());
        put(&[250 + vertex]);
    }
    for corners in [&[0_u32, 1, 2][..], &[1], &[0, 2, 3]] {
        put(&[9]);
        put(&(corners.len() as i32).to_le_bytes());
        corners.iter().for_each(|corner| put(&corner.to_le_bytes()));
        put(&[1]);
        put(&0.5_f32.to_le_bytes());
    }
    put(&3_i32.to_le_bytes());
    out
}

#[test]
fn ply_binary_reads_every_type_in_both_byte_orders() {
    for (big, newline) in [(false, "\n"), (true, "\n"), (false, "\r\n"), (true, "\r\n"), (false, "\r"), (true, "\r")] {
        let data = read(binary_ply(big, newline));
        assert_square(&data, MeshFormat::Ply);
        let expected: [(&str, [f64; 4]); 6] = [
            ("i8", [0.0, -1.0, -2.0, -3.0]),
            ("u16", [65_535.0, 65_534.0, 65_533.0, 65_532.0]),
            ("i16", [-300.0, -301.0, -302.0, -303.0]),
            ("u32", [4e9, 4e9 + 1.0, 4e9 + 2.0, 4e9 + 3.0]),
            ("i32", [-7e4, -70_001.0, -70_002.0, -70_003.0]),
            ("u8", [250.0, 251.0, 252.0, 253.0]),
        ];
        assert_eq!(fields(&data), expected.each_ref().map(|(name, values)| (*name, values.as_slice())));
        assert_eq!(data.warnings.iter().filter(|warning| warning.code == "SkippedFace").count(), 1);
        // extra, tags, empty, texcoord, edge.
        assert_eq!(data.warnings.iter().filter(|warning| warning.code == "SkippedData").count(), 5);
        // Of the three faces one has a single corner.
        assert_eq!(data.triangle_fields, [("red".to_owned(), vec![9.0, 9.0])]);
    }
}

#[test]
fn ply_floats_of_binary_files_are_widened() {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{}",
        PLY_FACES.replace("face 2", "face 1")
    )
    .into_bytes();
    for value in [0.1_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, f32::NAN, 0.0] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    let data = read(&bytes);
    assert_eq!(data.positions[0], f64::from(0.1_f32));
    assert!(data.positions[7].is_nan());
    bytes.extend(b"more");
    assert_eq!(codes(&read(&bytes)), [("SkippedData", 4)]);
}

#[test]
fn ply_faces_may_come_before_vertices() {
    let data = read(
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
        property float x\nproperty float y\nproperty float z\nproperty float a\nproperty float a\nend_header\n\
        3 0 1 2\n0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n",
    );
    assert_eq!(data.triangles, [0, 1, 2]);
    assert_eq!(fields(&data), [("a", &[1.0, 3.0, 5.0][..]), ("a_2", &[2.0, 4.0, 6.0])]);
    assert_eq!(codes(&data), [("RenamedField", 1)]);
}

#[test]
fn ply_rows_that_do_not_fit_the_header_are_refused() {
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = PLY_FACES.replace("face 2", "face 1");
    let line = |rows: &str| match fail(format!("{head}{faces}{rows}")) {
        ParseError::InvalidSyntax { line, .. } => line,
        other => panic!("{other}"),
    };
    assert_eq!(line("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), 11);
    assert_eq!(line("0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n"), 11);
    assert_eq!(line("0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), 13);
    assert_eq!(line("0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), 13);
}

#[test]
fn ply_faces_may_have_numbers_that_the_header_does_not_declare() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n1 1 .5\n0 1 -.1\n3 0 1 2 255 0 0 255\n3 0 2 3 0 255 0 255\n";
    let data = read(text);
    assert_square(&data, MeshFormat::Ply);
    assert_eq!(codes(&data), [("SkippedData", 2)]);
}

#[test]
fn ply_strips_are_cut_into_triangles() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n9 0 1 2 3 -1 2 3 4 -1\n";
    assert_eq!(read(text).triangles, [0, 1, 2, 2, 1, 3, 2, 3, 4]);
    assert_eq!(read(text.replace("9 0", "8 0").replace("4 -1", "4")).triangles, [0, 1, 2, 2, 1, 3, 2, 3, 4]);
}

// ------------------------------------------------------------------ VTK

/// A binary file: text as it is, numbers big endian and followed by a line end.
struct Blocks(Vec<u8>);

impl Blocks {
    fn text(mut self, text: &str) -> Self {
        self.0.extend(text.as_bytes());
        self
    }
    fn numbers<const N: usize>(mut self, raw: impl IntoIterator<Item = [u8; N]>) -> Self {
        self.0.extend(raw.into_iter().flatten());
        self.0.push(b'\n');
        self
    }
}

fn vtk(encoding: &str) -> Blocks {
    Blocks(Vec::new()).text(&format!("# vtk DataFile Version 4.2\n\n{encoding}\nDATASET POLYDATA\n"))
}

/// With the color that every point has.
fn point_fields(color: &[f64; 4]) -> [(&'static str, &[f64]); 13] {
    [
        ("a b", &[0.1, 1.0, 2.0, 3.0]),
        ("pair_0", &[1.0, 3.0, 5.0, 7.0]),
        ("pair_1", &[2.0, 4.0, 6.0, 8.0]),
        ("rgb_0", color),
        ("rgb_1", color),
        ("rgb_2", color),
        ("v_0", &[1.0, 0.0, 0.0, 1.0]),
        ("v_1", &[0.0, 1.0, 0.0, 1.0]),
        ("v_2", &[0.0, 0.0, 1.0, 1.0]),
        // The square root of three, as IEEE 754 rounds it.
        ("v_magnitude", &[1.0, 1.0, 1.0, 1.732_050_807_568_877_2]),
        ("one", &[9.0, 8.0, 7.0, 6.0]),
        ("two_0", &[1.0, 2.0, 3.0, 4.0]),
        ("two_1", &[-1.0, -2.0, -3.0, -4.0]),
    ]
}

#[test]
fn vtk_text_is_read_with_everything_around_it() {
    let text = "# vtk DataFile Version 3.0\n title # POINTS\nASCII\nDATASET POLYDATA\nFIELD FieldData 2\nTIME 1 1 double\n\
        0.5\nnames 1 2 string\nfirst%20one\n\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0.5 0 1\n-0.1\nMETADATA\nINFORMATION 1\n\
        NAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 2 8\n\
        3 0 1 2\n3 0 2 3\nCELL_DATA 2\nSCALARS c int 1\nLOOKUP_TABLE default\n1 2\nPOINT_DATA 4\nSCALARS a%20b float\n\
        LOOKUP_TABLE mine\n0.1 1 2 3\nLOOKUP_TABLE mine 2\n0 0 0 1\n1 1 1 1\nscalars pair int 2\n1 2 3 4 5 6 7 8\n\
        COLOR_SCALARS rgb 3\n0 0 0 0 0 0 0 0 0 0 0 0\nVECTORS v float\n1 0 0 0 1 0 0 0 1 1 1 1\nGLOBAL_IDS ids vtkIdType\n\
        0 1 2 3\nFIELD more 3\none 1 4 long\n9 8 7 6\nMETADATA\nCOMPONENT_NAMES\nX\n\ntwo 2 4 double\n1 -1 2 -2 3 -3 4 -4\n\
        NULL_ARRAY 0 0 float\n";
    for text in [text.to_owned(), text.replace('\n', "\r\n"), text.replace('\n', "\r"), text.trim_end().to_owned()] {
        let data = read(&text);
        assert_square(&data, MeshFormat::Vtk);
        assert_eq!(fields(&data), point_fields(&[0.0; 4]));
        // TIME, names, vertex cell, line, c (which has too few values), table, ids.
        assert_eq!(data.warnings.len(), 7, "{:?}", data.warnings);
    }
}

#[test]
fn vtk_binary_is_read_with_everything_around_it() {
    let bytes = vtk("BINARY")
        .text("FIELD FieldData 1\nnames 1 2 string\n")
        .numbers([[0xc0 + 2], [b'h'], [b'i'], [0x80], [1], [b'x']])
        .text("POINTS 4 double\n")
        .numbers(SQUARE.map(f64::to_be_bytes))
        .text("LINES 1 3\n")
        .numbers([2_i32, 0, 1].map(i32::to_be_bytes))
        .text("POLYGONS 2 8\n")
        .numbers([3_i32, 0, 1, 2, 3, 0, 2, 3].map(i32::to_be_bytes))
        .text("METADATA\nINFORMATION 0\n\nPOINT_DATA 4\nSCALARS a%20b double 1\nLOOKUP_TABLE default\n")
        .numbers([0.1_f64, 1.0, 2.0, 3.0].map(f64::to_be_bytes))
        .text("SCALARS pair unsigned_char 2\n")
        .numbers([1_u8, 2, 3, 4, 5, 6, 7, 8].map(u8::to_be_bytes))
        .text("COLOR_SCALARS rgb 3\n")
        .numbers([[10_u8]; 12])
        .text("VECTORS v float\n")
        .numbers([1.0_f32, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0].map(f32::to_be_bytes))
        .text("LOOKUP_TABLE t 1\n")
        .numbers([[1_u8; 4]])
        .text("FIELD more 2\none 1 4 long\n")
        .numbers([9_i64, 8, 7, 6].map(i64::to_be_bytes))
        .text("two 2 4 short\n")
        .numbers([1_i16, -1, 2, -2, 3, -3, 4, -4].map(i16::to_be_bytes));
    let data = read(&bytes.0);
    assert_square(&data, MeshFormat::Vtk);
    assert_eq!(fields(&data), point_fields(&[10.0 / 255.0; 4]));
}

#[test]
fn vtk_numbers_of_every_type_are_read() {
    let base = || {
        vtk("BINARY")
            .text("POINTS 4 double\n")
            .numbers(SQUARE.map(f64::to_be_bytes))
            .text("POLYGONS 2 8\n")
            .numbers([3_i32, 0, 1, 2, 3, 0, 2, 3].map(i32::to_be_bytes))
            .text("POINT_DATA 4\n")
    };
    let check = |blocks: Blocks, expected: [f64; 4]| assert_eq!(fields(&read(blocks.0)), [("s", &expected[..])]);
    let signed = [1.0, -2.0, 3.0, -4.0];
    check(base().text("SCALARS s char\n").numbers([1_i8, -2, 3, -4].map(i8::to_be_bytes)), signed);
    check(base().text("SCALARS s vtktypeint64\n").numbers([1_i64, -2, 3, -4].map(i64::to_be_bytes)), signed);
    check(base().text("SCALARS s vtkIdType\n").numbers([1_i32, -2, 3, -4].map(i32::to_be_bytes)), signed);
    let large = [65_535.0, 1.0, 2.0, 3.0];
    check(base().text("SCALARS s unsigned_short\n").numbers([65_535_u16, 1, 2, 3].map(u16::to_be_bytes)), large);
    check(base().text("SCALARS s unsigned_int\n").numbers([65_535_u32, 1, 2, 3].map(u32::to_be_bytes)), large);
    check(base().text("SCALARS s unsigned_long\n").numbers([65_535_u64, 1, 2, 3].map(u64::to_be_bytes)), large);
    check(base().text("SCALARS s bit\n").numbers([[0b0101_0000_u8]]), [0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn vtk_cells_of_version_5_are_read() {
    let text = "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 .5 0 1 -.1\n\
        POLYGONS 4 6\nOFFSETS vtktypeint64\n0 3 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2\n3\n\
        LINES 2 2\nOFFSETS vtktypeint64\n0 2\nCONNECTIVITY vtktypeint64\n0 1\n";
    let data = read(text);
    assert_square(&data, MeshFormat::Vtk);
    assert_eq!(codes(&data), [("SkippedData", 1), ("SkippedFace", 1)]);
    let binary = vtk("BINARY")
        .text("POINTS 4 double\n")
        .numbers(SQUARE.map(f64::to_be_bytes))
        .text("POLYGONS 3 6\nOFFSETS vtktypeint64\n")
        .numbers([0_i64, 3, 6].map(i64::to_be_bytes))
        .text("CONNECTIVITY vtktypeint64\n")
        .numbers([0_i64, 1, 2, 0, 2, 3].map(i64::to_be_bytes));
    assert_square(&read(binary.0), MeshFormat::Vtk);
    for (from, to) in [("0 3 3 6", "0 3 2 6"), ("0 3 3 6", "0 3 3 7"), ("0 3 3 6", "1 3 3 6"), ("CONNECT", "COLLECT")] {
        assert_eq!(fail(text.replacen(from, to, 1)).code(), "InvalidSyntax", "{to}");
    }
}

#[test]
fn vtk_strips_keep_their_orientation() {
    let text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0 0 1 0 1 0 0 1 1 0 2 0 0\n\
        TRIANGLE_STRIPS 2 9\n5 0 1 2 3 4\n2 0 1\n";
    let data = read(text);
    assert_eq!(data.triangles, [0, 1, 2, 2, 1, 3, 2, 3, 4]);
    assert_eq!(codes(&data), [("SkippedFace", 1)]);
}

#[test]
fn vtk_varieties_and_lengths_that_do_not_fit_are_named() {
    let other = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET HYPERGRID\nPOINTS 1 float\n0 0 0\n";
    assert_eq!(
        fail(other),
        ParseError::UnsupportedFeature { format: "vtk".to_owned(), feature: "DATASET HYPERGRID".to_owned() }
    );
    let mesh = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
    let wrong = fail(format!("{mesh}POINT_DATA 4\nSCALARS s float\n1 2 3 4\n"));
    assert_eq!(wrong, ParseError::LengthMismatch { field: "POINT_DATA".to_owned(), expected: 3, actual: 4 });
    // One array too short does not keep the others from being read.
    let data = read(format!("{mesh}POINT_DATA 3\nFIELD f 2\ns 1 2 float\n1 2\nt 1 3 float\n4 5 6\n"));
    assert_eq!(fields(&data), [("t", &[4.0, 5.0, 6.0][..])]);
    assert_eq!(codes(&data), [("SkippedData", 2)]);
    assert_eq!(fail(format!("{mesh}POINT_DATA 3\nSCALARS s float\n1 2\n")).code(), "UnexpectedEnd");
    assert_eq!(fail(format!("{mesh}POINT_DATA 3\nSCALARS s float\n1 2 x\n")).code(), "InvalidNumber");
    assert_eq!(fail(format!("{mesh}POINT_DATA 3\nSCALARS s float\n1 2 3 4\n")).code(), "InvalidSyntax");
    assert_eq!(fail(mesh.replace("POLYGONS 1 4", "POLYGONS 2 4")).code(), "InvalidSyntax");
    assert_eq!(fail(mesh.replace("3 0 1 2", "4 0 1 2")).code(), "InvalidSyntax");
    assert_eq!(fail(mesh.replace("3 0 1 2", "3 0 1 3")).code(), "FaceIndexOutOfBounds");
}

// ------------------------------------------------------------------ formats

#[test]
fn what_is_no_mesh_is_told_with_the_formats_that_there_are() {
    let cases: [(&[u8], &str); 9] = [
        (b"hello world", "text"),
        (b"<?xml version=\"1.0\"?>\n<svg/>", "an SVG picture"),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "a JPEG picture"),
        (b"\x89PNG\r\n", "a PNG picture"),
        (b"BZh9", "compressed by bzip2"),
        (b"<!DOCTYPE html><html>404", "a page of the web, perhaps an error message of a server"),
        (b"0.5 1\n0.25 2\n", "a table of numbers, which is a field and no mesh"),
        (b"\0\x01\x02", "binary data of a kind that is not known here"),
        (b"{\"a\": 1}", "JSON"),
    ];
    for (bytes, what) in cases {
        match fail(bytes) {
            ParseError::UnknownFormat { seems, formats } => {
                assert_eq!(seems, what);
                let names: Vec<&str> = morse_smooth::io::formats().iter().map(|format| format.name).collect();
                assert_eq!(formats, names.join(", "));
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn the_content_counts_more_than_the_name() {
    let named = ReadOptions { format: None, file_name: Some("scan.ply".to_owned()) };
    assert_eq!(read_mesh(b"hello", &named).map_err(|error| error.code()), Err("InvalidSyntax"));
    assert!(read_mesh(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", &named).is_ok());
    for &format in MeshFormat::ALL {
        assert_eq!(format.name().to_uppercase().parse(), Ok(format));
    }
    assert_eq!("doc".parse::<MeshFormat>().map_err(|error| error.code()), Err("UnsupportedFormat"));
    assert_eq!(FieldFormat::from_name("CSV").map(FieldFormat::name), Some("csv"));
}

// ------------------------------------------------------------------ fields

fn column(text: &str, column: Option<Column>) -> Result<Vec<f64>, ParseError> {
    read_field(text.as_bytes(), &FieldReadOptions { column, ..FieldReadOptions::default() })
}

fn name(name: &str) -> Option<Column> {
    Some(Column::Name(name.to_owned()))
}

#[test]
fn plain_numbers_are_read() {
    for text in [
        "1\n-2.5\n1e-3\n",
        "1\r\n-2.5\r\n1e-3",
        "1\r-2.5\r1e-3\r",
        "\u{feff}1 -2.5 1e-3",
        "# c\n\n 1 # one\n-2.5\n\n1e-3\n",
    ] {
        assert_eq!(column(text, None), Ok(vec![1.0, -2.5, 1e-3]), "{text:?}");
    }
    let values = column("1\nNaN\n-inf\n", None).expect("what is not finite is refused later");
    assert!(values[1].is_nan() && values[2] == f64::NEG_INFINITY);
    let options = FieldReadOptions { format: Some(FieldFormat::Txt), ..FieldReadOptions::default() };
    assert_eq!(read_field(b"1\n2\nx\n", &options), Err(ParseError::InvalidNumber { line: 3, text: "x".to_owned() }));
    assert_eq!(column("1\n2\n3\n", Some(Column::Number(0))), Ok(vec![1.0, 2.0, 3.0]));
    assert_eq!(column("1\n2\n3\n", Some(Column::Number(1))).map_err(|error| error.code()), Err("UnknownColumn"));
}

#[test]
fn csv_columns_are_found_by_name_and_number() {
    let text = "label,\"height, m\" , t\n# note\na,1,10\n\"b \"\"x\"\"\n\",2.5, 20 \n\nc,3,-3e1";
    for text in [text.to_owned(), text.replace('\n', "\r\n"), format!("{text}\n")] {
        let columns = NameList(["height, m", "t"].map(str::to_owned).to_vec());
        assert_eq!(column(&text, None), Err(ParseError::AmbiguousColumn { columns }));
        assert_eq!(column(&text, name("height, m")), Ok(vec![1.0, 2.5, 3.0]));
        assert_eq!(column(&text, name("t")), Ok(vec![10.0, 20.0, -30.0]));
        assert_eq!(column(&text, Some(Column::Number(2))), Ok(vec![10.0, 20.0, -30.0]));
        assert_eq!(column(&text, name("u")), Err(ParseError::UnknownColumn { column: "u".to_owned() }));
        assert_eq!(column(&text, Some(Column::Number(3))), Err(ParseError::UnknownColumn { column: "3".to_owned() }));
        assert_eq!(column(&text, Some(Column::Number(0))).map_err(|error| error.code()), Err("InvalidNumber"));
    }
    assert_eq!(column("1,2\n3,4\n", None).map_err(|error| error.code()), Err("AmbiguousColumn"));
    assert_eq!(column("a,2\nb,4\n", None), Ok(vec![2.0, 4.0]));
    assert_eq!(column("1,2\n3,4\n", Some(Column::Number(1))), Ok(vec![2.0, 4.0]));
    assert_eq!(column("x\ty\n1\t2\n3\t4\n", name("y")), Ok(vec![2.0, 4.0]));
    assert_eq!(column("value\n1\n2\n", None), Ok(vec![1.0, 2.0]));
    assert_eq!(column("value\n1\n2\n", name("value")), Ok(vec![1.0, 2.0]));
}

#[test]
fn csv_of_spreadsheets_with_decimal_commas_is_read() {
    assert_eq!(column("a;b\n1,5;2\n-3,25;4\n", name("a")), Ok(vec![1.5, -3.25]));
    assert_eq!(column("1,234.5;2\n", None), Ok(vec![2.0]), "a number with comma and point is no number");
    assert_eq!(column("a;b\n1,5;2\n1,2,3;4\n", name("a")).map_err(|error| error.code()), Err("InvalidNumber"));
}

#[test]
fn csv_gaps_are_missing_values_and_short_records_errors_with_their_line() {
    let gap = column("a,b\n1,2\n3,\n", name("b")).expect("a missing value");
    assert!(gap[0] == 2.0 && gap[1].is_nan());
    let gap = column("a,b\r\n1,2\r\n\r\nNA,3\r\n", name("a")).expect("a missing value");
    assert!(gap[0] == 1.0 && gap[1].is_nan());
    assert_eq!(
        column("a,b\r\n1,2\r\n\r\nmuch,3\r\n", name("a")),
        Err(ParseError::InvalidNumber { line: 4, text: "much".to_owned() })
    );
    match column("a,b\n1,2\n3\n4,5\n", name("b")) {
        Err(ParseError::InvalidSyntax { line: 3, .. }) => {}
        other => panic!("{other:?}"),
    }
    assert_eq!(column("a,b\n", None).map_err(|error| error.code()), Err("MissingElement"));
    assert_eq!(column(" \n", None), Err(ParseError::EmptyFile {}));
}
