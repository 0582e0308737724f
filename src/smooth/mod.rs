//! Smoothing: the systems of \[Patane09, section 4\] set up, solved and reported.

mod active;
mod bounds;
mod channels;
mod choice;
mod constraints;
mod data_term;
mod family;
mod input;
mod maximum_principle;
mod method;
mod methods;
mod missing;
mod names;
mod operators;
mod options;
mod prescribe;
mod prescribed;
mod report;
mod routes;
mod run;
mod schedule;
mod system;
mod systems;
mod unconstrained;

pub use choice::{ChosenEpsilon, Confidence, NoiseLevel, RuleName};
pub use constraints::{Constraints, Unconstrained, constrained_vertices};
pub use family::{EpsilonRule, ExtremumLife, Family, FamilyOptions, Sweep, SweepOptions};
pub use maximum_principle::MaximumPrinciple;
pub use method::Method;
pub use methods::{
    BilateralOptions, Functional, InterpolateOptions, LeastSquaresOptions, LowPassOptions, TikhonovOptions,
    epsilon_for_wavelength,
};
pub use names::{Equation, MethodName, Route, UsedPrecision};
pub use options::{Metric, Operator, Precision, SmootherOptions, SolverChoice};
pub use prescribe::{Extrema, ExtremumValues, PersistenceOf, PrescribeOptions, ResultRange};
pub use prescribed::{PrescribeRoute, PrescribedReport};
pub use report::{SmoothReport, Smoothed, SmoothnessEnergies, SolverReport, smoothness};
pub use system::Energy;

use std::sync::Arc;

use nalgebra_sparse::CscMatrix;

use crate::error::Result;
use crate::mesh::TriMesh;
use crate::support::watch::{Phase, Watch};
use method::Masked;
use operators::Operators;
use systems::Systems;

/// Smooths fields on one mesh. Holds the operators, the ordering and the symbolic and last numeric factor, so that a new
/// field costs a solve and a new ε one numeric factorisation.
///
/// # Example
/// ```
/// use morse_smooth::mesh::shapes::{self, Random};
/// use morse_smooth::smooth::{Smoother, SmootherOptions, TikhonovOptions};
/// let mesh = shapes::sphere(3)?;
/// let mut noise = Random::new(1);
/// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
/// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
/// let smoothed = smoother.tikhonov(&field, &TikhonovOptions { epsilon: 0.01, ..TikhonovOptions::default() })?;
/// let report = &smoothed.reports[0];
/// assert!(report.after.minima < report.before.minima);
/// assert_eq!(report.after.index_sum, Some(2));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
#[derive(Debug)]
pub struct Smoother {
    operators: Arc<Operators>,
    systems: Systems,
    masked: Masked,
}

impl Smoother {
    /// Assembles the Laplacian. The mesh is shared, not copied.
    ///
    /// # Errors
    /// `ZeroWeightSum` for normalised weights; `InapplicableOption` for the finite-element operator with weights other than
    /// cotangent, for which it means nothing.
    pub fn new(mesh: &TriMesh, options: SmootherOptions) -> Result<Self> {
        Self::watched(mesh, options, &Watch::none())
    }

    /// The same as [`Smoother::new`], watched. The watcher hears of the phase `Analysis`, of which nothing is done yet: how far the work
    /// is, is told by what the smoother is made for.
    ///
    /// # Errors
    /// Those of [`Smoother::new`]; `Cancelled`.
    pub fn watched(mesh: &TriMesh, options: SmootherOptions, watch: &Watch<'_>) -> Result<Self> {
        watch.prepare(Phase::Analysis);
        let operators = Arc::new(Operators::new(mesh, options, watch)?);
        Ok(Self { operators, systems: Systems::default(), masked: Masked::default() })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.operators.mesh
    }

    /// The options it was made with.
    #[must_use]
    pub fn options(&self) -> SmootherOptions {
        self.operators.options
    }

    /// The Laplacian in use.
    #[must_use]
    pub fn laplacian(&self) -> &CscMatrix<f64> {
        &self.operators.laplacian
    }

