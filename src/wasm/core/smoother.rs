//! The class behind `Smoother`, and `smooth`.

use js_sys::{Array, Float64Array, Object};
use wasm_bindgen::prelude::*;

use super::mesh::RawTriMesh;
use super::options::{ShortMethod, Smoothing, from_rule, smoother};
use super::reports;
use super::watching::Watching;
use crate::error::{OptionError, Result as Outcome};
use crate::smooth::{MethodName, Smoothed, Smoother};
use crate::support::watch::Watch;
use crate::wasm::shared::answer::Answer;
use crate::wasm::shared::arrays::floats;
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::read;

/// A smoother in wasm memory.
#[wasm_bindgen]
pub struct RawSmoother {
    smoother: Smoother,
}

impl RawSmoother {
    pub(super) fn smoother(&mut self) -> &mut Smoother {
        &mut self.smoother
    }
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawSmoother {
    #[wasm_bindgen(constructor)]
    pub fn new(mesh: &RawTriMesh, options: &JsValue) -> Result<Self, Thrown> {
        let (options, watching) = read("", options, |record| (smoother(record), Watching::read(record)))?;
        Ok(Self { smoother: watching.run(|watch| Smoother::watched(mesh.mesh(), options, watch))? })
    }

    /// Smooths by the method of that name.
    pub fn apply(&mut self, method: &str, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let method = MethodName::from_name(method).ok_or_else(|| OptionError::invalid("method", "a method's name"))?;
        let operator = self.smoother.options().operator;
        let (smoothing, watching) = read("", options, |record| {
            (Smoothing::read(record, method, operator).with_weights(record), Watching::read(record))
        })?;
        Ok(watching.run(|watch| run(&mut self.smoother, &smoothing, watch, values))?)
    }
}

/// The short way: one smoother, one field.
#[wasm_bindgen]
pub fn smooth(mesh: &RawTriMesh, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
    let (options, smoothing, watching) = read("", options, |record| {
        let options = smoother(record);
        let default = if record.holds("constraints") { ShortMethod::LeastSquares } else { ShortMethod::Tikhonov };
        let method = record.choice("method").unwrap_or(default);
        let smoothing = Smoothing::read_with_default(record, method.method(), options.operator);
        record.foreign("the method does not have it", &|record| {
            for other in ShortMethod::ALL {
                Smoothing::read_with_default(record, other.method(), options.operator);
            }
        });
        (options, smoothing, Watching::read(record))
    })?;
    Ok(watching.run(|watch| {
        let mut smoother = Smoother::watched(mesh.mesh(), options, watch)?;
        run(&mut smoother, &smoothing, watch, values)
    })?)
}

fn run(smoother: &mut Smoother, smoothing: &Smoothing, watch: &Watch<'_>, values: &Float64Array) -> Outcome<Object> {
    let values = floats(values)?;
    let method = smoothing.method();
    let smoothed = match smoothing.rule() {
        None => smoother.apply(&values, &method, watch),
        Some(rule) => smoother.apply_chosen(&values, &method, rule, watch),
    };
    answer(&smoothed.map_err(from_rule)?)
}

pub(super) fn answer(smoothed: &Smoothed) -> Outcome<Object> {
    let reports: Array = smoothed.reports.iter().map(reports::smoothing).collect();
    let answer = Answer::new();
    answer.array("values", &smoothed.values);
    answer.set("report", &reports.get(0));
    answer.set("reports", &reports);
    if let Some(prescribed) = smoothed.reports.first().and_then(|report| report.prescribed.as_ref()) {
        reports::prescribed(&answer, prescribed);
    }
    Ok(answer.finish()?)
}
