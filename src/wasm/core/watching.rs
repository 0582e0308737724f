//! `onProgress`: telling the caller how far the work is, and hearing that it is to stop.

use core::ops::ControlFlow;

use js_sys::Function;
use wasm_bindgen::JsValue;

use crate::support::watch::{Progress, Watch};
use crate::wasm::shared::record::Record;

/// Who is told of the progress of a call, if anybody is.
pub(super) struct Watching(Option<Function>);

impl Watching {
    /// `src/js` hands a function of its own, which keeps what the caller's throws, and returns `false` then.
    pub(super) fn read(record: &Record) -> Self {
        Self(record.function("onProgress"))
    }

    /// Does work that the caller watches.
    pub(super) fn run<T>(&self, work: impl FnOnce(&Watch<'_>) -> T) -> T {
        let mut tell = |progress| self.tell(progress);
        work(&Watch::new(&mut tell))
    }

    #[inline(never)]
    fn tell(&self, progress: Progress) -> ControlFlow<()> {
        let Some(callback) = &self.0 else { return ControlFlow::Continue(()) };
        let (phase, fraction) = (JsValue::from_str(progress.phase.name()), JsValue::from_f64(progress.fraction));
        match callback.call2(&JsValue::NULL, &phase, &fraction) {
            Ok(answer) if answer != JsValue::FALSE => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    }
}
