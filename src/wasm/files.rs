//! `readMesh`, `readField`, `writeMesh`.

use js_sys::{Array, Float64Array, Object, Uint8Array};
use wasm_bindgen::prelude::*;

use super::convert::{bytes, diagnostics, floats};
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::{invalid, is_absent, read};
use crate::error::{FieldError, OptionError};
use crate::io::{self, Column, FieldFormat, FieldReadOptions, MeshFormat, ReadOptions, WriteOptions};
use crate::load::{LoadOptions, load};
use crate::mesh::WeldOptions;

fn mesh_format(name: Option<&str>) -> Result<Option<MeshFormat>, OptionError> {
    let expected = "the name of a mesh format, such as \"ply\"";
    name.map(|name| MeshFormat::from_name(name).ok_or_else(|| invalid("format", expected))).transpose()
}

/// Reads a mesh file into `{ mesh, fields, format, warnings }`.
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh(file: &Uint8Array, options: &JsValue) -> Result<Object, Thrown> {
    let input = read(options, &[&["format", "fileName", "weld"]])?;
    let read = ReadOptions { format: mesh_format(input.format.as_deref())?, file_name: input.file_name };
    let options = LoadOptions { read, weld: input.weld.unwrap_or(false).then(WeldOptions::default) };
    let loaded = load(&bytes(file)?, &options)?;
    let fields = Array::new();
    for (name, values) in &loaded.fields {
        fields.push(&Array::of2(&JsValue::from_str(name), &Float64Array::from(values.as_slice())));
    }
    // Not by assignment, which takes the name `__proto__` for something else.
    let fields = Object::from_entries(&fields).unwrap_or_default();
    let result = Object::new();
    set(&result, "mesh", &RawTriMesh::wrap(loaded.mesh).into());
    set(&result, "fields", &fields);
    set(&result, "format", &JsValue::from_str(loaded.format.name()));
    set(&result, "warnings", &diagnostics(&loaded.warnings));
    Ok(result)
}

/// Reads one field.
#[wasm_bindgen(js_name = readField)]
pub fn read_field(file: &Uint8Array, options: &JsValue) -> Result<Float64Array, Thrown> {
    let input = read(options, &[&["format", "column"]])?;
    let format = input
        .format
        .map(|name| FieldFormat::from_name(&name).ok_or_else(|| invalid("format", "\"txt\", \"csv\" or \"npy\"")))
        .transpose()?;
    let column = match (input.column.as_string(), input.column.as_f64()) {
        (Some(name), _) => Some(Column::Name(name)),
        (_, Some(number)) if number >= 0.0 && number.fract() == 0.0 && number <= f64::from(u32::MAX) => {
            Some(Column::Number(number as usize))
        }
        _ if is_absent(&input.column) => None,
        _ => return Err(invalid("column", "a name or a number from 0").into()),
    };
    let values = io::read_field(&bytes(file)?, &FieldReadOptions { format, column })?;
    if let Some(vertex) = values.iter().position(|value| !value.is_finite()) {
        return Err(FieldError::NonFiniteValue { vertex: vertex as u32 }.into());
    }
    Ok(Float64Array::from(values.as_slice()))
}

/// Writes a mesh; `fields` of the options holds `Float64Array`s by name.
#[wasm_bindgen(js_name = writeMesh)]
pub fn write_mesh(mesh: &RawTriMesh, options: &JsValue) -> Result<Uint8Array, Thrown> {
    let input = read(options, &[&["format", "binary", "fields"]])?;
    let Some(format) = mesh_format(input.format.as_deref())? else {
        return Err(invalid("format", "the name of a mesh format, such as \"ply\", and it has no default").into());
    };
    let mut fields = Vec::new();
    if let Some(object) = input.fields.dyn_ref::<Object>() {
        for entry in Object::entries(object).iter() {
            let entry: Array = entry.unchecked_into();
            let name = entry.get(0).as_string().unwrap_or_default();
            let values = entry.get(1).dyn_into::<Float64Array>().map_err(|_| invalid("fields", "arrays of numbers"))?;
            fields.push((name, floats(&values)?));
        }
    } else if !is_absent(&input.fields) {
        return Err(invalid("fields", "an object of arrays by name").into());
    }
    let borrowed: Vec<(&str, &[f64])> =
        fields.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    let mesh = mesh.mesh();
    let options = WriteOptions { format, binary: input.binary.unwrap_or(false) };
    let written =
        io::write_mesh(mesh.positions(), mesh.connectivity().triangles().as_flattened(), &borrowed, &options)?;
    Ok(Uint8Array::from(written.as_slice()))
}
