//! What the intrinsic Delaunay Laplacian promises on any mesh.

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::{LaplacianWeights, cotan_laplacian, galerkin_mass, laplacian};
use morse_smooth::smooth::{Metric, Smoother, SmootherOptions, SolverChoice, TikhonovOptions};
use nalgebra::{DMatrix, DVector};

use crate::intrinsic::{assert_close, assert_sound, intrinsic, slack};
use crate::support::{
    book_of_three, dense, every_kind, jittered, jittered_plane, mesh, noise, random_complex, shuffle,
};

fn varied() -> Vec<(String, TriMesh)> {
    let mut all: Vec<(String, TriMesh)> =
        every_kind().into_iter().map(|(name, mesh)| (name.to_owned(), mesh)).collect();
    for seed in 0..6 {
        all.push((format!("sphere {seed}"), jittered(&shapes::sphere(2).unwrap(), 0.12, seed)));
        all.push((format!("torus {seed}"), shapes::torus(12, 5, 0.9).unwrap()));
        all.push((format!("thin torus {seed}"), jittered(&shapes::torus(5, 14, 0.2).unwrap(), 0.1, seed)));
        all.push((format!("klein bottle {seed}"), jittered(&shapes::klein_bottle(9, 8).unwrap(), 0.2, seed)));
        all.push((format!("moebius {seed}"), jittered(&shapes::moebius(7, 5).unwrap(), 0.1, seed)));
        all.push((format!("plane {seed}"), jittered(&jittered_plane(9, 8, seed), 0.08, seed)));
        all.push((format!("needle {seed}"), jittered(&shapes::tetrahedron().unwrap(), 0.99, seed)));
        all.push((format!("complex {seed}"), random_complex(seed, 10, 8 + 5 * seed as usize)));
    }
    all
}

/// Rippa's theorem: fᵀLf is smallest for the Delaunay triangulation, whatever f is.
#[test]
fn no_energy_is_larger_than_the_cotangent_one() {
    let mut smaller = 0;
    for (name, mesh) in varied() {
        assert_sound(&name, &mesh);
        if slack(&mesh) < 1e-12 {
            continue;
        }
        let (flipped, plain) = (intrinsic(&mesh), dense(&cotan_laplacian(&mesh).unwrap()));
        let size = plain.abs().max();
        let least = (&plain - &flipped).symmetric_eigenvalues().min();
        assert!(least >= -1e-11 * size, "{name}: larger by {:e} of {size:e}", -least);
        let regular = mesh.connectivity().edges().iter().enumerate().all(|(e, &[a, b])| {
            mesh.connectivity().triangles_of_edge(e as u32).len() != 2 || plain[(a as usize, b as usize)] <= 0.0
        });
        if regular {
            assert_close(&format!("{name}, Delaunay already"), &flipped, &plain, 1e-12);
        } else {
            smaller += 1;
            assert!((&plain - &flipped).abs().max() > 1e-9 * size, "{name}: nothing was flipped");
        }
    }
    assert!(smaller > 20, "{smaller}");
    let sphere = shapes::sphere(3).unwrap();
    assert_close("sphere", &intrinsic(&sphere), &dense(&cotan_laplacian(&sphere).unwrap()), 1e-12);
    // Three triangles at every interior edge, and a boundary: nothing can be flipped.
    let book = book_of_three();
    assert_close("book", &intrinsic(&book), &dense(&cotan_laplacian(&book).unwrap()), 1e-12);
}

#[test]
fn neither_units_nor_the_order_of_corners_matter() {
    for (seed, (name, base)) in varied().into_iter().enumerate() {
        let expected = intrinsic(&base);
        let triangles = base.connectivity().triangles().as_flattened().to_vec();
        for factor in [1e-300, 1e-160, 1e-6, 3.7, 1e74] {
            let positions: Vec<f64> = base.positions().iter().map(|x| x * factor).collect();
            if positions.iter().all(|x| x.abs() < 1e75) {
                let scaled = TriMesh::new(positions, triangles.clone()).unwrap();
                assert_close(&format!("{name} times {factor:e}"), &intrinsic(&scaled), &expected, 1e-9);
            }
        }
        let mut random = Random::new(seed as u64);
        let mut turned = base.connectivity().triangles().to_vec();
        turned.iter_mut().for_each(|t| shuffle(t, &mut random));
        shuffle(&mut turned, &mut random);
        let turned = TriMesh::new(base.positions().to_vec(), turned.as_flattened().to_vec()).unwrap();
        assert_close(&format!("{name}, in another order"), &intrinsic(&turned), &expected, 1e-9);
    }
}

