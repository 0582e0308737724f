//! Operators against their definitions with angles, against closed forms, and the properties that they promise.

use std::collections::BTreeMap;

use morse_smooth::Watch;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{
    LaplacianWeights, MassScale, cotan_laplacian, galerkin_mass, laplacian, lumped_mass, lumped_mass_diagonal,
    mean_value_laplacian, normalized_cotan_laplacian, uniform_laplacian,
};
use nalgebra::{DMatrix, DVector};

use crate::support::{dense, every_kind, islands, jittered, jittered_plane, mesh};

pub(crate) const ALL_WEIGHTS: [LaplacianWeights; 4] = [
    LaplacianWeights::Cotangent,
    LaplacianWeights::MeanValue,
    LaplacianWeights::NormalizedCotangent,
    LaplacianWeights::Uniform,
];

fn difference(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

fn length(p: [f64; 3]) -> f64 {
    p[0].hypot(p[1]).hypot(p[2])
}

/// The angle at `here` in a triangle, from the lengths and the scalar product.
fn angle(here: [f64; 3], p: [f64; 3], q: [f64; 3]) -> f64 {
    let (a, b) = (difference(p, here), difference(q, here));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    length(cross).atan2(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
}

/// The Laplacian by the definition of its weights, with angles.
pub(crate) fn reference_laplacian(mesh: &TriMesh, weights: LaplacianWeights) -> DMatrix<f64> {
    let n = mesh.vertex_count();
    let mut w: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for (t, &corners) in mesh.connectivity().triangles().iter().enumerate() {
        for c in 0..3 {
            let [i, j, k] = [corners[c], corners[(c + 1) % 3], corners[(c + 2) % 3]];
            let [p, q, r] = [i, j, k].map(|v| mesh.position(v));
            let (i, j, k) = (i as usize, j as usize, k as usize);
            match weights {
                LaplacianWeights::Uniform => {
                    w.insert((i, j), 1.0);
                    w.insert((j, i), 1.0);
                }
                _ if mesh.is_zero_area(t as u32) => {}
                LaplacianWeights::MeanValue => {
                    let half = (angle(p, q, r) / 2.0).tan();
                    *w.entry((i, j)).or_default() += half / length(difference(q, p));
                    *w.entry((i, k)).or_default() += half / length(difference(r, p));
                }
                _ => {
                    // The angle at k is opposite to the edge (i, j).
                    let half = 0.5 / angle(r, p, q).tan();
                    *w.entry((i, j)).or_default() += half;
                    *w.entry((j, i)).or_default() += half;
                }
            }
        }
    }
    let mut matrix = DMatrix::zeros(n, n);
    for (&(i, j), &w) in &w {
        matrix[(i, j)] -= w;
        matrix[(i, i)] += w;
    }
    if matches!(weights, LaplacianWeights::MeanValue | LaplacianWeights::NormalizedCotangent) {
        for i in 0..n {
            let sum = matrix[(i, i)];
            if sum != 0.0 {
                matrix.row_mut(i).scale_mut(1.0 / sum);
            }
        }
    }
    matrix
}

/// The Galerkin mass by its integral: a quadrature at the three midpoints is exact for products of linear functions.
pub(crate) fn reference_mass(mesh: &TriMesh, scale: MassScale) -> DMatrix<f64> {
    let n = mesh.vertex_count();
    let mut matrix = DMatrix::zeros(n, n);
    let mut area = 0.0;
    for corners in mesh.connectivity().triangles() {
        let [p, q, r] = corners.map(|v| mesh.position(v));
        let (a, b) = (difference(q, p), difference(r, p));
        let t = 0.5 * length(a) * length(b) * angle(p, q, r).sin();
        area += t;
        for middle in [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]] {
            for x in 0..3 {
                for y in 0..3 {
                    matrix[(corners[x] as usize, corners[y] as usize)] += t / 3.0 * middle[x] * middle[y];
                }
            }
        }
    }
    let used = n - mesh.topology().unwrap().isolated_vertices;
    match scale {
        MassScale::Raw => matrix,
        MassScale::MeanOne => matrix * (used as f64 / area),
    }
}

fn assert_close(name: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64) {
    let difference = (found - expected).abs().max();
    let size = expected.abs().max();
    assert!(difference <= tolerance * size, "{name}: {difference:e} of {size:e}");
}

fn meshes() -> Vec<(&'static str, TriMesh)> {
    let mut all = every_kind();
    all.push(("jittered sphere", jittered(&shapes::sphere(2).unwrap(), 0.1, 3)));
    all.push(("jittered torus", jittered(&shapes::torus(9, 8, 0.2).unwrap(), 0.05, 4)));
    all.push(("jittered strip", jittered(&shapes::moebius(9, 4).unwrap(), 0.05, 4)));
    all.push(("with a triangle on a line", with_line()));
    all
}

/// A square whose diagonal carries a third vertex in a triangle without area, and that vertex hangs on nothing else.
fn with_line() -> TriMesh {
    let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 0.0]];
    mesh(&positions, &[[0, 1, 2], [0, 2, 3], [0, 2, 4]])
}

