//! What holds of every interpolation and every least-squares fit, whatever the mesh.

use std::collections::BTreeMap;

use morse_smooth::field::{CriticalKind, DeltaOptions, Features, Threshold};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{
    Constraints, Energy, InterpolateOptions, LeastSquaresOptions, Metric, Operator, SmoothReport, Smoothed, Smoother,
    SolverChoice, TikhonovOptions, Unconstrained, constrained_vertices,
};
use nalgebra::DVector;

use crate::analyses::critical_points;
use crate::dense_reference::{Reference, error, is_distinct, meshes, named, settings, smoother, sparse_set};
use crate::support::{every_kind, link_components, links, noise, random_complex, random_surface, tied};

const ENERGIES: [Energy; 2] = [Energy::Harmonic, Energy::Biharmonic];

fn interpolate(smoother: &mut Smoother, f: &[f64], constraints: Constraints<'_>, energy: Energy) -> Smoothed {
    smoother
        .interpolate(f, &InterpolateOptions { constraints, energy, channels: 1, ..InterpolateOptions::default() })
        .unwrap()
}

fn fit(smoother: &mut Smoother, f: &[f64], set: &[u32], weights: Option<&[f64]>, epsilon: f64) -> Smoothed {
    let constraints = named(set, Unconstrained::Keep);
    smoother
        .least_squares(
            f,
            &LeastSquaresOptions { constraints, epsilon, weights, channels: 1, ..LeastSquaresOptions::default() },
        )
        .unwrap()
}

/// Type and multiplicity of every critical point by the components of lower and upper links.
fn critical(mesh: &TriMesh, f: &[f64]) -> BTreeMap<u32, (CriticalKind, usize)> {
    let mut found = BTreeMap::new();
    for (v, link) in links(f.len(), mesh.connectivity().triangles()).iter().enumerate() {
        let is_below = |u: u32| (f[u as usize], u as usize) < (f[v], v);
        let (lower, upper) = (link_components(link, is_below).len(), link_components(link, |u| !is_below(u)).len());
        let kind = match (lower, upper) {
            (0, 0) | (1, 1) => continue,
            (0, _) => (CriticalKind::Minimum, 1),
            (_, 0) => (CriticalKind::Maximum, 1),
            _ => (CriticalKind::Saddle, lower.max(upper) - 1),
        };
        found.insert(v as u32, kind);
    }
    found
}

fn check_kept(mesh: &TriMesh, f: &[f64], x: &[f64], features: &[u32], set: &[u32], report: &SmoothReport) {
    let (before, after) = (critical(mesh, f), critical(mesh, x));
    let constrained: Vec<u32> = before.keys().copied().filter(|v| features.contains(v)).collect();
    let preserved = constrained.iter().filter(|&v| before.get(v) == after.get(v)).count();
    let is_free = |(v, kind): &(&u32, &(CriticalKind, usize))| kind.0 != CriticalKind::Saddle && !set.contains(v);
    let free_extrema = after.iter().filter(is_free).count();
    assert_eq!(report.constraint_count, set.len());
    assert_eq!(report.constrained_critical_points, Some(constrained.len()));
    assert_eq!(report.preserved, Some(preserved));
    assert_eq!(report.free_extrema, Some(free_extrema));
}

