//! The space in which the solutions for all ε lie, to high accuracy, for one channel.

use super::block::Block;
use super::pencil::Pencil;
use super::small::{Symmetric, add_combination, dot, orthonormal};
use crate::error::{Cancelled, Result, SmoothError};
use crate::smooth::data_term::Mass;
use crate::smooth::system::Matrices;
use crate::solve::dot_products;
use crate::support::watch::Watch;

/// What a vector of the space was made as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// What stays of the field for ε → 0: its mean on every component.
    Kernel,
    /// The field itself, where the data term reaches all of it: what stays for ε → ∞.
    Field,
    /// The solution for a shift, by its number, and after it derivatives of the solution by ε, but for factors.
    OfShift(usize),
}

/// How many derivatives each shift gives: the solves for them are cheap beside its factor.
pub(super) const DERIVATIVES: usize = 5;

/// A growing space with the systems projected onto it.
///
/// The basis is orthonormal in the norm of S + σB with S = LᵀWL, in which both matrices have a condition number of no more than the
/// largest ε over the least.
#[derive(Debug)]
pub(super) struct Space {
    sigma: f64,
    basis: Vec<Vec<f64>>,
    /// √W·L times the basis; emptied when the space grows no more.
    images: Vec<Vec<f64>>,
    /// What each vector that was added is in the basis.
    added: Vec<(Kind, Vec<f64>)>,
    /// f at the unknowns, and Bf.
    field: Vec<f64>,
    field_mass: Vec<f64>,
    /// 1 at unknowns whose values the data term knows, or their weights; nothing where all count alike.
    counted: Option<Vec<f64>>,
    smooth: Symmetric,
    data: Symmetric,
    plain: Symmetric,
    sobolev: Symmetric,
    /// vᵀLᵀLv where W is not the identity.
    laplacian: Option<Symmetric>,
    /// vᵀKv with K the diagonal of what is counted.
    counted_plain: Option<Symmetric>,
    loads: Vec<f64>,
    /// vᵀKf.
    counted_loads: Vec<f64>,
    /// fᵀBf and fᵀKf.
    field_data: f64,
    field_counted: f64,
    full: Pencil,
    /// The same without the last vector of each shift: what errors are estimated with.
    partial: Pencil,
}

impl Space {
    pub(super) fn new(matrices: &Matrices, field: Vec<f64>, counted: Option<Vec<f64>>, sigma: f64) -> Self {
        let field_mass = matrices.mass().times(&field);
        let field_data = dot(&field, &field_mass);
        let field_counted = counted
            .as_ref()
            .map_or_else(|| dot(&field, &field), |counted| field.iter().zip(counted).map(|(f, k)| k * f * f).sum());
        let with = |wanted: bool| wanted.then(Symmetric::default);
        Self {
            sigma,
            laplacian: with(matrices.weights().is_some()),
            counted_plain: with(counted.is_some()),
            basis: Vec::new(),
            images: Vec::new(),
            added: Vec::new(),
            field,
            field_mass,
            counted,
            smooth: Symmetric::default(),
            data: Symmetric::default(),
            plain: Symmetric::default(),
            sobolev: Symmetric::default(),
            loads: Vec::new(),
            counted_loads: Vec::new(),
            field_data,
            field_counted,
            full: Pencil::default(),
            partial: Pencil::default(),
        }
    }

    /// f at the unknowns.
    pub(super) fn field(&self) -> &[f64] {
        &self.field
    }

    pub(super) fn field_mass(&self) -> &[f64] {
        &self.field_mass
    }

    pub(super) fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// Adds vectors to the space, but for those that lie there already.
    pub(super) fn add(
        &mut self,
        kind: Kind,
        vectors: Vec<Vec<f64>>,
        matrices: &Matrices,
        watch: &Watch<'_>,
    ) -> Result<(), Cancelled> {
        let mut block = Block::new(vectors, matrices, self.sigma);
        let coordinates = block.orthonormalize(&self.basis, &self.images, watch)?;
        self.added.extend(coordinates.into_iter().map(|coordinates| (kind, coordinates)));
        let Block { vectors, images, masses, .. } = block;
        self.basis.extend(vectors);
        self.images.extend(images);
        self.measure(matrices, &masses, watch)
    }

