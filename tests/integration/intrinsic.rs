//! The Laplacian of the intrinsic Delaunay triangulation against planar Delaunay triangulations found by trying all circles:
//! of flat pieces, of pieces that are folded, and of surfaces that unfold to periodic patterns of the plane.

use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{LinkKind, TriMesh};
use morse_smooth::operators::{
    LaplacianWeights, cotan_laplacian, galerkin_mass, intrinsic_delaunay_laplacian, laplacian,
};
use morse_smooth::smooth::{Metric, Smoother, SmootherOptions, SolverChoice, TikhonovOptions};
use nalgebra::{DMatrix, DVector};

use crate::support::{
    book_of_three, dense, every_kind, jittered, jittered_plane, mesh, noise, random_complex, shuffle,
};

type Point = [f64; 2];

/// Twice the signed area.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// All triangles whose circles have no point inside, counter-clockwise: O(n⁴). Points must be in general position.
fn delaunay(points: &[Point]) -> Vec<[usize; 3]> {
    let mut found = Vec::new();
    for a in 0..points.len() {
        for b in a + 1..points.len() {
            for c in b + 1..points.len() {
                let (p, q, r) = (points[a], points[b], points[c]);
                let twice = turn(p, q, r);
                if twice.abs() < 1e-9 {
                    continue;
                }
                // The centre relative to p.
                let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
                let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
                let centre =
                    [p[0] + (v[1] * uu - u[1] * vv) / (2.0 * twice), p[1] + (u[0] * vv - v[0] * uu) / (2.0 * twice)];
                let radius = distance(centre, p);
                let inside = |&x: &Point| distance(centre, x) < radius * (1.0 - 1e-9);
                if !points.iter().any(inside) {
                    found.push(if twice > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    found
}

/// Flips random diagonals of a planar triangulation, Delaunay or not, as long as triangles keep some area.
fn spoil(points: &[Point], triangles: &mut [[usize; 3]], flips: usize, random: &mut Random) {
    let pick = |random: &mut Random, n: usize| (random.uniform() * n as f64) as usize;
    for _ in 0..flips {
        let (t, s) = (pick(random, triangles.len()), pick(random, 3));
        let [i, j, k] = [0, 1, 2].map(|c| triangles[t][(s + c) % 3]);
        let other = triangles.iter().position(|o| (0..3).any(|c| o[c] == j && o[(c + 1) % 3] == i));
        let Some(u) = other else { continue };
        let m = triangles[u].into_iter().find(|&v| v != i && v != j).unwrap();
        let fat = |[a, b, c]: [usize; 3]| {
            let sides = [(a, b), (b, c), (c, a)].map(|(x, y)| distance(points[x], points[y]));
            let longest = sides.into_iter().fold(0.0, f64::max);
            turn(points[a], points[b], points[c]) > 0.0 && sides.iter().sum::<f64>() - 2.0 * longest > 5e-5
        };
        if fat([k, i, m]) && fat([m, j, k]) {
            triangles[t] = [k, i, m];
            triangles[u] = [m, j, k];
        }
    }
}

/// The cotangent Laplacian of planar triangles by angles, with points standing for vertices.
fn planar_laplacian(points: &[Point], vertices: &[usize], triangles: &[[usize; 3]], n: usize) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(n, n);
    for t in triangles {
        for c in 0..3 {
            let [a, b, o] = [0, 1, 2].map(|x| t[(c + x) % 3]);
            let (p, q, r) = (points[a], points[b], points[o]);
            let scalar = (p[0] - r[0]) * (q[0] - r[0]) + (p[1] - r[1]) * (q[1] - r[1]);
            let half = 0.5 / turn(p, q, r).abs().atan2(scalar).tan();
            let (i, j) = (vertices[a], vertices[b]);
            if i != j {
                matrix[(i, j)] -= half;
                matrix[(j, i)] -= half;
                matrix[(i, i)] += half;
                matrix[(j, j)] += half;
            }
        }
    }
    matrix
}

fn assert_close(name: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64) {
    let difference = (found - expected).abs().max();
    assert!(difference <= tolerance * expected.abs().max(), "{name}: {difference:e} of {:e}", expected.abs().max());
}

fn intrinsic(mesh: &TriMesh) -> DMatrix<f64> {
    dense(&intrinsic_delaunay_laplacian(mesh))
}

fn to_mesh(positions: &[[f64; 3]], triangles: &[[usize; 3]]) -> TriMesh {
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|v| v as u32)).collect();
    mesh(positions, &triangles)
}

/// The least that two sides of a triangle have more than the third, as a fraction of the mean length.
fn slack(mesh: &TriMesh) -> f64 {
    let length = |a: u32, b: u32| {
        let (p, q) = (mesh.position(a), mesh.position(b));
        (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2])
    };
    let edges = mesh.connectivity().edges();
    let mean = edges.iter().map(|&[a, b]| length(a, b)).sum::<f64>() / edges.len() as f64;
    let slacks = mesh.connectivity().triangles().iter().map(|&[a, b, c]| {
        let sides = [length(a, b), length(b, c), length(c, a)];
        sides.iter().sum::<f64>() - 2.0 * sides.into_iter().fold(0.0, f64::max)
    });
    slacks.fold(f64::INFINITY, f64::min) / mean
}

/// What is promised whatever the mesh.
fn assert_sound(name: &str, mesh: &TriMesh) {
    let sparse = intrinsic_delaunay_laplacian(mesh);
    for &[a, b] in mesh.connectivity().edges() {
        for (i, j) in [(a, b), (b, a)] {
            assert!(sparse.get_entry(i as usize, j as usize).is_some(), "{name}: the edge {i}, {j} is not stored");
        }
    }
    for v in 0..mesh.vertex_count() {
        assert!(sparse.get_entry(v, v).is_some(), "{name}: no diagonal at {v}");
        let isolated = mesh.connectivity().link_kinds()[v] == LinkKind::Isolated;
        assert!(!isolated || sparse.col(v).nnz() == 1, "{name}: isolated {v}");
    }
    let matrix = dense(&sparse);
    assert!(matrix.iter().all(|x| x.is_finite()), "{name}: not finite");
    assert_eq!(matrix, matrix.transpose(), "{name}");
    let size = matrix.abs().max();
    assert!(matrix.column_sum().abs().max() <= 1e-14 * size, "{name}: rows do not sum to zero");
    let least = matrix.clone().symmetric_eigenvalues().min();
    assert!(least >= -1e-13 * size, "{name}: eigenvalue {least:e} of {size:e}");
    // An edge between other than two triangles of the mesh may have a negative weight, no other pair of vertices.
    let mut irregular = DMatrix::from_element(matrix.nrows(), matrix.ncols(), false);
    for (e, &[a, b]) in mesh.connectivity().edges().iter().enumerate() {
        if mesh.connectivity().triangles_of_edge(e as u32).len() != 2 {
            irregular[(a as usize, b as usize)] = true;
            irregular[(b as usize, a as usize)] = true;
        }
    }
    for i in 0..matrix.nrows() {
        for j in 0..i {
            assert!(matrix[(i, j)] <= 0.0 || irregular[(i, j)], "{name}: weight {:e} at {i}, {j}", -matrix[(i, j)]);
        }
    }
}

#[test]
fn in_the_plane_it_is_the_delaunay_triangulation() {
    for seed in 0..30 {
        let mut random = Random::new(seed);
        // Long cells make flips go far.
        let width = 1.0 + 4.0 * random.uniform();
        let mut points = vec![[0.0, 0.0], [width, 0.0], [width, 1.0], [0.0, 1.0]];
        for i in 0..5 {
            for j in 0..5 {
                let at = |k: i32, random: &mut Random| (f64::from(k) + 0.5 + 0.45 * random.signed()) / 5.0;
                points.push([width * at(i, &mut random), at(j, &mut random)]);
            }
        }
        let n = points.len();
        let vertices: Vec<usize> = (0..n).collect();
        let good = delaunay(&points);
        assert_eq!(good.len(), 2 * n - 2 - 4, "general position");
        let expected = planar_laplacian(&points, &vertices, &good, n);
        let mut triangles = good.clone();
        for flips in [0, 30, 1000] {
            spoil(&points, &mut triangles, flips, &mut random);
            // Somewhere in space.
            let (c, s) = (0.6, 0.8);
            let positions: Vec<[f64; 3]> = points.iter().map(|&[x, y]| [7.0 + c * x, y * c, s * x - y * s]).collect();
            let positions: Vec<[f64; 3]> =
                positions.iter().zip(&points).map(|(p, &[x, y])| [p[0], s * y, s * x].map(|z| z + 0.0 * x)).collect();
            // (x, y) → (cx, y', …) must keep lengths: x along (c, 0, s), y along (0, 1, 0).
            let positions: Vec<[f64; 3]> =
                positions.iter().zip(&points).map(|(_, &[x, y])| [7.0 + c * x, y, s * x]).collect();
            let bad = to_mesh(&positions, &triangles);
            assert!(slack(&bad) > 1e-5, "seed {seed}: lengths must stay");
            assert_close(&format!("seed {seed}, {flips} flips"), &intrinsic(&bad), &expected, 1e-9);
            assert_sound("plane", &bad);
        }
    }
}