/// Where all circles are one, any triangulation will do, and the boundary alone has weights.
#[test]
fn vertices_on_one_circle() {
    for n in [4_u32, 6, 50, 101] {
        let step = std::f64::consts::TAU / f64::from(n);
        let positions: Vec<[f64; 3]> =
            (0..n).map(|v| [(step * f64::from(v)).cos(), (step * f64::from(v)).sin(), 0.0]).collect();
        // Triangles about the middle one, so that no side is nearly as long as the others together.
        let mut triangles = Vec::new();
        let mut halves = vec![(0, n / 3), (n / 3, 2 * n / 3), (2 * n / 3, n)];
        triangles.push([0, n / 3, 2 * n / 3]);
        while let Some((a, b)) = halves.pop() {
            if b - a > 1 {
                let middle = (a + b) / 2;
                triangles.push([a, middle, b % n]);
                halves.extend([(a, middle), (middle, b)]);
            }
        }
        let polygon = mesh(&positions, &triangles);
        assert!(slack(&polygon) > 1e-5, "lengths must stay");
        let found = intrinsic(&polygon);
        // The angle at the circle over a side is half of that at the centre.
        let w = 0.5 / (0.5 * step).tan();
        for i in 0..n as usize {
            for j in 0..n as usize {
                let apart = (i + n as usize - j) % n as usize;
                let expected = if i == j {
                    2.0 * w
                } else if apart == 1 || apart == n as usize - 1 {
                    -w
                } else {
                    0.0
                };
                assert!((found[(i, j)] - expected).abs() <= 1e-9 * w, "{n}: {i}, {j}: {}", found[(i, j)]);
            }
        }
    }
    // Squares: their diagonals weigh nothing and the edges keep the cotangents of 45° and 90°.
    let grid = shapes::grid(30, 30).unwrap();
    assert_close("grid", &intrinsic(&grid), &dense(&cotan_laplacian(&grid).unwrap()), 1e-11);
}

