//! `readMesh`, `readField`, `writeMesh`.

use js_sys::{Array, Float64Array, Object, Uint8Array};
use wasm_bindgen::prelude::*;

use super::mesh::{RawTriMesh, from_weld, weld};
use super::reports;
use crate::error::{FieldError, OptionError};
use crate::field::Missing;
use crate::io::{self, Column, FieldReadOptions, MeshFormat, ReadOptions, WriteOptions};
use crate::load::{LoadOptions, load};
use crate::wasm::shared::answer::{Answer, array};
use crate::wasm::shared::arrays::{bytes, floats};
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};

/// Reads a mesh file into `{ mesh, fields, format, warnings }`.
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh(file: &Uint8Array, options: &JsValue) -> Result<Object, Thrown> {
    let options = read("", options, |record| {
        let read = ReadOptions { format: record.choice("format"), file_name: record.text("fileName") };
        LoadOptions { read, weld: weld(record) }
    })?;
    let loaded = load(&bytes(file)?, &options).map_err(from_weld)?;
    let answer = Answer::new();
    let fields = Array::new();
    for (name, values) in &loaded.fields {
        fields.push(&Array::of2(&JsValue::from_str(name), &array(values)?));
    }
    // Not by assignment, which takes the name `__proto__` for something else.
    answer.set("fields", &Object::from_entries(&fields).unwrap_or_default());
    answer.set("mesh", &RawTriMesh::wrap(loaded.mesh, loaded.vertex_map).into());
    answer.text("format", loaded.format.name());
    answer.set("warnings", &reports::diagnostics(&loaded.warnings));
    Ok(answer.finish()?)
}

/// Reads one field.
#[wasm_bindgen(js_name = readField)]
pub fn read_field(file: &Uint8Array, options: &JsValue) -> Result<JsValue, Thrown> {
    let options =
        read("", options, |record| FieldReadOptions { format: record.choice("format"), column: column(record) })?;
    let values = io::read_field(&bytes(file)?, &options)?;
    // What is not a number is missing; whoever uses the field says what becomes of it.
    if let Some(vertex) = values.iter().position(|value| value.is_infinite()) {
        return Err(FieldError::NonFiniteValue { vertex: vertex as u32 }.into());
    }
    Ok(array(&values)?)
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
pub fn write_mesh(mesh: &RawTriMesh, options: &JsValue) -> Result<JsValue, Thrown> {
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
    let mesh = mesh.mesh();
    let missing = match missing {
        Missing::Error => false,
        Missing::Omit => true,
        Missing::Fill => {
            let reason = "only smoothing can fill in missing values".to_owned();
            return Err(OptionError::InapplicableOption { option: "missing".to_owned(), reason }.into());
        }
    };
    let options = WriteOptions { format, binary, missing };
    let written =
        io::write_mesh(mesh.positions(), mesh.connectivity().triangles().as_flattened(), &borrowed, &options)?;
    Ok(array(&written)?)
}
