//! The vectors that a space grows by, all of a shift at once: what the space has of them is read from memory once for all.

use super::small::{DEPENDENT, add_combination, dot};
use crate::error::Cancelled;
use crate::smooth::system::Matrices;
use crate::solve::{dot_products, norm, product, transposed_product};
use crate::support::watch::Watch;

/// Vectors with what the norm of S + σB needs of them.
pub(super) struct Block<'a> {
    matrices: &'a Matrices,
    sigma: f64,
    pub(super) vectors: Vec<Vec<f64>>,
    /// √W·L times the vectors.
    pub(super) images: Vec<Vec<f64>>,
    /// B times the vectors.
    pub(super) masses: Vec<Vec<f64>>,
}

/// What a vector was, in the basis that is there and in the block's own after it; and whether it is one of these.
struct Share {
    of_basis: Vec<f64>,
    of_block: Vec<f64>,
    is_kept: bool,
}

/// What is left of a vector of length 1 that was independent of the others before rounding took the rest.
const COLLAPSED: f64 = 1e-3;

impl<'a> Block<'a> {
    /// Zeros, and what is no number, are left out.
    pub(super) fn new(mut vectors: Vec<Vec<f64>>, matrices: &'a Matrices, sigma: f64) -> Self {
        vectors.retain_mut(|vector| {
            let size = norm(vector);
            vector.iter_mut().for_each(|x| *x /= size);
            size > 0.0 && size.is_finite()
        });
        Self { matrices, sigma, vectors, images: Vec::new(), masses: Vec::new() }
    }

    /// Makes them orthonormal, also to a basis with its images, and leaves out those that depend on others. Returns for each of those
    /// that stay what it was: its coordinates in the basis followed by those that stay.
    pub(super) fn orthonormalize(
        &mut self,
        basis: &[Vec<f64>],
        images: &[Vec<f64>],
        watch: &Watch<'_>,
    ) -> Result<Vec<Vec<f64>>, Cancelled> {
        self.measure(watch)?;
        let least: Vec<f64> = (0..self.vectors.len()).map(|k| DEPENDENT * self.size(k)).collect();
        let mut first = self.pass(basis, images, &least, watch)?;
        first.retain(|share| share.is_kept);
        // Twice is enough for orthogonality to rounding.
        self.measure(watch)?;
        let second = self.pass(basis, images, &vec![COLLAPSED; first.len()], watch)?;
        let mut coordinates = Vec::with_capacity(second.len());
        for (share, itself) in first.into_iter().zip(&second) {
            if itself.is_kept {
                let mut sum = share.of_basis;
                sum.resize(basis.len() + itself.of_block.len(), 0.0);
                for (scale, other) in share.of_block.iter().zip(&second) {
                    let parts = other.of_basis.iter().enumerate();
                    let own = other.of_block.iter().enumerate().map(|(j, part)| (basis.len() + j, part));
                    parts.chain(own).for_each(|(place, part)| sum[place] += scale * part);
                }
                coordinates.push(sum);
            }
        }
        Ok(coordinates)
    }

    /// Takes away what the basis has of them, and what each has of those before it; each is left out where no more than so much stays.
    fn pass(
        &mut self,
        basis: &[Vec<f64>],
        images: &[Vec<f64>],
        least: &[f64],
        watch: &Watch<'_>,
    ) -> Result<Vec<Share>, Cancelled> {
        let mut shares = dot_products(images, &self.images, watch)?;
        let by_mass = dot_products(basis, &self.masses, watch)?;
        for (sums, others) in shares.iter_mut().zip(by_mass) {
            sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += self.sigma * other);
        }
        for (vector, shares) in self.vectors.iter_mut().zip(&shares) {
            watch.tick((basis.len() * vector.len() / 4) as u64)?;
            add_combination(vector, basis, &shares.iter().map(|share| -share).collect::<Vec<_>>());
        }
        self.measure(watch)?;
        let count = self.vectors.len();
        let mut found = Vec::with_capacity(count);
        let mut kept = 0;
        for (k, of_basis) in shares.into_iter().enumerate() {
            watch.tick((3 * kept * self.vectors[k].len()) as u64)?;
            let mut of_block = Vec::with_capacity(kept + 1);
            for j in 0..kept {
                let share = dot(&self.images[j], &self.images[k]) + self.sigma * dot(&self.vectors[j], &self.masses[k]);
                of_block.push(share);
                for vectors in [&mut self.vectors, &mut self.images, &mut self.masses] {
                    let (before, own) = vectors.split_at_mut(k);
                    own[0].iter_mut().zip(&before[j]).for_each(|(x, other)| *x -= share * other);
                }
            }
            let rest = self.size(k);
            let is_kept = rest > least[k];
            if is_kept {
                of_block.push(rest);
                for vectors in [&mut self.vectors, &mut self.images, &mut self.masses] {
                    vectors[k].iter_mut().for_each(|x| *x /= rest);
                    vectors.swap(kept, k);
                }
                kept += 1;
            }
            found.push(Share { of_basis, of_block, is_kept });
        }
        for vectors in [&mut self.vectors, &mut self.images, &mut self.masses] {
            vectors.truncate(kept);
        }
        Ok(found)
    }

    fn measure(&mut self, watch: &Watch<'_>) -> Result<(), Cancelled> {
        self.images.clear();
        self.masses.clear();
        for vector in &self.vectors {
            watch.tick(20 * vector.len() as u64)?;
            self.images.push(image(self.matrices, vector));
            self.masses.push(self.matrices.mass().times(vector));
        }
        Ok(())
    }

    /// ‖v‖ in the norm of S + σB.
    fn size(&self, k: usize) -> f64 {
        let (image, vector, mass) = (&self.images[k], &self.vectors[k], &self.masses[k]);
        (dot(image, image) + self.sigma * dot(vector, mass)).max(0.0).sqrt()
    }
}

/// √W·Lx.
fn image(matrices: &Matrices, x: &[f64]) -> Vec<f64> {
    let laplacian = matrices.laplacian();
    let mut image = if matrices.is_symmetric() { transposed_product(laplacian, x) } else { product(laplacian, x) };
    if let Some(weights) = matrices.weights() {
        image.iter_mut().zip(weights).for_each(|(y, w)| *y *= w.sqrt());
    }
    image
}
