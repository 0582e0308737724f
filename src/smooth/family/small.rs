//! Small symmetric matrices, as large as the space of a family.

/// A symmetric matrix that grows by a row at a time; its lower triangle.
#[derive(Debug, Clone, Default)]
pub(super) struct Symmetric {
    rows: Vec<Vec<f64>>,
}

impl Symmetric {
    pub(super) fn size(&self) -> usize {
        self.rows.len()
    }

    /// Keeps the first rows alone.
    pub(super) fn truncate(&mut self, size: usize) {
        self.rows.truncate(size);
    }

    /// Adds a row: its entries up to the diagonal.
    pub(super) fn push(&mut self, row: Vec<f64>) {
        debug_assert_eq!(row.len(), self.rows.len() + 1);
        self.rows.push(row);
    }

    /// Adds rows, of which what is beyond the diagonal is left out.
    pub(super) fn grow(&mut self, rows: Vec<Vec<f64>>) {
        for mut row in rows {
            row.truncate(self.size() + 1);
            self.push(row);
        }
    }

    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.size()];
        for (i, row) in self.rows.iter().enumerate() {
            // The row left of the diagonal is the column above it.
            let Some((diagonal, before)) = row.split_last() else { continue };
            let mut sum = diagonal * x[i];
            for ((a, x_j), y) in before.iter().zip(x).zip(&mut result) {
                sum += a * x_j;
                *y += a * x[i];
            }
            result[i] += sum;
        }
        result
    }

    /// xᵀAx.
    pub(super) fn quadratic(&self, x: &[f64]) -> f64 {
        self.times(x).iter().zip(x).map(|(a, b)| a * b).sum()
    }

    /// QᵀAQ, for the columns of Q.
    pub(super) fn between(&self, columns: &[Vec<f64>]) -> Self {
        let images: Vec<Vec<f64>> = columns.iter().map(|column| self.times(column)).collect();
        let mut result = Self::default();
        for (i, column) in columns.iter().enumerate() {
            result.push(images[..=i].iter().map(|image| dot(column, image)).collect());
        }
        result
    }

    /// A + sB.
    pub(super) fn plus(&self, scale: f64, other: &Self) -> Self {
        let sum = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a + scale * b).collect();
        Self { rows: self.rows.iter().zip(&other.rows).map(sum).collect() }
    }

    /// The columns of M⁻ᵀ for the Cholesky factor M of a positive definite matrix; nothing where it is not so.
    pub(super) fn inverse_root(&self) -> Option<Vec<Vec<f64>>> {
        let size = self.size();
        let mut factor = self.rows.clone();
        for i in 0..size {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let rest = factor[i][j] - known;
                factor[i][j] = if i > j {
                    rest / factor[j][j]
                } else if rest > 0.0 {
                    rest.sqrt()
                } else {
                    return None;
                };
            }
        }
        // The rows of M⁻¹, one column of M⁻ᵀ each.
        let mut columns: Vec<Vec<f64>> = Vec::with_capacity(size);
        for i in 0..size {
            let mut column = vec![0.0; size];
            for j in 0..=i {
                let unit = f64::from(u8::from(i == j));
                let known: f64 = (j..i).map(|k| factor[i][k] * columns[k][j]).sum();
                column[j] = (unit - known) / factor[i][i];
            }
            columns.push(column);
        }
        Some(columns)
    }

    /// All its entries, row by row.
    pub(super) fn full(&self) -> Vec<Vec<f64>> {
        let size = self.size();
        (0..size).map(|i| (0..size).map(|j| self.rows[i.max(j)][i.min(j)]).collect()).collect()
    }
}

/// Orthonormal columns that span the same space, without those that depend on the ones before.
pub(super) fn orthonormal(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut kept: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    for column in columns {
        let mut column = column.clone();
        let size = dot(&column, &column).sqrt();
        // Twice is enough for orthogonality to rounding.
        for _ in 0..2 {
            for other in &kept {
                let share = dot(other, &column);
                column.iter_mut().zip(other).for_each(|(x, y)| *x -= share * y);
            }
        }
        let rest = dot(&column, &column).sqrt();
        if rest > DEPENDENT * size {
            column.iter_mut().for_each(|x| *x /= rest);
            kept.push(column);
        }
    }
    kept
}

/// What is left of a vector, relative to it, where it depends on others but for rounding.
pub(super) const DEPENDENT: f64 = 1e-12;

/// xᵀy, by four sums, which is four times as fast.
#[inline(never)]
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (blocks, others) = (x.chunks_exact(4), y.chunks_exact(4));
    let rest: f64 = blocks.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in blocks.zip(others) {
        for i in 0..4 {
            sums[i] += a[i] * b[i];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// x + Σ c v, four vectors at a time.
#[inline(never)]
pub(super) fn add_combination(x: &mut [f64], vectors: &[Vec<f64>], coefficients: &[f64]) {
    let part = ..x.len();
    let mut blocks = vectors.chunks_exact(4);
    let mut shares = coefficients.chunks_exact(4);
    for (block, c) in (&mut blocks).zip(&mut shares) {
        let n = x.len();
        let [v0, v1, v2, v3] = [0, 1, 2, 3].map(|k| &block[k][part]);
        for i in 0..n {
            x[i] += (c[0] * v0[i] + c[1] * v1[i]) + (c[2] * v2[i] + c[3] * v3[i]);
        }
    }
    for (vector, c) in blocks.remainder().iter().zip(shares.remainder()) {
        x.iter_mut().zip(&vector[part]).for_each(|(x, v)| *x += c * v);
    }
}
