//! The class behind `Smoother`, and `smooth`.

use js_sys::{Float64Array, Function, Object};
use wasm_bindgen::prelude::*;

use super::convert::{floats, object};
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::{
    BILATERAL, ConstraintInput, INTERPOLATE, LEAST_SQUARES, LOW_PASS, Method, SMOOTHER, TIKHONOV, from_rule, read,
    read_smooth,
};
use core::ops::ControlFlow;

use crate::error::Result;
use crate::smooth::{self, Smoothed, Smoother};
use crate::support::watch::{Progress, Watch};

/// A smoother in wasm memory.
#[wasm_bindgen]
pub struct RawSmoother {
    smoother: Smoother,
    on_progress: Option<Function>,
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawSmoother {
    #[wasm_bindgen(constructor)]
    pub fn new(mesh: &RawTriMesh, options: &JsValue) -> Result<Self, Thrown> {
        let input = read(options, &[SMOOTHER])?;
        let smoother = Smoother::new(mesh.mesh(), input.smoother()?)?;
        Ok(Self { smoother, on_progress: input.progress()? })
    }

    pub fn tikhonov(&mut self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[TIKHONOV])?.tikhonov(self.smoother.options().operator)?;
        Ok(result(&self.apply(values, &smooth::Method::Tikhonov(options))?))
    }

    pub fn interpolate(&mut self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let input = read(options, &[INTERPOLATE])?;
        let constraints = ConstraintInput::read(&input.constraints)?;
        let options = input.interpolate(&constraints)?;
        Ok(result(&self.apply(values, &smooth::Method::Interpolate(options)).map_err(from_rule)?))
    }

    #[wasm_bindgen(js_name = leastSquares)]
    #[allow(clippy::needless_pass_by_value, reason = "wasm-bindgen hands what may be missing over by value")]
    pub fn least_squares(
        &mut self,
        values: &Float64Array,
        options: &JsValue,
        weights: Option<Float64Array>,
    ) -> Result<Object, Thrown> {
        let input = read(options, &[LEAST_SQUARES])?;
        let constraints = ConstraintInput::read(&input.constraints)?;
        let weights = weights.as_ref().map(floats).transpose()?;
        let options = input.least_squares(&constraints, weights.as_deref())?;
        Ok(result(&self.apply(values, &smooth::Method::LeastSquares(options)).map_err(from_rule)?))
    }

    #[wasm_bindgen(js_name = lowPass)]
    pub fn low_pass(&mut self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[LOW_PASS])?.low_pass()?;
        Ok(result(&self.apply(values, &smooth::Method::LowPass(options))?))
    }

    pub fn bilateral(&mut self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[BILATERAL])?.bilateral()?;
        Ok(result(&self.apply(values, &smooth::Method::Bilateral(options))?))
    }
}

impl RawSmoother {
    fn apply(&mut self, values: &Float64Array, method: &smooth::Method<'_>) -> Result<Smoothed> {
        let mut tell = teller(self.on_progress.as_ref());
        self.smoother.apply(&floats(values)?, method, &Watch::new(&mut tell))
    }
}

/// The short way: one smoother, one field.
#[wasm_bindgen]
pub fn smooth(mesh: &RawTriMesh, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
    let (input, method) = read_smooth(options)?;
    let options = input.smoother()?;
    let on_progress = input.progress()?;
    let mut tell = teller(on_progress.as_ref());
    let watch = Watch::new(&mut tell);
    let values = floats(values)?;
    if method == Method::Tikhonov {
        let tikhonov = smooth::Method::Tikhonov(input.tikhonov(options.operator)?);
        return Ok(result(&Smoother::new(mesh.mesh(), options)?.apply(&values, &tikhonov, &watch)?));
    }
    let constraints = ConstraintInput::read(&input.constraints)?;
    let method = if method == Method::Interpolate {
        smooth::Method::Interpolate(input.interpolate(&constraints)?)
    } else {
        smooth::Method::LeastSquares(input.least_squares(&constraints, None)?)
    };
    Ok(result(&Smoother::new(mesh.mesh(), options)?.apply(&values, &method, &watch).map_err(from_rule)?))
}

/// Calls `{ phase, fraction }` back. What a callback throws is not ours: `src/js` hands callbacks that keep it.
fn teller(on_progress: Option<&Function>) -> impl FnMut(Progress) -> ControlFlow<()> {
    move |Progress { phase, fraction }| {
        if let Some(callback) = on_progress {
            let progress = Object::new();
            set(&progress, "phase", &JsValue::from_str(phase.name()));
            set(&progress, "fraction", &JsValue::from_f64(fraction));
            let _ = callback.call1(&JsValue::NULL, &progress);
        }
        ControlFlow::Continue(())
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
