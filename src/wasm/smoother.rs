//! The class behind `Smoother`, and `smooth`.

use js_sys::{Float64Array, Function, Object};
use wasm_bindgen::prelude::*;

use super::convert::{floats, object};
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::{SMOOTHER, TIKHONOV, read, read_smooth};
use crate::smooth::{Phase, Smoothed, Smoother};

/// A smoother in wasm memory.
#[wasm_bindgen]
pub struct RawSmoother {
    smoother: Smoother,
    on_progress: Option<Function>,
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/morse-smooth.d.ts")]
impl RawSmoother {
    #[wasm_bindgen(constructor)]
    pub fn new(mesh: &RawTriMesh, options: &JsValue) -> Result<Self, Thrown> {
        let input = read(options, &[SMOOTHER])?;
        let smoother = Smoother::new(mesh.mesh(), input.smoother()?)?;
        Ok(Self { smoother, on_progress: input.progress()? })
    }

    pub fn tikhonov(&mut self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[TIKHONOV])?.tikhonov(self.smoother.options().operator)?;
        let mut tell = teller(self.on_progress.as_ref());
        Ok(result(&self.smoother.tikhonov_with_progress(&floats(values)?, &options, &mut tell)?))
    }
}

/// The short way: one smoother, one field.
#[wasm_bindgen]
pub fn smooth(mesh: &RawTriMesh, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
    let input = read_smooth(options)?;
    let smoother = input.smoother()?;
    let tikhonov = input.tikhonov(smoother.operator)?;
    let on_progress = input.progress()?;
    let mut smoother = Smoother::new(mesh.mesh(), smoother)?;
    let mut tell = teller(on_progress.as_ref());
    Ok(result(&smoother.tikhonov_with_progress(&floats(values)?, &tikhonov, &mut tell)?))
}

/// Calls `{ phase, fraction }` back. What a callback throws is not ours: `src/js` hands callbacks that keep it.
fn teller(on_progress: Option<&Function>) -> impl FnMut(Phase, f64) {
    move |phase, fraction| {
        if let Some(callback) = on_progress {
            let progress = Object::new();
            set(&progress, "phase", &JsValue::from_str(phase.name()));
            set(&progress, "fraction", &JsValue::from_f64(fraction));
            let _ = callback.call1(&JsValue::NULL, &progress);
        }
    }
}

fn result(smoothed: &Smoothed) -> Object {
    let reports = object(&smoothed.reports);
    let result = Object::new();
    set(&result, "values", &Float64Array::from(smoothed.values.as_slice()));
    set(&result, "report", &js_sys::Reflect::get_u32(&reports, 0).unwrap_or(JsValue::NULL));
    set(&result, "reports", &reports);
    result
}
