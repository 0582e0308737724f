//! Meshes and small independent tools that several test modules share.

use std::collections::{BTreeMap, BTreeSet};

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::solve::{Scalar, norm, product, transposed_product};
use nalgebra::{Complex, ComplexField, DMatrix};
use nalgebra_sparse::pattern::SparsityPattern;
use nalgebra_sparse::{CooMatrix, CscMatrix};

pub(crate) fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriMesh {
    TriMesh::new(positions.as_flattened().to_vec(), triangles.as_flattened().to_vec()).expect("a valid mesh")
}

/// A complex with reproducible random positions, where only the incidences matter.
pub(crate) fn complex(vertices: u32, triangles: &[[u32; 3]]) -> TriMesh {
    let mut random = Random::new(u64::from(vertices) * 31 + triangles.len() as u64);
    let positions: Vec<[f64; 3]> = (0..vertices).map(|_| [random.signed(), random.signed(), random.signed()]).collect();
    mesh(&positions, triangles)
}

/// Any `triangles` different ones out of all triples of `vertices` vertices: mostly not a manifold.
pub(crate) fn random_complex(seed: u64, vertices: u32, triangles: usize) -> TriMesh {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for a in 0..vertices {
        for b in a + 1..vertices {
            for c in b + 1..vertices {
                all.push([a, b, c]);
            }
        }
    }
    shuffle(&mut all, &mut random);
    all.truncate(triangles.max(1));
    for t in &mut all {
        shuffle(t, &mut random);
    }
    complex(vertices, &all)
}

/// A closed or open surface with a share of its triangles taken out at random: boundaries, pinched vertices, holes,
/// isolated vertices, and vertices in random order.
pub(crate) fn random_surface(seed: u64, base: &TriMesh, removed: f64) -> TriMesh {
    let mut random = Random::new(seed);
    let n = base.vertex_count() as u32;
    let mut names: Vec<u32> = (0..n).collect();
    shuffle(&mut names, &mut random);
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for t in base.connectivity().triangles() {
        let keep = random.uniform() >= removed || triangles.is_empty();
        if keep {
            let mut t = t.map(|v| names[v as usize]);
            shuffle(&mut t, &mut random);
            triangles.push(t);
        }
    }
    let mut positions = vec![[0.0; 3]; n as usize];
    for v in 0..n {
        positions[names[v as usize] as usize] = base.position(v);
    }
    mesh(&positions, &triangles)
}

pub(crate) fn shuffle<T>(items: &mut [T], random: &mut Random) {
    for i in (1..items.len()).rev() {
        items.swap(i, (random.uniform() * (i + 1) as f64) as usize);
    }
}

pub(crate) fn two_tetrahedra_at_an_edge() -> TriMesh {
    complex(6, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2], [0, 1, 4], [0, 5, 1], [0, 4, 5], [1, 5, 4]])
}

pub(crate) fn two_tetrahedra_at_a_vertex() -> TriMesh {
    complex(7, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2], [0, 4, 5], [0, 6, 4], [0, 5, 6], [4, 6, 5]])
}

pub(crate) fn bow_tie() -> TriMesh {
    complex(5, &[[0, 1, 2], [0, 3, 4]])
}

pub(crate) fn book_of_three() -> TriMesh {
    complex(5, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]])
}

/// A tetrahedron, two isolated vertices, an octahedron.
pub(crate) fn islands() -> TriMesh {
    let (first, second) = (shapes::tetrahedron().unwrap(), shapes::octahedron().unwrap());
    let mut positions = first.positions().to_vec();
    positions.extend([9.0, 9.0, 9.0, -9.0, 9.0, 9.0]);
    positions.extend(second.positions().iter().map(|x| x + 5.0));
    let mut triangles = first.connectivity().triangles().as_flattened().to_vec();
    triangles.extend(second.connectivity().triangles().as_flattened().iter().map(|v| v + 6));
    TriMesh::new(positions, triangles).unwrap()
}

/// A grid without its middle cell: an annulus.
pub(crate) fn annulus() -> TriMesh {
    let grid = shapes::grid(6, 6).unwrap();
    let kept: Vec<[u32; 3]> = grid
        .connectivity()
        .triangles()
        .iter()
        .copied()
        .filter(|t| {
            let centre = t.iter().fold([0.0; 2], |c, &v| {
                let p = grid.position(v);
                [c[0] + p[0] / 3.0, c[1] + p[1] / 3.0]
            });
            (centre[0] - 0.5).abs() > 0.1 || (centre[1] - 0.5).abs() > 0.1
        })
        .collect();
    TriMesh::new(grid.positions().to_vec(), kept.as_flattened().to_vec()).unwrap()
}

