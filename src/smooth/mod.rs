//! Smoothing: the systems of \[Patane09, section 4\] set up, solved and reported.

mod bounds;
mod channels;
mod constraints;
mod filters;
mod interpolate;
mod least_squares;
mod maximum_principle;
mod options;
mod regularized;
mod report;
mod routes;
mod system;
mod tikhonov;

pub use constraints::{Constraints, Unconstrained, constrained_vertices};
pub use filters::{BilateralOptions, LowPassOptions};
pub use interpolate::InterpolateOptions;
pub use least_squares::LeastSquaresOptions;
pub use maximum_principle::MaximumPrinciple;
pub use options::{Metric, Operator, Phase, Precision, Progress, SmootherOptions, SolverChoice};
pub use report::{SmoothReport, Smoothed, SmoothnessEnergies, SolverReport, smoothness};
pub use system::Energy;
pub use tikhonov::{TikhonovOptions, epsilon_for_wavelength};

use nalgebra_sparse::CscMatrix;

use crate::error::{OptionError, Result};
use crate::mesh::TriMesh;
use crate::operators::{self, LaplacianWeights};
use constraints::LeftOut;
use routes::Manner;
use system::{FullSystem, Reach, ReducedSystem};

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
    mesh: TriMesh,
    options: SmootherOptions,
    laplacian: CscMatrix<f64>,
    reach: Reach,
    /// With all vertices reached as unknowns.
    full: Option<FullSystem>,
    /// Without the components that the last constraints left out.
    partial: Option<FullSystem>,
    /// With the vertices that the last constraints left free.
    reduced: Option<ReducedSystem>,
}

