//! Reading, loading and writing files.

use morse_smooth::io::{
    Column, FieldReadOptions, MeshFormat, ReadOptions, WriteOptions, read_field, read_mesh, read_table, write_mesh,
};
use morse_smooth::load::{LoadOptions, load};
use morse_smooth::mesh::WeldOptions;

use crate::check;
use crate::mesh::{Arrays, every_kind};

#[test]
fn mesh_files() {
    for Arrays { name, positions, triangles } in every_kind() {
        let values: Vec<f64> = positions.chunks_exact(3).map(|p| 0.1 * p[0] - p[2]).collect();
        let fields: [(&str, &[f64]); 2] = [("height", &values), ("height", &values)];
        for (format, binary, fields) in [
            (MeshFormat::Obj, false, &[][..]),
            (MeshFormat::Off, false, &[]),
            (MeshFormat::Ply, false, &fields),
            (MeshFormat::Ply, true, &fields),
            (MeshFormat::Vtk, false, &fields),
            (MeshFormat::Vtk, true, &fields),
        ] {
            let what = format!("{} of {name}", format.name());
            let file = check(&format!("writing {what}"), 1.5, || {
                write_mesh(&positions, &triangles, fields, &WriteOptions { format, binary, ..WriteOptions::default() })
                    .unwrap()
            });
            let read = check(&format!("reading {what}"), 1.2, || read_mesh(&file, &ReadOptions::default()).unwrap());
            assert_eq!(read.positions, positions);
            if !binary {
                continue;
            }
            for weld in [None, Some(WeldOptions::default()), Some(WeldOptions { tolerance: 1e-3 })] {
                let options = LoadOptions { weld, ..Default::default() };
                check(&format!("loading {what}"), 1.6, || load(&file, &options).map(drop).ok());
            }
        }
    }
}

/// Files whose content is of unusual shape.
#[test]
fn odd_mesh_files() {
    let n = 30_000;
    // One face with many corners, and one strip.
    let mut obj: String = (0..n).map(|i| format!("v {i} {} 0\n", i * i % 7)).collect();
    obj += &format!("f {}\n", (1..=n).map(|i| i.to_string()).collect::<Vec<_>>().join(" "));
    check("a face of many corners", 1.2, || read_mesh(obj.as_bytes(), &ReadOptions::default()).unwrap());
    let points: String = (0..n).map(|i| format!("{i} {} 0\n", i * i % 7)).collect();
    let ids: Vec<String> = (0..n).map(|i| i.to_string()).collect();
    let head = format!("# vtk DataFile Version 5.1\n\nASCII\nDATASET POLYDATA\nPOINTS {n} float\n{points}");
    let strip = format!("{head}TRIANGLE_STRIPS 1 {}\n{n} {}\n", n + 1, ids.join(" "));
    check("a strip", 1.2, || read_mesh(strip.as_bytes(), &ReadOptions::default()).unwrap());
    let offsets: Vec<String> = (0..=n / 3).map(|i| (3 * i).to_string()).collect();
    let cells = format!(
        "{head}POLYGONS {} {n}\nOFFSETS vtktypeint64\n{}\nCONNECTIVITY vtktypeint64\n{}\n",
        n / 3 + 1,
        offsets.join("\n"),
        ids.join("\n")
    );
    check("cells by offsets", 1.2, || read_mesh(cells.as_bytes(), &ReadOptions::default()).unwrap());
    // Many components of few points.
    let triangle = "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
    let columns = format!("{triangle}POINT_DATA 3\nFIELD all 1\nname {n} 3 float\n{}\n", "0 ".repeat(3 * n));
    check("many columns", 4.0, || read_mesh(columns.as_bytes(), &ReadOptions::default()).unwrap());
}

#[test]
fn field_files() {
    let numbers: Vec<String> = (0..100_000).map(|i| format!("{}", f64::from(i) * 0.37)).collect();
    let rows = numbers.join("\n");
    check("numbers", 1.2, || read_field(rows.as_bytes(), &FieldReadOptions::default()).unwrap());
    let table: String = numbers.iter().map(|x| format!("a,{x}\n")).collect();
    check("a table", 1.2, || read_field(table.as_bytes(), &FieldReadOptions::default()).unwrap());
    let wide = format!("{0}\n{0}\n", numbers.join(","));
    check("all columns", 1.2, || read_table(table.as_bytes(), None).unwrap());
    let blanks = table.replace(',', " ");
    check("all columns between blanks", 1.2, || read_table(blanks.as_bytes(), None).unwrap());
    let first = FieldReadOptions { column: Some(Column::Number(0)), ..FieldReadOptions::default() };
    check("a table of many columns", 4.0, || read_field(wide.as_bytes(), &first).unwrap());
    check("all of many columns", 4.0, || read_table(wide.as_bytes(), None).unwrap());
}

/// Files of other programs, with bytes that are wrong: a few bytes must not ask for much.
#[test]
fn damaged_files_take_little_memory() {
    const SPARE: i64 = 64 << 20;
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/files");
    let mut state = 3_u64;
    let mut random = |end: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % end
    };
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        for round in 0..40 {
            let mut damaged = bytes.clone();
            for _ in 0..round % 4 {
                let place = random(if round % 2 == 0 { bytes.len() } else { bytes.len().min(400) });
                damaged[place] = random(256) as u8;
            }
            let most = 20 * bytes.len() as i64 + SPARE;
            let (_, mesh) = crate::usage(|| read_mesh(&damaged, &ReadOptions::default()).map(drop).ok());
            let (_, table) = crate::usage(|| read_table(&damaged, None).map(drop).ok());
            for usage in [mesh, table] {
                assert!(usage.peak.max(usage.ensured) <= most, "{path:?}: {} {}", usage.peak, usage.ensured);
            }
        }
    }
}