    /// The last basis vectors' rows of all the small matrices.
    fn measure(&mut self, matrices: &Matrices, masses: &[Vec<f64>], watch: &Watch<'_>) -> Result<(), Cancelled> {
        let before = self.basis.len() - masses.len();
        let (vectors, images) = (&self.basis[before..], &self.images[before..]);
        let data = dot_products(&self.basis, masses, watch)?;
        let is_identity = matches!(matrices.mass(), Mass::Identity);
        self.plain.grow(if is_identity { data.clone() } else { dot_products(&self.basis, vectors, watch)? });
        self.data.grow(data);
        self.smooth.grow(dot_products(&self.images, images, watch)?);
        let scaled = |vectors: &[Vec<f64>], by: &dyn Fn(usize) -> f64| -> Vec<Vec<f64>> {
            vectors.iter().map(|vector| vector.iter().enumerate().map(|(i, x)| x * by(i)).collect()).collect()
        };
        let plain_images = matrices.weights().map(|weights| scaled(images, &|i| 1.0 / weights[i].sqrt()));
        let mut energies = dot_products(&self.basis, plain_images.as_deref().unwrap_or(images), watch)?;
        if !matrices.is_symmetric() {
            // Only the symmetric part of L makes energies.
            let transposed = dot_products(&self.images, vectors, watch)?;
            let pairs = energies.iter_mut().flatten().zip(transposed.into_iter().flatten());
            pairs.for_each(|(a, b)| *a = 0.5 * (*a + b));
        }
        self.sobolev.grow(energies);
        drop(plain_images);
        if let (Some(laplacian), Some(weights)) = (&mut self.laplacian, matrices.weights()) {
            // The images are √W·L times the vectors: both sides are divided by the root.
            laplacian.grow(dot_products(&self.images, &scaled(images, &|i| 1.0 / weights[i]), watch)?);
        }
        for vector in vectors {
            self.loads.push(dot(vector, &self.field_mass));
        }
        if let (Some(counted_plain), Some(counted)) = (&mut self.counted_plain, &self.counted) {
            let scaled = scaled(vectors, &|i| counted[i]);
            self.counted_loads.extend(scaled.iter().map(|vector| dot(vector, &self.field)));
            counted_plain.grow(dot_products(&self.basis, &scaled, watch)?);
        } else {
            self.counted_loads.extend(vectors.iter().map(|vector| dot(vector, &self.field)));
        }
        Ok(())
    }

    /// The systems projected onto the space with the vectors that have been added: all of it, and its part.
    ///
    /// # Errors
    /// `NotConverged` where the projected matrices are not positive definite, which rounding alone can make them.
    pub(super) fn projections(&self) -> Result<[Pencil; 2]> {
        let size = self.dimension();
        let unit = |i: usize| (0..size).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
        let all: Vec<Vec<f64>> = (0..size).map(unit).collect();
        let kept = (0..size).filter(|&place| !self.is_last_of_shift(place));
        let padded = kept.map(|place| {
            let (_, coordinates) = &self.added[place];
            let mut column = coordinates.clone();
            column.resize(size, 0.0);
            column
        });
        let some = orthonormal(&padded.collect::<Vec<_>>());
        let pencil = |columns: &[Vec<f64>]| {
            Pencil::new(columns, &self.smooth, &self.data, &self.loads, self.sigma)
                .ok_or(SmoothError::NotConverged { iterations: 0, residual: f64::INFINITY })
        };
        Ok([pencil(&all)?, pencil(&some)?])
    }

    /// Takes what [`Space::projections`] found.
    pub(super) fn project(&mut self, [full, partial]: [Pencil; 2]) {
        (self.full, self.partial) = (full, partial);
    }

    /// Whether a vector is the last one of its shift.
    fn is_last_of_shift(&self, place: usize) -> bool {
        let kind = self.added[place].0;
        matches!(kind, Kind::OfShift(_)) && self.added.get(place + 1).is_none_or(|(next, _)| *next != kind)
    }

    /// Whether there is a vector of a kind.
    fn has(&self, kind: Kind) -> bool {
        self.added.iter().any(|(other, _)| *other == kind)
    }

    /// Whether what stays for ε → 0 is in the space on its own.
    fn has_kernel(&self) -> bool {
        self.has(Kind::Kernel)
    }