    /// Smooths values by a method, watched: what the methods below do, each by its name and unwatched.
    ///
    /// # Missing values
    /// A vertex whose value is NaN in some channel is missing in all of them. With
    /// [`Missing::Omit`](crate::field::Missing::Omit) the triangles at missing vertices are left out, as if the mesh had a hole
    /// there: what is smoothed is, to the last bit, the field on [`TriMesh::submesh`]; vertices that have no triangle left keep their
    /// values, NaN included, and constrained vertices are named as in the whole mesh. With
    /// [`Missing::Fill`](crate::field::Missing::Fill) smoothness is asked for on the whole mesh, and the data term, or the
    /// constraints, are those of the other vertices alone: B becomes PBP with the projection P to them. Rules for constraints look at
    /// the triangles that have three values. A component of the mesh without any value is an error, or what `unconstrained` says.
    /// Isolated vertices stay as they are. What is found out about a set of missing vertices is kept for the next call.
    ///
    /// # Errors
    /// Those of the method; `Cancelled` where the watcher stops the work, after which everything goes on as if this call had not
    /// been; `MissingValue` for a constrained vertex without a value, `EmptyMesh` where no triangle has three values, and
    /// `InapplicableOption` for filters that are asked to fill.
    ///
    /// # Example
    /// ```
    /// use core::ops::ControlFlow;
    /// use morse_smooth::mesh::shapes;
    /// use morse_smooth::smooth::{Method, Smoother, SmootherOptions, TikhonovOptions};
    /// use morse_smooth::{Progress, Watch};
    /// let mesh = shapes::sphere(3)?;
    /// let height: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2]).collect();
    /// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let mut stop = |_: Progress| ControlFlow::Break(());
    /// let method = Method::Tikhonov(TikhonovOptions::default());
    /// let stopped = smoother.apply(&height, &method, &Watch::new(&mut stop));
    /// assert_eq!(stopped.map_err(|error| error.code()), Err("Cancelled"));
    /// assert!(smoother.apply(&height, &method, &Watch::none()).is_ok());
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn apply(&mut self, values: &[f64], method: &Method<'_>, watch: &Watch<'_>) -> Result<Smoothed> {
        method::apply(&self.operators, &mut self.systems, &mut self.masked, values, method, watch)
    }

    /// Solves eq. (3) or (5) of \[Patane09\], or that of [`Operator::Fem`]: see [`TikhonovOptions`].
    ///
    /// # Definition
    /// (LᵀL + εB) x = εBf with B = I (eq. 3), the Galerkin or the lumped mass matrix (eq. 5), or (L M⁻¹ L + εM) x = εMf with
    /// the lumped masses M in the mesh's units; every channel is normalised to [0, 1] by its range before and brought back
    /// after, which changes nothing but the reported numbers.
    ///
    /// # Properties
    /// Constants are kept; T(af + b) = aT(f) + b; Σx = Σf (eq. 3), 1ᵀBx = 1ᵀBf (eq. 5). Isolated vertices, and vertices
    /// that no operator acts on because all their triangles have zero area, keep their value. Every route refines its
    /// solution with the residual in factored form, r = εB(f − x) − Lᵀ(Lx), or with that of the complex system, until
    /// corrections are rounding or shrink so fast that the error left is below 1e-16 of the solution (2e-11 with a factor in
    /// single precision).
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `InvalidOption` for ε or channels; `InapplicableOption` for a
    /// metric or scale beside the finite-element operator, and for `unconstrained` where nothing is filled in; `ZeroArea` for a mass matrix on a mesh without area;
    /// `NotPositiveDefinite` (its column is a vertex), `IndefinitePreconditioner`, `NotConverged`, `OutOfMemory` from the
    /// solver. Nothing is lost by them.
    pub fn tikhonov(&mut self, values: &[f64], options: &TikhonovOptions) -> Result<Smoothed> {
        self.apply(values, &Method::Tikhonov(*options), &Watch::none())
    }