impl Smoother {
    /// Assembles the Laplacian. The mesh is shared, not copied.
    ///
    /// # Errors
    /// `ZeroWeightSum` for normalised weights; `InapplicableOption` for the finite-element operator with weights other than
    /// cotangent, for which it means nothing.
    pub fn new(mesh: &TriMesh, options: SmootherOptions) -> Result<Self> {
        if options.operator == Operator::Fem && options.weights != LaplacianWeights::Cotangent {
            let reason = "the finite-element operator has cotangent weights".to_owned();
            return Err(OptionError::InapplicableOption { option: "weights".to_owned(), reason }.into());
        }
        let laplacian = operators::laplacian(mesh, options.weights)?;
        let reach = Reach::new(mesh, &laplacian, options.operator)?;
        Ok(Self { mesh: mesh.clone(), options, laplacian, reach, full: None, partial: None, reduced: None })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// The options it was made with.
    #[must_use]
    pub fn options(&self) -> SmootherOptions {
        self.options
    }

    /// The Laplacian in use.
    #[must_use]
    pub fn laplacian(&self) -> &CscMatrix<f64> {
        &self.laplacian
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
    /// that no operator reaches because all their triangles have zero area, keep their value. Every route refines its
    /// solution with the residual in factored form, r = εB(f − x) − Lᵀ(Lx), or with that of the complex system, until
    /// corrections are rounding or shrink so fast that the error left is below 1e-16 of the solution (2e-11 with a factor in
    /// single precision).
    ///
    /// # Errors
    /// `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`; `InvalidOption` for ε or channels; `InapplicableOption` for a
    /// metric or scale beside the finite-element operator; `ZeroArea` for a mass matrix on a mesh without area;
    /// `NotPositiveDefinite` (its column is a vertex), `IndefinitePreconditioner`, `NotConverged`, `OutOfMemory` from the
    /// solver. Nothing is lost by them.
    pub fn tikhonov(&mut self, values: &[f64], options: &TikhonovOptions) -> Result<Smoothed> {
        self.tikhonov_with_progress(values, options, &mut |_, _| {})
    }

    /// [`Smoother::tikhonov`] that tells how far it is.
    ///
    /// # Errors
    /// As [`Smoother::tikhonov`].
    pub fn tikhonov_with_progress(
        &mut self,
        values: &[f64],
        options: &TikhonovOptions,
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        tikhonov::run(self, values, options, progress)
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
    /// constrained values are all the same gets this value exactly. Vertices that no operator reaches keep theirs. For what harmonic
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
    /// use morse_smooth::smooth::{Constraints, Energy, InterpolateOptions, Smoother, SmootherOptions, Unconstrained};
    /// let mesh = shapes::sphere(3)?;
    /// let mut noise = Random::new(1);
    /// let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2] + 0.1 * noise.signed()).collect();
    /// let features = Features::CriticalPoints(DeltaOptions::default());
    /// let constraints = Constraints { features, stars: true, unconstrained: Unconstrained::Error };
    /// let mut smoother = Smoother::new(&mesh, SmootherOptions::default())?;
    /// let options = InterpolateOptions { constraints, energy: Energy::Harmonic, channels: 1 };
    /// let report = smoother.interpolate(&field, &options)?.reports.remove(0);
    /// assert_eq!(report.preserved, report.constrained_critical_points);
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn interpolate(&mut self, values: &[f64], options: &InterpolateOptions<'_>) -> Result<Smoothed> {
        self.interpolate_with_progress(values, options, &mut |_, _| {})
    }

    /// [`Smoother::interpolate`] that tells how far it is.
    ///
    /// # Errors
    /// As [`Smoother::interpolate`].
    pub fn interpolate_with_progress(
        &mut self,
        values: &[f64],
        options: &InterpolateOptions<'_>,
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        interpolate::run(self, values, options, progress)
    }

    /// Pulls some vertices towards their values and smooths the rest: eq. (7) of \[Patane09\].
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
        self.least_squares_with_progress(values, options, &mut |_, _| {})
    }

    /// [`Smoother::least_squares`] that tells how far it is.
    ///
    /// # Errors
    /// As [`Smoother::least_squares`].
    pub fn least_squares_with_progress(
        &mut self,
        values: &[f64],
        options: &LeastSquaresOptions<'_>,
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        least_squares::run(self, values, options, progress)
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
        self.low_pass_with_progress(values, options, &mut |_, _| {})
    }

    /// [`Smoother::low_pass`] that tells how far it is.
    ///
    /// # Errors
    /// As [`Smoother::low_pass`].
    pub fn low_pass_with_progress(
        &self,
        values: &[f64],
        options: &LowPassOptions,
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        filters::low_pass(self, values, options, progress)
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
    /// let options = BilateralOptions { iterations: 3, radius: 0.4, sigma_distance: 0.2, sigma_value: 0.3, channels: 1 };
    /// let report = smoother.bilateral(&field, &options)?.reports.remove(0);
    /// assert!(report.after.minima < report.before.minima);
    /// # Ok::<(), morse_smooth::Error>(())
    /// ```
    pub fn bilateral(&self, values: &[f64], options: &BilateralOptions) -> Result<Smoothed> {
        self.bilateral_with_progress(values, options, &mut |_, _| {})
    }

    /// [`Smoother::bilateral`] that tells how far it is.
    ///
    /// # Errors
    /// As [`Smoother::bilateral`].
    pub fn bilateral_with_progress(
        &self,
        values: &[f64],
        options: &BilateralOptions,
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        filters::bilateral(self, values, options, progress)
    }

    fn reach(&self) -> &Reach {
        &self.reach
    }

    /// How systems are to be solved; bounds are the same for all channels.
    fn manner(&self, is_first: bool) -> Manner {
        Manner {
            choice: self.options.solver,
            precision: self.options.precision,
            symmetric: self.options.weights.is_symmetric(),
            bounds: self.options.bounds && is_first,
        }
    }

    /// No two factors are kept: each can take most of the memory. Analyses stay.
    fn drop_factors(&mut self) {
        self.full.iter_mut().for_each(FullSystem::drop_factor);
        self.partial.iter_mut().for_each(FullSystem::drop_factor);
        self.reduced.iter_mut().for_each(ReducedSystem::drop_factor);
    }

    fn take_full_system(&mut self) -> Result<FullSystem> {
        let known = self.full.take();
        self.drop_factors();
        match known {
            Some(system) => Ok(system),
            None => FullSystem::new(&self.mesh, &self.laplacian, self.options.operator, self.reach.active().to_vec()),
        }
    }

    fn take_partial_system(&mut self, left_out: &LeftOut) -> Result<FullSystem> {
        let unknowns = left_out.remaining(&self.reach);
        let known = self.partial.take();
        self.drop_factors();
        match known.filter(|system| system.unknowns() == unknowns) {
            Some(system) => Ok(system),
            None => FullSystem::new(&self.mesh, &self.laplacian, self.options.operator, unknowns),
        }
    }

    fn take_reduced_system(&mut self, energy: Energy, free: Vec<u32>) -> Result<ReducedSystem> {
        let known = self.reduced.take();
        self.drop_factors();
        match known.filter(|system| system.is_for(energy, &free)) {
            Some(system) => Ok(system),
            None => {
                let symmetric = self.options.weights.is_symmetric();
                ReducedSystem::new(&self.mesh, &self.laplacian, self.options.operator, symmetric, energy, free)
            }
        }
    }
}
