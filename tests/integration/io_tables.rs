//! Tables as a whole, and the list of formats.

use core::fmt::Write;

use morse_smooth::error::ParseError;
use morse_smooth::io::{
    FieldFormat, FieldReadOptions, MeshFormat, ReadOptions, Table, WriteOptions, formats, read_field, read_mesh,
    read_table, write_mesh,
};

fn table(text: &str) -> Table {
    read_table(text.as_bytes(), None).expect("a table")
}

fn names(table: &Table) -> Vec<&str> {
    table.columns.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn columns_have_names_or_numbers() {
    let read = table("\u{feff}x;name;y\n1,5;a;2\n3;b;4,25\n");
    assert_eq!(read.columns, [("x".to_owned(), vec![1.5, 3.0]), ("y".to_owned(), vec![2.0, 4.25])]);
    assert_eq!(read.warnings.iter().map(|warning| warning.code).collect::<Vec<_>>(), ["SkippedData"]);
    assert_eq!(names(&table("1 2 3\r\n4 5 6\r\n")), ["0", "1", "2"]);
    assert_eq!(names(&table("f f f_2\n1 2 3\n")), ["f", "f_2", "f_2_2"]);
}

#[test]
fn a_row_of_another_length_is_told_by_its_line() {
    let line = |text: &str| match read_table(text.as_bytes(), None) {
        Err(ParseError::InvalidSyntax { line, .. }) => line,
        other => panic!("{other:?}"),
    };
    assert_eq!(line("# c\na,b\n1,2\n\n3\n4,5\n"), 5);
    assert_eq!(line("1 2\n3 4 5\n6 7\n"), 2);
}

#[test]
fn a_table_of_one_column_is_the_field() {
    let mut text = String::from("height\n");
    for i in 0..1000 {
        writeln!(text, "{}", f64::from(i) * 0.37 - 100.0).expect("a text");
    }
    let field = read_field(text.as_bytes(), &FieldReadOptions::default()).expect("a field");
    assert_eq!(table(&text).columns, [("height".to_owned(), field)]);
    assert_eq!(read_table(text.as_bytes(), Some(FieldFormat::Csv)), Ok(table(&text)));
}

#[test]
fn formats_are_those_that_there_are() {
    let triangle = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    for &format in MeshFormat::ALL {
        let listed = formats().iter().find(|listed| listed.name == format.name());
        let options = WriteOptions { format, ..WriteOptions::default() };
        let written = write_mesh(&triangle, &[0, 1, 2], &[], &options);
        assert_eq!(written.is_ok(), listed.is_some_and(|listed| listed.writes), "{}", format.name());
        let read = read_mesh(b"1", &ReadOptions { format: Some(format), file_name: None });
        let is_known = read.expect_err("no mesh").code() != "UnsupportedFormat";
        assert_eq!(is_known, listed.is_some_and(|listed| listed.reads), "{}", format.name());
        let endings = listed.iter().flat_map(|listed| listed.extensions);
        for ending in endings {
            let options = ReadOptions { format: None, file_name: Some(format!("a.{}", ending.to_uppercase())) };
            assert_ne!(read_mesh(b"1", &options).expect_err("no mesh").code(), "UnknownFormat");
        }
    }
    for &format in FieldFormat::ALL {
        let listed = formats().iter().find(|listed| listed.name == format.name());
        assert!(listed.is_some_and(|listed| listed.reads), "{}", format.name());
        let is_text = matches!(format, FieldFormat::Txt | FieldFormat::Csv);
        assert_eq!(read_table(b"1\n2\n", Some(format)).is_ok(), is_text, "{}", format.name());
    }
}
