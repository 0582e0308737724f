//! What only the options of pictures are read by.

use js_sys::{Array, Float64Array};
use wasm_bindgen::JsCast;

use crate::wasm::shared::record::Record;

impl Record {
    /// Takes entries for known that are not asked for.
    pub(super) fn ignore_others(&self) {
        self.entries.iter().for_each(|entry| entry.is_known.set(true));
    }

    /// So many numbers; `src/js` has made a `Float64Array` of them.
    pub(super) fn numbers<const N: usize>(&self, name: &str, expected: &str) -> Option<[f64; N]> {
        self.read(name, expected, |value| {
            let array = value.dyn_ref::<Float64Array>().filter(|array| array.length() as usize == N)?;
            let mut numbers = [0.0; N];
            array.copy_to(&mut numbers);
            Some(numbers)
        })
    }

    /// So many texts.
    pub(super) fn texts<const N: usize>(&self, name: &str, expected: &str) -> Option<[String; N]> {
        self.read(name, expected, |value| {
            let array = value.dyn_ref::<Array>()?;
            let texts: Option<Vec<String>> = array.iter().map(|text| text.as_string()).collect();
            texts?.try_into().ok()
        })
    }
}
