//! Files as people have brought them, which were refused or read wrongly: each with what stands in it.

use morse_smooth::error::{Detail, NameList, ParseError};
use morse_smooth::io::{
    Column, ExpectedRows, FieldReadOptions, MeshData, ReadOptions, WriteOptions, read_field, read_mesh, read_table,
    write_mesh,
};
use morse_smooth::load::{LoadOptions, TriangleFields, load_arrays};

use crate::io_data::area;

fn mesh(text: impl AsRef<[u8]>) -> MeshData {
    read_mesh(text.as_ref(), &ReadOptions::default()).expect("a valid file")
}

fn codes(data: &MeshData) -> Vec<&str> {
    data.warnings.iter().map(|warning| warning.code).collect()
}

fn field(text: impl AsRef<[u8]>, column: Option<&str>) -> Result<Vec<f64>, ParseError> {
    let column = column.map(|name| Column::Name(name.to_owned()));
    read_field(text.as_ref(), &FieldReadOptions { column, ..FieldReadOptions::default() })
}

/// Values with `None` where they are missing, so that they can be compared.
fn present(values: &[f64]) -> Vec<Option<f64>> {
    values.iter().map(|&value| (!value.is_nan()).then_some(value)).collect()
}

// ------------------------------------------------------------------ numbers

#[test]
fn windows_writes_nan_in_its_own_way() {
    let values = field("0.5\n-1.#IND\n1.#QNAN\n0.7\n", None).expect("a field");
    assert_eq!(present(&values), [Some(0.5), None, None, Some(0.7)]);
    let table = read_table(b"0.5\n-1.#IND\n1.#QNAN\n0.7\n", None).expect("a table");
    assert_eq!(
        table.warnings.iter().map(|warning| (warning.code, warning.count)).collect::<Vec<_>>(),
        [("NonFiniteValue", 2)]
    );
    let data = mesh("v 0 0 1.#INF\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 2 3 4\n");
    // The vertex is nowhere, and no face has it.
    assert_eq!(data.positions[..3], [1.0, 0.0, 0.0]);
    assert_eq!((data.triangles, data.vertex_map), (vec![0, 1, 2], Some(vec![1, 2, 3])));
    // A comment begins where a word does.
    assert_eq!(
        field("1 # one\n2\n#3\n4#5\n", None),
        Err(ParseError::InvalidNumber { line: 4, text: "4#5".to_owned() })
    );
}

#[test]
fn fortran_writes_exponents_with_d() {
    assert_eq!(field("1.0D+00\n2\n3\n", None), Ok(vec![1.0, 2.0, 3.0]));
    assert_eq!(field("1.5d-3\n-2D2\n", None), Ok(vec![1.5e-3, -200.0]));
    assert_eq!(field("a,b\n1.0D+01,x\n2.5D0,y\n", None), Ok(vec![10.0, 2.5]));
}

#[test]
fn commas_are_decimal_where_they_cannot_be_separators() {
    assert_eq!(field("0,1\n0,2\n0,3\n", None), Ok(vec![0.1, 0.2, 0.3]));
    assert_eq!(field("0,25\n1,05\n-3,125\n17\n", None), Ok(vec![0.25, 1.05, -3.125, 17.0]));
    assert_eq!(field("height\n0,25\n1,5\n", None), Ok(vec![0.25, 1.5]));
    // A counting column and its values, with an integer for each: two columns.
    assert_eq!(field("0,5\n1,7\n2,9\n", None).map_err(|error| error.code()), Err("AmbiguousColumn"));
    assert_eq!(field("0,5\n1,7\n2,9\n", Some("1")), Ok(vec![5.0, 7.0, 9.0]));
    let blanks = read_table(b"1,5 2,5\n3,5 4,5\n", None).expect("two columns");
    assert_eq!(blanks.columns, [("0".to_owned(), vec![1.5, 3.5]), ("1".to_owned(), vec![2.5, 4.5])]);
    // With points there are no decimal commas.
    assert_eq!(read_table(b"1.5,2\n3,4.5\n", None).expect("two columns").columns[1].1, [2.0, 4.5]);
}

// ------------------------------------------------------------------ tables

