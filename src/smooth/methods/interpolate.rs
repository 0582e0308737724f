//! Interpolation of constrained values, eq. (6) of \[Patane09\].

use std::sync::Arc;

use super::regularized::solutions;
use super::{constrained, settings};
use crate::error::Result;
use crate::field::Missing;
#[cfg(doc)]
use crate::smooth::Smoother;
use crate::smooth::channels::Channel;
use crate::smooth::constraints::{Constraints, leave_out_constant_components};
use crate::smooth::input::Input;
use crate::smooth::maximum_principle::Certifier;
use crate::smooth::names::{Equation, MethodName};
use crate::smooth::operators::Operators;
use crate::smooth::report::{About, Measures, Smoothed};
use crate::smooth::run::{Found, Procedure, run};
use crate::smooth::schedule::{Forecast, Schedule, Stages, Work};
use crate::smooth::system::{ReducedSystem, Solved};
use crate::smooth::systems::Systems;
use crate::smooth::{Energy, bounds};
use crate::support::memory;
use crate::support::watch::Watch;

/// Options of [`Smoother::interpolate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolateOptions<'a> {
    /// Which vertices keep their values, to the last bit. Default none.
    pub constraints: Constraints<'a>,
    /// What is made least. Default harmonic.
    pub energy: Energy,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`. Default 1.
    pub channels: usize,
    /// What NaN means. Default an error.
    pub missing: Missing,
}

impl Default for InterpolateOptions<'_> {
    fn default() -> Self {
        Self {
            constraints: Constraints::default(),
            energy: Energy::default(),
            channels: 1,
            missing: Missing::default(),
        }
    }
}

pub(in crate::smooth) fn start(
    input: &Input<'_>,
    systems: &mut Systems,
    options: &InterpolateOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Smoothed> {
    let operators = input.operators;
    let is_squared = options.energy == Energy::Biharmonic || !operators.is_symmetric();
    let schedule = Schedule::new(&Forecast {
        rule: options.constraints.is_rule(),
        work: Work::expected(operators.options, operators.is_symmetric(), is_squared),
        analysis: true,
        factorization: true,
        groups: input.channels.group_count(),
    });
    let mut stages = schedule.stages(watch);
    let (set, components) = constrained(input, &options.constraints, &mut stages)?;
    let mut free = components.remaining(&operators.active);
    free.retain(|v| set.vertices.binary_search(v).is_err());
    let all_free = free.clone();
    let constant = leave_out_constant_components(&operators.active, &set, &mut free);
    let system = systems.reduced(operators, options.energy, &free, watch)?;
    let constrained = set.vertices.clone();
    let about = About {
        method: MethodName::Interpolate,
        equation: Equation::Interpolation,
        epsilon: None,
        constraints: Some(set),
        unconstrained: Some(components),
    };
    let mut procedure =
        Interpolation { operators, system, constrained, free: all_free.into(), constant, certifier: None };
    run(input, &about, &mut procedure, stages)
}

struct Interpolation<'a> {
    operators: &'a Operators,
    system: &'a mut ReducedSystem,
    /// The constrained vertices, ascending.
    constrained: Vec<u32>,
    /// All vertices that are free, ascending.
    free: Arc<[u32]>,
    /// The vertices of the largest component with a single constrained one, which are not solved for.
    constant: usize,
    /// For the harmonic energy, once a channel is solved for.
    certifier: Option<Certifier<'a>>,
}

impl Procedure for Interpolation<'_> {
    fn solve(&mut self, group: &[Channel], is_first: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        let settings = settings(self.operators.options, is_first);
        let solved = self.system.solve(&self.operators.laplacian, group, settings, stages)?;
        let factor = if settings.bounds { self.perturbation_factor(&solved) } else { None };
        let perturbation_factor = bounds::with_constants(factor, self.constant);
        if self.system.energy() == Energy::Harmonic && self.certifier.is_none() {
            let Operators { mesh, laplacian, .. } = self.operators;
            memory::ensure(2 * mesh.vertex_count() as u64 + 16 * laplacian.nnz() as u64)?;
            self.certifier = Some(Certifier::new(mesh.connectivity(), laplacian, &self.free));
        }
        Ok(Found { solutions: solutions(self.system.free(), solved), perturbation_factor })
    }

    fn measures(&mut self, x: &[f64], _: &[f64]) -> Measures {
        let certify = |certifier: &Certifier<'_>| certifier.certify(x);
        Measures { maximum_principle: self.certifier.as_ref().map(certify), ..Measures::default() }
    }
}

impl Interpolation<'_> {
    fn perturbation_factor(&self, solved: &Solved) -> Option<f64> {
        if self.system.free().is_empty() {
            return Some(1.0);
        }
        let eigenvalue = solved.smallest_eigenvalue;
        let singular_value = if self.system.is_squared() { eigenvalue.map(f64::sqrt) } else { eigenvalue };
        let takes_column = |v: usize| self.constrained.binary_search(&(v as u32)).is_ok();
        let fixed =
            bounds::norm_of_columns(&self.operators.laplacian, &takes_column, &|row| self.system.row_scale(row));
        bounds::interpolation(fixed, singular_value)
    }
}
