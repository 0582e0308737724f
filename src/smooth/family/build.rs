//! Building a family: one shift after the other, each where the estimated error is largest.

use std::sync::Arc;

use super::estimate::{Calibration, PER_DECADE, logarithmic, margin};
use super::growth::{Growth, PROBES};
use super::members::{Family, Field, KeptGaps};
use super::options::FamilyOptions;
use super::reach::{counted, kernel};
use super::small::dot;
use super::space::{DERIVATIVES, Kind, Space};

use crate::error::{MeshError, OptionError, Result};
use crate::smooth::channels::TOGETHER;
use crate::smooth::input::Input;
use crate::smooth::method::{self, Masked, Method};
use crate::smooth::methods::settings;
use crate::smooth::operators::Operators;
use crate::smooth::report::About;
use crate::smooth::routes::{Accuracy, LARGE, Solutions, SolverSettings};
use crate::smooth::schedule::{Forecast, Schedule};
use crate::smooth::system::{Matrices, RegularizedSystem};
use crate::smooth::systems::Systems;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// Where rounding keeps a family from its tolerance, more shifts than these do not help.
const MOST_SHIFTS: usize = 16;
/// So many shifts are usual: memory is made sure of for them, and progress is told as if there were so many.
const USUAL_SHIFTS: usize = 9;
/// The share of the tolerance that the estimate after the first shift has to be below.
const FIRST: f64 = 1e-4;
/// A family that has not come to half of its least error after so many shifts gets no better.
const PATIENCE: usize = 5;
/// What making a shift's vectors orthogonal takes, beside the steps of a [`Schedule`].
const EXTENSION: f64 = 20.0;

impl Family {
    /// Makes a family, and lets it grow.
    pub(in crate::smooth) fn new(
        operators: &Arc<Operators>,
        systems: &mut Systems,
        masked: &mut Masked,
        values: &[f64],
        options: &FamilyOptions<'_>,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        options.check()?;
        let method = Method::from(options.method);
        let mut made = None;
        let make = &mut |input: &Input<'_>, systems: &mut Systems, method: &Method<'_>| {
            made = Some(start(input, systems, method, options, watch)?);
            Ok(())
        };
        let part = method::on_input(operators, systems, masked, values, &method, watch, make)?;
        let Some(mut family) = made else { return Err(MeshError::EmptyMesh { vertices: 0, triangles: 0 }.into()) };
        family.field.home = Arc::clone(operators);
        family.field.left_out = part.map(|part| (part, values.to_vec()));
        Ok(family)
    }

    /// Adds a shift; whether the family is complete.
    pub(in crate::smooth) fn grow(
        &mut self,
        operators: &Arc<Operators>,
        systems: &mut Systems,
        masked: &mut Masked,
        watch: &Watch<'_>,
    ) -> Result<bool> {
        if !Arc::ptr_eq(operators, &self.field.home) {
            return Err(OptionError::invalid("family", "a family of this smoother").into());
        }
        let systems = match &self.field.left_out {
            None => systems,
            Some((part, _)) => match masked.of_part(part) {
                Some(systems) => systems,
                None => &mut Systems::default(),
            },
        };
        grow(self, systems, watch)?;
        Ok(self.growth.is_complete)
    }
}