    /// Interpolates the values of constrained vertices by a smooth field: eq. (6) of \[Patane09\].
    ///
    /// # Definition
    /// With the values f_I of the constrained vertices given, the others are g with L_FF g = −L_FI f_I ([`Energy::Harmonic`]), or
    /// those for which ‖Lx‖ is least ([`Energy::Biharmonic`]; with [`Operator::Fem`], xᵀLM⁻¹Lx). Where L is not symmetric, the
    /// harmonic system is solved through its normal equations.
    ///
    /// # Properties
    /// Constrained values stay to the last bit. With 1-stars every constrained critical point keeps its type. Constants are
    /// kept; T(af + b) = aT(f) + b. An empty set leaves no component constrained, a full one changes nothing; a component whose
    /// constrained values are all the same gets this value exactly. Vertices that no operator acts on keep theirs. For what harmonic
    /// interpolation promises about other extrema see [`MaximumPrinciple`].
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, `IndexOutOfBounds` (a constrained vertex), `InvalidOption`,
    /// `Unconstrained`; `NotPositiveDefinite`, `NonFiniteEntry`, `NotConverged`, `IndefinitePreconditioner`, `OutOfMemory` from the
    /// solver, on meshes with very thin triangles mostly. Nothing is lost by them.
    ///
    /// # Example
    /// ```
    /// use morse_smooth::field::{DeltaOptions, Features};
    /// use morse_smooth::mesh::shapes::{self, Random};
    /// use morse_smooth::smooth::{Constraints, InterpolateOptions, Smoother, SmootherOptions};
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let features = Features::CriticalPoints(DeltaOptions::default());
    /// let constraints = Constraints { features, stars: true, ..Constraints::default() };
    /// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let options = InterpolateOptions { constraints, ..InterpolateOptions::default() };
    /// let report = smoother.interpolate(&field, &options)?.reports.remove(0);
    /// assert_eq!(report.preserved, report.constrained_critical_points);
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn interpolate(&mut self, values: &[f64], options: &InterpolateOptions<'_>) -> Result<Smoothed> {
        self.apply(values, &Method::Interpolate(*options), &Watch::none())
    }

    /// Fits some vertices to their values and smooths the rest: eq. (7) of \[Patane09\].
    ///
    /// # Definition
    /// (LᵀL + εΔ) x = εΔf, where the diagonal matrix Δ holds the weights of the constrained vertices and zeros elsewhere (the
    /// paper leaves out the ε on the right); L M⁻¹ L instead of LᵀL with [`Operator::Fem`].
    ///
    /// # Properties
    /// Constants are kept; T(af + b) = aT(f) + b; the weighted sum over the constrained vertices stays. With all vertices
    /// constrained by weights 1 it is eq. (3), and shares its analysis with [`Smoother::tikhonov`].
    ///
    /// # Errors
    /// As [`Smoother::interpolate`]; `LengthMismatch` and `InvalidWeight` for the weights.
    pub fn least_squares(&mut self, values: &[f64], options: &LeastSquaresOptions<'_>) -> Result<Smoothed> {
        self.apply(values, &Method::LeastSquares(*options), &Watch::none())
    }

    /// Filters by repeated averaging with the neighbours: diffusion \[Patane09, sections 2.2 and 4.1\], or, with a negative μ, the
    /// low-pass filter of \[Taubin95\].
    ///
    /// # Definition
    /// With K = D⁻¹L, D the diagonal of L, every iteration is x ← (I − μK)(I − λK) x. [`SmootherOptions::operator`] makes no
    /// difference to it.
    ///
    /// # Properties
    /// Linear; constants are kept; T(af + b) = aT(f) + b; Σ d_i x_i = Σ d_i f_i where L is symmetric. Vertices whose row of L is
    /// zero keep their value to the last bit, as all do without iterations. An eigenvector of K with the eigenvalue k is
    /// multiplied by ((1 − μk)(1 − λk))^N in N iterations. Without negative weights, as mean value and uniform ones are,
    /// k lies between 0 and 2. Then λ ≤ 1 lets nothing grow, and diffusion is an average: no value leaves the range of
    /// the input. With μ < −λ low frequencies, k < 1/λ + 1/μ, grow a little instead of shrinking. Negative cotangents can
    /// have larger k, and values grow without bounds where the product is beyond 1.
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `InvalidOption` for λ, μ or channels; `Diverged` where a value is
    /// beyond a million times the range of the input. Nothing is lost by them.
    ///
    /// # Example
    /// ```
    /// use morse_smooth::mesh::shapes::{self, Random};
    /// use morse_smooth::smooth::{LowPassOptions, Smoother, SmootherOptions};
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let options = LowPassOptions { iterations: 20, lambda: 0.5, mu: -0.53, ..LowPassOptions::default() };
    /// let report = smoother.low_pass(&field, &options)?.reports.remove(0);
    /// assert!(report.after.minima < report.before.minima);
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn low_pass(&self, values: &[f64], options: &LowPassOptions) -> Result<Smoothed> {
        self.filter(values, &Method::LowPass(*options))
    }