/// A mesh with its vertices moved by up to `amount` in every direction.
pub(crate) fn jittered(base: &TriMesh, amount: f64, seed: u64) -> TriMesh {
    let mut random = Random::new(seed);
    let positions = base.positions().iter().map(|x| x + amount * random.signed()).collect();
    TriMesh::new(positions, base.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

/// A planar grid with interior vertices moved within the plane.
pub(crate) fn jittered_plane(columns: u32, rows: u32, seed: u64) -> TriMesh {
    let base = shapes::grid(columns, rows).unwrap();
    let mut random = Random::new(seed);
    let mut positions = base.positions().to_vec();
    for p in positions.chunks_exact_mut(3) {
        p[0] += 0.25 / f64::from(columns - 1) * random.signed();
        p[1] += 0.25 / f64::from(rows - 1) * random.signed();
    }
    TriMesh::new(positions, base.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

/// One of every kind of mesh that the crate takes, by name.
pub(crate) fn every_kind() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("tetrahedron", shapes::tetrahedron().unwrap()),
        ("octahedron", shapes::octahedron().unwrap()),
        ("sphere", shapes::sphere(2).unwrap()),
        ("torus", shapes::torus(9, 7, 0.3).unwrap()),
        ("grid", shapes::grid(6, 5).unwrap()),
        ("annulus", annulus()),
        ("moebius", shapes::moebius(11, 4).unwrap()),
        ("klein bottle", shapes::klein_bottle(9, 8).unwrap()),
        ("two tetrahedra at an edge", two_tetrahedra_at_an_edge()),
        ("two tetrahedra at a vertex", two_tetrahedra_at_a_vertex()),
        ("bow tie", bow_tie()),
        ("book of three", book_of_three()),
        ("islands", islands()),
        ("one triangle", complex(3, &[[0, 1, 2]])),
        ("pinched torus", random_surface(5, &shapes::torus(9, 7, 0.3).unwrap(), 0.3)),
        ("random complex", random_complex(11, 9, 30)),
    ]
}

/// Values in [−1, 1], all different.
pub(crate) fn noise(n: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..n).map(|_| random.signed()).collect()
}

/// Few different values: many ties.
pub(crate) fn tied(n: usize, seed: u64, steps: f64) -> Vec<f64> {
    noise(n, seed).into_iter().map(|x| (x * steps).round() / steps).collect()
}

pub(crate) fn dense(matrix: &CscMatrix<f64>) -> DMatrix<f64> {
    let mut full = DMatrix::zeros(matrix.nrows(), matrix.ncols());
    for (row, column, value) in matrix.triplet_iter() {
        full[(row, column)] += value;
    }
    full
}

/// For every edge the triangles at it, from the list of triangles alone.
pub(crate) fn edge_map(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], Vec<u32>> {
    let mut edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            edges.entry([p.min(q), p.max(q)]).or_default().push(t as u32);
        }
    }
    edges
}

/// A link as a graph: the neighbours of every node.
pub(crate) type Link = BTreeMap<u32, BTreeSet<u32>>;

/// The links of all vertices, from the list of triangles alone.
pub(crate) fn links(vertices: usize, triangles: &[[u32; 3]]) -> Vec<Link> {
    let mut links = vec![Link::new(); vertices];
    for &[a, b, c] in triangles {
        for (v, p, q) in [(a, b, c), (b, c, a), (c, a, b)] {
            links[v as usize].entry(p).or_default().insert(q);
            links[v as usize].entry(q).or_default().insert(p);
        }
    }
    links
}

/// The connected components of the nodes that `inside` takes.
pub(crate) fn link_components(link: &Link, inside: impl Fn(u32) -> bool) -> Vec<Vec<u32>> {
    let mut seen = BTreeSet::new();
    let mut components = Vec::new();
    for &start in link.keys().filter(|&&v| inside(v)) {
        if !seen.insert(start) {
            continue;
        }
        let mut component = vec![start];
        let mut next = 0;
        while next < component.len() {
            for &u in &link[&component[next]] {
                if inside(u) && seen.insert(u) {
                    component.push(u);
                }
            }
            next += 1;
        }
        components.push(component);
    }
    components
}

/// The nodes of a link in order, where it is one cycle or one open path; `true` for a cycle.
pub(crate) fn walk_link(link: &Link) -> Option<(Vec<u32>, bool)> {
    let ends: Vec<u32> = link.iter().filter(|(_, n)| n.len() == 1).map(|(&v, _)| v).collect();
    if link.is_empty() || link.values().any(|n| n.len() > 2) || link_components(link, |_| true).len() > 1 {
        return None;
    }
    let start = *ends.first().or_else(|| link.keys().next())?;
    let (mut path, mut previous) = (vec![start], start);
    loop {
        let here = path[path.len() - 1];
        match link[&here].iter().copied().find(|&u| u != previous && u != start) {
            Some(next) => {
                previous = here;
                path.push(next);
            }
            None => return Some((path, ends.is_empty())),
        }
    }
}

