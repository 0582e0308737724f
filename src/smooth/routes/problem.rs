//! What a route is given: a system in factored form, and what is asked of it.

use nalgebra_sparse::CscMatrix;

use crate::smooth::data_term::Mass;
use crate::solve::{Twofold, norm, product, product_twofold, transposed_product, transposed_product_twofold};

/// A linear system. Its right-hand sides are [`RightHandSide`]s.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct Problem<'a> {
    /// A: a column for every unknown.
    pub(in crate::smooth) matrix: &'a CscMatrix<f64>,
    pub(in crate::smooth) form: Form<'a>,
}

/// How the matrix A of a [`Problem`] makes the system.
#[derive(Clone, Copy)]
pub(in crate::smooth) enum Form<'a> {
    /// Ax = −c, with A symmetric and positive definite.
    Symmetric,
    /// AᵀWAx = −AᵀWc.
    Normal {
        weights: Weights<'a>,
        /// The rows of A that belong to unknowns, where they make a symmetric matrix.
        symmetric_part: Option<SymmetricPart<'a>>,
    },
    /// (AᵀWA + εB) x = εBf − AᵀWc for a square A, divided by [`DataPart::scale`].
    Regularized { weights: Weights<'a>, data: DataPart<'a>, symmetry: Symmetry },
}

/// The diagonal of W; nothing for the identity.
pub(in crate::smooth) type Weights<'a> = Option<&'a [f64]>;

/// What is symmetric about a regularised system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::smooth) enum Symmetry {
    /// A is not symmetric.
    Unsymmetric,
    /// A is symmetric.
    Symmetric,
    /// A is symmetric and W = B⁻¹: the system is a product of two of first order, (A + i√ε·B) W (A − i√ε·B).
    Product,
}

/// A symmetric matrix in the order of the unknowns.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct SymmetricPart<'a> {
    pub(in crate::smooth) matrix: &'a CscMatrix<f64>,
    /// W at its rows.
    pub(in crate::smooth) weights: Weights<'a>,
}

/// The matrix εB of the data term.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct DataPart<'a> {
    pub(in crate::smooth) mass: &'a Mass,
    pub(in crate::smooth) epsilon: f64,
}

impl DataPart<'_> {
    /// The system is divided by this, so that neither a huge nor a tiny ε leaves the range of double precision.
    pub(in crate::smooth) fn scale(&self) -> f64 {
        self.epsilon.max(1.0)
    }

    /// The values where the data term reaches, and their mean elsewhere.
    pub(super) fn met(&self, side: &RightHandSide) -> Vec<f64> {
        let reaches = |i: usize| self.mass.diagonal(i) > 0.0;
        let known: Vec<f64> = (0..side.field.len()).filter(|&i| reaches(i)).map(|i| side.field[i]).collect();
        let mean = known.iter().sum::<f64>() / known.len().max(1) as f64;
        side.field.iter().enumerate().map(|(i, &f)| if reaches(i) { f } else { mean }).collect()
    }

    /// ε in the system that is divided by the scale.
    pub(in crate::smooth) fn scaled_epsilon(&self) -> f64 {
        self.epsilon / self.scale()
    }
}

/// One right-hand side.
#[derive(Debug, Default)]
pub(in crate::smooth) struct RightHandSide {
    /// f: the data at the unknowns; empty without a data term.
    pub(in crate::smooth) field: Vec<f64>,
    /// c: what is known of A's image, per row; empty for nothing.
    pub(in crate::smooth) offset: Vec<f64>,
}

pub(in crate::smooth) fn difference(x: &[f64], f: &[f64]) -> Vec<f64> {
    let mut difference = Vec::with_capacity(x.len());
    for i in 0..x.len() {
        difference.push(x[i] - f[i]);
    }
    difference
}

impl<'a> Problem<'a> {
    pub(in crate::smooth) fn unknowns(&self) -> usize {
        self.matrix.ncols()
    }