    /// Filters by averages over balls, weighted by distance and by difference of value: what differs much counts little, so
    /// that steps stay.
    ///
    /// # Definition
    /// Every iteration is x_i ← x_i + Σ φ_d(|p_j − p_i|) φ_v(x_j − x_i) (x_j − x_i) / Σ φ_d(|p_j − p_i|) φ_v(x_j − x_i) for all
    /// vertices at once, over the vertices within the radius of p_i, itself included, along straight lines and not along the
    /// surface; φ(t) = exp(−t²/(2σ²)) with the σ of each \[Patane09, section 2.2\], \[Tomasi98\]. The paper prints |x_j − x_i|
    /// where the difference needs its sign, or values could but rise, and takes variances where these σ are standard
    /// deviations.
    ///
    /// # Properties
    /// Constants are kept, and no value leaves the range of the input; T(af + b) = aT(f) + b with `sigma_value` scaled by |a|.
    /// Not linear, so there is no perturbation factor. The result does not depend on L. Isolated vertices keep their value and
    /// are no neighbours; a vertex without others within the radius keeps its value to the last bit.
    ///
    /// # Units
    /// `radius` and `sigma_distance` are lengths in those of the mesh, `sigma_value` is in those of the field.
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `InvalidOption` for the radius, a σ or channels.
    ///
    /// # Example
    /// ```
    /// use morse_smooth::mesh::shapes::{self, Random};
    /// use morse_smooth::smooth::{BilateralOptions, Smoother, SmootherOptions};
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let lengths = BilateralOptions { radius: 0.4, sigma_distance: 0.2, sigma_value: 0.3, ..BilateralOptions::default() };
    /// let options = BilateralOptions { iterations: 3, ..lengths };
    /// let report = smoother.bilateral(&field, &options)?.reports.remove(0);
    /// assert!(report.after.minima < report.before.minima);
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn bilateral(&self, values: &[f64], options: &BilateralOptions) -> Result<Smoothed> {
        self.filter(values, &Method::Bilateral(*options))
    }

    /// The smoothest field that has exactly the chosen extrema: what no other method promises.
    ///
    /// # Definition
    /// Of ‖Lx‖² + ε‖x − f‖²_B, as Tikhonov smoothing or least squares minimise it, the minimum among the fields that rise along the same
    /// steps as a field with the chosen extrema: from its lowest neighbour to every vertex that is not to be a minimum, from every
    /// vertex that is not to be a maximum to its highest neighbour, and along all edges of the chosen extrema, each time by the margin or
    /// more. These fields are a convex set, and have no other extrema \[Bauer12\], \[Jacobson12\]. That field is the smoothed one, flooded until
    /// the chosen extrema are left. The minimum is found by an interior-point method \[Mehrotra92\], \[Gondzio96\].
    ///
    /// # Properties
    /// The minima and maxima by (value, id) are the chosen vertices and [`PrescribedReport::unavoidable`]; before the field is returned they are
    /// looked at. On closed surfaces saddles then number minima + maxima − χ. The energy is that of the best such field
    /// but for [`PrescribedReport::gap`]; [`PrescribedReport::unconstrained_energy`] is a bound for all fields. That no field with the
    /// same extrema that rises along *other* steps has less energy is not promised. Chosen extrema may become shallow unless `prominence` says
    /// how high they are, and values may leave the range of the input unless `range` forbids it. Vertices that no operator acts on stay
    /// near their values.
    ///
    /// # Errors
    /// Those of [`Smoother::tikhonov`] or [`Smoother::least_squares`]; `IndexOutOfBounds`, `NotAnExtremum`, `ConflictingExtremum`,
    /// `AdjacentExtrema`, `TooFewExtrema` for what is chosen; `Unconstrained` where a component of the mesh has no chosen minimum or maximum; `Infeasible`
    /// where kept values or the range leave no room; `ConstantField`; `InapplicableOption` for several channels and for missing values
    /// that are to be filled in. `NotConverged` returns no field.
    ///
    /// # Example
    /// ```
    /// use morse_smooth::mesh::shapes::{self, Random};
    /// use morse_smooth::smooth::{Extrema, PersistenceOf, PrescribeOptions, Smoother, SmootherOptions};
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let extrema = Extrema::Most { minima: 1, maxima: 2, of: PersistenceOf::Input };
    /// let options = PrescribeOptions { extrema, ..PrescribeOptions::default() };
    /// let report = smoother.prescribe(&field, &options)?.reports.remove(0);
    /// assert_eq!((report.after.minima, report.after.maxima, report.after.saddles), (1, 2, 1));
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn prescribe(&mut self, values: &[f64], options: &PrescribeOptions<'_>) -> Result<Smoothed> {
        self.apply(values, &Method::Prescribe(*options), &Watch::none())
    }

