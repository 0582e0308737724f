//! The option `weld`, of meshes and of files.

use super::record::{Record, read};
use crate::error::{Error, OptionError};
use crate::mesh::WeldOptions;

/// Whether and how vertices are welded: true, false or `{ tolerance }`.
pub(in crate::wasm) fn weld(record: &Record) -> Option<WeldOptions> {
    let value = record.get("weld")?;
    match value.as_bool() {
        Some(welds) => welds.then(WeldOptions::default),
        None if value.is_object() => record.part("weld", |value| {
            read("weld", value, |record| WeldOptions { tolerance: record.number("tolerance").unwrap_or_default() })
        }),
        None => {
            record.invalid("weld", "true, false or { tolerance }");
            None
        }
    }
}

/// Says where the option stands that welding refuses.
pub(in crate::wasm) fn from_weld(error: Error) -> Error {
    match error {
        Error::Option(OptionError::InvalidOption { option, expected }) if option == "tolerance" => {
            OptionError::invalid("weld.tolerance", &expected).into()
        }
        other => other,
    }
}