#[test]
fn critical_points_with_stars_keep_their_types() {
    let mut all = every_kind();
    for seed in 0..6 {
        all.push(("random complex", random_complex(seed, 12, 20 + 8 * seed as usize)));
        all.push(("random surface", random_surface(seed, &shapes::torus(9, 7, 0.3).unwrap(), 0.08 * seed as f64)));
    }
    for (name, mesh) in all {
        let n = mesh.vertex_count();
        for f in [noise(n, 3), tied(n, 4, 3.0), vec![0.25; n]] {
            for setting in settings() {
                let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
                for features in [
                    Features::CriticalPoints(DeltaOptions::default()),
                    Features::CriticalPoints(DeltaOptions { delta: 0.2, ..DeltaOptions::default() }),
                    Features::Persistence(Threshold::Relative(0.4)),
                    Features::Vertices(&[2, 0]),
                ] {
                    for (stars, energy) in [(true, ENERGIES[0]), (true, ENERGIES[1]), (false, ENERGIES[0])] {
                        let constraints = Constraints { features, stars, unconstrained: Unconstrained::Keep };
                        let found = interpolate(&mut smoother, &f, constraints, energy);
                        let report = &found.reports[0];
                        let set = constrained_vertices(
                            &mesh,
                            &f,
                            1,
                            morse_smooth::field::Missing::Error,
                            &constraints,
                            &morse_smooth::Watch::none(),
                        )
                        .unwrap();
                        let plain = Constraints { stars: false, ..constraints };
                        let chosen = constrained_vertices(
                            &mesh,
                            &f,
                            1,
                            morse_smooth::field::Missing::Error,
                            &plain,
                            &morse_smooth::Watch::none(),
                        )
                        .unwrap();
                        for &v in &set {
                            assert_eq!(found.values[v as usize].to_bits(), f[v as usize].to_bits(), "{name} {v}");
                        }
                        check_kept(&mesh, &f, &found.values, &chosen, &set, report);
                        if stars {
                            assert_eq!(report.preserved, report.constrained_critical_points, "{name} {setting:?}");
                        }
                        if f[0] == 0.25 {
                            assert_eq!(found.values, f, "constants stay");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn affine_maps_and_mirrors_go_through() {
    let mut compared = 0;
    for (name, mesh) in meshes() {
        let f = noise(mesh.vertex_count(), 9);
        let moved: Vec<f64> = f.iter().map(|v| -250.0 * v + 17.0).collect();
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let set = sparse_set(&Reference::new(&smoother), 11);
            let constraints = named(&set, Unconstrained::Mean);
            let mut check = |context: &str, apply: &mut dyn FnMut(&mut Smoother, &[f64]) -> Smoothed| {
                let (x, y) = (apply(&mut smoother, &f), apply(&mut smoother, &moved));
                let expected: Vec<f64> = x.values.iter().map(|v| -250.0 * v + 17.0).collect();
                let wrong = error(&moved, &y.values, &expected);
                assert!(wrong < 1e-11, "{name} {setting:?} {context}: {wrong:e}");
                let (a, b) = (x.reports[0].after, y.reports[0].after);
                if is_distinct(&mesh, &x.values) {
                    compared += 1;
                    let down = apply(&mut smoother, &f.iter().map(|v| -v).collect::<Vec<_>>()).reports[0].after;
                    assert_eq!((a.minima, a.maxima, a.saddles), (down.maxima, down.minima, down.saddles), "{name}");
                }
                assert_eq!(a.index_sum, b.index_sum);
                if name == "torus" {
                    assert_eq!(i64::from(a.minima) + i64::from(a.maxima), i64::from(a.saddles));
                }
            };
            for energy in ENERGIES {
                check("interpolate", &mut |s, f| interpolate(s, f, named(&set, Unconstrained::Keep), energy));
                check("Mean", &mut |s, f| interpolate(s, f, constraints, energy));
            }
            for epsilon in [1e-3, 1.0, 1e3] {
                check("least squares", &mut |s, f| fit(s, f, &set, None, epsilon));
            }
        }
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn constants_stay_under_every_weight() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let weights: Vec<f64> = (0..n).map(|v| 0.1 + v as f64).collect();
            let all: Vec<u32> = (0..n as u32).collect();
            for epsilon in [1e-6, 1.0, 1e6] {
                let found = fit(&mut smoother, &vec![7.3; n], &all, Some(&weights), epsilon);
                assert_eq!(found.values, vec![7.3; n], "{name} {setting:?}");
            }
        }
    }
}

#[test]
fn the_maximum_principle_and_its_certificate() {
    let (mut certified, mut void) = (0, 0);
    for (name, mesh) in meshes().into_iter().chain(every_kind()) {
        let n = mesh.vertex_count();
        // With the range [0, 1] values are their own normalisation.
        let mut f = noise(n, 5).iter().map(|x| 0.5 + 0.4 * x).collect::<Vec<f64>>();
        let used = mesh.connectivity().triangles().as_flattened();
        f[used[0] as usize] = 0.0;
        f[used[1] as usize] = 1.0;
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            for every in [5, 23, 1000] {
                let set = sparse_set(&reference, every);
                let found = interpolate(&mut smoother, &f, named(&set, Unconstrained::Keep), Energy::Harmonic);
                let (x, report) = (&found.values, &found.reports[0]);
                let certificate = report.maximum_principle.expect("of a harmonic interpolation");
                let free = reference.free(&set);
                let is_extremum = |v: usize, around: &[usize]| {
                    let beyond = |s: f64| around.iter().all(|&j| s * (x[j] - x[v]) > 1e-12);
                    !around.is_empty() && (beyond(1.0) || beyond(-1.0))
                };
                let around = |v: usize| -> Vec<usize> {
                    (0..n).filter(|&j| j != v && reference.laplacian[(v, j)] != 0.0).collect()
                };
                let smallest = free.iter().flat_map(|&v| around(v).into_iter().map(move |j| (v, j)));
                let smallest = smallest.map(|(v, j)| -reference.laplacian[(v, j)]).fold(f64::INFINITY, f64::min);
                assert_eq!(certificate.smallest_weight, if smallest.is_finite() { smallest } else { 0.0 }, "{name}");
                let extrema = free.iter().filter(|&&v| is_extremum(v, &around(v))).count();
                assert_eq!(certificate.extrema, extrema, "{name} {setting:?}");
                let mesh_links = links(n, mesh.connectivity().triangles());
                let along_edges = |v: usize| -> Vec<usize> { mesh_links[v].keys().map(|&u| u as usize).collect() };
                let extrema = free.iter().filter(|&&v| is_extremum(v, &along_edges(v))).count();
                assert_eq!(certificate.mesh_extrema, extrema, "{name} {setting:?}");
                if certificate.smallest_weight >= 0.0 {
                    assert_eq!(certificate.extrema, 0, "{name} {setting:?}");
                    certified += free.len();
                    let low = set.iter().map(|&v| f[v as usize]).fold(f64::INFINITY, f64::min);
                    let high = set.iter().map(|&v| f[v as usize]).fold(f64::NEG_INFINITY, f64::max);
                    assert!(free.iter().all(|&v| x[v] >= low - 1e-12 && x[v] <= high + 1e-12), "{name} {setting:?}");
                } else {
                    void += 1;
                }
                if [LaplacianWeights::Uniform, LaplacianWeights::MeanValue].contains(&setting.0) {
                    assert!(certificate.smallest_weight >= 0.0, "{name}");
                    // On every kind of mesh these couple the ends of every edge, but for vertices without area.
                    if setting.0 == LaplacianWeights::Uniform {
                        assert_eq!(certificate.mesh_extrema, 0, "{name}");
                    }
                }
                let other = interpolate(&mut smoother, &f, named(&set, Unconstrained::Keep), Energy::Biharmonic);
                assert_eq!(other.reports[0].maximum_principle, None);
            }
        }
    }
    assert!(certified > 1000 && void > 10, "{certified} {void}");
}

#[test]
fn energies_are_least_among_competitors() {
    for (name, mesh) in meshes() {
        let f = noise(mesh.vertex_count(), 12);
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            let set = sparse_set(&reference, 17);
            let free = reference.free(&set);
            for energy in ENERGIES {
                if energy == Energy::Harmonic && !setting.0.is_symmetric() {
                    continue;
                }
                let energy_of = |x: &[f64]| {
                    let x = DVector::from_column_slice(x);
                    let image = &reference.laplacian * &x;
                    match energy {
                        Energy::Harmonic => image.dot(&x),
                        Energy::Biharmonic => image.iter().zip(&reference.weights).map(|(y, w)| y * y * w).sum(),
                    }
                };
                let x = interpolate(&mut smoother, &f, named(&set, Unconstrained::Keep), energy).values;
                let least = energy_of(&x);
                assert!(free.is_empty() || least < energy_of(&f), "{name} {setting:?} {energy:?}");
                for seed in 0..30 {
                    let amount = 10.0_f64.powi(-(seed as i32) / 6);
                    let mut other = x.clone();
                    free.iter().zip(noise(free.len(), seed)).for_each(|(&v, e)| other[v] += amount * e);
                    assert!(least <= energy_of(&other) * (1.0 + 1e-12), "{name} {setting:?} {energy:?} {amount:e}");
                }
            }
        }
    }
}

#[test]
fn sums_over_the_constrained_vertices_stay() {
    for (name, mesh) in meshes() {
        let f: Vec<f64> = noise(mesh.vertex_count(), 13).iter().map(|x| 3.0 + x).collect();
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            let set = sparse_set(&reference, 7);
            let weights: Vec<f64> = noise(set.len(), 2).iter().map(|x| 2.0 + x).collect();
            for epsilon in [1e-3, 0.5, 1e3] {
                let x = fit(&mut smoother, &f, &set, Some(&weights), epsilon).values;
                let total = |v: &[f64]| -> f64 { set.iter().zip(&weights).map(|(&i, w)| w * v[i as usize]).sum() };
                let (found, expected) = (total(&x), total(&f));
                assert!(
                    (found - expected).abs() < 1e-10 * expected,
                    "{name} {setting:?} {epsilon}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn least_squares_lie_between_their_limits() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        let f = noise(n, 14);
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            let all: Vec<u32> = (0..n as u32).collect();
            if setting.1 == Operator::Paper {
                // All vertices alike: eq. (3).
                for epsilon in [1e-3, 1.0, 1e3] {
                    let at = TikhonovOptions {
                        epsilon,
                        metric: Metric::Identity,
                        mass_scale: MassScale::Raw,
                        channels: 1,
                        ..TikhonovOptions::default()
                    };
                    let expected = smoother.tikhonov(&f, &at).unwrap();
                    let found = fit(&mut smoother, &f, &all, None, epsilon);
                    let wrong = error(&f, &found.values, &expected.values);
                    assert!(wrong < 1e-12, "{name} {setting:?} {epsilon}: {wrong:e}");
                }
            }
            let set = sparse_set(&reference, 9);
            let weights: Vec<f64> = noise(set.len(), 2).iter().map(|x| 2.0 + x).collect();
            let limit = interpolate(&mut smoother, &f, named(&set, Unconstrained::Keep), Energy::Biharmonic).values;
            let mut previous: Option<(f64, f64, f64)> = None;
            for step in -4..=9 {
                let found = fit(&mut smoother, &f, &set, Some(&weights), 10.0_f64.powi(step));
                let image = &reference.laplacian * DVector::from_column_slice(&found.values);
                let roughness: f64 = image.iter().zip(&reference.weights).map(|(y, w)| y * y * w).sum();
                let distance: f64 = set
                    .iter()
                    .zip(&weights)
                    .map(|(&v, w)| w * (found.values[v as usize] - f[v as usize]).powi(2))
                    .sum();
                let apart = error(&f, &found.values, &limit);
                if let Some((d, r, a)) = previous {
                    assert!(distance <= d * (1.0 + 1e-9) + 1e-25, "{name} {setting:?} {step}: {distance:e} {d:e}");
                    assert!(roughness >= r * (1.0 - 1e-9) - 1e-20, "{name} {setting:?} {step}");
                    assert!(step < 5 || a < 1e-9 || apart < 0.2 * a, "{name} {setting:?} {step}: {apart:e} {a:e}");
                }
                previous = Some((distance, roughness, apart));
            }
        }
    }
}

#[test]
fn reports_of_constrained_smoothings() {
    for (name, mesh) in meshes() {
        let n = mesh.vertex_count();
        let mut f: Vec<f64> = noise(n, 15).iter().map(|x| 30.0 * x - 4.0).collect();
        let isolated: Vec<usize> = (0..n).filter(|&v| mesh.connectivity().star(v as u32).is_empty()).collect();
        isolated.iter().for_each(|&v| f[v] = -1e6);
        let used = |v: &usize| !isolated.contains(v);
        let low = (0..n).filter(used).map(|v| f[v]).fold(f64::INFINITY, f64::min);
        let high = (0..n).filter(used).map(|v| f[v]).fold(f64::NEG_INFINITY, f64::max);
        let normalized = |v: &[f64]| {
            DVector::from_iterator(n, (0..n).map(|i| if used(&i) { (v[i] - low) / (high - low) } else { 0.0 }))
        };
        for setting in settings() {
            let mut smoother = smoother(&mesh, setting, SolverChoice::Auto);
            let reference = Reference::new(&smoother);
            let set = sparse_set(&reference, 6);
            let weights: Vec<f64> = noise(set.len(), 2).iter().map(|x| 2.0 + x).collect();
            let keep = named(&set, Unconstrained::Mean);
            let mut all = vec![(fit(&mut smoother, &f, &set, Some(&weights), 0.2), Some(0.2))];
            all.extend(ENERGIES.map(|energy| (interpolate(&mut smoother, &f, keep, energy), None)));
            for (found, epsilon) in all {
                let report = &found.reports[0];
                let (from, to) = (normalized(&f), normalized(&found.values));
                let (l, d) = (&reference.laplacian, &to - &from);
                let pulled: f64 = set.iter().zip(&weights).map(|(&v, w)| w * d[v as usize].powi(2)).sum();
                for (what, value, expected) in [
                    ("l∞", report.l_infinity, d.amax()),
                    ("l2", report.l2, d.norm()),
                    ("metric", report.metric_norm, if epsilon.is_some() { pulled.sqrt() } else { d.norm() }),
                    ("‖Lx‖", report.laplacian_norm, (l * &to).norm()),
                    ("S(f)", report.sobolev_before, (l * &from).dot(&from)),
                    ("S(x)", report.sobolev_after, (l * &to).dot(&to)),
                ] {
                    let size = expected.abs().max(1e-3);
                    assert!((value - expected).abs() <= 1e-10 * size, "{name} {setting:?} {what}: {value} {expected}");
                }
                let counts = |v: &[f64]| critical_points(&mesh, v, &DeltaOptions::default()).unwrap().counts;
                assert_eq!((report.before, report.after), (counts(&f), counts(&found.values)));
                let (method, equation) =
                    if epsilon.is_some() { ("leastSquares", "(7)") } else { ("interpolate", "(6)") };
                assert_eq!((report.method.name(), report.equation.name(), report.epsilon), (method, equation, epsilon));
                assert!(report.solver.relative_residual < 1e-10 && report.perturbation_factor.is_none());
                check_kept(&mesh, &f, &found.values, &set, &set, report);
            }
        }
    }
}
