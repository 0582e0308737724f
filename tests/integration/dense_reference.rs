//! Constrained systems by dense algebra: elimination in double precision, corrected by residuals with 32 digits until they
//! bring nothing more. Residuals are those of the factored form, so that the conditioning of LᵀL does not matter.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale, lumped_mass_diagonal};
use morse_smooth::smooth::{Constraints, Energy, Operator, Smoother, SmootherOptions, SolverChoice, Unconstrained};
use nalgebra::{DMatrix, DVector};

use crate::exact::Double;
use crate::operators::ALL_WEIGHTS;
use crate::support::{dense, jittered_plane, random_complex, random_surface, two_tetrahedra_at_an_edge};

/// All weights, and finite elements.
pub(crate) fn settings() -> Vec<(LaplacianWeights, Operator)> {
    let paper = ALL_WEIGHTS.into_iter().map(|weights| (weights, Operator::Paper));
    paper.chain([(LaplacianWeights::Cotangent, Operator::Fem)]).collect()
}

pub(crate) fn smoother(
    mesh: &TriMesh,
    (weights, operator): (LaplacianWeights, Operator),
    solver: SolverChoice,
) -> Smoother {
    Smoother::new(mesh, SmootherOptions { weights, operator, solver, ..SmootherOptions::default() }).unwrap()
}

pub(crate) fn named(vertices: &[u32], unconstrained: Unconstrained) -> Constraints<'_> {
    Constraints { features: morse_smooth::field::Features::Vertices(vertices), stars: false, unconstrained }
}

/// Meshes beside each other, with two isolated vertices and a triangle without area at the first edge.
pub(crate) fn together(parts: &[TriMesh]) -> TriMesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (number, part) in parts.iter().enumerate() {
        let first = (positions.len() / 3) as u32;
        positions.extend(part.positions().iter().map(|x| x + 7.0 * number as f64));
        triangles.extend(part.connectivity().triangles().as_flattened().iter().map(|v| v + first));
        positions.extend([3.0 + number as f64, 40.0, 50.0]);
    }
    let (a, b) = (triangles[0], triangles[1]);
    let middle: Vec<f64> =
        (0..3).map(|k| 0.5 * (positions[3 * a as usize + k] + positions[3 * b as usize + k])).collect();
    triangles.extend([a, b, (positions.len() / 3) as u32]);
    positions.extend(middle);
    TriMesh::new(positions, triangles).unwrap()
}

/// Closed, open, in parts, not manifold.
pub(crate) fn meshes() -> Vec<(&'static str, TriMesh)> {
    let torus = |around, across| shapes::torus(around, across, 0.35).unwrap();
    vec![
        ("torus", torus(19, 16)),
        ("plane", jittered_plane(17, 16, 3)),
        ("two components", together(&[torus(13, 10), shapes::sphere(2).unwrap()])),
        ("holes and pinches", random_surface(5, &torus(18, 14), 0.3)),
        ("sheets at edges", random_complex(11, 14, 120)),
        ("two tetrahedra at an edge", two_tetrahedra_at_an_edge()),
    ]
}

/// The operator of a smoother as a dense matrix, with its components.
pub(crate) struct Reference {
    pub(crate) laplacian: DMatrix<f64>,
    /// The diagonal of W in LᵀWL.
    pub(crate) weights: Vec<f64>,
    /// Of every vertex that the operator ties to another one.
    pub(crate) component: Vec<Option<usize>>,
}