/// Makes a family of what a method smooths.
fn start(
    input: &Input<'_>,
    systems: &mut Systems,
    method: &Method<'_>,
    options: &FamilyOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Family> {
    let operators = input.operators;
    let n = operators.mesh.vertex_count() as u64;
    let count = input.channels.count();
    let most = options.factorizations.unwrap_or(MOST_SHIFTS).min(MOST_SHIFTS);
    let usual = most.min(USUAL_SHIFTS);
    // Per channel: its values, thrice; the basis with its images, and what a shift adds. For all: probes and solutions.
    let vectors = 2 * (1 + DERIVATIVES + 2) + 8;
    // What later shifts add, and what they take meanwhile, is kept for them in one piece: so the first factor shows whether there is room for
    // both, and what they leave is not cut up.
    let added = 2 * (1 + DERIVATIVES) * usual.saturating_sub(1) * count;
    let later = memory::hold(8 * n * (added + meanwhile(count)) as u64)?;
    memory::ensure(8 * n * ((vectors * count + 4 * TOGETHER + PROBES) as u64))?;
    let steps = vec![(Phase::Factorization, 1.0); usual];
    let mut plan = watch.plan(&steps);
    plan.begin(0)?;
    let regularization = {
        let schedule = Schedule::of_filter(1);
        method.regularization(input, &mut schedule.stages(watch))?
    };
    let system = systems.regularized(operators, &regularization.unknowns, &regularization.term, watch)?;
    let matrices = Arc::clone(system.matrices());
    let sigma = (options.range.0 * options.range.1).sqrt();
    let channels: Vec<_> = input.channels.groups(&operators.mesh).flat_map(|(_, group)| group).collect();
    let mut spaces = Vec::with_capacity(channels.len());
    for channel in &channels {
        let field = matrices.restrict(&channel.normalized);
        let mut space = Space::new(&matrices, field, counted(matrices.mass()), sigma);
        let kernel = kernel(space.field_mass(), &matrices, &operators.active);
        space.add(Kind::Kernel, vec![kernel], &matrices, watch)?;
        if !matrices.mass().has_gaps() {
            space.add(Kind::Field, vec![space.field().to_vec()], &matrices, watch)?;
        }
        spaces.push(space);
    }
    let field = Field {
        home: Arc::clone(operators),
        operators: Arc::clone(operators),
        about: About { epsilon: None, ..regularization.about },
        values: input.channels.to_interleaved(),
        channels,
        gaps: input.gaps.as_ref().map(|gaps| KeptGaps { missing: Arc::clone(&gaps.missing), part: gaps.part.cloned() }),
        left_out: None,
    };
    let growth = Growth::new(options.first(), options.tolerance, &matrices, &operators.active);
    let mut family = Family { field, matrices, range: options.range, growth, spaces };
    add_shift(&mut family, system, watch)?;
    drop(later);
    while !family.growth.is_complete && family.growth.shifts.len() < most {
        plan.begin(0)?;
        add_shift(&mut family, system, watch)?;
    }
    plan.finish()?;
    Ok(family)
}

/// Adds a shift to a family.
fn grow(family: &mut Family, systems: &mut Systems, watch: &Watch<'_>) -> Result<()> {
    if family.growth.is_complete {
        return Ok(());
    }
    let matrices = Arc::clone(&family.matrices);
    let system = systems.regularized(&family.field.operators, matrices.unknowns(), matrices.term(), watch)?;
    add_shift(family, system, watch)
}

/// Adds a shift where the error is largest, and estimates errors anew.
fn add_shift(family: &mut Family, system: &mut RegularizedSystem, watch: &Watch<'_>) -> Result<()> {
    let Family { field, matrices, range, growth, spaces } = family;
    let epsilon = growth.worst.0;
    let (n, count) = (matrices.unknowns().len() as u64, spaces.len());
    let dimension = spaces.iter().map(Space::dimension).max().unwrap_or(0) as u64 + 3;
    memory::ensure(8 * n * meanwhile(count) as u64 + 8 * dimension * dimension * (12 * count as u64 + 12))?;
    let full = SolverSettings { solutions: Solutions::Many, ..settings(field.operators.options, false) };
    let rough = SolverSettings { accuracy: Accuracy::Rough, ..full };
    let (work, analysis, factorization) = system.forecast(epsilon, full);
    let [first, next] = [true, false].map(|is_first| {
        let [analysis, factorization] = [analysis, factorization].map(|needed| needed && is_first);
        Schedule::new(&Forecast { rule: false, work, analysis, factorization, groups: 1 })
    });
    let steps = steps(&first, &next, spaces.len().div_ceil(TOGETHER));
    let mut plan = watch.plan(&steps);
    // The less memory is left, the fewer are solved for at once: beside a large factor the others take no time to speak of.
    let together = if n < LARGE as u64 { TOGETHER } else { 1 };
    // Whatever fails leaves the family as it was.
    let mut added: Vec<Vec<Vec<f64>>> = Vec::with_capacity(spaces.len());
    let mut traces: Vec<f64> = Vec::new();
    for group in spaces.chunks(TOGETHER) {
        let fields = group.iter().map(|space| space.field().to_vec()).collect();
        plan.begin(0)?;
        let schedule = if added.is_empty() { &first } else { &next };
        let solved = system.solve_fields(fields, epsilon, full, &mut schedule.stages(watch))?.solutions;
        let solutions: Vec<Vec<f64>> = solved.into_iter().map(|solution| solution.x).collect();
        // (S + εB)⁻¹εB of f − x, of that and so on, beside as many probes as cost nothing more.
        let mut rest: Vec<Vec<f64>> = solutions
            .iter()
            .zip(group)
            .map(|(x, space)| space.field().iter().zip(x).map(|(f, x)| f - x).collect())
            .collect();
        let mut of_spaces: Vec<Vec<Vec<f64>>> = solutions.into_iter().map(|x| vec![x]).collect();
        for _ in 0..DERIVATIVES {
            let first = traces.len();
            let probes = &growth.probes[first..PROBES.min(first + together.saturating_sub(rest.len()).max(1))];
            let right_hand_sides: Vec<Vec<f64>> = rest.iter().chain(probes).cloned().collect();
            plan.begin(0)?;
            let solved = system.solve_fields(right_hand_sides, epsilon, rough, &mut next.stages(watch))?.solutions;
            let mut solved: Vec<Vec<f64>> = solved.into_iter().map(|solution| solution.x).collect();
            traces.extend(probes.iter().zip(&solved[rest.len()..]).map(|(z, x)| dot(z, x)));
            solved.truncate(rest.len());
            of_spaces.iter_mut().zip(&solved).for_each(|(vectors, y)| vectors.push(y.clone()));
            rest = solved;
        }
        added.append(&mut of_spaces);
    }
    plan.begin(0)?;
    let kind = Kind::OfShift(growth.shifts.len());
    let before: Vec<usize> = spaces.iter().map(Space::dimension).collect();
    if let Err(error) = extend(spaces, added, kind, matrices, watch) {
        spaces.iter_mut().zip(before).for_each(|(space, dimension)| space.truncate(dimension));
        return Err(error);
    }
    growth.shifts.push(epsilon);
    growth.traces.push(traces.iter().sum::<f64>() / traces.len().max(1) as f64);
    growth.calibrations =
        spaces.iter().map(|space| Calibration::new(space, matrices, &growth.shifts, *range)).collect();
    let errors = logarithmic(*range, PER_DECADE).into_iter().map(|epsilon| (epsilon, growth.error(spaces, epsilon)));
    growth.worst = errors.fold((range.0, 0.0), |worst, error| if error.1 > worst.1 { error } else { worst });
    growth.least = match growth.least {
        (least, _) if growth.worst.1 < 0.5 * least => (growth.worst.1, 0),
        (least, ago) => (least, ago + 1),
    };
    // The first estimate rests on one place of the range alone: it has to be far below what is wanted.
    let (count, wanted) = (growth.shifts.len(), growth.tolerance);
    let is_good = margin(count) * growth.worst.1 <= if count > 1 { wanted } else { FIRST * wanted };
    growth.is_complete = is_good || growth.least.1 >= PATIENCE || count >= MOST_SHIFTS;
    if growth.is_complete {
        growth.probes = Vec::new();
        spaces.iter_mut().for_each(Space::finish);
    }
    Ok(())
}

/// The vectors that a shift takes while it is added: solutions; what is solved for together, or else their images and what makes them
/// orthogonal.
fn meanwhile(count: usize) -> usize {
    let added = 1 + DERIVATIVES;
    added * count + (added * (count + 4)).max(8 * count.min(TOGETHER) + 3 * TOGETHER)
}

/// The steps of a shift for so many groups of channels: a solution and its derivatives for each, and what makes them orthogonal.
fn steps(first: &Schedule, next: &Schedule, groups: usize) -> Vec<(Phase, f64)> {
    let mut steps = vec![(Phase::Solve, next.time()); ((1 + DERIVATIVES) * groups).saturating_sub(1)];
    steps.insert(0, (Phase::Factorization, first.time()));
    steps.push((Phase::Solve, EXTENSION * groups as f64));
    steps
}

/// Adds to every space what a shift gave for it.
fn extend(
    spaces: &mut [Space],
    added: Vec<Vec<Vec<f64>>>,
    kind: Kind,
    matrices: &Matrices,
    watch: &Watch<'_>,
) -> Result<()> {
    for (space, vectors) in spaces.iter_mut().zip(added) {
        space.add(kind, vectors, matrices, watch)?;
    }
    // One that cannot be projected leaves those of the others as they were, too.
    let projections = spaces.iter().map(Space::projections).collect::<Result<Vec<_>>>()?;
    spaces.iter_mut().zip(projections).for_each(|(space, projections)| space.project(projections));
    Ok(())
}