/// Flips alone are right however thin triangles are: nothing is added to any length.
#[test]
fn thin_and_small_triangles_change_nothing_else() {
    for height in [1e-1, 1e-3, 1e-6, 1e-9, 1e-12] {
        let cap = [[0., 0., 0.], [1., 0., 0.], [0.5, height, 0.], [0.5, -1., 0.]];
        let weights = intrinsic(&mesh(&cap, &[[0, 1, 2], [1, 0, 3]]));
        // The edge from 2 to 3 takes the place of that from 0 to 1. The boundary's weights are ½ cot of the angles at 3 and at 2.
        let (u, v) = ((0.5_f64, 1.0_f64), (0.5_f64, height));
        let at_apex = u.0.atan2(u.1);
        let at_cap = v.0.atan2(v.1);
        let half_cotangent = |angle: f64| 0.5 / angle.tan();
        let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-12 * expected.abs().max(1.0);
        assert_eq!(weights[(0, 1)], 0.0, "height {height:e}");
        for end in [0, 1] {
            assert!(close(-weights[(end, 2)], half_cotangent(at_apex)), "height {height:e}: {}", weights[(end, 2)]);
            assert!(close(-weights[(end, 3)], half_cotangent(at_cap)), "height {height:e}: {}", weights[(end, 3)]);
        }
        let diagonal = 2.0 * half_cotangent(core::f64::consts::PI - at_apex - at_cap);
        assert!(close(-weights[(2, 3)], diagonal), "height {height:e}: {} {diagonal}", weights[(2, 3)]);
    }

    // Two squares whose sides are 1 and small.
    for small in [1e-3, 1e-6, 1e-12, 1e-30] {
        let square = |side: f64, at: f64| [[at, 0., 0.], [at + side, 0., 0.], [at + side, side, 0.], [at, side, 0.]];
        let positions = [square(small, 0.0), square(1.0, 3.0)].concat();
        let both = intrinsic(&mesh(&positions, &[[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]));
        for first in [0, 4] {
            for (a, b, weight) in [(0, 1, 0.5), (1, 2, 0.5), (2, 3, 0.5), (0, 3, 0.5), (0, 2, 0.0)] {
                let found = -both[(first + a, first + b)];
                assert!((found - weight).abs() <= 1e-14, "{small:e}, {first}: {a} {b} {found}");
            }
        }
    }
}

#[test]
fn triangles_without_area_take_part() {
    // Lengths 1, 1 and 2: 1e-5 times the square of the longest stands for the area.
    let line = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    let [base, apex] = [4.0, -2.0].map(|four_areas_cotangent| four_areas_cotangent / (8.0 * 4e-5));
    let expected = DMatrix::from_row_slice(
        3,
        3,
        &[base + apex, -base, -apex, -base, 2.0 * base, -base, -apex, -base, base + apex],
    );
    assert_close("line", &intrinsic(&line), &expected, 1e-9);

    // All in one place: nothing to measure, so all sides are alike.
    for at in [0.0, 3.0] {
        let point = mesh(&[[at; 3]; 4], &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
        assert_close(
            "point",
            &intrinsic(&point),
            &dense(&cotan_laplacian(&shapes::tetrahedron().unwrap()).unwrap()),
            1e-14,
        );
    }

    // Two vertices of a sphere in one place, and a vertex upon an edge.
    let base = jittered(&shapes::sphere(2).unwrap(), 0.03, 1);
    let triangles = base.connectivity().triangles().to_vec();
    let mut positions: Vec<[f64; 3]> = (0..base.vertex_count() as u32).map(|v| base.position(v)).collect();
    let [a, b, c] = triangles[10].map(|v| v as usize);
    positions[a] = positions[b];
    let (p, q) = (positions[b], positions[triangles[40][0] as usize]);
    positions[c] = [0, 1, 2].map(|x| 0.5 * (p[x] + q[x]));
    let collapsed = mesh(&positions, &triangles);
    assert_sound("collapsed", &collapsed);
    assert!(intrinsic(&collapsed).symmetric_eigenvalues().iter().filter(|&&x| x < 1e-6).count() == 1, "one component");
}

#[test]
fn the_worst_meshes_stay_finite() {
    // Needles, slivers, and lengths from end to end of the numbers.
    for stretch in [1e-300, 1e-16, 1e-8, 1e-4, 1e4, 1e8, 1e16, 1e70] {
        for (name, base) in varied() {
            let positions: Vec<f64> =
                base.positions().iter().enumerate().map(|(i, x)| if i % 3 == 0 { x * stretch } else { *x }).collect();
            let triangles = base.connectivity().triangles().as_flattened().to_vec();
            assert_sound(&format!("{name} stretched {stretch:e}"), &TriMesh::new(positions, triangles).unwrap());
        }
    }
    // Few places for many vertices.
    for seed in 0..200 {
        let base = random_complex(seed, 9, 4 + seed as usize % 60);
        let positions: Vec<f64> = base.positions().iter().map(|x| (1.4 * x).round()).collect();
        let triangles = base.connectivity().triangles().as_flattened().to_vec();
        assert_sound(&format!("crowd {seed}"), &TriMesh::new(positions, triangles).unwrap());
    }
    // Vertices on a line, and a fan of a parabola, which takes many flips per edge.
    for curve in [0.0, 1e-3, 1.0] {
        let n = 150_u32;
        let mut positions: Vec<[f64; 3]> =
            (0..n).map(|v| f64::from(v) / f64::from(n)).map(|x| [x, curve * x * x, 0.0]).collect();
        positions.push([0.5, 40.0, 0.0]);
        let mut triangles: Vec<[u32; 3]> = (1..n - 1).map(|v| [0, v, v + 1]).collect();
        triangles.push([0, n - 1, n]);
        assert_sound("fan", &mesh(&positions, &triangles));
    }
}

#[test]
fn it_smooths() {
    for (name, mesh) in varied() {
        if mesh.topology().unwrap().isolated_vertices > 0 || mesh.area() == 0.0 {
            continue;
        }
        let (f, n) = (noise(mesh.vertex_count(), 5), mesh.vertex_count());
        let matrix =
            dense(&laplacian(&mesh, LaplacianWeights::IntrinsicDelaunay, &morse_smooth::Watch::none()).unwrap());
        for metric in [Metric::Identity, Metric::Mass] {
            let mass = match metric {
                Metric::Mass => dense(&galerkin_mass(&mesh, Default::default()).unwrap()),
                _ => DMatrix::identity(n, n),
            };
            let epsilon = 0.05;
            let system = matrix.transpose() * &matrix + &mass * epsilon;
            let expected = system.lu().solve(&(&mass * DVector::from_vec(f.clone()) * epsilon)).unwrap();
            for solver in [SolverChoice::Auto, SolverChoice::Cholesky, SolverChoice::ConjugateGradient] {
                let weights = LaplacianWeights::IntrinsicDelaunay;
                let options = SmootherOptions { weights, solver, ..SmootherOptions::default() };
                let mut smoother = Smoother::new(&mesh, options).unwrap();
                let options = TikhonovOptions { epsilon, metric, ..TikhonovOptions::default() };
                let found = DVector::from_vec(smoother.tikhonov(&f, &options).unwrap().values);
                let error = (found - &expected).abs().max();
                assert!(error < 1e-7, "{name} {metric:?} {solver:?}: {error:e}");
            }
        }
    }
}
