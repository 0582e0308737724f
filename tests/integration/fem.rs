//! The finite-element operator: L M⁻¹ L beside εM in the units of the mesh.

use core::f64::consts::{PI, TAU};

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale, lumped_mass_diagonal};
use morse_smooth::smooth::{
    Metric, Operator, Precision, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, epsilon_for_wavelength,
};

use crate::operators::ALL_WEIGHTS;
use crate::routes::{error, reference};
use crate::support::{every_kind, noise};

fn fem(mesh: &TriMesh) -> Smoother {
    Smoother::new(mesh, SmootherOptions { operator: Operator::Fem, ..SmootherOptions::default() }).unwrap()
}

fn at(epsilon: f64) -> TikhonovOptions {
    TikhonovOptions { epsilon, ..TikhonovOptions::default() }
}

fn scaled(mesh: &TriMesh, factor: f64) -> TriMesh {
    let positions = mesh.positions().iter().map(|x| x * factor).collect();
    TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

#[test]
fn solutions_agree_with_dense_algebra_on_every_kind_of_mesh() {
    for (name, mesh) in every_kind() {
        let f = noise(mesh.vertex_count(), 5);
        let mut smoother = fem(&mesh);
        let areas = lumped_mass_diagonal(&mesh, MassScale::Raw).unwrap();
        let largest = smoother.laplacian().values().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for epsilon in [1e6, 1.0, 1e-2, 1e-4, 1e-6] {
            let found = smoother.tikhonov(&f, &at(epsilon)).unwrap();
            let expected = reference(&mesh, LaplacianWeights::Cotangent, Operator::Fem, Metric::Mass, epsilon, &f);
            let wrong = error(&f, &found.values, &expected);
            assert!(wrong < 1e-11, "{name} ε = {epsilon:e}: {wrong:e}");
            let report = &found.reports[0];
            assert_eq!((report.equation.name(), report.solver.route.name()), ("fem", "complexCholesky"), "{name}");
            // The residual is a difference of products with L M⁻¹ L, which are rounded, beside a small εMf.
            let residual = report.solver.relative_residual;
            let least = areas.iter().copied().filter(|&a| a > 0.0).fold(f64::INFINITY, f64::min);
            let rounding = 1e-15 * (1.0 + largest * largest / (least * least * epsilon));
            assert!(residual < rounding, "{name} ε = {epsilon:e}: {residual:e} where rounding is {rounding:e}");
        }
    }
}

#[test]
fn the_unit_of_the_mesh_does_not_matter() {
    let mesh = shapes::torus(17, 12, 0.4).unwrap();
    let f = noise(mesh.vertex_count(), 5);
    for epsilon in [10.0, 1e-2] {
        let expected = fem(&mesh).tikhonov(&f, &at(epsilon)).unwrap().values;
        for factor in [1e-30, 1e-6, 0.1, 7.0, 1e3, 1e30] {
            let found = fem(&scaled(&mesh, factor)).tikhonov(&f, &at(epsilon * f64::powi(factor, -4))).unwrap();
            let wrong = error(&f, &found.values, &expected);
            assert!(wrong < 1e-11, "{factor:e}: {wrong:e}");
        }
    }
}

/// Damps an eigenfunction of the surface with eigenvalue λ, for several ε; the largest deviation from ε/(λ² + ε).
fn deviation(mesh: &TriMesh, lambda: f64, eigenfunction: impl Fn([f64; 3]) -> f64) -> f64 {
    let f: Vec<f64> = (0..mesh.vertex_count() as u32).map(|v| eigenfunction(mesh.position(v))).collect();
    let mut smoother = fem(mesh);
    let mut worst = 0.0_f64;
    for ratio in [0.1, 1.0, 10.0] {
        let epsilon = ratio * lambda * lambda;
        let found = smoother.tikhonov(&f, &at(epsilon)).unwrap().values;
        let expected: Vec<f64> = f.iter().map(|f| f * ratio / (1.0 + ratio)).collect();
        worst = worst.max(error(&f, &found, &expected));
    }
    worst
}

#[test]
fn eigenfunctions_of_the_sphere_are_damped_as_they_should() {
    // Spherical harmonics of degree l have the eigenvalue l(l + 1).
    for subdivisions in [4, 5] {
        let mesh = shapes::sphere(subdivisions).unwrap();
        for (lambda, harmonic) in [
            (2.0, (|p| p[2]) as fn([f64; 3]) -> f64),
            (6.0, |p| 3.0 * p[2] * p[2] - 1.0),
            (6.0, |p| p[0] * p[1]),
            (12.0, |p| p[0] * (5.0 * p[2] * p[2] - 1.0)),
            (20.0, |p| p[0] * p[1] * (7.0 * p[2] * p[2] - 1.0)),
        ] {
            let wrong = deviation(&mesh, lambda, harmonic);
            // The second order of linear elements, in the length of the edges times the wave number.
            let edge = PI / 2.0 / f64::from(1_u32 << subdivisions);
            assert!(wrong < 0.5 * edge * edge * lambda, "{subdivisions}, λ = {lambda}: {wrong:e}");
        }
    }
}

#[test]
fn refining_the_mesh_changes_little() {
    // In contrast to eq. (3) and (5), ε means the same on every mesh of a surface.
    let wave = |p: [f64; 3]| (3.0 * p[0]).sin() + p[1] * p[2];
    let value_at_first = |subdivisions: u32, operator: Operator, epsilon: f64| {
        let mesh = shapes::sphere(subdivisions).unwrap();
        let f: Vec<f64> = (0..mesh.vertex_count() as u32).map(|v| wave(mesh.position(v))).collect();
        let mut smoother = Smoother::new(&mesh, SmootherOptions { operator, ..SmootherOptions::default() }).unwrap();
        // The vertices of a mesh are the first ones of its subdivision.
        smoother.tikhonov(&f, &at(epsilon)).unwrap().values[..66].to_vec()
    };
    let change =
        |operator, epsilon| error(&[1.0], &value_at_first(4, operator, epsilon), &value_at_first(5, operator, epsilon));
    // Either ε halves waves of degree 2 on the first mesh.
    let (fem, paper) = (change(Operator::Fem, 36.0), change(Operator::Paper, 5e-3));
    assert!(fem < 0.01 && paper > 0.1, "{fem:e} {paper:e}");
}

#[test]
fn the_wavelength_is_that_of_half_the_amplitude() {
    // Waves along a strip so long and fine that its ends and its mesh hardly matter.
    let base = shapes::grid(201, 6).unwrap();
    let positions = base.positions().chunks_exact(3).flat_map(|p| [20.0 * p[0], 0.5 * p[1], 0.0]).collect();
    let strip = TriMesh::new(positions, base.connectivity().triangles().as_flattened().to_vec()).unwrap();
    for wavelength in [2.0, 4.0, 5.0] {
        // Cosines have no slope at the ends, so they are eigenfunctions.
        let f: Vec<f64> = strip.positions().chunks_exact(3).map(|p| (TAU * p[0] / wavelength).cos()).collect();
        let epsilon = epsilon_for_wavelength(wavelength).unwrap();
        let found = fem(&strip).tikhonov(&f, &at(epsilon)).unwrap().values;
        let half: Vec<f64> = f.iter().map(|f| 0.5 * f).collect();
        let wrong = error(&f, &found, &half);
        assert!(wrong < 0.02, "{wavelength}: {wrong:e}");
        let expected = (TAU / wavelength).powi(4);
        assert!((epsilon - expected).abs() <= 1e-14 * expected);
    }
}

#[test]
fn wavelengths_that_mean_nothing_are_refused() {
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e-300, 1e300, 1e-78, 1e82] {
        let refused = epsilon_for_wavelength(bad).expect_err("no wavelength");
        assert_eq!(refused.code(), "InvalidOption", "{bad:e}");
        assert!(refused.to_string().contains("cutoffWavelength"));
    }
    for good in [1e-76, 1e-10, 1.0, 1e10, 1e80] {
        assert!(epsilon_for_wavelength(good).is_ok(), "{good:e}");
    }
}

