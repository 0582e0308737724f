//! What only the options of the core are read by.

use js_sys::Function;

use crate::error::OptionError;
use crate::wasm::shared::record::{Entry, Record, is_absent};

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

    pub(in crate::wasm::core) fn function(&self, name: &str) -> Option<Function> {
        self.object(name, "a function")
    }

    /// Says that an entry decides which others there are and is wrong itself: nothing can be said of the others.
    pub(in crate::wasm::core) fn decisive(&self) {
        self.is_decisive.set(true);
    }

    /// Asks for options, by `fields`, that mean nothing here. That one of them is there is told before anything else.
    #[inline(never)]
    pub(in crate::wasm::core) fn foreign(&self, reason: &str, fields: &dyn Fn(&Self)) {
        let known: Vec<bool> = self.entries.iter().map(|entry| entry.is_known.get()).collect();
        let problem = self.problem.take();
        fields(self);
        self.problem.take();
        let is_foreign = |known: bool, entry: &Entry| !known && entry.is_known.get() && !is_absent(&entry.value);
        if let Some((entry, _)) = self.entries.iter().zip(known).find(|(entry, known)| is_foreign(*known, entry)) {
            self.inapplicable(&entry.name, reason);
        }
        if let Some(problem) = problem {
            self.refuse(problem);
        }
    }
}
