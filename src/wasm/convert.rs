//! Typed arrays and plain objects. Arrays are copied both ways: a view of wasm memory dies when the memory grows.

use js_sys::{Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::JsValue;
#[cfg(feature = "wasm")]
use {super::error::set, crate::error::Diagnostic, js_sys::Object, nalgebra_sparse::CscMatrix, serde::Serialize};

use crate::error::SolveError;

#[inline(never)]
pub(super) fn floats(array: &Float64Array) -> Result<Vec<f64>, SolveError> {
    copied(array.length(), |copy| array.copy_to(copy))
}

#[inline(never)]
pub(super) fn ids(array: &Uint32Array) -> Result<Vec<u32>, SolveError> {
    copied(array.length(), |copy| array.copy_to(copy))
}

#[inline(never)]
pub(super) fn bytes(array: &Uint8Array) -> Result<Vec<u8>, SolveError> {
    copied(array.length(), |copy| array.copy_to(copy))
}

/// A copy of a typed array; out of memory is an error, not a trap.
pub(super) fn copied<T: Clone + Default>(length: u32, copy_to: impl FnOnce(&mut [T])) -> Result<Vec<T>, SolveError> {
    let mut copy = Vec::new();
    if copy.try_reserve_exact(length as usize).is_err() {
        return Err(SolveError::OutOfMemory { bytes: u64::from(length) * size_of::<T>() as u64 });
    }
    copy.resize(length as usize, T::default());
    // An array whose buffer was transferred has length 0, and JavaScript refuses to copy from it.
    if length > 0 {
        copy_to(&mut copy);
    }
    Ok(copy)
}

/// Whether an option is left to its default.
pub(super) fn is_absent(value: &JsValue) -> bool {
    value.is_undefined() || value.is_null()
}

/// A plain object; `None` becomes null.
#[cfg(feature = "wasm")]
pub(super) fn object(value: &impl Serialize) -> JsValue {
    let serializer = serde_wasm_bindgen::Serializer::new().serialize_missing_as_null(true);
    value.serialize(&serializer).unwrap_or(JsValue::NULL)
}

/// Diagnostics as an array of plain objects.
#[cfg(feature = "wasm")]
pub(super) fn diagnostics(warnings: &[Diagnostic]) -> JsValue {
    object(&warnings)
}

/// Compressed sparse columns as in the types.
#[cfg(feature = "wasm")]
#[inline(never)]
pub(super) fn sparse(matrix: &CscMatrix<f64>) -> JsValue {
    let narrow = |values: &[usize]| {
        let values: Vec<u32> = values.iter().map(|&v| v as u32).collect();
        Uint32Array::from(values.as_slice())
    };
    let object = Object::new();
    set(&object, "rows", &JsValue::from_f64(matrix.nrows() as f64));
    set(&object, "columns", &JsValue::from_f64(matrix.ncols() as f64));
    set(&object, "columnPointers", &narrow(matrix.col_offsets()));
    set(&object, "rowIndices", &narrow(matrix.row_indices()));
    set(&object, "values", &Float64Array::from(matrix.values()));
    object.into()
}