#[test]
fn options_that_mean_nothing_are_refused() {
    let mesh = shapes::octahedron().unwrap();
    for weights in ALL_WEIGHTS {
        for solver in [SolverChoice::Auto, SolverChoice::ConjugateGradient] {
            for precision in [Precision::Double, Precision::Single] {
                let options = SmootherOptions { weights, operator: Operator::Fem, solver, precision, bounds: false };
                let made = Smoother::new(&mesh, options).map(|_| ()).map_err(|e| (e.code(), e.to_string()));
                if weights == LaplacianWeights::Cotangent {
                    assert_eq!(made, Ok(()));
                } else {
                    let (code, message) = made.expect_err("cotangent weights only");
                    assert!(code == "InapplicableOption" && message.contains("weights"), "{message}");
                }
            }
        }
    }
    let f = noise(6, 1);
    let mut smoother = fem(&mesh);
    let good = smoother.tikhonov(&f, &at(1.0)).unwrap();
    for (name, options) in [
        ("metric", TikhonovOptions { metric: Metric::Identity, ..at(1.0) }),
        ("metric", TikhonovOptions { metric: Metric::Lumped, ..at(1.0) }),
        ("massScale", TikhonovOptions { mass_scale: MassScale::Raw, ..at(1.0) }),
    ] {
        let refused = smoother.tikhonov(&f, &options).expect_err("has its own mass");
        assert_eq!(refused.code(), "InapplicableOption");
        assert!(refused.to_string().contains(name), "{refused}");
    }
    assert_eq!(smoother.tikhonov(&f, &at(1.0)).unwrap(), good);
}