impl Reference {
    pub(crate) fn new(smoother: &Smoother) -> Self {
        let laplacian = dense(smoother.laplacian());
        let n = laplacian.ncols();
        let weights = match smoother.options().operator {
            Operator::Paper => vec![1.0; n],
            Operator::Fem => {
                let areas = lumped_mass_diagonal(smoother.mesh(), MassScale::Raw).unwrap();
                areas.iter().map(|&area| if area > 0.0 { 1.0 / area } else { 0.0 }).collect()
            }
        };
        let mut component: Vec<Option<usize>> =
            (0..n).map(|v| laplacian.column(v).iter().any(|&x| x != 0.0).then_some(v)).collect();
        loop {
            let before = component.clone();
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                if laplacian[(i, j)] != 0.0 {
                    component[i] = component[i].min(component[j]);
                }
            }
            if component == before {
                break;
            }
        }
        Self { laplacian, weights, component }
    }

    /// The vertices of the components that have a constrained one.
    pub(crate) fn reached(&self, constrained: &[u32]) -> Vec<usize> {
        let components: Vec<usize> = constrained.iter().filter_map(|&v| self.component[v as usize]).collect();
        (0..self.component.len()).filter(|&v| self.component[v].is_some_and(|c| components.contains(&c))).collect()
    }

    /// The unknowns of an interpolation.
    pub(crate) fn free(&self, constrained: &[u32]) -> Vec<usize> {
        self.reached(constrained).into_iter().filter(|&v| !constrained.contains(&(v as u32))).collect()
    }

    /// Those of some vertices that are solved for: not those of components with a single constrained vertex, whose value they take.
    pub(crate) fn solved(&self, vertices: &[usize], constrained: &[u32]) -> usize {
        let components: Vec<usize> = constrained.iter().filter_map(|&v| self.component[v as usize]).collect();
        let is_single = |component| components.iter().filter(|&&c| Some(c) == component).count() == 1;
        vertices.iter().filter(|&&v| !is_single(self.component[v])).count()
    }

    /// The rows that an energy asks for, on the free columns, and the square roots of their weights.
    pub(crate) fn rows(&self, energy: Energy, free: &[usize]) -> (Vec<usize>, Vec<f64>) {
        match energy {
            Energy::Harmonic => (free.to_vec(), vec![1.0; free.len()]),
            Energy::Biharmonic => ((0..self.weights.len()).collect(), self.weights.clone()),
        }
    }

    /// Interpolates; components without a constrained vertex stay.
    pub(crate) fn interpolated(&self, f: &[f64], constrained: &[u32], energy: Energy) -> Vec<f64> {
        let free = self.free(constrained);
        let (rows, weights) = self.rows(energy, &free);
        let a = self.laplacian.select_rows(&rows).select_columns(&free);
        let mut fixed = DVector::from_column_slice(f);
        free.iter().for_each(|&v| fixed[v] = 0.0);
        let rest = self.laplacian.select_rows(&rows);
        let (matrix, residual): (_, Box<Residual<'_>>) = match energy {
            Energy::Harmonic => {
                let residual = |g: &[f64]| {
                    let image = sum(times(&a, &exactly(g)), &times(&rest, &exactly(fixed.as_slice())));
                    image.iter().map(|r| (-*r).value()).collect()
                };
                (a.clone(), Box::new(residual))
            }
            Energy::Biharmonic => {
                let residual = |g: &[f64]| {
                    let image = sum(times(&a, &exactly(g)), &times(&rest, &exactly(fixed.as_slice())));
                    let weighted: Vec<Double> = image.iter().zip(&weights).map(|(x, &w)| *x * w.into()).collect();
                    times(&a.transpose(), &weighted).iter().map(|r| (-*r).value()).collect()
                };
                (squared(&a, &weights), Box::new(residual))
            }
        };
        let mut x = f.to_vec();
        free.iter().zip(solve(matrix, &*residual)).for_each(|(&v, value)| x[v] = value);
        x
    }

    /// Solves (LᵀWL + εΔ) x = εΔf; components without a constrained vertex stay. `pull` has Δ for every vertex.
    pub(crate) fn least_squares(&self, f: &[f64], pull: &[f64], epsilon: f64) -> Vec<f64> {
        let constrained: Vec<u32> = (0..pull.len() as u32).filter(|&v| pull[v as usize] > 0.0).collect();
        let pull = DMatrix::from_diagonal(&DVector::from_column_slice(pull));
        self.regularized(f, &pull, &self.reached(&constrained), epsilon)
    }

    /// Solves (LᵀWL + εB) x = εBf for these vertices; the others stay.
    pub(crate) fn regularized(&self, f: &[f64], b: &DMatrix<f64>, unknowns: &[usize], epsilon: f64) -> Vec<f64> {
        let a = self.laplacian.select_rows(unknowns).select_columns(unknowns);
        let b = b.select_rows(unknowns).select_columns(unknowns);
        let weights: Vec<f64> = unknowns.iter().map(|&v| self.weights[v]).collect();
        let matrix = squared(&a, &weights) + &b * epsilon;
        let residual = |x: &[f64]| -> Vec<f64> {
            let image = times(&a, &exactly(x));
            let weighted: Vec<Double> = image.iter().zip(&weights).map(|(x, &w)| *x * w.into()).collect();
            let rest: Vec<Double> =
                unknowns.iter().zip(x).map(|(&v, &x)| Double::from(f[v]) - Double::from(x)).collect();
            let pulled = times(&b, &rest).into_iter().map(|pull| Double::from(epsilon) * pull);
            pulled.zip(times(&a.transpose(), &weighted)).map(|(p, s)| (p - s).value()).collect()
        };
        let mut x = f.to_vec();
        unknowns.iter().zip(solve(matrix, &residual)).for_each(|(&v, value)| x[v] = value);
        x
    }
}