#[test]
fn a_column_is_never_chosen_in_silence() {
    let error = field("id,f\n0,1.5\n1,2.5\n", None).expect_err("two columns");
    assert_eq!(error, ParseError::AmbiguousColumn { columns: NameList(vec!["id".to_owned(), "f".to_owned()]) });
    assert_eq!(error.detail(), [("columns", Detail::Texts(vec!["id".to_owned(), "f".to_owned()]))]);
    assert_eq!(field("id,f\n0,1.5\n1,2.5\n", Some("f")), Ok(vec![1.5, 2.5]));
    let values = field("stress,temp\n,20\n1.5,21\n", Some("stress")).expect("a column");
    assert_eq!(present(&values), [None, Some(1.5)]);
    // One column of numbers beside text needs no name.
    assert_eq!(field("name,f\na,1.5\nb,2.5\n", None), Ok(vec![1.5, 2.5]));
}

#[test]
fn blank_separated_columns_are_columns() {
    let text = "000 0 0 0 0.25\n001 1 0 0 0.5\n002 0 1 0 -1\n";
    assert_eq!(field(text, None).map_err(|error| error.code()), Err("AmbiguousColumn"));
    let options = FieldReadOptions { column: Some(Column::Number(4)), ..FieldReadOptions::default() };
    assert_eq!(read_field(text.as_bytes(), &options), Ok(vec![0.25, 0.5, -1.0]));
    let table = read_table(b"# x y z height\n0 0 0 1\n1 0 0 2\n", None).expect("a table with its header in a comment");
    assert_eq!(table.columns[3], ("height".to_owned(), vec![1.0, 2.0]));
    // Numbers that fill lines are one field.
    assert_eq!(field("1 2 3\n4 5 6\n7\n", None), Ok(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]));
}

#[test]
fn spreadsheets_write_tables_in_many_ways() {
    let expected = [("id".to_owned(), vec![0.0, 1.0]), ("Höhe".to_owned(), vec![1.5, -2.25])];
    let utf16 = |text: &str, big: bool| {
        let units = text.encode_utf16().flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() });
        let mark = if big { [0xfe, 0xff] } else { [0xff, 0xfe] };
        mark.into_iter().chain(units).collect::<Vec<u8>>()
    };
    for text in [
        "id,Höhe\n0,1.5\n1,-2.25\n",
        "id;Höhe\r\n0;1,5\r\n1;-2,25\r\n",
        "id\tHöhe\n0\t1,5\n1\t-2,25",
        "id|Höhe\n0|1.5\n1|-2.25\n",
        "id  Höhe\n 0   1.5\n 1 -2.25\n",
        "\u{feff}id,Höhe\n0,1.5\n1,-2.25\n",
        "sep=;\nid;Höhe\n0;1,5\n1;-2,25\n",
        "SEP=,\r\n\"id\",\"Höhe\"\r\n\"0\",\"1.5\"\r\n\"1\",\"-2.25\"\r\n",
        "# written by hand\nid,Höhe\n# in between\n0,1.5\n1,-2.25,\n",
    ] {
        for bytes in [
            text.as_bytes().to_vec(),
            utf16(text.trim_start_matches('\u{feff}'), false),
            utf16(text.trim_start_matches('\u{feff}'), true),
        ] {
            assert_eq!(read_table(&bytes, None).expect(text).columns, expected, "{text:?}");
        }
    }
}

#[test]
fn headers_may_be_integers_and_rows_may_have_names() {
    let columns = |text: &str| read_table(text.as_bytes(), None).expect(text).columns;
    let of = |name: &str, values: &[f64]| (name.to_owned(), values.to_vec());
    // What pandas writes without names.
    assert_eq!(columns(",0,1\n0,0.5,1\n1,0.25,3\n")[1..], [of("0", &[0.5, 0.25]), of("1", &[1.0, 3.0])]);
    assert_eq!(columns(",0\n0,0.5\n1,0.25\n")[1..], [of("0", &[0.5, 0.25])]);
    assert_eq!(
        columns("2019,2020\n0.5,1.0\n0.25,3.5\n0.75,2e1\n"),
        [of("2019", &[0.5, 0.25, 0.75]), of("2020", &[1.0, 3.5, 20.0])]
    );
    // These integers are data.
    assert_eq!(columns("0,1\n2,3\n4,5\n"), [of("0", &[0.0, 2.0, 4.0]), of("1", &[1.0, 3.0, 5.0])]);
    assert_eq!(columns("0 1 2\n.5 1.5 2.5\n")[0], of("0", &[0.0, 0.5]));
    // What R writes: the names of the rows have none.
    assert_eq!(columns("\"x\" \"y\"\n\"a\" 1 2\n\"b\" 3 4\n"), [of("x", &[1.0, 3.0]), of("y", &[2.0, 4.0])]);
}