/// A symmetric matrix from its pairs, made definite by a dominant diagonal.
pub(crate) fn dominant(n: usize, pairs: &[(usize, usize, f64)]) -> CscMatrix<f64> {
    let mut coo = CooMatrix::new(n, n);
    let mut sums = vec![0.5; n];
    let mut seen = BTreeSet::new();
    for &(i, j, value) in pairs {
        if i != j && seen.insert((i.min(j), i.max(j))) {
            coo.push(i, j, value);
            coo.push(j, i, value);
            sums[i] += value.abs();
            sums[j] += value.abs();
        }
    }
    for (i, &sum) in sums.iter().enumerate() {
        coo.push(i, i, sum);
    }
    CscMatrix::from(&coo)
}

pub(crate) fn random_spd(seed: u64, n: usize, pairs: usize) -> CscMatrix<f64> {
    let mut random = Random::new(seed);
    let pairs: Vec<(usize, usize, f64)> = (0..pairs)
        .map(|_| {
            let at = |x: f64| (x * n as f64) as usize;
            (at(random.uniform()), at(random.uniform()), random.signed())
        })
        .collect();
    dominant(n, &pairs)
}

/// xᵀ A x.
pub(crate) fn quadratic_form(matrix: &CscMatrix<f64>, x: &[f64]) -> f64 {
    transposed_product(matrix, x).iter().zip(x).map(|(a, b)| a * b).sum()
}

/// ‖b − A x‖₂ / ‖b‖₂ for one right-hand side; 0 where b is zero and x solves exactly.
pub(crate) fn relative_residual(matrix: &CscMatrix<f64>, x: &[f64], b: &[f64]) -> f64 {
    let residual: Vec<f64> = product(matrix, x).iter().zip(b).map(|(ax, b)| b - ax).collect();
    match (norm(&residual), norm(b)) {
        (0.0, _) => 0.0,
        (r, b) => r / b,
    }
}

/// Entries per column of the factor, in the order of elimination: elimination played on a dense pattern.
pub(crate) fn column_counts(pattern: &SparsityPattern, order: &[u32]) -> Vec<u64> {
    let n = order.len();
    let mut linked = vec![vec![false; n]; n];
    for (i, j) in pattern.entries() {
        linked[i][j] = true;
    }
    let mut alive = vec![true; n];
    let mut counts = Vec::new();
    for &pivot in order {
        let pivot = pivot as usize;
        alive[pivot] = false;
        let next: Vec<usize> = (0..n).filter(|&v| alive[v] && linked[pivot][v]).collect();
        counts.push(1 + next.len() as u64);
        for &a in &next {
            for &b in &next {
                linked[a][b] = true;
            }
        }
    }
    counts
}

/// What a factor can be stored in, with what dense algebra needs.
pub(crate) trait Kind: Scalar<Wide: ComplexField<RealField = f64>> {
    const NAME: &'static str;
    /// What a well-conditioned system is solved to.
    const ACCURACY: f64;

    /// The number, or its real part where there are no others.
    fn entry(re: f64, im: f64) -> Self::Wide;
}

macro_rules! kinds {
    ($($kind:ty, $accuracy:literal, |$re:ident, $im:ident| $entry:expr;)*) => {
        $(impl Kind for $kind {
            const NAME: &'static str = stringify!($kind);
            const ACCURACY: f64 = $accuracy;

            fn entry($re: f64, $im: f64) -> Self::Wide {
                $entry
            }
        })*
    };
}

kinds! {
    f64, 1e-12, |re, _im| re;
    f32, 2e-5, |re, _im| re;
    Complex<f64>, 1e-12, |re, im| Complex::new(re, im);
    Complex<f32>, 2e-5, |re, im| Complex::new(re, im);
}

/// Random numbers in the square around zero.
pub(crate) fn random_column<K: Kind>(n: usize, random: &mut Random) -> Vec<K::Wide> {
    (0..n).map(|_| K::entry(random.signed(), random.signed())).collect()
}

/// A x
pub(crate) fn product_of<K: Kind>(pattern: &SparsityPattern, values: &[K::Wide], x: &[K::Wide]) -> Vec<K::Wide> {
    let mut y = vec![K::Wide::default(); x.len()];
    for ((column, row), &value) in pattern.entries().zip(values) {
        y[row] += value * x[column];
    }
    y
}

/// Largest difference as a fraction of the largest value.
pub(crate) fn distance<K: Kind>(found: &[K::Wide], expected: &[K::Wide]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = |size: f64, x: f64| if x > size || x.is_nan() { x } else { size };
    let size = expected.iter().map(|x| x.modulus()).fold(0.0, largest);
    found.iter().zip(expected).map(|(&a, &b)| (a - b).modulus()).fold(0.0, largest) / size
}