    /// About how long a product with the matrix of the system takes, in ticks.
    pub(in crate::smooth) fn ticks(&self) -> u64 {
        6 * (self.matrix.nnz() + self.unknowns()) as u64
    }

    pub(in crate::smooth) fn data(&self) -> Option<DataPart<'a>> {
        match self.form {
            Form::Regularized { data, .. } => Some(data),
            Form::Symmetric | Form::Normal { .. } => None,
        }
    }

    pub(in crate::smooth) fn weights(&self) -> Weights<'a> {
        match self.form {
            Form::Symmetric => None,
            Form::Normal { weights, .. } | Form::Regularized { weights, .. } => weights,
        }
    }

    /// A, or what is symmetric of it in the order of the unknowns; nothing where nothing is.
    pub(in crate::smooth) fn symmetric_part(&self) -> Option<SymmetricPart<'a>> {
        match self.form {
            Form::Symmetric => Some(SymmetricPart { matrix: self.matrix, weights: None }),
            Form::Normal { symmetric_part, .. } => symmetric_part,
            Form::Regularized { symmetry: Symmetry::Unsymmetric, .. } => None,
            Form::Regularized { weights, .. } => Some(SymmetricPart { matrix: self.matrix, weights }),
        }
    }

    /// Whether the system is a product of two complex ones of first order.
    pub(in crate::smooth) fn is_product(&self) -> bool {
        matches!(self.form, Form::Regularized { symmetry: Symmetry::Product, .. })
    }

    /// Whether A itself, with all its rows, is symmetric.
    fn is_symmetric(&self) -> bool {
        match self.form {
            Form::Symmetric => true,
            Form::Normal { .. } => false,
            Form::Regularized { symmetry, .. } => symmetry != Symmetry::Unsymmetric,
        }
    }

    fn is_first_order(&self) -> bool {
        matches!(self.form, Form::Symmetric)
    }

    pub(super) fn scale(&self) -> f64 {
        self.data().map_or(1.0, |data| data.scale())
    }

    /// Ax + c.
    #[inline(never)]
    fn image(&self, x: &[f64], offset: &[f64]) -> Vec<f64> {
        // A symmetric A is its own transpose, and the product with the transpose gathers, which is faster.
        let mut image = if self.is_symmetric() { transposed_product(self.matrix, x) } else { product(self.matrix, x) };
        image.iter_mut().zip(offset).for_each(|(y, c)| *y += c);
        image
    }

    /// AᵀW(Ax + c)/scale, or Ax + c: never with an assembled AᵀWA, whose rounding the refinement is there to remove.
    #[inline(never)]
    fn smoothing(&self, x: &[f64], offset: &[f64]) -> Vec<f64> {
        let mut image = self.image(x, offset);
        if self.is_first_order() {
            return image;
        }
        let scale = self.scale();
        match self.weights() {
            Some(weights) => image.iter_mut().zip(weights).for_each(|(y, w)| *y *= w / scale),
            None => image.iter_mut().for_each(|y| *y /= scale),
        }
        transposed_product(self.matrix, &image)
    }

    /// What the right-hand side is more than the matrix times x; for an empty x all of it.
    pub(in crate::smooth) fn residual(&self, side: &RightHandSide, x: &[f64]) -> Vec<f64> {
        if let (Some(data), true, true) = (self.data(), x.is_empty(), side.offset.is_empty()) {
            let epsilon = data.scaled_epsilon();
            return data.mass.times(&side.field).into_iter().map(|b| epsilon * b).collect();
        }
        let mut residual = self.smoothing(x, &side.offset);
        match self.data() {
            Some(data) => {
                let epsilon = data.scaled_epsilon();
                let fidelity = data.mass.times(&difference(&side.field, x));
                residual.iter_mut().zip(fidelity).for_each(|(r, b)| *r = epsilon * b - *r);
            }
            None => residual.iter_mut().for_each(|r| *r = -*r),
        }
        residual
    }

    /// [`Problem::residual`], rounded once: with sums in twice the precision.
    pub(in crate::smooth) fn precise_residual(&self, side: &RightHandSide, x: &[f64]) -> Vec<f64> {
        let wide: Vec<Twofold> = x.iter().map(|&x| x.into()).collect();
        let mut image = product_twofold(self.matrix, &wide);
        image.iter_mut().zip(&side.offset).for_each(|(y, &c)| *y = y.plus(c.into()));
        if self.is_first_order() {
            return image.into_iter().map(|y| -y.value()).collect();
        }
        if let Some(weights) = self.weights() {
            image.iter_mut().zip(weights).for_each(|(y, &w)| *y = y.times(w));
        }
        let smoothing = transposed_product_twofold(self.matrix, &image);
        let Some(data) = self.data() else { return smoothing.into_iter().map(|y| -y.value()).collect() };
        let rest: Vec<Twofold> = side.field.iter().zip(x).map(|(&f, &x)| Twofold::difference(f, x)).collect();
        let fidelity = data.mass.times_twofold(&rest);
        let (epsilon, scale) = (data.scaled_epsilon(), data.scale());
        let parts = fidelity.iter().zip(&smoothing);
        parts.map(|(b, s)| b.times(epsilon).minus(s.divided_by(scale)).value()).collect()
    }

    /// The matrix times x.
    pub(in crate::smooth) fn apply(&self, x: &[f64]) -> Vec<f64> {
        let mut image = self.smoothing(x, &[]);
        if let Some(data) = self.data() {
            let epsilon = data.scaled_epsilon();
            image.iter_mut().zip(data.mass.times(x)).for_each(|(l, b)| *l += epsilon * b);
        }
        image
    }

    /// What the system minimises, twice: (Ax + c)ᵀW(Ax + c) + ε(x − f)ᵀB(x − f), divided by the scale.
    pub(in crate::smooth) fn energy(&self, side: &RightHandSide, x: &[f64]) -> f64 {
        let mut image = self.image(x, &side.offset);
        if let Some(weights) = self.weights() {
            image.iter_mut().zip(weights).for_each(|(y, w)| *y *= w.sqrt());
        }
        let smoothness = norm(&image);
        let fidelity = self.data().map_or(0.0, |data| {
            let distance = data.mass.norm(&difference(&side.field, x));
            data.scaled_epsilon() * distance * distance
        });
        smoothness * smoothness / self.scale() + fidelity
    }

    /// The diagonal of the matrix.
    pub(in crate::smooth) fn diagonal(&self) -> Vec<f64> {
        let (scale, weights, data) = (self.scale(), self.weights(), self.data());
        let weight = |row: usize| weights.map_or(1.0, |weights| weights[row]);
        let mut diagonal = Vec::with_capacity(self.unknowns());
        for (j, column) in self.matrix.col_iter().enumerate() {
            let mut sum = 0.0;
            for (&row, v) in column.row_indices().iter().zip(column.values()) {
                if !self.is_first_order() {
                    sum += v * v * weight(row);
                } else if row == j {
                    sum = *v;
                }
            }
            diagonal.push(sum / scale + data.map_or(0.0, |data| data.scaled_epsilon() * data.mass.diagonal(j)));
        }
        diagonal
    }

    /// ‖b − Ax‖₂/‖b‖₂ of the whole system.
    pub(in crate::smooth) fn relative_residual(&self, side: &RightHandSide, x: &[f64]) -> f64 {
        let residual = norm(&self.residual(side, x));
        if residual == 0.0 {
            return 0.0;
        }
        residual
            / match self.data() {
                Some(data) if side.offset.is_empty() => data.scaled_epsilon() * norm(&data.mass.times(&side.field)),
                None if self.is_first_order() => norm(&side.offset),
                _ => norm(&self.residual(side, &vec![0.0; x.len()])),
            }
    }
}