#[test]
fn missing_values_have_many_spellings() {
    let text = "f,g\n1,0\nNA,0\n,0\nn/a,0\nnull,0\nNaN,0\n-,0\n#N/A,0\n?,0\nNone,0\n2,0\n";
    let values = field(text, Some("f")).expect("a column");
    assert_eq!(values.len(), 11);
    assert_eq!((values[0], values[10]), (1.0, 2.0));
    assert!(values[1..10].iter().all(|value| value.is_nan()));
}

#[test]
fn a_wrong_number_of_rows_is_told_with_a_likely_cause() {
    let check = |rows: usize, vertices, triangles, cause: &str| {
        let text: String = (0..rows).map(|row| format!("{row}.5\n")).collect();
        let expected = Some(ExpectedRows { vertices, triangles });
        match read_field(text.as_bytes(), &FieldReadOptions { expected, ..FieldReadOptions::default() }) {
            Err(error @ ParseError::WrongRowCount { .. }) => {
                let message = error.to_string();
                assert!(message.contains(&rows.to_string()) && message.contains(&vertices.to_string()), "{message}");
                assert!(message.contains(cause), "{message}");
            }
            other => panic!("{other:?}"),
        }
    };
    check(8, 6, Some(8), "each triangle");
    check(7, 6, Some(8), "header");
    check(5, 6, None, "header");
    check(12, 6, Some(8), "2 for each vertex");
    check(24, 7, Some(8), "each corner");
    check(100, 6, Some(8), "another mesh");
    let right = FieldReadOptions {
        expected: Some(ExpectedRows { vertices: 2, triangles: None }),
        ..FieldReadOptions::default()
    };
    assert_eq!(read_field(b"1\n2\n", &right), Ok(vec![1.0, 2.0]));
}

// ------------------------------------------------------------------ meshes

#[test]
fn concave_polygons_keep_their_area() {
    let dart = mesh("OFF\n4 1 0\n2 0 0\n.5 .5 0\n0 2 0\n0 0 0\n4 0 1 2 3\n");
    assert!((area(&dart) - 1.0).abs() < 1e-15, "{}", area(&dart));
    assert_eq!(codes(&dart), ["PolygonTriangulated"]);
    // The same in a plane that is no coordinate plane, beginning at every corner, in either direction.
    let points = ["2 0 2", "0.5 0.5 1", "0 2 2", "0 0 0"];
    for first in 0..4 {
        for backwards in [false, true] {
            let ids: Vec<String> =
                (0..4).map(|i| if backwards { first + 4 - i } else { first + i } % 4).map(|i| i.to_string()).collect();
            let data = mesh(format!("OFF\n4 1 0\n{}\n4 {}\n", points.join("\n"), ids.join(" ")));
            // Corners (2, 0, 2), (0.5, 0.5, 1), (0, 2, 2), (0, 0, 0) lie in z = x + y.
            assert!((area(&data) - 3.0_f64.sqrt()).abs() < 1e-12, "{first} {backwards}: {}", area(&data));
        }
    }
    // A comb of ten teeth: 21 corners above and two below; its area by the trapezium rule.
    let mut outline: Vec<(f64, f64)> = vec![(20.0, -1.0), (0.0, -1.0)];
    outline.extend((0..=20).map(|i| (f64::from(i), f64::from(i % 2) * 3.0)));
    let rows: String = outline.iter().map(|(x, y)| format!("v {x} {y} 7\n")).collect();
    let ids: Vec<String> = (1..=outline.len()).map(|id| id.to_string()).collect();
    let comb = mesh(format!("{rows}f {}\n", ids.join(" ")));
    assert!((area(&comb) - 50.0).abs() < 1e-12, "{}", area(&comb));
    assert_eq!(comb.triangles.len(), 3 * (outline.len() - 2));
}