pub(crate) fn exactly(x: &[f64]) -> Vec<Double> {
    x.iter().map(|&x| x.into()).collect()
}

fn sum(a: Vec<Double>, b: &[Double]) -> Vec<Double> {
    a.into_iter().zip(b).map(|(a, b)| a + *b).collect()
}

/// The zeros of a sparse matrix are passed over.
pub(crate) fn times(matrix: &DMatrix<f64>, x: &[Double]) -> Vec<Double> {
    let mut y = vec![Double::from(0.0); matrix.nrows()];
    for (column, &scale) in matrix.column_iter().zip(x) {
        for (y, &entry) in y.iter_mut().zip(column.iter()) {
            if entry != 0.0 {
                *y = *y + Double::from(entry) * scale;
            }
        }
    }
    y
}

/// AᵀWA.
pub(crate) fn squared(a: &DMatrix<f64>, weights: &[f64]) -> DMatrix<f64> {
    let mut scaled = a.clone();
    scaled.row_iter_mut().zip(weights).for_each(|(mut row, w)| row *= *w);
    a.tr_mul(&scaled)
}

/// What the right-hand side is more than the matrix times x.
type Residual<'a> = dyn Fn(&[f64]) -> Vec<f64> + 'a;

/// Corrects until corrections are rounding.
fn solve(matrix: DMatrix<f64>, residual: &Residual<'_>) -> Vec<f64> {
    let mut x = DVector::zeros(matrix.ncols());
    if matrix.is_empty() {
        return Vec::new();
    }
    let factor = matrix.lu();
    for _ in 0..60 {
        let correction = factor.solve(&DVector::from_vec(residual(x.as_slice()))).expect("a regular matrix");
        x += &correction;
        if correction.amax() <= 4e-16 * x.amax() {
            return x.as_slice().to_vec();
        }
    }
    panic!("the reference is too badly conditioned");
}

/// Largest difference as a fraction of the range of the field.
pub(crate) fn error(f: &[f64], found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let range = f.iter().fold(f64::MIN, |m, &x| m.max(x)) - f.iter().fold(f64::MAX, |m, &x| m.min(x));
    found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / range
}

/// Few vertices, but one at least in every component but the last.
pub(crate) fn sparse_set(reference: &Reference, every: usize) -> Vec<u32> {
    let n = reference.component.len();
    let mut firsts: Vec<usize> = reference.component.iter().flatten().copied().collect();
    firsts.sort_unstable();
    firsts.dedup();
    if firsts.len() > 1 {
        firsts.pop();
    }
    let tied = |v: &usize| reference.component[*v].is_some_and(|c| firsts.contains(&c));
    let mut set: Vec<u32> = (0..n).filter(tied).step_by(every).chain(firsts.clone()).map(|v| v as u32).collect();
    set.sort_unstable();
    set.dedup();
    set
}

/// Whether the ends of every edge have values that rounding cannot swap: else critical points may differ between two results.
pub(crate) fn is_distinct(mesh: &TriMesh, values: &[f64]) -> bool {
    let range = values.iter().fold(f64::MIN, |m, &x| m.max(x)) - values.iter().fold(f64::MAX, |m, &x| m.min(x));
    let edges = mesh.connectivity().edges();
    edges.iter().all(|&[a, b]| (values[a as usize] - values[b as usize]).abs() > 1e-9 * range)
}
