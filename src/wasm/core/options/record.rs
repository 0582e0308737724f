//! What only the options of the core are read by.

use js_sys::Function;
use wasm_bindgen::JsValue;

use crate::error::OptionError;
use crate::support::named::Named;
use crate::wasm::shared::record::{Record, is_absent};

impl Record {
    /// The option means nothing here.
    #[inline(never)]
    pub(in crate::wasm::core) fn inapplicable(&self, name: &str, reason: &str) {
        self.refuse(OptionError::InapplicableOption { option: self.path(name), reason: reason.to_owned() });
    }

    /// A number that has no default.
    #[inline(never)]
    pub(in crate::wasm::core) fn given(&self, name: &str, expected: &str) -> f64 {
        if !self.has(name) {
            self.invalid(name, expected);
        }
        self.number(name).unwrap_or_default()
    }

    #[inline(never)]
    pub(in crate::wasm::core) fn integer(&self, name: &str) -> Option<u32> {
        self.integer_of(name, "an integer from 0 to 4294967295")
    }

    /// An integer that has no default.
    #[inline(never)]
    pub(in crate::wasm::core) fn given_integer(&self, name: &str, expected: &str) -> usize {
        if !self.has(name) {
            self.invalid(name, expected);
        }
        self.integer(name).unwrap_or_default() as usize
    }

    /// One of the choices, by its name.
    pub(in crate::wasm::core) fn choice<T: Named>(&self, name: &str) -> Option<T> {
        self.has(name).then(|| self.chosen(name))?
    }

    /// One of the choices, by its name, where none is the default.
    pub(in crate::wasm::core) fn chosen<T: Named>(&self, name: &str) -> Option<T> {
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

    pub(in crate::wasm::core) fn function(&self, name: &str) -> Option<Function> {
        self.object(name, "a function")
    }

    /// Says that an entry decides which others there are and is wrong itself: nothing can be said of the others.
    pub(in crate::wasm::core) fn decisive(&self) {
        self.is_decisive.set(true);
    }

    /// Asks for options, by `fields`, that mean nothing here.
    #[inline(never)]
    pub(in crate::wasm::core) fn foreign(&self, reason: &str, fields: &dyn Fn(&Self)) {
        let known: Vec<bool> = self.entries.iter().map(|entry| entry.is_known.get()).collect();
        let problem = self.problem.take();
        fields(self);
        self.problem.replace(problem);
        for (entry, known) in self.entries.iter().zip(known) {
            if !known && entry.is_known.get() && !is_absent(&entry.value) {
                self.inapplicable(&entry.name, reason);
            }
        }
    }
}
