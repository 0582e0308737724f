//! The bilateral filter against a double loop over all vertices.

use morse_smooth::mesh::{LinkKind, TriMesh, shapes};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::BilateralOptions;
use nalgebra::{DMatrix, DVector};

use crate::filters::{affine, bilateral, error, meshes, smoother};
use crate::support::{islands, jittered, jittered_plane, noise};

/// The filter by its definition, over all pairs.
fn reference_bilateral(mesh: &TriMesh, f: &[f64], options: &BilateralOptions) -> Vec<f64> {
    let kinds = mesh.connectivity().link_kinds();
    let used: Vec<usize> = (0..f.len()).filter(|&v| kinds[v] != LinkKind::Isolated).collect();
    let gauss = |t: f64, sigma: f64| (-(t / sigma) * (t / sigma) / 2.0).exp();
    let mut x = f.to_vec();
    for _ in 0..options.iterations {
        let before = x.clone();
        for &i in &used {
            let (mut above, mut below) = (0.0, 0.0);
            for &j in &used {
                let (p, q) = (mesh.position(i as u32), mesh.position(j as u32));
                let distance = (0..3).map(|k| (q[k] - p[k]) * (q[k] - p[k])).sum::<f64>().sqrt();
                if distance <= options.radius {
                    let difference = before[j] - before[i];
                    let weight = gauss(distance, options.sigma_distance) * gauss(difference, options.sigma_value);
                    above += weight * difference;
                    below += weight;
                }
            }
            x[i] = before[i] + above / below;
        }
    }
    x
}