    /// ln of what the residual for ε is in proportion to: the residuals of all ε are multiples of one vector.
    pub(super) fn log_residual(&self, epsilon: f64, shifts: &[f64], of: Which) -> f64 {
        let pencil = match of {
            Which::Full => &self.full,
            Which::Partial => &self.partial,
        };
        // As often as the shift has vectors: fewer than others where some of them depended on what was there.
        let mut distances = 0.0;
        for (place, (kind, _)) in self.added.iter().enumerate() {
            if let Kind::OfShift(shift) = kind
                && !(of == Which::Partial && self.is_last_of_shift(place))
            {
                distances += libm::log((epsilon - shifts[*shift]).abs().max(f64::MIN_POSITIVE));
            }
        }
        libm::log(epsilon) + distances - pencil.log_divisors(epsilon, self.has_kernel())
    }

    fn coefficients(&self, epsilon: f64, of: Which) -> Vec<f64> {
        match of {
            Which::Full => self.full.coefficients(epsilon),
            Which::Partial => self.partial.coefficients(epsilon),
        }
    }

    /// The solution for ε in the basis.
    pub(super) fn coefficients_of(&self, epsilon: f64) -> Vec<f64> {
        self.coefficients(epsilon, Which::Full)
    }

    pub(super) fn basis(&self) -> &[Vec<f64>] {
        &self.basis
    }

    /// The solution for ε at the unknowns.
    pub(super) fn solution(&self, epsilon: f64, of: Which) -> Vec<f64> {
        let mut x = vec![0.0; self.field.len()];
        add_combination(&mut x, &self.basis, &self.coefficients(epsilon, of));
        x
    }

    /// ‖x − y‖/‖x‖ for the solution x and that without the last vector of each shift y.
    pub(super) fn difference(&self, epsilon: f64) -> f64 {
        let x = self.coefficients(epsilon, Which::Full);
        let y = self.coefficients(epsilon, Which::Partial);
        let difference: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x - y).collect();
        let size = self.plain.quadratic(&x).max(0.0).sqrt();
        if size > 0.0 { self.plain.quadratic(&difference).max(0.0).sqrt() / size } else { 0.0 }
    }

    /// ‖x − f‖_B.
    pub(super) fn metric_norm(&self, epsilon: f64) -> f64 {
        // What no vector of the space reaches of f; nothing but rounding where f is among them.
        let beyond = if self.has(Kind::Field) { 0.0 } else { self.field_data - self.full.projected() };
        (self.full.misfit(epsilon) + beyond.max(0.0)).sqrt()
    }

    /// xᵀSx.
    pub(super) fn smoothness_energy(&self, epsilon: f64) -> f64 {
        self.full.smoothness_energy(epsilon)
    }

    /// ‖Lx‖₂² and xᵀLx.
    pub(super) fn energies(&self, epsilon: f64) -> (f64, f64) {
        let x = self.coefficients(epsilon, Which::Full);
        let squared = match &self.laplacian {
            Some(laplacian) => laplacian.quadratic(&x).max(0.0),
            None => self.full.smoothness_energy(epsilon),
        };
        (squared, self.sobolev.quadratic(&x))
    }

    /// Σ k(x − f)² over what is counted.
    pub(super) fn counted_misfit(&self, epsilon: f64) -> f64 {
        let x = self.coefficients(epsilon, Which::Full);
        let square = self.counted_plain.as_ref().unwrap_or(&self.plain).quadratic(&x);
        (self.field_counted - 2.0 * dot(&x, &self.counted_loads) + square).max(0.0)
    }

    /// Lets go of the vectors after the first ones. Projections stay as they are.
    pub(super) fn truncate(&mut self, dimension: usize) {
        self.basis.truncate(dimension);
        self.images.truncate(dimension);
        self.added.truncate(dimension);
        self.loads.truncate(dimension);
        self.counted_loads.truncate(dimension);
        let others = [&mut self.laplacian, &mut self.counted_plain].into_iter().flatten();
        let matrices = [&mut self.smooth, &mut self.data, &mut self.plain, &mut self.sobolev].into_iter().chain(others);
        matrices.for_each(|matrix| matrix.truncate(dimension));
    }

    /// Gives back what only growing needs.
    pub(super) fn finish(&mut self) {
        self.images = Vec::new();
    }
}

/// All of a space, or its part that errors are estimated with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Which {
    Full,
    Partial,
}
