//! Eigenvalues and eigenvectors of small symmetric matrices: Householder's reflections make them tridiagonal, the rotations of the QL
//! algorithm diagonal.

use super::small::Symmetric;

/// Rotations from end to end after which an eigenvalue is there; three are usual.
const MOST_SWEEPS: usize = 60;

/// All eigenvalues, with their orthonormal eigenvectors.
pub(super) fn eigen(matrix: &Symmetric) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut columns = matrix.full();
    let (mut diagonal, mut beside) = tridiagonal(&mut columns);
    diagonalize(&mut diagonal, &mut beside, &mut columns);
    (diagonal, columns)
}

/// Overwrites a symmetric matrix with the columns of Q, where QᵀAQ has this diagonal and these entries beside it, of which the first
/// one is zero.
fn tridiagonal(q: &mut [Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
    let n = q.len();
    let (mut diagonal, mut beside) = (vec![0.0; n], vec![0.0; n]);
    // Householder's vectors u, each with 2/uᵀu, from the last row up.
    let mut reflections: Vec<(Vec<f64>, f64)> = Vec::with_capacity(n);
    for i in (1..n).rev() {
        let mut u = q[i][..i].to_vec();
        diagonal[i] = q[i][i];
        let beyond: f64 = u[..i - 1].iter().map(|x| x * x).sum();
        if beyond == 0.0 {
            beside[i] = u[i - 1];
            reflections.push((u, 0.0));
            continue;
        }
        let size = (beyond + u[i - 1] * u[i - 1]).sqrt();
        let sign = if u[i - 1] < 0.0 { -1.0 } else { 1.0 };
        beside[i] = -sign * size;
        u[i - 1] += sign * size;
        let scale = 2.0 / (beyond + u[i - 1] * u[i - 1]);
        // A − u pᵀ − p uᵀ with p = s Au − (s²/2) uᵀAu u.
        let mut p: Vec<f64> = (0..i).map(|k| scale * sum_of_products(&q[k][..i], &u)).collect();
        let share = 0.5 * scale * sum_of_products(&p, &u);
        p.iter_mut().zip(&u).for_each(|(p, u)| *p -= share * u);
        for k in 0..i {
            for j in 0..i {
                q[k][j] -= u[k] * p[j] + p[k] * u[j];
            }
        }
        reflections.push((u, scale));
    }
    if let Some(first) = q.first() {
        diagonal[0] = first[0];
    }
    // Q is the product of the reflections, from the last row's on.
    for (j, column) in q.iter_mut().enumerate() {
        column.fill(0.0);
        column[j] = 1.0;
        for (u, scale) in reflections.iter().rev() {
            let share = scale * sum_of_products(u, column);
            column.iter_mut().zip(u).for_each(|(x, u)| *x -= share * u);
        }
    }
    (diagonal, beside)
}

/// Makes a tridiagonal matrix diagonal, by rotations of the columns that are given, with Wilkinson's shifts.
fn diagonalize(diagonal: &mut [f64], beside: &mut [f64], columns: &mut [Vec<f64>]) {
    let n = diagonal.len();
    beside.rotate_left(n.min(1));
    for first in 0..n {
        for _ in 0..MOST_SWEEPS {
            let is_split = |m: &usize| {
                let size = diagonal[*m].abs() + diagonal[*m + 1].abs();
                beside[*m].abs() <= f64::EPSILON * size || beside[*m].abs() < f64::MIN_POSITIVE
            };
            let last = (first..n - 1).find(is_split).unwrap_or(n - 1);
            if last == first {
                break;
            }
            let half = (diagonal[first + 1] - diagonal[first]) / (2.0 * beside[first]);
            let root = (half * half + 1.0).sqrt();
            let away = if half < 0.0 { half - root } else { half + root };
            let mut g = diagonal[last] - diagonal[first] + beside[first] / away;
            let (mut sine, mut cosine, mut moved) = (1.0, 1.0, 0.0);
            let mut is_done = true;
            for i in (first..last).rev() {
                let (f, b) = (sine * beside[i], cosine * beside[i]);
                let size = (f * f + g * g).sqrt();
                beside[i + 1] = size;
                if size == 0.0 {
                    diagonal[i + 1] -= moved;
                    beside[last] = 0.0;
                    is_done = false;
                    break;
                }
                (sine, cosine) = (f / size, g / size);
                g = diagonal[i + 1] - moved;
                let turned = (diagonal[i] - g) * sine + 2.0 * cosine * b;
                moved = sine * turned;
                diagonal[i + 1] = g + moved;
                g = cosine * turned - b;
                let (before, after) = columns.split_at_mut(i + 1);
                for (x, y) in before[i].iter_mut().zip(&mut after[0]) {
                    (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
                }
            }
            if is_done {
                diagonal[first] -= moved;
                beside[first] = g;
                beside[last] = 0.0;
            }
        }
    }
}

fn sum_of_products(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}