#[test]
fn entries_follow_the_definitions() {
    for (name, mesh) in meshes() {
        for weights in ALL_WEIGHTS {
            let found = dense(&laplacian(&mesh, weights, &Watch::none()).unwrap());
            assert_close(name, &found, &reference_laplacian(&mesh, weights), 1e-13);
        }
        for scale in [MassScale::Raw, MassScale::MeanOne] {
            let found = dense(&galerkin_mass(&mesh, scale).unwrap());
            let expected = reference_mass(&mesh, scale);
            assert_close(name, &found, &expected, 1e-13);
            let sums = DMatrix::from_diagonal(&expected.column_sum());
            assert_close(name, &dense(&lumped_mass(&mesh, scale).unwrap()), &sums, 1e-13);
            let diagonal = lumped_mass_diagonal(&mesh, scale).unwrap();
            assert_close(name, &DMatrix::from_diagonal(&DVector::from_vec(diagonal)), &sums, 1e-13);
        }
    }
}

#[test]
fn closed_forms() {
    // The regular tetrahedron: every opposite angle is 60°, so every weight is cot 60° = 1/√3.
    let tetrahedron = shapes::tetrahedron().unwrap();
    let w = 1.0 / 3.0_f64.sqrt();
    let expected = DMatrix::from_fn(4, 4, |i, j| if i == j { 3.0 * w } else { -w });
    assert_close("tetrahedron", &dense(&cotan_laplacian(&tetrahedron).unwrap()), &expected, 1e-15);
    let third = DMatrix::from_fn(4, 4, |i, j| if i == j { 1.0 } else { -1.0 / 3.0 });
    assert_close("tetrahedron", &dense(&mean_value_laplacian(&tetrahedron).unwrap()), &third, 1e-15);
    assert_close("tetrahedron", &dense(&normalized_cotan_laplacian(&tetrahedron).unwrap()), &third, 1e-15);
    assert_close("tetrahedron", &dense(&uniform_laplacian(&tetrahedron).unwrap()), &(third * 3.0), 1e-15);
    // b_ii = (3 triangles of area A)/6, b_ij = (2 of them)/12, four triangles on four vertices: A n/area = 1.
    let expected = DMatrix::from_fn(4, 4, |i, j| if i == j { 0.5 } else { 1.0 / 6.0 });
    assert_close("tetrahedron", &dense(&galerkin_mass(&tetrahedron, MassScale::MeanOne).unwrap()), &expected, 1e-15);

    // The plane cut into equilateral triangles: interior weights are all 1/√3, whatever the choice, up to the row's sum.
    let (columns, rows) = (7_u32, 6_u32);
    let height = 0.75_f64.sqrt();
    let positions: Vec<[f64; 3]> = (0..columns * rows)
        .map(|v| [f64::from(v / rows) - 0.5 * f64::from(v % rows), height * f64::from(v % rows), 0.0])
        .collect();
    let triangles = shapes::grid(columns, rows).unwrap().connectivity().triangles().to_vec();
    let plane = mesh(&positions, &triangles);
    for (weights, scale) in [(LaplacianWeights::Cotangent, w), (LaplacianWeights::MeanValue, 1.0 / 6.0)] {
        let matrix = dense(&laplacian(&plane, weights, &Watch::none()).unwrap());
        for (v, kind) in plane.connectivity().link_kinds().iter().enumerate() {
            if *kind == morse_smooth::mesh::LinkKind::Cycle {
                for u in 0..matrix.ncols() {
                    let expected = match (u == v, length(difference(positions[u], positions[v])) < 1.1) {
                        (true, _) => 6.0 * scale,
                        (_, true) => -scale,
                        _ => 0.0,
                    };
                    assert!((matrix[(v, u)] - expected).abs() < 1e-14, "{weights:?} {v} {u}: {}", matrix[(v, u)]);
                }
            }
        }
    }
}

