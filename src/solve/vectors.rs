//! Several vectors at a time: each number that comes from memory is used for a few results.

use super::lanes::{Doubles, Lanes, sum_products};
use crate::error::Cancelled;
use crate::support::watch::Watch;

/// So many elements of a handful of vectors stay in the processor's nearest cache.
const PIECE: usize = 256;

/// For each of `ys` its products xᵀy with all of `xs`. All have the same length.
///
/// # Errors
/// `Cancelled`.
///
/// # Panics
/// Where lengths differ.
pub(crate) fn dot_products(xs: &[Vec<f64>], ys: &[Vec<f64>], watch: &Watch<'_>) -> Result<Vec<Vec<f64>>, Cancelled> {
    let length = ys.first().map_or(0, Vec::len);
    let mut products = vec![vec![0.0; xs.len()]; ys.len()];
    for start in (0..length).step_by(PIECE) {
        let part = start..length.min(start + PIECE);
        watch.tick((xs.len() * ys.len() * part.len() / 2) as u64)?;
        for i in (0..xs.len()).step_by(2) {
            // An odd one out is its own neighbour.
            let i1 = (i + 1).min(xs.len() - 1);
            let x = [&xs[i][part.clone()], &xs[i1][part.clone()]];
            for j in (0..ys.len()).step_by(2) {
                let j1 = (j + 1).min(ys.len() - 1);
                let sums = four_products(x, [&ys[j][part.clone()], &ys[j1][part.clone()]]);
                products[j][i] += sums[0];
                if i1 > i {
                    products[j][i1] += sums[1];
                }
                if j1 > j {
                    products[j1][i] += sums[2];
                }
                if i1 > i && j1 > j {
                    products[j1][i1] += sums[3];
                }
            }
        }
    }
    Ok(products)
}

/// The products of two vectors with two others.
#[inline(never)]
fn four_products(x: [&[f64]; 2], y: [&[f64]; 2]) -> [f64; 4] {
    let zero = Doubles::load(&[0.0; 4]);
    let [mut s0, mut s1, mut s2, mut s3] = [zero; 4];
    let ([(x0, x0_rest), (x1, x1_rest)], [(y0, y0_rest), (y1, y1_rest)]) =
        (x.map(|x| x.as_chunks::<4>()), y.map(|y| y.as_chunks::<4>()));
    for ((x0, x1), (y0, y1)) in x0.iter().zip(x1).zip(y0.iter().zip(y1)) {
        let (a, b) = (Doubles::load(x0), Doubles::load(x1));
        let c = Doubles::load(y0);
        s0 = s0.plus_product(a, c);
        s1 = s1.plus_product(b, c);
        let d = Doubles::load(y1);
        s2 = s2.plus_product(a, d);
        s3 = s3.plus_product(b, d);
    }
    let rest = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let rests = [rest(x0_rest, y0_rest), rest(x1_rest, y0_rest), rest(x0_rest, y1_rest), rest(x1_rest, y1_rest)];
    let mut products = [0.0; 4];
    for ((product, sums), rest) in products.iter_mut().zip([s0, s1, s2, s3]).zip(rests) {
        let [a, b, c, d] = sums.store();
        *product = (a + b) + (c + d) + rest;
    }
    products
}

/// A few elements of many vectors, side by side, four elements of a vector at a time.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    rows: Vec<[f64; 4]>,
    vectors: usize,
}

impl Rows {
    /// Takes the elements from `start` on, up to so many; zeros where there are none.
    pub(crate) fn gather(&mut self, vectors: &[Vec<f64>], start: usize, count: usize) {
        let fours = count.div_ceil(4);
        self.vectors = vectors.len();
        self.rows.clear();
        self.rows.resize(fours * vectors.len(), [0.0; 4]);
        for (place, vector) in vectors.iter().enumerate() {
            let part = &vector[start..vector.len().min(start + count)];
            for (row, elements) in self.rows[place..].iter_mut().step_by(vectors.len()).zip(part.chunks(4)) {
                row[..elements.len()].copy_from_slice(elements);
            }
        }
    }

    /// Four elements of four sums Σ c v, for each four elements in turn: lists of coefficients of four sums are side by side.
    pub(crate) fn combinations<'a>(&'a self, coefficients: &'a [[f64; 4]]) -> impl Iterator<Item = [[f64; 4]; 4]> + 'a {
        self.rows.chunks_exact(self.vectors.max(1)).map(|row| combined(row, coefficients))
    }
}

#[inline(never)]
fn combined(row: &[[f64; 4]], coefficients: &[[f64; 4]]) -> [[f64; 4]; 4] {
    let sums = [Doubles::load(&[0.0; 4]); 4];
    sum_products::<true, _, _>(sums, row.iter().zip(coefficients), |a| a, |b, j| b[j]).map(Lanes::store)
}
