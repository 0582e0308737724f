//! The systems of all ε, projected onto a small space and brought into diagonal form.

use super::eigen::eigen;
use super::small::Symmetric;

/// (S + εB) x = εBf on a space, in coordinates in which S and B are diagonal.
#[derive(Debug, Clone, Default)]
pub(super) struct Pencil {
    /// The diagonals of S and of σB, which add up to 1.
    smoothness: Vec<f64>,
    data: Vec<f64>,
    /// The vectors that the coordinates belong to, in the basis of the space.
    vectors: Vec<Vec<f64>>,
    /// Bf on those vectors.
    loads: Vec<f64>,
    sigma: f64,
}

/// A data part of a coordinate that is zero but for rounding.
const NO_DATA: f64 = 1e-15;

impl Pencil {
    /// `columns`: orthonormal vectors in the coordinates of a basis for which the matrices of S and B are given, and the products
    /// `loads` with Bf. Nothing where S + σB is not positive definite.
    pub(super) fn new(
        columns: &[Vec<f64>],
        smooth: &Symmetric,
        data: &Symmetric,
        loads: &[f64],
        sigma: f64,
    ) -> Option<Self> {
        let (s, b) = (smooth.between(columns), data.between(columns));
        let whitened = s.plus(sigma, &b).inverse_root()?;
        let (smoothness, rotations) = eigen(&s.between(&whitened));
        let size = loads.len();
        let mut vectors = Vec::with_capacity(columns.len());
        for rotation in &rotations {
            let inner = combined(&whitened, rotation, columns.len());
            vectors.push(combined(columns, &inner, size));
        }
        let data_parts = vectors.iter().map(|vector| (sigma * data.quadratic(vector)).max(0.0)).collect();
        let loads = vectors.iter().map(|vector| vector.iter().zip(loads).map(|(a, b)| a * b).sum()).collect();
        let smoothness = smoothness.iter().map(|value| value.max(0.0)).collect();
        Some(Self { smoothness, data: data_parts, vectors, loads, sigma })
    }

    /// What the system for ε divides each coordinate by.
    fn divisors(&self, epsilon: f64) -> impl Iterator<Item = f64> {
        let ratio = epsilon / self.sigma;
        self.smoothness.iter().zip(&self.data).map(move |(s, b)| s + ratio * b)
    }

    /// The solution's coordinates.
    fn amplitudes(&self, epsilon: f64) -> Vec<f64> {
        // Divided by ε, so that rounding leaves their sizes monotone in ε.
        let divisors = self.smoothness.iter().zip(&self.data).map(|(s, b)| s / epsilon + b / self.sigma);
        divisors.zip(&self.loads).map(|(divisor, load)| load / divisor).collect()
    }

    /// The solution in the basis of the space.
    pub(super) fn coefficients(&self, epsilon: f64) -> Vec<f64> {
        combined(&self.vectors, &self.amplitudes(epsilon), self.vectors.first().map_or(0, Vec::len))
    }

    /// xᵀSx.
    pub(super) fn smoothness_energy(&self, epsilon: f64) -> f64 {
        self.amplitudes(epsilon).iter().zip(&self.smoothness).map(|(x, s)| s * x * x).sum()
    }

    /// ‖x − p‖²_B for the projection p of f to the space: what falls as ε grows.
    pub(super) fn misfit(&self, epsilon: f64) -> f64 {
        let mut sum = 0.0;
        for ((divisor, load), (s, b)) in
            self.divisors(epsilon).zip(&self.loads).zip(self.smoothness.iter().zip(&self.data))
        {
            if *b > NO_DATA {
                let difference = load * (s / divisor);
                sum += difference * difference * self.sigma / b;
            }
        }
        sum
    }

    /// ‖p‖²_B.
    pub(super) fn projected(&self) -> f64 {
        let parts = self.loads.iter().zip(&self.data).filter(|(_, b)| **b > NO_DATA);
        parts.map(|(load, b)| load * load * self.sigma / b).sum()
    }

    /// ln Π d over all coordinates but that of the kernel, of which there is one if `has_kernel`.
    pub(super) fn log_divisors(&self, epsilon: f64, has_kernel: bool) -> f64 {
        let kernel = self.smoothness.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).map(|(place, _)| place);
        let divisors = self.divisors(epsilon).enumerate();
        let others = divisors.filter(|(place, _)| !has_kernel || Some(*place) != kernel);
        others.map(|(_, divisor)| libm::log(divisor.max(f64::MIN_POSITIVE))).sum()
    }
}

/// Σ c v.
fn combined(vectors: &[Vec<f64>], coefficients: &[f64], length: usize) -> Vec<f64> {
    let mut sum = vec![0.0; length];
    for (vector, c) in vectors.iter().zip(coefficients) {
        sum.iter_mut().zip(vector).for_each(|(x, v)| *x += c * v);
    }
    sum
}
