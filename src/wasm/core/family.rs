//! The class behind `SmoothingFamily`.

use js_sys::{Array, Float64Array, Object};
use wasm_bindgen::prelude::*;

use super::options::{FamilyChoice, epsilon_rule, from_rule};
use super::reports;
use super::smoother::{RawSmoother, answer};
use super::watching::Watching;
use crate::smooth::{ExtremumLife, Family, Sweep, SweepOptions};
use crate::wasm::shared::answer::{Answer, array};
use crate::wasm::shared::arrays::floats;
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};

/// A family in wasm memory.
#[wasm_bindgen]
pub struct RawFamily {
    family: Family,
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawSmoother {
    /// The fields of all ε. What a sweep will be asked for, if there is to be one, is looked at first.
    pub fn family(
        &mut self,
        values: &Float64Array,
        options: &JsValue,
        sweep: Option<Object>,
        epsilons: Option<Float64Array>,
    ) -> Result<RawFamily, Thrown> {
        let operator = self.smoother().options().operator;
        let (choice, watching) =
            read("", options, |record| (FamilyChoice::read(record, operator), Watching::read(record)))?;
        if let Some(sweep) = sweep {
            let (counts, channel) = read("", &sweep, of_sweep)?;
            let epsilons = epsilons.map(|epsilons| floats(&epsilons)).transpose()?;
            let asked = SweepOptions { epsilons: epsilons.as_deref(), counts, channel };
            choice.options().check()?;
            // That there are no channels at all is told where the values are read.
            asked.check(choice.options().range, choice.channels().max(1))?;
        }
        let values = floats(values)?;
        let family = watching.run(|watch| self.smoother().family(&values, &choice.options(), watch));
        Ok(RawFamily { family: family.map_err(from_rule)? })
    }

    /// Adds a shift to a family; whether it is complete.
    pub fn grow(&mut self, family: &mut RawFamily, options: &JsValue) -> Result<bool, Thrown> {
        let watching = read("", options, Watching::read)?;
        Ok(watching.run(|watch| self.smoother().grow(&mut family.family, watch))?)
    }
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawFamily {
    /// What can be told of it in a word.
    pub fn about(&self) -> Result<Object, Thrown> {
        let answer = Answer::new();
        let (least, largest) = self.family.range();
        answer.set("epsilonRange", &Array::of2(&least.into(), &largest.into()));
        answer.count("dimension", self.family.dimension());
        answer.count("factorizations", self.family.shifts().len());
        answer.array("shifts", self.family.shifts());
        answer.number("errorEstimate", self.family.error_estimate());
        answer.flag("complete", self.family.is_complete());
        Ok(answer.finish()?)
    }

    #[wasm_bindgen(js_name = errorAt)]
    pub fn error_at(&self, epsilon: f64) -> Result<f64, Thrown> {
        Ok(self.family.error_at(epsilon)?)
    }

    pub fn values(&self, epsilon: f64) -> Result<JsValue, Thrown> {
        Ok(array(&self.family.values(epsilon)?)?)
    }

    pub fn at(&self, epsilon: f64, options: &JsValue) -> Result<Object, Thrown> {
        let watching = read("", options, Watching::read)?;
        Ok(answer(&watching.run(|watch| self.family.at(epsilon, watch))?)?)
    }

    pub fn sweep(&self, epsilons: Option<Float64Array>, options: &JsValue) -> Result<Object, Thrown> {
        let ((counts, channel), watching) = read("", options, |record| (of_sweep(record), Watching::read(record)))?;
        let epsilons = epsilons.map(|epsilons| floats(&epsilons)).transpose()?;
        let options = SweepOptions { epsilons: epsilons.as_deref(), counts, channel };
        Ok(sweep(&watching.run(|watch| self.family.sweep(&options, watch))?)?)
    }

    pub fn choose(&self, rule: &JsValue, options: &JsValue) -> Result<Object, Thrown> {
        let rule = epsilon_rule("rule", rule)?;
        let watching = read("", options, Watching::read)?;
        Ok(reports::chosen(&watching.run(|watch| self.family.choose(rule, watch))?).object())
    }

    pub fn lives(&self, options: &JsValue) -> Result<Object, Thrown> {
        let (channel, per_decade, watching) = read("", options, |record| {
            let channel = record.integer("channel").unwrap_or_default() as usize;
            (channel, record.integer("perDecade").unwrap_or(8) as usize, Watching::read(record))
        })?;
        Ok(lives(&watching.run(|watch| self.family.lives(channel, per_decade, watch))?)?)
    }
}

/// Whether critical points are counted, and the channel.
fn of_sweep(record: &Record) -> (bool, usize) {
    (record.boolean("counts").unwrap_or_default(), record.integer("channel").unwrap_or_default() as usize)
}

fn sweep(sweep: &Sweep) -> Result<Object, crate::error::OutOfMemory> {
    let answer = Answer::new();
    answer.array("epsilons", &sweep.epsilons);
    answer.array("lInfinity", &sweep.l_infinity);
    answer.array("metricNorm", &sweep.metric_norm);
    answer.array("laplacianNorm", &sweep.laplacian_norm);
    answer.array("sobolev", &sweep.sobolev);
    answer.array("minima", &sweep.minima);
    answer.array("maxima", &sweep.maxima);
    answer.array("saddles", &sweep.saddles);
    answer.count("lCurveCorner", sweep.l_curve_corner);
    answer.finish()
}

fn lives(lives: &[ExtremumLife]) -> Result<Object, crate::error::OutOfMemory> {
    let answer = Answer::new();
    answer.column("kinds", lives.len(), &|k| if lives[k].is_maximum { 1_i8 } else { -1 });
    answer.column("firstVertices", lives.len(), &|k| lives[k].first_vertex);
    answer.column("lastVertices", lives.len(), &|k| lives[k].last_vertex);
    answer.column("largestEpsilons", lives.len(), &|k| lives[k].largest);
    answer.column("leastEpsilons", lives.len(), &|k| lives[k].least);
    answer.finish()
}