#[test]
fn polygons_that_are_not_flat_or_cross_themselves_are_told() {
    let bow = mesh("OFF\n4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n");
    assert_eq!(codes(&bow), ["PolygonTriangulated", "IrregularPolygon"]);
    let bent = mesh("OFF\n4 1 0\n0 0 0\n1 0 1\n1 1 0\n0 1 1\n4 0 1 2 3\n");
    assert_eq!(codes(&bent), ["PolygonTriangulated", "IrregularPolygon"]);
    let nearly_flat = mesh("OFF\n4 1 0\n0 0 0\n1 0 .01\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    assert_eq!(codes(&nearly_flat), ["PolygonTriangulated"]);
}

#[test]
fn off_files_count_words() {
    let square = mesh("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    for text in [
        "OFF\n4 2 0\n0 0 0\n1 0\n0\n1 1 0\n0\n1\n0\n3 0 1 2\n3\n0 2 3\n",
        "OFF\n4 2 0\n0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3\n",
        "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 0 2 3",
    ] {
        let data = mesh(text);
        assert_eq!((data.positions, data.triangles), (square.positions.clone(), square.triangles.clone()), "{text:?}");
    }
    // Lines that others have, too, must not be taken for the rest of one that is too short.
    for text in ["OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1\n3 0 2 3\n"]
    {
        let error = read_mesh(text.as_bytes(), &ReadOptions::default()).expect_err(text);
        assert_eq!(error.code(), "InvalidSyntax", "{text:?}");
    }
}

#[test]
fn vertices_that_are_nowhere_and_unused_are_dropped() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property float f\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 1\nnan nan nan 2\n1 0 0 3\n0 1 0 4\n3 0 2 3\n";
    let data = mesh(text);
    assert_eq!(data.positions, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    assert_eq!(data.triangles, [0, 1, 2]);
    assert_eq!(data.fields, [("f".to_owned(), vec![1.0, 3.0, 4.0])]);
    assert_eq!(data.vertex_map, Some(vec![0, 2, 3]));
    assert_eq!((codes(&data), data.warnings[0].examples.clone()), (vec!["DroppedVertex"], vec![1]));
    let used = mesh(text.replace("3 0 2 3", "3 0 1 3"));
    assert!(used.positions[3].is_nan() && used.vertex_map.is_none());
}

#[test]
fn names_of_ply_fields_come_back() {
    let names = ["Höhe", "two words", "höhe", "H_he"];
    let values = [1.0, 2.0, 3.0];
    let fields: Vec<(&str, &[f64])> = names.iter().map(|&name| (name, &values[..])).collect();
    let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let bytes = write_mesh(&positions, &[0, 1, 2], &fields, &WriteOptions::default()).expect("a file");
    assert!(bytes.is_ascii());
    let data = mesh(&bytes);
    assert_eq!(data.fields.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), names);
    assert!(data.warnings.is_empty());
}

// ------------------------------------------------------------------ fields on triangles

const ROOF: &str = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
    element face 3\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty double load\nend_header\n\
    0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 0\n4 0 1 2 3 10 1\n2 0 1 20 2\n3 1 4 2 30 nan\n";

#[test]
fn fields_on_triangles_stay_there() {
    let data = mesh(ROOF);
    assert_eq!(data.triangle_fields[0], ("red".to_owned(), vec![10.0, 10.0, 30.0]));
    assert_eq!(present(&data.triangle_fields[1].1), [Some(1.0), Some(1.0), None]);
    assert!(data.fields.is_empty());
}

#[test]
fn fields_on_triangles_become_means_weighted_by_area() {
    let options = LoadOptions { triangle_fields: TriangleFields::Average, ..LoadOptions::default() };
    let loaded = load_arrays(ROOF.as_bytes(), &options).expect("a mesh");
    // Areas 2, 2 and 1; vertices 1 and 2 have the third triangle, too.
    let triangles: Vec<[u32; 3]> =
        loaded.triangles.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect();
    let expected: Vec<f64> = (0..5)
        .map(|vertex| {
            let around = triangles
                .iter()
                .zip([(2.0, 10.0), (2.0, 10.0), (1.0, 30.0)])
                .filter(|(corners, _)| corners.contains(&vertex));
            let (weights, sum) =
                around.fold((0.0, 0.0), |(weights, sum), (_, (w, value))| (weights + w, sum + w * value));
            sum / weights
        })
        .collect();
    assert_eq!(loaded.fields[0], ("red".to_owned(), expected));
    assert_eq!(present(&loaded.fields[1].1), [Some(1.0), Some(1.0), Some(1.0), Some(1.0), None]);
    assert_eq!(loaded.triangle_fields.len(), 2);
    assert!(loaded.warnings.iter().any(|warning| warning.code == "AveragedField" && warning.count == 2));
}