    /// The smoothed fields for every ε of a range at once: six or seven factorisations, after which each ε costs a product with a few
    /// dozen vectors.
    ///
    /// # Definition
    /// See [`FamilyOptions`] and [`Family`]. x(ε) = (LᵀWL + εB)⁻¹εBf is sought in the space of f, its means, and the solutions with their
    /// first four derivatives at some shifts ε_k, by Galerkin's condition: of all fields in the space it is the nearest one to the solution in the
    /// norm of LᵀWL + εB. Each shift is taken where the estimated error is largest.
    ///
    /// # Properties
    /// ‖x − f‖_B falls and ‖Lx‖ grows with ε. [`Family::error_estimate`] is an estimate, not a bound: compared with exact solutions it was
    /// between a third of the largest error and ten times as large.
    ///
    /// # Errors
    /// Those of the method; `InvalidOption` for the range and the tolerance; `Cancelled`.
    ///
    /// # Example
    /// ```
    /// use morse_smooth::mesh::shapes::{self, Random};
    /// use morse_smooth::smooth::{FamilyOptions, Smoother, SmootherOptions};
    /// use morse_smooth::Watch;
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let family = smoother.family(&field, &FamilyOptions::default(), &Watch::none())?;
    /// assert!(family.error_estimate() <= 1e-6);
    /// for epsilon in [1e-4, 1e-2, 1.0] {
    ///     assert_eq!(family.values(epsilon)?.len(), field.len());
    /// }
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn family(&mut self, values: &[f64], options: &FamilyOptions<'_>, watch: &Watch<'_>) -> Result<Family> {
        Family::new(&self.operators, &mut self.systems, &mut self.masked, values, options, watch)
    }

    /// Smooths by a method with the ε that a rule chooses: through a family, then by the method itself. Reports say why.
    ///
    /// The range is that of [`FamilyOptions`]; with [`Operator::Fem`], where ε has the units of the mesh, from waves as long as the mesh
    /// to waves as long as its edges.
    ///
    /// # Errors
    /// Those of [`Smoother::family`] and [`Family::choose`]; `InvalidOption` for a method without ε.
    pub fn apply_chosen(
        &mut self,
        values: &[f64],
        method: &Method<'_>,
        rule: EpsilonRule,
        watch: &Watch<'_>,
    ) -> Result<Smoothed> {
        // What is wrong with the options is told before the long work.
        method.with_epsilon(1.0).check(self.operators.options)?;
        let mut plan = watch.plan(&[(Phase::Factorization, 9.0), (Phase::Factorization, 1.0)]);
        plan.begin(0)?;
        let options = FamilyOptions::for_choice(method, rule, &self.operators)?;
        let choice = self.family(values, &options, watch)?.choose(rule, watch)?;
        plan.begin(0)?;
        let mut smoothed = self.apply(values, &method.with_epsilon(choice.epsilon), watch)?;
        for report in &mut smoothed.reports {
            report.choice = Some(choice.clone());
        }
        plan.finish()?;
        Ok(smoothed)
    }

    /// Adds a shift to a family that was made with a limit of factorisations; whether it is complete then.
    ///
    /// # Errors
    /// `InvalidOption` for a family of another smoother; those of the solver; `Cancelled`, after which the family is as it was.
    pub fn grow(&mut self, family: &mut Family, watch: &Watch<'_>) -> Result<bool> {
        family.grow(&self.operators, &mut self.systems, &mut self.masked, watch)
    }

    /// Applies a method that solves no system, and so has nothing to keep.
    fn filter(&self, values: &[f64], method: &Method<'_>) -> Result<Smoothed> {
        method::apply(&self.operators, &mut Systems::default(), &mut Masked::default(), values, method, &Watch::none())
    }
}