/// A sphere pulled together to a dense spot and a thin rest.
fn uneven() -> TriMesh {
    let sphere = jittered(&shapes::sphere(3).unwrap(), 0.02, 8);
    let positions = sphere.positions().chunks_exact(3).flat_map(|p| {
        let scale = (1.0 + 1.001 * p[2].clamp(-0.99, 1.0)).powi(2);
        [p[0] * scale, p[1] * scale, scale]
    });
    TriMesh::new(positions.collect(), sphere.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

fn moved(mesh: &TriMesh, scale: f64, offset: f64) -> TriMesh {
    let positions = mesh.positions().iter().map(|x| scale * x + offset).collect();
    TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

#[test]
fn bilateral_agrees_with_a_double_loop() {
    let mut all = meshes();
    all.push(("uneven", uneven()));
    all.push(("far away", moved(&jittered(&shapes::sphere(2).unwrap(), 0.05, 3), 1.0, 1e8)));
    all.push(("needle", moved(&uneven(), 1e-9, 7.0)));
    for (name, mesh) in all {
        let f = affine(&noise(mesh.vertex_count(), 7), 40.0, -300.0);
        let smoother = smoother(&mesh, LaplacianWeights::Uniform);
        // No distance in these meshes is one of these radii, where rounding would decide.
        for (radius, sigma_distance, sigma_value) in [
            (1e-12, 1.0, 10.0),
            (1e-9, 1e-9, 20.0),
            (0.11, 0.05, 30.0),
            (0.37, 0.3, 5.0),
            (0.97, 0.5, 1e4),
            (2.57, 10.0, 12.0),
            (1e3, 0.2, 17.0),
        ] {
            for iterations in [1, 3] {
                let options = bilateral(iterations, radius, sigma_distance, sigma_value);
                let found = smoother.bilateral(&f, &options).unwrap();
                let wrong = error(&f, &found.values, &reference_bilateral(&mesh, &f, &options));
                assert!(wrong < 1e-13, "{name} {options:?}: {wrong:e}");
                let report = &found.reports[0];
                assert_eq!((report.method.name(), report.equation.name()), ("bilateral", "[15]"));
                assert_eq!((report.solver.route.name(), report.solver.iterations), ("none", iterations));
                assert_eq!(report.perturbation_factor, None);
            }
        }
    }
}

#[test]
fn neighbours_at_the_radius_count() {
    // Lattices whose distances are exact: 3-4-5 triangles, and cells as wide as the radius.
    for scale in [1.0, 0.25, 1024.0] {
        let mesh = moved(&shapes::grid(17, 17).unwrap(), 16.0 * scale, -3.0 * scale);
        let f = noise(mesh.vertex_count(), 2);
        let smoother = smoother(&mesh, LaplacianWeights::Uniform);
        for radius in [1.0, 2.0, 3.0, 5.0, 10.0, 16.0] {
            let at = bilateral(1, radius * scale, 4.0 * scale, 1.0);
            let found = smoother.bilateral(&f, &at).unwrap().values;
            let wrong = error(&f, &found, &reference_bilateral(&mesh, &f, &at));
            assert!(wrong < 1e-13, "{scale} {radius}: {wrong:e}");
            let below = BilateralOptions { radius: radius * scale * (1.0 - 1e-15), ..at };
            let less = smoother.bilateral(&f, &below).unwrap().values;
            assert!(error(&f, &less, &found) > 1e-6, "{scale} {radius}");
            assert!(error(&f, &less, &reference_bilateral(&mesh, &f, &below)) < 1e-13, "{scale} {radius}");
        }
    }
}

#[test]
fn extreme_lengths_are_no_trouble() {
    let f = noise(islands().vertex_count(), 4);
    for scale in [1e-70, 1.0, 1e73] {
        let mesh = moved(&islands(), scale, 0.0);
        let smoother = smoother(&mesh, LaplacianWeights::Uniform);
        for radius in [f64::MIN_POSITIVE, 5e-324, 1e-200, 1e-20, 1.0, 1e20, 1e200, f64::MAX] {
            for sigma in [5e-324, 1e-160, 1.0, 1e160, f64::MAX] {
                for sigma_value in [5e-324, 1e-3, f64::MAX] {
                    let found = smoother.bilateral(&f, &bilateral(2, radius, sigma, sigma_value)).unwrap();
                    assert!(found.values.iter().all(|x| x.abs() <= 1.0), "{scale:e} {radius:e} {sigma:e}");
                    // Whatever is closer than the least distance between vertices.
                    if radius < 0.1 * scale {
                        assert_eq!(found.values, f, "{scale:e} {radius:e} {sigma:e}");
                    }
                }
            }
        }
        // All equal weights: every vertex gets the mean of those in triangles.
        let found = smoother.bilateral(&f, &bilateral(1, f64::MAX, f64::MAX, f64::MAX)).unwrap().values;
        let used: Vec<usize> = (0..f.len()).filter(|v| ![4, 5].contains(v)).collect();
        let mean = used.iter().map(|&v| f[v]).sum::<f64>() / used.len() as f64;
        used.iter().for_each(|&v| assert!((found[v] - mean).abs() < 1e-15, "{scale:e}"));
        assert_eq!(found[4..6], f[4..6]);
    }
}

#[test]
fn bilateral_filters_keep_steps_and_become_gaussian_averages() {
    let plane = jittered_plane(20, 15, 6);
    let n = plane.vertex_count();
    let error_of_step = noise(n, 3);
    let side = |v: usize| if plane.position(v as u32)[0] < 0.5 { -1.0 } else { 1.0 };
    let f: Vec<f64> = (0..n).map(|v| side(v) + 0.05 * error_of_step[v]).collect();
    let smoother = smoother(&plane, LaplacianWeights::Uniform);
    let kept = smoother.bilateral(&f, &bilateral(5, 0.3, 0.1, 0.1)).unwrap().values;
    (0..n).for_each(|v| assert!((kept[v] - side(v)).abs() < 0.03, "{v}: {}", kept[v]));
    // Differences of all sizes count the same: a matrix with rows of Gaussians divided by their sums.
    let blurred = smoother.bilateral(&f, &bilateral(1, 10.0, 0.1, 1e12)).unwrap().values;
    let mut matrix = DMatrix::from_fn(n, n, |i, j| {
        let (p, q) = (plane.position(i as u32), plane.position(j as u32));
        (-((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)) / 0.02).exp()
    });
    for mut row in matrix.row_iter_mut() {
        let sum = row.sum();
        row /= sum;
    }
    let expected = matrix * DVector::from_column_slice(&f);
    assert!(error(&f, &blurred, expected.as_slice()) < 1e-13);
    let steepest = (0..n).map(|v| (blurred[v] - side(v)).abs()).fold(0.0, f64::max);
    assert!(steepest > 0.5, "{steepest}");
}

#[test]
fn bilateral_filters_are_affinely_equivariant() {
    for (name, mesh) in meshes() {
        let f = noise(mesh.vertex_count(), 5);
        let smoother = smoother(&mesh, LaplacianWeights::Uniform);
        let constant = vec![2.5; f.len()];
        assert_eq!(smoother.bilateral(&constant, &bilateral(3, 1.0, 1.0, 1e-3)).unwrap().values, constant);
        assert_eq!(smoother.bilateral(&f, &bilateral(0, 1.0, 1.0, 1.0)).unwrap().values, f);
        for sigma in [0.01, 0.3, 4.0] {
            let found = smoother.bilateral(&f, &bilateral(3, 0.8, 0.5, sigma)).unwrap().values;
            let options = bilateral(3, 0.8, 0.5, sigma * 3e7);
            let scaled = smoother.bilateral(&affine(&f, -3e7, 5e8), &options).unwrap().values;
            let wrong = error(&f, &affine(&scaled, -1.0 / 3e7, 5.0 / 0.3), &found);
            assert!(wrong < 1e-12, "{name} {sigma}: {wrong:e}");
        }
    }
}
