//! The systems that are solved, as matrices.

use std::collections::VecDeque;

use morse_smooth::TriMesh;
use morse_smooth::Watch;
use morse_smooth::mesh::shapes::Random;
use morse_smooth::operators::{MassScale, cotan_laplacian, galerkin_mass, lumped_mass_diagonal};
use morse_smooth::solve::{gram, submatrix};
use nalgebra::Complex;
use nalgebra_sparse::CscMatrix;
use nalgebra_sparse::pattern::SparsityPattern;

/// Right-hand sides that a system has.
pub(crate) const COLUMNS: usize = 8;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// LII: the Laplacian without the 1-rings of n/200 vertices, as harmonic interpolation has it.
    Harmonic,
    /// C = L + i√ε M, M lumped: complex symmetric, on the pattern of L.
    Complex,
    /// A = LᵀL + εB, B Galerkin: equation (5).
    Mass,
    /// LᵀL + εI: equation (3).
    Identity,
}

pub(crate) const KINDS: [(&str, Kind); 4] =
    [("LII", Kind::Harmonic), ("C", Kind::Complex), ("A", Kind::Mass), ("A3", Kind::Identity)];

#[derive(Clone, Debug)]
pub(crate) enum Values {
    Real(Vec<f64>),
    Complex(Vec<Complex<f64>>),
}

impl Values {
    pub(crate) fn real(&self) -> &[f64] {
        match self {
            Self::Real(values) => values,
            Self::Complex(_) => &[],
        }
    }

    /// A number that depends on all entries, so that no computation is left out.
    pub(crate) fn sum(&self) -> f64 {
        match self {
            Self::Real(values) => values.iter().map(|x| x.abs()).sum(),
            Self::Complex(values) => values.iter().map(|z| z.re.abs() + z.im.abs()).sum(),
        }
    }
}

pub(crate) struct System {
    /// Both triangles.
    pub(crate) pattern: SparsityPattern,
    pub(crate) values: Values,
    /// x, y, z of every unknown.
    pub(crate) positions: Vec<f64>,
    /// [`COLUMNS`] right-hand sides.
    pub(crate) right_hand_sides: Values,
}

impl System {
    pub(crate) fn new(mesh: &TriMesh, kind: Kind, epsilon: f64) -> Self {
        let laplacian = cotan_laplacian(mesh).expect("enough memory");
        let n = mesh.vertex_count();
        let fields: Vec<f64> = (0..COLUMNS as u64).flat_map(|column| field(mesh, column)).collect();
        let (matrix, positions, right_hand_sides) = match kind {
            Kind::Harmonic => {
                let kept = unknowns_of_interpolation(mesh);
                let positions = kept.iter().flat_map(|&v| mesh.position(v)).collect();
                let columns = fields.chunks_exact(n).flat_map(|column| kept.iter().map(|&v| column[v as usize]));
                (submatrix(&laplacian, &kept), positions, columns.collect())
            }
            Kind::Complex => return Self::complex(mesh, &laplacian, &fields, epsilon),
            Kind::Mass => {
                let mass = galerkin_mass(mesh, MassScale::MeanOne).expect("a mesh with area");
                (
                    &gram(&laplacian, &Watch::none()).expect("it fits") + &(mass * epsilon),
                    mesh.positions().to_vec(),
                    fields,
                )
            }
            Kind::Identity => {
                let identity = CscMatrix::identity(n) * epsilon;
                (&gram(&laplacian, &Watch::none()).expect("it fits") + &identity, mesh.positions().to_vec(), fields)
            }
        };
        let (pattern, values) = matrix.into_pattern_and_values();
        Self { pattern, values: Values::Real(values), positions, right_hand_sides: Values::Real(right_hand_sides) }
    }

    fn complex(mesh: &TriMesh, laplacian: &CscMatrix<f64>, fields: &[f64], epsilon: f64) -> Self {
        let mass = lumped_mass_diagonal(mesh, MassScale::MeanOne).expect("a mesh with area");
        Self {
            pattern: laplacian.pattern().clone(),
            values: Values::Complex(shifted(laplacian, &mass, epsilon)),
            positions: mesh.positions().to_vec(),
            right_hand_sides: Values::Complex(
                fields.iter().zip(mass.iter().cycle()).map(|(f, m)| Complex::new(m * f, 0.0)).collect(),
            ),
        }
    }
}

/// The values of L + i√ε M on the pattern of L.
pub(crate) fn shifted(laplacian: &CscMatrix<f64>, mass: &[f64], epsilon: f64) -> Vec<Complex<f64>> {
    let shift = epsilon.sqrt();
    let entry = |(row, column, &value): (usize, usize, &f64)| {
        Complex::new(value, if row == column { shift * mass[row] } else { 0.0 })
    };
    laplacian.triplet_iter().map(entry).collect()
}

/// A smooth function with noise.
pub(crate) fn field(mesh: &TriMesh, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let scale = 1.0 + seed as f64;
    mesh.positions().chunks_exact(3).map(|p| scale * p[0] * p[1] + p[2] + 0.2 * random.signed()).collect()
}

/// Everything but the 1-rings of n/200 vertices that are spread out: no two within `APART` edges of each other.
fn unknowns_of_interpolation(mesh: &TriMesh) -> Vec<u32> {
    /// On a regular mesh, n/166 vertices that far apart find room in random order.
    const APART: u32 = 10;
    let n = mesh.vertex_count();
    let neighbours = cotan_laplacian(mesh).expect("enough memory").into_pattern_and_values().0;
    let mut order: Vec<u32> = (0..n as u32).collect();
    let mut random = Random::new(0);
    for i in (1..n).rev() {
        order.swap(i, (random.uniform() * (i + 1) as f64) as usize);
    }
    let (mut near, mut fixed) = (vec![false; n], vec![false; n]);
    let mut distance = vec![u32::MAX; n];
    let mut constraints = 0;
    for &v in &order {
        if constraints == n / 200 {
            break;
        }
        if near[v as usize] {
            continue;
        }
        constraints += 1;
        let mut queue = VecDeque::from([v as usize]);
        let mut met = vec![v as usize];
        distance[v as usize] = 0;
        while let Some(u) = queue.pop_front() {
            near[u] = true;
            fixed[u] |= distance[u] <= 1;
            for &w in neighbours.lane(u) {
                if distance[u] < APART && distance[w] == u32::MAX {
                    distance[w] = distance[u] + 1;
                    met.push(w);
                    queue.push_back(w);
                }
            }
        }
        met.iter().for_each(|&u| distance[u] = u32::MAX);
    }
    (0..n as u32).filter(|&v| !fixed[v as usize]).collect()
}
