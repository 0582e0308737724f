//! Results as plain objects.

use core::cell::Cell;

use js_sys::{Object, Reflect};
use wasm_bindgen::prelude::*;

use super::reserve;
use crate::error::OutOfMemory;
use crate::support::memory;

/// The constructors of typed arrays, which copy what is in wasm memory; they throw where JavaScript has no memory for the copy.
#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = Float64Array)]
    type Doubles;
    #[wasm_bindgen(catch, constructor, js_class = "Float64Array")]
    fn new(values: &[f64]) -> Result<Doubles, JsValue>;

    #[wasm_bindgen(js_name = Float32Array)]
    type Singles;
    #[wasm_bindgen(catch, constructor, js_class = "Float32Array")]
    fn new(values: &[f32]) -> Result<Singles, JsValue>;

    #[wasm_bindgen(js_name = Uint32Array)]
    type Ids;
    #[wasm_bindgen(catch, constructor, js_class = "Uint32Array")]
    fn new(values: &[u32]) -> Result<Ids, JsValue>;

    #[wasm_bindgen(js_name = Uint8Array)]
    type Bytes;
    #[wasm_bindgen(catch, constructor, js_class = "Uint8Array")]
    fn new(values: &[u8]) -> Result<Bytes, JsValue>;

    #[wasm_bindgen(js_name = Int8Array)]
    type Signs;
    #[wasm_bindgen(catch, constructor, js_class = "Int8Array")]
    fn new(values: &[i8]) -> Result<Signs, JsValue>;
}

/// A typed array that can be made of values in wasm memory.
pub(in crate::wasm) trait Element: Copy {
    fn array(values: &[Self]) -> Result<JsValue, JsValue>;
}

macro_rules! elements {
    ($($element:ty => $array:ident),*) => {
        $(impl Element for $element {
            #[inline(never)]
            fn array(values: &[Self]) -> Result<JsValue, JsValue> {
                $array::new(values).map(JsValue::from)
            }
        })*
    };
}
elements!(f64 => Doubles, f32 => Singles, u32 => Ids, u8 => Bytes, i8 => Signs);

/// A copy in the memory of JavaScript.
///
/// # Errors
/// `OutOfMemory` where there is none.
pub(in crate::wasm) fn array<T: Element>(values: &[T]) -> Result<JsValue, OutOfMemory> {
    reserve::release();
    T::array(values).map_err(|_| OutOfMemory { bytes: size_of_val(values) as u64 })
}

/// A plain object that is being filled.
pub(in crate::wasm) struct Answer {
    object: Object,
    shortage: Cell<Option<OutOfMemory>>,
}

impl Answer {
    /// The work is done: what was set aside for its result is given back.
    pub(in crate::wasm) fn new() -> Self {
        reserve::release();
        Self { object: Object::new(), shortage: Cell::new(None) }
    }

    /// Sets a property, which cannot fail on a new object.
    #[inline(never)]
    pub(in crate::wasm) fn set(&self, name: &str, value: &JsValue) {
        let set = Reflect::set(&self.object, &JsValue::from_str(name), value);
        debug_assert!(set.is_ok(), "a new object takes properties");
    }

    #[inline(never)]
    pub(in crate::wasm) fn number(&self, name: &str, value: f64) {
        self.set(name, &JsValue::from_f64(value));
    }

    /// A number, or null.
    pub(in crate::wasm) fn optional(&self, name: &str, value: Option<f64>) {
        self.set(name, &value.map_or(JsValue::NULL, JsValue::from_f64));
    }

    pub(in crate::wasm) fn count(&self, name: &str, count: usize) {
        self.number(name, count as f64);
    }

    pub(in crate::wasm) fn text(&self, name: &str, text: &str) {
        self.set(name, &JsValue::from_str(text));
    }

    pub(in crate::wasm) fn flag(&self, name: &str, flag: bool) {
        self.set(name, &JsValue::from_bool(flag));
    }

    #[allow(clippy::needless_pass_by_value, reason = "a part that was handed over is not to be changed")]
    pub(in crate::wasm) fn part(&self, name: &str, part: Self) {
        self.shortage.set(self.shortage.take().or(part.shortage.take()));
        self.set(name, &part.object);
    }

    /// A typed array with these values.
    pub(in crate::wasm) fn array<T: Element>(&self, name: &str, values: &[T]) {
        match array(values) {
            Ok(copy) => self.set(name, &copy),
            Err(shortage) => self.shortage.set(Some(shortage)),
        }
    }

    /// A typed array with what `get` gives for every number below `count`.
    #[inline(never)]
    pub(in crate::wasm) fn column<T: Element>(&self, name: &str, count: usize, get: &dyn Fn(usize) -> T) {
        match memory::with_room(count) {
            Ok(mut values) => {
                values.extend((0..count).map(get));
                self.array(name, &values);
            }
            Err(shortage) => self.shortage.set(Some(shortage)),
        }
    }

    /// The object as it is, for what holds no arrays.
    pub(in crate::wasm) fn object(self) -> Object {
        debug_assert!(self.shortage.take().is_none(), "arrays can be too large");
        self.object
    }

    /// The object.
    ///
    /// # Errors
    /// `OutOfMemory` where an array could not be made.
    pub(in crate::wasm) fn finish(self) -> Result<Object, OutOfMemory> {
        self.shortage.take().map_or(Ok(self.object), Err)
    }
}
