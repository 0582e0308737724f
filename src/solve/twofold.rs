//! Sums of products in twice the precision: for residuals that tell what is wrong with a solution which is right but for rounding.

use nalgebra_sparse::CscMatrix;

/// A number as the sum of two that do not overlap, with about 32 digits (\[Dekker71\]).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Twofold {
    high: f64,
    low: f64,
}

impl From<f64> for Twofold {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl Twofold {
    /// a − b
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        sum(a, -b)
    }

    /// The nearest number.
    pub(crate) fn value(self) -> f64 {
        self.high
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let Self { high, low } = sum(self.high, other.high);
        short_sum(high, low + (self.low + other.low))
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Self { high: -other.high, low: -other.low })
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        let Self { high, low } = product(self.high, factor);
        short_sum(high, low + self.low * factor)
    }

    pub(crate) fn divided_by(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        let rest = self.minus(product(quotient, divisor));
        short_sum(quotient, rest.value() / divisor)
    }
}

/// a + b
fn sum(a: f64, b: f64) -> Twofold {
    let high = a + b;
    let part = high - a;
    Twofold { high, low: (a - (high - part)) + (b - part) }
}

/// a + b, where a is not the smaller one.
fn short_sum(a: f64, b: f64) -> Twofold {
    let high = a + b;
    Twofold { high, low: b - (high - a) }
}

/// a·b
fn product(a: f64, b: f64) -> Twofold {
    let high = a * b;
    let ((a, a_low), (b, b_low)) = (halves(a), halves(b));
    Twofold { high, low: ((a * b - high) + a * b_low + a_low * b) + a_low * b_low }
}

/// A number as the sum of two with half of its digits each.
fn halves(a: f64) -> (f64, f64) {
    /// 2²⁷ + 1
    const SPLIT: f64 = 134_217_729.0;
    let large = SPLIT * a;
    let high = large - (large - a);
    (high, a - high)
}

/// A·x
pub(crate) fn product_twofold(matrix: &CscMatrix<f64>, x: &[Twofold]) -> Vec<Twofold> {
    let mut image = vec![Twofold::default(); matrix.nrows()];
    for (column, &x) in matrix.col_iter().zip(x) {
        for (&row, &value) in column.row_indices().iter().zip(column.values()) {
            image[row] = image[row].plus(x.times(value));
        }
    }
    image
}

/// Aᵀ·x
pub(crate) fn transposed_product_twofold(matrix: &CscMatrix<f64>, x: &[Twofold]) -> Vec<Twofold> {
    let times = |column: nalgebra_sparse::csc::CscCol<'_, f64>| {
        let products = column.row_indices().iter().zip(column.values()).map(|(&row, &value)| x[row].times(value));
        products.fold(Twofold::default(), Twofold::plus)
    };
    matrix.col_iter().map(times).collect()
}
