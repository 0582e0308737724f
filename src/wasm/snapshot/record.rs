//! Option objects, entry by entry: the code that serde writes for the same is 7 kB more to download.

use js_sys::{Array, Float64Array, Object};
use wasm_bindgen::{JsCast, JsValue};

use crate::error::OptionError;
use crate::wasm::convert::is_absent;

/// The entries of an object that are not left to their defaults, which says in its errors where it stands.
pub(super) struct Record {
    /// The option that it is the value of; empty for the options themselves.
    place: &'static str,
    entries: Vec<(String, JsValue)>,
}

impl Record {
    /// `src/js` hands plain objects, on which nothing of the caller's can run.
    pub(super) fn new(place: &'static str, value: &JsValue) -> Result<Self, OptionError> {
        let mut entries = Vec::new();
        if !is_absent(value) {
            if !value.is_object() || Array::is_array(value) || value.is_function() {
                let argument = if place.is_empty() { "options" } else { place };
                let expected = "an object".to_owned();
                return Err(OptionError::InvalidArgument { argument: argument.to_owned(), expected });
            }
            for entry in Object::entries(value.unchecked_ref()).iter() {
                let entry: Array = entry.unchecked_into();
                entries.push((entry.get(0).as_string().unwrap_or_default(), entry.get(1)));
            }
        }
        Ok(Self { place, entries })
    }

    /// Refuses other names, whatever their values.
    pub(super) fn only(&self, known: &[&[&str]]) -> Result<(), OptionError> {
        let is_unknown = |name: &str| !known.iter().any(|names| names.contains(&name));
        let unknown = self.entries.iter().find(|(name, _)| is_unknown(name));
        unknown.map_or(Ok(()), |(name, _)| Err(OptionError::UnknownOption { option: self.path(name) }))
    }

    pub(super) fn get(&self, name: &str) -> Option<&JsValue> {
        let found = self.entries.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value).filter(|value| !is_absent(value))
    }

    /// The error for an option here.
    pub(super) fn invalid(&self, name: &str, expected: &str) -> OptionError {
        OptionError::invalid(&self.path(name), expected)
    }

    fn path(&self, name: &str) -> String {
        if self.place.is_empty() { name.to_owned() } else { format!("{}.{name}", self.place) }
    }

    /// What `convert` makes of an option, if it is there.
    fn read<T>(
        &self,
        name: &str,
        expected: &str,
        convert: impl FnOnce(&JsValue) -> Option<T>,
    ) -> Result<Option<T>, OptionError> {
        self.get(name).map(|value| convert(value).ok_or_else(|| self.invalid(name, expected))).transpose()
    }

    pub(super) fn boolean(&self, name: &str) -> Result<Option<bool>, OptionError> {
        self.read(name, "true or false", JsValue::as_bool)
    }

    pub(super) fn text(&self, name: &str) -> Result<Option<String>, OptionError> {
        self.read(name, "a text in quotes", JsValue::as_string)
    }

    pub(super) fn number(&self, name: &str) -> Result<Option<f64>, OptionError> {
        self.read(name, "a number", JsValue::as_f64)
    }

    pub(super) fn integer(&self, name: &str, expected: &str) -> Result<Option<u32>, OptionError> {
        let is_whole = |x: &f64| x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(x);
        self.read(name, expected, |value| value.as_f64().filter(is_whole).map(|x| x as u32))
    }

    /// So many numbers; `src/js` has made a `Float64Array` of them.
    pub(super) fn numbers<const N: usize>(&self, name: &str, expected: &str) -> Result<Option<[f64; N]>, OptionError> {
        self.read(name, expected, |value| {
            let array = value.dyn_ref::<Float64Array>().filter(|array| array.length() as usize == N)?;
            let mut numbers = [0.0; N];
            array.copy_to(&mut numbers);
            Some(numbers)
        })
    }

    /// So many texts.
    pub(super) fn texts<const N: usize>(&self, name: &str, expected: &str) -> Result<Option<[String; N]>, OptionError> {
        self.read(name, expected, |value| {
            let array = value.dyn_ref::<Array>()?;
            let texts: Option<Vec<String>> = array.iter().map(|text| text.as_string()).collect();
            texts?.try_into().ok()
        })
    }
}
