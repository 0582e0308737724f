//! The functions of `morse-smooth/files`: bytes in, plain arrays out, and back.

use js_sys::{Array, Float64Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::error::{FieldError, MeshError, OptionError, OutOfMemory};
use crate::field::Missing;
use crate::io::{self, Column, ExpectedRows, FieldFormat, FieldReadOptions, MeshFormat, ReadOptions, WriteOptions};
use crate::load::{LoadOptions, load_arrays};
use crate::mesh;
use crate::wasm::shared::answer::{Answer, array};
use crate::wasm::shared::arrays::{bytes, floats, ids};
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};
use crate::wasm::shared::warnings::diagnostics;
use crate::wasm::shared::weld::{from_weld, weld};

/// Everything that can be read or written: `[{ name, extensions, reads, writes, description }]`.
#[must_use]
#[wasm_bindgen]
pub fn formats() -> Array {
    let list = io::formats().iter().map(|format| {
        let answer = Answer::new();
        answer.text("name", format.name);
        let extensions: Array = format.extensions.iter().map(|&ending| JsValue::from_str(ending)).collect();
        answer.set("extensions", &extensions);
        answer.flag("reads", format.reads);
        answer.flag("writes", format.writes);
        answer.text("description", format.description);
        answer.object()
    });
    list.collect()
}

/// Reads a mesh file into `{ positions, triangles, fields, triangleFields, vertexMap, format, warnings }`.
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh(file: &Uint8Array, options: &JsValue) -> Result<Object, Thrown> {
    let options = read("", options, |record| {
        let read = ReadOptions { format: record.choice("format"), file_name: record.text("fileName") };
        let triangle_fields = record.choice("triangleFields").unwrap_or_default();
        LoadOptions { read, weld: weld(record), triangle_fields }
    })?;
    let loaded = load_arrays(&bytes(file)?, &options).map_err(from_weld)?;
    let answer = Answer::new();
    answer.array("positions", &loaded.positions);
    answer.array("triangles", &loaded.triangles);
    answer.set("fields", &by_name(&loaded.fields)?.into());
    answer.set("triangleFields", &by_name(&loaded.triangle_fields)?.into());
    match &loaded.file_vertices {
        Some(map) => answer.array("vertexMap", map),
        None => answer.set("vertexMap", &JsValue::NULL),
    }
    answer.text("format", loaded.format.name());
    answer.set("warnings", &diagnostics(&loaded.warnings));
    Ok(answer.finish()?)
}

/// Arrays under their names.
fn by_name(fields: &[(String, Vec<f64>)]) -> Result<Object, OutOfMemory> {
    let entries = Array::new();
    for (name, values) in fields {
        entries.push(&Array::of2(&JsValue::from_str(name), &array(values)?));
    }
    // Not by assignment, which takes the name `__proto__` for something else.
    Ok(Object::from_entries(&entries).unwrap_or_default())
}

/// Reads one field.
#[wasm_bindgen(js_name = readField)]
pub fn read_field(file: &Uint8Array, options: &JsValue) -> Result<JsValue, Thrown> {
    let options = read("", options, |record| {
        let vertices = record.integer_of("vertices", "the number of vertices");
        let triangles = record.integer_of("triangles", "the number of triangles").map(u64::from);
        let expected = vertices.map(|vertices| ExpectedRows { vertices: u64::from(vertices), triangles });
        FieldReadOptions { format: format(record), column: column(record), expected }
    })?;
    let values = io::read_field(&bytes(file)?, &options)?;
    // What is not a number is missing; whoever uses the field says what becomes of it.
    if let Some(vertex) = values.iter().position(|value| value.is_infinite()) {
        return Err(FieldError::NonFiniteValue { vertex: vertex as u32 }.into());
    }
    Ok(array(&values)?)
}

/// Reads all columns of a table: `{ columns, warnings }`.
#[wasm_bindgen(js_name = readTable)]
pub fn read_table(file: &Uint8Array, options: &JsValue) -> Result<Object, Thrown> {
    let format = read("", options, format)?;
    let table = io::read_table(&bytes(file)?, format)?;
    let answer = Answer::new();
    answer.set("columns", &by_name(&table.columns)?.into());
    answer.set("warnings", &diagnostics(&table.warnings));
    Ok(answer.finish()?)
}

/// The format of a field or a table. A file name tells something only if it ends in `.csv`: texts of all kinds end in `.txt`.
fn format(record: &Record) -> Option<FieldFormat> {
    let name = record.text("fileName").unwrap_or_default();
    let is_csv = name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("csv"));
    record.choice("format").or(is_csv.then_some(FieldFormat::Csv))
}

/// A column by its name or its number.
fn column(record: &Record) -> Option<Column> {
    match record.get("column")?.as_string() {
        Some(name) => Some(Column::Name(name)),
        None => record.integer_of("column", "a name or a number from 0").map(|number| Column::Number(number as usize)),
    }
}

/// Writes a mesh; `fields` of the options holds `Float64Array`s by name.
#[wasm_bindgen(js_name = writeMesh)]
pub fn write_mesh(positions: &Float64Array, triangles: &Uint32Array, options: &JsValue) -> Result<JsValue, Thrown> {
    let (format, binary, missing, fields) = read("", options, |record| {
        let format = record.chosen("format").unwrap_or(MeshFormat::Ply);
        let fields = record.object::<Object>("fields", "an object of arrays by name");
        let missing = record.choice("missing").unwrap_or_default();
        (format, record.boolean("binary").unwrap_or_default(), missing, fields)
    })?;
    let mut named = Vec::new();
    for entry in fields.iter().flat_map(|fields| Object::entries(fields).to_vec()) {
        let entry: Array = entry.unchecked_into();
        let name = entry.get(0).as_string().unwrap_or_default();
        let expected = "arrays of numbers";
        let values = entry.get(1).dyn_into::<Float64Array>().map_err(|_| OptionError::invalid("fields", expected))?;
        named.push((name, floats(&values)?));
    }
    let borrowed: Vec<(&str, &[f64])> = named.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    let missing = match missing {
        Missing::Error => false,
        Missing::Omit => true,
        Missing::Fill => {
            let reason = "only smoothing can fill in missing values".to_owned();
            return Err(OptionError::InapplicableOption { option: "missing".to_owned(), reason }.into());
        }
    };
    let (positions, triangles) = (floats(positions)?, ids(triangles)?);
    mesh::check_arrays(&positions, &triangles)?;
    if positions.is_empty() || triangles.is_empty() {
        return Err(MeshError::EmptyMesh { vertices: positions.len() / 3, triangles: triangles.len() / 3 }.into());
    }
    let options = WriteOptions { format, binary, missing };
    Ok(array(&io::write_mesh(&positions, &triangles, &borrowed, &options)?)?)
}
