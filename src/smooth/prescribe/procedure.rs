//! From a field to the smoothest one with the chosen extrema, step by step.

use std::sync::Arc;

use super::dual;
use super::extrema::{Chosen, chosen};
use super::incidence::{Optimum, Steps};
use super::interior;
use super::options::{ExtremumValues, PrescribeOptions, ResultRange};
use super::prominence;
use super::quadratic::Quadratic;
use super::representative::{Flooded, Representative, flooded, representative};
use super::steps::{self, GROUND, Step};
use crate::error::{Result, SmoothError};
use crate::field::{CriticalKind, DeltaOptions, ScalarField, VertexOrder, critical_points};
use crate::mesh::TriMesh;
use crate::smooth::channels::Channel;
use crate::smooth::input::Input;
use crate::smooth::methods::{Regularization, settings};
use crate::smooth::names::{MethodName, Route, UsedPrecision};
use crate::smooth::prescribed::{PrescribeRoute, PrescribedReport};
use crate::smooth::report::{About, Measures, Smoothed, SolverReport};
use crate::smooth::routes::RightHandSide;
use crate::smooth::run::{Found, Procedure, Solution, run, whole};
use crate::smooth::schedule::{Forecast, Schedule, Stages, Work};
use crate::smooth::system::{Matrices, RegularizedSystem, Square};
use crate::smooth::systems::Systems;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// The shares of smoothing, of finding steps, and of the interior-point method.
const STEPS: [(Phase, f64); 3] = [(Phase::Solve, 13.0), (Phase::Field, 3.0), (Phase::Factorization, 80.0)];
const MINIMIZING: [(Phase, f64); 2] = [(Phase::Solve, 1.0), (Phase::Factorization, 8.0)];
const PREVIEW: [(Phase, f64); 2] = [(Phase::Solve, 13.0), (Phase::Field, 3.0)];

/// Of other smoothed fields whose order is tried, ε times the one that is asked for.
const OTHER_EPSILONS: [f64; 2] = [0.125, 8.0];

/// What is left of a bound on all values for the chosen extrema, in margins: results are within it though steps may lack a tenth of one.
const INSIDE: f64 = 0.2;

/// The margin has at least so many steps of double precision at the values, so that rounding leaves it.
const STEPS_OF_DOUBLES: f64 = 16.0;

