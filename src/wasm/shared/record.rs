//! Option objects, entry by entry: the code that serde writes for the same is larger to download.

use core::cell::{Cell, RefCell};

use js_sys::{Array, Object};
use wasm_bindgen::{JsCast, JsValue};

use crate::error::{Error, OptionError, Result};
use crate::support::named::Named;

/// Reads an options object: `fields` asks the record for every option that there is, by its name. `place` is the option that the
/// object is the value of, empty for the options themselves; errors say so. `undefined` and `null` leave everything to defaults.
///
/// # Errors
/// `InvalidArgument` for what is no object; `UnknownOption` for an entry that `fields` did not ask for; else the first thing wrong
/// that it came upon.
pub(in crate::wasm) fn read<T>(place: &'static str, value: &JsValue, fields: impl FnOnce(&Record) -> T) -> Result<T> {
    let record = Record::new(place, value)?;
    let options = fields(&record);
    record.finish()?;
    Ok(options)
}

/// Whether an option is left to its default.
pub(in crate::wasm) fn is_absent(value: &JsValue) -> bool {
    value.is_undefined() || value.is_null()
}

/// The entries of an object. What is wrong with one of them is told at the end.
pub(in crate::wasm) struct Record {
    place: &'static str,
    pub(in crate::wasm) entries: Vec<Entry>,
    pub(in crate::wasm) problem: RefCell<Option<Error>>,
    /// Whether the problem is told even where there are unknown entries, too.
    pub(in crate::wasm) is_decisive: Cell<bool>,
}

pub(in crate::wasm) struct Entry {
    pub(in crate::wasm) name: String,
    pub(in crate::wasm) value: JsValue,
    /// Whether it was asked for.
    pub(in crate::wasm) is_known: Cell<bool>,
}

impl Record {
    /// `src/js` hands plain objects, on which nothing of the caller's can run.
    #[inline(never)]
    fn new(place: &'static str, value: &JsValue) -> Result<Self> {
        let mut entries = Vec::new();
        if !is_absent(value) {
            if !value.is_object() || Array::is_array(value) || value.is_function() {
                let argument = if place.is_empty() { "options" } else { place };
                let expected = "an object".to_owned();
                return Err(OptionError::InvalidArgument { argument: argument.to_owned(), expected }.into());
            }
            for entry in Object::entries(value.unchecked_ref()).iter() {
                let entry: Array = entry.unchecked_into();
                let name = entry.get(0).as_string().unwrap_or_default();
                entries.push(Entry { name, value: entry.get(1), is_known: Cell::new(false) });
            }
        }
        Ok(Self { place, entries, problem: RefCell::new(None), is_decisive: Cell::new(false) })
    }

    #[inline(never)]
    fn finish(self) -> Result<()> {
        let unknown = self.entries.iter().find(|entry| !entry.is_known.get());
        match (self.problem.take(), unknown) {
            (Some(problem), unknown) if unknown.is_none() || self.is_decisive.get() => Err(problem),
            (_, Some(entry)) => Err(OptionError::UnknownOption { option: self.path(&entry.name) }.into()),
            (_, None) => Ok(()),
        }
    }

    pub(in crate::wasm) fn path(&self, name: &str) -> String {
        if self.place.is_empty() { name.to_owned() } else { format!("{}.{name}", self.place) }
    }

    /// Says that something is wrong. The first of several is told.
    #[inline(never)]
    pub(in crate::wasm) fn refuse(&self, problem: impl Into<Error>) {
        self.problem.borrow_mut().get_or_insert_with(|| problem.into());
    }

    /// The option takes something else.
    #[inline(never)]
    pub(in crate::wasm) fn invalid(&self, name: &str, expected: &str) {
        self.refuse(OptionError::invalid(&self.path(name), expected));
    }

    /// The entry, if it is there and not left to its default.
    #[inline(never)]
    pub(in crate::wasm) fn get(&self, name: &str) -> Option<&JsValue> {
        let entry = self.entries.iter().find(|entry| entry.name == name)?;
        entry.is_known.set(true);
        Some(&entry.value).filter(|value| !is_absent(value))
    }

    /// Whether the entry is there, without asking for it.
    pub(in crate::wasm) fn holds(&self, name: &str) -> bool {
        self.entries.iter().any(|entry| entry.name == name && !is_absent(&entry.value))
    }

    /// Whether the entry is there.
    pub(in crate::wasm) fn has(&self, name: &str) -> bool {
        self.get(name).is_some()
    }

    /// What `convert` makes of an entry, which is wrong if that is nothing.
    pub(in crate::wasm) fn read<T>(
        &self,
        name: &str,
        expected: &str,
        convert: impl FnOnce(&JsValue) -> Option<T>,
    ) -> Option<T> {
        let read = convert(self.get(name)?);
        if read.is_none() {
            self.invalid(name, expected);
        }
        read
    }

    pub(in crate::wasm) fn boolean(&self, name: &str) -> Option<bool> {
        self.read(name, "true or false", JsValue::as_bool)
    }

    pub(in crate::wasm) fn text(&self, name: &str) -> Option<String> {
        self.read(name, "a text in quotes", JsValue::as_string)
    }

    #[inline(never)]
    pub(in crate::wasm) fn number(&self, name: &str) -> Option<f64> {
        self.read(name, "a number", JsValue::as_f64)
    }

    #[inline(never)]
    pub(in crate::wasm) fn integer_of(&self, name: &str, expected: &str) -> Option<u32> {
        let is_whole = |x: &f64| x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(x);
        self.read(name, expected, |value| value.as_f64().filter(is_whole).map(|x| x as u32))
    }

    /// One of the choices, by its name.
    pub(in crate::wasm) fn choice<T: Named>(&self, name: &str) -> Option<T> {
        self.has(name).then(|| self.chosen(name))?
    }

    /// One of the choices, by its name, where none is the default.
    pub(in crate::wasm) fn chosen<T: Named>(&self, name: &str) -> Option<T> {
        let found = self.get(name).and_then(JsValue::as_string).and_then(|label| T::labelled(&label));
        if found.is_none() {
            self.no_choice(name, &mut T::CHOICES.iter().map(|choice| choice.label()));
        }
        found
    }

    #[inline(never)]
    fn no_choice(&self, name: &str, labels: &mut dyn Iterator<Item = &'static str>) {
        let labels: Vec<&str> = labels.collect();
        self.invalid(name, &format!("one of \"{}\"", labels.join("\", \"")));
    }

    /// An object of a class.
    pub(in crate::wasm) fn object<T: JsCast + Clone>(&self, name: &str, expected: &str) -> Option<T> {
        self.read(name, expected, |value| value.dyn_ref::<T>().cloned())
    }

    /// What is read of the entry by a function of its own.
    pub(in crate::wasm) fn part<T>(&self, name: &str, read: impl FnOnce(&JsValue) -> Result<T>) -> Option<T> {
        self.taken(read(self.get(name)?))
    }

    /// What was made of an entry; what went wrong is told.
    pub(in crate::wasm) fn taken<T>(&self, made: Result<T, impl Into<Error>>) -> Option<T> {
        made.map_err(|problem| self.refuse(problem)).ok()
    }
}
