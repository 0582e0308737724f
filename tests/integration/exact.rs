//! Dense linear algebra with about 32 digits (pairs of doubles, [Dekker71]; Knuth's TwoSum): a reference whose rounding does
//! not matter where double precision loses everything.

use core::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::DMatrix;

/// An unevaluated sum of two doubles, the second below half a unit in the last place of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Double(f64, f64);

impl Double {
    pub(crate) fn value(self) -> f64 {
        self.0 + self.1
    }
}

impl From<f64> for Double {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}

fn two_sum(a: f64, b: f64) -> Double {
    let s = a + b;
    let t = s - a;
    Double(s, (a - (s - t)) + (b - t))
}

fn two_product(a: f64, b: f64) -> Double {
    let p = a * b;
    Double(p, a.mul_add(b, -p))
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (two_sum(self.0, other.0), two_sum(self.1, other.1));
        let v = two_sum(s.0, s.1 + t.0);
        two_sum(v.0, v.1 + t.1)
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.0, other.0);
        two_sum(p.0, p.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let q = Self::from(self.0 / other.0);
        let r = self - q * other;
        let q2 = Self::from(r.0 / other.0);
        let r = r - q2 * other;
        q + q2 + Self::from(r.0 / other.0)
    }
}

/// Solves (LᵀL + εB) x = εBf.
pub(crate) fn tikhonov(laplacian: &DMatrix<f64>, mass: &DMatrix<f64>, epsilon: f64, f: &[f64]) -> Vec<f64> {
    weighted_tikhonov(laplacian, &vec![1.0; f.len()], mass, epsilon, f)
}

/// Solves (LᵀW⁻¹L + εB) x = εBf with the diagonal of W, by elimination without pivoting, which a definite matrix allows.
pub(crate) fn weighted_tikhonov(
    laplacian: &DMatrix<f64>,
    weights: &[f64],
    mass: &DMatrix<f64>,
    epsilon: f64,
    f: &[f64],
) -> Vec<f64> {
    let n = f.len();
    let zero = Double::from(0.0);
    let e = Double::from(epsilon);
    let mut rows: Vec<Vec<Double>> = vec![vec![zero; n + 1]; n];
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                let (a, b) = (laplacian[(k, i)], laplacian[(k, j)]);
                if a != 0.0 && b != 0.0 {
                    rows[i][j] = rows[i][j] + two_product(a, b) / Double::from(weights[k]);
                }
            }
            let b = e * Double::from(mass[(i, j)]);
            rows[i][j] = rows[i][j] + b;
            rows[i][n] = rows[i][n] + b * Double::from(f[j]);
        }
    }
    for p in 0..n {
        assert!(rows[p][p].value() > 0.0, "definite");
        for i in p + 1..n {
            if rows[i][p].value() != 0.0 {
                let factor = rows[i][p] / rows[p][p];
                for j in p..=n {
                    rows[i][j] = rows[i][j] - factor * rows[p][j];
                }
            }
        }
    }
    let mut x = vec![zero; n];
    for i in (0..n).rev() {
        let known = (i + 1..n).fold(rows[i][n], |sum, j| sum - rows[i][j] * x[j]);
        x[i] = known / rows[i][i];
    }
    x.into_iter().map(Double::value).collect()
}

#[test]
fn the_reference_itself_has_thirty_digits() {
    // (1 + 2⁻⁷⁰)² − 1 = 2⁻⁶⁹ + 2⁻¹⁴⁰, and a third times three.
    let tiny = 2.0_f64.powi(-70);
    let x = Double::from(1.0) + Double::from(tiny);
    assert_eq!((x * x - Double::from(1.0)).value(), 2.0 * tiny);
    let third = Double::from(1.0) / Double::from(3.0);
    assert!((third * Double::from(3.0) - Double::from(1.0)).value().abs() < 1e-31);
    // A path of two with w = 1: L = [[1, −1], [−1, 1]], so x = mean ± difference/2 · ε/(4 + ε).
    let path = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
    let x = tikhonov(&path, &DMatrix::identity(2, 2), 1e-12, &[0.0, 1.0]);
    let damped = 0.5 * 1e-12 / (4.0 + 1e-12);
    assert!(((x[1] - 0.5) - damped).abs() < 1e-16 && ((0.5 - x[0]) - damped).abs() < 1e-16);
}
