//! What a solver is given: a system in factored form, and what is asked of it.

use nalgebra_sparse::CscMatrix;

use crate::solve::{norm, product, transposed_product};

/// How the matrix A of a [`Problem`] makes the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::smooth) enum Order {
    /// Ax = −c, with A symmetric and positive definite.
    First,
    /// (AᵀWA/scale + εB) x = εBf − AᵀWc/scale.
    Squared,
}

/// A linear system. Its right-hand sides are [`Load`]s.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct Problem<'a> {
    /// A: a column for every unknown.
    pub(in crate::smooth) matrix: &'a CscMatrix<f64>,
    pub(in crate::smooth) order: Order,
    /// The diagonal of W; nothing for the identity.
    pub(in crate::smooth) weights: Option<&'a [f64]>,
    /// εB; nothing where the unknowns are not pulled anywhere.
    pub(in crate::smooth) pull: Option<Pull<'a>>,
    /// The system is divided by this, so that neither a huge nor a tiny ε leaves the range of double precision.
    pub(in crate::smooth) scale: f64,
    /// The rows of A that belong to unknowns, where they make a symmetric matrix.
    pub(in crate::smooth) inner: Option<Inner<'a>>,
    /// Whether W = B⁻¹, so that the system is a product of two of first order.
    pub(in crate::smooth) splits: bool,
}

/// The rows of the unknowns, in the order of the columns.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct Inner<'a> {
    pub(in crate::smooth) matrix: &'a CscMatrix<f64>,
    /// The diagonal of W there.
    pub(in crate::smooth) weights: Option<&'a [f64]>,
}

/// εB.
#[derive(Clone, Copy)]
pub(in crate::smooth) struct Pull<'a> {
    pub(in crate::smooth) mass: &'a Mass,
    /// ε/scale.
    pub(in crate::smooth) epsilon: f64,
}

/// B on the unknowns.
#[derive(Debug)]
pub(in crate::smooth) enum Mass {
    Identity,
    Diagonal(Vec<f64>),
    Matrix(CscMatrix<f64>),
}

/// One right-hand side.
#[derive(Debug, Default)]
pub(in crate::smooth) struct Load {
    /// f: where the unknowns are pulled; empty without a pull.
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

impl Problem<'_> {
    pub(in crate::smooth) fn unknowns(&self) -> usize {
        self.matrix.ncols()
    }

    /// ε/scale; 0 without a pull.
    pub(in crate::smooth) fn epsilon(&self) -> f64 {
        self.pull.map_or(0.0, |pull| pull.epsilon)
    }

    /// Whether A itself, with all its rows, is symmetric.
    fn is_symmetric(&self) -> bool {
        self.inner.is_some_and(|inner| core::ptr::eq(inner.matrix, self.matrix))
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
        if self.order == Order::First {
            return image;
        }
        match self.weights {
            Some(weights) => image.iter_mut().zip(weights).for_each(|(y, w)| *y *= w / self.scale),
            None => image.iter_mut().for_each(|y| *y /= self.scale),
        }
        transposed_product(self.matrix, &image)
    }

    /// What the right-hand side is more than the matrix times x.
    pub(in crate::smooth) fn residual(&self, load: &Load, x: &[f64]) -> Vec<f64> {
        let mut residual = self.smoothing(x, &load.offset);
        match self.pull {
            Some(Pull { mass, epsilon }) => {
                let pull = mass.times(&difference(&load.field, x));
                residual.iter_mut().zip(pull).for_each(|(r, b)| *r = epsilon * b - *r);
            }
            None => residual.iter_mut().for_each(|r| *r = -*r),
        }
        residual
    }

    /// The matrix times x.
    pub(in crate::smooth) fn apply(&self, x: &[f64]) -> Vec<f64> {
        let mut image = self.smoothing(x, &[]);
        if let Some(Pull { mass, epsilon }) = self.pull {
            image.iter_mut().zip(mass.times(x)).for_each(|(l, b)| *l += epsilon * b);
        }
        image
    }

    /// The diagonal of the matrix.
    pub(in crate::smooth) fn diagonal(&self) -> Vec<f64> {
        let weight = |row: usize| self.weights.map_or(1.0, |weights| weights[row]);
        let mut diagonal = Vec::with_capacity(self.unknowns());
        for (j, column) in self.matrix.col_iter().enumerate() {
            let mut sum = 0.0;
            for (&row, v) in column.row_indices().iter().zip(column.values()) {
                match self.order {
                    Order::Squared => sum += v * v * weight(row),
                    Order::First if row == j => sum = *v,
                    Order::First => {}
                }
            }
            diagonal.push(sum / self.scale + self.pull.map_or(0.0, |pull| pull.epsilon * pull.mass.diagonal(j)));
        }
        diagonal
    }

    /// ‖b − Ax‖₂/‖b‖₂ of the whole system.
    pub(in crate::smooth) fn relative_residual(&self, load: &Load, x: &[f64]) -> f64 {
        let residual = norm(&self.residual(load, x));
        if residual == 0.0 {
            return 0.0;
        }
        residual
            / match self.pull {
                Some(Pull { mass, epsilon }) if load.offset.is_empty() => epsilon * norm(&mass.times(&load.field)),
                None if self.order == Order::First => norm(&load.offset),
                _ => norm(&self.residual(load, &vec![0.0; x.len()])),
            }
    }
}

impl Mass {
    #[inline(never)]
    pub(in crate::smooth) fn times(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Identity => x.to_vec(),
            Self::Diagonal(diagonal) => diagonal.iter().zip(x).map(|(d, x)| d * x).collect(),
            // Symmetric, so the product that gathers serves.
            Self::Matrix(matrix) => transposed_product(matrix, x),
        }
    }

    pub(in crate::smooth) fn diagonal(&self, i: usize) -> f64 {
        match self {
            Self::Identity => 1.0,
            Self::Diagonal(diagonal) => diagonal[i],
            Self::Matrix(matrix) => matrix.get_entry(i, i).map_or(0.0, |entry| entry.into_value()),
        }
    }

    /// ‖x‖_B
    pub(in crate::smooth) fn norm(&self, x: &[f64]) -> f64 {
        let square: f64 = self.times(x).iter().zip(x).map(|(a, b)| a * b).sum();
        square.max(0.0).sqrt()
    }
}