#[test]
fn what_the_operators_promise() {
    for (name, mesh) in meshes() {
        for weights in ALL_WEIGHTS {
            let matrix = dense(&laplacian(&mesh, weights, &Watch::none()).unwrap());
            let size = matrix.abs().max();
            let sums = matrix.column_sum().abs().max();
            assert!(sums <= 1e-14 * size, "{name} {weights:?}: rows sum to {sums:e}");
            if weights.is_symmetric() {
                assert_eq!(matrix, matrix.transpose(), "{name} {weights:?}");
                let smallest = matrix.clone().symmetric_eigenvalues().min();
                assert!(smallest >= -1e-13 * size, "{name} {weights:?}: eigenvalue {smallest:e}");
            }
            if weights == LaplacianWeights::MeanValue {
                for i in 0..matrix.nrows() {
                    for j in 0..i {
                        // Opposite signs of zero apart, an edge that carries an area carries a positive weight.
                        assert!(matrix[(i, j)] <= 0.0 && (matrix[(i, j)] < 0.0) == (matrix[(j, i)] < 0.0), "{name}");
                    }
                }
            }
        }
        let used = mesh.vertex_count() - mesh.topology().unwrap().isolated_vertices;
        for (scale, total) in [(MassScale::Raw, mesh.area()), (MassScale::MeanOne, used as f64)] {
            let full = dense(&galerkin_mass(&mesh, scale).unwrap());
            assert!((full.sum() - total).abs() <= 1e-13 * total, "{name} {scale:?}");
            assert!(full.symmetric_eigenvalues().min() >= -1e-14 * total, "{name} {scale:?}");
        }
    }
}

#[test]
fn laplacians_and_the_scaled_mass_know_no_units() {
    let base = jittered(&shapes::torus(9, 8, 0.2).unwrap(), 0.05, 4);
    for factor in [1e-70, 1e-6, 3.7, 1e9, 1e74] {
        let scaled = TriMesh::new(
            base.positions().iter().map(|x| x * factor).collect(),
            base.connectivity().triangles().as_flattened().to_vec(),
        )
        .unwrap();
        for weights in ALL_WEIGHTS {
            let (a, b) = (
                laplacian(&base, weights, &Watch::none()).unwrap(),
                laplacian(&scaled, weights, &Watch::none()).unwrap(),
            );
            assert_close(&format!("{weights:?} times {factor:e}"), &dense(&b), &dense(&a), 1e-14);
        }
        let (a, b) =
            (galerkin_mass(&base, MassScale::MeanOne).unwrap(), galerkin_mass(&scaled, MassScale::MeanOne).unwrap());
        assert_close(&format!("mass times {factor:e}"), &dense(&b), &dense(&a), 1e-14);
        let (a, b) = (galerkin_mass(&base, MassScale::Raw).unwrap(), galerkin_mass(&scaled, MassScale::Raw).unwrap());
        assert_close(&format!("raw mass times {factor:e}"), &dense(&b), &(dense(&a) * (factor * factor)), 1e-14);
    }
}

#[test]
fn linear_functions_on_a_plane_are_harmonic() {
    let plane = jittered_plane(12, 9, 8);
    for weights in [LaplacianWeights::Cotangent, LaplacianWeights::NormalizedCotangent, LaplacianWeights::MeanValue] {
        let matrix = dense(&laplacian(&plane, weights, &Watch::none()).unwrap());
        for axis in 0..2 {
            let coordinate =
                DVector::from_iterator(plane.vertex_count(), plane.positions().chunks_exact(3).map(|p| 3.0 + p[axis]));
            let image = &matrix * coordinate;
            for (v, kind) in plane.connectivity().link_kinds().iter().enumerate() {
                if *kind == morse_smooth::mesh::LinkKind::Cycle {
                    assert!(image[v].abs() < 1e-13, "{weights:?}, axis {axis}, vertex {v}: {:e}", image[v]);
                }
            }
        }
    }
}

#[test]
fn rows_without_area_are_empty() {
    for (mesh, vertex) in [(with_line(), 4), (islands(), 5)] {
        for weights in [LaplacianWeights::Cotangent, LaplacianWeights::MeanValue, LaplacianWeights::NormalizedCotangent]
        {
            let matrix = dense(&laplacian(&mesh, weights, &Watch::none()).unwrap());
            assert!(matrix.row(vertex).iter().chain(matrix.column(vertex).iter()).all(|&x| x == 0.0), "{weights:?}");
        }
        let mass = dense(&galerkin_mass(&mesh, MassScale::MeanOne).unwrap());
        assert!(mass.row(vertex).iter().all(|&x| x == 0.0));
    }
    let line = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    assert_eq!(galerkin_mass(&line, MassScale::MeanOne).expect_err("no area").code(), "ZeroArea");
    assert_eq!(lumped_mass(&line, MassScale::MeanOne).expect_err("no area").code(), "ZeroArea");
    assert!(dense(&galerkin_mass(&line, MassScale::Raw).unwrap()).iter().all(|&x| x == 0.0));
}