/// Smooths with prescribed extrema.
pub(in crate::smooth) fn start(
    input: &Input<'_>,
    systems: &mut Systems,
    options: &PrescribeOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Smoothed> {
    let operators = input.operators;
    let work = Work::Exact;
    let schedule = Schedule::new(&Forecast { rule: false, work, analysis: false, factorization: false, groups: 1 });
    let mut stages = schedule.stages(watch);
    let Regularization { about, unknowns, term } = options.functional.regularization(input, &mut stages)?;
    let system = systems.regularized(operators, &unknowns, &term, watch)?;
    let about = About { method: MethodName::Prescribe, constraints: None, ..about };
    let mut procedure = Prescribing { input, options, about: about.clone(), system, report: None };
    run(input, &about, &mut procedure, stages)
}

struct Prescribing<'a, 'b> {
    input: &'a Input<'b>,
    options: &'a PrescribeOptions<'a>,
    about: About,
    system: &'a mut RegularizedSystem,
    report: Option<PrescribedReport>,
}

/// A smoothed field.
struct Smooth {
    /// Normalised, and in the units of the input.
    x: Vec<f64>,
    values: Vec<f64>,
}

impl Procedure for Prescribing<'_, '_> {
    fn solve(&mut self, group: &[Channel], _is_first: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        let Some(channel) = group.first() else {
            return Ok(Found { solutions: Vec::new(), perturbation_factor: None });
        };
        if channel.range.length() <= 0.0 {
            return Err(SmoothError::ConstantField {}.into());
        }
        stages.begin(Phase::Solve, 0)?;
        let (solution, report) = self.prescribed(channel, stages.watch)?;
        self.report = Some(report);
        Ok(Found { solutions: vec![solution], perturbation_factor: None })
    }

    fn measures(&mut self, x: &[f64], f: &[f64]) -> Measures {
        let unknowns = self.system.unknowns();
        let moved: Vec<f64> = unknowns.iter().map(|&v| x[v as usize] - f[v as usize]).collect();
        let metric_norm = Some(self.system.mass().norm(&moved));
        Measures { metric_norm, prescribed: self.report.take(), ..Measures::default() }
    }
}

impl Prescribing<'_, '_> {
    fn mesh(&self) -> &TriMesh {
        &self.input.operators.mesh
    }

    fn epsilon(&self) -> f64 {
        self.options.functional.epsilon()
    }

    fn prescribed(&mut self, channel: &Channel, watch: &Watch<'_>) -> Result<(Solution, PrescribedReport)> {
        let n = self.mesh().vertex_count() as u64;
        memory::ensure(64 * n)?;
        let mut plan = watch.plan(if self.options.preview { &PREVIEW } else { &STEPS });
        plan.begin(0)?;
        let epsilon = self.epsilon();
        let smooth = self.smoothed(channel, epsilon, watch)?;
        plan.begin(0)?;
        let mesh = self.mesh().clone();
        let range = channel.range.length();
        let input = ScalarField::new(&mesh, &channel.values)?;
        let chosen = chosen(
            &self.options.extrema,
            self.options.complete,
            &input,
            &ScalarField::new(&mesh, &smooth.values)?,
            watch,
        )?;
        let first = flooded(&ScalarField::new(&mesh, &smooth.values)?, &chosen, range, watch)?;
        if self.options.preview {
            let preview = self.preview(&smooth, first, channel);
            plan.finish()?;
            return preview;
        }
        plan.begin(0)?;
        let exact = self.optimum(channel, &smooth, &chosen, first, watch)?;
        plan.finish()?;
        Ok(exact)
    }

    /// The field that the functional alone asks for.
    fn smoothed(&mut self, channel: &Channel, epsilon: f64, watch: &Watch<'_>) -> Result<Smooth> {
        let settings = settings(self.input.operators.options, false);
        let (work, analysis, factorization) = self.system.forecast(epsilon, settings);
        let schedule = Schedule::new(&Forecast { rule: false, work, analysis, factorization, groups: 1 });
        let mut stages = schedule.stages(watch);
        let mut solved = self.system.solve(core::slice::from_ref(channel), epsilon, settings, &mut stages)?;
        let x = solved.solutions.pop().map(|solution| solution.x).unwrap_or_default();
        let unknowns = Arc::clone(self.system.unknowns());
        let (x, values) = whole(self.input.operators, &self.about, channel, &unknowns, &x)?;
        Ok(Smooth { x, values })
    }

    /// The flooded field as it is.
    fn preview(&self, smooth: &Smooth, flooded: Flooded, channel: &Channel) -> Result<(Solution, PrescribedReport)> {
        let normalized = |value: &f64| (value - channel.range.min) / channel.range.length();
        let x: Vec<f64> = flooded.values.iter().map(normalized).collect();
        let unconstrained_energy = self.energy(channel, &smooth.x);
        let energy = self.energy(channel, &x);
        let report = PrescribedReport {
            minima: flooded.extrema.minima,
            maxima: flooded.extrema.maxima,
            unavoidable: flooded.unavoidable,
            energy,
            unconstrained_energy,
            least_slack: 1.0,
            margin: 0.0,
            gap: if energy > 0.0 { (1.0 - unconstrained_energy / energy).max(0.0) } else { 0.0 },
            iterations: 0,
            solves: 0,
            route: PrescribeRoute::Preview,
        };
        Ok((Solution::of_values(flooded.values, SolverReport::none(0)), report))
    }

    fn energy(&self, channel: &Channel, x: &[f64]) -> f64 {
        let matrices = self.system.matrices();
        let problem = matrices.problem(self.epsilon());
        let side = RightHandSide { field: matrices.restrict(&channel.normalized), offset: Vec::new() };
        problem.energy(&side, &matrices.restrict(x)) * problem.data().map_or(1.0, |data| data.scale())
    }
}

/// What the best field is looked for with.
struct Search<'a, 'b> {
    channel: &'a Channel,
    mesh: &'a TriMesh,
    quadratic: Quadratic<'b>,
    /// The smoothed field at the variables, with the kept values of extrema.
    start: Vec<f64>,
    /// The smoothed field on the whole mesh, normalised.
    smooth: &'a [f64],
    unconstrained_energy: f64,
    margin: f64,
    prominence: Option<f64>,
    range: ResultRange,
    /// The values at the chosen extrema that are kept, normalised.
    kept: Vec<(u32, f64)>,
}

/// A field that was found.
struct Candidate {
    optimum: Optimum,
    energy: f64,
    least_slack: f64,
    representative: Representative,
}

impl Prescribing<'_, '_> {
    /// The field of the least energy.
    fn optimum(
        &mut self,
        channel: &Channel,
        smooth: &Smooth,
        chosen: &Chosen,
        first: Flooded,
        watch: &Watch<'_>,
    ) -> Result<(Solution, PrescribedReport)> {
        let (epsilon, range) = (self.epsilon(), channel.range.length());
        let mesh = self.mesh().clone();
        let mut representatives = vec![representative(&mesh, first, watch)?];
        if self.options.representatives == 3 {
            for factor in OTHER_EPSILONS {
                let other = self.smoothed(channel, factor * epsilon, watch)?;
                let other = ScalarField::new(&mesh, &other.values)?;
                let other = flooded(&other, chosen, range, watch)?;
                representatives.push(representative(&mesh, other, watch)?);
            }
        }
        let matrices: Arc<Matrices> = Arc::clone(self.system.matrices());
        let square: Square = self.system.square(epsilon, watch)?;
        let mut quadratic = Quadratic::new(mesh.connectivity(), &matrices, epsilon, channel, &smooth.x, square, watch)?;
        let mut start: Vec<f64> = quadratic.vertices.iter().map(|&v| smooth.x[v as usize]).collect();
        let unconstrained_energy = quadratic.energy(&start);
        let mut kept = Vec::new();
        if self.options.values == ExtremumValues::Keep {
            kept.extend(chosen.all().into_iter().map(|v| (v, channel.normalized[v as usize])));
            kept.sort_unstable_by_key(|&(v, _)| v);
            keep(&mut quadratic, &kept, &mut start, watch)?;
            // The order of the vertices is that of the smoothest field with these values; and where that is impossible, of the input.
            let values = channel_values(channel, &quadratic.vertices, &start, &kept);
            representatives.clear();
            for values in [&values, &channel.values] {
                let flooded = flooded(&ScalarField::new(&mesh, values)?, chosen, range, watch)?;
                representatives.push(representative(&mesh, flooded, watch)?);
            }
        }
        let largest = channel.range.min.abs().max(channel.range.max.abs());
        let margin = self.options.margin.max(STEPS_OF_DOUBLES * (largest.next_up() - largest) / range);
        let mut search = Search {
            channel,
            mesh: &mesh,
            quadratic,
            start,
            smooth: &smooth.x,
            unconstrained_energy,
            margin,
            prominence: self.options.prominence,
            range: self.options.range,
            kept,
        };
        let best = search.best(representatives, self.options, watch)?;
        let told = search.told(best, watch)?;
        if let Some(factor) = search.quadratic.into_system_factor() {
            self.system.keep_factor(epsilon, factor);
        }
        Ok(told)
    }
}

impl Search<'_, '_> {
    /// The best of what the representatives lead to. Where values are kept, the first one that leads anywhere.
    fn best(
        &mut self,
        representatives: Vec<Representative>,
        options: &PrescribeOptions<'_>,
        watch: &Watch<'_>,
    ) -> Result<Candidate> {
        let keeps = !self.kept.is_empty();
        let rounds = if keeps { 1 } else { representatives.len() } + usize::from(options.again);
        let shares = vec![(Phase::Factorization, 1.0); rounds];
        let mut plan = watch.plan(&shares);
        let mut best: Option<Candidate> = None;
        let mut failure = None;
        for representative in representatives {
            if keeps && best.is_some() {
                break;
            }
            if failure.is_none() {
                plan.begin(0)?;
            }
            match self.candidate(representative, watch) {
                Ok(candidate) if best.as_ref().is_none_or(|best| candidate.energy < best.energy) => {
                    best = Some(candidate);
                }
                Ok(_) => {}
                Err(crate::error::Error::Smooth(error @ SmoothError::Infeasible { .. })) => {
                    failure.get_or_insert(error);
                }
                Err(error) => return Err(error),
            }
        }
        let Some(mut best) = best else {
            return Err(failure.unwrap_or(SmoothError::NotConverged { iterations: 0, residual: f64::NAN }).into());
        };
        if options.again {
            plan.begin(0)?;
            let heights = self.values(&best.optimum.x);
            let again = self.candidate(Representative { heights, ..best.representative.clone() }, watch)?;
            if again.energy < best.energy {
                best = again;
            }
        }
        plan.finish()?;
        Ok(best)
    }

    /// The field of the least energy that rises as a representative does.
    fn candidate(&mut self, representative: Representative, watch: &Watch<'_>) -> Result<Candidate> {
        let order = VertexOrder::of_checked(&representative.heights);
        let extrema = &representative.extrema;
        let mut steps = steps::steps(self.mesh.connectivity(), order, extrema, self.margin, watch)?;
        if let Some(prominence) = self.prominence {
            let unavoidable = &representative.unavoidable;
            let wish = prominence::Wish { prominence, margin: self.margin, smooth: self.smooth, unavoidable };
            prominence::raise(&mut steps, self.mesh.connectivity(), order, &wish, watch)?;
        }
        if self.range == ResultRange::Input {
            let inside = INSIDE * self.margin;
            steps.extend(extrema.minima.iter().map(|&to| Step { from: GROUND, to, least: inside }));
            steps.extend(extrema.maxima.iter().map(|&from| Step { from, to: GROUND, least: inside - 1.0 }));
        }
        if self.range == ResultRange::Input || !self.kept.is_empty() {
            let kept = |v: u32| {
                let place = self.kept.binary_search_by_key(&v, |&(v, _)| v);
                place.ok().map(|place| self.kept[place].1)
            };
            steps::check(&steps, order, &kept, watch)?;
        }
        self.to_variables(&mut steps);
        let steps = Steps::new(steps, &self.quadratic)?;
        let optimum = self.minimize(&steps, watch)?;
        let energy = self.quadratic.energy(&optimum.x);
        let least_slack = steps.least_slack(&optimum.x);
        Ok(Candidate { optimum, energy, least_slack, representative })
    }

    /// By the factor of the functional alone where few steps bind, and with as many factors as it takes where many do.
    fn minimize(&mut self, steps: &Steps, watch: &Watch<'_>) -> Result<Optimum> {
        let mut plan = watch.plan(&MINIMIZING);
        plan.begin(0)?;
        let optimum = match dual::minimize(&mut self.quadratic, steps, &self.start, watch)? {
            Some(optimum) => optimum,
            None => {
                plan.begin(0)?;
                interior::minimize(&mut self.quadratic, steps, &self.start, self.unconstrained_energy, watch)?
            }
        };
        plan.finish()?;
        Ok(optimum)
    }

    /// Names variables where vertices are named.
    fn to_variables(&self, steps: &mut [Step]) {
        let vertices = &self.quadratic.vertices;
        if vertices.len() == self.mesh.vertex_count() {
            return;
        }
        let place = |v: u32| vertices.binary_search(&v).map_or(GROUND, |place| place as u32);
        for step in steps {
            (step.from, step.to) = (place(step.from), place(step.to));
        }
    }

    /// Variables as values in the units of the input.
    fn values(&self, x: &[f64]) -> Vec<f64> {
        channel_values(self.channel, &self.quadratic.vertices, x, &self.kept)
    }

    /// The result with what is told of it, after its extrema have been looked at once more.
    fn told(&self, best: Candidate, watch: &Watch<'_>) -> Result<(Solution, PrescribedReport)> {
        let Candidate { optimum, energy, least_slack, representative } = best;
        let Representative { extrema, unavoidable, .. } = representative;
        let values = self.values(&optimum.x);
        let points = critical_points(&ScalarField::new(self.mesh, &values)?, &DeltaOptions::default(), watch)?.points;
        let of_kind = |kind: CriticalKind| -> Vec<u32> {
            points.iter().filter(|point| point.kind == kind).map(|point| point.vertex).collect()
        };
        if of_kind(CriticalKind::Minimum) != extrema.minima || of_kind(CriticalKind::Maximum) != extrema.maxima {
            return Err(SmoothError::NotConverged { iterations: optimum.iterations, residual: optimum.gap }.into());
        }
        let scale = self.quadratic.scale();
        let report = PrescribedReport {
            minima: extrema.minima,
            maxima: extrema.maxima,
            unavoidable,
            energy: energy * scale,
            unconstrained_energy: self.unconstrained_energy * scale,
            least_slack,
            margin: self.margin,
            gap: optimum.gap,
            iterations: optimum.iterations,
            solves: optimum.solves,
            route: optimum.route,
        };
        let solver = SolverReport {
            route: Route::Cholesky,
            precision: UsedPrecision::Double,
            unknowns: self.quadratic.vertices.len(),
            factor_nonzeros: self.quadratic.factor_nonzeros(),
            relative_residual: optimum.unbalanced,
            refinement_steps: 0,
            iterations: optimum.iterations,
        };
        Ok((Solution::of_values(values, solver), report))
    }
}

/// Fixes the values that are kept, and finds the smoothest field that has them.
fn keep(quadratic: &mut Quadratic<'_>, kept: &[(u32, f64)], start: &mut [f64], watch: &Watch<'_>) -> Result<()> {
    let mut is_fixed = vec![false; start.len()];
    for &(v, value) in kept {
        if let Ok(place) = quadratic.vertices.binary_search(&v) {
            is_fixed[place] = true;
            start[place] = value;
        }
    }
    quadratic.fix(is_fixed);
    quadratic.factor(&|_| {}, watch)?;
    let mut right = quadratic.minus_gradient(start);
    quadratic.clear_fixed(&mut right);
    let change = quadratic.solve(&right, watch)?;
    start.iter_mut().zip(change).for_each(|(x, d)| *x += d);
    Ok(())
}

/// Normalised values of some vertices in the units of the input. Other vertices, and those whose values are kept, have theirs.
fn channel_values(channel: &Channel, vertices: &[u32], x: &[f64], kept: &[(u32, f64)]) -> Vec<f64> {
    let mut values = channel.values.clone();
    for (&v, x) in vertices.iter().zip(x) {
        values[v as usize] = channel.range.min + channel.range.length() * x;
    }
    for &(v, _) in kept {
        values[v as usize] = channel.values[v as usize];
    }
    values
}
